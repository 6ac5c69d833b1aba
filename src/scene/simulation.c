/// Scenes that grow step by step: plants of species bud by bud, and in their light the L-systems
/// that stand among them.
#include "scene/simulation.h"

#include <math.h>
#include <string.h>

/// What a step is taken back to, besides what grows bud by bud.
typedef struct FrBack {
    FrGrowingMark *growing;
    guint steps; ///< that are told
    double light_seconds;
} FrBack;

void fr_simulation_forget(void *data) {
    FrBack *back = data;
    if (back != NULL) {
        fr_growing_mark_free(back->growing);
        g_free(back);
    }
}

void fr_simulation_clear(FrSimulation *simulation) {
    g_clear_pointer(&simulation->back, g_ptr_array_unref);
    fr_ecosystem_free(simulation->ecosystem);
    fr_growing_free(simulation->growing);
    fr_hills_free(simulation->hills);
    fr_scene_free(simulation->scene);
    *simulation = (FrSimulation){0};
}

bool fr_simulation_is_growing(const FrSimulation *simulation) {
    return fr_simulation_growth(simulation) != NULL;
}

static void free_plant(void *plant) {
    fr_plant_free(plant);
}

/// Brings the plants of the scene up to date. The light compares them with the old ones, which stay
/// until `old` is freed.
static FrStatus draw(FrSimulation *simulation, const FrContext *context, GPtrArray *old) {
    if (simulation->is_drawn || !fr_simulation_is_growing(simulation)) {
        return FR_OK;
    }
    FrStatus status = fr_ecosystem_draw(simulation->ecosystem, simulation->scene, context, old);
    simulation->is_drawn = status == FR_OK;
    return status;
}

/// What grows bud by bud keeps off the others as they are now.
static FrStatus renew(FrSimulation *simulation, const FrContext *context) {
    FrStatus status = fr_growing_show_ahead(simulation->growing, simulation->scene, context);
    if (status == FR_OK) {
        status = fr_ecosystem_renew(simulation->ecosystem, simulation->scene, simulation->hills,
                                    context);
        fr_growing_show_again(simulation->growing, simulation->scene);
    }
    return status;
}

static bool is_mixed(const FrSimulation *simulation) {
    return fr_simulation_is_growing(simulation) && fr_growing_is_any(simulation->growing);
}

FrStatus fr_simulation_take_up(FrSimulation *simulation, const FrContext *context) {
    simulation->is_drawn = simulation->is_shown = false;
    if (!is_mixed(simulation)) {
        return FR_OK;
    }
    // The state knows whether its world is new to it; standing it there is none of its changes.
    FrGrowth *growth = fr_ecosystem_growth(simulation->ecosystem);
    GBytes *state = fr_growth_save(growth);
    FrStatus status = renew(simulation, context);
    if (status == FR_OK) {
        gsize size;
        const void *data = g_bytes_get_data(state, &size);
        status = fr_growth_restore(growth, data, size, (FrSpan){0}, context);
    }
    g_bytes_unref(state);
    return status;
}

/// Plants that ask the scene see those that grow bud by bud, and these keep off them.
static FrStatus step_growing(FrSimulation *simulation, const FrContext *context) {
    GPtrArray *old = g_ptr_array_new_with_free_func(free_plant);
    FrStatus status = draw(simulation, context, old);
    if (status == FR_OK) {
        status = fr_growing_step(simulation->growing, simulation->scene, context);
    }
    simulation->is_shown = false;
    g_ptr_array_unref(old);
    if (status == FR_OK && fr_simulation_is_growing(simulation)) {
        status = renew(simulation, context);
    }
    return status;
}

static FrStatus step_all(FrSimulation *simulation, const FrContext *context) {
    FrStatus status = FR_OK;
    if (fr_simulation_is_growing(simulation)) {
        status = fr_ecosystem_step(simulation->ecosystem, simulation->scene, context);
        simulation->is_drawn = false;
    }
    if (status == FR_OK && fr_growing_has_steps(simulation->growing)) {
        status = step_growing(simulation, context);
    }
    return status;
}

FrGrowthStats fr_simulation_stats(const FrSimulation *simulation) {
    const FrGrowth *growth = fr_simulation_growth(simulation);
    return growth == NULL ? (FrGrowthStats){0} : fr_growth_stats(growth);
}

const FrGrowth *fr_simulation_growth(const FrSimulation *simulation) {
    return fr_ecosystem_growth(simulation->ecosystem);
}

uint64_t fr_simulation_step_count(const FrSimulation *simulation) {
    return simulation->steps;
}

