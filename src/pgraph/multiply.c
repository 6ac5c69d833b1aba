// Children of multipliers: branches of a Tree, children of a Phiball.
#include "pgraph/golden.h"
#include "pgraph/instance.h"

#include "plant/frames.h"

#include <math.h>

#define PI 3.14159265358979323846

// Turned about z, then about the new y, then about the new z. A child's y axis, its upper side,
// looks to the parent's tip where the last angle is a quarter turn.
static versors turned_zyz(double azimuth, double down, double roll) {
    // Whole turns are taken off before the angle becomes a float.
    azimuth -= 2 * PI * floor(azimuth / (2 * PI));
    float half_sum = (float)(0.5 * (azimuth + roll)), half_rest = (float)(0.5 * (azimuth - roll));
    float half_down = (float)(0.5 * down);
    float sine = sinf(half_down), cosine = cosf(half_down);
    return (versors){{-sine * sinf(half_rest), sine * cosf(half_rest), cosine * sinf(half_sum),
                      cosine * cosf(half_sum)}};
}

// Whether any link makes iteration i.
static bool is_wanted(const FrExpansion *expansion, const FrStage *stage, uint32_t i, uint32_t n) {
    FrComponentKind kind = expansion->prepared[stage->component].kind;
    for (uint32_t k = 0; k < stage->link_count; k++) {
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        if (fr_link_is_multiplied(kind, link->kind) &&
            fr_flags_allow(&fr_stage_prepared(expansion, link->stage)->flags, i, n)) {
            return true;
        }
    }
    return false;
}

// ---- branches ---------------------------------------------------------------------------------

typedef struct Branching {
    const FrExpansion *expansion;
    const FrStem *stem;
    const FrTreeParams *tree;
    FrPose base;
    uint32_t row;
    uint32_t place; // the one that `at` is of
    double at;      // along the stem
} Branching;

static bool is_on_surface(const FrTreeParams *tree, const FrPrepared *child) {
    if (tree->placement != FR_PLACE_AUTO) {
        return tree->placement == FR_PLACE_ON_SURFACE;
    }
    return !child->is_stem && !child->is_point_set;
}

// The point of the stem at a place, as an offset on the internode that holds it.
static void stand_at(Branching *branching, uint32_t place, FrPose *site) {
    const FrStem *stem = branching->stem;
    if (place != branching->place) {
        branching->place = place;
        branching->at = fr_place_at(&stem->places, place);
    }
    *site = branching->base;
    if (stem->internodes == 0) {
        return;
    }
    uint32_t k = fr_stem_node_of(stem, branching->at, place);
    uint32_t node = branching->expansion->level.node_count[branching->row] + k;
    double back = stem->gaps > 0 ? 0 : (double)(k + 1) - branching->at * stem->internodes;
    float length = branching->expansion->plant->nodes.length[node];
    site->bearer = node;
    site->offset = (vec3s){{0, 0, -(float)fmax(0, back) * length}};
    site->rotation = (versors){{0, 0, 0, 1}};
}

static double height_of(const FrPlant *plant, FrPose site) {
    if (site.bearer == FR_NONE) {
        return (double)site.offset.z;
    }
    vec3s heading = fr_frame_heading(plant->nodes.frame[site.bearer]);
    return (double)(plant->nodes.position[site.bearer].z + site.offset.z * heading.z);
}

