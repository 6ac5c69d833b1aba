// Pictures made by the program. With FROND_TEXTURES set to a folder they are written there too.
#include "material/texture.h"

#include "material/bark.h"

#include <math.h>
#include <string.h>

static const char *const names[] = {"none",          "leaf",        "petal",
                                    "bark-furrowed", "bark-smooth", "bark-plated"};

static FrMaterialParams sheet(int kind) {
    return (FrMaterialParams){.colour = {{1, 1, 1}},
                              .texture = kind,
                              .roughness = 0.8,
                              .relief = 1,
                              .tile_width = 0.5,
                              .tile_height = 0.5,
                              .size = 128,
                              .seed = 3,
                              .venation = 1,
                              .vein_density = 1,
                              .tooth_depth = 0.03};
}

static void make(const FrMaterialParams *params, FrPool *pool, FrImage *maps[FR_MAP_COUNT]) {
    FrContext context = fr_context_default();
    context.pool = pool;
    g_assert_cmpint(fr_texture_make(params, "test", (FrSpan){0}, &context, maps), ==, FR_OK);
}

static void drop(FrImage *maps[FR_MAP_COUNT]) {
    for (int map = 0; map < FR_MAP_COUNT; map++) {
        fr_image_unref(maps[map]);
    }
}

static bool is_same(const FrImage *a, const FrImage *b) {
    return a->width == b->width && a->channels == b->channels &&
           memcmp(a->pixels, b->pixels, (size_t)a->width * a->height * a->channels) == 0;
}

static void test_threads(void) {
    const int threads[] = {2, 3, 8};
    for (int kind = FR_TEXTURE_LEAF; kind <= FR_TEXTURE_BARK_PLATED; kind++) {
        FrMaterialParams params = sheet(kind);
        FrImage *alone[FR_MAP_COUNT], *together[FR_MAP_COUNT];
        make(&params, NULL, alone);
        for (size_t i = 0; i < G_N_ELEMENTS(threads); i++) {
            FrPool *pool = fr_pool_new(threads[i]);
            make(&params, pool, together);
            for (int map = 0; map < FR_MAP_COUNT; map++) {
                g_assert_true(is_same(alone[map], together[map]));
            }
            drop(together);
            fr_pool_free(pool);
        }
        drop(alone);
    }
}

static void test_seed(void) {
    for (int kind = FR_TEXTURE_LEAF; kind <= FR_TEXTURE_BARK_PLATED; kind++) {
        FrMaterialParams params = sheet(kind);
        FrImage *first[FR_MAP_COUNT], *second[FR_MAP_COUNT];
        make(&params, NULL, first);
        params.seed++;
        make(&params, NULL, second);
        g_assert_false(is_same(first[FR_MAP_COLOUR], second[FR_MAP_COLOUR]));
        drop(first);
        drop(second);
    }
}

static void test_normals(void) {
    for (int kind = FR_TEXTURE_LEAF; kind <= FR_TEXTURE_BARK_PLATED; kind++) {
        FrMaterialParams params = sheet(kind);
        FrImage *maps[FR_MAP_COUNT];
        make(&params, NULL, maps);
        const uint8_t *n = maps[FR_MAP_NORMAL]->pixels;
        bool is_flat = true;
        for (size_t i = 0; i < 128 * 128; i++, n += 3) {
            float x = (float)n[0] / 127.5f - 1, y = (float)n[1] / 127.5f - 1,
                  z = (float)n[2] / 127.5f - 1;
            g_assert_cmpfloat(fabsf(sqrtf(x * x + y * y + z * z) - 1), <, 0.01f);
            g_assert_cmpfloat(z, >=, 0);
            is_flat &= z > 0.99f;
        }
        g_assert_false(is_flat);
        drop(maps);
    }
}

/// A furrow that runs up the stem is lit on its right wall by light from the left.
static void test_normal_directions(void) {
    FrTexel texels[16 * 16] = {0};
    for (int y = 0; y < 16; y++) {
        for (int x = 0; x < 16; x++) {
            texels[y * 16 + x].height = (float)x / 16.0f; // rises to the right, at 45 degrees
        }
    }
    FrMaterialParams params = sheet(FR_TEXTURE_LEAF);
    FrTexture texture = {.size = 16, .texels = texels, .params = &params};
    vec3s normal = fr_texture_normal(&texture, 8, 8);
    g_assert_cmpfloat(fabsf(normal.x + (float)G_SQRT2 / 2), <, 1e-4f);
    g_assert_cmpfloat(fabsf(normal.y), <, 1e-6f);
    for (int i = 0; i < 16 * 16; i++) {
        texels[i].height = (float)(i / 16) / 16.0f; // rises downwards in the picture
    }
    normal = fr_texture_normal(&texture, 8, 8);
    g_assert_cmpfloat(fabsf(normal.y - (float)G_SQRT2 / 2), <, 1e-4f); // +Y is up
}

