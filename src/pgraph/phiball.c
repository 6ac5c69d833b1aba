// Phiball and Phyllotaxis: children spread over a surface of revolution by the golden section.
#include "pgraph/golden.h"
#include "pgraph/revolved.h"
#include "pgraph/spread.h"

#include <math.h>

#define PI 3.14159265358979323846

typedef struct Ball {
    FrSpread spread;
    const FrGoldenParams *params;
    const FrRevolved *revolved; // of a phyllotaxis; else the section of a sphere:
    double opening, closing;
    double radius, divergence, influence;
    double mean;   // of the children's squared scales
    double before; // area of the children so far
} Ball;

static double child_scale(Ball *ball) {
    return fr_value(ball->spread.place, &ball->params->child_scale, FR_GOLDEN_child_scale);
}

// Area of the section where its radius is 1, over 2π.
static double unit_area(const Ball *ball) {
    return ball->revolved != NULL ? fr_revolved_area(ball->revolved)
                                  : fabs(cos(ball->opening) - cos(ball->closing));
}

static double radius_of(const Ball *ball, FrEvaluator *evaluator) {
    const FrGoldenParams *params = ball->params;
    double n = ball->spread.count;
    switch (params->radius_mode) {
    case FR_RADIUS_BY_AREA:
        return fr_golden_radius(n, fr_value(evaluator, &params->child_area, FR_GOLDEN_child_area),
                                unit_area(ball));
    case FR_RADIUS_TOUCHING:
        return fr_golden_touching_radius(
            n, fr_value(evaluator, &params->child_radius, FR_GOLDEN_child_radius), unit_area(ball));
    default:
        return fr_value(evaluator, &params->radius, FR_GOLDEN_radius);
    }
}

static Ball measure_ball(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                         FrEvaluator *place) {
    Ball ball = {.spread = fr_spread_begin(expansion, row, evaluator, place)};
    const FrPrepared *prepared = &expansion->prepared[ball.spread.stage->component];
    const FrGoldenParams *params = ball.params = prepared->params;
    ball.revolved = prepared->revolved;
    ball.divergence = fr_value(evaluator, &params->divergence, FR_GOLDEN_divergence) *
                      (params->handedness == FR_HAND_LEFT ? 1 : -1);
    ball.influence = fr_value(evaluator, &params->influence, FR_GOLDEN_influence);
    bool is_at_pole = false;
    if (prepared->kind == FR_COMPONENT_PHIBALL) {
        const FrPhiballParams *phiball = prepared->params;
        ball.opening = fr_value(evaluator, &phiball->opening, FR_PHIBALL_opening);
        ball.closing = fr_value(evaluator, &phiball->closing, FR_PHIBALL_closing);
        is_at_pole = phiball->anchor == FR_ANCHOR_POLE;
    }
    FrPose *centre = &ball.spread.centre;
    ball.radius = radius_of(&ball, evaluator) * centre->scale;
    if (is_at_pole) {
        *centre =
            fr_pose_moved(*centre, (vec3s){{0, 0, -(float)ball.radius}}, (versors){{0, 0, 0, 1}});
    }
    return ball;
}

static void measure_mean(Ball *ball) {
    if (ball->influence == 0 || ball->params->child_scale.is_constant) {
        ball->influence = 0; // equal children: zones in closed form
        return;
    }
    double sum = 0;
    for (uint32_t i = 0; i < ball->spread.count; i++) {
        fr_spread_enter(&ball->spread, i);
        double scale = child_scale(ball);
        sum += scale * scale;
    }
    ball->mean = sum / ball->spread.count;
}

// Part of the section's area before child i; i rises by one from call to call.
static double area_before(Ball *ball, uint32_t i, double scale) {
    bool is_end = ball->params->placement == FR_PLACEMENT_END;
    if (ball->influence == 0) {
        return fr_golden_before(i, ball->spread.count, is_end);
    }
    double area = fr_golden_area(scale, ball->mean, ball->influence);
    double before = ball->before + (is_end ? area : 0.5 * area);
    ball->before += area;
    return before / (ball->mean * ball->spread.count);
}

// Where the share `before` of the area lies before, on the surface of radius 1.
static FrRevolvedPoint point_at(const Ball *ball, double before) {
    if (ball->revolved != NULL) {
        return fr_revolved_at(ball->revolved, before);
    }
    double polar = fr_golden_polar(ball->opening, ball->closing, before);
    return (FrRevolvedPoint){.radius = sin(polar), .height = cos(polar), .polar = polar};
}

static FrPose pose_child(Ball *ball, uint32_t i, FrRevolvedPoint point, double scale) {
    const FrGoldenParams *params = ball->params;
    FrEvaluator *place = ball->spread.place;
    double azimuth = fmod(i * ball->divergence, 2 * PI);
    double push = fr_value(place, &params->push, FR_GOLDEN_push) * ball->spread.centre.scale;
    double out = ball->radius * point.radius + push * sin(point.polar);
    double up = ball->radius * point.height + push * cos(point.polar);
    vec3s by = {{(float)(out * cos(azimuth)), (float)(out * sin(azimuth)), (float)up}};
    versors turn =
        fr_turned_zyz(azimuth, point.polar + fr_value(place, &params->tilt, FR_GOLDEN_tilt),
                      PI / 2 + fr_value(place, &params->roll, FR_GOLDEN_roll));
    return fr_spread_site(&ball->spread, by, turn, scale);
}

void fr_make_golden(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                    FrEvaluator *place) {
    Ball ball = measure_ball(expansion, row, evaluator, place);
    measure_mean(&ball);
    for (uint32_t i = 0; i < ball.spread.count; i++) {
        bool is_wanted = fr_spread_wants(&ball.spread, i);
        if (!is_wanted && ball.influence == 0) {
            continue;
        }
        fr_spread_enter(&ball.spread, i);
        double scale = child_scale(&ball);
        FrRevolvedPoint point = point_at(&ball, area_before(&ball, i, scale));
        if (is_wanted) {
            fr_spread_write(&ball.spread, i, pose_child(&ball, i, point, scale));
        }
    }
}
