// MTG, the multiscale tree graph of plant science: tab-separated text of plants, axes and
// internodes, z up, metres.
// After: Godin, Caraglio. A Multiscale Model of Plant Topological Structures. Journal of
// Theoretical Biology 191, 1998. The file format is that of AMAPmod and OpenAlea.
//
// The column of an entity says what it hangs on: `^<` goes on from the last entity of its own
// column, `+` branches off the last one of the column before. So an internode is written, then what
// it bears, one column on, then the next internode of its axis.
#include "io/formats.h"
#include "io/meshes.h"
#include "io/output.h"
#include "io/topology.h"

/// Columns of the deepest plant that is written: every line is as wide.
enum { MAX_COLUMNS = 250 };

typedef struct FrMtg {
    const FrScene *scene;
    const FrContext *context;
    FrTopology *plants; ///< by plant of the scene; those that stand nowhere are empty
    uint32_t columns;   ///< that entities take
    uint64_t bytes, entities;
} FrMtg;

/// The plant that is being written, and the numbers of its entities so far.
typedef struct FrMtgPlant {
    const FrMtg *mtg;
    const FrTopology *topology;
    const FrStand *stand;
    FrPose pose; ///< of the stand
    FrOutput *output;
    uint32_t axes, nodes, organs;
} FrMtgPlant;

/// Column 0 has the plant, 1 its stems, and organs stand one column behind their internode.
static uint32_t count_columns(const FrTopology *topology) {
    const FrPlant *plant = topology->plant;
    uint32_t *column = g_new(uint32_t, MAX(plant->axes.count, 1));
    uint32_t most = 1;
    for (uint32_t axis = 0; axis < plant->axes.count; axis++) {
        uint32_t bearer = plant->axes.bearer[axis];
        uint32_t below = bearer != FR_NONE ? column[plant->nodes.axis[bearer]] : 0;
        bool goes_on = bearer != FR_NONE && plant->axes.first[axis] != FR_NONE &&
                       fr_topology_next(topology, bearer) == plant->axes.first[axis];
        column[axis] = goes_on ? below : below + 1;
        most = MAX(most, column[axis]);
    }
    g_free(column);
    return most + 2;
}

// ---- lines ------------------------------------------------------------------------------------

static const char header[] =
    "CODE:\tFORM-A\n\n"
    "CLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n"
    "$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tFREE\tFREE\tEXPLICIT\nA\t2\t<-LINEAR\tFREE\tEXPLICIT\n"
    "I\t3\tFREE\tFREE\tEXPLICIT\nL\t3\tFREE\tFREE\tEXPLICIT\nO\t3\tFREE\tFREE\tEXPLICIT\n\n"
    "DESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\nA\tA\t+\t?\nI\tI\t<\t1\nI\tI,L,O\t+\t?\n\n"
    "FEATURES:\nNAME\tTYPE\nName\tALPHA\nLength\tREAL\nRadius\tREAL\nXX\tREAL\nYY\tREAL\n"
    "ZZ\tREAL\n\n"
    "MTG:\n";

static void add_tabs(FrOutput *output, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        fr_output_text(output, "\t");
    }
}

static void add_title(FrOutput *output, uint32_t columns) {
    fr_output_text(output, header);
    fr_output_text(output, "ENTITY-CODE");
    add_tabs(output, columns);
    fr_output_text(output, "Name\tLength\tRadius\tXX\tYY\tZZ\n");
}

/// A name as one word, for columns end at blanks.
static void add_word(FrOutput *output, const char *name) {
    for (const char *at = name; *at != '\0'; at++) {
        char letter[2] = {*at, '\0'};
        fr_output_text(output, g_ascii_isalnum(*at) || *at == '-' ? letter : "_");
    }
}

static void add_component(FrOutput *output, const FrPlant *plant, uint32_t component) {
    if (component != FR_NONE) {
        add_word(output, g_array_index(plant->components, FrComponent, component).id);
    }
}

/// What follows the name: length, radius (none below 0), and a place in the world.
static void add_features(FrOutput *output, double length, double radius, const FrPose *pose,
                         vec3s at) {
    FrVertex vertex = {.position = {at.x, at.y, at.z}};
    vertex = fr_io_posed(pose, &vertex);
    fr_output_text(output, "\t");
    fr_output_fixed(output, length, 6);
    fr_output_text(output, "\t");
    if (radius >= 0) {
        fr_output_fixed(output, radius, 6);
    }
    for (int k = 0; k < 3; k++) {
        fr_output_text(output, "\t");
        fr_output_fixed(output, (double)vertex.position[k], 6);
    }
    fr_output_text(output, "\n");
}

static void add_organ(FrMtgPlant *own, uint32_t organ, uint32_t column) {
    const FrPlant *plant = own->topology->plant;
    const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]);
    bool is_leaf = shape->kind == FR_SHAPE_BLADE;
    vec3s at;
    versors rotation;
    fr_plant_organ_pose(plant, organ, &at, &rotation);
    double size = is_leaf ? (double)(shape->blade.petiole_length + shape->blade.length)
                          : (double)shape->size.z;
    double scale = (double)plant->organs.scale[organ] * own->stand->scale;
    add_tabs(own->output, column);
    fr_output_text(own->output, is_leaf ? "+L" : "+O");
    fr_output_integer(own->output, ++own->organs);
    add_tabs(own->output, own->mtg->columns - column);
    add_component(own->output, plant, plant->organs.component[organ]);
    add_features(own->output, size * scale, -1, &own->pose, at);
}

