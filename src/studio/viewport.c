#include "studio/viewport.h"

#include <math.h>

enum { SIGNAL_READY, SIGNAL_CLICKED, SIGNAL_DRAWN, SIGNAL_COUNT };

static const double rest_seconds = 0.2;  // without a move the view rests
static const double drag_angle = G_PI;   // for a drag over the whole height
static const double wheel_factor = 1.12; // of distance, for a notch

struct _StudioViewport {
    GtkGLArea parent;
    StudioRenderer *renderer;
    char *error;
    StudioCamera camera;
    StudioDisplay display;
    bool is_framed; // the first view has been framed
    bool is_dragging, is_moving, was_done;
    double drag_x, drag_y;
    gint64 moved; // when it moved last
    guint tick;
};

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioViewport, studio_viewport, GTK_TYPE_GL_AREA)

static double aspect_of(StudioViewport *viewport) {
    int width = gtk_widget_get_width(GTK_WIDGET(viewport));
    int height = gtk_widget_get_height(GTK_WIDGET(viewport));
    return width > 0 && height > 0 ? (double)width / height : 1;
}

// ---- drawing -----------------------------------------------------------------------------------

static void on_realize(GtkGLArea *area, gpointer data) {
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    gtk_gl_area_make_current(area);
    const GError *failed = gtk_gl_area_get_error(area);
    GError *error = NULL;
    g_clear_pointer(&viewport->error, g_free);
    if (failed != NULL) {
        viewport->error = g_strdup(failed->message);
        return;
    }
    viewport->renderer = studio_renderer_new(&error);
    if (viewport->renderer == NULL) {
        viewport->error = g_strdup(error->message);
        gtk_gl_area_set_error(area, error);
        g_error_free(error);
        return;
    }
    g_signal_emit(viewport, signals[SIGNAL_READY], 0);
}

static void on_unrealize(GtkGLArea *area, gpointer data) {
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    gtk_gl_area_make_current(area);
    if (gtk_gl_area_get_error(area) == NULL) {
        g_clear_pointer(&viewport->renderer, studio_renderer_free);
    }
}

static gboolean on_tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data) {
    (void)clock;
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(widget);
    double rested = (double)(g_get_monotonic_time() - viewport->moved) * 1e-6;
    if (viewport->is_moving && !viewport->is_dragging && rested > rest_seconds) {
        viewport->is_moving = false;
    }
    if (viewport->is_moving && rested > rest_seconds) {
        return G_SOURCE_CONTINUE; // held still: nothing to draw
    }
    gtk_gl_area_queue_render(GTK_GL_AREA(widget));
    return G_SOURCE_CONTINUE;
}

// Something is to be drawn, perhaps in several frames.
static void wake(StudioViewport *viewport) {
    if (viewport->tick == 0) {
        viewport->tick = gtk_widget_add_tick_callback(GTK_WIDGET(viewport), on_tick, NULL, NULL);
    }
    viewport->was_done = false;
    gtk_gl_area_queue_render(GTK_GL_AREA(viewport));
}

static void on_resize(GtkGLArea *area, int width, int height, gpointer data) {
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    if (viewport->renderer != NULL) {
        studio_renderer_resize(viewport->renderer, width, height);
        wake(viewport);
    }
}

static gboolean on_render(GtkGLArea *area, GdkGLContext *context, gpointer data) {
    (void)context;
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    if (viewport->renderer == NULL) {
        return FALSE;
    }
    viewport->display.cell = studio_camera_step(&viewport->camera, 0.1);
    bool has_more = studio_renderer_draw(viewport->renderer, &viewport->camera, &viewport->display,
                                         viewport->is_moving);
    if (!has_more && viewport->tick != 0) {
        gtk_widget_remove_tick_callback(GTK_WIDGET(viewport), viewport->tick);
        viewport->tick = 0;
    }
    if (!has_more && !viewport->was_done) {
        viewport->was_done = true;
        g_signal_emit(viewport, signals[SIGNAL_DRAWN], 0);
    }
    return TRUE;
}

// ---- moving ------------------------------------------------------------------------------------

