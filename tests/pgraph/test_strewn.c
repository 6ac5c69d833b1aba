// Scatter over the triangles of a file.
#include "graphs.h"

#include <cglm/struct.h>
#include <glib/gstdio.h>
#include <math.h>

// A box of 2 by 2 by 1 metres on the ground, y up: its top and bottom have 4 m², each side 2.
static const char box[] = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
                          "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\n"
                          "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                          "f 1/1 2/2 3/3 4/4\nf 5/1 8/4 7/3 6/2\nf 1/1 5/1 6/1 2/1\n"
                          "f 2/1 6/1 7/1 3/1\nf 3/1 7/1 8/1 4/1\nf 4/1 8/1 5/1 1/1\n";

static Built build_with_box(const char *text) {
    char *folder = g_dir_make_tmp("frond-box-XXXXXX", NULL);
    char *path = g_build_filename(folder, "box.obj", NULL);
    char *picture = g_build_filename(folder, "half.png", NULL);
    g_assert_true(g_file_set_contents(path, box, -1, NULL));
    // Left half white, right half black.
    FrImage *image = fr_image_new(2, 1, 1);
    image->pixels[0] = 255;
    GBytes *png = fr_image_to_png(image);
    gsize size;
    const char *bytes = g_bytes_get_data(png, &size);
    g_assert_true(g_file_set_contents(picture, bytes, (gssize)size, NULL));
    g_bytes_unref(png);
    fr_image_unref(image);
    FrPgraph *graph = graph_read(text);
    fr_pgraph_set_folder(graph, folder);
    Built built = build_graph(graph, NULL);
    g_unlink(path);
    g_unlink(picture);
    g_rmdir(folder);
    g_free(path);
    g_free(picture);
    g_free(folder);
    return built;
}

static void by_area(void) {
    Built built = build_with_box("scatter S surface=mesh;file=box.obj;number=1600\n"
                                 "simple C\nS - C");
    const FrOrgans *organs = &built.plant->organs;
    uint32_t top = 0, sides = 0;
    for (uint32_t k = 0; k < organs->count; k++) {
        vec3s at = organs->offset[k];
        float off = fmaxf(fmaxf(fabsf(at.x), fabsf(at.y)), 2 * fabsf(at.z - 0.5F));
        g_assert_cmpfloat_with_epsilon(off, 1, 1e-5);
        top += at.z > 0.9999F;
        sides += at.z > 1e-4F && at.z < 0.9999F;
    }
    // A quarter on the top, half on the four sides; blue noise keeps closer to it than chance.
    g_assert_cmpuint(top, >, 400 - 30);
    g_assert_cmpuint(top, <, 400 + 30);
    g_assert_cmpuint(sides, >, 800 - 40);
    g_assert_cmpuint(sides, <, 800 + 40);
    built_free(built);
}

static void far_apart(void) {
    double nearest[2];
    for (int even = 0; even < 2; even++) {
        Built built = build_with_box(
            even ? "scatter S surface=mesh;file=box.obj;number=300\nsimple C\nS - C"
                 : "scatter S surface=mesh;file=box.obj;number=300;regularity=0\nsimple C\nS - C");
        const FrOrgans *organs = &built.plant->organs;
        double sum = 0;
        for (uint32_t k = 0; k < organs->count; k++) {
            float least = INFINITY;
            for (uint32_t j = 0; j < organs->count; j++) {
                float apart = glms_vec3_distance(organs->offset[j], organs->offset[k]);
                least = j != k ? fminf(least, apart) : least;
            }
            sum += (double)least / organs->count;
        }
        nearest[even] = sum;
        built_free(built);
    }
    g_assert_cmpfloat(nearest[1], >, 1.4 * nearest[0]);
}

static void slopes_and_heights(void) {
    Built built = build_with_box("scatter S surface=mesh;file=box.obj;slope-to=10;mode=density;"
                                 "density=10\nsimple C\nS - C");
    g_assert_cmpuint(built.plant->organs.count, ==, 40);
    for (uint32_t k = 0; k < 40; k++) {
        g_assert_cmpfloat_with_epsilon(built.plant->organs.offset[k].z, 1, 1e-6);
    }
    built_free(built);
    built = build_with_box("scatter S surface=mesh;file=box.obj;height-from=.5;height-to=.7\n"
                           "simple C\nS - C");
    for (uint32_t k = 0; k < built.plant->organs.count; k++) {
        float height = built.plant->organs.offset[k].z;
        g_assert_true(height >= 0.5F && height <= 0.7F);
    }
    built_free(built);
    built = build_with_box("scatter S surface=mesh;file=box.obj;slope-from=20;slope-to=70\n"
                           "simple C\nS - C");
    g_assert_cmpuint(built.plant->organs.count, ==, 0);
    built_free(built);
}

static void normals(void) {
    const char *text = "scatter S surface=mesh;file=box.obj;slope-from=80;slope-to=100;align=%s;"
                       "azimuth=0\nsimple C\nS - C";
    for (int align = 0; align < 2; align++) {
        char *own = g_strdup_printf(text, align ? "1" : "0");
        Built built = build_with_box(own);
        for (uint32_t k = 0; k < built.plant->organs.count; k++) {
            vec3s heading = fr_frame_heading(built.plant->organs.rotation[k]);
            g_assert_cmpfloat_with_epsilon(heading.z, align ? 0 : 1, 1e-5);
        }
        built_free(built);
        g_free(own);
    }
}

static void maps(void) {
    // The top has the whole picture, of which the left half is light.
    Built built = build_with_box("scatter S surface=mesh;file=box.obj;slope-to=10;"
                                 "density-file=half.png\nsimple C\nS - C");
    for (uint32_t k = 0; k < built.plant->organs.count; k++) {
        g_assert_cmpfloat(built.plant->organs.offset[k].x, <=, 0);
    }
    built_free(built);
    built = build_with_box("scatter S surface=mesh;file=box.obj;density-file=no.png\n"
                           "simple C\nS - C");
    g_assert_cmpint(built.status, !=, FR_OK);
    built_free(built);
}

static void one_more(void) {
    Built few = build_with_box("scatter S surface=mesh;file=box.obj;number=50\nsimple C\nS - C");
    Built more = build_with_box("scatter S surface=mesh;file=box.obj;number=51\nsimple C\nS - C");
    for (uint32_t k = 0; k < 50; k++) {
        vec3s a = few.plant->organs.offset[k], b = more.plant->organs.offset[k];
        g_assert_cmpfloat(glms_vec3_distance(a, b), ==, 0);
    }
    built_free(few);
    built_free(more);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/strewn/" name, function)
    TEST("children lie on the triangles, as many as their area", by_area);
    TEST("with regularity they keep apart", far_apart);
    TEST("slopes and heights choose where", slopes_and_heights);
    TEST("align turns children to the normal", normals);
    TEST("a picture says where there are many", maps);
    TEST("one child more leaves all others where they are", one_more);
    return g_test_run();
}
