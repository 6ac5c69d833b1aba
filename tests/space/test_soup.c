// The soup's answers against a test of every triangle in doubles, and against itself with the same
// triangles added in other ways.
#include "space/soup.h"

#include "frond/random.h"

#include <glib.h>
#include <math.h>

enum { TRIANGLES = 3000, RAYS = 20000 };

typedef struct Triangles {
    float (*corners)[9];
    uint32_t count;
} Triangles;

// Some small, some large, some in the planes z = 0.25 n, where they overlap.
static Triangles make(uint32_t count) {
    Triangles made = {g_malloc(count * sizeof *made.corners), count};
    for (uint32_t i = 0; i < count; i++) {
        FrKey key = fr_key_child(fr_key_root(5), i);
        double size = i % 10 == 0 ? 0.8 : 0.1;
        for (uint32_t c = 0; c < 9; c++) {
            double middle = fr_random_signed(key, 1, c % 3);
            made.corners[i][c] = (float)(middle + size * fr_random_signed(key, 2, c));
            if (i % 5 == 0 && c % 3 == 2) {
                made.corners[i][c] = 0.25f * (float)floor(4.0 * middle);
            }
        }
    }
    return made;
}

static uint64_t key_of(uint32_t triangle) {
    return fr_mix64(triangle + 1);
}

/// Adds the triangles of `order` in batches that end at `ends`.
static FrSoup *soup_of(const Triangles *triangles, const uint32_t *order, const uint32_t *ends,
                       uint32_t batch_count) {
    FrSoup *soup = fr_soup_new(1, NULL, NULL);
    uint32_t begin = 0;
    for (uint32_t b = 0; b < batch_count; b++) {
        uint32_t count = ends[b] - begin;
        float(*corners)[9] = g_malloc(count * sizeof *corners + FR_SOUP_PADDING);
        uint64_t *keys = g_new(uint64_t, count);
        for (uint32_t i = 0; i < count; i++) {
            memcpy(corners[i], triangles->corners[order[begin + i]], sizeof *corners);
            keys[i] = key_of(order[begin + i]);
        }
        g_assert_cmpuint(fr_soup_add(soup, corners, keys, count), ==, begin);
        begin = ends[b];
    }
    return soup;
}

static void ray_of(uint32_t i, float origin[3], float direction[3]) {
    FrKey key = fr_key_child(fr_key_root(17), i);
    double length = 0.0, way[3];
    for (uint32_t c = 0; c < 3; c++) {
        origin[c] = (float)(1.5 * fr_random_signed(key, 1, c));
        way[c] = fr_random_normal(key, 2, c);
        length += way[c] * way[c];
    }
    for (int c = 0; c < 3; c++) {
        direction[c] = (float)(way[c] / sqrt(length));
    }
}

// Distance along the ray by three volumes, in doubles; < 0: not met. `margin` tells how far the ray
// is from an edge.
static double meet(const float *corners, const float origin[3], const float direction[3],
                   double *margin) {
    double a[3][3], d[3], e[2][3], n[3], volume[3];
    for (int c = 0; c < 3; c++) {
        d[c] = (double)direction[c];
        for (int k = 0; k < 3; k++) {
            a[k][c] = (double)corners[3 * k + c] - (double)origin[c];
        }
        e[0][c] = a[1][c] - a[0][c];
        e[1][c] = a[2][c] - a[0][c];
    }
    for (int k = 0; k < 3; k++) {
        const double *p = a[k], *q = a[(k + 1) % 3];
        volume[k] = d[0] * (p[1] * q[2] - p[2] * q[1]) + d[1] * (p[2] * q[0] - p[0] * q[2]) +
                    d[2] * (p[0] * q[1] - p[1] * q[0]);
    }
    n[0] = e[0][1] * e[1][2] - e[0][2] * e[1][1];
    n[1] = e[0][2] * e[1][0] - e[0][0] * e[1][2];
    n[2] = e[0][0] * e[1][1] - e[0][1] * e[1][0];
    double facing = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
    // Divided by their sum they are barycentric coordinates.
    double least = fmin(fmin(volume[0] / facing, volume[1] / facing), volume[2] / facing);
    *margin = fabs(least);
    if (least < 0.0) {
        return -1.0;
    }
    return (n[0] * a[0][0] + n[1] * a[0][1] + n[2] * a[0][2]) / facing;
}

static uint32_t *in_order(void) {
    uint32_t *order = g_new(uint32_t, TRIANGLES);
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        order[i] = i;
    }
    return order;
}