// ---- all at once ------------------------------------------------------------------------------

uint64_t fr_simulation_done(const FrSimulation *simulation) {
    const FrGrowth *growth = fr_simulation_growth(simulation);
    return growth == NULL ? 0 : fr_growth_step_count(growth);
}

static bool has_steps(const FrSimulation *simulation) {
    return (fr_simulation_is_growing(simulation) &&
            fr_simulation_done(simulation) < simulation->steps) ||
           fr_growing_has_steps(simulation->growing);
}

/// How many there will be at most.
static uint64_t steps_of(const FrSimulation *simulation) {
    uint64_t buds = fr_simulation_is_growing(simulation) ? simulation->steps : 0;
    return MAX(MAX(buds, fr_growing_longest(simulation->growing)), 1);
}

static FrStatus run_step(FrSimulation *simulation, const FrSceneOptions *options,
                         const FrContext *context) {
    bool is_growing =
        fr_simulation_is_growing(simulation) && fr_simulation_done(simulation) < simulation->steps;
    FrStatus status =
        is_growing ? step_all(simulation, context) : step_growing(simulation, context);
    uint64_t step = MAX(fr_simulation_done(simulation), simulation->scene->steps->len);
    if (status == FR_OK && options->after_step != NULL) {
        status = options->after_step(options->data, simulation, context);
    }
    fr_progress_report(context->progress, "build", (double)step / (double)steps_of(simulation));
    return status == FR_OK && fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : status;
}

FrStatus fr_simulation_run(FrSimulation *simulation, const FrSceneOptions *options,
                           const FrContext *context) {
    FrStatus status = FR_OK;
    if (options->resume != NULL) {
        status = fr_simulation_restore(simulation, options->resume, options->resume_size,
                                       options->resume_span, context);
        uint64_t reached = fr_simulation_done(simulation);
        if (status == FR_OK && reached > simulation->steps) {
            fr_diags_add(context->diags, FR_WARNING, "resumed-later", options->resume_span,
                         "the saved growth has done %" G_GUINT64_FORMAT
                         " steps already, more than the %" G_GUINT64_FORMAT " asked for",
                         reached, simulation->steps);
        }
    }
    while (status == FR_OK && has_steps(simulation)) {
        status = run_step(simulation, options, context);
    }
    GPtrArray *old = g_ptr_array_new_with_free_func(free_plant);
    if (status == FR_OK) {
        status = draw(simulation, context, old);
    }
    if (status == FR_OK && fr_simulation_is_growing(simulation)) {
        fr_ecosystem_tell_grown(simulation->ecosystem, simulation->scene, context);
    }
    if (status == FR_OK) {
        status = fr_growing_finish(simulation->growing, simulation->scene, context);
    }
    g_ptr_array_unref(old);
    return status;
}

FrStatus fr_scene_run(const FrDocument *document, const FrSceneHow *how, const FrContext *context,
                      FrScene **scene) {
    FrSimulation simulation;
    *scene = NULL;
    FrStatus status = fr_scene_begin(document, how, context, &simulation);
    if (status != FR_OK) {
        return status;
    }
    status = fr_simulation_run(&simulation, &how->options, context);
    if (status == FR_OK) {
        *scene = g_steal_pointer(&simulation.scene);
    } else if (how->parts != NULL) {
        fr_scene_forget_parts(simulation.scene, how->parts);
    }
    fr_simulation_clear(&simulation);
    return status;
}

// ---- one by one -------------------------------------------------------------------------------

FrStatus fr_simulation_new(const FrDocument *document, int64_t seed, uint32_t history,
                           const FrContext *context, FrSimulation **simulation) {
    const FrSceneHow how = {.options = {.seed = seed, .time = NAN, .steps = -1},
                            .history = history};
    FrSimulation *made = g_new0(FrSimulation, 1);
    FrStatus status = fr_scene_begin(document, &how, context, made);
    if (status != FR_OK) {
        g_clear_pointer(&made, g_free);
    }
    *simulation = made;
    return status;
}

void fr_simulation_free(FrSimulation *simulation) {
    if (simulation != NULL) {
        fr_simulation_clear(simulation);
        g_free(simulation);
    }
}

// ---- there and back ---------------------------------------------------------------------------

static FrBack *look_back(const FrSimulation *simulation) {
    FrBack *back = g_new(FrBack, 1);
    *back = (FrBack){fr_growing_mark(simulation->growing), simulation->scene->steps->len,
                     simulation->scene->light_seconds};
    return back;
}

/// What has been possible before is possible again.
static FrContext unlimited(void) {
    FrContext context = fr_context_default();
    memset(&context.limits, 0xFF, sizeof context.limits);
    return context;
}

