#include "studio/scene_tool_private.h"

#include <math.h>
#include <string.h>

static const SceneToolKind kinds[SCENE_TOOL_COUNT] = {
    {"select", "studio-tool-select-symbolic", "Choose branches and leaves (Esc)", "",
     GDK_KEY_Escape},
    {"move", "studio-tool-move-symbolic", "Move, turn and size what stands (M)",
     "Click a plant or an obstacle, then drag its handles, or use arrows, "
     "[ ] and + −; Delete takes it out",
     GDK_KEY_m},
    {"plant", "studio-tool-plant-symbolic", "Plant (P)",
     "Click the ground to plant; Enter plants below the pointer", GDK_KEY_p},
    {"paint", "studio-tool-paint-symbolic", "Paint plants with a brush (B)",
     "Drag over the ground; the right button moves the view, arrows turn it", GDK_KEY_b},
    {"take-out", "studio-tool-take-out-symbolic", "Take plants out of the scene (X)",
     "Drag over plants; those of rows and areas go one by one, too", GDK_KEY_x},
    {"obstacle", "studio-tool-obstacle-symbolic", "Add an obstacle (O)",
     "Click where it shall stand", GDK_KEY_o},
    {"road", "studio-tool-road-symbolic", "Draw a road (R)",
     "Draw its line over the ground; plants keep off it", GDK_KEY_r},
    {"envelope", "studio-tool-envelope-symbolic", "Draw the envelope of a species (E)",
     "Draw one side of the outline that the crown shall keep within, "
     "beside the dashed axis",
     GDK_KEY_e},
};

static const double foot_pixels = 14;

const SceneToolKind *studio_scene_kind(SceneTool tool) {
    return &kinds[tool];
}

// ---- what it sees ------------------------------------------------------------------------------

StudioEye studio_scene_eye(const StudioSceneTool *tool) {
    GtkWidget *viewport = GTK_WIDGET(tool->window->viewport);
    return (StudioEye){.camera = *studio_viewport_camera(tool->window->viewport),
                       .width = MAX(gtk_widget_get_width(viewport), 1),
                       .height = MAX(gtk_widget_get_height(viewport), 1)};
}

bool studio_scene_ground(const StudioSceneTool *tool, const double pixel[2], double at[3]) {
    if (tool->window->builder == NULL) {
        return false;
    }
    StudioEye eye = studio_scene_eye(tool);
    double origin[3], direction[3];
    studio_eye_ray(&eye, pixel, origin, direction);
    StudioGround *ground = studio_builder_ground(tool->window->builder);
    bool is_met = studio_ground_meet(ground, origin, direction, 200 * eye.camera.distance, at);
    studio_ground_unref(ground);
    double min[3], max[3];
    studio_viewport_bounds(tool->window->viewport, min, max);
    const double *target = eye.camera.target;
    return is_met && hypot(at[0] - target[0], at[1] - target[1]) <=
                         studio_ground_reach(eye.camera.distance, min, max);
}

void studio_scene_say_no_ground(StudioSceneTool *tool) {
    studio_window_say(tool->window,
                      "There is no ground here, or too far away: look down, or go there");
}

static StudioHit hit_at(const StudioSceneTool *tool, const double pixel[2]) {
    StudioEye eye = studio_scene_eye(tool);
    double origin[3], direction[3];
    studio_eye_ray(&eye, pixel, origin, direction);
    double spread = 6 * tan(0.5 * eye.camera.field_of_view) / eye.height;
    return studio_builder_hit(tool->window->builder, origin, direction, spread);
}

uint32_t studio_scene_element(const StudioSceneTool *tool, uint32_t origin) {
    const StudioWindow *window = tool->window;
    const FrContents *contents = studio_document_contents(window->document);
    bool is_current = window->shown == studio_document_revision(window->document);
    return origin == 0 || !is_current || contents == NULL
               ? FR_NONE
               : fr_contents_around(contents, origin, NULL);
}

