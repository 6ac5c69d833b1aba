/// L-systems that ask for free space, what grows around them, and both half grown.
#include "frond/simulation.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

typedef struct Run {
    FrContext context;
    FrDocument *document;
    FrSimulation *simulation;
} Run;

static Run begin(const char *text, int threads) {
    Run run = {.context = fr_context_default()};
    run.context.diags = fr_diags_new();
    run.context.pool = fr_pool_new(threads);
    FrSource *source = fr_source_new("room.frond", text, strlen(text));
    FrStatus status = fr_document_parse(source, NULL, &run.context, &run.document);
    if (status == FR_OK) {
        status = fr_simulation_new(run.document, -1, 0, &run.context, &run.simulation);
    }
    GString *said = g_string_new(NULL);
    fr_diags_print(run.context.diags, said);
    g_test_message("%s", said->str);
    g_string_free(said, TRUE);
    g_assert_cmpint(status, ==, FR_OK);
    fr_source_unref(source);
    return run;
}

static void step(Run *run, int count) {
    for (int i = 0; i < count; i++) {
        g_assert_cmpint(fr_simulation_step(run->simulation, &run->context), ==, FR_OK);
    }
}

static void end(Run *run) {
    fr_simulation_free(run->simulation);
    fr_document_free(run->document);
    fr_diags_free(run->context.diags);
    fr_pool_free(run->context.pool);
}

static const FrScene *scene_of(Run *run) {
    const FrScene *scene;
    g_assert_cmpint(fr_simulation_scene(run->simulation, &run->context, &scene), ==, FR_OK);
    return scene;
}

/// The whole document built.
static FrScene *build(const char *text) {
    Run run = begin(text, 1);
    FrScene *scene;
    g_assert_cmpint(fr_scene_build(run.document, -1, &run.context, &scene), ==, FR_OK);
    end(&run);
    return scene;
}

static vec3s world_of(const FrScene *scene, guint stand, vec3s at) {
    const FrStand *where = &g_array_index(scene->stands, FrStand, stand);
    at = glms_vec3_rotate(glms_vec3_scale(at, (float)where->scale), (float)where->turn,
                          (vec3s){{0, 0, 1}});
    for (int axis = 0; axis < 3; axis++) {
        at.raw[axis] += (float)where->at[axis];
    }
    return at;
}

static const FrPlant *plant_at(const FrScene *scene, guint stand) {
    uint32_t plant = g_array_index(scene->stands, FrStand, stand).plant;
    return g_array_index(scene->plants, FrScenePlant, plant).plant;
}

static vec3s tip_of(const FrScene *scene, guint stand) {
    const FrPlant *plant = plant_at(scene, stand);
    g_assert_cmpuint(plant->nodes.count, >, 0);
    return world_of(scene, stand, plant->nodes.position[plant->nodes.count - 1]);
}

#define LSYSTEM(id, text) "<plant id='" id "'><lsystem><![CDATA[\n" text "\n]]></lsystem></plant>"
#define DOCUMENT(plants, scene)                                                                    \
    "<frond version='1'>" plants "<scene ground='no'>" scene "</scene></frond>"
// Goes on while the way ahead is free for its own internode and one of somebody else.
#define AHEAD                                                                                      \
    "derivation length: 20\nw : &(90)!(0.04)D(?,?)A\n"                                             \
    "p1 : D(d,a) < A : a > 0.5 -> F(0.2)D(?,?)A"
// The same upwards, by the room around it.
#define AROUND "derivation length: 20\nw : !(0.04)D(?)A\np1 : D(d) < A : d > 0.5 -> F(0.2)D(?)A"

