/// @file lanes.h
/// The same arithmetic on eight unrelated things at once, one in each lane of a vector.
///
/// A chain of joints waits for the joint before; eight chains walked abreast fill the processor.
/// What a lane computes does not depend on the other lanes, so results never depend on which things
/// were walked together, nor on the width of the processor's registers: these are vector extensions
/// of the compiler, which makes two or four operations of one where registers are narrow. A loop
/// over lanes is compiled for both by FR_LANES_CLONES before its function.
#pragma once

#include "frond/vector.h"

#include <math.h>
#include <string.h>

enum { FR_LANES = 8 };

// clang does not let a clone for AVX call functions that are not, even those it inlines. gcc's
// thread sanitizer is not there yet when clones are chosen, and would be called.
#if defined __clang__ || defined __SANITIZE_THREAD__
#define FR_LANES_CLONES
#else
#define FR_LANES_CLONES __attribute__((target_clones("avx2", "default")))
#endif

typedef float FrLanes __attribute__((vector_size(32)));
typedef int32_t FrLaneMask __attribute__((vector_size(32))); ///< −1 where true, 0 where not
typedef uint32_t FrLaneBits __attribute__((vector_size(32)));
typedef uint64_t FrLaneWords __attribute__((vector_size(32))); ///< two lanes a word

/// Vectors, and rotations as fr_frame_step() takes them, one a lane.
typedef struct FrLanes3 {
    FrLanes x, y, z;
} FrLanes3;
typedef struct FrLanes4 {
    FrLanes x, y, z, w;
} FrLanes4;

static inline FrLanes fr_lanes_select(FrLaneMask mask, FrLanes yes, FrLanes no) {
    return (FrLanes)((mask & (FrLaneMask)yes) | (~mask & (FrLaneMask)no));
}

static inline bool fr_lanes_any(FrLaneMask mask) {
    FrLaneWords words = (FrLaneWords)mask;
    return ((words[0] | words[1]) | (words[2] | words[3])) != 0;
}

static inline FrLanes fr_lanes_sqrt(FrLanes v) {
    for (int k = 0; k < FR_LANES; k++) {
        v[k] = sqrtf(v[k]);
    }
    return v;
}

