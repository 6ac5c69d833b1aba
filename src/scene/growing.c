/// The growth loop of Van Haevre, Di Fiore, Bekaert, Van Reeth 2004, Illumination Driven Plant
/// Growth Based on Ray Density Estimation, listing 1, for many plants at once: each step every
/// plant is drawn, the light is brought up to date with all of them, their open symbols are
/// answered, and the productions applied.
#include "scene/growing.h"

#include "scene/grow.h"

#include <cglm/struct.h>

/// One plant.
typedef struct Sprout {
    const FrPlantDef *definition;
    FrLderivation *derivation;
    FrStand stand;
    uint32_t plant; ///< of the scene
} Sprout;

struct FrGrowing {
    GPtrArray *sprouts; ///< Sprout *
    FrLighting *lighting;
    uint64_t steps;   ///< at most
    uint64_t queries; ///< answered in this step
    uint64_t done;    ///< steps
    FrEnvironment environment;
    const Sprout *asking;
    FrGrowingWatch watch;
};

bool fr_growing_is_wanted(const FrScene *scene, const FrPlantDef *definition) {
    return definition->kind == FR_PLANT_LSYSTEM && scene->surroundings->light.is_given &&
           fr_lsystem_is_open(fr_lmodel_system(definition->lsystem));
}

static void free_sprout(void *data) {
    Sprout *sprout = data;
    fr_lderivation_free(sprout->derivation);
    g_free(sprout);
}

void fr_growing_free(FrGrowing *growing) {
    g_ptr_array_unref(growing->sprouts);
    fr_lighting_free(growing->lighting);
    g_free(growing);
}

// ---- answers ----------------------------------------------------------------------------------

/// What asks for light; everything else is the model's own environment's.
static bool is_light(const FrLquery *query) {
    return query->symbol == 'R' || query->symbol == 'I' || query->symbol == 'E';
}

static vec3s turned(vec3s v, double angle) {
    return glms_vec3_rotate(v, (float)angle, (vec3s){{0, 0, 1}});
}

/// `direction` is in the plant's coordinates.
static void answer_light(const FrLquery *query, const FrLightAnswer *light, vec3s direction) {
    if (query->symbol == 'R') {
        fr_lquery_bend(query, direction);
        return;
    }
    const float told[5] = {light->intensity, direction.x, direction.y, direction.z,
                           light->confidence};
    for (unsigned k = 0; k < MIN(query->count, 5); k++) {
        if ((query->asked >> k & 1) != 0) {
            query->parameters[k] = told[k];
        }
    }
}

static FrStatus answer(void *data, const FrLquery *queries, size_t count,
                       const FrContext *context) {
    FrGrowing *growing = data;
    const Sprout *sprout = growing->asking;
    FrLsettings plain = fr_lmodel_settings(sprout->definition->lsystem);
    vec3s *points = g_new(vec3s, count);
    FrLightAnswer *answers = g_new0(FrLightAnswer, count);
    const double *at = sprout->stand.at;
    vec3s origin = {{(float)at[0], (float)at[1], (float)at[2]}};
    size_t lit = 0;
    FrStatus status = FR_OK;
    for (size_t i = 0; i < count && status == FR_OK; i++) {
        if (is_light(&queries[i])) {
            vec3s local = glms_vec3_scale(queries[i].position, (float)sprout->stand.scale);
            points[lit++] = glms_vec3_add(turned(local, sprout->stand.turn), origin);
        } else {
            status = plain.environment->answer(plain.environment->data, &queries[i], 1, context);
        }
    }
    if (status == FR_OK) {
        status = fr_lighting_query(growing->lighting, points, lit, context, answers);
    }
    lit = 0;
    for (size_t i = 0; i < count && status == FR_OK; i++) {
        if (is_light(&queries[i])) {
            vec3s direction = turned(answers[lit].direction, -sprout->stand.turn);
            answer_light(&queries[i], &answers[lit++], direction);
        }
    }
    growing->queries += lit;
    g_free(points);
    g_free(answers);
    return status;
}

FrGrowing *fr_growing_new(uint64_t steps, FrGrowingWatch watch) {
    FrGrowing *growing = g_new0(FrGrowing, 1);
    growing->steps = steps;
    growing->watch = watch;
    growing->sprouts = g_ptr_array_new_with_free_func(free_sprout);
    growing->environment = (FrEnvironment){growing, answer};
    return growing;
}

FrStatus fr_growing_add(FrGrowing *growing, FrScene *scene, const FrPlantDef *definition,
                        int64_t seed, const FrStand *stand, const FrContext *context) {
    FrLsettings settings = fr_lmodel_settings(definition->lsystem);
    settings.seed = seed;
    settings.environment = &growing->environment;
    FrLderivation *derivation;
    FrStatus status = fr_lmodel_derive(definition->lsystem, &settings, context, &derivation);
    if (status != FR_OK) {
        return status;
    }
    Sprout *sprout = g_new0(Sprout, 1);
    *sprout = (Sprout){definition, derivation, *stand, scene->plants->len};
    g_ptr_array_add(growing->sprouts, sprout);
    FrScenePlant made = {.plant = fr_plant_new(definition->id)};
    FrStand stands = *stand;
    stands.plant = sprout->plant;
    g_array_append_val(scene->plants, made);
    g_array_append_val(scene->stands, stands);
    return FR_OK;
}

