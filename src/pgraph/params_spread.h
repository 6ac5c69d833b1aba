/// @file params_spread.h
/// The parameters of what is turned on an axis, and of what spreads, scatters and chooses children.
/// Included by params.h.
#pragma once

#include "frond/param.h"

#define FR_REVO_PARAMS(X)                                                                          \
    X(POINTS, outline, "0.06,0 0.08,0.1 0.1,0.16 0.09,0.16 0.075,0.14 0,0.14", 0, 0, "", "",       \
      "points radius,height that are turned about the z axis, in m")                               \
    X(VECTOR, size, "1, 1, 1", 0, 10000, "", "", "factors of the outline along x, y, z")           \
    X(INTEGER, detail, "24", 3, 128, "", "", "segments around")                                    \
    X(SWITCH, smooth, "no", 0, 1, "", "", "a curve through the points, not straight lines")        \
    X(CHOICE, ends, "closed", 0, 0, "", "closed open",                                             \
      "whether discs close the outline's ends where they are not on the axis")

/// Multipliers by the golden section. From child_scale on, evaluated for each child.
#define FR_GOLDEN_PARAMS(X)                                                                        \
    X(NUMBER, number, "100", 0, 1000000, "", "", "children")                                       \
    X(CHOICE, radius_mode, "absolute", 0, 0, "", "absolute by-area touching",                      \
      "radius given, or such that children of child-area, or child-radius, just fit")              \
    X(NUMBER, radius, "0.1", 0, 10000, "m", "", "radius of the surface")                           \
    X(NUMBER, child_area, "0.0001", 0, 10000, "m2", "", "area of a child, for by-area")            \
    X(NUMBER, child_radius, "0.005", 0, 10000, "m", "", "radius of a child, for touching")         \
    X(NUMBER, divergence, "222.49223594996", -3600, 3600, "deg", "", "turn between children")      \
    X(CHOICE, handedness, "left", 0, 0, "", "left right", "sense of the turn; right mirrors")      \
    X(CHOICE, placement, "midpoint", 0, 0, "", "midpoint end",                                     \
      "child in the middle of its zone, or at its end")                                            \
    X(NUMBER, influence, "0", 0, 1, "", "", "how much larger children take more room")             \
    X(NUMBER, child_scale, "1", 0.000001, 1000, "", "", "size of each child")                      \
    X(NUMBER, tilt, "0", -360, 360, "deg", "", "turn of each away from the axis")                  \
    X(NUMBER, roll, "0", -36000, 36000, "deg", "", "turn of each about itself")                    \
    X(NUMBER, push, "0", -10000, 10000, "m", "", "how far each stands off the surface")

#define FR_PHIBALL_PARAMS(X)                                                                       \
    X(NUMBER, opening, "0", 0, 180, "deg", "", "polar angle where the section begins")             \
    X(NUMBER, closing, "180", 0, 180, "deg", "", "polar angle where the section ends")             \
    X(CHOICE, anchor, "centre", 0, 0, "", "centre pole", "what sits where it is attached")

#define FR_PHYLLOTAXIS_PARAMS(X)                                                                   \
    X(CHOICE, form, "sphere", 0, 0, "", "sphere cone cylinder disc",                               \
      "surface of radius 1 that is then multiplied by radius; from its top down")                  \
    X(POINTS, outline, "", 0, 0, "", "",                                                           \
      "own surface: points radius,height turned about the z axis; instead of form")                \
    X(SWITCH, smooth, "yes", 0, 1, "", "", "a curve through the points of the outline")            \
    X(REAL, stretch, "1", 0.001, 1000, "", "", "height of the surface over that of its form")      \
    X(REAL, start, "0", 0, 1, "", "", "where along the outline children begin")                    \
    X(REAL, end, "1", 0, 1, "", "", "where along the outline children end")

