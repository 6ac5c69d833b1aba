// Cells inside surfaces, held against closed forms and against signed distances.
#include "frond/distance.h"
#include "frond/random.h"
#include "frond/solid.h"
#include "frond/voxels.h"

#include <cglm/struct.h>
#include <glib.h>
#include <math.h>
#include <string.h>

enum { SIDE = 40 };

typedef struct Cells {
    bool is_inside[SIDE][SIDE][SIDE]; // z, y, x
    uint64_t count, runs;
} Cells;

static const FrCellGrid grid = {{-2, -2, -2}, 0.1, {SIDE, SIDE, SIDE}};

static void note_run(void *data, int64_t first, int64_t last, int64_t y, int64_t z) {
    Cells *cells = data;
    cells->runs++;
    g_assert_true(first >= 0 && first <= last && last < SIDE);
    g_assert_true(y >= 0 && y < SIDE && z >= 0 && z < SIDE);
    for (int64_t x = first; x <= last; x++) {
        g_assert_false(cells->is_inside[z][y][x]);
        cells->is_inside[z][y][x] = true;
        cells->count++;
    }
}

static Cells *fill(const vec3s *positions, const uint32_t *indices, uint32_t count) {
    Cells *cells = g_new0(Cells, 1);
    fr_solid_cells(positions, indices, count, &grid, note_run, cells);
    return cells;
}

static const vec3s cube[8] = {{{-1, -1, -1}}, {{1, -1, -1}}, {{1, 1, -1}}, {{-1, 1, -1}},
                              {{-1, -1, 1}},  {{1, -1, 1}},  {{1, 1, 1}},  {{-1, 1, 1}}};
static const uint32_t sides[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                   1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

static void cube_cells(void) {
    Cells *cells = fill(cube, sides, 36);
    g_assert_cmpuint(cells->count, ==, 20 * 20 * 20);
    g_assert_cmpuint(cells->runs, ==, 20 * 20);
    g_assert_true(cells->is_inside[10][10][10] && cells->is_inside[29][29][29]);
    g_assert_false(cells->is_inside[9][10][10] || cells->is_inside[10][10][30]);
    g_free(cells);
}

/// Middles of cells lie on faces and edges: each row is still inside whole or not at all.
static void touched_middles(void) {
    vec3s moved[8];
    for (int i = 0; i < 8; i++) {
        moved[i] = glms_vec3_adds(cube[i], 0.05F);
    }
    Cells *cells = fill(moved, sides, 36);
    g_assert_cmpuint(cells->count % cells->runs, ==, 0);
    g_assert_cmpuint(cells->runs, >=, 19 * 19);
    g_free(cells);
}

static void turned_cubes(void) {
    for (uint32_t k = 0; k < 20; k++) {
        FrKey key = fr_key_child(fr_key_root(5), k);
        versors turn = fr_rotation_about(
            glms_vec3_normalize((vec3s){
                {(float)fr_random_signed(key, 0, 0), (float)fr_random_signed(key, 0, 1), 0.3F}}),
            (float)(6 * fr_random(key, 0, 2)));
        vec3s moved[8];
        for (int i = 0; i < 8; i++) {
            moved[i] = glms_quat_rotatev(turn, cube[i]);
        }
        FrDistance *distance = fr_distance_new(moved, 8, sides, 36);
        Cells *cells = fill(moved, sides, 36);
        for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
            int x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
            double at[3] = {-1.95 + 0.1 * x, -1.95 + 0.1 * y, -1.95 + 0.1 * z}, outward[3];
            double away = fr_distance_at(distance, at, outward);
            if (fabs(away) > 1e-6) {
                g_assert_true(cells->is_inside[z][y][x] == (away < 0));
            }
        }
        g_free(cells);
        fr_distance_free(distance);
    }
}

