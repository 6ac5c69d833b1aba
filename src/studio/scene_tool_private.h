/// @file scene_tool_private.h
/// What the files of the scene's tools share.
#pragma once

#include "studio/model/brush.h"
#include "studio/model/drawn_line.h"
#include "studio/model/gizmo.h"
#include "studio/model/scene_edit.h"
#include "studio/scene_tool.h"
#include "studio/window_private.h"

typedef enum SceneTool {
    SCENE_SELECT,
    SCENE_MOVE,
    SCENE_PLANT,
    SCENE_PAINT,
    SCENE_TAKE_OUT,
    SCENE_OBSTACLE,
    SCENE_ROAD,
    SCENE_ENVELOPE,
    SCENE_TOOL_COUNT,
} SceneTool;

/// Groups of options: those of tools, of one plant of a row, of any plant.
enum { SCENE_GROUP_ONE = 5, SCENE_GROUP_EXPORT, SCENE_GROUP_COUNT };

typedef struct SceneToolKind {
    const char *name, *icon, *tip, *hint;
    guint key;
} SceneToolKind;

struct StudioSceneTool {
    StudioWindow *window;
    SceneTool tool;
    GtkWidget *layer, *hint, *groups[SCENE_GROUP_COUNT], *one_label;
    GtkWidget *what, *radius, *density, *shape, *width, *bar;
    GPtrArray *plants; ///< names of what can be planted; presets begin with "preset:"

    double hover[2]; ///< pointer in the viewport, pixels
    bool is_hovering, is_drawing;
    bool is_sized;      ///< brush and road suit the document
    StudioCamera drawn; ///< what the layer was drawn with

    char *one_of; ///< place of the row or area of which one plant was clicked; NULL
    uint32_t one; ///< its number
    double one_at[3];
    GArray *ones; ///< plants of rows and areas, while a brush takes out

    bool has_standing; ///< what is selected can be moved
    StudioStanding standing;
    StudioGrip over, held;
    StudioStanding grabbed, written;
    double begin[2];  ///< of a drag
    bool is_stepped;  ///< Ctrl is down
    bool is_straight; ///< Shift is down
    bool is_copy_due; ///< Alt was down when the drag began, and nothing has been copied yet

    char *key; ///< of the stroke, for undo
    uint64_t strokes, dabs;
    double last[2];   ///< point of a line, pixels
    double dabbed[3]; ///< where the last dab was
    GArray *taken;    ///< double[2], where plants stand, while painting
    GArray *line;     ///< double[3] of a road, double[2] of an envelope
    double foot[3];   ///< of the axis that an envelope is drawn about
};

// scene_tool.c

const SceneToolKind *studio_scene_kind(SceneTool tool);
void studio_scene_choose(StudioSceneTool *tool, SceneTool which);
StudioEye studio_scene_eye(const StudioSceneTool *tool);
/// Where the pointer meets the ground; false: nowhere, or too far away for what is seen.
bool studio_scene_ground(const StudioSceneTool *tool, const double pixel[2], double at[3]);
/// Says that it does not.
void studio_scene_say_no_ground(StudioSceneTool *tool);
/// A coordinate, as exactly as the eye can tell.
double studio_scene_rounded(const StudioSceneTool *tool, double value);
/// The plant whose envelope is drawn, and the foot of its axis; FR_NONE.
uint32_t studio_scene_species(const StudioSceneTool *tool, double foot[3]);
/// The element of the document that begins at a byte; FR_NONE while the picture is an older one.
uint32_t studio_scene_element(const StudioSceneTool *tool, uint32_t origin);
/// Does what a click would do at a pixel.
bool studio_scene_act(StudioSceneTool *tool, const double pixel[2]);
/// Moves, turns and scales what is selected by keys; false: the key is none of those.
bool studio_scene_nudge(StudioSceneTool *tool, guint key, GdkModifierType state);

// scene_stroke.c

void studio_scene_stroke_begin(StudioSceneTool *tool, const double pixel[2]);
void studio_scene_stroke_go(StudioSceneTool *tool, const double pixel[2]);
void studio_scene_stroke_end(StudioSceneTool *tool);
/// The point on the upright plane through an axis that faces the camera: radius, height.
bool studio_scene_on_profile(const StudioSceneTool *tool, const double pixel[2], double at[2]);

// scene_one.c

/// The plant of a row or an area (the element) that was clicked; another element: none.
void studio_scene_set_one(StudioSceneTool *tool, uint32_t element, uint32_t number,
                          const double at[3]);
void studio_scene_add_one_actions(StudioSceneTool *tool);
/// What can be done with it.
GtkWidget *studio_scene_one_bar(StudioSceneTool *tool);
/// Whether one plant is chosen: of a row or an area, or a place.
bool studio_scene_is_one(const StudioSceneTool *tool);
/// What can be done with it wherever it stands.
GtkWidget *studio_scene_export_bar(void);
/// All plants of rows and areas; free with g_array_unref().
GArray *studio_scene_ones(const StudioSceneTool *tool);
/// Leaves out those of them within a radius.
void studio_scene_leave_out(StudioSceneTool *tool, const double at[3], double radius);

// scene_input.c

/// Connects the pointer and the keys of the viewport.
void studio_scene_listen(StudioSceneTool *tool);

// scene_layer.c

GtkWidget *studio_scene_layer_new(StudioSceneTool *tool);

// scene_bar.c

/// The palette at the left of the picture and the options below it.
void studio_scene_add_bars(StudioSceneTool *tool, GtkOverlay *overlay);
/// Lists what can be planted, if that has changed, and shows the options of the tool.
void studio_scene_update_bars(StudioSceneTool *tool);
/// What the tool, or the handle below the pointer, is for.
void studio_scene_show_hint(StudioSceneTool *tool);
/// The id of the plant to plant, taken over from its preset if need be, by a step of that key. Free
/// with g_free(); NULL.
char *studio_scene_chosen_plant(StudioSceneTool *tool, const char *key);

// scene_files.c

void studio_scene_add_actions(StudioSceneTool *tool);
/// Asks for a mesh and stands it at a place.
void studio_scene_ask_mesh(StudioSceneTool *tool, const double at[3]);
