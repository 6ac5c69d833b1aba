#include "material/vein_raster.h"

#include <math.h>

/// A tapering piece of vein in blade space.
typedef struct Piece {
    float ax, ay, bx, by;
    float ra, rb;
} Piece;

static float smooth(float t) {
    t = CLAMP(t, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Marks one texel. Fields keep the maximum, so the order of pieces does not matter.
static void mark(FrVeinField *field, size_t texel, float distance, float radius, float pixel) {
    const float valley = 2.6f;   // half width of the valley over the vein's
    const float strong = 0.006f; // radius of a vein drawn in full strength
    float drawn = fmaxf(radius, 0.6f * pixel);
    float strength = powf(fminf(radius / strong, 1.0f), 0.62f) * fminf(radius / drawn * 1.3f, 1.0f);
    float cover = strength * smooth(0.5f + (drawn - distance) / (1.4f * pixel));
    float reach = valley * drawn + 2.0f * pixel;
    float groove = powf(fminf(radius / strong, 1.0f), 0.7f) * smooth(1.0f - distance / reach);
    field->cover[texel] = fmaxf(field->cover[texel], cover);
    field->groove[texel] = fmaxf(field->groove[texel], groove);
}

static void draw(FrVeinField *field, const FrOutline *outline, const Piece *piece) {
    int size = field->size;
    float pixel = fr_blade_texel(outline, size);
    float reach = 2.6f * fmaxf(fmaxf(piece->ra, piece->rb), 0.6f * pixel) + 2.0f * pixel;
    float per_x = (float)size / outline->aspect, middle = 0.5f * (float)size;
    int left = (int)floorf(middle + (fminf(piece->ax, piece->bx) - reach) * per_x);
    int right = (int)ceilf(middle + (fmaxf(piece->ax, piece->bx) + reach) * per_x);
    int top = (int)floorf((1.0f - fmaxf(piece->ay, piece->by) - reach) * (float)size);
    int bottom = (int)ceilf((1.0f - fminf(piece->ay, piece->by) + reach) * (float)size);
    float dx = piece->bx - piece->ax, dy = piece->by - piece->ay;
    float squared = fmaxf(dx * dx + dy * dy, 1e-12f);
    for (int row = MAX(top, 0); row <= MIN(bottom, size - 1); row++) {
        float y = fr_blade_y(size, (float)row) - piece->ay;
        for (int column = MAX(left, 0); column <= MIN(right, size - 1); column++) {
            float x = fr_blade_x(outline, size, (float)column) - piece->ax;
            float t = CLAMP((x * dx + y * dy) / squared, 0.0f, 1.0f);
            float distance = hypotf(x - t * dx, y - t * dy);
            if (distance < reach) {
                float radius = piece->ra + t * (piece->rb - piece->ra);
                size_t texel = (size_t)row * (size_t)size + (size_t)column;
                mark(field, texel, distance, radius, pixel);
            }
        }
    }
}

FrVeinField *fr_vein_field_new(const FrVenation *venation, const FrOutline *outline, int size) {
    FrVeinField *field = g_new0(FrVeinField, 1);
    size_t texels = (size_t)size * (size_t)size;
    *field = (FrVeinField){
        .size = size, .cover = g_new0(float, texels), .groove = g_new0(float, texels)};
    const FrVein *veins = (const FrVein *)(void *)venation->veins->data;
    for (uint32_t i = 0; i < venation->veins->len; i++) {
        const FrVein *to = &veins[i];
        if (to->parent == FR_NONE) {
            continue;
        }
        const FrVein *from = &veins[to->parent];
        // A branch begins as thin as it is, not as thick as what bears it.
        float ra = fminf(from->radius, 1.15f * to->radius);
        Piece piece = {from->x, from->y, to->x, to->y, ra, to->radius};
        draw(field, outline, &piece);
    }
    for (uint32_t i = 0; i < venation->joins->len; i++) {
        FrVeinJoin join = g_array_index(venation->joins, FrVeinJoin, i);
        const FrVein *from = &veins[join.from], *to = &veins[join.to];
        float radius = fminf(from->radius, to->radius);
        Piece piece = {from->x, from->y, to->x, to->y, radius, radius};
        draw(field, outline, &piece);
    }
    return field;
}

void fr_vein_field_free(FrVeinField *field) {
    g_free(field->cover);
    g_free(field->groove);
    g_free(field);
}
