// Scatter: children strewn over a disc, a square or a ring.
#include "pgraph/bluenoise.h"
#include "pgraph/spread.h"

#include "plant/frames.h"

#include <cglm/struct.h>
#include <math.h>

#define PI 3.14159265358979323846

enum { MOST_CANDIDATES = 20 };

static double area_of(const FrScatterParams *params, double radius, double inner) {
    switch (params->surface) {
    case FR_SCATTER_SQUARE:
        return 4 * radius * radius;
    case FR_SCATTER_RING:
        return PI * fabs(radius * radius - inner * inner);
    default:
        return PI * radius * radius;
    }
}

double fr_scatter_count(const FrScatterParams *params, FrEvaluator *evaluator) {
    if (params->mode == FR_SCATTER_BY_NUMBER) {
        return fr_value(evaluator, &params->number, FR_SCATTER_number);
    }
    double radius = fr_value(evaluator, &params->radius, FR_SCATTER_radius);
    double inner = fr_value(evaluator, &params->inner_radius, FR_SCATTER_inner_radius);
    return fr_value(evaluator, &params->density, FR_SCATTER_density) *
           area_of(params, radius, inner);
}

// The rotation from the surface to the world's upright, in the frame of the scatter.
static versors to_upright(const FrSpread *spread, double part) {
    versors frame = spread->centre.rotation;
    if (spread->centre.bearer != FR_NONE) {
        frame = fr_frame_step(spread->expansion->plant->nodes.frame[spread->centre.bearer], frame);
    }
    versors back = {{-frame.x, -frame.y, -frame.z, frame.w}};
    vec3s upright = fr_turned(back, (vec3s){{0, 0, 1}});
    float sine = hypotf(upright.x, upright.y);
    vec3s axis =
        sine > 1e-6f ? (vec3s){{-upright.y / sine, upright.x / sine, 0}} : (vec3s){{1, 0, 0}};
    return fr_rotation_about(axis, (float)part * atan2f(sine, upright.z));
}

void fr_make_scatter(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                     FrEvaluator *place) {
    FrSpread spread = fr_spread_begin(expansion, row, evaluator, place);
    const FrScatterParams *params = expansion->prepared[spread.stage->component].params;
    if (spread.count == 0) {
        return;
    }
    double radius = fr_value(evaluator, &params->radius, FR_SCATTER_radius);
    double inner = fr_value(evaluator, &params->inner_radius, FR_SCATTER_inner_radius);
    double widest = params->surface == FR_SCATTER_RING ? fmax(radius, inner) : radius;
    uint32_t candidates = (uint32_t)floor(1 + params->regularity * (MOST_CANDIDATES - 1) + 0.5);
    double(*points)[2] = g_malloc_n(spread.count, sizeof *points);
    fr_bluenoise(points, spread.count, (FrStrewnForm)params->surface,
                 widest > 0 ? fmin(radius, inner) / widest : 0, candidates,
                 fr_key_child(expansion->level.key[row], fr_purpose(FR_SCATTER_surface)));
    widest *= spread.centre.scale;
    versors upright = to_upright(&spread, 1 - params->align);
#define FR_GET(field) fr_value(place, &params->field, FR_SCATTER_##field)
    for (uint32_t i = 0; i < spread.count; i++) {
        if (!fr_spread_wants(&spread, i)) {
            continue;
        }
        fr_spread_enter(&spread, i);
        vec3s by = {{(float)(widest * points[i][0]), (float)(widest * points[i][1]),
                     (float)(FR_GET(push) * spread.centre.scale)}};
        versors turn = fr_turned_zyz(FR_GET(azimuth), FR_GET(tilt), PI / 2);
        fr_spread_write(
            &spread, i,
            fr_spread_site(&spread, by, fr_frame_step(upright, turn), FR_GET(child_scale)));
    }
#undef FR_GET
    g_free(points);
}
