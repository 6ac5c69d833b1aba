// The outer surface of overlapping closed surfaces, as one solid.
// Doi, Koide. An efficient method of triangulating equi-valued surfaces by using tetrahedral cells.
// IEICE Transactions E74(1), 1991: of a tetrahedron's corners those inside are cut off by one or
// two triangles, and neighbours agree on what their common face has, so the surface is closed.
//
// A cell of the lattice is six tetrahedra, one for each order of going along x, y and z
// (Freudenthal 1942). Where an edge passes the surface is known exactly (solid_lines.c); points
// keep a little away from the corners, so that no triangle is without an area.
#include "skin/solid.h"

#include "skin/mesh.h"
#include "skin/nurbs.h"

#include <math.h>
#include <string.h>

/// Parts of an edge that points keep away from its ends.
#define CLEAR 0.04
/// The lattice is moved by parts of a cell, so that nothing drawn on round numbers lies on it.
static const double aside[3] = {0.31830988618, 0.41421356237, 0.57721566490};

typedef struct FrSolid {
    FrSolidLines lines[FR_SOLID_WAYS];
    double origin[3], width;
    GArray *vertices;    ///< FrVertex
    GArray *indices;     ///< uint32_t
    GHashTable *by_edge; ///< of the lattice → vertex + 1
} FrSolid;

// ---- one cell ----------------------------------------------------------------------------------

static int way_between(const int low[3], const int high[3]) {
    int way = 0;
    for (; way < FR_SOLID_WAYS; way++) {
        const int *step = fr_solid_steps[way];
        if (low[0] + step[0] == high[0] && low[1] + step[1] == high[1] &&
            low[2] + step[2] == high[2]) {
            break;
        }
    }
    return way;
}

/// Where an edge of the lattice passes the surface, 0 to 1 of it.
static double pass_of(const FrSolid *solid, int way, const int32_t point[3], bool goes_in) {
    int32_t line[2], at;
    size_t count;
    fr_solid_line(way, point, line, &at);
    const FrCrossing *crossings = fr_solid_find(&solid->lines[way], line, &count);
    for (size_t i = 0; i < count; i++) {
        double along = crossings[i].at - at;
        if (crossings[i].goes_in == goes_in && along >= 0.0 && along <= 1.0) {
            return CLAMP(along, CLEAR, 1.0 - CLEAR);
        }
    }
    return 0.5;
}

static uint32_t vertex_on(FrSolid *solid, const int32_t cell[3], const int low[3],
                          const int high[3], bool goes_in) {
    int way = way_between(low, high);
    int32_t point[3];
    for (int k = 0; k < 3; k++) {
        point[k] = cell[k] + low[k];
    }
    // 20 bits each way and 3 for the direction: the lattice is not wider than 2^20.
    uint64_t key = ((uint64_t)(uint32_t)point[0] & 0xfffff) |
                   ((uint64_t)(uint32_t)point[1] & 0xfffff) << 20 |
                   ((uint64_t)(uint32_t)point[2] & 0xfffff) << 40 | (uint64_t)way << 60;
    gpointer found = g_hash_table_lookup(solid->by_edge, &key);
    if (found != NULL) {
        return GPOINTER_TO_UINT(found) - 1;
    }
    double part = pass_of(solid, way, point, goes_in);
    FrVertex vertex = {0};
    for (int k = 0; k < 3; k++) {
        double at = point[k] + part * fr_solid_steps[way][k];
        vertex.position[k] = (float)(solid->origin[k] + solid->width * at);
    }
    g_array_append_val(solid->vertices, vertex);
    g_hash_table_insert(solid->by_edge, g_memdup2(&key, sizeof key),
                        GUINT_TO_POINTER(solid->vertices->len));
    return solid->vertices->len - 1;
}

/// Corners of a tetrahedron with what is cut off them.
typedef struct FrTetrahedron {
    int corner[4][3];
    bool is_inside[4];
} FrTetrahedron;

/// True if the middles of three edges, each between two corners, turn to the outside.
static bool faces_out(const FrTetrahedron *t, int edges[3][2]) {
    double at[3][3], out[3] = {0};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            at[i][k] = 0.5 * (t->corner[edges[i][0]][k] + t->corner[edges[i][1]][k]);
            int step = t->corner[edges[i][1]][k] - t->corner[edges[i][0]][k];
            out[k] += t->is_inside[edges[i][0]] ? step : -step;
        }
    }
    double a[3], b[3], dot = 0.0;
    for (int k = 0; k < 3; k++) {
        a[k] = at[1][k] - at[0][k];
        b[k] = at[2][k] - at[0][k];
    }
    for (int k = 0; k < 3; k++) {
        int m = (k + 1) % 3, n = (k + 2) % 3;
        dot += (a[m] * b[n] - a[n] * b[m]) * out[k];
    }
    return dot > 0.0;
}

