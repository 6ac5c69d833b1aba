// Gradient noise. After: Perlin. Improving noise. ACM Transactions on Graphics 21 (3), 2002; the
// permutation table is replaced by a hash of the lattice point, so the noise never repeats.
#include "frond/noise.h"

#include <math.h>

// From here on doubles are whole numbers, and at lattice points the noise is 0.
#define LARGEST 0x1p51

static double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

static double blend(double t, double a, double b) {
    return a + t * (b - a);
}

static double clamp1(double value) {
    return value < -1 ? -1 : value > 1 ? 1 : value;
}

static FrKey corner(FrKey key, double lattice) {
    return fr_key_child(key, (uint64_t)(int64_t)lattice);
}

// Any slope in [−1, 1).
static double gradient1(FrKey key, double x) {
    return ((double)(key >> 11) * 0x1.0p-52 - 1) * x;
}

// Eight unit directions.
static double gradient2(FrKey key, double x, double y) {
    double a = key & 1 ? -x : x, b = key & 2 ? -y : y;
    return key & 4 ? (a + b) * 0.70710678118654752440 : key & 8 ? a : b;
}

// The midpoints of the twelve edges of a cube, four of them twice.
static double gradient3(FrKey key, double x, double y, double z) {
    unsigned hash = key & 15;
    double a = hash < 8 ? x : y;
    double b = hash < 4 ? y : hash == 12 || hash == 14 ? x : z;
    return (hash & 1 ? -a : a) + (hash & 2 ? -b : b);
}

double fr_noise1(FrKey key, double x) {
    if (!(fabs(x) < LARGEST)) {
        return 0;
    }
    double cell = floor(x), u = x - cell;
    return 2 *
           blend(fade(u), gradient1(corner(key, cell), u), gradient1(corner(key, cell + 1), u - 1));
}

// The cell between columns x0, x1 and rows y0, y1 of the lattice; u and v are the place in it.
static double cell2(FrKey key, const double columns[2], const double rows[2], double u, double v) {
    FrKey left = corner(key, columns[0]), right = corner(key, columns[1]);
    double lower = blend(fade(u), gradient2(corner(left, rows[0]), u, v),
                         gradient2(corner(right, rows[0]), u - 1, v));
    double upper = blend(fade(u), gradient2(corner(left, rows[1]), u, v - 1),
                         gradient2(corner(right, rows[1]), u - 1, v - 1));
    // Unit gradients reach √½ at the centre of a cell.
    return clamp1(1.41421356237309504880 * blend(fade(v), lower, upper));
}

double fr_noise2(FrKey key, double x, double y) {
    if (!(fabs(x) < LARGEST && fabs(y) < LARGEST)) {
        return 0;
    }
    double column = floor(x), row = floor(y);
    return cell2(key, (double[2]){column, column + 1}, (double[2]){row, row + 1}, x - column,
                 y - row);
}

static double wrap(double value, double period) {
    return value - period * floor(value / period);
}

double fr_noise2_tiled(FrKey key, double x, double y, int period) {
    FR_ASSERT(period >= 1);
    if (!(fabs(x) < LARGEST && fabs(y) < LARGEST)) {
        return 0;
    }
    double column = floor(x), row = floor(y);
    double columns[2] = {wrap(column, period), wrap(column + 1, period)};
    double rows[2] = {wrap(row, period), wrap(row + 1, period)};
    return cell2(key, columns, rows, x - column, y - row);
}

static double layer3(FrKey left, FrKey right, double row, double plane, const double p[3]) {
    return blend(fade(p[0]), gradient3(corner(corner(left, row), plane), p[0], p[1], p[2]),
                 gradient3(corner(corner(right, row), plane), p[0] - 1, p[1], p[2]));
}

double fr_noise3(FrKey key, double x, double y, double z) {
    if (!(fabs(x) < LARGEST && fabs(y) < LARGEST && fabs(z) < LARGEST)) {
        return 0;
    }
    double column = floor(x), row = floor(y), plane = floor(z);
    double u = x - column, v = y - row, w = z - plane;
    FrKey left = corner(key, column), right = corner(key, column + 1);
    double near = blend(fade(v), layer3(left, right, row, plane, (double[3]){u, v, w}),
                        layer3(left, right, row + 1, plane, (double[3]){u, v - 1, w}));
    double far = blend(fade(v), layer3(left, right, row, plane + 1, (double[3]){u, v, w - 1}),
                       layer3(left, right, row + 1, plane + 1, (double[3]){u, v - 1, w - 1}));
    // Edge gradients reach a little over 1.
    return clamp1(blend(fade(w), near, far) * 0.9649);
}
