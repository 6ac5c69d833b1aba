// What stems meet: bodies they end at, are cut off at, turn away from; objects read from files.
#include "graphs.h"

#include "frond/skin.h"

#include <cglm/struct.h>
#include <glib/gstdio.h>
#include <math.h>

static float top_of(const FrPlant *plant) {
    float top = -INFINITY;
    for (uint32_t k = 0; k < plant->nodes.count; k++) {
        top = fmaxf(top, plant->nodes.position[k].z);
    }
    return top;
}

static void stop(void) {
    // A roof a metre up: the stem ends there and bears its flower, but nothing that was above.
    Built built = build("force roof kind=box;place=0,0,1;size=4,4,.2;solid=stop;strength=0\n"
                        "tree T length=2;number=20;start=0\nleaf L\nsimple S\n"
                        "roof - T\nT = L\nT - S");
    const FrPlant *plant = built.plant;
    g_assert_cmpfloat_with_epsilon(top_of(plant), 1, 1e-3);
    g_assert_cmpuint(plant->organs.count, ==, 10 + 1);
    g_assert_cmpuint(plant->organs.node[plant->organs.count - 1], ==, plant->axes.last[0]);
    g_assert_cmpuint(plant->axes.flags[0] & FR_CUT, ==, 0);
    built_free(built);
}

static void prune(void) {
    Built built = build("force hedge kind=cylinder;inverted=yes;size=1,1,1;solid=prune;strength=0\n"
                        "tree T length=2;number=20;start=0;branching-angle=90\n"
                        "horn H length=3;radius=.005\nsimple S\nhedge - T\nT = H\nT - S\nH - S");
    const FrPlant *plant = built.plant;
    for (uint32_t k = 0; k < plant->nodes.count; k++) {
        vec3s at = plant->nodes.position[k];
        g_assert_cmpfloat(at.z, <=, 1.001F);
        g_assert_cmpfloat(hypotf(at.x, at.y), <=, 0.501F);
    }
    g_assert_cmpuint(plant->axes.count, ==, 1 + 10);
    g_assert_cmpuint(plant->organs.count, ==, 0);
    g_assert_cmpuint(plant->axes.flags[0] & FR_CUT, !=, 0);
    built_free(built);
}

static void from_outside(void) {
    // A trunk that begins outside of its crown's form grows into it and ends at the top of it.
    Built built = build("force crown kind=point;radius=.5;place=0,0,1.5;inverted=yes;solid=prune;"
                        "strength=0\nhorn T length=3\ncrown - T");
    g_assert_cmpfloat_with_epsilon(top_of(built.plant), 2, 1e-3);
    built_free(built);
    built = build("force crown kind=point;radius=.5;place=0,0,1.5;inverted=yes;solid=prune;"
                  "strength=0\ntree T length=3;number=3;start=0;end=.3\nhorn H\n"
                  "crown - T\nT = H");
    g_assert_cmpuint(built.plant->axes.count, ==, 1);
    built_free(built);
}

static void arms_are_cut(void) {
    Built built =
        build("force roof kind=box;place=0,0,.3;size=4,4,.2;solid=prune;strength=0\n"
              "tree T length=2;forks=2;number=10;start=.5\nleaf L\nroof - T\nT = L\nT - L");
    g_assert_cmpuint(built.plant->axes.count, ==, 1);
    g_assert_cmpuint(built.plant->organs.count, ==, 0);
    built_free(built);
}

static void avoid(void) {
    const char *text = "force ball kind=point;radius=.3;place=.1,0,1;action=avoid;strength=%s;"
                       "reach=.5\nhorn H length=1;force-weight=%s\nball - H";
    float aside[3];
    static const char *const values[3][2] = {{"0", "1"}, {"10", "1"}, {"10", "0"}};
    for (int k = 0; k < 3; k++) {
        char *own = g_strdup_printf(text, values[k][0], values[k][1]);
        Built built = build(own);
        aside[k] = built.plant->nodes.position[built.plant->nodes.count - 1].x;
        built_free(built);
        g_free(own);
    }
    g_assert_cmpfloat(aside[0], ==, 0);
    g_assert_cmpfloat(aside[1], <, -0.1F);
    g_assert_cmpfloat(aside[2], ==, 0);
}

static void orders(void) {
    // The trunk feels the wind, its branches do not.
    Built built = build("force wind kind=direction;direction=1,0,0;strength=4;order-factor=0\n"
                        "tree T length=1;number=1;start=1;spacing=ends;branching-angle=0\n"
                        "horn H length=1\nwind - T\nT = H");
    const FrPlant *plant = built.plant;
    g_assert_cmpuint(plant->axes.count, ==, 2);
    vec3s a = fr_frame_heading(plant->nodes.frame[plant->axes.first[1]]);
    vec3s b = fr_frame_heading(plant->nodes.frame[plant->axes.last[1]]);
    g_assert_cmpfloat(glms_vec3_distance(a, b), <, 1e-5F);
    a = fr_frame_heading(plant->nodes.frame[plant->axes.first[0]]);
    g_assert_cmpfloat(glms_vec3_distance(a, b), >, 0.5F);
    built_free(built);
}

// ---- files --------------------------------------------------------------------------------------

// A cube of two metres on the ground, y up, in two materials.
static const char cube[] = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
                           "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                           "usemtl a\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\n"
                           "usemtl b\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

static Built build_with_cube(const char *text) {
    char *folder = g_dir_make_tmp("frond-cube-XXXXXX", NULL);
    char *path = g_build_filename(folder, "cube.obj", NULL);
    g_assert_true(g_file_set_contents(path, cube, -1, NULL));
    FrPgraph *graph = graph_read(text);
    fr_pgraph_set_folder(graph, folder);
    Built built = build_graph(graph, NULL);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return built;
}

