// Polygons, surfaces, spheres and discs become organs. Triangles are kept in units of their
// extent and rounded a little, so that leaves of one form share one shape.
#include "lsystem/build.h"

#include <math.h>

#define ROUNDING 4096.0
#define MOST_TRIANGLES 2600
#define RING_SIDES 24
#define MOST_CORNERS 512 // of a polygon that is cut into ears; longer ones become fans

static uint32_t add_mesh(FrLbuilder *builder, const float (*corners)[3], uint32_t count,
                         double extent, double stretch[3]) {
    FrPlant *plant = builder->plant;
    double(*points)[2] = g_malloc0_n(2 * (size_t)count, sizeof *points);
    for (uint32_t i = 0; i < count; i++) {
        double c[3];
        for (int k = 0; k < 3; k++) {
            c[k] = round((double)corners[i][k] / extent * ROUNDING) / ROUNDING + 0.0;
        }
        points[2 * i][0] = c[0];
        points[2 * i][1] = c[1];
        points[2 * i + 1][0] = c[2];
    }
    FrShape shape;
    memset(&shape, 0, sizeof shape);
    shape.kind = FR_SHAPE_MESH;
    shape.detail = fr_plant_add_profile(plant, (const double(*)[2])points, 2 * count, false);
    shape.size = (vec3s){{(float)stretch[0], (float)stretch[1], (float)stretch[2]}};
    g_free(points);
    FrStatus status = fr_lbuilder_limit(builder, plant->shapes->len + UINT64_C(1),
                                        builder->context->limits.shapes, "shapes", "the string");
    if (status != FR_OK) {
        builder->status = MAX(builder->status, status);
        return FR_NONE;
    }
    return fr_plant_add_shape(plant, &shape);
}

static double extent_of(const float (*corners)[3], uint32_t count) {
    double most = 0;
    for (uint32_t i = 0; i < count; i++) {
        double x = corners[i][0], y = corners[i][1], z = corners[i][2];
        most = fmax(most, x * x + y * y + z * z);
    }
    return sqrt(most);
}

// ---- polygons ---------------------------------------------------------------------------------

/// Area times two and direction of a polygon (Newell's method).
static void normal_of(const double (*at)[3], uint32_t count, double normal[3]) {
    normal[0] = normal[1] = normal[2] = 0;
    for (uint32_t i = 0, j = count - 1; i < count; j = i++) {
        normal[0] += (at[j][1] - at[i][1]) * (at[j][2] + at[i][2]);
        normal[1] += (at[j][2] - at[i][2]) * (at[j][0] + at[i][0]);
        normal[2] += (at[j][0] - at[i][0]) * (at[j][1] + at[i][1]);
    }
}

/// Twice the signed area of a triangle as seen along the normal.
static double area(const double a[3], const double b[3], const double c[3],
                   const double normal[3]) {
    double u[3], v[3], cross[3];
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    fr_lvector_cross(u, v, cross);
    return fr_lvector_dot(cross, normal);
}

static bool is_ear(const double (*at)[3], const uint32_t *left, uint32_t count, uint32_t i,
                   const double normal[3]) {
    uint32_t a = left[(i + count - 1) % count], b = left[i], c = left[(i + 1) % count];
    if (area(at[a], at[b], at[c], normal) <= 0) {
        return false;
    }
    for (uint32_t k = 0; k < count; k++) {
        uint32_t p = left[k];
        if (p != a && p != b && p != c && area(at[a], at[b], at[p], normal) > 0 &&
            area(at[b], at[c], at[p], normal) > 0 && area(at[c], at[a], at[p], normal) > 0) {
            return false;
        }
    }
    return true;
}

static void put_triangle(GArray *out, const double a[3], const double b[3], const double c[3]) {
    const double *corners[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        float corner[3] = {(float)corners[i][0], (float)corners[i][1], (float)corners[i][2]};
        g_array_append_vals(out, corner, 1);
    }
}

