#include "studio/fold_box.h"

#include "studio/accessible.h"

enum { DIVIDER = 1 }; // in pixels, in the style of libadwaita

struct _StudioFoldBox {
    GtkWidget parent;
    GtkPaned *outer, *inner;
    GtkWidget *contents[STUDIO_PANE_COUNT], *middle;
    GtkWidget *panes[STUDIO_PANE_COUNT]; // around the contents: what is hidden has no size
    bool is_wanted[STUDIO_PANE_COUNT];
    int widths[STUDIO_PANE_COUNT]; // as they were when they were shown last
    StudioPane last;               // asked for
    GdkSurface *surface;           // NULL: not on a screen
    gulong handler;
};

static guint folded;

G_DEFINE_TYPE(StudioFoldBox, studio_fold_box, GTK_TYPE_WIDGET)

// ---- what has room -----------------------------------------------------------------------------

static int needs(GtkWidget *widget) {
    int minimum;
    gtk_widget_measure(widget, GTK_ORIENTATION_HORIZONTAL, -1, &minimum, NULL, NULL, NULL);
    return minimum;
}

bool studio_fold_box_is_shown(const StudioFoldBox *box, StudioPane pane) {
    return gtk_widget_get_visible(box->panes[pane]);
}

bool studio_fold_box_is_wanted(const StudioFoldBox *box, StudioPane pane) {
    return box->is_wanted[pane];
}

int studio_fold_box_width(const StudioFoldBox *box, StudioPane pane) {
    int width = studio_fold_box_is_shown(box, pane) ? gtk_widget_get_width(box->panes[pane]) : 0;
    return width > 0 ? width : box->widths[pane];
}

static void show(StudioFoldBox *box, StudioPane pane, bool is_shown) {
    if (!is_shown) {
        box->widths[pane] = studio_fold_box_width(box, pane);
    }
    gtk_widget_set_visible(box->panes[pane], is_shown);
}

// Gives panes that have come the widths they had.
static void place(StudioFoldBox *box, const bool *is_new) {
    int room = gtk_widget_get_width(GTK_WIDGET(box)) - DIVIDER;
    int side = studio_fold_box_is_shown(box, STUDIO_PANE_SIDE)
                   ? studio_fold_box_width(box, STUDIO_PANE_SIDE) + DIVIDER
                   : 0;
    if (is_new[STUDIO_PANE_SIDE]) {
        side = box->widths[STUDIO_PANE_SIDE] + DIVIDER;
        gtk_paned_set_position(box->outer, box->widths[STUDIO_PANE_SIDE]);
    }
    if (is_new[STUDIO_PANE_INSPECTOR]) {
        int middle = room - side - box->widths[STUDIO_PANE_INSPECTOR];
        gtk_paned_set_position(box->inner, MAX(needs(box->middle), middle));
    }
}

// Folds what has no room, and unfolds what has.
static void decide(StudioFoldBox *box) {
    const StudioPane order[] = {box->last, (StudioPane)(1 - (int)box->last)};
    int room = gtk_widget_get_width(GTK_WIDGET(box)) - needs(box->middle);
    bool is_new[STUDIO_PANE_COUNT] = {false}, is_changed = false;
    for (int i = 0; i < STUDIO_PANE_COUNT; i++) {
        StudioPane pane = order[i];
        int needed = needs(box->contents[pane]) + DIVIDER;
        bool is_shown = box->is_wanted[pane] && needed <= room;
        room -= is_shown ? needed : 0;
        if (is_shown != studio_fold_box_is_shown(box, pane)) {
            show(box, pane, is_shown);
            is_new[pane] = is_shown;
            is_changed = true;
        }
    }
    if (is_changed) {
        place(box, is_new);
        g_signal_emit(box, folded, 0);
    }
}

void studio_fold_box_set_width(StudioFoldBox *box, StudioPane pane, int width) {
    box->widths[pane] = width;
}

void studio_fold_box_want(StudioFoldBox *box, StudioPane pane, bool is_wanted) {
    box->is_wanted[pane] = is_wanted;
    box->last = is_wanted ? pane : box->last;
    if (gtk_widget_get_width(GTK_WIDGET(box)) > 0) {
        decide(box);
    }
}

// ---- layout ------------------------------------------------------------------------------------

static void on_measure(GtkWidget *widget, GtkOrientation orientation, int for_size, int *minimum,
                       int *natural, int *minimum_baseline, int *natural_baseline) {
    StudioFoldBox *box = STUDIO_FOLD_BOX(widget);
    gtk_widget_measure(GTK_WIDGET(box->outer), orientation, for_size, minimum, natural, NULL, NULL);
    *minimum_baseline = *natural_baseline = -1;
    if (orientation == GTK_ORIENTATION_HORIZONTAL) { // either pane alone has room
        int side = needs(box->contents[STUDIO_PANE_SIDE]);
        int inspector = needs(box->contents[STUDIO_PANE_INSPECTOR]);
        *minimum = needs(box->middle) + MAX(side, inspector) + DIVIDER;
        *natural = MAX(*natural, *minimum);
    }
}

