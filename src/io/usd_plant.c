// A plant in a USD layer: its materials, a mesh for each part, point instancers for leaves that are
// not merged, and its axes as curves, a guide that renderers leave out.
#include "io/usd.h"

static const char per_vertex[] = " (\n        interpolation = \"vertex\"\n    )";

// ---- what a plant needs -----------------------------------------------------------------------

static FrStatus make_groups(FrUsd *usd, FrUsdPlant *own, const FrPlant *plant) {
    FrStatus status = fr_organ_groups_new(plant, &usd->options->skin, usd->context, &own->groups);
    own->shapes = g_new0(FrMesh *, MAX(plant->shapes->len, 1));
    own->group_surface = g_new0(uint32_t, MAX(own->groups->len, 1));
    for (guint g = 0; g < own->groups->len && status == FR_OK; g++) {
        const FrOrganGroup *group = &g_array_index(own->groups, FrOrganGroup, g);
        FrMesh **shape = &own->shapes[group->shape];
        if (*shape == NULL) {
            status = fr_skin_shape(plant, group->shape, &usd->options->skin, FR_UP_Z, usd->context,
                                   shape);
        }
        if (status == FR_OK && (*shape)->part_count > 0) {
            own->triangles += (*shape)->index_count / 3 * group->organs->len;
            status = fr_surfaces_find(&usd->surfaces, plant, group->material,
                                      (*shape)->parts[0].is_foliage, usd->context,
                                      &own->group_surface[g]);
        }
    }
    return status;
}

FrUsdPlant *fr_usd_plant_new(FrUsd *usd, uint32_t index, FrStatus *status) {
    const FrPlant *plant = fr_io_plant(usd->scene, index);
    const FrMesh *mesh = usd->meshes.meshes[index];
    FrUsdPlant *own = g_new0(FrUsdPlant, 1);
    own->triangles = mesh->index_count / 3;
    own->part_surface = g_new0(uint32_t, MAX(mesh->part_count, 1));
    *status = FR_OK;
    for (uint32_t p = 0; p < mesh->part_count && *status == FR_OK; p++) {
        *status = fr_surfaces_find(&usd->surfaces, plant, mesh->parts[p].material,
                                   mesh->parts[p].is_foliage, usd->context, &own->part_surface[p]);
    }
    if (*status == FR_OK && usd->options->leaves != FR_LEAVES_MERGED &&
        usd->options->skin.foliage) {
        *status = make_groups(usd, own, plant);
    }
    return own;
}

void fr_usd_plant_free(FrUsdPlant *own, const FrPlant *plant) {
    if (own == NULL) {
        return;
    }
    for (guint s = 0; own->shapes != NULL && s < plant->shapes->len; s++) {
        fr_mesh_free(own->shapes[s]);
    }
    if (own->groups != NULL) {
        g_array_unref(own->groups);
    }
    g_free(own->shapes);
    g_free(own->part_surface);
    g_free(own->group_surface);
    g_free(own);
}

// ---- meshes -----------------------------------------------------------------------------------

static void add_vertices(FrUsd *usd, const FrVertex *vertices, uint64_t count) {
    fr_usd_begin_list(usd, "point3f[] points");
    for (uint64_t v = 0; v < count; v++) {
        fr_usd_tuple(usd, vertices[v].position, 3, 6, v == 0);
    }
    fr_usd_end_list(usd, NULL);
    fr_usd_begin_list(usd, "normal3f[] normals");
    for (uint64_t v = 0; v < count; v++) {
        fr_usd_tuple(usd, vertices[v].normal, 3, 4, v == 0);
    }
    fr_usd_end_list(usd, per_vertex);
    fr_usd_begin_list(usd, "texCoord2f[] primvars:st");
    for (uint64_t v = 0; v < count; v++) {
        float st[2] = {vertices[v].uv[0], 1.0F - vertices[v].uv[1]}; // rows count from the bottom
        fr_usd_tuple(usd, st, 2, 5, v == 0);
    }
    fr_usd_end_list(usd, per_vertex);
}

