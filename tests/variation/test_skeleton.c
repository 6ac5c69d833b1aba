#include "plants.h"

#include <math.h>
#include <string.h>

/// A plant of `count` internodes that grow from any before them, in any direction.
static FrPlant *random_plant(uint32_t count, uint64_t seed) {
    FrPlant *plant = fr_plant_new("random");
    FrKey key = fr_key_root(seed);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t parent =
            i == 0 ? FR_NONE : i - 1 - (uint32_t)(fr_random(key, 1, i) * (double)MIN(i, 9));
        uint32_t axis = i > 0 && plant->nodes.next[parent] == FR_NONE
                            ? plant->nodes.axis[parent]
                            : fr_plant_add_axis(plant, parent, (vec3s){{0, 0, 0}}, 0.1f);
        vec3s about = {{(float)fr_random_signed(key, 2, i), (float)fr_random_signed(key, 3, i), 0}};
        versors turn = i == 0 ? GLMS_QUAT_IDENTITY
                              : fr_rotation_about(glms_vec3_normalize(about),
                                                  0.1f + 0.8f * (float)fr_random(key, 4, i));
        float length = 0.2f + 0.01f * floorf(10 * (float)fr_random(key, 5, i));
        fr_plant_add_node(plant, axis, turn, length, 0.1f);
    }
    plant->axes.offset[0].z = 0;
    return plant;
}

/// A digest that is the same for isomorphic trees with the same lengths (to 1 cm).
static uint64_t tree_digest(const FrPlant *plant) {
    uint32_t count = plant->nodes.count;
    uint64_t *sum = g_new0(uint64_t, count + 1);
    uint64_t roots = 0;
    for (uint32_t i = count; i-- > 0;) {
        uint64_t own = fr_mix64(sum[i] + (uint64_t)lrintf(plant->nodes.length[i] * 100) * 977 + 1);
        uint32_t parent = plant->nodes.parent[i];
        if (parent == FR_NONE) {
            roots += fr_mix64(own);
        } else {
            sum[parent] += fr_mix64(own);
        }
    }
    g_free(sum);
    return roots;
}

static void shuffle(FrSegment *segments, size_t count) {
    FrKey key = fr_key_root(77);
    for (size_t i = count; i > 1; i--) {
        size_t j = (size_t)(fr_random(key, 1, (uint32_t)i) * (double)i);
        FrSegment kept = segments[i - 1];
        segments[i - 1] = segments[j];
        segments[j] = kept;
    }
    for (size_t i = 0; i < count; i += 2) {
        vec3s kept = segments[i].from;
        segments[i].from = segments[i].to;
        segments[i].to = kept;
    }
}

static void isomorphic(void) {
    for (uint64_t seed = 1; seed <= 20; seed++) {
        FrPlant *plant = random_plant(400, seed);
        plant->axes.offset[0] = (vec3s){{3, -2, -50}}; // the base is the lowest
        plant->nodes.length[0] = 100;
        fr_plant_update_frames(plant, 0);
        size_t count;
        FrSegment *segments = fr_skeleton_segments(plant, &count);
        g_assert_cmpuint(count, ==, 400);
        shuffle(segments, count);
        FrContext context = fr_context_default();
        context.diags = fr_diags_new();
        FrPlant *welded;
        g_assert_cmpint(
            fr_skeleton_weld(segments, count, -1, "welded", (FrSpan){0}, &context, &welded), ==,
            FR_OK);
        assert_sound(welded);
        g_assert_cmpuint(fr_diags_count(context.diags), ==, 0);
        g_assert_cmpuint(welded->nodes.count, ==, 400);
        g_assert_cmpuint(tree_digest(welded), ==, tree_digest(plant));
        fr_diags_free(context.diags);
        fr_plant_free(welded);
        fr_plant_free(plant);
        g_free(segments);
    }
}

