#include "studio/things_panel.h"

#include "studio/accessible.h"

#include <string.h>

enum { INDENT = 16 };

struct _StudioThingsPanel {
    GtkBox parent;
    GtkWidget *list;
    uint64_t revision; // of what is listed
    const StudioDocument *document;
    gboolean is_showing;
};

static guint selected_signal;

G_DEFINE_TYPE(StudioThingsPanel, studio_things_panel, GTK_TYPE_BOX)

static const char key[] = "studio-element";

static void on_row(GtkListBox *list, GtkListBoxRow *row, StudioThingsPanel *panel) {
    (void)list;
    if (row != NULL && !panel->is_showing) {
        g_signal_emit(panel, selected_signal, 0,
                      GPOINTER_TO_UINT(g_object_get_data(G_OBJECT(row), key)));
    }
}

static guint depth_of(const FrContents *contents, uint32_t element) {
    guint depth = 0;
    for (uint32_t i = fr_contents_at(contents, element)->parent; i != FR_NONE;
         i = fr_contents_at(contents, i)->parent) {
        depth++;
    }
    return depth;
}

static GtkWidget *make_row(const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_widget_set_margin_start(box, (int)((depth_of(contents, element) - 1) * INDENT + 4));
    char *called = g_strdup(at->id);
    if (called == NULL && strcmp(at->name, "link") == 0) {
        char *from = fr_contents_get(contents, element, "from");
        char *to = fr_contents_get(contents, element, "to");
        called = g_strdup_printf("%s → %s", from, to);
        g_free(from);
        g_free(to);
    }
    static const char *const telling[][2] = {
        {"edit", "at"},   {"place", "plant"},  {"row", "plants"},
        {"view", "name"}, {"strew", "plants"}, {"obstacle", "shape"},
    };
    for (size_t i = 0; called == NULL && i < G_N_ELEMENTS(telling); i++) {
        if (strcmp(at->name, telling[i][0]) == 0) {
            called = fr_contents_get(contents, element, telling[i][1]);
        }
    }
    GtkWidget *name = gtk_label_new(called != NULL ? called : at->name);
    gtk_label_set_xalign(GTK_LABEL(name), 0);
    gtk_label_set_ellipsize(GTK_LABEL(name), PANGO_ELLIPSIZE_END);
    gtk_widget_set_hexpand(name, TRUE);
    gtk_box_append(GTK_BOX(box), name);
    if (called != NULL) {
        GtkWidget *kind = gtk_label_new(at->name);
        gtk_widget_add_css_class(kind, "dim-label");
        gtk_widget_add_css_class(kind, "caption");
        gtk_box_append(GTK_BOX(box), kind);
    }
    GtkWidget *row = gtk_list_box_row_new();
    gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
    g_object_set_data(G_OBJECT(row), key, GUINT_TO_POINTER(element));
    char *said = called == NULL ? g_strdup(at->name) : g_strdup_printf("%s, %s", called, at->name);
    studio_name(row, said);
    g_free(said);
    g_free(called);
    return row;
}

static void fill(StudioThingsPanel *panel, const FrContents *contents) {
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(panel->list)) != NULL) {
        gtk_list_box_remove(GTK_LIST_BOX(panel->list), child);
    }
    for (uint32_t i = 1; i < fr_contents_count(contents); i++) {
        gtk_list_box_append(GTK_LIST_BOX(panel->list), make_row(contents, i));
    }
}

void studio_things_panel_show(StudioThingsPanel *panel, StudioDocument *document,
                              uint32_t selected) {
    const FrContents *contents = studio_document_contents(document);
    panel->is_showing = TRUE;
    if (panel->document != document || panel->revision != studio_document_revision(document)) {
        fill(panel, contents);
        panel->document = document;
        panel->revision = studio_document_revision(document);
    }
    GtkListBoxRow *row =
        selected == FR_NONE || selected == 0
            ? NULL
            : gtk_list_box_get_row_at_index(GTK_LIST_BOX(panel->list), (int)selected - 1);
    if (row != NULL) {
        gtk_list_box_select_row(GTK_LIST_BOX(panel->list), row);
    } else {
        gtk_list_box_unselect_all(GTK_LIST_BOX(panel->list));
    }
    panel->is_showing = FALSE;
}

static void studio_things_panel_class_init(StudioThingsPanelClass *class) {
    selected_signal = g_signal_new("selected", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL,
                                   NULL, NULL, G_TYPE_NONE, 1, G_TYPE_UINT);
}

static void studio_things_panel_init(StudioThingsPanel *panel) {
    panel->list = gtk_list_box_new();
    gtk_widget_add_css_class(panel->list, "navigation-sidebar");
    studio_name(panel->list, "Contents of the document");
    g_signal_connect(panel->list, "row-selected", G_CALLBACK(on_row), panel);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), panel->list);
    gtk_widget_set_vexpand(scrolled, TRUE);
    gtk_widget_set_hexpand(scrolled, TRUE);
    gtk_box_append(GTK_BOX(panel), scrolled);
}

GtkWidget *studio_things_panel_new(void) {
    return g_object_new(STUDIO_TYPE_THINGS_PANEL, NULL);
}
