// Points, lines, planes, vortices, curves and bodies that draw stems.
//
// A stem that follows a line is led as one steers along a road: in its direction while it is at
// the right distance, and the more towards it the farther it is off (pure pursuit). So it comes to
// the distance and stays there.
#include "pgraph/force.h"

#include "frond/distance.h"

#include <math.h>

typedef struct Source {
    double outward[3]; ///< unit, from the source to the point
    double along[3];   ///< unit or nothing: its own direction there
    double distance;   ///< from its surface; negative within
    bool has_distance; ///< it has a place
    bool keeps_distance;
} Source;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Makes a unit vector of v; false and nothing where it has no direction.
static bool normalize(double v[3]) {
    double size = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] = size > 1e-12 ? v[k] / size : 0;
    }
    return size > 1e-12;
}

void fr_field_local(const FrField *field, const double at[3], double local[3]) {
    for (int c = 0; c < 3; c++) {
        local[c] = 0;
        for (int r = 0; r < 3; r++) {
            local[c] += field->axes[r][c] * (at[r] - field->at[r]) / field->scale;
        }
    }
}

static void to_plant(const FrField *field, double v[3]) {
    double out[3];
    for (int r = 0; r < 3; r++) {
        out[r] = dot(field->axes[r], v);
    }
    for (int r = 0; r < 3; r++) {
        v[r] = out[r];
    }
}

// The nearest point of a polyline, and the direction there.
static void nearest_on(const GArray *path, const double at[3], double point[3], double along[3]) {
    double best = INFINITY;
    for (guint k = 0; k + 1 < path->len; k++) {
        vec3s a = g_array_index(path, vec3s, k), b = g_array_index(path, vec3s, k + 1);
        double chord[3], way[3];
        for (int r = 0; r < 3; r++) {
            chord[r] = (double)b.raw[r] - (double)a.raw[r];
            way[r] = at[r] - (double)a.raw[r];
        }
        double size = dot(chord, chord);
        double t = size > 0 ? fmax(0, fmin(dot(way, chord) / size, 1)) : 0;
        double square = 0;
        for (int r = 0; r < 3; r++) {
            double miss = way[r] - t * chord[r];
            square += miss * miss;
        }
        if (square <= best && size > 0) { // at a corner what comes next leads on
            best = square;
            for (int r = 0; r < 3; r++) {
                point[r] = (double)a.raw[r] + t * chord[r];
                along[r] = chord[r];
            }
        }
    }
}

static void from_axis(const double local[3], double radius, Source *source) {
    source->outward[0] = local[0];
    source->outward[1] = local[1];
    source->distance = sqrt(local[0] * local[0] + local[1] * local[1]) - radius;
    if (!normalize(source->outward)) {
        source->outward[0] = 1;
    }
}

static void from_point(const double local[3], const double centre[3], double radius,
                       Source *source) {
    for (int r = 0; r < 3; r++) {
        source->outward[r] = local[r] - centre[r];
    }
    source->distance = sqrt(dot(source->outward, source->outward)) - radius;
    if (!normalize(source->outward)) {
        source->outward[0] = 1;
    }
}

// A box, or the half of a disc of radius `half[0]` where `dimensions` is 2, that reaches from −half
// to half. Distances from boxes after: Quilez, Distance functions. `way` receives the way out.
static double from_corner(const double *at, const double *half, int dimensions, double *way) {
    double outside = 0, deepest = -INFINITY;
    int nearest = 0;
    for (int k = 0; k < dimensions; k++) {
        double over = fabs(at[k]) - half[k];
        outside += over > 0 ? over * over : 0;
        nearest = over > deepest ? k : nearest;
        deepest = fmax(over, deepest);
    }
    for (int k = 0; k < dimensions; k++) {
        double over = fabs(at[k]) - half[k];
        double part = deepest > 0 ? fmax(over, 0) : k == nearest;
        way[k] = at[k] < 0 ? -part : part;
    }
    return deepest > 0 ? sqrt(outside) : deepest;
}

static void from_box(const double local[3], vec3s size, Source *source) {
    double half[3], at[3];
    for (int r = 0; r < 3; r++) {
        half[r] = 0.5 * (double)size.raw[r];
        at[r] = local[r] - (r == 2 ? half[2] : 0);
    }
    source->distance = from_corner(at, half, 3, source->outward);
}

static void from_cylinder(const double local[3], vec3s size, Source *source) {
    double off = sqrt(local[0] * local[0] + local[1] * local[1]), way[2];
    double half[2] = {0.5 * (double)size.x, 0.5 * (double)size.z};
    double at[2] = {off, local[2] - half[1]};
    source->distance = from_corner(at, half, 2, way);
    source->outward[0] = way[0] * (off > 0 ? local[0] / off : 1);
    source->outward[1] = off > 0 ? way[0] * local[1] / off : 0;
    source->outward[2] = way[1];
}

// What of the heading goes along the surface.
static void project(const double heading[3], Source *source) {
    double rise = dot(heading, source->outward);
    for (int r = 0; r < 3; r++) {
        source->along[r] = heading[r] - rise * source->outward[r];
    }
    normalize(source->along);
}

