// Files of rational surfaces: read by format, kept as they are, and cut into triangles for all that
// knows triangles only.
#include "material/nurbs_file.h"

#include <math.h>
#include <string.h>

/// Triangles are no farther from a surface than this part of the file's size.
#define TOLERANCE (1.0 / 1500)
#define TURN 0.45

static bool is_iges(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot != NULL &&
           (g_ascii_strcasecmp(dot, ".igs") == 0 || g_ascii_strcasecmp(dot, ".iges") == 0);
}

static bool is_obj(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot != NULL && g_ascii_strcasecmp(dot, ".obj") == 0;
}

bool fr_nurbs_file_is(const char *path) {
    if (!is_obj(path)) {
        return is_iges(path);
    }
    char *text = NULL;
    bool has_surfaces = g_file_get_contents(path, &text, NULL, NULL) && fr_obj_has_surfaces(text);
    g_free(text);
    return has_surfaces;
}

FrNurbsSurface fr_surface_new(uint32_t degree_u, uint32_t count_u, uint32_t degree_v,
                              uint32_t count_v, double **knots_u, double **knots_v,
                              double (**points)[4]) {
    *knots_u = g_new(double, (size_t)count_u + degree_u + 1);
    *knots_v = g_new(double, (size_t)count_v + degree_v + 1);
    *points = g_malloc_n((size_t)count_u * count_v, sizeof **points);
    return (FrNurbsSurface){
        degree_u, degree_v, count_u, count_v, *knots_u, *knots_v, (const double(*)[4]) * points};
}

static void surface_clear(void *data) {
    FrNurbsSurface *surface = data;
    g_free((void *)surface->knots_u);
    g_free((void *)surface->knots_v);
    g_free((void *)surface->points);
}

void fr_surface_fail(FrSurfaceReader *reader, size_t line, const char *what) {
    fr_diags_add(reader->context->diags, FR_ERROR, "bad-surfaces", reader->span,
                 "'%.80s', line %zu: %s", reader->name, line, what);
    reader->status = FR_ERR_DOCUMENT;
}

void fr_surface_take(FrSurfaceReader *reader, FrNurbsSurface surface, size_t line) {
    if (reader->status == FR_OK && fr_nurbs_surface_is_valid(&surface)) {
        g_array_append_val(reader->surfaces, surface);
        return;
    }
    surface_clear(&surface);
    if (reader->status == FR_OK) {
        fr_surface_fail(reader, line,
                        "the knots fall, or points or weights are no numbers above 0");
    }
}

// ---- triangles ---------------------------------------------------------------------------------

/// The grid of one surface.
typedef struct FrFileGrid {
    uint8_t *steps; ///< along u, then along v
    uint32_t points_u, points_v;
} FrFileGrid;

static double size_of(const GArray *surfaces) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < surfaces->len; i++) {
        const FrNurbsSurface *s = &g_array_index(surfaces, FrNurbsSurface, i);
        for (size_t n = 0; n < (size_t)s->count_u * s->count_v; n++) {
            for (int k = 0; k < 3; k++) {
                low[k] = fmin(low[k], s->points[n][k]);
                high[k] = fmax(high[k], s->points[n][k]);
            }
        }
    }
    double size = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    return size > 0.0 ? size : 1.0;
}

static bool has_same_rim(const FrNurbsSurface *a, const FrNurbsSurface *b) {
    size_t knots = (size_t)a->count_u + a->degree_u + 1;
    return a->degree_u == b->degree_u && a->count_u == b->count_u &&
           memcmp(a->knots_u, b->knots_u, knots * sizeof(double)) == 0;
}

