/// A plant that is drawn to the light of its scene is built twice: as it grows under open sky, to
/// know where it reaches to, and then with the directions to the light sampled around there. It is
/// not shaded by itself.
#include "scene/sampled.h"

#include "scene/grow.h"

#include <cglm/struct.h>

enum { CELLS = 16 }; // of the grid along the longest side

// How far around the plain plant light is sampled, of its size.
#define MARGIN 0.3F

typedef struct Sprout {
    const FrPlantDef *definition;
    int64_t seed;
    double time;
    uint32_t plant; ///< of the scene
    FrStand stand;
} Sprout;

struct FrSampled {
    GArray *sprouts; ///< Sprout
};

bool fr_sampled_is_wanted(const FrScene *scene, const FrPlantDef *definition) {
    return definition->kind == FR_PLANT_PGRAPH && scene->surroundings->light.is_given &&
           fr_pgraph_samples_light(definition->pgraph);
}

FrSampled *fr_sampled_new(void) {
    FrSampled *sampled = g_new0(FrSampled, 1);
    sampled->sprouts = g_array_new(FALSE, FALSE, sizeof(Sprout));
    return sampled;
}

void fr_sampled_free(FrSampled *sampled) {
    g_array_unref(sampled->sprouts);
    g_free(sampled);
}

void fr_sampled_add(FrSampled *sampled, FrScene *scene, const FrPlantDef *definition, int64_t seed,
                    double time, const FrStand *stand) {
    Sprout sprout = {definition, seed, time, scene->plants->len, *stand};
    g_array_append_val(sampled->sprouts, sprout);
    FrScenePlant made = {.plant = fr_plant_new(definition->id)};
    FrStand stands = *stand;
    stands.plant = sprout.plant;
    g_array_append_val(scene->plants, made);
    g_array_append_val(scene->stands, stands);
}

/// The sun shines where the plant will reach to, though it does not stand there yet.
static void light_reach(const FrStand *stand, vec3s min, vec3s max, const FrScene *scene,
                        FrLighting *lighting) {
    vec3s far = glms_vec3_maxv(glms_vec3_abs(min), glms_vec3_abs(max));
    double reach = (double)glms_vec3_norm(far) * stand->scale;
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = stand->at[axis] - reach;
        high[axis] = stand->at[axis] + reach;
    }
    fr_lighting_widen(lighting, scene, low, high);
}

/// The directions to the light around the sprout, and what they cost.
static FrStatus sample_light(const Sprout *sprout, const FrDocument *document, FrScene *scene,
                             FrLighting *lighting, const FrContext *context, FrLightField **field) {
    FrScenePlant plain;
    FrStatus status = fr_scene_grow(document, sprout->definition, sprout->seed, sprout->time,
                                    context, &plain, NULL);
    if (status != FR_OK) {
        return status;
    }
    vec3s min, max;
    fr_plant_bounds(plain.plant, &min, &max);
    fr_plant_free(plain.plant);
    g_free(plain.by_component);
    if (!(min.x <= max.x)) {
        min = max = glms_vec3_zero();
    }
    float margin = MARGIN * glms_vec3_norm(glms_vec3_sub(max, min));
    const double *at = sprout->stand.at;
    FrLightPlace place = {{at[0], at[1], at[2]}, sprout->stand.turn, sprout->stand.scale};
    double began = (double)g_get_monotonic_time() * 1e-6;
    min = glms_vec3_subs(min, margin);
    max = glms_vec3_adds(max, margin);
    light_reach(&sprout->stand, min, max, scene, lighting);
    status = fr_lighting_update(lighting, scene, context);
    if (status == FR_OK) {
        status = fr_lighting_field(lighting, &place, min, max, CELLS, context, field);
        fr_lighting_forget(lighting);
    }
    scene->light_seconds += (double)g_get_monotonic_time() * 1e-6 - began;
    scene->light = fr_lighting_stats(lighting);
    return status;
}

static FrStatus build_one(const Sprout *sprout, const FrDocument *document, FrScene *scene,
                          FrLighting *lighting, const FrContext *context) {
    FrLightField *field = NULL;
    FrStatus status = sample_light(sprout, document, scene, lighting, context, &field);
    FrScenePlant made;
    if (status == FR_OK) {
        status = fr_scene_grow_in_light(document, sprout->definition, sprout->seed, sprout->time,
                                        field, context, &made, NULL);
    }
    if (status == FR_OK) {
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, sprout->plant);
        fr_plant_free(plant->plant);
        *plant = made;
    }
    fr_light_field_free(field);
    return status;
}

FrStatus fr_sampled_build(FrSampled *sampled, const FrDocument *document, FrScene *scene,
                          const FrContext *context) {
    if (sampled->sprouts->len == 0) {
        return FR_OK;
    }
    FrLighting *lighting;
    FrStatus status = fr_lighting_new(scene, context, &lighting);
    for (guint i = 0; i < sampled->sprouts->len && status == FR_OK; i++) {
        const Sprout *sprout = &g_array_index(sampled->sprouts, Sprout, i);
        status = build_one(sprout, document, scene, lighting, context);
    }
    fr_lighting_free(lighting);
    return status;
}