// Poses branch b. *reach receives the way from axis to surface.
static FrChild pose_branch(Branching *branching, uint32_t b, FrEvaluator *evaluator,
                           FrEvaluator *place, vec3s *reach) {
    const FrTreeParams *tree = branching->tree;
    const FrStem *stem = branching->stem;
    const FrLevel *level = &branching->expansion->level;
    const FrPlaces *places = &stem->places;
    FrPose site;
    stand_at(branching, b / places->whorl, &site);
    FrKey key = fr_key_child(level->key[branching->row], b);
    place->vars.key = key;
    if (stem->prepared->varies) {
        fr_place_enter(place, evaluator, level, branching->row, b, places->branches, key);
        place->vars.value[FR_VAR_x] = branching->at;
        place->vars.value[FR_VAR_height] =
            stem->prepared->uses_height ? height_of(branching->expansion->plant, site) : 0;
    }
#define FR_GET(field) fr_value(place, &tree->field, FR_TREE_##field)
    double jitter = FR_GET(azimuth_jitter);
    double azimuth = fr_branch_azimuth(places, b) + FR_GET(azimuth);
    azimuth += jitter != 0 ? jitter * fr_random_signed(key, FR_TREE_azimuth_jitter, 1) : 0;
    versors turn = turned_zyz(azimuth, FR_GET(branching_angle), PI / 2 + FR_GET(roll));
    double radius = fr_stem_radius(stem, branching->at);
    azimuth -= 2 * PI * floor(azimuth / (2 * PI));
    *reach = (vec3s){{(float)radius * cosf((float)azimuth),
                      (float)(radius * stem->flatness) * sinf((float)azimuth), 0}};
    if (stem->internodes > 0) {
        site.rotation = turn; // internodes have the stem's frame
    } else {
        *reach = fr_turned(site.rotation, *reach);
        site.rotation = fr_frame_step(site.rotation, turn);
    }
    site.scale = branching->base.scale * FR_GET(child_scale);
#undef FR_GET
    return (FrChild){
        .site = site,
        .key = key,
        .i = b,
        .n = places->branches,
        .is_multiplied = true,
        .order = (uint16_t)MIN(level->order[branching->row] + 1, UINT16_MAX),
        .x = (float)branching->at,
        .parent_length = (float)(stem->length / branching->base.scale),
        .parent_radius = (float)(radius / branching->base.scale),
        .axis = FR_NONE,
    };
}

uint32_t fr_make_branches(const FrExpansion *expansion, uint32_t row, const FrStem *stem,
                          FrPose base, FrEvaluator *evaluator, FrEvaluator *place, uint32_t at) {
    const FrStage *stage = fr_instance_stage(expansion, row);
    uint32_t count = expansion->level.places[row];
    Branching branching = {
        .expansion = expansion,
        .stem = stem,
        .tree = stem->prepared->params,
        .base = base,
        .row = row,
        .place = FR_NONE,
    };
    for (uint32_t b = 0; b < count; b++) {
        if (!is_wanted(expansion, stage, b, count)) {
            continue;
        }
        vec3s reach;
        FrChild child = pose_branch(&branching, b, evaluator, place, &reach);
        for (uint32_t k = 0; k < stage->link_count; k++) {
            const FrStageLink *link = fr_stage_link(expansion, stage, k);
            const FrPrepared *to = fr_stage_prepared(expansion, link->stage);
            if (link->kind != FR_LINK_BRANCH || !fr_flags_allow(&to->flags, b, count)) {
                continue;
            }
            FrChild one = child;
            if (is_on_surface(branching.tree, to)) {
                one.site.offset.x += reach.x;
                one.site.offset.y += reach.y;
                one.site.offset.z += reach.z;
            }
            fr_child_write(expansion, row, link, &one, at++);
        }
    }
    return at;
}

// ---- phiball ----------------------------------------------------------------------------------

typedef struct Ball {
    const FrPhiballParams *params;
    const FrExpansion *expansion;
    uint32_t row, count;
    double radius, opening, closing, divergence, influence;
    double mean;   // of the children's squared scales
    double before; // area of the children so far
    FrPose centre;
} Ball;

static void enter_child(const Ball *ball, uint32_t i, FrEvaluator *evaluator, FrEvaluator *place) {
    const FrLevel *level = &ball->expansion->level;
    FrKey key = fr_key_child(level->key[ball->row], i);
    place->vars.key = key;
    if (ball->expansion->prepared[evaluator->component].varies) {
        fr_place_enter(place, evaluator, level, ball->row, i, ball->count, key);
        place->vars.value[FR_VAR_x] = evaluator->vars.value[FR_VAR_x];
    }
}

static double child_scale(const Ball *ball, FrEvaluator *place) {
    return fr_value(place, &ball->params->child_scale, FR_PHIBALL_child_scale);
}