static void branches_of_a_tree(void) {
    // Thick stems go on: the branches come back as they were, not only the internodes.
    FrPlant *plant = small_tree();
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        plant->nodes.radius[i] = 0.1f / (1 + plant->axes.order[plant->nodes.axis[i]]);
    }
    size_t count;
    FrSegment *segments = fr_skeleton_segments(plant, &count);
    shuffle(segments, count);
    FrContext context = fr_context_default();
    FrPlant *welded;
    g_assert_cmpint(fr_skeleton_weld(segments, count, -1, "welded", (FrSpan){0}, &context, &welded),
                    ==, FR_OK);
    g_assert_cmpuint(welded->axes.count, ==, plant->axes.count);
    uint32_t orders[2][3] = {{0}};
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        orders[0][plant->axes.order[a]]++;
        orders[1][welded->axes.order[a]]++;
    }
    g_assert_true(memcmp(orders[0], orders[1], sizeof orders[0]) == 0);
    vec3s low, high, other_low, other_high;
    fr_plant_bounds(plant, &low, &high);
    fr_plant_bounds(welded, &other_low, &other_high);
    g_assert_cmpfloat(glms_vec3_distance(low, other_low), <, 1e-4f);
    g_assert_cmpfloat(glms_vec3_distance(high, other_high), <, 1e-4f);
    fr_plant_free(welded);
    fr_plant_free(plant);
    g_free(segments);
}

static FrStatus read_table(const char *text, FrContext *context, FrSegment **segments,
                           size_t *count) {
    FrSource *source = fr_source_new("table.txt", text, strlen(text));
    context->diags = fr_diags_new();
    FrStatus status = fr_skeleton_read(source, context, segments, count);
    fr_source_unref(source);
    return status;
}

static void tables(void) {
    FrContext context = fr_context_default();
    FrSegment *segments;
    size_t count;
    g_assert_cmpint(read_table("# x y z x y z r\n0 0 0  0 0 1  0.1\n\n0,0,1;0,1,2;0.05 # fork\n"
                               "0 0 1 0 -1 2\r\n0 0 2 0 0 2 1\n0 1 2 0 -1 2 0.01",
                               &context, &segments, &count),
                    ==, FR_OK);
    g_assert_cmpuint(count, ==, 5);
    g_assert_cmpfloat(segments[2].radius, ==, 0.01f);
    FrPlant *plant;
    g_assert_cmpint(fr_skeleton_weld(segments, count, -1, "table", (FrSpan){0}, &context, &plant),
                    ==, FR_OK);
    assert_sound(plant);
    g_assert_cmpuint(plant->nodes.count, ==, 3); // a loop and a point are left out
    g_assert_cmpuint(plant->axes.count, ==, 2);
    g_assert_cmpuint(fr_diags_count(context.diags), ==, 2);
    fr_plant_free(plant);
    fr_diags_free(context.diags);
    g_free(segments);
    static const char *const wrong[] = {"1 2 3\n",         "1 2 3 4 5 x 7",     "0 0 0 1 1 1 -1",
                                        "0 0 0 1 1 1 1 1", "0 0 0 1e300 0 0 1", "nan 0 0 0 0 1"};
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        g_assert_cmpint(read_table(wrong[i], &context, &segments, &count), ==, FR_ERR_DOCUMENT);
        g_assert_cmpuint(fr_diags_error_count(context.diags), ==, 1);
        g_assert_null(segments);
        fr_diags_free(context.diags);
    }
}

static void hostile(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrPlant *plant;
    FrSegment wrong = {{{0, 0, 0}}, {{0, NAN, 1}}, 1};
    g_assert_cmpint(fr_skeleton_weld(&wrong, 1, -1, "wrong", (FrSpan){0}, &context, &plant), ==,
                    FR_ERR_DOCUMENT);
    g_assert_null(plant);
    g_assert_cmpint(fr_skeleton_weld(NULL, 0, 0, "nothing", (FrSpan){0}, &context, &plant), ==,
                    FR_OK);
    g_assert_cmpuint(plant->nodes.count, ==, 0);
    fr_plant_free(plant);
    FrSegment flat[] = {{{{0, 0, 0}}, {{1, 0, 0}}, 1}, {{{1, 0, 0}}, {{1e9f, 0, 0}}, 1}};
    g_assert_cmpint(fr_skeleton_weld(flat, 2, 0, "flat", (FrSpan){0}, &context, &plant), ==, FR_OK);
    assert_sound(plant);
    fr_plant_free(plant);
    context.limits.nodes = 1;
    g_assert_cmpint(fr_skeleton_weld(flat, 2, 0, "flat", (FrSpan){0}, &context, &plant), ==,
                    FR_ERR_LIMIT);
    fr_diags_free(context.diags);
}

