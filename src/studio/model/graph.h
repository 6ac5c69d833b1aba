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
    uint32_t line;      ///< where each box and repeat has a line of its own, below what it hangs on
    bool is_enabled;
    bool is_recursive; ///< it follows upon itself, at once or by way of others
    bool is_reached;   ///< something leads to it, or everything begins at it
    uint32_t depth;    ///< how often it may follow upon itself; 0: not known as a plain number
} StudioBox;

typedef struct StudioWire {
    uint32_t element;  ///< of the contents
    uint32_t from, to; ///< boxes
    FrLinkKind kind;
    bool is_tree;     ///< one of those the layout goes by; others run back or across
    bool is_repeated; ///< part of a recursion
    uint32_t again;   ///< where a recursion is closed: the repeat it ends at, else FR_NONE
} StudioWire;

/// The first component of a recursion, shown once more at its end.
typedef struct StudioRepeat {
    uint32_t box;       ///< that it stands for
    double column, row; ///< as of a box
    uint32_t line;
    uint32_t depth; ///< how often the recursion goes round; 0: not known
} StudioRepeat;

typedef struct StudioGraph {
    GArray *boxes;   ///< StudioBox
    GArray *wires;   ///< StudioWire
    GArray *repeats; ///< StudioRepeat
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
enum { STUDIO_USUAL_BUDGET = 250000, STUDIO_USUAL_MILLISECONDS = 250 };

/// `seconds` NAN: unknown.
StudioLoad studio_load_of(uint64_t instances, double seconds, const StudioBudget *budget);
/// "38 ms", "1.2 s", short enough for a box; "" below a millisecond or for NAN. Free with g_free().
char *studio_time_text(double seconds);
/// A graph of nothing.
StudioGraph *studio_graph_empty(void);
/// The graph of a plant; empty if it has none. Laid out as a tidy tree: parents above the middle of
/// their children and repeats, in the order of the document, no two in one place; and as an
/// outline, by lines, where boxes are indented by their rows.
StudioGraph *studio_graph_new(const FrContents *contents, uint32_t plant);
void studio_graph_free(StudioGraph *graph);
const StudioBox *studio_graph_box(const StudioGraph *graph, uint32_t box);
const StudioWire *studio_graph_wire(const StudioGraph *graph, uint32_t wire);
const StudioRepeat *studio_graph_repeat(const StudioGraph *graph, uint32_t repeat);
/// "again, 5 deep". Free with g_free().
char *studio_repeat_words(const StudioRepeat *repeat);
/// FR_NONE: there is none of that id.
uint32_t studio_graph_find(const StudioGraph *graph, const char *id);
