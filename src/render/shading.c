// Sky and ground as the nine numbers that tell what they bring to a matt surface of any direction
// (Ramamoorthi, Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps); lamps
// as points.
#include "frond/shading.h"

#include "render/colour.h"
#include "render/film.h"
#include "render/lamps.h"
#include "render/sky.h"

#include <math.h>

// How bright the mean of a picture usually is, of what a light meter held into the light says: of
// plants in the open, and of rooms, whose walls are light.
#define USUAL_PICTURE 0.6
#define USUAL_ROOM 2.0

// The polynomials of the basis at a direction, without their factors.
static void basis_at(vec3s n, float terms[FR_SHADING_TERMS]) {
    const float values[FR_SHADING_TERMS] = {1,
                                            n.y,
                                            n.z,
                                            n.x,
                                            n.x * n.y,
                                            n.y * n.z,
                                            3 * n.z * n.z - 1,
                                            n.x * n.z,
                                            n.x * n.x - n.y * n.y};
    for (int i = 0; i < FR_SHADING_TERMS; i++) {
        terms[i] = values[i];
    }
}

vec3s fr_shading_sky(const FrShading *shading, vec3s normal) {
    float terms[FR_SHADING_TERMS];
    vec3s sum = glms_vec3_zero();
    basis_at(normal, terms);
    for (int i = 0; i < FR_SHADING_TERMS; i++) {
        sum = glms_vec3_muladds(shading->sky[i], terms[i], sum);
    }
    return glms_vec3_maxv(sum, glms_vec3_zero());
}

// The basis is orthonormal with these factors squared, π stripped; a matt surface averages the
// bands of degree 0, 1 and 2 by 1, 2/3 and 1/4 of π.
static void gather(const FrSky *sky, vec3s ground, vec3s out[FR_SHADING_TERMS]) {
    static const double factors[FR_SHADING_TERMS] = {
        1 / (4 * G_PI),      0.5 / G_PI,        0.5 / G_PI,
        0.5 / G_PI,          3.75 / (4 * G_PI), 3.75 / (4 * G_PI),
        0.3125 / (4 * G_PI), 3.75 / (4 * G_PI), 0.9375 / (4 * G_PI)};
    double sums[FR_SHADING_TERMS][3] = {{0}};
    for (uint32_t row = 0; row < sky->rows; row++) {
        float z = 2 * ((float)row + 0.5f) / (float)sky->rows - 1;
        float side = sqrtf(1 - z * z);
        for (uint32_t column = 0; column < sky->columns; column++) {
            float turn = 2 * FR_PI_F * ((float)column + 0.5f) / (float)sky->columns;
            float terms[FR_SHADING_TERMS];
            basis_at((vec3s){{side * cosf(turn), side * sinf(turn), z}}, terms);
            vec3s light = sky->radiance[(size_t)row * sky->columns + column];
            light = z < 0 ? glms_vec3_add(light, ground) : light;
            for (int i = 0; i < 3 * FR_SHADING_TERMS; i++) {
                sums[i / 3][i % 3] += (double)(light.raw[i % 3] * terms[i / 3]);
            }
        }
    }
    double cell = 4 * G_PI / ((double)sky->columns * sky->rows);
    for (int i = 0; i < 3 * FR_SHADING_TERMS; i++) {
        out[i / 3].raw[i % 3] = (float)(sums[i / 3][i % 3] * factors[i / 3] * cell);
    }
}

static FrShadingLamp point_of(const FrShiningLamp *lamp) {
    FrShadingLamp point = {.at = lamp->at,
                           .axis = lamp->axis,
                           .intensity = glms_vec3_scale(lamp->radiance, lamp->area / FR_PI_F),
                           .cosine = lamp->cosine,
                           .near = lamp->radius,
                           .is_area = lamp->is_area};
    if (lamp->is_area) {
        point.at = glms_vec3_muladds(lamp->side[0], 0.5f, point.at);
        point.at = glms_vec3_muladds(lamp->side[1], 0.5f, point.at);
        point.cosine = -1;
        point.near = 0.5f * sqrtf(lamp->area);
    }
    return point;
}

static float brightness_at(const FrShadingLamp *lamp, vec3s place) {
    return fr_luminance(lamp->intensity) / fmaxf(glms_vec3_distance2(lamp->at, place), 1e-6f);
}

// Keeps the brightest; each falls into its place among those kept.
static void choose_lamps(FrShading *shading, const FrLampSet *set, vec3s middle) {
    for (uint32_t i = 0; i < set->count; i++) {
        FrShadingLamp lamp = point_of(&set->lamps[i]);
        float brightness = brightness_at(&lamp, middle);
        uint32_t at = shading->lamp_count;
        while (at > 0 && brightness > brightness_at(&shading->lamps[at - 1], middle)) {
            if (at < FR_SHADING_LAMPS) {
                shading->lamps[at] = shading->lamps[at - 1];
            }
            at--;
        }
        if (at < FR_SHADING_LAMPS) {
            shading->lamps[at] = lamp;
            shading->lamp_count = MIN(shading->lamp_count + 1, FR_SHADING_LAMPS);
        }
    }
}

