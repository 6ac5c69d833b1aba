#include "studio/curve_box.h"

#include "frond/curve.h"
#include "studio/accessible.h"
#include "studio/model/values.h"
#include "studio/widgets.h"

#include <math.h>
#include <string.h>

enum { HEIGHT = 150, MARGIN = 12, GRAB = 12, SAMPLES = 96 };

struct _StudioCurveBox {
    GtkWidget parent;
    gboolean is_function;
    GArray *points; // double[2]; NULL: nothing to show
    FrCurveKind kind;
    double top, bottom;    // y of the edges
    guint grabbed, chosen; // FR_NONE
    bool is_out;           // the grabbed point is dragged out of the box
};

static guint edited;

G_DEFINE_TYPE(StudioCurveBox, studio_curve_box, GTK_TYPE_WIDGET)

// ---- coordinates -------------------------------------------------------------------------------

static double inner(double size) {
    return fmax(1, size - 2 * MARGIN);
}

static void to_screen(StudioCurveBox *box, double x, double y, double *sx, double *sy) {
    double width = gtk_widget_get_width(GTK_WIDGET(box));
    double height = gtk_widget_get_height(GTK_WIDGET(box));
    *sx = MARGIN + x * inner(width);
    *sy = MARGIN + (box->top - y) / (box->top - box->bottom) * inner(height);
}

static void from_screen(StudioCurveBox *box, double sx, double sy, double *x, double *y) {
    double width = gtk_widget_get_width(GTK_WIDGET(box));
    double height = gtk_widget_get_height(GTK_WIDGET(box));
    *x = CLAMP((sx - MARGIN) / inner(width), 0, 1);
    double t = CLAMP((sy - MARGIN) / inner(height), 0, 1);
    *y = box->top + t * (box->bottom - box->top);
}

static const double *point_at(StudioCurveBox *box, guint index) {
    return &g_array_index(box->points, double, 2 * index);
}

static guint find_point(StudioCurveBox *box, double sx, double sy) {
    guint found = FR_NONE;
    double nearest = GRAB;
    for (guint i = 0; box->points != NULL && i < box->points->len; i++) {
        double x, y;
        to_screen(box, point_at(box, i)[0], point_at(box, i)[1], &x, &y);
        if (hypot(x - sx, y - sy) < nearest) {
            nearest = hypot(x - sx, y - sy);
            found = i;
        }
    }
    return found;
}

// The box holds all points with a little room, and 0 to 1 of a curve.
static void fit(StudioCurveBox *box) {
    box->top = box->is_function ? 1 : 0.5;
    box->bottom = 0;
    for (guint i = 0; box->points != NULL && i < box->points->len; i++) {
        box->top = fmax(box->top, point_at(box, i)[1]);
        box->bottom = fmin(box->bottom, point_at(box, i)[1]);
    }
}

// Tells a screen reader which point is chosen, and where it is.
static void say(StudioCurveBox *box) {
    guint count = box->points == NULL ? 0 : box->points->len;
    char *words =
        box->chosen < count
            ? g_strdup_printf("Point %u of %u at %.3g, %.3g", box->chosen + 1, count,
                              point_at(box, box->chosen)[0], point_at(box, box->chosen)[1])
            : g_strdup_printf("%u points; Page Down chooses one", count);
    studio_describe(GTK_WIDGET(box), words);
    g_free(words);
}

static void choose(StudioCurveBox *box, guint point) {
    box->chosen = point;
    say(box);
    gtk_widget_queue_draw(GTK_WIDGET(box));
}

static void emit(StudioCurveBox *box, gboolean is_drag) {
    say(box);
    char *text = studio_points_write(box->points);
    g_signal_emit(box, edited, 0, text, is_drag);
    g_free(text);
    gtk_widget_queue_draw(GTK_WIDGET(box));
}

// ---- pointer and keys --------------------------------------------------------------------------

