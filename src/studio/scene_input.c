/// The pointer and the keys of the scene's tools, taken before the viewport turns its view by them.
#include "studio/scene_tool_private.h"
#include "studio/widgets.h"

#include <string.h>

static bool draws(const StudioSceneTool *tool) {
    return tool->tool == SCENE_PAINT || tool->tool == SCENE_TAKE_OUT || tool->tool == SCENE_ROAD ||
           tool->tool == SCENE_ENVELOPE;
}

static bool can_edit(const StudioSceneTool *tool) {
    const StudioWindow *window = tool->window;
    return window->document != NULL && window->builder != NULL &&
           studio_document_contents(window->document) != NULL &&
           !studio_document_is_broken(window->document);
}

static StudioGrip handle_at(const StudioSceneTool *tool, const double pixel[2]) {
    if (!tool->has_standing || draws(tool)) {
        return STUDIO_GRIP_NONE;
    }
    StudioEye eye = studio_scene_eye(tool);
    StudioGround *ground = studio_builder_ground(tool->window->builder);
    double pivot[3];
    studio_gizmo_pivot(ground, &tool->standing, pivot);
    studio_ground_unref(ground);
    StudioGizmo gizmo;
    return studio_gizmo_place(&eye, pivot, &tool->standing, &gizmo)
               ? studio_gizmo_under(&gizmo, pixel)
               : STUDIO_GRIP_NONE;
}

// ---- drags -------------------------------------------------------------------------------------

static void on_begin(GtkGestureDrag *gesture, double x, double y, StudioSceneTool *tool) {
    const double pixel[2] = {x, y};
    GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(gesture));
    tool->held = can_edit(tool) ? handle_at(tool, pixel) : STUDIO_GRIP_NONE;
    bool is_ours = tool->held != STUDIO_GRIP_NONE ||
                   (can_edit(tool) && (state & GDK_SHIFT_MASK) == 0 && draws(tool));
    if (!is_ours) {
        tool->held = STUDIO_GRIP_NONE;
        gtk_gesture_set_state(GTK_GESTURE(gesture), GTK_EVENT_SEQUENCE_DENIED);
        return;
    }
    gtk_gesture_set_state(GTK_GESTURE(gesture), GTK_EVENT_SEQUENCE_CLAIMED);
    gtk_widget_grab_focus(GTK_WIDGET(tool->window->viewport));
    tool->is_drawing = true;
    tool->is_copy_due = (state & GDK_ALT_MASK) != 0;
    studio_scene_stroke_begin(tool, pixel);
}

static void on_update(GtkGestureDrag *gesture, double x, double y, StudioSceneTool *tool) {
    double from_x, from_y;
    if (!tool->is_drawing || !gtk_gesture_drag_get_start_point(gesture, &from_x, &from_y)) {
        return;
    }
    GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(gesture));
    tool->is_stepped = (state & GDK_CONTROL_MASK) != 0;
    tool->is_straight = (state & GDK_SHIFT_MASK) != 0;
    const double pixel[2] = {from_x + x, from_y + y};
    memcpy(tool->hover, pixel, sizeof tool->hover);
    studio_scene_stroke_go(tool, pixel);
}

static void on_end(GtkGestureDrag *gesture, double x, double y, StudioSceneTool *tool) {
    (void)gesture;
    (void)x;
    (void)y;
    if (tool->is_drawing) {
        tool->is_drawing = false;
        studio_scene_stroke_end(tool);
    }
}

// ---- hovering ----------------------------------------------------------------------------------

static void on_motion(GtkEventControllerMotion *controller, double x, double y,
                      StudioSceneTool *tool) {
    (void)controller;
    tool->hover[0] = x;
    tool->hover[1] = y;
    tool->is_hovering = true;
    StudioGrip over =
        can_edit(tool) && !tool->is_drawing ? handle_at(tool, tool->hover) : tool->held;
    bool is_new = over != tool->over;
    tool->over = over;
    if (is_new || tool->tool > SCENE_MOVE) {
        studio_scene_show_hint(tool);
        gtk_widget_queue_draw(tool->layer);
    }
}

static void on_leave(GtkEventControllerMotion *controller, StudioSceneTool *tool) {
    (void)controller;
    tool->is_hovering = false;
    tool->over = STUDIO_GRIP_NONE;
    studio_scene_show_hint(tool);
    gtk_widget_queue_draw(tool->layer);
}

// ---- keys --------------------------------------------------------------------------------------

static gboolean on_key(GtkEventControllerKey *controller, guint key, guint code,
                       GdkModifierType state, StudioSceneTool *tool) {
    (void)controller;
    (void)code;
    if ((state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) != 0 || !can_edit(tool)) {
        return FALSE;
    }
    for (int i = 0; i < SCENE_TOOL_COUNT; i++) {
        if (key == studio_scene_kind((SceneTool)i)->key) {
            studio_scene_choose(tool, (SceneTool)i);
            return TRUE;
        }
    }
    if (key == GDK_KEY_a) {
        return gtk_widget_activate_action(GTK_WIDGET(tool->window->viewport), "win.frame-all",
                                          NULL);
    }
    if (tool->one_of != NULL && tool->tool == SCENE_MOVE &&
        (key == GDK_KEY_t || (key == GDK_KEY_Delete && (state & GDK_SHIFT_MASK) != 0))) {
        return gtk_widget_activate_action(GTK_WIDGET(tool->window->viewport),
                                          key == GDK_KEY_t ? "win.take-one" : "win.leave-one-out",
                                          NULL);
    }
    if (key == GDK_KEY_Delete && tool->has_standing) {
        return gtk_widget_activate_action(GTK_WIDGET(tool->window->viewport), "win.remove", NULL);
    }
    if (key == GDK_KEY_Return || key == GDK_KEY_KP_Enter) {
        StudioEye eye = studio_scene_eye(tool);
        const double middle[2] = {0.5 * eye.width, 0.5 * eye.height};
        return studio_scene_act(tool, tool->is_hovering ? tool->hover : middle);
    }
    return studio_scene_nudge(tool, key, state);
}

// The picture has been drawn from elsewhere: what is drawn over it follows.
static gboolean on_render(GtkGLArea *area, GdkGLContext *context, StudioSceneTool *tool) {
    (void)area;
    (void)context;
    const StudioCamera *camera = studio_viewport_camera(tool->window->viewport);
    if (memcmp(camera, &tool->drawn, sizeof *camera) != 0) {
        gtk_widget_queue_draw(tool->layer);
    }
    return FALSE;
}

void studio_scene_listen(StudioSceneTool *tool) {
    GtkWidget *viewport = GTK_WIDGET(tool->window->viewport);
    GtkGesture *drag = studio_listen_to_drags(viewport, G_CALLBACK(on_begin), G_CALLBACK(on_update),
                                              G_CALLBACK(on_end), tool);
    gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), GDK_BUTTON_PRIMARY);
    gtk_event_controller_set_propagation_phase(GTK_EVENT_CONTROLLER(drag), GTK_PHASE_CAPTURE);
    GtkEventController *motion = gtk_event_controller_motion_new();
    g_signal_connect(motion, "motion", G_CALLBACK(on_motion), tool);
    g_signal_connect(motion, "leave", G_CALLBACK(on_leave), tool);
    gtk_widget_add_controller(viewport, motion);
    GtkEventController *keys = gtk_event_controller_key_new();
    gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), tool);
    gtk_widget_add_controller(viewport, keys);
    g_signal_connect(viewport, "render", G_CALLBACK(on_render), tool);
}
