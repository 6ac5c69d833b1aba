// Generalized cylinders: which control points there are. Control points are joined by Hermite
// curves or steer a uniform cubic B-spline; a span is drawn as soon as its last point is known, so
// branches that open within continue a copy of what there is.
#include "lsystem/spline.h"

#include <math.h>

#define MOST_STRIPS 100
#define MOST_SPLINES 100000

static FrLtube *top(const FrLturtle *turtle) {
    return turtle->splines->len == 0
               ? NULL
               : &g_array_index(turtle->splines, FrLtube, turtle->splines->len - 1);
}

void fr_lspline_begin(FrLturtle *turtle, int kind, int strips) {
    if (kind < 1 || kind > 4) {
        return;
    }
    FrLtube spline = {.is_closed = kind % 2 == 0,
                      .is_b_spline = kind > 2,
                      .strips = strips > 0 ? (uint32_t)MIN(strips, MOST_STRIPS) : 4,
                      // The curve may begin beside the node.
                      .stand = (turtle->pose.stand & FR_LSTAND_NODE) | FR_LSTAND_LATERAL};
    if (turtle->pose.spline != 0) {
        *top(turtle) = spline;
    } else {
        g_array_append_val(turtle->splines, spline);
    }
    turtle->pose.spline = 1;
}

static FrLpoint point_of(const FrLpose *pose) {
    FrLpoint point = {.width = pose->width,
                      .arrive = pose->arrive,
                      .leave = pose->leave,
                      .scales_tangents = pose->scales_tangents,
                      .contour = pose->contour,
                      .sides = pose->sides};
    memcpy(point.position, pose->position, sizeof point.position);
    memcpy(point.heading, pose->heading, sizeof point.heading);
    memcpy(point.left, pose->left, sizeof point.left);
    memcpy(point.up, pose->up, sizeof point.up);
    memcpy(point.radius_tangents, pose->radius_tangents, sizeof point.radius_tangents);
    return point;
}

/// Remembers the points that begin a curve. True if the point is one of them.
static bool is_beginning(FrLtube *spline, const FrLpoint *point) {
    uint32_t needed = spline->is_b_spline ? 3 : 1;
    if (spline->count >= needed) {
        return false;
    }
    spline->first[spline->count] = *point;
    spline->recent[spline->count++] = *point;
    spline->last = *point;
    return true;
}

static void add_point(FrLturtle *turtle, FrLtube *spline, FrLpoint point, uint32_t strips) {
    FrLpoint target = point;
    if (is_beginning(spline, &point)) {
        return;
    }
    fr_lspline_draw(turtle, spline, &target, strips);
    spline->last = target;
    if (spline->is_b_spline) {
        spline->recent[0] = spline->recent[1];
        spline->recent[1] = spline->recent[2];
        spline->recent[2] = point;
    }
    spline->count++;
}

void fr_lspline_point(FrLturtle *turtle, int strips) {
    FrLtube *spline = top(turtle);
    if (turtle->pose.spline == 0 || spline == NULL) {
        return;
    }
    uint32_t count = strips == 0 ? spline->strips : (uint32_t)CLAMP(strips, 1, MOST_STRIPS);
    add_point(turtle, spline, point_of(&turtle->pose), count);
    uint32_t node = fr_lstand_node(spline->stand);
    if (node != FR_NONE && !spline->is_b_spline) {
        turtle->pose.stand = node | FR_LSTAND_LATERAL | (spline->count > 1 ? FR_LSTAND_TIP : 0);
    }
}

void fr_lspline_end(FrLturtle *turtle) {
    FrLtube *spline = top(turtle);
    if (turtle->pose.spline == 0 || spline == NULL) {
        return;
    }
    uint32_t needed = spline->is_b_spline ? 3 : 1;
    for (uint32_t i = 0; i < needed && spline->is_closed && spline->count >= needed; i++) {
        add_point(turtle, spline, spline->first[i], spline->strips);
    }
    turtle->pose.spline = 0;
    g_array_set_size(turtle->splines, turtle->splines->len - 1);
}

// The curves of brackets lie on the stack above those around them. A bracket that closed the curve
// it was given has taken its copy away itself.
void fr_lspline_push(FrLturtle *turtle) {
    FrLtube *spline = top(turtle);
    if (spline == NULL || turtle->splines->len >= MOST_SPLINES) {
        turtle->pose.spline = 0;
        return;
    }
    FrLtube copy = *spline;
    copy.stand |= FR_LSTAND_LATERAL;
    g_array_append_val(turtle->splines, copy);
}

void fr_lspline_pop(FrLturtle *turtle) {
    if (turtle->splines->len > 0) {
        g_array_set_size(turtle->splines, turtle->splines->len - 1);
    }
}

static void set_radius_tangents(FrLpose *pose, const uint32_t *module) {
    unsigned count = fr_lhead_count(*module);
    if (count == 1) {
        pose->scales_tangents = fr_lword_float(module[1]) != 0;
    }
    for (unsigned side = 0; side < 2 && count >= 2; side++) {
        unsigned k = side == 1 && count >= 4 ? 2 : 0;
        double angle = fr_lturtle_value(module, k, 0) / 180 * G_PI;
        double length = fr_lturtle_value(module, k + 1, 0);
        bool is_finite = isfinite(angle) && fabs(length) < 1e9;
        pose->radius_tangents[side][0] = is_finite ? (float)(cos(angle) * length) : 0;
        pose->radius_tangents[side][1] = is_finite ? (float)(sin(angle) * length) : 0;
    }
}

static float tangent_of(const uint32_t *module, unsigned k, float otherwise) {
    float value = (float)fr_lturtle_value(module, k, (double)otherwise);
    return fabsf(value) < 1e6F ? value : otherwise;
}

void fr_lspline_obey(FrLturtle *turtle, char symbol, const uint32_t *module) {
    FrLpose *pose = &turtle->pose;
    int strips = 0;
    if (fr_lhead_count(*module) > 0) {
        strips = MAX(fr_lturtle_int(fr_lturtle_value(module, 0, 1)), 1);
    }
    switch (symbol) {
    case 's':
        fr_lspline_begin(turtle, 1, 0);
        pose->spline = 2;
        fr_lspline_point(turtle, 0);
        break;
    case 'c':
    case 'e':
        if (pose->spline == 0) {
            fr_lspline_begin(turtle, 1, 0);
        }
        fr_lspline_point(turtle, strips);
        if (symbol == 'e') {
            fr_lspline_end(turtle);
        }
        break;
    case 't':
        if (fr_lhead_count(*module) > 0) {
            pose->arrive = tangent_of(module, 0, 1.2F);
            pose->leave = tangent_of(module, 1, pose->arrive);
        }
        break;
    case 'r':
        set_radius_tangents(pose, module);
        break;
    default:
        break;
    }
}
