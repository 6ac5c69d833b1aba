// Trees by matrices of ramification and by strands.
#include "frond/ramified.h"

#include <math.h>
#include <string.h>

static FrRamified *made(const FrRamifiedParams *params, const char *text, FrStatus wanted) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrRamified *ramified = fr_ramified_new(params);
    FrSource *source = text != NULL ? fr_source_new("matrix", text, strlen(text)) : NULL;
    FrStatus status = fr_ramified_load(ramified, source, (FrSpan){0}, &context);
    g_assert_cmpint(status, ==, wanted);
    g_assert_cmpuint(fr_diags_error_count(context.diags), ==, wanted == FR_OK ? 0 : 1);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    return ramified;
}

static FrPlant *grown(const FrRamifiedParams *params, const char *text, uint64_t seed) {
    FrContext context = fr_context_default();
    FrRamified *ramified = made(params, text, FR_OK);
    FrPlant *plant;
    g_assert_cmpint(fr_ramified_grow(ramified, "tree", seed, &context, &plant), ==, FR_OK);
    char *why = NULL;
    g_assert_true(fr_plant_is_valid(plant, &why));
    fr_ramified_free(ramified);
    return plant;
}

static FrRamifiedParams defaults(int by, int order) {
    FrRamifiedParams params;
    fr_params_init(fr_ramified_table(), &params);
    params.by = by;
    params.order = order;
    return params;
}

static void perfect(void) {
    for (int order = 1; order < 9; order++) {
        FrRamifiedParams params = defaults(FR_RAMIFIED_PERFECT, order);
        params.leaves = 3;
        FrPlant *plant = grown(&params, NULL, 1);
        uint32_t tips = 1U << (order - 1);
        g_assert_cmpuint(plant->nodes.count, ==, 2 * tips - 1);
        g_assert_cmpuint(plant->axes.count, ==, tips);
        g_assert_cmpuint(plant->organs.count, ==, 3 * tips);
        fr_plant_free(plant);
    }
}

static void known_rows(void) {
    FrRamifiedParams params = defaults(FR_RAMIFIED_RANDOM, 5);
    FrRamified *ramified = made(&params, NULL, FR_OK);
    for (uint32_t k = 2; k <= 30; k++) {
        const double *row = fr_ramified_row(ramified, k);
        double sum = 0;
        for (uint32_t i = 0; i < k; i++) {
            sum += row[i];
        }
        g_assert_cmpfloat_with_epsilon(sum, 1, 1e-15);
        g_assert_cmpfloat_with_epsilon(row[0], 0.5, 1e-15);
        g_assert_cmpfloat_with_epsilon(row[k - 1], pow(2, 1 - (double)k), 1e-18);
    }
    fr_ramified_free(ramified);
}

/// How often nodes of Strahler order 3 fork into (3,1), (3,2) and (2,2), over many trees.
static void tally(FrPlant *plant, double counts[3]) {
    uint32_t nodes = plant->nodes.count, *order = g_new(uint32_t, nodes);
    uint32_t(*children)[2] = g_malloc0_n(nodes, sizeof *children);
    fr_plant_strahler(plant, order);
    for (uint32_t i = 0; i < nodes; i++) {
        uint32_t parent = plant->nodes.parent[i];
        if (parent != FR_NONE) {
            children[parent][children[parent][0] != 0] = order[i];
        }
    }
    for (uint32_t i = 0; i < nodes; i++) {
        uint32_t a = MAX(children[i][0], children[i][1]), b = MIN(children[i][0], children[i][1]);
        g_assert_true((a == 0) == (b == 0)); // both or neither
        if (order[i] == 3) {
            counts[a == 2 ? 2 : b - 1]++;
        }
    }
    g_free(children);
    g_free(order);
}

static void measured(void) {
    FrRamifiedParams params = defaults(FR_RAMIFIED_MATRIX, 4);
    double counts[3] = {0};
    for (uint64_t seed = 0; seed < 3000; seed++) {
        FrPlant *plant = grown(&params,
                               "# (k,1) ... (k-1,k-1)\n0.3 0.7\n0.2, 0.3, 0.5\n"
                               "0.1 0.1 0.2 0.6 # of order 4\n",
                               seed);
        tally(plant, counts);
        fr_plant_free(plant);
    }
    double all = counts[0] + counts[1] + counts[2];
    g_assert_cmpfloat(all, >, 10000);
    g_assert_cmpfloat_with_epsilon(counts[0] / all, 0.2, 0.015);
    g_assert_cmpfloat_with_epsilon(counts[1] / all, 0.3, 0.015);
    g_assert_cmpfloat_with_epsilon(counts[2] / all, 0.5, 0.015);
}

