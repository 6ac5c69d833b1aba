// Plants that climb. A bud feels the nearest surface, is drawn to it and grows along it; a shoot
// without a hold bends down under its weight and ends.
//
// Surface adaptation after Hädrich, Benes, Deussen, Pirk 2017, Interactive Modeling and Authoring
// of Climbing Plants, Computer Graphics Forum 36 (2); lengths without a hold after T. Luft's ivy
// generator, 2007. Both bend by strengths that are tuned; here the bend follows from how far the
// bud is from where it shall be (docs/growth-engine.md, Climbing).
#include "growth/engine.h"
#include "growth/obstacles.h"

#include <cglm/struct.h>
#include <math.h>

// ---- what can be climbed ----------------------------------------------------------------------

/// What nobody sees gives no hold.
static bool gives_hold(const FrGrowthObstacle *obstacle) {
    return !obstacle->is_ground && !obstacle->is_clear;
}

static bool is_ground_to_hold(const FrGrowthObstacle *obstacle) {
    return obstacle->is_ground && !obstacle->is_clear;
}

FrStatus fr_growth_take_supports(FrGrowth *growth, const FrContext *context) {
    growth->support = growth->support_ground = NULL;
    bool climbs = false;
    for (uint32_t i = 0; i < growth->species_count; i++) {
        climbs |= fr_species_climbs(&growth->species[i].params);
    }
    if (!climbs) {
        return FR_OK;
    }
    const char *what = "the surfaces that are climbed";
    FrStatus status = fr_obstacles_join(growth->obstacles, growth->obstacle_count, gives_hold, what,
                                        context, &growth->support);
    return status != FR_OK
               ? status
               : fr_obstacles_join(growth->obstacles, growth->obstacle_count, is_ground_to_hold,
                                   what, context, &growth->support_ground);
}

// ---- feeling ----------------------------------------------------------------------------------

/// The ground counts only where nothing else is near, or nothing would leave it.
FrHold fr_climb_feel(const FrGrowth *growth, const FrSpeciesParams *params, vec3s world) {
    const FrDistance *surfaces[2] = {growth->support, growth->support_ground};
    const double at[3] = {(double)world.x, (double)world.y, (double)world.z};
    FrHold hold = {0};
    for (int i = 0; i < 2 && !hold.is_near; i++) {
        double outward[3];
        hold.distance = surfaces[i] == NULL
                            ? INFINITY
                            : fr_distance_within(surfaces[i], at, params->climb, outward);
        hold.is_near = hold.distance < params->climb;
        if (hold.is_near) {
            hold.away = (vec3s){{(float)outward[0], (float)outward[1], (float)outward[2]}};
        }
    }
    return hold;
}

/// How far off a surface stems lie: as near as the cells allow that must be free around a tip.
static double gap_of(const FrGrowth *growth, const FrSpeciesParams *params) {
    const double spare = 1.1; // a level wall may stand anywhere in its cells
    return params->collide ? ((double)(params->box / 2) + spare) * growth->voxels->cell : 0;
}

// ---- growing ----------------------------------------------------------------------------------

vec3s fr_climb_pull(const FrGrowth *growth, const FrSpeciesParams *params, const FrLiveBud *bud,
                    vec3s gravity) {
    float free_part = fminf(bud->unheld / (float)params->climb_free, 1);
    return glms_vec3_add(glms_vec3_scale(gravity, 1 - free_part),
                         glms_vec3_scale(growth->up, -(float)params->climb_sag * free_part));
}

static vec3s across(vec3s vector, vec3s unit) {
    return glms_vec3_sub(vector, glms_vec3_scale(unit, glms_vec3_dot(vector, unit)));
}

vec3s fr_climb_direction(const FrGrowth *growth, const FrSpeciesParams *params,
                         const FrLiveBud *bud, const FrHold *hold, vec3s wanted, uint32_t trial) {
    const double steepest = 0.8, lift = 0.25; // to the surface; off it for each late trial
    if (!hold->is_near) {
        return wanted;
    }
    vec3s right = glms_vec3_cross(growth->up, hold->away);
    vec3s wound = glms_vec3_add(wanted, glms_vec3_scale(right, (float)params->climb_wind));
    vec3s along = across(wound, hold->away);
    if (glms_vec3_norm(along) < 1e-3f) { // straight at the surface
        along = across(bud->side, hold->away);
    }
    if (glms_vec3_norm(along) < 1e-3f) {
        along = across(glms_vec3_cross(bud->direction, bud->side), hold->away);
    }
    double gap = gap_of(growth, params), length = MAX((double)bud->length, 1e-6);
    double over = fmax((double)trial - (double)(params->trials / 2), 0); // first beside, then over
    double lean = params->cling * CLAMP((gap - hold->distance) / length, -1, 1) + lift * over;
    float out = (float)CLAMP(lean, -steepest, 0.95);
    vec3s held = glms_vec3_add(glms_vec3_scale(glms_vec3_normalize(along), sqrtf(1 - out * out)),
                               glms_vec3_scale(hold->away, out));
    double faint = (hold->distance - gap) / MAX(params->climb - gap, 1e-6);
    float part = (float)CLAMP(1 - faint, 0, 1);
    vec3s sum = glms_vec3_add(glms_vec3_scale(held, part), glms_vec3_scale(wanted, 1 - part));
    return glms_vec3_norm(sum) < 1e-4f ? held : glms_vec3_normalize(sum);
}

bool fr_climb_note(const FrGrowth *growth, const FrGrownPlant *plant, FrLiveBud *bud) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    FrHold hold = fr_climb_feel(growth, params, fr_bud_world(plant, bud));
    double holds_at = gap_of(growth, params) + params->step / 2;
    if (hold.is_near && hold.distance <= holds_at) {
        bud->unheld = 0;
        // Buds to both sides then lie along the surface.
        vec3s side = glms_vec3_cross(hold.away, bud->direction);
        bud->side = glms_vec3_norm(side) > 0.1f ? glms_vec3_normalize(side) : bud->side;
        return true;
    }
    bud->unheld += bud->length;
    return (double)bud->unheld < params->climb_free;
}