/// Takes back all but what grows bud by bud.
static void go_back(FrSimulation *simulation, FrBack *back) {
    FrContext context = unlimited();
    fr_growing_return(simulation->growing, back->growing, &context);
    g_array_set_size(simulation->scene->steps, back->steps);
    simulation->scene->light_seconds = back->light_seconds;
    simulation->is_drawn = simulation->is_shown = false;
    fr_simulation_forget(back);
}

FrStatus fr_simulation_step(FrSimulation *simulation, const FrContext *context) {
    FrGrowth *growth = fr_ecosystem_growth(simulation->ecosystem);
    bool has_more = fr_growing_has_steps(simulation->growing);
    if (growth == NULL && !has_more) {
        return FR_OK;
    }
    // Buds have made their step when the L-systems make theirs, which may fail.
    bool keeps = growth != NULL && has_more && simulation->most_back == 0;
    GBytes *buds = keeps ? fr_growth_save(growth) : NULL;
    uint64_t done = fr_simulation_done(simulation);
    FrBack *back = look_back(simulation);
    FrStatus status = step_all(simulation, context);
    if (status == FR_OK) {
        g_ptr_array_add(simulation->back, back);
        if (simulation->back->len > simulation->most_back) {
            g_ptr_array_remove_index(simulation->back, 0);
        }
    } else {
        bool is_back = fr_simulation_done(simulation) == done;
        if (!is_back && buds != NULL) {
            gsize size;
            const void *data = g_bytes_get_data(buds, &size);
            is_back = fr_growth_restore(growth, data, size, (FrSpan){0}, context) == FR_OK;
        } else if (!is_back) {
            is_back = fr_growth_undo(growth);
        }
        FR_ASSERT(is_back);
        go_back(simulation, back);
    }
    g_clear_pointer(&buds, g_bytes_unref);
    return status;
}

bool fr_simulation_undo(FrSimulation *simulation) {
    FrGrowth *growth = fr_ecosystem_growth(simulation->ecosystem);
    if (simulation->back->len == 0 || (growth != NULL && !fr_growth_undo(growth))) {
        return false;
    }
    go_back(simulation, g_ptr_array_steal_index(simulation->back, simulation->back->len - 1));
    FrContext context = unlimited();
    FrStatus status = fr_simulation_take_up(simulation, &context);
    FR_ASSERT(status == FR_OK);
    return true;
}

/// Lets the L-systems of the changed document go on, and the steps back with them.
static void inherit(FrSimulation *next, FrSimulation *last, const FrContext *context) {
    uint32_t *origins = fr_growing_inherit(next->growing, last->growing, context);
    GPtrArray *empty = next->back;
    next->back = last->back;
    last->back = empty;
    for (guint i = 0; i < next->back->len; i++) {
        FrBack *back = g_ptr_array_index(next->back, i);
        fr_growing_mark_inherit(back->growing, next->growing, origins);
    }
    g_free(origins);
    if (is_mixed(next)) {
        FrContext own = unlimited();
        own.pool = context->pool;
        FrStatus status = renew(next, &own);
        FR_ASSERT(status == FR_OK);
    }
}

FrStatus fr_simulation_change(FrSimulation *simulation, const FrDocument *document,
                              const FrContext *context) {
    const FrSceneHow how = {.options = {.seed = simulation->seed, .time = NAN, .steps = -1},
                            .history = simulation->most_back,
                            .previous = fr_simulation_is_growing(simulation) ? simulation : NULL};
    FrSimulation next;
    FrStatus status = fr_scene_begin(document, &how, context, &next);
    if (status == FR_OK) {
        g_array_append_vals(next.scene->steps, simulation->scene->steps->data,
                            simulation->scene->steps->len);
        next.scene->light_seconds += simulation->scene->light_seconds;
        inherit(&next, simulation, context);
        fr_simulation_clear(simulation);
        *simulation = next;
    }
    return status;
}

FrStatus fr_simulation_scene(FrSimulation *simulation, const FrContext *context,
                             const FrScene **scene) {
    GPtrArray *old = g_ptr_array_new_with_free_func(free_plant);
    FrStatus status = draw(simulation, context, old);
    if (status == FR_OK && !simulation->is_shown) {
        status = fr_growing_draw(simulation->growing, simulation->scene, context, old);
        simulation->is_shown = status == FR_OK;
    }
    fr_growing_detach(simulation->growing, old);
    g_ptr_array_unref(old);
    *scene = status == FR_OK ? simulation->scene : NULL;
    return status;
}
