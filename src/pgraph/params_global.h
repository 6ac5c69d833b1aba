/// @file params_global.h
/// The parameters of global components: what deforms, lights, weighs and draws all that follows.
/// Included by params.h.
#pragma once

#include "frond/param.h"

/// What FFD and Hyperpatch share.
#define FR_SCOPE_PARAMS(X)                                                                         \
    X(CHOICE, moves, "triangles", 0, 0, "", "triangles skeleton",                                  \
      "every vertex of what follows, or its stems only: then leaves keep their form")              \
    X(SWITCH, preceding, "yes", 0, 1, "", "",                                                      \
      "deformations before it act too; if not, they only carry what follows along")                \
    X(NUMBER, strength, "1", -10, 10, "", "", "0 nothing is moved, 1 all the way")                 \
    X(REAL, step, "0.1", 0.0001, 1000, "m", "",                                                    \
      "stems in it get an internode at least every so far, to bend at")                            \
    X(VECTOR, box_from, "-0.5, -0.5, 0", -10000, 10000, "m", "", "one corner of the lattice")      \
    X(VECTOR, box_to, "0.5, 0.5, 1", -10000, 10000, "m", "", "the corner opposite")                \
    X(INTEGER, degree_x, "2", 1, 4, "", "", "degree of the lattice along x: one point more")       \
    X(INTEGER, degree_y, "2", 1, 4, "", "", "degree along y")                                      \
    X(INTEGER, degree_z, "2", 1, 4, "", "", "degree along z")

#define FR_FFD_PARAMS(X)                                                                           \
    X(CHOICE, form, "exact", 0, 0, "", "exact lattice",                                            \
      "the functions move every point, or the control points of the lattice (amount 1)")           \
    X(FORMULA, to_x, "x", 0, 0, "", "x y z amount", "where the point x, y, z goes, in m")          \
    X(FORMULA, to_y, "y", 0, 0, "", "x y z amount", "the same along y")                            \
    X(FORMULA, to_z, "z", 0, 0, "", "x y z amount", "the same along z")                            \
    X(NUMBER, amount, "1", -1000000, 1000000, "", "", "a number for the functions")                \
    X(CHOICE, preset, "none", 0, 0, "",                                                            \
      "none bend twist taper bulge flare shear stretch wave spiral spherify ruffle curve",         \
      "functions ready made, of that amount, instead of to-x, to-y, to-z")                         \
    X(TEXT, path, "", 0, 0, "", "",                                                                \
      "points x,y,z x,y,z for preset=curve: the line that its z axis comes to run along, in m")

#define FR_HYPERPATCH_PARAMS(X)                                                                    \
    X(TEXT, points, "", 0, 0, "", "",                                                              \
      "control points and how far each is moved, in m: i,j,k:x,y,z i,j,k:x,y,z")

#define FR_WORLD_PARAMS(X)                                                                         \
    X(FORMULA, gravity_x, "0", 0, 0, "", "x y z", "pull of gravity at the point x, y, z")          \
    X(FORMULA, gravity_y, "0", 0, 0, "", "x y z", "the same along y")                              \
    X(FORMULA, gravity_z, "-1", 0, 0, "", "x y z", "the same along z")                             \
    X(FORMULA, light_x, "0", 0, 0, "", "x y z", "towards the light at the point x, y, z")          \
    X(FORMULA, light_y, "0", 0, 0, "", "x y z", "the same along y")                                \
    X(FORMULA, light_z, "1", 0, 0, "", "x y z", "the same along z")                                \
    X(SWITCH, sampled, "no", 0, 1, "", "",                                                         \
      "the light is that of a scene with a `<light>`, where the plant stands")                     \
    X(REAL, step, "0.1", 0.0001, 1000, "m", "", "stems get an internode at least every so far")    \
    X(SWITCH, sun, "no", 0, 1, "", "",                                                             \
      "the light is a sun at sun-azimuth and sun-elevation, whatever light-x, -y, -z say")         \
    X(NUMBER, sun_azimuth, "180", -36000, 36000, "deg", "",                                        \
      "where the sun stands, from the y axis towards the x axis: north, east, south, west")        \
    X(NUMBER, sun_elevation, "45", -90, 90, "deg", "", "how high the sun stands")

