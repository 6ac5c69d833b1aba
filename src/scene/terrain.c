/// Terrain: a height map becomes triangles; a grid over all triangles finds the highest at a place.
#include "frond/terrain.h"

#include <math.h>
#include <string.h>

enum {
    MOST_CELLS = 1024, // along a side
    MOST_ENTRIES = 16, // of a triangle in cells, on average
};

struct FrHills {
    double at[3], scale[3], turn; ///< of the mesh
    FrMeshFile *mesh;
    uint32_t side;      ///< cells along a side
    uint32_t *first;    ///< by cell, of `triangles`; one more than there are cells
    uint32_t *triangle; ///< numbers of triangles, by cell
};

// ---- height maps ------------------------------------------------------------------------------

/// Between the four pixels around a place, 0 to 1 along each side.
static float height_at(const FrHeightMap *map, double u, double v) {
    double x = u * (map->width - 1), y = v * (map->height - 1), sum = 0;
    uint32_t column = (uint32_t)fmin(x, fmax(map->width - 2.0, 0));
    uint32_t row = (uint32_t)fmin(y, fmax(map->height - 2.0, 0));
    for (int corner = 0; corner < 4; corner++) {
        uint32_t i = MIN(column + (corner & 1), map->width - 1);
        uint32_t k = MIN(row + (uint32_t)(corner >> 1), map->height - 1);
        double weight = ((corner & 1) != 0 ? x - column : 1 - (x - column)) *
                        (corner >> 1 != 0 ? y - row : 1 - (y - row));
        sum += weight * (double)map->heights[(size_t)k * map->width + i];
    }
    return (float)sum;
}

/// Smooth normals of a terrain of this size would lean wrongly if they were those of its mesh of
/// size 1, so the mesh has its size.
static FrMeshFile *mesh_of_map(const FrTerrain *terrain, const uint32_t points[2]) {
    size_t count = (size_t)points[0] * points[1];
    vec3s *positions = g_new(vec3s, count);
    float(*uvs)[2] = g_malloc_n(count, sizeof *uvs);
    uint32_t *indices = g_new(uint32_t, 6 * count), index_count = 0;
    for (uint32_t row = 0; row < points[1]; row++) {
        for (uint32_t column = 0; column < points[0]; column++) {
            uint32_t v = row * points[0] + column;
            double u = (double)column / (points[0] - 1), w = (double)row / (points[1] - 1);
            positions[v] =
                (vec3s){{terrain->size.x * (float)(u - 0.5), terrain->size.y * (float)(0.5 - w),
                         terrain->size.z * height_at(terrain->heights, u, w)}};
            uvs[v][0] = (float)u;
            uvs[v][1] = (float)w;
            if (row > 0 && column > 0) {
                const uint32_t corners[6] = {v, v - points[0],     v - points[0] - 1,
                                             v, v - points[0] - 1, v - 1};
                memcpy(&indices[index_count], corners, sizeof corners);
                index_count += 6;
            }
        }
    }
    return fr_mesh_file_new(positions, NULL, uvs, (uint32_t)count, indices, index_count, NULL);
}

static FrStatus make_mesh(FrHills *hills, const FrTerrain *terrain, const FrContext *context) {
    if (terrain->mesh != NULL) {
        hills->mesh = fr_mesh_file_ref(terrain->mesh);
        return FR_OK;
    }
    const FrHeightMap *map = terrain->heights;
    double longer = MAX(map->width, map->height);
    double scale = fmin(1, (double)terrain->points / longer);
    uint32_t points[2] = {MAX((uint32_t)(map->width * scale), 2),
                          MAX((uint32_t)(map->height * scale), 2)};
    FrStatus status = fr_limit_check(2 * (uint64_t)points[0] * points[1], context->limits.triangles,
                                     "triangles", "the terrain", terrain->span, context->diags);
    if (status == FR_OK) {
        hills->mesh = mesh_of_map(terrain, points);
    }
    return status;
}

// ---- finding ----------------------------------------------------------------------------------

static uint32_t cell_along(const FrHills *hills, int axis, double at) {
    double min = (double)hills->mesh->min.raw[axis], max = (double)hills->mesh->max.raw[axis];
    double cell = max > min ? floor((at - min) / (max - min) * hills->side) : 0;
    return cell <= 0 ? 0 : cell >= hills->side - 1 ? hills->side - 1 : (uint32_t)cell;
}

/// The cells that a triangle's box covers: first and last along x, then along y.
static void cells_of(const FrHills *hills, uint32_t triangle, uint32_t cells[4]) {
    const uint32_t *corner = &hills->mesh->indices[3 * triangle];
    for (int axis = 0; axis < 2; axis++) {
        double min = INFINITY, max = -INFINITY;
        for (int k = 0; k < 3; k++) {
            double at = (double)hills->mesh->positions[corner[k]].raw[axis];
            min = fmin(min, at);
            max = fmax(max, at);
        }
        cells[2 * axis] = cell_along(hills, axis, min);
        cells[2 * axis + 1] = cell_along(hills, axis, max);
    }
}

