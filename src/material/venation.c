// The veins of a leaf: midrib and secondaries (pinnate), several main veins from the base
// (palmate), or many that run side by side from base to tip (parallel) first, then finer and finer
// stages of space colonization (vein_growth.c). A stage that halves the distances on a finished
// blade does what Runions et al. 2005 do by keeping the distances and doubling a uniformly growing
// blade.
//
// Radii: C. D. Murray, "The physiological principle of minimum work", 1926: the cube of a vein's
// radius is the sum of the cubes of what it feeds.

#include "material/venation.h"

#include <math.h>

#include "material/vein_growth.h"

enum {
    DRAW_SECONDARY = 1,
    DRAW_STAGE = 2,
    DRAW_BRIDGE = 77,
    MOST_SECONDARIES = 60,
    MOST_STAGES = 24
};
enum { PINNATE, PALMATE, PARALLEL };

static const float trunk_step = 0.004f; ///< of midrib and secondaries

typedef struct Maker {
    FrVenation *venation;
    const FrMaterialParams *params;
    const FrOutline *outline;
    FrProgress *progress;
    FrKey key;
    float density;
    bool is_closed;
} Maker;

static FrVein *vein(const FrVenation *venation, uint32_t index) {
    return &g_array_index(venation->veins, FrVein, index);
}

static uint32_t add_vein(FrVenation *venation, uint32_t parent, float x, float y) {
    FrVein node = {.x = x, .y = y, .parent = parent};
    g_array_append_val(venation->veins, node);
    return venation->veins->len - 1;
}

// ---- midrib and secondaries ---------------------------------------------------------------------

/// Returns how many nodes the midrib has: node i is at y = i · trunk_step.
static uint32_t grow_midrib(Maker *maker) {
    const float *tip = maker->outline->points[maker->outline->count - 1];
    uint32_t count = (uint32_t)(tip[1] / trunk_step);
    uint32_t last = add_vein(maker->venation, FR_NONE, 0, 0);
    for (uint32_t i = 1; i < count; i++) {
        last = add_vein(maker->venation, last, 0, (float)i * trunk_step);
    }
    return MAX(count, 1);
}

/// Follows a secondary from the midrib: it leaves at `angle` from the midrib's direction and bends
/// towards the tip on its way. In closed venation it turns along the margin, for `spacing` at most,
/// so that the next stage joins it to the secondary above.
static void grow_secondary(Maker *maker, uint32_t base, float side, float angle, float spacing) {
    const float clearance = maker->is_closed ? 0.016f : 0.006f, margin_zone = 0.05f;
    float x = 0, y = vein(maker->venation, base)->y;
    float half = fmaxf(fr_outline_half_width(maker->outline, y + 0.08f), 0.02f);
    float wander = (float)fr_random(maker->key, DRAW_SECONDARY, 3 * base) * 6.0f;
    float along_margin = 0;
    uint32_t last = base;
    while (along_margin < spacing) {
        float way = fminf(x / half, 1.0f);
        float heading = angle * (1.0f - 0.4f * way * way) + 0.04f * sinf(wander + 25.0f * x);
        float distance = fr_outline_at(maker->outline, x, y).distance;
        if (maker->is_closed && x > 0.3f * half && distance < margin_zone) {
            heading *= 0.25f + 0.75f * fmaxf(distance - clearance, 0) / margin_zone;
            along_margin += trunk_step;
        }
        x += trunk_step * sinf(heading);
        y += trunk_step * cosf(heading);
        if (y >= 1 || fr_outline_at(maker->outline, x, y).distance < clearance) {
            return;
        }
        last = add_vein(maker->venation, last, side * x, y);
    }
}

/// Pairs of secondaries at nearly equal distances, left and right a little apart, steeper towards
/// the tip.
static void grow_secondaries(Maker *maker, uint32_t midrib, float lowest) {
    const float highest = 0.93f;
    float wanted = roundf(8.0f * sqrtf(maker->density));
    int pairs = (int)CLAMP(wanted, 3.0f, (float)MOST_SECONDARIES);
    float spacing = (highest - lowest) / (float)pairs;
    for (int i = 0; i < 2 * pairs; i++) {
        uint32_t draw = (uint32_t)i;
        float jitter = (float)fr_random_signed(maker->key, DRAW_SECONDARY, 3 * draw + 1);
        float place = ((float)(i / 2) + (i % 2 == 0 ? 0.1f : 0.45f) + 0.1f * jitter) / (float)pairs;
        float y = lowest + (highest - lowest) * powf(place, 0.95f);
        uint32_t base = (uint32_t)(y / trunk_step);
        if (base < 1 || base + 1 >= midrib) {
            continue;
        }
        float tilt = (float)fr_random_signed(maker->key, DRAW_SECONDARY, 3 * draw + 2);
        float angle = 1.0f - 0.3f * place + 0.05f * tilt;
        grow_secondary(maker, base, i % 2 == 0 ? -1.0f : 1.0f, angle, 0.8f * spacing);
    }
}