/// Branches that stand along straight internodes, beside their middle, keep their bearer.
static void branches_along(void) {
    FrPlant *plant = fr_plant_new("mast");
    uint32_t mast = add_branch(plant, FR_NONE, 0, 2, 2);
    plant->axes.base_radius[mast] = 0.1f;
    for (uint32_t k = 0; k < 6; k++) {
        uint32_t bearer = plant->axes.first[mast] + k % 2;
        uint32_t axis = add_branch(plant, bearer, 1.2f, 3, 0.6f);
        plant->axes.offset[axis] = (vec3s){{0.02f, 0, -0.15f * (float)(k + 1)}};
        for (uint32_t i = plant->axes.first[axis]; i != FR_NONE; i = plant->nodes.next[i]) {
            plant->nodes.radius[i] = 0.005f;
        }
    }
    fr_plant_update_frames(plant, 0);
    size_t count;
    FrSegment *lines = fr_skeleton_segments(plant, &count);
    g_assert_cmpuint(count, ==, 2 + 6 + 18); // the mast cut at six feet
    FrContext context = fr_context_default();
    FrPlant *again;
    g_assert_cmpint(fr_skeleton_weld(lines, count, -1, "again", (FrSpan){0}, &context, &again), ==,
                    FR_OK);
    g_assert_cmpuint(again->axes.count, ==, 7);
    uint32_t of_order[2] = {0, 0};
    for (uint32_t a = 0; a < again->axes.count; a++) {
        g_assert_cmpuint(again->axes.order[a], <, 2);
        of_order[again->axes.order[a]]++;
    }
    g_assert_cmpuint(of_order[0], ==, 1);
    g_assert_cmpuint(of_order[1], ==, 6);
    fr_plant_free(again);
    g_free(lines);
    fr_plant_free(plant);
}

/// The same lines in another order and direction are the same plant.
static void any_order(void) {
    FrPlant *tree = small_tree();
    size_t count;
    FrSegment *lines = fr_skeleton_segments(tree, &count);
    FrSegment *turned = g_new(FrSegment, count);
    for (size_t i = 0; i < count; i++) {
        FrSegment line = lines[(i * 7 + 3) % count];
        turned[i] = i % 2 == 0 ? line : (FrSegment){line.to, line.from, line.radius};
    }
    g_assert_cmpuint(count % 7, !=, 0); // or the steps would not reach all
    FrContext context = fr_context_default();
    FrPlant *one, *other;
    g_assert_cmpint(fr_skeleton_weld(lines, count, -1, "same", (FrSpan){0}, &context, &one), ==,
                    FR_OK);
    g_assert_cmpint(fr_skeleton_weld(turned, count, -1, "same", (FrSpan){0}, &context, &other), ==,
                    FR_OK);
    g_assert_cmpuint(fr_plant_digest(one), ==, fr_plant_digest(other));
    fr_plant_free(one);
    fr_plant_free(other);
    g_free(turned);
    g_free(lines);
    fr_plant_free(tree);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/variation/skeleton/branches along an internode keep their bearer",
                    branches_along);
    g_test_add_func("/variation/skeleton/lines may come in any order and direction", any_order);
    g_test_add_func("/variation/skeleton/a rebuilt hierarchy is isomorphic to the plant's",
                    isomorphic);
    g_test_add_func("/variation/skeleton/thick stems go on as they did", branches_of_a_tree);
    g_test_add_func("/variation/skeleton/tables of lines become plants", tables);
    g_test_add_func("/variation/skeleton/hostile lines are refused", hostile);
    return g_test_run();
}
