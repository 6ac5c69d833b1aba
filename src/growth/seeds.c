// Seeds that stand where they cannot grow: outside the arena, in an obstacle, beside their
// envelope, or close below something.
#include "frond/solid.h"
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

bool fr_seed_is_in_arena(const FrGrowthParams *params, const FrSeed *seed) {
    for (int axis = 0; axis < 3; axis++) {
        if (!(seed->at[axis] >= (double)params->min.raw[axis] &&
              seed->at[axis] <= (double)params->max.raw[axis])) {
            return false;
        }
    }
    return true;
}

/// A way straight up, as a trunk goes that begins outside; it wanders by about an internode, so
/// that is how near to a mesh it must come.
static bool comes_near(const FrReadySpecies *species, vec3s at, vec3s up) {
    double place[3] = {(double)at.x, (double)at.y, (double)at.z}, outward[3];
    return species->envelope == NULL
               ? fr_envelope_holds(species, at, up)
               : fr_distance_at(species->envelope, place, outward) < species->params.step;
}

static bool comes_within(const FrGrowthParams *params, const FrReadySpecies *species, vec3s up) {
    enum { PLACES = 1024 };
    double highest = 0;
    for (int axis = 0; axis < 3; axis++) {
        double width = (double)params->max.raw[axis] - (double)params->min.raw[axis];
        highest += width * fabs((double)up.raw[axis]);
    }
    bool is_within = false;
    for (int i = 0; i < PLACES && !is_within; i++) {
        vec3s at = glms_vec3_scale(up, (float)(highest * i / PLACES));
        is_within = comes_near(species, at, up);
    }
    return is_within;
}

bool *fr_species_come_within(const FrGrowthParams *params, const FrReadySpecies *species,
                             uint32_t count, vec3s up) {
    bool *come_within = g_new(bool, count + 1u);
    for (uint32_t i = 0; i < count; i++) {
        come_within[i] = comes_within(params, &species[i], up);
    }
    return come_within;
}

void fr_misplaced_note(FrMisplaced *misplaced, const FrSeed *seed) {
    misplaced->first = misplaced->count == 0 ? seed : misplaced->first;
    misplaced->count++;
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

void fr_misplaced_tell_hindered(const FrMisplaced *hindered, uint32_t count,
                                const FrContext *context) {
    if (hindered->count > 0) {
        const FrSeed *first = hindered->first;
        fr_diags_add(
            context->diags, FR_WARNING, "seed-room", first->span,
            "%u of %u seeds have no room above them for a first internode and hardly "
            "grow, the first of them at %g,%g,%g: an obstacle, the arena or the envelope ends it",
            hindered->count, count, first->at[0], first->at[1], first->at[2]);
    }
}

bool fr_seed_can_rise(const FrGrowthParams *params, vec3s up, double width, const FrSeed *seed) {
    FrSeed risen = *seed;
    for (int axis = 0; axis < 3; axis++) {
        risen.at[axis] += width * (double)up.raw[axis];
    }
    return fr_seed_is_in_arena(params, &risen);
}

enum { CELLS = 3 }; // of a foot: the one of the seed, and those above it

/// Where a seed is looked at: a little above its place, as it may stand on an obstacle, and in the
/// cells above.
static FrPoint3 place_of(const FrSeed *seed, vec3s up, double cell, int k) {
    double above = cell * (k == 0 ? 0.1 : k);
    FrPoint3 place;
    for (int axis = 0; axis < 3; axis++) {
        place.at[axis] = seed->at[axis] + above * (double)up.raw[axis];
    }
    return place;
}

/// The cell of a place; false if it is outside of all.
static bool cell_at(const double origin[3], double width, const double at[3], FrCell *cell) {
    for (int axis = 0; axis < 3; axis++) {
        double where = (at[axis] - origin[axis]) / width;
        if (!(where >= 0 && where < FR_VOXELS_WIDTH)) {
            return false;
        }
        cell->at[axis] = (int16_t)where;
    }
    return true;
}

/// Places by their x, so that a triangle is held against those beside it only.
typedef struct Sorted {
    double x;
    uint32_t place;
} Sorted;

static int compare_x(const void *a, const void *b) {
    double p = ((const Sorted *)a)->x, q = ((const Sorted *)b)->x;
    return (p > q) - (p < q);
}

static Sorted *sort_places(const FrPoint3 *places, uint32_t count) {
    Sorted *sorted = g_new(Sorted, (size_t)count + 1);
    for (uint32_t i = 0; i < count; i++) {
        sorted[i] = (Sorted){places[i].at[0], i};
    }
    qsort(sorted, count, sizeof *sorted, compare_x);
    return sorted;
}

/// The first whose x is not below `least`.
static uint32_t first_from(const Sorted *sorted, uint32_t count, double least) {
    uint32_t low = 0, high = count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (sorted[middle].x < least) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/// Places to look at, and where there is something: in their cells, or on the way from each.
typedef struct Feet {
    const double *origin; ///< of all cells
    double width;         ///< of a cell
    const FrPoint3 *places;
    const FrPoint3 *ends; ///< of the ways; NULL: cells are meant
    double reach;         ///< farther from a place nothing matters, m
    const Sorted *sorted;
    uint32_t count;
    bool *is_taken;
} Feet;

static double determinant(const double a[3], const double b[3], const double c[3]) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// True if a way goes through a triangle: Cramer's rule for where it meets the plane and where in
/// the triangle that is.
static bool crosses(const double from[3], const double to[3], const FrVoxelSurface *triangle) {
    double way[3], side[2][3], base[3];
    const uint32_t *corners = triangle->indices;
    for (int axis = 0; axis < 3; axis++) {
        double first = (double)triangle->positions[corners[0]].raw[axis];
        way[axis] = from[axis] - to[axis];
        base[axis] = from[axis] - first;
        side[0][axis] = (double)triangle->positions[corners[1]].raw[axis] - first;
        side[1][axis] = (double)triangle->positions[corners[2]].raw[axis] - first;
    }
    double all = determinant(way, side[0], side[1]);
    if (all == 0) {
        return false;
    }
    double t = determinant(base, side[0], side[1]) / all;
    double u = determinant(way, base, side[1]) / all, v = determinant(way, side[0], base) / all;
    return t >= 0 && t <= 1 && u >= 0 && v >= 0 && u + v <= 1;
}

static bool meets(const Feet *feet, uint32_t place, const FrVoxelSurface *triangle) {
    const double *at = feet->places[place].at;
    if (feet->ends != NULL) {
        return crosses(at, feet->ends[place].at, triangle);
    }
    FrCell cell;
    return cell_at(feet->origin, feet->width, at, &cell) &&
           fr_voxels_touches(triangle, feet->origin, feet->width, cell);
}

/// Notes the places that one triangle matters to.
static void note_triangle(const Feet *feet, const FrVoxelSurface *triangle) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int corner = 0; corner < 3; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            double at = (double)triangle->positions[triangle->indices[corner]].raw[axis];
            low[axis] = fmin(low[axis], at - feet->reach);
            high[axis] = fmax(high[axis], at + feet->reach);
        }
    }
    uint32_t i = first_from(feet->sorted, feet->count, low[0]);
    for (; i < feet->count && feet->sorted[i].x <= high[0]; i++) {
        uint32_t place = feet->sorted[i].place;
        const double *at = feet->places[place].at;
        if (!feet->is_taken[place] && at[1] >= low[1] && at[1] <= high[1] && at[2] >= low[2] &&
            at[2] <= high[2]) {
            feet->is_taken[place] = meets(feet, place, triangle);
        }
    }
}

