// Six plain numbers that change a species as a whole (Beneš, Andrysco, Šťava 2009, section 3.8:
// noise of lengths and angles and hidden particles for `randomize`, buds of an internode for
// `density`).
#include "frond/species.h"

#include <glib.h>
#include <math.h>

#define DEGREES (G_PI / 180)

/// `value` times 2 to the power of `slider`.
static double doubled(double value, double slider, double most) {
    return MIN(value * exp2(slider), most);
}

static void randomize(FrSpeciesParams *params, double amount) {
    const double hidden = 400; // particles at most
    params->length_noise = MIN(params->length_noise + 0.25 * amount, 1);
    params->wander = MIN(params->wander + 20 * DEGREES * amount, 90 * DEGREES);
    params->particles = MIN(params->particles + (int64_t)lround(hidden * amount), 10000000);
}

/// Below the middle what depends on light fades; above it grows to twice as much.
static void sense_light(FrSpeciesParams *params, double amount) {
    double factor = 1 + amount;
    params->phototropism = CLAMP(params->phototropism * factor, -10, 10);
    params->search = MIN(params->search * factor, 5);
    params->shed_light = MIN(params->shed_light * factor, 1);
    params->branch_dark = MIN(params->branch_dark * factor, 1);
    params->wake_light = MIN(params->wake_light * factor, 1);
}

void fr_species_apply_sliders(const FrSpeciesSliders *sliders, FrSpeciesParams *params) {
    randomize(params, sliders->randomize);
    params->laterals = (int64_t)lround(doubled((double)params->laterals, sliders->density, 8));
    params->leaves = (int64_t)lround(doubled((double)params->leaves, sliders->density, 64));
    params->auxin_reach = doubled(params->auxin_reach, -sliders->branching, 1000);
    params->auxin = doubled(params->auxin, -sliders->branching, 100);
    params->wake_light = doubled(params->wake_light, -sliders->branching, 1);
    params->twist = CLAMP(params->twist + 30 * DEGREES * sliders->twist, -2 * G_PI, 2 * G_PI);
    sense_light(params, sliders->light);
    params->gravitropism = CLAMP(params->gravitropism + 0.4 * sliders->gravity, -10, 10);
}
