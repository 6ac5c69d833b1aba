#include "material/texture.h"

#include <math.h>
#include <string.h>

#include <cglm/struct.h>

// ---- colour -----------------------------------------------------------------------------------

static float linear(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : powf((srgb + 0.055f) / 1.055f, 2.4f);
}

vec3s fr_colour_linear(vec3s srgb) {
    return (vec3s){{linear(srgb.x), linear(srgb.y), linear(srgb.z)}};
}

float fr_colour_srgb(float value) {
    float clamped = glm_clamp(value, 0.0f, 1.0f);
    return clamped <= 0.0031308f ? 12.92f * clamped : 1.055f * powf(clamped, 1 / 2.4f) - 0.055f;
}

vec3s fr_colour_mix(vec3s a, vec3s b, float t) {
    return glms_vec3_lerp(a, b, t);
}

vec3s fr_colour_scale(vec3s colour, float factor) {
    return glms_vec3_scale(colour, factor);
}

vec3s fr_colour_adjust(vec3s colour, float brightness, float saturation) {
    float luminance = 0.2126f * colour.x + 0.7152f * colour.y + 0.0722f * colour.z;
    vec3s grey = {{luminance, luminance, luminance}};
    vec3s result = glms_vec3_scale(glms_vec3_lerp(grey, colour, saturation), brightness);
    return glms_vec3_clamp(result, 0.0f, 1.0f);
}

bool fr_texture_second_colour(const FrMaterialParams *params, vec3s *second) {
    *second = fr_colour_linear(params->second_colour);
    return second->x + second->y + second->z > 0;
}

vec3s fr_texture_base_colour(const FrMaterialParams *params, vec3s typical) {
    vec3s colour = params->colour;
    bool is_white = colour.x >= 1 && colour.y >= 1 && colour.z >= 1;
    return fr_colour_linear(is_white ? typical : colour);
}

// ---- the field ----------------------------------------------------------------------------------

typedef struct RowTask {
    FrTexture *texture;
    FrTextureRowFn row;
    void *data;
} RowTask;

static void do_rows(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    RowTask *task = data;
    for (size_t row = begin; row < end; row++) {
        task->row(task->texture, (int)row, task->data);
    }
}

void fr_texture_rows(FrTexture *texture, FrTextureRowFn row, void *data) {
    RowTask task = {.texture = texture, .row = row, .data = data};
    fr_parallel_for(texture->context->pool, (size_t)texture->size, 8, do_rows, &task,
                    texture->context->progress);
}

const FrTexel *fr_texture_at(const FrTexture *texture, int x, int y) {
    int size = texture->size;
    if (texture->is_tiled) {
        x = (x + size) % size;
        y = (y + size) % size;
    } else {
        x = CLAMP(x, 0, size - 1);
        y = CLAMP(y, 0, size - 1);
    }
    return &texture->texels[(size_t)y * (size_t)size + (size_t)x];
}

// ---- maps -------------------------------------------------------------------------------------

static uint8_t byte_of(float value) {
    return (uint8_t)(glm_clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

/// By the operator of Sobel; rows run downwards, the map's green upwards.
vec3s fr_texture_normal(const FrTexture *texture, int x, int y) {
    float h[3][3];
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            h[j][i] = fr_texture_at(texture, x + i - 1, y + j - 1)->height;
        }
    }
    float right = h[0][2] + 2 * h[1][2] + h[2][2] - h[0][0] - 2 * h[1][0] - h[2][0];
    float down = h[2][0] + 2 * h[2][1] + h[2][2] - h[0][0] - 2 * h[0][1] - h[0][2];
    float scale = (float)texture->size / 8.0f;
    return glms_vec3_normalize((vec3s){{-right * scale, down * scale, 1.0f}});
}

static void write_row(FrTexture *texture, int row, void *data) {
    FrImage **maps = data;
    FrImage *colour = maps[FR_MAP_COLOUR];
    size_t width = (size_t)texture->size;
    size_t start = (size_t)row * width;
    for (size_t x = 0; x < width; x++) {
        const FrTexel *texel = &texture->texels[start + x];
        uint8_t *rgb = colour->pixels + (start + x) * colour->channels;
        uint8_t *normal = maps[FR_MAP_NORMAL]->pixels + (start + x) * 3;
        uint8_t *rough = maps[FR_MAP_ROUGHNESS]->pixels + (start + x) * 3;
        vec3s n = fr_texture_normal(texture, (int)x, row);
        for (int c = 0; c < 3; c++) {
            rgb[c] = byte_of(fr_colour_srgb(texel->colour[c]));
            normal[c] = byte_of(0.5f + 0.5f * n.raw[c]);
        }
        if (colour->channels == 4) {
            rgb[3] = byte_of(texel->alpha);
        }
        rough[0] = 255;
        rough[1] = byte_of(texel->roughness);
        rough[2] = 0;
    }
}

// ---- making -----------------------------------------------------------------------------------

typedef void (*PaintFn)(FrTexture *texture);

static const struct {
    PaintFn paint;
    bool is_tiled, has_alpha;
} kinds[] = {
    [FR_TEXTURE_LEAF] = {fr_texture_leaf, false, true},
    [FR_TEXTURE_PETAL] = {fr_texture_petal, false, true},
    [FR_TEXTURE_BARK_FURROWED] = {fr_texture_bark_furrowed, true, false},
    [FR_TEXTURE_BARK_SMOOTH] = {fr_texture_bark_smooth, true, false},
    [FR_TEXTURE_BARK_PLATED] = {fr_texture_bark_plated, true, false},
};

FrStatus fr_texture_make(const FrMaterialParams *params, const char *name, FrSpan span,
                         const FrContext *context, FrImage *maps[FR_MAP_COUNT]) {
    size_t kind = (size_t)params->texture;
    FR_ASSERT(kind < G_N_ELEMENTS(kinds) && kinds[kind].paint != NULL);
    uint64_t side = (uint64_t)CLAMP(params->size, 16, 4096);
    FrStatus status =
        fr_limit_check(side * side, context->limits.pixels, "pixels", name, span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    FrTexture texture = {
        .size = (int)side,
        .is_tiled = kinds[kind].is_tiled,
        .has_alpha = kinds[kind].has_alpha,
        .texels = g_new0(FrTexel, (size_t)(side * side)),
        .params = params,
        .context = context,
        .key = fr_key_child(fr_key_root((uint64_t)params->seed), kind),
    };
    kinds[kind].paint(&texture);
    FrImage *made[FR_MAP_COUNT] = {
        [FR_MAP_COLOUR] = fr_image_new((uint32_t)side, (uint32_t)side, texture.has_alpha ? 4 : 3),
        [FR_MAP_NORMAL] = fr_image_new((uint32_t)side, (uint32_t)side, 3),
        [FR_MAP_ROUGHNESS] = fr_image_new((uint32_t)side, (uint32_t)side, 3),
    };
    fr_texture_rows(&texture, write_row, made);
    g_free(texture.texels);
    if (fr_progress_is_cancelled(context->progress)) {
        for (int map = 0; map < FR_MAP_COUNT; map++) {
            g_clear_pointer(&made[map], fr_image_unref);
        }
        status = FR_CANCELLED;
    }
    memcpy(maps, made, sizeof made);
    return status;
}
