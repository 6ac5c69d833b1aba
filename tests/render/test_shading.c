/// Light for pictures without paths, against the sky that paths see, and formulas.
#include "frond/shading.h"

#include "render/colour.h"
#include "render/film.h"
#include "render/sky.h"

#include <math.h>

#define SOLAR_CONSTANT 1361.0

typedef struct Room {
    FrSceneParams params;
    FrLampParams lamps[10];
    GPtrArray *list;
    FrSurroundings around;
    FrScene scene;
} Room;

static Room *room_new(guint lamp_count) {
    Room *room = g_new0(Room, 1);
    fr_params_init(fr_scene_table(), &room->params);
    room->list = g_ptr_array_new();
    for (guint i = 0; i < lamp_count; i++) {
        fr_params_init(fr_lamp_table(), &room->lamps[i]);
        g_ptr_array_add(room->list, &room->lamps[i]);
    }
    room->around.lamps = room->list;
    room->scene.plants = g_array_new(FALSE, FALSE, sizeof(FrScenePlant));
    room->scene.stands = g_array_new(FALSE, FALSE, sizeof(FrStand));
    room->scene.params = &room->params;
    room->scene.surroundings = &room->around;
    return room;
}

static void room_free(Room *room) {
    for (guint i = 0; i < room->list->len; i++) {
        fr_params_clear(fr_lamp_table(), &room->lamps[i]);
    }
    fr_params_clear(fr_scene_table(), &room->params);
    g_ptr_array_unref(room->list);
    g_array_unref(room->scene.plants);
    g_array_unref(room->scene.stands);
    g_free(room);
}

static FrShading shade(const Room *room) {
    FrContext context = fr_context_default();
    return fr_shading_of(&room->scene, &context);
}

// What it was multiplied by: the exposure and balance of light `white`, for a picture that is so
// bright of what a light meter says.
static vec3s factor_of(vec3s white, double usual) {
    float level = fr_luminance(white) / FR_PI_F;
    float exposure = fr_film_exposure_of(usual * 0.18 * (double)level, level);
    return glms_vec3_scale(fr_film_balance(white), exposure);
}

// The mean of cos⁺ times the radiance over all directions, by brute force.
static vec3s brought(const FrSky *sky, vec3s ground, vec3s normal) {
    enum { STEPS = 200 };
    vec3s sum = glms_vec3_zero();
    for (int i = 0; i < STEPS * STEPS; i++) {
        float z = 2 * ((float)(i / STEPS) + 0.5f) / STEPS - 1, side = sqrtf(1 - z * z);
        float turn = 2 * FR_PI_F * ((float)(i % STEPS) + 0.5f) / STEPS;
        vec3s way = {{side * cosf(turn), side * sinf(turn), z}};
        float cosine = glms_vec3_dot(way, normal);
        if (cosine > 0) {
            vec3s light = z > 0 ? fr_sky_radiance(sky, way) : ground;
            sum = glms_vec3_muladds(light, 4 * cosine / (STEPS * STEPS), sum);
        }
    }
    return sum;
}

static void test_sky(void) {
    Room *room = room_new(0);
    FrContext context = fr_context_default();
    FrShading shading = shade(room);
    FrSky *sky = fr_sky_new(&room->params, true, &context);
    vec3s factor = factor_of(sky->flat_irradiance, 0.6);
    vec3s ground = glms_vec3_scale(
        glms_vec3_mul(fr_srgb_decode3(room->params.ground_colour), sky->flat_irradiance),
        1 / FR_PI_F);
    float top = fr_luminance(fr_shading_sky(&shading, (vec3s){{0, 0, 1}}));
    for (int i = 0; i < 14; i++) {
        vec3s normal = {{i < 6     ? (float)((i == 0) - (i == 1))
                         : (i & 1) ? 1
                                   : -1,
                         i < 6     ? (float)((i == 2) - (i == 3))
                         : (i & 2) ? 1
                                   : -1,
                         i < 6     ? (float)((i == 4) - (i == 5))
                         : (i & 4) ? 1
                                   : -1}};
        normal = glms_vec3_normalize(normal);
        vec3s wanted = glms_vec3_mul(brought(sky, ground, normal), factor);
        vec3s is = fr_shading_sky(&shading, normal);
        for (int c = 0; c < 3; c++) { // nine numbers are good to a few parts of a hundred
            g_assert_cmpfloat_with_epsilon(is.raw[c], wanted.raw[c], 0.05f * top);
        }
    }
    fr_sky_free(sky);
    room_free(room);
}

