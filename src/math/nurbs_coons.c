// Patches from their four sides. Coons. Surfaces for computer-aided design of space forms. MIT,
// 1967.
//
// S = L + K − B: the surfaces ruled between two opposite sides and between the other two, less the
// bilinear one of the corners. A linear function has the means of `degree` knots in a row
// (Greville) as its control values, whatever the knots: so all three are nets of the same size, and
// no degree needs to be raised.
#include "frond/nurbs.h"

#include <string.h>

double fr_nurbs_greville(const double *knots, uint32_t degree, uint32_t index) {
    double sum = 0.0;
    for (uint32_t k = 1; k <= degree; k++) {
        sum += knots[index + k];
    }
    return sum / degree;
}

void fr_nurbs_coons(const FrNurbsCurve *bottom, const FrNurbsCurve *top, const FrNurbsCurve *left,
                    const FrNurbsCurve *right, double (*points)[4]) {
    uint32_t across = bottom->count, along = left->count;
    const double(*b)[4] = (const double(*)[4])bottom->points,
          (*t)[4] = (const double(*)[4])top->points;
    const double(*l)[4] = (const double(*)[4])left->points,
          (*r)[4] = (const double(*)[4])right->points;
    for (uint32_t j = 0; j < along; j++) {
        double v = fr_nurbs_greville(left->knots, left->degree, j);
        for (uint32_t i = 0; i < across; i++) {
            double u = fr_nurbs_greville(bottom->knots, bottom->degree, i);
            double *point = points[(size_t)j * across + i];
            for (int k = 0; k < 3; k++) {
                double ruled = (1.0 - v) * b[i][k] + v * t[i][k];
                double other = (1.0 - u) * l[j][k] + u * r[j][k];
                double low = (1.0 - u) * b[0][k] + u * b[across - 1][k];
                double high = (1.0 - u) * t[0][k] + u * t[across - 1][k];
                point[k] = ruled + other - ((1.0 - v) * low + v * high);
            }
            point[3] = 1.0;
        }
    }
}
