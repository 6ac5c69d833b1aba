#include "studio/text_panel.h"

#include <adwaita.h>
#include <gtksourceview/gtksource.h>
#include <string.h>

struct _StudioTextPanel {
    GtkBox parent;
    StudioDocument *document; // borrowed
    GtkSourceBuffer *buffer;
    GtkWidget *view;
    GtkTextTag *error, *warning;
    gboolean is_showing, is_typing;
    guint seal; // timer that ends a step of typing
};

enum { SEAL_MILLISECONDS = 900 };

G_DEFINE_TYPE(StudioTextPanel, studio_text_panel, GTK_TYPE_BOX)

static GtkTextBuffer *buffer_of(StudioTextPanel *panel) {
    return GTK_TEXT_BUFFER(panel->buffer);
}

static char *text_of(StudioTextPanel *panel) {
    GtkTextIter begin, end;
    gtk_text_buffer_get_bounds(buffer_of(panel), &begin, &end);
    return gtk_text_buffer_get_text(buffer_of(panel), &begin, &end, TRUE);
}

// ---- typing ------------------------------------------------------------------------------------

static gboolean on_seal(gpointer data) {
    StudioTextPanel *panel = data;
    panel->seal = 0;
    if (panel->document != NULL) {
        studio_document_seal(panel->document);
    }
    return G_SOURCE_REMOVE;
}

static void on_changed(GtkTextBuffer *buffer, StudioTextPanel *panel) {
    (void)buffer;
    if (panel->is_showing || panel->document == NULL) {
        return;
    }
    char *text = text_of(panel);
    panel->is_typing = TRUE;
    studio_document_replace(panel->document, text, strlen(text), "Type", "text");
    panel->is_typing = FALSE;
    g_free(text);
    g_clear_handle_id(&panel->seal, g_source_remove);
    panel->seal = g_timeout_add(SEAL_MILLISECONDS, on_seal, panel);
}

// ---- showing -----------------------------------------------------------------------------------

// Bytes to a place in the buffer.
static void place_of(StudioTextPanel *panel, const char *text, uint32_t offset, GtkTextIter *at) {
    gtk_text_buffer_get_iter_at_offset(buffer_of(panel), at,
                                       (int)g_utf8_strlen(text, (gssize)offset));
}

static void mark(StudioTextPanel *panel, const FrDiags *diags) {
    GtkTextIter begin, end;
    gtk_text_buffer_get_bounds(buffer_of(panel), &begin, &end);
    gtk_text_buffer_remove_tag(buffer_of(panel), panel->error, &begin, &end);
    gtk_text_buffer_remove_tag(buffer_of(panel), panel->warning, &begin, &end);
    size_t size;
    const char *text = fr_source_text(studio_document_source(panel->document), &size);
    for (size_t i = 0; diags != NULL && i < fr_diags_count(diags); i++) {
        const FrDiag *diag = fr_diags_get(diags, i);
        if (diag->span.source == NULL || diag->span.end > size) {
            continue;
        }
        place_of(panel, text, diag->span.begin, &begin);
        place_of(panel, text, MAX(diag->span.end, diag->span.begin + 1), &end);
        gtk_text_buffer_apply_tag(buffer_of(panel),
                                  diag->severity == FR_ERROR ? panel->error : panel->warning,
                                  &begin, &end);
    }
}

void studio_text_panel_show(StudioTextPanel *panel, StudioDocument *document,
                            const FrDiags *diags) {
    panel->document = document;
    size_t size;
    const char *text = fr_source_text(studio_document_source(document), &size);
    if (!panel->is_typing && g_utf8_validate(text, (gssize)size, NULL)) {
        char *shown = text_of(panel);
        panel->is_showing = TRUE;
        if (strcmp(shown, text) != 0) {
            GtkTextMark *cursor = gtk_text_buffer_get_insert(buffer_of(panel));
            GtkTextIter at;
            gtk_text_buffer_get_iter_at_mark(buffer_of(panel), &at, cursor);
            int line = gtk_text_iter_get_line(&at);
            gtk_text_buffer_set_text(buffer_of(panel), text, (int)size);
            gtk_text_buffer_get_iter_at_line(buffer_of(panel), &at, line);
            gtk_text_buffer_place_cursor(buffer_of(panel), &at);
        }
        panel->is_showing = FALSE;
        g_free(shown);
    }
    mark(panel, diags);
}