static void put_triangle(FrSolid *solid, const int32_t cell[3], const FrTetrahedron *t,
                         int edges[3][2]) {
    uint32_t made[3];
    for (int i = 0; i < 3; i++) {
        int low = MIN(edges[i][0], edges[i][1]), high = MAX(edges[i][0], edges[i][1]);
        made[i] = vertex_on(solid, cell, t->corner[low], t->corner[high], t->is_inside[high]);
    }
    if (!faces_out(t, edges)) {
        uint32_t other = made[1];
        made[1] = made[2];
        made[2] = other;
    }
    g_array_append_vals(solid->indices, made, 3);
}

static void cut_tetrahedron(FrSolid *solid, const int32_t cell[3], const FrTetrahedron *t) {
    int in[4], out[4], ins = 0, outs = 0;
    for (int i = 0; i < 4; i++) {
        if (t->is_inside[i]) {
            in[ins++] = i;
        } else {
            out[outs++] = i;
        }
    }
    if (ins == 1 || ins == 3) {
        int alone = ins == 1 ? in[0] : out[0], *rest = ins == 1 ? out : in;
        int edges[3][2] = {{alone, rest[0]}, {alone, rest[1]}, {alone, rest[2]}};
        put_triangle(solid, cell, t, edges);
    } else if (ins == 2) {
        int one[3][2] = {{in[0], out[0]}, {in[0], out[1]}, {in[1], out[1]}};
        int other[3][2] = {{in[0], out[0]}, {in[1], out[1]}, {in[1], out[0]}};
        put_triangle(solid, cell, t, one);
        put_triangle(solid, cell, t, other);
    }
}

/// `inside` by corner: bit 0 along x, bit 1 along y, bit 2 along z.
static void cut_cell(FrSolid *solid, const int32_t cell[3], const bool inside[8]) {
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                     {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int o = 0; o < 6; o++) {
        FrTetrahedron t = {0};
        for (int c = 0; c < 4; c++) {
            int bits = 0;
            for (int k = 0; k < 3; k++) {
                t.corner[c][k] = c > 0 ? t.corner[c - 1][k] : 0;
                t.corner[c][k] += c > 0 && orders[o][c - 1] == k;
                bits |= t.corner[c][k] << k;
            }
            t.is_inside[c] = inside[bits];
        }
        cut_tetrahedron(solid, cell, &t);
    }
}

// ---- all cells ---------------------------------------------------------------------------------

/// A line along x on its way: whether the lattice's points are inside, from the left.
typedef struct FrWalk {
    const FrCrossing *next;
    size_t left;
} FrWalk;

/// Whether the point `x` is inside; points are asked for in rising order.
static bool is_inside(FrWalk *walk, double x) {
    while (walk->left > 0 && walk->next->at < x) {
        walk->next++;
        walk->left--;
    }
    return walk->left > 0 && !walk->next->goes_in;
}

static void cut_row(FrSolid *solid, int32_t j, int32_t k) {
    FrWalk walks[4];
    double first = INFINITY;
    for (int r = 0; r < 4; r++) {
        const int32_t line[2] = {j + r % 2, k + r / 2};
        walks[r].next = fr_solid_find(&solid->lines[0], line, &walks[r].left);
        first = walks[r].left > 0 ? fmin(first, walks[r].next->at) : first;
    }
    bool before[4] = {false};
    for (double x = floor(first); isfinite(x);) {
        bool inside[8], is_mixed = false;
        double next = INFINITY;
        for (int r = 0; r < 4; r++) {
            bool after = is_inside(&walks[r], x + 1.0);
            next = walks[r].left > 0 ? fmin(next, walks[r].next->at) : next;
            inside[2 * r] = before[r];
            inside[2 * r + 1] = before[r] = after;
        }
        for (int c = 1; c < 8; c++) {
            is_mixed |= inside[c] != inside[0];
        }
        if (is_mixed) {
            const int32_t cell[3] = {(int32_t)x, j, k};
            cut_cell(solid, cell, inside);
        }
        bool is_even = before[0] == before[1] && before[1] == before[2] && before[2] == before[3];
        if (!isfinite(next) && is_even && !before[0]) {
            return;
        }
        x = is_even ? fmax(floor(next), x + 1.0) : x + 1.0;
    }
}

/// Rows of cells: along y, then along z.
static int compare_rows(const void *a, const void *b) {
    const int32_t *p = a, *q = b;
    int first = (p[1] > q[1]) - (p[1] < q[1]);
    return first != 0 ? first : (p[0] > q[0]) - (p[0] < q[0]);
}

