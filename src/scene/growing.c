/// The growth loop of Van Haevre, Di Fiore, Bekaert, Van Reeth 2004, Illumination Driven Plant
/// Growth Based on Ray Density Estimation, listing 1, for many plants at once: each step every
/// plant is drawn, the light is brought up to date with all of them, their open symbols are
/// answered, and the productions applied. What they ask of free space is answered from what stands
/// then too.
#include "scene/growing_parts.h"

#include "scene/grow.h"

static bool asks_space(const FrPlantDef *definition) {
    return fr_lsystem_asks_space(fr_lmodel_system(definition->lsystem));
}

bool fr_growing_is_wanted(const FrScene *scene, const FrPlantDef *definition) {
    return definition->kind == FR_PLANT_LSYSTEM &&
           fr_lsystem_is_open(fr_lmodel_system(definition->lsystem)) &&
           (scene->surroundings->light.is_given || asks_space(definition));
}

void fr_sprout_free(void *data) {
    FrSprout *sprout = data;
    fr_lderivation_free(sprout->derivation);
    fr_answers_clear(&sprout->answers);
    fr_plant_free(sprout->ahead);
    g_free(sprout->id);
    g_free(sprout);
}

void fr_growing_free(FrGrowing *growing) {
    if (growing == NULL) {
        return;
    }
    g_ptr_array_unref(growing->sprouts);
    fr_lighting_free(growing->lighting);
    fr_clearance_free(growing->clearance);
    g_free(growing);
}

FrGrowing *fr_growing_new(uint64_t steps, FrGrowingWatch watch) {
    FrGrowing *growing = g_new0(FrGrowing, 1);
    growing->steps = steps;
    growing->watch = watch;
    growing->sprouts = g_ptr_array_new_with_free_func(fr_sprout_free);
    growing->environment = (FrEnvironment){growing, fr_growing_answer};
    return growing;
}

FrStatus fr_growing_derive(const FrGrowing *growing, const FrPlantDef *definition, int64_t seed,
                           const FrContext *context, FrLderivation **derivation) {
    FrLsettings settings = fr_lmodel_settings(definition->lsystem);
    settings.seed = seed;
    settings.environment = &growing->environment;
    return fr_lmodel_derive(definition->lsystem, &settings, context, derivation);
}

FrStatus fr_growing_add(FrGrowing *growing, FrScene *scene, const FrPlantDef *definition,
                        int64_t seed, const FrStand *stand, const FrContext *context) {
    FrLderivation *derivation;
    FrStatus status = fr_growing_derive(growing, definition, seed, context, &derivation);
    if (status != FR_OK) {
        return status;
    }
    FrSprout *sprout = g_new0(FrSprout, 1);
    *sprout = (FrSprout){.definition = definition,
                         .id = g_strdup(definition->id),
                         .derivation = derivation,
                         .stand = *stand,
                         .plant = scene->plants->len,
                         .seed = seed,
                         .answers = fr_answers_new()};
    g_ptr_array_add(growing->sprouts, sprout);
    FrScenePlant made = {.plant = fr_plant_new(definition->id)};
    FrStand stands = *stand;
    stands.plant = sprout->plant;
    g_array_append_val(scene->plants, made);
    g_array_append_val(scene->stands, stands);
    return FR_OK;
}

// ---- steps ------------------------------------------------------------------------------------

static bool is_growing(const FrGrowing *growing, const FrSprout *sprout) {
    uint64_t length = MIN(fr_lderivation_length(sprout->derivation), growing->steps);
    return fr_lderivation_step(sprout->derivation) < length &&
           !fr_lderivation_is_stopped(sprout->derivation);
}

/// Draws a plant as it is now, if that has not been done.
static FrStatus draw_ahead(FrSprout *sprout, const FrContext *context) {
    if (sprout->ahead != NULL) {
        return FR_OK;
    }
    FrStatus status =
        fr_lderivation_look(sprout->derivation, context, &sprout->ahead, &sprout->drawn);
    if (status == FR_OK) {
        g_free(sprout->ahead->name);
        sprout->ahead->name = g_strdup(sprout->id);
    }
    return status;
}

