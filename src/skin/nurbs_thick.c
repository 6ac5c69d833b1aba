// A blade as a solid: both its faces, half the thickness away from its surface, and its rim.
#include "skin/nurbs_mesh.h"

#include <string.h>

/// Both halves side by side: columns from the right margin to the midrib to the left margin.
typedef struct FrThick {
    FrNurbsTile *halves;
    uint32_t rows, columns; ///< along and across
    double (*points)[3];    ///< row by row
    double (*normals)[3];   ///< unit
    double (*blended)[2];
} FrThick;

static uint32_t columns_of(const FrNurbsTile halves[2]) {
    return halves[0].points_v + halves[1].points_v - 1;
}

/// Edges of a half on the rim: its margin, and where the blade begins and ends if it is wide there.
static uint32_t rim_edges(const FrNurbsTile *half) {
    bool has_base = (half->shrunk & FR_SHRUNK_U0) == 0,
         has_tip = (half->shrunk & FR_SHRUNK_U1) == 0;
    return half->points_u - 1 + ((has_base ? 1U : 0U) + (has_tip ? 1U : 0U)) * (half->points_v - 1);
}

void fr_nurbs_count_thick(FrNurbsTile halves[2]) {
    uint32_t faces = halves[0].triangles + halves[1].triangles;
    halves[0].is_thick = true;
    halves[0].vertices = 2 * halves[0].points_u * columns_of(halves);
    halves[0].triangles = 2 * faces + 2 * (rim_edges(&halves[0]) + rim_edges(&halves[1]));
    halves[1].vertices = halves[1].triangles = 0;
}

static void take_half(FrThick *thick, const FrNurbsTile *half, uint32_t first,
                      const FrNurbsGrid *grid) {
    for (uint32_t j = 0; j < half->points_v; j++) {
        for (uint32_t i = 0; i < half->points_u; i++) {
            size_t to = (size_t)i * thick->columns + first + j,
                   from = (size_t)j * half->points_u + i;
            memcpy(thick->points[to], grid->points[from], sizeof *thick->points);
            memcpy(thick->blended[to], grid->blended[from], sizeof *thick->blended);
            bool is_shared = first > 0 && j == 0;
            for (int k = 0; k < 3; k++) {
                double other = is_shared ? thick->normals[to][k] : 0.0;
                thick->normals[to][k] = other + grid->normals[from][k];
            }
        }
    }
}

// One normal where a row is but a point, and unit length everywhere.
static void settle_normals(FrThick *thick) {
    for (uint32_t i = 0; i < thick->rows; i++) {
        double(*row)[3] = thick->normals + (size_t)i * thick->columns;
        const double(*at)[3] = (const double(*)[3])thick->points + (size_t)i * thick->columns;
        for (uint32_t j = 0; j < thick->columns;) {
            uint32_t end = j + 1;
            double sum[3];
            memcpy(sum, row[j], sizeof sum);
            for (; end < thick->columns && memcmp(at[end], at[j], sizeof *at) == 0; end++) {
                for (int k = 0; k < 3; k++) {
                    sum[k] += row[end][k];
                }
            }
            if (!(fr_unit3(sum) > 1e-6)) {
                memcpy(sum, (double[3]){0.0, 0.0, 1.0}, sizeof sum);
            }
            for (; j < end; j++) {
                memcpy(row[j], sum, sizeof sum);
            }
        }
    }
}

static void put_vertices(FrNurbsMeshing *meshing, const FrThick *thick, FrVertex *vertex) {
    size_t count = (size_t)thick->rows * thick->columns;
    double away = 0.5 * meshing->params->thickness;
    for (size_t n = 0; n < 2 * count; n++) {
        size_t from = n % count;
        double side = n < count ? 1.0 : -1.0, at[3], normal[3];
        for (int k = 0; k < 3; k++) {
            normal[k] = side * thick->normals[from][k];
            at[k] = thick->points[from][k] + away * normal[k];
        }
        fr_nurbs_put_vertex(meshing, &thick->halves[0], vertex + n, at, normal,
                            (float)thick->blended[from][0], (float)thick->blended[from][1]);
    }
}