static void cut_rows(FrSolid *solid, const FrContext *context) {
    GArray *rows = g_array_new(FALSE, FALSE, 2 * sizeof(int32_t));
    const FrSolidLines *lines = &solid->lines[0];
    for (size_t i = 0; i < lines->count; i++) {
        const int32_t *line = lines->crossings[i].line;
        bool is_new = i == 0 || memcmp(line, lines->crossings[i - 1].line, 2 * sizeof *line) != 0;
        for (int r = 0; r < 4 && is_new; r++) {
            const int32_t row[2] = {line[0] - r % 2, line[1] - r / 2};
            g_array_append_vals(rows, row, 1);
        }
    }
    g_array_sort(rows, compare_rows);
    for (guint i = 0; i < rows->len && !fr_progress_is_cancelled(context->progress); i++) {
        const int32_t *row = (const int32_t *)(void *)rows->data + 2 * (size_t)i;
        if (i == 0 || compare_rows(row, row - 2) != 0) {
            cut_row(solid, row[0], row[1]);
        }
    }
    g_array_unref(rows);
}

// ---- the whole ---------------------------------------------------------------------------------

/// Tells what is no part of the solid, and how it would be.
static void warn_of_open(const FrSolidAsk *ask) {
    const FrNurbsParams *params = ask->params;
    const char *advice = params->forks == FR_FORKS_RAMIFORM
                             ? "fork surfaces never are, tubes are with 'forks' as 'plain'"
                         : !params->caps            ? "tubes are with 'caps'"
                         : !(params->thickness > 0) ? "blades are with a 'thickness'"
                                                    : "flat shapes and open profiles never are";
    fr_diags_add(ask->context->diags, FR_WARNING, "not-closed", ask->span,
                 "'%s': surfaces that are not closed are no part of the solid; %s", ask->plant,
                 advice);
}

static void warn_of_thin(const FrSolidAsk *ask) {
    const FrNurbsParams *params = ask->params;
    if (params->thickness > 0.0 && params->thickness < params->voxel) {
        fr_diags_add(ask->context->diags, FR_WARNING, "thinner-than-voxel", ask->span,
                     "'%s': blades %g m thick fall to pieces on a lattice of %g m; let 'voxel' be "
                     "at most half of 'thickness'",
                     ask->plant, params->thickness, params->voxel);
    }
}

static FrStatus refuse_nothing(const FrSolidAsk *ask, bool has_closed) {
    if (has_closed) {
        fr_diags_add(ask->context->diags, FR_ERROR, "voxel-too-coarse", ask->span,
                     "'%s': everything falls through a lattice of %g m; let 'voxel' be half of the "
                     "thinnest that shall stay",
                     ask->plant, ask->params->voxel);
    } else {
        fr_diags_add(ask->context->diags, FR_ERROR, "nothing-closed", ask->span,
                     "'%s': there is nothing closed to make a solid of", ask->plant);
    }
    return FR_ERR_DOCUMENT;
}

/// Corners of the closed surfaces in cells; answers how many triangles.
static size_t take_corners(const FrMesh *mesh, FrSolid *solid, double (**corners)[3],
                           const FrSolidAsk *ask) {
    size_t triangles = (size_t)(mesh->index_count / 3), taken = 0;
    bool *is_closed = g_new0(bool, triangles + 1);
    uint64_t open = fr_mesh_open_edges(mesh, is_closed);
    *corners = g_malloc_n(3 * triangles + 1, sizeof **corners);
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        for (uint64_t i = part->first_index; i < part->first_index + part->index_count; i++) {
            const float *at = mesh->vertices[part->first_vertex + mesh->indices[i]].position;
            for (int k = 0; k < 3 && is_closed[i / 3]; k++) {
                (*corners)[taken][k] = ((double)at[k] - solid->origin[k]) / solid->width;
            }
            taken += is_closed[i / 3];
        }
    }
    g_free(is_closed);
    if (open > 0) {
        warn_of_open(ask);
    }
    return taken / 3;
}

/// Where the lattice begins; false if it were wider than its numbers reach.
static bool place(const FrMesh *mesh, FrSolid *solid) {
    double widest = 0.0;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (uint32_t p = 0; p < mesh->part_count; p++) {
            low = fmin(low, (double)mesh->parts[p].min[k]);
            high = fmax(high, (double)mesh->parts[p].max[k]);
        }
        solid->origin[k] = low - (2.0 + aside[k]) * solid->width;
        widest = fmax(widest, high - low);
    }
    return widest / solid->width < (1 << 19);
}

/// Of each square of the lattice that a surface covers, roughly.
enum { TRIANGLES_A_CELL = 12, BYTES_A_CELL = 1200 };

