/// @file prepare.h
/// What is worked out once per component, so that instances need not.
#pragma once

#include "pgraph/evaluate.h"
#include "pgraph/flags.h"
#include "pgraph/graph.h"
#include "pgraph/places.h"
#include "pgraph/recursion.h"

enum { FR_MOST_OUTLINE_POINTS = 4096 }; ///< of a Revo

/// How a leaf comes by its shape.
typedef enum FrShapeChoice {
    FR_SHAPE_SAME,      ///< one for all
    FR_SHAPE_VARIANT,   ///< one of some, chosen by the path
    FR_SHAPE_EVALUATED, ///< its own: a parameter depends on where it is
} FrShapeChoice;

/// An object of a primitive: all of it, or what a file has of one material.
typedef struct FrPiece {
    uint32_t shape, material; ///< of the plant; a material FR_NONE is that of what it is part of
} FrPiece;

typedef struct FrPrepared {
    FrComponentKind kind;
    const void *params;
    FrFlags flags;
    uint64_t key_word; ///< of its id and seed
    uint32_t material; ///< FR_NONE: inherited
    bool varies;       ///< any parameter is not constant
    bool uses_place;   ///< … and depends on where in the plant it is
    bool is_timed;     ///< may be absent: has a birth, a lifetime, a clock, a chance of its own
    bool grows;
    bool is_unmoved;   ///< its own translate and rotate are constantly nothing
    bool is_drawn;     ///< … and its own tropism is not
    bool is_stem;      ///< horn or tree
    bool is_string;    ///< … made of objects
    bool is_point_set; ///< simple with primitive tube or area
    bool is_along;     ///< a leaf with parameters that differ along it
    bool is_ahead;     ///< a stem as long as its way to an obstacle
    bool is_aligned;   ///< a stem that turns to the direction of what it stands on
    bool bears;        ///< multiplies at least one link
    bool bears_welded; ///< branches that are to be one surface with it
    uint32_t along;    ///< parameters of a stem that differ along it, bits 1 << FrAlong
    uint32_t profile;  ///< cross-section, of the plant; FR_NONE
    uint32_t finish;   ///< of a stem, of the plant; the next is that of a broken one; FR_NONE
    FrFinishParams finished;
    uint32_t shape;  ///< of a revo, or the one of a leaf, of the plant; FR_NONE
    FrPiece *pieces; ///< of a primitive; owned
    uint32_t piece_count;
    FrMeshFile *file;            ///< triangles; owned reference; NULL
    struct FrDistance *distance; ///< from them, of a force; owned; NULL
    FrShapeChoice shape_choice;
    uint32_t variant_count, *variants; ///< shapes for FR_SHAPE_VARIANT; owned
    FrShape blade;                     ///< of a leaf: outline and curves filled in
    double bend_factor;                ///< how far the stem turns for each degree of curvature
    FrCurve *crown;                    ///< of a tree: length of its branches; owned; NULL
    FrDensity *density;                ///< of a tree with a density curve; owned
    GArray *path;                      ///< of a stem along a path: vec3s, ends of internodes; owned
    const FrNumber *number;            ///< of children, of a multiplier that has one; NULL
    uint32_t number_parameter;         ///< … its row
    uint32_t number_times;             ///< … and how often it has so many
    struct FrStrewnSurface *strewn;    ///< mesh of a scatter; owned
    struct FrRevolved *revolved;       ///< surface of a phyllotaxis; owned
    GArray *weights;                   ///< FrWeight, of a variation; owned
    const GArray *defines;             ///< FrGraftDefine, of a graft
    char *symbols;                     ///< of its links; owned; NULL
    uint32_t deformation;              ///< of an FFD or hyperpatch, of the plant
    double step;                       ///< m, of internodes in a scope or field
    double low, top;                   ///< of a revo: its lowest point; where what follows stands
} FrPrepared;

/// One for each component that is reached, of a graph that has passed its check. Adds profiles,
/// shapes, materials and components to the plant. Fails by files that cannot be read and the limit
/// of shapes; *prepared is to be freed all the same.
FrStatus fr_prepare(FrPrepared **prepared, const FrPgraph *graph, const FrRecursions *recursions,
                    FrPlant *plant, GHashTable *faults, const FrContext *context);
void fr_prepared_free(FrPrepared *prepared, uint32_t count);

/// A leaf's part of fr_prepare().
void fr_prepare_leaf(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                     FrPlant *plant, GHashTable *faults);
/// A leaf's shape for the instance or variant whose variables are set.
FrShape fr_leaf_shape(const FrPrepared *prepared, FrEvaluator *evaluator);
/// Whether any of its parameters differs along the leaf itself.
bool fr_leaf_is_along(const FrLeafParams *leaf);
/// Adds what does, of the instance or variant whose variables are set, to its blade.
void fr_leaf_along(FrBlade *blade, const FrLeafParams *leaf, FrEvaluator *evaluator,
                   FrPlant *plant);
/// Whether a number depends on where in the plant it is.
static inline bool fr_uses_place(const FrNumber *number) {
    return fr_number_uses(number, FR_VAR_height) || fr_number_uses(number, FR_VAR_px) ||
           fr_number_uses(number, FR_VAR_py) || fr_number_uses(number, FR_VAR_pz);
}
/// The key of a leaf's variant.
FrKey fr_variant_key(const FrPgraph *graph, const FrPrepared *prepared, uint32_t variant);

/// The material a component names: an index into the graph's, FR_NONE if it names none.
FrStatus fr_find_material(const FrPgraph *graph, uint32_t component, uint32_t *material,
                          FrDiags *diags);
/// The points of a `path`, at least two (vec3s), or NULL and an error.
GArray *fr_path_points(const char *path, const FrPrototype *prototype, FrDiags *diags);
/// All checks; without warnings for graphs that are about to be built.
FrStatus fr_pgraph_check_all(const FrPgraph *graph, const FrRecursions *recursions, FrDiags *diags,
                             bool with_warnings);
/// Reads the file that a component names into made->file.
FrStatus fr_prepare_file(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                         const char *name, const FrContext *context);
/// Adds the pieces of a primitive to the plant; `made->file` has been read for FR_PRIMITIVE_MESH.
void fr_prepare_pieces(FrPrepared *made, int primitive, vec3s size, int64_t detail, FrPlant *plant);
/// The surface of a Force that is read from a file; nothing for others.
FrStatus fr_prepare_body(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                         const FrContext *context);
/// The surface of a Scatter that is read from a file; nothing for others.
FrStatus fr_prepare_scatter(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                            const FrContext *context);
/// Adds the shape of a Revo to the plant.
void fr_prepare_revo(FrPrepared *made, FrPlant *plant);
/// The outline of a leaf as a profile of the plant; FR_NONE: elliptic.
uint32_t fr_leaf_outline(FrPlant *plant, const FrLeafParams *leaf);