static void test_facing(void) {
    FrScene *scene =
        build(DOCUMENT(LSYSTEM("p", AHEAD), "<place plant='p' at='0, -2, 1'/>"
                                            "<place plant='p' at='0, 2, 1' turn='180'/>"));
    float gap = glms_vec3_distance(tip_of(scene, 0), tip_of(scene, 1));
    g_assert_cmpfloat(gap, >, 0.1f);
    g_assert_cmpfloat(gap, <, 0.55f);
    fr_scene_free(scene);
    scene = build(DOCUMENT(LSYSTEM("p", AHEAD), "<place plant='p' at='0, -2, 1'/>"));
    g_assert_cmpuint(plant_at(scene, 0)->nodes.count, ==, 20); // alone it is free
    fr_scene_free(scene);
}

static void test_below(void) {
    FrScene *scene = build(DOCUMENT(LSYSTEM("p", AROUND),
                                    "<obstacle at='0, 0, 2' size='1, 1, 0.2'/><place plant='p'/>"));
    float height = tip_of(scene, 0).z;
    g_assert_cmpfloat(height, >, 1.3f); // the box begins at 2 m; 0.2 m more come after 0.5 m
    g_assert_cmpfloat(height, <, 1.75f);
    fr_scene_free(scene);
}

#define BEAM                                                                                       \
    "<plant id='beam'><pgraph><camera id='c'/><tree id='t' length='2' radius='0.05' "              \
    "gnarl='0'/><link from='c' to='t'/></pgraph></plant>"

/// Wood of plants from components counts where it stands, and theirs is scaled.
static void test_wood(void) {
    FrScene *scene = build(DOCUMENT(LSYSTEM("p", AHEAD) BEAM, "<place plant='p' at='0, -2, 1'/>"
                                                              "<place plant='beam'/>"));
    float end_at = fabsf(tip_of(scene, 0).y);
    g_assert_cmpfloat(end_at, >, 0.3f);
    g_assert_cmpfloat(end_at, <, 0.6f);
    fr_scene_free(scene);
    // Half as large it measures in its own metres: 0.25 m of the world.
    scene = build(DOCUMENT(LSYSTEM("p", AHEAD) BEAM, "<place plant='p' at='0, -1, 1' scale='0.5'/>"
                                                     "<place plant='beam'/>"));
    end_at = fabsf(tip_of(scene, 0).y);
    g_assert_cmpfloat(end_at, >, 0.15f);
    g_assert_cmpfloat(end_at, <, 0.32f);
    fr_scene_free(scene);
}

/// ?E has room for the light, then for space; who has no light gets what the model says.
static void test_both(void) {
    FrScene *scene = build(DOCUMENT(
        LSYSTEM("p", "derivation length: 12\nw : !(0.04)?E(0,0,0,0,0,0,0)A\n"
                     "p1 : E(i,x,y,z,c,d,a) < A : a > 0.5 && i > 0 -> F(0.2)?E(0,0,0,0,0,0,0)A"),
        "<light near='0.1'/><obstacle at='0, 0, 2' size='0.2, 0.2, "
        "0.2'/><place plant='p'/>"));
    float height = tip_of(scene, 0).z;
    g_assert_cmpfloat(height, >, 1.3f);
    g_assert_cmpfloat(height, <, 1.75f);
    fr_scene_free(scene);
}

// ---- beside buds ------------------------------------------------------------------------------

// Branches to the left and to the right in turn.
#define MIXED(surroundings)                                                                        \
    DOCUMENT(                                                                                      \
        LSYSTEM("p",                                                                               \
                "derivation length: 7\nw : &(90)!(0.03)D(?,?)A(1)\n"                               \
                "p1 : D(d,a) < A(s) : a > 0.6 && d > 0.1 -> "                                      \
                "F(0.2)[+(50*s)D(?,?)A(s)]D(?,?)A(-s)") "<plant id='t'><species model='open' "     \
                                                        "step='0.2' auxin-reach='1' dormancy='0' " \
                                                        "leaves='0' shed='none'/></plant>",        \
        "<growth steps='7' min='-3, -3, -1' max='3, 3, 4' cell='0.03'/>" surroundings              \
        "<place plant='p' at='0, -1, 0.7'/><place plant='p' at='0, 1, 0.9' turn='180'/>"           \
        "<place plant='t' at='0, 0, 0'/>")