// ---- steps ------------------------------------------------------------------------------------

static bool is_growing(const FrGrowing *growing, const Sprout *sprout) {
    uint64_t length = MIN(fr_lderivation_length(sprout->derivation), growing->steps);
    return fr_lderivation_step(sprout->derivation) < length &&
           !fr_lderivation_is_stopped(sprout->derivation);
}

/// Draws all plants as they are now; `old` receives those that were there before.
static FrStatus draw_all(FrGrowing *growing, FrScene *scene, const FrContext *context,
                         GPtrArray *old) {
    uint64_t bytes = 0;
    for (guint i = 0; i < scene->plants->len; i++) {
        bytes = fr_count_add(bytes,
                             fr_plant_bytes(g_array_index(scene->plants, FrScenePlant, i).plant));
    }
    FrStatus status = FR_OK;
    for (guint i = 0; i < growing->sprouts->len && status == FR_OK; i++) {
        const Sprout *sprout = g_ptr_array_index(growing->sprouts, i);
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, sprout->plant);
        FrPlant *drawn;
        status = fr_lderivation_draw(sprout->derivation, context, &drawn, &plant->drawn);
        if (status == FR_OK) {
            g_free(drawn->name);
            drawn->name = g_strdup(sprout->definition->id);
            g_ptr_array_add(old, plant->plant);
            plant->plant = drawn;
            plant->modules = fr_lstring_count(fr_lderivation_string(sprout->derivation));
            bytes = fr_count_add(bytes, fr_plant_bytes(drawn));
            status = fr_limit_check(bytes, context->limits.bytes, "bytes", "the scene",
                                    sprout->definition->span, context->diags);
        }
    }
    return status;
}

static FrStatus ask_all(FrGrowing *growing, const FrContext *context) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < growing->sprouts->len && status == FR_OK; i++) {
        Sprout *sprout = g_ptr_array_index(growing->sprouts, i);
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
        Sprout *sprout = g_ptr_array_index(growing->sprouts, i);
        growing->asking = sprout;
        if (is_growing(growing, sprout)) {
            status = fr_lderivation_run(sprout->derivation, 1, context);
        }
    }
    return status;
}

static void note_step(FrGrowing *growing, FrScene *scene, double began, double light) {
    FrSceneStep step = {.step = ++growing->done,
                        .seconds = (double)g_get_monotonic_time() * 1e-6 - began,
                        .light_seconds = light,
                        .queries = growing->queries,
                        .rays_recast = fr_lighting_stats(growing->lighting).recast};
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const Sprout *sprout = g_ptr_array_index(growing->sprouts, i);
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
        const Sprout *sprout = g_ptr_array_index(growing->sprouts, i);
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
    FrStatus status = draw_all(growing, scene, context, old);
    double drawn = (double)g_get_monotonic_time() * 1e-6;
    if (status == FR_OK) {
        status = fr_lighting_update(growing->lighting, scene, context);
    }
    if (status == FR_OK) {
        status = show(growing, false);
    }
    if (status == FR_OK) {
        status = ask_all(growing, context);
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

static bool is_any_growing(const FrGrowing *growing, uint64_t *longest) {
    bool is_any = false;
    *longest = 1;
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const Sprout *sprout = g_ptr_array_index(growing->sprouts, i);
        is_any |= is_growing(growing, sprout);
        *longest = MAX(*longest, fr_lderivation_length(sprout->derivation));
    }
    return is_any;
}

bool fr_growing_has_steps(const FrGrowing *growing) {
    uint64_t longest;
    return is_any_growing(growing, &longest);
}

FrStatus fr_growing_finish(FrGrowing *growing, FrScene *scene, const FrContext *context) {
    if (growing->sprouts->len == 0) {
        return FR_OK;
    }
    GPtrArray *old = g_ptr_array_new();
    FrStatus status = draw_all(growing, scene, context, old);
    for (guint i = 0; i < old->len; i++) {
        fr_plant_free(g_ptr_array_index(old, i));
    }
    g_ptr_array_unref(old);
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const Sprout *sprout = g_ptr_array_index(growing->sprouts, i);
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, sprout->plant);
        plant->by_component = fr_scene_count_made(plant->plant);
    }
    scene->light = fr_lighting_stats(growing->lighting);
    return status == FR_OK ? show(growing, false) : status;
}

bool fr_growing_is_any(const FrGrowing *growing) {
    return growing->sprouts->len > 0;
}

FrStatus fr_growing_begin(FrGrowing *growing, const FrScene *scene, const FrContext *context) {
    return growing->sprouts->len == 0 ? FR_OK : fr_lighting_new(scene, context, &growing->lighting);
}

FrStatus fr_growing_run(FrGrowing *growing, FrScene *scene, const FrContext *context) {
    FrStatus status = FR_OK;
    uint64_t longest;
    while (status == FR_OK && is_any_growing(growing, &longest)) {
        status = fr_growing_step(growing, scene, context);
        fr_progress_report(context->progress, "build", (double)scene->steps->len / (double)longest);
        if (status == FR_OK && fr_progress_is_cancelled(context->progress)) {
            status = FR_CANCELLED;
        }
    }
    return status == FR_OK ? fr_growing_finish(growing, scene, context) : status;
}
