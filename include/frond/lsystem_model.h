/// @file lsystem_model.h
/// An L-system with all that belongs to it: its view, its environment, its materials, the values
/// that are set from outside. What a `<lsystem>` of a document and a .l file have in common.
///
///     FrLmodel *model = fr_lmodel_new(&params);
///     fr_lmodel_define(model, "angle", &number, span);
///     fr_lmodel_compile(model, NULL, folder, &context);      reads params.file
///     FrLsettings settings = fr_lmodel_settings(model);
///     fr_lmodel_grow(model, &settings, &context, &plant, NULL, NULL);
#pragma once

#include "frond/lsystem.h"
#include "frond/param.h"

#define FR_LSYSTEM_PARAMS(X)                                                                       \
    X(TEXT, file, "", 0, 0, "", "", "file of the L-system (.l); empty: the text within")           \
    X(TEXT, view, "", 0, 0, "", "",                                                                \
      "view file (.v) with angles, widths, surfaces; empty: the .v beside file, if there is one")  \
    X(TEXT, colour_map, "", 0, 0, "", "",                                                          \
      "colour map (.map) or materials (.mat); empty: those beside file, if there are any")         \
    X(INTEGER, steps, "-1", -1, 1000000000, "", "", "steps of derivation; -1: as the text says")   \
    X(CHOICE, notation, "auto", 0, 0, "", "auto cpfg paper",                                       \
      "how it is written; auto: cpfg if it begins with Lsystem, else as in papers")                \
    X(CHOICE, brackets, "square", 0, 0, "", "square round",                                        \
      "what branches stand in; with round ones modules have no parameters")                        \
    X(REAL, unit, "1", 0.000001, 1000000, "m", "", "length of one unit of the text")               \
    X(TEXT, material, "", 0, 0, "", "", "id of the material of its axes")                          \
    X(TEXT, leaf_material, "", 0, 0, "", "", "id of the material of its surfaces and polygons")    \
    X(TEXT, colours, "", 0, 0, "", "",                                                             \
      "ids of the materials of organs in colour 1, 2, … of ;(n), separated by blanks")             \
    X(VECTOR, light, "0.6, 0, 0.8", -1000000, 1000000, "", "",                                     \
      "direction towards the light that answers R")                                                \
    X(REAL, light_strength, "1", 0, 1000000, "", "", "what I and ?E receive")                      \
    X(VECTOR, obstacle, "0, 0, 0", -1000000, 1000000, "m", "", "middle of a ball that D measures") \
    X(REAL, obstacle_radius, "0", 0, 1000000, "m", "", "its radius; 0: there is none")             \
    X(REAL, shade_height, "0", -1000000, 1000000, "m", "",                                         \
      "below this height the light is shaded")                                                     \
    X(REAL, shade, "1", 0, 1, "", "", "part of the light that there is in the shade")

typedef struct FrLsystemParams {
    FR_LSYSTEM_PARAMS(FR_PARAM_FIELD)
} FrLsystemParams;

FR_API const FrParamTable *fr_lsystem_table(void);

typedef struct FrLmodel FrLmodel;

/// Copies the parameters.
FR_API FrLmodel *fr_lmodel_new(const FrLsystemParams *params);
FR_API void fr_lmodel_free(FrLmodel *model);
/// Sets a number that the L-system knows by this name; it may vary by the seed. Takes a copy. False
/// if it is no name, or set already.
FR_API bool fr_lmodel_define(FrLmodel *model, const char *name, const FrNumber *number,
                             FrSpan span);
/// Where printf() of the language goes; NULL: nowhere.
FR_API void fr_lmodel_set_print(FrLmodel *model, void (*print)(void *user, const char *text),
                                void *user);
/// Materials of axes and of organs; NULL: its own. Takes references.
FR_API void fr_lmodel_set_materials(FrLmodel *model, FrMaterial *axes, FrMaterial *organs);
/// Materials of the colours from 1; at most 255. Takes references.
FR_API void fr_lmodel_set_colours(FrLmodel *model, FrMaterial *const *materials, size_t count);
/// Reads the view and compiles `text`, or the file of the parameters if that is NULL, relative to
/// `folder`. `span` is where the model is described. Once a model.
FR_API FR_MUST_USE FrStatus fr_lmodel_compile(FrLmodel *model, FrSource *text, const char *folder,
                                              FrSpan span, const FrContext *context);

// ---- a compiled model, which any number of threads may read -----------------------------------

FR_API const FrLsystem *fr_lmodel_system(const FrLmodel *model);
FR_API const FrLsystemParams *fr_lmodel_params(const FrLmodel *model);
/// How many numbers are set.
FR_API size_t fr_lmodel_value_count(const FrLmodel *model);
/// Its name.
FR_API const char *fr_lmodel_value_name(const FrLmodel *model, uint32_t value);
/// The view file of the model, relative to `folder`; NULL if it has none. Free with g_free().
FR_API char *fr_lmodel_view_name(const FrLmodel *model, const char *folder);
/// The place of a number in the order they were set, that of FrLsettings.values; FR_NONE.
FR_API uint32_t fr_lmodel_find_value(const FrLmodel *model, const char *name);
/// Writes them all for a seed; `key` is that of what the plant stands on.
FR_API void fr_lmodel_evaluate(const FrLmodel *model, FrKey key, double *values);
/// What the model says; it must outlive what is derived with it. The values are still to be set.
FR_API FrLsettings fr_lmodel_settings(const FrLmodel *model);
/// Begins a derivation; values that are NULL are those for the settings' seed.
FR_API FR_MUST_USE FrStatus fr_lmodel_derive(const FrLmodel *model, const FrLsettings *settings,
                                             const FrContext *context, FrLderivation **derivation);
/// The same to its end, and draws. `modules` (may be NULL) receives the length of the string,
/// `drawn` (may be NULL) what the turtle drew.
FR_API FR_MUST_USE FrStatus fr_lmodel_grow(const FrLmodel *model, const FrLsettings *settings,
                                           const FrContext *context, FrPlant **plant,
                                           uint64_t *modules, FrLdrawn *drawn);
