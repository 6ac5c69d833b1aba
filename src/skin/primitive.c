// Primitives: closed ones have Euler number 2 (the torus 0) when equal positions are joined, all
// are counter-clockwise from outside. Flat ones lie in the plane of a blade: along z, facing y.
#include "skin/shape.h"

#include <cglm/struct.h>

#include <math.h>

// Thinner than this nothing has a surface.
#define THINNEST 1e-6F

/// A surface that a grid of vertices is laid over.
typedef struct FrGrid {
    uint32_t around, along; ///< quads
    /// Position and normal at (a, b), a around and b along, both 0 to 1.
    void (*at)(const vec3s *size, double a, double b, vec3s *position, vec3s *normal);
} FrGrid;

static vec3s unit(double x, double y, double z) {
    double length = sqrt(x * x + y * y + z * z);
    return (vec3s){{(float)(x / length), (float)(y / length), (float)(z / length)}};
}

// Sine and cosine that meet exactly after a whole turn.
static void turn(double part, double *cosine, double *sine) {
    double angle = 2.0 * G_PI * (part >= 1.0 ? part - 1.0 : part);
    *cosine = cos(angle);
    *sine = sin(angle);
}

static void on_sphere(const vec3s *size, double a, double b, vec3s *position, vec3s *normal) {
    double c, s;
    turn(a, &c, &s);
    bool is_pole = b <= 0.0 || b >= 1.0;
    double ring = is_pole ? 0.0 : sin(G_PI * b), height = b >= 1.0 ? 1.0 : -cos(G_PI * b);
    *position = (vec3s){{(float)(0.5 * size->x * ring * c), (float)(0.5 * size->y * ring * s),
                         (float)(0.5 * size->z * (1.0 + height))}};
    *normal = unit(ring * c / size->x, ring * s / size->y, height / size->z);
}

static void on_cylinder(const vec3s *size, double a, double b, vec3s *position, vec3s *normal) {
    double c, s;
    turn(a, &c, &s);
    *position =
        (vec3s){{(float)(0.5 * size->x * c), (float)(0.5 * size->y * s), (float)(size->z * b)}};
    *normal = unit(c / size->x, s / size->y, 0.0);
}

static void on_cone(const vec3s *size, double a, double b, vec3s *position, vec3s *normal) {
    double c, s;
    turn(a, &c, &s);
    double ring = 1.0 - b;
    *position = (vec3s){{(float)(0.5 * size->x * ring * c), (float)(0.5 * size->y * ring * s),
                         (float)(size->z * b)}};
    *normal = unit(c / size->x, s / size->y, 0.5 / size->z);
}

static void on_torus(const vec3s *size, double a, double b, vec3s *position, vec3s *normal) {
    double c, s, ring_c, ring_s;
    turn(a, &c, &s);
    turn(b, &ring_c, &ring_s);
    double thick_x = fmin(0.5 * size->z, 0.25 * size->x);
    double thick_y = fmin(0.5 * size->z, 0.25 * size->y);
    double x = 0.5 * size->x - thick_x + thick_x * ring_c;
    double y = 0.5 * size->y - thick_y + thick_y * ring_c;
    *position = (vec3s){{(float)(x * c), (float)(y * s), (float)(0.5 * size->z * (1.0 + ring_s))}};
    // ∂/∂a × ∂/∂b; where the hole is a point or a line, from beside it.
    x = fmax(x, 1e-9 * size->x);
    y = fmax(y, 1e-9 * size->y);
    double dx = -x * s, dy = y * c;
    double ex = -thick_x * ring_s * c, ey = -thick_y * ring_s * s, ez = 0.5 * size->z * ring_c;
    *normal = unit(dy * ez, -dx * ez, dx * ey - dy * ex);
}

