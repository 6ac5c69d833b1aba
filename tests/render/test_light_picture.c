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

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/light_picture/it is dark below a plate", test_slice);
    g_test_add_func("/render/light_picture/sizes are checked as of other pictures", test_size);
    return g_test_run();
}
