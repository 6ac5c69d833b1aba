// What a new node brings forth: buds beside it, or relays where its axis ends. The rows of orders
// say which (Hallé, Oldeman, Tomlinson 1978); light says how many (Beneš, Andrysco, Šťava 2009,
// section 3.2).
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>

/// How many of `tier` buds come to be in so much light.
static uint32_t buds_in_light(const FrSpeciesParams *params, uint32_t tier, float light) {
    double width = params->branch_light - params->branch_dark;
    double part = width > 0 ? CLAMP(((double)light - params->branch_dark) / width, 0, 1)
                            : (double)light >= params->branch_dark;
    double smooth = part * part * (3 - 2 * part);
    return (uint32_t)lround((double)tier * smooth);
}

/// What the buds of a bud's axis count their divergence from. Buds that stand in two rows shall
/// make a level spray: on an axis that lies level, whatever bears it, and else across the plane of
/// the two axes.
static vec3s side_of(const FrGrowth *growth, const FrOrderParams *order, vec3s bearer,
                     vec3s direction, vec3s out) {
    vec3s level = glms_vec3_cross(growth->up, direction);
    if (order->bearing == FR_BEARING_LEVEL && glms_vec3_norm(level) > 0.1f) {
        return glms_vec3_normalize(level);
    }
    return glms_vec3_normalize(glms_vec3_cross(bearer, out));
}

/// Adds `count` buds around the tip of the apex' last internode.
static void add_around(const FrGrowth *growth, FrGrownPlant *plant, FrLiveBud apex, uint32_t node,
                       uint32_t count, double divergence, uint8_t row, bool is_relay) {
    const FrReadySpecies *species = fr_species_of(growth, plant);
    const FrGrownAxis *axis = &plant->axes[apex.axis];
    // An apex' buds of one node are told apart by the node's place on its axis.
    FrKey key = fr_key_child(axis->key, axis->internodes);
    vec3s other = glms_vec3_cross(apex.direction, apex.side);
    uint32_t built = MIN(row, species->order_count - 1);
    float cosine = species->cosine[built], sine = species->sine[built];
    for (uint32_t i = 0; i < count; i++) {
        float around = (float)(divergence + 2 * G_PI * i / count);
        vec3s out = glms_vec3_add(glms_vec3_scale(apex.side, cosf(around)),
                                  glms_vec3_scale(other, sinf(around)));
        FrLiveBud *bud = fr_grown_add_bud(plant);
        bud->key = fr_key_child(key, i + (is_relay ? 256 : 0));
        bud->node = node;
        bud->axis = apex.axis;
        bud->direction = glms_vec3_normalize(
            glms_vec3_add(glms_vec3_scale(apex.direction, cosine), glms_vec3_scale(out, sine)));
        bud->side = side_of(growth, &species->orders[built], apex.direction, bud->direction, out);
        bud->light = apex.light;
        bud->brightest = apex.brightest;
        bud->unheld = apex.unheld;
        bud->state = FR_LIVE_ASLEEP;
        bud->row = row;
        bud->is_relay = is_relay;
        bud->place = (uint16_t)MIN(axis->internodes, UINT16_MAX);
    }
}

/// True if a node that is the n-th of its axis bears buds.
static bool bears_tier(const FrOrderParams *order, uint32_t n) {
    switch (order->growth) {
    case FR_GROWTH_RHYTHMIC:
        return n % (uint32_t)order->unit == 0;
    case FR_GROWTH_BASAL:
        return n <= (uint32_t)order->unit;
    default:
        return true;
    }
}

void fr_growth_sprout(const FrGrowth *growth, FrGrownPlant *plant, uint32_t index, uint32_t node) {
    const FrReadySpecies *species = fr_species_of(growth, plant);
    FrLiveBud apex = plant->buds[index];
    const FrGrownAxis *axis = &plant->axes[apex.axis];
    const FrOrderParams *order = fr_order_of(species, apex.row);
    uint32_t n = axis->internodes;
    uint32_t life = (uint32_t)order->life;
    if (life == 0 && order->axis == FR_AXIS_SYMPODIAL) {
        life = (uint32_t)order->unit;
    }
    bool has_ended = life > 0 && n >= life;
    const FrOrderParams *next = fr_order_of(species, apex.row + 1u);
    bool may_branch = axis->order < species->params.max_order && next->in_axils;
    if (order->tier > 0 && may_branch && bears_tier(order, n)) {
        uint32_t tier = n / (order->growth == FR_GROWTH_RHYTHMIC ? (uint32_t)order->unit : 1);
        uint32_t count = buds_in_light(&species->params, (uint32_t)order->tier, apex.light);
        uint8_t row = (uint8_t)MIN(apex.row + 1u, species->order_count - 1);
        add_around(growth, plant, apex, node, count, order->divergence * tier, row, false);
    }
    if (has_ended) {
        plant->axes[apex.axis].is_growing = false;
        plant->buds[index].state = FR_LIVE_DONE;
        add_around(growth, plant, apex, node, (uint32_t)order->relays,
                   order->divergence * (axis->order + 1), apex.row, true);
    }
}
