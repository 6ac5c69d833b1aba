/// @file edit.h
/// Edits by hand: what is said of single instances, found by their paths in the i-tree.
///
/// Paths make a tree of their own. Every instance is handed down where it stands in it, so one
/// without edits below costs a comparison. Nothing in a path is a number that chance or a slider
/// changes: an edit keeps its place for as long as there is a way to it.
#pragma once

#include "pgraph/graph.h"

/// Where an instance stands in the tree of paths.
typedef uint32_t FrEditState;
#define FR_EDIT_NOWHERE UINT32_MAX

/// How a child follows on its parent.
typedef struct FrStep {
    uint32_t component; ///< of the child
    uint32_t iteration; ///< for a multiplied one
    bool is_multiplied;
    bool is_global; ///< the child is no part of paths
    uint16_t arms;  ///< at each fork of the parent's stem which arm, two bits each
} FrStep;

typedef struct FrEdits FrEdits;

/// The edits of a graph; NULL if it has none.
FrEdits *fr_edits_new(const FrPgraph *graph);
void fr_edits_free(FrEdits *edits);
/// Before the roots; after a camera it may be the same.
FrEditState fr_edits_begin(const FrEdits *edits, uint32_t root, bool is_camera);
/// Where a child stands of a parent that stands at `state`; `iteration` is the parent's, for what
/// follows on something that is no part of paths.
FrEditState fr_edits_step(const FrEdits *edits, FrEditState state, bool parent_is_global,
                          uint32_t iteration, const FrStep *step);
/// The number of the edit of what stands there, FR_NONE.
uint32_t fr_edits_at(const FrEdits *edits, FrEditState state);

/// An edit's path as steps; false if it is not well written. `steps` (may be NULL) gets FrPathStep.
bool fr_edit_path_read(const char *text, GArray *steps);

typedef struct FrPathStep {
    char id[65];
    uint32_t iteration;
    bool is_multiplied;
    uint16_t arms; ///< of its own stem, on the way to the next step
} FrPathStep;

/// An edit of the graph, FrGraphEdit.
typedef struct FrGraphEdit {
    FrEditParams params; ///< owned
    FrSpan span;
    uint32_t replacement; ///< component, FR_NONE
    GArray *axis;         ///< vec3s, ends of internodes of a drawn axis; owned; NULL
} FrGraphEdit;

static inline const FrGraphEdit *fr_graph_edit(const FrPgraph *graph, uint32_t edit) {
    return &g_array_index(graph->edits, FrGraphEdit, edit);
}

void fr_graph_edit_clear(gpointer edit);
/// The ends of the internodes of a drawn axis (vec3s), NULL if its text is wrong.
GArray *fr_drawn_axis(const char *points);
/// What a build depends on besides its parameters.
FrDigest fr_edits_digest(FrDigest digest, const FrPgraph *graph);
/// Warns of edits that found no place, or lost it to a later edit of the same path, which is noted
/// in `places` (FrEditPlace), and of those that say what nothing there reads.
void fr_edits_report(const FrPgraph *graph, uint8_t *places, FrDiags *diags);
