// Materials for the path tracer. Leaves split their colour between reflection and transmission;
// what shines through has passed more pigment, so it is yellower and more saturated (Woolley 1971,
// Reflectance and Transmittance of Light by Leaves; Bousquet, Lachérade, Jacquemoud, Moya 2005).
#include "render/look.h"

#include "render/colour.h"

#include <math.h>

// Reflectance at normal incidence of wax and of dry bark (index 1.5).
#define COAT 0.04f
#define SMALLEST_WIDTH 0.05f

void fr_decoder_init(FrDecoder *decoder) {
    for (int i = 0; i < 256; i++) {
        decoder->linear[i] = fr_srgb_decode((float)i / 255.0f);
    }
}

static FrStatus load(FrMaterial *material, FrMap map, const FrContext *context,
                     const FrImage **image) {
    *image = NULL;
    if (!fr_material_has(material, map)) {
        return FR_OK;
    }
    FrStatus status = FR_OK;
    *image = fr_material_image(material, map, context, &status);
    return status;
}

FrStatus fr_look_init(FrLook *look, FrMaterial *material, bool is_foliage,
                      const FrContext *context) {
    *look = (FrLook){
        .tint = is_foliage ? (vec3s){{0.12f, 0.25f, 0.05f}} : (vec3s){{0.22f, 0.17f, 0.12f}},
        .roughness_factor = is_foliage ? 0.5f : 0.9f,
        .translucency = is_foliage ? 0.45f : 0.0f,
        .is_foliage = is_foliage,
    };
    if (material == NULL) {
        return FR_OK;
    }
    const FrMaterialParams *params = fr_material_params(material);
    look->tint = fr_srgb_decode3(fr_material_tint(material));
    look->roughness_factor = (float)params->roughness;
    look->translucency = is_foliage ? (float)params->translucency : 0.0f;
    look->mirror = (float)params->mirror;
    look->clear = (float)params->clear;
    look->relief = (float)params->relief;
    look->cutoff = (float)params->alpha_cutoff * 255.0f;
    FrStatus status = load(material, FR_MAP_COLOUR, context, &look->colour);
    if (status == FR_OK) {
        status = load(material, FR_MAP_NORMAL, context, &look->normal);
    }
    if (status == FR_OK) {
        status = load(material, FR_MAP_ROUGHNESS, context, &look->roughness);
    }
    // A picture of a leaf wrapped around a stem would leave gaps in it.
    look->has_holes = is_foliage && look->colour != NULL && look->colour->channels == 4 &&
                      fr_material_has_alpha(material);
    return status;
}

/// Four neighbours of a point and their weights.
typedef struct Taps {
    const uint8_t *at[4];
    float weight[4];
} Taps;

static inline uint32_t wrap(float cell, uint32_t count, bool is_clamped) {
    if (is_clamped) {
        return (uint32_t)fminf(fmaxf(cell, 0.0f), (float)(count - 1));
    }
    float size = (float)count;
    float inside = cell - size * floorf(cell / size);
    return (uint32_t)fminf(inside, size - 1.0f);
}

static inline Taps taps_at(const FrImage *image, float u, float v, bool is_clamped) {
    float x = u * (float)image->width - 0.5f;
    float y = v * (float)image->height - 0.5f;
    // A coordinate that is no number, or too large to have a fraction, is as good as 0.
    x = fabsf(x) < 1e7f ? x : 0.0f;
    y = fabsf(y) < 1e7f ? y : 0.0f;
    float left = floorf(x);
    float top = floorf(y);
    float fx = x - left;
    float fy = y - top;
    size_t x0 = wrap(left, image->width, is_clamped);
    size_t x1 = wrap(left + 1.0f, image->width, is_clamped);
    size_t y0 = wrap(top, image->height, is_clamped);
    size_t y1 = wrap(top + 1.0f, image->height, is_clamped);
    const uint8_t *row0 = image->pixels + y0 * image->width * image->channels;
    const uint8_t *row1 = image->pixels + y1 * image->width * image->channels;
    uint32_t step = image->channels;
    return (Taps){
        .at = {row0 + x0 * step, row0 + x1 * step, row1 + x0 * step, row1 + x1 * step},
        .weight = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy},
    };
}

static inline float mix_taps(const Taps *taps, uint32_t channel) {
    float sum = 0.0f;
    for (int i = 0; i < 4; i++) {
        sum += taps->weight[i] * (float)taps->at[i][channel];
    }
    return sum;
}

