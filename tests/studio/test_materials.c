/// Materials of a document: made, named, given, and seen by themselves.
#include "studio.h"

#include "studio/model/borrowed.h"
#include "studio/model/materials.h"

#include <math.h>

static const char text[] = "<frond version=\"1\">\n"
                           "  <material id=\"bark\" colour=\"#804020\"/>\n"
                           "  <plant id=\"p\"><pgraph>\n"
                           "    <tree id=\"t\" material=\"bark\" face-material=\"bark\"/>\n"
                           "    <leaf id=\"bark-leaf\"/>\n"
                           "  </pgraph></plant>\n"
                           "</frond>\n";

static StudioDocument *document_new(const char *from) {
    return studio_document_new(from, strlen(from), "materials.frond", NULL);
}

static void test_add(void) {
    StudioDocument *document = document_new(text);
    char *id;
    g_assert_true(studio_add_material(document, element_of(document, "bark"),
                                      element_of(document, "bark-leaf"), "material", &id));
    g_assert_cmpstr(id, ==, "bark2");
    g_assert_nonnull(strstr(text_of(document), "  <material id=\"bark\" colour=\"#804020\"/>\n"
                                               "  <material id=\"bark2\" colour=\"#804020\"/>\n"));
    g_assert_nonnull(strstr(text_of(document), "<leaf id=\"bark-leaf\" material=\"bark2\"/>"));
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Add material bark2");
    g_assert_true(studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, text);
    g_free(id);
    studio_document_free(document);
}

static void test_first(void) {
    StudioDocument *document =
        document_new("<frond version=\"1\">\n  <plant id=\"p\"><pgraph/></plant>\n</frond>\n");
    g_assert_true(studio_add_material(document, FR_NONE, FR_NONE, NULL, NULL));
    g_assert_cmpstr(text_of(document), ==,
                    "<frond version=\"1\">\n  <material id=\"material\" colour=\"#8a8a80\"/>\n"
                    "  <plant id=\"p\"><pgraph/></plant>\n</frond>\n");
    studio_document_free(document);
}

static void test_rename(void) {
    StudioDocument *document = document_new(text);
    uint32_t bark = element_of(document, "bark");
    g_assert_false(studio_rename_material(document, bark, "no id"));
    g_assert_cmpuint(studio_document_steps(document), ==, 0);
    g_assert_true(studio_rename_material(document, bark, "rind"));
    g_assert_nonnull(strstr(text_of(document), "<material id=\"rind\""));
    g_assert_nonnull(
        strstr(text_of(document), "<tree id=\"t\" material=\"rind\" face-material=\"rind\"/>"));
    g_assert_nonnull(strstr(text_of(document), "<leaf id=\"bark-leaf\"/>"));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    studio_document_free(document);
}

static void test_files(void) {
    static const char *const cases[][3] = {
        {"/home/eve/plants", "/home/eve/plants/bark.png", "bark.png"},
        {"/home/eve/plants", "/home/eve/plants/maps/bark.png", "maps/bark.png"},
        {"/home/eve/plants", "/home/eve/pictures/bark.png", "../pictures/bark.png"},
        {"/home/eve/plants", "/mnt/bark.png", "/mnt/bark.png"},
        {"", "/mnt/bark.png", "/mnt/bark.png"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        char *file = studio_file_from(cases[i][0], cases[i][1]);
        g_assert_cmpstr(file, ==, cases[i][2]);
        g_free(file);
    }
}

static const uint8_t *pixel(const FrImage *image, uint32_t x, uint32_t y) {
    return image->pixels + 4 * ((size_t)y * image->width + x);
}

static void test_swatch(void) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.colour = (vec3s){{0.8f, 0.2f, 0.1f}};
    FrImage *ball = studio_swatch(&params, NULL, 32);
    g_assert_cmpint(pixel(ball, 0, 0)[3], ==, 0);
    g_assert_cmpint(pixel(ball, 16, 16)[3], ==, 255);
    g_assert_cmpint(pixel(ball, 16, 16)[0], >, 2 * pixel(ball, 16, 16)[1]);
    g_assert_cmpint(pixel(ball, 10, 10)[0], >, pixel(ball, 24, 24)[0]); // light from the upper left
    fr_image_unref(ball);
    FrImage *leaf = fr_image_new(2, 2, 4);
    memset(leaf->pixels, 255, 16);
    leaf->pixels[3] = 0; // a hole in the upper left quarter
    FrImage *flat = studio_swatch(&params, leaf, 32);
    g_assert_cmpint(pixel(flat, 4, 4)[3], ==, 0);
    g_assert_cmpint(pixel(flat, 28, 28)[3], ==, 255);
    g_assert_cmpint(pixel(flat, 28, 28)[0], ==, 204); // white times the colour
    fr_image_unref(flat);
    params.texture = FR_TEXTURE_PETAL; // its picture has the colour already
    flat = studio_swatch(&params, leaf, 32);
    g_assert_cmpint(pixel(flat, 28, 28)[1], ==, 255);
    fr_image_unref(flat);
    fr_image_unref(leaf);
    fr_params_clear(fr_material_table(), &params);
}

static void test_thumbnail(void) {
    FrImage *image = fr_image_new(6, 4, 3);
    for (uint32_t i = 0; i < 6 * 4; i++) {
        image->pixels[3 * i] = i % 6 < 3 ? 30 : 90; // left and right half
    }
    FrImage *small = studio_thumbnail(image, 2, 1);
    g_assert_cmpint(pixel(small, 0, 0)[0], ==, 30);
    g_assert_cmpint(pixel(small, 1, 0)[0], ==, 90);
    g_assert_cmpint(pixel(small, 1, 0)[3], ==, 255);
    FrImage *one = studio_thumbnail(small, 1, 1), *more = studio_thumbnail(small, 4, 3);
    g_assert_cmpint(pixel(one, 0, 0)[0], ==, 60);
    g_assert_cmpint(pixel(more, 3, 2)[0], ==, 90);
    fr_image_unref(more);
    fr_image_unref(one);
    fr_image_unref(small);
    fr_image_unref(image);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/materials/a copy is made and given in one step", test_add);
    g_test_add_func("/studio/materials/the first one stands before the plants", test_first);
    g_test_add_func("/studio/materials/another name is told to all that name it", test_rename);
    g_test_add_func("/studio/materials/files are named from the document on", test_files);
    g_test_add_func("/studio/materials/a swatch is a lit ball, or a leaf with its holes",
                    test_swatch);
    g_test_add_func("/studio/materials/a thumbnail has the means of pixels", test_thumbnail);
    return g_test_run();
}
