// Seeds that stand where they cannot grow: outside the arena, in an obstacle, beside their
// envelope.
#include "frond/solid.h"
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>

bool fr_seed_is_in_arena(const FrGrowthParams *params, const FrSeed *seed) {
    for (int axis = 0; axis < 3; axis++) {
        if (!(seed->at[axis] >= (double)params->min.raw[axis] &&
              seed->at[axis] <= (double)params->max.raw[axis])) {
            return false;
        }
    }
    return true;
}

bool fr_species_comes_within(const FrGrowthParams *params, const FrReadySpecies *species,
                             vec3s up) {
    enum { PLACES = 1024 };
    double highest = 0;
    for (int axis = 0; axis < 3; axis++) {
        double width = (double)params->max.raw[axis] - (double)params->min.raw[axis];
        highest += width * fabs((double)up.raw[axis]);
    }
    bool is_within = false;
    for (int i = 0; i < PLACES && !is_within; i++) {
        vec3s at = glms_vec3_scale(up, (float)(highest * i / PLACES));
        is_within = fr_envelope_holds(species, at, up);
    }
    return is_within;
}

void fr_misplaced_note(FrMisplaced *misplaced, const FrSeed *seed) {
    misplaced->first = misplaced->count == 0 ? seed : misplaced->first;
    misplaced->count++;
}

void fr_misplaced_tell_left_out(const FrMisplaced *left_out, uint32_t count, bool is_all,
                                const FrContext *context) {
    if (left_out->count > 0) {
        const FrSeed *first = left_out->first;
        fr_diags_add(
            context->diags, FR_WARNING, "seed-place", first->span,
            "%u of %u seeds have no place to stand, the first of them at %g,%g,%g: outside "
            "the arena or in an obstacle%s",
            left_out->count, count, first->at[0], first->at[1], first->at[2],
            is_all ? "; nothing grows" : "");
    }
}

void fr_misplaced_tell_outside(const FrMisplaced *outside, uint32_t count,
                               const FrContext *context) {
    if (outside->count > 0) {
        const FrSeed *first = outside->first;
        fr_diags_add(context->diags, FR_WARNING, "seed-envelope", first->span,
                     "%u of %u seeds stand outside of their envelope and do not grow into it, the "
                     "first of them at %g,%g,%g",
                     outside->count, count, first->at[0], first->at[1], first->at[2]);
    }
}

/// Which seeds stand in an obstacle. The caller frees it.
static bool *find_buried(const FrGrowthSetup *setup, const FrSeed *seeds, uint32_t count) {
    bool *is_buried = g_new0(bool, count + 1u);
    FrPoint3 *places = g_new(FrPoint3, count + 1u);
    for (uint32_t i = 0; i < count; i++) {
        places[i] = (FrPoint3){{seeds[i].at[0], seeds[i].at[1], seeds[i].at[2]}};
    }
    for (uint32_t i = 0; i < setup->obstacle_count; i++) {
        const FrGrowthObstacle *obstacle = &setup->obstacles[i];
        if (!obstacle->is_ground) {
            fr_solid_holds(obstacle->positions, obstacle->indices, obstacle->index_count, places,
                           count, is_buried);
        }
    }
    g_free(places);
    return is_buried;
}

void fr_seeds_check(const FrGrowthSetup *setup, vec3s up, const FrSeed *seeds, uint32_t count,
                    const FrContext *context) {
    bool *comes_within = g_new(bool, setup->species_count + 1u);
    for (uint32_t i = 0; i < setup->species_count; i++) {
        FrReadySpecies species = fr_species_make_ready(&setup->species[i]);
        comes_within[i] = fr_species_comes_within(&setup->params, &species, up);
        fr_species_clear_ready(&species);
    }
    bool *is_buried = find_buried(setup, seeds, count);
    FrMisplaced left_out = {0}, outside = {0};
    for (uint32_t i = 0; i < count; i++) {
        if (is_buried[i] || !fr_seed_is_in_arena(&setup->params, &seeds[i])) {
            fr_misplaced_note(&left_out, &seeds[i]);
        } else if (!comes_within[seeds[i].species]) {
            fr_misplaced_note(&outside, &seeds[i]);
        }
    }
    fr_misplaced_tell_left_out(&left_out, count, left_out.count == count, context);
    fr_misplaced_tell_outside(&outside, count, context);
    g_free(is_buried);
    g_free(comes_within);
}
