#include "studio/sketch_board.h"

#include "studio/accessible.h"
#include "studio/model/sketch_shape.h"
#include "studio/sketch_canvas.h"
#include "studio/widgets.h"

#include <math.h>
#include <string.h>

enum { SIGNAL_DRAWN, SIGNAL_RAISED, SIGNAL_COUNT };

static const double notch = 1.0 / 40; // of the board's height, for a notch of the wheel
static const double step = 1.0 / 50;  // likewise, for a key
static const float pen_width = 9;     // pixels in the plane

struct _StudioSketchBoard {
    GtkWidget parent;
    StudioBoard board;
    StudioCanvas canvas, trace_canvas;
    GArray *layers[2];
    GArray *events; // FrPenEvent
    GArray *live;   // StudioLine: what is being drawn
    GArray *trace;  // the same as a hair
    uint8_t colour[4];
    gboolean is_arrow, is_tilting;
    bool is_down, is_device; // the pen draws; a device leads it
    bool has_cursor;         // the pen is led by keys
    double x, y;             // m, where the pen was last
    double pressure;         // of it, 0 to 1
    double first[3], last[3];
    gint64 began;
};

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioSketchBoard, studio_sketch_board, GTK_TYPE_WIDGET)

// ---- drawing -----------------------------------------------------------------------------------

static double now(StudioSketchBoard *board) {
    return round((double)(g_get_monotonic_time() - board->began) * 1e-3) * 1e-3;
}

static void add(StudioSketchBoard *board, FrPenEvent event) {
    g_array_append_val(board->events, event);
}

static void to_float(const double at[3], float to[3]) {
    for (int i = 0; i < 3; i++) {
        to[i] = (float)at[i];
    }
}

// Shows what was drawn since the last event.
static void extend(StudioSketchBoard *board, double pressure) {
    double at[3];
    float from[3], to[3];
    studio_board_point(&board->board, board->x, board->y, board->board.height, at);
    to_float(board->is_arrow ? board->first : board->last, from);
    to_float(at, to);
    if (board->is_arrow) {
        g_array_set_size(board->live, 0);
        studio_sketch_add_arrow(board->live, from, to, 0.6f * pen_width, board->colour);
    } else {
        StudioLine line = {.width = pen_width * (float)(0.5 + 0.5 * pressure)};
        memcpy(line.from, from, sizeof line.from);
        memcpy(line.to, to, sizeof line.to);
        memcpy(line.colour, board->colour, sizeof line.colour);
        g_array_append_val(board->live, line);
        line.width = 1;
        line.colour[3] = 110;
        g_array_append_val(board->trace, line);
    }
    memcpy(board->last, at, sizeof board->last);
    gtk_widget_queue_draw(GTK_WIDGET(board));
}

static void move(StudioSketchBoard *board, double x, double y, double pressure, double time) {
    board->x = x;
    board->y = y;
    board->pressure = pressure;
    if (board->is_down) {
        add(board,
            (FrPenEvent){.kind = FR_PEN_MOVE, .x = x, .y = y, .pressure = pressure, .time = time});
        extend(board, pressure);
    }
}

static void begin(StudioSketchBoard *board, bool is_device, double x, double y, double pressure) {
    g_array_set_size(board->events, 0);
    g_array_set_size(board->live, 0);
    g_array_set_size(board->trace, 0);
    board->began = g_get_monotonic_time();
    board->is_down = true;
    board->is_device = is_device;
    add(board, (FrPenEvent){.kind = FR_PEN_HEIGHT, .height = board->board.height});
    add(board, (FrPenEvent){.kind = FR_PEN_DOWN});
    studio_board_point(&board->board, x, y, board->board.height, board->first);
    memcpy(board->last, board->first, sizeof board->last);
    if (!is_device) {
        move(board, x, y, pressure, 0);
    }
}

static void end(StudioSketchBoard *board) {
    if (board->is_down) {
        board->is_down = false;
        add(board, (FrPenEvent){.kind = FR_PEN_UP});
        g_array_set_size(board->live, 0);
        gtk_widget_queue_draw(GTK_WIDGET(board));
        g_signal_emit(board, signals[SIGNAL_DRAWN], 0);
    }
}

