// Revo: an outline turned about the z axis.
#include "pgraph/instance.h"
#include "pgraph/revolved.h"

#include <math.h>

// Where the ends are not on the axis but shall be closed, the outline goes on to it.
static void close_ends(GArray *points) {
    FrOutlinePoint first = g_array_index(points, FrOutlinePoint, 0);
    FrOutlinePoint last = g_array_index(points, FrOutlinePoint, points->len - 1);
    if (first.radius > 0) {
        first.radius = 0;
        g_array_prepend_val(points, first);
    }
    if (last.radius > 0) {
        last.radius = 0;
        g_array_append_val(points, last);
    }
}

// The volume within the outline, counted negative where its outer side is on the wrong one.
static double volume(const GArray *points) {
    double sum = 0;
    for (guint k = 0; k + 1 < points->len; k++) {
        const FrOutlinePoint *at = &g_array_index(points, FrOutlinePoint, k);
        double a = at[0].radius, b = at[1].radius;
        sum += (a * a + a * b + b * b) * (at[1].height - at[0].height);
    }
    return sum;
}

static void reverse(GArray *points) {
    for (guint k = 0; k < points->len / 2; k++) {
        FrOutlinePoint *a = &g_array_index(points, FrOutlinePoint, k);
        FrOutlinePoint *b = &g_array_index(points, FrOutlinePoint, points->len - 1 - k);
        FrOutlinePoint kept = *a;
        *a = *b;
        *b = kept;
    }
}

// The points as a profile of the plant, as those of a blade: along, half width.
static uint32_t add_outline(FrPlant *plant, const GArray *points, double widest, double low,
                            double high) {
    double(*made)[2] = g_malloc_n(points->len, sizeof *made);
    for (guint k = 0; k < points->len; k++) {
        FrOutlinePoint point = g_array_index(points, FrOutlinePoint, k);
        made[k][0] = high > low ? (point.height - low) / (high - low) : 0;
        made[k][1] = widest > 0 ? 0.5 * point.radius / widest : 0;
    }
    uint32_t profile = fr_plant_add_profile(plant, (const double(*)[2])made, points->len, false);
    g_free(made);
    return profile;
}

void fr_prepare_revo(FrPrepared *made, FrPlant *plant) {
    const FrRevoParams *revo = made->params;
    FR_ASSERT(revo->outline.count >= 2);
    GArray *points =
        fr_outline_points((const double(*)[2])revo->outline.at, revo->outline.count, revo->smooth);
    double widest = 0, low = INFINITY, high = -INFINITY;
    for (guint k = 0; k < points->len; k++) {
        FrOutlinePoint point = g_array_index(points, FrOutlinePoint, k);
        widest = fmax(widest, point.radius);
        low = fmin(low, point.height);
        high = fmax(high, point.height);
    }
    double end = g_array_index(points, FrOutlinePoint, points->len - 1).height;
    if (revo->ends == FR_ENDS_CLOSED) {
        close_ends(points);
    }
    if (volume(points) < 0) {
        reverse(points);
    }
    FrShape shape = {
        .kind = FR_SHAPE_REVOLUTION,
        .size = {{(float)(2 * widest) * revo->size.x, (float)(2 * widest) * revo->size.y,
                  (float)(high - low) * revo->size.z}},
        .detail = (uint32_t)revo->detail,
        .outline = add_outline(plant, points, widest, low, high),
    };
    made->shape = fr_plant_add_shape(plant, &shape);
    made->low = low * (double)revo->size.z;
    made->top = end * (double)revo->size.z;
    g_array_unref(points);
}

void fr_make_revo(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    static const versors identity = {{0, 0, 0, 1}};
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = &expansion->prepared[fr_instance_stage(expansion, row)->component];
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    vec3s low = {{0, 0, (float)(prepared->low * pose.scale)}};
    vec3s top = {{0, 0, (float)(prepared->top * pose.scale)}};
    fr_write_organ(expansion, row, level->organ_count[row], fr_pose_moved(pose, low, identity),
                   prepared->shape);
    FrChild child = fr_single_child(expansion, row, fr_pose_moved(pose, top, identity));
    fr_make_single_children(expansion, row, child, level->child_count[row]);
}
