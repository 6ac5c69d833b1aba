#include "pgraph/spread.h"

#include <math.h>

#define TURN 6.283185307179586

versors fr_turned_zyz(double azimuth, double down, double roll) {
    // Whole turns are taken off before the angle becomes a float.
    azimuth -= TURN * floor(azimuth / TURN);
    float half_sum = (float)(0.5 * (azimuth + roll)), half_rest = (float)(0.5 * (azimuth - roll));
    float half_down = (float)(0.5 * down);
    float sine = sinf(half_down), cosine = cosf(half_down);
    return (versors){{-sine * sinf(half_rest), sine * cosf(half_rest), cosine * sinf(half_sum),
                      cosine * cosf(half_sum)}};
}

bool fr_is_wanted(const FrExpansion *expansion, const FrStage *stage, uint32_t i, uint32_t n) {
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

FrSpread fr_spread_begin(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                         FrEvaluator *place) {
    return (FrSpread){
        .expansion = expansion,
        .stage = fr_instance_stage(expansion, row),
        .row = row,
        .count = expansion->level.places[row],
        .at = expansion->level.child_count[row],
        .evaluator = evaluator,
        .place = place,
        .centre = fr_instance_pose(expansion, row, evaluator),
    };
}

bool fr_spread_wants(const FrSpread *spread, uint32_t i) {
    return fr_is_wanted(spread->expansion, spread->stage, i, spread->count);
}

void fr_spread_enter(FrSpread *spread, uint32_t i) {
    const FrLevel *level = &spread->expansion->level;
    FrKey key = fr_key_child(level->key[spread->row], i);
    spread->place->vars.key = key;
    if (spread->expansion->prepared[spread->stage->component].varies) {
        fr_place_enter(spread->place, spread->evaluator, level, spread->row, i, spread->count, key);
        spread->place->vars.value[FR_VAR_x] = spread->evaluator->vars.value[FR_VAR_x];
    }
}

FrPose fr_spread_site(const FrSpread *spread, vec3s by, versors turn, double scale) {
    FrPose site = fr_pose_moved(spread->centre, by, turn);
    site.scale = spread->centre.scale * scale;
    return site;
}

void fr_spread_write(FrSpread *spread, uint32_t i, FrPose site) {
    const FrExpansion *expansion = spread->expansion;
    const FrLevel *level = &expansion->level;
    FrChild child = {
        .site = site,
        .key = spread->place->vars.key,
        .i = i,
        .n = spread->count,
        .is_multiplied = true,
        .age = level->age[spread->row],
        .order = (uint16_t)MIN(level->order[spread->row] + 1, UINT16_MAX),
        .x = level->x[spread->row],
        .parent_length = level->parent_length[spread->row],
        .parent_radius = level->parent_radius[spread->row],
        .stretch = 1,
        .axis = FR_NONE,
    };
    for (uint32_t k = 0; k < spread->stage->link_count; k++) {
        const FrStageLink *link = fr_stage_link(expansion, spread->stage, k);
        const FrFlags *flags = &fr_stage_prepared(expansion, link->stage)->flags;
        if (fr_flags_allow(flags, i, spread->count)) {
            fr_child_write(expansion, spread->row, link, &child, spread->at++);
        }
    }
}
