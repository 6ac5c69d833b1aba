#include "studio/text_panel.h"

#include "studio/accessible.h"
#include "studio/model/place.h"

#include <adwaita.h>
#include <gtksourceview/gtksource.h>
#include <string.h>

struct _StudioTextPanel {
    GtkBox parent;
    StudioDocument *document; // borrowed
    char *place;              // of the element whose text it is; NULL: the whole document's
    GtkSourceBuffer *buffer;
    GtkWidget *view, *note; // a label: why nothing can be typed
    GtkTextTag *error, *warning, *pointed;
    gboolean is_showing, is_typing;
    gboolean is_foreign; // the document is not UTF-8: its text is shown as well as can be
    guint seal;          // timer that ends a step of typing
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
    if (panel->is_showing || panel->document == NULL || panel->is_foreign) {
        return;
    }
    char *text = text_of(panel);
    panel->is_typing = TRUE;
    if (panel->place == NULL) {
        studio_document_replace(panel->document, text, strlen(text), "Type", "text");
    } else {
        const FrContents *contents = studio_document_contents(panel->document);
        uint32_t element = studio_place_find(contents, panel->place);
        if (element != FR_NONE) {
            studio_document_splice_one(panel->document,
                                       fr_contents_set_text(contents, element, text), "Type",
                                       panel->place);
        }
    }
    panel->is_typing = FALSE;
    g_free(text);
    g_clear_handle_id(&panel->seal, g_source_remove);
    panel->seal = g_timeout_add(SEAL_MILLISECONDS, on_seal, panel);
}

// ---- showing -----------------------------------------------------------------------------------

// How long a piece of XML is, and how many bytes of text it means: an opened or closed CDATA
// section and a comment are none, a reference is one.
static size_t piece_at(const char *xml, const char *end, size_t *meaning) {
    const char *closed = NULL;
    *meaning = 0;
    if (g_str_has_prefix(xml, "<![CDATA[")) {
        return strlen("<![CDATA[");
    }
    if (g_str_has_prefix(xml, "]]>")) {
        return strlen("]]>");
    }
    if (g_str_has_prefix(xml, "<!--") && (closed = strstr(xml, "-->")) != NULL) {
        return (size_t)(closed - xml) + strlen("-->");
    }
    *meaning = 1;
    closed = *xml == '&' ? memchr(xml, ';', (size_t)(end - xml)) : NULL;
    return closed == NULL ? 1 : (size_t)(closed - xml) + 1;
}

// Bytes of the whole document, as far as `end`, in UTF-8. Free with g_free().
static char *whole_text(StudioDocument *document, size_t end) {
    size_t size;
    const char *text = fr_source_text(studio_document_source(document), &size);
    return g_utf8_make_valid(text, (gssize)MIN(size, end));
}

// Where a byte of the document is in the text that is shown; FR_NONE: outside.
static uint32_t shown_offset(StudioTextPanel *panel, uint32_t offset) {
    if (panel->place == NULL && panel->is_foreign) {
        char *before = whole_text(panel->document, offset);
        uint32_t shown = (uint32_t)strlen(before);
        g_free(before);
        return shown;
    }
    if (panel->place == NULL) {
        return offset;
    }
    const FrContents *contents = studio_document_contents(panel->document);
    uint32_t element = studio_place_find(contents, panel->place);
    FrSpan place = {0};
    if (element != FR_NONE) {
        g_free(fr_contents_text(contents, element, &place));
    }
    if (place.source == NULL || offset < place.begin || offset > place.end) {
        return FR_NONE;
    }
    const char *text = fr_source_text(place.source, NULL);
    uint32_t shown = 0;
    for (uint32_t at = place.begin; at < offset;) {
        size_t meaning;
        at += (uint32_t)piece_at(text + at, text + place.end, &meaning);
        shown += (uint32_t)meaning;
    }
    return shown;
}

// Bytes of what is shown to a place in the buffer.
static void place_of(StudioTextPanel *panel, const char *shown, uint32_t offset, GtkTextIter *at) {
    gtk_text_buffer_get_iter_at_offset(
        buffer_of(panel), at,
        (int)g_utf8_strlen(shown, (gssize)MIN((size_t)offset, strlen(shown))));
}

static void underline(StudioTextPanel *panel, const FrDiags *diags) {
    GtkTextIter begin, end;
    gtk_text_buffer_get_bounds(buffer_of(panel), &begin, &end);
    gtk_text_buffer_remove_tag(buffer_of(panel), panel->error, &begin, &end);
    gtk_text_buffer_remove_tag(buffer_of(panel), panel->warning, &begin, &end);
    char *shown = text_of(panel);
    for (size_t i = 0; diags != NULL && i < fr_diags_count(diags); i++) {
        const FrDiag *diag = fr_diags_get(diags, i);
        uint32_t from = diag->span.source == NULL ? FR_NONE : shown_offset(panel, diag->span.begin);
        uint32_t to = from == FR_NONE ? FR_NONE : shown_offset(panel, diag->span.end);
        if (from == FR_NONE || to == FR_NONE) {
            continue;
        }
        place_of(panel, shown, from, &begin);
        place_of(panel, shown, MAX(to, from + 1), &end);
        gtk_text_buffer_apply_tag(buffer_of(panel),
                                  diag->severity == FR_ERROR ? panel->error : panel->warning,
                                  &begin, &end);
    }
    g_free(shown);
}

