#include "render/render.h"

#include "frond/digest.h"
#include "render/film.h"
#include "world_by_hand.h"

static vec3s grey(float value) {
    return (vec3s){{value, value, value}};
}

static FrSceneParams clear_day(void) {
    return (FrSceneParams){.sun_azimuth = 2.4,
                           .sun_elevation = 0.73,
                           .sun_strength = 1,
                           .sky_strength = 1,
                           .turbidity = 3,
                           .ground = true,
                           .ground_colour = grey(0.4f)};
}

/// A scene without any plant.
typedef struct EmptyScene {
    FrSceneParams params;
    FrScene scene;
} EmptyScene;

static void empty_scene_init(EmptyScene *empty) {
    empty->params = clear_day();
    empty->scene = (FrScene){
        .plants = g_array_new(FALSE, TRUE, sizeof(FrScenePlant)),
        .stands = g_array_new(FALSE, TRUE, sizeof(FrStand)),
        .views = g_ptr_array_new(),
        .params = &empty->params,
    };
}

static void empty_scene_clear(EmptyScene *empty) {
    g_array_free(empty->scene.plants, TRUE);
    g_array_free(empty->scene.stands, TRUE);
    g_ptr_array_free(empty->scene.views, TRUE);
}

/// Some leaning blades and a sphere before a real sky.
static FrWorld *small_world(void) {
    FrSceneParams params = clear_day();
    FrContext context = fr_context_default();
    FrWorld *world = fr_world_new(fr_sky_new(&params, true, &context),
                                  fr_ground_new(params.ground_colour, 0.5f));
    uint32_t blade = fr_world_add_mesh(world, square(), matt((vec3s){{0.1f, 0.2f, 0.05f}}, 0.4f));
    uint32_t ball = fr_world_add_mesh(world, sphere(), matt(grey(0.5f), 0.0f));
    mat4s identity = glms_mat4_identity();
    fr_world_add_stand(world, ball, glms_translate(identity, (vec3s){{0, 0, 1}}));
    for (int i = 0; i < 5; i++) {
        mat4s at = glms_translate(identity, (vec3s){{(float)i - 2, 1, 2}});
        fr_world_add_stand(world, blade, glms_rotate(at, (float)i, (vec3s){{0.6f, 0, 0.8f}}));
    }
    fr_world_commit(world);
    return world;
}

static FrDigest render_with(int threads) {
    FrWorld *world = small_world();
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(threads);
    FrRenderParams params = {.width = 53, .height = 37, .samples = 4, .bounces = 4};
    FrImage *image = NULL;
    g_assert_cmpint(fr_render_world(world, NULL, 0, &params, &context, &image), ==, FR_OK);
    g_assert_cmpuint(image->width, ==, 53);
    g_assert_cmpuint(image->height, ==, 37);
    g_assert_cmpuint(image->channels, ==, 3);
    FrDigest digest = fr_digest(0, image->pixels, (size_t)53 * 37 * 3);
    fr_image_unref(image);
    fr_pool_free(context.pool);
    fr_world_free(world);
    return digest;
}

static void test_threads(void) {
    FrDigest one = render_with(1);
    g_assert_cmphex(render_with(2), ==, one);
    g_assert_cmphex(render_with(3), ==, one);
    g_assert_cmphex(render_with(8), ==, one);
}

static void test_empty(void) {
    EmptyScene empty;
    empty_scene_init(&empty);
    FrContext context = fr_context_default();
    FrRenderParams params = {.width = 40, .height = 40, .samples = 2, .bounces = 3};
    FrImage *image = NULL;
    FrSkinParams skin = {0};
    g_assert_cmpint(fr_render(&empty.scene, &params, &skin, &context, &image), ==, FR_OK);
    const uint8_t *sky = image->pixels + 3 * 20;
    const uint8_t *ground = image->pixels + 3 * (38 * 40 + 20);
    g_assert_cmpuint(sky[2], >, sky[0]);
    g_assert_cmpuint(sky[2], >, 90);
    g_assert_cmpint(ABS(ground[2] - ground[0]), <, 40);
    fr_image_unref(image);
    empty_scene_clear(&empty);
}

static FrStatus try_size(int64_t width, int64_t height, int64_t samples, const char **code) {
    EmptyScene empty;
    empty_scene_init(&empty);
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrRenderParams params = {.width = width, .height = height, .samples = samples};
    FrSkinParams skin = {0};
    FrImage *image = NULL;
    FrStatus status = fr_render(&empty.scene, &params, &skin, &context, &image);
    g_assert_null(image);
    g_assert_cmpuint(fr_diags_error_count(context.diags), ==, 1);
    *code = fr_diags_get(context.diags, 0)->code;
    fr_diags_free(context.diags);
    empty_scene_clear(&empty);
    return status;
}

