// One rational surface as a grid of triangles. A side that is shrunk to a point has triangles, not
// quads, beside it; the two sides of a seam are at the same places.
#include "skin/nurbs_mesh.h"

#include "skin/bark.h"

#include <string.h>

static void grow(FrNurbsGrid *grid, const FrNurbsTile *tile) {
    size_t points = (size_t)tile->points_u * tile->points_v;
    uint32_t parameters = MAX(tile->points_u, tile->points_v);
    if (parameters > grid->parameters) {
        grid->parameters = 2 * parameters;
        grid->u = g_renew(double, grid->u, grid->parameters);
        grid->v = g_renew(double, grid->v, grid->parameters);
    }
    if (points > grid->room) {
        grid->room = 2 * points;
        grid->points = g_realloc_n(grid->points, grid->room, sizeof *grid->points);
        grid->normals = g_realloc_n(grid->normals, grid->room, sizeof *grid->normals);
        grid->blended = g_realloc_n(grid->blended, grid->room, sizeof *grid->blended);
    }
}

/// Copies a point over others of its row or column, which are the same but for rounding.
static void unite(FrNurbsGrid *grid, size_t first, size_t stride, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        memcpy(grid->points[first + i * stride], grid->points[first], sizeof *grid->points);
    }
}

static void unite_seams(const FrNurbsTile *tile, FrNurbsGrid *grid) {
    const FrNurbsSurface *s = &tile->piece->surface;
    uint32_t nu = tile->points_u, nv = tile->points_v;
    bool closed_u = true, closed_v = true;
    for (uint32_t j = 0; j < s->count_v; j++) {
        const double(*row)[4] = s->points + (size_t)j * s->count_u;
        closed_u = closed_u && memcmp(row[0], row[s->count_u - 1], sizeof *row) == 0;
    }
    const double(*last)[4] = s->points + (size_t)(s->count_v - 1) * s->count_u;
    for (uint32_t i = 0; i < s->count_u; i++) {
        closed_v = closed_v && memcmp(s->points[i], last[i], sizeof *last) == 0;
    }
    for (uint32_t j = 0; j < nv && closed_u; j++) {
        size_t row = (size_t)j * nu;
        memcpy(grid->points[row + nu - 1], grid->points[row], sizeof *grid->points);
    }
    for (uint32_t i = 0; i < nu && closed_v; i++) {
        memcpy(grid->points[(size_t)(nv - 1) * nu + i], grid->points[i], sizeof *grid->points);
    }
    const struct {
        uint8_t side;
        size_t first, stride;
        uint32_t count;
    } sides[] = {{FR_SHRUNK_V0, 0, 1, nu},
                 {FR_SHRUNK_V1, (size_t)(nv - 1) * nu, 1, nu},
                 {FR_SHRUNK_U0, 0, nu, nv},
                 {FR_SHRUNK_U1, nu - 1, nu, nv}};
    for (size_t k = 0; k < G_N_ELEMENTS(sides); k++) {
        if ((tile->shrunk & sides[k].side) != 0) {
            unite(grid, sides[k].first, sides[k].stride, sides[k].count);
        }
    }
}

/// The middle of a row of a tube and how far its points are from there.
static double row_middle(const FrNurbsGrid *grid, const FrNurbsTile *tile, uint32_t j,
                         double middle[3]) {
    uint32_t count = MAX(tile->points_u - 1, 1);
    const double(*row)[3] = (const double(*)[3])grid->points + (size_t)j * tile->points_u;
    memset(middle, 0, 3 * sizeof *middle);
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            middle[k] += row[i][k] / count;
        }
    }
    double radius = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double way[3] = {row[i][0] - middle[0], row[i][1] - middle[1], row[i][2] - middle[2]};
        radius += sqrt(fr_dot3(way, way)) / count;
    }
    return radius;
}

/// Coordinates of bark, as on the other kind of tubes.
static void lay_bark(const FrNurbsMeshing *meshing, const FrNurbsTile *tile, FrNurbsGrid *grid) {
    double middle[3], before[3], radius = row_middle(grid, tile, 0, before), u_range[2];
    const FrNurbsSurface *s = &tile->piece->surface;
    fr_nurbs_range(s->knots_u, s->degree_u, s->count_u, u_range);
    FrPlan plan = {.plant = meshing->plant, .tiles = meshing->bark_tiles};
    FrBark bark = fr_bark_for(&plan, tile->piece->axis, tile->slot, (float)radius);
    double v = (double)bark.v;
    for (uint32_t j = 0; j < tile->points_v; j++) {
        double next = row_middle(grid, tile, j, middle);
        double way[3] = {middle[0] - before[0], middle[1] - before[1], middle[2] - before[2]};
        v -= (double)fr_bark_along(&bark, (float)sqrt(fr_dot3(way, way)), (float)radius,
                                   (float)next);
        for (uint32_t i = 0; i < tile->points_u; i++) {
            double *blended = grid->blended[(size_t)j * tile->points_u + i];
            double part = (grid->u[i] - u_range[0]) / (u_range[1] - u_range[0]);
            blended[0] = (double)bark.u + part * (double)bark.around;
            blended[1] = v;
        }
        radius = next;
        memcpy(before, middle, sizeof before);
    }
}

