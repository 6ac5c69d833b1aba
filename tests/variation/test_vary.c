#include "plants.h"

#include <math.h>
#include <string.h>

static FrVaryPlan *prepare(const FrVary *vary, const FrPlant *base) {
    FrContext context = fr_context_default();
    FrVaryPlan *plan;
    g_assert_cmpint(fr_vary_prepare(vary, base, &context, &plan), ==, FR_OK);
    return plan;
}

static FrStroke *bow(void) {
    return fr_stroke_parse("0,0,0 0.1,0,1 0.5,0,1.8 1.2,0,2.2", (FrSpan){0}, NULL);
}

static void nothing_drawn(void) {
    FrPlant *base = small_tree();
    FrDigest before = fr_plant_digest(base);
    FrVaryParams params = vary_params();
    params.scatter = 0;
    FrVary *vary = fr_vary_new(&params);
    FrVaryPlan *plan = prepare(vary, base);
    FrPlant *instance = fr_vary_instance(plan, 5);
    g_assert_cmpuint(fr_plant_digest(instance), ==, before);
    fr_plant_free(instance);
    fr_vary_plan_free(plan);
    fr_vary_params(vary)->scatter = 0.05;
    plan = prepare(vary, base);
    instance = fr_vary_instance(plan, 5);
    g_assert_cmpuint(fr_plant_digest(instance), !=, before);
    g_assert_cmpuint(fr_plant_digest(base), ==, before);
    assert_sound(instance);
    // The cache is what the frames pass makes of it.
    FrPlant *again = fr_plant_copy(instance);
    fr_plant_update_frames(again, 0);
    g_assert_true(memcmp(again->nodes.position, instance->nodes.position,
                         again->nodes.count * sizeof(vec3s)) == 0);
    fr_plant_free(again);
    fr_plant_free(instance);
    fr_vary_plan_free(plan);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(base);
}

/// The axes whose rotations differ between two instances.
static uint32_t differing(const FrPlant *one, const FrPlant *other, uint32_t *last) {
    uint32_t count = 0;
    for (uint32_t a = 0; a < one->axes.count; a++) {
        bool differs = false;
        for (uint32_t i = one->axes.first[a]; i != FR_NONE; i = one->nodes.next[i]) {
            differs |=
                memcmp(&one->nodes.rotation[i], &other->nodes.rotation[i], sizeof(versors)) != 0;
        }
        count += differs;
        *last = differs ? a : *last;
    }
    return count;
}

static void one_twig_alone(void) {
    FrPlant *base = small_tree();
    FrVaryParams params = vary_params();
    FrVary *vary = fr_vary_new(&params);
    FrStroke *stroke = bow(), *local = fr_stroke_parse("0,0,0 0,0,1 0,1,1", (FrSpan){0}, NULL);
    fr_vary_add_stroke(vary, stroke, "stem", FR_APPLY_BOTH, (FrSpan){0});
    FrVaryPlan *plan = prepare(vary, base);
    FrPlant *before = fr_vary_instance(plan, 3);
    for (uint32_t a = 0; a < base->axes.count; a++) {
        g_assert_cmpuint(fr_vary_stroke_of(plan, a), ==, 0);
    }
    fr_vary_plan_free(plan);
    fr_vary_add_stroke(vary, local, "twig:4", FR_APPLY_SELECTED, (FrSpan){0});
    plan = prepare(vary, base);
    FrPlant *after = fr_vary_instance(plan, 3);
    uint32_t twig = FR_NONE;
    g_assert_cmpuint(differing(before, after, &twig), ==, 1);
    g_assert_cmpuint(fr_vary_stroke_of(plan, twig), ==, 1);
    g_assert_cmpstr(g_array_index(base->components, FrComponent, base->axes.component[twig]).id, ==,
                    "twig");
    fr_vary_plan_free(plan);
    fr_plant_free(before);
    fr_plant_free(after);
    fr_stroke_unref(stroke);
    fr_stroke_unref(local);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(base);
}

static void modes(void) {
    FrPlant *base = small_tree();
    static const uint32_t wanted[] = {1, 1, 2}; // limb:2, its twig, both
    for (FrApply apply = FR_APPLY_SELECTED; apply <= FR_APPLY_BOTH; apply++) {
        FrVaryParams params = vary_params();
        FrVary *vary = fr_vary_new(&params);
        FrStroke *stroke = bow();
        fr_vary_add_stroke(vary, stroke, "limb:2", apply, (FrSpan){0});
        FrVaryPlan *plan = prepare(vary, base);
        uint32_t drawn = 0;
        for (uint32_t a = 0; a < base->axes.count; a++) {
            drawn += fr_vary_stroke_of(plan, a) == 0;
        }
        g_assert_cmpuint(drawn, ==, wanted[apply]);
        fr_stroke_unref(stroke);
        fr_vary_plan_free(plan);
        fr_vary_free(vary);
        fr_params_clear(fr_vary_table(), &params);
    }
    fr_plant_free(base);
}