static void note_taken(const Feet *feet, const FrGrowthObstacle *obstacle) {
    for (uint32_t i = 0; i + 2 < obstacle->index_count; i += 3) {
        const FrVoxelSurface triangle = {
            .positions = obstacle->positions, .indices = obstacle->indices + i, .index_count = 3};
        note_triangle(feet, &triangle);
    }
}

bool *fr_seeds_find_left_out(const FrGrowthSetup *setup, const double origin[3], double width,
                             vec3s up, const FrSeed *seeds, uint32_t count) {
    size_t places = (size_t)count * CELLS;
    bool *is_held = g_new0(bool, places + 1), *is_taken = g_new0(bool, places + 1);
    FrPoint3 *place = g_new(FrPoint3, places + 1);
    for (size_t i = 0; i < places; i++) {
        place[i] = place_of(&seeds[i / CELLS], up, width, (int)(i % CELLS));
        FrCell cell;
        is_taken[i] = !cell_at(origin, width, place[i].at, &cell);
    }
    Sorted *sorted = sort_places(place, (uint32_t)places);
    const Feet feet = {.origin = origin,
                       .width = width,
                       .places = place,
                       .reach = 2 * width,
                       .sorted = sorted,
                       .count = (uint32_t)places,
                       .is_taken = is_taken};
    for (uint32_t i = 0; i < setup->obstacle_count; i++) {
        const FrGrowthObstacle *obstacle = &setup->obstacles[i];
        if (!obstacle->is_ground) {
            fr_solid_holds(obstacle->positions, obstacle->indices, obstacle->index_count, place,
                           (uint32_t)places, is_held);
            note_taken(&feet, obstacle);
        }
    }
    bool *is_left_out = g_new(bool, (size_t)count + 1);
    for (uint32_t i = 0; i < count; i++) {
        bool is_blocked = true;
        for (size_t k = (size_t)i * CELLS; k < ((size_t)i + 1) * CELLS; k++) {
            is_blocked &= is_held[k] || is_taken[k];
        }
        is_left_out[i] = is_held[(size_t)i * CELLS] || is_blocked ||
                         !fr_seed_is_in_arena(&setup->params, &seeds[i]) ||
                         !fr_seed_can_rise(&setup->params, up, width, &seeds[i]);
    }
    g_free(is_held);
    g_free(is_taken);
    g_free(sorted);
    g_free(place);
    return is_left_out;
}

