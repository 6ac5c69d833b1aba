// Growing grafts. Plants of other engines are of unknown size until they are grown, so they are
// grown a batch at a time, no more than fit if all are as large as the largest so far, and each
// with the limits that the plant has left.
#include "pgraph/graft.h"

#include "pgraph/global.h"
#include "pgraph/life.h"
#include "pgraph/timing.h"

#include <math.h>

enum { MOST_AT_ONCE = 1024 };

typedef struct Batch {
    const FrGrafting *grafting;
    const FrExpansion *expansion;
    const FrContext *context;
    const uint32_t *rows;
    FrLimits limits;
    FrScion *scions;
    FrDiags **diags;
    FrStatus *statuses;
} Batch;

void fr_grafting_init(FrGrafting *grafting, const FrGraft *graft) {
    *grafting =
        (FrGrafting){.graft = graft,
                     .scions = g_array_new(FALSE, TRUE, sizeof(FrScion)),
                     .largest = UINT64_MAX,
                     .told = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL)};
}

void fr_grafting_clear(FrGrafting *grafting) {
    fr_grafts_drop(grafting);
    g_array_unref(grafting->scions);
    g_hash_table_unref(grafting->told);
}

void fr_grafts_drop(FrGrafting *grafting) {
    for (guint i = 0; i < grafting->scions->len; i++) {
        FrScion *scion = &g_array_index(grafting->scions, FrScion, i);
        fr_plant_free(scion->plant);
        g_free(scion->materials);
        g_free(scion->shapes);
        g_free(scion->profiles);
        g_free(scion->finishes);
        g_free(scion->lengths);
    }
    g_array_set_size(grafting->scions, 0);
    g_clear_pointer(&grafting->scion, g_free);
}

// ---- growing ----------------------------------------------------------------------------------

static FrStatus grow(const Batch *batch, uint32_t row, FrEvaluator *evaluator,
                     const FrContext *context, FrPlant **plant) {
    const FrExpansion *expansion = batch->expansion;
    const FrPrepared *prepared = &expansion->prepared[fr_instance_stage(expansion, row)->component];
    const FrGraftParams *params = prepared->params;
    const GArray *defines = prepared->defines;
    fr_instance_enter(expansion, row, evaluator);
    const char **names = g_new(const char *, defines->len + 1);
    double *values = g_new(double, defines->len + 1);
    for (guint k = 0; k < defines->len; k++) {
        const FrGraftDefine *define = &g_array_index(defines, FrGraftDefine, k);
        names[k] = define->name;
        values[k] = fr_value(evaluator, &define->number, FR_GRAFT_COUNT + k);
    }
    FrGraftWish wish = {
        .plant = params->plant,
        .key = expansion->level.key[row],
        .steps = (int64_t)floor(fr_value(evaluator, &params->steps, FR_GRAFT_steps) + 0.5),
        .symbols = prepared->symbols,
        .names = names,
        .values = values,
        .count = defines->len,
    };
    FrStatus status =
        batch->grafting->graft->grow(batch->grafting->graft->data, &wish, context, plant);
    g_free(names);
    g_free(values);
    return status;
}

static void grow_range(void *data, size_t begin, size_t end, int worker) {
    const Batch *batch = data;
    FrEvaluator evaluator = {.faults = batch->expansion->faults[worker]};
    for (size_t i = begin; i < end; i++) {
        batch->diags[i] = fr_diags_new();
        FrContext context = {.diags = batch->diags[i], .limits = batch->limits};
        double began = fr_graft_begin(batch->expansion, i);
        batch->statuses[i] =
            grow(batch, batch->rows[i], &evaluator, &context, &batch->scions[i].plant);
        fr_graft_end(batch->expansion,
                     fr_instance_stage(batch->expansion, batch->rows[i])->component, worker, began);
    }
}