static inline FrLanes3 fr_lanes3_add(FrLanes3 a, FrLanes3 b) {
    return (FrLanes3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline FrLanes3 fr_lanes3_scale(FrLanes3 a, FrLanes scale) {
    return (FrLanes3){a.x * scale, a.y * scale, a.z * scale};
}

static inline FrLanes fr_lanes3_dot(FrLanes3 a, FrLanes3 b) {
    return a.x * b.x + (a.y * b.y + a.z * b.z);
}

static inline FrLanes3 fr_lanes3_cross(FrLanes3 a, FrLanes3 b) {
    return (FrLanes3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Four rows of four numbers, transposed.
typedef float FrRow __attribute__((vector_size(16)));

static inline void fr_rows_transpose(FrRow row[4]) {
    FrRow a = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
    FrRow b = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
    FrRow c = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
    FrRow d = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
    row[0] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
    row[1] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
    row[2] = __builtin_shufflevector(c, d, 0, 1, 4, 5);
    row[3] = __builtin_shufflevector(c, d, 2, 3, 6, 7);
}

static inline FrLanes fr_rows_joined(FrRow low, FrRow high) {
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Reads rotations of a column.
static inline FrLanes4 fr_lanes4_gather(const versors *column, const uint32_t index[FR_LANES]) {
    FrRow rows[FR_LANES];
    for (int k = 0; k < FR_LANES; k++) {
        memcpy(&rows[k], &column[index[k]], sizeof rows[k]);
    }
    fr_rows_transpose(rows);
    fr_rows_transpose(rows + 4);
    return (FrLanes4){fr_rows_joined(rows[0], rows[4]), fr_rows_joined(rows[1], rows[5]),
                      fr_rows_joined(rows[2], rows[6]), fr_rows_joined(rows[3], rows[7])};
}

/// A row for every lane.
static inline void fr_lanes4_rows(FrLanes4 lanes, FrRow rows[FR_LANES]) {
    const FrLanes *column[4] = {&lanes.x, &lanes.y, &lanes.z, &lanes.w};
    for (int k = 0; k < 4; k++) {
        rows[k] = __builtin_shufflevector(*column[k], *column[k], 0, 1, 2, 3);
        rows[k + 4] = __builtin_shufflevector(*column[k], *column[k], 4, 5, 6, 7);
    }
    fr_rows_transpose(rows);
    fr_rows_transpose(rows + 4);
}

/// Writes the lanes so marked to a column.
static inline void fr_lanes4_scatter(versors *column, const uint32_t index[FR_LANES],
                                     FrLanes4 lanes, const bool is_written[FR_LANES]) {
    FrRow rows[FR_LANES];
    fr_lanes4_rows(lanes, rows);
    for (int k = 0; k < FR_LANES; k++) {
        if (is_written[k]) {
            memcpy(&column[index[k]], &rows[k], sizeof rows[k]);
        }
    }
}

/// Reads numbers, or points, of a column.
static inline FrLanes fr_lanes_gather(const float *column, const uint32_t index[FR_LANES]) {
    FrLanes lanes;
    for (int k = 0; k < FR_LANES; k++) {
        lanes[k] = column[index[k]];
    }
    return lanes;
}

static inline FrLanes3 fr_lanes3_gather(const vec3s *column, const uint32_t index[FR_LANES]) {
    FrLanes3 lanes;
    for (int k = 0; k < FR_LANES; k++) {
        lanes.x[k] = column[index[k]].x;
        lanes.y[k] = column[index[k]].y;
        lanes.z[k] = column[index[k]].z;
    }
    return lanes;
}

static inline void fr_lanes3_scatter(vec3s *column, const uint32_t index[FR_LANES], FrLanes3 lanes,
                                     const bool is_written[FR_LANES]) {
    FrRow rows[FR_LANES];
    fr_lanes4_rows((FrLanes4){lanes.x, lanes.y, lanes.z, lanes.z}, rows);
    for (int k = 0; k < FR_LANES; k++) {
        if (is_written[k]) {
            memcpy(&column[index[k]], &rows[k], sizeof *column);
        }
    }
}

/// fr_frame_step() in every lane.
static inline FrLanes4 fr_lanes_frame_step(FrLanes4 p, FrLanes4 l) {
    FrLanes x = (p.w * l.x + p.x * l.w) + (p.y * l.z - p.z * l.y);
    FrLanes y = (p.w * l.y + p.y * l.w) + (p.z * l.x - p.x * l.z);
    FrLanes z = (p.w * l.z + p.z * l.w) + (p.x * l.y - p.y * l.x);
    FrLanes w = (p.w * l.w - p.x * l.x) - (p.y * l.y + p.z * l.z);
    FrLanes scale = 1.5f - 0.5f * ((x * x + y * y) + (z * z + w * w));
    return (FrLanes4){x * scale, y * scale, z * scale, w * scale};
}

/// fr_frame_heading(), fr_frame_left() and fr_frame_up() in every lane.
static inline FrLanes3 fr_lanes_heading(FrLanes4 q) {
    return (FrLanes3){2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
                      1 - 2 * (q.x * q.x + q.y * q.y)};
}

static inline FrLanes3 fr_lanes_left(FrLanes4 q) {
    return (FrLanes3){1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z),
                      2 * (q.x * q.z - q.w * q.y)};
}

static inline FrLanes3 fr_lanes_up(FrLanes4 q) {
    return (FrLanes3){2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z),
                      2 * (q.y * q.z + q.w * q.x)};
}

/// atan2(y, x) / y for y > 0, finite also where y is 0 and x is not; within 3e-7 of it. The series
/// for [0, 1] is Hastings' (Approximations for Digital Computers, 1955), as Abramowitz and Stegun
/// print it (4.4.49).
static inline FrLanes fr_lanes_angle_over(FrLanes y, FrLanes x) {
    FrLanes across = fr_lanes_select(x < 0, -x, x);
    FrLaneMask is_steep = y > across;
    FrLanes over = 1 / fr_lanes_select(is_steep, y, across);
    FrLanes t = fr_lanes_select(is_steep, across, y) * over;
    FrLanes s = t * t;
    FrLanes series = 0.0028662257f * s - 0.0161657367f;
    series = series * s + 0.0429096138f;
    series = series * s - 0.0752896400f;
    series = series * s + 0.1065626393f;
    series = series * s - 0.1420889944f;
    series = series * s + 0.1999355085f;
    series = series * s - 0.3333314528f;
    series = 1 + s * series;
    FrLanes result = over * fr_lanes_select(is_steep, 1.57079633f - t * series, series);
    FrLaneMask is_backward = x < 0;
    if (fr_lanes_any(is_backward)) {
        FrLanes half_turn = 3.14159265f / fr_lanes_select(y > 0, y, over);
        result = fr_lanes_select(is_backward, half_turn - result, result);
    }
    return result;
}
