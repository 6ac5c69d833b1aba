// Welds branches to their parents: a hole in the parent's lattice of quads, as wide as the branch's
// first ring needs it, is filled from its rim to that ring. Both have the same places and normals
// there, so the surface is one.
//
// It goes over a mesh that is written, one generation of branches after the other: where each
// would be welded is found side by side, and the holes are dug in the order of tubes.
// Where a hole would meet another's or the parent's end, or would go around it, the branch stays
// as it was: on a collar that reaches into its parent.
#include "skin/weld.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

// Quads that a ring keeps away from the rim of its hole.
#define CLEAR_COLUMNS 0.15F
#define CLEAR_RINGS 0.08F
enum { FEET_MOST = 129, BRANCH_GRAIN = 4 };

/// The branch's first ring on its parent, and its hole.
typedef struct FrWeldHole {
    FrWeldFoot feet[FEET_MOST];
    uint32_t foot_count;
    int32_t left, right;  ///< columns of the rim
    uint32_t bottom, top; ///< rings of it
} FrWeldHole;

/// What fills a hole: vertices of its own, and corners of triangles among them. Owned.
typedef struct FrWeldPatch {
    FrVertex *vertices;
    uint32_t (*triangles)[3];
    uint32_t vertex_count, triangle_count;
} FrWeldPatch;

typedef struct FrWeldBranch {
    const FrTube *tube, *bearer;
    uint32_t generation; ///< of branches on branches
    FrWeldHole *hole;    ///< owned, until it is dug or given up; NULL: there is none
    FrWeldPatch patch;
    bool is_dug;
} FrWeldBranch;

typedef struct FrWelding {
    FrPatch *patch;
    const FrPlan *plan;
    uint32_t *tube_of;      ///< by node, FR_NONE
    FrWeldGrid *grids;      ///< by tube, as they are needed
    FrWeldBranch *branches; ///< at work
} FrWelding;

static const FrTube *tube_at(const FrWelding *welding, uint32_t tube) {
    return &g_array_index(welding->plan->tubes, FrTube, tube);
}

static FrVertex *vertices_of(const FrWelding *welding, const FrTube *tube) {
    const FrMeshPart *part = fr_patch_part(welding->patch, tube->slot);
    return welding->patch->mesh->vertices + part->first_vertex + tube->first_vertex;
}

static uint32_t columns_of(const FrWelding *welding, const FrTube *tube) {
    return welding->plan->sections[tube->section].count;
}

// ---- the hole ----------------------------------------------------------------------------------

static void make_grid(FrWelding *welding, uint32_t tube) {
    FrWeldGrid *grid = &welding->grids[tube];
    if (grid->bands == NULL) {
        const FrTube *parent = tube_at(welding, tube);
        fr_weld_grid_init(grid, vertices_of(welding, parent), columns_of(welding, parent),
                          parent->rings);
    }
}

// Finds where the ring is on the parent; false if it goes around it.
static bool find_feet(const FrWeldGrid *grid, const FrVertex *ring, uint32_t count,
                      FrWeldHole *hole) {
    float sides = (float)grid->columns - 1.0F;
    hole->foot_count = count;
    for (uint32_t i = 0; i < count; i++) {
        FrWeldFoot *foot = &hole->feet[i];
        *foot = fr_weld_snap(grid, ring[i].position);
        float before = i > 0 ? hole->feet[i - 1].x : foot->x;
        float turns = floorf((before - foot->x) / sides + 0.5F);
        foot->x += turns * sides;
        foot->vertex.uv[0] += turns * grid->around;
    }
    return fabsf(hole->feet[count - 1].x - hole->feet[0].x) < 0.5F * sides;
}

// The rectangle of quads that has the ring within it; false if there is none.
static bool find_rim(const FrWeldGrid *grid, FrWeldHole *hole) {
    float left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;
    for (uint32_t i = 0; i < hole->foot_count; i++) {
        left = MIN(left, hole->feet[i].x);
        right = MAX(right, hole->feet[i].x);
        bottom = MIN(bottom, hole->feet[i].y);
        top = MAX(top, hole->feet[i].y);
    }
    if (bottom < CLEAR_RINGS || top > (float)grid->rings - 1.0F - CLEAR_RINGS) {
        return false;
    }
    hole->left = (int32_t)floorf(left - CLEAR_COLUMNS);
    hole->right = (int32_t)ceilf(right + CLEAR_COLUMNS);
    hole->bottom = (uint32_t)(bottom - CLEAR_RINGS);
    hole->top = MIN((uint32_t)ceilf(top + CLEAR_RINGS), grid->rings - 1);
    uint32_t wide = (uint32_t)(hole->right - hole->left), high = hole->top - hole->bottom;
    return wide + 1 < grid->columns - 1 && 2 * (wide + high) + hole->foot_count <= FR_WELD_MOST;
}

