// Binary trees by chance, and the plants they are.
//
// Strahler orders go down the tree: a branch of order k draws what it forks into from row k of the
// matrix, until order 1, which is a tip. Strands go down it too: a branch of n strands forks into
// two that share them, until one strand is left. Where angles a and b stand at a fork, together
// `angle`, the sines are as the weights are the other way round: tan a = r·sin / (1 + r·cos).
#include "variation/ramified.h"

#include <cglm/struct.h>

#include <math.h>

#define FR_PARAM_STRUCT FrRamifiedParams
static const FrParam rows[] = {FR_RAMIFIED_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable table = {
    .element = "ramified",
    .meaning = "a tree of forks: random, perfect, by a matrix of ramification or by strands; its "
               "text has a row for each order k from 2 on, the probabilities that it forks into "
               "k and 1 … k and k-1, k-1 and k-1",
    .rows = rows,
    .count = G_N_ELEMENTS(rows),
    .struct_size = sizeof(FrRamifiedParams)};

enum { PURPOSE_FORK = 81, PURPOSE_LENGTH, PURPOSE_ROLL, PURPOSE_LEAF };
/// Angle from leaf to leaf.
#define GOLDEN 2.39996322972865332

const FrParamTable *fr_ramified_table(void) {
    return &table;
}

FrRamified *fr_ramified_new(const FrRamifiedParams *params) {
    FrRamified *ramified = g_new0(FrRamified, 1);
    fr_params_copy(&table, &ramified->params, params);
    fr_matrix_known(ramified);
    return ramified;
}

void fr_ramified_free(FrRamified *ramified) {
    if (ramified != NULL) {
        fr_params_clear(&table, &ramified->params);
        fr_material_unref(ramified->bark);
        fr_material_unref(ramified->leaf);
        fr_source_unref(ramified->span.source);
        g_free(ramified);
    }
}

void fr_ramified_set_materials(FrRamified *ramified, FrMaterial *bark, FrMaterial *leaf) {
    ramified->bark = bark == NULL ? NULL : fr_material_ref(bark);
    ramified->leaf = leaf == NULL ? NULL : fr_material_ref(leaf);
}

FrStatus fr_ramified_load(FrRamified *ramified, const FrSource *text, FrSpan span,
                          const FrContext *context) {
    ramified->span = span;
    fr_source_ref(span.source);
    bool wants_text = ramified->params.by == FR_RAMIFIED_MATRIX;
    if (wants_text == (text != NULL)) {
        return wants_text ? fr_matrix_read(ramified, text, context) : FR_OK;
    }
    fr_diags_add(context->diags, FR_ERROR, wants_text ? "missing-text" : "misplaced-text", span,
                 wants_text ? "by='matrix' needs the rows of a matrix as text"
                            : "only by='matrix' reads the rows of a matrix");
    return FR_ERR_DOCUMENT;
}

const double *fr_ramified_row(const FrRamified *ramified, uint32_t order) {
    FR_ASSERT(order >= 2 && order <= FR_RAMIFIED_ORDERS);
    return ramified->rows[order];
}

// ---- the tree ----------------------------------------------------------------------------------

/// A branch to come: from a fork to the next, or to its tip.
typedef struct FrTwig {
    FrKey key;
    uint32_t weight; ///< Strahler order, or strands
    uint32_t bearer; ///< node, FR_NONE for the stem
    uint32_t axis;   ///< that it goes on with, FR_NONE: begins one
    double tilt;     ///< radians, to the sides of the fork's plane
    double roll;     ///< of that plane
} FrTwig;

static void split_strands(const FrRamified *ramified, const FrTwig *twig, uint32_t weights[2]) {
    double least = ramified->params.split;
    double part = least + (0.5 - least) * fr_random(twig->key, PURPOSE_FORK, 0);
    double smaller = CLAMP(round(part * twig->weight), 1.0, floor(0.5 * twig->weight));
    weights[1] = (uint32_t)smaller;
    weights[0] = twig->weight - weights[1];
}

static void draw_orders(const FrRamified *ramified, const FrTwig *twig, uint32_t weights[2]) {
    const double *row = ramified->rows[twig->weight];
    double drawn = fr_random(twig->key, PURPOSE_FORK, 0);
    uint32_t i = 0;
    while (i + 1 < twig->weight && drawn >= row[i]) {
        drawn -= row[i++];
    }
    bool is_last = i + 1 == twig->weight;
    weights[0] = is_last ? twig->weight - 1 : twig->weight;
    weights[1] = is_last ? twig->weight - 1 : i + 1;
}

/// Weights of what a branch forks into, the heavier first; false at a tip.
static bool fork_into(const FrRamified *ramified, const FrTwig *twig, uint32_t weights[2]) {
    if (twig->weight < 2) {
        return false;
    }
    if (ramified->params.by == FR_RAMIFIED_STRANDS) {
        split_strands(ramified, twig, weights);
    } else {
        draw_orders(ramified, twig, weights);
    }
    return true;
}

static FrTwig stem_of(const FrRamified *ramified, uint64_t seed) {
    const FrRamifiedParams *params = &ramified->params;
    int64_t weight = params->by == FR_RAMIFIED_STRANDS ? params->strands
                                                       : MIN(params->order, FR_RAMIFIED_ORDERS);
    return (FrTwig){
        .key = fr_key_root(seed), .weight = (uint32_t)weight, .bearer = FR_NONE, .axis = FR_NONE};
}

/// Appends the two branches of a fork; the one that goes on is taken first.
static void push_fork(const FrRamified *ramified, const FrTwig *twig, const uint32_t weights[2],
                      uint32_t node, uint32_t axis, GArray *waiting) {
    const FrRamifiedParams *params = &ramified->params;
    bool is_strands = params->by == FR_RAMIFIED_STRANDS;
    double lighter = is_strands ? (double)weights[1] / weights[0]
                                : pow(params->ratio, (double)weights[1] - weights[0]);
    double r = pow(lighter, params->deviation), angle = params->angle;
    double tilt = atan2(r * sin(angle), 1.0 + r * cos(angle));
    double chance = fr_random_signed(twig->key, PURPOSE_ROLL, 0);
    double roll = params->roll + chance * params->roll_variance;
    FrTwig aside = {.key = fr_key_child(twig->key, 1),
                    .weight = weights[1],
                    .bearer = node,
                    .axis = FR_NONE,
                    .tilt = tilt - angle,
                    .roll = roll};
    FrTwig onward = {.key = fr_key_child(twig->key, 0),
                     .weight = weights[0],
                     .bearer = node,
                     .axis = axis,
                     .tilt = tilt,
                     .roll = roll};
    g_array_append_val(waiting, aside);
    g_array_append_val(waiting, onward);
}

/// How much a tree has.
typedef struct FrRamifiedCount {
    uint64_t nodes, tips;
} FrRamifiedCount;

/// What every tree has at least: strands are divided until each is alone, and a branch of order k
/// bears two of order k − 1 or goes on as k.
static FrRamifiedCount least_count(const FrRamified *ramified) {
    FrTwig stem = stem_of(ramified, 0);
    uint64_t tips = ramified->params.by == FR_RAMIFIED_STRANDS
                        ? MAX(stem.weight, 1)
                        : UINT64_C(1) << (MAX(stem.weight, 1) - 1);
    return (FrRamifiedCount){2 * tips - 1, tips};
}

/// Follows all forks without their angles; stops counting above `most` internodes.
static FrRamifiedCount count_tree(const FrRamified *ramified, uint64_t seed, uint64_t most,
                                  const FrContext *context) {
    if (ramified->params.by == FR_RAMIFIED_STRANDS) {
        return least_count(ramified);
    }
    GArray *waiting = g_array_new(FALSE, FALSE, sizeof(FrTwig));
    FrTwig twig = stem_of(ramified, seed);
    g_array_append_val(waiting, twig);
    FrRamifiedCount count = {0, 0};
    while (waiting->len > 0 && count.nodes <= most &&
           !fr_progress_is_cancelled(context->progress)) {
        twig = g_array_index(waiting, FrTwig, waiting->len - 1);
        g_array_set_size(waiting, waiting->len - 1);
        uint32_t weights[2];
        count.nodes++;
        if (fork_into(ramified, &twig, weights)) {
            for (uint32_t k = 2; k-- > 0;) {
                FrTwig child = {.key = fr_key_child(twig.key, k), .weight = weights[k]};
                g_array_append_val(waiting, child);
            }
        } else {
            count.tips++;
        }
    }
    g_array_unref(waiting);
    return count;
}

// ---- the plant ---------------------------------------------------------------------------------

/// A plant on its way.
typedef struct FrRamifying {
    const FrRamified *ramified;
    FrPlant *plant;
    uint32_t bark, leaf, shape; ///< indices into the plant's materials and shapes
    uint32_t components[2];     ///< of stem and branches
    double whole;               ///< weight of the stem
} FrRamifying;

static double length_of(const FrRamifying *ramifying, const FrTwig *twig) {
    const FrRamifiedParams *params = &ramifying->ramified->params;
    double lower = params->by == FR_RAMIFIED_STRANDS ? log2(ramifying->whole / twig->weight)
                                                     : ramifying->whole - twig->weight;
    double chance = fr_random_signed(twig->key, PURPOSE_LENGTH, 0);
    double length = params->length * pow(params->length_ratio, lower);
    return fmax(length * (1.0 + params->length_variance * chance), 0.01 * length);
}

static uint32_t add_internode(const FrRamifying *ramifying, FrTwig *twig) {
    FrPlant *plant = ramifying->plant;
    if (twig->axis == FR_NONE) {
        twig->axis = fr_plant_add_axis(plant, twig->bearer, (vec3s){{0, 0, 0}}, 0.0F);
        plant->axes.material[twig->axis] = ramifying->bark;
        plant->axes.component[twig->axis] = ramifying->components[twig->bearer != FR_NONE];
        plant->axes.path[twig->axis] = twig->key;
    }
    versors roll = fr_rotation_about((vec3s){{0, 0, 1}}, (float)twig->roll);
    versors tilt = fr_rotation_about((vec3s){{1, 0, 0}}, (float)twig->tilt);
    return fr_plant_add_node(plant, twig->axis, glms_quat_mul(roll, tilt),
                             (float)length_of(ramifying, twig), 0.0F);
}

static void add_leaves(const FrRamifying *ramifying, const FrTwig *twig, uint32_t node) {
    FrPlant *plant = ramifying->plant;
    uint32_t count = (uint32_t)ramifying->ramified->params.leaves;
    uint32_t first = count > 0 ? fr_plant_append_organs(plant, count) : 0;
    double start = 2.0 * G_PI * fr_random(twig->key, PURPOSE_LEAF, 0);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t organ = first + i;
        versors around = fr_rotation_about((vec3s){{0, 0, 1}}, (float)(start + GOLDEN * i));
        versors out = fr_rotation_about((vec3s){{1, 0, 0}}, 0.9F);
        plant->organs.node[organ] = node;
        plant->organs.rotation[organ] = glms_quat_mul(around, out);
        plant->organs.shape[organ] = ramifying->shape;
        plant->organs.material[organ] = ramifying->leaf;
        plant->organs.component[organ] = ramifying->components[1];
        plant->organs.path[organ] = fr_key_child(twig->key, 2 + i);
    }
}

