// Hydra and Wreath: children on a ring, as the arms of a star or the candles of a wreath.
//
// The ring goes from opening to closing; over a whole turn the last child stands one step before
// the first, not upon it. An arm grows away from the axis with its upper side along it; a candle
// grows along the axis with its upper side to it: an arm that was tilted by a quarter turn. What is
// oriented tangentially is turned about the axis by a quarter turn more, and what is oriented to
// the world as the child at azimuth 0.
#include "pgraph/spread.h"

#include <math.h>

#define TURN 6.283185307179586

typedef struct Star {
    FrSpread spread;
    const FrRingParams *params;
    uint32_t rings, each; // children of a ring
    double radius, opening, step, spacing, turn;
    double polar; // of a child without tilt
} Star;

// Between neighbours. A whole turn has as many gaps as children, a part of one has one less.
static double step_of(double opening, double closing, uint32_t n) {
    double turns = (closing - opening) / TURN;
    bool is_whole = fabs(turns - floor(turns + 0.5)) < 1e-9 && fabs(turns) > 0.5;
    uint32_t gaps = is_whole ? n : n - 1;
    return gaps > 0 ? (closing - opening) / gaps : 0;
}

static Star measure_star(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                         FrEvaluator *place) {
    Star star = {.spread = fr_spread_begin(expansion, row, evaluator, place)};
    const FrPrepared *prepared = &expansion->prepared[star.spread.stage->component];
    const FrRingParams *params = star.params = prepared->params;
#define FR_GET(field) fr_value(evaluator, &params->field, FR_RING_##field)
    star.rings = (uint32_t)params->rings;
    star.each = star.spread.count / star.rings;
    star.radius = FR_GET(radius) * star.spread.centre.scale;
    star.opening = FR_GET(opening);
    star.step = star.each > 0 ? step_of(star.opening, FR_GET(closing), star.each) : 0;
    star.spacing = FR_GET(ring_spacing) * star.spread.centre.scale;
    star.turn = FR_GET(ring_turn);
    star.polar = prepared->kind == FR_COMPONENT_HYDRA ? TURN / 4 : 0;
#undef FR_GET
    return star;
}

static FrPose pose_child(Star *star, uint32_t i) {
    const FrRingParams *params = star->params;
    FrEvaluator *place = star->spread.place;
    uint32_t ring = i / star->each;
#define FR_GET(field) fr_value(place, &params->field, FR_RING_##field)
    double azimuth = star->opening + (i % star->each) * star->step + ring * star->turn;
    azimuth -= TURN * floor(azimuth / TURN);
    double radius = star->radius;
    if (params->ring_curve != NULL) {
        double at = star->rings > 1 ? (double)ring / (star->rings - 1) : 0;
        radius *= fr_curve_eval(params->ring_curve, at);
    }
    radius += FR_GET(push) * star->spread.centre.scale;
    vec3s by = {{(float)(radius * cos(azimuth)), (float)(radius * sin(azimuth)),
                 (float)(ring * star->spacing)}};
    double facing = params->orient == FR_ORIENT_RADIAL       ? azimuth
                    : params->orient == FR_ORIENT_TANGENTIAL ? azimuth + TURN / 4
                                                             : 0;
    versors turn = fr_turned_zyz(facing, star->polar - FR_GET(tilt), TURN / 4 + FR_GET(roll));
    return fr_spread_site(&star->spread, by, turn, FR_GET(child_scale));
#undef FR_GET
}

void fr_make_star(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                  FrEvaluator *place) {
    Star star = measure_star(expansion, row, evaluator, place);
    for (uint32_t i = 0; i < star.spread.count; i++) {
        if (fr_spread_wants(&star.spread, i)) {
            fr_spread_enter(&star.spread, i);
            fr_spread_write(&star.spread, i, pose_child(&star, i));
        }
    }
}
