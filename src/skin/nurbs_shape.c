// Shapes of organs as rational surfaces: quadrics and tori are exact, as surfaces of revolution
// (Piegl, Tiller, The NURBS Book, section 8.5).
#include "skin/nurbs.h"

#include <string.h>

#define HALF_ROOT2 0.70710678118654752
#define THINNEST 1e-5

/// A point of what is turned about z: distances along x and y, height, weight.
typedef struct FrMeridianPoint {
    double x, y, z, weight;
} FrMeridianPoint;

static void form_clear(gpointer data) {
    FrNurbsForm *form = data;
    g_free(form->knots_u);
    g_free(form->knots_v);
    g_free(form->points);
    g_free(form->texture);
}

FrNurbsForm *fr_nurbs_form_add(GArray *forms, uint32_t kind, uint32_t degree_u, uint32_t count_u,
                               uint32_t degree_v, uint32_t count_v) {
    FrNurbsForm form = {
        .kind = kind,
        .degree_u = degree_u,
        .degree_v = degree_v,
        .count_u = count_u,
        .count_v = count_v,
        .knots_u = g_new(double, (size_t)count_u + degree_u + 1),
        .knots_v = g_new(double, (size_t)count_v + degree_v + 1),
        .points = g_malloc_n((size_t)count_u * count_v, sizeof *form.points),
    };
    g_array_append_val(forms, form);
    return &g_array_index(forms, FrNurbsForm, forms->len - 1);
}

// Knots of `count` points of a polygon.
static void polygon_knots(uint32_t count, double *knots) {
    knots[0] = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        knots[i + 1] = (double)i / (count - 1);
    }
    knots[count + 1] = 1.0;
}

static void put(double point[4], double x, double y, double z, double weight) {
    point[0] = x;
    point[1] = y;
    point[2] = z;
    point[3] = weight;
}

/// Turns a meridian about z; its knots are the caller's to fill in.
static FrNurbsForm *revolve(GArray *forms, FrNurbsCircle circle, uint32_t kind, uint32_t degree,
                            const FrMeridianPoint *meridian, uint32_t count) {
    FrNurbsCurve ring = fr_nurbs_circle(circle);
    FrNurbsForm *form = fr_nurbs_form_add(forms, kind, ring.degree, ring.count, degree, count);
    memcpy(form->knots_u, ring.knots, sizeof(double) * (ring.count + ring.degree + 1));
    for (uint32_t j = 0; j < count; j++) {
        const FrMeridianPoint *m = &meridian[j];
        for (uint32_t i = 0; i < ring.count; i++) {
            const double *c = ring.points[i];
            put(form->points[(size_t)j * ring.count + i], m->x * c[0], m->y * c[1], m->z,
                m->weight * c[3]);
        }
    }
    fr_nurbs_curve_clear(&ring);
    return form;
}

static void revolve_polygon(GArray *forms, FrNurbsCircle circle, uint32_t kind,
                            const FrMeridianPoint *meridian, uint32_t count) {
    FrNurbsForm *form = revolve(forms, circle, kind, 1, meridian, count);
    polygon_knots(count, form->knots_v);
}

static void lay_sphere(GArray *forms, FrNurbsCircle circle, const double size[3]) {
    double x = 0.5 * size[0], y = 0.5 * size[1], z = size[2];
    const FrMeridianPoint arc[] = {{0, 0, 0, 1},
                                   {x, y, 0, HALF_ROOT2},
                                   {x, y, 0.5 * z, 1},
                                   {x, y, z, HALF_ROOT2},
                                   {0, 0, z, 1}};
    static const double knots[] = {0, 0, 0, 0.5, 0.5, 1, 1, 1};
    FrNurbsForm *form = revolve(forms, circle, FR_NURBS_TUBE, 2, arc, 5);
    memcpy(form->knots_v, knots, sizeof knots);
}