uint32_t studio_scene_species(const StudioSceneTool *tool, double foot[3]) {
    StudioWindow *window = tool->window;
    const FrContents *contents = studio_document_contents(window->document);
    uint32_t selected = studio_window_selected(window);
    uint32_t plant = studio_window_plant(window);
    foot[0] = foot[1] = foot[2] = 0;
    StudioStanding standing;
    char *id = selected == FR_NONE ? NULL : fr_contents_get(contents, selected, "plant");
    if (id != NULL && studio_standing_read(window->document, selected, &standing)) {
        plant = fr_contents_find(contents, 0, id);
        StudioGround *ground = studio_builder_ground(window->builder);
        studio_gizmo_pivot(ground, &standing, foot);
        studio_ground_unref(ground);
    }
    g_free(id);
    if (!studio_scene_is_species(window->document, plant)) {
        plant = fr_contents_child(contents, 0, "plant");
        while (plant != FR_NONE && !studio_scene_is_species(window->document, plant)) {
            plant = fr_contents_sibling(contents, plant);
        }
    }
    return plant;
}

// ---- clicks ------------------------------------------------------------------------------------

// No more digits than the eye can tell.
double studio_scene_rounded(const StudioSceneTool *tool, double value) {
    double step = studio_camera_step(studio_viewport_camera(tool->window->viewport), 0.002);
    return round(value / step) * step;
}

static bool plant_at(StudioSceneTool *tool, const double at[3]) {
    StudioDocument *document = tool->window->document;
    static const char key[] = "plant"; // what a preset brings along is part of the same step
    studio_document_seal(document);
    char *plant = studio_scene_chosen_plant(tool, key);
    StudioSpot spot = {.at = {studio_scene_rounded(tool, at[0]), studio_scene_rounded(tool, at[1])},
                       .turn = floor(360 * g_random_double()),
                       .scale = 1,
                       .seed = -1};
    bool is_planted = plant != NULL && studio_plant(document, plant, &spot, 1, key);
    studio_document_seal(document);
    if (is_planted) {
        studio_window_select(tool->window, studio_scene_last(document, "place"));
    } else {
        studio_window_say(tool->window, "There is nothing to plant, or the text is not right");
    }
    g_free(plant);
    return is_planted;
}

static bool stand_obstacle(StudioSceneTool *tool, const double at[3]) {
    static const char *const shapes[] = {"box", "sphere", "cylinder", "cone"};
    guint shape = gtk_drop_down_get_selected(GTK_DROP_DOWN(tool->shape));
    if (shape >= G_N_ELEMENTS(shapes)) {
        studio_scene_ask_mesh(tool, at);
        return true;
    }
    double side = studio_camera_step(studio_viewport_camera(tool->window->viewport), 0.14);
    const double size[3] = {side, side, side};
    const double where[3] = {studio_scene_rounded(tool, at[0]), studio_scene_rounded(tool, at[1]),
                             studio_scene_rounded(tool, at[2])};
    StudioDocument *document = tool->window->document;
    if (studio_add_obstacle(document, shapes[shape], where, size, NULL)) {
        studio_window_select(tool->window, studio_scene_last(document, "obstacle"));
        return true;
    }
    return false;
}

// A seed is too small to be met: what stands within a few pixels.
static StudioHit seed_near(const StudioSceneTool *tool, const double pixel[2]) {
    StudioEye eye = studio_scene_eye(tool);
    GArray *stands = studio_builder_stands(tool->window->builder);
    StudioHit found = {.kind = STUDIO_HIT_NOTHING};
    double nearest = foot_pixels;
    for (guint i = 0; i < stands->len; i++) {
        const StudioStand *stand = &g_array_index(stands, StudioStand, i);
        double foot[2];
        if (studio_eye_project(&eye, stand->at, foot)) {
            double away = hypot(foot[0] - pixel[0], foot[1] - pixel[1]);
            if (away < nearest && stand->origin != 0) {
                found = (StudioHit){.kind = STUDIO_HIT_PLANT,
                                    .foot = {stand->at[0], stand->at[1], stand->at[2]},
                                    .origin = stand->origin,
                                    .number = stand->number};
                nearest = away;
            }
        }
    }
    g_array_unref(stands);
    return found;
}

