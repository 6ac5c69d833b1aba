/// A scene as light sees it. Stems and leaves are meshed coarsely, for light alone; pictures of
/// materials count by their mean colour, and their transparent pixels are holes.
#include "frond/lighting.h"

#include "frond/daylight.h"
#include "frond/light_density.h"
#include "frond/shadows.h"
#include "frond/sky_views.h"
#include "scene/optics.h"

#include <cglm/struct.h>
#include <math.h>

// Suns and skies tell light in kW/m², lamps in W.
#define KILO 1000.0
// Plants may grow so far beyond where they stand without changing what suns shine on, in metres;
// beyond that it is widened by as much or by half its width, as all photons start anew then.
#define ROOM_TO_GROW 3.0

/// A plant as a mesh.
typedef struct Meshed {
    const FrPlant *plant; ///< only to be compared; NULL: none
    FrMesh *mesh;
    FrLightMaterial *materials;
} Meshed;

struct FrLighting {
    FrLight *light;
    FrOpticsTable *optics;
    GArray *lamps;  ///< FrLamp
    GArray *meshed; ///< Meshed, by plant of the scene
    vec3s min, max; ///< what suns shine on
    const FrLightParams *params;
};

static void clear_meshed(void *data) {
    Meshed *meshed = data;
    fr_mesh_free(meshed->mesh);
    g_free(meshed->materials);
}

// ---- what shines ------------------------------------------------------------------------------

static void add_daylight(FrLighting *lighting, const FrScene *scene) {
    const FrSceneParams *params = scene->params;
    const FrSunParams *sun = &scene->surroundings->sun;
    if (params->sun_strength <= 0 && params->sky_strength <= 0) {
        return;
    }
    size_t count = (size_t)lighting->params->suns;
    FrLamp *lamps = g_new(FrLamp, 2 * count + 1);
    FrSkyKind sky = params->sky == FR_SCENE_SKY_AIR
                        ? FR_SKY_CLEAR
                        : (FrSkyKind)(params->sky - FR_SCENE_SKY_UNIFORM);
    FrSunPath path = fr_light_sun_path(sun->latitude, params->sun_azimuth, params->sun_elevation);
    size_t written = fr_light_day(sky, path, count, KILO * params->sun_strength,
                                  KILO * params->sky_strength, lamps);
    g_array_append_vals(lighting->lamps, lamps, (guint)written);
    g_free(lamps);
}

static void add_lamps(FrLighting *lighting, const FrScene *scene) {
    const GPtrArray *lamps = scene->surroundings->lamps;
    for (guint i = 0; i < lamps->len; i++) {
        FrLamp lamp = fr_scene_lamp(g_ptr_array_index(lamps, i));
        g_array_append_val(lighting->lamps, lamp);
    }
}

static void find_room(FrLighting *lighting, const FrScene *scene) {
    double min[3], max[3];
    fr_scene_bounds(scene, min, max);
    for (guint i = 0; i < scene->stands->len; i++) {
        const double *at = g_array_index(scene->stands, FrStand, i).at;
        for (int axis = 0; axis < 3; axis++) {
            min[axis] = fmin(min[axis], at[axis] - ROOM_TO_GROW);
            max[axis] = fmax(max[axis], at[axis] + ROOM_TO_GROW);
        }
    }
    lighting->min = (vec3s){{(float)min[0], (float)min[1], (float)min[2]}};
    lighting->max = (vec3s){{(float)max[0], (float)max[1], (float)max[2]}};
}

/// Widens what suns and skies shine on where plants have grown out of it.
static void widen_room(FrLighting *lighting, const FrScene *scene) {
    double min[3], max[3];
    fr_scene_bounds(scene, min, max);
    fr_lighting_widen(lighting, scene, min, max);
}

static FrLight *new_views(const FrLightParams *params) {
    FrSkyViewSettings settings = {.count = params->views,
                                  .is_even = params->even,
                                  .is_mean = params->towards == FR_LIGHT_TOWARDS_MEAN,
                                  .near = (float)params->near};
    return fr_sky_views_new(&settings);
}

static FrLight *new_shadows(const FrLightParams *params) {
    FrShadowLightSettings settings = fr_shadow_light_default();
    settings.cell = params->cell;
    settings.span = params->span;
    return fr_shadow_light_new(&settings);
}