/// Triangles on their way.
typedef struct FrThickWriter {
    uint32_t *index;
    uint64_t written;
    uint32_t first, below; ///< first vertex; from the upper face to the lower
} FrThickWriter;

static void put_triangle(FrThickWriter *writer, uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t corners[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        writer->index[writer->written++] = writer->first + corners[k];
    }
}

/// An edge of the rim, passed with the upper face on its left.
static void put_rim(FrThickWriter *writer, uint32_t a, uint32_t b) {
    put_triangle(writer, b, a, a + writer->below);
    put_triangle(writer, b, a + writer->below, b + writer->below);
}

static void put_half(FrThickWriter *writer, const FrThick *thick, const FrNurbsTile *half,
                     uint32_t first) {
    for (uint32_t n = 0; n < 2 * (half->points_u - 1) * (half->points_v - 1); n++) {
        uint32_t i = n / 2 % (half->points_u - 1), j = n / 2 / (half->points_u - 1);
        uint32_t corners[3][2], at[3];
        if (!fr_nurbs_corners(half, i, j, n % 2 == 1, corners)) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            at[k] = corners[k][0] * thick->columns + first + corners[k][1];
        }
        put_triangle(writer, at[0], at[1], at[2]);
        put_triangle(writer, at[0] + writer->below, at[2] + writer->below, at[1] + writer->below);
    }
    // The base is passed towards rising u of the next half, as the upper face lies to the left.
    uint32_t last_row = (half->points_u - 1) * thick->columns;
    for (uint32_t j = first; j + 1 < first + half->points_v; j++) {
        if ((half->shrunk & FR_SHRUNK_U0) == 0) {
            put_rim(writer, j + 1, j);
        }
        if ((half->shrunk & FR_SHRUNK_U1) == 0) {
            put_rim(writer, last_row + j, last_row + j + 1);
        }
    }
    for (uint32_t i = 0; i + 1 < half->points_u; i++) {
        uint32_t margin = first == 0 ? 0 : thick->columns - 1;
        uint32_t a = i * thick->columns + margin, b = a + thick->columns;
        put_rim(writer, first == 0 ? a : b, first == 0 ? b : a);
    }
}

void fr_nurbs_write_thick(FrNurbsMeshing *meshing, FrNurbsTile halves[2], FrNurbsGrid *grid) {
    FrThick thick = {.halves = halves, .rows = halves[0].points_u, .columns = columns_of(halves)};
    size_t count = (size_t)thick.rows * thick.columns;
    double *memory = g_new(double, 8 * count);
    thick.points = (double(*)[3])(void *)memory;
    thick.normals = (double(*)[3])(void *)(memory + 3 * count);
    thick.blended = (double(*)[2])(void *)(memory + 6 * count);
    fr_nurbs_fill(meshing, &halves[0], grid);
    take_half(&thick, &halves[0], 0, grid);
    fr_nurbs_fill(meshing, &halves[1], grid);
    take_half(&thick, &halves[1], halves[0].points_v - 1, grid);
    settle_normals(&thick);
    const FrMeshPart *part = &meshing->mesh->parts[meshing->part_of[halves[0].slot]];
    put_vertices(meshing, &thick,
                 meshing->mesh->vertices + part->first_vertex + halves[0].first_vertex);
    FrThickWriter writer = {.index =
                                meshing->mesh->indices + part->first_index + halves[0].first_index,
                            .first = (uint32_t)halves[0].first_vertex,
                            .below = (uint32_t)count};
    put_half(&writer, &thick, &halves[0], 0);
    put_half(&writer, &thick, &halves[1], halves[0].points_v - 1);
    FR_ASSERT(writer.written == 3 * (uint64_t)halves[0].triangles);
    g_free(memory);
}