static void lay_grid(FrShapeMesh *mesh, const FrGrid *grid, const vec3s *size) {
    uint32_t first = mesh->vertex_count;
    for (uint32_t j = 0; j <= grid->along; j++) {
        for (uint32_t i = 0; i <= grid->around; i++) {
            double a = (double)i / grid->around, b = (double)j / grid->along;
            vec3s position, normal;
            grid->at(size, a, b, &position, &normal);
            fr_shape_vertex(mesh, position, normal, (float)a, (float)(1.0 - b));
        }
    }
    uint32_t row = grid->around + 1;
    bool is_apex_down = grid->at == on_sphere;
    bool is_apex_up = grid->at == on_sphere || grid->at == on_cone;
    for (uint32_t j = 0; j < grid->along; j++) {
        for (uint32_t i = 0; i < grid->around; i++) {
            uint32_t a = first + j * row + i, b = a + 1, c = b + row, d = a + row;
            if (j > 0 || !is_apex_down) {
                fr_shape_triangle(mesh, a, b, c);
            }
            if (j + 1 < grid->along || !is_apex_up) {
                fr_shape_triangle(mesh, a, c, d);
            }
        }
    }
}

static void lay_disc(FrShapeMesh *mesh, const vec3s *size, uint32_t around, float z,
                     bool faces_up) {
    vec3s normal = {{0, 0, faces_up ? 1.0F : -1.0F}};
    uint32_t first = mesh->vertex_count;
    for (uint32_t i = 0; i < around; i++) {
        double c, s;
        turn((double)i / around, &c, &s);
        vec3s at = {{(float)(0.5 * size->x * c), (float)(0.5 * size->y * s), z}};
        fr_shape_vertex(mesh, at, normal, (float)(0.5 + 0.5 * c), (float)(0.5 - 0.5 * s));
    }
    for (uint32_t i = 1; i + 1 < around; i++) {
        fr_shape_triangle(mesh, first, first + i + (faces_up ? 0 : 1),
                          first + i + (faces_up ? 1 : 0));
    }
}

static void lay_box(FrShapeMesh *mesh, const vec3s *size) {
    for (int axis = 0; axis < 3; axis++) {
        for (int side = -1; side <= 1; side += 2) {
            vec3s normal = {{0, 0, 0}};
            normal.raw[axis] = (float)side;
            uint32_t first = mesh->vertex_count;
            for (int corner = 0; corner < 4; corner++) {
                float p = corner == 1 || corner == 2 ? 0.5F : -0.5F, q = corner >= 2 ? 0.5F : -0.5F;
                vec3s at = {{0, 0, 0}};
                at.raw[axis] = 0.5F * (float)side;
                at.raw[(axis + 1) % 3] = (float)side * p;
                at.raw[(axis + 2) % 3] = q;
                at = (vec3s){{at.x * size->x, at.y * size->y, (at.z + 0.5F) * size->z}};
                fr_shape_vertex(mesh, at, normal, p + 0.5F, 0.5F - q);
            }
            fr_shape_triangle(mesh, first, first + 1, first + 2);
            fr_shape_triangle(mesh, first, first + 2, first + 3);
        }
    }
}

// A fan in the plane of x and z that faces y; u rises to the right as seen from there.
static void lay_flat(FrShapeMesh *mesh, const vec3s *size, const double (*corners)[2],
                     uint32_t count) {
    uint32_t first = mesh->vertex_count;
    for (uint32_t i = 0; i < count; i++) {
        double x = corners[i][0], z = corners[i][1];
        vec3s at = {{(float)(size->x * x), 0, (float)(size->z * z)}};
        fr_shape_vertex(mesh, at, (vec3s){{0, 1, 0}}, (float)(0.5 - x), (float)(1.0 - z));
    }
    for (uint32_t i = 1; i + 1 < count; i++) {
        fr_shape_triangle(mesh, first, first + i, first + i + 1);
    }
}

