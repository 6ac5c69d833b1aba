/// @file placing.h
/// Many plants at once: in rows along a line, or strewn over an area.
#pragma once

#include "frond/surroundings.h"

/// What rows and strewn plants have in common.
#define FR_SPREAD_PARAMS(X)                                                                        \
    X(TEXT, plants, "", 0, 0, "", "",                                                              \
      "ids of the plants, each with its share if it is not 1: `oak 3, birch`")                     \
    X(INTEGER, seed, "1", 0, 4294967295.0, "", "", "seed of all that is left to chance")           \
    X(INTEGER, individuals, "4", 0, 100000, "", "",                                                \
      "how many different plants there are of each id; 0: every one is another")                   \
    X(NUMBER, turn, "0 ~ 180", -360000, 360000, "deg", "", "turned about the vertical")            \
    X(NUMBER, scale, "1", 0.001, 1000, "", "", "size")                                             \
    X(TEXT, except, "", 0, 0, "", "",                                                              \
      "numbers (from 0, as i in numbers) of plants that are left out; all others stay as they "    \
      "are")

/// A `<row>`: plants along a line. Its text is the points of the line.
#define FR_ROW_PARAMS(X)                                                                           \
    X(REAL, spacing, "4", 0.001, 1000000, "m", "", "from plant to plant along the line")           \
    X(CHOICE, line, "straight", 0, 0, "", "straight smooth",                                       \
      "from point to point, or a curve through them")                                              \
    X(INTEGER, rows, "1", 1, 1000000, "", "", "how many rows, side by side about the line")        \
    X(REAL, between, "4", 0, 1000000, "m", "", "from row to row")                                  \
    X(SWITCH, staggered, "no", 0, 1, "", "",                                                       \
      "every other row stands on the gaps of its neighbours")                                      \
    X(REAL, scatter, "0", 0, 1000000, "m", "", "how far a plant may stand from its point")

/// A `<strew>`: plants over an area, none near another (blue noise).
#define FR_STREW_PARAMS(X)                                                                         \
    X(INTEGER, number, "20", 0, 4294967295.0, "", "", "how many plants")                           \
    X(CHOICE, area, "square", 0, 0, "", "square disc", "a rectangle or an ellipse")                \
    X(VECTOR, at, "0, 0, 0", -1000000, 1000000, "m", "", "its middle")                             \
    X(REAL, width, "40", 0.001, 1000000, "m", "", "of the area along x")                           \
    X(REAL, depth, "40", 0.001, 1000000, "m", "", "of the area along y")                           \
    X(REAL, aside, "0", -360000, 360000, "deg", "", "the area turned about the vertical")          \
    X(REAL, spacing, "0", 0, 1000000, "m", "", "plants that would stand nearer are left out")      \
    X(INTEGER, evenness, "10", 1, 100, "", "",                                                     \
      "places tried for each plant; the one farthest from the others is taken, 1 is pure chance")  \
    X(TEXT, density, "", 0, 0, "", "",                                                             \
      "picture over the area, its top towards +y: the brighter, the denser; black has no plants")

/// A part of a mix.
typedef struct FrMixPart {
    char *plant; ///< id, owned
    double share;
} FrMixPart;

typedef struct FrRow {
    FR_SPREAD_PARAMS(FR_PARAM_FIELD)
    FR_ROW_PARAMS(FR_PARAM_FIELD)
    GArray *mix;     ///< FrMixPart
    GArray *gaps;    ///< uint32_t: of `except`, ascending
    FrStroke *along; ///< owned
    FrSpan span;
} FrRow;

typedef struct FrStrew {
    FR_SPREAD_PARAMS(FR_PARAM_FIELD)
    FR_STREW_PARAMS(FR_PARAM_FIELD)
    GArray *mix;      ///< FrMixPart
    GArray *gaps;     ///< uint32_t: of `except`, ascending
    FrImage *picture; ///< of its density, owned; NULL: the same everywhere
    FrSpan span;
} FrStrew;

enum { FR_STREW_SQUARE, FR_STREW_DISC };

FR_API const FrParamTable *fr_row_table(void);
FR_API const FrParamTable *fr_strew_table(void);
