// One deformation at one place: where it goes and how space is stretched there.
// The rotation in a Jacobian: Higham. Computing the Polar Decomposition, with Applications. SIAM
// Journal on Scientific and Statistical Computing 7 (4), 1986.
#include "plant/deform.h"

#include <math.h>

// Nothing is moved farther than this, in metres.
#define FARTHEST 1e9
// Half the distance over which the derivatives of functions are taken, in units at the origin.
#define DERIVATIVE_STEP 1e-5
// A determinant below this part of the product of its columns' lengths is none.
#define FLAT 1e-7
enum { MOST_POLAR_STEPS = 40 };

double fr_deform_determinant(const double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

void fr_deform_cofactors(const double m[3][3], double out[3][3]) {
    for (int r = 0; r < 3; r++) {
        int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
        for (int c = 0; c < 3; c++) {
            int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            out[r][c] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        }
    }
}

void fr_deform_product(const double a[3][3], const double b[3][3], double product[3][3]) {
    double made[3][3];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            made[r][c] = a[r][0] * b[0][c] + a[r][1] * b[1][c] + a[r][2] * b[2][c];
        }
    }
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            product[r][c] = made[r][c];
        }
    }
}

static double column_lengths(const double m[3][3]) {
    double product = 1;
    for (int c = 0; c < 3; c++) {
        product *= sqrt(m[0][c] * m[0][c] + m[1][c] * m[1][c] + m[2][c] * m[2][c]);
    }
    return product;
}

static void set_identity(double m[3][3]) {
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            m[r][c] = r == c;
        }
    }
}

bool fr_deform_rotation(const double matrix[3][3], double rotation[3][3]) {
    double lengths = column_lengths(matrix);
    double determinant = fr_deform_determinant(matrix);
    if (!(determinant > FLAT * lengths) || !isfinite(lengths)) {
        set_identity(rotation);
        return false;
    }
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            rotation[r][c] = matrix[r][c];
        }
    }
    for (int step = 0; step < MOST_POLAR_STEPS; step++) {
        double cofactors[3][3], change = 0;
        fr_deform_cofactors((const double(*)[3])rotation, cofactors);
        double det = fr_deform_determinant((const double(*)[3])rotation);
        // Scaled to determinant 1 on the way, Newton's iteration sets out near its goal.
        double factor = step < 4 ? 1 / cbrt(det) : 1;
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++) {
                double next = 0.5 * (factor * rotation[r][c] + cofactors[r][c] / (factor * det));
                change = fmax(change, fabs(next - rotation[r][c]));
                rotation[r][c] = next;
            }
        }
        if (change < 1e-14) {
            break;
        }
    }
    return true;
}

void fr_deform_matrix(versors rotation, double axes[3][3]) {
    double x = (double)rotation.x, y = (double)rotation.y, z = (double)rotation.z,
           w = (double)rotation.w;
    double inverse = 1 / sqrt(x * x + y * y + z * z + w * w);
    x *= inverse;
    y *= inverse;
    z *= inverse;
    w *= inverse;
    axes[0][0] = 1 - 2 * (y * y + z * z);
    axes[0][1] = 2 * (x * y - w * z);
    axes[0][2] = 2 * (x * z + w * y);
    axes[1][0] = 2 * (x * y + w * z);
    axes[1][1] = 1 - 2 * (x * x + z * z);
    axes[1][2] = 2 * (y * z - w * x);
    axes[2][0] = 2 * (x * z - w * y);
    axes[2][1] = 2 * (y * z + w * x);
    axes[2][2] = 1 - 2 * (x * x + y * y);
}

versors fr_deform_quaternion(const double m[3][3]) {
    double q[4], trace = m[0][0] + m[1][1] + m[2][2];
    if (trace > 0) {
        double s = 2 * sqrt(trace + 1);
        q[0] = (m[2][1] - m[1][2]) / s;
        q[1] = (m[0][2] - m[2][0]) / s;
        q[2] = (m[1][0] - m[0][1]) / s;
        q[3] = 0.25 * s;
    } else {
        int i = m[1][1] > m[0][0] ? 1 : 0;
        i = m[2][2] > m[i][i] ? 2 : i;
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double s = 2 * sqrt(fmax(1 + m[i][i] - m[j][j] - m[k][k], 1e-30));
        q[i] = 0.25 * s;
        q[j] = (m[j][i] + m[i][j]) / s;
        q[k] = (m[k][i] + m[i][k]) / s;
        q[3] = (m[k][j] - m[j][k]) / s;
    }
    double inverse = 1 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return (versors){{(float)(q[0] * inverse), (float)(q[1] * inverse), (float)(q[2] * inverse),
                      (float)(q[3] * inverse)}};
}

