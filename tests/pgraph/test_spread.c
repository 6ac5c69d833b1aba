// What turns an outline, spreads, scatters and chooses: Revo, Hydra, Wreath, Phyllotaxis, Scatter,
// Variation.
#include "graphs.h"

#include "pgraph/bluenoise.h"

#include "../skin/mesh_check.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREE (G_PI / 180)

// ---- revo -------------------------------------------------------------------------------------

static FrMesh *skinned(const Built *built) {
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *mesh;
    g_assert_cmpint(fr_skin_plant(built->plant, &params, FR_UP_Z, &context, &mesh), ==, FR_OK);
    return mesh;
}

static double revo_volume(const char *text) {
    Built built = build(text);
    FrMesh *mesh = skinned(&built);
    double volume = check_volume(mesh);
    fr_mesh_free(mesh);
    built_free(built);
    return volume;
}

static void revo_is_a_cylinder(void) {
    double volume = revo_volume("revo R outline=1,0 1,2;detail=64");
    g_assert_cmpfloat_with_epsilon(volume, 2 * G_PI, 0.01 * 2 * G_PI);
    // Points from the top down, and below the ground, enclose the same.
    volume = revo_volume("revo R outline=1,1 1,-1;detail=64");
    g_assert_cmpfloat_with_epsilon(volume, 2 * G_PI, 0.01 * 2 * G_PI);
    volume = revo_volume("revo R outline=0,0 1,1 0,2;detail=128;size=2, 1, 3");
    g_assert_cmpfloat_with_epsilon(volume, 2 * 2 * G_PI, 0.01 * 4 * G_PI);
}

static void revo_stands_where_it_is_drawn(void) {
    Built built = build("revo R outline=0.2,-0.5 0.5,1.5 0.1,1.5 0.1,0.25;size=2\n"
                        "simple S primitive=box\nR - S");
    FrMesh *mesh = skinned(&built);
    const FrMeshPart *part = &mesh->parts[0];
    g_assert_cmpfloat_with_epsilon(part->min[2], -1, 1e-6);
    g_assert_cmpfloat_with_epsilon(part->max[2], 3, 1e-6);
    g_assert_cmpfloat_with_epsilon(part->max[0], 1, 1e-6);
    fr_mesh_free(mesh);
    // What follows stands where the outline ends: in the vase.
    uint32_t box = built_organ(&built, "S");
    g_assert_cmpfloat_with_epsilon(built.plant->organs.offset[box].z, 0.5, 1e-6);
    built_free(built);
}

static void revo_open_or_closed(void) {
    Built built = build("revo R outline=1,0 1,2;detail=16;ends=open");
    FrMesh *mesh = skinned(&built);
    g_assert_true(mesh->parts[0].is_foliage); // seen from both sides
    g_assert_cmpuint(mesh->index_count, ==, 16 * 6);
    fr_mesh_free(mesh);
    built_free(built);
    built = build("revo R outline=1,0 1,2;detail=16");
    mesh = skinned(&built);
    g_assert_false(mesh->parts[0].is_foliage);
    g_assert_cmpuint(mesh->index_count, ==, 16 * 12);
    // Its corners are sharp: every normal is that of a face.
    for (uint64_t k = 0; k < mesh->vertex_count; k++) {
        float z = fabsf(mesh->vertices[k].normal[2]);
        g_assert_true(z < 1e-6F || z > 1 - 1e-6F);
    }
    fr_mesh_free(mesh);
    built_free(built);
}

static void revo_needs_an_outline(void) {
    FrPgraph *graph = graph_read("revo R outline=1,1");
    Built built = build_graph(graph, NULL);
    g_assert_cmpint(built.status, ==, FR_ERR_DOCUMENT);
    g_assert_true(built_has(&built, "wrong-outline"));
    built_free(built);
}

// ---- hydra and wreath -------------------------------------------------------------------------

static void assert_arm(const Built *built, uint32_t organ, double azimuth, double radius,
                       bool is_candle) {
    const FrOrgans *organs = &built->plant->organs;
    vec3s outwards = {{(float)cos(azimuth), (float)sin(azimuth), 0}}, up = {{0, 0, 1}};
    vec3s at = organs->offset[organ];
    g_assert_cmpfloat_with_epsilon(glms_vec3_distance(at, glms_vec3_scale(outwards, (float)radius)),
                                   0, 1e-6);
    vec3s heading = fr_frame_heading(organs->rotation[organ]);
    vec3s upper = fr_frame_up(organs->rotation[organ]);
    g_assert_cmpfloat_with_epsilon(glms_vec3_dot(heading, is_candle ? up : outwards), 1, 1e-6);
    g_assert_cmpfloat_with_epsilon(glms_vec3_dot(heading, is_candle ? outwards : up), 0, 1e-6);
    // The upper side of an arm looks along the axis, that of a candle to it.
    g_assert_cmpfloat_with_epsilon(glms_vec3_dot(upper, is_candle ? outwards : up),
                                   is_candle ? -1 : 1, 1e-6);
}