// Warnings of the same place are told once.
static void pass_on(FrGrafting *grafting, const FrDiags *from, FrDiags *to) {
    for (size_t i = 0; i < fr_diags_count(from); i++) {
        const FrDiag *diag = fr_diags_get(from, i);
        gint64 place = (gint64)((uintptr_t)diag->code ^ (uint64_t)diag->span.begin << 32);
        if (diag->severity == FR_ERROR ||
            g_hash_table_add(grafting->told, g_memdup2(&place, sizeof place))) {
            fr_diags_add(to, diag->severity, diag->code, diag->span, "%s", diag->text);
        }
    }
}

// ---- what the receiving plant has of it -------------------------------------------------------

static uint32_t mapped(const uint32_t *map, uint32_t index) {
    return index == FR_NONE ? FR_NONE : map[index];
}

/// The curves along a blade are told by one more than their profile.
static uint32_t mapped_along(const FrScion *scion, uint32_t index) {
    return index == 0 ? 0 : scion->profiles[index - 1] + 1;
}

static void map_blade(const FrScion *scion, FrBlade *blade) {
    blade->outline = mapped(scion->profiles, blade->outline);
    blade->along_curve = mapped(scion->profiles, blade->along_curve);
    blade->across_curve = mapped(scion->profiles, blade->across_curve);
    blade->across_along = mapped_along(scion, blade->across_along);
    blade->fold_along = mapped_along(scion, blade->fold_along);
    blade->twist_along = mapped_along(scion, blade->twist_along);
    blade->wave_along = mapped_along(scion, blade->wave_along);
    blade->leaflet_curve = mapped_along(scion, blade->leaflet_curve);
}

static void map_shapes(FrScion *scion, FrPlant *host) {
    const FrPlant *plant = scion->plant;
    scion->materials = g_new(uint32_t, plant->materials->len + 1);
    for (guint i = 0; i < plant->materials->len; i++) {
        scion->materials[i] = fr_plant_add_material(host, g_ptr_array_index(plant->materials, i));
    }
    scion->profiles = g_new(uint32_t, plant->profiles->len + 1);
    for (guint i = 0; i < plant->profiles->len; i++) {
        const FrProfile *profile = &g_array_index(plant->profiles, FrProfile, i);
        scion->profiles[i] = fr_plant_add_profile(host, (const double(*)[2])profile->points,
                                                  profile->count, profile->is_closed);
    }
    scion->shapes = g_new(uint32_t, plant->shapes->len + 1);
    for (guint i = 0; i < plant->shapes->len; i++) {
        FrShape shape = g_array_index(plant->shapes, FrShape, i);
        if (shape.kind == FR_SHAPE_MESH) {
            shape.detail = mapped(scion->profiles, shape.detail);
        } else if (shape.kind == FR_SHAPE_REVOLUTION) {
            shape.outline = mapped(scion->profiles, shape.outline);
        } else if (shape.kind == FR_SHAPE_FILE) {
            shape.detail = fr_plant_add_file(host, g_ptr_array_index(plant->files, shape.detail));
        } else if (shape.kind == FR_SHAPE_BLADE) {
            map_blade(scion, &shape.blade);
        }
        scion->shapes[i] = fr_plant_add_shape(host, &shape);
    }
}

/// Finishes, and the scopes of deformations, whose rows the plant gets now and values later.
static void map_rest(FrScion *scion, FrPlant *host) {
    const FrPlant *plant = scion->plant;
    scion->finishes = g_new(uint32_t, plant->finishes->len + 1);
    for (guint i = 0; i < plant->finishes->len; i++) {
        FrFinish finish = g_array_index(plant->finishes, FrFinish, i);
        finish.face = finish.face > 0 ? mapped(scion->materials, finish.face - 1) + 1 : 0;
        guint known = 0;
        while (known < host->finishes->len &&
               memcmp(&g_array_index(host->finishes, FrFinish, known), &finish, sizeof finish)) {
            known++;
        }
        scion->finishes[i] =
            known < host->finishes->len ? known : fr_plant_add_finish(host, &finish);
    }
    if (plant->deformers->len == 0) {
        return;
    }
    uint32_t first = host->deformations->len;
    for (guint i = 0; i < plant->deformations->len; i++) {
        FrDeformation deformation = g_array_index(plant->deformations, FrDeformation, i);
        deformation.component = FR_NONE;
        fr_plant_add_deformation(host, &deformation);
    }
    scion->deformers = fr_plant_append_deformers(host, plant->deformers->len);
    for (guint i = 0; i < plant->deformers->len; i++) {
        FrDeformer *to = &g_array_index(host->deformers, FrDeformer, scion->deformers + i);
        *to = g_array_index(plant->deformers, FrDeformer, i);
        to->deformation += first;
    }
}