bool fr_look_is_hole(const FrLook *look, float u, float v) {
    if (!look->has_holes) {
        return false;
    }
    Taps taps = taps_at(look->colour, u, v, look->is_foliage);
    return mix_taps(&taps, 3) < look->cutoff;
}

vec3s fr_look_colour(const FrLook *look, const FrDecoder *decoder, float u, float v) {
    if (look->colour == NULL) {
        return look->tint;
    }
    Taps taps = taps_at(look->colour, u, v, look->is_foliage);
    vec3s colour = glms_vec3_zero();
    bool is_grey = look->colour->channels < 3;
    for (int c = 0; c < 3; c++) {
        int channel = is_grey ? 0 : c;
        for (int i = 0; i < 4; i++) {
            colour.raw[c] += taps.weight[i] * decoder->linear[taps.at[i][channel]];
        }
    }
    return glms_vec3_mul(colour, look->tint);
}

vec3s fr_look_normal(const FrLook *look, float u, float v) {
    if (look->normal == NULL || look->normal->channels < 3) {
        return (vec3s){{0, 0, 1}};
    }
    Taps taps = taps_at(look->normal, u, v, look->is_foliage);
    vec3s normal;
    for (uint32_t c = 0; c < 3; c++) {
        normal.raw[c] = mix_taps(&taps, c) * (2.0f / 255.0f) - 1.0f;
    }
    normal.x *= look->relief;
    normal.y *= look->relief;
    normal.z = fmaxf(normal.z, 0.05f);
    return normal;
}

/// How green a colour is: 0 for white, red or blue petals, 1 for leaves.
static float greenness(vec3s colour) {
    float other = 0.5f * (colour.r + colour.b);
    return glm_clamp(2.0f * (colour.g - other) / fmaxf(colour.g, 1e-4f), 0.0f, 1.0f);
}

/// The colour of light that came through a blade of base colour `colour`.
static vec3s shine_through(vec3s colour) {
    float green = greenness(colour);
    vec3s shifted = {{colour.r * 1.12f, colour.g * 1.25f, colour.b * 0.35f}};
    vec3s through = glms_vec3_lerp(colour, shifted, green);
    return glms_vec3_minv(through, glms_vec3_one());
}

/// The lower side of a leaf is paler.
static vec3s lower_side(vec3s colour) {
    float green = greenness(colour);
    float grey = fr_luminance(colour);
    vec3s pale = glms_vec3_lerp(colour, (vec3s){{grey, grey, grey}}, 0.25f * green);
    return glms_vec3_minv(glms_vec3_scale(pale, 1.0f + 0.25f * green), glms_vec3_one());
}

void fr_look_scattering(const FrLook *look, const FrDecoder *decoder, float u, float v,
                        bool is_upper, FrBsdf *bsdf) {
    vec3s colour = fr_look_colour(look, decoder, u, v);
    float roughness = look->roughness_factor;
    if (look->roughness != NULL && look->roughness->channels >= 3) {
        Taps taps = taps_at(look->roughness, u, v, look->is_foliage);
        roughness *= mix_taps(&taps, 1) / 255.0f;
    }
    float part = look->translucency;
    bsdf->mirror = glms_vec3_scale(colour, look->mirror);
    bsdf->clear = glms_vec3_scale(colour, (1.0f - look->mirror) * look->clear);
    bsdf->rough_a = 1.0f;
    bsdf->rough_b = 0.0f;
    bsdf->transmittance = glms_vec3_zero();
    if (look->is_foliage) {
        if (part > 0.0f) {
            bsdf->transmittance = glms_vec3_scale(shine_through(colour), part);
        }
        colour = is_upper ? colour : lower_side(colour);
        roughness = is_upper ? roughness : fminf(roughness * 1.3f, 1.0f);
    } else {
        fr_bsdf_set_roughness(bsdf, 0.6f * roughness);
    }
    float matt = (1.0f - look->mirror) * (1.0f - look->clear);
    bsdf->transmittance = glms_vec3_scale(bsdf->transmittance, matt);
    bsdf->reflectance = glms_vec3_scale(colour, (1.0f - part) * matt);
    // Mirrors and glass have their gloss already.
    bsdf->coat = roughness < 1.0f && matt >= 1.0f ? COAT : 0.0f;
    bsdf->coat_width = fmaxf(roughness * roughness, SMALLEST_WIDTH);
}
