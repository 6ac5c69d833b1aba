#include "studio/key_track.h"

#include "studio/accessible.h"
#include "studio/widgets.h"

#include <math.h>

enum { HEIGHT = 14, MARK = 5, GRAB = 8 };

static const double same_time = 0.002; // years
static const double key_step = 0.005;  // of the span, by a key stroke

struct _StudioKeyTrack {
    GtkWidget parent;
    GArray *times; // double
    double now, span, inset;
    double held; // time of the key that is dragged; NAN: none is
    gboolean is_dragged;
};

enum { SIGNAL_GO, SIGNAL_MOVE, SIGNAL_DROPPED, SIGNAL_REMOVE, SIGNAL_COUNT };

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioKeyTrack, studio_key_track, GTK_TYPE_WIDGET)

// ---- places ------------------------------------------------------------------------------------

static double line_of(StudioKeyTrack *track) {
    return fmax(gtk_widget_get_width(GTK_WIDGET(track)) - 2 * track->inset, 1);
}

static double place_of(StudioKeyTrack *track, double time) {
    return track->inset + time / track->span * line_of(track);
}

static double time_at(StudioKeyTrack *track, double x) {
    return CLAMP((x - track->inset) / line_of(track), 0, 1) * track->span;
}

static double time_of(const StudioKeyTrack *track, guint index) {
    return g_array_index(track->times, double, index);
}

// The key under a place; NAN.
static double key_under(StudioKeyTrack *track, double x) {
    double found = NAN, nearest = GRAB;
    for (guint i = 0; i < track->times->len; i++) {
        double away = fabs(place_of(track, time_of(track, i)) - x);
        found = away < nearest ? time_of(track, i) : found;
        nearest = fmin(nearest, away);
    }
    return found;
}

static bool is_now(const StudioKeyTrack *track, double time) {
    return fabs(time - track->now) < same_time;
}

double studio_key_track_next(StudioKeyTrack *track, double time, int direction) {
    double found = NAN;
    for (guint i = 0; i < track->times->len; i++) {
        double at = time_of(track, direction > 0 ? i : track->times->len - 1 - i);
        if (isnan(found) && (at - time) * direction > same_time) {
            found = at;
        }
    }
    return found;
}

// ---- pointer and keys --------------------------------------------------------------------------

static void on_begin(GtkGestureDrag *gesture, double x, double y, StudioKeyTrack *track) {
    (void)gesture;
    (void)y;
    gtk_widget_grab_focus(GTK_WIDGET(track));
    track->held = key_under(track, x);
    track->is_dragged = FALSE;
}

static void on_drag(GtkGestureDrag *gesture, double dx, double dy, StudioKeyTrack *track) {
    (void)dy;
    double x, y;
    gtk_gesture_drag_get_start_point(gesture, &x, &y);
    track->is_dragged = track->is_dragged || fabs(dx) > 3;
    if (track->is_dragged && !isnan(track->held)) {
        g_signal_emit(track, signals[SIGNAL_MOVE], 0, track->held, time_at(track, x + dx));
    }
}

static void on_end(GtkGestureDrag *gesture, double dx, double dy, StudioKeyTrack *track) {
    (void)dy;
    double x, y, held = track->held;
    gtk_gesture_drag_get_start_point(gesture, &x, &y);
    track->held = NAN;
    if (track->is_dragged && !isnan(held)) {
        g_signal_emit(track, signals[SIGNAL_DROPPED], 0);
    } else {
        g_signal_emit(track, signals[SIGNAL_GO], 0, isnan(held) ? time_at(track, x + dx) : held);
    }
}

static void on_menu(GtkGestureClick *gesture, int count, double x, double y,
                    StudioKeyTrack *track) {
    (void)gesture;
    (void)count;
    (void)y;
    double key = key_under(track, x);
    if (!isnan(key)) {
        g_signal_emit(track, signals[SIGNAL_REMOVE], 0, key);
    }
}

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioKeyTrack *track) {
    (void)keys;
    (void)code;
    int direction = key == GDK_KEY_Left ? -1 : key == GDK_KEY_Right ? 1 : 0;
    double now = track->now, next = studio_key_track_next(track, now, direction);
    bool is_at = !isnan(key_under(track, place_of(track, now)));
    if (direction != 0 && (state & GDK_ALT_MASK) != 0) {
        if (is_at) {
            track->held = now;
            double to = CLAMP(now + direction * key_step * track->span, 0, track->span);
            g_signal_emit(track, signals[SIGNAL_MOVE], 0, now, to);
            to = track->held;
            track->held = NAN;
            g_signal_emit(track, signals[SIGNAL_DROPPED], 0);
            g_signal_emit(track, signals[SIGNAL_GO], 0, to);
        }
        return TRUE;
    }
    if (direction != 0 && !isnan(next)) {
        g_signal_emit(track, signals[SIGNAL_GO], 0, next);
    } else if ((key == GDK_KEY_Delete || key == GDK_KEY_BackSpace) && is_at) {
        g_signal_emit(track, signals[SIGNAL_REMOVE], 0, now);
    }
    return direction != 0 || key == GDK_KEY_Delete || key == GDK_KEY_BackSpace;
}

