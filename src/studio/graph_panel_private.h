/// @file graph_panel_private.h
/// What the files of the graph panel share.
#pragma once

#include "studio/component_icon.h"
#include "studio/graph_panel.h"
#include "studio/model/commands.h"
#include "studio/model/graph.h"

enum {
    BOX_WIDTH = 116,
    BOX_HEIGHT = 36,
    GAP_X = 14,
    GAP_Y = 34,
    INDENT = 28, // of an outline
    GAP_LINE = 12,
    PAD = 16,
    TOOL = 34,
    TOOL_PAD = 10,
    CLICK = 5,
    WIRE_GRAB = 7,
    TOOL_PRESET = FR_COMPONENT_COUNT, ///< behind the kinds of components
    TOOL_END,
};

/// What a component has, and how many seconds that takes.
typedef struct Load {
    uint64_t instances;
    double seconds, skin_seconds; // of these
} Load;

typedef enum DragKind { DRAG_NOTHING, DRAG_TOOL, DRAG_BOX, DRAG_CANVAS } DragKind;

struct _StudioGraphPanel {
    GtkWidget parent;
    StudioDocument *document; // borrowed
    uint32_t plant;
    uint32_t selected; // element
    StudioGraph *graph;
    GHashTable *counts;      // id → Load; NULL: not known
    StudioBudget budget;     // as in studio_load_of()
    double shift_x, shift_y; // of the graph within the panel
    DragKind drag;
    uint32_t held;   // tool or box
    bool is_dragged; // it is no click
    bool is_carried; // by keys
    double x, y;     // pointer
    uint32_t over;   // box under the pointer, FR_NONE
    GtkWidget *menu;
};

// graph_places.c

double studio_graph_tools_top(StudioGraphPanel *panel);
/// The height of the words above the tools.
double studio_graph_line(StudioGraphPanel *panel);
graphene_rect_t studio_graph_tool_rect(StudioGraphPanel *panel, guint kind);
/// How large the graph is drawn: smaller where there is little room, but never so small that it is
/// hard to read, larger where letters are.
double studio_graph_scale(StudioGraphPanel *panel);
graphene_rect_t studio_graph_box_rect(StudioGraphPanel *panel, uint32_t box);
graphene_rect_t studio_graph_repeat_rect(StudioGraphPanel *panel, uint32_t repeat);
/// Where a box stands, in boxes.
void studio_graph_stand(StudioGraphPanel *panel, const StudioBox *box, double *x, double *y);
/// Moves the graph by turns of a wheel, as far as there is more of it than is in sight.
void studio_graph_scroll(StudioGraphPanel *panel, double dx, double dy);
/// What a tool is called.
const char *studio_graph_tool_name(guint tool);
/// Moves the graph so far that the box of an element is in sight.
void studio_graph_reveal(StudioGraphPanel *panel, uint32_t element);
/// The ends of a wire, and its two bends between them.
void studio_graph_wire_course(StudioGraphPanel *panel, const StudioWire *wire, double at[4][2]);
// What is under a point: FR_NONE where there is nothing. A repeat stands for its box.
uint32_t studio_graph_box_under(StudioGraphPanel *panel, double x, double y);
uint32_t studio_graph_tool_under(StudioGraphPanel *panel, double x, double y);
uint32_t studio_graph_wire_under(StudioGraphPanel *panel, double x, double y);
/// Whether the pointer is where boxes are, and on none: not over the tools or another pane.
bool studio_graph_is_beside_boxes(StudioGraphPanel *panel);
/// What would come of a drop here, in words; NULL: nothing. Free with g_free().
char *studio_graph_words_of_drop(StudioGraphPanel *panel, bool *is_refused);

/// What is known of a box; NULL: nothing.
const Load *studio_graph_load(StudioGraphPanel *panel, const StudioBox *box);

// graph_draw.c

void studio_graph_draw(StudioGraphPanel *panel, GtkSnapshot *snapshot);

// graph_panel.c

/// Does what the drop of what is held would do here.
void studio_graph_drop(StudioGraphPanel *panel);
/// The menu of the selected box.
void studio_graph_popup(StudioGraphPanel *panel, double x, double y);

// graph_keys.c

void studio_graph_add_keys(StudioGraphPanel *panel);
/// Tells a screen reader what is selected, or what a drop would do.
void studio_graph_say(StudioGraphPanel *panel);