// The first of the two triangles of a quad, in the mesh.
static uint64_t triangles_at(const FrWelding *welding, const FrTube *tube, int32_t column,
                             uint32_t ring) {
    int32_t sides = (int32_t)columns_of(welding, tube) - 1;
    uint64_t at = (uint64_t)(((column % sides) + sides) % sides);
    uint64_t first = fr_patch_part(welding->patch, tube->slot)->first_index + tube->first_index;
    return first / 3 + 2 * ((uint64_t)ring * (uint64_t)sides + at);
}

// Whether every quad of the hole is still there; with `take`, removes them.
static bool dig(const FrWelding *welding, const FrTube *tube, const FrWeldHole *hole, bool take) {
    for (uint32_t ring = hole->bottom; ring < hole->top; ring++) {
        for (int32_t column = hole->left; column < hole->right; column++) {
            uint64_t at = triangles_at(welding, tube, column, ring);
            if (welding->patch->is_gone[at] != 0) {
                return false;
            }
            welding->patch->is_gone[at] = welding->patch->is_gone[at + 1] = take ? 1 : 0;
        }
    }
    return true;
}

// ---- the patch ---------------------------------------------------------------------------------

static FrWeldPoint point_of(const FrVertex *vertex, float x, float y) {
    return (FrWeldPoint){{{vertex->position[0], vertex->position[1], vertex->position[2]}}, x, y};
}

// Counter-clockwise from the lower left corner.
static uint32_t walk_rim(const FrWeldGrid *grid, const FrWeldHole *hole, FrVertex *vertices,
                         FrWeldPoint *points) {
    int32_t x = hole->left, wide = hole->right - hole->left;
    int32_t y = (int32_t)hole->bottom, high = (int32_t)(hole->top - hole->bottom);
    uint32_t count = 0;
    const int32_t sides[4][3] = {{1, 0, wide}, {0, 1, high}, {-1, 0, wide}, {0, -1, high}};
    for (int side = 0; side < 4; side++) {
        for (int32_t k = 0; k < sides[side][2]; k++) {
            vertices[count] = fr_weld_grid_vertex(grid, x, (uint32_t)y);
            points[count] = point_of(&vertices[count], (float)x, (float)y);
            count++;
            x += sides[side][0];
            y += sides[side][1];
        }
    }
    return count;
}

// The feet, turned round if the branch's columns go the other way.
static void walk_feet(const FrWeldHole *hole, FrVertex *vertices, FrWeldPoint *points) {
    uint32_t count = hole->foot_count;
    float area = 0.0F;
    for (uint32_t i = 0; i < count; i++) {
        const FrWeldFoot *a = &hole->feet[i], *b = &hole->feet[(i + 1) % count];
        area += (a->x - hole->feet[0].x) * (b->y - hole->feet[0].y) -
                (b->x - hole->feet[0].x) * (a->y - hole->feet[0].y);
    }
    for (uint32_t i = 0; i < count; i++) {
        const FrWeldFoot *foot = &hole->feet[area > 0.0F ? i : count - 1 - i];
        vertices[i] = foot->vertex;
        points[i] = point_of(&foot->vertex, foot->x, foot->y);
    }
}

// Deformed space may be inside out: then so are the quads that go.
static bool is_turned(const FrWelding *welding, const FrTube *tube, const FrWeldHole *hole) {
    const uint32_t *corner =
        welding->patch->mesh->indices + 3 * triangles_at(welding, tube, hole->left, hole->bottom);
    return corner[1] != corner[0] + 1;
}

