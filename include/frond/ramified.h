/// @file ramified.h
/// Plants from the combinatorics of their branches: random and perfect binary trees, measured
/// matrices of ramification, and strands.
///
/// Viennot, Eyrolles, Janey, Arquès. Combinatorial analysis of ramified patterns and computer
/// imagery of trees. SIGGRAPH 1989. Holton. Strands, gravity and botanical tree imagery. Computer
/// Graphics Forum 13(1), 1994.
///
///     FrRamified *ramified = fr_ramified_new(&params);
///     fr_ramified_load(ramified, text, span, &context);          the matrix, if `by` wants one
///     fr_ramified_grow(ramified, "tree", seed, &context, &plant);
#pragma once

#include "frond/param.h"
#include "frond/plant.h"

/// Settings. X rows as in param.h.
#define FR_RAMIFIED_PARAMS(X)                                                                      \
    X(CHOICE, by, "random", 0, 0, "", "random perfect matrix strands",                             \
      "random binary trees, perfect ones, the matrix of ramification in the text, or strands")     \
    X(INTEGER, order, "5", 1, 30, "", "",                                                          \
      "Strahler order of the stem; a matrix has a row for each order from 2 on")                   \
    X(INTEGER, strands, "40", 1, 100000000, "", "", "by strands: of the stem, one for each tip")   \
    X(REAL, split, "0.25", 0, 0.5, "", "",                                                         \
      "by strands: the smaller branch of a fork has this part of them at least, half at most")     \
    X(REAL, length, "0.5", 0.000001, 1000, "m", "", "of the first internode")                      \
    X(REAL, length_ratio, "0.85", 0.01, 2, "", "",                                                 \
      "lengths of one order over those of the next higher one, of half the strands over all")      \
    X(REAL, length_variance, "0.15", 0, 1, "", "", "part by which lengths differ by chance")       \
    X(REAL, angle, "60", 0, 179, "deg", "", "between the two branches of a fork")                  \
    X(REAL, deviation, "1", 0, 10, "", "",                                                         \
      "sines of both angles go by this power of the weights: the heavier branch deviates less")    \
    X(REAL, roll, "100", -360, 360, "deg", "", "turn of a fork's plane from that of the last one") \
    X(REAL, roll_variance, "30", 0, 180, "deg", "", "by which that differs by chance")             \
    X(CHOICE, weights, "strahler", 0, 0, "", "weibel strahler strands pipe",                       \
      "radii: by the order of branches, by the tips they bear, or by the pipe model")              \
    X(REAL, thinnest, "0.004", 0.000001, 100, "m", "", "radius of the tips")                       \
    X(REAL, ratio, "1.6", 1, 100, "", "",                                                          \
      "weights weibel and strahler: how much thicker an order is than the next thinner one")       \
    X(REAL, pipe_exponent, "2", 1, 4, "", "", "weights pipe: powers of radii that add up")         \
    X(TEXT, material, "", 0, 0, "", "", "id of the material of branches")                          \
    X(INTEGER, leaves, "0", 0, 100, "", "", "at each tip, in a spiral")                            \
    X(REAL, leaf_length, "0.12", 0.0001, 100, "m", "", "of their blades")                          \
    X(REAL, leaf_width, "0.05", 0.0001, 100, "m", "", "of their blades")                           \
    X(TEXT, leaf_material, "", 0, 0, "", "", "id of the material of leaves")

enum { FR_RAMIFIED_RANDOM, FR_RAMIFIED_PERFECT, FR_RAMIFIED_MATRIX, FR_RAMIFIED_STRANDS };
enum { FR_RAMIFIED_ORDERS = 30 };

typedef struct FrRamifiedParams {
    FR_RAMIFIED_PARAMS(FR_PARAM_FIELD)
} FrRamifiedParams;

FR_API const FrParamTable *fr_ramified_table(void);

typedef struct FrRamified FrRamified;

/// Copies the parameters.
FR_API FrRamified *fr_ramified_new(const FrRamifiedParams *params);
FR_API void fr_ramified_free(FrRamified *ramified);
/// Materials of branches and leaves; NULL: none. Takes references.
FR_API void fr_ramified_set_materials(FrRamified *ramified, FrMaterial *bark, FrMaterial *leaf);
/// Reads the matrix from `text` (NULL where the settings want none) and checks that it goes with
/// the settings. `span` is where all is described. Once.
FR_API FR_MUST_USE FrStatus fr_ramified_load(FrRamified *ramified, const FrSource *text,
                                             FrSpan span, const FrContext *context);
/// The probabilities of the forks of order k, 2 to FR_RAMIFIED_ORDERS: of (k, 1) … (k, k − 1), then
/// of (k − 1, k − 1); k of them.
FR_API const double *fr_ramified_row(const FrRamified *ramified, uint32_t order);
/// A plant: the heavier branch of a fork goes on with the axis, the other begins one. Internodes
/// are counted before they are made.
FR_API FR_MUST_USE FrStatus fr_ramified_grow(const FrRamified *ramified, const char *name,
                                             uint64_t seed, const FrContext *context,
                                             FrPlant **plant);
