#include "studio/model/pace.h"

#include <math.h>

static const double wanted_seconds = 0.030;
static const double least_triangles = 20000, most_triangles = 4e6;
static const double plain_below = 150000; // triangles: too few for light by pixels
// Sides of the picture, and the triangles below which the next smaller one serves better. A larger
// one comes back only at twice as many: it takes time itself.
static const struct { double scale, least; } scales[] = {{1, 40000}, {0.75, 28000}, {0.5, 0}};

StudioPacing studio_pacing_new(void) {
    return (StudioPacing){.triangles = 60000, .scale = 1, .is_plain = true, .rich_from = 400000};
}

static double scale_for(const StudioPacing *pacing) {
    size_t i = 0;
    while (pacing->triangles < (pacing->scale < scales[i].scale ? 2 : 1) * scales[i].least) {
        i++; // the last one has no least
    }
    return scales[i].scale;
}

void studio_pacing_learn(StudioPacing *pacing, double seconds, uint64_t triangles) {
    double factor = fmin(fmax(wanted_seconds / fmax(seconds, 1e-4), 0.6), 1.3);
    bool is_right = factor > 0.8 && factor < 1.25; // leaves that come and go catch the eye
    bool is_used = (double)triangles > 0.5 * pacing->triangles;
    if (!is_right && (is_used || factor < 1)) {
        pacing->triangles = fmin(fmax(pacing->triangles * factor, least_triangles), most_triangles);
    }
    pacing->scale = scale_for(pacing);
    if (pacing->is_plain && pacing->triangles > pacing->rich_from) {
        pacing->is_plain = false;
    } else if (!pacing->is_plain && pacing->triangles < plain_below) {
        pacing->is_plain = true;
        pacing->rich_from *= 4; // it was not fast enough for that: try later
    }
}
