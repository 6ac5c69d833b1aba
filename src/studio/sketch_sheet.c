#include "studio/sketch_sheet.h"

#include "studio/accessible.h"
#include "studio/model/sketch_shape.h"
#include "studio/sketch_canvas.h"

#include <math.h>

enum { SIGNAL_CHOSEN, SIGNAL_OPENED, SIGNAL_COUNT };

struct _StudioSketchSheet {
    GtkWidget parent;
    GPtrArray *instances; // GArray * of StudioLine
    guint64 first_seed;
    guint chosen;
    StudioCamera camera;
    StudioCanvas canvas;
};

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioSketchSheet, studio_sketch_sheet, GTK_TYPE_WIDGET)

// ---- cells -------------------------------------------------------------------------------------

// As many columns as make the cells largest for plants that are taller than wide.
static guint columns_of(StudioSketchSheet *sheet) {
    double width = gtk_widget_get_width(GTK_WIDGET(sheet));
    double height = fmax(1, gtk_widget_get_height(GTK_WIDGET(sheet)));
    guint count = MAX(sheet->instances->len, 1), best = 1;
    double largest = 0;
    for (guint columns = 1; columns <= count; columns++) {
        double side = fmin(width / columns * 1.2, height / ceil((double)count / columns));
        if (side > largest) {
            largest = side;
            best = columns;
        }
    }
    return best;
}

static graphene_rect_t cell_of(StudioSketchSheet *sheet, guint index) {
    guint columns = columns_of(sheet);
    guint rows = (MAX(sheet->instances->len, 1) + columns - 1) / columns;
    float width = (float)gtk_widget_get_width(GTK_WIDGET(sheet)) / (float)columns;
    float height = (float)gtk_widget_get_height(GTK_WIDGET(sheet)) / (float)rows;
    return GRAPHENE_RECT_INIT((float)(index % columns) * width, (float)(index / columns) * height,
                              width, height);
}

static void draw_number(StudioSketchSheet *sheet, GtkSnapshot *snapshot,
                        const graphene_rect_t *cell, guint index) {
    char *text = g_strdup_printf("%" G_GUINT64_FORMAT, sheet->first_seed + index);
    PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(sheet), text);
    GdkRGBA ink;
    gtk_style_context_get_color(gtk_widget_get_style_context(GTK_WIDGET(sheet)), &ink);
    ink.alpha = 0.6f;
    gtk_snapshot_save(snapshot);
    graphene_point_t at = GRAPHENE_POINT_INIT(cell->origin.x + 8, cell->origin.y + 6);
    gtk_snapshot_translate(snapshot, &at);
    gtk_snapshot_append_layout(snapshot, layout, &ink);
    gtk_snapshot_restore(snapshot);
    g_object_unref(layout);
    g_free(text);
}

static void draw_choice(StudioSketchSheet *sheet, GtkSnapshot *snapshot,
                        const graphene_rect_t *cell) {
    GdkRGBA ink;
    GtkStyleContext *style = gtk_widget_get_style_context(GTK_WIDGET(sheet));
    if (!gtk_style_context_lookup_color(style, "accent_color", &ink)) {
        gtk_style_context_get_color(style, &ink);
    }
    GskRoundedRect outline;
    graphene_rect_t inner = *cell;
    graphene_rect_inset(&inner, 3, 3);
    gsk_rounded_rect_init_from_rect(&outline, &inner, 8);
    const float widths[] = {2, 2, 2, 2};
    const GdkRGBA colours[] = {ink, ink, ink, ink};
    gtk_snapshot_append_border(snapshot, &outline, widths, colours);
}

static void studio_sketch_sheet_snapshot(GtkWidget *widget, GtkSnapshot *snapshot) {
    StudioSketchSheet *sheet = STUDIO_SKETCH_SHEET(widget);
    graphene_rect_t first = cell_of(sheet, 0);
    if (first.size.width < 2 || first.size.height < 2) {
        return;
    }
    double aspect = (double)(first.size.width / first.size.height);
    studio_sketch_fit(&sheet->camera, (GArray *const *)sheet->instances->pdata,
                      sheet->instances->len, aspect);
    StudioLens lens = studio_sketch_lens(&sheet->camera, aspect);
    for (guint i = 0; i < sheet->instances->len; i++) {
        graphene_rect_t cell = cell_of(sheet, i);
        GArray *layers[] = {g_ptr_array_index(sheet->instances, i)};
        studio_canvas_draw(&sheet->canvas, widget, snapshot, &cell, &lens, layers, 1);
        draw_number(sheet, snapshot, &cell, i);
        if (i == sheet->chosen) {
            draw_choice(sheet, snapshot, &cell);
        }
    }
}