/// Mean difference of neighbouring columns (or rows), once over the seam, once in the worst place.
static void seam(const FrImage *image, bool is_row, double *over_seam, double *worst) {
    uint32_t size = image->width;
    *worst = 0;
    for (uint32_t i = 0; i < size; i++) {
        uint32_t next = (i + 1) % size;
        double sum = 0;
        for (uint32_t k = 0; k < size; k++) {
            size_t a = is_row ? (size_t)i * size + k : (size_t)k * size + i;
            size_t b = is_row ? (size_t)next * size + k : (size_t)k * size + next;
            for (uint32_t c = 0; c < 3; c++) {
                sum += abs(image->pixels[a * 3 + c] - image->pixels[b * 3 + c]);
            }
        }
        if (next == 0) {
            *over_seam = sum;
        } else {
            *worst = MAX(*worst, sum);
        }
    }
}

static void test_tiles(void) {
    for (int kind = FR_TEXTURE_BARK_FURROWED; kind <= FR_TEXTURE_BARK_PLATED; kind++) {
        FrMaterialParams params = sheet(kind);
        params.size = 256;
        FrImage *maps[FR_MAP_COUNT];
        make(&params, NULL, maps);
        for (int map = 0; map < FR_MAP_COUNT; map++) {
            for (int is_row = 0; is_row < 2; is_row++) {
                double over_seam = INFINITY, worst = 0;
                seam(maps[map], is_row, &over_seam, &worst);
                g_assert_cmpfloat(over_seam, <=, worst);
            }
        }
        g_assert_cmpuint(maps[FR_MAP_COLOUR]->channels, ==, 3);
        drop(maps);
    }
}

static void test_fields_repeat(void) {
    FrBarkCells cells;
    fr_bark_cells_init(&cells, 9, 6, 4, 0.9f);
    for (uint32_t i = 0; i < 500; i++) {
        float u = (float)fr_random(1, 0, i), v = (float)fr_random(1, 1, i);
        float here = fr_bark_fractal(4, u, v, 5, 9, 3);
        g_assert_cmpfloat(fabsf(here - fr_bark_fractal(4, u + 1, v - 2, 5, 9, 3)), <, 1e-3f);
        FrBarkPlate plate = fr_bark_plate(&cells, u, v);
        FrBarkPlate again = fr_bark_plate(&cells, u - 1, v + 1);
        g_assert_cmpfloat(fabsf(plate.edge - again.edge), <, 1e-3f);
        g_assert_cmpfloat(plate.edge, >=, 0);
        g_assert_cmpfloat(fabsf(here), <=, 1.3f);
    }
    fr_bark_cells_clear(&cells);
}

/// Part of the picture that is opaque.
static double opaque(const FrMaterialParams *params) {
    FrImage *maps[FR_MAP_COUNT];
    make(params, NULL, maps);
    g_assert_cmpuint(maps[FR_MAP_COLOUR]->channels, ==, 4);
    double sum = 0;
    size_t count = (size_t)maps[0]->width * maps[0]->height;
    for (size_t i = 0; i < count; i++) {
        sum += maps[FR_MAP_COLOUR]->pixels[4 * i + 3] / 255.0;
    }
    drop(maps);
    return sum / (double)count;
}

static void test_alpha(void) {
    double diamond[][2] = {{0, 0}, {0.5, 0.5}, {1, 0}};
    for (int kind = FR_TEXTURE_LEAF; kind <= FR_TEXTURE_PETAL; kind++) {
        FrMaterialParams params = sheet(kind);
        double ellipse = opaque(&params);
        g_assert_cmpfloat(ellipse, >=, G_PI / 4);
        g_assert_cmpfloat(ellipse, <, G_PI / 4 + 0.04);
        params.outline = (FrPoints){diamond, 3};
        double whole = opaque(&params);
        g_assert_cmpfloat(whole, >=, 0.5);
        g_assert_cmpfloat(whole, <, 0.5 + 0.04);
        params.teeth = 12;
        params.tooth_depth = 0.06;
        double toothed = opaque(&params);
        g_assert_cmpfloat(toothed, <, whole - 0.02);
        g_assert_cmpfloat(toothed, >, whole - 0.06 * 4 * 0.7072);
    }
}

/// Half a texel inside the outline everything is opaque: geometry cut along it has no rim of holes.
static void test_no_rim(void) {
    FrMaterialParams params = sheet(FR_TEXTURE_LEAF);
    FrImage *maps[FR_MAP_COUNT];
    make(&params, NULL, maps);
    for (int y = 0; y < 128; y++) {
        for (int x = 0; x < 128; x++) {
            double across = (x + 0.5) / 128 - 0.5, along = 1 - (y + 0.5) / 128;
            double half_width = sqrt(along * (1 - along));
            if (fabs(across) <= half_width) {
                g_assert_cmpuint(maps[0]->pixels[(y * 128 + x) * 4 + 3], ==, 255);
            }
        }
    }
    drop(maps);
}