static void test_sizes(void) {
    const char *code;
    g_assert_cmpint(try_size(0, 10, 1, &code), ==, FR_ERR_USAGE);
    g_assert_cmpstr(code, ==, "picture-size");
    g_assert_cmpint(try_size(10, -5, 1, &code), ==, FR_ERR_USAGE);
    g_assert_cmpint(try_size(10, 10, 0, &code), ==, FR_ERR_USAGE);
    g_assert_cmpint(try_size(32768, 32768, 1, &code), ==, FR_ERR_LIMIT);
    g_assert_cmpstr(code, ==, "limit-pixels");
}

static void test_views(void) {
    EmptyScene empty;
    empty_scene_init(&empty);
    FrViewParams close = {.name = "close-up", .field_of_view = 0.5, .zoom = 1};
    g_ptr_array_add(empty.scene.views, &close);
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSkinParams skin = {0};
    FrRenderParams params = {.width = 8, .height = 8, .samples = 1, .view = (char[]){"close-pu"}};
    FrImage *image = NULL;
    g_assert_cmpint(fr_render(&empty.scene, &params, &skin, &context, &image), ==, FR_ERR_USAGE);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "unknown-view");
    g_assert_nonnull(strstr(fr_diags_get(context.diags, 0)->text, "'close-up'"));
    params.view = (char[]){"close-up"};
    g_assert_cmpint(fr_render(&empty.scene, &params, &skin, &context, &image), ==, FR_OK);
    fr_image_unref(image);
    fr_diags_free(context.diags);
    empty_scene_clear(&empty);
}

static void cancel_soon(void *user, const char *stage, double fraction) {
    FrProgress **progress = user;
    g_assert_cmpstr(stage, ==, "render");
    g_assert_cmpfloat(fraction, <, 0.9);
    fr_progress_cancel(*progress);
}

static void test_cancel(void) {
    EmptyScene empty;
    empty_scene_init(&empty);
    FrContext context = fr_context_default();
    FrProgress *progress = NULL;
    progress = fr_progress_new(cancel_soon, &progress);
    context.progress = progress;
    // Whole, this would take minutes.
    FrRenderParams params = {.width = 2000, .height = 2000, .samples = 64, .bounces = 3};
    FrSkinParams skin = {0};
    FrImage *image = NULL;
    g_assert_cmpint(fr_render(&empty.scene, &params, &skin, &context, &image), ==, FR_CANCELLED);
    g_assert_null(image);
    fr_progress_free(progress);
    empty_scene_clear(&empty);
}

// Noise about a level is averaged away; an edge far above the noise stays where it is.
static void test_denoise(void) {
    enum { SIZE = 48 };
    FrFilm *film = fr_film_new(SIZE, SIZE);
    double before = 0.0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        float level = i % SIZE < SIZE / 2 ? 0.5f : 2.0f;
        for (uint32_t half = 0; half < 2; half++) {
            float noise = 0.1f * (float)fr_random_normal(fr_key_root(7), half, i);
            film->half[half][i] = grey(level + noise);
            before += (double)(noise * noise) / (2.0 * 2 * SIZE * SIZE);
        }
        film->albedo[i] = grey(0.5f);
        film->normal[i] = (vec3s){{0, 0, 1}};
        film->cover[i] = 1.0f;
    }
    FrContext context = fr_context_default();
    vec3s *light = fr_film_denoise(film, &context);
    double after = 0.0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        float level = i % SIZE < SIZE / 2 ? 0.5f : 2.0f;
        after += (double)((light[i].g - level) * (light[i].g - level)) / (SIZE * SIZE);
        g_assert_cmpfloat_with_epsilon(light[i].g, level, 0.3);
    }
    g_assert_cmpfloat(after, <, before / 8);
    g_free(light);
    fr_film_free(film);
}

// AgX shows mid grey as mid grey, keeps greys grey, and rises.
static void test_tone(void) {
    vec3s middle = fr_tone(grey(0.18f));
    g_assert_cmpfloat(middle.g, >, 0.38f);
    g_assert_cmpfloat(middle.g, <, 0.52f);
    float last = -1.0f;
    for (float light = 1e-5f; light < 10.0f; light *= 1.5f) {
        vec3s shown = fr_tone(grey(light));
        g_assert_cmpfloat_with_epsilon(shown.r, shown.g, 2e-3);
        g_assert_cmpfloat_with_epsilon(shown.b, shown.g, 2e-3);
        g_assert_cmpfloat(shown.g, >=, last);
        last = shown.g;
    }
    g_assert_cmpfloat(last, >, 0.9f);
    vec3s black = fr_tone(grey(0.0f));
    g_assert_cmpfloat(black.g, <, 0.01f);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/render/the picture is the same for any number of threads",
                    test_threads);
    g_test_add_func("/render/render/an empty scene shows sky and ground", test_empty);
    g_test_add_func("/render/render/no size and too large a size are refused", test_sizes);
    g_test_add_func("/render/render/views are found by name, misspelt ones suggested", test_views);
    g_test_add_func("/render/render/a cancelled picture is none", test_cancel);
    g_test_add_func("/render/film/noise goes and edges stay", test_denoise);
    g_test_add_func("/render/film/tones rise from black to white", test_tone);
    return g_test_run();
}