static void follows_the_stroke(void) {
    FrPlant *base = small_tree();
    FrVaryParams params = vary_params();
    params.scatter = 0;
    params.anticipation = 1;
    FrVary *vary = fr_vary_new(&params);
    // A quarter circle; limbs leave the stem as before and then turn by a right angle.
    GString *text = g_string_new(NULL);
    for (int i = 0; i <= 90; i++) {
        g_string_append_printf(text, "%f,0,%f ", 1 - cos(i * G_PI / 180), sin(i * G_PI / 180));
    }
    FrStroke *stroke = fr_stroke_parse(text->str, (FrSpan){0}, NULL);
    fr_vary_add_stroke(vary, stroke, "limb", FR_APPLY_SELECTED, (FrSpan){0});
    FrVaryPlan *plan = prepare(vary, base);
    FrPlant *grown = fr_vary_instance(plan, 1);
    for (uint32_t a = 0; a < base->axes.count; a++) {
        uint32_t first = base->axes.first[a], last = base->axes.last[a];
        g_assert_true(memcmp(&grown->nodes.rotation[first], &base->nodes.rotation[first],
                             sizeof(versors)) == 0);
        if (base->axes.component[a] == 1) {
            float turned = glms_vec3_dot(fr_frame_heading(grown->nodes.frame[first]),
                                         fr_frame_heading(grown->nodes.frame[last]));
            // From the middle of the first of 16 pieces to the middle of the last.
            g_assert_cmpfloat_with_epsilon(turned, cosf((float)(G_PI_2 * 15 / 16)), 1e-3);
        }
    }
    // A sluggish branch lags behind the same stroke, a little.
    fr_vary_params(vary)->anticipation = 0.8;
    FrVaryPlan *slow = prepare(vary, base);
    FrPlant *late = fr_vary_instance(slow, 1);
    float lag = 0;
    for (uint32_t i = 0; i < base->nodes.count; i++) {
        float along = glms_vec3_dot(fr_frame_heading(grown->nodes.frame[i]),
                                    fr_frame_heading(late->nodes.frame[i]));
        lag = fmaxf(lag, acosf(fminf(along, 1)));
    }
    g_assert_cmpfloat(lag, >, 0.05f);
    g_assert_cmpfloat(lag, <, 0.5f);
    fr_plant_free(late);
    fr_plant_free(grown);
    fr_vary_plan_free(slow);
    fr_vary_plan_free(plan);
    fr_stroke_unref(stroke);
    g_string_free(text, TRUE);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(base);
}

/// A stroke that goes out and then up lifts a level branch, whatever side it is on and however its
/// internodes are rolled.
static void rises_on_all_sides(void) {
    FrStroke *stroke = fr_stroke_parse("0,0,0 0.5,0,0 0.8,0,0.2 1,0,0.5 1,0,1", (FrSpan){0}, NULL);
    FrVaryParams params = vary_params();
    params.scatter = 0;
    params.anticipation = 1;
    for (int side = 0; side < 8; side++) {
        FrPlant *plant = fr_plant_new("limb");
        uint32_t axis = add_branch(plant, FR_NONE, 0, 12, 1.5f);
        vec3s heading = {{cosf(0.785f * (float)side), sinf(0.785f * (float)side), 0}};
        versors roll = fr_rotation_about((vec3s){{0, 0, 1}}, 1.3f * (float)side);
        plant->nodes.rotation[plant->axes.first[axis]] =
            fr_frame_step(fr_rotation_between((vec3s){{0, 0, 1}}, heading), roll);
        fr_plant_update_frames(plant, 0);
        FrVary *vary = fr_vary_new(&params);
        fr_vary_add_stroke(vary, stroke, "", FR_APPLY_SELECTED, (FrSpan){0});
        FrVaryPlan *plan = prepare(vary, plant);
        FrPlant *grown = fr_vary_instance(plan, 1);
        vec3s tip = grown->nodes.position[grown->axes.last[axis]];
        g_assert_cmpfloat(tip.z, >, 0.6f);
        g_assert_cmpfloat(glms_vec3_dot(tip, heading), >, 0.6f);
        g_assert_cmpfloat(fabsf(tip.x * heading.y - tip.y * heading.x), <, 0.01f);
        fr_plant_free(grown);
        fr_vary_plan_free(plan);
        fr_vary_free(vary);
        fr_plant_free(plant);
    }
    fr_params_clear(fr_vary_table(), &params);
    fr_stroke_unref(stroke);
}