static void moved(StudioViewport *viewport) {
    viewport->is_moving = true;
    viewport->moved = g_get_monotonic_time();
    if (viewport->renderer != NULL) {
        studio_renderer_invalidate(viewport->renderer, false);
    }
    wake(viewport);
}

static bool is_pan(GtkGesture *gesture) {
    guint button = gtk_gesture_single_get_current_button(GTK_GESTURE_SINGLE(gesture));
    GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(gesture));
    return button != GDK_BUTTON_PRIMARY || (state & GDK_SHIFT_MASK) != 0;
}

static void on_drag_begin(GtkGestureDrag *gesture, double x, double y, StudioViewport *viewport) {
    (void)gesture;
    (void)x;
    (void)y;
    viewport->drag_x = viewport->drag_y = 0;
    gtk_widget_grab_focus(GTK_WIDGET(viewport));
}

static void on_drag_update(GtkGestureDrag *gesture, double x, double y, StudioViewport *viewport) {
    double height = gtk_widget_get_height(GTK_WIDGET(viewport));
    if (!viewport->is_dragging && hypot(x, y) < 4) {
        return; // a click that trembles
    }
    viewport->is_dragging = true;
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
    bool was_dragging = viewport->is_dragging;
    viewport->is_dragging = false;
    if (was_dragging) {
        moved(viewport);
        return;
    }
    double from_x, from_y;
    (void)x;
    (void)y;
    if (gtk_gesture_single_get_current_button(GTK_GESTURE_SINGLE(gesture)) == GDK_BUTTON_PRIMARY &&
        gtk_gesture_drag_get_start_point(gesture, &from_x, &from_y)) {
        g_signal_emit(viewport, signals[SIGNAL_CLICKED], 0,
                      2 * from_x / gtk_widget_get_width(GTK_WIDGET(viewport)) - 1,
                      1 - 2 * from_y / gtk_widget_get_height(GTK_WIDGET(viewport)));
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
                   {GDK_KEY_3, "win.mode::skeleton"}};
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

static void add_controllers(StudioViewport *viewport) {
    GtkWidget *widget = GTK_WIDGET(viewport);
    GtkGesture *drag = gtk_gesture_drag_new();
    gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), 0);
    g_signal_connect(drag, "drag-begin", G_CALLBACK(on_drag_begin), viewport);
    g_signal_connect(drag, "drag-update", G_CALLBACK(on_drag_update), viewport);
    g_signal_connect(drag, "drag-end", G_CALLBACK(on_drag_end), viewport);
    gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(drag));
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

// ---- what it shows -----------------------------------------------------------------------------

bool studio_viewport_is_ready(StudioViewport *viewport) {
    return viewport->renderer != NULL;
}

const char *studio_viewport_error(StudioViewport *viewport) {
    return viewport->error;
}

void studio_viewport_take(StudioViewport *viewport, const StudioView *view) {
    gtk_gl_area_make_current(GTK_GL_AREA(viewport));
    StudioStore *store = studio_renderer_store(viewport->renderer);
    studio_store_update(store, view);
    studio_renderer_invalidate(viewport->renderer, true);
    double min[3], max[3];
    studio_store_bounds(store, min, max);
    if (!viewport->is_framed && max[0] >= min[0]) {
        viewport->is_framed = true;
        studio_viewport_frame_all(viewport);
        if (view->scene->views->len > 0) {
            studio_viewport_see(viewport, g_ptr_array_index(view->scene->views, 0));
        }
    }
    wake(viewport);
}

void studio_viewport_add_picture(StudioViewport *viewport, const StudioPicture *picture) {
    gtk_gl_area_make_current(GTK_GL_AREA(viewport));
    studio_store_add_picture(studio_renderer_store(viewport->renderer), picture);
    studio_renderer_invalidate(viewport->renderer, true);
    wake(viewport);
}

void studio_viewport_forget(StudioViewport *viewport) {
    viewport->is_framed = false;
    viewport->camera = studio_camera_default();
}

StudioDisplay *studio_viewport_display(StudioViewport *viewport) {
    return &viewport->display;
}

void studio_viewport_update(StudioViewport *viewport) {
    if (viewport->renderer != NULL) {
        studio_renderer_invalidate(viewport->renderer, false);
        wake(viewport);
    }
}

