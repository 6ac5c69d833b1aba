/// How near internodes may come to each other (E13): all pairs of a dense stand, by brute force.
#include "growing.h"
#include "growth/engine.h"

enum { PLANTS = 4, CELLS = 25 }; // to the metre

/// An internode in the world.
typedef struct Internode {
    double base[3]; ///< where it leaves the cell that it begins in
    double tip[3];
    uint32_t plant, node, parent, axis;
    uint32_t left; ///< the axis that it leaves if it is the first of its own, else FR_NONE
    uint32_t birth;
} Internode;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Distance between two segments (Ericson, Real-Time Collision Detection, 5.1.9).
static double gap(const double p1[3], const double q1[3], const double p2[3], const double q2[3]) {
    double d1[3], d2[3], r[3];
    for (int k = 0; k < 3; k++) {
        d1[k] = q1[k] - p1[k];
        d2[k] = q2[k] - p2[k];
        r[k] = p1[k] - p2[k];
    }
    double a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r), s = 0, t = 0;
    if (a <= 0) {
        t = CLAMP(f / e, 0, 1);
    } else {
        double c = dot(d1, r), b = dot(d1, d2), scale = a * e - b * b;
        s = scale > 1e-12 * a * e ? CLAMP((b * f - c * e) / scale, 0, 1) : 0;
        t = (b * s + f) / e;
        if (t < 0 || t > 1) {
            t = CLAMP(t, 0, 1);
            s = CLAMP((b * t - c) / a, 0, 1);
        }
    }
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double way = r[k] + d1[k] * s - d2[k] * t;
        square += way * way;
    }
    return sqrt(square);
}

/// Cuts off the part that lies in the cell in which the internode begins, for there its bearer
/// stands. False if nothing is left.
static bool leave_first_cell(Internode *one) {
    double leaves = INFINITY;
    for (int k = 0; k < 3; k++) {
        double along = one->tip[k] - one->base[k], cell = floor(one->base[k] * CELLS);
        double wall = (along > 0 ? cell + 1 : cell) / CELLS;
        leaves = along == 0 ? leaves : fmin(leaves, (wall - one->base[k]) / along);
    }
    for (int k = 0; k < 3; k++) {
        one->base[k] += (one->tip[k] - one->base[k]) * leaves;
    }
    return leaves < 1;
}

static GArray *internodes_of(const FrGrowth *growth) {
    GArray *all = g_array_new(FALSE, FALSE, sizeof(Internode));
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            const FrGrownAxis *axis = &plant->axes[plant->nodes.axis[i]];
            bool is_first = axis->first == i && axis->bearer != FR_NONE;
            Internode one = {.plant = p,
                             .node = i,
                             .parent = plant->nodes.parent[i],
                             .axis = plant->nodes.axis[i],
                             .left = is_first ? plant->nodes.axis[axis->bearer] : FR_NONE,
                             .birth = plant->nodes.birth[i]};
            vec3s base = fr_grown_base(plant, i), tip = fr_grown_tip(plant, i);
            for (int k = 0; k < 3; k++) {
                one.base[k] = (double)base.raw[k];
                one.tip[k] = (double)tip.raw[k];
            }
            if (leave_first_cell(&one)) {
                g_array_append_val(all, one);
            }
        }
    }
    return all;
}

/// True of those that may come near each other: of one axis, at one node, or where a branch leaves.
static bool are_kin(const Internode *a, const Internode *b) {
    return a->plant == b->plant &&
           (a->axis == b->axis || a->parent == b->parent || a->parent == b->node ||
            b->parent == a->node || a->left == b->axis || b->left == a->axis ||
            (a->left != FR_NONE && a->left == b->left));
}

/// The least distances of all pairs that are not kin.
typedef struct Least {
    double tips;       ///< from the tip of the later one to the whole other one
    double internodes; ///< from any point of one to any of the other
    guint pairs;
} Least;

static Least measure(GArray *all) {
    Least least = {.tips = INFINITY, .internodes = INFINITY};
    for (guint i = 0; i < all->len; i++) {
        const Internode *a = &g_array_index(all, Internode, i);
        for (guint k = 0; k < i; k++) {
            const Internode *b = &g_array_index(all, Internode, k);
            if (are_kin(a, b)) {
                continue;
            }
            double from_a = gap(a->tip, a->tip, b->base, b->tip);
            double from_b = gap(b->tip, b->tip, a->base, a->tip);
            // Of two that are born in one step either may have been the first.
            double tip = a->birth > b->birth   ? from_a
                         : a->birth < b->birth ? from_b
                                               : fmax(from_a, from_b);
            least.tips = fmin(least.tips, tip);
            least.internodes = fmin(least.internodes, gap(a->base, a->tip, b->base, b->tip));
            least.pairs++;
        }
    }
    return least;
}

