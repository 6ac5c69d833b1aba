// A curve's memory: shared by curve.c, which evaluates, and curve_builtin.c, which names some.
#pragma once

#include "frond/curve.h"

/// A point with what evaluation needs of its segment: the slope at the point, and the area under
/// the curve up to it.
typedef struct FrCurveKnot {
    double x, y, slope, area;
} FrCurveKnot;

struct FrCurve {
    gint references;
    FrCurveKind kind;
    size_t count;
    FrCurveKnot knots[];
};