static double bounded(double value) {
    return fmax(-FARTHEST, fmin(value, FARTHEST));
}

// Of the operations that had no value, the one that stands first in its text is kept, so that it
// does not matter which vertex came first.
static void note_fault(FrDeformNote *note, const FrExprFault *fault, int axis) {
    if (note == NULL || fault->code == NULL) {
        return;
    }
    bool is_first = note->fault.code == NULL || axis < note->axis ||
                    (axis == note->axis && fault->span.begin < note->fault.span.begin);
    if (is_first) {
        note->fault = *fault;
        note->axis = axis;
    }
}

static void eval_functions(const FrDeformation *deformation, double amount, const double at[3],
                           double out[3], FrDeformNote *note) {
    static const FrVars nothing = {0};
    const double values[4] = {at[0], at[1], at[2], amount};
    for (int axis = 0; axis < 3; axis++) {
        FrExprFault fault = {0};
        out[axis] = deformation->map[axis] == NULL
                        ? at[axis]
                        : fr_expr_eval_with(deformation->map[axis], &nothing, values, &fault);
        note_fault(note, &fault, axis);
    }
}

static void eval_local(const FrDeformation *deformation, double amount, const double at[3],
                       double out[3], double jacobian[3][3], FrDeformNote *note) {
    if (deformation->kind == FR_DEFORM_LATTICE) {
        fr_lattice_eval(&deformation->lattice, at, out, jacobian);
        return;
    }
    eval_functions(deformation, amount, at, out, note);
    for (int c = 0; c < 3; c++) {
        double step = DERIVATIVE_STEP * (1 + fabs(at[c]));
        double below[3] = {at[0], at[1], at[2]}, above[3] = {at[0], at[1], at[2]};
        below[c] -= step;
        above[c] += step;
        double from[3], to[3];
        eval_functions(deformation, amount, below, from, NULL);
        eval_functions(deformation, amount, above, to, NULL);
        for (int r = 0; r < 3; r++) {
            jacobian[r][c] = (to[r] - from[r]) / (above[c] - below[c]);
        }
    }
}

void fr_deform_map(const FrPlant *plant, const FrDeformer *scope, const FrFooting *stand,
                   FrFlow *flow, FrDeformNote *note) {
    const FrDeformation *deformation =
        &g_array_index(plant->deformations, FrDeformation, scope->deformation);
    if (deformation->kind == FR_DEFORM_NOTHING || scope->strength == 0) {
        return;
    }
    double scale = (double)scope->scale, strength = (double)scope->strength;
    double local[3], moved[3], jacobian[3][3];
    for (int c = 0; c < 3; c++) {
        local[c] = 0;
        for (int r = 0; r < 3; r++) {
            local[c] += stand->axes[r][c] * (flow->at[r] - stand->at[r]) / scale;
        }
    }
    eval_local(deformation, (double)scope->amount, local, moved, jacobian, note);
    double forth[3][3], back[3][3];
    for (int r = 0; r < 3; r++) {
        moved[r] = bounded(strength * (moved[r] - local[r]));
        for (int c = 0; c < 3; c++) {
            double identity = r == c;
            jacobian[r][c] = bounded(identity + strength * (jacobian[r][c] - identity));
            forth[r][c] = stand->axes[r][c];
            back[r][c] = stand->axes[c][r];
        }
    }
    for (int r = 0; r < 3; r++) {
        double by = forth[r][0] * moved[0] + forth[r][1] * moved[1] + forth[r][2] * moved[2];
        flow->at[r] = bounded(flow->at[r] + scale * by);
    }
    // A · J · Aᵀ acts on what the scopes before have made of space.
    fr_deform_product((const double(*)[3])jacobian, (const double(*)[3])back, jacobian);
    fr_deform_product((const double(*)[3])forth, (const double(*)[3])jacobian, jacobian);
    fr_deform_product((const double(*)[3])jacobian, (const double(*)[3])flow->turn, flow->turn);
}
