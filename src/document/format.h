/// @file format.h
/// The elements of a document, each declared once: what it may hold, its attributes, what it is
/// for. The reader, the schema, the reference page and `--set` all go by these rows.
#pragma once

#include "frond/document.h"

typedef enum FrElementId {
    FR_ELEMENT_FROND,
    FR_ELEMENT_CURVE,
    FR_ELEMENT_FUNCTION,
    FR_ELEMENT_MATERIAL,
    FR_ELEMENT_PLANT,
    FR_ELEMENT_SLIDER,
    FR_ELEMENT_PGRAPH,
    FR_ELEMENT_LINK,
    FR_ELEMENT_EDITS,
    FR_ELEMENT_EDIT,
    FR_ELEMENT_LSYSTEM,
    FR_ELEMENT_DEFINE,
    FR_ELEMENT_SKELETON,
    FR_ELEMENT_RAMIFIED,
    FR_ELEMENT_NURBS,
    FR_ELEMENT_SPECIES,
    FR_ELEMENT_ORDER,
    FR_ELEMENT_SLIDERS,
    FR_ELEMENT_VARY,
    FR_ELEMENT_STROKE,
    FR_ELEMENT_INDICATOR,
    FR_ELEMENT_SCENE,
    FR_ELEMENT_PLACE,
    FR_ELEMENT_ROW,
    FR_ELEMENT_STREW,
    FR_ELEMENT_VIEW,
    FR_ELEMENT_GROWTH,
    FR_ELEMENT_PARTICLES,
    FR_ELEMENT_OBSTACLE,
    FR_ELEMENT_TERRAIN,
    FR_ELEMENT_LAMP,
    FR_ELEMENT_SUN,
    FR_ELEMENT_LIGHT,
    FR_ELEMENT_COMPONENT, ///< the first of FR_COMPONENT_COUNT, in the order of FrComponentKind
    FR_ELEMENT_COUNT = FR_ELEMENT_COMPONENT + FR_COMPONENT_COUNT
} FrElementId;

/// A set of elements: bit 1 << FrElementId.
typedef uint64_t FrElementSet;

typedef struct FrElement {
    const char *name;
    const char *meaning;
    const FrParamTable *table; ///< attributes but `id`; NULL if it has none
    FrElementSet children;
    const char *required; ///< attributes that must be given, separated by blanks
    bool has_id;          ///< `id` must be given
    bool has_text;        ///< its content is text
    bool is_once;         ///< at most once in what holds it
} FrElement;

FrElement fr_element(FrElementId id);
/// The element of that name, or FR_ELEMENT_COUNT.
FrElementId fr_element_find(const char *name);
/// True if `required` of the element names the attribute.
bool fr_element_requires(const FrElement *element, const char *attribute);
enum { FR_LONGEST_ID = 64 }; ///< bytes
/// True for what `id` may be but for its length: a letter or `_`, then letters, digits, `_` and
/// `-`.
bool fr_id_is_valid(const char *id);

/// The newest version of the format, and the only one so far.
enum { FR_DOCUMENT_VERSION = 1 };

#define FR_FROND_PARAMS(X)                                                                         \
    X(INTEGER, version, "1", 1, 4294967295.0, "", "", "version of the format")
#define FR_CURVE_PARAMS(X)                                                                         \
    X(CHOICE, kind, "smooth", 0, 0, "", "smooth linear step",                                      \
      "how it goes from point to point: without overshooting, straight, or in steps")              \
    X(POINTS, points, "", 0, 0, "", "", "the points x,y in the order of rising x")
#define FR_FUNCTION_PARAMS(X)                                                                      \
    X(TEXT, parameters, "", 0, 0, "", "", "names of its parameters, separated by blanks")
#define FR_PLANT_PARAMS(X)                                                                         \
    X(INTEGER, seed, "1", 0, 4294967295.0, "", "", "seed of everything random in the plant")       \
    X(REAL, age, "0", 0, 1000000, "a", "", "how old it is when its clock shows 0")                 \
    X(REAL, time, "0", 0, 1000000, "a", "", "what its clock shows")                                \
    X(NUMBER, season, "0", 0, 1, "", "", "from spring to winter; may be an expression of time")    \
    X(NUMBER, health, "1", 0, 1, "", "", "how well it is; may be an expression of time")
#define FR_DEFINE_PARAMS(X) X(NUMBER, value, "0", -1e30, 1e30, "", "", "its value")
#define FR_LINK_PARAMS(X)                                                                          \
    X(TEXT, from, "", 0, 0, "", "", "id of the component that makes")                              \
    X(TEXT, to, "", 0, 0, "", "", "id of the component that is made")                              \
    X(CHOICE, kind, "child", 0, 0, "", "child branch leaf",                                        \
      "child: at the tip; branch: multiplied along the stem of a tree; leaf: once, after a "       \
      "recursion has ended")                                                                       \
    X(TEXT, symbol, "", 0, 0, "", "", "from a graft: at each place of this symbol of its plant")

typedef struct FrFrondParams {
    FR_FROND_PARAMS(FR_PARAM_FIELD)
} FrFrondParams;
typedef struct FrCurveParams {
    FR_CURVE_PARAMS(FR_PARAM_FIELD)
} FrCurveParams;
typedef struct FrFunctionParams {
    FR_FUNCTION_PARAMS(FR_PARAM_FIELD)
} FrFunctionParams;
typedef struct FrPlantParams {
    FR_PLANT_PARAMS(FR_PARAM_FIELD)
} FrPlantParams;
typedef struct FrDefineParams {
    FR_DEFINE_PARAMS(FR_PARAM_FIELD)
} FrDefineParams;
typedef struct FrLinkParams {
    FR_LINK_PARAMS(FR_PARAM_FIELD)
} FrLinkParams;
