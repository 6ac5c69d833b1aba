/// The light of a scene in false colours.
#include "frond/render.h"

#include <string.h>

#define TEXT                                                                                       \
    "<frond version='1'><plant id='p'><pgraph><camera id='root'/><horn id='s' length='0.2' "       \
    "radius='0.005'/><link from='root' to='s'/></pgraph></plant><scene ground='no' "               \
    "sky='overcast'>"                                                                              \
    "<light near='0.001'/><place plant='p' at='5, 0, 0'/>"                                         \
    "<obstacle at='0, 0, 1' size='8, 8, 0.02'/><obstacle at='0, 0, 3' size='8, 0.01, 0.01'/>"      \
    "</scene></frond>"

static FrImage *draw(int axis, double at, int64_t width, int64_t height, FrStatus *status) {
    FrContext context = fr_context_default();
    FrDocument *document;
    FrScene *scene;
    FrSource *source = fr_source_new("light.frond", TEXT, strlen(TEXT));
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_OK);
    FrRenderParams params;
    fr_params_init(fr_render_table(), &params);
    params.width = width;
    params.height = height;
    FrImage *image;
    *status = fr_render_light(scene, axis, at, &params, &context, &image);
    fr_params_clear(fr_render_table(), &params);
    fr_scene_free(scene);
    fr_document_free(document);
    fr_source_unref(source);
    return image;
}

static int brightness(const FrImage *image, uint32_t x, uint32_t y) {
    const uint8_t *pixel = image->pixels + ((size_t)y * image->width + x) * 3;
    return pixel[0] + pixel[1] + pixel[2];
}

static void test_slice(void) {
    FrStatus status;
    FrImage *image = draw(1, 0.3, 180, 66, &status);
    g_assert_cmpint(status, ==, FR_OK);
    // The slice shows 9 by 3 metres and a little more; the plate hangs in the lower half.
    int above = brightness(image, 80, 20), below = brightness(image, 80, 58);
    g_assert_cmpint(above, >, 700);
    g_assert_cmpint(below, <, above / 2);
    fr_image_unref(image);
    // From above it is seen where the plate does not reach.
    image = draw(2, 0.5, 90, 80, &status);
    g_assert_cmpint(brightness(image, 87, 3), >, brightness(image, 40, 40) + 100);
    fr_image_unref(image);
}

static void test_size(void) {
    FrStatus status;
    g_assert_null(draw(0, 0, 0, 10, &status));
    g_assert_cmpint(status, ==, FR_ERR_USAGE);
    g_assert_null(draw(0, 0, 32768, 32768, &status));
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
}

#define SIDE "<view name='side' azimuth='0' elevation='0'/></scene></frond>"

/// A picture of points, seen straight from −y.
static FrImage *draw_points(FrLightAt where, uint32_t count, int threads) {
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(threads);
    FrDocument *document;
    FrScene *scene;
    char *text = g_strndup(TEXT, strlen(TEXT) - strlen("</scene></frond>"));
    char *whole = g_strconcat(text, SIDE, NULL);
    FrSource *source = fr_source_new("light.frond", whole, strlen(whole));
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_OK);
    FrRenderParams params;
    fr_params_init(fr_render_table(), &params);
    params.width = 180;
    params.height = 66;
    FrSkinParams skin = fr_skin_default();
    FrImage *image;
    g_assert_cmpint(fr_render_light_points(scene, where, count, &params, &skin, &context, &image),
                    ==, FR_OK);
    fr_params_clear(fr_render_table(), &params);
    fr_scene_free(scene);
    fr_document_free(document);
    fr_source_unref(source);
    fr_pool_free(context.pool);
    g_free(text);
    g_free(whole);
    return image;
}

static bool is_coloured(const FrImage *image, uint32_t x, uint32_t y) {
    const uint8_t *pixel = image->pixels + ((size_t)y * image->width + x) * 3;
    return pixel[0] != pixel[1] || pixel[1] != pixel[2];
}

/// The brightest of the balls in some rows.
static int brightest(const FrImage *image, uint32_t top, uint32_t bottom) {
    int most = 0;
    for (uint32_t y = top; y < bottom; y++) {
        for (uint32_t x = 60; x < 120; x++) {
            most = is_coloured(image, x, y) ? MAX(most, brightness(image, x, y)) : most;
        }
    }
    return most;
}

static void test_grid(void) {
    FrImage *image = draw_points(FR_LIGHT_AT_GRID, 30, 1);
    // The plate is seen from its edge, a third up.
    int above = brightest(image, 0, 36), below = brightest(image, 52, 66);
    g_assert_cmpint(above, >, 650);
    g_assert_cmpint(below, >, 0);
    g_assert_cmpint(below, <, above / 2);
    FrImage *again = draw_points(FR_LIGHT_AT_GRID, 30, 3);
    g_assert_cmpint(memcmp(image->pixels, again->pixels, (size_t)3 * 180 * 66), ==, 0);
    fr_image_unref(again);
    fr_image_unref(image);
}

/// One tip has one ball, and its line leads up to the light.
static void test_organs(void) {
    FrImage *image = draw_points(FR_LIGHT_AT_ORGANS, 1, 1);
    uint32_t count = 0, least[2] = {999, 999}, most[2] = {0, 0};
    for (uint32_t i = 0; i < 180 * 66; i++) {
        uint32_t at[2] = {i % 180, i / 180};
        for (int c = 0; is_coloured(image, at[0], at[1]) && c < 2; c++) {
            least[c] = MIN(least[c], at[c]);
            most[c] = MAX(most[c], at[c]);
            count += c == 0;
        }
    }
    g_assert_cmpuint(count, >=, 4);
    g_assert_cmpuint(most[0] - least[0], <=, 6);
    g_assert_cmpuint(most[1] - least[1], >=, 3);
    g_assert_cmpuint(least[0], >, 140); // the plant stands to the right
    fr_image_unref(image);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/light_picture/it is dark below a plate", test_slice);
    g_test_add_func("/render/light_picture/sizes are checked as of other pictures", test_size);
    g_test_add_func("/render/light_points/balls below a plate are darker", test_grid);
    g_test_add_func("/render/light_points/every tip has a ball", test_organs);
    return g_test_run();
}