static void add_faces(FrUsd *usd, const uint32_t *indices, uint64_t count) {
    fr_usd_begin_list(usd, "int[] faceVertexCounts");
    for (uint64_t i = 0; i + 2 < count; i += 3) {
        fr_output_text(&usd->output, i == 0 ? "3" : ", 3");
    }
    fr_usd_end_list(usd, NULL);
    fr_usd_begin_list(usd, "int[] faceVertexIndices");
    for (uint64_t i = 0; i < count; i++) {
        fr_output_text(&usd->output, i == 0 ? "" : ", ");
        fr_output_integer(&usd->output, indices[i]);
    }
    fr_usd_end_list(usd, NULL);
}

static void add_mesh(FrUsd *usd, const char *path, const char *name, const FrMesh *mesh,
                     const FrMeshPart *part, uint32_t surface) {
    char *material = fr_usd_material_name(usd, surface);
    fr_usd_line(usd, "def Mesh \"%s\" (", name);
    fr_usd_line(usd, "    prepend apiSchemas = [\"MaterialBindingAPI\"]");
    fr_usd_open(usd, ")");
    fr_usd_begin_list(usd, "float3[] extent");
    fr_usd_tuple(usd, part->min, 3, 6, true);
    fr_usd_tuple(usd, part->max, 3, 6, false);
    fr_usd_end_list(usd, NULL);
    fr_usd_line(usd, "rel material:binding = <%s/Materials/%s>", path, material);
    fr_usd_line(usd, "uniform bool doubleSided = %d", part->is_foliage);
    fr_usd_line(usd, "uniform token subdivisionScheme = \"none\"");
    add_vertices(usd, mesh->vertices + part->first_vertex, part->vertex_count);
    add_faces(usd, mesh->indices + part->first_index, part->index_count);
    fr_usd_close(usd);
    g_free(material);
}

static void add_parts(FrUsd *usd, const char *path, const FrMesh *mesh, const FrUsdPlant *own) {
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        if (mesh->parts[p].index_count > 0) {
            const FrSurface *surface = fr_surfaces_get(&usd->surfaces, own->part_surface[p]);
            char *plain = fr_usd_name(surface->name);
            char *name = g_strdup_printf("%s_%u", plain, p + 1);
            add_mesh(usd, path, name, mesh, &mesh->parts[p], own->part_surface[p]);
            g_free(plain);
            g_free(name);
        }
    }
}

// ---- leaves -----------------------------------------------------------------------------------

typedef enum FrUsdPose { FR_USD_POSITION, FR_USD_ORIENTATION, FR_USD_SCALE } FrUsdPose;

static void add_poses(FrUsd *usd, const FrPlant *plant, const FrOrganGroup *group, const char *what,
                      FrUsdPose kind) {
    fr_usd_begin_list(usd, what);
    for (guint i = 0; i < group->organs->len; i++) {
        double at[3], q[4], scale;
        fr_organ_group_pose(plant, group, g_array_index(group->organs, uint32_t, i), at, q, &scale);
        float size = (float)scale;
        float values[3][4] = {
            {(float)at[0], (float)at[1], (float)at[2]},
            {(float)q[3], (float)q[0], (float)q[1], (float)q[2]}, // the real part first
            {size, size, size},
        };
        fr_usd_tuple(usd, values[kind], kind == FR_USD_ORIENTATION ? 4 : 3, 6, i == 0);
    }
    fr_usd_end_list(usd, NULL);
}

static void add_instancer(FrUsd *usd, const char *path, const FrPlant *plant,
                          const FrOrganGroup *group, const char *name, const FrMesh *shape,
                          uint32_t surface) {
    fr_usd_open(usd, "def PointInstancer \"%s\"", name);
    fr_usd_line(usd, "rel prototypes = <%s/%s/Prototypes/shape>", path, name);
    fr_usd_begin_list(usd, "int[] protoIndices");
    for (guint i = 0; i < group->organs->len; i++) {
        fr_output_text(&usd->output, i == 0 ? "0" : ", 0");
    }
    fr_usd_end_list(usd, NULL);
    add_poses(usd, plant, group, "point3f[] positions", FR_USD_POSITION);
    add_poses(usd, plant, group, "quath[] orientations", FR_USD_ORIENTATION);
    add_poses(usd, plant, group, "float3[] scales", FR_USD_SCALE);
    fr_usd_open(usd, "def Scope \"Prototypes\"");
    add_mesh(usd, path, "shape", shape, &shape->parts[0], surface);
    fr_usd_close(usd);
    fr_usd_close(usd);
}