// The plane goes to a height, and the pen with it.
static void raise_to(StudioSketchBoard *board, double height, double time) {
    double before = board->board.height;
    studio_board_raise(&board->board, height - before);
    if (board->board.height == before) {
        return;
    }
    if (board->is_down) {
        add(board,
            (FrPenEvent){.kind = FR_PEN_HEIGHT, .height = board->board.height, .time = time});
        if (!board->is_device) {
            move(board, board->x, board->y, board->pressure, time);
        }
    }
    gtk_widget_queue_draw(GTK_WIDGET(board));
    g_signal_emit(board, signals[SIGNAL_RAISED], 0);
}

void studio_sketch_board_feed(StudioSketchBoard *board, const FrPenEvent *event) {
    bool is_own = board->is_down && board->is_device;
    switch (event->kind) {
    case FR_PEN_DOWN:
        if (!board->is_down) {
            begin(board, true, board->x, board->y, 1);
        }
        break;
    case FR_PEN_MOVE:
        if (is_own && board->live->len == 0 && board->events->len <= 2) {
            studio_board_point(&board->board, event->x, event->y, board->board.height,
                               board->first);
            memcpy(board->last, board->first, sizeof board->last);
        }
        if (!board->is_down || is_own) {
            move(board, event->x, event->y, event->pressure, event->time);
        }
        break;
    case FR_PEN_HEIGHT:
        raise_to(board, event->height, is_own ? event->time : now(board));
        break;
    case FR_PEN_UP:
        if (is_own) {
            end(board);
        }
        break;
    }
}

// ---- pointer -----------------------------------------------------------------------------------

static void to_board(StudioSketchBoard *board, double px, double py, double *x, double *y) {
    double width = gtk_widget_get_width(GTK_WIDGET(board));
    double height = fmax(1, gtk_widget_get_height(GTK_WIDGET(board)));
    *x = (px - 0.5 * width) / height * board->board.size;
    *y = (0.5 * height - py) / height * board->board.size;
}

static double time_of(StudioSketchBoard *board, StudioTouch touch) {
    return isnan(touch.time) ? now(board) : touch.time;
}

// How hard the pen is pressed; a tilted one moves the plane.
static double feel(StudioSketchBoard *board, StudioTouch touch) {
    if (board->is_tilting && !isnan(touch.tilt)) {
        raise_to(board, studio_board_lean(&board->board, touch.tilt), time_of(board, touch));
    }
    return studio_pen_pressure(touch.pressure);
}

void studio_sketch_board_press(StudioSketchBoard *board, double px, double py, StudioTouch touch) {
    double x, y;
    gtk_widget_grab_focus(GTK_WIDGET(board));
    board->has_cursor = false;
    if (!board->is_down) {
        to_board(board, px, py, &x, &y);
        begin(board, false, x, y, feel(board, touch));
    }
}

void studio_sketch_board_draw(StudioSketchBoard *board, double px, double py, StudioTouch touch) {
    double x, y;
    if (board->is_down && !board->is_device) {
        double pressure = feel(board, touch);
        to_board(board, px, py, &x, &y);
        move(board, x, y, pressure, time_of(board, touch));
    }
}

void studio_sketch_board_lift(StudioSketchBoard *board) {
    if (!board->is_device) {
        end(board);
    }
}

static double axis_of(GdkEvent *event, GdkAxisUse axis) {
    double value;
    return gdk_event_get_axis(event, axis, &value) ? value : NAN;
}

static StudioTouch touch_of(GtkGestureDrag *drag) {
    GdkEvent *event = gtk_event_controller_get_current_event(GTK_EVENT_CONTROLLER(drag));
    if (event == NULL || gdk_event_get_device_tool(event) == NULL) {
        return (StudioTouch){NAN, NAN, NAN}; // a mouse
    }
    return (StudioTouch){axis_of(event, GDK_AXIS_PRESSURE), axis_of(event, GDK_AXIS_YTILT), NAN};
}

static void on_begin(GtkGestureDrag *drag, double px, double py, StudioSketchBoard *board) {
    studio_sketch_board_press(board, px, py, touch_of(drag));
}

static void on_drag(GtkGestureDrag *drag, double dx, double dy, StudioSketchBoard *board) {
    double x, y;
    if (gtk_gesture_drag_get_start_point(drag, &x, &y)) {
        studio_sketch_board_draw(board, x + dx, y + dy, touch_of(drag));
    }
}