FrStatus fr_growing_draw(FrGrowing *growing, FrScene *scene, const FrContext *context,
                         GPtrArray *old) {
    uint64_t bytes = 0;
    for (guint i = 0; i < scene->plants->len; i++) {
        bytes = fr_count_add(bytes,
                             fr_plant_bytes(g_array_index(scene->plants, FrScenePlant, i).plant));
    }
    FrStatus status = FR_OK;
    for (guint i = 0; i < growing->sprouts->len && status == FR_OK; i++) {
        FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, sprout->plant);
        status = draw_ahead(sprout, context);
        if (status == FR_OK) {
            g_ptr_array_add(old, plant->plant);
            plant->plant = g_steal_pointer(&sprout->ahead);
            plant->drawn = sprout->drawn;
            plant->modules = fr_lstring_count(fr_lderivation_string(sprout->derivation));
            bytes = fr_count_add(bytes, fr_plant_bytes(plant->plant));
            status = fr_limit_check(bytes, context->limits.bytes, "bytes", "the scene",
                                    sprout->definition->span, context->diags);
        }
    }
    return status;
}

/// In both directions.
static void exchange(const FrGrowing *growing, FrScene *scene) {
    for (guint i = 0; i < growing->sprouts->len; i++) {
        FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, sprout->plant);
        FrPlant *shown = plant->plant;
        plant->plant = sprout->ahead;
        sprout->ahead = shown;
    }
}

FrStatus fr_growing_show_ahead(FrGrowing *growing, FrScene *scene, const FrContext *context) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < growing->sprouts->len && status == FR_OK; i++) {
        status = draw_ahead(g_ptr_array_index(growing->sprouts, i), context);
    }
    if (status == FR_OK) {
        exchange(growing, scene);
    }
    return status;
}

void fr_growing_show_again(FrGrowing *growing, FrScene *scene) {
    exchange(growing, scene);
}

static FrStatus ask_all(FrGrowing *growing, const FrContext *context) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < growing->sprouts->len && status == FR_OK; i++) {
        FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        growing->asking = sprout;
        if (is_growing(growing, sprout)) {
            status = fr_lderivation_ask(sprout->derivation, context);
        }
    }
    return status;
}

static FrStatus derive_all(FrGrowing *growing, const FrContext *context) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < growing->sprouts->len && status == FR_OK; i++) {
        FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        growing->asking = sprout;
        if (is_growing(growing, sprout)) {
            g_clear_pointer(&sprout->ahead, fr_plant_free);
            status = fr_lderivation_run(sprout->derivation, 1, context);
        }
    }
    return status;
}

static void note_step(FrGrowing *growing, FrScene *scene, double began, double light) {
    FrSceneStep step = {.step = ++growing->done,
                        .seconds = (double)g_get_monotonic_time() * 1e-6 - began,
                        .light_seconds = light,
                        .queries = growing->queries};
    if (growing->lighting != NULL) {
        step.rays_recast = fr_lighting_stats(growing->lighting).recast;
    }
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, sprout->plant).plant;
        step.nodes += plant->nodes.count;
        step.organs += plant->organs.count;
    }
    scene->light_seconds += light;
    // What grows bud by bud beside them has made the same step already.
    if (scene->steps->len >= step.step) {
        FrSceneStep *told = &g_array_index(scene->steps, FrSceneStep, step.step - 1);
        told->seconds += step.seconds;
        told->light_seconds += light;
        told->nodes += step.nodes;
        told->organs += step.organs;
        told->queries = step.queries;
        told->rays_recast = step.rays_recast;
    } else {
        g_array_append_val(scene->steps, step);
    }
}

/// Shows the first sprout of the definition that is watched.
static FrStatus show(const FrGrowing *growing, bool is_answered) {
    const FrGrowingWatch *watch = &growing->watch;
    for (guint i = 0; watch->see != NULL && i < growing->sprouts->len; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        if (sprout->definition == watch->definition) {
            return watch->see(watch->user, sprout->derivation, is_answered);
        }
    }
    return FR_OK;
}