static void measure_axes(FrScion *scion) {
    const FrNodes *nodes = &scion->plant->nodes;
    scion->lengths = g_new0(float, scion->plant->axes.count + 1);
    for (uint32_t node = 0; node < nodes->count; node++) {
        scion->lengths[nodes->axis[node]] += nodes->length[node];
    }
    for (uint32_t organ = 0; organ < scion->plant->organs.count; organ++) {
        scion->places += scion->plant->organs.shape[organ] == FR_NONE;
    }
}

uint32_t fr_scion_places(const FrScion *scion, char symbol) {
    const FrOrgans *organs = &scion->plant->organs;
    uint32_t count = 0;
    for (uint32_t organ = 0; organ < organs->count && scion->places > 0; organ++) {
        count += organs->shape[organ] == FR_NONE && *fr_scion_symbol(scion->plant, organ) == symbol;
    }
    return count;
}

// ---- a level ----------------------------------------------------------------------------------

typedef struct Sums {
    uint64_t nodes, organs;
} Sums;

static FrStatus check(const FrExpansion *expansion, uint32_t row, const Sums *sums,
                      const FrContext *context) {
    const FrPrototype *prototype =
        fr_pgraph_prototype(expansion->graph, fr_instance_stage(expansion, row)->component);
    FrStatus status = fr_limit_check(sums->nodes, context->limits.nodes, "nodes", prototype->id,
                                     prototype->span, context->diags);
    if (status == FR_OK) {
        status = fr_limit_check(sums->organs, context->limits.organs, "organs", prototype->id,
                                prototype->span, context->diags);
    }
    return status != FR_OK
               ? status
               : fr_limit_check(expansion->plant->shapes->len, context->limits.shapes, "shapes",
                                prototype->id, prototype->span, context->diags);
}

const char *fr_pgraph_grafted(const FrPgraph *graph, uint32_t graft) {
    FR_ASSERT(fr_pgraph_kind(graph, graft) == FR_COMPONENT_GRAFT);
    const FrGraftParams *params = fr_pgraph_prototype(graph, graft)->params;
    return params->plant;
}

/// Takes what a batch has grown, in the order of its rows.
static FrStatus take(FrGrafting *grafting, FrExpansion *expansion, const Batch *batch,
                     uint32_t count, Sums *sums) {
    FrStatus status = FR_OK;
    for (uint32_t i = 0; i < count; i++) {
        FrScion *scion = &batch->scions[i];
        if (status == FR_OK) {
            pass_on(grafting, batch->diags[i], batch->context->diags);
            status = batch->statuses[i];
        }
        fr_diags_free(batch->diags[i]);
        if (status == FR_OK) {
            uint64_t size = scion->plant->nodes.count + (uint64_t)scion->plant->organs.count;
            grafting->largest =
                grafting->largest == UINT64_MAX ? size : MAX(size, grafting->largest);
            sums->nodes += scion->plant->nodes.count;
            sums->organs += scion->plant->organs.count;
            map_shapes(scion, expansion->plant);
            map_rest(scion, expansion->plant);
            measure_axes(scion);
            status = check(expansion, batch->rows[i], sums, batch->context);
        }
        g_array_append_val(grafting->scions, *scion);
    }
    return status;
}