static void on_end(GtkGestureDrag *drag, double dx, double dy, StudioSketchBoard *board) {
    (void)drag;
    (void)dx;
    (void)dy;
    studio_sketch_board_lift(board);
}

static gboolean on_scroll(GtkEventControllerScroll *scroll, double dx, double dy,
                          StudioSketchBoard *board) {
    (void)scroll;
    (void)dx;
    raise_to(board, board->board.height - dy * notch * board->board.size, now(board));
    return TRUE;
}

// ---- keys: arrows lead the pen, Space lowers and lifts it --------------------------------------

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioSketchBoard *board) {
    (void)keys;
    (void)code;
    double by = step * board->board.size * ((state & GDK_SHIFT_MASK) != 0 ? 0.2 : 1);
    double right = key == GDK_KEY_Right ? by : key == GDK_KEY_Left ? -by : 0;
    double up = key == GDK_KEY_Up ? by : key == GDK_KEY_Down ? -by : 0;
    if ((state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) != 0) {
        return FALSE;
    }
    if (key == GDK_KEY_Page_Up || key == GDK_KEY_Page_Down) {
        double higher = key == GDK_KEY_Page_Up ? by : -by;
        raise_to(board, board->board.height + higher, now(board));
    } else if (key == GDK_KEY_space) {
        board->has_cursor = true;
        if (board->is_down) {
            end(board);
        } else {
            begin(board, false, board->x, board->y, 1);
        }
    } else if (key == GDK_KEY_Escape && board->is_down) {
        board->is_down = false; // nothing was drawn
        g_array_set_size(board->live, 0);
    } else if (right != 0 || up != 0) {
        board->has_cursor = true;
        move(board, board->x + right, board->y + up, 1, now(board));
    } else {
        return FALSE;
    }
    gtk_widget_queue_draw(GTK_WIDGET(board));
    return TRUE;
}

// ---- what it shows -----------------------------------------------------------------------------

static void draw_plane(StudioSketchBoard *board, GtkSnapshot *snapshot) {
    double width = gtk_widget_get_width(GTK_WIDGET(board));
    double height = gtk_widget_get_height(GTK_WIDGET(board));
    graphene_rect_t all = GRAPHENE_RECT_INIT(0, 0, (float)width, (float)height);
    GdkRGBA ink;
    gtk_style_context_get_color(gtk_widget_get_style_context(GTK_WIDGET(board)), &ink);
    cairo_t *cairo = gtk_snapshot_append_cairo(snapshot, &all);
    cairo_set_source_rgba(cairo, ink.red, ink.green, ink.blue, 0.08);
    cairo_set_line_width(cairo, 1);
    for (int i = -10; i <= 10; i++) {
        double x = round(0.5 * width + 0.1 * i * height) + 0.5;
        double y = round(0.5 * height + 0.1 * i * height) + 0.5;
        cairo_move_to(cairo, x, 0);
        cairo_line_to(cairo, x, height);
        cairo_move_to(cairo, 0, y);
        cairo_line_to(cairo, width, y);
    }
    cairo_stroke(cairo);
    if (board->has_cursor) {
        double x = 0.5 * width + board->x / board->board.size * height;
        double y = 0.5 * height - board->y / board->board.size * height;
        cairo_set_source_rgba(cairo, ink.red, ink.green, ink.blue, board->is_down ? 0.9 : 0.5);
        cairo_set_line_width(cairo, 2);
        cairo_arc(cairo, x, y, board->is_down ? 5 : 8, 0, 2 * G_PI);
        cairo_stroke(cairo);
    }
    cairo_destroy(cairo);
}

static void studio_sketch_board_snapshot(GtkWidget *widget, GtkSnapshot *snapshot) {
    StudioSketchBoard *board = STUDIO_SKETCH_BOARD(widget);
    float width = (float)gtk_widget_get_width(widget),
          height = (float)gtk_widget_get_height(widget);
    if (width < 1 || height < 1) {
        return;
    }
    draw_plane(board, snapshot);
    StudioLens lens = studio_board_lens(&board->board, (double)(width / height));
    GArray *layers[] = {board->layers[0], board->layers[1], board->live};
    graphene_rect_t area = GRAPHENE_RECT_INIT(0, 0, width, height);
    if (board->is_down) { // what of it lies before the plane by now is no more than a hair
        StudioLens before = lens;
        before.nearest = 0.1f * lens.unit;
        studio_canvas_draw(&board->trace_canvas, widget, snapshot, &area, &before, &board->trace,
                           1);
    }
    studio_canvas_draw(&board->canvas, widget, snapshot, &area, &lens, layers, 3);
}

