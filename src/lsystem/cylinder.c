// Generalized cylinders: control points joined by Hermite curves or steered by a uniform cubic
// B-spline. Each becomes an axis with a node at the end of each strip.
#include "lsystem/build.h"

#include <math.h>

#define MOST_STRIPS 100

/// A point of the curve.
typedef struct Sample {
    double position[3], width;
} Sample;

static double distance(const double a[3], const double b[3]) {
    double square = 0;
    for (int k = 0; k < 3; k++) {
        square += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return sqrt(square);
}

static Sample hermite(const FrLpoint *a, const FrLpoint *b, double t) {
    double chord = distance(a->position, b->position);
    double t2 = t * t, t3 = t2 * t;
    double h0 = 2 * t3 - 3 * t2 + 1, h1 = t3 - 2 * t2 + t, h2 = 3 * t2 - 2 * t3, h3 = t3 - t2;
    Sample sample = {.width = a->width + (b->width - a->width) * t};
    for (int k = 0; k < 3; k++) {
        sample.position[k] = h0 * a->position[k] + h1 * a->heading[k] * chord * a->leave +
                             h2 * b->position[k] + h3 * b->heading[k] * chord * b->arrive;
    }
    return sample;
}

static Sample spline(const FrLpoint *p[4], double t) {
    double u = 1 - t, t2 = t * t, t3 = t2 * t;
    double weight[4] = {u * u * u / 6, (3 * t3 - 6 * t2 + 4) / 6,
                        (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, t3 / 6};
    Sample sample = {.width = 0};
    for (int i = 0; i < 4; i++) {
        sample.width += weight[i] * p[i]->width;
        for (int k = 0; k < 3; k++) {
            sample.position[k] += weight[i] * p[i]->position[k];
        }
    }
    return sample;
}

static void add_samples(GArray *samples, FrLcylinderKind kind, const FrLpoint *points,
                        uint32_t count) {
    bool is_spline = kind >= FR_LSPLINE_OPEN;
    bool is_closed = kind == FR_LHERMITE_CLOSED || kind == FR_LSPLINE_CLOSED;
    uint32_t most = is_spline ? 3 : 1;
    uint32_t spans = is_closed ? count : count > most ? count - most : 0;
    for (uint32_t span = 0; span < spans; span++) {
        const FrLpoint *p[4];
        for (uint32_t i = 0; i < 4; i++) {
            p[i] = &points[(span + i) % count];
        }
        uint32_t strips = CLAMP(p[is_spline ? 3 : 1]->strips, 1, MOST_STRIPS);
        for (uint32_t s = span == 0 ? 0 : 1; s <= strips; s++) {
            double t = (double)s / strips;
            Sample sample = is_spline ? spline(p, t) : hermite(p[0], p[1], t);
            g_array_append_val(samples, sample);
        }
    }
}

static void set_profile(FrLbuilder *builder, uint32_t axis, int32_t contour) {
    for (guint i = 0; i < builder->view->contours->len; i++) {
        const FrLcontour *found = &g_array_index(builder->view->contours, FrLcontour, i);
        if (found->id != contour || contour == 0 || found->count < 2) {
            continue;
        }
        double(*points)[2] = g_malloc_n(found->count, sizeof *points);
        for (uint32_t p = 0; p < found->count; p++) {
            points[p][0] = found->points[p][0];
            points[p][1] = found->points[p][1];
        }
        builder->plant->axes.profile[axis] = fr_plant_add_profile(
            builder->plant, (const double(*)[2])points, found->count, found->is_closed);
        g_free(points);
        return;
    }
}

void fr_lbuilder_cylinder(FrLbuilder *builder, FrLpose *pose, FrLcylinderKind kind,
                          const FrLpoint *points, uint32_t count) {
    if (count < 2 || (kind >= FR_LSPLINE_OPEN && count < 4)) {
        return;
    }
    builder->drawn.cylinders++;
    GArray *samples = g_array_new(FALSE, FALSE, sizeof(Sample));
    add_samples(samples, kind, points, count);
    FrLpose walker = *pose;
    walker.is_lateral = true;
    bool is_first = true;
    memcpy(walker.last_heading, points[0].heading, sizeof walker.last_heading);
    memcpy(walker.last_up, points[0].up, sizeof walker.last_up);
    for (guint i = 1; i < samples->len && builder->status == FR_OK; i++) {
        const Sample *a = &g_array_index(samples, Sample, i - 1), *b = a + 1;
        FrLsegment segment = {.start_width = a->width, .end_width = b->width, .symbol = 'F'};
        for (int k = 0; k < 3; k++) {
            segment.start[k] = a->position[k];
            segment.end[k] = b->position[k];
            walker.heading[k] = b->position[k] - a->position[k];
        }
        if (!(fr_lvector_dot(walker.heading, walker.heading) > 0)) {
            continue;
        }
        // The frame that turns least about the curve (minimal rotation from strip to strip).
        fr_lvector_unit(walker.heading);
        fr_lturtle_untwist(&walker);
        memcpy(walker.last_heading, walker.heading, sizeof walker.heading);
        memcpy(walker.last_up, walker.up, sizeof walker.up);
        memcpy(segment.heading, walker.heading, sizeof segment.heading);
        memcpy(segment.left, walker.left, sizeof segment.left);
        if (is_first) {
            walker.is_at_tip = false; // the curve may begin beside the node
        }
        fr_lbuilder_segment(builder, &walker, &segment);
        builder->drawn.segments--; // not a segment of F or G
        builder->drawn.length -= distance(segment.start, segment.end);
        if (is_first && walker.node != FR_NONE && builder->status == FR_OK) {
            set_profile(builder, builder->plant->nodes.axis[walker.node], pose->contour);
            is_first = false;
        }
    }
    g_array_unref(samples);
}