static void test_all(void) {
    Triangles triangles = make(TRIANGLES);
    uint32_t *order = in_order();
    const uint32_t ends[1] = {TRIANGLES};
    FrSoup *soup = soup_of(&triangles, order, ends, 1);
    uint32_t compared = 0, met = 0;
    for (uint32_t i = 0; i < RAYS / 10; i++) {
        float origin[3], direction[3];
        ray_of(i, origin, direction);
        double nearest = INFINITY;
        bool is_clear = true;
        for (uint32_t t = 0; t < TRIANGLES; t++) {
            double margin;
            double distance = meet(triangles.corners[t], origin, direction, &margin);
            is_clear = is_clear && margin > 1e-5;
            nearest = distance > 0.0 ? fmin(nearest, distance) : nearest;
        }
        FrSoupHit hit = fr_soup_trace(soup, origin, direction, FR_NONE);
        if (is_clear) { // no edge so near that rounding decides
            compared++;
            met += hit.triangle != FR_NONE;
            g_assert_cmpfloat(hit.distance, ==, nearest);
        }
    }
    g_assert_cmpuint(compared, >, RAYS / 20);
    g_assert_cmpuint(met, >, RAYS / 40);
    fr_soup_free(soup);
    g_free(order);
    g_free(triangles.corners);
}

static void shuffle(uint32_t *order, uint64_t seed) {
    for (uint32_t i = TRIANGLES - 1; i > 0; i--) {
        uint32_t k = (uint32_t)(fr_random(fr_key_root(seed), 1, i) * (i + 1));
        uint32_t held = order[i];
        order[i] = order[k];
        order[k] = held;
    }
}

static void assert_same_hit(const FrSoupHit *a, const uint32_t *order_a, const FrSoupHit *b,
                            const uint32_t *order_b) {
    g_assert_cmpfloat(a->distance, ==, b->distance);
    g_assert_cmpint(a->is_back, ==, b->is_back);
    g_assert_cmpuint(a->triangle == FR_NONE, ==, b->triangle == FR_NONE);
    if (a->triangle != FR_NONE) {
        g_assert_cmpuint(order_a[a->triangle], ==, order_b[b->triangle]);
    }
}

static void test_order(void) {
    Triangles triangles = make(TRIANGLES);
    uint32_t *order = in_order(), *other = in_order();
    shuffle(other, 3);
    const uint32_t one[1] = {TRIANGLES}, three[3] = {1000, 1300, TRIANGLES};
    FrSoup *soup = soup_of(&triangles, order, one, 1);
    FrSoup *same = soup_of(&triangles, other, three, 3);
    for (uint32_t i = 0; i < RAYS; i++) {
        float origin[3], direction[3];
        ray_of(i, origin, direction);
        FrSoupHit a = fr_soup_trace(soup, origin, direction, FR_NONE);
        FrSoupHit b = fr_soup_trace(same, origin, direction, FR_NONE);
        assert_same_hit(&a, order, &b, other);
        // From there on, without the triangle itself.
        for (int c = 0; c < 3 && a.triangle != FR_NONE; c++) {
            origin[c] += (float)a.distance * direction[c];
        }
        a = fr_soup_trace(soup, origin, direction, a.triangle);
        b = fr_soup_trace(same, origin, direction, b.triangle);
        assert_same_hit(&a, order, &b, other);
    }
    fr_soup_free(soup);
    fr_soup_free(same);
    g_free(order);
    g_free(other);
    g_free(triangles.corners);
}

static void test_last(void) {
    Triangles triangles = make(TRIANGLES);
    uint32_t *order = in_order();
    const uint32_t first[1] = {2500}, both[2] = {2500, TRIANGLES};
    FrSoup *before = soup_of(&triangles, order, first, 1);
    FrSoup *after = soup_of(&triangles, order, both, 2);
    uint32_t cut = 0;
    for (uint32_t i = 0; i < RAYS; i++) {
        float origin[3], direction[3];
        ray_of(i, origin, direction);
        FrSoupHit old = fr_soup_trace(before, origin, direction, FR_NONE);
        FrSoupHit all = fr_soup_trace(after, origin, direction, FR_NONE);
        FrSoupHit new = fr_soup_trace_last(after, origin, direction, old.distance, old.triangle);
        if (all.triangle == old.triangle) {
            g_assert_cmpuint(new.triangle, ==, FR_NONE);
        } else {
            cut++;
            assert_same_hit(&new, order, &all, order);
        }
    }
    g_assert_cmpuint(cut, >, RAYS / 100);
    fr_soup_free(before);
    fr_soup_free(after);
    g_free(order);
    g_free(triangles.corners);
}