static void lay_torus(GArray *forms, FrNurbsCircle circle, const double size[3]) {
    double thick_x = fmin(0.5 * size[2], 0.25 * size[0]);
    double thick_y = fmin(0.5 * size[2], 0.25 * size[1]);
    FrNurbsCurve ring = fr_nurbs_circle(FR_CIRCLE_NINE);
    FrMeridianPoint meridian[9];
    for (int i = 0; i < 9; i++) {
        const double *c = ring.points[i];
        meridian[i] = (FrMeridianPoint){0.5 * size[0] + thick_x * (c[0] - 1.0),
                                        0.5 * size[1] + thick_y * (c[0] - 1.0),
                                        0.5 * size[2] * (1.0 + c[1]), c[3]};
    }
    FrNurbsForm *form = revolve(forms, circle, FR_NURBS_PATCH, 2, meridian, 9);
    memcpy(form->knots_v, ring.knots, 12 * sizeof(double));
    fr_nurbs_curve_clear(&ring);
}

// A tube from z = 0 to the top with its caps; `top` is the share of its width that is left there.
static void lay_cylinder(GArray *forms, FrNurbsCircle circle, const double size[3], double top) {
    double x = 0.5 * size[0], y = 0.5 * size[1], z = size[2];
    const FrMeridianPoint side[] = {{x, y, 0, 1}, {top * x, top * y, z, 1}};
    const FrMeridianPoint foot[] = {{0, 0, 0, 1}, {x, y, 0, 1}};
    const FrMeridianPoint cap[] = {{top * x, top * y, z, 1}, {0, 0, z, 1}};
    revolve_polygon(forms, circle, FR_NURBS_TUBE, side, 2);
    revolve_polygon(forms, circle, FR_NURBS_FOOT, foot, 2);
    if (top > 0.0) {
        revolve_polygon(forms, circle, FR_NURBS_CAP, cap, 2);
    }
}

static void lay_patch(GArray *forms, const double corners[4][3]) {
    FrNurbsForm *form = fr_nurbs_form_add(forms, FR_NURBS_PATCH, 1, 2, 1, 2);
    polygon_knots(2, form->knots_u);
    polygon_knots(2, form->knots_v);
    static const int order[] = {0, 1, 3, 2};
    for (int i = 0; i < 4; i++) {
        const double *c = corners[order[i]];
        put(form->points[i], c[0], c[1], c[2], 1.0);
    }
}

static void lay_box(GArray *forms, const double size[3]) {
    for (int axis = 0; axis < 3; axis++) {
        for (int side = -1; side <= 1; side += 2) {
            double corners[4][3];
            for (int i = 0; i < 4; i++) {
                double p = i == 1 || i == 2 ? 0.5 : -0.5, at[3];
                at[axis] = 0.5 * side;
                at[(axis + 1) % 3] = side * p;
                at[(axis + 2) % 3] = i >= 2 ? 0.5 : -0.5;
                corners[i][0] = at[0] * size[0];
                corners[i][1] = at[1] * size[1];
                corners[i][2] = (at[2] + 0.5) * size[2];
            }
            lay_patch(forms, (const double(*)[3])corners);
        }
    }
}

// Flat shapes stand in the plane of x and z and face y.
static void lay_flat(GArray *forms, const FrShape *shape, FrNurbsCircle circle,
                     const double size[3]) {
    double x = 0.5 * size[0], z = size[2];
    if (shape->kind == FR_SHAPE_SQUARE) {
        lay_patch(forms, (const double[4][3]){{x, 0, 0}, {-x, 0, 0}, {-x, 0, z}, {x, 0, z}});
    } else if (shape->kind == FR_SHAPE_TRIANGLE) {
        lay_patch(forms, (const double[4][3]){{x, 0, 0}, {-x, 0, 0}, {0, 0, z}, {0, 0, z}});
    } else {
        const FrMeridianPoint disc[] = {{x, 0.5 * z, 0, 1}, {0, 0, 0, 1}};
        revolve_polygon(forms, circle, FR_NURBS_PATCH, disc, 2);
        FrNurbsForm *form = &g_array_index(forms, FrNurbsForm, forms->len - 1);
        for (uint32_t i = 0; i < form->count_u * 2; i++) {
            double *p = form->points[i];
            put(p, -p[0], 0.0, 0.5 * z + p[1], p[3]);
        }
    }
}