// Ears are cut off until a triangle is left (Meisters 1975).
static void triangulate(const double (*at)[3], uint32_t count, GArray *out) {
    if (count < 3) {
        return;
    }
    double normal[3];
    normal_of(at, count, normal);
    if (count > MOST_CORNERS) {
        for (uint32_t i = 1; i + 1 < count; i++) {
            put_triangle(out, at[0], at[i], at[i + 1]);
        }
        return;
    }
    uint32_t left[MOST_CORNERS];
    for (uint32_t i = 0; i < count; i++) {
        left[i] = i;
    }
    while (count > 2) {
        uint32_t ear = 0;
        while (ear < count && !is_ear(at, left, count, ear, normal)) {
            ear++;
        }
        ear = ear == count ? 0 : ear; // crossed or flat: any corner goes
        put_triangle(out, at[left[(ear + count - 1) % count]], at[left[ear]],
                     at[left[(ear + 1) % count]]);
        count--;
        memmove(left + ear, left + ear + 1, (count - ear) * sizeof *left);
    }
}

/// A point in the axes of a pose: left, −up (that is heading × left), heading.
static void localize(const FrLpose *pose, const double point[3], double out[3]) {
    double d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = point[k] - pose->position[k];
    }
    out[0] = fr_lvector_dot(d, pose->left);
    out[1] = -fr_lvector_dot(d, pose->up);
    out[2] = fr_lvector_dot(d, pose->heading);
}

// Puts the corners on a grid, in its units, and leaves out those that repeat; how many are left.
static uint32_t settle(double (*at)[3], uint32_t count, double *unit) {
    double most = 0;
    for (uint32_t i = 0; i < count; i++) {
        most = fmax(most, fr_lvector_dot(at[i], at[i]));
    }
    double grid = sqrt(most) / ROUNDING;
    *unit = grid;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count && grid > 0; i++) {
        double corner[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = round(at[i][k] / grid) + 0.0;
        }
        if (kept == 0 || memcmp(corner, at[kept - 1], sizeof corner) != 0) {
            memcpy(at[kept++], corner, sizeof corner);
        }
    }
    return kept > 1 && memcmp(at[0], at[kept - 1], sizeof at[0]) == 0 ? kept - 1 : kept;
}

/// Places triangles that are given in the axes of the pose and in such units.
static void add_parts(FrLbuilder *builder, const FrLpose *pose, const float (*corners)[3],
                      uint32_t count, double stretch[3], double unit) {
    uint32_t material = fr_lbuilder_material(builder, pose, builder->leaf);
    for (uint32_t first = 0; first < count; first += 3 * MOST_TRIANGLES) {
        uint32_t part = MIN(count - first, 3 * MOST_TRIANGLES);
        double extent = extent_of(corners + first, part);
        if (extent > 0 && isfinite(extent) && builder->status == FR_OK) {
            uint32_t shape = add_mesh(builder, corners + first, part, extent, stretch);
            if (shape != FR_NONE) {
                fr_lbuilder_organ(builder, pose, pose->position, shape, extent * unit, material);
            }
        }
    }
}

void fr_lbuilder_triangles(FrLbuilder *builder, const FrLpose *pose, const double (*corners)[3],
                           uint32_t count) {
    builder->drawn.surfaces++;
    float(*local)[3] = g_malloc_n(count, sizeof *local);
    for (uint32_t i = 0; i < count; i++) {
        double at[3];
        localize(pose, corners[i], at);
        for (int k = 0; k < 3; k++) {
            local[i][k] = (float)at[k];
        }
        fr_lbuilder_include(builder, corners[i]);
    }
    add_parts(builder, pose, (const float(*)[3])local, count, (double[3]){1, 1, 1}, 1);
    g_free(local);
}

void fr_lbuilder_polygon(FrLbuilder *builder, const FrLpose *pose, const double (*points)[3],
                         uint32_t count) {
    if (count < 3) {
        return;
    }
    builder->drawn.polygons++;
    double(*local)[3] = g_malloc_n(count, sizeof *local);
    for (uint32_t i = 0; i < count; i++) {
        localize(pose, points[i], local[i]);
    }
    double unit;
    count = settle(local, count, &unit);
    GArray *corners = g_array_new(FALSE, FALSE, 3 * sizeof(float));
    triangulate((const double(*)[3])local, count, corners);
    add_parts(builder, pose, (const float(*)[3])(void *)corners->data, corners->len,
              (double[3]){1, 1, 1}, unit);
    g_array_unref(corners);
    g_free(local);
}

// ---- surfaces ---------------------------------------------------------------------------------