/// Under transparent texels lies the colour of the blade, so a filter mixes in nothing foreign.
static void test_dilated(void) {
    FrMaterialParams params = sheet(FR_TEXTURE_LEAF);
    params.colour = (vec3s){{0.2f, 0.5f, 0.1f}};
    FrImage *maps[FR_MAP_COUNT];
    make(&params, NULL, maps);
    const uint8_t *corner = maps[FR_MAP_COLOUR]->pixels;
    g_assert_cmpuint(corner[3], ==, 0);
    g_assert_cmpuint(corner[1], >, 80);
    g_assert_cmpuint(corner[1], >, corner[0]);
    g_assert_cmpuint(corner[1], >, corner[2]);
    drop(maps);
}

static void test_limit(void) {
    FrMaterialParams params = sheet(FR_TEXTURE_BARK_SMOOTH);
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.pixels = 128 * 128 - 1;
    FrImage *maps[FR_MAP_COUNT] = {NULL};
    g_assert_cmpint(fr_texture_make(&params, "stem", (FrSpan){0}, &context, maps), ==,
                    FR_ERR_LIMIT);
    g_assert_null(maps[FR_MAP_COLOUR]);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-pixels");
    fr_diags_free(context.diags);
}

static void test_cancel(void) {
    FrMaterialParams params = sheet(FR_TEXTURE_LEAF);
    FrContext context = fr_context_default();
    context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(context.progress);
    FrImage *maps[FR_MAP_COUNT] = {NULL};
    g_assert_cmpint(fr_texture_make(&params, "leaf", (FrSpan){0}, &context, maps), ==,
                    FR_CANCELLED);
    g_assert_null(maps[FR_MAP_COLOUR]);
    fr_progress_free(context.progress);
}

/// Extremes of every parameter make a picture.
static void test_extremes(void) {
    for (int kind = FR_TEXTURE_LEAF; kind <= FR_TEXTURE_BARK_PLATED; kind++) {
        FrMaterialParams params = sheet(kind);
        params.size = 16;
        params.vein_density = 8;
        params.teeth = 200;
        params.tooth_depth = 0.5;
        params.colour = (vec3s){{0, 0, 0}};
        params.second_colour = (vec3s){{1, 1, 1}};
        FrImage *maps[FR_MAP_COUNT];
        make(&params, NULL, maps);
        g_assert_cmpuint(maps[FR_MAP_NORMAL]->pixels[2], >=, 127);
        drop(maps);
    }
}

static void test_show(void) {
    const char *folder = g_getenv("FROND_TEXTURES");
    if (folder == NULL) {
        g_test_skip("FROND_TEXTURES is not set");
        return;
    }
    static const char *const map_names[] = {"colour", "normal", "roughness"};
    for (int kind = FR_TEXTURE_LEAF; kind <= FR_TEXTURE_BARK_PLATED; kind++) {
        FrMaterialParams params = sheet(kind);
        params.size = 512;
        params.teeth = 24;
        FrImage *maps[FR_MAP_COUNT];
        make(&params, NULL, maps);
        for (int map = 0; map < FR_MAP_COUNT; map++) {
            char *path = g_strdup_printf("%s/%s-%s.png", folder, names[kind], map_names[map]);
            GBytes *png = fr_image_to_png(maps[map]);
            g_assert_true(g_file_set_contents(path, g_bytes_get_data(png, NULL),
                                              (gssize)g_bytes_get_size(png), NULL));
            g_bytes_unref(png);
            g_free(path);
        }
        drop(maps);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/material/texture/any number of threads makes the same bytes", test_threads);
    g_test_add_func("/material/texture/another seed makes another picture", test_seed);
    g_test_add_func("/material/texture/normals have unit length", test_normals);
    g_test_add_func("/material/texture/normals point away from slopes, green upwards",
                    test_normal_directions);
    g_test_add_func("/material/texture/barks continue over their edges", test_tiles);
    g_test_add_func("/material/bark/fields repeat with the tile", test_fields_repeat);
    g_test_add_func("/material/texture/the opaque part has the area of the outline", test_alpha);
    g_test_add_func("/material/texture/a blade is opaque up to its outline", test_no_rim);
    g_test_add_func("/material/texture/colour goes on under transparent texels", test_dilated);
    g_test_add_func("/material/texture/a size over the limit makes nothing", test_limit);
    g_test_add_func("/material/texture/a cancelled picture is not kept", test_cancel);
    g_test_add_func("/material/texture/the ends of every range make a picture", test_extremes);
    g_test_add_func("/material/texture/pictures can be written to look at", test_show);
    return g_test_run();
}
