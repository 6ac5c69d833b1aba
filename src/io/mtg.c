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

/// Columns of the deepest plant that is written: every line is as wide.
enum { MAX_COLUMNS = 250 };

/// What hangs on what, in lists; FR_NONE ends each.
typedef struct FrMtgTree {
    const FrPlant *plant;
    uint32_t *first_axis;  ///< by node: the first axis it bears
    uint32_t *next_axis;   ///< by axis: the next with the same bearer
    uint32_t *first_organ; ///< by node
    uint32_t *next_organ;  ///< by organ
    uint32_t first_stem;   ///< axes without a bearer, in a list as well
    uint32_t first_loose;  ///< organs without a node
    uint32_t columns;      ///< that the plant's entities take
} FrMtgTree;

typedef struct FrMtg {
    const FrScene *scene;
    const FrContext *context;
    FrMtgTree *trees; ///< by plant of the scene; those that stand nowhere are empty
    uint32_t columns; ///< of the whole file
    uint64_t bytes, entities;
} FrMtg;

/// An internode or the begin of an axis that is still to be written.
typedef struct FrMtgTask {
    uint32_t node;
    uint32_t column;
    uint32_t axis; ///< that begins with the internode; FR_NONE: it goes on with the one before
} FrMtgTask;

// ---- what hangs on what -----------------------------------------------------------------------

static bool is_shed_axis(const FrPlant *plant, uint32_t axis) {
    return plant->axes.first[axis] == FR_NONE || (plant->axes.flags[axis] & FR_SHED) != 0 ||
           (plant->nodes.flags[plant->axes.first[axis]] & FR_SHED) != 0;
}

/// The internode that goes on from one: the next of its axis, or the first of an axis that
/// continues it.
static uint32_t next_node(const FrMtgTree *tree, uint32_t node) {
    const FrPlant *plant = tree->plant;
    uint32_t next = plant->nodes.next[node];
    if (next != FR_NONE) {
        return (plant->nodes.flags[next] & FR_SHED) == 0 ? next : FR_NONE;
    }
    for (uint32_t axis = tree->first_axis[node]; axis != FR_NONE; axis = tree->next_axis[axis]) {
        if ((plant->axes.flags[axis] & FR_CONTINUES) != 0) {
            return plant->axes.first[axis];
        }
    }
    return FR_NONE;
}

static void link_axes(FrMtgTree *tree) {
    const FrAxes *axes = &tree->plant->axes;
    for (uint32_t axis = axes->count; axis-- > 0;) {
        if (!is_shed_axis(tree->plant, axis)) {
            uint32_t bearer = axes->bearer[axis];
            uint32_t *head = bearer != FR_NONE ? &tree->first_axis[bearer] : &tree->first_stem;
            tree->next_axis[axis] = *head;
            *head = axis;
        }
    }
}

static void link_organs(FrMtgTree *tree) {
    const FrOrgans *organs = &tree->plant->organs;
    for (uint32_t organ = organs->count; organ-- > 0;) {
        if ((organs->flags[organ] & FR_SHED) == 0) {
            uint32_t node = organs->node[organ];
            uint32_t *head = node != FR_NONE ? &tree->first_organ[node] : &tree->first_loose;
            tree->next_organ[organ] = *head;
            *head = organ;
        }
    }
}

/// Column 0 has the plant, 1 its stems, and organs stand one column behind their internode.
static uint32_t count_columns(const FrMtgTree *tree) {
    const FrPlant *plant = tree->plant;
    uint32_t *column = g_new(uint32_t, MAX(plant->axes.count, 1));
    uint32_t most = 1;
    for (uint32_t axis = 0; axis < plant->axes.count; axis++) {
        uint32_t bearer = plant->axes.bearer[axis];
        uint32_t below = bearer != FR_NONE ? column[plant->nodes.axis[bearer]] : 0;
        bool goes_on = bearer != FR_NONE && plant->axes.first[axis] != FR_NONE &&
                       next_node(tree, bearer) == plant->axes.first[axis];
        column[axis] = goes_on ? below : below + 1;
        most = MAX(most, column[axis]);
    }
    g_free(column);
    return most + 2;
}

static uint32_t *filled(uint32_t count) {
    uint32_t *column = g_new(uint32_t, MAX(count, 1));
    for (uint32_t i = 0; i < count; i++) {
        column[i] = FR_NONE;
    }
    return column;
}

