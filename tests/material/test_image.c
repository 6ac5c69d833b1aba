#include "frond/image.h"

#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>

#include <jpeglib.h>

// ---- fixtures -----------------------------------------------------------------------------------

typedef struct Fixture {
    FrSource *source;
    FrSpan span;
    FrDiags *diags;
    FrContext context;
} Fixture;

static void set_up(Fixture *fixture, gconstpointer data) {
    (void)data;
    fixture->source = fr_source_new("plant.frond", "picture=\"leaf.png\"", 18);
    fixture->span = (FrSpan){.source = fixture->source, .begin = 9, .end = 17};
    fixture->diags = fr_diags_new();
    fixture->context = fr_context_default();
    fixture->context.diags = fixture->diags;
}

static void tear_down(Fixture *fixture, gconstpointer data) {
    (void)data;
    fr_diags_free(fixture->diags);
    fr_source_unref(fixture->source);
}

/// The bytes are refused with exactly this diagnostic, at the span that names the picture.
static void assert_refused(Fixture *fixture, const void *data, size_t size, const char *code,
                           FrStatus expected) {
    size_t before = fr_diags_error_count(fixture->diags);
    FrStatus status = FR_OK;
    FrImage *image =
        fr_image_from_bytes(data, size, "leaf.png", fixture->span, &fixture->context, &status);
    g_assert_null(image);
    g_assert_cmpint(status, ==, expected);
    g_assert_cmpuint(fr_diags_error_count(fixture->diags), ==, before + 1);
    if (before == 0) {
        const FrDiag *diag = fr_diags_get(fixture->diags, 0);
        g_assert_cmpstr(diag->code, ==, code);
        g_assert_cmpuint(diag->span.begin, ==, 9);
        g_assert_cmpuint(diag->span.end, ==, 17);
    }
}

static FrImage *pattern(uint32_t width, uint32_t height, uint32_t channels) {
    FrImage *image = fr_image_new(width, height, channels);
    for (size_t i = 0; i < (size_t)width * height * channels; i++) {
        image->pixels[i] = (uint8_t)(i * 37 + i / 11);
    }
    return image;
}

