// Plants that climb. A bud feels the nearest surface, is drawn to it and grows along it; a shoot
// without a hold bends down under its weight and ends.
//
// Surface adaptation after Hädrich, Benes, Deussen, Pirk 2017, Interactive Modeling and Authoring
// of Climbing Plants, Computer Graphics Forum 36 (2); lengths without a hold after T. Luft's ivy
// generator, 2007. Both bend by strengths that are tuned; here the bend follows from how far the
// bud is from where it shall be (docs/growth-engine.md, Climbing).
#include "growth/climbing.h"
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

/// So much must be free around a tip, and the cells beside it; what stands may stand anywhere in
/// its cells.
static double room_of(const FrGrowth *growth, const FrSpeciesParams *params, double spare) {
    return params->collide ? ((double)(params->box / 2) + spare) * growth->voxels->cell : 0;
}

static vec3s to_vec3s(const double from[3]) {
    return (vec3s){{(float)from[0], (float)from[1], (float)from[2]}};
}

static void feel_surface(const FrGrowth *growth, const FrSpeciesParams *params,
                         const FrDistance *surface, const double at[3], FrHold *hold) {
    double outward[3];
    double distance =
        surface == NULL ? INFINITY : fr_distance_within(surface, at, params->climb, outward);
    if (distance < params->climb) {
        hold->is_near = true;
        hold->distance = distance;
        hold->away = to_vec3s(outward);
        hold->gap = room_of(growth, params, 1.1);
    }
}

/// Wood occupies only the cells of its middle line, so stems may touch it where it is thick.
static void feel_bark(const FrGrowth *growth, const FrSpeciesParams *params, const double at[3],
                      FrHold *hold) {
    double reach = hold->is_near ? hold->distance : params->climb;
    FrBark bark = fr_stems_near(growth->bark, at, reach, params->climb_wood);
    if (bark.distance < reach) {
        hold->is_near = hold->is_grown = true;
        hold->distance = bark.distance;
        hold->away = to_vec3s(bark.outward);
        hold->radius = bark.radius;
        hold->gap = fmax(params->tip_radius, room_of(growth, params, 1.5) - bark.radius);
    }
}

/// The ground counts only where nothing else is near, or nothing would leave it.
FrHold fr_climb_feel(const FrGrowth *growth, const FrSpeciesParams *params, vec3s world) {
    const double at[3] = {(double)world.x, (double)world.y, (double)world.z};
    FrHold hold = {.at = world, .distance = INFINITY};
    feel_surface(growth, params, growth->support, at, &hold);
    feel_bark(growth, params, at, &hold);
    if (!hold.is_near) {
        feel_surface(growth, params, growth->support_ground, at, &hold);
    }
    return hold;
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

/// A way along wood, which is round: bent so that its end lies as far off the bark as it shall.
static vec3s around_wood(const FrGrowth *growth, const FrSpeciesParams *params, const FrHold *hold,
                         vec3s way, float length) {
    enum { TIMES = 2 };
    for (int k = 0; k < TIMES; k++) {
        vec3s end = glms_vec3_add(hold->at, glms_vec3_scale(way, length));
        FrHold there = fr_climb_feel(growth, params, end);
        if (!there.is_grown) {
            break;
        }
        double lack = there.gap - there.distance, most = (double)length / 2;
        vec3s lift = glms_vec3_scale(there.away, (float)(params->cling * CLAMP(lack, -most, most)));
        way = glms_vec3_normalize(glms_vec3_add(glms_vec3_scale(way, length), lift));
    }
    return way;
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
    double gap = hold->gap, length = MAX((double)bud->length, 1e-6);
    double over = fmax((double)trial - (double)(params->trials / 2), 0); // first beside, then over
    double lean = params->cling * CLAMP((gap - hold->distance) / length, -1, 1) + lift * over;
    float out = (float)CLAMP(lean, -steepest, 0.95);
    vec3s held = glms_vec3_add(glms_vec3_scale(glms_vec3_normalize(along), sqrtf(1 - out * out)),
                               glms_vec3_scale(hold->away, out));
    if (hold->is_grown && hold->distance < gap + length) {
        held = around_wood(growth, params, hold, held, (float)length);
    }
    double faint = (hold->distance - gap) / MAX(params->climb - gap, 1e-6);
    float part = (float)CLAMP(1 - faint, 0, 1);
    vec3s sum = glms_vec3_add(glms_vec3_scale(held, part), glms_vec3_scale(wanted, 1 - part));
    return glms_vec3_norm(sum) < 1e-4f ? held : glms_vec3_normalize(sum);
}

double fr_climb_room(const FrGrowth *growth, const FrSpeciesParams *params, const double from[3],
                     const double way[3], double part, FrBark *bark) {
    double at[3], length = 0;
    for (int r = 0; r < 3; r++) {
        at[r] = from[r] + part * way[r];
        length += way[r] * way[r];
    }
    length = sqrt(length);
    *bark = fr_stems_near(growth->bark, at, length, params->climb_wood);
    if (!(bark->distance < length)) {
        return length;
    }
    double bend = fmin(length * length / (8 * fmax(bark->radius, 1e-6)), bark->radius / 4);
    return bark->distance + 4 * part * (1 - part) * bend;
}

bool fr_climb_is_clear(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud,
                       vec3s to) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    if (growth->bark == NULL || !fr_species_climbs(params)) {
        return true;
    }
    vec3s bud_at = fr_bud_world(plant, bud);
    double length = (double)bud->length, from[3], way[3];
    for (int r = 0; r < 3; r++) {
        from[r] = (double)bud_at.raw[r];
        way[r] = plant->seed.at[r] + (double)to.raw[r] - from[r];
    }
    FrBark bark;
    double shortest = length / 32;
    for (double along = 0; along < length;) {
        double room = fr_climb_room(growth, params, from, way, along / length, &bark);
        if (room <= 0) {
            return false;
        }
        along += fmax(room, shortest);
    }
    return fr_climb_room(growth, params, from, way, 1, &bark) > params->tip_radius / 2;
}

bool fr_climb_note(const FrGrowth *growth, const FrGrownPlant *plant, FrLiveBud *bud) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    FrHold hold = fr_climb_feel(growth, params, fr_bud_world(plant, bud));
    if (hold.is_near && hold.distance <= hold.gap + params->step / 2) {
        bud->unheld = 0;
        // Buds to both sides then lie along the surface.
        vec3s side = glms_vec3_cross(hold.away, bud->direction);
        bud->side = glms_vec3_norm(side) > 0.1f ? glms_vec3_normalize(side) : bud->side;
        return true;
    }
    bud->unheld += bud->length;
    return (double)bud->unheld < params->climb_free;
}
