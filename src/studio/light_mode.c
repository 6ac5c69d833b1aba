#include "studio/light_mode.h"

#include "studio/light_panel.h"
#include "studio/model/lamps.h"
#include "studio/window_private.h"

#include <math.h>
#include <string.h>

static const double arrow_part = 0.16; // of half the scene's size
static const double least_arrow = 0.1; // m

struct StudioLightMode {
    StudioWindow *window;
    StudioLightPanel *panel;
    StudioLightLayer *layer;
    StudioLightWish wish;
    StudioHandle held; // what is dragged
    bool shows_lamps, shows_sun;
    bool is_hovering; // the pointer is over something that can be dragged
};

// ---- marks -------------------------------------------------------------------------------------

static void box_of(const StudioLightMode *mode, double min[3], double max[3]) {
    studio_viewport_bounds(mode->window->viewport, min, max);
}

// How long arrows are.
static double reach_of(const StudioLightMode *mode) {
    double min[3], max[3], half = 0;
    box_of(mode, min, max);
    for (int i = 0; i < 3; i++) {
        half = fmax(half, 0.5 * (max[i] - min[i]));
    }
    return fmax(arrow_part * half, least_arrow);
}

static bool is_open(const StudioLightMode *mode) {
    const char *page = gtk_stack_get_visible_child_name(GTK_STACK(mode->window->side));
    return g_strcmp0(page, "light") == 0;
}

static bool has_contents(const StudioLightMode *mode) {
    return mode->window->document != NULL &&
           studio_document_contents(mode->window->document) != NULL;
}

// Lamps can be dragged while they are shown.
static bool has_handles(const StudioLightMode *mode) {
    return has_contents(mode) && is_open(mode) && mode->shows_lamps;
}

void studio_light_mode_update(StudioLightMode *mode) {
    StudioWindow *window = mode->window;
    StudioOverlay *lamps = NULL, *sun = NULL;
    if (has_contents(mode)) {
        uint32_t selected = studio_window_selected(window);
        studio_light_panel_show(mode->panel, window->document, selected);
        double min[3], max[3];
        box_of(mode, min, max);
        if (has_handles(mode)) {
            lamps = studio_lamp_marks(window->document, selected, reach_of(mode));
        }
        sun = mode->shows_sun ? studio_sun_marks(window->document, min, max) : NULL;
    }
    studio_viewport_set_overlay(window->viewport, "lamps", lamps);
    studio_viewport_set_overlay(window->viewport, "a-sun", sun);
}

static void look(StudioLightMode *mode) {
    studio_light_layer_set(mode->layer, &mode->wish);
    studio_light_panel_set_wish(mode->panel, &mode->wish);
    if (mode->window->builder != NULL) {
        studio_builder_look(mode->window->builder);
        studio_window_poll(mode->window);
    }
}

void studio_light_mode_collect(StudioLightMode *mode) {
    StudioSight *sight = studio_light_layer_take(mode->layer);
    if (sight == NULL) {
        return;
    }
    for (int i = 0; i < STUDIO_SIGHT_COUNT; i++) {
        studio_viewport_set_overlay(mode->window->viewport, studio_sight_name((StudioSightLayer)i),
                                    g_steal_pointer(&sight->layers[i]));
    }
    studio_light_panel_set_sight(mode->panel, sight);
    studio_sight_free(sight);
}

// ---- the pointer -------------------------------------------------------------------------------

static StudioHandle handle_under(const StudioLightMode *mode, double x, double y) {
    StudioViewport *viewport = mode->window->viewport;
    return studio_handle_at(mode->window->document, studio_window_selected(mode->window),
                            reach_of(mode), studio_viewport_camera(viewport),
                            studio_viewport_aspect(viewport),
                            gtk_widget_get_height(GTK_WIDGET(viewport)), x, y);
}

static gboolean on_press(StudioViewport *viewport, double x, double y, guint modifiers,
                         StudioLightMode *mode) {
    (void)viewport;
    if (!has_handles(mode) || (modifiers & GDK_SHIFT_MASK) != 0) {
        return FALSE;
    }
    mode->held = handle_under(mode, x, y);
    if (mode->held.kind == STUDIO_HANDLE_NONE) {
        return FALSE;
    }
    if (mode->held.element != studio_window_selected(mode->window)) {
        studio_window_select(mode->window, mode->held.element);
    }
    return TRUE;
}

