#include "studio/widgets.h"

#include "studio/accessible.h"

GtkWidget *studio_action_button(const char *icon, const char *action, const char *tip) {
    GtkWidget *button = gtk_button_new_from_icon_name(icon);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
    studio_tell(button, tip);
    return button;
}

GtkWidget *studio_flat_button(const char *icon, const char *tip) {
    GtkWidget *button = gtk_button_new_from_icon_name(icon);
    gtk_widget_add_css_class(button, "flat");
    studio_tell(button, tip);
    return button;
}

GtkWidget *studio_row_button(const char *icon, const char *tip) {
    GtkWidget *button = studio_flat_button(icon, tip);
    gtk_widget_add_css_class(button, "row-button");
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    return button;
}

GtkWidget *studio_bar_button(GtkWidget *bar, const char *icon, const char *tip, GCallback clicked,
                             void *data) {
    GtkWidget *button = studio_flat_button(icon, tip);
    gtk_widget_set_name(button, tip);
    g_signal_connect(button, "clicked", clicked, data);
    gtk_box_append(GTK_BOX(bar), button);
    return button;
}

GtkGesture *studio_listen_to_drags(GtkWidget *widget, GCallback begin, GCallback update,
                                   GCallback end, void *data) {
    GtkGesture *drag = gtk_gesture_drag_new();
    g_signal_connect(drag, "drag-begin", begin, data);
    g_signal_connect(drag, "drag-update", update, data);
    g_signal_connect(drag, "drag-end", end, data);
    gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(drag));
    return drag;
}

void studio_listen_for_menu(GtkWidget *widget, GCallback pressed, void *data) {
    GtkGesture *menu = gtk_gesture_click_new();
    gtk_gesture_single_set_button(GTK_GESTURE_SINGLE(menu), GDK_BUTTON_SECONDARY);
    g_signal_connect(menu, "pressed", pressed, data);
    gtk_widget_add_controller(widget, GTK_EVENT_CONTROLLER(menu));
}

void studio_close_on_escape(GtkWidget *window) {
    GtkEventController *keys = gtk_shortcut_controller_new();
    gtk_shortcut_controller_add_shortcut(GTK_SHORTCUT_CONTROLLER(keys),
                                         gtk_shortcut_new(gtk_keyval_trigger_new(GDK_KEY_Escape, 0),
                                                          gtk_named_action_new("window.close")));
    gtk_widget_add_controller(window, keys);
}

char *studio_chosen_path(GtkNativeDialog *chooser, int response) {
    GFile *file = response == GTK_RESPONSE_ACCEPT
                      ? gtk_file_chooser_get_file(GTK_FILE_CHOOSER(chooser))
                      : NULL;
    char *path = file == NULL ? NULL : g_file_get_path(file);
    g_clear_object(&file);
    return path;
}
