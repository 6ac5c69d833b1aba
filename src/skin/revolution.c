// Surfaces of revolution. Corners of the outline stay sharp, gentle turns are shaded smoothly: a
// point of a corner has a ring of vertices for each of its two sides.
#include "skin/shape.h"

#include <math.h>

// Outlines of so many points keep them all, however far away.
enum { LEAST_POINTS = 12 };

// Sharper than this is a corner.
#define SMOOTHEST_CORNER 0.85 // cosine
// Thinner than this nothing has a surface.
#define THINNEST 1e-6

typedef struct Point {
    double radius, height;
} Point;

typedef struct Way {
    double out, up, length; // direction of a piece of the outline
} Way;

// Radius and height of the outline's points, for a surface as wide and high as 1.
static GArray *outline_points(const FrPlant *plant, const FrShape *shape, const FrDetail *detail) {
    const FrProfile *profile = &g_array_index(plant->profiles, FrProfile, shape->outline);
    GArray *points = g_array_new(FALSE, FALSE, sizeof(Point));
    uint32_t wanted = fr_shape_segments(profile->count, LEAST_POINTS, UINT16_MAX, detail);
    uint32_t count = MIN(profile->count, wanted);
    for (uint32_t k = 0; k < count; k++) {
        uint32_t from =
            count > 1 ? (uint32_t)((uint64_t)k * (profile->count - 1) / (count - 1)) : 0;
        Point point = {profile->points[from][1], profile->points[from][0]};
        Point last =
            points->len > 0 ? g_array_index(points, Point, points->len - 1) : (Point){INFINITY, 0};
        if (isfinite(point.radius) && isfinite(point.height) &&
            hypot(point.radius - last.radius, point.height - last.height) > 1e-9) {
            point.radius = fmax(0, point.radius);
            g_array_append_val(points, point);
        }
    }
    return points;
}

static Way way_between(Point a, Point b, double width, double height) {
    double out = (b.radius - a.radius) * width, up = (b.height - a.height) * height;
    double length = hypot(out, up);
    return (Way){out / length, up / length, length};
}

// A ring of vertices around the axis with the outer side of `way`. Answers its first.
static uint32_t lay_ring(FrShapeMesh *mesh, Point point, const double size[3], Way way,
                         uint32_t around, double v) {
    double mean = 0.5 * (size[0] + size[1]);
    uint32_t first = mesh->vertex_count;
    for (uint32_t i = 0; i <= around; i++) {
        double part = i < around ? (double)i / around : 0;
        double c = cos(2 * G_PI * part), s = sin(2 * G_PI * part);
        vec3s at = {{(float)(point.radius * size[0] * c), (float)(point.radius * size[1] * s),
                     (float)(point.height * size[2])}};
        double x = way.up * c * mean / size[0], y = way.up * s * mean / size[1], z = -way.out;
        double length = sqrt(x * x + y * y + z * z);
        vec3s normal = {{(float)(x / length), (float)(y / length), (float)(z / length)}};
        fr_shape_vertex(mesh, at, normal, (float)((double)i / around), (float)v);
    }
    return first;
}

static void join_rings(FrShapeMesh *mesh, uint32_t lower, uint32_t upper, uint32_t around,
                       bool is_apex_low, bool is_apex_high) {
    for (uint32_t i = 0; i < around; i++) {
        if (!is_apex_low) {
            fr_shape_triangle(mesh, lower + i, lower + i + 1, upper + i + 1);
        }
        if (!is_apex_high) {
            fr_shape_triangle(mesh, lower + i, upper + i + 1, upper + i);
        }
    }
}

static Way mean_way(Way a, Way b) {
    Way way = {a.out + b.out, a.up + b.up, 0};
    double length = hypot(way.out, way.up);
    return (Way){way.out / length, way.up / length, length};
}

static bool is_corner(Way a, Way b) {
    return a.out * b.out + a.up * b.up < SMOOTHEST_CORNER;
}

static void lay_pieces(FrShapeMesh *mesh, const GArray *points, const double size[3],
                       uint32_t around) {
    const Point *at = &g_array_index(points, Point, 0);
    uint32_t last = points->len - 1, before = 0;
    double mean = 0.5 * (size[0] + size[1]), total = 0, passed = 0;
    for (uint32_t k = 0; k < last; k++) {
        total += way_between(at[k], at[k + 1], mean, size[2]).length;
    }
    Way came = {0};
    for (uint32_t k = 0; k < last; k++) {
        Way way = way_between(at[k], at[k + 1], mean, size[2]);
        bool begins = k == 0 || is_corner(came, way);
        uint32_t lower = before;
        if (begins) {
            lower = lay_ring(mesh, at[k], size, way, around, 1 - passed / total);
        }
        Way onward = way;
        if (k + 1 < last) {
            Way next = way_between(at[k + 1], at[k + 2], mean, size[2]);
            onward = is_corner(way, next) ? way : mean_way(way, next);
        }
        passed += way.length;
        before = lay_ring(mesh, at[k + 1], size, onward, around, 1 - passed / total);
        join_rings(mesh, lower, before, around, at[k].radius <= 0, at[k + 1].radius <= 0);
        came = way;
    }
}

void fr_shape_revolution(FrShapeMesh *mesh, const FrPlant *plant, const FrShape *shape,
                         const FrDetail *detail) {
    double size[3];
    for (int k = 0; k < 3; k++) {
        double extent = (double)shape->size.raw[k];
        size[k] = extent > THINNEST && isfinite(extent) ? extent : THINNEST;
    }
    GArray *points = outline_points(plant, shape, detail);
    if (points->len >= 2) {
        lay_pieces(mesh, points, size, fr_shape_segments(shape->detail, 3, 128, detail));
        mesh->is_foliage = g_array_index(points, Point, 0).radius > 0 ||
                           g_array_index(points, Point, points->len - 1).radius > 0;
    }
    g_array_unref(points);
}
