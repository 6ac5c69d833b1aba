/// Dart throwing (Cook 1986): places by chance, kept where nothing is near.
#include "studio/model/brush.h"

#include "frond/random.h"

#include <math.h>

enum { MOST_DARTS = 4000 };

static const double tries = 8;     // for each plant that there is room for
static const double packing = 0.7; // densest strewing by darts: this over the spacing's square

double studio_brush_spacing(double density) {
    return sqrt(packing / fmax(density, 1e-9));
}

static bool is_near(const GArray *taken, const double at[2], double spacing) {
    for (guint i = 0; i < taken->len; i++) {
        const double *other = &g_array_index(taken, double, 2 * i);
        if (hypot(other[0] - at[0], other[1] - at[1]) < spacing) {
            return true;
        }
    }
    return false;
}

GArray *studio_brush_dab(const StudioBrush *brush, uint64_t dab, const double at[2],
                         GArray *taken) {
    GArray *places = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    double spacing = studio_brush_spacing(brush->density);
    double room = G_PI * brush->radius * brush->radius * brush->density;
    uint64_t darts = (uint64_t)fmin(ceil(tries * room) + 1, MOST_DARTS);
    FrKey key = fr_key_child(fr_key_root(brush->seed), dab);
    for (uint64_t i = 0; i < darts; i++) {
        FrKey dart = fr_key_child(key, i);
        double away = brush->radius * sqrt(fr_random(dart, 0, 0));
        double turn = 2 * G_PI * fr_random(dart, 0, 1);
        double place[2] = {at[0] + away * cos(turn), at[1] + away * sin(turn)};
        if (!is_near(taken, place, spacing)) {
            g_array_append_vals(taken, place, 1);
            g_array_append_vals(places, place, 1);
        }
    }
    return places;
}
