#include "frond/material.h"

#include <glib/gstdio.h>
#include <string.h>

typedef struct Fixture {
    char *folder;
    FrMaterialParams params;
    FrContext context;
} Fixture;

static void set_up(Fixture *fixture, gconstpointer data) {
    (void)data;
    fixture->folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    fr_params_init(fr_material_table(), &fixture->params);
    fixture->context = fr_context_default();
    fixture->context.diags = fr_diags_new();
}

static void tear_down(Fixture *fixture, gconstpointer data) {
    (void)data;
    fr_params_clear(fr_material_table(), &fixture->params);
    fr_diags_free(fixture->context.diags);
    GDir *folder = g_dir_open(fixture->folder, 0, NULL);
    for (const char *name; (name = g_dir_read_name(folder)) != NULL;) {
        char *path = g_build_filename(fixture->folder, name, NULL);
        g_remove(path);
        g_free(path);
    }
    g_dir_close(folder);
    g_rmdir(fixture->folder);
    g_free(fixture->folder);
}

/// Writes a picture of that many channels into the folder; returns its bytes.
static GBytes *write_picture(const Fixture *fixture, const char *name, uint32_t channels) {
    FrImage *image = fr_image_new(8, 8, channels);
    memset(image->pixels, 0x80, 8 * 8 * channels);
    GBytes *png = fr_image_to_png(image);
    char *path = g_build_filename(fixture->folder, name, NULL);
    g_assert_true(g_file_set_contents(path, g_bytes_get_data(png, NULL),
                                      (gssize)g_bytes_get_size(png), NULL));
    g_free(path);
    fr_image_unref(image);
    return png;
}

static void name_file(char **field, const char *name) {
    g_free(*field);
    *field = g_strdup(name);
}

static FrMaterial *material(const Fixture *fixture) {
    return fr_material_new("leaf", &fixture->params, fixture->folder, (FrSpan){0});
}

static void test_table(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    const FrParamTable *table = fr_material_table();
    g_assert_cmpstr(table->element, ==, "material");
    const FrParam *texture = fr_params_find(table, "texture");
    for (int kind = FR_TEXTURE_NONE; kind <= FR_TEXTURE_BARK_PLATED; kind++) {
        static const char *const names[] = {"none",          "leaf",        "petal",
                                            "bark-furrowed", "bark-smooth", "bark-plated"};
        char *name = fr_param_choice(texture, kind);
        g_assert_cmpstr(name, ==, names[kind]);
        g_free(name);
    }
    g_assert_cmpint(fixture->params.venation, ==, 1);
    g_assert_cmpint(fixture->params.size, ==, 512);
}

static void test_plain(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    fixture->params.colour = (vec3s){{0.25f, 0.5f, 0.75f}};
    FrMaterial *plain = material(fixture);
    g_assert_cmpstr(fr_material_name(plain), ==, "leaf");
    for (int map = 0; map < FR_MAP_COUNT; map++) {
        FrStatus status = FR_OK;
        const char *type = NULL;
        g_assert_false(fr_material_has(plain, (FrMap)map));
        g_assert_null(fr_material_image(plain, (FrMap)map, &fixture->context, &status));
        g_assert_null(fr_material_image_file(plain, (FrMap)map, &fixture->context, &type, &status));
        g_assert_cmpint(status, ==, FR_OK);
    }
    g_assert_false(fr_material_has_alpha(plain));
    g_assert_cmpfloat(fr_material_tint(plain).z, ==, 0.75f);
    g_assert_true(fr_material_ref(plain) == plain);
    fr_material_unref(plain);
    g_assert_cmpfloat((float)fr_material_params(plain)->roughness, ==, 0.8f);
    fr_material_unref(plain);
}

static void test_made(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    fixture->params.texture = FR_TEXTURE_LEAF;
    fixture->params.size = 64;
    fixture->params.colour = (vec3s){{0.2f, 0.4f, 0.1f}};
    FrMaterial *leaf = material(fixture);
    g_assert_true(fr_material_has_alpha(leaf));
    g_assert_cmpfloat(fr_material_tint(leaf).x, ==, 1); // the picture holds the colour
    const FrImage *colour = fr_material_image(leaf, FR_MAP_COLOUR, &fixture->context, NULL);
    g_assert_nonnull(colour);
    g_assert_cmpuint(colour->width, ==, 64);
    g_assert_true(colour == fr_material_image(leaf, FR_MAP_COLOUR, &fixture->context, NULL));
    for (int map = 0; map < FR_MAP_COUNT; map++) {
        const char *type = NULL;
        GBytes *file = fr_material_image_file(leaf, (FrMap)map, &fixture->context, &type, NULL);
        g_assert_nonnull(file);
        g_assert_cmpstr(type, ==, "image/png");
        g_bytes_unref(file);
    }
    fr_material_unref(leaf);
    fixture->params.texture = FR_TEXTURE_BARK_SMOOTH;
    FrMaterial *bark = material(fixture);
    g_assert_false(fr_material_has_alpha(bark));
    fr_material_unref(bark);
}