/// Counts triangles by cell, or writes them where the counts say.
static void sort_triangles(FrHills *hills, bool is_counting) {
    for (uint32_t t = 0; t < hills->mesh->index_count / 3; t++) {
        uint32_t cells[4];
        cells_of(hills, t, cells);
        for (uint32_t y = cells[2]; y <= cells[3]; y++) {
            for (uint32_t x = cells[0]; x <= cells[1]; x++) {
                uint32_t *next = &hills->first[(size_t)y * hills->side + x];
                if (!is_counting) {
                    hills->triangle[*next] = t;
                }
                (*next)++;
            }
        }
    }
}

/// How often triangles would stand in cells.
static uint64_t count_entries(const FrHills *hills) {
    uint64_t sum = 0;
    for (uint32_t t = 0; t < hills->mesh->index_count / 3; t++) {
        uint32_t cells[4];
        cells_of(hills, t, cells);
        sum += (uint64_t)(cells[1] - cells[0] + 1) * (cells[3] - cells[2] + 1);
    }
    return sum;
}

static void make_grid(FrHills *hills) {
    uint64_t triangles = hills->mesh->index_count / 3;
    hills->side = (uint32_t)CLAMP(sqrt(0.5 * (double)triangles), 1, MOST_CELLS);
    // Large triangles one above the other must not fill all cells.
    while (hills->side > 1 && count_entries(hills) > MOST_ENTRIES * triangles) {
        hills->side = (hills->side + 1) / 2;
    }
    size_t cells = (size_t)hills->side * hills->side;
    hills->first = g_new0(uint32_t, cells + 1);
    sort_triangles(hills, true);
    uint32_t sum = 0;
    for (size_t i = 0; i <= cells; i++) {
        uint32_t count = hills->first[i];
        hills->first[i] = sum;
        sum += count;
    }
    hills->triangle = g_new(uint32_t, MAX(sum, 1));
    sort_triangles(hills, false);
    // Each has been moved to its end, which is the next one's beginning.
    memmove(hills->first + 1, hills->first, cells * sizeof *hills->first);
    hills->first[0] = 0;
}

FrStatus fr_hills_new(const FrTerrain *terrain, const FrContext *context, FrHills **hills) {
    *hills = NULL;
    if (terrain == NULL || (terrain->mesh == NULL && terrain->heights == NULL)) {
        return FR_OK;
    }
    FrHills *made = g_new0(FrHills, 1);
    for (int k = 0; k < 3; k++) {
        made->at[k] = (double)terrain->at.raw[k];
        made->scale[k] = terrain->mesh != NULL ? (double)terrain->size.raw[k] : 1;
    }
    made->turn = terrain->turn;
    FrStatus status = make_mesh(made, terrain, context);
    if (status != FR_OK) {
        fr_hills_free(made);
        return status;
    }
    make_grid(made);
    *hills = made;
    return FR_OK;
}

void fr_hills_free(FrHills *hills) {
    if (hills != NULL) {
        fr_mesh_file_unref(hills->mesh);
        g_free(hills->first);
        g_free(hills->triangle);
        g_free(hills);
    }
}

FrMeshFile *fr_hills_mesh(const FrHills *hills) {
    return hills->mesh;
}

/// The height of a triangle over a place; false if it is not over it.
static bool triangle_height(const FrMeshFile *mesh, uint32_t triangle, const double at[2],
                            double *height) {
    double p[3][3];
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < 3; r++) {
            p[k][r] = (double)mesh->positions[mesh->indices[3 * triangle + (uint32_t)k]].raw[r];
        }
    }
    double area =
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
    double b =
        ((at[0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (at[1] - p[0][1])) / area;
    double c =
        ((p[1][0] - p[0][0]) * (at[1] - p[0][1]) - (at[0] - p[0][0]) * (p[1][1] - p[0][1])) / area;
    // A little beyond its edges, so that nothing falls between two.
    const double slack = 1e-7;
    if (area == 0 || !(b >= -slack && c >= -slack && b + c <= 1 + slack)) {
        return false;
    }
    *height = p[0][2] + b * (p[1][2] - p[0][2]) + c * (p[2][2] - p[0][2]);
    return true;
}

bool fr_hills_height(const FrHills *hills, double x, double y, double *height) {
    double sine = sin(hills->turn), cosine = cos(hills->turn);
    double dx = x - hills->at[0], dy = y - hills->at[1];
    const double at[2] = {(cosine * dx + sine * dy) / hills->scale[0],
                          (cosine * dy - sine * dx) / hills->scale[1]};
    const vec3s min = hills->mesh->min, max = hills->mesh->max;
    if (at[0] < (double)min.x || at[0] > (double)max.x || at[1] < (double)min.y ||
        at[1] > (double)max.y) {
        return false;
    }
    size_t cell = (size_t)cell_along(hills, 1, at[1]) * hills->side + cell_along(hills, 0, at[0]);
    double highest = -INFINITY;
    for (uint32_t i = hills->first[cell]; i < hills->first[cell + 1]; i++) {
        double found;
        if (triangle_height(hills->mesh, hills->triangle[i], at, &found)) {
            highest = fmax(highest, found);
        }
    }
    *height = hills->at[2] + highest * hills->scale[2];
    return isfinite(highest);
}