static void add_groups(FrUsd *usd, const char *path, const FrPlant *plant, const FrUsdPlant *own) {
    for (guint g = 0; own->groups != NULL && g < own->groups->len; g++) {
        const FrOrganGroup *group = &g_array_index(own->groups, FrOrganGroup, g);
        const FrMesh *shape = own->shapes[group->shape];
        if (shape->part_count > 0) {
            char *word = fr_usd_name(group->word);
            char *name = g_strdup_printf("%s_instances_%u", word, g + 1);
            add_instancer(usd, path, plant, group, name, shape, own->group_surface[g]);
            g_free(word);
            g_free(name);
        }
    }
}

// ---- axes -------------------------------------------------------------------------------------

static bool has_curve(const FrPlant *plant, uint32_t axis) {
    return plant->axes.first[axis] != FR_NONE && (plant->axes.flags[axis] & FR_SHED) == 0;
}

static void add_curve_counts(FrUsd *usd, const FrPlant *plant) {
    const char *comma = "";
    fr_usd_begin_list(usd, "int[] curveVertexCounts");
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (has_curve(plant, a)) {
            uint32_t count = 1;
            for (uint32_t i = plant->axes.first[a]; i != FR_NONE; i = plant->nodes.next[i]) {
                count++;
            }
            fr_output_text(&usd->output, comma);
            fr_output_integer(&usd->output, count);
            comma = ", ";
        }
    }
    fr_usd_end_list(usd, NULL);
}

static void add_curve_points(FrUsd *usd, const FrPlant *plant) {
    bool is_first = true;
    fr_usd_begin_list(usd, "point3f[] points");
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (has_curve(plant, a)) {
            fr_usd_tuple(usd, fr_plant_axis_origin(plant, a).raw, 3, 6, is_first);
            is_first = false;
            for (uint32_t i = plant->axes.first[a]; i != FR_NONE; i = plant->nodes.next[i]) {
                fr_usd_tuple(usd, plant->nodes.position[i].raw, 3, 6, false);
            }
        }
    }
    fr_usd_end_list(usd, NULL);
}

static void add_curve_widths(FrUsd *usd, const FrPlant *plant) {
    const char *comma = "";
    fr_usd_begin_list(usd, "float[] widths");
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (has_curve(plant, a)) {
            fr_output_text(&usd->output, comma);
            comma = ", ";
            fr_output_fixed(&usd->output, 2 * (double)plant->axes.base_radius[a], 6);
            for (uint32_t i = plant->axes.first[a]; i != FR_NONE; i = plant->nodes.next[i]) {
                fr_output_text(&usd->output, ", ");
                fr_output_fixed(&usd->output, 2 * (double)plant->nodes.radius[i], 6);
            }
        }
    }
    fr_usd_end_list(usd, per_vertex);
}

static void add_skeleton(FrUsd *usd, const FrPlant *plant) {
    fr_usd_open(usd, "def BasisCurves \"skeleton\"");
    fr_usd_line(usd, "uniform token type = \"linear\"");
    fr_usd_line(usd, "uniform token purpose = \"guide\"");
    add_curve_counts(usd, plant);
    add_curve_points(usd, plant);
    add_curve_widths(usd, plant);
    fr_usd_close(usd);
}

// ---- all --------------------------------------------------------------------------------------

static void add_materials(FrUsd *usd, const char *path, const FrMesh *mesh, const FrUsdPlant *own) {
    bool *used = g_new0(bool, MAX(usd->surfaces.surfaces->len, 1));
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        used[own->part_surface[p]] |= mesh->parts[p].index_count > 0;
    }
    for (guint g = 0; own->groups != NULL && g < own->groups->len; g++) {
        const FrOrganGroup *group = &g_array_index(own->groups, FrOrganGroup, g);
        used[own->group_surface[g]] |= own->shapes[group->shape]->part_count > 0;
    }
    fr_usd_materials(usd, path, used);
    g_free(used);
}

void fr_usd_plant(FrUsd *usd, uint32_t index, const char *path) {
    const FrPlant *plant = fr_io_plant(usd->scene, index);
    const FrMesh *mesh = usd->meshes.meshes[index];
    const FrUsdPlant *own = g_ptr_array_index(usd->plants, index);
    add_materials(usd, path, mesh, own);
    add_parts(usd, path, mesh, own);
    add_groups(usd, path, plant, own);
    if (plant->nodes.count > 0) {
        add_skeleton(usd, plant);
    }
}
