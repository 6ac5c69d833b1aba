// The upper side of a leaf as seen from above.

#include <math.h>

#include "frond/noise.h"
#include "material/texture.h"
#include "material/vein_raster.h"

/// Length of a typical blade is 1, its width this.
static const float leaf_aspect = 0.62f;

enum { KEY_VEINS, KEY_MOTTLE, KEY_GRAIN, KEY_TONE, KEY_BLEMISH };

typedef struct Leaf {
    const FrOutline *outline;
    const FrVeinField *veins;
    vec3s blade, vein;
    FrKey mottle, grain, tone, blemish;
} Leaf;

static float smooth(float low, float high, float value) {
    float t = CLAMP((value - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static float noise(FrKey key, float x, float y, float frequency) {
    return (float)fr_noise2(key, (double)(x * frequency), (double)(y * frequency));
}

/// Between the veins the tissue is darker away from them, mottled, and warmer towards the margin.
static vec3s tissue(const Leaf *leaf, float x, float y, float groove, float margin) {
    float mottle = noise(leaf->mottle, x, y, 6.0f) + 0.6f * noise(leaf->mottle, x, y, 15.0f);
    float grain = noise(leaf->grain, x, y, 90.0f) + 0.7f * noise(leaf->grain, y, x, 190.0f);
    float tone = noise(leaf->tone, x, y, 2.5f);
    float brightness = 1.0f + 0.09f * mottle + 0.06f * grain + 0.10f * tone;
    brightness *= 1.0f - 0.12f * groove; // the slopes of the valleys see less sky
    brightness *= 1.0f + 0.12f * smooth(0.10f, 0.0f, fabsf(x));
    float rim = smooth(0.035f, 0.0f, margin);
    vec3s colour = fr_colour_adjust(leaf->blade, brightness, 0.95f + 0.06f * mottle);
    vec3s warm = {{colour.x * 1.35f + 0.015f, colour.y * 1.08f, colour.z * 0.8f}};
    return fr_colour_mix(colour, warm, CLAMP(0.45f * rim + 0.18f * tone, 0.0f, 1.0f));
}

/// Few small dry spots with a darker edge; most leaves have some.
static vec3s with_blemishes(const Leaf *leaf, vec3s colour, float x, float y) {
    float field = noise(leaf->blemish, x, y, 11.0f) + 0.35f * noise(leaf->blemish, y, x, 47.0f);
    float spot = smooth(0.86f, 0.98f, field), ring = smooth(0.74f, 0.86f, field) - spot;
    vec3s dry = {{0.20f, 0.13f, 0.045f}};
    colour = fr_colour_mix(colour, dry, 0.6f * spot);
    return fr_colour_mix(colour, fr_colour_scale(colour, 0.62f), 0.5f * ring);
}

static void paint_row(FrTexture *texture, int row, void *data) {
    const Leaf *leaf = data;
    int size = texture->size;
    float y = fr_blade_y(size, (float)row), pixel = fr_blade_texel(leaf->outline, size);
    FrMargin *margins = g_new(FrMargin, size);
    fr_outline_row(leaf->outline, size, row, margins);
    for (int column = 0; column < size; column++) {
        size_t at = (size_t)row * (size_t)size + (size_t)column;
        FrTexel *texel = &texture->texels[at];
        float x = fr_blade_x(leaf->outline, size, (float)column);
        float cover = leaf->veins->cover[at], groove = leaf->veins->groove[at];
        vec3s colour = tissue(leaf, x, y, groove, margins[column].distance);
        colour = with_blemishes(leaf, colour, x, y);
        colour = fr_colour_mix(colour, leaf->vein, 0.85f * cover);
        for (int c = 0; c < 3; c++) {
            texel->colour[c] = colour.raw[c];
        }
        texel->alpha = fr_outline_alpha(leaf->outline, texture->params, margins[column], pixel);
        float swell = 0.5f * noise(leaf->mottle, x, y, 9.0f);
        float grain = noise(leaf->grain, x, y, 120.0f);
        texel->height =
            0.0058f * (1.0f - groove) + 0.0018f * cover + 0.0016f * swell + 0.00022f * grain;
        texel->roughness = CLAMP(0.86f + 0.12f * groove + 0.06f * grain, 0.0f, 1.0f);
    }
    g_free(margins);
}

void fr_texture_leaf(FrTexture *texture) {
    FrOutline *outline = fr_outline_new(texture->params, leaf_aspect);
    FrKey key = texture->key;
    FrVenation *venation = fr_venation_new(texture->params, outline, fr_key_child(key, KEY_VEINS),
                                           2.5f / (float)texture->size, texture->context->progress);
    FrVeinField *veins = fr_vein_field_new(venation, outline, texture->size, texture->context);
    vec3s blade = fr_texture_base_colour(texture->params, (vec3s){{0.28f, 0.40f, 0.15f}});
    vec3s vein;
    if (!fr_texture_second_colour(texture->params, &vein)) {
        vec3s pale = {{0.62f, 0.66f, 0.30f}};
        vein = fr_colour_mix(fr_colour_scale(blade, 1.6f), pale, 0.42f);
    }
    Leaf leaf = {
        .outline = outline,
        .veins = veins,
        .blade = blade,
        .vein = vein,
        .mottle = fr_key_child(key, KEY_MOTTLE),
        .grain = fr_key_child(key, KEY_GRAIN),
        .tone = fr_key_child(key, KEY_TONE),
        .blemish = fr_key_child(key, KEY_BLEMISH),
    };
    fr_texture_rows(texture, paint_row, &leaf);
    fr_vein_field_free(veins);
    fr_venation_free(venation);
    fr_outline_free(outline);
}
