// A petal as seen from above: fine veins that spread from the claw and end at the margin, a base
// spot, colour that deepens or pales from base to tip.

#include <math.h>

#include "frond/noise.h"
#include "material/outline.h"

static const float petal_aspect = 0.7f;

enum { KEY_FINE, KEY_COARSE, KEY_TONE, KEY_SPOT };

typedef struct Petal {
    const FrOutline *outline;
    vec3s base, spot;
    FrKey fine, coarse, tone, edge;
    float density;
} Petal;

static float smooth(float low, float high, float value) {
    float t = CLAMP((value - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// A place by its vein instead of by its x, −1 to 1 at the picture's edges. Veins leave the claw
/// together, spread like a fan and run out at the margin.
static float vein_across(const Petal *petal, float x, float y) {
    float rest = CLAMP(1.0f - y, 0.0f, 1.0f);
    float spread = 0.10f + 0.90f * (1.0f - powf(rest, 1.7f));
    return x / (0.5f * petal->outline->aspect * spread);
}

/// 1 on a vein, 0 between two. Each forks once more towards the tip.
static float vein_line(const Petal *petal, float across, float y) {
    float apart = smooth(2.0f, 1.2f, fabsf(across)); // beyond the fan they would be too close
    float wander = 0.035f * (float)fr_noise2(petal->coarse, (double)(across * 3), (double)(y * 4));
    float place = (across + wander) * 11.0f * sqrtf(petal->density);
    float ridge = 1.0f - fabsf(place - roundf(place)) * 2.0f;
    float fork = place * 2.0f + 0.5f;
    float between = 1.0f - fabsf(fork - roundf(fork)) * 2.0f;
    float main_vein = smooth(0.68f, 1.0f, ridge);
    return apart * fmaxf(main_vein, 0.7f * smooth(0.5f, 1.0f, between) * smooth(0.3f, 0.75f, y));
}

static vec3s petal_colour(const Petal *petal, float x, float y, float across, float vein) {
    float fine = (float)fr_noise2(petal->fine, (double)(across * 40), (double)(y * 5));
    float tone = (float)fr_noise2(petal->tone, (double)(x * 5), (double)(y * 3));
    float brightness = 1.0f + 0.035f * fine + 0.05f * tone - 0.075f * vein;
    // Deeper at the claw, paler towards the tip: thin tissue lets more light through.
    brightness *= 0.80f + 0.24f * smooth(0.0f, 0.8f, y);
    float saturation = 1.08f - 0.14f * smooth(0.3f, 1.0f, y) + 0.06f * vein;
    vec3s colour = fr_colour_adjust(petal->base, brightness, saturation);
    float ragged = 0.10f * (float)fr_noise2(petal->edge, (double)(across * 7), (double)(y * 2));
    float streak = 0.16f * vein;
    float spot = 1.0f - smooth(0.04f, 0.36f, y - ragged - streak + 0.10f * across * across);
    return fr_colour_mix(colour, fr_colour_scale(petal->spot, 1.0f + 0.08f * fine), 0.92f * spot);
}

static void paint_row(FrTexture *texture, int row, void *data) {
    const Petal *petal = data;
    int size = texture->size;
    float y = fr_blade_y(size, (float)row), pixel = fr_blade_texel(petal->outline, size);
    FrMargin *margins = g_new(FrMargin, size);
    fr_outline_row(petal->outline, size, row, margins);
    for (int column = 0; column < size; column++) {
        FrTexel *texel = &texture->texels[(size_t)row * (size_t)size + (size_t)column];
        float x = fr_blade_x(petal->outline, size, (float)column);
        float across = vein_across(petal, x, y);
        float vein = vein_line(petal, across, y);
        float rim = smooth(0.03f, 0.0f, margins[column].distance);
        vec3s colour = petal_colour(petal, x, y, across, vein);
        colour = fr_colour_adjust(colour, 1.0f - 0.07f * rim, 1.0f + 0.1f * rim);
        for (int c = 0; c < 3; c++) {
            texel->colour[c] = colour.raw[c];
        }
        texel->alpha = fr_outline_alpha(petal->outline, texture->params, margins[column], pixel);
        float fine = (float)fr_noise2(petal->fine, (double)(across * 40), (double)(y * 5));
        float crease = expf(-across * across * 25.0f);
        texel->height = -0.0007f * vein + 0.0003f * fine - 0.003f * crease;
        texel->roughness = CLAMP(0.9f + 0.08f * fine, 0.0f, 1.0f);
    }
    g_free(margins);
}

void fr_texture_petal(FrTexture *texture) {
    FrOutline *outline = fr_outline_new(texture->params, petal_aspect);
    vec3s base = fr_colour_linear(texture->params->colour), spot;
    if (!fr_texture_second_colour(texture->params, &spot)) {
        spot = fr_colour_adjust(base, 0.55f, 1.15f);
    }
    Petal petal = {
        .outline = outline,
        .base = base,
        .spot = spot,
        .fine = fr_key_child(texture->key, KEY_FINE),
        .coarse = fr_key_child(texture->key, KEY_COARSE),
        .tone = fr_key_child(texture->key, KEY_TONE),
        .edge = fr_key_child(texture->key, KEY_SPOT),
        .density = (float)CLAMP(texture->params->vein_density, 0.1, 8),
    };
    fr_texture_rows(texture, paint_row, &petal);
    fr_outline_free(outline);
}
