/// @file bsdf.h
/// How a surface scatters light: matt reflection, matt transmission, a thin glossy coat, and, in
/// one direction only, as a mirror and as clear glass. Private to render.
#pragma once

#include "frond/vector.h"

typedef struct FrBsdf {
    vec3s normal;           ///< shading normal, on the side of the viewer
    vec3s side;             ///< geometric normal, on the side of the viewer
    vec3s reflectance;      ///< matt, at normal incidence below the coat
    vec3s transmittance;    ///< matt, to the other side; black if opaque
    vec3s mirror;           ///< part thrown back as by a mirror; black if none
    vec3s clear;            ///< part that goes straight through; black if none
    float coat;             ///< reflectance of the coat at normal incidence; 0: none
    float coat_width;       ///< GGX α of the coat
    float rough_a, rough_b; ///< Oren and Nayar's A and B; 1 and 0 are Lambert's
} FrBsdf;

/// A and B for facets whose slopes have a standard deviation of `sigma` radians.
void fr_bsdf_set_roughness(FrBsdf *bsdf, float sigma);
/// What light may do where it goes on in one direction only.
typedef enum FrStraight { FR_STRAIGHT_NO, FR_STRAIGHT_MIRROR, FR_STRAIGHT_CLEAR } FrStraight;

/// Decides between mirror, clear glass and all the rest, which the functions below are about, with
/// the random number `choice`; what is left of it is even in [0, 1) again. `factor` is what the
/// light has to be multiplied by for the decision.
FrStraight fr_bsdf_decide(const FrBsdf *bsdf, float *choice, vec3s *factor);
/// Value times the cosine of `in`. `out` and `in` are unit and point away from the surface.
vec3s fr_bsdf_eval(const FrBsdf *bsdf, vec3s out, vec3s in);
/// Probability density per steradian with which fr_bsdf_sample() gives `in`.
float fr_bsdf_density(const FrBsdf *bsdf, vec3s out, vec3s in);
/// A direction `in` and the factor eval / density; false if the light ends here.
bool fr_bsdf_sample(const FrBsdf *bsdf, vec3s out, float choice, float u, float v, vec3s *in,
                    vec3s *factor, float *density);
