/// @file along.h
/// Parameters of a stem that differ along its own length: `self` curves, expressions of `s`.
#pragma once

#include "pgraph/stem.h"

/// The parameters of a stem that may.
typedef enum FrAlong {
    FR_ALONG_RADIUS,
    FR_ALONG_FLATNESS,
    FR_ALONG_CURVATURE,
    FR_ALONG_TWIST,
    FR_ALONG_GNARL,
    FR_ALONG_GRAVITROPISM,
    FR_ALONG_PHOTOTROPISM,
    FR_ALONG_PLAGIOTROPISM,
    FR_ALONG_COUNT
} FrAlong;

/// Bits 1 << FrAlong of those that do.
uint32_t fr_along_find(const FrStemParams *params);
static inline bool fr_is_along(const FrStem *stem, FrAlong which) {
    return (stem->prepared->along >> which & 1) != 0;
}
/// The value at `at`, 0 at the base to 1 at the tip, in SI units. It must be one that differs.
double fr_along_at(const FrStem *stem, FrAlong which, double at);
/// Its mean between two places.
double fr_along_mean(const FrStem *stem, FrAlong which, double from, double to);
/// The mean of its size over the whole stem.
double fr_along_size(const FrStem *stem, FrAlong which);