/// How long a first internode is in so much light; 0: nobody knows its way.
static double first_length(const FrReadySpecies *species, double light) {
    const FrSpeciesParams *params = &species->params;
    if (params->fate == FR_FATE_COLONIZE || fr_species_climbs(params)) {
        return 0;
    }
    double search = 1 + params->search * (1 - 2 * light);
    double length = params->step * CLAMP(search, params->min_length, params->max_length);
    return length * (double)species->shorter[0] * species->orders[0].length;
}

/// How far from its foot obstacles matter to it: below one it has half the light or less, and half
/// a box around its tip must be free, too.
static double headroom_of(const FrReadySpecies *species, double width) {
    double length = first_length(species, 0.5);
    return species->params.collide && length > 0
               ? length + width * (double)(species->params.box / 2)
               : 0;
}

/// True if a first internode, which is `length` long, leaves the envelope that its seed is within,
/// or is longer than the envelope is wide there.
static bool leaves_envelope(const FrReadySpecies *species, double length, vec3s up) {
    vec3s tip = glms_vec3_scale(up, (float)length);
    const FrPoints *outline = &species->params.envelope;
    bool is_turned = species->envelope == NULL && outline->count > 1;
    return length > 0 && fr_envelope_holds(species, (vec3s){{0, 0, 0}}, up) &&
           (!fr_envelope_holds(species, tip, up) ||
            (is_turned && 2 * fr_envelope_radius(outline, length) < length));
}

bool *fr_seeds_find_hindered(const FrGrowthSetup *setup, const FrReadySpecies *species,
                             double width, vec3s up, const FrSeed *seeds, uint32_t count) {
    bool *is_hindered = g_new0(bool, (size_t)count + 1);
    FrPoint3 *from = g_new(FrPoint3, (size_t)count + 1), *to = g_new(FrPoint3, (size_t)count + 1);
    double reach = 0;
    for (uint32_t i = 0; i < count; i++) {
        const FrReadySpecies *of = &species[seeds[i].species];
        double length = first_length(of, 1), room = headroom_of(of, width);
        FrSeed tip = seeds[i];
        from[i] = place_of(&seeds[i], up, width, 1); // what it stands on may reach into its cell
        for (int axis = 0; axis < 3; axis++) {
            tip.at[axis] += length * (double)up.raw[axis];
            to[i].at[axis] =
                room > 0 ? seeds[i].at[axis] + room * (double)up.raw[axis] : from[i].at[axis];
        }
        is_hindered[i] =
            !fr_seed_is_in_arena(&setup->params, &tip) || leaves_envelope(of, length, up);
        reach = fmax(reach, room);
    }
    Sorted *sorted = sort_places(from, count);
    const Feet feet = {.places = from,
                       .ends = to,
                       .reach = reach,
                       .sorted = sorted,
                       .count = count,
                       .is_taken = is_hindered};
    for (uint32_t i = 0; i < setup->obstacle_count; i++) {
        if (!setup->obstacles[i].is_ground) {
            note_taken(&feet, &setup->obstacles[i]);
        }
    }
    g_free(sorted);
    g_free(from);
    g_free(to);
    return is_hindered;
}

void fr_seeds_check(const FrGrowthSetup *setup, double width, vec3s up, const FrSeed *seeds,
                    uint32_t count, const FrContext *context) {
    FrReadySpecies *species = g_new(FrReadySpecies, setup->species_count + 1u);
    for (uint32_t i = 0; i < setup->species_count; i++) {
        species[i] = fr_species_make_ready(&setup->species[i]);
    }
    bool *come_within = fr_species_come_within(&setup->params, species, setup->species_count, up);
    bool *is_hindered = fr_seeds_find_hindered(setup, species, width, up, seeds, count);
    fr_seeds_tell_crowded(species, width, seeds, count, context);
    for (uint32_t i = 0; i < setup->species_count; i++) {
        fr_species_clear_ready(&species[i]);
    }
    g_free(species);
    const double origin[3] = {(double)setup->params.min.x, (double)setup->params.min.y,
                              (double)setup->params.min.z};
    bool *is_left_out = fr_seeds_find_left_out(setup, origin, width, up, seeds, count);
    FrMisplaced outside = {0}, hindered = {0};
    uint32_t left_out = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (is_left_out[i]) {
            left_out++;
        } else if (!come_within[seeds[i].species]) {
            fr_misplaced_note(&outside, &seeds[i]);
        } else if (is_hindered[i]) {
            fr_misplaced_note(&hindered, &seeds[i]);
        }
    }
    const FrSowing sowing = {setup, origin, width, up};
    fr_seeds_tell_left_out(&sowing, seeds, count, is_left_out, left_out == count, context);
    fr_misplaced_tell_outside(&outside, count, context);
    fr_misplaced_tell_hindered(&hindered, count, context);
    g_free(is_hindered);
    g_free(is_left_out);
    g_free(come_within);
}
