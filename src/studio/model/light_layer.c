#include "studio/model/light_layer.h"

#include "frond/lighting.h"
#include "frond/render.h"
#include "studio/model/growth_marks.h"
#include "studio/model/light_marks.h"

#include <string.h>

enum { MOST_CELLS = 3000, MOST_ORGANS = 40000, POINTS = 14, CELL_POINTS = 6 };

struct StudioLightLayer {
    StudioWake wake;
    void *user;
    GMutex lock;
    // Under the lock:
    StudioLightWish wish;
    StudioSight *sight; // to be taken; NULL: none
    // Of the builder's thread alone:
    FrLighting *lighting; // of what stands; NULL: not made yet
};

StudioLightLayer *studio_light_layer_new(StudioWake wake, void *user) {
    StudioLightLayer *layer = g_new0(StudioLightLayer, 1);
    layer->wake = wake;
    layer->user = user;
    g_mutex_init(&layer->lock);
    return layer;
}

void studio_light_layer_free(StudioLightLayer *layer) {
    if (layer != NULL) {
        fr_lighting_free(layer->lighting);
        studio_sight_free(layer->sight);
        g_mutex_clear(&layer->lock);
        g_free(layer);
    }
}

void studio_sight_free(StudioSight *sight) {
    if (sight != NULL) {
        for (int i = 0; i < STUDIO_SIGHT_COUNT; i++) {
            studio_overlay_free(sight->layers[i]);
        }
        g_free(sight->problem);
        g_free(sight);
    }
}

const char *studio_sight_name(StudioSightLayer layer) {
    static const char *const names[] = {"field", "cells", "rays", "voxels", "particles", "buds"};
    return names[layer];
}

void studio_light_layer_set(StudioLightLayer *layer, const StudioLightWish *wish) {
    g_mutex_lock(&layer->lock);
    layer->wish = *wish;
    g_mutex_unlock(&layer->lock);
}

StudioSight *studio_light_layer_take(StudioLightLayer *layer) {
    g_mutex_lock(&layer->lock);
    StudioSight *sight = g_steal_pointer(&layer->sight);
    g_mutex_unlock(&layer->lock);
    return sight;
}

// ---- light -------------------------------------------------------------------------------------

// The light of what stands, made when it is asked for first.
static FrStatus make_lighting(StudioLightLayer *layer, const FrScene *scene,
                              const FrContext *context) {
    if (layer->lighting != NULL) {
        return FR_OK;
    }
    FrStatus status = fr_lighting_new(scene, context, &layer->lighting);
    if (status == FR_OK) {
        status = fr_lighting_update(layer->lighting, scene, context);
    }
    if (status != FR_OK) {
        g_clear_pointer(&layer->lighting, fr_lighting_free);
    }
    return status;
}

// So many of the places that are left are no fewer than needed to see the light.
static void thin_out(GArray *places) {
    guint step = places->len / MOST_ORGANS + 1;
    for (guint i = 0; step > 1 && i * step < places->len; i++) {
        g_array_index(places, vec3s, i) = g_array_index(places, vec3s, i * step);
    }
    g_array_set_size(places, (places->len + step - 1) / step);
}

static FrStatus see_points(StudioLightLayer *layer, const FrScene *scene, FrLightAt where,
                           uint32_t count, const FrContext *context, StudioSight *sight) {
    FrLightPlaces places;
    FrStatus status = fr_light_places(scene, where, count, context, &places);
    if (status != FR_OK) {
        return status;
    }
    thin_out(places.at);
    FrLightAnswer *answers = g_new0(FrLightAnswer, places.at->len + 1);
    status = fr_lighting_query(layer->lighting, (const vec3s *)(void *)places.at->data,
                               places.at->len, context, answers);
    if (status == FR_OK && sight != NULL) {
        sight->layers[STUDIO_SIGHT_FIELD] =
            studio_light_points(scene, &places, answers, &sight->top);
    }
    g_array_unref(places.at);
    g_free(answers);
    return status;
}

static FrStatus see_slice(StudioLightLayer *layer, const FrScene *scene,
                          const StudioLightWish *wish, const FrContext *context,
                          StudioSight *sight) {
    StudioSlice slice = studio_slice_of(scene, (int)wish->field - STUDIO_FIELD_X, wish->slice);
    GArray *places = studio_slice_places(&slice);
    FrLightAnswer *answers = g_new0(FrLightAnswer, places->len + 1);
    FrStatus status = fr_lighting_query(layer->lighting, (const vec3s *)(void *)places->data,
                                        places->len, context, answers);
    if (status == FR_OK) {
        sight->slice_at = slice.at;
        sight->layers[STUDIO_SIGHT_FIELD] =
            studio_slice_marks(scene, &slice, places, answers, &sight->top);
    }
    g_array_unref(places);
    g_free(answers);
    return status;
}

