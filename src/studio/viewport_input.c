/// What pointer and keys do in the viewport: they move the view, or go to who takes them.
#include "studio/viewport_private.h"
#include "studio/widgets.h"

#include <math.h>

enum { SIGNAL_CLICKED, SIGNAL_PRESS, SIGNAL_DRAG, SIGNAL_RELEASE, SIGNAL_HOVER, SIGNAL_COUNT };

static const double drag_angle = G_PI;   // for a drag over the whole height
static const double wheel_factor = 1.12; // of distance, for a notch

static guint signals[SIGNAL_COUNT];

static void moved(StudioViewport *viewport) {
    viewport->is_moving = true;
    viewport->is_framed = true; // what is seen has been chosen
    viewport->moved = g_get_monotonic_time();
    if (viewport->renderer != NULL) {
        studio_renderer_invalidate(viewport->renderer, false);
    }
    studio_viewport_wake(viewport);
}

static bool is_pan(GtkGesture *gesture) {
    guint button = gtk_gesture_single_get_current_button(GTK_GESTURE_SINGLE(gesture));
    GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(gesture));
    return button != GDK_BUTTON_PRIMARY || (state & GDK_SHIFT_MASK) != 0;
}

// A point of the widget as one of the picture, −1 to 1.
static void to_picture(StudioViewport *viewport, double *x, double *y) {
    *x = 2 * *x / gtk_widget_get_width(GTK_WIDGET(viewport)) - 1;
    *y = 1 - 2 * *y / gtk_widget_get_height(GTK_WIDGET(viewport));
}

static guint modifiers_of(GtkGestureDrag *gesture) {
    return gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(gesture));
}

static bool is_main_button(GtkGestureDrag *gesture) {
    return gtk_gesture_single_get_current_button(GTK_GESTURE_SINGLE(gesture)) == GDK_BUTTON_PRIMARY;
}

static void on_drag_begin(GtkGestureDrag *gesture, double x, double y, StudioViewport *viewport) {
    viewport->drag_x = viewport->drag_y = 0;
    gtk_widget_grab_focus(GTK_WIDGET(viewport));
    gboolean is_taken = FALSE;
    if (is_main_button(gesture)) {
        to_picture(viewport, &x, &y);
        g_signal_emit(viewport, signals[SIGNAL_PRESS], 0, x, y, modifiers_of(gesture), &is_taken);
    }
    viewport->is_taken = is_taken;
}

static void on_drag_update(GtkGestureDrag *gesture, double x, double y, StudioViewport *viewport) {
    double height = gtk_widget_get_height(GTK_WIDGET(viewport)), from_x, from_y;
    if (!viewport->is_dragging && hypot(x, y) < 4) {
        return; // a click that trembles
    }
    viewport->is_dragging = true;
    if (viewport->is_taken) {
        if (gtk_gesture_drag_get_start_point(gesture, &from_x, &from_y)) {
            x += from_x;
            y += from_y;
            to_picture(viewport, &x, &y);
            g_signal_emit(viewport, signals[SIGNAL_DRAG], 0, x, y, modifiers_of(gesture));
        }
        return;
    }
    double right = (x - viewport->drag_x) / height, down = (y - viewport->drag_y) / height;
    viewport->drag_x = x;
    viewport->drag_y = y;
    if (is_pan(GTK_GESTURE(gesture))) {
        studio_camera_pan(&viewport->camera, -right, down);
    } else {
        studio_camera_orbit(&viewport->camera, -right * drag_angle, down * drag_angle);
    }
    moved(viewport);
}

static void on_drag_end(GtkGestureDrag *gesture, double x, double y, StudioViewport *viewport) {
    bool was_dragging = viewport->is_dragging, was_taken = viewport->is_taken;
    double from_x = 0, from_y = 0;
    viewport->is_dragging = viewport->is_taken = false;
    gtk_gesture_drag_get_start_point(gesture, &from_x, &from_y);
    x += from_x;
    y += from_y;
    to_picture(viewport, &x, &y);
    if (was_taken) {
        g_signal_emit(viewport, signals[SIGNAL_RELEASE], 0, x, y, (gboolean)was_dragging);
    } else if (was_dragging) {
        moved(viewport);
    } else if (is_main_button(gesture)) {
        to_picture(viewport, &from_x, &from_y);
        g_signal_emit(viewport, signals[SIGNAL_CLICKED], 0, from_x, from_y);
    }
}

static void on_motion(GtkEventControllerMotion *motion, double x, double y,
                      StudioViewport *viewport) {
    GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(motion));
    if ((state & (GDK_BUTTON1_MASK | GDK_BUTTON2_MASK | GDK_BUTTON3_MASK)) == 0) {
        to_picture(viewport, &x, &y);
        g_signal_emit(viewport, signals[SIGNAL_HOVER], 0, x, y);
    }
}

static gboolean on_scroll(GtkEventControllerScroll *scroll, double x, double y,
                          StudioViewport *viewport) {
    (void)scroll;
    (void)x;
    studio_camera_zoom(&viewport->camera, pow(wheel_factor, y));
    moved(viewport);
    return TRUE;
}