static const FrProfile *profile_of(const FrPlant *plant, uint32_t index) {
    return index < plant->profiles->len ? &g_array_index(plant->profiles, FrProfile, index) : NULL;
}

static void lay_revolution(GArray *forms, const FrPlant *plant, const FrShape *shape,
                           FrNurbsCircle circle, const double size[3]) {
    const FrProfile *profile = profile_of(plant, shape->outline);
    if (profile == NULL) {
        return;
    }
    FrMeridianPoint *meridian = g_new(FrMeridianPoint, profile->count + 1);
    uint32_t count = 0;
    for (uint32_t i = 0; i < profile->count; i++) {
        double height = profile->points[i][0] * size[2], out = fmax(profile->points[i][1], 0.0);
        FrMeridianPoint point = {out * size[0], out * size[1], height, 1.0};
        const FrMeridianPoint *last = count > 0 ? &meridian[count - 1] : NULL;
        bool is_new = last == NULL ||
                      fabs(last->x - point.x) + fabs(last->y - point.y) > THINNEST ||
                      fabs(last->z - point.z) > THINNEST;
        if (isfinite(height) && isfinite(point.x) && isfinite(point.y) && is_new) {
            meridian[count++] = point;
        }
    }
    if (count >= 2) {
        revolve_polygon(forms, circle, FR_NURBS_TUBE, meridian, count);
    }
    g_free(meridian);
}

static void lay_triangles(GArray *forms, const FrPlant *plant, const FrShape *shape) {
    const FrProfile *profile = profile_of(plant, shape->detail);
    for (uint32_t i = 0; profile != NULL && i + 6 <= profile->count; i += 6) {
        double corners[4][3];
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t from = i + 2 * MIN(k, 2);
            corners[k][0] = profile->points[from][0] * (double)shape->size.x;
            corners[k][1] = profile->points[from][1] * (double)shape->size.y;
            corners[k][2] = profile->points[from + 1][0] * (double)shape->size.z;
        }
        lay_patch(forms, (const double(*)[3])corners);
    }
}

static uint64_t file_triangles(const FrPlant *plant, const FrShape *shape) {
    if (shape->detail >= plant->files->len) {
        return 0;
    }
    const FrMeshFile *file = g_ptr_array_index(plant->files, shape->detail);
    return shape->outline < file->part_count ? file->parts[shape->outline].index_count / 3 : 0;
}

/// Surfaces of a file are what they were.
static void lay_surfaces(GArray *forms, const GArray *surfaces, const double size[3]) {
    for (uint32_t i = 0; i < surfaces->len; i++) {
        const FrNurbsSurface *s = &g_array_index(surfaces, FrNurbsSurface, i);
        FrNurbsForm *form = fr_nurbs_form_add(forms, FR_NURBS_PATCH, s->degree_u, s->count_u,
                                              s->degree_v, s->count_v);
        memcpy(form->knots_u, s->knots_u, sizeof(double) * (s->count_u + s->degree_u + 1));
        memcpy(form->knots_v, s->knots_v, sizeof(double) * (s->count_v + s->degree_v + 1));
        for (size_t n = 0; n < (size_t)s->count_u * s->count_v; n++) {
            const double *p = s->points[n];
            put(form->points[n], size[0] * p[0], size[1] * p[1], size[2] * p[2], p[3]);
        }
    }
}