static void tree_init(FrMtgTree *tree, const FrPlant *plant) {
    *tree = (FrMtgTree){
        .plant = plant,
        .first_axis = filled(plant->nodes.count),
        .next_axis = filled(plant->axes.count),
        .first_organ = filled(plant->nodes.count),
        .next_organ = filled(plant->organs.count),
        .first_stem = FR_NONE,
        .first_loose = FR_NONE,
    };
    link_axes(tree);
    link_organs(tree);
    tree->columns = count_columns(tree);
}

static void tree_clear(FrMtgTree *tree) {
    g_free(tree->first_axis);
    g_free(tree->next_axis);
    g_free(tree->first_organ);
    g_free(tree->next_organ);
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
static void add_features(FrOutput *output, double length, double radius, const FrStand *stand,
                         vec3s at) {
    FrPose pose = fr_io_pose(stand, FR_UP_Z);
    FrVertex vertex = {.position = {at.x, at.y, at.z}};
    vertex = fr_io_posed(&pose, &vertex);
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

static void add_organ(const FrMtg *mtg, FrOutput *output, const FrMtgTree *tree,
                      const FrStand *stand, uint32_t organ, uint32_t column, uint32_t number) {
    const FrPlant *plant = tree->plant;
    const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]);
    bool is_leaf = shape->kind == FR_SHAPE_BLADE;
    vec3s at;
    versors rotation;
    fr_plant_organ_pose(plant, organ, &at, &rotation);
    double size = is_leaf ? (double)(shape->blade.petiole_length + shape->blade.length)
                          : (double)shape->size.z;
    add_tabs(output, column);
    fr_output_text(output, is_leaf ? "+L" : "+O");
    fr_output_integer(output, number);
    add_tabs(output, mtg->columns - column);
    add_component(output, plant, plant->organs.component[organ]);
    add_features(output, size * (double)plant->organs.scale[organ] * stand->scale, -1, stand, at);
}

/// Numbers of the entities of one plant so far.
typedef struct FrMtgNumbers {
    uint32_t axes, nodes, organs;
} FrMtgNumbers;

static void add_node(const FrMtg *mtg, FrOutput *output, const FrMtgTree *tree,
                     const FrStand *stand, const FrMtgTask *task, FrMtgNumbers *numbers) {
    const FrPlant *plant = tree->plant;
    uint32_t node = task->node, axis = plant->nodes.axis[node];
    add_tabs(output, task->column);
    if (task->axis == FR_NONE) {
        fr_output_text(output, "^<I");
    } else {
        fr_output_text(output, plant->axes.bearer[task->axis] == FR_NONE ? "/A" : "+A");
        fr_output_integer(output, ++numbers->axes);
        fr_output_text(output, "/I");
    }
    fr_output_integer(output, ++numbers->nodes);
    add_tabs(output, mtg->columns - task->column);
    add_component(output, plant, plant->axes.component[axis]);
    add_features(output, (double)plant->nodes.length[node] * stand->scale,
                 (double)plant->nodes.radius[node] * stand->scale, stand,
                 plant->nodes.position[node]);
}

/// Writes an internode and its organs, and puts what goes on from it, then its branches, on top of
/// what is still to be written.
static void take_task(const FrMtg *mtg, FrOutput *output, const FrMtgTree *tree,
                      const FrStand *stand, GArray *tasks, FrMtgNumbers *numbers) {
    FrMtgTask task = g_array_index(tasks, FrMtgTask, tasks->len - 1);
    g_array_set_size(tasks, tasks->len - 1);
    add_node(mtg, output, tree, stand, &task, numbers);
    uint32_t organ = tree->first_organ[task.node];
    for (; organ != FR_NONE; organ = tree->next_organ[organ]) {
        add_organ(mtg, output, tree, stand, organ, task.column + 1, ++numbers->organs);
    }
    uint32_t next = next_node(tree, task.node);
    if (next != FR_NONE) {
        FrMtgTask on = {next, task.column, FR_NONE};
        g_array_append_val(tasks, on);
    }
    guint first = tasks->len;
    uint32_t axis = tree->first_axis[task.node];
    for (; axis != FR_NONE; axis = tree->next_axis[axis]) {
        FrMtgTask branch = {tree->plant->axes.first[axis], task.column + 1, axis};
        if (branch.node != next) {
            g_array_append_val(tasks, branch);
        }
    }
    for (guint low = first, high = tasks->len; low + 1 < high; low++, high--) {
        FrMtgTask *a = &g_array_index(tasks, FrMtgTask, low);
        FrMtgTask *b = &g_array_index(tasks, FrMtgTask, high - 1);
        FrMtgTask swap = *a;
        *a = *b;
        *b = swap;
    }
}

