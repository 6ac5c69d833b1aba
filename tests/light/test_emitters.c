// Photons start where the lamps are, each lamp its share, evenly.
#include "light/emitters.h"

#include <cglm/struct.h>

enum { PHOTONS = 65536, GRID = 16 };

static FrKey key_of(uint64_t photon) {
    return fr_key_child(fr_key_root(3), photon);
}

static void test_shares(void) {
    FrLamp lamps[4] = {{.kind = FR_LAMP_POINT, .power = 1, .position = {{1, 0, 0}}},
                       {.kind = FR_LAMP_POINT, .power = 0, .position = {{2, 0, 0}}},
                       {.kind = FR_LAMP_POINT, .power = 5, .position = {{3, 0, 0}}},
                       {.kind = FR_LAMP_POINT, .power = 2, .position = {{4, 0, 0}}}};
    uint32_t counts[5] = {0};
    FrEmitters *emitters = fr_emitters_new(lamps, 4, (vec3s){{0, 0, 0}}, (vec3s){{1, 1, 1}});
    g_assert_cmpfloat(fr_emitters_power(emitters), ==, 8.0);
    for (uint32_t i = 0; i < 1001; i++) {
        FrEmission emission = fr_emitters_emit(emitters, key_of(i), i, 1001);
        counts[(int)emission.origin[0]]++;
    }
    for (int i = 0; i < 4; i++) {
        double share = 1001.0 * lamps[i].power / 8.0;
        g_assert_cmpfloat(fabs((double)counts[i + 1] - share), <=, 1.0);
    }
    g_assert_cmpuint(counts[2], ==, 0);
    fr_emitters_free(emitters);
}

// One photon in each of as many cells, so the coarser cells hold equally many.
static void assert_even(const FrLamp *lamp, int across, int along, float corner, float side) {
    uint32_t counts[GRID][GRID] = {{0}};
    FrEmitters *emitters = fr_emitters_new(lamp, 1, (vec3s){{0, 0, 0}}, (vec3s){{2, 2, 2}});
    for (uint32_t i = 0; i < PHOTONS; i++) {
        FrEmission emission = fr_emitters_emit(emitters, key_of(i), i, PHOTONS);
        int a = (int)(GRID * (emission.origin[across] - corner) / side);
        int b = (int)(GRID * (emission.origin[along] - corner) / side);
        g_assert_true(a >= 0 && a < GRID && b >= 0 && b < GRID);
        counts[a][b]++;
    }
    for (int a = 0; a < GRID; a++) {
        for (int b = 0; b < GRID; b++) {
            g_assert_cmpuint(counts[a][b], ==, PHOTONS / (GRID * GRID));
        }
    }
    fr_emitters_free(emitters);
}

static void test_even(void) {
    FrLamp sun = {.kind = FR_LAMP_SUN, .power = 3, .direction = {{0, 0, -1}}};
    FrLamp area = {.kind = FR_LAMP_AREA,
                   .power = 1,
                   .position = {{0.5f, 0.5f, 1}},
                   .side = {{{1, 0, 0}}, {{0, 1, 0}}}};
    assert_even(&sun, 0, 1, 0.0f, 2.0f);
    assert_even(&area, 0, 1, 0.5f, 1.0f);
    FrEmitters *emitters = fr_emitters_new(&sun, 1, (vec3s){{0, 0, 0}}, (vec3s){{2, 2, 2}});
    g_assert_cmpfloat(fr_emitters_power(emitters), ==, 12.0);
    fr_emitters_free(emitters);
}

// The mean of a function of direction over a sky of brightness b that is seen through a cube:
// Σ b A f / Σ b A on a fine grid of directions, A the area of the cube seen from there.
static double mean_height(const FrLamp *sky) {
    double sum = 0.0, weight = 0.0;
    for (int i = 0; i < 400; i++) {
        for (int k = 0; k < 400; k++) {
            double z = (i + 0.5) / 400, turn = 2.0 * G_PI * (k + 0.5) / 400, side = sqrt(1 - z * z);
            vec3s to = {{(float)(side * cos(turn)), (float)(side * sin(turn)), (float)z}};
            double seen = fabs((double)to.x) + fabs((double)to.y) + z;
            double part = fr_lamp_sky_brightness(sky, to) * seen;
            sum += part * z;
            weight += part;
        }
    }
    return sum / weight;
}

static void test_sky(void) {
    for (int kind = FR_SKY_UNIFORM; kind <= FR_SKY_CLEAR; kind++) {
        FrLamp sky = {
            .kind = FR_LAMP_SKY, .power = 1, .sky = (FrSkyKind)kind, .sun = {{0.6f, 0, 0.8f}}};
        FrEmitters *emitters = fr_emitters_new(&sky, 1, (vec3s){{-1, -1, -1}}, (vec3s){{1, 1, 1}});
        double sum = 0.0;
        for (uint32_t i = 0; i < PHOTONS; i++) {
            FrEmission emission = fr_emitters_emit(emitters, key_of(i), i, PHOTONS);
            g_assert_cmpfloat(emission.direction[2], <, 0.0f);
            sum -= (double)emission.direction[2];
        }
        g_assert_cmpfloat_with_epsilon(sum / PHOTONS, mean_height(&sky), 0.005);
        fr_emitters_free(emitters);
    }
}

static void test_neighbours(void) {
    FrLamp sun = {.kind = FR_LAMP_SUN, .power = 3, .direction = {{0, 0, -1}}};
    FrEmitters *emitters = fr_emitters_new(&sun, 1, (vec3s){{0, 0, 0}}, (vec3s){{1, 1, 1}});
    double sum = 0.0;
    for (uint32_t i = 0; i + 1 < PHOTONS; i++) {
        FrEmission a = fr_emitters_emit(emitters, key_of(i), i, PHOTONS);
        FrEmission b = fr_emitters_emit(emitters, key_of(i + 1), i + 1, PHOTONS);
        sum += hypot((double)(a.origin[0] - b.origin[0]), (double)(a.origin[1] - b.origin[1]));
    }
    // The cells are 1/256 wide; any two photons are half a metre apart on average.
    g_assert_cmpfloat(sum / PHOTONS, <, 4.0 / 256);
    fr_emitters_free(emitters);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/emitters/every lamp sends its share", test_shares);
    g_test_add_func("/light/emitters/photons start evenly", test_even);
    g_test_add_func("/light/emitters/skies shine from where they are bright", test_sky);
    g_test_add_func("/light/emitters/neighbours start side by side", test_neighbours);
    return g_test_run();
}
