/// @file param.h
/// Parameter tables: every parameter is declared once, in one row.
///
/// A table is an X-macro whose rows are
///
///     X(KIND, field, default_text, min, max, unit, choices, meaning)
///
/// The struct, its defaults, range checks, XML attributes, the schema, `--set`, the inspector and
/// the reference page all come from that row. In documents `_` of a field name is written `-`.
///
/// | KIND      | C type      | text form                                  | unit        |
/// |-----------|-------------|--------------------------------------------|-------------|
/// | NUMBER    | FrNumber    | see number.h                               | "m", "deg"… |
/// | REAL      | double      | 3.5                                        | as above    |
/// | INTEGER   | int64_t     | 12                                         |             |
/// | SWITCH    | bool        | yes, no                                    |             |
/// | CHOICE    | int         | one of `choices` ("a b c"), stored as index |            |
/// | TEXT      | char *      | any; also ids of other things; NULL if ""  |             |
/// | CURVE     | FrCurve *   | a curve's name, or "x,y x,y …"; NULL if "" |             |
/// | POINTS    | FrPoints    | "x,y x,y …"                                |             |
/// | VECTOR    | vec3s       | "x, y, z" or one number for all three      |             |
/// | COLOUR    | vec3s       | "#rrggbb", stored as sRGB 0 to 1           |             |
/// | FORMULA   | FrExpr *    | an expression of `choices` ("x y z") alone; NULL if "" |
#pragma once

#include "frond/number.h"

typedef struct FrPoints {
    double (*at)[2]; ///< owned
    size_t count;
} FrPoints;

typedef enum FrParamKind {
    FR_PARAM_NUMBER,
    FR_PARAM_REAL,
    FR_PARAM_INTEGER,
    FR_PARAM_SWITCH,
    FR_PARAM_CHOICE,
    FR_PARAM_TEXT,
    FR_PARAM_CURVE,
    FR_PARAM_POINTS,
    FR_PARAM_VECTOR,
    FR_PARAM_COLOUR,
    FR_PARAM_FORMULA,
} FrParamKind;

typedef struct FrParam {
    const char *name; ///< the C field's name; fr_param_attribute() is its form in documents
    FrParamKind kind;
    const char *default_text;
    double min, max;     ///< hard range in the document's unit, both ends allowed
    const char *unit;    ///< "" if dimensionless
    const char *choices; ///< names separated by spaces: for CHOICE what to choose from, for
                         ///< FORMULA its variables in the order of their values, for NUMBER
                         ///< "self" if it may differ along the component itself; else ""
    const char *meaning; ///< one line
    size_t offset;       ///< of the field in its struct
} FrParam;

typedef struct FrParamTable {
    const char *element; ///< name of the XML element
    const char *meaning; ///< one line
    const FrParam *rows;
    size_t count;
    size_t struct_size;
} FrParamTable;

#define FR_TYPE_NUMBER FrNumber
#define FR_TYPE_REAL double
#define FR_TYPE_INTEGER int64_t
#define FR_TYPE_SWITCH bool
#define FR_TYPE_CHOICE int
#define FR_TYPE_TEXT char *
#define FR_TYPE_CURVE FrCurve *
#define FR_TYPE_POINTS FrPoints
#define FR_TYPE_VECTOR vec3s
#define FR_TYPE_COLOUR vec3s
#define FR_TYPE_FORMULA FrExpr *

/// Expands a row to a struct field.
#define FR_PARAM_FIELD(kind, field, text, min, max, unit, choices, meaning)                        \
    FR_TYPE_##kind field; ///< meaning
/// Expands a row to an FrParam, inside a table for struct type FR_PARAM_STRUCT.
#define FR_PARAM_ROW(kind_, field_, text_, min_, max_, unit_, choices_, meaning_)                  \
    {.name = #field_,                                                                              \
     .kind = FR_PARAM_##kind_,                                                                     \
     .default_text = text_,                                                                        \
     .min = min_,                                                                                  \
     .max = max_,                                                                                  \
     .unit = unit_,                                                                                \
     .choices = choices_,                                                                          \
     .meaning = meaning_,                                                                          \
     .offset = offsetof(FR_PARAM_STRUCT, field_)},

/// Fills `object` with the defaults of every row; afterwards it owns what its fields point to.
FR_API void fr_params_init(const FrParamTable *table, void *object);
/// Frees what the fields own.
FR_API void fr_params_clear(const FrParamTable *table, void *object);
/// Deep copy into an uninitialized `to`.
FR_API void fr_params_copy(const FrParamTable *table, void *to, const void *from);
/// The row of that name (`-` equals `_`), or NULL.
FR_API const FrParam *fr_params_find(const FrParamTable *table, const char *name);
/// Parses and stores one value. On a wrong value the field keeps its old one.
FR_API FrStatus fr_params_set(const FrParamTable *table, void *object, const FrParam *param,
                              const char *text, FrSpan span, const FrScope *scope, FrDiags *diags);
/// The digest of one value, continued from `seed`: where it is equal, so is all that is made of it.
/// Curves and functions count by what they are, not by their names.
FR_API FrDigest fr_param_digest(FrDigest seed, const FrParam *param, const void *object);
/// The nearest row's attribute name for a misspelt one, or NULL. Free with g_free().
FR_API char *fr_params_suggest(const FrParamTable *table, const char *name);
/// The name as documents write it: `branching-angle`. Free with g_free().
FR_API char *fr_param_attribute(const FrParam *param);
/// The i-th name of a CHOICE row. Free with g_free().
FR_API char *fr_param_choice(const FrParam *param, int index);
