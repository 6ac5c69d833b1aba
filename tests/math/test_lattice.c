// Bézier lattices: the regular one moves nothing, others are held against Bernstein's sum.
#include "frond/lattice.h"

#include <glib.h>
#include <math.h>

static FrLattice regular(uint32_t a, uint32_t b, uint32_t c) {
    FrLattice lattice = {.min = {-1, 0.5, -3}, .max = {2, 1.25, 4}, .degree = {a, b, c}};
    fr_lattice_reset(&lattice);
    return lattice;
}

static void assert_near(double a, double b, double tolerance) {
    g_assert_cmpfloat(fabs(a - b), <=, tolerance);
}

static void identity(void) {
    for (uint32_t degree = 1; degree <= 4; degree++) {
        FrLattice lattice = regular(degree, 1 + degree % 4, 1 + (degree + 1) % 4);
        for (int k = 0; k < 200; k++) {
            // Also well outside the box.
            double at[3] = {-3 + 0.04 * k, 0.2 + 0.009 * k, 6 - 0.07 * k};
            double out[3], jacobian[3][3];
            fr_lattice_eval(&lattice, at, out, jacobian);
            for (int r = 0; r < 3; r++) {
                assert_near(out[r], at[r], 1e-12);
                for (int c = 0; c < 3; c++) {
                    assert_near(jacobian[r][c], r == c, 1e-12);
                }
            }
        }
    }
}

static double binomial(uint32_t n, uint32_t k) {
    double value = 1;
    for (uint32_t i = 1; i <= k; i++) {
        value = value * (n - k + i) / i;
    }
    return value;
}

static double bernstein(uint32_t n, uint32_t k, double t) {
    return binomial(n, k) * pow(t, k) * pow(1 - t, n - k);
}

static void move_some(FrLattice *lattice) {
    for (uint32_t p = 0; p < fr_lattice_count(lattice); p++) {
        for (int k = 0; k < 3; k++) {
            lattice->points[p][k] += 0.3 * sin(7.0 * p + 2.0 * k);
        }
    }
}

static void bernstein_sum(void) {
    FrLattice lattice = regular(4, 2, 3);
    move_some(&lattice);
    const double part[3] = {0.3, 0.8, 0.15};
    double at[3], out[3], sum[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        at[k] = lattice.min[k] + part[k] * (lattice.max[k] - lattice.min[k]);
    }
    for (uint32_t i = 0; i <= 4; i++) {
        for (uint32_t j = 0; j <= 2; j++) {
            for (uint32_t k = 0; k <= 3; k++) {
                double weight =
                    bernstein(4, i, part[0]) * bernstein(2, j, part[1]) * bernstein(3, k, part[2]);
                for (int c = 0; c < 3; c++) {
                    sum[c] += weight * lattice.points[fr_lattice_index(&lattice, i, j, k)][c];
                }
            }
        }
    }
    fr_lattice_eval(&lattice, at, out, NULL);
    for (int c = 0; c < 3; c++) {
        assert_near(out[c], sum[c], 1e-12);
    }
}

static void jacobian(void) {
    FrLattice lattice = regular(3, 4, 2);
    move_some(&lattice);
    const double at[3] = {0.7, 0.9, 1.1};
    double out[3], exact[3][3];
    fr_lattice_eval(&lattice, at, out, exact);
    for (int c = 0; c < 3; c++) {
        double below[3] = {at[0], at[1], at[2]}, above[3] = {at[0], at[1], at[2]}, a[3], b[3];
        below[c] -= 1e-5;
        above[c] += 1e-5;
        fr_lattice_eval(&lattice, below, a, NULL);
        fr_lattice_eval(&lattice, above, b, NULL);
        for (int r = 0; r < 3; r++) {
            assert_near(exact[r][c], (b[r] - a[r]) / 2e-5, 1e-7);
        }
    }
}

static void corners(void) {
    // A corner's control point is where the corner goes.
    FrLattice lattice = regular(2, 2, 2);
    double *corner = lattice.points[fr_lattice_index(&lattice, 2, 2, 2)];
    corner[0] = 5;
    corner[1] = 6;
    corner[2] = 7;
    double out[3];
    fr_lattice_eval(&lattice, lattice.max, out, NULL);
    assert_near(out[0], 5, 1e-12);
    assert_near(out[1], 6, 1e-12);
    assert_near(out[2], 7, 1e-12);
    fr_lattice_eval(&lattice, lattice.min, out, NULL);
    assert_near(out[0], lattice.min[0], 1e-12);
}

static void outside(void) {
    // Beyond the box the way goes on straight, without a jump at the face.
    FrLattice lattice = regular(4, 4, 4);
    move_some(&lattice);
    double place[4][3];
    for (int k = 0; k < 4; k++) {
        double at[3] = {0.2, 0.8, 4 + 0.5 * k};
        fr_lattice_eval(&lattice, at, place[k], NULL);
    }
    for (int c = 0; c < 3; c++) {
        double step = place[1][c] - place[0][c];
        assert_near(place[2][c] - place[1][c], step, 1e-12);
        assert_near(place[3][c] - place[2][c], step, 1e-12);
    }
    double near_face[3] = {0.2, 0.8, 4 - 1e-9}, out[3];
    fr_lattice_eval(&lattice, near_face, out, NULL);
    for (int c = 0; c < 3; c++) {
        assert_near(out[c], place[0][c], 1e-7);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/math/lattice/C29 a regular lattice of any degree moves nothing", identity);
    g_test_add_func("/math/lattice/a lattice is Bernstein's sum over its points", bernstein_sum);
    g_test_add_func("/math/lattice/the Jacobian is the derivative", jacobian);
    g_test_add_func("/math/lattice/C32 a corner goes where its control point is moved", corners);
    g_test_add_func("/math/lattice/outside the box the way goes on straight", outside);
    return g_test_run();
}