// Fills the hole; false if there is no way to.
static bool make_patch(const FrWelding *welding, const FrTube *tube, const FrWeldGrid *grid,
                       const FrWeldHole *hole, FrWeldPatch *made) {
    FrVertex vertices[FR_WELD_MOST];
    FrWeldPoint points[FR_WELD_MOST];
    uint32_t triangles[FR_WELD_MOST][3];
    uint32_t rim = walk_rim(grid, hole, vertices, points), feet = hole->foot_count;
    walk_feet(hole, vertices + rim, points + rim);
    made->triangle_count = fr_weld_strip(points, rim, points + rim, feet, triangles);
    if (made->triangle_count == 0) {
        return false;
    }
    bool turned = is_turned(welding, tube, hole);
    for (uint32_t i = 0; turned && i < made->triangle_count; i++) {
        uint32_t kept = triangles[i][1];
        triangles[i][1] = triangles[i][2];
        triangles[i][2] = kept;
    }
    made->vertex_count = rim + feet;
    made->vertices = g_memdup2(vertices, made->vertex_count * sizeof *vertices);
    made->triangles = g_memdup2(triangles, made->triangle_count * sizeof *triangles);
    return true;
}

static void add_patch(FrWelding *welding, const FrWeldPatch *made, uint32_t slot) {
    uint32_t first = fr_patch_add(welding->patch, slot, made->vertices, made->vertex_count);
    for (uint32_t i = 0; i < made->triangle_count; i++) {
        const uint32_t *corner = made->triangles[i];
        const uint32_t own[3] = {first + corner[0], first + corner[1], first + corner[2]};
        fr_patch_add_triangle(welding->patch, slot, own);
    }
}

// ---- one branch --------------------------------------------------------------------------------

// Moves the first ring onto the parent, and those that lead from it as far as they follow.
static void move_collar(const FrTube *tube, uint32_t columns, const FrWeldHole *hole,
                        FrVertex *rings) {
    for (uint32_t i = 0; i < columns; i++) {
        const FrVertex *foot = &hole->feet[i % (columns - 1)].vertex;
        float move[3];
        for (int k = 0; k < 3; k++) {
            move[k] = foot->position[k] - rings[i].position[k];
        }
        for (uint32_t ring = 1; ring < tube->collar_rings; ring++) {
            float left = 1.0F - (float)ring / (float)tube->collar_rings;
            for (int k = 0; k < 3; k++) {
                rings[ring * columns + i].position[k] += left * left * move[k];
            }
        }
        memcpy(rings[i].position, foot->position, sizeof foot->position);
        memcpy(rings[i].normal, foot->normal, sizeof foot->normal);
    }
}

// The tube that a branch can be welded to, NULL if there is none.
static const FrTube *bearer_of(const FrWelding *welding, const FrTube *tube) {
    const FrPlan *plan = welding->plan;
    uint32_t parent = welding->tube_of[plan->plant->axes.bearer[tube->axis]];
    if (parent == FR_NONE || columns_of(welding, tube) - 1 >= FEET_MOST) {
        return NULL;
    }
    const FrTube *bearer = tube_at(welding, parent);
    bool can_bear = bearer->rings >= 2 && plan->sections[bearer->section].is_closed &&
                    bearer->scope == tube->scope;
    return can_bear ? bearer : NULL;
}

static uint32_t number_of(const FrWelding *welding, const FrTube *tube) {
    return (uint32_t)(tube - tube_at(welding, 0));
}

// Finds the holes of some branches and fills them, as if there were no others.
static void find_holes(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const FrWelding *welding = data;
    for (size_t i = begin; i < end; i++) {
        FrWeldBranch *branch = &welding->branches[i];
        const FrWeldGrid *grid = &welding->grids[number_of(welding, branch->bearer)];
        const FrVertex *ring = vertices_of(welding, branch->tube);
        uint32_t feet = columns_of(welding, branch->tube) - 1;
        FrWeldHole hole = {0};
        if (find_feet(grid, ring, feet, &hole) && find_rim(grid, &hole) &&
            make_patch(welding, branch->bearer, grid, &hole, &branch->patch)) {
            branch->hole = g_memdup2(&hole, sizeof hole);
        }
    }
}

// Digs the holes that meet no other, in the order of tubes.
static void dig_holes(FrWelding *welding, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++) {
        FrWeldBranch *branch = &welding->branches[i];
        if (branch->hole != NULL && dig(welding, branch->bearer, branch->hole, false)) {
            dig(welding, branch->bearer, branch->hole, true);
            move_collar(branch->tube, columns_of(welding, branch->tube), branch->hole,
                        vertices_of(welding, branch->tube));
            branch->is_dug = true;
        }
        g_clear_pointer(&branch->hole, g_free);
    }
}

