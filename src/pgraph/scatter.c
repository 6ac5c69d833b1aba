// Scatter: children strewn over a disc, a square, a ring or the triangles of a file.
#include "pgraph/bluenoise.h"
#include "pgraph/spread.h"
#include "pgraph/strewn.h"

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

double fr_scatter_count(const FrPrepared *prepared, FrEvaluator *evaluator) {
    const FrScatterParams *params = prepared->params;
    const FrStrewnSurface *mesh = prepared->strewn;
    if (mesh != NULL && !(mesh->area > 0)) {
        return 0;
    }
    if (params->mode == FR_SCATTER_BY_NUMBER) {
        return fr_value(evaluator, &params->number, FR_SCATTER_number);
    }
    double density = fr_value(evaluator, &params->density, FR_SCATTER_density);
    if (mesh != NULL) {
        return density * mesh->area;
    }
    double radius = fr_value(evaluator, &params->radius, FR_SCATTER_radius);
    double inner = fr_value(evaluator, &params->inner_radius, FR_SCATTER_inner_radius);
    return density * area_of(params, radius, inner);
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

// Part of the turn from upright to a normal, in the frame of the scatter.
static versors aligned(versors upright, const double normal[3], double part) {
    vec3s up = fr_turned(upright, (vec3s){{0, 0, 1}});
    vec3s wanted = {{(float)normal[0], (float)normal[1], (float)normal[2]}};
    vec3s axis = glms_vec3_cross(up, wanted);
    float sine = glms_vec3_norm(axis), angle = atan2f(sine, glms_vec3_dot(up, wanted));
    axis = sine > 1e-6f ? glms_vec3_divs(axis, sine) : fr_frame_left(upright);
    return fr_frame_step(fr_rotation_about(axis, (float)part * angle), upright);
}

// A point to stand on, in the coordinates of the scatter, and what turns a child there.
typedef struct Spot {
    vec3s at, normal;
    versors turn;
} Spot;

static void write_child(FrSpread *spread, const FrScatterParams *params, uint32_t i, Spot spot) {
    FrEvaluator *place = spread->place;
#define FR_GET(field) fr_value(place, &params->field, FR_SCATTER_##field)
    float push = (float)FR_GET(push), scale = (float)spread->centre.scale;
    vec3s by = glms_vec3_scale(glms_vec3_add(spot.at, glms_vec3_scale(spot.normal, push)), scale);
    versors turn = fr_turned_zyz(FR_GET(azimuth), FR_GET(tilt), PI / 2);
    fr_spread_write(
        spread, i, fr_spread_site(spread, by, fr_frame_step(spot.turn, turn), FR_GET(child_scale)));
#undef FR_GET
}

static void strew_mesh(FrSpread *spread, const FrScatterParams *params, const FrStrewnSurface *mesh,
                       uint32_t candidates, FrKey key) {
    FrStrewnPoint *points = g_new(FrStrewnPoint, spread->count);
    fr_strew(mesh, points, spread->count, candidates, key, spread->expansion->progress);
    versors upright = to_upright(spread, 1);
    for (uint32_t i = 0; i < spread->count; i++) {
        if (fr_spread_wants(spread, i)) {
            Spot spot = {.turn = aligned(upright, points[i].normal, params->align)};
            for (int r = 0; r < 3; r++) {
                spot.at.raw[r] = (float)points[i].at[r];
                spot.normal.raw[r] = (float)points[i].normal[r];
            }
            fr_spread_enter(spread, i);
            write_child(spread, params, i, spot);
        }
    }
    g_free(points);
}

static void strew_plane(FrSpread *spread, const FrScatterParams *params, uint32_t candidates,
                        FrKey key) {
    FrEvaluator *evaluator = spread->evaluator;
    double radius = fr_value(evaluator, &params->radius, FR_SCATTER_radius);
    double inner = fr_value(evaluator, &params->inner_radius, FR_SCATTER_inner_radius);
    double widest = params->surface == FR_SCATTER_RING ? fmax(radius, inner) : radius;
    double(*points)[2] = g_malloc_n(spread->count, sizeof *points);
    fr_bluenoise(points, spread->count, (FrStrewnForm)params->surface,
                 widest > 0 ? fmin(radius, inner) / widest : 0, candidates, key, NULL,
                 spread->expansion->progress);
    versors upright = to_upright(spread, 1 - params->align);
    for (uint32_t i = 0; i < spread->count; i++) {
        if (fr_spread_wants(spread, i)) {
            Spot spot = {
                .at = {{(float)(widest * points[i][0]), (float)(widest * points[i][1]), 0}},
                .normal = {{0, 0, 1}},
                .turn = upright,
            };
            fr_spread_enter(spread, i);
            write_child(spread, params, i, spot);
        }
    }
    g_free(points);
}

void fr_make_scatter(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                     FrEvaluator *place) {
    FrSpread spread = fr_spread_begin(expansion, row, evaluator, place);
    const FrPrepared *prepared = &expansion->prepared[spread.stage->component];
    const FrScatterParams *params = prepared->params;
    if (spread.count == 0) {
        return;
    }
    uint32_t candidates = (uint32_t)floor(1 + params->regularity * (MOST_CANDIDATES - 1) + 0.5);
    FrKey key = fr_key_child(expansion->level.key[row], fr_purpose(FR_SCATTER_surface));
    if (prepared->strewn != NULL) {
        strew_mesh(&spread, params, prepared->strewn, candidates, key);
    } else {
        strew_plane(&spread, params, candidates, key);
    }
}
