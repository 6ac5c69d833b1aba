#include "studio/sketch_view.h"

#include "studio/accessible.h"
#include "studio/model/sketch_shape.h"
#include "studio/sketch_canvas.h"
#include "studio/widgets.h"

#include <math.h>

enum { SIGNAL_PEN, SIGNAL_TURNED, SIGNAL_KEY, SIGNAL_COUNT };

static const double wheel_factor = 1.12; // of distance, for a notch
static const double key_angle = 6 * G_PI / 180;

struct _StudioSketchView {
    GtkWidget parent;
    StudioCamera camera;
    StudioCanvas canvas;
    GArray *layers[2];
    gboolean is_painting;
    bool is_pen;           // the drag paints
    bool is_framed;        // it shows all, and the user has not changed that
    double drag_x, drag_y; // when it turned last
};

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioSketchView, studio_sketch_view, GTK_TYPE_WIDGET)

static double aspect_of(StudioSketchView *view) {
    int width = gtk_widget_get_width(GTK_WIDGET(view));
    int height = gtk_widget_get_height(GTK_WIDGET(view));
    return width > 0 && height > 0 ? (double)width / height : 1;
}

StudioLens studio_sketch_view_lens(StudioSketchView *view) {
    return studio_sketch_lens(&view->camera, aspect_of(view));
}

StudioCamera *studio_sketch_view_camera(StudioSketchView *view) {
    return &view->camera;
}

static void turned(StudioSketchView *view) {
    gtk_widget_queue_draw(GTK_WIDGET(view));
    g_signal_emit(view, signals[SIGNAL_TURNED], 0);
}

// ---- pointer and keys --------------------------------------------------------------------------

static void on_begin(GtkGestureDrag *drag, double x, double y, StudioSketchView *view) {
    guint button = gtk_gesture_single_get_current_button(GTK_GESTURE_SINGLE(drag));
    gtk_widget_grab_focus(GTK_WIDGET(view));
    view->drag_x = view->drag_y = 0;
    view->is_pen = view->is_painting && button == GDK_BUTTON_PRIMARY;
    if (view->is_pen) {
        g_signal_emit(view, signals[SIGNAL_PEN], 0, STUDIO_PEN_DOWN, x, y);
    }
}

static void on_drag(GtkGestureDrag *drag, double x, double y, StudioSketchView *view) {
    double from_x = 0, from_y = 0;
    gtk_gesture_drag_get_start_point(drag, &from_x, &from_y);
    if (view->is_pen) {
        g_signal_emit(view, signals[SIGNAL_PEN], 0, STUDIO_PEN_MOVES, from_x + x, from_y + y);
        return;
    }
    double height = fmax(1, gtk_widget_get_height(GTK_WIDGET(view)));
    double right = (x - view->drag_x) / height, down = (y - view->drag_y) / height;
    view->drag_x = x;
    view->drag_y = y;
    if ((gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(drag)) &
         GDK_SHIFT_MASK) != 0) {
        studio_camera_pan(&view->camera, -right, down);
        view->is_framed = false;
    } else {
        studio_camera_orbit(&view->camera, -right * G_PI, down * G_PI);
    }
    turned(view);
}

static void on_end(GtkGestureDrag *drag, double x, double y, StudioSketchView *view) {
    double from_x = 0, from_y = 0;
    gtk_gesture_drag_get_start_point(drag, &from_x, &from_y);
    if (view->is_pen) {
        view->is_pen = false;
        g_signal_emit(view, signals[SIGNAL_PEN], 0, STUDIO_PEN_UP, from_x + x, from_y + y);
    }
}

static gboolean on_scroll(GtkEventControllerScroll *scroll, double x, double y,
                          StudioSketchView *view) {
    (void)scroll;
    (void)x;
    studio_camera_zoom(&view->camera, pow(wheel_factor, y));
    view->is_framed = false;
    turned(view);
    return TRUE;
}

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioSketchView *view) {
    (void)keys;
    (void)code;
    if ((state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) != 0) {
        return FALSE;
    }
    switch (key) {
    case GDK_KEY_Left:
    case GDK_KEY_Right:
        studio_camera_orbit(&view->camera, key == GDK_KEY_Right ? key_angle : -key_angle, 0);
        break;
    case GDK_KEY_Up:
    case GDK_KEY_Down:
        studio_camera_orbit(&view->camera, 0, key == GDK_KEY_Up ? key_angle : -key_angle);
        break;
    case GDK_KEY_plus:
    case GDK_KEY_equal:
    case GDK_KEY_minus:
        studio_camera_zoom(&view->camera, key == GDK_KEY_minus ? wheel_factor : 1 / wheel_factor);
        view->is_framed = false;
        break;
    case GDK_KEY_f:
        studio_sketch_view_frame(view);
        break;
    default: {
        gboolean is_taken = FALSE;
        g_signal_emit(view, signals[SIGNAL_KEY], 0, key, &is_taken);
        return is_taken;
    }
    }
    turned(view);
    return TRUE;
}