// Removes by a pattern, merges, and compares with a soup of what is left.
static void compare_thinned(uint32_t batches, uint32_t of_ten, bool is_first_kept) {
    Triangles triangles = make(TRIANGLES);
    uint32_t *order = in_order();
    const uint32_t ends[5] = {2600, 2700, 2800, 2900, TRIANGLES};
    const uint32_t one[1] = {TRIANGLES};
    FrSoup *soup = soup_of(&triangles, order, batches == 1 ? one : ends, batches);
    uint32_t *left = g_new(uint32_t, TRIANGLES), left_count = 0;
    uint32_t *numbers = g_new(uint32_t, TRIANGLES), *remap = g_new(uint32_t, TRIANGLES);
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        if (t % 10 < of_ten) {
            fr_soup_remove(soup, t);
        } else {
            left[left_count++] = t;
        }
        g_assert_cmpint(fr_soup_has(soup, t), ==, t % 10 >= of_ten);
    }
    const uint32_t end[1] = {left_count};
    FrSoup *same = soup_of(&triangles, left, end, 1);
    for (int merged = 0; merged < 2; merged++) {
        for (uint32_t i = 0; i < RAYS / 4; i++) {
            float origin[3], direction[3];
            ray_of(i, origin, direction);
            FrSoupHit a = fr_soup_trace(soup, origin, direction, FR_NONE);
            FrSoupHit b = fr_soup_trace(same, origin, direction, FR_NONE);
            assert_same_hit(&a, merged == 0 ? order : numbers, &b, left);
        }
        if (merged == 0) {
            g_assert_true(fr_soup_wants_compaction(soup));
            fr_soup_compact(soup, remap);
            g_assert_false(fr_soup_wants_compaction(soup));
            for (uint32_t t = 0; t < TRIANGLES; t++) {
                g_assert_cmpuint(remap[t] == FR_NONE, ==, t % 10 < of_ten);
                g_assert_true(remap[t] == FR_NONE || remap[t] <= t);
                if (remap[t] != FR_NONE) {
                    numbers[remap[t]] = t;
                }
            }
            g_assert_cmpint(remap[99] == 99, ==, is_first_kept);
        }
    }
    fr_soup_free(soup);
    fr_soup_free(same);
    g_free(left);
    g_free(numbers);
    g_free(remap);
    g_free(order);
    g_free(triangles.corners);
}

static void test_removal(void) {
    compare_thinned(1, 7, false);
    compare_thinned(5, 2, true);
    compare_thinned(5, 6, false);
}

static void test_empty(void) {
    FrSoup *soup = fr_soup_new(1, NULL, NULL);
    const float origin[3] = {0, 0, 1}, down[3] = {0, 0, -1};
    g_assert_cmpuint(fr_soup_trace(soup, origin, down, FR_NONE).triangle, ==, FR_NONE);
    float(*corners)[9] = g_malloc(sizeof *corners + FR_SOUP_PADDING);
    memcpy(corners[0], ((const float[9]){-1, -1, 0, 2, -1, 0, -1, 2, 0}), sizeof corners[0]);
    fr_soup_add(soup, corners, g_memdup2(&(uint64_t){1}, sizeof(uint64_t)), 1);
    FrSoupHit hit = fr_soup_trace(soup, origin, down, FR_NONE);
    g_assert_cmpuint(hit.triangle, ==, 0);
    g_assert_cmpfloat(hit.distance, ==, 1.0);
    g_assert_false(hit.is_back);
    g_assert_cmpuint(fr_soup_trace(soup, origin, down, 0).triangle, ==, FR_NONE);
    fr_soup_remove(soup, 0);
    g_assert_cmpuint(fr_soup_trace(soup, origin, down, FR_NONE).triangle, ==, FR_NONE);
    uint32_t remap[1];
    fr_soup_compact(soup, remap);
    g_assert_cmpuint(remap[0], ==, FR_NONE);
    g_assert_cmpuint(fr_soup_count(soup), ==, 0);
    g_assert_cmpuint(fr_soup_trace(soup, origin, down, FR_NONE).triangle, ==, FR_NONE);
    fr_soup_free(soup);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/space/soup/a ray meets the nearest of all triangles", test_all);
    g_test_add_func("/space/soup/the order of additions does not matter", test_order);
    g_test_add_func("/space/soup/only rays that meet what is new are cut", test_last);
    g_test_add_func("/space/soup/what is removed is gone, before and after merging", test_removal);
    g_test_add_func("/space/soup/an empty soup is never met", test_empty);
    return g_test_run();
}