// ---- choosing ----------------------------------------------------------------------------------

void studio_sketch_sheet_choose(StudioSketchSheet *sheet, guint index) {
    sheet->chosen = index;
    gtk_widget_queue_draw(GTK_WIDGET(sheet));
}

static void choose(StudioSketchSheet *sheet, guint index) {
    if (index < sheet->instances->len && index != sheet->chosen) {
        studio_sketch_sheet_choose(sheet, index);
        g_signal_emit(sheet, signals[SIGNAL_CHOSEN], 0, index);
    }
}

static void on_pressed(GtkGestureClick *click, int times, double x, double y,
                       StudioSketchSheet *sheet) {
    (void)click;
    gtk_widget_grab_focus(GTK_WIDGET(sheet));
    for (guint i = 0; i < sheet->instances->len; i++) {
        graphene_rect_t cell = cell_of(sheet, i);
        graphene_point_t point = GRAPHENE_POINT_INIT((float)x, (float)y);
        if (graphene_rect_contains_point(&cell, &point)) {
            choose(sheet, i);
            if (times == 2) {
                g_signal_emit(sheet, signals[SIGNAL_OPENED], 0, i);
            }
            return;
        }
    }
}

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioSketchSheet *sheet) {
    (void)keys;
    (void)code;
    (void)state;
    guint columns = columns_of(sheet);
    switch (key) {
    case GDK_KEY_Left:
        choose(sheet, sheet->chosen - 1);
        return TRUE;
    case GDK_KEY_Right:
        choose(sheet, sheet->chosen + 1);
        return TRUE;
    case GDK_KEY_Up:
        choose(sheet, sheet->chosen - columns);
        return TRUE;
    case GDK_KEY_Down:
        choose(sheet, sheet->chosen + columns);
        return TRUE;
    case GDK_KEY_Return:
    case GDK_KEY_KP_Enter:
        g_signal_emit(sheet, signals[SIGNAL_OPENED], 0, sheet->chosen);
        return TRUE;
    default:
        return FALSE;
    }
}

// ---- life --------------------------------------------------------------------------------------

void studio_sketch_sheet_show(StudioSketchSheet *sheet, GPtrArray *instances, guint64 first_seed) {
    g_ptr_array_ref(instances);
    g_ptr_array_unref(sheet->instances);
    sheet->instances = instances;
    sheet->first_seed = first_seed;
    sheet->chosen = MIN(sheet->chosen, MAX(instances->len, 1) - 1);
    gtk_widget_queue_draw(GTK_WIDGET(sheet));
}

void studio_sketch_sheet_see(StudioSketchSheet *sheet, const StudioCamera *camera) {
    sheet->camera = *camera;
    gtk_widget_queue_draw(GTK_WIDGET(sheet));
}

static void studio_sketch_sheet_finalize(GObject *object) {
    StudioSketchSheet *sheet = STUDIO_SKETCH_SHEET(object);
    g_ptr_array_unref(sheet->instances);
    studio_canvas_clear(&sheet->canvas);
    G_OBJECT_CLASS(studio_sketch_sheet_parent_class)->finalize(object);
}

static void studio_sketch_sheet_class_init(StudioSketchSheetClass *class) {
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    G_OBJECT_CLASS(class)->finalize = studio_sketch_sheet_finalize;
    widget->snapshot = studio_sketch_sheet_snapshot;
    gtk_widget_class_set_css_name(widget, "sketchsheet");
    gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_IMG);
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_CHOSEN] = g_signal_new("chosen", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                          G_TYPE_NONE, 1, G_TYPE_UINT);
    signals[SIGNAL_OPENED] = g_signal_new("opened", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                          G_TYPE_NONE, 1, G_TYPE_UINT);
}

static void studio_sketch_sheet_init(StudioSketchSheet *sheet) {
    GtkWidget *widget = GTK_WIDGET(sheet);
    sheet->instances = g_ptr_array_new();
    sheet->camera = studio_camera_default();
    gtk_widget_set_focusable(widget, TRUE);
    GtkGesture *click = gtk_gesture_click_new();
    g_signal_connect(click, "pressed", G_CALLBACK(on_pressed), sheet);
    gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(click));
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), sheet);
    gtk_widget_add_controller(widget, keys);
}

GtkWidget *studio_sketch_sheet_new(void) {
    GtkWidget *widget = g_object_new(STUDIO_TYPE_SKETCH_SHEET, NULL);
    studio_name(widget, "Contact sheet of instances");
    return widget;
}