/// A stand so close that branches get in each other's way.
static Least grow(const char *box, const char *keeps_off) {
    World world;
    world_init(&world);
    world_set(&world, "model", "open");
    world_set(&world, "shed", "none");
    world_set(&world, "dormancy", "0");
    world_set(&world, "auxin-reach", "1");
    world_set(&world, "box", box);
    world_set(&world, "keeps-off", keeps_off);
    world.setup.params.cell = 1.0 / CELLS;
    const FrSeed seeds[PLANTS] = {{.id = 1},
                                  {.at = {0.4, 0, 0}, .id = 2},
                                  {.at = {0, 0.4, 0}, .id = 3},
                                  {.at = {0.4, 0.4, 0}, .id = 4}};
    world_sow(&world, seeds, PLANTS);
    g_assert_cmpuint(world_step(&world, 11).collisions, >, 20);
    GArray *all = internodes_of(world.growth);
    g_assert_cmpuint(all->len, >, 150);
    Least least = measure(all);
    g_test_message("box %s around the %s: %u pairs, tips %g m, internodes %g m apart", box,
                   keeps_off, least.pairs, least.tips, least.internodes);
    g_array_free(all, TRUE);
    world_clear(&world);
    return least;
}

static void test_tips(void) {
    g_assert_cmpfloat(grow("3", "tip").tips, >=, 1.0 / CELLS);
    g_assert_cmpfloat(grow("5", "tip").tips, >=, 2.0 / CELLS);
}

/// They share no cell.
static void test_never_touch(void) {
    g_assert_cmpfloat(grow("1", "tip").internodes, >, 1e-6);
}

static void test_internodes(void) {
    g_assert_cmpfloat(grow("3", "internode").internodes, >=, 1.0 / CELLS);
    g_assert_cmpfloat(grow("5", "internode").internodes, >=, 2.0 / CELLS);
}

enum { POINTS = 24 };

/// Which points of a grid are taken.
static void look(const World *world, bool *is_taken) {
    for (int i = 0; i < POINTS * POINTS * POINTS; i++) {
        const double at[3] = {-1.2 + 0.1 * (i % POINTS), -1.2 + 0.1 * (i / POINTS % POINTS),
                              0.1 * (i / POINTS / POINTS)};
        is_taken[i] = fr_growth_is_taken(world->growth, at);
    }
}

/// The cells of branches are those of then, and what stands in the way is there still.
static void test_taken_back(void) {
    static const vec3s corners[4] = {
        {{0.5F, -1, 0}}, {{0.5F, 1, 0}}, {{0.5F, 1, 3}}, {{0.5F, -1, 3}}};
    World world;
    world_init(&world);
    world_set(&world, "model", "open");
    const FrGrowthObstacle wall = world_sheet(corners);
    world.setup.obstacles = &wall;
    world.setup.obstacle_count = 1;
    world.setup.params.history = 4;
    world_sow_one(&world);
    world_step(&world, 5);
    bool *then = g_new(bool, POINTS *POINTS *POINTS);
    bool *now = g_new(bool, POINTS *POINTS *POINTS);
    look(&world, then);
    world_step(&world, 4);
    look(&world, now);
    g_assert_true(memcmp(then, now, POINTS * POINTS * POINTS) != 0);
    for (int i = 0; i < 4; i++) {
        g_assert_true(fr_growth_undo(world.growth));
    }
    look(&world, now);
    g_assert_true(memcmp(then, now, POINTS * POINTS * POINTS) == 0);
    g_assert_true(fr_growth_is_taken(world.growth, (double[3]){0.5, 0.5, 1}));
    g_free(then);
    g_free(now);
    world_clear(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/space/E13 new tips are half a box off all wood but their kin's",
                    test_tips);
    g_test_add_func("/growth/space/E13 branches never touch, however small the box",
                    test_never_touch);
    g_test_add_func(
        "/growth/space/E13 no two internodes are nearer than half a box where asked for",
        test_internodes);
    g_test_add_func("/growth/space/a step back frees its cells and lets obstacles stand",
                    test_taken_back);
    return g_test_run();
}
