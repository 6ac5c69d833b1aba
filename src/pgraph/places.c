#include "pgraph/places.h"

#include "pgraph/params.h"

#include <math.h>

#define SMALLEST_GAP 0.01 // of the first
#define MOST_GROWTH 500.0 // of the logarithm of gaps

static double between(double low, double value, double high) {
    return value < low ? low : value > high ? high : value;
}

static double density_below(const FrDensity *density, double at) {
    double step = between(0, at, 1) * FR_DENSITY_STEPS;
    int k = (int)step < FR_DENSITY_STEPS ? (int)step : FR_DENSITY_STEPS - 1;
    return density->below[k] + (step - k) * (density->below[k + 1] - density->below[k]);
}

double fr_density_place(const FrDensity *density, double start, double end, double part) {
    double low = density_below(density, start);
    double high = density_below(density, end);
    if (!(high > low)) {
        return start + part * (end - start);
    }
    double wanted = low + part * (high - low);
    int first = 0, last = FR_DENSITY_STEPS; // below[first] ≤ wanted, as far as known
    while (last - first > 1) {
        int middle = (first + last) / 2;
        *(density->below[middle] <= wanted ? &first : &last) = middle;
    }
    double rise = density->below[last] - density->below[first];
    double inside = rise > 0 ? (wanted - density->below[first]) / rise : 0;
    return between(start, (first + between(0, inside, 1)) / FR_DENSITY_STEPS, end);
}

// Gaps that each are `ratio` of the one before: k of them together, in first ones.
static double gaps_to(double k, double ratio) {
    return ratio == 1 ? k : expm1(k * log(ratio)) / (ratio - 1);
}

double fr_places_within(double stretch, double ratio) {
    double gaps = stretch;
    if (ratio != 1) {
        // Shrinking gaps end where they are a hundredth of the first.
        double rest = 1 + (ratio - 1) * stretch;
        gaps = log(fmax(rest, ratio < 1 ? SMALLEST_GAP : 1)) / log(ratio);
    }
    return floor(gaps + 1e-6) + 1;
}

// k such gaps over all of them.
static double part_of_gaps(double k, double all, double ratio) {
    double growth = log(ratio);
    if (growth * all > MOST_GROWTH) { // what exponentials can hold
        return exp(growth * (k - all));
    }
    return all > 0 ? expm1(k * growth) / expm1(all * growth) : 0;
}

// Where the gaps shrink or grow: place k, shifted by a part of its gap, over all of them.
static double part_by_ratio(const FrPlaces *places, double k, double shift) {
    double all = places->is_at_ends ? (double)places->count - 1 : (double)places->count;
    double from = part_of_gaps(k, all, places->ratio), to = part_of_gaps(k + 1, all, places->ratio);
    double inside = (places->is_at_ends ? 0 : 0.5) + shift;
    return from + inside * (to - from);
}

double fr_place_at(const FrPlaces *places, uint32_t k) {
    double shift = 0;
    if (places->irregularity > 0) {
        shift = 0.5 * places->irregularity *
                fr_random_signed(places->key, fr_purpose(FR_TREE_regularity), k);
    }
    if (places->pitch > 0) {
        double at = places->start + gaps_to((double)k + shift, places->ratio) * places->pitch;
        return between(places->start, at, places->end);
    }
    double part = places->is_at_ends
                      ? (places->count > 1 ? ((double)k + shift) / (places->count - 1) : 0)
                      : ((double)k + 0.5 + shift) / places->count;
    if (places->ratio != 1) {
        part = part_by_ratio(places, k, shift);
    }
    part = between(0, part, 1);
    if (places->density != NULL) {
        return fr_density_place(places->density, places->start, places->end, part);
    }
    return places->start + part * (places->end - places->start);
}
