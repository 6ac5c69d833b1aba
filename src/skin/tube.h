// Writes the tubes of a run.
#pragma once

#include "skin/plan.h"

#include <math.h>

/// Where the vertices and indices of one part are.
typedef struct FrSlab {
    FrVertex *vertices;
    uint32_t *indices;
} FrSlab;

/// Smallest box around some vertices.
typedef struct FrBox {
    float min[3], max[3];
} FrBox;

static inline FrBox fr_box_empty(void) {
    return (FrBox){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static inline void fr_box_widen(FrBox *box, const FrVertex *vertices, uint64_t count) {
    // Four at once, the fourth for nothing: compilers make single instructions of that.
    float low[4] = {INFINITY, INFINITY, INFINITY, INFINITY};
    float high[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (uint64_t i = 0; i < count; i++) {
        const float *at = (const float *)&vertices[i];
        for (int k = 0; k < 4; k++) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        box->min[k] = low[k] < box->min[k] ? low[k] : box->min[k];
        box->max[k] = high[k] > box->max[k] ? high[k] : box->max[k];
    }
}

/// A vector of the plant (z up) as the mesh wants it.
static inline vec3s fr_upright(vec3s v, FrUpAxis up) {
    return up == FR_UP_Y ? (vec3s){{v.x, v.z, -v.y}} : v;
}

static inline void fr_box_join(FrBox *box, const FrBox *other) {
    for (int k = 0; k < 3; k++) {
        box->min[k] = MIN(box->min[k], other->min[k]);
        box->max[k] = MAX(box->max[k], other->max[k]);
    }
}

/// Writes every tube of the run at its place in the slab of its slot, and the box of each into
/// `boxes`, which go by tube.
void fr_write_run(const FrPlan *plan, const FrRun *run, FrUpAxis up, const FrSlab *slabs,
                  FrBox *boxes, FrDeformNote *notes);
