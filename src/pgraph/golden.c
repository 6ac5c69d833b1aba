#include "pgraph/golden.h"

#include <math.h>

// Nearest neighbours are never nearer than this times √(area of a child); found by trying seven
// sections of twenty-one sizes each.
#define NEAREST 0.8706

double fr_golden_polar(double opening, double closing, double before) {
    double height = cos(opening) - before * (cos(opening) - cos(closing));
    return acos(height < -1 ? -1 : height > 1 ? 1 : height);
}

double fr_golden_radius(double n, double area, double section) {
    double zone = 2 * 3.14159265358979323846 * section;
    return zone > 1e-12 ? sqrt(n * area / zone) : 0;
}

double fr_golden_touching_radius(double n, double radius, double section) {
    double side = 2 * radius / NEAREST;
    return fr_golden_radius(n, side * side, section);
}
