#include "studio/messages.h"

#include <adwaita.h>

enum { SAID_SECONDS = 4, UNDO_SECONDS = 8 };

struct StudioMessages {
    AdwToastOverlay *overlay;
    AdwToast *toast; // what is said; NULL: nothing
    guint timer;     // ends it; 0: nothing is said, or it stays
    gboolean stays;
};

static void forget(StudioMessages *messages) {
    g_clear_weak_pointer(&messages->toast);
    g_clear_handle_id(&messages->timer, g_source_remove);
}

static void on_dismissed(AdwToast *toast, StudioMessages *messages) {
    if (messages->toast == toast) {
        forget(messages);
    }
}

static gboolean on_said_long_enough(gpointer user) {
    StudioMessages *messages = user;
    messages->timer = 0;
    adw_toast_dismiss(messages->toast);
    return G_SOURCE_REMOVE;
}

// What is said while something is shown takes its place: libadwaita 1.2 uses a toast after it has
// freed it where one is dismissed before it has come up wholly.
void studio_messages_say(StudioMessages *messages, const char *text, bool can_undo) {
    char *escaped = g_markup_escape_text(text, -1);
    if (messages->toast == NULL) {
        AdwToast *toast = adw_toast_new(escaped);
        adw_toast_set_timeout(toast, 0); // our own timer: it begins anew with each text
        g_set_weak_pointer(&messages->toast, toast);
        g_signal_connect(toast, "dismissed", G_CALLBACK(on_dismissed), messages);
        adw_toast_overlay_add_toast(messages->overlay, toast);
    }
    adw_toast_set_title(messages->toast, escaped);
    adw_toast_set_button_label(messages->toast, can_undo ? "_Undo" : NULL);
    adw_toast_set_action_name(messages->toast, can_undo ? "win.undo" : NULL);
    g_clear_handle_id(&messages->timer, g_source_remove);
    if (!messages->stays) {
        messages->timer = g_timeout_add_seconds(can_undo ? UNDO_SECONDS : SAID_SECONDS,
                                                on_said_long_enough, messages);
    }
    g_free(escaped);
}

void studio_messages_stay(StudioMessages *messages) {
    messages->stays = TRUE;
}

void studio_messages_forget_undo(StudioMessages *messages) {
    if (messages->toast != NULL) {
        adw_toast_set_button_label(messages->toast, NULL);
    }
}

const char *studio_messages_said(const StudioMessages *messages) {
    return messages->toast == NULL ? NULL : adw_toast_get_title(messages->toast);
}

GtkWidget *studio_messages_widget(const StudioMessages *messages) {
    return GTK_WIDGET(messages->overlay);
}

StudioMessages *studio_messages_new(GtkWidget *under) {
    StudioMessages *messages = g_new0(StudioMessages, 1);
    messages->overlay = ADW_TOAST_OVERLAY(adw_toast_overlay_new());
    adw_toast_overlay_set_child(messages->overlay, under);
    return messages;
}

void studio_messages_free(StudioMessages *messages) {
    if (messages != NULL) {
        if (messages->toast != NULL) {
            g_signal_handlers_disconnect_by_data(messages->toast, messages);
        }
        forget(messages);
        g_free(messages);
    }
}
