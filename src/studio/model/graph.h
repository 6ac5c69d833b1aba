/// @file graph.h
/// A p-graph as it is drawn: boxes for components, wires for links, and where they stand.
#pragma once

#include "frond/pgraph.h"
#include "studio/model/document.h"

typedef struct StudioBox {
    uint32_t element; ///< of the contents
    char *id;
    FrComponentKind kind;
    double column, row; ///< of its middle; a box is 1 wide and 1 high
    bool is_enabled;
    bool is_recursive; ///< it follows upon itself
    bool is_reached;   ///< something leads to it, or everything begins at it
} StudioBox;

typedef struct StudioWire {
    uint32_t element;  ///< of the contents
    uint32_t from, to; ///< boxes
    FrLinkKind kind;
    bool is_tree; ///< one of those the layout goes by; others run back or across
} StudioWire;

typedef struct StudioGraph {
    GArray *boxes; ///< StudioBox
    GArray *wires; ///< StudioWire
    double columns, rows;
} StudioGraph;

/// What a component's number of instances, and their time, says.
typedef enum StudioLoad { STUDIO_LOAD_NOTHING, STUDIO_LOAD_FINE, STUDIO_LOAD_HEAVY } StudioLoad;

/// What one component may have and take at most; 0: anything is fine.
typedef struct StudioBudget {
    uint64_t instances;
    double seconds;
} StudioBudget;

/// More than this is worth a word, unless the user says otherwise.
enum { STUDIO_USUAL_BUDGET = 250000, STUDIO_USUAL_MILLISECONDS = 100 };

/// `seconds` NAN: unknown.
StudioLoad studio_load_of(uint64_t instances, double seconds, const StudioBudget *budget);
/// "38 ms", "1.2 s", short enough for a box; "" below a millisecond or for NAN. Free with g_free().
char *studio_time_text(double seconds);
/// The graph of a plant; empty if it has none. Laid out as a tidy tree: parents above the middle of
/// their children, in the order of the document, no two boxes in one place.
StudioGraph *studio_graph_new(const FrContents *contents, uint32_t plant);
void studio_graph_free(StudioGraph *graph);
const StudioBox *studio_graph_box(const StudioGraph *graph, uint32_t box);
const StudioWire *studio_graph_wire(const StudioGraph *graph, uint32_t wire);
/// FR_NONE: there is none of that id.
uint32_t studio_graph_find(const StudioGraph *graph, const char *id);
