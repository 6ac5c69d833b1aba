/// @file pgraph.h
/// Plants of linked components (Lintermann, Deussen 1999, Interactive Modeling of Plants).
///
/// A p-graph has component prototypes as nodes and creation dependencies as links. Building
/// expands it to the tree of instances (the i-tree) and that to an FrPlant. What each component
/// and parameter does: docs/components.md, generated from the tables.
#pragma once

#include "frond/light_field.h"
#include "frond/param.h"
#include "frond/plant.h"

typedef enum FrComponentKind {
    FR_COMPONENT_CAMERA,
    FR_COMPONENT_SIMPLE,
    FR_COMPONENT_HORN,
    FR_COMPONENT_TREE,
    FR_COMPONENT_LEAF,
    FR_COMPONENT_PHIBALL,
    FR_COMPONENT_REVO,
    FR_COMPONENT_HYDRA,
    FR_COMPONENT_WREATH,
    FR_COMPONENT_PHYLLOTAXIS,
    FR_COMPONENT_SCATTER,
    FR_COMPONENT_VARIATION,
    FR_COMPONENT_FFD,
    FR_COMPONENT_HYPERPATCH,
    FR_COMPONENT_WORLD,
    FR_COMPONENT_FORCE,
    FR_COMPONENT_GRAFT,
    FR_COMPONENT_COUNT
} FrComponentKind;

/// Parameters of a component kind; the struct's layout is private to the engine.
FR_API const FrParamTable *fr_pgraph_table(FrComponentKind kind);
/// When a parameter would have an effect that has none beside the others, like "mode is density";
/// NULL if it has one. Free with g_free().
FR_API char *fr_pgraph_why_unread(FrComponentKind kind, const void *params, const FrParam *row);

/// How a child hangs on its parent (the paper's link kinds, in words).
typedef enum FrLinkKind {
    FR_LINK_CHILD,  ///< thin line: at the tip of a stem, on each place of a multiplier
    FR_LINK_BRANCH, ///< bold: multiplied along the stem of a Tree, elsewhere like child
    FR_LINK_LEAF,   ///< dashed: once, after a recursion has ended, elsewhere like child
    FR_LINK_SYMBOL, ///< at each place that a graft calls by a symbol
} FrLinkKind;

typedef struct FrPgraph FrPgraph;

/// What is the same for the whole plant and seen by all its expressions.
typedef struct FrPgraphState {
    double age;    ///< years of the plant when its clock shows 0, ≥ 0
    double time;   ///< what the clock shows, years
    double season; ///< 0 to 1 from spring to winter
    double health; ///< 0 to 1
} FrPgraphState;

FR_API FrPgraph *fr_pgraph_new(const char *name, uint64_t seed);
FR_API void fr_pgraph_free(FrPgraph *graph);
/// A new graph has age, time and season 0 and health 1.
FR_API void fr_pgraph_set_state(FrPgraph *graph, const FrPgraphState *state);
/// Adds a prototype with default parameters and returns its index. `id` must be new: else FR_NONE
/// and a diagnostic.
FR_API uint32_t fr_pgraph_add(FrPgraph *graph, FrComponentKind kind, const char *id, FrSpan span,
                              FrDiags *diags);
FR_API uint32_t fr_pgraph_count(const FrPgraph *graph);
/// The index of the component of that id, or FR_NONE.
FR_API uint32_t fr_pgraph_find(const FrPgraph *graph, const char *id);
FR_API FrComponentKind fr_pgraph_kind(const FrPgraph *graph, uint32_t component);
FR_API const char *fr_pgraph_id(const FrPgraph *graph, uint32_t component);
/// The parameter struct that fr_pgraph_table() describes, to be set with fr_params_set().
FR_API void *fr_pgraph_params(FrPgraph *graph, uint32_t component);
/// Whether an edit has a place.
typedef enum FrEditPlace {
    FR_EDIT_WAITS,     ///< there is none now
    FR_EDIT_STANDS,    ///< it has one
    FR_EDIT_OVERRULED, ///< a later edit of the same path has it
} FrEditPlace;