// ---- what it shows -----------------------------------------------------------------------------

void studio_sketch_view_set_lines(StudioSketchView *view, GArray *below, GArray *above) {
    GArray *layers[] = {below, above};
    for (int i = 0; i < 2; i++) {
        GArray *old = view->layers[i];
        view->layers[i] = layers[i] == NULL ? NULL : g_array_ref(layers[i]);
        g_clear_pointer(&old, g_array_unref);
    }
    gtk_widget_queue_draw(GTK_WIDGET(view));
}

void studio_sketch_view_set_painting(StudioSketchView *view, gboolean is_painting) {
    view->is_painting = is_painting;
    gtk_widget_set_cursor_from_name(GTK_WIDGET(view), is_painting ? "crosshair" : "grab");
}

void studio_sketch_view_keep_framed(StudioSketchView *view) {
    if (view->is_framed) {
        studio_sketch_view_frame(view);
    }
}

void studio_sketch_view_frame(StudioSketchView *view) {
    view->is_framed = true;
    studio_sketch_fit(&view->camera, view->layers, 2, aspect_of(view));
    gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void studio_sketch_view_snapshot(GtkWidget *widget, GtkSnapshot *snapshot) {
    StudioSketchView *view = STUDIO_SKETCH_VIEW(widget);
    StudioLens lens = studio_sketch_view_lens(view);
    graphene_rect_t area = GRAPHENE_RECT_INIT(0, 0, (float)gtk_widget_get_width(widget),
                                              (float)gtk_widget_get_height(widget));
    studio_canvas_draw(&view->canvas, widget, snapshot, &area, &lens, view->layers, 2);
}

static void studio_sketch_view_finalize(GObject *object) {
    StudioSketchView *view = STUDIO_SKETCH_VIEW(object);
    studio_canvas_clear(&view->canvas);
    g_clear_pointer(&view->layers[0], g_array_unref);
    g_clear_pointer(&view->layers[1], g_array_unref);
    G_OBJECT_CLASS(studio_sketch_view_parent_class)->finalize(object);
}

static void studio_sketch_view_class_init(StudioSketchViewClass *class) {
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    G_OBJECT_CLASS(class)->finalize = studio_sketch_view_finalize;
    widget->snapshot = studio_sketch_view_snapshot;
    gtk_widget_class_set_css_name(widget, "sketchview");
    gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_IMG);
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_PEN] = g_signal_new("pen", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                       G_TYPE_NONE, 3, G_TYPE_INT, G_TYPE_DOUBLE, G_TYPE_DOUBLE);
    signals[SIGNAL_TURNED] =
        g_signal_new("turned", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    signals[SIGNAL_KEY] = g_signal_new("key", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                       G_TYPE_NONE, 2, G_TYPE_UINT, G_TYPE_POINTER);
}

static void studio_sketch_view_init(StudioSketchView *view) {
    GtkWidget *widget = GTK_WIDGET(view);
    view->camera = studio_camera_default();
    gtk_widget_set_focusable(widget, TRUE);
    gtk_widget_set_hexpand(widget, TRUE);
    gtk_widget_set_vexpand(widget, TRUE);
    gtk_widget_set_overflow(widget, GTK_OVERFLOW_HIDDEN);
    GtkGesture *drag = studio_listen_to_drags(widget, G_CALLBACK(on_begin), G_CALLBACK(on_drag),
                                              G_CALLBACK(on_end), view);
    gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(drag), 0);
    GtkEventController *scroll =
        gtk_event_controller_scroll_new(GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);
    g_signal_connect(scroll, "scroll", G_CALLBACK(on_scroll), view);
    gtk_widget_add_controller(widget, scroll);
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), view);
    gtk_widget_add_controller(widget, keys);
}

GtkWidget *studio_sketch_view_new(const char *label) {
    GtkWidget *widget = g_object_new(STUDIO_TYPE_SKETCH_VIEW, NULL);
    studio_name(widget, label);
    return widget;
}