static void on_drag(StudioViewport *viewport, double x, double y, guint modifiers,
                    StudioLightMode *mode) {
    (void)modifiers;
    if (mode->held.kind != STUDIO_HANDLE_NONE) {
        studio_handle_drag(mode->window->document, &mode->held, studio_viewport_camera(viewport),
                           studio_viewport_aspect(viewport), x, y);
    }
}

static void on_release(StudioViewport *viewport, double x, double y, gboolean moved,
                       StudioLightMode *mode) {
    (void)viewport;
    (void)x;
    (void)y;
    if (mode->held.kind != STUDIO_HANDLE_NONE && moved) {
        studio_document_seal(mode->window->document);
    }
    mode->held.kind = STUDIO_HANDLE_NONE;
}

static void on_hover(StudioViewport *viewport, double x, double y, StudioLightMode *mode) {
    bool is_over = has_handles(mode) && handle_under(mode, x, y).kind != STUDIO_HANDLE_NONE;
    if (is_over != mode->is_hovering) {
        mode->is_hovering = is_over;
        gtk_widget_set_cursor_from_name(GTK_WIDGET(viewport), is_over ? "grab" : NULL);
    }
}

// Delete takes away the lamp, the date or the light that is selected, and never the scene.
static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioLightMode *mode) {
    (void)keys;
    (void)code;
    (void)state;
    if ((key != GDK_KEY_Delete && key != GDK_KEY_BackSpace) || !has_contents(mode) ||
        !is_open(mode)) {
        return FALSE;
    }
    static const char *const names[] = {"lamp", "sun", "light", NULL};
    uint32_t selected = studio_window_selected(mode->window);
    const FrContents *contents = studio_document_contents(mode->window->document);
    if (selected == FR_NONE || !g_strv_contains(names, fr_contents_at(contents, selected)->name)) {
        return FALSE;
    }
    g_action_group_activate_action(G_ACTION_GROUP(mode->window), "remove", NULL);
    return TRUE;
}

static void listen_to_keys(StudioLightMode *mode, GtkWidget *widget) {
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), mode);
    gtk_widget_add_controller(widget, keys);
}

// ---- actions -----------------------------------------------------------------------------------

static const struct {
    const char *name;
    size_t offset; // of what it switches, in the mode
} shows[] = {
    {"show-lamps", offsetof(StudioLightMode, shows_lamps)},
    {"show-sun", offsetof(StudioLightMode, shows_sun)},
    {"show-rays", offsetof(StudioLightMode, wish.rays)},
    {"show-cells", offsetof(StudioLightMode, wish.cells)},
    {"show-buds", offsetof(StudioLightMode, wish.buds)},
    {"show-voxels", offsetof(StudioLightMode, wish.voxels)},
    {"show-particles", offsetof(StudioLightMode, wish.particles)},
};

static void do_show(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioLightMode *mode = data;
    const char *name = g_action_get_name(G_ACTION(action));
    for (size_t i = 0; i < G_N_ELEMENTS(shows); i++) {
        if (strcmp(shows[i].name, name) == 0) {
            *(bool *)((char *)mode + shows[i].offset) = g_variant_get_boolean(state);
        }
    }
    g_simple_action_set_state(action, state);
    studio_light_mode_update(mode);
    look(mode);
}

static void do_field(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    static const char *const names[] = {"none", "x", "y", "z", "points", "organs"};
    StudioLightMode *mode = data;
    for (int i = 0; i < STUDIO_FIELD_COUNT; i++) {
        if (strcmp(names[i], g_variant_get_string(parameter, NULL)) == 0) {
            mode->wish.field = (StudioFieldKind)i;
            look(mode);
        }
    }
}

static void on_slice(StudioLightPanel *panel, double part, StudioLightMode *mode) {
    (void)panel;
    mode->wish.slice = part;
    look(mode);
}

static void on_photons(StudioLightPanel *panel, guint photons, StudioLightMode *mode) {
    (void)panel;
    mode->wish.photons = photons;
    look(mode);
}

static void do_slice(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    on_slice(NULL, CLAMP(g_variant_get_double(parameter), 0, 1), data);
}

static void do_photons(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    on_photons(NULL, (guint)CLAMP(g_variant_get_int32(parameter), 1, 100000), data);
}

static void done(StudioLightMode *mode, uint32_t element) {
    if (element == FR_NONE) {
        studio_window_say(mode->window, "First mend what is wrong in the text");
    } else {
        studio_window_select(mode->window, element);
    }
}