/// Hydra and Wreath. From child_scale on, evaluated for each child.
#define FR_RING_PARAMS(X)                                                                          \
    X(NUMBER, number, "6", 0, 10000, "", "", "children of a ring")                                 \
    X(NUMBER, radius, "0.1", 0, 10000, "m", "", "radius of the ring they stand on")                \
    X(NUMBER, opening, "0", -36000, 36000, "deg", "", "where around the ring they begin")          \
    X(NUMBER, closing, "360", -36000, 36000, "deg", "",                                            \
      "where around the ring they end; a whole turn from opening has no place twice")              \
    X(INTEGER, rings, "1", 1, 1000, "", "", "rings, one above the other")                          \
    X(NUMBER, ring_spacing, "0", -1000, 1000, "m", "", "height from ring to ring")                 \
    X(NUMBER, ring_turn, "0", -36000, 36000, "deg", "", "turn from ring to ring")                  \
    X(CURVE, ring_curve, "", 0, 0, "", "",                                                         \
      "multiplies the radius from the first ring to the last")                                     \
    X(NUMBER, child_scale, "1", 0.000001, 1000, "", "", "size of each child")                      \
    X(NUMBER, tilt, "0", -360, 360, "deg", "", "turn of each towards the axis")                    \
    X(NUMBER, roll, "0", -36000, 36000, "deg", "", "turn of each about itself")                    \
    X(NUMBER, push, "0", -10000, 10000, "m", "", "how much farther out each stands")               \
    X(CHOICE, orient, "radial", 0, 0, "", "radial tangential world",                               \
      "which way each faces: out from the axis, along the ring, or all the same way")

/// From child_scale on, evaluated for each child.
#define FR_SCATTER_PARAMS(X)                                                                       \
    X(CHOICE, surface, "disc", 0, 0, "", "disc square ring mesh", "what is strewn with children")  \
    X(TEXT, file, "", 0, 0, "", "", "file of triangles or surfaces for surface=mesh")              \
    X(TEXT, density_file, "", 0, 0, "", "", "picture on them; many children where it is light")    \
    X(REAL, slope_from, "0", 0, 180, "deg", "", "triangles less steep than this bear none")        \
    X(REAL, slope_to, "180", 0, 180, "deg", "", "triangles steeper than this bear none")           \
    X(REAL, height_from, "-10000", -10000, 10000, "m", "", "no children lower on the mesh")        \
    X(REAL, height_to, "10000", -10000, 10000, "m", "", "no children higher on the mesh")          \
    X(CHOICE, mode, "number", 0, 0, "", "number density", "what counts the children")              \
    X(NUMBER, number, "30", 0, 1000000, "", "", "children")                                        \
    X(NUMBER, density, "10", 0, 1000000, "1/m2", "", "children on a square metre")                 \
    X(NUMBER, radius, "1", 0, 10000, "m", "", "radius of disc and ring, half a square's side")     \
    X(NUMBER, inner_radius, "0.5", 0, 10000, "m", "", "radius of the hole of a ring")              \
    X(REAL, regularity, "1", 0, 1, "", "", "1 as far apart as chance allows, 0 anywhere")          \
    X(REAL, align, "1", 0, 1, "", "", "1 children stand off the surface, 0 upright")               \
    X(NUMBER, child_scale, "1", 0.000001, 1000, "", "", "size of each child")                      \
    X(NUMBER, azimuth, "0 ~ 180", -36000, 36000, "deg", "", "turn of each about its own axis")     \
    X(NUMBER, tilt, "0", -360, 360, "deg", "", "lean of each, to where azimuth turns it")          \
    X(NUMBER, push, "0", -10000, 10000, "m", "", "how far each stands off the surface")

#define FR_VARIATION_PARAMS(X)                                                                     \
    X(CHOICE, rule, "random", 0, 0, "", "random sequence choice",                                  \
      "by chance, by turns of the iteration number, or by the number choice")                      \
    X(TEXT, weights, "", 0, 0, "", "",                                                             \
      "how often each child comes, in the order of the links: 3 1 1; empty: all alike")            \
    X(NUMBER, choice, "0", 0, 1000000, "", "", "for rule=choice: number of the link, from 0")

