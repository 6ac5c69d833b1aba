// Parameters that differ along a component itself, held against integrals.
#include "graphs.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREES (180 / G_PI)

static vec3s tip_heading(const FrPlant *plant) {
    vec3s up = {{0, 0, 1}};
    return glms_quat_rotatev(plant->nodes.frame[plant->nodes.count - 1], up);
}

static double tip_angle(const FrPlant *plant) {
    return acos(fmin(1, (double)tip_heading(plant).z)) * DEGREES;
}

static void radius(void) {
    Built built = build("horn H radius=.1 | self 0,1 1,.25;taper=0;min-radius=0;segments=8");
    const FrNodes *nodes = &built.plant->nodes;
    g_assert_cmpfloat_with_epsilon(built.plant->axes.base_radius[0], 0.1f, 1e-7);
    double before = 0.1;
    for (uint32_t k = 0; k < nodes->count; k++) {
        g_assert_cmpfloat((double)nodes->radius[k], <, before);
        before = (double)nodes->radius[k];
    }
    g_assert_cmpfloat_with_epsilon(nodes->radius[7], 0.025f, 1e-7);
    built_free(built);
}

static void radius_by_expression(void) {
    Built built = build("horn H radius== .1*(1 - s/2);taper=0;min-radius=0;segments=4");
    for (uint32_t k = 0; k < 4; k++) {
        double expected = 0.1 * (1 - (k + 1) / 8.0);
        g_assert_cmpfloat_with_epsilon((double)built.plant->nodes.radius[k], expected, 1e-7);
    }
    built_free(built);
}

static void curvature(void) {
    // Of 120 degrees times a curve whose integral is 1/2, 60 are left at the tip, in any number of
    // internodes; the first half of the stem turns by a quarter of that.
    static const int segments[] = {4, 16, 64};
    for (size_t k = 0; k < G_N_ELEMENTS(segments); k++) {
        char *text = g_strdup_printf("horn H curvature== 120*s;segments=%d", segments[k]);
        Built built = build(text);
        // The last internode has the direction of its middle.
        double middle = 1 - 0.5 / segments[k];
        g_assert_cmpfloat_with_epsilon(tip_angle(built.plant), 60 * middle * middle, 1e-3);
        built_free(built);
        g_free(text);
    }
}

static void twist(void) {
    Built built = build("horn H twist=90 | self 0,0 .5,0 .5001,1 1,1;segments=64");
    const versors *frame = built.plant->nodes.frame;
    vec3s x = {{1, 0, 0}};
    vec3s half = glms_quat_rotatev(frame[31], x), end = glms_quat_rotatev(frame[63], x);
    g_assert_cmpfloat_with_epsilon(half.x, 1, 1e-4);
    double angle = atan2((double)end.y, (double)end.x) * DEGREES;
    g_assert_cmpfloat_with_epsilon(angle, 45 * (31.5 / 32), 0.4);
    built_free(built);
}

static void tropism(void) {
    // In a constant field the angle decays with the integral of the strength: here 1.2.
    static const int segments[] = {4, 16, 64};
    for (size_t k = 0; k < G_N_ELEMENTS(segments); k++) {
        char *text = g_strdup_printf(
            "horn H rotate-x=100;phototropism== 2.4*s;segments=%d\nhorn T length=.001;segments=1\n"
            "H - T",
            segments[k]);
        Built built = build(text);
        g_assert_cmpfloat_with_epsilon(tip_angle(built.plant), 30.119421, 1e-3);
        built_free(built);
        g_free(text);
    }
}

static void gnarl(void) {
    Built built = build("horn H gnarl=60 | self 0,0 .5,0 .500001,1 1,1;segments=40");
    const FrNodes *nodes = &built.plant->nodes;
    for (uint32_t k = 0; k < 19; k++) {
        g_assert_cmpfloat_with_epsilon(nodes->position[k].x, 0, 1e-6);
        g_assert_cmpfloat_with_epsilon(nodes->position[k].y, 0, 1e-6);
    }
    vec3s tip = nodes->position[39];
    g_assert_cmpfloat(hypot((double)tip.x, (double)tip.y), >, 0.01);
    built_free(built);
}

static void random_part(void) {
    // One draw for the whole stem, multiplied along it.
    Built built = build("horn H radius=.1 ~ .05 | self 0,1 1,.5;taper=0;min-radius=0;segments=1");
    double base = (double)built.plant->axes.base_radius[0];
    g_assert_cmpfloat(fabs(base - 0.1), >, 1e-4);
    g_assert_cmpfloat_with_epsilon((double)built.plant->nodes.radius[0], base / 2, 1e-7);
    built_free(built);
}

static const FrBlade *only_blade(const Built *built) {
    g_assert_cmpuint(built->plant->shapes->len, ==, 1);
    return &g_array_index(built->plant->shapes, FrShape, 0).blade;
}

