/// @file document.h
/// The `.frond` document: XML with places for every error, written back as the user wrote it.
///
/// Two levels. The *tree* is the text itself, lossless: elements, attributes, comments, white
/// space, each with its span; edits change the tree and an unchanged document is written
/// byte for byte. The *definitions* (materials, curves, p-graphs, scene) are read from the tree.
#pragma once

#include "frond/context.h"
#include "frond/ecosystem.h"
#include "frond/lsystem_model.h"
#include "frond/material.h"
#include "frond/nurbs_skin.h"
#include "frond/pgraph.h"
#include "frond/placing.h"
#include "frond/ramified.h"
#include "frond/surroundings.h"
#include "frond/variation.h"

typedef struct FrDocument FrDocument;

/// Reads and checks a document. On FR_OK there are no errors in it. Otherwise *document is still
/// set if the text is well-formed XML, so that an editor can show it, else NULL.
FR_API FR_MUST_USE FrStatus fr_document_load(const char *path, const FrContext *context,
                                             FrDocument **document);
FR_API FR_MUST_USE FrStatus fr_document_parse(FrSource *source, const char *folder,
                                              const FrContext *context, FrDocument **document);
FR_API void fr_document_free(FrDocument *document);
/// The text as it would be saved.
FR_API char *fr_document_text(const FrDocument *document, size_t *size);
/// Writes beside `path`, flushes, renames.
FR_API FR_MUST_USE FrStatus fr_document_save(const FrDocument *document, const char *path,
                                             FrDiags *diags);
/// `path` is `id.attribute` or `plant.component.attribute`, e.g. `trunk.length`; `value` the
/// attribute's text. `plant.slider` is short for that slider's `value`. A bad path lists near
/// names. The definitions follow.
FR_API FR_MUST_USE FrStatus fr_document_set(FrDocument *document, const char *path,
                                            const char *value, const FrContext *context);

// ---- what is in it ----------------------------------------------------------------------------

typedef enum FrPlantKind {
    FR_PLANT_PGRAPH,
    FR_PLANT_LSYSTEM,
    FR_PLANT_SKELETON,
    FR_PLANT_RAMIFIED,
    FR_PLANT_VARIED,  ///< another plant of the document, varied
    FR_PLANT_SPECIES, ///< grows bud by bud among the others of its scene
} FrPlantKind;

/// A `<slider>` of a plant: one handle for many of its numbers.
#define FR_SLIDER_PARAMS(X)                                                                        \
    X(TEXT, label, "", 0, 0, "", "", "what it does, in a few words")                               \
    X(REAL, min, "0", -1000000000, 1000000000, "", "", "its least value")                          \
    X(REAL, max, "1", -1000000000, 1000000000, "", "", "its greatest value")                       \
    X(REAL, initial, "1", -1000000000, 1000000000, "", "", "where it stands at first")             \
    X(REAL, value, "1", -1000000000, 1000000000, "", "",                                           \
      "where it stands now; if it is not given, as at first")                                      \
    X(TEXT, choices, "", 0, 0, "", "",                                                             \
      "names of its values 0, 1, 2 …, separated by blanks, if it chooses")

typedef struct FrSlider {
    FR_SLIDER_PARAMS(FR_PARAM_FIELD)
    char *id;
} FrSlider;

/// The name of the value a slider has, NULL if it has none. Free with g_free().
FR_API char *fr_slider_choice(const FrSlider *slider);

FR_API const FrParamTable *fr_slider_table(void);

/// A `<plant>`: a name, a seed and one engine's definition.
typedef struct FrPlantDef {
    char *id;
    uint64_t seed;
    bool has_seed; ///< it was given; else an L-system keeps that of its text
    FrPlantKind kind;
    double age, time;        ///< years of the plant when its clock shows 0; what it shows
    FrNumber season, health; ///< see FrPgraphState; of `time` and `age`
    GPtrArray *sliders;      ///< FrSlider *, in the order of the document
    FrPgraph *pgraph;        ///< for FR_PLANT_PGRAPH, else empty
    FrLmodel *lsystem;       ///< for FR_PLANT_LSYSTEM, else NULL
    FrSkeleton *skeleton;    ///< for FR_PLANT_SKELETON, else NULL
    FrSpeciesDef *species;   ///< for FR_PLANT_SPECIES, else NULL
    FrRamified *ramified;    ///< for FR_PLANT_RAMIFIED, else NULL
    FrVary *vary;   ///< for FR_PLANT_VARIED, else NULL; its `base` is the id of the other plant
    bool has_nurbs; ///< it has a `<nurbs>`: it is shown as rational surfaces …
    FrNurbsParams nurbs; ///< … with these settings, else with the usual ones
    FrSpan nurbs_span;   ///< of its name
    FrSpan span;
} FrPlantDef;

/// A `<place>` of a scene: one plant and where it stands.
#define FR_PLACE_PARAMS(X)                                                                         \
    X(TEXT, plant, "", 0, 0, "", "", "id of the plant")                                            \
    X(VECTOR, at, "0, 0, 0", -1000000, 1000000, "m", "", "where it stands")                        \
    X(REAL, turn, "0", -360000, 360000, "deg", "", "turned about the vertical")                    \
    X(REAL, scale, "1", 0.001, 1000, "", "", "size")                                               \
    X(INTEGER, seed, "-1", -1, 4294967295.0, "", "", "own seed; -1: that of the plant")

