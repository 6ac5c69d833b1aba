/// @file sketch_panel_private.h
/// What the files of the sketch panel share.
#pragma once

#include "studio/model/builder.h"
#include "studio/model/sketch_shape.h"
#include "studio/model/sketcher.h"
#include "studio/sketch_board.h"
#include "studio/sketch_device.h"
#include "studio/sketch_panel.h"
#include "studio/sketch_sheet.h"
#include "studio/sketch_view.h"
#include "studio/viewport.h"

enum { MOST_INSTANCES = 24, MOST_INTERNODES = 60000, MOST_LEAVES = 20000 };

typedef enum SketchTool { TOOL_PAINT, TOOL_PATH, TOOL_TURN } SketchTool;

struct _StudioSketchPanel {
    GtkBox parent;
    StudioDocument *document; // borrowed; NULL: not sketching
    StudioSketchOf of;
    char *last;  // the variation that was sketched before; NULL
    bool is_new; // the next stroke begins another variation
    GActionMap *actions;

    StudioSketcher *sketcher;
    gint is_woken;        // atomic
    uint64_t asked;       // serial number
    StudioSketched *done; // the last that came; NULL
    StudioBase *base;     // the plant that is shown; NULL
    StudioBuilder *builder;
    gint is_built;     // atomic: the builder has something
    uint64_t revision; // of what was asked of the builder
    uint64_t built;    // what came of it
    double strength;   // of indicators, while they play
    bool is_playing;
    guint seed;          // of the first instance
    guint chosen, count; // instances
    bool is_sheet, is_whole;

    FrSelection *selection; // of the base
    uint8_t *states;        // of its axes
    StudioChosen kind;
    uint32_t component; // of the base
    SketchTool tool;
    FrApply apply;
    StudioPen pen;
    bool keeps_path;
    FrIdBuffer *seen;  // while it is painted over
    uint32_t path_end; // the first end of a path; FR_NONE
    StudioDevice *device;
    bool is_framed;  // the strokes were shown from where all is seen
    bool is_showing; // widgets are being set

    GtkWidget *variation, *drawn, *growth, *growth_rows, *marks;
    GtkWidget *problem, *problem_text, *work, *pages, *outer, *inner;
    GtkWidget *instances, *branches, *height, *height_text, *hint, *device_button;
    StudioSketchView *strokes, *skeleton;
    StudioSketchBoard *board;
    StudioSketchSheet *sheet;
    StudioViewport *viewport;
};

// sketch_panel.c

void studio_sketch_say(StudioSketchPanel *panel, const char *text);
/// The contents of the document; NULL.
const FrContents *studio_sketch_contents(StudioSketchPanel *panel);
/// Asks for instances, and for their whole geometry where it is shown.
void studio_sketch_ask(StudioSketchPanel *panel);
/// How far apart instances stand, in metres.
double studio_sketch_step(StudioSketchPanel *panel);

// sketch_choose.c: what is chosen in the skeleton

/// Another plant is shown: nothing is chosen.
void studio_sketch_take_base(StudioSketchPanel *panel, StudioBase *base);
/// The choice has changed: shows it, and brings the board to it.
void studio_sketch_chosen(StudioSketchPanel *panel);
/// The branches chosen as a document has them, NULL: none. Free with g_free().
char *studio_sketch_choice(StudioSketchPanel *panel);
void studio_sketch_clear(StudioSketchPanel *panel);
void studio_sketch_choose_kind(StudioSketchPanel *panel, guint item);
void studio_sketch_on_pen(StudioSketchView *view, int phase, double x, double y,
                          StudioSketchPanel *panel);
gboolean studio_sketch_on_key(StudioSketchView *view, guint key, gboolean *is_taken,
                              StudioSketchPanel *panel);

// sketch_show.c: what the panes show

void studio_sketch_show_skeleton(StudioSketchPanel *panel);
void studio_sketch_show_instances(StudioSketchPanel *panel);
void studio_sketch_show_height(StudioSketchPanel *panel);
/// The lists of variations, of what was drawn, and of the settings of growth.
void studio_sketch_show_lists(StudioSketchPanel *panel);
void studio_sketch_show_page(StudioSketchPanel *panel);
void studio_sketch_show_problem(StudioSketchPanel *panel);

// sketch_parts.c

void studio_sketch_make(StudioSketchPanel *panel);

// sketch_actions.c

void studio_sketch_add_actions(StudioSketchPanel *panel);
/// The pen has drawn something on the board.
void studio_sketch_on_drawn(StudioSketchBoard *board, StudioSketchPanel *panel);