// ---- other patterns -----------------------------------------------------------------------------

/// Follows a main vein from the base to the margin, bending a little to the tip.
static void grow_main(Maker *maker, uint32_t base, float side, float angle) {
    const float clearance = 0.012f, free = 0.1f; // so far the base's own margin is near
    float x = 0, y = vein(maker->venation, base)->y;
    uint32_t last = base;
    for (float way = 0; way < 1.2f; way += trunk_step) {
        float heading = angle * (1.0f - 0.35f * fminf(2.0f * way, 1.0f));
        x += trunk_step * sinf(heading);
        y += trunk_step * cosf(heading);
        float distance = fr_outline_at(maker->outline, x, y).distance;
        if (y >= 1 || distance < (way > free ? clearance : 0.0f)) {
            return;
        }
        last = add_vein(maker->venation, last, side * x, y);
    }
}

/// Main veins fan out from the base; the midrib has secondaries above them.
static void grow_palm(Maker *maker, uint32_t midrib) {
    const float fan[] = {0.55f, 1.05f, 1.5f};
    uint32_t base = MIN(4, midrib - 1);
    for (size_t k = 0; k < G_N_ELEMENTS(fan); k++) {
        float tilt = 0.06f * (float)fr_random_signed(maker->key, DRAW_SECONDARY, (uint32_t)k);
        grow_main(maker, base, 1.0f, fan[k] + tilt);
        grow_main(maker, base, -1.0f, fan[k] - tilt);
    }
    grow_secondaries(maker, midrib, 0.35f);
}

/// Veins side by side from base to tip, as far apart as the blade is wide, and short bridges
/// between neighbours.
static void grow_parallel(Maker *maker, uint32_t midrib) {
    enum { MOST_LINES = 40 };
    FrVenation *venation = maker->venation;
    int lines = (int)CLAMP(roundf(6.0f * sqrtf(maker->density)), 2.0f, (float)MOST_LINES);
    vein(venation, midrib - 1)->radius = 1.5f * (float)lines; // the midrib is the strongest
    for (int side = -1; side <= 1; side += 2) {
        uint32_t before_first = 0, before_count = midrib;
        for (int k = 1; k <= lines; k++) {
            float out = (float)side * (float)k / ((float)lines + 0.7f);
            uint32_t first = venation->veins->len, last = 0;
            for (uint32_t i = 1; i < midrib; i++) {
                float y = (float)i * trunk_step;
                last = add_vein(venation, last, out * fr_outline_half_width(maker->outline, y), y);
            }
            uint32_t count = venation->veins->len - first;
            for (uint32_t i = 4; i < MIN(count, before_count); i++) {
                FrKey key =
                    fr_key_child(maker->key, DRAW_BRIDGE + (uint64_t)(k * side + MOST_LINES));
                if (fr_random(key, DRAW_BRIDGE, i) < 0.008) {
                    // A step higher on the outer one.
                    FrVeinJoin bridge = {before_first + i - 2, first + i - 1};
                    g_array_append_val(venation->joins, bridge);
                }
            }
            before_first = first;
            before_count = count;
        }
    }
}

// ---- stages of finer veins ----------------------------------------------------------------------

/// Throws sources like darts: kept are those inside the blade, `spacing` from each other and from
/// every vein.
static GArray *throw_sources(const Maker *maker, const FrVeinGrid *veins, int stage,
                             float spacing) {
    GArray *sources = g_array_new(FALSE, FALSE, sizeof(FrAuxin));
    FrVeinGrid taken;
    float half = 0.5f * maker->outline->aspect;
    fr_vein_grid_init(&taken, half, spacing);
    uint32_t throws = (uint32_t)(6.0f * half / (spacing * spacing));
    FrKey key = fr_key_child(maker->key, (uint64_t)(DRAW_STAGE + stage));
    for (uint32_t i = 0; i < throws; i++) {
        FrAuxin auxin = {.x = half * (float)fr_random_signed(key, 0, i),
                         .y = (float)fr_random(key, 1, i)};
        bool is_free =
            fr_vein_grid_nearest(veins, auxin.x, auxin.y, 0.8f * spacing) == UINT32_MAX &&
            fr_vein_grid_nearest(&taken, auxin.x, auxin.y, spacing) == UINT32_MAX;
        if (is_free && fr_outline_at(maker->outline, auxin.x, auxin.y).distance > 0.35f * spacing) {
            fr_vein_grid_add(&taken, auxin.x, auxin.y);
            g_array_append_val(sources, auxin);
        }
    }
    fr_vein_grid_clear(&taken);
    return sources;
}