static FrStatus grow_batch(FrGrafting *grafting, FrExpansion *expansion, const FrContext *context,
                           const uint32_t *rows, uint32_t count, Sums *sums) {
    Batch batch = {.grafting = grafting,
                   .expansion = expansion,
                   .context = context,
                   .rows = rows,
                   .limits = context->limits,
                   .scions = g_new0(FrScion, count),
                   .diags = g_new0(FrDiags *, count),
                   .statuses = g_new0(FrStatus, count)};
    batch.limits.nodes = context->limits.nodes - sums->nodes;
    batch.limits.organs = context->limits.organs - sums->organs;
    // All grafts of a level share what a plant may have, so that those within them do too.
    batch.limits.instances = MAX(context->limits.instances / grafting->count, 1);
    fr_parallel_for(context->pool, count, 1, grow_range, &batch, NULL);
    FrStatus status = take(grafting, expansion, &batch, count, sums);
    g_free(batch.scions);
    g_free(batch.diags);
    g_free(batch.statuses);
    return status;
}

/// How many may be grown at once.
static uint32_t batch_size(const FrGrafting *grafting, const FrContext *context, const Sums *sums) {
    if (grafting->largest == UINT64_MAX) {
        return 1; // nothing is known yet
    }
    uint64_t left = MIN(context->limits.nodes - sums->nodes, context->limits.organs - sums->organs);
    return (uint32_t)CLAMP(left / (grafting->largest + 1), 1, MOST_AT_ONCE);
}

static FrStatus check_grafter(const FrGrafting *grafting, const FrExpansion *expansion,
                              uint32_t row, const FrContext *context) {
    if (grafting->graft != NULL) {
        return FR_OK;
    }
    const FrPrototype *prototype =
        fr_pgraph_prototype(expansion->graph, fr_instance_stage(expansion, row)->component);
    fr_diags_add(context->diags, FR_ERROR, "no-graft", prototype->span,
                 "nobody knows the plant that stands at '%s'", prototype->id);
    return FR_ERR_DOCUMENT;
}

FrStatus fr_grafts_grow(FrGrafting *grafting, FrExpansion *expansion, const FrContext *context) {
    const FrLevel *level = &expansion->level;
    GArray *rows = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    FrEvaluator evaluator = {.faults = expansion->faults[0]};
    for (uint32_t row = 0; row < level->count; row++) {
        bool is_graft = fr_stage_prepared(expansion, level->stage[row])->kind == FR_COMPONENT_GRAFT;
        if (is_graft && fr_instance_lives(expansion, row, &evaluator)) {
            g_array_append_val(rows, row);
        }
    }
    FrStatus status = FR_OK;
    Sums sums = {expansion->plant->nodes.count, expansion->plant->organs.count};
    if (rows->len > 0) {
        grafting->scion = g_new(uint32_t, level->count);
        grafting->count = rows->len;
        status = check_grafter(grafting, expansion, g_array_index(rows, uint32_t, 0), context);
    }
    for (uint32_t i = 0; i < rows->len; i++) {
        grafting->scion[g_array_index(rows, uint32_t, i)] = i;
    }
    for (uint32_t done = 0; done < rows->len && status == FR_OK;) {
        if (fr_progress_is_cancelled(context->progress)) {
            status = FR_CANCELLED;
            break;
        }
        uint32_t count = MIN(batch_size(grafting, context, &sums), rows->len - done);
        status = grow_batch(grafting, expansion, context, &g_array_index(rows, uint32_t, done),
                            count, &sums);
        done += count;
    }
    g_array_unref(rows);
    expansion->grafting = grafting;
    return status;
}

void fr_graft_measure(const FrExpansion *expansion, uint32_t row) {
    const FrLevel *level = &expansion->level;
    const FrScion *scion = fr_scion_of(expansion->grafting, row);
    const FrStage *stage = fr_instance_stage(expansion, row);
    level->node_count[row] = scion->plant->nodes.count;
    level->axis_count[row] = scion->plant->axes.count;
    level->organ_count[row] = scion->plant->organs.count - scion->places;
    for (uint32_t k = 0; k < stage->link_count && scion->places > 0; k++) {
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        if (link->kind == FR_LINK_SYMBOL) {
            level->places[row] += fr_scion_places(scion, link->symbol);
        }
    }
}