typedef struct FrRevoParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_REVO_PARAMS(FR_PARAM_FIELD)
} FrRevoParams;

/// What Phiball and Phyllotaxis share, at the same places.
typedef struct FrGoldenParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_GOLDEN_PARAMS(FR_PARAM_FIELD)
} FrGoldenParams;

typedef struct FrPhiballParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_GOLDEN_PARAMS(FR_PARAM_FIELD)
    FR_PHIBALL_PARAMS(FR_PARAM_FIELD)
} FrPhiballParams;

typedef struct FrPhyllotaxisParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_GOLDEN_PARAMS(FR_PARAM_FIELD)
    FR_PHYLLOTAXIS_PARAMS(FR_PARAM_FIELD)
} FrPhyllotaxisParams;

typedef struct FrRingParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_RING_PARAMS(FR_PARAM_FIELD)
} FrRingParams;

typedef struct FrScatterParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_SCATTER_PARAMS(FR_PARAM_FIELD)
} FrScatterParams;

typedef struct FrVariationParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_VARIATION_PARAMS(FR_PARAM_FIELD)
} FrVariationParams;

#define FR_GOLDEN_ID(kind, field, ...) FR_GOLDEN_##field,
#define FR_PHIBALL_ID(kind, field, ...) FR_PHIBALL_##field,
#define FR_RING_ID(kind, field, ...) FR_RING_##field,
#define FR_SCATTER_ID(kind, field, ...) FR_SCATTER_##field,
#define FR_VARIATION_ID(kind, field, ...) FR_VARIATION_##field,
enum { FR_GOLDEN_BEFORE = FR_BASIC_COUNT - 1, FR_GOLDEN_PARAMS(FR_GOLDEN_ID) FR_GOLDEN_COUNT };
enum { FR_PHIBALL_BEFORE = FR_GOLDEN_COUNT - 1, FR_PHIBALL_PARAMS(FR_PHIBALL_ID) FR_PHIBALL_COUNT };
enum { FR_RING_BEFORE = FR_BASIC_COUNT - 1, FR_RING_PARAMS(FR_RING_ID) FR_RING_COUNT };
enum { FR_SCATTER_BEFORE = FR_BASIC_COUNT - 1, FR_SCATTER_PARAMS(FR_SCATTER_ID) FR_SCATTER_COUNT };
enum {
    FR_VARIATION_BEFORE = FR_BASIC_COUNT - 1,
    FR_VARIATION_PARAMS(FR_VARIATION_ID) FR_VARIATION_COUNT
};
#undef FR_GOLDEN_ID
#undef FR_PHIBALL_ID
#undef FR_RING_ID
#undef FR_SCATTER_ID
#undef FR_VARIATION_ID

// The values of the CHOICE rows, in their order.
enum { FR_ENDS_CLOSED, FR_ENDS_OPEN };
enum { FR_RADIUS_ABSOLUTE, FR_RADIUS_BY_AREA, FR_RADIUS_TOUCHING };
enum { FR_HAND_LEFT, FR_HAND_RIGHT };
enum { FR_PLACEMENT_MIDPOINT, FR_PLACEMENT_END };
enum { FR_ANCHOR_CENTRE, FR_ANCHOR_POLE };
enum { FR_ORIENT_RADIAL, FR_ORIENT_TANGENTIAL, FR_ORIENT_WORLD };
enum { FR_FORM_SPHERE, FR_FORM_CONE, FR_FORM_CYLINDER, FR_FORM_DISC };
enum { FR_SCATTER_DISC, FR_SCATTER_SQUARE, FR_SCATTER_RING, FR_SCATTER_MESH };
enum { FR_SCATTER_BY_NUMBER, FR_SCATTER_BY_DENSITY };
enum { FR_CHOOSE_AT_RANDOM, FR_CHOOSE_IN_TURN, FR_CHOOSE_BY_NUMBER };