static void test_sun(void) {
    Room *room = room_new(0);
    FrContext context = fr_context_default();
    room->params.sun_azimuth = 0.5 * G_PI;
    room->params.sun_elevation = G_PI / 6;
    FrShading shading = shade(room);
    g_assert_cmpfloat_with_epsilon(shading.to_sun.x, cos(G_PI / 6), 1e-6);
    g_assert_cmpfloat_with_epsilon(shading.to_sun.z, 0.5, 1e-6);
    FrSky *sky = fr_sky_new(&room->params, true, &context);
    vec3s wanted = glms_vec3_mul(glms_vec3_scale(sky->sun_irradiance, 1 / FR_PI_F),
                                 factor_of(sky->flat_irradiance, 0.6));
    g_assert_cmpfloat_with_epsilon(shading.sun.g, wanted.g, 0.01f * wanted.g);
    fr_sky_free(sky);
    room->params.sun_elevation = -0.1;
    g_assert_true(fr_is_black(shade(room).sun));
    room_free(room);
}

// Φ/4π of a point and Φ/π of an area, by π for a matt surface, in parts of the solar constant.
static void test_lamps(void) {
    Room *room = room_new(1);
    room->params.sky_strength = room->params.sun_strength = 0;
    FrLampParams *lamp = &room->lamps[0];
    lamp->power = 100;
    lamp->colour = glms_vec3_one();
    for (int k = 0; k < 2; k++) {
        lamp->kind = k == 0 ? 0 : 2;
        FrShading shading = shade(room);
        g_assert_cmpuint(shading.lamp_count, ==, 1);
        g_assert_cmpfloat_with_epsilon(shading.lamps[0].at.z, 2, 1e-6);
        g_assert_true(fr_is_black(shading.sun));
        float share = (float)(100 / SOLAR_CONSTANT) / (k == 0 ? 4 * FR_PI_F : FR_PI_F);
        vec3s white = glms_vec3_fill(share / 4); // 2 m below it
        float wanted = fr_luminance(factor_of(white, 0.6)) * share / FR_PI_F;
        g_assert_cmpfloat_with_epsilon(fr_luminance(shading.lamps[0].intensity), wanted,
                                       1e-3f * wanted);
    }
    room_free(room);
}

static void test_brightest(void) {
    Room *room = room_new(10);
    for (int i = 0; i < 10; i++) {
        room->lamps[i].power = 1 + (i * 7) % 10;
        room->lamps[i].at = (vec3s){{(float)i, 0, 2}};
    }
    room->lamps[9].at = (vec3s){{1000, 0, 2}};
    FrShading shading = shade(room);
    g_assert_cmpuint(shading.lamp_count, ==, FR_SHADING_LAMPS);
    float last = INFINITY;
    for (uint32_t i = 0; i < shading.lamp_count; i++) {
        const FrShadingLamp *lamp = &shading.lamps[i];
        float bright = fr_luminance(lamp->intensity) / glms_vec3_norm2(lamp->at);
        g_assert_cmpfloat(bright, <=, last);
        g_assert_cmpfloat(lamp->at.x, <, 10);
        last = bright;
    }
    room_free(room);
}

static void test_darkness(void) {
    Room *room = room_new(1);
    room->params.sky_strength = room->params.sun_strength = 0;
    room->lamps[0].power = 0;
    FrShading shading = shade(room);
    g_assert_cmpuint(shading.lamp_count, ==, 0);
    g_assert_cmpfloat(shading.sun.g, >, 0.5);
    room_free(room);
}

static void test_digest(void) {
    Room *room = room_new(1);
    FrDigest before = fr_shading_digest(&room->scene);
    g_assert_true(fr_shading_digest(&room->scene) == before);
    room->lamps[0].power += 1;
    g_assert_false(fr_shading_digest(&room->scene) == before);
    room->lamps[0].power -= 1;
    room->params.turbidity += 1;
    g_assert_false(fr_shading_digest(&room->scene) == before);
    room_free(room);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/shading/nine numbers bring what the sky brings to all sides",
                    test_sky);
    g_test_add_func("/render/shading/the sun is that of the path tracer, none below the horizon",
                    test_sun);
    g_test_add_func("/render/shading/lamps shine with their power over their directions",
                    test_lamps);
    g_test_add_func("/render/shading/the eight lamps brightest in the middle are kept in order",
                    test_brightest);
    g_test_add_func("/render/shading/a scene without light is shown by a clear day", test_darkness);
    g_test_add_func("/render/shading/its digest tells every change of the light", test_digest);
    return g_test_run();
}
