#include "studio/wind_menu.h"

#include "studio/accessible.h"
#include "studio/model/wind.h"
#include "studio/window_private.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *action, *title;
    size_t offset; // of the number in a StudioWind
    double least, most, step;
} handles[] = {
    {"wind-strength", "Strength", offsetof(StudioWind, strength), 0, 1, 0.05},
    {"wind-direction", "Towards (degrees from north)", offsetof(StudioWind, direction), 0, 360, 5},
    {"wind-speed", "Speed of the gusts", offsetof(StudioWind, speed), 0, 4, 0.1},
};

static double *number_of(StudioWindow *window, size_t handle) {
    StudioDisplay *display = studio_viewport_display(window->viewport);
    return (double *)(void *)((char *)&display->wind + handles[handle].offset);
}

// Strength and direction are the plant's, too, where it is bent by a wind of its own.
static void set_number(StudioWindow *window, size_t handle, double number) {
    double *place = number_of(window, handle), strength, direction;
    *place = CLAMP(number, handles[handle].least, handles[handle].most);
    const StudioWind *wind = &studio_viewport_display(window->viewport)->wind;
    if (window->document == NULL || place == &wind->speed ||
        !studio_wind_read(window->document, studio_window_plant(window), &strength, &direction)) {
        return;
    }
    bool is_strength = place == &wind->strength;
    studio_wind_write(window->document, studio_window_plant(window),
                      is_strength ? wind->strength : strength,
                      is_strength && strength > 0 ? direction : wind->direction);
}

static void do_number(GSimpleAction *action, GVariant *parameter, gpointer data) {
    StudioWindow *window = data;
    for (size_t i = 0; i < G_N_ELEMENTS(handles); i++) {
        if (strcmp(handles[i].action, g_action_get_name(G_ACTION(action))) == 0) {
            set_number(window, i, g_variant_get_double(parameter));
        }
    }
    studio_viewport_update(window->viewport);
}

static void do_wind(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioWindow *window = data;
    studio_viewport_display(window->viewport)->has_wind = g_variant_get_boolean(state);
    g_simple_action_set_state(action, state);
    studio_viewport_update(window->viewport);
}

void studio_wind_add_actions(StudioWindow *window) {
    static const GActionEntry entries[] = {
        {.name = "wind", .state = "false", .change_state = do_wind},
        {.name = "wind-strength", .activate = do_number, .parameter_type = "d"},
        {.name = "wind-direction", .activate = do_number, .parameter_type = "d"},
        {.name = "wind-speed", .activate = do_number, .parameter_type = "d"},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), window);
}

// Whoever sets the wind wants to see it.
static void on_value(GtkRange *range, StudioWindow *window) {
    size_t handle = GPOINTER_TO_SIZE(g_object_get_data(G_OBJECT(range), "studio-handle"));
    set_number(window, handle, gtk_range_get_value(range));
    g_action_group_change_action_state(G_ACTION_GROUP(window), "wind", g_variant_new_boolean(TRUE));
}

static void add_handle(StudioWindow *window, GtkBox *box, size_t handle) {
    GtkWidget *title = gtk_label_new(handles[handle].title);
    gtk_label_set_xalign(GTK_LABEL(title), 0);
    gtk_box_append(box, title);
    GtkWidget *scale = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, handles[handle].least,
                                                handles[handle].most, handles[handle].step);
    gtk_range_set_value(GTK_RANGE(scale), *number_of(window, handle));
    gtk_scale_set_draw_value(GTK_SCALE(scale), TRUE);
    gtk_scale_set_value_pos(GTK_SCALE(scale), GTK_POS_RIGHT);
    gtk_widget_set_size_request(scale, 240, -1);
    gtk_widget_set_name(scale, handles[handle].action);
    studio_name(scale, handles[handle].title);
    g_object_set_data(G_OBJECT(scale), "studio-handle", GSIZE_TO_POINTER(handle));
    g_signal_connect(scale, "value-changed", G_CALLBACK(on_value), window);
    gtk_box_append(box, scale);
}

// Each drag is a step of its own.
static gboolean on_event(GtkEventControllerLegacy *controller, GdkEvent *event,
                         StudioWindow *window) {
    (void)controller;
    GdkEventType type = gdk_event_get_event_type(event);
    if (window->document != NULL && (type == GDK_BUTTON_RELEASE || type == GDK_KEY_RELEASE)) {
        studio_document_seal(window->document);
    }
    return FALSE;
}

// A plant's own wind is what is seen first.
static void take_own(StudioWindow *window) {
    StudioWind *wind = &studio_viewport_display(window->viewport)->wind;
    double strength, direction;
    if (window->document != NULL &&
        studio_wind_read(window->document, studio_window_plant(window), &strength, &direction) &&
        strength > 0) {
        wind->strength = fmin(strength, 1);
        wind->direction = direction;
    }
}

// The numbers may have been set by actions.
static void on_show(GtkWidget *box, StudioWindow *window) {
    take_own(window);
    for (GtkWidget *child = gtk_widget_get_first_child(box); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        if (GTK_IS_SCALE(child)) {
            size_t handle = GPOINTER_TO_SIZE(g_object_get_data(G_OBJECT(child), "studio-handle"));
            g_signal_handlers_block_by_func(child, on_value, window);
            gtk_range_set_value(GTK_RANGE(child), *number_of(window, handle));
            g_signal_handlers_unblock_by_func(child, on_value, window);
        }
    }
}

GtkWidget *studio_wind_button_new(StudioWindow *window) {
    GtkWidget *linked = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    gtk_widget_add_css_class(linked, "linked");
    GtkWidget *wind = gtk_toggle_button_new();
    gtk_button_set_icon_name(GTK_BUTTON(wind), "weather-windy-symbolic");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(wind), "win.wind");
    gtk_widget_set_tooltip_text(wind, "Let a wind blow, to look at (W)");
    studio_name(wind, "Wind");
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    for (size_t i = 0; i < G_N_ELEMENTS(handles); i++) {
        add_handle(window, GTK_BOX(box), i);
    }
    g_signal_connect(box, "map", G_CALLBACK(on_show), window);
    GtkEventController *events = gtk_event_controller_legacy_new();
    gtk_event_controller_set_propagation_phase(events, GTK_PHASE_CAPTURE);
    g_signal_connect(events, "event", G_CALLBACK(on_event), window);
    gtk_widget_add_controller(box, events);
    GtkWidget *popover = gtk_popover_new();
    gtk_popover_set_child(GTK_POPOVER(popover), box);
    GtkWidget *menu = gtk_menu_button_new();
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(menu), popover);
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(menu), "pan-down-symbolic");
    studio_tell(menu, "How the wind blows");
    gtk_widget_set_name(menu, "wind-menu");
    gtk_box_append(GTK_BOX(linked), wind);
    gtk_box_append(GTK_BOX(linked), menu);
    return linked;
}
