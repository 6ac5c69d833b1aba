/// Rays and solids: boxes by their slabs, balls and cylinders by quadratic equations, triangles
/// after Möller, Trumbore 1997.
#include "scene/pick_solid.h"

#include <cglm/struct.h>
#include <math.h>

/// A ray in the coordinates of a shape of extent 1 that stands on the origin.
typedef struct Ray {
    double origin[3], direction[3];
} Ray;

static Ray within(const FrPlant *plant, uint32_t organ, const FrShape *shape,
                  const double origin[3], const double direction[3]) {
    vec3s at;
    versors turn;
    fr_plant_organ_pose(plant, organ, &at, &turn);
    versors back = glms_quat_inv(turn);
    vec3s from = {{(float)(origin[0] - (double)at.x), (float)(origin[1] - (double)at.y),
                   (float)(origin[2] - (double)at.z)}};
    vec3s along = {{(float)direction[0], (float)direction[1], (float)direction[2]}};
    from = glms_quat_rotatev(back, from);
    along = glms_quat_rotatev(back, along);
    Ray ray;
    for (int k = 0; k < 3; k++) {
        double size = fmax((double)(shape->size.raw[k] * plant->organs.scale[organ]), 1e-9);
        ray.origin[k] = (double)from.raw[k] / size;
        ray.direction[k] = (double)along.raw[k] / size;
    }
    return ray;
}

/// Narrows [*in, *out] to where origin + t·direction is between two planes.
static void clip(double origin, double direction, double low, double high, double *in,
                 double *out) {
    double a = (low - origin) / direction, b = (high - origin) / direction;
    if (direction != 0) {
        *in = fmax(*in, fmin(a, b));
        *out = fmin(*out, fmax(a, b));
    } else if (origin < low || origin > high) {
        *out = -INFINITY;
    }
}

/// Narrows it to where the first `axes` coordinates about `middle` are within a half.
static void clip_round(const Ray *ray, int axes, const double middle[3], double *in, double *out) {
    double a = 0, b = 0, c = -0.25;
    for (int k = 0; k < axes; k++) {
        double from = ray->origin[k] - middle[k];
        a += ray->direction[k] * ray->direction[k];
        b += ray->direction[k] * from;
        c += from * from;
    }
    double root = b * b - a * c;
    if (a > 0 && root >= 0) {
        *in = fmax(*in, (-b - sqrt(root)) / a);
        *out = fmin(*out, (-b + sqrt(root)) / a);
    } else if (root < 0 || c > 0) {
        *out = -INFINITY;
    }
}

static double meet_primitive(const Ray *ray, FrShapeKind kind) {
    const double middle[3] = {0, 0, 0.5};
    double in = 0, out = INFINITY;
    for (int k = 0; k < 3; k++) {
        clip(ray->origin[k], ray->direction[k], k == 2 ? 0 : -0.5, k == 2 ? 1 : 0.5, &in, &out);
    }
    if (kind == FR_SHAPE_SPHERE) {
        clip_round(ray, 3, middle, &in, &out);
    } else if (kind == FR_SHAPE_CYLINDER || kind == FR_SHAPE_CONE) {
        clip_round(ray, 2, middle, &in, &out);
    }
    return in <= out && in > 0 ? in : INFINITY;
}

static void cross(const double a[3], const double b[3], double result[3]) {
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double meet_triangle(const Ray *ray, const FrMeshFile *mesh, const uint32_t corners[3]) {
    double side[2][3], from[3], p[3], q[3];
    const vec3s *at = mesh->positions;
    for (int k = 0; k < 3; k++) {
        side[0][k] = (double)(at[corners[1]].raw[k] - at[corners[0]].raw[k]);
        side[1][k] = (double)(at[corners[2]].raw[k] - at[corners[0]].raw[k]);
        from[k] = ray->origin[k] - (double)at[corners[0]].raw[k];
    }
    cross(ray->direction, side[1], p);
    double volume = dot(side[0], p);
    if (volume == 0) {
        return INFINITY;
    }
    double u = dot(from, p) / volume;
    cross(from, side[0], q);
    double v = dot(ray->direction, q) / volume;
    double t = dot(side[1], q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : INFINITY;
}

double fr_pick_solid(const FrPlant *plant, uint32_t organ, const double origin[3],
                     const double direction[3]) {
    const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]);
    Ray ray = within(plant, organ, shape, origin, direction);
    if (shape->kind != FR_SHAPE_FILE) {
        return meet_primitive(&ray, shape->kind);
    }
    const FrMeshFile *mesh = g_ptr_array_index(plant->files, shape->detail);
    const FrMeshFilePart *part = &mesh->parts[shape->outline];
    double nearest = INFINITY;
    for (uint32_t i = 0; i + 2 < part->index_count; i += 3) {
        nearest = fmin(nearest, meet_triangle(&ray, mesh, &mesh->indices[part->first_index + i]));
    }
    return nearest;
}