void studio_text_panel_go(StudioTextPanel *panel, uint32_t offset) {
    GtkTextIter at;
    place_of(panel, fr_source_text(studio_document_source(panel->document), NULL), offset, &at);
    gtk_text_buffer_place_cursor(buffer_of(panel), &at);
    gtk_text_view_scroll_to_iter(GTK_TEXT_VIEW(panel->view), &at, 0.2, FALSE, 0, 0);
    gtk_widget_grab_focus(panel->view);
}

// ---- life --------------------------------------------------------------------------------------

static void follow_scheme(StudioTextPanel *panel) {
    bool is_dark = adw_style_manager_get_dark(adw_style_manager_get_default());
    GtkSourceStyleSchemeManager *manager = gtk_source_style_scheme_manager_get_default();
    GtkSourceStyleScheme *scheme =
        gtk_source_style_scheme_manager_get_scheme(manager, is_dark ? "Adwaita-dark" : "Adwaita");
    gtk_source_buffer_set_style_scheme(panel->buffer, scheme);
}

static void on_dark(AdwStyleManager *manager, GParamSpec *spec, StudioTextPanel *panel) {
    (void)manager;
    (void)spec;
    follow_scheme(panel);
}

static void studio_text_panel_dispose(GObject *object) {
    StudioTextPanel *panel = STUDIO_TEXT_PANEL(object);
    g_clear_handle_id(&panel->seal, g_source_remove);
    panel->document = NULL;
    g_clear_object(&panel->buffer);
    G_OBJECT_CLASS(studio_text_panel_parent_class)->dispose(object);
}

static void studio_text_panel_class_init(StudioTextPanelClass *class) {
    G_OBJECT_CLASS(class)->dispose = studio_text_panel_dispose;
}

static void studio_text_panel_init(StudioTextPanel *panel) {
    GtkSourceLanguage *xml =
        gtk_source_language_manager_get_language(gtk_source_language_manager_get_default(), "xml");
    panel->buffer = gtk_source_buffer_new(NULL);
    gtk_source_buffer_set_language(panel->buffer, xml);
    gtk_text_buffer_set_enable_undo(buffer_of(panel), FALSE); // the document's undo is for all
    follow_scheme(panel);
    g_signal_connect_object(adw_style_manager_get_default(), "notify::dark", G_CALLBACK(on_dark),
                            panel, 0);
    panel->error = gtk_text_buffer_create_tag(buffer_of(panel), NULL, "underline",
                                              PANGO_UNDERLINE_ERROR, NULL);
    GdkRGBA amber = {0.9f, 0.65f, 0.1f, 1};
    panel->warning = gtk_text_buffer_create_tag(
        buffer_of(panel), NULL, "underline", PANGO_UNDERLINE_ERROR, "underline-rgba", &amber, NULL);
    panel->view = gtk_source_view_new_with_buffer(panel->buffer);
    gtk_source_view_set_show_line_numbers(GTK_SOURCE_VIEW(panel->view), TRUE);
    gtk_source_view_set_tab_width(GTK_SOURCE_VIEW(panel->view), 2);
    gtk_source_view_set_insert_spaces_instead_of_tabs(GTK_SOURCE_VIEW(panel->view), TRUE);
    gtk_source_view_set_auto_indent(GTK_SOURCE_VIEW(panel->view), TRUE);
    gtk_text_view_set_monospace(GTK_TEXT_VIEW(panel->view), TRUE);
    gtk_widget_set_name(panel->view, "text");
    gtk_accessible_update_property(GTK_ACCESSIBLE(panel->view), GTK_ACCESSIBLE_PROPERTY_LABEL,
                                   "Text of the document", -1);
    g_signal_connect(panel->buffer, "changed", G_CALLBACK(on_changed), panel);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), panel->view);
    gtk_widget_set_vexpand(scrolled, TRUE);
    gtk_widget_set_hexpand(scrolled, TRUE);
    gtk_box_append(GTK_BOX(panel), scrolled);
}

GtkWidget *studio_text_panel_new(void) {
    return g_object_new(STUDIO_TYPE_TEXT_PANEL, NULL);
}