static void leaf_midrib(void) {
    Built built = build("leaf L curvature-along== 180*s");
    const FrBlade *blade = only_blade(&built);
    g_assert_cmpfloat_with_epsilon(blade->curvature_along, (float)(G_PI / 2), 1e-5);
    g_assert_cmpuint(blade->along_curve, !=, FR_NONE);
    built_free(built);
}

static void leaf_parts(void) {
    Built built = build("leaf L fold=40 | self fall;twist=90 | self ramp;wave=.1 | self ramp;"
                        "curvature-across=60 | self fall");
    const FrBlade *blade = only_blade(&built);
    const FrProfile *fold = &g_array_index(built.plant->profiles, FrProfile, blade->fold_along - 1);
    g_assert_cmpfloat_with_epsilon(fold->points[0][1], 40 / DEGREES, 1e-9);
    g_assert_cmpfloat_with_epsilon(fold->points[fold->count - 1][1], 0, 1e-9);
    g_assert_cmpuint(blade->twist_along, !=, 0);
    g_assert_cmpuint(blade->wave_along, !=, 0);
    g_assert_cmpuint(blade->across_along, !=, 0);
    built_free(built);
}

static void leaves_of_places(void) {
    // What differs along a leaf may also differ from leaf to leaf.
    Built built = build("tree T number=3\nleaf L fold== 10*(i + 1)*s\nT = L");
    g_assert_cmpuint(built.plant->shapes->len, ==, 3);
    for (guint k = 0; k < 3; k++) {
        const FrBlade *blade = &g_array_index(built.plant->shapes, FrShape, k).blade;
        const FrProfile *fold =
            &g_array_index(built.plant->profiles, FrProfile, blade->fold_along - 1);
        g_assert_cmpfloat_with_epsilon(fold->points[fold->count - 1][1], 10 * (k + 1) / DEGREES,
                                       1e-9);
    }
    built_free(built);
}

static void refused(void) {
    static const struct {
        FrComponentKind kind;
        const char *attribute, *text;
        uint32_t begin, end;
    } wrong[] = {
        {FR_COMPONENT_TREE, "number", "10 | self ramp", 5, 9},
        {FR_COMPONENT_HORN, "length", "2 | depth ramp | s fall", 17, 18},
        {FR_COMPONENT_LEAF, "length", "= s", 0, 3},
        {FR_COMPONENT_LEAF, "rotate-x", "40 | self ramp", 5, 9},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        const FrParamTable *table = fr_pgraph_table(wrong[k].kind);
        void *params = g_malloc0(table->struct_size);
        FrDiags *diags = fr_diags_new();
        FrSource *source = fr_source_new("test", wrong[k].text, strlen(wrong[k].text));
        FrSpan span = {source, 0, (uint32_t)strlen(wrong[k].text)};
        fr_params_init(table, params);
        const FrParam *row = fr_params_find(table, wrong[k].attribute);
        const FrNumber *number = (const FrNumber *)(const void *)((char *)params + row->offset);
        double before = number->from;
        g_assert_cmpint(fr_params_set(table, params, row, wrong[k].text, span, NULL, diags), ==,
                        FR_ERR_DOCUMENT);
        g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "not-along-itself");
        g_assert_cmpuint(fr_diags_get(diags, 0)->span.begin, ==, wrong[k].begin);
        g_assert_cmpuint(fr_diags_get(diags, 0)->span.end, ==, wrong[k].end);
        g_assert_cmpfloat(number->from, ==, before);
        fr_params_clear(table, params);
        fr_diags_free(diags);
        fr_source_unref(source);
        g_free(params);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/along/a radius follows its curve along the stem", radius);
    g_test_add_func("/pgraph/along/an expression sees the place along the stem",
                    radius_by_expression);
    g_test_add_func("/pgraph/along/a curvature turns by its integral in any number of internodes",
                    curvature);
    g_test_add_func("/pgraph/along/a twist acts where its curve is not nothing", twist);
    g_test_add_func("/pgraph/along/a tropism turns by its integral in any number of internodes",
                    tropism);
    g_test_add_func("/pgraph/along/a stem is straight where its gnarl is nothing", gnarl);
    g_test_add_func("/pgraph/along/chance is drawn once for the whole stem", random_part);
    g_test_add_func("/pgraph/along/a midrib turns by its integral", leaf_midrib);
    g_test_add_func("/pgraph/along/fold, twist, wave and curvature differ along a leaf",
                    leaf_parts);
    g_test_add_func("/pgraph/along/leaves may differ along themselves and among each other",
                    leaves_of_places);
    g_test_add_func("/pgraph/along/elsewhere it is refused at its place", refused);
    return g_test_run();
}