static gboolean on_tip(GtkWidget *widget, int x, int y, gboolean is_keyboard, GtkTooltip *tip,
                       gpointer data) {
    (void)y;
    (void)is_keyboard;
    (void)data;
    double key = key_under(STUDIO_KEY_TRACK(widget), x);
    char *text = isnan(key) ? g_strdup("Key frames: click to go there")
                            : g_strdup_printf("A key at %.2f years: drag to move it, right button "
                                              "or Delete to remove it",
                                              key);
    gtk_tooltip_set_text(tip, text);
    g_free(text);
    return TRUE;
}

// ---- looks -------------------------------------------------------------------------------------

static void studio_key_track_snapshot(GtkWidget *widget, GtkSnapshot *snapshot) {
    StudioKeyTrack *track = STUDIO_KEY_TRACK(widget);
    float width = (float)gtk_widget_get_width(widget),
          height = (float)gtk_widget_get_height(widget);
    cairo_t *cairo = gtk_snapshot_append_cairo(snapshot, &GRAPHENE_RECT_INIT(0, 0, width, height));
    GdkRGBA ink;
    gtk_style_context_get_color(gtk_widget_get_style_context(widget), &ink);
    double middle = 0.5 * (double)height;
    cairo_set_source_rgba(cairo, ink.red, ink.green, ink.blue, 0.2);
    cairo_set_line_width(cairo, 1);
    cairo_move_to(cairo, track->inset, middle);
    cairo_line_to(cairo, (double)width - track->inset, middle);
    cairo_stroke(cairo);
    for (guint i = 0; i < track->times->len; i++) {
        double time = time_of(track, i), x = place_of(track, time);
        cairo_move_to(cairo, x, middle - MARK);
        cairo_line_to(cairo, x + MARK, middle);
        cairo_line_to(cairo, x, middle + MARK);
        cairo_line_to(cairo, x - MARK, middle);
        cairo_close_path(cairo);
        if (is_now(track, time)) {
            cairo_set_source_rgb(cairo, 1.0, 0.62, 0.13);
        } else {
            cairo_set_source_rgba(cairo, ink.red, ink.green, ink.blue, 0.85);
        }
        cairo_fill(cairo);
    }
    cairo_destroy(cairo);
}

static void studio_key_track_measure(GtkWidget *widget, GtkOrientation orientation, int size,
                                     int *minimum, int *natural, int *minimum_baseline,
                                     int *natural_baseline) {
    (void)widget;
    (void)size;
    *minimum = *natural = orientation == GTK_ORIENTATION_VERTICAL ? HEIGHT : 100;
    *minimum_baseline = *natural_baseline = -1;
}

// ---- life --------------------------------------------------------------------------------------

void studio_key_track_show(StudioKeyTrack *track, const GArray *times, double now, double span,
                           double inset) {
    g_array_set_size(track->times, 0);
    g_array_append_vals(track->times, times->data, times->len);
    track->now = now;
    track->span = span;
    track->inset = inset;
    gtk_widget_queue_draw(GTK_WIDGET(track));
}

void studio_key_track_hold(StudioKeyTrack *track, double time) {
    track->held = time;
}

static void studio_key_track_finalize(GObject *object) {
    g_array_unref(STUDIO_KEY_TRACK(object)->times);
    G_OBJECT_CLASS(studio_key_track_parent_class)->finalize(object);
}

static void studio_key_track_class_init(StudioKeyTrackClass *class) {
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    GType type = G_TYPE_FROM_CLASS(class);
    G_OBJECT_CLASS(class)->finalize = studio_key_track_finalize;
    widget->snapshot = studio_key_track_snapshot;
    widget->measure = studio_key_track_measure;
    gtk_widget_class_set_css_name(widget, "keytrack");
    signals[SIGNAL_GO] = g_signal_new("go", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                      G_TYPE_NONE, 1, G_TYPE_DOUBLE);
    signals[SIGNAL_MOVE] = g_signal_new("move", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                        G_TYPE_NONE, 2, G_TYPE_DOUBLE, G_TYPE_DOUBLE);
    signals[SIGNAL_DROPPED] =
        g_signal_new("dropped", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    signals[SIGNAL_REMOVE] = g_signal_new("remove", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                          G_TYPE_NONE, 1, G_TYPE_DOUBLE);
}

static void studio_key_track_init(StudioKeyTrack *track) {
    GtkWidget *widget = GTK_WIDGET(track);
    track->times = g_array_new(FALSE, FALSE, sizeof(double));
    track->held = NAN;
    track->span = 1;
    gtk_widget_set_focusable(widget, TRUE);
    gtk_widget_set_has_tooltip(widget, TRUE);
    g_signal_connect(widget, "query-tooltip", G_CALLBACK(on_tip), NULL);
    studio_name(widget, "Key frames of the selected component");
    studio_describe(widget, "Arrow keys go from key to key, with Alt they move it; Delete removes");
    studio_listen_to_drags(widget, G_CALLBACK(on_begin), G_CALLBACK(on_drag), G_CALLBACK(on_end),
                           track);
    studio_listen_for_menu(widget, G_CALLBACK(on_menu), track);
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), track);
    gtk_widget_add_controller(widget, keys);
}

GtkWidget *studio_key_track_new(void) {
    return g_object_new(STUDIO_TYPE_KEY_TRACK, NULL);
}