StudioCamera *studio_viewport_camera(StudioViewport *viewport) {
    return &viewport->camera;
}

void studio_viewport_frame(StudioViewport *viewport, const double min[3], const double max[3]) {
    studio_camera_frame(&viewport->camera, min, max, aspect_of(viewport));
    studio_viewport_update(viewport);
}

void studio_viewport_frame_all(StudioViewport *viewport) {
    if (viewport->renderer != NULL) {
        double min[3], max[3];
        studio_store_bounds(studio_renderer_store(viewport->renderer), min, max);
        studio_viewport_frame(viewport, min, max);
    }
}

void studio_viewport_see(StudioViewport *viewport, const FrViewParams *view) {
    double min[3], max[3];
    studio_store_bounds(studio_renderer_store(viewport->renderer), min, max);
    studio_camera_see(&viewport->camera, view, min, max, aspect_of(viewport));
    studio_viewport_update(viewport);
}

void studio_viewport_move(StudioViewport *viewport, double azimuth, double elevation, double zoom) {
    studio_camera_orbit(&viewport->camera, azimuth, elevation);
    studio_camera_zoom(&viewport->camera, zoom);
    moved(viewport);
}

void studio_viewport_highlight(StudioViewport *viewport, const float (*points)[3], uint32_t count) {
    if (viewport->renderer != NULL) {
        gtk_gl_area_make_current(GTK_GL_AREA(viewport));
        studio_renderer_highlight(viewport->renderer, points, count);
        studio_viewport_update(viewport);
    }
}

bool studio_viewport_is_done(StudioViewport *viewport) {
    return viewport->was_done;
}

StudioPace studio_viewport_pace(StudioViewport *viewport) {
    return viewport->renderer == NULL ? (StudioPace){0} : studio_renderer_pace(viewport->renderer);
}

StudioAmount studio_viewport_amount(StudioViewport *viewport) {
    return viewport->renderer == NULL
               ? (StudioAmount){0}
               : studio_store_amount(studio_renderer_store(viewport->renderer));
}

// ---- life --------------------------------------------------------------------------------------

static void studio_viewport_finalize(GObject *object) {
    g_free(STUDIO_VIEWPORT(object)->error);
    G_OBJECT_CLASS(studio_viewport_parent_class)->finalize(object);
}

static void studio_viewport_class_init(StudioViewportClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_viewport_finalize;
    gtk_widget_class_set_accessible_role(GTK_WIDGET_CLASS(class), GTK_ACCESSIBLE_ROLE_IMG);
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_READY] =
        g_signal_new("ready", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    signals[SIGNAL_CLICKED] = g_signal_new("clicked", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                           G_TYPE_NONE, 2, G_TYPE_DOUBLE, G_TYPE_DOUBLE);
    signals[SIGNAL_DRAWN] =
        g_signal_new("drawn", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
}

static void studio_viewport_init(StudioViewport *viewport) {
    GtkGLArea *area = GTK_GL_AREA(viewport);
    viewport->camera = studio_camera_default();
    viewport->display = (StudioDisplay){.mode = STUDIO_SHADED,
                                        .has_shadow = true,
                                        .has_occlusion = true,
                                        .has_grid = true,
                                        .is_dark = true};
    gtk_gl_area_set_required_version(area, 3, 3);
    gtk_gl_area_set_auto_render(area, FALSE);
    gtk_widget_set_focusable(GTK_WIDGET(viewport), TRUE);
    gtk_accessible_update_property(GTK_ACCESSIBLE(viewport), GTK_ACCESSIBLE_PROPERTY_LABEL,
                                   "Picture of the plants", -1);
    g_signal_connect(area, "realize", G_CALLBACK(on_realize), NULL);
    g_signal_connect(area, "unrealize", G_CALLBACK(on_unrealize), NULL);
    g_signal_connect(area, "resize", G_CALLBACK(on_resize), NULL);
    g_signal_connect(area, "render", G_CALLBACK(on_render), NULL);
    add_controllers(viewport);
}

GtkWidget *studio_viewport_new(void) {
    return g_object_new(STUDIO_TYPE_VIEWPORT, NULL);
}