/// Neighbours in the file with the same knots along u, such as a tube and its caps, share steps.
static void share_rims(const GArray *surfaces, FrFileGrid *grids, uint32_t first, uint32_t next) {
    const FrNurbsSurface *s = &g_array_index(surfaces, FrNurbsSurface, first);
    uint32_t pieces = fr_nurbs_pieces(s->knots_u, s->degree_u, s->count_u);
    for (uint32_t k = 0; k < pieces; k++) {
        uint8_t most = 0;
        for (uint32_t i = first; i < next; i++) {
            most = MAX(most, grids[i].steps[k]);
        }
        for (uint32_t i = first; i < next; i++) {
            grids[i].steps[k] = most;
        }
    }
}

static uint64_t count_grid(const FrNurbsSurface *s, FrFileGrid *grid) {
    uint32_t pieces_u = fr_nurbs_pieces(s->knots_u, s->degree_u, s->count_u);
    uint32_t pieces_v = fr_nurbs_pieces(s->knots_v, s->degree_v, s->count_v);
    grid->points_u = grid->points_v = 1;
    for (uint32_t k = 0; k < pieces_u + pieces_v; k++) {
        *(k < pieces_u ? &grid->points_u : &grid->points_v) += grid->steps[k];
    }
    return 2 * (uint64_t)(grid->points_u - 1) * (grid->points_v - 1);
}

static FrFileGrid *choose_grids(const GArray *surfaces, uint64_t *triangles) {
    FrFileGrid *grids = g_new0(FrFileGrid, surfaces->len);
    const FrNurbsFineness fineness = {TOLERANCE * size_of(surfaces), TURN};
    for (uint32_t i = 0; i < surfaces->len; i++) {
        const FrNurbsSurface *s = &g_array_index(surfaces, FrNurbsSurface, i);
        uint32_t pieces = fr_nurbs_pieces(s->knots_u, s->degree_u, s->count_u);
        grids[i].steps = g_malloc((size_t)s->count_u + s->count_v);
        fr_nurbs_steps(s, &fineness, grids[i].steps, grids[i].steps + pieces);
    }
    for (uint32_t first = 0, next; first < surfaces->len; first = next) {
        const FrNurbsSurface *s = &g_array_index(surfaces, FrNurbsSurface, first);
        for (next = first + 1; next < surfaces->len &&
                               has_same_rim(s, &g_array_index(surfaces, FrNurbsSurface, next));
             next++) {
        }
        share_rims(surfaces, grids, first, next);
    }
    *triangles = 0;
    for (uint32_t i = 0; i < surfaces->len; i++) {
        *triangles += count_grid(&g_array_index(surfaces, FrNurbsSurface, i), &grids[i]);
    }
    return grids;
}

static void add_triangle(FrMeshFile *file, uint32_t a, uint32_t b, uint32_t c) {
    const vec3s *at = file->positions;
    bool is_plain = memcmp(&at[a], &at[b], sizeof *at) != 0 &&
                    memcmp(&at[b], &at[c], sizeof *at) != 0 &&
                    memcmp(&at[c], &at[a], sizeof *at) != 0;
    const uint32_t corners[3] = {a, b, c};
    for (int k = 0; k < 3 && is_plain; k++) {
        file->indices[file->index_count++] = corners[k];
    }
}

static void add_surface(FrMeshFile *file, const FrNurbsSurface *s, const FrFileGrid *grid) {
    uint32_t nu = grid->points_u, nv = grid->points_v, first = file->vertex_count;
    size_t count = (size_t)nu * nv;
    double *u = g_new(double, nu), *v = g_new(double, nv);
    double(*points)[3] = g_malloc_n(2 * count, sizeof *points), (*normals)[3] = points + count;
    uint32_t pieces = fr_nurbs_pieces(s->knots_u, s->degree_u, s->count_u);
    fr_nurbs_parameters(s->knots_u, s->degree_u, s->count_u, grid->steps, u);
    fr_nurbs_parameters(s->knots_v, s->degree_v, s->count_v, grid->steps + pieces, v);
    fr_nurbs_grid(s, u, nu, v, nv, points, normals, NULL, NULL);
    for (size_t n = 0; n < count; n++) {
        for (int k = 0; k < 3; k++) {
            file->positions[first + n].raw[k] = (float)points[n][k];
            file->normals[first + n].raw[k] = (float)normals[n][k];
        }
        file->uvs[first + n][0] = (float)(n % nu) / (float)(nu - 1);
        file->uvs[first + n][1] = 1.0F - (float)(n / nu) / (float)(nv - 1);
    }
    file->vertex_count += (uint32_t)count;
    for (uint32_t n = 0; n < (nu - 1) * (nv - 1); n++) {
        uint32_t at = first + n % (nu - 1) + n / (nu - 1) * nu;
        add_triangle(file, at, at + 1, at + nu + 1);
        add_triangle(file, at, at + nu + 1, at + nu);
    }
    g_free(u);
    g_free(v);
    g_free(points);
}