static void grow_stages(Maker *maker, float finest) {
    const float coarsest = 0.065f, shrink = 0.8f;
    float least = fmaxf(0.0135f / maker->density, finest);
    float spacing = coarsest / sqrtf(maker->density);
    for (int stage = 0; stage < MOST_STAGES && spacing >= least; stage++, spacing *= shrink) {
        if (fr_progress_is_cancelled(maker->progress)) {
            return;
        }
        FrVeinGrid veins;
        fr_vein_grid_init(&veins, 0.5f * maker->outline->aspect, spacing);
        for (uint32_t i = 0; i < maker->venation->veins->len; i++) {
            const FrVein *v = vein(maker->venation, i);
            fr_vein_grid_add(&veins, v->x, v->y);
        }
        GArray *sources = throw_sources(maker, &veins, stage, spacing);
        float step = fminf(trunk_step, 0.3f * spacing);
        fr_veins_grow(maker->venation, &veins, (const FrAuxin *)(void *)sources->data, sources->len,
                      spacing, step, maker->is_closed);
        g_array_unref(sources);
        fr_vein_grid_clear(&veins);
    }
}

/// Growth in steps leaves corners: every node between two others moves to their middle.
static void smooth_veins(FrVenation *venation, uint32_t first) {
    enum { PASSES = 3 };
    uint32_t count = venation->veins->len;
    uint32_t *child = g_new(uint32_t, count), *children = g_new0(uint32_t, count);
    for (uint32_t i = 1; i < count; i++) {
        uint32_t parent = vein(venation, i)->parent;
        child[parent] = i;
        children[parent]++;
    }
    for (int pass = 0; pass < PASSES; pass++) {
        for (uint32_t i = first; i < count; i++) {
            FrVein *v = vein(venation, i);
            if (children[i] == 1) {
                const FrVein *a = vein(venation, v->parent), *b = vein(venation, child[i]);
                v->x = 0.5f * v->x + 0.25f * (a->x + b->x);
                v->y = 0.5f * v->y + 0.25f * (a->y + b->y);
            }
        }
    }
    g_free(child);
    g_free(children);
}

// ---- radii --------------------------------------------------------------------------------------

static void set_radii(FrVenation *venation) {
    const float midrib_radius = 0.0095f;
    GArray *veins = venation->veins;
    for (uint32_t i = veins->len; i-- > 0;) {
        FrVein *v = vein(venation, i);
        v->radius = v->radius == 0 ? 1 : v->radius; // the radius's cube, in units of a tip's
        if (v->parent != FR_NONE) {
            vein(venation, v->parent)->radius += v->radius;
        }
    }
    float whole = cbrtf(vein(venation, 0)->radius);
    for (uint32_t i = 0; i < veins->len; i++) {
        vein(venation, i)->radius = midrib_radius * cbrtf(vein(venation, i)->radius) / whole;
    }
}

FrVenation *fr_venation_new(const FrMaterialParams *params, const FrOutline *outline, FrKey key,
                            float finest, FrProgress *progress) {
    FrVenation *venation = g_new0(FrVenation, 1);
    venation->veins = g_array_new(FALSE, FALSE, sizeof(FrVein));
    venation->joins = g_array_new(FALSE, FALSE, sizeof(FrVeinJoin));
    Maker maker = {
        .venation = venation,
        .params = params,
        .outline = outline,
        .progress = progress,
        .key = key,
        .density = (float)CLAMP(params->vein_density, 0.1, 8),
        .is_closed = params->venation == 1,
    };
    uint32_t midrib = grow_midrib(&maker);
    if (params->vein_pattern == PALMATE) {
        grow_palm(&maker, midrib);
    } else if (params->vein_pattern == PARALLEL) {
        grow_parallel(&maker, midrib);
    } else {
        grow_secondaries(&maker, midrib, 0.05f);
    }
    uint32_t trunk = venation->veins->len;
    if (params->vein_pattern != PARALLEL) {
        grow_stages(&maker, finest);
    }
    smooth_veins(venation, trunk);
    set_radii(venation);
    return venation;
}

void fr_venation_free(FrVenation *venation) {
    g_array_unref(venation->veins);
    g_array_unref(venation->joins);
    g_free(venation);
}
