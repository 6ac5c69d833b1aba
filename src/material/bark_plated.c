// Bark of pine and plane: many-sided plates with dark cracks between them, each plate flaking off
// in thin layers.

#include <math.h>

#include "material/bark.h"

enum { KEY_PLATES, KEY_BEND, KEY_LAYERS, KEY_GRAIN, KEY_TONE, KEY_SPLITS, KEY_RUST };

typedef struct Plated {
    FrBarkCells plates, splits;
    vec3s top, deep;
    FrKey key;
} Plated;

static FrKey child(const Plated *bark, uint64_t word) {
    return fr_key_child(bark->key, word);
}

/// Steps of a staircase with rounded edges: the layers of a plate from above.
static float layered(float value, float layers, float *rim) {
    float scaled = value * layers, step = floorf(scaled);
    float part = scaled - step;
    *rim = fr_bark_smooth(0.16f, 0.0f, part) + 0.5f * fr_bark_smooth(0.86f, 1.0f, part);
    return (step + fr_bark_smooth(0.0f, 0.16f, part)) / layers;
}

typedef struct Place {
    float height; ///< 0 in a crack to 1 on the highest layer
    float crack;  ///< 1 in a crack between plates
    float rim;    ///< 1 at the broken edge of a layer
    float random; ///< of the plate
} Place;

static Place place_at(const Plated *bark, float u, float v) {
    float bend = fr_bark_fractal(child(bark, KEY_BEND), u, v, 6, 5, 5);
    float turn = fr_bark_fractal(child(bark, KEY_BEND + 100), u, v, 6, 5, 5);
    float rough = fr_bark_fractal(child(bark, KEY_BEND + 200), u, v, 34, 22, 3);
    FrBarkPlate plate = fr_bark_plate(&bark->plates, u + 0.05f * bend + 0.012f * rough,
                                      v + 0.06f * turn + 0.012f * rough);
    FrBarkPlate split = fr_bark_plate(&bark->splits, u + 0.03f * turn, v + 0.03f * bend);
    float layers = fr_bark_fractal(child(bark, KEY_LAYERS), u, v, 8, 7, 4);
    // Layers follow the plate's margin, as if peeled from its edge inwards.
    float dome = fr_bark_smooth(0.0f, 0.5f, plate.edge) + 0.75f * layers + 0.15f * plate.random;
    float rim;
    float terrace = layered(CLAMP(dome, 0.0f, 1.2f) / 1.2f, 5.0f, &rim);
    float width = 0.05f + 0.07f * fr_bark_smooth(-0.3f, 0.4f, layers + 0.4f * plate.upright - 0.2f);
    float crack = 1.0f - fr_bark_smooth(0.25f * width, 1.7f * width, plate.edge + 0.02f * layers);
    float thin = (1.0f - fr_bark_smooth(0.0f, 0.07f, split.edge)) *
                 fr_bark_smooth(0.45f, 0.75f, split.random);
    return (Place){
        .height = (1.0f - crack) * (0.45f + 0.5f * terrace - 0.16f * thin),
        .crack = fmaxf(crack, 0.55f * thin),
        .rim = rim * (1.0f - crack),
        .random = plate.random,
    };
}

static void paint_row(FrTexture *texture, int row, void *data) {
    const Plated *bark = data;
    float v = ((float)row + 0.5f) / (float)texture->size;
    for (int column = 0; column < texture->size; column++) {
        float u = ((float)column + 0.5f) / (float)texture->size;
        FrTexel *texel = &texture->texels[(size_t)row * (size_t)texture->size + (size_t)column];
        Place place = place_at(bark, u, v);
        float grain = fr_bark_fractal(child(bark, KEY_GRAIN), u, v, 40, 26, 4);
        float tone = fr_bark_fractal(child(bark, KEY_TONE), u, v, 5, 5, 4);
        float rust = fr_bark_fractal(child(bark, KEY_RUST), u, v, 11, 11, 4);
        float brightness = 0.62f + 0.5f * place.height + 0.28f * (place.random - 0.5f) +
                           0.5f * grain + 0.3f * tone - 0.2f * place.rim;
        vec3s colour = fr_colour_adjust(bark->top, fmaxf(brightness, 0.25f), 1.0f - 0.4f * tone);
        // Weathered layers are grey, freshly broken ones keep the colour of the inner bark.
        vec3s grey = fr_colour_adjust(colour, 1.12f, 0.45f);
        vec3s fresh = {{colour.x * 1.14f, colour.y * 0.97f, colour.z * 0.86f}};
        float weathered = fr_bark_smooth(0.55f, 0.95f, place.height + 0.5f * rust);
        colour = fr_colour_mix(fr_colour_mix(colour, fresh, 0.7f * (1.0f - weathered)), grey,
                               0.75f * weathered);
        colour = fr_colour_mix(colour, bark->deep, 0.93f * place.crack);
        for (int c = 0; c < 3; c++) {
            texel->colour[c] = colour.raw[c];
        }
        texel->alpha = 1;
        texel->height = 0.026f * place.height + 0.003f * grain;
        texel->roughness = CLAMP(0.95f - 0.08f * weathered + 0.1f * grain, 0.0f, 1.0f);
    }
}

void fr_texture_bark_plated(FrTexture *texture) {
    Plated bark = {.key = texture->key};
    fr_bark_cells_init(&bark.plates, child(&bark, KEY_PLATES), 8, 4, 0.78f);
    fr_bark_cells_init(&bark.splits, child(&bark, KEY_SPLITS), 10, 9, 0.95f);
    bark.top = fr_texture_base_colour(texture->params, (vec3s){{0.53f, 0.43f, 0.36f}});
    if (!fr_texture_second_colour(texture->params, &bark.deep)) {
        bark.deep = fr_colour_adjust(bark.top, 0.11f, 1.2f);
    }
    fr_texture_rows(texture, paint_row, &bark);
    fr_bark_cells_clear(&bark.plates);
    fr_bark_cells_clear(&bark.splits);
}
