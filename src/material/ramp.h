// Colours over the season: the `ramp` of a material.
#pragma once

#include "frond/material.h"

enum { FR_MOST_STOPS = 16 };

typedef struct FrRamp {
    uint32_t count; ///< 0: no ramp
    double at[FR_MOST_STOPS];
    vec3s colour[FR_MOST_STOPS]; ///< sRGB
} FrRamp;

/// Reads "0 #7fa845, 0.8 #d08a1e". False and a diagnostic if the text is wrong.
bool fr_ramp_read(FrRamp *ramp, const char *text, FrSpan span, FrDiags *diags);
/// The colour at a place from 0 to 1.
vec3s fr_ramp_at(const FrRamp *ramp, double place);