// Bodies keep stems `radius` away; what is inverted is seen from within.
static void settle(const FrForceParams *params, double radius, Source *source) {
    normalize(source->outward);
    if (params->inverted) {
        source->distance = -source->distance;
        for (int r = 0; r < 3; r++) {
            source->outward[r] = -source->outward[r];
        }
    }
    source->distance -= params->kind >= FR_FORCE_TO_BOX ? radius : 0;
}

// The source at a point, all in its own coordinates. `heading` may be NULL.
static Source source_at(const FrField *force, const FrPrepared *prepared, const double local[3],
                        const double *heading) {
    static const double centre[3] = {0, 0, 0};
    const FrForceParams *params = prepared->params;
    Source source = {.has_distance = true, .keeps_distance = true};
    switch (params->kind) {
    case FR_FORCE_ALONG_DIRECTION:
        from_point(local, centre, 0, &source);
        for (int r = 0; r < 3; r++) {
            source.along[r] = (double)params->direction.raw[r];
        }
        normalize(source.along);
        source.has_distance = source.keeps_distance = false;
        break;
    case FR_FORCE_TO_POINT:
        from_point(local, centre, force->radius, &source);
        break;
    case FR_FORCE_TO_LINE:
        from_axis(local, force->radius, &source);
        source.along[2] = 1;
        break;
    case FR_FORCE_TO_PLANE:
        source.outward[2] = 1;
        source.distance = local[2] - force->radius;
        break;
    case FR_FORCE_IN_VORTEX:
        from_axis(local, force->radius, &source);
        source.along[0] = -source.outward[1] * cos(force->pitch);
        source.along[1] = source.outward[0] * cos(force->pitch);
        source.along[2] = sin(force->pitch);
        source.keeps_distance = force->radius > 0;
        break;
    case FR_FORCE_TO_BOX:
        from_box(local, params->size, &source);
        break;
    case FR_FORCE_TO_CYLINDER:
        from_cylinder(local, params->size, &source);
        break;
    case FR_FORCE_TO_MESH:
        source.distance = fr_distance_at(prepared->distance, local, source.outward);
        break;
    default: {
        double point[3] = {0, 0, 0};
        nearest_on(prepared->path, local, point, source.along);
        normalize(source.along);
        from_point(local, point, force->radius, &source);
        break;
    }
    }
    settle(params, force->radius, &source);
    bool has_own = params->kind == FR_FORCE_ALONG_DIRECTION || params->kind == FR_FORCE_TO_LINE ||
                   params->kind == FR_FORCE_IN_VORTEX || params->kind == FR_FORCE_TO_CURVE;
    if (!has_own && heading != NULL) {
        project(heading, &source);
    }
    return source;
}

static double weight_at(const FrForceParams *params, double distance) {
    double far = fabs(distance) / params->range;
    switch (params->falloff) {
    case FR_FALLOFF_LINEAR:
        return fmax(0, 1 - far);
    case FR_FALLOFF_INVERSE:
        return 1 / (1 + far);
    case FR_FALLOFF_GAUSS:
        return exp(-far * far);
    default:
        return 1;
    }
}

double fr_force_at(const FrField *force, const FrPrepared *prepared, const double at[3],
                   const double heading[3], double direction[3]) {
    const FrForceParams *params = prepared->params;
    double local[3], own[3];
    fr_field_local(force, at, local);
    for (int c = 0; c < 3; c++) {
        own[c] = 0;
        for (int r = 0; r < 3; r++) {
            own[c] += force->axes[r][c] * heading[r];
        }
    }
    Source source = source_at(force, prepared, local, own);
    double weight = weight_at(params, source.distance);
    // How much of the direction is towards the source, or away from it where it is too near.
    double towards = 0;
    if (source.keeps_distance && params->action != FR_ACTION_ALIGN) {
        towards = fmax(-1, fmin(source.distance / params->reach, 1));
    }
    double onward = sqrt(1 - towards * towards);
    if (params->action == FR_ACTION_AVOID && source.has_distance) {
        double near = fmax(0, fmin(1 - source.distance / params->reach, 1));
        weight *= near * near;
        towards = -1;
        onward = 0;
    } else if (params->action == FR_ACTION_PULL && source.keeps_distance) {
        weight *= fabs(towards);
        onward = 0;
    }
    for (int r = 0; r < 3; r++) {
        direction[r] = onward * source.along[r] - towards * source.outward[r];
    }
    normalize(direction);
    to_plant(force, direction);
    return weight;
}

double fr_force_clearance(const FrField *force, const FrPrepared *prepared, const double at[3],
                          double outward[3]) {
    double local[3];
    fr_field_local(force, at, local);
    Source source = source_at(force, prepared, local, NULL);
    for (int r = 0; r < 3; r++) {
        outward[r] = source.outward[r];
    }
    to_plant(force, outward);
    return source.has_distance ? source.distance * force->scale : INFINITY;
}
