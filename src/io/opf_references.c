// The tables of an OPF file: reference meshes, materials, shapes that pair the two, attributes.
#include "io/opf.h"

#include <math.h>

enum { SIDES = 12 }; ///< of the cylinder that internodes are

// ---- what is needed ---------------------------------------------------------------------------

/// A material's mean colour where it is not a hole, for OPF knows no pictures.
static FrStatus find_colour(FrMaterial *material, const FrContext *context, vec3s *colour) {
    FrStatus status = FR_OK;
    vec3s tint = fr_material_tint(material);
    const FrImage *image = fr_material_image(material, FR_MAP_COLOUR, context, &status);
    double sum[3] = {0, 0, 0}, weight = 0;
    for (size_t i = 0; image != NULL && i < (size_t)image->width * image->height; i++) {
        const uint8_t *pixel = image->pixels + i * image->channels;
        double alpha = image->channels == 4 ? pixel[3] : 255;
        for (uint32_t k = 0; k < 3; k++) {
            sum[k] += alpha * pixel[image->channels >= 3 ? k : 0];
        }
        weight += 255 * alpha;
    }
    for (int k = 0; k < 3; k++) {
        colour->raw[k] = tint.raw[k] * (weight > 0 ? (float)(sum[k] / weight) : 1.0F);
    }
    return status;
}

static FrStatus make_colours(FrOpf *opf, FrOpfPlant *own) {
    const GPtrArray *materials = own->topology.plant->materials;
    FrStatus status = FR_OK;
    own->colours = g_new0(vec3s, materials->len + 1);
    own->colours[materials->len] = (vec3s){{0.5F, 0.5F, 0.5F}};
    for (guint m = 0; m < materials->len && status == FR_OK; m++) {
        status = find_colour(g_ptr_array_index(materials, m), opf->context, &own->colours[m]);
    }
    own->first_material = opf->materials;
    opf->materials += materials->len + 1;
    return status;
}

static FrStatus make_groups(FrOpf *opf, FrOpfPlant *own, uint32_t *meshes) {
    const FrPlant *plant = own->topology.plant;
    FrStatus status = fr_organ_groups_new(plant, &opf->options->skin, opf->context, &own->groups);
    own->meshes = g_new0(FrMesh *, MAX(own->groups->len, 1));
    own->group = g_new(uint32_t, MAX(plant->organs.count, 1));
    own->first_mesh = *meshes;
    *meshes += own->groups->len;
    for (uint32_t organ = 0; organ < plant->organs.count; organ++) {
        own->group[organ] = FR_NONE;
    }
    for (guint g = 0; g < own->groups->len && status == FR_OK; g++) {
        const FrOrganGroup *group = &g_array_index(own->groups, FrOrganGroup, g);
        status = fr_skin_shape(plant, group->shape, &opf->options->skin, FR_UP_Z, opf->context,
                               &own->meshes[g]);
        bool is_seen = status == FR_OK && own->meshes[g]->part_count > 0;
        for (guint i = 0; is_seen && i < group->organs->len; i++) {
            own->group[g_array_index(group->organs, uint32_t, i)] = g;
        }
    }
    return status;
}

FrStatus fr_opf_make_references(FrOpf *opf) {
    const FrScene *scene = opf->scene;
    FrStatus status = FR_OK;
    uint32_t meshes = 1; // the cylinder is the first
    opf->plants = g_new0(FrOpfPlant, MAX(scene->plants->len, 1));
    for (guint s = 0; s < fr_scene_stand_count(scene) && status == FR_OK; s++) {
        FrOpfPlant *own = &opf->plants[fr_io_stand(scene, s)->plant];
        if (own->groups == NULL) {
            fr_topology_init(&own->topology, fr_io_plant(scene, fr_io_stand(scene, s)->plant));
            status = make_groups(opf, own, &meshes);
            status = status == FR_OK ? make_colours(opf, own) : status;
        }
    }
    uint32_t shapes = opf->materials;
    for (guint p = 0; p < scene->plants->len && status == FR_OK; p++) {
        opf->plants[p].first_group = shapes;
        shapes += opf->plants[p].groups != NULL ? opf->plants[p].groups->len : 0;
    }
    return status;
}