/// The area of all surfaces, in squares of the lattice.
static double area_of(const double (*corners)[3], size_t triangles) {
    double area = 0.0;
    for (size_t i = 0; i < triangles; i++) {
        const double *a = corners[3 * i], *b = corners[3 * i + 1], *c = corners[3 * i + 2];
        double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        double v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2];
        double z = u[0] * v[1] - u[1] * v[0];
        area += 0.5 * sqrt(x * x + y * y + z * z);
    }
    return area;
}

static void set_normals(FrVertex *vertices, const uint32_t *indices, size_t count) {
    for (size_t i = 0; i + 2 < count; i += 3) {
        const float *a = vertices[indices[i]].position, *b = vertices[indices[i + 1]].position;
        const float *c = vertices[indices[i + 2]].position;
        float u[3], v[3];
        for (int k = 0; k < 3; k++) {
            u[k] = b[k] - a[k];
            v[k] = c[k] - a[k];
        }
        for (int k = 0; k < 3; k++) {
            int m = (k + 1) % 3, n = (k + 2) % 3;
            for (int corner = 0; corner < 3; corner++) {
                vertices[indices[i + (size_t)corner]].normal[k] += u[m] * v[n] - u[n] * v[m];
            }
        }
    }
}

static FrMesh *to_mesh(const FrSolid *solid, uint32_t material) {
    size_t vertices = solid->vertices->len, indices = solid->indices->len;
    FrMesh *mesh = fr_mesh_new(vertices, indices, indices > 0 ? 1 : 0);
    if (mesh == NULL || indices == 0) {
        return mesh;
    }
    memcpy(mesh->vertices, solid->vertices->data, vertices * sizeof *mesh->vertices);
    memcpy(mesh->indices, solid->indices->data, indices * sizeof *mesh->indices);
    set_normals(mesh->vertices, mesh->indices, indices);
    float min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < vertices; i++) {
        float *n = mesh->vertices[i].normal, *at = mesh->vertices[i].position;
        float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++) {
            n[k] = length > 0.0F ? n[k] / length : k == 2 ? 1.0F : 0.0F;
            min[k] = fminf(min[k], at[k]);
            max[k] = fmaxf(max[k], at[k]);
        }
    }
    mesh->parts[0] =
        (FrMeshPart){.material = material, .vertex_count = vertices, .index_count = indices};
    fr_part_set_box(&mesh->parts[0], min, max);
    return mesh;
}

static FrStatus make(FrMesh **mesh, FrSolid *solid, const double (*corners)[3], size_t triangles,
                     const FrContext *context) {
    solid->vertices = g_array_new(FALSE, FALSE, sizeof(FrVertex));
    solid->indices = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    solid->by_edge = g_hash_table_new_full(fr_key_hash, g_int64_equal, g_free, NULL);
    for (int way = 0; way < FR_SOLID_WAYS; way++) {
        solid->lines[way] = fr_solid_lines(way, corners, triangles);
    }
    cut_rows(solid, context);
    FrStatus status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
    if (status == FR_OK) {
        uint32_t material = (*mesh)->part_count > 0 ? (*mesh)->parts[0].material : FR_NONE;
        FrMesh *made = to_mesh(solid, material);
        status = made != NULL ? FR_OK : FR_ERR_MACHINE;
        fr_mesh_free(made != NULL ? *mesh : NULL);
        *mesh = made != NULL ? made : *mesh;
    }
    for (int way = 0; way < FR_SOLID_WAYS; way++) {
        g_free(solid->lines[way].crossings);
    }
    g_array_unref(solid->vertices);
    g_array_unref(solid->indices);
    g_hash_table_unref(solid->by_edge);
    return status;
}

FrStatus fr_solid_of(FrMesh **mesh, const FrSolidAsk *ask) {
    const FrContext *context = ask->context;
    FrSolid solid = {.width = ask->params->voxel};
    bool is_empty = (*mesh)->index_count == 0;
    double(*corners)[3] = NULL;
    bool is_in_reach = place(*mesh, &solid);
    size_t triangles = is_in_reach ? take_corners(*mesh, &solid, &corners, ask) : 0;
    double cells = is_in_reach ? area_of((const double(*)[3])corners, triangles) : 1e15;
    const char *who = "the solid of these voxels";
    FrStatus status =
        fr_limit_check((uint64_t)fmin(TRIANGLES_A_CELL * cells, 1e18), context->limits.triangles,
                       "triangles", who, ask->span, context->diags);
    if (status == FR_OK) {
        status = fr_limit_check((uint64_t)fmin(BYTES_A_CELL * cells, 1e18), context->limits.bytes,
                                "bytes", who, ask->span, context->diags);
    }
    if (status == FR_OK) {
        warn_of_thin(ask);
        status = make(mesh, &solid, (const double(*)[3])corners, triangles, context);
    }
    if (status == FR_OK && !is_empty && (*mesh)->index_count == 0) {
        status = refuse_nothing(ask, triangles > 0);
    }
    g_free(corners);
    return status;
}