static FrStatus new_light(const FrLightParams *params, const FrContext *context, FrLight **light) {
    if (params->by != FR_LIGHT_BY_DENSITY) {
        *light = params->by == FR_LIGHT_BY_SHADOWS ? new_shadows(params) : new_views(params);
        return FR_OK;
    }
    FrDensityParams density = {.photons = params->photons,
                               .distance = params->distance,
                               .estimator = params->estimator,
                               .neighbours = params->neighbours,
                               .bounces = params->bounces,
                               .seed = params->seed,
                               .span = params->photons_place};
    return fr_light_density_new(&density, context, light);
}

FrStatus fr_lighting_new(const FrScene *scene, const FrContext *context, FrLighting **lighting) {
    const FrLightParams *params = &scene->surroundings->light;
    FrLighting *made = g_new0(FrLighting, 1);
    made->params = params;
    made->optics = fr_optics_new();
    made->lamps = g_array_new(FALSE, FALSE, sizeof(FrLamp));
    made->meshed = g_array_new(FALSE, TRUE, sizeof(Meshed));
    g_array_set_clear_func(made->meshed, clear_meshed);
    add_daylight(made, scene);
    add_lamps(made, scene);
    find_room(made, scene);
    FrStatus status = new_light(params, context, &made->light);
    if (status != FR_OK) {
        fr_lighting_free(made);
        made = NULL;
    }
    *lighting = made;
    return status;
}

void fr_lighting_free(FrLighting *lighting) {
    if (lighting == NULL) {
        return;
    }
    fr_light_free(lighting->light);
    g_array_unref(lighting->meshed);
    g_array_unref(lighting->lamps);
    fr_optics_free(lighting->optics);
    g_free(lighting);
}

// ---- what stands in the way -------------------------------------------------------------------

static FrStatus mesh_plant(FrLighting *lighting, const FrPlant *plant, const FrContext *context,
                           Meshed *meshed) {
    FrSkinParams skin = fr_skin_default();
    skin.lod = 1;
    skin.collar = 0;
    FrStatus status = fr_skin_plant(plant, &skin, FR_UP_Z, context, &meshed->mesh);
    if (status != FR_OK) {
        return status;
    }
    meshed->plant = plant;
    meshed->materials = g_new0(FrLightMaterial, meshed->mesh->part_count + 1);
    for (uint32_t i = 0; i < meshed->mesh->part_count && status == FR_OK; i++) {
        const FrMeshPart *part = &meshed->mesh->parts[i];
        FrMaterial *material =
            part->material == FR_NONE ? NULL : g_ptr_array_index(plant->materials, part->material);
        status = fr_optics_of(lighting->optics, material, part->is_foliage, context,
                              &meshed->materials[i]);
    }
    return status;
}

/// Meshes of the scene's plants; those that stayed are moved out of the old ones.
static FrStatus mesh_all(FrLighting *lighting, const FrScene *scene, const FrContext *context,
                         GArray *meshed) {
    FrStatus status = FR_OK;
    g_array_set_size(meshed, scene->plants->len);
    for (guint i = 0; i < scene->plants->len && status == FR_OK; i++) {
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        Meshed *now = &g_array_index(meshed, Meshed, i);
        Meshed *old =
            i < lighting->meshed->len ? &g_array_index(lighting->meshed, Meshed, i) : NULL;
        if (plant != NULL && old != NULL && old->plant == plant) {
            *now = *old;
            *old = (Meshed){0};
        } else if (plant != NULL) {
            status = mesh_plant(lighting, plant, context, now);
        }
    }
    return status;
}

static mat4s transform_of(const FrStand *stand) {
    vec3s at = {{(float)stand->at[0], (float)stand->at[1], (float)stand->at[2]}};
    mat4s transform = glms_translate(glms_mat4_identity(), at);
    transform = glms_rotate(transform, (float)stand->turn, (vec3s){{0, 0, 1}});
    return glms_scale_uni(transform, (float)stand->scale);
}