static void on_begin(GtkGestureDrag *drag, double x, double y, StudioCurveBox *box) {
    (void)drag;
    gtk_widget_grab_focus(GTK_WIDGET(box));
    if (box->points == NULL) {
        return;
    }
    box->grabbed = find_point(box, x, y);
    box->is_out = false;
    if (box->grabbed == FR_NONE) {
        double px, py;
        from_screen(box, x, y, &px, &py);
        box->grabbed = studio_points_add(box->points, px, py, box->is_function);
        emit(box, TRUE);
    }
    choose(box, box->grabbed);
}

static void on_drag(GtkGestureDrag *drag, double dx, double dy, StudioCurveBox *box) {
    double x0, y0, x, y;
    if (box->grabbed == FR_NONE || box->points == NULL ||
        !gtk_gesture_drag_get_start_point(drag, &x0, &y0)) {
        return;
    }
    int width = gtk_widget_get_width(GTK_WIDGET(box));
    int height = gtk_widget_get_height(GTK_WIDGET(box));
    bool is_end = box->grabbed == 0 || box->grabbed + 1 == box->points->len;
    box->is_out =
        !is_end && box->points->len > 2 &&
        (x0 + dx < -GRAB || y0 + dy < -GRAB || x0 + dx > width + GRAB || y0 + dy > height + GRAB);
    from_screen(box, x0 + dx, y0 + dy, &x, &y);
    studio_points_move(box->points, box->grabbed, x, y, box->is_function);
    emit(box, TRUE);
}

static void remove_point(StudioCurveBox *box, guint index) {
    g_array_remove_index(box->points, index);
    box->chosen = FR_NONE;
    emit(box, FALSE);
}

static void on_end(GtkGestureDrag *drag, double dx, double dy, StudioCurveBox *box) {
    (void)drag;
    (void)dx;
    (void)dy;
    guint grabbed = box->grabbed;
    box->grabbed = FR_NONE;
    if (grabbed == FR_NONE || box->points == NULL) {
        return;
    }
    if (box->is_out) {
        remove_point(box, grabbed);
    } else {
        emit(box, FALSE);
    }
}

// A new point halfway from the chosen one to the next.
static void insert_point(StudioCurveBox *box) {
    guint before = MIN(box->chosen, box->points->len - 2);
    const double *a = point_at(box, before), *b = point_at(box, before + 1);
    double x = 0.5 * (a[0] + b[0]), y = 0.5 * (a[1] + b[1]);
    choose(box, studio_points_add(box->points, x, y, box->is_function));
    emit(box, FALSE);
}

// From point to point.
static bool choose_by_key(StudioCurveBox *box, guint key) {
    guint last = box->points->len - 1, chosen = box->chosen;
    switch (key) {
    case GDK_KEY_Page_Down:
        choose(box, chosen > last ? 0 : MIN(chosen + 1, last));
        return true;
    case GDK_KEY_Page_Up:
        choose(box, chosen > last ? last : chosen - (chosen > 0));
        return true;
    case GDK_KEY_Home:
    case GDK_KEY_End:
        choose(box, key == GDK_KEY_Home ? 0 : last);
        return true;
    case GDK_KEY_Insert:
        if (last > 0) {
            insert_point(box);
        }
        return true;
    default:
        return false;
    }
}

static bool is_arrow(guint key) {
    return key == GDK_KEY_Left || key == GDK_KEY_Right || key == GDK_KEY_Up || key == GDK_KEY_Down;
}

