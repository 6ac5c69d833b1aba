// Bark of oak, chestnut, willow: ridges along the stem that part and meet again, deep furrows
// between them, short cracks across.

#include <math.h>

#include "material/bark.h"

enum { KEY_RIDGES, KEY_CRACKS, KEY_BEND, KEY_DEPTH, KEY_FIBRE, KEY_TONE, KEY_LICHEN, KEY_SWELL };

typedef struct Furrowed {
    FrBarkCells ridges, cracks;
    vec3s top, deep;
    FrKey key;
} Furrowed;

static FrKey child(const Furrowed *bark, uint64_t word) {
    return fr_key_child(bark->key, word);
}

/// What a place is before its colour is known.
typedef struct Place {
    float ridge;  ///< 0 at the bottom of a furrow, 1 on top of a ridge
    float crack;  ///< 1 in a crack across
    float fibre;  ///< −1 to 1, fine threads along
    float random; ///< of the ridge
} Place;

static Place place_at(const Furrowed *bark, float u, float v) {
    // Bent coordinates, so that no border is straight.
    float bend = fr_bark_fractal(child(bark, KEY_BEND), u, v, 4, 3, 4);
    float fine = fr_bark_fractal(child(bark, KEY_BEND + 100), u, v, 24, 12, 3);
    float bu = u + 0.045f * bend + 0.007f * fine;
    float bv = v + 0.03f * fr_bark_fractal(child(bark, KEY_BEND + 200), u, v, 6, 4, 3);
    FrBarkPlate plate = fr_bark_plate(&bark->ridges, bu, bv);
    // Borders across are filled up in places: there one ridge goes on into the next.
    float filled = fr_bark_noise(child(bark, KEY_DEPTH), u, v, 7, 7);
    float open = 0.25f + 0.75f * fr_bark_smooth(0.35f, 0.9f, plate.upright + 0.35f * filled);
    float side = fr_bark_smooth(0.02f, 0.28f, plate.edge + 0.16f * fine);
    float ridge = 1.0f - open * (1.0f - powf(side, 0.75f));
    FrBarkPlate crack =
        fr_bark_plate(&bark->cracks, u + 0.02f * fine + 0.02f * bend, v + 0.012f * fine);
    float crossing =
        (1.0f - 0.65f * crack.upright) * (1.0f - fr_bark_smooth(0.0f, 0.13f, crack.edge));
    crossing *= fr_bark_smooth(0.3f, 0.7f, 0.5f * (crack.random + crack.other));
    float fibre = fr_bark_fractal(child(bark, KEY_FIBRE), bu, bv, 48, 9, 4);
    // Two ridges that meet are of one height there.
    float inside = fr_bark_smooth(0.0f, 0.45f, plate.edge);
    float shared = 0.5f * (plate.random + plate.other);
    float random = shared + inside * (plate.random - shared);
    return (Place){.ridge = ridge, .crack = crossing * ridge, .fibre = fibre, .random = random};
}

static void paint_row(FrTexture *texture, int row, void *data) {
    const Furrowed *bark = data;
    float v = ((float)row + 0.5f) / (float)texture->size;
    for (int column = 0; column < texture->size; column++) {
        float u = ((float)column + 0.5f) / (float)texture->size;
        FrTexel *texel = &texture->texels[(size_t)row * (size_t)texture->size + (size_t)column];
        Place place = place_at(bark, u, v);
        float swell = fr_bark_fractal(child(bark, KEY_SWELL), u, v, 18, 10, 5);
        float tone = fr_bark_fractal(child(bark, KEY_TONE), u, v, 5, 4, 4);
        float lichen = fr_bark_fractal(child(bark, KEY_LICHEN), u, v, 12, 12, 4);
        float relief = place.ridge * (0.8f + 0.2f * place.random) - 0.28f * place.crack +
                       0.11f * place.fibre + 0.2f * swell * (0.3f + 0.7f * place.ridge);
        float light = fr_bark_smooth(0.12f, 0.78f, relief);
        float brightness =
            0.88f + 0.2f * place.random + 0.3f * tone + 0.75f * place.fibre + 0.6f * swell;
        vec3s colour = fr_colour_mix(bark->deep, bark->top, light);
        colour = fr_colour_adjust(colour, fmaxf(brightness, 0.3f), 1.0f - 0.25f * tone);
        vec3s grey = fr_colour_adjust(bark->top, 1.35f, 0.45f);
        float crust = fr_bark_smooth(0.15f, 0.4f, lichen) * fr_bark_smooth(0.6f, 1.0f, place.ridge);
        colour = fr_colour_mix(colour, grey, 0.5f * crust);
        colour = fr_colour_scale(colour, 1.0f - 0.62f * place.crack);
        for (int c = 0; c < 3; c++) {
            texel->colour[c] = colour.raw[c];
        }
        texel->alpha = 1;
        texel->height = 0.034f * relief;
        texel->roughness = CLAMP(0.97f - 0.1f * crust + 0.04f * place.fibre, 0.0f, 1.0f);
    }
}

void fr_texture_bark_furrowed(FrTexture *texture) {
    Furrowed bark = {.key = texture->key};
    fr_bark_cells_init(&bark.ridges, child(&bark, KEY_RIDGES), 12, 3, 0.85f);
    fr_bark_cells_init(&bark.cracks, child(&bark, KEY_CRACKS), 16, 14, 0.95f);
    bark.top = fr_texture_base_colour(texture->params, (vec3s){{0.47f, 0.41f, 0.345f}});
    if (!fr_texture_second_colour(texture->params, &bark.deep)) {
        bark.deep = fr_colour_adjust(bark.top, 0.17f, 1.3f);
    }
    fr_texture_rows(texture, paint_row, &bark);
    fr_bark_cells_clear(&bark.ridges);
    fr_bark_cells_clear(&bark.cracks);
}
