// A span of a generalized cylinder: points of its curve, radii along it, its rings, and what the
// plant gets of it.
#include "lsystem/spline.h"

#include <math.h>

#define SHORTEST 1e-5

/// A span, ready to be evaluated.
typedef struct Span {
    const FrLpoint *from, *to;
    double length; ///< of the chord
    double curve[3][4];
    double radius[2][4]; ///< the parameter of the curve and the radius, over the span
    double twist;
} Span;

static double cubic(const double c[4], double t) {
    return ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
}

static double slope(const double c[4], double t) {
    return (3 * c[3] * t + 2 * c[2]) * t + c[1];
}

static double distance(const double a[3], const double b[3]) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        square += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return sqrt(square);
}

static void set_hermite(Span *span) {
    for (int k = 0; k < 3; k++) {
        double a = span->from->position[k], b = span->to->position[k];
        double out = span->from->heading[k] * span->length * (double)span->from->leave;
        double in = span->to->heading[k] * span->length * (double)span->to->arrive;
        double curve[4] = {a, out, 3 * (b - a) - 2 * out - in, 2 * (a - b) + out + in};
        memcpy(span->curve[k], curve, sizeof curve);
    }
}

static void set_b_spline(Span *span, const FrLpoint recent[3], const FrLpoint *target) {
    for (int k = 0; k < 3; k++) {
        double a = recent[0].position[k], b = recent[1].position[k], c = recent[2].position[k];
        double curve[4] = {(a + 4 * b + c) / 6, (c - a) / 2, (a - 2 * b + c) / 2,
                           (target->position[k] - a + 3 * (b - c)) / 6};
        memcpy(span->curve[k], curve, sizeof curve);
    }
}

// A cubic in (parameter, radius) with the tangents of @Gr; straight where there are none.
static void set_radius(Span *span) {
    double start = (double)span->from->width / 2, rise = (double)span->to->width / 2 - start;
    double out[2], in[2];
    for (int k = 0; k < 2; k++) {
        double scale = k == 1 && span->to->scales_tangents ? span->length : 1;
        out[k] = (double)span->from->radius_tangents[1][k] * scale;
        in[k] = (double)span->to->radius_tangents[0][k] * scale;
    }
    if (out[0] == 0 && out[1] == 0) {
        out[0] = 1;
        out[1] = rise;
    }
    if (in[0] == 0 && in[1] == 0) {
        in[0] = 1;
        in[1] = rise;
    }
    double parameter[4] = {0, out[0], 3 - 2 * out[0] - in[0], out[0] + in[0] - 2};
    double radius[4] = {start, out[1], 3 * rise - 2 * out[1] - in[1], out[1] + in[1] - 2 * rise};
    memcpy(span->radius[0], parameter, sizeof parameter);
    memcpy(span->radius[1], radius, sizeof radius);
}

/// The point of a uniform B-spline beside `b`, in the direction of its curve there.
static FrLpoint b_spline_point(const FrLpoint *a, const FrLpoint *b, const FrLpoint *c,
                               double twist) {
    FrLpoint point = *b;
    double heading[3];
    for (int k = 0; k < 3; k++) {
        point.position[k] = (a->position[k] + 4 * b->position[k] + c->position[k]) / 6;
        heading[k] = (c->position[k] - a->position[k]) / 2;
    }
    if (fr_lvector_dot(heading, heading) > 1e-14) {
        fr_lvector_unit(heading);
        memcpy(point.heading, heading, sizeof heading);
        fr_lpoint_untwist(&point, b, twist);
    }
    return point;
}

/// Roll of `to` against the frame that comes from `from` with the least twist.
static double twist_between(const FrLpoint *from, const FrLpoint *to) {
    FrLpoint carried = *to;
    double cross[3];
    fr_lpoint_untwist(&carried, from, 0);
    fr_lvector_cross(to->up, carried.up, cross);
    double angle = asin(MIN(sqrt(fr_lvector_dot(cross, cross)), 1));
    angle = fr_lvector_dot(to->up, carried.up) < 0 ? G_PI - angle : angle;
    return fr_lvector_dot(to->left, carried.up) < 0 ? -angle : angle;
}