static void fill(StudioTextPanel *panel, const char *text) {
    char *shown = text_of(panel);
    if (strcmp(shown, text) != 0) {
        GtkTextIter at;
        gtk_text_buffer_get_iter_at_mark(buffer_of(panel), &at,
                                         gtk_text_buffer_get_insert(buffer_of(panel)));
        int line = gtk_text_iter_get_line(&at);
        panel->is_showing = TRUE;
        gtk_text_buffer_set_text(buffer_of(panel), text, -1);
        panel->is_showing = FALSE;
        gtk_text_buffer_get_iter_at_line(buffer_of(panel), &at, line);
        gtk_text_buffer_place_cursor(buffer_of(panel), &at);
    }
    g_free(shown);
}

void studio_text_panel_show(StudioTextPanel *panel, StudioDocument *document, uint32_t element,
                            const FrDiags *diags) {
    const FrContents *contents = studio_document_contents(document);
    panel->document = document;
    g_free(panel->place);
    panel->place = element == FR_NONE ? NULL : studio_place_of(contents, element);
    panel->is_foreign = !studio_document_is_text(document);
    gtk_text_view_set_editable(GTK_TEXT_VIEW(panel->view), !panel->is_foreign);
    gtk_widget_set_visible(panel->note, panel->is_foreign);
    char *text = element == FR_NONE ? whole_text(document, SIZE_MAX)
                                    : fr_contents_text(contents, element, NULL);
    if (!panel->is_typing) {
        fill(panel, text);
    }
    g_free(text);
    underline(panel, diags);
}

void studio_text_panel_mark(StudioTextPanel *panel, uint32_t begin, uint32_t end) {
    GtkTextIter from, to;
    gtk_text_buffer_get_bounds(buffer_of(panel), &from, &to);
    gtk_text_buffer_remove_tag(buffer_of(panel), panel->pointed, &from, &to);
    uint32_t first =
        begin == FR_NONE || panel->document == NULL ? FR_NONE : shown_offset(panel, begin);
    uint32_t last = first == FR_NONE ? FR_NONE : shown_offset(panel, end);
    if (last != FR_NONE) {
        char *shown = text_of(panel);
        place_of(panel, shown, first, &from);
        place_of(panel, shown, last, &to);
        g_free(shown);
        gtk_text_buffer_apply_tag(buffer_of(panel), panel->pointed, &from, &to);
        gtk_text_view_scroll_to_iter(GTK_TEXT_VIEW(panel->view), &from, 0.1, FALSE, 0, 0);
    }
}

void studio_text_panel_forget(StudioTextPanel *panel) {
    g_clear_handle_id(&panel->seal, g_source_remove);
    panel->document = NULL;
}

void studio_text_panel_go(StudioTextPanel *panel, uint32_t offset) {
    GtkTextIter at;
    char *shown = text_of(panel);
    place_of(panel, shown, offset, &at);
    g_free(shown);
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
    g_clear_pointer(&panel->place, g_free);
    g_clear_object(&panel->buffer);
    G_OBJECT_CLASS(studio_text_panel_parent_class)->dispose(object);
}

static void studio_text_panel_class_init(StudioTextPanelClass *class) {
    G_OBJECT_CLASS(class)->dispose = studio_text_panel_dispose;
}

static void studio_text_panel_init(StudioTextPanel *panel) {
    GtkSourceLanguage *xml =
        gtk_source_language_manager_get_language(gtk_source_language_manager_get_default(), "xml");
    gtk_orientable_set_orientation(GTK_ORIENTABLE(panel), GTK_ORIENTATION_VERTICAL);
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
    GdkRGBA blue = {0.21f, 0.52f, 0.89f, 0.4f};
    panel->pointed =
        gtk_text_buffer_create_tag(buffer_of(panel), NULL, "background-rgba", &blue, NULL);
    panel->view = gtk_source_view_new_with_buffer(panel->buffer);
    gtk_source_view_set_show_line_numbers(GTK_SOURCE_VIEW(panel->view), TRUE);
    gtk_source_view_set_tab_width(GTK_SOURCE_VIEW(panel->view), 2);
    gtk_source_view_set_insert_spaces_instead_of_tabs(GTK_SOURCE_VIEW(panel->view), TRUE);
    gtk_source_view_set_auto_indent(GTK_SOURCE_VIEW(panel->view), TRUE);
    gtk_text_view_set_monospace(GTK_TEXT_VIEW(panel->view), TRUE);
    studio_name(panel->view, "Text of the document");
    g_signal_connect(panel->buffer, "changed", G_CALLBACK(on_changed), panel);
    panel->note = gtk_label_new("This is not UTF-8: it can be read here, but not changed");
    gtk_widget_set_name(panel->note, "text-note");
    gtk_widget_add_css_class(panel->note, "text-note");
    gtk_label_set_wrap(GTK_LABEL(panel->note), TRUE);
    gtk_label_set_xalign(GTK_LABEL(panel->note), 0);
    gtk_widget_set_visible(panel->note, FALSE);
    gtk_box_append(GTK_BOX(panel), panel->note);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), panel->view);
    gtk_widget_set_vexpand(scrolled, TRUE);
    gtk_widget_set_hexpand(scrolled, TRUE);
    gtk_box_append(GTK_BOX(panel), scrolled);
}

GtkWidget *studio_text_panel_new(const char *language) {
    StudioTextPanel *panel = g_object_new(STUDIO_TYPE_TEXT_PANEL, NULL);
    gtk_widget_set_name(panel->view, language);
    gtk_source_buffer_set_language(panel->buffer,
                                   gtk_source_language_manager_get_language(
                                       gtk_source_language_manager_get_default(), language));
    return GTK_WIDGET(panel);
}
