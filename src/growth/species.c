// A species made ready for growth: its orders are put together from the model, or from its own
// rows, and its plain attributes.
#include "growth/engine.h"

#include <math.h>
#include <string.h>

/// The one order of an open architecture: what the attributes of the species say.
static FrOrderParams open_order(const FrSpeciesParams *params) {
    FrOrderParams order;
    fr_params_init(fr_order_table(), &order);
    order.tier = params->laterals;
    order.angle = params->branching_angle;
    order.divergence = params->divergence;
    return order;
}

/// Tiers and angles of a model change with the attributes of the species, which say 2 and 45° for
/// the model as it is.
static void scale_order(const FrSpeciesParams *params, FrOrderParams *order) {
    if (order->tier > 0) {
        int64_t tier = (int64_t)lround((double)order->tier * (double)params->laterals / 2);
        order->tier = CLAMP(tier, params->laterals > 0 ? 1 : 0, 8);
    }
    double angle = order->angle * params->branching_angle / (G_PI / 4);
    order->angle = MIN(angle, 175 * G_PI / 180);
}

/// Palms and their like have few thick stems and few large leaves, which the attributes of the
/// species, made for trees of many twigs, are times.
static void scale_habit(FrSpeciesParams *params) {
    FrHabit habit = fr_species_habit(params->model);
    params->tip_radius *= habit.girth;
    params->leaf_length *= habit.blade_length;
    params->leaf_width *= habit.blade_width;
    params->leaves = lround((double)params->leaves * habit.leaves);
    params->leaf_life = MAX(lround((double)params->leaf_life * habit.leaf_life), 1);
}

/// Works out once what every bud needs.
static void prepare(FrReadySpecies *ready) {
    const FrSpeciesParams *params = &ready->params;
    for (uint32_t row = 0; row < ready->order_count; row++) {
        ready->cosine[row] = (float)cos(ready->orders[row].angle);
        ready->sine[row] = (float)sin(ready->orders[row].angle);
    }
    for (int order = 0; order < 256; order++) {
        double control = params->apical_control > 1 ? 1 / params->apical_control : 1;
        ready->shorter[order] = (float)pow(params->step_ratio * control, order);
    }
    ready->wander = (float)tan(MIN(params->wander, 1.2));
    ready->trial = (float)tan(MIN(params->trial_angle, 1.4));
    ready->turn_cosine = (float)cos(params->turn_limit);
    ready->turn_sine = (float)sin(params->turn_limit);
}

FrReadySpecies fr_species_make_ready(const FrSpecies *species) {
    FrReadySpecies ready = {.bark = species->bark,
                            .leaf = species->leaf,
                            .envelope = species->envelope,
                            .name = g_strdup(species->name)};
    fr_params_copy(fr_species_table(), &ready.params, &species->params);
    const FrSpeciesParams *params = &ready.params;
    if (species->order_count > 0) {
        ready.order_count = MIN(species->order_count, FR_MAX_ORDERS);
        memcpy(ready.orders, species->orders, ready.order_count * sizeof(FrOrderParams));
    } else if (params->model == FR_MODEL_OPEN) {
        ready.order_count = 1;
        ready.orders[0] = open_order(params);
    } else {
        ready.order_count = fr_species_model(params->model, ready.orders);
        for (uint32_t row = 0; row < ready.order_count; row++) {
            scale_order(params, &ready.orders[row]);
        }
    }
    scale_habit(&ready.params);
    prepare(&ready);
    return ready;
}

void fr_species_clear_ready(FrReadySpecies *ready) {
    fr_params_clear(fr_species_table(), &ready->params);
    g_free(ready->name);
}
