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
    for (uint64_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            float at = vertices[i].position[k];
            box->min[k] = at < box->min[k] ? at : box->min[k];
            box->max[k] = at > box->max[k] ? at : box->max[k];
        }
    }
}

/// A vector of the plant (z up) as the mesh wants it.
static inline vec3s fr_upright(vec3s v, FrUpAxis up) {
    return up == FR_UP_Y ? (vec3s){{v.x, v.z, -v.y}} : v;
}

/// Writes every tube of the run at its place in `mesh`. `part_of` and `boxes` go by slot.
void fr_write_run(const FrPlan *plan, const FrRun *run, FrUpAxis up, FrMesh *mesh,
                  const uint32_t *part_of, FrBox *boxes);
