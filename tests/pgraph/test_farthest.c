// The farthest of several candidates, held against the plain search over all points.
#include "pgraph/farthest.h"
#include "pgraph/zorder.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { POINTS = 1500, CANDIDATES = 6 };

// On a saddle whose one half lies close together.
static void draw(const void *data, FrKey point, uint32_t candidate, double at[3]) {
    (void)data;
    at[0] = 2 * fr_random(point, 0, candidate) - 1;
    at[1] = 2 * fr_random(point, 1, candidate) - 1;
    at[1] *= at[0] < 0 ? 0.01 : 1;
    at[2] = at[0] * at[1];
}

// Of few places, so that many are equally far.
static void draw_on_lattice(const void *data, FrKey point, uint32_t candidate, double at[3]) {
    (void)data;
    at[0] = floor(8 * fr_random(point, 0, candidate));
    at[1] = floor(8 * fr_random(point, 1, candidate));
    at[2] = 0;
}

static uint32_t farthest_of_all(const FrCandidates *drawn, double (*points)[3], uint32_t count) {
    double farthest = -1;
    uint32_t best = 0;
    for (uint32_t c = 0; c < drawn->count; c++) {
        double at[3], nearest = INFINITY;
        drawn->draw(NULL, fr_key_child(drawn->key, count), c, at);
        for (uint32_t k = 0; k < count; k++) {
            double x = points[k][0] - at[0], y = points[k][1] - at[1], z = points[k][2] - at[2];
            nearest = fmin(nearest, x * x + y * y + z * z);
        }
        if (nearest > farthest) {
            farthest = nearest;
            best = c;
            memcpy(points[count], at, sizeof at);
        }
    }
    return best;
}

static void as_one_by_one(void) {
    for (int lattice = 0; lattice < 2; lattice++) {
        const FrCandidates drawn = {.draw = lattice ? draw_on_lattice : draw,
                                    .key = fr_key_root(7),
                                    .count = CANDIDATES,
                                    .area = lattice ? 64 : 3};
        uint32_t *chosen = fr_choose_farthest(&drawn, POINTS, NULL);
        double(*points)[3] = g_malloc_n(POINTS, sizeof *points);
        for (uint32_t i = 0; i < POINTS; i++) {
            g_assert_cmpuint(chosen[i], ==, farthest_of_all(&drawn, points, i));
        }
        g_free(points);
        g_free(chosen);
    }
}

static void first_stay(void) {
    const FrCandidates drawn = {draw, NULL, fr_key_root(3), CANDIDATES, 3};
    uint32_t *few = fr_choose_farthest(&drawn, 100, NULL);
    uint32_t *many = fr_choose_farthest(&drawn, POINTS, NULL);
    g_assert_true(memcmp(few, many, 100 * sizeof *few) == 0);
    g_free(few);
    g_free(many);
}

static void cancelled(void) {
    const FrCandidates drawn = {draw, NULL, fr_key_root(3), CANDIDATES, 3};
    FrProgress *progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(progress);
    uint32_t *chosen = fr_choose_farthest(&drawn, 100, progress);
    for (uint32_t i = 0; i < 100; i++) {
        g_assert_cmpuint(chosen[i], ==, 0);
    }
    g_free(chosen);
    fr_progress_free(progress);
}

static void in_order(void) {
    // The eight corners of a box in the order of their bits, and places outside as its border.
    const double min[3] = {-1, 0, 5}, max[3] = {1, 0.5, 6};
    FrZorder order = fr_zorder(min, max);
    uint64_t items[9], spare[9];
    for (uint32_t k = 0; k < 8; k++) {
        const uint32_t corner = 7 - k;
        const double at[3] = {corner & 1 ? 3 : -3, corner & 2 ? 0.5 : 0, corner & 4 ? 6 : 5};
        items[k] = fr_zorder_item(&order, at, corner);
    }
    items[8] = fr_zorder_item(&order, min, 100);
    fr_zorder_sort(items, spare, 9);
    const uint32_t expected[9] = {0, 100, 1, 2, 3, 4, 5, 6, 7};
    for (uint32_t k = 0; k < 9; k++) {
        g_assert_cmpuint(fr_zorder_number(items[k]), ==, expected[k]);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/farthest/batches choose what one by one would", as_one_by_one);
    g_test_add_func("/pgraph/farthest/the first stay when more follow", first_stay);
    g_test_add_func("/pgraph/farthest/after cancelling all is left to chance", cancelled);
    g_test_add_func("/pgraph/farthest/z-order goes by the bits of the place", in_order);
    return g_test_run();
}