static void simple_file(void) {
    Built built = build_with_cube("simple S primitive=mesh;file=cube.obj;scale=.5\n"
                                  "simple T size=.1\nS - T");
    const FrPlant *plant = built.plant;
    assert_sound(plant);
    g_assert_cmpuint(plant->organs.count, ==, 3);
    g_assert_cmpuint(plant->materials->len, ==, 2);
    g_assert_cmpfloat(plant->organs.offset[2].z, ==, 1);
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *mesh;
    g_assert_cmpint(fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh), ==, FR_OK);
    g_assert_cmpuint(mesh->index_count, ==, 3 * 24);
    fr_mesh_free(mesh);
    built_free(built);
}

static void string_of_files(void) {
    Built built = build_with_cube("horn H primitive=mesh;file=cube.obj;segments=4;radius=.1");
    g_assert_cmpuint(built.plant->organs.count, ==, 2 * 4);
    built_free(built);
}

static void along_a_file(void) {
    // Up the cube's side, over its edge and on along its top, never inside.
    Built built = build_with_cube("force F kind=mesh;file=cube.obj;radius=.05;strength=20;"
                                  "reach=.15;solid=yes;step=.03\n"
                                  "horn H length=3;radius=.01;translate-x=1.2;rotate-y=-10\nF - H");
    const FrPlant *plant = built.plant;
    for (uint32_t k = 0; k < plant->nodes.count; k++) {
        vec3s at = plant->nodes.position[k];
        bool is_inside = fabsf(at.x) < 1 && fabsf(at.y) < 1 && at.z < 2;
        g_assert_false(is_inside);
    }
    vec3s tip = plant->nodes.position[plant->nodes.count - 1];
    g_assert_cmpfloat(tip.z, >, 2);
    g_assert_cmpfloat(tip.x, <, 0.8F);
    built_free(built);
}

static void missing_files(void) {
    static const char *const texts[] = {
        "simple S primitive=mesh",
        "simple S primitive=mesh;file=none.obj",
        "horn H primitive=mesh;file=../cube.obj",
        "force F kind=mesh;file=cube.blend\nhorn H\nF - H",
    };
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        Built built = build_with_cube(texts[k]);
        g_assert_cmpint(built.status, ==, FR_ERR_DOCUMENT);
        g_assert_null(built.plant);
        built_free(built);
    }
}

static FrPgraphBuild *rebuild(const char *text, const FrPgraphBuild *last) {
    FrContext context = fr_context_default();
    FrPgraph *graph = graph_read(text);
    FrPgraphBuild *made;
    g_assert_cmpint(fr_pgraph_rebuild(graph, last, &context, &made), ==, FR_OK);
    fr_pgraph_free(graph);
    return made;
}

static void rebuilt(void) {
    static const char *const texts[] = {
        "force B kind=box;place=0,0,1;solid=prune;strength=0\ntree T length=2;number=40\nhorn H\n"
        "B - T\nT = H",
        "force B kind=box;place=0,0,1;solid=prune;strength=0\ntree T length=2;number=40\n"
        "horn H length=.5\nB - T\nT = H",
        "force B kind=box;place=0,0,9;solid=prune;strength=0\ntree T length=2;number=40\n"
        "horn H length=.5\nB - T\nT = H",
    };
    FrPgraphBuild *last = NULL;
    for (size_t k = 0; k < 2 * G_N_ELEMENTS(texts); k++) {
        const char *text = texts[k % G_N_ELEMENTS(texts)];
        FrPgraphBuild *made = rebuild(text, last), *whole = rebuild(text, NULL);
        g_assert_cmpuint(fr_plant_digest(fr_pgraph_build_plant(made)), ==,
                         fr_plant_digest(fr_pgraph_build_plant(whole)));
        fr_pgraph_build_free(whole);
        fr_pgraph_build_free(last);
        last = made;
    }
    fr_pgraph_build_free(last);
}

static void any_threads(void) {
    uint64_t expected = 0;
    for (int threads = 1; threads <= 8; threads = threads * 2 - (threads == 2)) {
        FrPool *pool = fr_pool_new(threads);
        Built built = build_graph(
            graph_read("force B kind=box;place=.3,0,.5;size=.4,.4,.4;solid=prune;action=avoid\n"
                       "tree T length=1;number=400\nhorn H length=.5;gnarl=20\nB - T\nT = H"),
            pool);
        g_assert_cmpint(built.status, ==, FR_OK);
        uint64_t digest = fr_plant_digest(built.plant);
        expected = threads == 1 ? digest : expected;
        g_assert_cmpuint(digest, ==, expected);
        built_free(built);
        fr_pool_free(pool);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/obstacle/" name, function)
    TEST("a stem that is stopped ends there and bears its tip", stop);
    TEST("what is pruned stays within and loses what hung on it", prune);
    TEST("a trunk may grow into its envelope from outside, branches not", from_outside);
    TEST("what ends before a fork has no arms", arms_are_cut);
    TEST("stems turn away from what they avoid, by their weight", avoid);
    TEST("order-factor 0 is for trunks only", orders);
    TEST("a file stands as a simple with its own materials", simple_file);
    TEST("a file is an object of a string", string_of_files);
    TEST("a stem follows the surface of a file from outside", along_a_file);
    TEST("files that are not there are errors", missing_files);
    TEST("what is pruned is rebuilt as it would be built", rebuilt);
    TEST("any number of threads gives the same bits", any_threads);
    return g_test_run();
}