static FrStatus see_field(StudioLightLayer *layer, const FrScene *scene,
                          const StudioLightWish *wish, const FrContext *context,
                          StudioSight *sight) {
    switch (wish->field) {
    case STUDIO_FIELD_X:
    case STUDIO_FIELD_Y:
    case STUDIO_FIELD_Z:
        return see_slice(layer, scene, wish, context, sight);
    case STUDIO_FIELD_POINTS:
        return see_points(layer, scene, FR_LIGHT_AT_GRID, POINTS, context, sight);
    case STUDIO_FIELD_ORGANS:
        return see_points(layer, scene, FR_LIGHT_AT_ORGANS, 1, context, sight);
    default: // cells are made where light is asked for
        return wish->cells ? see_points(layer, scene, FR_LIGHT_AT_GRID, CELL_POINTS, context, NULL)
                           : FR_OK;
    }
}

static void see_light(StudioLightLayer *layer, const FrScene *scene, const StudioLightWish *wish,
                      const FrContext *context, StudioSight *sight) {
    const FrLightParams *params = &scene->surroundings->light;
    sight->has_rays = params->by == FR_LIGHT_BY_DENSITY;
    bool is_seen =
        wish->field != STUDIO_FIELD_NONE || (sight->has_rays && (wish->rays || wish->cells));
    FrStatus status = is_seen ? make_lighting(layer, scene, context) : FR_OK;
    if (!is_seen || status != FR_OK) {
        return;
    }
    fr_lighting_forget(layer->lighting);
    status = see_field(layer, scene, wish, context, sight);
    if (status == FR_OK) {
        status = fr_lighting_query(layer->lighting, &params->reference, 1, context, &sight->probe);
        sight->has_probe = status == FR_OK;
    }
    if (status == FR_OK && wish->rays) {
        GArray *rays = fr_lighting_rays(layer->lighting, wish->photons);
        sight->layers[STUDIO_SIGHT_RAYS] = studio_ray_marks(rays);
        g_array_unref(rays);
    }
    if (status == FR_OK && wish->cells) {
        GArray *cells = fr_lighting_cells(layer->lighting, MOST_CELLS);
        sight->layers[STUDIO_SIGHT_CELLS] = studio_cell_marks(cells);
        g_array_unref(cells);
    }
    sight->stats = fr_lighting_stats(layer->lighting);
}

// ---- looking -----------------------------------------------------------------------------------

static void see_growth(const FrGrowth *growth, double apart, const StudioLightWish *wish,
                       StudioSight *sight) {
    sight->has_growth = growth != NULL;
    if (growth != NULL && wish->buds) {
        sight->layers[STUDIO_SIGHT_BUDS] = studio_bud_marks(growth, apart);
    }
    if (growth != NULL && wish->voxels) {
        sight->layers[STUDIO_SIGHT_VOXELS] = studio_voxel_marks(growth, apart);
    }
    if (growth != NULL && wish->particles) {
        sight->layers[STUDIO_SIGHT_PARTICLES] = studio_particle_marks(growth, apart);
    }
}

void studio_light_layer_look(void *user, const StudioSeen *seen, const FrContext *context) {
    StudioLightLayer *layer = user;
    if (seen == NULL) { // what stands is about to change
        g_clear_pointer(&layer->lighting, fr_lighting_free);
        return;
    }
    g_mutex_lock(&layer->lock);
    StudioLightWish wish = layer->wish;
    g_mutex_unlock(&layer->lock);
    StudioSight *sight = g_new0(StudioSight, 1);
    FrContext own = *context;
    own.diags = fr_diags_new();
    if (seen->scene->surroundings != NULL) {
        see_light(layer, seen->scene, &wish, &own, sight);
    }
    see_growth(seen->growth, seen->scene->params->apart, &wish, sight);
    for (size_t i = 0; i < fr_diags_count(own.diags) && sight->problem == NULL; i++) {
        const FrDiag *diag = fr_diags_get(own.diags, i);
        sight->problem = diag->severity == FR_ERROR ? g_strdup(diag->text) : NULL;
    }
    fr_diags_free(own.diags);
    if (fr_progress_is_cancelled(context->progress)) {
        studio_sight_free(sight); // it will be looked at again
        return;
    }
    g_mutex_lock(&layer->lock);
    studio_sight_free(layer->sight);
    layer->sight = sight;
    g_mutex_unlock(&layer->lock);
    layer->wake(layer->user);
}