/// Two cubes of one mesh that overlap: their union, and the same turned inside out.
static void union_cells(void) {
    vec3s both[16];
    uint32_t indices[72], turned[72];
    for (int i = 0; i < 16; i++) {
        both[i] = i < 8 ? cube[i] : glms_vec3_adds(cube[i - 8], 0.5F);
    }
    for (uint32_t i = 0; i < 72; i++) {
        indices[i] = i < 36 ? sides[i] : sides[i - 36] + 8;
    }
    for (uint32_t i = 0; i < 72; i += 3) {
        turned[i] = indices[i];
        turned[i + 1] = indices[i + 2];
        turned[i + 2] = indices[i + 1];
    }
    Cells *cells = fill(both, indices, 72), *again = fill(both, turned, 72);
    g_assert_cmpuint(cells->count, ==, 2 * 8000 - 15 * 15 * 15);
    g_assert_true(memcmp(cells->is_inside, again->is_inside, sizeof cells->is_inside) == 0);
    g_free(cells);
    g_free(again);
}

static void open_surfaces(void) {
    Cells *cells = fill(cube, sides, 24); // the sides at x = 1 and two others are missing
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        g_assert_false(cells->is_inside[i / SIDE / SIDE][i / SIDE % SIDE][i % SIDE]);
    }
    g_free(cells);
    vec3s far[8];
    for (int i = 0; i < 8; i++) {
        far[i] = glms_vec3_scale(cube[i], 1e6F);
    }
    cells = fill(far, sides, 36); // reaches beyond the grid on all sides
    g_assert_cmpuint(cells->count, ==, SIDE * SIDE * SIDE);
    g_free(cells);
    uint32_t flat[6] = {0, 1, 1, 2, 2, 2};
    cells = fill(cube, flat, 6);
    g_assert_cmpuint(cells->count, ==, 0);
    g_free(cells);
}

/// The middles of all cells that lie in a turned cube are held, and no others.
static void held_points(void) {
    vec3s moved[8];
    versors turn = fr_rotation_about(glms_vec3_normalize((vec3s){{3, 1, 2}}), 1.1F);
    for (int i = 0; i < 8; i++) {
        moved[i] = glms_quat_rotatev(turn, cube[i]);
    }
    enum { COUNT = SIDE * SIDE * SIDE };
    FrPoint3 *points = g_new(FrPoint3, COUNT);
    bool *is_held = g_new0(bool, COUNT);
    for (int i = 0; i < COUNT; i++) {
        points[i] = (FrPoint3){{-1.95 + 0.1 * (i % SIDE), -1.95 + 0.1 * (i / SIDE % SIDE),
                                -1.95 + 0.1 * (i / SIDE / SIDE)}};
    }
    fr_solid_holds(moved, sides, 36, points, COUNT, is_held);
    int held = 0;
    for (int i = 0; i < COUNT; i++) {
        vec3s at = {{(float)points[i].at[0], (float)points[i].at[1], (float)points[i].at[2]}};
        vec3s back = glms_quat_rotatev(glms_quat_conjugate(turn), at);
        float beyond = fmaxf(fabsf(back.x), fmaxf(fabsf(back.y), fabsf(back.z))) - 1;
        g_assert_true(fabsf(beyond) < 1e-5F || is_held[i] == (beyond < 0));
        held += is_held[i];
    }
    g_assert_cmpint(held, >, 7500);
    memset(is_held, 0, COUNT);
    fr_solid_holds(moved, sides, 30, points, COUNT, is_held); // a side is missing: rows are open
    int fewer = 0;
    for (int i = 0; i < COUNT; i++) {
        fewer += is_held[i];
    }
    g_assert_cmpint(fewer, <, held);
    g_free(points);
    g_free(is_held);
}

/// The same cells, in bricks.
static void filled_voxels(void) {
    vec3s moved[8];
    versors turn = fr_rotation_about(glms_vec3_normalize((vec3s){{1, 2, 3}}), 0.7F);
    for (int i = 0; i < 8; i++) {
        moved[i] = glms_quat_rotatev(turn, cube[i]);
    }
    Cells *cells = fill(moved, sides, 36);
    FrVoxels *voxels = fr_voxels_new(grid.origin, grid.cell);
    const double end[3] = {2, 2, 2};
    const FrVoxelSurface surface = {.positions = moved, .indices = sides, .index_count = 36};
    FrContext context = fr_context_default();
    context.limits.bytes = voxels->bytes;
    g_assert_cmpint(fr_voxels_fill(voxels, &surface, end, &context), ==, FR_ERR_LIMIT);
    context.progress = fr_progress_new(NULL, NULL);
    context.limits.bytes = voxels->bytes + (1 << 20);
    fr_progress_cancel(context.progress);
    g_assert_cmpint(fr_voxels_fill(voxels, &surface, end, &context), ==, FR_CANCELLED);
    fr_progress_free(context.progress);
    context.progress = NULL;
    g_assert_cmpint(fr_voxels_fill(voxels, &surface, end, &context), ==, FR_OK);
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        int x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
        FrCell cell = {{(int16_t)x, (int16_t)y, (int16_t)z}};
        g_assert_true(cells->is_inside[z][y][x] ==
                      (fr_voxels_owner(voxels, cell) == FR_VOXEL_SOLID));
    }
    fr_voxels_free(voxels);
    g_free(cells);
}

