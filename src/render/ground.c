// Ground patterns from one tile of fractal noise, read at several scales that never repeat
// together.
#include "render/ground.h"

#include "frond/noise.h"
#include "render/colour.h"

#include <glib.h>
#include <math.h>

enum { GROUND_CELLS = 256, GROUND_OCTAVES = 6 };

FrGround *fr_ground_new(vec3s colour, float variation) {
    FrGround *ground = g_new0(FrGround, 1);
    ground->colour = colour;
    ground->variation = variation;
    ground->haze = INFINITY;
    ground->height = g_new(float, GROUND_CELLS *GROUND_CELLS);
    FrKey key = fr_key_name("ground");
    for (int y = 0; y < GROUND_CELLS; y++) {
        for (int x = 0; x < GROUND_CELLS; x++) {
            double sum = 0.0;
            double weight = 0.5;
            int period = 4;
            for (int octave = 0; octave < GROUND_OCTAVES; octave++) {
                double scale = (double)period / GROUND_CELLS;
                sum += weight * fr_noise2_tiled(fr_key_child(key, (uint64_t)octave), x * scale,
                                                y * scale, period);
                weight *= 0.62;
                period *= 2;
            }
            ground->height[y * GROUND_CELLS + x] = (float)sum;
        }
    }
    return ground;
}

void fr_ground_free(FrGround *ground) {
    if (ground != NULL) {
        g_free(ground->height);
        g_free(ground);
    }
}

/// The tile, `size` metres wide, at a point; `slope` receives its gradient per cell.
static float tile_at(const FrGround *ground, float x, float y, float size, float *slope_x,
                     float *slope_y) {
    double scale = GROUND_CELLS / (double)size;
    double px = ((double)x + ground->origin[0]) * scale;
    double py = ((double)y + ground->origin[1]) * scale;
    double left = floor(px);
    double low = floor(py);
    float fx = (float)(px - left);
    float fy = (float)(py - low);
    int64_t column = fabs(left) < 1e15 ? (int64_t)left : 0;
    int64_t row = fabs(low) < 1e15 ? (int64_t)low : 0;
    size_t x0 = (size_t)(column & (GROUND_CELLS - 1));
    size_t x1 = (size_t)((column + 1) & (GROUND_CELLS - 1));
    size_t y0 = (size_t)(row & (GROUND_CELLS - 1)) * GROUND_CELLS;
    size_t y1 = (size_t)((row + 1) & (GROUND_CELLS - 1)) * GROUND_CELLS;
    float a = ground->height[y0 + x0];
    float b = ground->height[y0 + x1];
    float c = ground->height[y1 + x0];
    float d = ground->height[y1 + x1];
    *slope_x = (b - a) * (1.0f - fy) + (d - c) * fy;
    *slope_y = (c - a) * (1.0f - fx) + (d - b) * fx;
    return (a * (1.0f - fx) + b * fx) * (1.0f - fy) + (c * (1.0f - fx) + d * fx) * fy;
}

vec3s fr_ground_colour(const FrGround *ground, float x, float y) {
    if (ground->variation <= 0.0f) {
        return ground->colour;
    }
    float sx;
    float sy;
    float fine = tile_at(ground, x, y, 2.9f, &sx, &sy);
    float middle = tile_at(ground, y, x, 17.3f, &sx, &sy);
    float coarse = tile_at(ground, x, y, 131.0f, &sx, &sy);
    float light = 1.0f + ground->variation * (0.55f * fine + 0.45f * middle + 0.35f * coarse);
    // Patches drift between drier, redder and fresher, greener ground.
    float dry = ground->variation * (0.25f * middle + 0.2f * coarse);
    vec3s colour = glms_vec3_scale(ground->colour, fmaxf(light, 0.2f));
    colour.r *= 1.0f + 0.5f * dry;
    colour.b *= 1.0f - 0.3f * dry;
    return glms_vec3_minv(colour, glms_vec3_one());
}

vec3s fr_ground_normal(const FrGround *ground, float x, float y) {
    if (ground->variation <= 0.0f) {
        return (vec3s){{0, 0, 1}};
    }
    float fine_x;
    float fine_y;
    float coarse_x;
    float coarse_y;
    tile_at(ground, x, y, 0.83f, &fine_x, &fine_y);
    tile_at(ground, x, y, 4.7f, &coarse_x, &coarse_y);
    float strength = 1.6f * ground->variation;
    return glms_vec3_normalize(
        (vec3s){{-strength * (fine_x + coarse_x), -strength * (fine_y + coarse_y), 1.0f}});
}