StudioBoard *studio_sketch_board_get(StudioSketchBoard *board) {
    return &board->board;
}

void studio_sketch_board_update(StudioSketchBoard *board) {
    gtk_widget_queue_draw(GTK_WIDGET(board));
}

void studio_sketch_board_set_lines(StudioSketchBoard *board, GArray *below, GArray *above) {
    GArray *layers[] = {below, above};
    for (int i = 0; i < 2; i++) {
        GArray *old = board->layers[i];
        board->layers[i] = layers[i] == NULL ? NULL : g_array_ref(layers[i]);
        g_clear_pointer(&old, g_array_unref);
    }
    gtk_widget_queue_draw(GTK_WIDGET(board));
}

void studio_sketch_board_set_pen(StudioSketchBoard *board, const uint8_t colour[4],
                                 gboolean is_arrow) {
    memcpy(board->colour, colour, sizeof board->colour);
    board->is_arrow = is_arrow;
}

void studio_sketch_board_set_tilting(StudioSketchBoard *board, gboolean is_tilting) {
    board->is_tilting = is_tilting;
}

const GArray *studio_sketch_board_events(StudioSketchBoard *board) {
    return board->events;
}

// ---- life --------------------------------------------------------------------------------------

static void studio_sketch_board_finalize(GObject *object) {
    StudioSketchBoard *board = STUDIO_SKETCH_BOARD(object);
    studio_canvas_clear(&board->canvas);
    studio_canvas_clear(&board->trace_canvas);
    g_clear_pointer(&board->layers[0], g_array_unref);
    g_clear_pointer(&board->layers[1], g_array_unref);
    g_array_unref(board->events);
    g_array_unref(board->live);
    g_array_unref(board->trace);
    G_OBJECT_CLASS(studio_sketch_board_parent_class)->finalize(object);
}

static void studio_sketch_board_class_init(StudioSketchBoardClass *class) {
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    G_OBJECT_CLASS(class)->finalize = studio_sketch_board_finalize;
    widget->snapshot = studio_sketch_board_snapshot;
    gtk_widget_class_set_css_name(widget, "sketchboard");
    gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_IMG);
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_DRAWN] =
        g_signal_new("drawn", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    signals[SIGNAL_RAISED] =
        g_signal_new("raised", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
}

static void studio_sketch_board_init(StudioSketchBoard *board) {
    GtkWidget *widget = GTK_WIDGET(board);
    studio_board_frame(&board->board, NULL, 0, 1);
    board->events = g_array_new(FALSE, FALSE, sizeof(FrPenEvent));
    board->live = g_array_new(FALSE, FALSE, sizeof(StudioLine));
    board->trace = g_array_new(FALSE, FALSE, sizeof(StudioLine));
    gtk_widget_set_focusable(widget, TRUE);
    gtk_widget_set_hexpand(widget, TRUE);
    gtk_widget_set_vexpand(widget, TRUE);
    gtk_widget_set_overflow(widget, GTK_OVERFLOW_HIDDEN);
    gtk_widget_set_cursor_from_name(widget, "crosshair");
    studio_listen_to_drags(widget, G_CALLBACK(on_begin), G_CALLBACK(on_drag), G_CALLBACK(on_end),
                           board);
    GtkEventController *scroll =
        gtk_event_controller_scroll_new(GTK_EVENT_CONTROLLER_SCROLL_VERTICAL);
    g_signal_connect(scroll, "scroll", G_CALLBACK(on_scroll), board);
    gtk_widget_add_controller(widget, scroll);
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), board);
    gtk_widget_add_controller(widget, keys);
}

GtkWidget *studio_sketch_board_new(void) {
    GtkWidget *widget = g_object_new(STUDIO_TYPE_SKETCH_BOARD, NULL);
    studio_name(widget, "Drawing board");
    studio_describe(widget, "Draw with the pointer, or with arrow keys and Space; Page Up and Page "
                            "Down move the board");
    return widget;
}