/// A pole of one internode follows a stroke all the same, and leans in the wind.
static void straight_stems_bend(void) {
    FrPlant *pole = fr_plant_new("pole");
    add_branch(pole, FR_NONE, 0, 1, 2);
    fr_plant_update_frames(pole, 0);
    FrVaryParams params = vary_params();
    params.scatter = 0;
    params.anticipation = 1;
    FrVary *vary = fr_vary_new(&params);
    FrVaryPlan *plan = prepare(vary, pole);
    g_assert_true(fr_vary_plan_base(plan) == pole); // nothing asks for joints
    fr_vary_plan_free(plan);
    FrStroke *stroke =
        fr_stroke_parse("0,0,0 0,0,1 0.2,0,1.8 0.6,0,2.4 1,0,2.6 1.4,0,2.7", (FrSpan){0}, NULL);
    fr_vary_add_stroke(vary, stroke, "", FR_APPLY_SELECTED, (FrSpan){0});
    plan = prepare(vary, pole);
    FrPlant *drawn = fr_vary_instance(plan, 1);
    g_assert_cmpuint(drawn->nodes.count, ==, 6); // the points of the stroke
    g_assert_cmpfloat(drawn->nodes.position[5].x, >, 0.5f);
    assert_sound(drawn);
    fr_plant_free(drawn);
    fr_vary_plan_free(plan);
    fr_vary_free(vary);
    vary = fr_vary_new(&params);
    fr_vary_add_indicator(vary, (vec3s){{0, 1, 0}}, "", FR_APPLY_BOTH, (FrSpan){0});
    plan = prepare(vary, pole);
    FrPlant *blown = fr_vary_instance(plan, 1);
    g_assert_cmpuint(blown->nodes.count, ==, 4);
    g_assert_cmpfloat(blown->nodes.position[3].y, >, 0.05f);
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.nodes = 3;
    FrVaryPlan *refused;
    g_assert_cmpint(fr_vary_prepare(vary, pole, &context, &refused), ==, FR_ERR_LIMIT);
    g_assert_null(refused);
    fr_diags_free(context.diags);
    fr_plant_free(blown);
    fr_vary_plan_free(plan);
    fr_stroke_unref(stroke);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(pole);
}

/// Mean distance of the same joints over the height.
static double difference(const FrPlant *one, const FrPlant *other, double height) {
    double sum = 0;
    for (uint32_t i = 0; i < one->nodes.count; i++) {
        sum += (double)glms_vec3_distance(one->nodes.position[i], other->nodes.position[i]);
    }
    return sum / one->nodes.count / height;
}

static void seven_instances(void) {
    enum { COUNT = 7 };
    FrPlant *base = small_tree();
    FrDigest before = fr_plant_digest(base);
    FrVaryParams params = vary_params();
    FrVary *vary = fr_vary_new(&params);
    FrStroke *stroke = bow();
    fr_vary_add_stroke(vary, stroke, "stem", FR_APPLY_SELECTED, (FrSpan){0});
    FrVaryPlan *plan = prepare(vary, base);
    FrPlant *all[COUNT];
    FrDigest digests[COUNT];
    static const int threads[] = {1, 2, 3, 8};
    for (size_t t = 0; t < G_N_ELEMENTS(threads); t++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(threads[t]);
        g_assert_cmpint(fr_vary_collection(plan, 1, COUNT, &context, all), ==, FR_OK);
        for (int i = 0; i < COUNT; i++) {
            FrDigest digest = fr_plant_digest(all[i]);
            if (t > 0) {
                g_assert_cmpuint(digest, ==, digests[i]);
            }
            digests[i] = digest;
            if (t + 1 < G_N_ELEMENTS(threads)) {
                fr_plant_free(all[i]);
            }
        }
        fr_pool_free(context.pool);
    }
    for (int i = 0; i < COUNT; i++) {
        g_assert_cmpuint(fr_vary_topology_digest(all[i]), ==, fr_vary_topology_digest(base));
        for (int j = 0; j < i; j++) {
            double apart = difference(all[i], all[j], 4);
            g_test_message("%d and %d differ by %.1f %%", i, j, 100 * apart);
            g_assert_cmpfloat(apart, >=, 0.02);
            g_assert_cmpfloat(apart, <=, 0.15);
        }
    }
    for (int i = 0; i < COUNT; i++) {
        fr_plant_free(all[i]);
    }
    g_assert_cmpuint(fr_plant_digest(base), ==, before);
    fr_stroke_unref(stroke);
    fr_vary_plan_free(plan);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(base);
}

