#include "studio/model/growth_marks.h"

#include "studio/model/light_marks.h"

#include <math.h>

enum { MOST_CELLS = 6000, MOST_PARTICLES = 200000 };

static const double feeler = 0.25; // m, to the light of a bud in full light

StudioOverlay *studio_bud_marks(const FrGrowth *growth, double apart) {
    static const float asleep[4] = {0.62f, 0.62f, 0.62f, 0.55f};
    StudioOverlay *overlay = studio_overlay_new();
    double(*shifts)[2] = fr_growth_spread(growth, apart);
    GArray *buds = fr_growth_buds(growth);
    for (guint i = 0; i < buds->len; i++) {
        const FrGrowthBud *bud = &g_array_index(buds, FrGrowthBud, i);
        double at[3], end[3];
        float colour[4];
        studio_light_colour(0.2f + 0.8f * bud->light, 1, colour);
        for (int c = 0; c < 3; c++) {
            at[c] = (double)bud->at.raw[c] + (c < 2 ? shifts[bud->plant][c] : 0);
            end[c] = at[c] + feeler * (double)(bud->light * bud->towards.raw[c]);
        }
        studio_overlay_point(overlay, at, bud->is_growing ? 6 : 3,
                             bud->is_growing ? colour : asleep);
        if (bud->is_growing) {
            studio_overlay_line(overlay, at, end, 1.2, colour);
        }
    }
    g_array_unref(buds);
    g_free(shifts);
    return overlay;
}

// Hues that follow each other by the golden ratio, so that neighbours differ.
static void colour_of_plant(uint32_t plant, float colour[4]) {
    double hue = fmod(plant * 0.61803398875, 1) * 6;
    for (int c = 0; c < 3; c++) {
        double away = fabs(remainder(hue - 2 * c, 6));
        colour[c] = (float)(0.35 + 0.6 * CLAMP(2 - away, 0, 1));
    }
    colour[3] = 0.35f;
}

StudioOverlay *studio_voxel_marks(const FrGrowth *growth, double apart) {
    StudioOverlay *overlay = studio_overlay_new();
    double(*shifts)[2] = fr_growth_spread(growth, apart);
    GArray *cells = fr_growth_cells(growth, MOST_CELLS);
    for (guint i = 0; i < cells->len; i++) {
        const FrGrowthCell *cell = &g_array_index(cells, FrGrowthCell, i);
        float colour[4] = {0.7f, 0.7f, 0.7f, 0.25f};
        double min[3], max[3];
        if (cell->plant != FR_NONE) {
            colour_of_plant(cell->plant, colour);
        }
        for (int c = 0; c < 3; c++) {
            bool goes = c < 2 && cell->plant != FR_NONE;
            min[c] = cell->min[c] + (goes ? shifts[cell->plant][c] : 0);
            max[c] = min[c] + cell->width;
        }
        studio_overlay_box(overlay, min, max, 1, colour);
    }
    g_array_unref(cells);
    g_free(shifts);
    return overlay;
}

static uint32_t nearest_plant(const FrGrowth *growth, const double at[3]) {
    uint32_t nearest = FR_NONE;
    double best = INFINITY;
    for (uint32_t i = 0; i < fr_growth_plant_count(growth); i++) {
        FrSeed seed = fr_growth_seed(growth, i);
        double away = hypot(at[0] - seed.at[0], at[1] - seed.at[1]);
        if (away < best) {
            best = away;
            nearest = i;
        }
    }
    return nearest;
}

StudioOverlay *studio_particle_marks(const FrGrowth *growth, double apart) {
    static const float rim[4] = {0.55f, 0.56f, 0.58f, 1}, black[4] = {0, 0, 0, 1};
    static const float blue[4] = {0.25f, 0.55f, 1, 1};
    StudioOverlay *overlay = studio_overlay_new();
    uint64_t count;
    bool *is_active;
    FrParticle *particles = fr_growth_particles(growth, &count, &is_active);
    uint64_t step = count / MOST_PARTICLES + 1;
    double(*shifts)[2] = fr_growth_spread(growth, apart);
    for (uint64_t i = 0; i < count; i += step) {
        double at[3] = {(double)particles[i].at.x, (double)particles[i].at.y,
                        (double)particles[i].at.z};
        if (particles[i].w != 1) {
            continue; // a direction is nowhere
        }
        uint32_t plant = apart > 0 ? nearest_plant(growth, at) : FR_NONE;
        for (int c = 0; c < 2 && plant != FR_NONE; c++) {
            at[c] += shifts[plant][c];
        }
        if (is_active[i]) {
            studio_overlay_point(overlay, at, 5, blue);
        } else { // black is seen on dark, too
            studio_overlay_point(overlay, at, 5, rim);
            studio_overlay_point(overlay, at, 3.5, black);
        }
    }
    g_free(shifts);
    g_free(particles);
    g_free(is_active);
    return overlay;
}
