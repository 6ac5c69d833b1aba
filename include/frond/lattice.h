/// @file lattice.h
/// Trivariate Bézier lattices: a box of space that is deformed by moving control points.
#pragma once

#include "frond/api.h"

enum { FR_LATTICE_MOST_DEGREE = 4, FR_LATTICE_MOST_POINTS = 125 };

/// X(u, v, w) = Σ Bᵢ(u) Bⱼ(v) Bₖ(w) Pᵢⱼₖ, where (u, v, w) is 0 to 1 within the box.
typedef struct FrLattice {
    double min[3], max[3];                    ///< the box, min < max
    uint32_t degree[3];                       ///< 1 to 4 along each axis
    double points[FR_LATTICE_MOST_POINTS][3]; ///< at fr_lattice_index()
} FrLattice;

/// Where control point (i, j, k) is stored.
static inline uint32_t fr_lattice_index(const FrLattice *lattice, uint32_t i, uint32_t j,
                                        uint32_t k) {
    return (i * (lattice->degree[1] + 1) + j) * (lattice->degree[2] + 1) + k;
}

/// Control points there are.
static inline uint32_t fr_lattice_count(const FrLattice *lattice) {
    return (lattice->degree[0] + 1) * (lattice->degree[1] + 1) * (lattice->degree[2] + 1);
}

/// Puts every control point in its regular place: the lattice that moves nothing.
FR_API void fr_lattice_reset(FrLattice *lattice);
/// Where `at` goes. Outside the box the deformation goes on linearly from the nearest point of the
/// box. `jacobian` may be NULL; jacobian[r][c] is ∂out[r]/∂at[c].
FR_API void fr_lattice_eval(const FrLattice *lattice, const double at[3], double out[3],
                            double jacobian[3][3]);