static void ring_of_six(bool is_candle) {
    Built built =
        build(is_candle ? "wreath W radius=.2\nleaf L\nW - L" : "hydra H radius=.2\nleaf L\nH - L");
    g_assert_cmpuint(built.plant->organs.count, ==, 6);
    for (uint32_t i = 0; i < 6; i++) {
        assert_arm(&built, i, i * 60 * DEGREE, 0.2, is_candle);
    }
    built_free(built);
}

static void hydra_is_a_star(void) {
    ring_of_six(false);
    // Part of a turn has children at both ends; an only child stands at the first.
    Built built = build("hydra H number=4;opening=30;closing=120;radius=1\nleaf L\nH - L");
    for (uint32_t i = 0; i < 4; i++) {
        assert_arm(&built, i, (30 + 30 * i) * DEGREE, 1, false);
    }
    built_free(built);
    built = build("hydra H number=1;opening=45;closing=90;radius=1\nleaf L\nH - L");
    assert_arm(&built, 0, 45 * DEGREE, 1, false);
    built_free(built);
    built = build("hydra H number=5;closing=-720;radius=1\nleaf L\nH - L");
    for (uint32_t i = 0; i < 5; i++) {
        assert_arm(&built, i, -144.0 * i * DEGREE, 1, false);
    }
    built_free(built);
}

static void wreath_bears_candles(void) {
    ring_of_six(true);
    // A hydra tilted by a quarter turn is a wreath.
    Built built = build("hydra H radius=.2;tilt=90\nleaf L\nH - L");
    for (uint32_t i = 0; i < 6; i++) {
        assert_arm(&built, i, i * 60 * DEGREE, 0.2, true);
    }
    built_free(built);
}

static void rings(void) {
    Built built = build("wreath W number=3;rings=2;ring-spacing=.5;ring-turn=60;ring-curve=1,1 2,1"
                        ";radius=1\nleaf L only=!0\nW - L");
    g_assert_cmpuint(built.plant->organs.count, ==, 5);
    vec3s last = built.plant->organs.offset[4];
    g_assert_cmpfloat_with_epsilon(last.x, cos(300 * DEGREE), 1e-6);
    g_assert_cmpfloat_with_epsilon(last.z, 0.5, 1e-6);
    built_free(built);
}

// ---- phyllotaxis ------------------------------------------------------------------------------

static void assert_like_phiball(const char *phyllotaxis, const char *phiball) {
    Built one = build(phyllotaxis), other = build(phiball);
    g_assert_cmpuint(one.plant->organs.count, ==, other.plant->organs.count);
    for (uint32_t k = 0; k < one.plant->organs.count; k++) {
        vec3s at = one.plant->organs.offset[k], expected = other.plant->organs.offset[k];
        g_assert_cmpfloat(glms_vec3_distance(at, expected), <, 1e-6F);
        vec3s heading = fr_frame_heading(one.plant->organs.rotation[k]);
        vec3s radial = fr_frame_heading(other.plant->organs.rotation[k]);
        g_assert_cmpfloat(glms_vec3_distance(heading, radial), <, 2e-6F);
    }
    built_free(one);
    built_free(other);
}

static void sphere_is_a_phiball(void) {
    assert_like_phiball("phyllotaxis P number=300;radius=1\nleaf L\nP - L",
                        "phiball P number=300;radius=1\nleaf L\nP - L");
    assert_like_phiball("phyllotaxis P number=50;radius=.3;start=.25;end=.5;push=.1\nleaf L\nP - L",
                        "phiball P number=50;radius=.3;opening=45;closing=90;push=.1\nleaf L\n"
                        "P - L");
    assert_like_phiball(
        "phyllotaxis P number=40;radius-mode=by-area;child-area=.01;end=.5;child-scale=1..2;"
        "influence=1\nleaf L\nP - L",
        "phiball P number=40;radius-mode=by-area;child-area=.01;closing=90;child-scale=1..2;"
        "influence=1\nleaf L\nP - L");
}

