/// @file colour.h
/// Small arithmetic of linear sRGB colours. Private to render.
#pragma once

#include "frond/vector.h"

#include <cglm/struct.h>

#define FR_PI_F 3.14159265358979f

/// Of linear sRGB (ITU-R BT.709).
static inline float fr_luminance(vec3s colour) {
    return 0.2126f * colour.r + 0.7152f * colour.g + 0.0722f * colour.b;
}

static inline bool fr_is_black(vec3s colour) {
    return !(colour.r > 0.0f || colour.g > 0.0f || colour.b > 0.0f);
}

/// Decodes sRGB (IEC 61966-2-1).
static inline float fr_srgb_decode(float value) {
    return value <= 0.04045f ? value / 12.92f : powf((value + 0.055f) / 1.055f, 2.4f);
}

static inline vec3s fr_srgb_decode3(vec3s c) {
    return (vec3s){{fr_srgb_decode(c.r), fr_srgb_decode(c.g), fr_srgb_decode(c.b)}};
}

static inline vec3s fr_vec3_of(const float *values) {
    return (vec3s){{values[0], values[1], values[2]}};
}

/// Two unit vectors that make a right-handed frame with the unit vector `z` (Duff, Burgess,
/// Christensen, Hery, Kensler, Liani, Villemin 2017, Building an Orthonormal Basis, Revisited).
static inline void fr_basis(vec3s z, vec3s *x, vec3s *y) {
    float sign = copysignf(1.0f, z.z);
    float a = -1.0f / (sign + z.z);
    float b = z.x * z.y * a;
    *x = (vec3s){{1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x}};
    *y = (vec3s){{b, sign + z.y * z.y * a, -z.y}};
}

static inline vec3s fr_from_basis(vec3s x, vec3s y, vec3s z, vec3s v) {
    return (vec3s){{
        x.x * v.x + y.x * v.y + z.x * v.z,
        x.y * v.x + y.y * v.y + z.y * v.z,
        x.z * v.x + y.z * v.y + z.z * v.z,
    }};
}