void fr_nurbs_fill(const FrNurbsMeshing *meshing, const FrNurbsTile *tile, FrNurbsGrid *grid) {
    const FrNurbsPiece *piece = tile->piece;
    const FrNurbsSurface *s = &piece->surface;
    grow(grid, tile);
    const uint8_t *steps = meshing->steps + tile->steps;
    uint32_t pieces = fr_nurbs_pieces(s->knots_u, s->degree_u, s->count_u);
    fr_nurbs_parameters(s->knots_u, s->degree_u, s->count_u, steps, grid->u);
    fr_nurbs_parameters(s->knots_v, s->degree_v, s->count_v, steps + pieces, grid->v);
    fr_nurbs_grid(s, grid->u, tile->points_u, grid->v, tile->points_v, grid->points, grid->normals,
                  piece->texture, grid->blended);
    unite_seams(tile, grid);
    if (piece->axis != FR_NONE && piece->kind == FR_NURBS_TUBE) {
        lay_bark(meshing, tile, grid);
    } else if (piece->texture == NULL) {
        for (uint32_t n = 0; n < tile->points_u * tile->points_v; n++) {
            grid->blended[n][0] = grid->u[n % tile->points_u];
            grid->blended[n][1] = grid->v[n / tile->points_u];
        }
    }
}

/// Where a point of the grid is, with all of a shrunk side at one place.
static void place_of(const FrNurbsTile *tile, uint32_t i, uint32_t j, uint32_t place[2]) {
    uint32_t last_u = tile->points_u - 1, last_v = tile->points_v - 1;
    for (int pass = 0; pass < 2; pass++) {
        bool is_column = ((tile->shrunk & FR_SHRUNK_U0) != 0 && i == 0) ||
                         ((tile->shrunk & FR_SHRUNK_U1) != 0 && i == last_u);
        j = is_column ? 0 : j;
        bool is_row = ((tile->shrunk & FR_SHRUNK_V0) != 0 && j == 0) ||
                      ((tile->shrunk & FR_SHRUNK_V1) != 0 && j == last_v);
        i = is_row ? 0 : i;
    }
    place[0] = i;
    place[1] = j;
}

bool fr_nurbs_corners(const FrNurbsTile *tile, uint32_t i, uint32_t j, bool is_upper,
                      uint32_t corners[3][2]) {
    const uint32_t cells[2][3][2] = {{{i, j}, {i + 1, j}, {i + 1, j + 1}},
                                     {{i, j}, {i + 1, j + 1}, {i, j + 1}}};
    uint32_t places[3][2];
    for (int k = 0; k < 3; k++) {
        memcpy(corners[k], cells[is_upper][k], sizeof corners[k]);
        place_of(tile, corners[k][0], corners[k][1], places[k]);
    }
    return memcmp(places[0], places[1], sizeof places[0]) != 0 &&
           memcmp(places[1], places[2], sizeof places[0]) != 0 &&
           memcmp(places[2], places[0], sizeof places[0]) != 0;
}

void fr_nurbs_put_vertex(FrNurbsMeshing *meshing, FrNurbsTile *tile, FrVertex *vertex,
                         const double at[3], const double normal[3], float u, float v) {
    vec3s place = {{(float)at[0], (float)at[1], (float)at[2]}};
    vec3s across = {{(float)normal[0], (float)normal[1], (float)normal[2]}};
    place = fr_upright(place, meshing->up);
    across = fr_upright(across, meshing->up);
    memcpy(vertex->position, place.raw, sizeof place.raw);
    memcpy(vertex->normal, across.raw, sizeof across.raw);
    vertex->uv[0] = u;
    vertex->uv[1] = v;
    fr_box_widen(&tile->box, vertex, 1);
}

void fr_nurbs_write_tile(FrNurbsMeshing *meshing, FrNurbsTile *tile, FrNurbsGrid *grid) {
    fr_nurbs_fill(meshing, tile, grid);
    const FrMeshPart *part = &meshing->mesh->parts[meshing->part_of[tile->slot]];
    FrVertex *vertex = meshing->mesh->vertices + part->first_vertex + tile->first_vertex;
    uint32_t *index = meshing->mesh->indices + part->first_index + tile->first_index;
    for (uint32_t n = 0; n < tile->vertices; n++) {
        fr_nurbs_put_vertex(meshing, tile, vertex + n, grid->points[n], grid->normals[n],
                            (float)grid->blended[n][0], (float)grid->blended[n][1]);
    }
    uint64_t written = 0;
    for (uint32_t j = 0; j + 1 < tile->points_v; j++) {
        for (uint32_t i = 0; i + 1 < tile->points_u; i++) {
            for (int half = 0; half < 2; half++) {
                uint32_t corners[3][2];
                bool is_plain = fr_nurbs_corners(tile, i, j, half == 1, corners);
                for (int k = 0; k < 3 && is_plain; k++) {
                    index[written++] = (uint32_t)tile->first_vertex + corners[k][0] +
                                       corners[k][1] * tile->points_u;
                }
            }
        }
    }
    FR_ASSERT(written == 3 * (uint64_t)tile->triangles);
}