static void any_outline(void) {
    // On a cylinder equal areas are equal heights; outwards is away from the axis either way.
    const char *texts[] = {
        "phyllotaxis P number=10;radius=1;outline=.5,0 .5,2;smooth=no\nleaf L\nP - L",
        "phyllotaxis P number=10;radius=1;outline=.5,2 .5,0\nleaf L\nP - L"};
    for (uint32_t k = 0; k < 2; k++) {
        Built built = build(texts[k]);
        for (uint32_t i = 0; i < 10; i++) {
            vec3s at = built.plant->organs.offset[i];
            double height = (i + 0.5) / 5;
            g_assert_cmpfloat_with_epsilon(at.z, k == 0 ? height : 2 - height, 1e-5);
            g_assert_cmpfloat_with_epsilon(hypotf(at.x, at.y), 0.5, 1e-6);
            vec3s heading = fr_frame_heading(built.plant->organs.rotation[i]);
            g_assert_cmpfloat_with_epsilon(heading.x * at.x + heading.y * at.y, 0.5, 1e-5);
        }
        built_free(built);
    }
    // On a disc they are equal rings, as in a flower head.
    Built built = build("phyllotaxis P number=100;radius=1;form=disc\nleaf L\nP - L");
    for (uint32_t i = 0; i < 100; i++) {
        vec3s at = built.plant->organs.offset[i];
        g_assert_cmpfloat_with_epsilon(at.x * at.x + at.y * at.y, (i + 0.5) / 100, 1e-6);
        vec3s heading = fr_frame_heading(built.plant->organs.rotation[i]);
        g_assert_cmpfloat_with_epsilon(heading.z, 1, 1e-6);
    }
    built_free(built);
}

// ---- scatter ----------------------------------------------------------------------------------

static double nearest_pair(const double (*points)[2], uint32_t count) {
    double nearest = INFINITY;
    for (uint32_t a = 0; a < count; a++) {
        for (uint32_t b = 0; b < a; b++) {
            double distance = hypot(points[a][0] - points[b][0], points[a][1] - points[b][1]);
            nearest = fmin(nearest, distance);
        }
    }
    return nearest;
}

static void scatter_keeps_apart(void) {
    enum { COUNT = 500 };
    double(*even)[2] = g_malloc_n(COUNT, sizeof *even);
    double(*chance)[2] = g_malloc_n(COUNT, sizeof *chance);
    for (int form = FR_STREWN_DISC; form <= FR_STREWN_RING; form++) {
        double area = form == FR_STREWN_SQUARE ? 4 : form == FR_STREWN_RING ? 0.75 * G_PI : G_PI;
        fr_bluenoise(even, COUNT, (FrStrewnForm)form, 0.5, 20, 7, NULL, NULL);
        fr_bluenoise(chance, COUNT, (FrStrewnForm)form, 0.5, 1, 7, NULL, NULL);
        double room = sqrt(area / COUNT);
        g_assert_cmpfloat(nearest_pair((const double(*)[2])even, COUNT), >, 0.5 * room);
        g_assert_cmpfloat(nearest_pair((const double(*)[2])chance, COUNT), <, 0.2 * room);
        for (uint32_t k = 0; k < COUNT; k++) {
            double radius = hypot(even[k][0], even[k][1]);
            g_assert_cmpfloat(form == FR_STREWN_SQUARE ? fabs(even[k][0]) : radius, <=, 1);
            g_assert_true(form != FR_STREWN_RING || radius >= 0.5 - 1e-9);
        }
    }
    g_free(even);
    g_free(chance);
}

static void scatter_grid_is_only_faster(void) {
    // The best candidate by looking at all points.
    enum { COUNT = 60, CANDIDATES = 5 };
    double points[COUNT][2], fewer[COUNT / 2][2];
    fr_bluenoise(points, COUNT, FR_STREWN_SQUARE, 0, CANDIDATES, 3, NULL, NULL);
    fr_bluenoise(fewer, COUNT / 2, FR_STREWN_SQUARE, 0, CANDIDATES, 3, NULL, NULL);
    // Other numbers of points have other grids, and the same first points.
    g_assert_true(memcmp(points, fewer, sizeof fewer) == 0);
    for (uint32_t i = 0; i < COUNT; i++) {
        double best = -1, chosen[2] = {0, 0};
        for (uint32_t c = 0; c < CANDIDATES; c++) {
            FrKey key = fr_key_child(3, i);
            double at[2] = {2 * fr_random(key, 0, c) - 1, 2 * fr_random(key, 1, c) - 1};
            double nearest = INFINITY;
            for (uint32_t k = 0; k < i; k++) {
                nearest = fmin(nearest, hypot(points[k][0] - at[0], points[k][1] - at[1]));
            }
            if (nearest > best) {
                best = nearest;
                memcpy(chosen, at, sizeof at);
            }
        }
        g_assert_cmpfloat(chosen[0], ==, points[i][0]);
        g_assert_cmpfloat(chosen[1], ==, points[i][1]);
    }
}

