// Segments and boxes by separating axes (Gottschalk, Lin, Manocha 1996). The boxes are the eight
// octants of a cube, which share most of the work: of each axis of the cube there are two places,
// of each axis across the segment four. Without branches, so that several segments are tested at
// once.
#include "light/segments.h"

// The octants on the near and the far side of the cell in x, y and z.
static const int32_t sides[3][2] = {{0x55, 0xaa}, {0x33, 0xcc}, {0x0f, 0xf0}};

static inline int32_t if_within(float value, float most, int32_t octants) {
    return fabsf(value) <= most ? octants : 0;
}

static void test_sides(const FrSegments *segments, uint32_t count, float quarter, int axis,
                       int32_t *restrict octants) {
    const float *restrict middle = segments->middle[axis], *restrict half = segments->half[axis];
    const float *restrict slack = segments->slack;
    const int32_t near = sides[axis][0], far = sides[axis][1];
    for (uint32_t i = 0; i < count; i++) {
        float most = quarter + half[i] + slack[i];
        octants[i] &=
            if_within(middle[i] + quarter, most, near) | if_within(middle[i] - quarter, most, far);
    }
}

// Across the segment and the axis that is neither `a` nor `b`.
static void test_across(const FrSegments *segments, uint32_t count, float quarter, int a, int b,
                        int32_t *restrict octants) {
    const float *restrict at_a = segments->middle[a], *restrict at_b = segments->middle[b];
    const float *restrict way_a = segments->way[a], *restrict way_b = segments->way[b];
    const float *restrict slack = segments->slack;
    const int32_t near_near = sides[a][0] & sides[b][0], near_far = sides[a][0] & sides[b][1];
    const int32_t far_near = sides[a][1] & sides[b][0], far_far = sides[a][1] & sides[b][1];
    for (uint32_t i = 0; i < count; i++) {
        float most = (quarter + slack[i]) * (fabsf(way_a[i]) + fabsf(way_b[i]));
        float across = at_a[i] * way_b[i] - at_b[i] * way_a[i];
        float step_a = quarter * way_b[i], step_b = quarter * way_a[i];
        octants[i] &= if_within(across + step_a - step_b, most, near_near) |
                      if_within(across + step_a + step_b, most, near_far) |
                      if_within(across - step_a - step_b, most, far_near) |
                      if_within(across - step_a + step_b, most, far_far);
    }
}

void fr_segments_octants(const FrSegments *segments, uint32_t count, float quarter,
                         int32_t *octants) {
    for (uint32_t i = 0; i < count; i++) {
        octants[i] = 0xff;
    }
    for (int axis = 0; axis < 3; axis++) {
        test_sides(segments, count, quarter, axis, octants);
        test_across(segments, count, quarter, axis, (axis + 1) % 3, octants);
    }
}