static bool add_node(void *user, const FrTopologyStep *step) {
    FrMtgPlant *own = user;
    const FrPlant *plant = own->topology->plant;
    uint32_t node = step->node, column = step->order + 1;
    add_tabs(own->output, column);
    if (step->axis == FR_NONE) {
        fr_output_text(own->output, "^<I");
    } else {
        fr_output_text(own->output, step->order == 0 ? "/A" : "+A");
        fr_output_integer(own->output, ++own->axes);
        fr_output_text(own->output, "/I");
    }
    fr_output_integer(own->output, ++own->nodes);
    add_tabs(own->output, own->mtg->columns - column);
    add_component(own->output, plant, plant->axes.component[plant->nodes.axis[node]]);
    add_features(own->output, fr_topology_length(own->topology, step) * own->stand->scale,
                 (double)plant->nodes.radius[node] * own->stand->scale, &own->pose,
                 plant->nodes.position[node]);
    uint32_t organ = own->topology->first_organ[node];
    for (; organ != FR_NONE; organ = own->topology->next_organ[organ]) {
        add_organ(own, organ, column + 1);
    }
    return own->output->error == 0;
}

/// Organs that stand on the ground hang on an internode without length.
static void add_loose(FrMtgPlant *own) {
    if (own->topology->first_loose == FR_NONE) {
        return;
    }
    fr_output_text(own->output, "\t/A");
    fr_output_integer(own->output, ++own->axes);
    fr_output_text(own->output, "/I");
    fr_output_integer(own->output, ++own->nodes);
    add_tabs(own->output, own->mtg->columns - 1);
    add_features(own->output, 0, 0, &own->pose, (vec3s){{0, 0, 0}});
    uint32_t organ = own->topology->first_loose;
    for (; organ != FR_NONE; organ = own->topology->next_organ[organ]) {
        add_organ(own, organ, 2);
    }
}

static void add_stand(FrMtg *mtg, FrOutput *output, guint number) {
    const FrStand *stand = fr_io_stand(mtg->scene, number);
    const FrTopology *topology = &mtg->plants[stand->plant];
    FrMtgPlant own = {.mtg = mtg,
                      .topology = topology,
                      .stand = stand,
                      .pose = fr_io_pose(stand, FR_UP_Z),
                      .output = output};
    fr_output_text(output, "/P");
    fr_output_integer(output, number + 1);
    add_tabs(output, mtg->columns);
    add_word(output, topology->plant->name);
    add_tabs(output, 2);
    for (int k = 0; k < 3; k++) {
        fr_output_text(output, "\t");
        fr_output_fixed(output, stand->at[k], 6);
    }
    fr_output_text(output, "\n");
    add_loose(&own);
    uint32_t stem = topology->first_stem;
    for (; stem != FR_NONE; stem = topology->next_axis[stem]) {
        fr_topology_walk(topology, stem, add_node, NULL, &own);
    }
    mtg->entities += 1 + (uint64_t)own.axes + own.nodes + own.organs;
}

static bool write_mtg(void *user, int descriptor) {
    FrMtg *mtg = user;
    guint stands = fr_scene_stand_count(mtg->scene);
    FrOutput output;
    fr_output_start(&output, descriptor, mtg->context->progress);
    add_title(&output, mtg->columns);
    for (guint s = 0; s < stands && output.error == 0; s++) {
        add_stand(mtg, &output, s);
        fr_progress_report(mtg->context->progress, "write", (s + 1.0) / stands);
    }
    bool is_whole = fr_output_finish(&output);
    mtg->bytes = output.done;
    return is_whole;
}

static FrStatus make_topologies(FrMtg *mtg) {
    for (guint s = 0; s < fr_scene_stand_count(mtg->scene); s++) {
        uint32_t plant = fr_io_stand(mtg->scene, s)->plant;
        FrTopology *topology = &mtg->plants[plant];
        if (topology->plant == NULL) {
            fr_topology_init(topology, fr_io_plant(mtg->scene, plant));
        }
        mtg->columns = MAX(mtg->columns, count_columns(topology));
    }
    return fr_limit_check(mtg->columns, MAX_COLUMNS, "columns",
                          "an .mtg file: branches on branches, one a column", (FrSpan){0},
                          mtg->context->diags);
}

FrStatus fr_mtg_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats) {
    (void)options;
    FrMtg mtg = {.scene = scene, .context = context, .columns = 1};
    gint64 start = g_get_monotonic_time();
    mtg.plants = g_new0(FrTopology, MAX(scene->plants->len, 1));
    FrStatus status = make_topologies(&mtg);
    if (status == FR_OK) {
        status = fr_io_replace_file(path, write_mtg, &mtg, context->diags);
    }
    stats->entities = mtg.entities;
    stats->bytes = mtg.bytes;
    stats->write_seconds = (double)(g_get_monotonic_time() - start) * 1e-6;
    for (guint p = 0; p < scene->plants->len; p++) {
        fr_topology_clear(&mtg.plants[p]);
    }
    g_free(mtg.plants);
    return status;
}
