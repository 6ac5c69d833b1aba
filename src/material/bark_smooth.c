// Bark of beech, cherry, birch: a smooth skin stretched around the stem, with lenticels, the
// corky pores that lie across it.

#include <math.h>

#include "material/bark.h"

enum { KEY_PORES, KEY_SKIN, KEY_TONE, KEY_STRETCH, KEY_PEEL, KEY_EDGE };

enum { PORES = 150 };

static const float most_bend = 0.012f;

typedef struct Pore {
    float u, v;        ///< centre
    float half_length; ///< in u
    float half_height; ///< in v
    float strength;    ///< 0 to 1
} Pore;

typedef struct Smooth {
    Pore pores[PORES];
    vec3s skin, cork;
    FrKey key;
} Smooth;

static FrKey child(const Smooth *bark, uint64_t word) {
    return fr_key_child(bark->key, word);
}

/// Many short pores and few long ones; v stratified, so that no part of the tile stays empty.
static void scatter_pores(Smooth *bark) {
    FrKey key = child(bark, KEY_PORES);
    for (uint32_t i = 0; i < PORES; i++) {
        float length = (float)fr_random(key, 2, i);
        float height = (float)fr_random(key, 3, i);
        bark->pores[i] = (Pore){
            .u = (float)fr_random(key, 0, i),
            .v = ((float)i + (float)fr_random(key, 1, i)) / PORES,
            .half_length = 0.009f + 0.055f * length * length * length * length,
            .half_height = 0.0015f + 0.002f * height * height,
            .strength = 0.4f + 0.6f * (float)fr_random(key, 4, i),
        };
    }
}

/// Shortest way from `from` to `to` on a circle of length 1.
static float around(float from, float to) {
    float way = to - from;
    return way - roundf(way);
}

/// The pores that can reach a row of texels, however the row bends.
static int pores_of_row(const Smooth *bark, float v, const Pore **pores) {
    int count = 0;
    for (int i = 0; i < PORES; i++) {
        const Pore *pore = &bark->pores[i];
        if (fabsf(around(pore->v, v)) < 5.0f * pore->half_height + most_bend) {
            pores[count++] = pore;
        }
    }
    return count;
}

/// 1 inside a pore, 0 outside its swollen lip; `edge` roughens the outline.
static void pores_at(const Pore *const *pores, int count, float u, float v, float edge, float *pore,
                     float *lip) {
    *pore = *lip = 0;
    for (int i = 0; i < count; i++) {
        const Pore *p = pores[i];
        float dv = fabsf(around(p->v, v)) / p->half_height;
        if (dv > 5.0f) {
            continue;
        }
        float du = fabsf(around(p->u, u)) / p->half_length;
        // Pointed at both ends like an eye.
        float out = du * du + dv * (0.75f + 0.25f * dv) + 0.35f * edge;
        *pore = fmaxf(*pore, p->strength * fr_bark_smooth(1.15f, 0.55f, out));
        *lip = fmaxf(*lip, p->strength * fr_bark_smooth(4.0f, 0.9f, out));
    }
}

static void paint_row(FrTexture *texture, int row, void *data) {
    const Smooth *bark = data;
    float v = ((float)row + 0.5f) / (float)texture->size;
    const Pore *pores[PORES];
    int pore_count = pores_of_row(bark, v, pores);
    for (int column = 0; column < texture->size; column++) {
        float u = ((float)column + 0.5f) / (float)texture->size;
        FrTexel *texel = &texture->texels[(size_t)row * (size_t)texture->size + (size_t)column];
        float bend = 0.006f * fr_bark_fractal(child(bark, KEY_PEEL), u, v, 5, 5, 3);
        float edge = fr_bark_fractal(child(bark, KEY_EDGE), u, v, 60, 120, 2);
        float pore, lip;
        pores_at(pores, pore_count, u, v + bend, edge, &pore, &lip);
        float stretch = fr_bark_fractal(child(bark, KEY_STRETCH), u, v + bend, 7, 70, 3);
        // Sheared, which keeps the period, so that the noises' grids do not show as a weave.
        float skin = fr_bark_fractal(child(bark, KEY_SKIN), u + v, v - u, 18, 22, 5);
        float tone = fr_bark_fractal(child(bark, KEY_TONE), u, v + bend, 5, 6, 6);
        float patch = fr_bark_smooth(0.12f, 0.34f, tone + 0.12f * skin);
        float brightness = 1.0f + 0.13f * stretch + 0.2f * skin + 0.25f * tone - 0.22f * patch;
        vec3s colour = fr_colour_adjust(bark->skin, brightness, 1.0f + 0.25f * tone);
        colour = fr_colour_mix(colour, fr_colour_adjust(bark->skin, 1.25f, 0.7f),
                               0.7f * fr_bark_smooth(0.1f, 0.5f, -tone));
        colour = fr_colour_mix(colour, bark->cork, 0.22f * (lip - pore) + 0.85f * pore);
        for (int c = 0; c < 3; c++) {
            texel->colour[c] = colour.raw[c];
        }
        texel->alpha = 1;
        texel->height =
            0.0022f * lip - 0.0030f * pore + 0.0006f * stretch + 0.0009f * skin + 0.004f * tone;
        texel->roughness = CLAMP(0.8f + 0.18f * pore + 0.08f * skin, 0.0f, 1.0f);
    }
}

void fr_texture_bark_smooth(FrTexture *texture) {
    Smooth bark = {.key = texture->key};
    scatter_pores(&bark);
    bark.skin = fr_texture_base_colour(texture->params, (vec3s){{0.55f, 0.525f, 0.475f}});
    if (!fr_texture_second_colour(texture->params, &bark.cork)) {
        // Dark on a light skin, pale on a dark one.
        vec3s dark = {{0.10f, 0.066f, 0.043f}}, pale = {{0.34f, 0.22f, 0.14f}};
        bool is_dark =
            0.2126f * bark.skin.x + 0.7152f * bark.skin.y + 0.0722f * bark.skin.z < 0.12f;
        vec3s tinged = fr_colour_adjust(bark.skin, is_dark ? 1.8f : 0.3f, 1.2f);
        bark.cork = fr_colour_mix(tinged, is_dark ? pale : dark, 0.6f);
    }
    fr_texture_rows(texture, paint_row, &bark);
}
