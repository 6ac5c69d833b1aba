#include "material/vein_raster.h"

#include <math.h>

enum { BAND_ROWS = 32 };

static const float valley = 2.6f;   ///< half width of the valley over the vein's
static const float strong = 0.006f; ///< radius of a vein drawn in full strength

/// What is drawn of a vein at one of its ends.
typedef struct End {
    float x, y;
    float drawn; ///< radius, never less than a texel shows
    float strength, depth;
} End;

/// A tapering piece of vein in blade space.
typedef struct Piece {
    End a, b;
    int top, bottom; ///< rows that it may touch
} Piece;

typedef struct Raster {
    FrVeinField *field;
    const FrOutline *outline;
    float pixel;
    Piece *pieces;
    uint32_t count;
    uint32_t *first; ///< by band: where its pieces begin in `order`
    uint32_t *order;
} Raster;

static float smooth(float t) {
    t = CLAMP(t, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static float larger(float a, float b) {
    return a > b ? a : b;
}

static End end_of(const FrVein *vein, float radius, float pixel) {
    float drawn = larger(radius, 0.6f * pixel), part = fminf(radius / strong, 1.0f);
    return (End){
        .x = vein->x,
        .y = vein->y,
        .drawn = drawn,
        .strength = powf(part, 0.62f) * fminf(radius / drawn * 1.3f, 1.0f),
        .depth = powf(part, 0.7f),
    };
}

static void add_piece(Raster *raster, const FrVein *from, const FrVein *to, float ra, float rb) {
    float size = (float)raster->field->size;
    Piece piece = {.a = end_of(from, ra, raster->pixel), .b = end_of(to, rb, raster->pixel)};
    float reach = valley * larger(piece.a.drawn, piece.b.drawn) + 2.0f * raster->pixel;
    piece.top = MAX((int)floorf((1.0f - larger(from->y, to->y) - reach) * size), 0);
    piece.bottom =
        MIN((int)ceilf((1.0f - fminf(from->y, to->y) + reach) * size), raster->field->size - 1);
    raster->pieces[raster->count++] = piece;
}

// ---- one row of one piece -----------------------------------------------------------------------

/// Fields keep the maximum, so the order of pieces does not matter.
static void draw_row(const Raster *raster, const Piece *piece, int row) {
    const FrVeinField *field = raster->field;
    const End *a = &piece->a, *b = &piece->b;
    int size = field->size;
    float pixel = raster->pixel, per_x = (float)size / raster->outline->aspect;
    float most = valley * larger(a->drawn, b->drawn) + 2.0f * pixel;
    float middle = 0.5f * (float)size;
    int left = MAX((int)floorf(middle + (fminf(a->x, b->x) - most) * per_x), 0);
    int right = MIN((int)ceilf(middle + (larger(a->x, b->x) + most) * per_x), size - 1);
    float dx = b->x - a->x, dy = b->y - a->y;
    float inverse = 1.0f / larger(dx * dx + dy * dy, 1e-12f);
    float y = fr_blade_y(size, (float)row) - a->y;
    float *cover = field->cover + (size_t)row * (size_t)size;
    float *groove = field->groove + (size_t)row * (size_t)size;
    for (int column = left; column <= right; column++) {
        float x = fr_blade_x(raster->outline, size, (float)column) - a->x;
        float t = CLAMP((x * dx + y * dy) * inverse, 0.0f, 1.0f);
        float aside = x - t * dx, along = y - t * dy, squared = aside * aside + along * along;
        if (squared >= most * most) {
            continue;
        }
        float distance = sqrtf(squared), drawn = a->drawn + t * (b->drawn - a->drawn);
        float strength = a->strength + t * (b->strength - a->strength);
        float depth = a->depth + t * (b->depth - a->depth);
        float reach = valley * drawn + 2.0f * pixel;
        float covered = strength * smooth(0.5f + (drawn - distance) / (1.4f * pixel));
        cover[column] = larger(cover[column], covered);
        groove[column] = larger(groove[column], depth * smooth(1.0f - distance / reach));
    }
}

static void draw_bands(void *data, size_t begin, size_t end, int worker) {
    const Raster *raster = data;
    (void)worker;
    for (size_t band = begin; band < end; band++) {
        int top = (int)band * BAND_ROWS, bottom = top + BAND_ROWS - 1;
        for (uint32_t i = raster->first[band]; i < raster->first[band + 1]; i++) {
            const Piece *piece = &raster->pieces[raster->order[i]];
            for (int row = MAX(top, piece->top); row <= MIN(bottom, piece->bottom); row++) {
                draw_row(raster, piece, row);
            }
        }
    }
}

// ---- the whole ----------------------------------------------------------------------------------

static void collect(Raster *raster, const FrVenation *venation) {
    const FrVein *veins = (const FrVein *)(void *)venation->veins->data;
    for (uint32_t i = 0; i < venation->veins->len; i++) {
        const FrVein *to = &veins[i];
        if (to->parent != FR_NONE) {
            const FrVein *from = &veins[to->parent];
            // A branch begins as thin as it is, not as thick as what bears it.
            add_piece(raster, from, to, fminf(from->radius, 1.15f * to->radius), to->radius);
        }
    }
    for (uint32_t i = 0; i < venation->joins->len; i++) {
        FrVeinJoin join = g_array_index(venation->joins, FrVeinJoin, i);
        const FrVein *from = &veins[join.from], *to = &veins[join.to];
        float radius = fminf(from->radius, to->radius);
        add_piece(raster, from, to, radius, radius);
    }
}

/// Sorts pieces by the bands of rows that they touch.
static void sort_by_band(Raster *raster, uint32_t bands) {
    raster->first = g_new0(uint32_t, bands + 2);
    uint32_t *next = raster->first + 1; // as pieces are put, it becomes where the next band begins
    for (uint32_t i = 0; i < raster->count; i++) {
        const Piece *piece = &raster->pieces[i];
        for (int band = piece->top / BAND_ROWS; band <= piece->bottom / BAND_ROWS; band++) {
            next[band + 1] += piece->top <= piece->bottom;
        }
    }
    for (uint32_t band = 0; band <= bands; band++) {
        raster->first[band + 1] += raster->first[band];
    }
    raster->order = g_new(uint32_t, MAX(raster->first[bands + 1], 1));
    for (uint32_t i = 0; i < raster->count; i++) {
        const Piece *piece = &raster->pieces[i];
        for (int band = piece->top / BAND_ROWS;
             piece->top <= piece->bottom && band <= piece->bottom / BAND_ROWS; band++) {
            raster->order[next[band]++] = i;
        }
    }
}

FrVeinField *fr_vein_field_new(const FrVenation *venation, const FrOutline *outline, int size,
                               const FrContext *context) {
    FrVeinField *field = g_new0(FrVeinField, 1);
    size_t texels = (size_t)size * (size_t)size;
    *field = (FrVeinField){
        .size = size, .cover = g_new0(float, texels), .groove = g_new0(float, texels)};
    uint32_t bands = (uint32_t)(size - 1) / BAND_ROWS + 1;
    Raster raster = {
        .field = field,
        .outline = outline,
        .pixel = fr_blade_texel(outline, size),
        .pieces = g_new(Piece, venation->veins->len + venation->joins->len + 1),
    };
    collect(&raster, venation);
    sort_by_band(&raster, bands);
    fr_parallel_for(context->pool, bands, 1, draw_bands, &raster, context->progress);
    g_free(raster.pieces);
    g_free(raster.first);
    g_free(raster.order);
    return field;
}

void fr_vein_field_free(FrVeinField *field) {
    g_free(field->cover);
    g_free(field->groove);
    g_free(field);
}