void fr_opf_clear_references(FrOpf *opf) {
    for (guint p = 0; p < opf->scene->plants->len; p++) {
        FrOpfPlant *own = &opf->plants[p];
        for (guint g = 0; own->groups != NULL && g < own->groups->len; g++) {
            fr_mesh_free(own->meshes[g]);
        }
        if (own->groups != NULL) {
            g_array_unref(own->groups);
        }
        fr_topology_clear(&own->topology);
        g_free(own->meshes);
        g_free(own->group);
        g_free(own->colours);
    }
    g_free(opf->plants);
}

// ---- tables -----------------------------------------------------------------------------------

static void add_float(FrOutput *output, double value) {
    fr_output_fixed(output, value, 6);
    fr_output_text(output, " ");
}

static void open_mesh(FrOutput *output, const char *name, uint32_t id, bool is_tapered) {
    fr_output_text(output, "<mesh name=\"");
    fr_output_text(output, name);
    fr_output_text(output, "\" shape=\"\" Id=\"");
    fr_output_integer(output, id);
    fr_output_text(output, is_tapered ? "\" enableScale=\"true\">\n<points>"
                                      : "\" enableScale=\"false\">\n<points>");
}

static void add_face(FrOutput *output, uint64_t id, const uint32_t corners[3]) {
    fr_output_text(output, "<face Id=\"");
    fr_output_integer(output, id);
    fr_output_text(output, "\">");
    for (int k = 0; k < 3; k++) {
        fr_output_text(output, k > 0 ? " " : "");
        fr_output_integer(output, corners[k]);
    }
    fr_output_text(output, "</face>\n");
}

/// Of diameter and length 1, along x: two rings.
static void add_cylinder(FrOutput *output) {
    open_mesh(output, "cylinder", 0, true);
    for (int i = 0; i < 2 * SIDES; i++) {
        double angle = 2 * G_PI * (i % SIDES) / SIDES;
        add_float(output, i / SIDES);
        add_float(output, 0.5 * cos(angle));
        add_float(output, 0.5 * sin(angle));
    }
    fr_output_text(output, "</points>\n<normals>");
    for (int i = 0; i < 2 * SIDES; i++) {
        double angle = 2 * G_PI * (i % SIDES) / SIDES;
        fr_output_text(output, "0 ");
        add_float(output, cos(angle));
        add_float(output, sin(angle));
    }
    fr_output_text(output, "</normals>\n<faces>\n");
    for (uint32_t i = 0; i < SIDES; i++) {
        uint32_t next = (i + 1) % SIDES;
        add_face(output, 2 * (uint64_t)i, (uint32_t[3]){i, next, SIDES + next});
        add_face(output, 2 * (uint64_t)i + 1, (uint32_t[3]){i, SIDES + next, SIDES + i});
    }
    fr_output_text(output, "</faces>\n</mesh>\n");
}

static void add_mesh(FrOutput *output, const char *name, uint32_t id, const FrMesh *mesh) {
    open_mesh(output, name, id, false);
    for (uint64_t v = 0; v < mesh->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            add_float(output, (double)mesh->vertices[v].position[k]);
        }
    }
    fr_output_text(output, "</points>\n<normals>");
    for (uint64_t v = 0; v < mesh->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            add_float(output, (double)mesh->vertices[v].normal[k]);
        }
    }
    fr_output_text(output, "</normals>\n<textureCoords>");
    for (uint64_t v = 0; v < mesh->vertex_count; v++) {
        add_float(output, (double)mesh->vertices[v].uv[0]);
        add_float(output, 1.0 - (double)mesh->vertices[v].uv[1]); // rows count from the bottom
    }
    fr_output_text(output, "</textureCoords>\n<faces>\n");
    for (uint64_t i = 0; i + 2 < mesh->index_count; i += 3) {
        add_face(output, i / 3, mesh->indices + i);
    }
    fr_output_text(output, "</faces>\n</mesh>\n");
}