/// The point at `r` of 0 … 1; its width is twice the radius there.
static FrLpoint sample(const Span *span, double r) {
    if (r >= 1) {
        return *span->to;
    }
    FrLpoint point = *span->from;
    double t = cubic(span->radius[0], r), heading[3];
    for (int k = 0; k < 3; k++) {
        point.position[k] = cubic(span->curve[k], t);
        heading[k] = slope(span->curve[k], t);
    }
    point.width = (float)(2 * cubic(span->radius[1], r));
    if (fr_lvector_dot(heading, heading) > 0) {
        fr_lvector_unit(heading);
        memcpy(point.heading, heading, sizeof heading);
    }
    fr_lpoint_untwist(&point, span->from, span->twist * t);
    return point;
}

// ---- rings ------------------------------------------------------------------------------------

static const FrLcontour *find_contour(const FrLview *view, int32_t id) {
    for (guint i = 0; i < view->contours->len && id != 0; i++) {
        const FrLcontour *found = &g_array_index(view->contours, FrLcontour, i);
        if (found->id == id && found->count >= 2) {
            return found;
        }
    }
    return NULL;
}

/// Point i of `sides` at equal distances around a contour; the circle if it is NULL.
static void contour_point(const FrLcontour *contour, uint32_t i, uint32_t sides, double out[2]) {
    double part = (double)i / sides;
    if (contour == NULL) {
        out[0] = cos(2 * G_PI * part);
        out[1] = sin(2 * G_PI * part);
        return;
    }
    double(*points)[3] = contour->points;
    double left = part * contour->length;
    uint32_t count = contour->count, p = 0, next = 1 % count;
    double step = distance(points[0], points[next]);
    while (left > step && p + 2 < count + contour->is_closed) {
        left -= step;
        p++;
        next = (p + 1) % count;
        step = distance(points[p], points[next]);
    }
    double t = step > 0 ? MIN(left / step, 1) : 0;
    double x = points[p][0] + t * (points[next][0] - points[p][0]);
    double y = points[p][1] + t * (points[next][1] - points[p][1]);
    double turn[2] = {points[0][0], points[0][1]};
    double size = hypot(turn[0], turn[1]);
    bool turns = contour->is_closed && size > 1e-4; // the first point comes to lie on the x axis
    out[0] = turns ? (x * turn[0] + y * turn[1]) / size : x;
    out[1] = turns ? (y * turn[0] - x * turn[1]) / size : y;
}

/// Counts the ring at a point into the bounding box.
static void include_ring(FrLbuilder *builder, const Span *span, const FrLpoint *point, double t) {
    const FrLcontour *a = find_contour(builder->view, span->from->contour);
    const FrLcontour *b = find_contour(builder->view, span->to->contour);
    double radius = (double)point->width / 2;
    for (uint32_t i = 0; i < point->sides; i++) {
        double p[2], q[2], at[3];
        contour_point(a, i, point->sides, p);
        contour_point(b, i, point->sides, q);
        for (int k = 0; k < 3; k++) {
            at[k] = point->position[k] + radius * ((p[0] + t * (q[0] - p[0])) * point->up[k] -
                                                   (p[1] + t * (q[1] - p[1])) * point->left[k]);
        }
        fr_lbuilder_include(builder, at);
    }
}

// ---- what the plant gets ----------------------------------------------------------------------

