#include "render/ground.h"

#include "render/colour.h"

#include <glib.h>
#include <math.h>

enum { SAMPLES = 4000 };

static float brightness(const FrGround *ground, double x, double y) {
    return fr_luminance(fr_ground_at(ground, (float)x, (float)y).colour);
}

/// Correlation of the brightness along a line with that along the line shifted.
static double likeness(const FrGround *ground, double shift_x, double shift_y) {
    double sums[5] = {0};
    for (int i = 0; i < SAMPLES; i++) {
        double x = 0.0137 * i;
        double y = 0.0071 * i;
        double a = (double)brightness(ground, x, y);
        double b = (double)brightness(ground, x + shift_x, y + shift_y);
        double terms[5] = {a, b, a * a, b * b, a * b};
        for (int k = 0; k < 5; k++) {
            sums[k] += terms[k] / SAMPLES;
        }
    }
    double spread = sqrt((sums[2] - sums[0] * sums[0]) * (sums[3] - sums[1] * sums[1]));
    return (sums[4] - sums[0] * sums[1]) / spread;
}

static void test_no_repeats(void) {
    FrGround *ground = fr_ground_new((vec3s){{0.3f, 0.3f, 0.3f}}, 0.6f);
    g_assert_cmpfloat(likeness(ground, 0.001, 0.0), >, 0.8);
    // The widths of the tiles, along the directions they are laid in.
    static const double shifts[][2] = {{0.488, 0.366},   {-0.366, 0.488}, {2.6769, -1.1154},
                                       {1.1154, 2.6769}, {4.844, 16.608}, {-16.608, 4.844}};
    for (size_t i = 0; i < G_N_ELEMENTS(shifts); i++) {
        g_assert_cmpfloat(fabs(likeness(ground, shifts[i][0], shifts[i][1])), <, 0.35);
    }
    fr_ground_free(ground);
}

/// How far the pattern around a place runs in one direction: the coherence of its structure tensor,
/// 0 for none, 1 for stripes.
static double coherence(const FrGround *ground, double x, double y) {
    const double step = 0.004;
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (int i = 0; i < 400; i++) {
        double px = x + 0.02 * (i % 20);
        double py = y + 0.02 * (i / 20);
        double here = (double)brightness(ground, px, py);
        double along_x = (double)brightness(ground, px + step, py) - here;
        double along_y = (double)brightness(ground, px, py + step) - here;
        xx += along_x * along_x;
        xy += along_x * along_y;
        yy += along_y * along_y;
    }
    return hypot(xx - yy, 2.0 * xy) / (xx + yy);
}

static void test_no_streaks(void) {
    FrGround *ground = fr_ground_new((vec3s){{0.3f, 0.3f, 0.3f}}, 0.6f);
    double sum = 0.0;
    for (int i = 0; i < 100; i++) {
        sum += coherence(ground, 3.1 * (i % 10), 2.7 * (i / 10)) / 100.0;
    }
    g_assert_cmpfloat(sum, <, 0.28);
    fr_ground_free(ground);
}

static void test_mean(void) {
    FrGround *ground = fr_ground_new((vec3s){{0.3f, 0.2f, 0.1f}}, 0.6f);
    double sum = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        sum += (double)brightness(ground, 1.37 * i, 0.71 * i) / SAMPLES;
    }
    double wanted = (double)fr_luminance(ground->colour);
    g_assert_cmpfloat(fabs(sum / wanted - 1.0), <, 0.1);
    fr_ground_free(ground);
}

static void test_origin(void) {
    FrGround *here = fr_ground_new((vec3s){{0.3f, 0.3f, 0.3f}}, 0.6f);
    FrGround *there = fr_ground_new((vec3s){{0.3f, 0.3f, 0.3f}}, 0.6f);
    there->origin[0] = 128.0;
    there->origin[1] = -64.0;
    for (int i = 0; i < 100; i++) {
        double x = 0.37 * i;
        float a = brightness(here, x + 128.0, -64.0);
        float b = brightness(there, x, 0.0);
        g_assert_cmpfloat(fabsf(a - b), <, 0.02f);
    }
    fr_ground_free(here);
    fr_ground_free(there);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/ground/no layer of the ground repeats itself", test_no_repeats);
    g_test_add_func("/render/ground/no streaks run over the ground", test_no_streaks);
    g_test_add_func("/render/ground/the ground has the colour asked for on the whole", test_mean);
    g_test_add_func("/render/ground/patches stay where they are in the world", test_origin);
    return g_test_run();
}
