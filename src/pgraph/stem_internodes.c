// How many internodes a stem is cut into where nobody says: so many that its form shows.
#include "pgraph/stem.h"

#include "pgraph/along.h"

#include <math.h>

#define PI 3.14159265358979323846
#define DEGREE (PI / 180)

enum { MOST_ADAPTIVE = 256, INTERNODES_OF_PROFILE = 8, MOST_BEADS = 1000 };
enum { INTERNODES_OF_FLARE = 4, MOST_FOR_FLARE = 32 };
enum { INTERNODES_OF_BUTTRESS = 8, MOST_FOR_BUTTRESS = 64, INTERNODES_OF_FURROW = 3 };

// An internode for so many radians of turn, so few that no joint shows, and some for any bend.
#define BEND_PER_INTERNODE (4 * DEGREE)
#define LEAST_BEND (1 * DEGREE)
#define LEAST_INTERNODES_OF_BEND 3
#define INTERNODE_OF_WELD 1.0 // over the stem's radius
#define MOST_FOR_WELD 64
// A gnarl makes so many times its own angle of turn, and shows less of each; never more internodes
// for one gnarl than show its form.
#define GNARL_PER_INTERNODE (12 * DEGREE)
#define TURNS_PER_GNARL 2.5
#define INTERNODES_PER_GNARL 5.0

// How large a parameter is, on the average where it differs along the stem.
static double size_of(const FrStem *stem, FrAlong which, double value) {
    return fr_is_along(stem, which) ? fr_along_size(stem, which) : fabs(value);
}

// Rings that ridges and furrows show on stand at nodes.
static double finished_internodes(const FrStem *stem) {
    const FrFinishParams *finish = &stem->prepared->finished;
    double count = 0, radius = stem->radius * (1 + stem->flare);
    if (finish->buttresses > 0 && radius > 0) {
        double each = finish->buttress_height * radius / INTERNODES_OF_BUTTRESS;
        count = fmin(stem->length / each, MOST_FOR_BUTTRESS);
    }
    if (finish->relief > 0 && stem->radius > 0) {
        double furrow = 2 * PI * stem->radius * finish->relief_stretch / finish->relief_count;
        count = fmax(count, INTERNODES_OF_FURROW * stem->length / furrow);
    }
    return count;
}

// Holes reach from ring to ring, and rings stand at nodes: few far apart would meet.
static double welded_internodes(const FrStem *stem) {
    const FrTreeParams *tree = stem->prepared->params;
    bool is_free = stem->prepared->bears_welded && stem->radius > 0 &&
                   tree->mode != FR_BRANCHES_AT_NODES; // which would be more then
    return is_free ? fmin(stem->length / (INTERNODE_OF_WELD * stem->radius), MOST_FOR_WELD) : 0;
}

// So many that a gnarl shows, at least `count`.
static double internodes_of_gnarl(double count, double gnarl, double frequency) {
    if (gnarl > 0) {
        double most = INTERNODES_PER_GNARL * frequency;
        double wanted = TURNS_PER_GNARL * gnarl * frequency / GNARL_PER_INTERNODE;
        count = fmax(count, fmin(most, fmax(wanted, frequency)));
    }
    return count;
}

static double mean_sag(const FrStem *stem) {
    enum { PLACES = 8 };
    double sum = 0;
    for (int k = 0; k < PLACES; k++) {
        sum += fr_stem_sag(stem, (k + 0.5) / PLACES) / PLACES;
    }
    return sum;
}

uint32_t fr_stem_internodes(const FrStem *stem) {
    const FrStemParams *params = stem->prepared->params;
    if (stem->prepared->is_string) {
        double beads = stem->radius > 0 ? stem->length / (2 * stem->radius) : 1;
        return (uint32_t)fmax(1, fmin(beads, MOST_BEADS));
    }
    double turn = size_of(stem, FR_ALONG_CURVATURE, stem->curvature) * stem->prepared->bend_factor;
    double pull = size_of(stem, FR_ALONG_PHOTOTROPISM, stem->tropism.up) +
                  size_of(stem, FR_ALONG_GRAVITROPISM, stem->tropism.down) +
                  size_of(stem, FR_ALONG_PLAGIOTROPISM, stem->tropism.flat);
    pull += fabs(stem->align) + fabs(stem->aim) + (stem->elasticity > 0 ? mean_sag(stem) : 0);
    turn += PI * (1 - exp(-pull)) + fabs(stem->bend) + fabs(stem->bend_aside) +
            fabs(stem->curvature_back);
    double count = turn / BEND_PER_INTERNODE;
    if (turn > LEAST_BEND) {
        count = fmax(count, LEAST_INTERNODES_OF_BEND);
    }
    count = internodes_of_gnarl(count, size_of(stem, FR_ALONG_GNARL, stem->gnarl),
                                stem->gnarl_frequency);
    count = internodes_of_gnarl(count, stem->gnarl_fine, stem->gnarl_fine_frequency);
    if (params->profile != NULL || fr_is_along(stem, FR_ALONG_RADIUS)) {
        count = fmax(count, INTERNODES_OF_PROFILE);
    }
    if (stem->flare > 0) {
        count = fmax(count, fmin(INTERNODES_OF_FLARE / params->flare_height, MOST_FOR_FLARE));
    }
    count = fmax(count, fmax(finished_internodes(stem), welded_internodes(stem)));
    if (stem->step > 0) {
        count = fmax(count, stem->length / stem->step);
    }
    return (uint32_t)fmin(fmax(ceil(count - 1e-9), 1), MOST_ADAPTIVE);
}
