#include "studio/wrap_box.h"

#include <stdbool.h>

struct _StudioWrapBox {
    GtkWidget parent;
    int gap;
};

G_DEFINE_TYPE(StudioWrapBox, studio_wrap_box, GTK_TYPE_WIDGET)

static int width_of(GtkWidget *child) {
    int natural;
    gtk_widget_measure(child, GTK_ORIENTATION_HORIZONTAL, -1, NULL, &natural, NULL, NULL);
    return natural;
}

static int height_of(GtkWidget *child, int width) {
    int natural;
    gtk_widget_measure(child, GTK_ORIENTATION_VERTICAL, width, NULL, &natural, NULL, NULL);
    return natural;
}

// How high all rows are together.
static int lay_out(GtkWidget *box, int width, bool is_placed) {
    int gap = STUDIO_WRAP_BOX(box)->gap;
    int x = 0, y = 0, row = 0;
    for (GtkWidget *child = gtk_widget_get_first_child(box); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        if (!gtk_widget_should_layout(child)) {
            continue;
        }
        int wide = MIN(width_of(child), width), high = height_of(child, wide);
        if (x > 0 && x > width - wide) {
            y += row + gap;
            x = row = 0;
        }
        if (is_placed) {
            gtk_widget_size_allocate(child, &(GtkAllocation){x, y, wide, high}, -1);
        }
        x += wide + gap;
        row = MAX(row, high);
    }
    return y + row;
}

static GtkSizeRequestMode on_mode(GtkWidget *box) {
    (void)box;
    return GTK_SIZE_REQUEST_HEIGHT_FOR_WIDTH;
}

static void on_measure(GtkWidget *box, GtkOrientation orientation, int for_size, int *minimum,
                       int *natural, int *minimum_baseline, int *natural_baseline) {
    *minimum_baseline = *natural_baseline = -1;
    if (orientation == GTK_ORIENTATION_VERTICAL) {
        *minimum = *natural = lay_out(box, for_size < 0 ? G_MAXINT : for_size, false);
        return;
    }
    *minimum = *natural = 0;
    for (GtkWidget *child = gtk_widget_get_first_child(box); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        if (gtk_widget_should_layout(child)) {
            int wide = width_of(child);
            int gap = *natural > 0 ? STUDIO_WRAP_BOX(box)->gap : 0;
            *minimum = MAX(*minimum, wide);
            *natural += gap + wide;
        }
    }
}

static void on_allocate(GtkWidget *box, int width, int height, int baseline) {
    (void)height;
    (void)baseline;
    lay_out(box, width, true);
}

static void studio_wrap_box_dispose(GObject *object) {
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(GTK_WIDGET(object))) != NULL) {
        gtk_widget_unparent(child);
    }
    G_OBJECT_CLASS(studio_wrap_box_parent_class)->dispose(object);
}

static void studio_wrap_box_class_init(StudioWrapBoxClass *class) {
    G_OBJECT_CLASS(class)->dispose = studio_wrap_box_dispose;
    GTK_WIDGET_CLASS(class)->get_request_mode = on_mode;
    GTK_WIDGET_CLASS(class)->measure = on_measure;
    GTK_WIDGET_CLASS(class)->size_allocate = on_allocate;
}

static void studio_wrap_box_init(StudioWrapBox *box) {
    (void)box;
}

GtkWidget *studio_wrap_box_new(int gap) {
    StudioWrapBox *box = g_object_new(STUDIO_TYPE_WRAP_BOX, NULL);
    box->gap = gap;
    return GTK_WIDGET(box);
}

void studio_wrap_box_append(StudioWrapBox *box, GtkWidget *child) {
    gtk_widget_insert_before(child, GTK_WIDGET(box), NULL);
}