static void lay_file(GArray *forms, const FrPlant *plant, const FrShape *shape,
                     const double size[3]) {
    if (file_triangles(plant, shape) == 0) {
        return;
    }
    const FrMeshFile *file = g_ptr_array_index(plant->files, shape->detail);
    if (file->surfaces != NULL && shape->outline == 0) {
        lay_surfaces(forms, file->surfaces, size);
        return;
    }
    const FrMeshFilePart *part = &file->parts[shape->outline];
    for (uint32_t i = part->first_index; i < part->first_index + part->index_count; i += 3) {
        double corners[4][3];
        for (uint32_t k = 0; k < 4; k++) {
            vec3s at = file->positions[file->indices[i + MIN(k, 2)]];
            for (int r = 0; r < 3; r++) {
                corners[k][r] = (double)at.raw[r] * (double)shape->size.raw[r];
            }
        }
        lay_patch(forms, (const double(*)[3])corners);
    }
}

GArray *fr_nurbs_shape(const FrPlant *plant, const FrShape *shape, const FrNurbsParams *params) {
    GArray *forms = g_array_new(FALSE, FALSE, sizeof(FrNurbsForm));
    g_array_set_clear_func(forms, form_clear);
    double size[3];
    for (int k = 0; k < 3; k++) {
        double given = (double)shape->size.raw[k];
        size[k] = given > THINNEST && isfinite(given) ? given : THINNEST;
    }
    FrNurbsCircle circle = (FrNurbsCircle)params->circle;
    switch (shape->kind) {
    case FR_SHAPE_BLADE:
        fr_nurbs_leaf(forms, plant, &shape->blade, params);
        break;
    case FR_SHAPE_BOX:
        lay_box(forms, size);
        break;
    case FR_SHAPE_SPHERE:
        lay_sphere(forms, circle, size);
        break;
    case FR_SHAPE_CONE:
        lay_cylinder(forms, circle, size, 0.0);
        break;
    case FR_SHAPE_CYLINDER:
        lay_cylinder(forms, circle, size, 1.0);
        break;
    case FR_SHAPE_TORUS:
        lay_torus(forms, circle, size);
        break;
    case FR_SHAPE_SQUARE:
    case FR_SHAPE_CIRCLE:
    case FR_SHAPE_TRIANGLE:
        lay_flat(forms, shape, circle, size);
        break;
    case FR_SHAPE_REVOLUTION:
        lay_revolution(forms, plant, shape, circle, size);
        break;
    case FR_SHAPE_MESH:
        lay_triangles(forms, plant, shape);
        break;
    case FR_SHAPE_FILE:
        lay_file(forms, plant, shape, size);
        break;
    }
    return forms;
}

static uint64_t file_bytes(const FrPlant *plant, const FrShape *shape) {
    uint64_t bytes = 1024, triangles = file_triangles(plant, shape);
    const FrMeshFile *file = triangles > 0 ? g_ptr_array_index(plant->files, shape->detail) : NULL;
    if (file == NULL || file->surfaces == NULL || shape->outline != 0) {
        return fr_count_multiply(triangles, 512) + bytes;
    }
    for (uint32_t i = 0; i < file->surfaces->len; i++) {
        const FrNurbsSurface *s = &g_array_index(file->surfaces, FrNurbsSurface, i);
        uint64_t knots = s->count_u + s->count_v + 2 * (FR_NURBS_DEGREE_MOST + 1);
        bytes += sizeof(FrNurbsForm) + 32 * (uint64_t)s->count_u * s->count_v + 8 * knots;
    }
    return bytes;
}

uint64_t fr_nurbs_shape_bytes_most(const FrPlant *plant, const FrShape *shape,
                                   const FrNurbsParams *params) {
    const FrProfile *outline = profile_of(plant, shape->outline);
    const FrProfile *triangles = profile_of(plant, shape->detail);
    switch (shape->kind) {
    case FR_SHAPE_BLADE:
        return fr_nurbs_leaf_bytes_most(&shape->blade, params);
    case FR_SHAPE_REVOLUTION:
        return outline != NULL ? fr_count_multiply(outline->count, 9 * 32 + 64) + 1024 : 0;
    case FR_SHAPE_MESH:
        return triangles != NULL ? fr_count_multiply(triangles->count, 64) + 1024 : 0;
    case FR_SHAPE_FILE:
        return file_bytes(plant, shape);
    default:
        return 8192;
    }
}