static void on_pinch(GtkGestureZoom *gesture, double scale, StudioViewport *viewport) {
    (void)gesture;
    static const char key[] = "last-scale";
    double *last = g_object_get_data(G_OBJECT(gesture), key);
    if (last == NULL) {
        last = g_new(double, 1);
        *last = 1;
        g_object_set_data_full(G_OBJECT(gesture), key, last, g_free);
    }
    studio_camera_zoom(&viewport->camera, *last / fmax(scale, 0.01));
    *last = scale;
    moved(viewport);
}

static void on_pinch_begin(GtkGesture *gesture, GdkEventSequence *sequence, gpointer data) {
    (void)sequence;
    (void)data;
    g_object_set_data(G_OBJECT(gesture), "last-scale", NULL);
}

static gboolean on_key(GtkEventControllerKey *controller, guint key, guint code,
                       GdkModifierType state, StudioViewport *viewport) {
    (void)controller;
    (void)code;
    const double step = 5 * G_PI / 180;
    static const struct {
        guint key;
        const char *action;
    } letters[] = {{GDK_KEY_f, "win.frame"},
                   {GDK_KEY_1, "win.mode::shaded"},
                   {GDK_KEY_2, "win.mode::wireframe"},
                   {GDK_KEY_3, "win.mode::skeleton"},
                   {GDK_KEY_w, "win.wind"}};
    for (size_t i = 0; i < G_N_ELEMENTS(letters); i++) {
        if (key == letters[i].key && (state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) == 0) {
            char *name;
            GVariant *target;
            g_action_parse_detailed_name(letters[i].action, &name, &target, NULL);
            gtk_widget_activate_action_variant(GTK_WIDGET(viewport), name, target);
            g_clear_pointer(&target, g_variant_unref);
            g_free(name);
            return TRUE;
        }
    }
    bool is_pan = (state & GDK_SHIFT_MASK) != 0;
    double right = key == GDK_KEY_Right ? 1 : key == GDK_KEY_Left ? -1 : 0;
    double up = key == GDK_KEY_Up ? 1 : key == GDK_KEY_Down ? -1 : 0;
    if ((right == 0 && up == 0) || (state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) != 0) {
        return FALSE;
    }
    if (is_pan) {
        studio_camera_pan(&viewport->camera, 0.04 * right, 0.04 * up);
    } else {
        studio_camera_orbit(&viewport->camera, right * step, up * step);
    }
    moved(viewport);
    return TRUE;
}

void studio_viewport_add_controllers(StudioViewport *viewport) {
    GtkWidget *widget = GTK_WIDGET(viewport);
    GtkGesture *drag =
        studio_listen_to_drags(widget, G_CALLBACK(on_drag_begin), G_CALLBACK(on_drag_update),
                               G_CALLBACK(on_drag_end), viewport);
    gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), 0);
    GtkEventController *motion = gtk_event_controller_motion_new();
    g_signal_connect(motion, "motion", G_CALLBACK(on_motion), viewport);
    gtk_widget_add_controller(widget, motion);
    GtkEventController *scroll =
        gtk_event_controller_scroll_new(GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);
    g_signal_connect(scroll, "scroll", G_CALLBACK(on_scroll), viewport);
    gtk_widget_add_controller(widget, scroll);
    GtkGesture *pinch = gtk_gesture_zoom_new();
    g_signal_connect(pinch, "begin", G_CALLBACK(on_pinch_begin), NULL);
    g_signal_connect(pinch, "scale-changed", G_CALLBACK(on_pinch), viewport);
    gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(pinch));
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), viewport);
    gtk_widget_add_controller(widget, keys);
}

void studio_viewport_move(StudioViewport *viewport, double azimuth, double elevation, double zoom) {
    studio_camera_orbit(&viewport->camera, azimuth, elevation);
    studio_camera_zoom(&viewport->camera, zoom);
    moved(viewport);
}

void studio_viewport_add_signals(GType type) {
    signals[SIGNAL_CLICKED] = g_signal_new("clicked", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                           G_TYPE_NONE, 2, G_TYPE_DOUBLE, G_TYPE_DOUBLE);
    signals[SIGNAL_PRESS] =
        g_signal_new("press", type, G_SIGNAL_RUN_LAST, 0, g_signal_accumulator_true_handled, NULL,
                     NULL, G_TYPE_BOOLEAN, 3, G_TYPE_DOUBLE, G_TYPE_DOUBLE, G_TYPE_UINT);
    signals[SIGNAL_DRAG] = g_signal_new("drag", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                        G_TYPE_NONE, 3, G_TYPE_DOUBLE, G_TYPE_DOUBLE, G_TYPE_UINT);
    signals[SIGNAL_RELEASE] =
        g_signal_new("release", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 3,
                     G_TYPE_DOUBLE, G_TYPE_DOUBLE, G_TYPE_BOOLEAN);
    signals[SIGNAL_HOVER] = g_signal_new("hover", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                         G_TYPE_NONE, 2, G_TYPE_DOUBLE, G_TYPE_DOUBLE);
}