/// A JPEG of one flat colour with 1 (grey), 3 (RGB) or 4 (inks) components.
static GBytes *flat_jpeg(uint32_t side, const uint8_t *colour, int components) {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    unsigned char *data = NULL;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = jpeg.image_height = side;
    jpeg.input_components = components;
    jpeg.in_color_space = components == 4 ? JCS_CMYK : components == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    uint8_t *row = g_malloc((size_t)side * (size_t)components);
    for (uint32_t x = 0; x < side; x++) {
        memcpy(row + (size_t)x * (size_t)components, colour, (size_t)components);
    }
    while (jpeg.next_scanline < jpeg.image_height) {
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    g_free(row);
    GBytes *bytes = g_bytes_new(data, size);
    free(data);
    return bytes;
}

// ---- PNG ----------------------------------------------------------------------------------------

static void test_round_trip(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    const uint32_t channels[] = {1, 3, 4};
    for (size_t i = 0; i < G_N_ELEMENTS(channels); i++) {
        FrImage *image = pattern(61, 7, channels[i]);
        GBytes *png = fr_image_to_png(image);
        gsize size = 0;
        const void *data = g_bytes_get_data(png, &size);
        FrImage *back =
            fr_image_from_bytes(data, size, "x", fixture->span, &fixture->context, NULL);
        g_assert_nonnull(back);
        g_assert_cmpuint(back->channels, ==, channels[i]);
        g_assert_true(memcmp(back->pixels, image->pixels, 61 * 7 * channels[i]) == 0);
        fr_image_unref(back);
        fr_image_unref(image);
        g_bytes_unref(png);
    }
    g_assert_cmpuint(fr_diags_count(fixture->diags), ==, 0);
}

static void test_png_is_deterministic(Fixture *fixture, gconstpointer unused) {
    (void)fixture;
    (void)unused;
    FrImage *image = pattern(40, 30, 4);
    GBytes *first = fr_image_to_png(image), *second = fr_image_to_png(image);
    g_assert_true(g_bytes_equal(first, second));
    // No chunk that would tell a viewer to bend a normal map's values.
    g_assert_null(
        g_strstr_len(g_bytes_get_data(first, NULL), (gssize)g_bytes_get_size(first), "sRGB"));
    g_bytes_unref(first);
    g_bytes_unref(second);
    fr_image_unref(image);
}

static void test_cut_png(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    FrImage *image = pattern(50, 50, 3);
    GBytes *png = fr_image_to_png(image);
    gsize size = 0;
    const uint8_t *data = g_bytes_get_data(png, &size);
    for (size_t cut = 8; cut + 12 < size; cut += 131) {
        assert_refused(fixture, data, cut, "picture-damaged", FR_ERR_DOCUMENT);
    }
    g_bytes_unref(png);
    fr_image_unref(image);
}

static void test_damaged_png(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    FrImage *image = pattern(50, 50, 3);
    GBytes *png = fr_image_to_png(image);
    gsize size = 0;
    uint8_t *data = g_bytes_unref_to_data(png, &size);
    memset(data + size / 2, 0xa5, 64);
    assert_refused(fixture, data, size, "picture-damaged", FR_ERR_DOCUMENT);
    g_free(data);
    fr_image_unref(image);
}

static void test_huge_png(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    // A whole header chunk with its checksum: 100000 × 100000 RGBA, then no pixels.
    static const uint8_t header[] = {
        0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0,   0,   13,   'I',  'H',  'D',
        'R',  0x00, 0x01, 0x86, 0xa0, 0x00, 0x01, 0x86, 0xa0, 8,   6,   0,    0,    0,    0xa8,
        0x52, 0x0b, 0xc8, 0,    0,    0,    0,    'I',  'D',  'A', 'T', 0x35, 0xaf, 0x06, 0x1e};
    assert_refused(fixture, header, sizeof header, "limit-pixels", FR_ERR_LIMIT);
}

static void test_unknown_bytes(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    assert_refused(fixture, "GIF89a......", 12, "picture-format", FR_ERR_DOCUMENT);
    assert_refused(fixture, "", 0, "picture-format", FR_ERR_DOCUMENT);
    assert_refused(fixture, "\x89PNG", 4, "picture-format", FR_ERR_DOCUMENT);
}

// ---- JPEG ---------------------------------------------------------------------------------------

static void assert_first_pixel(Fixture *fixture, GBytes *jpeg, const int *expected) {
    gsize size = 0;
    const void *data = g_bytes_get_data(jpeg, &size);
    FrImage *image = fr_image_from_bytes(data, size, "x", fixture->span, &fixture->context, NULL);
    g_assert_nonnull(image);
    for (uint32_t c = 0; c < image->channels; c++) {
        g_assert_cmpint(ABS(image->pixels[c] - expected[c]), <=, 6);
    }
    fr_image_unref(image);
    g_bytes_unref(jpeg);
}

static void test_jpeg_colours(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    const uint8_t green[] = {40, 160, 60}, grey[] = {123};
    assert_first_pixel(fixture, flat_jpeg(16, green, 3), (int[]){40, 160, 60});
    assert_first_pixel(fixture, flat_jpeg(16, grey, 1), (int[]){123});
    // Adobe's inverted inks: full cyan light, half magenta and yellow, half black.
    const uint8_t inks[] = {255, 128, 128, 128};
    assert_first_pixel(fixture, flat_jpeg(16, inks, 4), (int[]){128, 64, 64});
}

static void test_cut_jpeg(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    const uint8_t green[] = {40, 160, 60};
    GBytes *jpeg = flat_jpeg(128, green, 3);
    gsize size = 0;
    const uint8_t *data = g_bytes_get_data(jpeg, &size);
    for (size_t cut = 3; cut + 2 < size; cut += 29) {
        assert_refused(fixture, data, cut, "picture-damaged", FR_ERR_DOCUMENT);
    }
    g_bytes_unref(jpeg);
}

static void test_huge_jpeg(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    const uint8_t green[] = {40, 160, 60};
    GBytes *jpeg = flat_jpeg(16, green, 3);
    gsize size = 0;
    uint8_t *data = g_bytes_unref_to_data(jpeg, &size);
    for (size_t i = 0; i + 9 < size; i++) {
        if (data[i] == 0xff && data[i + 1] == 0xc0) { // frame header: height and width
            memcpy(data + i + 5, "\xff\xdc\xff\xdc", 4);
        }
    }
    assert_refused(fixture, data, size, "limit-pixels", FR_ERR_LIMIT);
    g_free(data);
}

// ---- files --------------------------------------------------------------------------------------

static void assert_no_file(Fixture *fixture, const char *path) {
    FrStatus status = FR_OK;
    size_t before = fr_diags_error_count(fixture->diags);
    g_assert_null(fr_image_load(path, fixture->span, &fixture->context, &status));
    g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_error_count(fixture->diags), ==, before + 1);
    g_assert_cmpstr(fr_diags_get(fixture->diags, before)->code, ==, "picture-missing");
}