static Ball measure_ball(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrPhiballParams *params =
        expansion->prepared[fr_instance_stage(expansion, row)->component].params;
#define FR_GET(field) fr_value(evaluator, &params->field, FR_PHIBALL_##field)
    Ball ball = {
        .params = params,
        .expansion = expansion,
        .row = row,
        .count = expansion->level.places[row],
        .opening = FR_GET(opening),
        .closing = FR_GET(closing),
        .divergence = FR_GET(divergence) * (params->handedness == FR_HAND_LEFT ? 1 : -1),
        .influence = FR_GET(influence),
        .centre = fr_instance_pose(expansion, row, evaluator),
    };
    if (params->radius_mode == FR_RADIUS_BY_AREA) {
        ball.radius = fr_golden_radius(ball.count, FR_GET(child_area), ball.opening, ball.closing);
    } else if (params->radius_mode == FR_RADIUS_TOUCHING) {
        ball.radius =
            fr_golden_touching_radius(ball.count, FR_GET(child_radius), ball.opening, ball.closing);
    } else {
        ball.radius = FR_GET(radius);
    }
#undef FR_GET
    ball.radius *= ball.centre.scale;
    if (params->anchor == FR_ANCHOR_POLE) {
        ball.centre = fr_pose_moved(ball.centre, (vec3s){{0, 0, -(float)ball.radius}},
                                    (versors){{0, 0, 0, 1}});
    }
    return ball;
}

static void measure_mean(Ball *ball, FrEvaluator *evaluator, FrEvaluator *place) {
    if (ball->influence == 0 || ball->params->child_scale.is_constant) {
        ball->influence = 0; // equal children: zones in closed form
        return;
    }
    double sum = 0;
    for (uint32_t i = 0; i < ball->count; i++) {
        enter_child(ball, i, evaluator, place);
        double scale = child_scale(ball, place);
        sum += scale * scale;
    }
    ball->mean = sum / ball->count;
}

// Part of the section's area before child i; i rises by one from call to call.
static double area_before(Ball *ball, uint32_t i, double scale) {
    bool is_end = ball->params->placement == FR_PLACEMENT_END;
    if (ball->influence == 0) {
        return fr_golden_before(i, ball->count, is_end);
    }
    double area = fr_golden_area(scale, ball->mean, ball->influence);
    double before = ball->before + (is_end ? area : 0.5 * area);
    ball->before += area;
    return before / (ball->mean * ball->count);
}

static FrChild pose_child(Ball *ball, uint32_t i, double polar, double scale, FrEvaluator *place) {
    const FrPhiballParams *params = ball->params;
    const FrLevel *level = &ball->expansion->level;
#define FR_GET(field) fr_value(place, &params->field, FR_PHIBALL_##field)
    double azimuth = fmod(i * ball->divergence, 2 * PI);
    double reach = ball->radius + FR_GET(push) * ball->centre.scale;
    vec3s by = {{(float)(reach * sin(polar) * cos(azimuth)),
                 (float)(reach * sin(polar) * sin(azimuth)), (float)(reach * cos(polar))}};
    FrPose site = fr_pose_moved(ball->centre, by,
                                turned_zyz(azimuth, polar + FR_GET(tilt), PI / 2 + FR_GET(roll)));
#undef FR_GET
    site.scale = ball->centre.scale * scale;
    return (FrChild){
        .site = site,
        .key = place->vars.key,
        .i = i,
        .n = ball->count,
        .is_multiplied = true,
        .order = (uint16_t)MIN(level->order[ball->row] + 1, UINT16_MAX),
        .x = level->x[ball->row],
        .parent_length = level->parent_length[ball->row],
        .parent_radius = level->parent_radius[ball->row],
        .axis = FR_NONE,
    };
}

void fr_make_phiball(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                     FrEvaluator *place) {
    const FrStage *stage = fr_instance_stage(expansion, row);
    uint32_t at = expansion->level.child_count[row];
    Ball ball = measure_ball(expansion, row, evaluator);
    measure_mean(&ball, evaluator, place);
    for (uint32_t i = 0; i < ball.count; i++) {
        bool wanted = is_wanted(expansion, stage, i, ball.count);
        if (!wanted && ball.influence == 0) {
            continue;
        }
        enter_child(&ball, i, evaluator, place);
        double scale = child_scale(&ball, place);
        double polar = fr_golden_polar(ball.opening, ball.closing, area_before(&ball, i, scale));
        if (!wanted) {
            continue;
        }
        FrChild child = pose_child(&ball, i, polar, scale, place);
        for (uint32_t k = 0; k < stage->link_count; k++) {
            const FrStageLink *link = fr_stage_link(expansion, stage, k);
            if (fr_flags_allow(&fr_stage_prepared(expansion, link->stage)->flags, i, ball.count)) {
                fr_child_write(expansion, row, link, &child, at++);
            }
        }
    }
}