/// Takes the surfaces.
static FrMeshFile *to_file(FrSurfaceReader *reader) {
    uint64_t triangles;
    FrFileGrid *grids = choose_grids(reader->surfaces, &triangles);
    reader->status =
        fr_limit_check(triangles, MIN(reader->context->limits.triangles, INT32_MAX / 3),
                       "triangles", reader->name, reader->span, reader->context->diags);
    FrMeshFile *file = NULL;
    if (reader->status == FR_OK) {
        uint64_t vertices = 0;
        for (uint32_t i = 0; i < reader->surfaces->len; i++) {
            vertices += (uint64_t)grids[i].points_u * grids[i].points_v;
        }
        file = g_new0(FrMeshFile, 1);
        g_atomic_ref_count_init(&file->references);
        file->positions = g_new(vec3s, vertices);
        file->normals = g_new(vec3s, vertices);
        file->uvs = g_malloc_n(vertices, sizeof *file->uvs);
        file->indices = g_new(uint32_t, 3 * triangles + 1);
        for (uint32_t i = 0; i < reader->surfaces->len; i++) {
            add_surface(file, &g_array_index(reader->surfaces, FrNurbsSurface, i), &grids[i]);
        }
        file->parts = g_new0(FrMeshFilePart, 1);
        file->parts[0].index_count = file->index_count;
        file->part_count = 1;
        file->surfaces = g_array_ref(reader->surfaces);
    }
    for (uint32_t i = 0; i < reader->surfaces->len; i++) {
        g_free(grids[i].steps);
    }
    g_free(grids);
    return file;
}

FrMeshFile *fr_nurbs_file_import(const char *path, const char *name, FrSpan span,
                                 const FrContext *context, FrStatus *status) {
    FrSurfaceReader reader = {.name = name,
                              .span = span,
                              .context = context,
                              .surfaces = g_array_new(FALSE, FALSE, sizeof(FrNurbsSurface))};
    g_array_set_clear_func(reader.surfaces, surface_clear);
    char *text = NULL;
    gsize size = 0;
    if (!g_file_get_contents(path, &text, &size, NULL)) {
        fr_diags_add(context->diags, FR_ERROR, "cannot-read", span, "cannot read '%.80s'", name);
        reader.status = FR_ERR_MACHINE;
    } else if (is_iges(path)) {
        fr_iges_surfaces(&reader, text, size);
    } else {
        fr_obj_surfaces(&reader, text);
    }
    g_free(text);
    if (reader.status == FR_OK && reader.surfaces->len == 0) {
        fr_diags_add(context->diags, FR_ERROR, "empty-mesh", span,
                     "'%.80s' has no rational B-spline surfaces", name);
        reader.status = FR_ERR_DOCUMENT;
    }
    if (reader.status == FR_OK && reader.has_trims) {
        fr_diags_add(context->diags, FR_WARNING, "untrimmed", span,
                     "'%.80s' trims surfaces; they are taken whole", name);
    }
    FrMeshFile *file = reader.status == FR_OK ? to_file(&reader) : NULL;
    g_array_unref(reader.surfaces);
    *status = reader.status;
    return file;
}