static void set_profile(FrLbuilder *builder, uint32_t axis, const FrLcontour *contour) {
    builder->plant->axes.profile[axis] = FR_NONE;
    if (contour == NULL) {
        return;
    }
    double(*points)[2] = g_malloc_n(contour->count, sizeof *points);
    for (uint32_t p = 0; p < contour->count; p++) {
        points[p][0] = contour->points[p][0];
        points[p][1] = contour->points[p][1];
    }
    builder->plant->axes.profile[axis] = fr_plant_add_profile(
        builder->plant, (const double(*)[2])points, contour->count, contour->is_closed);
    g_free(points);
}

static void add_node(FrLbuilder *builder, FrLtube *spline, const FrLsegment *segment,
                     const FrLpoint *from, const FrLpoint *to) {
    uint32_t axes = builder->axes;
    fr_lbuilder_node(builder, &spline->stand, segment, (float[2]){from->width, to->width},
                     to->position);
    if (builder->axes > axes) {
        set_profile(builder, axes, find_contour(builder->view, spline->last.contour));
    }
}

static void add_strip(FrLturtle *turtle, FrLtube *spline, const FrLpoint *from,
                      const FrLpoint *to) {
    FrLbuilder *builder = turtle->builder;
    FrLpoint frame = *to;
    for (int k = 0; k < 3; k++) {
        frame.heading[k] = to->position[k] - from->position[k];
    }
    double square = fr_lvector_dot(frame.heading, frame.heading);
    if (!(square > 0)) {
        return;
    }
    fr_lvector_unit(frame.heading);
    fr_lpoint_untwist(&frame, from, 0);
    FrLsegment segment = {.start = from->position,
                          .heading = frame.heading,
                          .left = frame.left,
                          .length = sqrt(square),
                          .module = builder->module,
                          .maker = builder->maker,
                          .colour = turtle->pose.colour};
    if (builder->view->style != FR_LSTYLE_CYLINDER) {
        // Lines and flat strips are drawn as segments and end the one that was begun.
        turtle->has_segment = false;
        fr_lbuilder_count(builder, segment.length, to->width);
        fr_lbuilder_include(builder, to->position);
    }
    add_node(builder, spline, &segment, from, to);
}

static void draw(FrLturtle *turtle, FrLtube *spline, const Span *span, uint32_t strips) {
    FrLbuilder *builder = turtle->builder;
    bool is_cylinder = builder->view->style == FR_LSTYLE_CYLINDER;
    FrLpoint before = *span->from;
    builder->drawn.cylinders++;
    if (is_cylinder) {
        include_ring(builder, span, &before, 0);
    }
    for (uint32_t i = 1; i <= strips && builder->status == FR_OK; i++) {
        double r = (double)i / strips;
        FrLpoint point = sample(span, r);
        add_strip(turtle, spline, &before, &point);
        if (is_cylinder) {
            include_ring(builder, span, &point, i == strips ? 1 : cubic(span->radius[0], r));
        }
        before = point;
    }
    turtle->status = MAX(turtle->status, builder->status);
}

void fr_lspline_draw(FrLturtle *turtle, FrLtube *spline, FrLpoint *target, uint32_t strips) {
    const FrLview *view = turtle->view;
    Span span = {.twist = 0};
    FrLpoint to = *target;
    if (view->twists) {
        span.twist = twist_between(&spline->last, target);
    } else {
        fr_lpoint_untwist(target, &spline->last, 0);
        to = *target;
    }
    if (spline->is_b_spline) {
        const FrLpoint *recent = spline->recent;
        if (spline->count == 3) {
            spline->last = b_spline_point(&recent[0], &recent[1], &recent[2], 0);
        }
        to = b_spline_point(&recent[1], &recent[2], target, span.twist);
    }
    span.from = &spline->last;
    span.to = &to;
    span.length = distance(spline->last.position, to.position);
    if (!(span.length >= SHORTEST) || turtle->builder == NULL) {
        return;
    }
    if (spline->is_b_spline) {
        set_b_spline(&span, spline->recent, target);
        *target = to;
    } else {
        set_hermite(&span);
    }
    set_radius(&span);
    draw(turtle, spline, &span, strips);
}