static void begin_plant(FrRamifying *ramifying) {
    const FrRamified *ramified = ramifying->ramified;
    FrPlant *plant = ramifying->plant;
    FrShape shape = {.kind = FR_SHAPE_BLADE,
                     .blade = {.length = (float)ramified->params.leaf_length,
                               .width = (float)ramified->params.leaf_width,
                               .curvature_along = -0.6F,
                               .fold = 0.25F,
                               .outline = FR_NONE,
                               .along_curve = FR_NONE,
                               .across_curve = FR_NONE,
                               .segments_along = 4,
                               .segments_across = 1}};
    ramifying->shape = ramified->params.leaves > 0 ? fr_plant_add_shape(plant, &shape) : FR_NONE;
    ramifying->bark =
        ramified->bark != NULL ? fr_plant_add_material(plant, ramified->bark) : FR_NONE;
    ramifying->leaf =
        ramified->leaf != NULL ? fr_plant_add_material(plant, ramified->leaf) : FR_NONE;
    ramifying->components[0] = fr_plant_add_component(plant, "stem", ramified->span);
    ramifying->components[1] = fr_plant_add_component(plant, "branch", ramified->span);
}

static void make_plant(FrRamifying *ramifying, uint64_t seed) {
    const FrRamified *ramified = ramifying->ramified;
    GArray *waiting = g_array_new(FALSE, FALSE, sizeof(FrTwig));
    FrTwig twig = stem_of(ramified, seed);
    ramifying->whole = twig.weight;
    g_array_append_val(waiting, twig);
    while (waiting->len > 0) {
        twig = g_array_index(waiting, FrTwig, waiting->len - 1);
        g_array_set_size(waiting, waiting->len - 1);
        uint32_t node = add_internode(ramifying, &twig), weights[2];
        if (fork_into(ramified, &twig, weights)) {
            push_fork(ramified, &twig, weights, node, twig.axis, waiting);
        } else {
            add_leaves(ramifying, &twig, node);
        }
    }
    g_array_unref(waiting);
}