static FrStatus set_scene(FrLighting *lighting, const FrScene *scene, const GArray *meshed,
                          const FrContext *context) {
    FrLightMesh *meshes = g_new0(FrLightMesh, meshed->len + 1);
    uint32_t *mesh_of = g_new(uint32_t, meshed->len + 1);
    FrLightStand *stands = g_new0(FrLightStand, scene->stands->len + 1);
    FrLightScene lit = {.meshes = meshes,
                        .stands = stands,
                        .lamps = (const FrLamp *)(const void *)lighting->lamps->data,
                        .lamp_count = lighting->lamps->len,
                        .mask = fr_optics_is_hole,
                        .mask_user = lighting->optics,
                        .min = lighting->min,
                        .max = lighting->max,
                        .has_reference = lighting->params->relative,
                        .reference = lighting->params->reference,
                        .span = lighting->params->reference_place};
    for (guint i = 0; i < meshed->len; i++) {
        const Meshed *from = &g_array_index(meshed, Meshed, i);
        mesh_of[i] = from->mesh == NULL ? FR_NONE : lit.mesh_count;
        if (from->mesh != NULL) {
            meshes[lit.mesh_count++] =
                (FrLightMesh){.mesh = from->mesh, .materials = from->materials};
        }
    }
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        if (mesh_of[stand->plant] != FR_NONE) {
            stands[lit.stand_count++] =
                (FrLightStand){.mesh = mesh_of[stand->plant], .transform = transform_of(stand)};
        }
    }
    FrStatus status = fr_light_set_scene(lighting->light, &lit, context);
    g_free(meshes);
    g_free(mesh_of);
    g_free(stands);
    return status;
}

void fr_lighting_widen(FrLighting *lighting, const FrScene *scene, const double min[3],
                       const double max[3]) {
    if (scene->params->sun_strength <= 0 && scene->params->sky_strength <= 0) {
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        float *low = &lighting->min.raw[axis], *high = &lighting->max.raw[axis];
        double more = fmax(ROOM_TO_GROW, 0.5 * (double)(*high - *low));
        *low = min[axis] < (double)*low ? (float)(min[axis] - more) : *low;
        *high = max[axis] > (double)*high ? (float)(max[axis] + more) : *high;
    }
}

FrStatus fr_lighting_update(FrLighting *lighting, const FrScene *scene, const FrContext *context) {
    GArray *meshed = g_array_new(FALSE, TRUE, sizeof(Meshed));
    g_array_set_clear_func(meshed, clear_meshed);
    widen_room(lighting, scene);
    FrStatus status = mesh_all(lighting, scene, context, meshed);
    if (status == FR_OK) {
        status = set_scene(lighting, scene, meshed, context);
    }
    // The light has read the old meshes until now.
    g_array_unref(lighting->meshed);
    lighting->meshed = meshed;
    return status;
}

void fr_lighting_detach(FrLighting *lighting, const GPtrArray *plants) {
    GHashTable *freed = g_hash_table_new(NULL, NULL);
    for (guint i = 0; plants != NULL && i < plants->len; i++) {
        g_hash_table_add(freed, g_ptr_array_index(plants, i));
    }
    for (guint i = 0; i < lighting->meshed->len; i++) {
        Meshed *meshed = &g_array_index(lighting->meshed, Meshed, i);
        if (plants == NULL || g_hash_table_contains(freed, meshed->plant)) {
            meshed->plant = NULL;
        }
    }
    g_hash_table_unref(freed);
}

void fr_lighting_room(const FrLighting *lighting, vec3s room[2]) {
    room[0] = lighting->min;
    room[1] = lighting->max;
}

void fr_lighting_set_room(FrLighting *lighting, const vec3s room[2]) {
    lighting->min = room[0];
    lighting->max = room[1];
}

FrStatus fr_lighting_query(FrLighting *lighting, const vec3s *points, size_t count,
                           const FrContext *context, FrLightAnswer *answers) {
    return fr_light_query(lighting->light, points, count, context, answers);
}

FrStatus fr_lighting_field(FrLighting *lighting, const FrLightPlace *place, vec3s min, vec3s max,
                           uint32_t cells, const FrContext *context, FrLightField **field) {
    return fr_light_field_new(lighting->light, place, min, max, cells, context, field);
}

GArray *fr_lighting_rays(const FrLighting *lighting, uint32_t most) {
    return fr_light_rays(lighting->light, most);
}

GArray *fr_lighting_cells(const FrLighting *lighting, uint32_t most) {
    return fr_light_cells(lighting->light, most);
}

void fr_lighting_forget(FrLighting *lighting) {
    fr_light_forget(lighting->light);
}

FrLightStats fr_lighting_stats(const FrLighting *lighting) {
    return fr_light_stats(lighting->light);
}
