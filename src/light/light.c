// The one question about light, handed to the backend that was made, and the reference.
#include "frond/light.h"

#include "light/backend.h"

void fr_light_free(FrLight *light) {
    if (light != NULL) {
        light->backend->free(light);
    }
}

static FrStatus find_reference(FrLight *light, const FrLightScene *scene,
                               const FrContext *context) {
    light->reference = 1.0f;
    if (!scene->has_reference) {
        return FR_OK;
    }
    FrLightAnswer answer;
    FrStatus status = light->backend->query(light, &scene->reference, 1, context, &answer);
    if (status != FR_OK) {
        return status;
    }
    if (!(answer.intensity > 0.0f)) {
        fr_diags_add(context->diags, FR_ERROR, "dark-reference", scene->span,
                     "no light reaches the reference at %g, %g, %g, so nothing can be told "
                     "relative to it",
                     (double)scene->reference.x, (double)scene->reference.y,
                     (double)scene->reference.z);
        return FR_ERR_DOCUMENT;
    }
    light->reference = answer.intensity;
    return FR_OK;
}

FrStatus fr_light_set_scene(FrLight *light, const FrLightScene *scene, const FrContext *context) {
    light->has_scene = false;
    FrStatus status = light->backend->set_scene(light, scene, context);
    if (status == FR_OK) {
        status = find_reference(light, scene, context);
    }
    light->has_scene = status == FR_OK;
    return status;
}

FrStatus fr_light_query(FrLight *light, const vec3s *points, size_t count, const FrContext *context,
                        FrLightAnswer *answers) {
    FR_ASSERT(light->has_scene);
    FrStatus status = light->backend->query(light, points, count, context, answers);
    for (size_t i = 0; i < count && status == FR_OK; i++) {
        answers[i].intensity /= light->reference;
    }
    return status;
}

void fr_light_forget(FrLight *light) {
    if (light->backend->forget != NULL) {
        light->backend->forget(light);
    }
}

const double *fr_light_absorbed(const FrLight *light, uint32_t stand) {
    return light->has_scene && light->backend->absorbed != NULL
               ? light->backend->absorbed(light, stand)
               : NULL;
}

FrLightStats fr_light_stats(const FrLight *light) {
    FrLightStats stats = {0};
    light->backend->stats(light, &stats);
    return stats;
}

GArray *fr_light_rays(const FrLight *light, uint32_t most) {
    GArray *rays = g_array_new(FALSE, FALSE, sizeof(FrLightRay));
    if (light->has_scene && light->backend->rays != NULL) {
        light->backend->rays(light, most, rays);
    }
    return rays;
}

GArray *fr_light_cells(const FrLight *light, uint32_t most) {
    GArray *cells = g_array_new(FALSE, FALSE, sizeof(FrLightCell));
    if (light->has_scene && light->backend->cells != NULL) {
        light->backend->cells(light, most, cells);
    }
    return cells;
}