/// A change of one instance, found by its path in the i-tree: the ids of the components on the way
/// to it, with the iteration of what is multiplied: trunk/branch[3]/leaf[0]. A camera is left out.
#define FR_EDIT_PARAMS(X)                                                                          \
    X(TEXT, at, "", 0, 0, "", "", "path of the instance: trunk/branch[3]/leaf[0]")                 \
    X(SWITCH, prune, "no", 0, 1, "", "", "not made, with all that follows on it")                  \
    X(SWITCH, hide, "no", 0, 1, "", "", "made but not shown; what follows on it is")               \
    X(REAL, rotate_x, "0", -3600, 3600, "deg", "", "turned further about its x axis")              \
    X(REAL, rotate_y, "0", -3600, 3600, "deg", "", "turned then about its y axis")                 \
    X(REAL, rotate_z, "0", -3600, 3600, "deg", "", "turned last about its z axis")                 \
    X(REAL, bend, "0", -720, 720, "deg", "",                                                       \
      "a stem: further turn from base to tip, towards its y axis")                                 \
    X(REAL, bend_aside, "0", -720, 720, "deg", "", "a stem: the same towards its x axis")          \
    X(REAL, scale, "1", 0.000001, 1000000, "", "", "size of it and of all that follows")           \
    X(TEXT, replace, "", 0, 0, "", "", "id of the component that is made in its place")            \
    X(INTEGER, redraw, "0", 0, 4294967295.0, "", "",                                               \
      "another number draws all that is random in it, and in what follows, anew")                  \
    X(TEXT, axis, "", 0, 0, "", "",                                                                \
      "a stem: points x,y,z x,y,z that it runs along, in m of its own coordinates")

typedef struct FrEditParams {
    FR_EDIT_PARAMS(FR_PARAM_FIELD)
} FrEditParams;

FR_API const FrParamTable *fr_edit_table(void);
/// Adds an edit; all components have been added. What has no place now is kept: a build warns of
/// it, and makes the edit again as soon as its instance is there.
FR_API FrStatus fr_pgraph_edit(FrPgraph *graph, const FrEditParams *params, FrSpan span,
                               FrDiags *diags);
FR_API uint32_t fr_pgraph_edit_count(const FrPgraph *graph);
FR_API const FrEditParams *fr_pgraph_edit_at(const FrPgraph *graph, uint32_t edit);
FR_API FrStatus fr_pgraph_link(FrPgraph *graph, uint32_t from, uint32_t to, FrLinkKind kind,
                               FrSpan span, FrDiags *diags);
/// Where the files that components name are: their names are relative to it.
FR_API void fr_pgraph_set_folder(FrPgraph *graph, const char *folder);
/// The `material` parameters of components name these. Takes a reference.
/// Links from a graft to what stands at each place of a symbol.
FR_API FrStatus fr_pgraph_link_symbol(FrPgraph *graph, uint32_t from, uint32_t to, char symbol,
                                      FrSpan span, FrDiags *diags);
/// Gives the plant of a graft a number that it knows by this name. Takes a copy. False if the graft
/// gives one of that name already.
FR_API bool fr_pgraph_define(FrPgraph *graph, uint32_t graft, const char *name,
                             const FrNumber *number);
/// The id of the plant that a graft puts in its place.
FR_API const char *fr_pgraph_grafted(const FrPgraph *graph, uint32_t graft);
FR_API void fr_pgraph_add_material(FrPgraph *graph, FrMaterial *material);
/// Roots, unreachable components, cycles without a depth, unknown materials.
FR_API FR_MUST_USE FrStatus fr_pgraph_check(const FrPgraph *graph, FrDiags *diags);

/// True if one of its Worlds samples the light.
FR_API bool fr_pgraph_samples_light(const FrPgraph *graph);

/// What stands at one instance of a graft.
typedef struct FrGraftWish {
    const char *plant;   ///< its id
    FrKey key;           ///< of the instance: all that is random in the plant hangs on it
    int64_t steps;       ///< of its growth; < 0: as many as it has itself
    const char *symbols; ///< that something is linked to; NULL: none
    const char *const *names;
    const double *values; ///< of the names: numbers that the plant knows
    size_t count;
} FrGraftWish;

