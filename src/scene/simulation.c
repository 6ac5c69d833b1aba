/// Scenes that grow step by step: plants of species bud by bud, and in their light the L-systems
/// that stand among them.
#include "scene/simulation.h"

#include <math.h>
#include <string.h>

void fr_simulation_clear(FrSimulation *simulation) {
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
    GPtrArray *grown = g_ptr_array_new_with_free_func(free_plant);
    FrStatus status = fr_growing_exchange(simulation->growing, simulation->scene, context, grown);
    if (status == FR_OK) {
        status = fr_ecosystem_renew(simulation->ecosystem, simulation->scene, simulation->hills,
                                    context);
        FrStatus back = fr_growing_exchange(simulation->growing, simulation->scene, context, grown);
        FR_ASSERT(back == FR_OK);
    }
    g_ptr_array_unref(grown);
    return status;
}

FrStatus fr_simulation_take_up(FrSimulation *simulation, const FrContext *context) {
    simulation->is_drawn = false;
    bool is_mixed = fr_simulation_is_growing(simulation) && fr_growing_is_any(simulation->growing);
    return is_mixed ? renew(simulation, context) : FR_OK;
}

/// Plants that ask the scene see those that grow bud by bud, and these keep off them.
static FrStatus step_growing(FrSimulation *simulation, const FrContext *context) {
    GPtrArray *old = g_ptr_array_new_with_free_func(free_plant);
    FrStatus status = draw(simulation, context, old);
    if (status == FR_OK) {
        status = fr_growing_step(simulation->growing, simulation->scene, context);
    }
    g_ptr_array_unref(old);
    if (status == FR_OK && fr_simulation_is_growing(simulation)) {
        status = renew(simulation, context);
    }
    return status;
}

FrStatus fr_simulation_step(FrSimulation *simulation, const FrContext *context) {
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
        is_growing ? fr_simulation_step(simulation, context) : step_growing(simulation, context);
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

bool fr_simulation_undo(FrSimulation *simulation) {
    FrGrowth *growth = fr_ecosystem_growth(simulation->ecosystem);
    if (growth == NULL || !fr_growth_undo(growth)) {
        return false;
    }
    simulation->is_drawn = false;
    GArray *steps = simulation->scene->steps;
    if (steps->len > 0) {
        g_array_set_size(steps, steps->len - 1);
    }
    return true;
}

FrStatus fr_simulation_change(FrSimulation *simulation, const FrDocument *document,
                              const FrContext *context) {
    const FrSceneHow how = {.options = {.seed = simulation->seed, .time = NAN, .steps = -1},
                            .history = fr_ecosystem_history(simulation->ecosystem),
                            .previous = fr_simulation_is_growing(simulation) ? simulation : NULL};
    FrSimulation next;
    FrStatus status = fr_scene_begin(document, &how, context, &next);
    if (status == FR_OK) {
        g_array_append_vals(next.scene->steps, simulation->scene->steps->data,
                            simulation->scene->steps->len);
        fr_simulation_clear(simulation);
        *simulation = next;
    }
    return status;
}

FrStatus fr_simulation_scene(FrSimulation *simulation, const FrContext *context,
                             const FrScene **scene) {
    GPtrArray *old = g_ptr_array_new_with_free_func(free_plant);
    FrStatus status = draw(simulation, context, old);
    g_ptr_array_unref(old);
    *scene = status == FR_OK ? simulation->scene : NULL;
    return status;
}
