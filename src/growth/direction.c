// Direction and length of the next internode.
//
// Beneš, Andrysco, Šťava 2009, section 3.5: v' = normalize(v + s·light + g·up + p·particles). The
// text says that branches turn against gravity, its formula adds gravity; the text is followed.
// Length follows the light: buds in shade search, buds in light branch (section 3.2).
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>

/// What gravity does to an axis that stands like this.
static vec3s gravity_pull(const FrGrowth *growth, const FrSpeciesParams *params,
                          const FrOrderParams *order, const FrGrownAxis *axis, vec3s direction) {
    float strength = (float)params->gravitropism;
    float rise = glms_vec3_dot(direction, growth->up);
    switch (order->bearing) {
    case FR_BEARING_LEVEL: // back to the horizontal, and twice as firmly as others rise
        return glms_vec3_scale(growth->up, -2 * fabsf(strength) * rise);
    case FR_BEARING_BENT: { // level after five internodes, then down to a slope of 30 degrees
        float wanted = fmaxf(1 - (float)axis->internodes / 5, -0.5f);
        return glms_vec3_scale(growth->up, 2 * fabsf(strength) * (wanted - rise));
    }
    default:
        return glms_vec3_scale(growth->up, strength);
    }
}

/// Where light draws an axis that stands like this: one that lies level, or bows, seeks it
/// sideways.
static vec3s light_pull(const FrGrowth *growth, const FrSpeciesParams *params,
                        const FrOrderParams *order, const FrGrownAxis *axis, vec3s brightest) {
    bool is_flat = order->bearing == FR_BEARING_LEVEL ||
                   (order->bearing == FR_BEARING_BENT && axis->internodes > 2);
    if (is_flat) {
        float rise = glms_vec3_dot(brightest, growth->up);
        brightest = glms_vec3_sub(brightest, glms_vec3_scale(growth->up, rise));
    }
    return glms_vec3_scale(brightest, (float)params->phototropism);
}

/// A vector across `direction` by chance, up to `size` long along each of two axes.
static vec3s chance_across(FrKey key, uint32_t purpose, uint32_t k, const FrLiveBud *bud,
                           float size) {
    uint64_t bits = fr_random_bits(key, purpose, k);
    float a = (float)(int32_t)(bits >> 32) * 0x1p-31f, b = (float)(int32_t)bits * 0x1p-31f;
    vec3s other = glms_vec3_cross(bud->direction, bud->side);
    return glms_vec3_add(glms_vec3_scale(bud->side, a * size), glms_vec3_scale(other, b * size));
}

/// Nearly normal, of deviation 1 and within ±3: the sum of three even draws.
static float chance_normal(FrKey key, uint32_t purpose, uint32_t k) {
    uint64_t bits = fr_random_bits(key, purpose, k);
    int64_t sum = (int64_t)(bits & 0x1fffff) + (int64_t)(bits >> 21 & 0x1fffff) +
                  (int64_t)(bits >> 42 & 0x1fffff);
    return (float)(2 * sum - 3 * 0x1fffff) / (float)0x1fffff;
}

/// Not further from `from` than the species allows.
static vec3s limited(const FrReadySpecies *species, vec3s from, vec3s to) {
    float cosine = glms_vec3_dot(from, to);
    if (cosine >= species->turn_cosine) {
        return to;
    }
    vec3s across = glms_vec3_sub(to, glms_vec3_scale(from, cosine));
    float length = glms_vec3_norm(across);
    if (length < 1e-6f) {
        return from;
    }
    return glms_vec3_add(glms_vec3_scale(from, species->turn_cosine),
                         glms_vec3_scale(across, species->turn_sine / length));
}

/// Palubicki et al. 2009: a part of the turn from the bud's direction to where light and up draw
/// it, the greater the stronger they draw.
static vec3s turned_part(const FrGrowth *growth, const FrSpeciesParams *params,
                         const FrLiveBud *bud) {
    float pull = (float)params->phototropism * bud->slope;
    vec3s to = glms_vec3_add(glms_vec3_scale(bud->brightest, pull),
                             glms_vec3_scale(growth->up, (float)params->gravitropism));
    float strength = glms_vec3_norm(to);
    if (strength < 1e-6f) {
        return bud->direction;
    }
    vec3s wanted = glms_vec3_scale(to, 1 / strength);
    float part = fminf(strength, (float)params->turn_part);
    float cosine = CLAMP(glms_vec3_dot(bud->direction, wanted), -1, 1);
    float angle = acosf(cosine);
    vec3s across = glms_vec3_sub(wanted, glms_vec3_scale(bud->direction, cosine));
    float length = glms_vec3_norm(across);
    if (length < 1e-6f) {
        return bud->direction;
    }
    return glms_vec3_add(glms_vec3_scale(bud->direction, cosf(part * angle)),
                         glms_vec3_scale(across, sinf(part * angle) / length));
}

