#include "studio/messages.h"

#include <adwaita.h>

enum { SAID_SECONDS = 4, UNDO_SECONDS = 8 };
enum { MOST_LETTERS = 60, LEAST_LETTERS = 12, BUTTON_ROOM = 120, UNDO_ROOM = 80 };

struct StudioMessages {
    AdwToastOverlay *overlay;
    AdwToast *toast; // what is said; NULL: nothing
    GtkLabel *words; // of the toast
    guint timer;     // ends it; 0: nothing is said, or it stays
    gboolean stays;
};

static void forget(StudioMessages *messages) {
    g_clear_weak_pointer(&messages->toast);
    messages->words = NULL;
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

// A toast's own title is one line that is cut where it is too long.
static GtkWidget *make_words(void) {
    GtkWidget *words = gtk_label_new(NULL);
    GtkLabel *label = GTK_LABEL(words);
    gtk_label_set_wrap(label, TRUE);
    gtk_label_set_wrap_mode(label, PANGO_WRAP_WORD_CHAR);
    gtk_label_set_xalign(label, 0);
    gtk_widget_set_hexpand(words, TRUE);
    gtk_widget_add_css_class(words, "heading");
    return words;
}

// The words are as wide as they are long, but not wider than there is room for: a toast that could
// become narrower is drawn too low for the lines that its words then take.
static void fit_words(StudioMessages *messages, const char *text, bool can_undo) {
    GtkWidget *overlay = GTK_WIDGET(messages->overlay);
    PangoFontMetrics *metrics =
        pango_context_get_metrics(gtk_widget_get_pango_context(overlay), NULL, NULL);
    int letter = MAX(pango_font_metrics_get_approximate_char_width(metrics),
                     pango_font_metrics_get_approximate_digit_width(metrics));
    pango_font_metrics_unref(metrics);
    int room = gtk_widget_get_width(overlay) - BUTTON_ROOM - (can_undo ? UNDO_ROOM : 0);
    double bold = 1.15; // times as wide as plain letters
    int most = (int)(room * PANGO_SCALE / (bold * MAX(letter, 1)));
    most = CLAMP(most, LEAST_LETTERS, MOST_LETTERS);
    gtk_label_set_max_width_chars(messages->words, most);
    gtk_label_set_width_chars(messages->words, (int)MIN(g_utf8_strlen(text, -1) * 5 / 4, most));
    gtk_label_set_text(messages->words, text);
}

// What is said while something is shown takes its place: libadwaita 1.2 uses a toast after it has
// freed it where one is dismissed before it has come up wholly.
void studio_messages_say(StudioMessages *messages, const char *text, bool can_undo) {
    if (messages->toast == NULL) {
        AdwToast *toast = adw_toast_new("");
        adw_toast_set_timeout(toast, 0); // our own timer: it begins anew with each text
        g_set_weak_pointer(&messages->toast, toast);
        messages->words = GTK_LABEL(make_words());
        adw_toast_set_custom_title(toast, GTK_WIDGET(messages->words));
        g_signal_connect(toast, "dismissed", G_CALLBACK(on_dismissed), messages);
        adw_toast_overlay_add_toast(messages->overlay, toast);
    }
    fit_words(messages, text, can_undo);
    adw_toast_set_button_label(messages->toast, can_undo ? "_Undo" : NULL);
    adw_toast_set_action_name(messages->toast, can_undo ? "win.undo" : NULL);
    g_clear_handle_id(&messages->timer, g_source_remove);
    if (!messages->stays) {
        messages->timer = g_timeout_add_seconds(can_undo ? UNDO_SECONDS : SAID_SECONDS,
                                                on_said_long_enough, messages);
    }
}

void studio_messages_stay(StudioMessages *messages, gboolean stays) {
    messages->stays = stays;
    if (!stays && messages->toast != NULL && messages->timer == 0) {
        messages->timer = g_timeout_add_seconds(SAID_SECONDS, on_said_long_enough, messages);
    }
}

void studio_messages_forget_undo(StudioMessages *messages) {
    if (messages->toast != NULL) {
        adw_toast_set_button_label(messages->toast, NULL);
    }
}

const char *studio_messages_said(const StudioMessages *messages) {
    return messages->toast == NULL ? NULL : gtk_label_get_text(messages->words);
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