static void on_allocate(GtkWidget *widget, int width, int height, int baseline) {
    GtkWidget *outer = GTK_WIDGET(STUDIO_FOLD_BOX(widget)->outer);
    gtk_widget_allocate(outer, MAX(width, needs(outer)), height, baseline, NULL);
}

// The window has its size, and nothing of it has been drawn yet. To hide parts while sizes are
// handed out is not allowed.
static void on_laid_out(GdkSurface *surface, int width, int height, StudioFoldBox *box) {
    (void)surface;
    (void)width;
    (void)height;
    if (gtk_widget_get_mapped(GTK_WIDGET(box)) && gtk_widget_get_width(GTK_WIDGET(box)) > 0) {
        decide(box);
    }
}

static void on_realize(GtkWidget *widget) {
    StudioFoldBox *box = STUDIO_FOLD_BOX(widget);
    GTK_WIDGET_CLASS(studio_fold_box_parent_class)->realize(widget);
    box->surface = gtk_native_get_surface(gtk_widget_get_native(widget));
    box->handler = g_signal_connect(box->surface, "layout", G_CALLBACK(on_laid_out), box);
}

static void on_unrealize(GtkWidget *widget) {
    StudioFoldBox *box = STUDIO_FOLD_BOX(widget);
    g_clear_signal_handler(&box->handler, box->surface);
    box->surface = NULL;
    GTK_WIDGET_CLASS(studio_fold_box_parent_class)->unrealize(widget);
}

// ---- life --------------------------------------------------------------------------------------

static void studio_fold_box_dispose(GObject *object) {
    StudioFoldBox *box = STUDIO_FOLD_BOX(object);
    if (box->outer != NULL) {
        gtk_widget_unparent(GTK_WIDGET(box->outer));
        box->outer = NULL;
    }
    G_OBJECT_CLASS(studio_fold_box_parent_class)->dispose(object);
}

static void studio_fold_box_class_init(StudioFoldBoxClass *class) {
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    G_OBJECT_CLASS(class)->dispose = studio_fold_box_dispose;
    widget->measure = on_measure;
    widget->size_allocate = on_allocate;
    widget->realize = on_realize;
    widget->unrealize = on_unrealize;
    folded = g_signal_new("folded", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                          NULL, G_TYPE_NONE, 0);
}

static void studio_fold_box_init(StudioFoldBox *box) {
    gtk_widget_set_overflow(GTK_WIDGET(box), GTK_OVERFLOW_HIDDEN);
}

static GtkPaned *make_paned(const char *name, GtkWidget *start, GtkWidget *end, bool is_end_wide) {
    GtkWidget *paned = gtk_paned_new(GTK_ORIENTATION_HORIZONTAL);
    studio_name(paned, name);
    gtk_paned_set_start_child(GTK_PANED(paned), start);
    gtk_paned_set_end_child(GTK_PANED(paned), end);
    gtk_paned_set_resize_start_child(GTK_PANED(paned), !is_end_wide);
    gtk_paned_set_resize_end_child(GTK_PANED(paned), is_end_wide);
    gtk_paned_set_shrink_start_child(GTK_PANED(paned), FALSE);
    gtk_paned_set_shrink_end_child(GTK_PANED(paned), FALSE);
    return GTK_PANED(paned);
}

GtkWidget *studio_fold_box_new(GtkWidget *side, GtkWidget *middle, GtkWidget *inspector) {
    StudioFoldBox *box = g_object_new(STUDIO_TYPE_FOLD_BOX, NULL);
    GtkWidget *const contents[] = {side, inspector};
    box->middle = middle;
    for (int i = 0; i < STUDIO_PANE_COUNT; i++) {
        box->is_wanted[i] = true;
        box->contents[i] = contents[i];
        box->panes[i] = adw_bin_new();
        adw_bin_set_child(ADW_BIN(box->panes[i]), contents[i]);
        gtk_widget_set_visible(box->panes[i], FALSE);
    }
    box->inner = make_paned("Divider between picture and inspector", middle,
                            box->panes[STUDIO_PANE_INSPECTOR], false);
    box->outer = make_paned("Divider between panel and picture", box->panes[STUDIO_PANE_SIDE],
                            GTK_WIDGET(box->inner), true);
    gtk_widget_set_parent(GTK_WIDGET(box->outer), GTK_WIDGET(box));
    return GTK_WIDGET(box);
}