static void scatter_in_a_plant(void) {
    Built built = build("scatter S mode=density;density=25;surface=square;radius=1;rotate-x=60;"
                        "align=0\nleaf L\nS - L");
    g_assert_cmpuint(built.plant->organs.count, ==, 100);
    for (uint32_t k = 0; k < 100; k++) {
        vec3s heading = fr_frame_heading(built.plant->organs.rotation[k]);
        g_assert_cmpfloat_with_epsilon(heading.z, 1, 1e-5);
    }
    built_free(built);
    built = build("scatter S rotate-x=60\nleaf L\nS - L");
    for (uint32_t k = 0; k < 30; k++) {
        vec3s heading = fr_frame_heading(built.plant->organs.rotation[k]);
        g_assert_cmpfloat_with_epsilon(heading.z, 0.5, 1e-5);
    }
    built_free(built);
}

// ---- variation --------------------------------------------------------------------------------

static void variation_by_weight(void) {
    Built built = build("phiball P number=4000\nvariation V weights=3 1 0\nleaf A\nleaf B\nleaf C\n"
                        "P - V\nV - A\nV - B\nV - C");
    g_assert_cmpuint(built.plant->organs.count, ==, 4000);
    g_assert_cmpuint(built_count(&built, "C"), ==, 0);
    double share = (double)built_count(&built, "A") / 4000;
    g_assert_cmpfloat_with_epsilon(share, 0.75, 0.03);
    built_free(built);
}

static void variation_in_turn(void) {
    Built built =
        build("phiball P number=8\nvariation V rule=sequence;weights=2 1\nleaf A\nleaf B\n"
              "P - V\nV - A\nV - B");
    for (uint32_t k = 0; k < 8; k++) {
        uint32_t expected = fr_pgraph_find(built.graph, k % 3 < 2 ? "A" : "B");
        g_assert_cmpuint(built.plant->organs.component[k], ==, expected);
    }
    built_free(built);
    built = build("phiball P number=8\nvariation V rule=choice;choice== i > 4\nleaf A\nleaf B\n"
                  "P - V\nV - A\nV - B");
    g_assert_cmpuint(built_count(&built, "A"), ==, 5);
    built_free(built);
}

static void variation_rolls_nothing_anew(void) {
    const char *few = "tree T mode=internode;internode=.1;length=1;start=0\nvariation V\nleaf A\n"
                      "leaf B\nT = V\nV - A\nV - B";
    const char *more = "tree T mode=internode;internode=.1;length=2;start=0\nvariation V\nleaf A\n"
                       "leaf B\nT = V\nV - A\nV - B";
    Built one = build(few), other = build(more);
    g_assert_cmpuint(one.plant->organs.count, ==, 11);
    for (uint32_t k = 0; k < 11; k++) {
        g_assert_cmpuint(one.plant->organs.path[k], ==, other.plant->organs.path[k]);
        g_assert_cmpuint(one.plant->organs.component[k], ==, other.plant->organs.component[k]);
    }
    built_free(one);
    built_free(other);
}

static void variation_goes_on_in_the_tube(void) {
    Built built = build("horn A\nvariation V\nhorn B\nA - V\nV - B");
    g_assert_true((built.plant->axes.flags[1] & FR_CONTINUES) != 0);
    built_free(built);
    // Stems of a variation begin on the axis, as other stems do.
    built = build("tree A number=1;radius=.1\nvariation V\nhorn B\nA = V\nV - B");
    g_assert_cmpfloat(built.plant->axes.offset[1].x, ==, 0);
    built_free(built);
}

static void variation_with_wrong_weights(void) {
    const char *wrong[] = {"1 x", "0 0", "1 2 3", "-1 2", "1e9 1"};
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        FrPgraph *graph = graph_read("variation V\nleaf A\nleaf B\nV - A\nV - B");
        graph_set(graph, "V", "weights", wrong[k]);
        Built built = build_graph(graph, NULL);
        g_assert_cmpint(built.status, ==, FR_ERR_DOCUMENT);
        g_assert_true(built_has(&built, "wrong-weights"));
        built_free(built);
    }
}

// ---- all of them ------------------------------------------------------------------------------