/// Sun, sky and ground of a scene.
#define FR_SCENE_PARAMS(X)                                                                         \
    X(REAL, sun_azimuth, "135", -360, 360, "deg", "", "direction of the sun, from +y clockwise")   \
    X(REAL, sun_elevation, "42", -10, 90, "deg", "", "height of the sun above the horizon")        \
    X(REAL, sun_strength, "1", 0, 20, "", "", "strength of the sun; 1 is a clear day")             \
    X(CHOICE, sky, "air", 0, 0, "", "air uniform overcast clear",                                  \
      "as the air makes it, or even, overcast or clear as standards have it; air is a clear "      \
      "sky to plants")                                                                             \
    X(REAL, sky_strength, "1", 0, 20, "", "", "strength of the sky's light")                       \
    X(REAL, turbidity, "3", 1, 10, "", "", "haze: 2 clear mountain air, 10 haze")                  \
    X(SWITCH, ground, "yes", 0, 1, "", "", "a ground to stand on")                                 \
    X(COLOUR, ground_colour, "#6b6a4e", 0, 1, "", "", "colour of the ground")                      \
    X(REAL, exposure, "0", -20, 20, "", "", "stops of exposure added to the automatic one")        \
    X(REAL, apart, "0", 0, 1000, "", "",                                                           \
      "plants that have grown together are shown so many times farther from their middle")         \
    X(REAL, frame_time, "0.1", 0.000001, 1000000, "a", "",                                         \
      "years from picture to picture of a sequence (render --frames)")

/// A view. Angles and distance count from the middle of what is looked at.
#define FR_VIEW_PARAMS(X)                                                                          \
    X(TEXT, name, "", 0, 0, "", "", "name of the view")                                            \
    X(REAL, azimuth, "-30", -3600, 3600, "deg", "", "from where, about the vertical, from -y")     \
    X(REAL, elevation, "8", -89, 89, "deg", "", "from how high above")                             \
    X(REAL, field_of_view, "35", 1, 120, "deg", "", "of the picture's height")                     \
    X(REAL, zoom, "1", 0.01, 1000, "", "", "1 frames the whole scene, 2 is twice as near")         \
    X(VECTOR, look_at, "0, 0, 0", -1000000, 1000000, "m", "", "moved from the middle by")          \
    X(VECTOR, eye, "0, 0, 0", -1000000, 1000000, "m", "",                                          \
      "where the camera stands, in a room say")                                                    \
    X(VECTOR, target, "0, 0, 0", -1000000, 1000000, "m", "",                                       \
      "what an eye that is not in the same place looks at; then only the field of view counts")

enum { FR_SCENE_SKY_AIR, FR_SCENE_SKY_UNIFORM, FR_SCENE_SKY_OVERCAST, FR_SCENE_SKY_CLEAR };

typedef struct FrPlace {
    FR_PLACE_PARAMS(FR_PARAM_FIELD)
    FrSpan span;
} FrPlace;
typedef struct FrSceneParams {
    FR_SCENE_PARAMS(FR_PARAM_FIELD)
} FrSceneParams;
typedef struct FrViewParams {
    FR_VIEW_PARAMS(FR_PARAM_FIELD)
} FrViewParams;

FR_API const FrParamTable *fr_place_table(void);
FR_API const FrParamTable *fr_scene_table(void);
FR_API const FrParamTable *fr_view_table(void);

FR_API const char *fr_document_name(const FrDocument *document);
/// The first line of the first comment: what the document calls itself. NULL if it has none; free
/// with g_free().
FR_API char *fr_document_title(const FrDocument *document);
/// The place of the root element's name, for what is wrong with the document as a whole.
FR_API FrSpan fr_document_span(const FrDocument *document);
/// A plant's definition once more, with another seed and, unless it is NAN, another time of its
/// clock in years; to be freed with fr_pgraph_free(). The document must have been read without
/// errors.
FR_API FrPgraph *fr_document_reseed(const FrDocument *document, const FrPlantDef *plant,
                                    uint64_t seed, double time);
FR_API const char *fr_document_folder(const FrDocument *document);
/// Arrays of FrPlantDef *, FrPlace *, FrRow *, FrStrew *, FrViewParams * and FrMaterial *, owned by
/// the document.
FR_API const GPtrArray *fr_document_plants(const FrDocument *document);
FR_API const GPtrArray *fr_document_places(const FrDocument *document);
FR_API const GPtrArray *fr_document_rows(const FrDocument *document);
FR_API const GPtrArray *fr_document_strews(const FrDocument *document);
FR_API const GPtrArray *fr_document_views(const FrDocument *document);
FR_API const GPtrArray *fr_document_materials(const FrDocument *document);
FR_API const FrSceneParams *fr_document_scene(const FrDocument *document);
FR_API const FrGrowthDef *fr_document_growth(const FrDocument *document);
FR_API const FrSurroundings *fr_document_surroundings(const FrDocument *document);

// ---- conversion -------------------------------------------------------------------------------

/// The document of one plant that is an L-system of this text; `view` (may be NULL) names its view
/// file. Free with g_free().
FR_API char *fr_document_wrap_lsystem(const char *id, const char *text, const char *view);
/// The document of one plant that is a skeleton of that file. Free with g_free().
FR_API char *fr_document_wrap_skeleton(const char *id, const char *file);
/// The text of a plant that is an L-system as a file of its own: numbers that the document sets
/// stand in their macros, steps and seed in its head. Free with g_free().
FR_API FR_MUST_USE FrStatus fr_document_extract_lsystem(const FrDocument *document,
                                                        const FrPlantDef *plant,
                                                        const FrContext *context, char **text);

/// The XML Schema (XSD 1.0) of the format, made from the parameter tables.
FR_API char *fr_document_schema(void);
/// The reference page of all elements and attributes, in Markdown, made from the same tables.
FR_API char *fr_document_reference(void);
