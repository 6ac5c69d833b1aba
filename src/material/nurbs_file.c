// Files of rational surfaces: read by format, kept as they are, and cut into triangles for all that
// knows triangles only.
#include "material/nurbs_file.h"

#include "material/mesh_file.h"

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
    gsize size = 0;
    bool has_surfaces =
        g_file_get_contents(path, &text, &size, NULL) && fr_obj_has_surfaces(text, size);
    g_free(text);
    return has_surfaces;
}

size_t fr_line_length(const char *text, size_t size) {
    size_t length = 0;
    while (length < size && text[length] != '\n' && text[length] != '\r') {
        length++;
    }
    return length;
}

size_t fr_line_end(const char *text, size_t size) {
    bool is_pair = size > 1 && text[0] == '\r' && text[1] == '\n';
    return is_pair ? 2 : size > 0;
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

static void say(const FrSurfaceReader *reader, FrSeverity severity, size_t line, const char *what,
                va_list arguments) {
    char *text = g_strdup_vprintf(what, arguments);
    fr_diags_add(reader->context->diags, severity, "bad-surfaces", reader->span,
                 "'%.80s', line %zu: %s", reader->name, line, text);
    g_free(text);
}

void fr_surface_fail(FrSurfaceReader *reader, size_t line, const char *what, ...) {
    va_list arguments;
    va_start(arguments, what);
    say(reader, FR_ERROR, line, what, arguments);
    va_end(arguments);
    reader->status = FR_ERR_DOCUMENT;
}

void fr_surface_warn(FrSurfaceReader *reader, size_t line, const char *what, ...) {
    va_list arguments;
    va_start(arguments, what);
    say(reader, FR_WARNING, line, what, arguments);
    va_end(arguments);
}

/// What is wrong with a surface that is not valid.
static const char *fault_of(const FrNurbsSurface *s) {
    const double *knots[2] = {s->knots_u, s->knots_v};
    const uint32_t counts[2] = {s->count_u + s->degree_u + 1, s->count_v + s->degree_v + 1};
    for (int way = 0; way < 2; way++) {
        for (uint32_t i = 0; i < counts[way]; i++) {
            if (!isfinite(knots[way][i]) || (i > 0 && knots[way][i] < knots[way][i - 1])) {
                return "knots fall or are no numbers";
            }
        }
    }
    for (size_t i = 0; i < (size_t)s->count_u * s->count_v; i++) {
        if (!(s->points[i][3] > 1e-12)) {
            return "a weight is not above 0";
        }
    }
    return "too many knots are equal, or numbers are too large";
}

/// Cuts a surface to a range along u, or along v.
static FrNurbsSurface cut(const FrNurbsSurface *s, bool is_u, const double range[2]) {
    uint32_t degree = is_u ? s->degree_u : s->degree_v, count = is_u ? s->count_u : s->count_v;
    const double *knots = is_u ? s->knots_u : s->knots_v;
    double *cut_knots = g_new(double, (size_t)count + 3 * ((size_t)degree + 1));
    uint32_t made = fr_nurbs_cut_knots(knots, degree, count, range, cut_knots);
    double *to[2], (*points)[4];
    FrNurbsSurface part = fr_surface_new(s->degree_u, is_u ? made : s->count_u, s->degree_v,
                                         is_u ? s->count_v : made, &to[0], &to[1], &points);
    memcpy(to[is_u ? 0 : 1], cut_knots, ((size_t)made + degree + 1) * sizeof *cut_knots);
    memcpy(to[is_u ? 1 : 0], is_u ? s->knots_v : s->knots_u,
           (is_u ? (size_t)s->count_v + s->degree_v + 1 : (size_t)s->count_u + s->degree_u + 1) *
               sizeof *cut_knots);
    for (uint32_t line = 0; line < (is_u ? s->count_v : s->count_u); line++) {
        size_t from = is_u ? (size_t)line * s->count_u : line;
        size_t at = is_u ? (size_t)line * made : line, stride = is_u ? 1 : s->count_u;
        fr_nurbs_cut(knots, degree, count, s->points + from, stride, cut_knots, made, points + at,
                     stride);
    }
    g_free(cut_knots);
    return part;
}

/// True if the surface, cut where it must be, has just these ranges.
static bool cut_to(FrNurbsSurface *surface, double ranges[2][2]) {
    for (int way = 0; way < 2; way++) {
        const FrNurbsSurface *s = surface;
        const double *knots = way == 0 ? s->knots_u : s->knots_v;
        uint32_t degree = way == 0 ? s->degree_u : s->degree_v;
        bool is_cut =
            fr_nurbs_is_cut(knots, degree, way == 0 ? s->count_u : s->count_v, ranges[way]);
        if (!(ranges[way][0] < ranges[way][1])) {
            return false;
        }
        if (is_cut) {
            FrNurbsSurface part = cut(surface, way == 0, ranges[way]);
            surface_clear(surface);
            *surface = part;
        }
    }
    return true;
}

void fr_surface_take(FrSurfaceReader *reader, FrNurbsSurface surface, double ranges[2][2],
                     size_t line) {
    if (!fr_nurbs_surface_is_valid(&surface)) {
        fr_surface_fail(reader, line, "%s", fault_of(&surface));
    } else if (!cut_to(&surface, ranges)) {
        fr_surface_fail(reader, line, "the range of a parameter is empty or outside the knots");
    } else {
        g_array_append_val(reader->surfaces, surface);
        return;
    }
    surface_clear(&surface);
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

/// Appends the triangles of a file, which is freed, to those of another.
static void join(FrMeshFile *to, FrMeshFile *from) {
    uint32_t vertices = to->vertex_count + from->vertex_count;
    uint32_t indices = to->index_count + from->index_count;
    to->positions = g_renew(vec3s, to->positions, vertices);
    to->normals = g_renew(vec3s, to->normals, vertices);
    to->uvs = g_realloc_n(to->uvs, vertices, sizeof *to->uvs);
    to->indices = g_renew(uint32_t, to->indices, indices);
    to->parts = g_renew(FrMeshFilePart, to->parts, to->part_count + from->part_count);
    size_t at = to->vertex_count, count = from->vertex_count;
    memcpy(to->positions + at, from->positions, count * sizeof *to->positions);
    memcpy(to->normals + at, from->normals, count * sizeof *to->normals);
    memcpy(to->uvs + at, from->uvs, count * sizeof *to->uvs);
    for (uint32_t i = 0; i < from->index_count; i++) {
        to->indices[to->index_count + i] = to->vertex_count + from->indices[i];
    }
    for (uint32_t p = 0; p < from->part_count; p++) {
        FrMeshFilePart part = from->parts[p];
        part.first_index += to->index_count;
        to->parts[to->part_count++] = part;
    }
    from->part_count = 0; // whose materials have moved
    to->vertex_count = vertices;
    to->index_count = indices;
    fr_mesh_file_unref(from);
}

/// Reads the polygons of an .obj that has surfaces, and appends them.
static void add_faces(FrSurfaceReader *reader, FrMeshFile *file, const char *path, char *text,
                      size_t size) {
    if (!fr_obj_keep_faces(text, size)) {
        return;
    }
    GBytes *bytes = g_bytes_new_static(text, size);
    FrMeshFile *faces = fr_mesh_file_import(path, reader->name, bytes, reader->span,
                                            reader->context, &reader->status);
    g_bytes_unref(bytes);
    if (faces != NULL) {
        uint64_t triangles = ((uint64_t)file->index_count + faces->index_count) / 3;
        uint64_t most = MIN(reader->context->limits.triangles, INT32_MAX / 3);
        reader->status = fr_limit_check(triangles, most, "triangles", reader->name, reader->span,
                                        reader->context->diags);
        join(file, faces);
    }
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
        fr_obj_surfaces(&reader, text, size);
    }
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
    if (file != NULL && !is_iges(path)) {
        add_faces(&reader, file, path, text, size);
    }
    if (reader.status != FR_OK) {
        g_clear_pointer(&file, fr_mesh_file_unref);
    }
    g_free(text);
    g_array_unref(reader.surfaces);
    *status = reader.status;
    return file;
}