static uint32_t owner_at(const FrVoxels *voxels, int x, int y, int z) {
    return fr_voxels_owner(voxels, (FrCell){{(int16_t)x, (int16_t)y, (int16_t)z}});
}

/// The lowest 64 layers of a cube that would fill 40 gigabytes with bricks.
static void deep_inside(void) {
    vec3s huge[8];
    for (int i = 0; i < 8; i++) {
        huge[i] = glms_vec3_scale(cube[i], 600);
    }
    const double origin[3] = {-500, -500, -500}, end[3] = {500, 500, -484.4};
    FrVoxels *voxels = fr_voxels_new(origin, 1000.0 / 4095);
    FrVoxelSurface surface = {
        .positions = huge, .indices = sides, .index_count = 36, .is_ground = true};
    FrContext context = fr_context_default();
    uint64_t empty = voxels->bytes;
    context.limits.bytes = empty + (20 << 20);
    g_assert_cmpint(fr_voxels_fill(voxels, &surface, end, &context), ==, FR_OK);
    g_assert_cmpuint(owner_at(voxels, 2000, 2000, 40), ==, FR_VOXEL_GROUND);
    g_assert_cmpuint(owner_at(voxels, 2000, 2000, 100), ==, FR_VOXEL_FREE);
    g_assert_cmpuint(voxels->bytes, ==, empty);
    // A root in there: its brick is its own, those beside it are as they were.
    const FrCell root = {{2001, 2001, 41}};
    uint64_t before = voxels->bytes;
    *fr_voxels_at(fr_voxels_reserve(voxels, root), root) = 7;
    g_assert_cmpuint(voxels->bytes - before, <, 8192);
    g_assert_cmpuint(owner_at(voxels, 2000, 2000, 40), ==, FR_VOXEL_GROUND);
    g_assert_cmpuint(owner_at(voxels, 2010, 2001, 41), ==, FR_VOXEL_GROUND);
    // What is solid too is solid, where bricks are shared and where they are not.
    surface.is_ground = false;
    g_assert_cmpint(fr_voxels_fill(voxels, &surface, end, &context), ==, FR_OK);
    surface.is_ground = true;
    g_assert_cmpint(fr_voxels_fill(voxels, &surface, end, &context), ==, FR_OK);
    g_assert_cmpuint(owner_at(voxels, 2000, 2000, 40), ==, FR_VOXEL_SOLID);
    g_assert_cmpuint(owner_at(voxels, 3000, 100, 50), ==, FR_VOXEL_SOLID);
    fr_voxels_clear_solid(voxels);
    g_assert_cmpuint(owner_at(voxels, 3000, 100, 50), ==, FR_VOXEL_FREE);
    g_assert_cmpuint(owner_at(voxels, 2000, 2000, 40), ==, FR_VOXEL_FREE);
    g_assert_cmpuint(owner_at(voxels, 2001, 2001, 41), ==, 7);
    fr_voxels_free(voxels);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/space/solid/a cube has the cells of its volume", cube_cells);
    g_test_add_func("/space/solid/middles of cells on the surface tear no rows", touched_middles);
    g_test_add_func("/space/solid/turned cubes agree with signed distances", turned_cubes);
    g_test_add_func("/space/solid/overlapping solids are one, whichever way they turn",
                    union_cells);
    g_test_add_func("/space/solid/open and flat surfaces enclose nothing", open_surfaces);
    g_test_add_func("/space/solid/points are held by what winds around them", held_points);
    g_test_add_func("/space/solid/voxels are filled with the same cells", filled_voxels);
    g_test_add_func("/space/solid/what is deep inside costs no memory", deep_inside);
    return g_test_run();
}
