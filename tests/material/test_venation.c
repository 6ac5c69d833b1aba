// Veins as in Runions et al. 2005: open venation is a tree, closed venation has loops.
#include "material/venation.h"

#include <math.h>

static FrMaterialParams leaf(int venation) {
    return (FrMaterialParams){.texture = FR_TEXTURE_LEAF,
                              .size = 512,
                              .vein_density = 1,
                              .tooth_depth = 0.03,
                              .venation = venation};
}

static FrVenation *grow(const FrMaterialParams *params, FrOutline **outline) {
    *outline = fr_outline_new(params, 0.6f);
    return fr_venation_new(params, *outline, fr_key_root(5), 2.5f / 512.0f, NULL);
}

static const FrVein *vein(const FrVenation *venation, uint32_t index) {
    return &g_array_index(venation->veins, FrVein, index);
}

static void done(FrVenation *venation, FrOutline *outline) {
    fr_venation_free(venation);
    fr_outline_free(outline);
}

/// Parents stand before their children, so following them can only end in the first node: the
/// veins without their joins are a tree rooted in the petiole.
static void assert_tree(const FrVenation *venation) {
    g_assert_cmpuint(venation->veins->len, >, 1000);
    g_assert_cmpuint(vein(venation, 0)->parent, ==, FR_NONE);
    g_assert_cmpfloat(fabsf(vein(venation, 0)->x) + fabsf(vein(venation, 0)->y), <, 1e-6f);
    for (uint32_t i = 1; i < venation->veins->len; i++) {
        g_assert_cmpuint(vein(venation, i)->parent, <, i);
    }
}

// Main veins of a palm leave the base to both sides; parallel ones keep their order to the tip.
static void test_patterns(void) {
    FrMaterialParams params = leaf(1);
    FrOutline *outline;
    params.vein_pattern = 1;
    FrVenation *venation = grow(&params, &outline);
    assert_tree(venation);
    uint32_t from_base = 0;
    for (uint32_t i = 1; i < venation->veins->len; i++) {
        const FrVein *parent = vein(venation, vein(venation, i)->parent);
        bool is_thick = vein(venation, i)->radius > 0.3f * vein(venation, 0)->radius;
        from_base += fabsf(parent->x) < 1e-6f && parent->y < 0.05f && is_thick &&
                     fabsf(vein(venation, i)->x) > 1e-6f;
    }
    g_assert_cmpuint(from_base, >=, 4);
    done(venation, outline);
    params.vein_pattern = 2;
    venation = grow(&params, &outline);
    assert_tree(venation);
    for (uint32_t i = 1; i < venation->veins->len; i++) {
        const FrVein *v = vein(venation, i), *parent = vein(venation, v->parent);
        g_assert_true(v->parent == 0 || v->x * parent->x >= 0.0f);
        g_assert_cmpfloat(v->y, >, parent->y);
        g_assert_cmpfloat(fabsf(v->x), <=, fr_outline_half_width(outline, v->y));
    }
    done(venation, outline);
}

static void test_open(void) {
    FrMaterialParams params = leaf(0);
    FrOutline *outline;
    FrVenation *venation = grow(&params, &outline);
    assert_tree(venation);
    g_assert_cmpuint(venation->joins->len, ==, 0);
    done(venation, outline);
}

static void test_closed(void) {
    FrMaterialParams params = leaf(1);
    FrOutline *outline;
    FrVenation *venation = grow(&params, &outline);
    assert_tree(venation);
    g_assert_cmpuint(venation->joins->len, >, 200);
    for (uint32_t i = 0; i < venation->joins->len; i++) {
        FrVeinJoin join = g_array_index(venation->joins, FrVeinJoin, i);
        g_assert_cmpuint(join.from, <, venation->veins->len);
        g_assert_cmpuint(join.to, <, venation->veins->len);
        // Two nodes of a tree that are no neighbours and get an edge close a loop.
        g_assert_cmpuint(join.from, !=, join.to);
        g_assert_cmpuint(vein(venation, join.from)->parent, !=, join.to);
        g_assert_cmpuint(vein(venation, join.to)->parent, !=, join.from);
        const FrVein *a = vein(venation, join.from), *b = vein(venation, join.to);
        g_assert_cmpfloat(hypotf(a->x - b->x, a->y - b->y), <, 0.012f);
    }
    done(venation, outline);
}

static void test_steps(void) {
    for (int venation_kind = 0; venation_kind < 2; venation_kind++) {
        FrMaterialParams params = leaf(venation_kind);
        FrOutline *outline;
        FrVenation *venation = grow(&params, &outline);
        for (uint32_t i = 1; i < venation->veins->len; i++) {
            const FrVein *a = vein(venation, i), *b = vein(venation, a->parent);
            g_assert_cmpfloat(hypotf(a->x - b->x, a->y - b->y), <, 0.009f);
            g_assert_cmpfloat(fr_outline_at(outline, a->x, a->y).distance, >, -0.005f);
        }
        done(venation, outline);
    }
}

