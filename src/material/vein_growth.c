// Space colonization: A. Runions, M. Fuhrer, B. Lane, P. Federl, A.-G. Rolland-Lagan,
// P. Prusinkiewicz, "Modeling and visualization of leaf venation patterns", SIGGRAPH 2005.
//
// Open venation: a source pulls the one vein node nearest to it and vanishes when it is reached.
// Closed venation: a source pulls every node of its relative neighbourhood (no other node is
// nearer to both) and vanishes when all the veins it pulls have reached it; there they join.

#include "material/vein_growth.h"

#include <math.h>

enum { MOST_PULLED = 4, PATIENCE = 3, MOST_STEPS = 400 };

/// A vein node that a source pulls.
typedef struct Pull {
    uint32_t node;
    float distance;
    int stalled; ///< steps without coming nearer
} Pull;

typedef struct Source {
    float x, y;
    Pull pulls[MOST_PULLED];
    int count;
} Source;

/// What one step knows about a node.
typedef struct Tip {
    float x, y; ///< sum of unit vectors to the sources that pull it
    uint32_t child;
    bool is_pulled;
} Tip;

typedef struct Growth {
    FrVenation *venation;
    const FrVeinGrid *grid;
    GArray *sources; ///< Source, the live ones
    GArray *tips;    ///< Tip, one a node
    GArray *pulled;  ///< uint32_t, nodes pulled in this step
    float spacing, step;
    bool is_closed;
} Growth;

static FrVein *vein(const FrVenation *venation, uint32_t index) {
    return &g_array_index(venation->veins, FrVein, index);
}

// ---- which veins a source pulls -----------------------------------------------------------------

static void collect(void *data, uint32_t point, float distance) {
    Pull pull = {.node = point, .distance = distance};
    g_array_append_val((GArray *)data, pull);
}

static int by_distance(const void *a, const void *b) {
    const Pull *p = a, *q = b;
    if (p->distance != q->distance) {
        return p->distance < q->distance ? -1 : 1;
    }
    return p->node < q->node ? -1 : 1;
}

/// Of nodes in rising distance, those with no nearer node that is also nearer to them.
static void relative_neighbours(const FrVenation *venation, const GArray *candidates,
                                Source *source) {
    for (uint32_t i = 0; i < candidates->len && source->count < MOST_PULLED; i++) {
        Pull pull = g_array_index(candidates, Pull, i);
        const FrVein *v = vein(venation, pull.node);
        bool is_neighbour = true;
        for (uint32_t k = 0; k < i && is_neighbour; k++) {
            const FrVein *u = vein(venation, g_array_index(candidates, Pull, k).node);
            is_neighbour = hypotf(u->x - v->x, u->y - v->y) >= pull.distance;
        }
        if (is_neighbour) {
            source->pulls[source->count++] = pull;
        }
    }
}

static void attach(Growth *growth, const FrAuxin *auxin, GArray *candidates) {
    Source source = {.x = auxin->x, .y = auxin->y};
    if (growth->is_closed) {
        g_array_set_size(candidates, 0);
        fr_vein_grid_visit(growth->grid, source.x, source.y, 2.5f * growth->spacing, collect,
                           candidates);
        g_array_sort(candidates, by_distance);
        relative_neighbours(growth->venation, candidates, &source);
    }
    if (source.count == 0) {
        uint32_t nearest = fr_vein_grid_nearest(growth->grid, source.x, source.y, 2.0f);
        if (nearest == UINT32_MAX) {
            return;
        }
        const FrVein *v = vein(growth->venation, nearest);
        float distance = hypotf(v->x - source.x, v->y - source.y);
        source.pulls[source.count++] = (Pull){.node = nearest, .distance = distance};
    }
    g_array_append_val(growth->sources, source);
}

// ---- a step -------------------------------------------------------------------------------------

static uint32_t add_vein(Growth *growth, uint32_t parent, float x, float y) {
    FrVein node = {.x = x, .y = y, .parent = parent};
    Tip tip = {.child = FR_NONE};
    g_array_append_val(growth->venation->veins, node);
    g_array_append_val(growth->tips, tip);
    return growth->venation->veins->len - 1;
}

static void pull_veins(Growth *growth) {
    g_array_set_size(growth->pulled, 0);
    for (uint32_t s = 0; s < growth->sources->len; s++) {
        const Source *source = &g_array_index(growth->sources, Source, s);
        for (int k = 0; k < source->count; k++) {
            const Pull *pull = &source->pulls[k];
            if (pull->distance <= growth->step) {
                continue;
            }
            const FrVein *v = vein(growth->venation, pull->node);
            Tip *tip = &g_array_index(growth->tips, Tip, pull->node);
            if (!tip->is_pulled) {
                *tip = (Tip){.child = FR_NONE, .is_pulled = true};
                g_array_append_val(growth->pulled, pull->node);
            }
            tip->x += (source->x - v->x) / pull->distance;
            tip->y += (source->y - v->y) / pull->distance;
        }
    }
}