static vec3s base_of(const FrPlant *plant, uint32_t node) {
    uint32_t parent = plant->nodes.parent[node];
    vec3s along = fr_frame_heading(plant->nodes.frame[node]);
    return parent == FR_NONE ? glms_vec3_sub(plant->nodes.position[node],
                                             glms_vec3_scale(along, plant->nodes.length[node]))
                             : plant->nodes.position[parent];
}

static float segment_distance(vec3s at, vec3s from, vec3s to) {
    vec3s along = glms_vec3_sub(to, from);
    float square = glms_vec3_norm2(along);
    float part = square > 0 ? glms_vec3_dot(glms_vec3_sub(at, from), along) / square : 0;
    part = CLAMP(part, 0, 1);
    return glms_vec3_distance(at, glms_vec3_add(from, glms_vec3_scale(along, part)));
}

/// How near the axes of two plants come to each other.
static float nearest(const FrScene *scene, guint one, guint other) {
    enum { PLACES = 8 };
    const FrPlant *a = plant_at(scene, one), *b = plant_at(scene, other);
    float least = INFINITY;
    for (uint32_t i = 0; i < a->nodes.count; i++) {
        vec3s from = world_of(scene, one, base_of(a, i));
        vec3s to = world_of(scene, one, a->nodes.position[i]);
        for (uint32_t j = 0; j < b->nodes.count; j++) {
            vec3s begin_at = world_of(scene, other, base_of(b, j));
            vec3s end_at = world_of(scene, other, b->nodes.position[j]);
            for (int k = 0; k <= PLACES; k++) {
                vec3s at = glms_vec3_lerp(from, to, (float)k / PLACES);
                least = fminf(least, segment_distance(at, begin_at, end_at));
            }
        }
    }
    return least;
}

static void test_mixed(void) {
    FrScene *scene = build(MIXED(""));
    g_assert_cmpuint(plant_at(scene, 0)->nodes.count, >, 20);
    g_assert_cmpuint(plant_at(scene, 2)->nodes.count, >, 25);
    for (guint i = 0; i < 2; i++) {
        float gap = nearest(scene, 2, i);
        g_test_message("%u: %g m", i, (double)gap);
        g_assert_cmpfloat(gap, >, 0.015f); // the radius of the L-system's wood
    }
    fr_scene_free(scene);
}

static FrDigest digest_after(const char *text, int threads, int steps) {
    Run run = begin(text, threads);
    step(&run, steps);
    FrDigest digest = fr_scene_digest(scene_of(&run));
    end(&run);
    return digest;
}

static void test_threads(void) {
    FrDigest one = digest_after(MIXED("<light near='0.1' photons='500'/>"), 1, 6);
    for (int threads = 2; threads <= 8; threads = threads == 3 ? 8 : threads + 1) {
        g_assert_cmpuint(digest_after(MIXED("<light near='0.1' photons='500'/>"), threads, 6), ==,
                         one);
    }
}

// ---- half grown -------------------------------------------------------------------------------

/// Saves after each step and goes on in a new simulation.
static void check_resumed(const char *text, int steps) {
    Run whole = begin(text, 1), parts = begin(text, 1);
    for (int i = 0; i < steps; i++) {
        step(&whole, 1);
        step(&parts, 1);
        GBytes *bytes = fr_simulation_save(parts.simulation, &parts.context);
        g_assert_nonnull(bytes);
        end(&parts);
        parts = begin(text, 1);
        gsize size;
        const void *data = g_bytes_get_data(bytes, &size);
        g_assert_cmpint(
            fr_simulation_restore(parts.simulation, data, size, (FrSpan){0}, &parts.context), ==,
            FR_OK);
        g_bytes_unref(bytes);
        g_assert_cmpuint(fr_simulation_stats(whole.simulation).digest, ==,
                         fr_simulation_stats(parts.simulation).digest);
    }
    step(&whole, 1);
    step(&parts, 1);
    g_assert_cmpuint(fr_scene_digest(scene_of(&whole)), ==, fr_scene_digest(scene_of(&parts)));
    g_assert_cmpuint(scene_of(&whole)->steps->len, ==, scene_of(&parts)->steps->len);
    end(&whole);
    end(&parts);
}