static void on_release(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioCurveBox *box) {
    (void)keys;
    (void)code;
    (void)state;
    if (is_arrow(key) && box->points != NULL && box->chosen < box->points->len) {
        emit(box, FALSE); // as long as the key was held it was one step
    }
}

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioCurveBox *box) {
    (void)keys;
    (void)code;
    (void)state;
    if (box->points == NULL || box->points->len == 0) {
        return FALSE;
    }
    if (choose_by_key(box, key)) {
        return TRUE;
    }
    if (box->chosen >= box->points->len) {
        return FALSE;
    }
    double x = point_at(box, box->chosen)[0], y = point_at(box, box->chosen)[1];
    double step = 0.01 * (box->top - box->bottom);
    bool is_end = box->chosen == 0 || box->chosen + 1 == box->points->len;
    switch (key) {
    case GDK_KEY_Left:
        x -= 0.01;
        break;
    case GDK_KEY_Right:
        x += 0.01;
        break;
    case GDK_KEY_Up:
        y += step;
        break;
    case GDK_KEY_Down:
        y -= step;
        break;
    case GDK_KEY_Delete:
    case GDK_KEY_BackSpace:
        if (!is_end) {
            remove_point(box, box->chosen);
        }
        return TRUE;
    default:
        return FALSE;
    }
    studio_points_move(box->points, box->chosen, CLAMP(x, 0, 1), y, box->is_function);
    emit(box, TRUE);
    return TRUE;
}

// ---- drawing -----------------------------------------------------------------------------------

static void draw_frame(StudioCurveBox *box, cairo_t *cairo, const GdkRGBA *ink) {
    double x0, y0, x1, y1;
    cairo_set_line_width(cairo, 1);
    for (int i = 0; i <= 4; i++) {
        double t = i / 4.0;
        cairo_set_source_rgba(cairo, ink->red, ink->green, ink->blue, i % 4 == 0 ? 0.22 : 0.09);
        to_screen(box, t, box->bottom, &x0, &y0);
        to_screen(box, t, box->top, &x1, &y1);
        cairo_move_to(cairo, round(x0) + 0.5, y0);
        cairo_line_to(cairo, round(x1) + 0.5, y1);
        double y = box->bottom + t * (box->top - box->bottom);
        to_screen(box, 0, y, &x0, &y0);
        to_screen(box, 1, y, &x1, &y1);
        cairo_move_to(cairo, x0, round(y0) + 0.5);
        cairo_line_to(cairo, x1, round(y1) + 0.5);
        cairo_stroke(cairo);
    }
}

static void trace_function(StudioCurveBox *box, cairo_t *cairo) {
    FrCurve *curve = fr_curve_new(box->kind, (const double(*)[2])(const void *)box->points->data,
                                  box->points->len);
    for (int i = 0; curve != NULL && i <= SAMPLES; i++) {
        double x = (double)i / SAMPLES, sx, sy;
        to_screen(box, x, fr_curve_eval(curve, x), &sx, &sy);
        cairo_line_to(cairo, sx, sy);
    }
    fr_curve_unref(curve);
}

static void trace_outline(StudioCurveBox *box, cairo_t *cairo) {
    for (guint i = 0; i < box->points->len; i++) {
        double x, y;
        to_screen(box, point_at(box, i)[0], point_at(box, i)[1], &x, &y);
        cairo_line_to(cairo, x, y);
    }
}

static void draw_points(StudioCurveBox *box, cairo_t *cairo, const GdkRGBA *ink) {
    for (guint i = 0; i < box->points->len; i++) {
        double x, y;
        to_screen(box, point_at(box, i)[0], point_at(box, i)[1], &x, &y);
        bool is_chosen = i == box->chosen;
        cairo_arc(cairo, x, y, is_chosen ? 6 : 4.5, 0, 2 * G_PI);
        if (i == box->grabbed && box->is_out) {
            cairo_set_source_rgb(cairo, 0.88, 0.2, 0.2);
        } else if (is_chosen) {
            cairo_set_source_rgb(cairo, 1.0, 0.62, 0.13);
        } else {
            cairo_set_source_rgb(cairo, ink->red, ink->green, ink->blue);
        }
        cairo_fill(cairo);
    }
}