static void test_file(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    GBytes *written = write_picture(fixture, "leaf.jpg", 4);
    name_file(&fixture->params.picture, "leaf.jpg");
    FrMaterial *leaf = material(fixture);
    g_assert_true(fr_material_has(leaf, FR_MAP_COLOUR));
    g_assert_false(fr_material_has(leaf, FR_MAP_NORMAL));
    g_assert_true(fr_material_has_alpha(leaf));
    const char *type = NULL;
    GBytes *file = fr_material_image_file(leaf, FR_MAP_COLOUR, &fixture->context, &type, NULL);
    g_assert_true(g_bytes_equal(file, written));
    g_assert_cmpstr(type, ==, "image/png"); // whatever its name says
    g_bytes_unref(file);
    g_bytes_unref(written);
    fr_material_unref(leaf);
}

static void test_opaque_file(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    g_bytes_unref(write_picture(fixture, "bark.png", 3));
    name_file(&fixture->params.picture, "bark.png");
    FrMaterial *bark = material(fixture);
    g_assert_false(fr_material_has_alpha(bark));
    fr_material_unref(bark);
}

/// A file takes the place of one map, the others are still made.
static void test_mixed(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    g_bytes_unref(write_picture(fixture, "normal.png", 3));
    name_file(&fixture->params.normal_map, "normal.png");
    fixture->params.texture = FR_TEXTURE_BARK_PLATED;
    fixture->params.size = 32;
    FrMaterial *bark = material(fixture);
    g_assert_cmpuint(fr_material_image(bark, FR_MAP_ROUGHNESS, &fixture->context, NULL)->width, ==,
                     32);
    g_assert_cmpuint(fr_material_image(bark, FR_MAP_NORMAL, &fixture->context, NULL)->width, ==, 8);
    g_assert_cmpuint(fr_material_image(bark, FR_MAP_COLOUR, &fixture->context, NULL)->width, ==,
                     32);
    fr_material_unref(bark);
}

static void test_missing(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    name_file(&fixture->params.picture, "lost.png");
    FrMaterial *leaf = material(fixture);
    FrStatus status = FR_OK;
    g_assert_null(fr_material_image(leaf, FR_MAP_COLOUR, &fixture->context, &status));
    g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpstr(fr_diags_get(fixture->context.diags, 0)->code, ==, "picture-missing");
    g_assert_nonnull(strstr(fr_diags_get(fixture->context.diags, 0)->text, "lost.png"));
    g_assert_false(fr_material_has_alpha(leaf));
    // Once the file is there it is found.
    g_bytes_unref(write_picture(fixture, "lost.png", 3));
    g_assert_nonnull(fr_material_image(leaf, FR_MAP_COLOUR, &fixture->context, NULL));
    fr_material_unref(leaf);
}

static void *ask(void *data) {
    FrContext context = fr_context_default();
    return (void *)fr_material_image(data, FR_MAP_NORMAL, &context, NULL);
}

static void test_shared(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    fixture->params.texture = FR_TEXTURE_PETAL;
    fixture->params.size = 64;
    FrMaterial *petal = material(fixture);
    GThread *threads[4];
    for (size_t i = 0; i < G_N_ELEMENTS(threads); i++) {
        threads[i] = g_thread_new("ask", ask, petal);
    }
    const void *first = g_thread_join(threads[0]);
    g_assert_nonnull(first);
    for (size_t i = 1; i < G_N_ELEMENTS(threads); i++) {
        g_assert_true(g_thread_join(threads[i]) == first);
    }
    fr_material_unref(petal);
}

#define ADD(name, function) g_test_add(name, Fixture, NULL, set_up, function, tear_down)

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    ADD("/material/material/choices of the table are the kinds of texture", test_table);
    ADD("/material/material/a plain material has a colour and no picture", test_plain);
    ADD("/material/material/a made leaf has all maps and holes", test_made);
    ADD("/material/material/a user's file is handed on unchanged", test_file);
    ADD("/material/material/a file without transparency has no holes", test_opaque_file);
    ADD("/material/material/a file takes the place of one made map", test_mixed);
    ADD("/material/material/a missing file is reported and looked for again", test_missing);
    ADD("/material/material/threads that ask at once get one picture", test_shared);
    return g_test_run();
}