/// Organs that stand on the ground hang on an internode without length.
static void add_loose(const FrMtg *mtg, FrOutput *output, const FrMtgTree *tree,
                      const FrStand *stand, FrMtgNumbers *numbers) {
    if (tree->first_loose == FR_NONE) {
        return;
    }
    fr_output_text(output, "\t/A");
    fr_output_integer(output, ++numbers->axes);
    fr_output_text(output, "/I");
    fr_output_integer(output, ++numbers->nodes);
    add_tabs(output, mtg->columns - 1);
    add_features(output, 0, 0, stand, (vec3s){{0, 0, 0}});
    for (uint32_t o = tree->first_loose; o != FR_NONE; o = tree->next_organ[o]) {
        add_organ(mtg, output, tree, stand, o, 2, ++numbers->organs);
    }
}

static void add_stand(FrMtg *mtg, FrOutput *output, guint number, GArray *tasks) {
    const FrStand *stand = fr_io_stand(mtg->scene, number);
    const FrMtgTree *tree = &mtg->trees[stand->plant];
    FrMtgNumbers numbers = {0};
    fr_output_text(output, "/P");
    fr_output_integer(output, number + 1);
    add_tabs(output, mtg->columns);
    add_word(output, tree->plant->name);
    add_tabs(output, 2);
    for (int k = 0; k < 3; k++) {
        fr_output_text(output, "\t");
        fr_output_fixed(output, stand->at[k], 6);
    }
    fr_output_text(output, "\n");
    add_loose(mtg, output, tree, stand, &numbers);
    for (uint32_t stem = tree->first_stem; stem != FR_NONE; stem = tree->next_axis[stem]) {
        FrMtgTask task = {tree->plant->axes.first[stem], 1, stem};
        g_array_append_val(tasks, task);
        while (tasks->len > 0 && output->error == 0) {
            take_task(mtg, output, tree, stand, tasks, &numbers);
        }
    }
    mtg->entities += 1 + (uint64_t)numbers.axes + numbers.nodes + numbers.organs;
}

/// Obstacles stand behind the plants and are none.
static guint plants_in(const FrScene *scene) {
    return scene->stands->len - scene->obstacles;
}

static bool write_mtg(void *user, int descriptor) {
    FrMtg *mtg = user;
    guint stands = plants_in(mtg->scene);
    GArray *tasks = g_array_new(FALSE, FALSE, sizeof(FrMtgTask));
    FrOutput output;
    fr_output_start(&output, descriptor, mtg->context->progress);
    add_title(&output, mtg->columns);
    for (guint s = 0; s < stands && output.error == 0; s++) {
        add_stand(mtg, &output, s, tasks);
        fr_progress_report(mtg->context->progress, "write", (s + 1.0) / stands);
    }
    bool is_whole = fr_output_finish(&output);
    mtg->bytes = output.done;
    g_array_unref(tasks);
    return is_whole;
}

static FrStatus make_trees(FrMtg *mtg) {
    for (guint s = 0; s < plants_in(mtg->scene); s++) {
        FrMtgTree *tree = &mtg->trees[fr_io_stand(mtg->scene, s)->plant];
        if (tree->plant == NULL) {
            tree_init(tree, fr_io_plant(mtg->scene, fr_io_stand(mtg->scene, s)->plant));
        }
        mtg->columns = MAX(mtg->columns, tree->columns);
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
    mtg.trees = g_new0(FrMtgTree, MAX(scene->plants->len, 1));
    FrStatus status = make_trees(&mtg);
    if (status == FR_OK) {
        status = fr_io_replace_file(path, write_mtg, &mtg, context->diags);
    }
    stats->entities = mtg.entities;
    stats->bytes = mtg.bytes;
    stats->write_seconds = (double)(g_get_monotonic_time() - start) * 1e-6;
    for (guint p = 0; p < scene->plants->len; p++) {
        tree_clear(&mtg.trees[p]);
    }
    g_free(mtg.trees);
    return status;
}
