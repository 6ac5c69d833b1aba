// Ground patterns from one tile of fractal noise, read at several scales and at places that drift
// over the ground, two of them blended, after I. Quilez, "Texture repetition" (2015).
#include "render/ground.h"

#include "frond/noise.h"
#include "render/colour.h"

#include <glib.h>
#include <math.h>

enum { GROUND_CELLS = 256, GROUND_OCTAVES = 6 };
#define PATCH_TILES 1.7  // a layer keeps its place over so many of its tiles
#define DRIFT_PLACES 5.0 // and changes among so many places to either side

FrGround *fr_ground_new(vec3s colour, float variation) {
    FrGround *ground = g_new0(FrGround, 1);
    ground->colour = colour;
    ground->variation = variation;
    ground->haze = INFINITY;
    ground->height = g_new(float, GROUND_CELLS *GROUND_CELLS);
    FrKey key = ground->key = fr_key_name("ground");
    for (int y = 0; y < GROUND_CELLS; y++) {
        for (int x = 0; x < GROUND_CELLS; x++) {
            double sum = 0.0;
            double weight = 0.4;
            int period = 4;
            for (int octave = 0; octave < GROUND_OCTAVES; octave++) {
                double scale = (double)period / GROUND_CELLS;
                sum += weight * fr_noise2_tiled(fr_key_child(key, (uint64_t)octave), x * scale,
                                                y * scale, period);
                weight *= 0.75;
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

/// How the tile is laid: its width in metres and by how much it is turned. No two layers repeat in
/// the same direction.
typedef struct Layer {
    double size, cosine, sine;
} Layer;

static const Layer grain_layer = {0.61, 0.8, 0.6};
static const Layer fine_layer = {2.9, 0.923076923076923, -0.384615384615385};
static const Layer middle_layer = {17.3, 0.28, 0.96};
static const Layer coarse_layer = {131.0, 0.6, -0.8};

/// The tile at a point; (slope_x, slope_y) receives its gradient per cell, along x and y.
static float tile_at(const FrGround *ground, float x, float y, Layer layer, float *slope_x,
                     float *slope_y) {
    double scale = GROUND_CELLS / layer.size;
    double world_x = ((double)x + ground->origin[0]) * scale;
    double world_y = ((double)y + ground->origin[1]) * scale;
    double px = layer.cosine * world_x + layer.sine * world_y;
    double py = layer.cosine * world_y - layer.sine * world_x;
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
    float slope_u = (b - a) * (1.0f - fy) + (d - c) * fy;
    float slope_v = (c - a) * (1.0f - fx) + (d - b) * fx;
    float cosine = (float)layer.cosine;
    float sine = (float)layer.sine;
    *slope_x = cosine * slope_u - sine * slope_v;
    *slope_y = sine * slope_u + cosine * slope_v;
    return (a * (1.0f - fx) + b * fx) * (1.0f - fy) + (c * (1.0f - fx) + d * fx) * fy;
}

/// The tile from two places of it, blended: the places change over the ground, so a layer never
/// repeats itself. Gradient as tile_at.
static float drifting(const FrGround *ground, float x, float y, Layer layer, float *slope_x,
                      float *slope_y) {
    double patch = PATCH_TILES * layer.size;
    double drift = DRIFT_PLACES * fr_noise2(ground->key, ((double)x + ground->origin[0]) / patch,
                                            ((double)y + ground->origin[1]) / patch);
    double place = floor(drift);
    float part = (float)(drift - place);
    part = part * part * (3.0f - 2.0f * part);
    float height = 0.0f;
    *slope_x = *slope_y = 0.0f;
    for (int i = 0; i < 2; i++) {
        FrKey key = fr_key_child(ground->key, (uint64_t)((int64_t)place + i));
        float shift_x = (float)(layer.size * fr_random(key, 0, 0));
        float shift_y = (float)(layer.size * fr_random(key, 0, 1));
        float along_x;
        float along_y;
        float weight = i == 0 ? 1.0f - part : part;
        height += weight * tile_at(ground, x + shift_x, y + shift_y, layer, &along_x, &along_y);
        *slope_x += weight * along_x;
        *slope_y += weight * along_y;
    }
    return height;
}

FrGroundPoint fr_ground_at(const FrGround *ground, float x, float y) {
    if (ground->variation <= 0.0f) {
        return (FrGroundPoint){ground->colour, {{0, 0, 1}}};
    }
    float grain_x, grain_y, fine_x, fine_y, unused;
    float grain = drifting(ground, x, y, grain_layer, &grain_x, &grain_y);
    float fine = drifting(ground, x, y, fine_layer, &fine_x, &fine_y);
    float middle = drifting(ground, x, y, middle_layer, &unused, &unused);
    float coarse = tile_at(ground, x, y, coarse_layer, &unused, &unused);
    float light = 1.2f * grain + 0.7f * fine + 0.4f * middle + 0.3f * coarse;
    vec3s colour = glms_vec3_scale(ground->colour, expf(ground->variation * light));
    // Patches drift between dry, reddish and fresh, greenish ground.
    float dry = ground->variation * (0.4f * grain + 0.3f * fine + 0.7f * middle + 0.5f * coarse);
    colour.r *= 1.0f + 0.35f * dry;
    colour.g *= 1.0f - 0.1f * dry;
    colour.b *= 1.0f - 0.2f * dry;
    float strength = 4.0f * ground->variation;
    return (FrGroundPoint){
        .colour = glms_vec3_clamp(colour, 0.0f, 1.0f),
        .normal = glms_vec3_normalize(
            (vec3s){{-strength * (grain_x + fine_x), -strength * (grain_y + fine_y), 1.0f}}),
    };
}