static void lay_flat_kind(FrShapeMesh *mesh, FrShapeKind kind, const vec3s *size, uint32_t around) {
    if (kind == FR_SHAPE_SQUARE) {
        lay_flat(mesh, size, (const double[][2]){{0.5, 0}, {-0.5, 0}, {-0.5, 1}, {0.5, 1}}, 4);
        return;
    }
    if (kind == FR_SHAPE_TRIANGLE) {
        lay_flat(mesh, size, (const double[][2]){{0.5, 0}, {-0.5, 0}, {0, 1}}, 3);
        return;
    }
    double corners[128][2];
    for (uint32_t i = 0; i < around; i++) {
        double c, s;
        turn((double)i / around, &c, &s);
        corners[i][0] = -0.5 * s;
        corners[i][1] = 0.5 - 0.5 * c;
    }
    lay_flat(mesh, size, (const double(*)[2])corners, around);
}

void fr_shape_triangles(FrShapeMesh *mesh, const FrPlant *plant, const FrShape *shape) {
    mesh->is_foliage = true;
    if (shape->detail >= plant->profiles->len) {
        return;
    }
    const FrProfile *profile = &g_array_index(plant->profiles, FrProfile, shape->detail);
    for (uint32_t i = 0; i + 6 <= profile->count; i += 6) {
        vec3s corner[3];
        for (uint32_t k = 0; k < 3; k++) {
            const double *xy = profile->points[i + 2 * k], *z = profile->points[i + 2 * k + 1];
            corner[k] = (vec3s){{(float)xy[0] * shape->size.x, (float)xy[1] * shape->size.y,
                                 (float)z[0] * shape->size.z}};
        }
        vec3s normal = glms_vec3_cross(glms_vec3_sub(corner[1], corner[0]),
                                       glms_vec3_sub(corner[2], corner[0]));
        float length = glms_vec3_norm(normal);
        if (!(length > 0)) {
            continue;
        }
        normal = glms_vec3_scale(normal, 1 / length);
        uint32_t first = mesh->vertex_count;
        for (uint32_t k = 0; k < 3; k++) {
            fr_shape_vertex(mesh, corner[k], normal, corner[k].x, -corner[k].z);
        }
        fr_shape_triangle(mesh, first, first + 1, first + 2);
    }
}

void fr_shape_primitive(FrShapeMesh *mesh, const FrShape *shape, const FrDetail *detail) {
    vec3s size = shape->size;
    for (int k = 0; k < 3; k++) {
        size.raw[k] = size.raw[k] > THINNEST && isfinite(size.raw[k]) ? size.raw[k] : THINNEST;
    }
    uint32_t around = fr_shape_segments(shape->detail, 3, 128, detail);
    uint32_t half = MAX(around / 2, 2);
    switch (shape->kind) {
    case FR_SHAPE_BOX:
        lay_box(mesh, &size);
        break;
    case FR_SHAPE_SPHERE:
        lay_grid(mesh, &(FrGrid){around, half, on_sphere}, &size);
        break;
    case FR_SHAPE_CONE:
        lay_grid(mesh, &(FrGrid){around, 1, on_cone}, &size);
        lay_disc(mesh, &size, around, 0.0F, false);
        break;
    case FR_SHAPE_CYLINDER:
        lay_grid(mesh, &(FrGrid){around, 1, on_cylinder}, &size);
        lay_disc(mesh, &size, around, 0.0F, false);
        lay_disc(mesh, &size, around, size.z, true);
        break;
    case FR_SHAPE_TORUS:
        lay_grid(mesh, &(FrGrid){around, MAX(half, 3), on_torus}, &size);
        break;
    case FR_SHAPE_BLADE:
    case FR_SHAPE_REVOLUTION:
    case FR_SHAPE_SQUARE:
    case FR_SHAPE_CIRCLE:
    case FR_SHAPE_TRIANGLE:
        mesh->is_foliage = true;
        lay_flat_kind(mesh, shape->kind, &size, around);
        break;
    case FR_SHAPE_MESH:
    case FR_SHAPE_FILE:
        break; // have makers of their own
    }
}