/// All that draws a bud besides chance.
static vec3s drawn_to(const FrGrowth *growth, const FrReadySpecies *species,
                      const FrGrownAxis *axis, const FrLiveBud *bud) {
    const FrSpeciesParams *params = &species->params;
    vec3s sum = bud->direction;
    if (params->fate == FR_FATE_COLONIZE) { // its direction is already that of its particles
        return glms_vec3_add(sum, glms_vec3_scale(growth->up, (float)params->gravitropism));
    }
    if (params->turning == FR_TURN_PART) {
        sum = turned_part(growth, params, bud);
    } else {
        const FrOrderParams *order = fr_order_of(species, bud->row);
        vec3s pull = gravity_pull(growth, params, order, axis, bud->direction);
        if (fr_species_climbs(params)) {
            pull = fr_climb_pull(growth, params, bud, pull);
        }
        sum = glms_vec3_add(sum, light_pull(growth, params, order, axis, bud->brightest));
        sum = glms_vec3_add(sum, pull);
    }
    return glms_vec3_add(sum, glms_vec3_scale(bud->attraction, (float)params->attraction));
}

vec3s fr_growth_direction(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud,
                          uint32_t trial) {
    const FrReadySpecies *species = fr_species_of(growth, plant);
    const FrSpeciesParams *params = &species->params;
    const FrGrownAxis *axis = &plant->axes[bud->axis];
    vec3s sum = drawn_to(growth, species, axis, bud);
    if (species->wander > 0) {
        sum = glms_vec3_add(
            sum, chance_across(bud->key, FR_CHANCE_TURN, axis->internodes, bud, species->wander));
    }
    if (trial > 0) { // Greene 1989: others around the wanted one
        float size = glms_vec3_norm(sum) * species->trial;
        sum = glms_vec3_add(sum, chance_across(bud->key, FR_CHANCE_TRIAL,
                                               axis->internodes * 64 + trial, bud, size));
    }
    float length = glms_vec3_norm(sum);
    if (length < 1e-4f) {
        return bud->direction;
    }
    vec3s wanted = glms_vec3_scale(sum, 1 / length);
    if (fr_species_climbs(params)) {
        FrHold hold = fr_climb_feel(growth, params, fr_bud_world(plant, bud));
        wanted = fr_climb_direction(growth, params, bud, &hold, wanted, trial);
    }
    return limited(species, bud->direction, wanted);
}

void fr_growth_turn(FrLiveBud *bud, vec3s direction, float twist) {
    vec3s across =
        glms_vec3_sub(bud->side, glms_vec3_scale(direction, glms_vec3_dot(bud->side, direction)));
    float length = glms_vec3_norm(across);
    if (length < 1e-4f) {
        across = fr_frame_left(fr_frame_from_heading(direction, bud->direction));
        length = 1;
    }
    across = glms_vec3_scale(across, 1 / length);
    vec3s other = glms_vec3_cross(direction, across);
    bud->direction = direction;
    bud->side = twist == 0 ? across
                           : glms_vec3_add(glms_vec3_scale(across, cosf(twist)),
                                           glms_vec3_scale(other, sinf(twist)));
}

double fr_growth_longest(const FrSpeciesParams *params) {
    return params->step * MAX(params->max_length, 2) * 2;
}

double fr_growth_length(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud) {
    const FrReadySpecies *species = fr_species_of(growth, plant);
    const FrSpeciesParams *params = &species->params;
    const FrGrownAxis *axis = &plant->axes[bud->axis];
    double search = 1 + params->search * (1 - 2 * (double)bud->light);
    double length = params->step * CLAMP(search, params->min_length, params->max_length);
    length *= (double)species->shorter[axis->order] * fr_order_of(species, bud->row)->length;
    if (params->apical_control < 1) {
        length *= pow(params->apical_control, (double)plant->max_order - (double)axis->order);
    }
    double noise = (double)chance_normal(bud->key, FR_CHANCE_LENGTH, axis->internodes);
    length *= CLAMP(1 + params->length_noise * noise, 0.4, 2);
    return MIN(length, fr_growth_longest(params));
}