/// Counts control points of patches and corners of triangles into the bounding box.
static void include_surface(FrLbuilder *builder, const FrLpose *pose, const FrLsurface *surface,
                            const double scale[3]) {
    uint32_t count = surface->is_mesh ? surface->count : surface->hull_count;
    for (uint32_t i = 0; i < count; i++) {
        double at[3], p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = scale[k] *
                   (surface->is_mesh ? (double)surface->corners[i][k] : surface->hull[i][k]);
        }
        for (int k = 0; k < 3; k++) {
            at[k] = p[0] * pose->left[k] + p[1] * pose->heading[k] + p[2] * pose->up[k] +
                    pose->position[k];
        }
        fr_lbuilder_include(builder, at);
    }
}

void fr_lbuilder_surface(FrLbuilder *builder, const FrLpose *pose, const FrLsurface *surface,
                         const double scale[3]) {
    builder->drawn.surfaces++;
    if (scale[0] != 0 && scale[1] != 0 && scale[2] != 0) {
        include_surface(builder, pose, surface, scale);
    }
    double size = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    if (!(size > 0) || !isfinite(size)) {
        return;
    }
    // Axes of the surface are left, heading, up; those of an organ left, −up, heading.
    double stretch[3] = {scale[0] / size, scale[2] / size, scale[1] / size};
    float(*turned)[3] = g_malloc_n(surface->count, sizeof *turned);
    for (uint32_t i = 0; i < surface->count; i++) {
        const float *c = surface->corners[i];
        turned[i][0] = c[0];
        turned[i][1] = -c[2];
        turned[i][2] = c[1];
    }
    add_parts(builder, pose, (const float(*)[3])turned, surface->count, stretch, size);
    g_free(turned);
}

// ---- spheres and discs ------------------------------------------------------------------------

static void add_primitive(FrLbuilder *builder, const FrLpose *pose, double diameter,
                          FrShapeKind kind) {
    uint32_t material = fr_lbuilder_material(builder, pose, builder->leaf);
    if (!(diameter > 0) || !isfinite(diameter)) {
        return;
    }
    FrShape shape;
    memset(&shape, 0, sizeof shape);
    shape.kind = kind;
    shape.size = (vec3s){{1, 1, 1}};
    shape.detail = 16;
    double at[3];
    for (int k = 0; k < 3; k++) {
        at[k] = pose->position[k] - pose->heading[k] * diameter / 2;
    }
    fr_lbuilder_organ(builder, pose, at, fr_plant_add_shape(builder->plant, &shape), diameter,
                      material);
}

/// Counts a box about the turtle into the bounding box, `depth` in z.
static void include_around(FrLbuilder *builder, const double at[3], double radius, double depth) {
    fr_lbuilder_include(builder, (double[3]){at[0] - radius, at[1] - radius, at[2] - depth});
    fr_lbuilder_include(builder, (double[3]){at[0] + radius, at[1] + radius, at[2] + depth});
}

void fr_lbuilder_sphere(FrLbuilder *builder, const FrLpose *pose, double diameter) {
    builder->drawn.spheres++;
    include_around(builder, pose->position, diameter / 2, diameter / 2);
    add_primitive(builder, pose, diameter, FR_SHAPE_SPHERE);
}

static void add_ring(FrLbuilder *builder, const FrLpose *pose, double outer, double inner) {
    float corners[6 * RING_SIDES][3];
    for (int i = 0; i < RING_SIDES; i++) {
        static const int order[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
        for (int c = 0; c < 6; c++) {
            double angle = 2 * G_PI * (i + order[c][0]) / RING_SIDES;
            double radius = (order[c][1] != 0 ? outer : inner) / outer;
            float *corner = corners[6 * i + c];
            corner[0] = (float)(radius * cos(angle));
            corner[1] = 0;
            corner[2] = (float)(radius * sin(angle));
        }
    }
    add_parts(builder, pose, (const float(*)[3])corners, 6 * RING_SIDES, (double[3]){1, 1, 1},
              outer);
}

// cpfg counts discs as if they faced z, those that face the viewer at z 0.
void fr_lbuilder_disc(FrLbuilder *builder, const FrLpose *pose, double diameter, double hole,
                      bool faces_viewer) {
    double z = faces_viewer ? 0 : pose->position[2];
    builder->drawn.discs++;
    include_around(builder, (double[3]){pose->position[0], pose->position[1], z}, diameter / 2, 0);
    if (hole > 0 && diameter > hole && isfinite(diameter)) {
        add_ring(builder, pose, diameter / 2, hole / 2);
    } else {
        add_primitive(builder, pose, diameter, FR_SHAPE_CIRCLE);
    }
}
