#include "studio/short_entry.h"

#include "studio/model/values.h"

#include <string.h>

static const char key[] = "studio-short-entry";

typedef struct ShortEntry {
    GtkEditable *entry;
    char *value;                  // whole
    gboolean is_short, is_edited; // the text is a shorter one; it has the focus
} ShortEntry;

static void show(ShortEntry *at) {
    char *text = at->is_edited ? g_strdup(at->value) : studio_value_short(at->value);
    at->is_short = strcmp(text, at->value) != 0;
    if (strcmp(gtk_editable_get_text(at->entry), text) != 0) {
        gtk_editable_set_text(at->entry, text);
    }
    g_free(text);
}

static void on_enter(GtkEventControllerFocus *focus, ShortEntry *at) {
    (void)focus;
    at->is_edited = TRUE;
    if (at->is_short) {
        show(at);
    }
}

static void on_leave(GtkEventControllerFocus *focus, ShortEntry *at) {
    (void)focus;
    at->is_edited = FALSE;
    if (strcmp(gtk_editable_get_text(at->entry), at->value) == 0) {
        show(at);
    }
}

static void entry_free(gpointer data) {
    g_free(((ShortEntry *)data)->value);
    g_free(data);
}

GtkWidget *studio_short_entry_new(void) {
    GtkWidget *entry = gtk_entry_new();
    ShortEntry *at = g_new0(ShortEntry, 1);
    at->entry = GTK_EDITABLE(entry);
    at->value = g_strdup("");
    g_object_set_data_full(G_OBJECT(entry), key, at, entry_free);
    GtkEventController *focus = gtk_event_controller_focus_new();
    g_signal_connect(focus, "enter", G_CALLBACK(on_enter), at);
    g_signal_connect(focus, "leave", G_CALLBACK(on_leave), at);
    gtk_widget_add_controller(entry, focus);
    return entry;
}

void studio_short_entry_show(GtkWidget *entry, const char *value) {
    ShortEntry *at = g_object_get_data(G_OBJECT(entry), key);
    char *own = g_strdup(value);
    g_free(at->value);
    at->value = own;
    show(at);
}

const char *studio_short_entry_text(GtkWidget *entry) {
    const ShortEntry *at = g_object_get_data(G_OBJECT(entry), key);
    return at->is_short ? at->value : gtk_editable_get_text(at->entry);
}