/// Who grows the plants of grafts. A place for something linked to a symbol is an organ without a
/// shape, of a component that is called like the symbol.
typedef struct FrGraft {
    void *data;
    /// Several threads call it at once; the context has no pool. Within its limits it makes no more
    /// than they allow.
    FrStatus (*grow)(void *data, const FrGraftWish *wish, const FrContext *context,
                     FrPlant **plant);
    const FrLightField *light; ///< for Worlds that sample it; NULL: they go by their formulas
} FrGraft;

/// What an expansion made. `by_component` has fr_pgraph_count() elements.
typedef struct FrPgraphCounts {
    uint64_t instances;
    uint64_t *by_component; ///< owned, as all arrays here
    uint32_t *parent;       ///< i-tree: parent instance of each, FR_NONE for roots; only on request
    uint32_t *component;    ///< i-tree: component of each; only on request
    uint64_t *place;        ///< i-tree: for fr_pgraph_path(); only on request
    uint8_t *edits;         ///< by edit, FrEditPlace; NULL without edits
    double *seconds; ///< by component: what an instance takes one thread to make, by a sample; NAN:
                     ///< none was made; only on request. Skins are made later
} FrPgraphCounts;

/// Frees the arrays.
FR_API void fr_pgraph_counts_clear(FrPgraphCounts *counts);

/// Expands and builds. The number of instances, nodes and organs of each generation is counted
/// and checked before it is made. `counts` may be NULL; set counts->parent to a non-NULL value to
/// ask for the i-tree (it is replaced by an array), and so counts->seconds for times.
/// `graft` (may be NULL) grows what its grafts ask for.
FR_API FR_MUST_USE FrStatus fr_pgraph_build_grafted(const FrPgraph *graph, const FrGraft *graft,
                                                    const FrContext *context, FrPlant **plant,
                                                    FrPgraphCounts *counts);
/// The same for a graph without grafts.
FR_API FR_MUST_USE FrStatus fr_pgraph_build(const FrPgraph *graph, const FrContext *context,
                                            FrPlant **plant, FrPgraphCounts *counts);

// ---- building again ---------------------------------------------------------------------------

/// A build that is kept so that the next one can take over what a change did not reach. It holds
/// the plant and, besides, some 170 bytes for each instance.
typedef struct FrPgraphBuild FrPgraphBuild;

/// Builds `graph` as fr_pgraph_build() does, bit for bit, but takes from `last` (of this or another
/// graph; NULL: nothing) the instances that depend on nothing that differs. Which component an
/// instance is of tells its id. A change of leaf shapes or materials alone makes no instance.
/// `last` stays as it is, whatever happens; the two may share memory. A graph with grafts is
/// refused: what it is made of is not all in it.
FR_API FR_MUST_USE FrStatus fr_pgraph_rebuild(const FrPgraph *graph, const FrPgraphBuild *last,
                                              const FrContext *context, FrPgraphBuild **build);
FR_API void fr_pgraph_build_free(FrPgraphBuild *build);
/// The plant, borrowed from the build.
FR_API const FrPlant *fr_pgraph_build_plant(const FrPgraphBuild *build);
/// Its counts, borrowed; without the i-tree. Their seconds are of the last build that made
/// instances of the component.
FR_API const FrPgraphCounts *fr_pgraph_build_counts(const FrPgraphBuild *build);
/// How many instances were not made but taken over.
FR_API uint64_t fr_pgraph_build_taken_over(const FrPgraphBuild *build);
/// Whether nodes, axes and organs of both are the same arrays; their shapes and materials may still
/// be others.
FR_API bool fr_pgraph_build_shares(const FrPgraphBuild *build, const FrPgraphBuild *other);
/// The path of an instance of the i-tree, as edits name it; to be freed with g_free().
FR_API char *fr_pgraph_path(const FrPgraph *graph, const FrPgraphCounts *counts, uint32_t instance);