static gint by_generation(gconstpointer a, gconstpointer b) {
    const FrWeldBranch *one = a, *other = b;
    if (one->generation != other->generation) {
        return one->generation < other->generation ? -1 : 1;
    }
    return one->tube < other->tube ? -1 : one->tube > other->tube;
}

static gint by_tube(gconstpointer a, gconstpointer b) {
    const FrWeldBranch *one = a, *other = b;
    return one->tube < other->tube ? -1 : one->tube > other->tube;
}

// ---- the whole ---------------------------------------------------------------------------------

static uint32_t *tubes_by_node(const FrPlan *plan) {
    uint32_t *tube_of = g_new(uint32_t, plan->plant->nodes.count);
    memset(tube_of, 0xff, plan->plant->nodes.count * sizeof *tube_of);
    for (uint32_t i = 0; i < plan->tubes->len; i++) {
        const FrTube *tube = &g_array_index(plan->tubes, FrTube, i);
        for (uint32_t node = tube->first; tube->rings > 0; node = fr_plan_next(plan, node)) {
            tube_of[node] = i;
            if (node == tube->last) {
                break;
            }
        }
    }
    return tube_of;
}

// All that may be welded, generation after generation: what a branch stands on has moved before.
static GArray *find_branches(const FrWelding *welding) {
    const FrPlan *plan = welding->plan;
    GArray *branches = g_array_new(FALSE, FALSE, sizeof(FrWeldBranch));
    uint32_t *generation = g_new0(uint32_t, plan->tubes->len);
    for (uint32_t i = 0; i < plan->tubes->len; i++) {
        const FrTube *tube = tube_at(welding, i);
        const FrTube *bearer = tube->is_welded && tube->rings > 0 ? bearer_of(welding, tube) : NULL;
        if (bearer != NULL) {
            generation[i] = 1 + generation[number_of(welding, bearer)];
            FrWeldBranch branch = {.tube = tube, .bearer = bearer, .generation = generation[i]};
            g_array_append_val(branches, branch);
        }
    }
    g_free(generation);
    g_array_sort(branches, by_generation);
    return branches;
}

static void weld_generation(FrWelding *welding, uint32_t begin, uint32_t end) {
    const FrContext *context = welding->plan->context;
    for (uint32_t i = begin; i < end; i++) {
        make_grid(welding, number_of(welding, welding->branches[i].bearer));
    }
    FrWeldBranch *all = welding->branches;
    welding->branches = all + begin;
    fr_parallel_for(context->pool, end - begin, BRANCH_GRAIN, find_holes, welding, NULL);
    welding->branches = all;
    dig_holes(welding, begin, end);
}

FrStatus fr_weld(FrPatch *patch) {
    const FrPlan *plan = &patch->job->wood->plan;
    FrWelding welding = {
        .patch = patch,
        .plan = plan,
        .tube_of = tubes_by_node(plan),
        .grids = g_new0(FrWeldGrid, plan->tubes->len),
    };
    GArray *branches = find_branches(&welding);
    welding.branches = (FrWeldBranch *)(void *)branches->data;
    FrStatus status = FR_OK;
    for (uint32_t begin = 0, end = 0; begin < branches->len && status == FR_OK; begin = end) {
        while (end < branches->len &&
               welding.branches[end].generation == welding.branches[begin].generation) {
            end++;
        }
        weld_generation(&welding, begin, end);
        status = fr_progress_is_cancelled(plan->context->progress) ? FR_CANCELLED : FR_OK;
    }
    g_array_sort(branches, by_tube);
    for (uint32_t i = 0; i < branches->len; i++) {
        FrWeldBranch *branch = &welding.branches[i];
        if (branch->is_dug) {
            add_patch(&welding, &branch->patch, branch->bearer->slot);
        }
        g_free(branch->patch.vertices);
        g_free(branch->patch.triangles);
    }
    g_array_unref(branches);
    for (uint32_t i = 0; i < plan->tubes->len; i++) {
        fr_weld_grid_clear(&welding.grids[i]);
    }
    g_free(welding.tube_of);
    g_free(welding.grids);
    return status;
}