#define FR_FORCE_PARAMS(X)                                                                         \
    X(CHOICE, kind, "line", 0, 0, "", "direction point line plane vortex curve box cylinder mesh", \
      "what stems are drawn by; line and vortex along its z axis, a plane across it")              \
    X(CHOICE, action, "follow", 0, 0, "", "follow pull align avoid",                               \
      "grow along it at its radius, only to its radius, only in its direction, or away from it")   \
    X(NUMBER, strength, "10", -10000, 10000, "1/m", "", "how fast stems turn; negative: away")     \
    X(VECTOR, direction, "0, 0, 1", -1000, 1000, "", "", "for kind=direction")                     \
    X(TEXT, path, "", 0, 0, "", "", "points x,y,z x,y,z for kind=curve, in m")                     \
    X(VECTOR, place, "0, 0, 0", -10000, 10000, "m", "", "where it is, seen from where it stands")  \
    X(VECTOR, size, "1, 1, 1", 0, 10000, "m", "",                                                  \
      "extent of a box or cylinder, which stands on its place along its z axis")                   \
    X(TEXT, file, "", 0, 0, "", "", "file of triangles or surfaces for kind=mesh")                 \
    X(SWITCH, inverted, "no", 0, 1, "", "", "its inside is free, all else is what it is")          \
    X(NUMBER, radius, "0", 0, 10000, "m", "", "distance that stems come to and keep")              \
    X(REAL, reach, "0.2", 0.00001, 10000, "m", "", "over what distance they come to it")           \
    X(NUMBER, pitch, "0", -90, 90, "deg", "", "climb of a vortex")                                 \
    X(CHOICE, falloff, "none", 0, 0, "", "none linear inverse gauss", "weaker with distance")      \
    X(REAL, range, "1", 0.00001, 10000, "m", "", "distance of the falloff")                        \
    X(REAL, order_factor, "1", 0, 100, "", "",                                                     \
      "how much stronger it draws branches of each further order")                                 \
    X(CHOICE, solid, "no", 0, 0, "", "no yes stop prune",                                          \
      "stems pass, slide along its surface, end at it, or are cut off there")                      \
    X(REAL, step, "0.05", 0.0001, 1000, "m", "", "stems get an internode at least every so far")   \
    X(CHOICE, apply_to, "both", 0, 0, "", "both self children",                                    \
      "all stems that follow; those of the order that stands on it; what branches from them")

typedef struct FrScopeParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_SCOPE_PARAMS(FR_PARAM_FIELD)
} FrScopeParams;

typedef struct FrFfdParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_SCOPE_PARAMS(FR_PARAM_FIELD)
    FR_FFD_PARAMS(FR_PARAM_FIELD)
} FrFfdParams;

typedef struct FrHyperpatchParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_SCOPE_PARAMS(FR_PARAM_FIELD)
    FR_HYPERPATCH_PARAMS(FR_PARAM_FIELD)
} FrHyperpatchParams;

typedef struct FrWorldParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_WORLD_PARAMS(FR_PARAM_FIELD)
} FrWorldParams;

typedef struct FrForceParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_FORCE_PARAMS(FR_PARAM_FIELD)
} FrForceParams;

#define FR_SCOPE_ID(kind, field, ...) FR_SCOPE_##field,
#define FR_FFD_ID(kind, field, ...) FR_FFD_##field,
#define FR_WORLD_ID(kind, field, ...) FR_WORLD_##field,
#define FR_FORCE_ID(kind, field, ...) FR_FORCE_##field,
enum { FR_SCOPE_BEFORE = FR_BASIC_COUNT - 1, FR_SCOPE_PARAMS(FR_SCOPE_ID) FR_SCOPE_COUNT };
enum { FR_FFD_BEFORE = FR_SCOPE_COUNT - 1, FR_FFD_PARAMS(FR_FFD_ID) FR_FFD_COUNT };
enum { FR_WORLD_BEFORE = FR_BASIC_COUNT - 1, FR_WORLD_PARAMS(FR_WORLD_ID) FR_WORLD_COUNT };
enum { FR_FORCE_BEFORE = FR_BASIC_COUNT - 1, FR_FORCE_PARAMS(FR_FORCE_ID) FR_FORCE_COUNT };
#undef FR_SCOPE_ID
#undef FR_FFD_ID
#undef FR_WORLD_ID
#undef FR_FORCE_ID

enum { FR_MOVES_TRIANGLES, FR_MOVES_SKELETON };
enum { FR_FFD_EXACT, FR_FFD_BY_LATTICE };
enum { FR_PRESET_NONE, FR_PRESET_CURVE = 12 };
enum {
    FR_FORCE_ALONG_DIRECTION,
    FR_FORCE_TO_POINT,
    FR_FORCE_TO_LINE,
    FR_FORCE_TO_PLANE,
    FR_FORCE_IN_VORTEX,
    FR_FORCE_TO_CURVE,
    FR_FORCE_TO_BOX,
    FR_FORCE_TO_CYLINDER,
    FR_FORCE_TO_MESH,
};
enum { FR_ACTION_FOLLOW, FR_ACTION_PULL, FR_ACTION_ALIGN, FR_ACTION_AVOID };
enum { FR_APPLIES_TO_BOTH, FR_APPLIES_TO_SELF };
enum { FR_SOLID_NOT, FR_SOLID_SLIDE, FR_SOLID_STOP, FR_SOLID_PRUNE };
enum { FR_FALLOFF_NONE, FR_FALLOFF_LINEAR, FR_FALLOFF_INVERSE, FR_FALLOFF_GAUSS };