static void grab(StudioSceneTool *tool, const double pixel[2]) {
    StudioWindow *window = tool->window;
    StudioHit hit = hit_at(tool, pixel);
    if (hit.kind != STUDIO_HIT_PLANT && hit.kind != STUDIO_HIT_OBSTACLE) {
        hit = seed_near(tool, pixel);
    }
    if (hit.kind == STUDIO_HIT_PLANT && hit.origin == 0 && studio_place_first(window->document)) {
        studio_window_select(window, studio_scene_last(window->document, "place"));
        return;
    }
    bool is_thing = hit.kind == STUDIO_HIT_PLANT || hit.kind == STUDIO_HIT_OBSTACLE;
    uint32_t element = is_thing ? studio_scene_element(tool, hit.origin) : FR_NONE;
    studio_window_select(window, element);
    studio_scene_set_one(tool, element, hit.number, hit.foot);
}

bool studio_scene_act(StudioSceneTool *tool, const double pixel[2]) {
    double at[3];
    if (tool->window->document == NULL || tool->tool == SCENE_SELECT) {
        return false;
    }
    if (tool->tool == SCENE_MOVE) {
        grab(tool, pixel);
    } else if (tool->tool == SCENE_PLANT || tool->tool == SCENE_OBSTACLE) {
        if (!studio_scene_ground(tool, pixel, at)) {
            studio_scene_say_no_ground(tool);
        } else if (tool->tool == SCENE_PLANT) {
            plant_at(tool, at);
        } else {
            stand_obstacle(tool, at);
        }
    } else {
        studio_scene_stroke_begin(tool, pixel);
        studio_scene_stroke_go(tool, pixel);
        studio_scene_stroke_end(tool);
    }
    return true;
}

bool studio_scene_tool_click(StudioSceneTool *tool, double x, double y) {
    StudioEye eye = studio_scene_eye(tool);
    const double pixel[2] = {0.5 * (1 + x) * eye.width, 0.5 * (1 - y) * eye.height};
    if (tool->tool == SCENE_SELECT) { // an obstacle has no branches to choose from
        StudioHit hit = tool->window->builder == NULL ? (StudioHit){0} : hit_at(tool, pixel);
        uint32_t element =
            hit.kind == STUDIO_HIT_OBSTACLE ? studio_scene_element(tool, hit.origin) : FR_NONE;
        if (element != FR_NONE) {
            studio_window_select(tool->window, element);
        }
        return element != FR_NONE;
    }
    return studio_scene_act(tool, pixel);
}

bool studio_scene_nudge(StudioSceneTool *tool, guint key, GdkModifierType state) {
    if (tool->tool != SCENE_MOVE || !tool->has_standing) {
        return false;
    }
    StudioWindow *window = tool->window;
    StudioStanding to = tool->standing;
    double step = studio_camera_step(studio_viewport_camera(window->viewport), 0.02);
    bool is_up = (state & GDK_SHIFT_MASK) != 0;
    double right = key == GDK_KEY_Right ? step : key == GDK_KEY_Left ? -step : 0;
    double away = key == GDK_KEY_Up ? step : key == GDK_KEY_Down ? -step : 0;
    double azimuth = studio_viewport_camera(window->viewport)->azimuth;
    double quarter = round(azimuth / (0.5 * G_PI)) * 0.5 * G_PI; // along the axis that is nearest
    to.at[0] += right * cos(quarter) - (is_up ? 0 : away) * sin(quarter);
    to.at[1] += right * sin(quarter) + (is_up ? 0 : away) * cos(quarter);
    to.at[2] += is_up ? away : 0;
    bool is_sized = key == GDK_KEY_plus || key == GDK_KEY_KP_Add || key == GDK_KEY_equal;
    bool is_shrunk = key == GDK_KEY_minus || key == GDK_KEY_KP_Subtract;
    to.turn += key == GDK_KEY_bracketleft ? 15 : key == GDK_KEY_bracketright ? -15 : 0;
    to.scale *= is_sized ? 1.1 : is_shrunk ? 1 / 1.1 : 1;
    bool is_known = right != 0 || away != 0 || is_sized || is_shrunk ||
                    key == GDK_KEY_bracketleft || key == GDK_KEY_bracketright;
    if (is_known) {
        studio_standing_move(window->document, studio_window_selected(window), &tool->standing, &to,
                             NULL);
    }
    return is_known;
}