static void extend_veins(Growth *growth) {
    const float balanced = 1e-3f; // opposite pulls: the vein waits until one source is gone
    for (uint32_t i = 0; i < growth->pulled->len; i++) {
        uint32_t node = g_array_index(growth->pulled, uint32_t, i);
        Tip tip = g_array_index(growth->tips, Tip, node);
        float strength = hypotf(tip.x, tip.y);
        uint32_t child = FR_NONE;
        if (strength > balanced) {
            const FrVein *v = vein(growth->venation, node);
            float reach = growth->step / strength;
            child = add_vein(growth, node, v->x + tip.x * reach, v->y + tip.y * reach);
        }
        Tip *after = &g_array_index(growth->tips, Tip, node);
        after->child = child;
        after->is_pulled = false;
    }
}

/// In open venation a source turns to whichever new node is nearest.
static void turn_to_nearest(Growth *growth, const FrVeinGrid *fresh, uint32_t first_fresh) {
    for (uint32_t s = 0; s < growth->sources->len; s++) {
        Source *source = &g_array_index(growth->sources, Source, s);
        Pull *pull = &source->pulls[0];
        uint32_t nearest = fr_vein_grid_nearest(fresh, source->x, source->y,
                                                fminf(pull->distance, 3 * growth->spacing));
        if (nearest != UINT32_MAX) {
            const FrVein *v = vein(growth->venation, first_fresh + nearest);
            float distance = hypotf(v->x - source->x, v->y - source->y);
            if (distance < pull->distance) {
                *pull = (Pull){.node = first_fresh + nearest, .distance = distance};
                continue;
            }
        }
        pull->stalled++;
    }
}

/// In closed venation every vein on its way to a source stays the source's.
static void follow_children(Growth *growth) {
    for (uint32_t s = 0; s < growth->sources->len; s++) {
        Source *source = &g_array_index(growth->sources, Source, s);
        for (int k = 0; k < source->count; k++) {
            Pull *pull = &source->pulls[k];
            uint32_t child = g_array_index(growth->tips, Tip, pull->node).child;
            if (pull->distance <= growth->step) {
                continue;
            }
            pull->stalled++;
            if (child != FR_NONE) {
                const FrVein *v = vein(growth->venation, child);
                float distance = hypotf(v->x - source->x, v->y - source->y);
                if (distance < pull->distance) {
                    *pull = (Pull){.node = child, .distance = distance};
                }
            }
        }
    }
}

/// All veins have arrived: they meet in the source.
static void join(Growth *growth, const Source *source) {
    if (!growth->is_closed || source->count < 2) {
        return;
    }
    uint32_t meeting = add_vein(growth, source->pulls[0].node, source->x, source->y);
    for (int k = 1; k < source->count; k++) {
        if (source->pulls[k].node != source->pulls[0].node) {
            FrVeinJoin joined = {.from = source->pulls[k].node, .to = meeting};
            g_array_append_val(growth->venation->joins, joined);
        }
    }
}

/// Drops pulls without hope and sources that are reached; keeps the order of the rest.
static void retire_sources(Growth *growth) {
    uint32_t kept = 0;
    for (uint32_t s = 0; s < growth->sources->len; s++) {
        Source source = g_array_index(growth->sources, Source, s);
        int alive = 0;
        bool is_reached = true;
        for (int k = 0; k < source.count; k++) {
            if (source.pulls[k].stalled < PATIENCE) {
                is_reached &= source.pulls[k].distance <= growth->step;
                source.pulls[alive++] = source.pulls[k];
            }
        }
        source.count = alive;
        if (is_reached && alive > 0) {
            join(growth, &source);
        } else if (alive > 0) {
            g_array_index(growth->sources, Source, kept++) = source;
        }
    }
    g_array_set_size(growth->sources, kept);
}

static void one_step(Growth *growth, float half_width) {
    uint32_t first_fresh = growth->venation->veins->len;
    pull_veins(growth);
    extend_veins(growth);
    if (growth->is_closed) {
        follow_children(growth);
    } else {
        FrVeinGrid fresh;
        fr_vein_grid_init(&fresh, half_width, growth->spacing);
        for (uint32_t i = first_fresh; i < growth->venation->veins->len; i++) {
            fr_vein_grid_add(&fresh, vein(growth->venation, i)->x, vein(growth->venation, i)->y);
        }
        turn_to_nearest(growth, &fresh, first_fresh);
        fr_vein_grid_clear(&fresh);
    }
    retire_sources(growth);
}

void fr_veins_grow(FrVenation *venation, const FrVeinGrid *grid, const FrAuxin *sources,
                   uint32_t count, float spacing, float step, bool is_closed) {
    Growth growth = {
        .venation = venation,
        .grid = grid,
        .sources = g_array_new(FALSE, FALSE, sizeof(Source)),
        .tips = g_array_new(FALSE, TRUE, sizeof(Tip)),
        .pulled = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
        .spacing = spacing,
        .step = step,
        .is_closed = is_closed,
    };
    g_array_set_size(growth.tips, venation->veins->len);
    GArray *candidates = g_array_new(FALSE, FALSE, sizeof(Pull));
    for (uint32_t i = 0; i < count; i++) {
        attach(&growth, &sources[i], candidates);
    }
    for (int i = 0; i < MOST_STEPS && growth.sources->len > 0; i++) {
        one_step(&growth, -grid->left);
    }
    g_array_unref(candidates);
    g_array_unref(growth.sources);
    g_array_unref(growth.tips);
    g_array_unref(growth.pulled);
}