// What falls onto white ground.
typedef struct Falling {
    vec3s sky, lamps;
} Falling;

static void expose(FrShading *shading, const Falling *light, bool is_room, double stops) {
    vec3s white = glms_vec3_add(light->sky, light->lamps);
    float level = fr_luminance(white) / FR_PI_F;
    float lamps = is_room ? fr_luminance(light->lamps) : 0;
    double room = (double)(lamps / fmaxf(fr_luminance(white), 1e-12f));
    double usual = USUAL_PICTURE + (USUAL_ROOM - USUAL_PICTURE) * room;
    double picture = usual * 0.18 * (double)level;
    float exposure = fr_film_exposure_of(picture, level) * (float)exp2(stops);
    vec3s factor = glms_vec3_scale(fr_film_balance(white), exposure);
    shading->sun = glms_vec3_mul(shading->sun, factor);
    for (int i = 0; i < FR_SHADING_TERMS; i++) {
        shading->sky[i] = glms_vec3_mul(shading->sky[i], factor);
    }
    for (uint32_t i = 0; i < shading->lamp_count; i++) {
        shading->lamps[i].intensity = glms_vec3_mul(shading->lamps[i].intensity, factor);
    }
}

// What lamps bring to white ground that lies in the middle of what they light, as far from them as
// its edge at least.
static vec3s brought_by(const FrLampSet *set, vec3s middle, float radius) {
    vec3s sum = glms_vec3_zero();
    for (uint32_t i = 0; i < set->count; i++) {
        FrShadingLamp lamp = point_of(&set->lamps[i]);
        float square = fmaxf(glms_vec3_distance2(lamp.at, middle), radius * radius);
        sum = glms_vec3_muladds(lamp.intensity, FR_PI_F / fmaxf(square, 1e-6f), sum);
    }
    return sum;
}

static FrShading shading_by(const FrScene *scene, const FrSceneParams *params,
                            const FrLampSet *lamps, const FrContext *context, Falling *light) {
    double min[3], max[3];
    vec3s size, middle;
    fr_scene_bounds(scene, min, max);
    for (int i = 0; i < 3; i++) {
        bool is_empty = !(max[i] >= min[i]);
        size.raw[i] = is_empty ? 0 : (float)(max[i] - min[i]);
        middle.raw[i] = is_empty ? 0 : (float)(0.5 * (min[i] + max[i]));
    }
    FrSky *sky = fr_sky_new_coarse(params, params->ground, context);
    FrShading shading = {.to_sun = sky->sun_direction};
    vec3s ground = glms_vec3_zero();
    *light = (Falling){.sky = sky->flat_irradiance};
    light->lamps = scene->obstacles > 0 ? fr_lamps_light(lamps, size)
                                        : brought_by(lamps, middle, 0.5f * glms_vec3_norm(size));
    if (params->ground) {
        ground = glms_vec3_mul(fr_srgb_decode3(params->ground_colour),
                               glms_vec3_scale(sky->flat_irradiance, 1 / FR_PI_F));
    }
    gather(sky, ground, shading.sky);
    if (scene->obstacles > 0) { // walls throw its light to and fro
        vec3s thrown = glms_vec3_scale(light->lamps, 0.5f / FR_PI_F);
        shading.sky[0] = glms_vec3_add(shading.sky[0], thrown);
    }
    bool is_up = sky->sun_direction.z > 0;
    shading.sun = glms_vec3_scale(sky->sun_irradiance, is_up ? 1 / FR_PI_F : 0);
    choose_lamps(&shading, lamps, middle);
    fr_sky_free(sky);
    return shading;
}

FrShading fr_shading_of(const FrScene *scene, const FrContext *context) {
    static const double nowhere[3] = {0};
    FrLampSet lamps = fr_lamps_new(scene->surroundings, nowhere);
    Falling light;
    FrSceneParams params = *scene->params; // its texts stay the scene's
    FrShading shading = shading_by(scene, &params, &lamps, context, &light);
    if (fr_is_black(light.sky) && fr_is_black(light.lamps)) {
        params.sun_strength = params.sky_strength = 1;
        params.sun_elevation = fmax(params.sun_elevation, 0.5);
        shading = shading_by(scene, &params, &lamps, context, &light);
    }
    expose(&shading, &light, scene->obstacles > 0, params.exposure);
    fr_lamps_clear(&lamps);
    return shading;
}

FrDigest fr_shading_digest(const FrScene *scene) {
    const FrParamTable *table = fr_scene_table();
    FrDigest digest = fr_digest(0, &scene->obstacles, sizeof scene->obstacles);
    for (size_t i = 0; i < table->count; i++) {
        digest = fr_param_digest(digest, &table->rows[i], scene->params);
    }
    table = fr_lamp_table();
    guint count = scene->surroundings == NULL ? 0 : scene->surroundings->lamps->len;
    for (size_t i = 0; i < count * table->count; i++) {
        digest = fr_param_digest(digest, &table->rows[i % table->count],
                                 g_ptr_array_index(scene->surroundings->lamps, i / table->count));
    }
    return digest;
}
