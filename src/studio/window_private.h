/// @file window_private.h
/// What the files of the window share.
#pragma once

#include "studio/files.h"
#include "studio/fold_box.h"
#include "studio/graph_panel.h"
#include "studio/inspector.h"
#include "studio/levels_panel.h"
#include "studio/light_mode.h"
#include "studio/messages.h"
#include "studio/model/builder.h"
#include "studio/model/carry.h"
#include "studio/model/commands.h"
#include "studio/model/hand.h"
#include "studio/model/place.h"
#include "studio/patch_mode.h"
#include "studio/picture.h"
#include "studio/scene_tool.h"
#include "studio/sketch_panel.h"
#include "studio/string_panel.h"
#include "studio/text_panel.h"
#include "studio/things_panel.h"
#include "studio/time_strip.h"
#include "studio/viewport.h"
#include "studio/window.h"

struct _StudioWindow {
    AdwApplicationWindow parent;
    StudioSettings *settings;
    StudioDocument *document; ///< NULL: the welcome page
    StudioRecovery *recovery;
    StudioBuilder *builder;
    char *selected;                            ///< place of what the inspector shows; NULL
    char *plant;                               ///< place of the plant the graph shows; NULL
    FrDiags *diags;                            ///< of the last build; NULL
    StudioTimes times;                         ///< of the last build
    uint64_t asked, shown;                     ///< revisions
    StudioMoment moment, asked_moment;         ///< of what is shown
    gint64 asked_time, first_seen, whole_seen; ///< of the last request: when, and when drawn; µs
    guint autosave, progress;                  ///< timers
    gint is_woken;                             ///< atomic: the main thread is on its way
    StudioPicked picked;                       ///< what was clicked last; `lines` NULL: nothing
    guint exports;                             ///< that run
    bool is_closing;                           ///< the user has said what shall become of changes

    GtkWidget *stack; ///< "welcome", "document"
    AdwWindowTitle *title;
    StudioMessages *over_picture, *over_all; ///< the second where no picture is in sight
    StudioFoldBox *panes;
    GtkWidget *undo, *redo, *save_button, *welcome_hidden[7];
    StudioViewport *viewport;
    GtkWidget *side; ///< stack of graph, things and text
    StudioGraphPanel *graph;
    StudioThingsPanel *things;
    StudioTextPanel *text, *lsystem;
    StudioStringPanel *string;
    StudioInspector *inspector;
    StudioLevelsPanel *levels; ///< above the inspector
    StudioTimeStrip *strip;
    StudioLightMode *light;
    StudioSketchPanel *sketch;
    StudioSceneTool *scene;
    StudioPatchMode *patch;
    GtkWidget *picked_bar, *picked_text;
    GtkWidget *amount, *problem, *problem_text, *busy, *busy_text, *busy_bar, *scale;
};

// window_build.c

/// Asks for what is shown to be built, if it is not already.
void studio_window_request(StudioWindow *window);
/// Connects the builder; called once.
void studio_window_start_builder(StudioWindow *window);
/// Shows how far the builder is until it is done.
void studio_window_poll(StudioWindow *window);
/// A StudioWake, whose user is the window.
void studio_window_wake(void *user);
/// Takes what the builder has made.
void studio_window_collect(StudioWindow *window);
/// Lets the user pick what stands at a point of the picture.
void studio_window_pick(StudioWindow *window, double x, double y);
/// Nothing is picked any more.
void studio_window_unpick(StudioWindow *window);
/// Edits what is picked by hand: an attribute that becomes "yes", and the name of the step.
void studio_window_edit_picked(StudioWindow *window, const char *attribute, const char *name);

// window_actions.c

void studio_window_add_actions(StudioWindow *window);
/// Enables what can be done now.
void studio_window_update_actions(StudioWindow *window);
/// The id of the component that is selected; NULL: none is.
const char *studio_window_component(StudioWindow *window);
/// Selects a component of the plant that is shown by its id.
void studio_window_select_component(StudioWindow *window, const char *id);

// window_presets.c

void studio_window_add_preset_actions(StudioWindow *window);
/// The text of a preset, of whose files those that `elements` of it name are beside the document
/// now; without a source after a message. Undo it where it is not put in; clear it.
StudioCarried studio_window_bring(StudioWindow *window, const char *name,
                                  GHashTable *(*elements)(const FrContents *));

// window.c

/// Shows an element in the inspector, the graph and the list; FR_NONE: nothing.
void studio_window_select(StudioWindow *window, uint32_t element);
/// Says that something is gone, and offers to undo that.
void studio_window_say_removed(StudioWindow *window, const char *text);
/// Of panels that have a signal "said".
void studio_window_on_said(GObject *panel, const char *text, StudioWindow *window);
uint32_t studio_window_selected(const StudioWindow *window);
/// The plant that the graph shows; FR_NONE.
uint32_t studio_window_plant(const StudioWindow *window);
/// Goes to the place of the first problem.
void studio_window_show_problem(StudioWindow *window);
/// Shows the text of the document, and of the L-system that its plant is.
void studio_window_show_texts(StudioWindow *window);
/// Shows or hides what is wrong.
void studio_window_update_problem(StudioWindow *window);

// window_parts.c

/// Shows or hides a bar over the picture; one that is hidden lets clicks through.
void studio_window_reveal(GtkWidget *revealer, bool is_shown);
/// What a component may have and take, by the preferences.
StudioBudget studio_window_budget(StudioWindow *window);
GtkWidget *studio_window_make_header(StudioWindow *window);
GtkWidget *studio_window_make_panes(StudioWindow *window);

// window_panes.c

/// Makes what has the picture between a panel and the inspector, and the actions that fold these.
GtkWidget *studio_window_fold_panes(StudioWindow *window, GtkWidget *side, GtkWidget *middle,
                                    GtkWidget *inspector);
/// Unfolds a pane that is needed now.
void studio_window_ask_pane(StudioWindow *window, StudioPane pane);
/// Writes widths, and which panes are wanted, to the settings.
void studio_window_remember_panes(StudioWindow *window);

// window_picture.c

/// Asks where the view shall be saved as a picture, and how large.
void studio_window_ask_picture(StudioWindow *window);

// window_cancel.c

/// Lets Escape take back what a pressed pointer does.
void studio_window_add_cancel(StudioWindow *window);

// window_sketch.c

/// Makes the page of the sketch mode and its actions.
void studio_window_add_sketch(StudioWindow *window);
/// Whether branches are being drawn: then nothing is built but what that shows.
bool studio_window_is_sketching(StudioWindow *window);
/// The document goes: ends it.
void studio_window_forget_sketch(StudioWindow *window);

// welcome.c

GtkWidget *studio_welcome_new(StudioWindow *window);

// export.c

/// One plant of the scene.
typedef struct StudioOne {
    uint32_t origin, number; ///< as in FrStand
    char *name;              ///< for a file: "oak", "row-3"
} StudioOne;

/// `one` NULL: all plants.
void studio_window_export(StudioWindow *window, const StudioOne *one);
/// Writes a model without asking, in the format of the file's ending.
void studio_window_export_to(StudioWindow *window, const StudioOne *one, const char *path);

// dialogs.c

void studio_window_show_preferences(StudioWindow *window);
void studio_window_show_shortcuts(StudioWindow *window);
void studio_window_show_about(StudioWindow *window);
/// Asks whether to save; then closes.
void studio_window_ask_and_close(StudioWindow *window);