static void strands(void) {
    FrRamifiedParams params = defaults(FR_RAMIFIED_STRANDS, 1);
    params.strands = 100;
    params.weights = FR_WEIGHTS_STRANDS - 1;
    params.thinnest = 0.01;
    for (uint64_t seed = 0; seed < 20; seed++) {
        FrPlant *plant = grown(&params, NULL, seed);
        g_assert_cmpuint(plant->nodes.count, ==, 199);
        g_assert_cmpfloat_with_epsilon((double)plant->nodes.radius[0], 0.1, 1e-7);
        fr_plant_free(plant);
    }
}

/// sin θ₁ / sin θ₂ = (s₂ / s₁)^k, and both angles together are `angle`.
static void deviations(void) {
    FrRamifiedParams params = defaults(FR_RAMIFIED_STRANDS, 1);
    params.strands = 3;
    params.angle = 1;
    for (int k = 0; k < 3; k++) {
        params.deviation = k;
        FrPlant *plant = grown(&params, NULL, 5);
        vec3s stem = fr_frame_heading(plant->nodes.frame[0]);
        vec3s onward = fr_frame_heading(plant->nodes.frame[plant->nodes.next[0]]), aside = stem;
        for (uint32_t a = 1; a < plant->axes.count; a++) {
            if (plant->axes.bearer[a] == 0) {
                aside = fr_frame_heading(plant->nodes.frame[plant->axes.first[a]]);
            }
        }
        double one = acos((double)(stem.x * onward.x + stem.y * onward.y + stem.z * onward.z));
        double two = acos((double)(stem.x * aside.x + stem.y * aside.y + stem.z * aside.z));
        g_assert_cmpfloat_with_epsilon(one + two, 1, 1e-5);
        g_assert_cmpfloat_with_epsilon(sin(one) / sin(two), pow(0.5, k), 1e-4);
        fr_plant_free(plant);
    }
}

static void wrong(void) {
    static const char *const texts[] = {
        NULL,      "",       "0.5 0.5 0.5\n", "0.5 0.4\n", "1 0\n",
        "0.5 x\n", "-1 2\n", "0.5 0.5\n",     "nan 1\n",   "0.5 0.5\n0.5 0.5\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        FrRamifiedParams params = defaults(FR_RAMIFIED_MATRIX, 3);
        fr_ramified_free(made(&params, texts[i], FR_ERR_DOCUMENT));
    }
    FrRamifiedParams params = defaults(FR_RAMIFIED_RANDOM, 3);
    fr_ramified_free(made(&params, "0.5 0.5\n", FR_ERR_DOCUMENT));
}

static void limits(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.nodes = 1000;
    FrRamifiedParams params = defaults(FR_RAMIFIED_PERFECT, 30);
    FrRamified *ramified = made(&params, NULL, FR_OK);
    FrPlant *plant = (FrPlant *)1;
    g_assert_cmpint(fr_ramified_grow(ramified, "tree", 1, &context, &plant), ==, FR_ERR_LIMIT);
    g_assert_null(plant);
    fr_ramified_free(ramified);
    // A branch that hardly ever ends.
    params = defaults(FR_RAMIFIED_MATRIX, 2);
    ramified = made(&params, "1 0.000000001", FR_OK);
    g_assert_cmpint(fr_ramified_grow(ramified, "tree", 1, &context, &plant), ==, FR_ERR_LIMIT);
    fr_ramified_free(ramified);
    fr_diags_free(context.diags);
}

static void refused_at_once(void) {
    // What every such tree has at least is counted without following a fork: with this order that
    // would take minutes.
    for (int strands = 0; strands < 2; strands++) {
        FrContext context = fr_context_default();
        context.diags = fr_diags_new();
        context.limits.nodes = UINT64_C(1) << 29;
        FrRamifiedParams params = defaults(strands ? FR_RAMIFIED_STRANDS : FR_RAMIFIED_RANDOM, 30);
        params.strands = 100000000;
        params.leaves = strands ? 1 : 0;
        FrRamified *ramified = made(&params, NULL, FR_OK);
        FrPlant *plant;
        g_assert_cmpint(fr_ramified_grow(ramified, "tree", 1, &context, &plant), ==, FR_ERR_LIMIT);
        const char *text = fr_diags_get(context.diags, 0)->text;
        g_assert_nonnull(strstr(text, strands ? "100000000" : "1073741823"));
        g_assert_nonnull(strstr(text, strands ? "'organs'" : "'nodes'"));
        fr_ramified_free(ramified);
        fr_diags_free(context.diags);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/variation/ramified/a perfect tree of order n has 2^(n-1) tips", perfect);
    g_test_add_func("/variation/ramified/rows of random trees are powers of one half", known_rows);
    g_test_add_func("/variation/ramified/branches fork as often as the matrix says", measured);
    g_test_add_func("/variation/ramified/strands are shared until each has a tip", strands);
    g_test_add_func("/variation/ramified/the heavier branch deviates less", deviations);
    g_test_add_func("/variation/ramified/matrices that are none are told", wrong);
    g_test_add_func("/variation/ramified/endless trees are refused", limits);
    g_test_add_func("/variation/ramified/too high an order is refused at once", refused_at_once);
    return g_test_run();
}