static void studio_curve_box_snapshot(GtkWidget *widget, GtkSnapshot *snapshot) {
    StudioCurveBox *box = STUDIO_CURVE_BOX(widget);
    graphene_rect_t bounds = GRAPHENE_RECT_INIT(0, 0, (float)gtk_widget_get_width(widget),
                                                (float)gtk_widget_get_height(widget));
    cairo_t *cairo = gtk_snapshot_append_cairo(snapshot, &bounds);
    GdkRGBA ink;
    gtk_style_context_get_color(gtk_widget_get_style_context(widget), &ink);
    draw_frame(box, cairo, &ink);
    if (box->points != NULL) {
        cairo_set_source_rgb(cairo, 0.34, 0.68, 0.33);
        cairo_set_line_width(cairo, 2);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
        if (box->is_function) {
            trace_function(box, cairo);
        } else {
            trace_outline(box, cairo);
        }
        cairo_stroke(cairo);
        draw_points(box, cairo, &ink);
    }
    cairo_destroy(cairo);
}

static void studio_curve_box_measure(GtkWidget *widget, GtkOrientation orientation, int size,
                                     int *minimum, int *natural, int *minimum_baseline,
                                     int *natural_baseline) {
    (void)widget;
    (void)size;
    *minimum = *natural = orientation == GTK_ORIENTATION_VERTICAL ? HEIGHT : 160;
    *minimum_baseline = *natural_baseline = -1;
}

// ---- life --------------------------------------------------------------------------------------

void studio_curve_box_show(StudioCurveBox *box, const char *points, int kind) {
    box->kind = (FrCurveKind)kind;
    if (box->grabbed != FR_NONE) {
        return; // it is being drawn here
    }
    g_clear_pointer(&box->points, g_array_unref);
    box->points = points == NULL ? NULL : studio_points_read(points);
    if (box->points == NULL || box->chosen >= box->points->len) {
        box->chosen = FR_NONE;
    }
    say(box);
    fit(box);
    gtk_widget_queue_draw(GTK_WIDGET(box));
}

char *studio_curve_box_text(StudioCurveBox *box) {
    return box->points == NULL ? NULL : studio_points_write(box->points);
}

gboolean studio_curve_box_put(StudioCurveBox *box, const char *text) {
    GArray *points = studio_points_read(text);
    if (points == NULL) {
        return FALSE;
    }
    g_clear_pointer(&box->points, g_array_unref);
    box->points = points;
    box->chosen = box->grabbed = FR_NONE;
    fit(box);
    emit(box, FALSE);
    return TRUE;
}

gboolean studio_curve_box_is_function(StudioCurveBox *box) {
    return box->is_function;
}

static void studio_curve_box_finalize(GObject *object) {
    g_clear_pointer(&STUDIO_CURVE_BOX(object)->points, g_array_unref);
    G_OBJECT_CLASS(studio_curve_box_parent_class)->finalize(object);
}

static void studio_curve_box_class_init(StudioCurveBoxClass *class) {
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    G_OBJECT_CLASS(class)->finalize = studio_curve_box_finalize;
    widget->snapshot = studio_curve_box_snapshot;
    widget->measure = studio_curve_box_measure;
    gtk_widget_class_set_css_name(widget, "curvebox");
    gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GROUP);
    edited = g_signal_new("edited", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                          NULL, G_TYPE_NONE, 2, G_TYPE_STRING, G_TYPE_BOOLEAN);
}

static void studio_curve_box_init(StudioCurveBox *box) {
    GtkWidget *widget = GTK_WIDGET(box);
    box->grabbed = box->chosen = FR_NONE;
    box->top = 1;
    gtk_widget_set_focusable(widget, TRUE);
    studio_listen_to_drags(widget, G_CALLBACK(on_begin), G_CALLBACK(on_drag), G_CALLBACK(on_end),
                           box);
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), box);
    g_signal_connect(keys, "key-released", G_CALLBACK(on_release), box);
    gtk_widget_add_controller(widget, keys);
}

GtkWidget *studio_curve_box_new(gboolean is_function) {
    StudioCurveBox *box = g_object_new(STUDIO_TYPE_CURVE_BOX, NULL);
    box->is_function = is_function;
    fit(box);
    return GTK_WIDGET(box);
}