// ---- the tool ----------------------------------------------------------------------------------

// Sizes that suit what is seen of a document when a tool is first chosen.
static void suit_sizes(StudioSceneTool *tool) {
    static const double plants = 8; // below the brush
    double radius = studio_camera_step(studio_viewport_camera(tool->window->viewport), 0.15);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(tool->radius), radius);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(tool->density),
                              round(100 * plants / (G_PI * radius * radius)));
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(tool->width), radius);
    tool->is_sized = true;
}

void studio_scene_choose(StudioSceneTool *tool, SceneTool which) {
    tool->tool = which;
    if (which > SCENE_MOVE && !tool->is_sized) {
        suit_sizes(tool);
    }
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(tool->window), "scene-tool");
    g_simple_action_set_state(G_SIMPLE_ACTION(action), g_variant_new_string(kinds[which].name));
    studio_scene_update_bars(tool);
    gtk_widget_queue_draw(tool->layer);
}

void studio_scene_tool_update(StudioSceneTool *tool) {
    StudioWindow *window = tool->window;
    bool is_there = window->document != NULL && studio_document_contents(window->document) != NULL;
    tool->has_standing =
        is_there && !studio_document_is_broken(window->document) &&
        studio_standing_read(window->document, studio_window_selected(window), &tool->standing);
    if (g_strcmp0(tool->one_of, window->selected) != 0) {
        g_clear_pointer(&tool->one_of, g_free);
    }
    studio_scene_update_bars(tool);
    gtk_widget_queue_draw(tool->layer);
}

void studio_scene_tool_reset(StudioSceneTool *tool) {
    tool->held = STUDIO_GRIP_NONE;
    tool->has_standing = tool->is_sized = false;
    g_clear_pointer(&tool->line, g_array_unref);
    g_clear_pointer(&tool->taken, g_array_unref);
    g_clear_pointer(&tool->ones, g_array_unref);
    g_clear_pointer(&tool->one_of, g_free);
    studio_scene_choose(tool, SCENE_SELECT);
}

void studio_scene_tool_free(StudioSceneTool *tool) {
    if (tool != NULL) {
        g_clear_pointer(&tool->line, g_array_unref);
        g_clear_pointer(&tool->taken, g_array_unref);
        g_clear_pointer(&tool->ones, g_array_unref);
        g_ptr_array_unref(tool->plants);
        g_free(tool->one_of);
        g_free(tool->key);
        g_free(tool);
    }
}

StudioSceneTool *studio_scene_tool_new(StudioWindow *window, GtkOverlay *overlay) {
    StudioSceneTool *tool = g_new0(StudioSceneTool, 1);
    tool->window = window;
    tool->plants = g_ptr_array_new_with_free_func(g_free);
    studio_scene_add_actions(tool);
    studio_scene_add_one_actions(tool);
    tool->layer = studio_scene_layer_new(tool);
    gtk_overlay_add_overlay(overlay, tool->layer);
    studio_scene_add_bars(tool, overlay);
    studio_scene_listen(tool);
    return tool;
}