static void test_no_file(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    assert_no_file(fixture, "/nowhere/leaf.png");
    assert_no_file(fixture, "/");
    assert_no_file(fixture, "/dev/zero");
}

static void test_load(Fixture *fixture, gconstpointer unused) {
    (void)unused;
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    char *path = g_build_filename(folder, "misnamed.jpg", NULL);
    FrImage *image = pattern(9, 5, 3);
    GBytes *png = fr_image_to_png(image);
    g_assert_true(g_file_set_contents(path, g_bytes_get_data(png, NULL),
                                      (gssize)g_bytes_get_size(png), NULL));
    FrImage *back = fr_image_load(path, fixture->span, &fixture->context, NULL);
    g_assert_nonnull(back);
    g_assert_true(memcmp(back->pixels, image->pixels, 9 * 5 * 3) == 0);
    fixture->context.limits.document_bytes = 10;
    FrStatus status = FR_OK;
    g_assert_null(fr_image_load(path, fixture->span, &fixture->context, &status));
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
    fr_image_unref(back);
    fr_image_unref(image);
    g_bytes_unref(png);
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
}

static void test_references(Fixture *fixture, gconstpointer unused) {
    (void)fixture;
    (void)unused;
    FrImage *image = fr_image_new(3, 2, 4);
    g_assert_true(fr_image_ref(image) == image);
    fr_image_unref(image);
    for (size_t i = 0; i < 3 * 2 * 4; i++) {
        g_assert_cmpuint(image->pixels[i], ==, 0);
    }
    fr_image_unref(image);
    fr_image_unref(NULL);
}

#define ADD(name, function) g_test_add(name, Fixture, NULL, set_up, function, tear_down)

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    ADD("/material/image/a PNG written and read is the same picture", test_round_trip);
    ADD("/material/image/a PNG has the same bytes every time", test_png_is_deterministic);
    ADD("/material/image/a PNG that is cut short is refused", test_cut_png);
    ADD("/material/image/a PNG with damaged pixels is refused", test_damaged_png);
    ADD("/material/image/a PNG of ten thousand million pixels is over the limit", test_huge_png);
    ADD("/material/image/bytes of no known format are refused", test_unknown_bytes);
    ADD("/material/image/a JPEG keeps its colours in RGB, grey and inks", test_jpeg_colours);
    ADD("/material/image/a JPEG that is cut short is refused", test_cut_jpeg);
    ADD("/material/image/a JPEG of four thousand million pixels is over the limit", test_huge_jpeg);
    ADD("/material/image/what is not a file is refused before it is opened", test_no_file);
    ADD("/material/image/a file is read by its content and within limits", test_load);
    ADD("/material/image/references are counted", test_references);
    return g_test_run();
}