static void own_draws(void) {
    // A branch more leaves the draws of all others as they were.
    FrPlant *base = small_tree(), *more = small_tree();
    add_branch(more, 50, 0.5f, 5, 0.5f);
    fr_plant_update_frames(more, 0);
    FrVaryParams params = vary_params();
    FrVary *vary = fr_vary_new(&params);
    FrVaryPlan *plan = prepare(vary, base), *other = prepare(vary, more);
    FrPlant *one = fr_vary_instance(plan, 4), *two = fr_vary_instance(other, 4);
    uint32_t last;
    g_assert_cmpuint(differing(one, two, &last), ==, 0);
    fr_plant_free(one);
    fr_plant_free(two);
    fr_vary_plan_free(plan);
    fr_vary_plan_free(other);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(base);
    fr_plant_free(more);
}

static void mapped_indicator(void) {
    FrPlant *base = small_tree();
    FrVaryParams params = vary_params();
    params.scatter = 0;
    FrVary *vary = fr_vary_new(&params);
    fr_vary_add_indicator(vary, (vec3s){{0, 0, -1}}, "limb:1 limb:2", FR_APPLY_SELECTED,
                          (FrSpan){0});
    FrVaryPlan *plan = prepare(vary, base);
    FrPlant *grown = fr_vary_instance(plan, 1);
    uint32_t last;
    g_assert_cmpuint(differing(base, grown, &last), ==, 2);
    fr_plant_free(grown);
    fr_vary_plan_free(plan);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(base);
}

static void refusals(void) {
    FrPlant *base = small_tree();
    FrVaryParams params = vary_params();
    FrVary *vary = fr_vary_new(&params);
    FrStroke *stroke = bow();
    fr_vary_add_stroke(vary, stroke, "stem limp limb:99 limb:x #12 #zz :1 #", FR_APPLY_BOTH,
                       (FrSpan){0});
    fr_vary_add_indicator(vary, (vec3s){{1, 0, 0}}, "nothing", FR_APPLY_BOTH, (FrSpan){0});
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrVaryPlan *plan;
    g_assert_cmpint(fr_vary_prepare(vary, base, &context, &plan), ==, FR_ERR_DOCUMENT);
    g_assert_null(plan);
    g_assert_cmpuint(fr_diags_error_count(context.diags), ==, 8);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "unknown-branch");
    g_assert_nonnull(strstr(fr_diags_get(context.diags, 0)->text, "did you mean 'limb'"));
    context.limits.iterations = 10;
    g_assert_cmpint(fr_vary_prepare(vary, base, &context, &plan), ==, FR_ERR_LIMIT);
    fr_vary_free(vary);
    vary = fr_vary_new(&params);
    plan = prepare(vary, base);
    FrPlant *all[4];
    context.limits.bytes = 1000;
    g_assert_cmpint(fr_vary_collection(plan, 1, 4, &context, all), ==, FR_ERR_LIMIT);
    g_assert_null(all[0]);
    fr_vary_plan_free(plan);
    fr_diags_free(context.diags);
    fr_stroke_unref(stroke);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(base);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/variation/vary/a stroke that rises lifts branches on all sides",
                    rises_on_all_sides);
    g_test_add_func("/variation/vary/a stem without joints is cut to bend", straight_stems_bend);
    g_test_add_func("/variation/vary/nothing drawn and nothing random is the base", nothing_drawn);
    g_test_add_func("/variation/vary/a local stroke changes one twig alone", one_twig_alone);
    g_test_add_func("/variation/vary/strokes reach the selected, their descendants, or both",
                    modes);
    g_test_add_func("/variation/vary/branches follow their stroke, sluggish ones late",
                    follows_the_stroke);
    g_test_add_func("/variation/vary/seven instances differ by 2 to 15 % of their height",
                    seven_instances);
    g_test_add_func("/variation/vary/every branch has its own draws", own_draws);
    g_test_add_func("/variation/vary/an indicator is mapped to a part", mapped_indicator);
    g_test_add_func("/variation/vary/what names no branch or asks too much is refused", refusals);
    return g_test_run();
}