/// r³ of a vein is the sum of r³ of the veins it feeds; a fork in two equals has
/// r = 2^(1/3) = 1.259921 times theirs.
static void test_murray(void) {
    FrMaterialParams params = leaf(0);
    FrOutline *outline;
    FrVenation *venation = grow(&params, &outline);
    uint32_t count = venation->veins->len, forks = 0;
    double *cubes = g_new0(double, count);
    uint32_t *children = g_new0(uint32_t, count), *child = g_new0(uint32_t, count);
    for (uint32_t i = 1; i < count; i++) {
        uint32_t parent = vein(venation, i)->parent;
        cubes[parent] += pow((double)vein(venation, i)->radius, 3);
        if (children[parent]++ == 0) {
            child[parent] = i;
        } else if (vein(venation, child[parent])->radius == vein(venation, i)->radius &&
                   children[parent] == 2) {
            forks++;
        }
    }
    double tip = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double radius = (double)vein(venation, i)->radius;
        g_assert_cmpfloat(radius, >, 0);
        tip = MIN(tip, radius);
        if (children[i] > 0) {
            g_assert_cmpfloat(fabs(cbrt(cubes[i]) / radius - 1), <, 1e-3);
        }
    }
    g_assert_cmpuint(forks, >, 0);
    bool has_smallest_fork = false;
    for (uint32_t i = 0; i < count; i++) {
        has_smallest_fork |= fabs((double)vein(venation, i)->radius / tip - 1.259921) < 1e-4;
    }
    g_assert_true(has_smallest_fork);
    g_free(cubes);
    g_free(children);
    g_free(child);
    done(venation, outline);
}

static void test_density(void) {
    uint32_t counts[3];
    const double densities[3] = {0.5, 1, 2};
    for (int i = 0; i < 3; i++) {
        FrMaterialParams params = leaf(1);
        params.vein_density = densities[i];
        FrOutline *outline;
        FrVenation *venation = grow(&params, &outline);
        counts[i] = venation->joins->len;
        done(venation, outline);
    }
    g_assert_cmpuint(counts[1], >, 2 * counts[0]);
    g_assert_cmpuint(counts[2], >, 2 * counts[1]);
}

/// Whatever outline a user draws, growing ends.
static void test_odd_outlines(void) {
    double needle[][2] = {{0, 0}, {0.5, 0.004}, {1, 0}};
    double point[][2] = {{0.5, 0.1}, {0.5, 0.1}, {0.5, 0.1}};
    double wild[][2] = {{0, 0.5}, {NAN, 0.2}, {7, 7}, {0.2, 0.0}, {0.9, 0.5}, {-3, 0.1}};
    double lobed[][2] = {{0, 0.02},  {0.1, 0.3}, {0.2, 0.06}, {0.4, 0.5},
                         {0.5, 0.1}, {0.7, 0.4}, {0.75, 0.1}, {1, 0}};
    const FrPoints outlines[] = {{needle, 3}, {point, 3}, {wild, 6}, {lobed, 8}, {lobed, 1}};
    for (size_t i = 0; i < G_N_ELEMENTS(outlines); i++) {
        FrMaterialParams params = leaf((int)(i % 2));
        params.outline = outlines[i];
        FrOutline *outline;
        FrVenation *venation = grow(&params, &outline);
        g_assert_cmpuint(venation->veins->len, >=, 1);
        for (uint32_t k = 0; k < venation->veins->len; k++) {
            g_assert_true(isfinite(vein(venation, k)->x) && isfinite(vein(venation, k)->y));
        }
        done(venation, outline);
    }
}

static void test_distance(void) {
    double diamond[][2] = {{0, 0}, {0.5, 0.5}, {1, 0}};
    FrMaterialParams params = leaf(0);
    params.outline = (FrPoints){diamond, 3};
    FrOutline *outline = fr_outline_new(&params, 1.0f);
    // A diamond with corners (0, 0), (±½, ½), (0, 1): its sides are 1/√8 from the centre.
    g_assert_cmpfloat(fabsf(fr_outline_at(outline, 0, 0.5f).distance - 0.35355339f), <, 1e-5f);
    g_assert_cmpfloat(fabsf(fr_outline_at(outline, -0.5f, 1.0f).distance + 0.35355339f), <, 1e-5f);
    g_assert_cmpfloat(fabsf(fr_outline_at(outline, 0.25f, 0.25f).arc - 0.25f), <, 1e-5f);
    g_assert_cmpfloat(fabsf(fr_outline_half_width(outline, 0.75f) - 0.25f), <, 1e-5f);
    FrMargin row[64];
    for (int y = 0; y < 64; y++) {
        fr_outline_row(outline, 64, y, row);
        for (int x = 0; x < 64; x++) {
            FrMargin alone =
                fr_outline_at(outline, fr_blade_x(outline, 64, (float)x), fr_blade_y(64, (float)y));
            g_assert_cmpfloat(fabsf(alone.distance - row[x].distance), <, 1e-6f);
        }
    }
    fr_outline_free(outline);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/material/venation/palmate and parallel veins run as they are called",
                    test_patterns);
    g_test_add_func("/material/venation/open venation is a tree rooted in the petiole", test_open);
    g_test_add_func("/material/venation/closed venation is connected and has loops", test_closed);
    g_test_add_func("/material/venation/veins stay in the blade and have no gaps", test_steps);
    g_test_add_func("/material/venation/radii follow the law of Murray", test_murray);
    g_test_add_func("/material/venation/a higher density gives more loops", test_density);
    g_test_add_func("/material/venation/any outline ends in finite veins", test_odd_outlines);
    g_test_add_func("/material/outline/distances of a diamond are those of geometry",
                    test_distance);
    return g_test_run();
}
