/// Escape while a pointer is pressed takes back what it has done, whatever it drags.
#include "studio/window_private.h"

// Those who draw the drag have their last say before changes are taken again.
static gboolean on_released(gpointer data) {
    StudioWindow *window = data;
    if (window->document != NULL) {
        studio_document_release(window->document);
    }
    return G_SOURCE_REMOVE;
}

static gboolean on_event(GtkEventControllerLegacy *controller, GdkEvent *event,
                         StudioWindow *window) {
    (void)controller;
    GdkEventType type = gdk_event_get_event_type(event);
    if (window->document == NULL) {
        return FALSE;
    }
    if (type == GDK_BUTTON_PRESS || type == GDK_TOUCH_BEGIN) {
        studio_document_hold(window->document);
    } else if (type == GDK_BUTTON_RELEASE || type == GDK_TOUCH_END || type == GDK_TOUCH_CANCEL) {
        g_idle_add_full(G_PRIORITY_HIGH, on_released, window, NULL);
    }
    return FALSE;
}

// The graph and the drawing plane put down by themselves what the document does not know of.
static bool has_own_cancel(StudioWindow *window) {
    GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));
    return studio_window_is_sketching(window) ||
           (focus != NULL && (focus == GTK_WIDGET(window->graph) ||
                              gtk_widget_is_ancestor(focus, GTK_WIDGET(window->graph))));
}

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioWindow *window) {
    (void)keys;
    (void)code;
    (void)state;
    return key == GDK_KEY_Escape && window->document != NULL &&
           studio_document_abandon(window->document) && !has_own_cancel(window);
}

void studio_window_add_cancel(StudioWindow *window) {
    GtkEventController *events = gtk_event_controller_legacy_new();
    gtk_event_controller_set_propagation_phase(events, GTK_PHASE_CAPTURE);
    g_signal_connect(events, "event", G_CALLBACK(on_event), window);
    gtk_widget_add_controller(GTK_WIDGET(window), events);
    GtkEventController *keys = gtk_event_controller_key_new();
    gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), window);
    gtk_widget_add_controller(GTK_WIDGET(window), keys);
}