FrStatus fr_growing_step(FrGrowing *growing, FrScene *scene, const FrContext *context) {
    double began = (double)g_get_monotonic_time() * 1e-6;
    growing->queries = 0;
    GPtrArray *old = g_ptr_array_new();
    FrStatus status = fr_growing_draw(growing, scene, context, old);
    double drawn = (double)g_get_monotonic_time() * 1e-6;
    if (status == FR_OK && growing->lighting != NULL) {
        status = fr_lighting_update(growing->lighting, scene, context);
    }
    if (status == FR_OK && growing->clearance != NULL) {
        status = fr_clearance_update(growing->clearance, scene, context);
    }
    if (status == FR_OK) {
        status = show(growing, false);
    }
    if (status == FR_OK) {
        status = ask_all(growing, context);
    }
    if (growing->lighting != NULL) {
        fr_lighting_forget(growing->lighting);
    }
    if (status == FR_OK) {
        status = show(growing, true);
    }
    double light = (double)g_get_monotonic_time() * 1e-6 - drawn;
    // Until here the light has compared the old plants with the new ones.
    for (guint i = 0; i < old->len; i++) {
        fr_plant_free(g_ptr_array_index(old, i));
    }
    g_ptr_array_unref(old);
    if (status == FR_OK) {
        status = derive_all(growing, context);
    }
    note_step(growing, scene, began, light);
    return status;
}

uint64_t fr_growing_longest(const FrGrowing *growing) {
    uint64_t longest = 0;
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        longest = MAX(longest, MIN(fr_lderivation_length(sprout->derivation), growing->steps));
    }
    return longest;
}

bool fr_growing_has_steps(const FrGrowing *growing) {
    bool has_any = false;
    for (guint i = 0; i < growing->sprouts->len && !has_any; i++) {
        has_any = is_growing(growing, g_ptr_array_index(growing->sprouts, i));
    }
    return has_any;
}

FrStatus fr_growing_finish(FrGrowing *growing, FrScene *scene, const FrContext *context) {
    if (growing->sprouts->len == 0) {
        return FR_OK;
    }
    GPtrArray *old = g_ptr_array_new();
    FrStatus status = fr_growing_draw(growing, scene, context, old);
    for (guint i = 0; i < old->len; i++) {
        fr_plant_free(g_ptr_array_index(old, i));
    }
    g_ptr_array_unref(old);
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, sprout->plant);
        plant->by_component = fr_scene_count_made(plant->plant);
    }
    if (growing->lighting != NULL) {
        scene->light = fr_lighting_stats(growing->lighting);
    }
    return status == FR_OK ? show(growing, false) : status;
}

void fr_growing_detach(FrGrowing *growing, const GPtrArray *plants) {
    if (growing->lighting != NULL) {
        fr_lighting_detach(growing->lighting, plants);
    }
}

bool fr_growing_go_on(FrGrowing *growing, const FrGrowing *next) {
    // Who may make no step has got no room to ask for.
    if (growing->steps == 0 || growing->done > next->steps) {
        return false;
    }
    growing->steps = next->steps;
    fr_growing_detach(growing, NULL);
    return true;
}

bool fr_growing_is_any(const FrGrowing *growing) {
    return growing->sprouts->len > 0;
}

bool fr_growing_asks_space(const FrGrowing *growing) {
    bool asks = false;
    for (guint i = 0; i < growing->sprouts->len && !asks; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        asks = asks_space(sprout->definition);
    }
    return asks;
}

static FrStatus make_room(FrGrowing *growing, const FrScene *scene, uint8_t *is_moving,
                          const FrContext *context) {
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        is_moving[sprout->plant] = 1;
    }
    return fr_growing_asks_space(growing) && growing->steps > 0
               ? fr_clearance_new(scene, is_moving, context, &growing->clearance)
               : FR_OK;
}

FrStatus fr_growing_begin(FrGrowing *growing, const FrScene *scene, uint8_t *is_moving,
                          const FrContext *context) {
    FrStatus status = FR_OK;
    if (growing->sprouts->len > 0 && scene->surroundings->light.is_given) {
        status = fr_lighting_new(scene, context, &growing->lighting);
    }
    return status == FR_OK ? make_room(growing, scene, is_moving, context) : status;
}
