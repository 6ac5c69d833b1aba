// Free-form deformation of a box of space by a trivariate tensor product of Bernstein polynomials.
// Sederberg, Parry. Free-Form Deformation of Solid Geometric Models. SIGGRAPH 1986.
//
// Control points are stored as they lie; what is summed are their displacements from the regular
// lattice, which reproduces the identity. So a lattice that has not been moved moves nothing at
// all, not even by rounding.
#include "frond/lattice.h"

enum { ROOM = FR_LATTICE_MOST_DEGREE + 1 };

// Bernstein polynomials of one degree and their derivatives at t.
static void bernstein(uint32_t degree, double t, double value[ROOM], double slope[ROOM]) {
    double lower[ROOM] = {1};
    value[0] = 1;
    for (uint32_t n = 1; n <= degree; n++) { // raises the degree by one
        for (uint32_t i = 0; i < n; i++) {
            lower[i] = value[i];
        }
        value[0] = (1 - t) * lower[0];
        for (uint32_t i = 1; i < n; i++) {
            value[i] = (1 - t) * lower[i] + t * lower[i - 1];
        }
        value[n] = t * lower[n - 1];
    }
    for (uint32_t i = 0; i <= degree; i++) {
        double before = i > 0 ? lower[i - 1] : 0;
        double here = i < degree ? lower[i] : 0;
        slope[i] = degree * (before - here);
    }
}

static double regular(const FrLattice *lattice, int axis, uint32_t i) {
    double part = (double)i / lattice->degree[axis];
    return lattice->min[axis] + part * (lattice->max[axis] - lattice->min[axis]);
}

void fr_lattice_reset(FrLattice *lattice) {
    for (int axis = 0; axis < 3; axis++) {
        FR_ASSERT(lattice->degree[axis] >= 1 && lattice->degree[axis] <= FR_LATTICE_MOST_DEGREE);
        FR_ASSERT(lattice->min[axis] < lattice->max[axis]);
    }
    for (uint32_t i = 0; i <= lattice->degree[0]; i++) {
        for (uint32_t j = 0; j <= lattice->degree[1]; j++) {
            for (uint32_t k = 0; k <= lattice->degree[2]; k++) {
                double *point = lattice->points[fr_lattice_index(lattice, i, j, k)];
                point[0] = regular(lattice, 0, i);
                point[1] = regular(lattice, 1, j);
                point[2] = regular(lattice, 2, k);
            }
        }
    }
}

// Displacement at a point of the box and its derivatives by u, v, w.
static void displace(const FrLattice *lattice, const double at[3], double out[3],
                     double slopes[3][3]) {
    double value[3][ROOM], slope[3][ROOM];
    for (int axis = 0; axis < 3; axis++) {
        bernstein(lattice->degree[axis], at[axis], value[axis], slope[axis]);
        out[axis] = slopes[0][axis] = slopes[1][axis] = slopes[2][axis] = 0;
    }
    for (uint32_t i = 0; i <= lattice->degree[0]; i++) {
        for (uint32_t j = 0; j <= lattice->degree[1]; j++) {
            for (uint32_t k = 0; k <= lattice->degree[2]; k++) {
                const double *point = lattice->points[fr_lattice_index(lattice, i, j, k)];
                const double place[3] = {regular(lattice, 0, i), regular(lattice, 1, j),
                                         regular(lattice, 2, k)};
                for (int axis = 0; axis < 3; axis++) {
                    double moved = point[axis] - place[axis];
                    out[axis] += value[0][i] * value[1][j] * value[2][k] * moved;
                    slopes[0][axis] += slope[0][i] * value[1][j] * value[2][k] * moved;
                    slopes[1][axis] += value[0][i] * slope[1][j] * value[2][k] * moved;
                    slopes[2][axis] += value[0][i] * value[1][j] * slope[2][k] * moved;
                }
            }
        }
    }
}

void fr_lattice_eval(const FrLattice *lattice, const double at[3], double out[3],
                     double jacobian[3][3]) {
    double inside[3], beyond[3], moved[3], slopes[3][3];
    for (int axis = 0; axis < 3; axis++) {
        double size = lattice->max[axis] - lattice->min[axis];
        double t = (at[axis] - lattice->min[axis]) / size;
        inside[axis] = t < 0 ? 0 : t > 1 ? 1 : t;
        beyond[axis] = t - inside[axis];
    }
    displace(lattice, inside, moved, slopes);
    for (int row = 0; row < 3; row++) {
        out[row] = at[row] + moved[row];
        for (int axis = 0; axis < 3; axis++) {
            out[row] += slopes[axis][row] * beyond[axis];
        }
    }
    if (jacobian == NULL) {
        return;
    }
    // Beyond a face the derivative across it stays; those along it are taken on the face.
    for (int row = 0; row < 3; row++) {
        for (int axis = 0; axis < 3; axis++) {
            double size = lattice->max[axis] - lattice->min[axis];
            jacobian[row][axis] = slopes[axis][row] / size + (row == axis ? 1 : 0);
        }
    }
}
