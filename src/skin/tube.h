// Writes the tubes of a run.
#pragma once

#include "skin/plan.h"

#include <math.h>

/// Smallest box around what one thread wrote of a part.
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

/// Writes every tube of the run at its place in `mesh`. `part_of` and `boxes` go by slot.
void fr_write_run(const FrPlan *plan, const FrRun *run, FrUpAxis up, FrMesh *mesh,
                  const uint32_t *part_of, FrBox *boxes, FrDeformNote *notes);