static void do_add_lamp(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioLightMode *mode = data;
    if (!has_contents(mode)) {
        return;
    }
    const StudioCamera *camera = studio_viewport_camera(mode->window->viewport);
    double min[3], max[3];
    box_of(mode, min, max);
    double top = max[2] >= min[2] ? max[2] : 1; // above what is looked at
    double at[3] = {camera->target[0], camera->target[1], top + reach_of(mode)};
    done(mode, studio_add_lamp(mode->window->document, g_variant_get_string(parameter, NULL), at));
}

static void do_make(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioLightMode *mode = data;
    const char *name = g_variant_get_string(parameter, NULL);
    if (has_contents(mode) && (strcmp(name, "sun") == 0 || strcmp(name, "light") == 0)) {
        done(mode, studio_make_of_scene(mode->window->document, name));
    }
}

static void add_actions(StudioLightMode *mode) {
    static const GActionEntry entries[] = {
        {.name = "light-field", .activate = do_field, .parameter_type = "s"},
        {.name = "light-slice", .activate = do_slice, .parameter_type = "d"},
        {.name = "light-photons", .activate = do_photons, .parameter_type = "i"},
        {.name = "add-lamp", .activate = do_add_lamp, .parameter_type = "s"},
        {.name = "make-of-scene", .activate = do_make, .parameter_type = "s"},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(mode->window), entries, G_N_ELEMENTS(entries),
                                    mode);
    for (size_t i = 0; i < G_N_ELEMENTS(shows); i++) {
        bool is_on = *(bool *)((char *)mode + shows[i].offset);
        GSimpleAction *action =
            g_simple_action_new_stateful(shows[i].name, NULL, g_variant_new_boolean(is_on));
        g_signal_connect(action, "change-state", G_CALLBACK(do_show), mode);
        g_action_map_add_action(G_ACTION_MAP(mode->window), G_ACTION(action));
        g_object_unref(action);
    }
}

// ---- life --------------------------------------------------------------------------------------

static void on_selected(StudioLightPanel *panel, guint element, StudioLightMode *mode) {
    (void)panel;
    studio_window_select(mode->window, element);
}

static void on_page(GtkStack *side, GParamSpec *spec, StudioLightMode *mode) {
    (void)side;
    (void)spec;
    studio_light_mode_update(mode);
}

StudioLightMode *studio_light_mode_new(StudioWindow *window) {
    StudioLightMode *mode = g_new0(StudioLightMode, 1);
    mode->window = window;
    mode->wish = (StudioLightWish){.slice = 0.5, .photons = 200};
    mode->shows_lamps = true;
    mode->layer = studio_light_layer_new(studio_window_wake, window);
    mode->panel = STUDIO_LIGHT_PANEL(studio_light_panel_new());
    add_actions(mode);
    g_signal_connect(mode->panel, "selected", G_CALLBACK(on_selected), mode);
    g_signal_connect(mode->panel, "slice", G_CALLBACK(on_slice), mode);
    g_signal_connect(mode->panel, "photons", G_CALLBACK(on_photons), mode);
    g_signal_connect(window->viewport, "press", G_CALLBACK(on_press), mode);
    g_signal_connect(window->viewport, "drag", G_CALLBACK(on_drag), mode);
    g_signal_connect(window->viewport, "release", G_CALLBACK(on_release), mode);
    g_signal_connect(window->viewport, "hover", G_CALLBACK(on_hover), mode);
    listen_to_keys(mode, GTK_WIDGET(mode->panel));
    listen_to_keys(mode, GTK_WIDGET(window->viewport));
    g_signal_connect(window->side, "notify::visible-child", G_CALLBACK(on_page), mode);
    studio_light_layer_set(mode->layer, &mode->wish);
    return mode;
}

void studio_light_mode_free(StudioLightMode *mode) {
    if (mode != NULL) {
        g_signal_handlers_disconnect_by_data(mode->window->viewport, mode);
        g_signal_handlers_disconnect_by_data(mode->window->side, mode);
        studio_light_layer_free(mode->layer);
        g_free(mode);
    }
}

GtkWidget *studio_light_mode_panel(StudioLightMode *mode) {
    return GTK_WIDGET(mode->panel);
}

void studio_light_mode_watch(StudioLightMode *mode) {
    studio_builder_watch(mode->window->builder, studio_light_layer_look, mode->layer);
}
