// OPF 2.0, the Open Plant Format of AMAP: XML of reference meshes, materials and the topology, in
// which each internode and organ places a mesh by a matrix. Centimetres, z up. AMAP's programs,
// ARCHIMED and PlantGeom read it.
//
// `decomp` is what an entity is made of, `follow` what goes on from it, `branch` what it bears. An
// internode is a cylinder of diameter 1 along x, scaled to its length and tapered between the
// diameters at its base (`dDwn`) and tip (`dUp`). One that is bent has no mesh of its own: it is
// made of straight segments, one scale finer, each with such a cylinder.
#include "io/opf.h"
#include "io/formats.h"

#include <cglm/struct.h>

static const double cm = 100; ///< in a metre

// ---- places -----------------------------------------------------------------------------------

/// A point of a plant or, moved by the stand but not to its place, a direction.
static vec3s placed(const FrOpf *opf, vec3s at, bool is_direction) {
    FrVertex vertex = {.position = {at.x, at.y, at.z}, .normal = {at.x, at.y, at.z}};
    vertex = fr_io_posed(&opf->pose, &vertex);
    const float *result = is_direction ? vertex.normal : vertex.position;
    return (vec3s){{result[0], result[1], result[2]}};
}

/// Three columns, how long they are, and a place, metres; the diameters are factors of y and z.
static void add_geometry(FrOpf *opf, uint32_t shape, const vec3s columns[3], const double sizes[3],
                         vec3s at, double base, double tip) {
    FrOutput *output = &opf->output;
    vec3s place = placed(opf, at, false);
    vec3s turned[3];
    for (int k = 0; k < 3; k++) {
        turned[k] = placed(opf, columns[k], true);
    }
    fr_output_text(output, "<geometry class=\"Mesh\"><shapeIndex>");
    fr_output_integer(output, shape);
    fr_output_text(output, "</shapeIndex><mat>");
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < 3; k++) {
            fr_output_fixed(output, (double)turned[k].raw[row] * sizes[k], 6);
            fr_output_text(output, " ");
        }
        fr_output_fixed(output, (double)place.raw[row] * cm, 4);
        fr_output_text(output, row < 2 ? "\n" : "</mat><dUp>");
    }
    fr_output_fixed(output, tip, 6);
    fr_output_text(output, "</dUp><dDwn>");
    fr_output_fixed(output, base, 6);
    fr_output_text(output, "</dDwn></geometry>");
}

static void columns_of(versors rotation, vec3s columns[3]) {
    const vec3s unit[3] = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
    for (int k = 0; k < 3; k++) {
        columns[k] = glms_quat_rotatev(rotation, unit[k]);
    }
}

// ---- topology ---------------------------------------------------------------------------------

static void open_entity(FrOpf *opf, const char *relation, const char *class_name, int scale) {
    fr_output_text(&opf->output, "<");
    fr_output_text(&opf->output, relation);
    fr_output_text(&opf->output, " class=\"");
    fr_output_text(&opf->output, class_name);
    fr_output_text(&opf->output, "\" scale=\"");
    fr_output_integer(&opf->output, (uint64_t)scale);
    fr_output_text(&opf->output, "\" id=\"");
    fr_output_integer(&opf->output, ++opf->id);
    fr_output_text(&opf->output, "\">");
}

static void close_entity(FrOpf *opf, const char *relation) {
    fr_output_text(&opf->output, "</");
    fr_output_text(&opf->output, relation);
    fr_output_text(&opf->output, ">\n");
}

static void add_name(FrOpf *opf, const char *name) {
    char *escaped = g_markup_escape_text(name, -1);
    fr_output_text(&opf->output, "<Name>");
    fr_output_text(&opf->output, escaped);
    fr_output_text(&opf->output, "</Name>");
    g_free(escaped);
}

static void add_component(FrOpf *opf, uint32_t component) {
    if (component != FR_NONE) {
        const FrPlant *plant = opf->plant->topology.plant;
        add_name(opf, g_array_index(plant->components, FrComponent, component).id);
    }
}

static void add_number(FrOpf *opf, const char *name, double value) {
    fr_output_text(&opf->output, "<");
    fr_output_text(&opf->output, name);
    fr_output_text(&opf->output, ">");
    fr_output_fixed(&opf->output, value, 6);
    fr_output_text(&opf->output, "</");
    fr_output_text(&opf->output, name);
    fr_output_text(&opf->output, ">");
}

static void add_organ(FrOpf *opf, uint32_t organ) {
    const FrPlant *plant = opf->plant->topology.plant;
    const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]);
    uint32_t group = opf->plant->group[organ];
    open_entity(opf, "branch", shape->kind == FR_SHAPE_BLADE ? "Leaf" : "Organ", 3);
    add_component(opf, plant->organs.component[organ]);
    if (group != FR_NONE) {
        double at[3], q[4], scale;
        const FrOrganGroup *own = &g_array_index(opf->plant->groups, FrOrganGroup, group);
        fr_organ_group_pose(plant, own, organ, at, q, &scale);
        double size = scale * opf->stand->scale * cm;
        vec3s columns[3];
        columns_of((versors){{(float)q[0], (float)q[1], (float)q[2], (float)q[3]}}, columns);
        add_geometry(opf, opf->plant->first_group + group, columns, (double[3]){size, size, size},
                     (vec3s){{(float)at[0], (float)at[1], (float)at[2]}}, 1, 1);
    }
    close_entity(opf, "branch");
}

static void add_organs(FrOpf *opf, uint32_t first) {
    for (uint32_t organ = first; organ != FR_NONE; organ = opf->plant->topology.next_organ[organ]) {
        add_organ(opf, organ);
    }
}