static void limits(void) {
    static const char *const texts[] = {
        "hydra A number=10000;rings=1000\nhydra B number=1000\nleaf L\nA - B\nB - L",
        "scatter A mode=density;density=1000000;radius=10000\nleaf L\nA - L",
        "phyllotaxis A number=1000000\nphyllotaxis B number=1000000\nleaf L\nA - B\nB - L",
    };
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        Built built = build_graph(graph_read(texts[k]), NULL);
        g_assert_cmpint(built.status, ==, FR_ERR_LIMIT);
        g_assert_true(built_has(&built, "limit-instances"));
        built_free(built);
    }
}

// Places are counted even where nothing will stand on them.
static void limits_of_empty_places(void) {
    static const char *const texts[] = {
        "scatter S mode=density;radius=10000\nleaf L enabled=no\nS = L",
        "scatter S mode=density;radius=10000\nleaf L only=25\nS = L",
    };
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        Built built = build_graph(graph_read(texts[i]), NULL);
        g_assert_cmpint(built.status, ==, FR_ERR_LIMIT);
        g_assert_true(built_has(&built, "limit-instances"));
        built_free(built);
    }
}

static void degenerate(void) {
    built_free(build("phyllotaxis P outline=0,0 0,1;number=9\nleaf L\nP - L"));
    built_free(build("phyllotaxis P outline=1,1 1,1;number=9;start=1;end=0\nleaf L\nP - L"));
    built_free(build("scatter S radius=0;inner-radius=0;surface=ring\nleaf L\nS - L"));
    built_free(build("hydra H number=0\nleaf L\nH - L"));
    built_free(build("variation V"));
    revo_volume("revo R outline=0,0 0,0");
    revo_volume("revo R outline=0,0 0,1 0,1;size=0");
}

static void same_for_any_threads(void) {
    FrDigest digest = 0;
    static const int threads[] = {1, 2, 3, 8};
    for (size_t k = 0; k < G_N_ELEMENTS(threads); k++) {
        FrPool *pool = fr_pool_new(threads[k]);
        Built built = build_graph(
            graph_read(
                "scatter S number=40\nvariation V weights=3 2 1\nhydra H number=5 ~ 2;tilt=0 ~ 9\n"
                "wreath W number=3;rings=2\nphyllotaxis P number=9;form=cone;push=0 ~ .01\n"
                "tree T crown=flame;break-chance=.3;flare=1;whorl=1..3;sweep=90\n"
                "revo R size=.1\nleaf L scale=1 ~ .2 | parent dome\n"
                "S - V\nV - H\nV - W\nV - P\nH - T\nW - T\nP - R\nT = L\nT - L"),
            pool);
        g_assert_cmpint(built.status, ==, FR_OK);
        assert_sound(built.plant);
        g_assert_cmpuint(built.plant->organs.count, >, 1000);
        FrDigest now = fr_plant_digest(built.plant);
        g_assert_true(k == 0 || now == digest);
        digest = now;
        built_free(built);
        fr_pool_free(pool);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/" name, function)
    TEST("C2 a straight outline turned about the axis is a cylinder", revo_is_a_cylinder);
    TEST("C2 a revo stands where its outline is drawn", revo_stands_where_it_is_drawn);
    TEST("C2 ends of a revo are closed or open", revo_open_or_closed);
    TEST("C2 a revo without an outline is refused", revo_needs_an_outline);
    TEST("C24 a hydra stands its children as a star", hydra_is_a_star);
    TEST("C25 a wreath stands its children as candles", wreath_bears_candles);
    TEST("C24 C25 rings stand one above the other", rings);
    TEST("C26 a phyllotaxis on a sphere is a phiball", sphere_is_a_phiball);
    TEST("a phyllotaxis gives equal area on any outline", any_outline);
    TEST("scattered children keep apart", scatter_keeps_apart);
    TEST("scattered points are the best candidates and stay with more",
         scatter_grid_is_only_faster);
    TEST("a scatter follows its surface or stays upright", scatter_in_a_plant);
    TEST("a variation chooses by weight", variation_by_weight);
    TEST("a variation chooses in turn or by number", variation_in_turn);
    TEST("a variation rolls nothing anew", variation_rolls_nothing_anew);
    TEST("what a variation chooses goes on like it", variation_goes_on_in_the_tube);
    TEST("wrong weights are errors", variation_with_wrong_weights);
    TEST("spread plants are the same for any number of threads", same_for_any_threads);
    TEST("multipliers count before they make", limits);
    TEST("multipliers count places on which nothing stands", limits_of_empty_places);
    TEST("empty outlines and radii make no harm", degenerate);
    return g_test_run();
}