static void add_materials(FrOpf *opf, const FrOpfPlant *own) {
    static const char *const words[] = {"ambient", "diffuse", "specular"};
    FrOutput *output = &opf->output;
    for (uint32_t m = 0; m <= own->topology.plant->materials->len; m++) {
        fr_output_text(output, "<material Id=\"");
        fr_output_integer(output, own->first_material + m);
        fr_output_text(output, "\"><emission>0.0 0.0 0.0 0.0</emission>");
        for (size_t w = 0; w < G_N_ELEMENTS(words); w++) {
            double part = w == 2 ? 0.05 : 1; // leaves and bark hardly shine
            fr_output_text(output, "<");
            fr_output_text(output, words[w]);
            fr_output_text(output, ">");
            for (int k = 0; k < 3; k++) {
                add_float(output, part * (double)own->colours[m].raw[k]);
            }
            fr_output_text(output, "1.0</");
            fr_output_text(output, words[w]);
            fr_output_text(output, ">");
        }
        fr_output_text(output, "<shininess>10.0</shininess></material>\n");
    }
}

static void add_shape(FrOutput *output, uint32_t id, const char *name, uint32_t mesh,
                      uint32_t material) {
    fr_output_text(output, "<shape Id=\"");
    fr_output_integer(output, id);
    fr_output_text(output, "\"><name>");
    fr_output_text(output, name);
    fr_output_text(output, "</name><meshIndex>");
    fr_output_integer(output, mesh);
    fr_output_text(output, "</meshIndex><materialIndex>");
    fr_output_integer(output, material);
    fr_output_text(output, "</materialIndex></shape>\n");
}

typedef void (*FrOpfTable)(FrOpf *opf, const FrOpfPlant *own);

static void add_meshes(FrOpf *opf, const FrOpfPlant *own) {
    for (guint g = 0; g < own->groups->len; g++) {
        char *name = g_markup_escape_text(g_array_index(own->groups, FrOrganGroup, g).word, -1);
        add_mesh(&opf->output, name, own->first_mesh + g, own->meshes[g]);
        g_free(name);
    }
}

static void add_barks(FrOpf *opf, const FrOpfPlant *own) {
    for (uint32_t m = 0; m <= own->topology.plant->materials->len; m++) {
        add_shape(&opf->output, own->first_material + m, "internode", 0, own->first_material + m);
    }
}

static void add_groups(FrOpf *opf, const FrOpfPlant *own) {
    for (guint g = 0; g < own->groups->len; g++) {
        const FrOrganGroup *group = &g_array_index(own->groups, FrOrganGroup, g);
        uint32_t material = MIN(group->material, own->topology.plant->materials->len);
        char *name = g_markup_escape_text(group->word, -1);
        add_shape(&opf->output, own->first_group + g, name, own->first_mesh + g,
                  own->first_material + material);
        g_free(name);
    }
}

static void for_plants(FrOpf *opf, FrOpfTable add) {
    for (guint p = 0; p < opf->scene->plants->len; p++) {
        if (opf->plants[p].groups != NULL) {
            add(opf, &opf->plants[p]);
        }
    }
}

void fr_opf_add_references(FrOpf *opf) {
    FrOutput *output = &opf->output;
    fr_output_text(output, "<meshBDD>\n");
    add_cylinder(output);
    for_plants(opf, add_meshes);
    fr_output_text(output, "</meshBDD>\n<materialBDD>\n");
    for_plants(opf, add_materials);
    fr_output_text(output, "</materialBDD>\n<shapeBDD>\n");
    for_plants(opf, add_barks);
    for_plants(opf, add_groups);
    fr_output_text(output, "</shapeBDD>\n<attributeBDD>\n"
                           "<attribute name=\"Name\" class=\"String\"/>\n"
                           "<attribute name=\"Length\" class=\"Metre\"/>\n"
                           "<attribute name=\"Diameter\" class=\"Metre\"/>\n"
                           "</attributeBDD>\n");
}