/// The cylinder of an internode, or of a straight part of one.
static void add_cylinder(FrOpf *opf, uint32_t node) {
    const FrPlant *plant = opf->plant->topology.plant;
    uint32_t axis = plant->nodes.axis[node], parent = plant->nodes.parent[node];
    bool is_first = plant->axes.first[axis] == node;
    float base = is_first ? plant->axes.base_radius[axis] : plant->nodes.radius[parent];
    double scale = opf->stand->scale, length = (double)plant->nodes.length[node] * scale;
    vec3s own[3];
    columns_of(plant->nodes.frame[node], own);
    vec3s from = glms_vec3_sub(plant->nodes.position[node],
                               glms_vec3_scale(own[2], plant->nodes.length[node]));
    uint32_t material = plant->axes.material[axis];
    uint32_t bark = MIN(material, plant->materials->len); // the last one is the default
    add_geometry(opf, opf->plant->first_material + bark, (vec3s[3]){own[2], own[0], own[1]},
                 (double[3]){length * cm, 1, 1}, from, 2 * (double)base * scale * cm,
                 2 * (double)plant->nodes.radius[node] * scale * cm);
}

/// A bent internode is made of segments.
static void add_internode(FrOpf *opf, const FrTopologyStep *step) {
    const FrPlant *plant = opf->plant->topology.plant;
    double scale = opf->stand->scale;
    add_component(opf, plant->axes.component[plant->nodes.axis[step->node]]);
    add_number(opf, "Length", fr_topology_length(&opf->plant->topology, step) * scale);
    add_number(opf, "Diameter", 2 * (double)plant->nodes.radius[step->node] * scale);
    if (step->first == step->node) {
        add_cylinder(opf, step->node);
        return;
    }
    for (uint32_t part = step->first;; part = plant->nodes.next[part]) {
        open_entity(opf, "decomp", "Segment", 4);
        add_cylinder(opf, part);
        close_entity(opf, "decomp");
        if (part == step->node) {
            return;
        }
    }
}

static bool enter(void *user, const FrTopologyStep *step) {
    FrOpf *opf = user;
    if (step->axis != FR_NONE) {
        open_entity(opf, step->order == 0 ? "decomp" : "branch", "Axis", 2);
    }
    open_entity(opf, step->axis != FR_NONE ? "decomp" : "follow", "Internode", 3);
    add_internode(opf, step);
    fr_output_text(&opf->output, "\n");
    add_organs(opf, opf->plant->topology.first_organ[step->node]);
    return opf->output.error == 0;
}

static void leave(void *user, const FrTopologyStep *step) {
    FrOpf *opf = user;
    close_entity(opf, step->axis != FR_NONE ? "decomp" : "follow");
    if (step->axis != FR_NONE) {
        close_entity(opf, step->order == 0 ? "decomp" : "branch");
    }
}

/// Organs that stand on the ground hang on an internode without length.
static void add_loose(FrOpf *opf) {
    if (opf->plant->topology.first_loose != FR_NONE) {
        open_entity(opf, "decomp", "Axis", 2);
        open_entity(opf, "decomp", "Internode", 3);
        fr_output_text(&opf->output, "\n");
        add_organs(opf, opf->plant->topology.first_loose);
        close_entity(opf, "decomp");
        close_entity(opf, "decomp");
    }
}

static void add_stand(FrOpf *opf, guint number) {
    opf->stand = fr_io_stand(opf->scene, number);
    opf->pose = fr_io_pose(opf->stand, FR_UP_Z);
    opf->plant = &opf->plants[opf->stand->plant];
    const FrTopology *topology = &opf->plant->topology;
    open_entity(opf, "decomp", "Individual", 1);
    add_name(opf, topology->plant->name);
    fr_output_text(&opf->output, "\n");
    add_loose(opf);
    for (uint32_t stem = topology->first_stem; stem != FR_NONE && opf->output.error == 0;
         stem = topology->next_axis[stem]) {
        fr_topology_walk(topology, stem, enter, leave, opf);
    }
    close_entity(opf, "decomp");
}

static bool write_opf(void *user, int descriptor) {
    FrOpf *opf = user;
    guint stands = fr_scene_stand_count(opf->scene);
    fr_output_start(&opf->output, descriptor, opf->context->progress);
    fr_output_text(&opf->output, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                                 "<opf version=\"2.0\" editable=\"true\">\n");
    fr_opf_add_references(opf);
    fr_output_text(&opf->output, "<topology class=\"Scene\" scale=\"0\" id=\"1\">\n");
    opf->id = 1;
    for (guint s = 0; s < stands && opf->output.error == 0; s++) {
        add_stand(opf, s);
        fr_progress_report(opf->context->progress, "write", (s + 1.0) / stands);
    }
    fr_output_text(&opf->output, "</topology>\n</opf>\n");
    bool is_whole = fr_output_finish(&opf->output);
    opf->bytes = opf->output.done;
    return is_whole;
}

FrStatus fr_opf_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats) {
    FrOpf opf = {.scene = scene, .context = context, .options = options};
    gint64 start = g_get_monotonic_time();
    FrStatus status = fr_opf_make_references(&opf);
    gint64 skinned = g_get_monotonic_time();
    if (status == FR_OK) {
        status = fr_io_replace_file(path, write_opf, &opf, context->diags);
    }
    stats->entities = opf.id;
    stats->bytes = opf.bytes;
    stats->skin_seconds = (double)(skinned - start) * 1e-6;
    stats->write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6;
    fr_opf_clear_references(&opf);
    return status;
}