static FrStatus check_count(const FrRamified *ramified, const char *name, FrRamifiedCount count,
                            const FrContext *context) {
    const FrLimits *limits = &context->limits;
    FrStatus status =
        fr_limit_check(count.nodes, limits->nodes, "nodes", name, ramified->span, context->diags);
    uint64_t organs = fr_count_multiply(count.tips, (uint64_t)ramified->params.leaves);
    return status == FR_OK ? fr_limit_check(organs, limits->organs, "organs", name, ramified->span,
                                            context->diags)
                           : status;
}

FrStatus fr_ramified_grow(const FrRamified *ramified, const char *name, uint64_t seed,
                          const FrContext *context, FrPlant **plant) {
    *plant = NULL;
    const FrRamifiedParams *params = &ramified->params;
    FrRamifiedCount count = least_count(ramified);
    FrStatus status = check_count(ramified, name, count, context);
    if (status != FR_OK) {
        return status;
    }
    count = count_tree(ramified, seed, context->limits.nodes, context);
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    status = check_count(ramified, name, count, context);
    if (status != FR_OK) {
        return status;
    }
    FrRamifying ramifying = {.ramified = ramified, .plant = fr_plant_new(name)};
    fr_plant_reserve(ramifying.plant, (uint32_t)count.nodes, (uint32_t)count.tips);
    begin_plant(&ramifying);
    make_plant(&ramifying, seed);
    fr_plant_weigh(ramifying.plant, (FrWeights)(params->weights + 1), params->thinnest,
                   params->ratio, params->pipe_exponent);
    *plant = ramifying.plant;
    return FR_OK;
}