static void test_resumed(void) {
    check_resumed(MIXED(""), 6);
}

static void test_resumed_in_light(void) {
    check_resumed(MIXED("<light near='0.1' photons='500'/>"), 5);
}

static void test_resumed_alone(void) {
    check_resumed(DOCUMENT(LSYSTEM("p", AHEAD), "<place plant='p' at='0, -2, 1'/>"
                                                "<place plant='p' at='0, 2, 1' turn='180'/>"),
                  6);
}

/// Where the digest of what follows stands in the head: behind two names and another digest.
enum { CONTENT_AT = 40, HEAD = 72 };

/// Changed bytes whose digest is right again are refused, or are a state that can go on.
static void test_wrong(void) {
    Run run = begin(MIXED(""), 1);
    step(&run, 4);
    GBytes *bytes = fr_simulation_save(run.simulation, &run.context);
    FrDigest wanted = fr_simulation_stats(run.simulation).digest;
    gsize size;
    uint8_t *data = g_bytes_unref_to_data(bytes, &size);
    uint64_t growth, growing;
    memcpy(&growth, data + CONTENT_AT + 8, sizeof growth);
    memcpy(&growing, data + CONTENT_AT + 16, sizeof growing);
    FrDigest content = fr_digest(0, data + HEAD, size - HEAD);
    g_assert_true(memcmp(&content, data + CONTENT_AT, sizeof content) == 0);
    uint32_t refused = 0;
    for (gsize at = HEAD + growth; at < HEAD + growth + growing; at += 5) {
        data[at] ^= 0x81;
        content = fr_digest(0, data + HEAD, size - HEAD);
        memcpy(data + CONTENT_AT, &content, sizeof content);
        FrStatus status =
            fr_simulation_restore(run.simulation, data, size, (FrSpan){0}, &run.context);
        refused += status == FR_ERR_DOCUMENT;
        g_assert_true(status == FR_ERR_DOCUMENT || status == FR_OK);
        g_assert_cmpuint(fr_simulation_stats(run.simulation).digest, ==, wanted);
        data[at] ^= 0x81;
    }
    g_assert_cmpuint(refused, >, growing / 5 / 2);
    content = fr_digest(0, data + HEAD, size - HEAD);
    memcpy(data + CONTENT_AT, &content, sizeof content);
    g_assert_cmpint(fr_simulation_restore(run.simulation, data, size, (FrSpan){0}, &run.context),
                    ==, FR_OK);
    step(&run, 1);
    g_free(data);
    end(&run);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/room/two L-systems that face each other stop before they meet",
                    test_facing);
    g_test_add_func("/scene/room/an L-system stops below an obstacle", test_below);
    g_test_add_func("/scene/room/an L-system stops before the wood of other plants", test_wood);
    g_test_add_func("/scene/room/?E tells of light and of space", test_both);
    g_test_add_func("/scene/room/a tree and L-systems that grow at once keep off each other",
                    test_mixed);
    g_test_add_func("/scene/room/the bits do not depend on threads", test_threads);
    g_test_add_func("/scene/room/L-systems and trees saved after each step go on alike",
                    test_resumed);
    g_test_add_func("/scene/room/in light they do so too", test_resumed_in_light);
    g_test_add_func("/scene/room/L-systems alone can be saved", test_resumed_alone);
    g_test_add_func("/scene/room/wrong answers in a saved state are noticed", test_wrong);
    return g_test_run();
}
