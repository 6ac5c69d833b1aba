#include "studio/patch_mode.h"

#include "studio/model/patch.h"
#include "studio/window_private.h"

struct StudioPatchMode {
    StudioWindow *window;
    GtkWidget *bar, *text, *reset, *reset_all;
    StudioPatch patch; // what is shown
    StudioPatch begun; // when the drag began
    char *place;       // of the element; NULL: none is shown
    uint32_t chosen;   // point, FR_NONE
    bool is_held, is_hovering;
};

// The lattice of what is selected.
static bool find_patch(const StudioPatchMode *mode, StudioPatch *patch) {
    StudioWindow *window = mode->window;
    uint32_t selected = window->document == NULL ? FR_NONE : studio_window_selected(window);
    if (selected == FR_NONE || window->builder == NULL) {
        return false;
    }
    const FrContents *contents = studio_document_contents(window->document);
    const FrContentsElement *at = fr_contents_at(contents, selected);
    uint32_t plant = studio_place_plant(contents, selected);
    StudioFooting footing;
    return plant != FR_NONE && at->id != NULL &&
           studio_builder_footing(window->builder, fr_contents_at(contents, plant)->id, at->id,
                                  &footing) &&
           studio_patch_read(window->document, selected, &footing, patch);
}

static void show(StudioPatchMode *mode) {
    bool is_shown = mode->place != NULL;
    studio_viewport_set_overlay(mode->window->viewport, "patch",
                                is_shown ? studio_patch_marks(&mode->patch, mode->chosen) : NULL);
    studio_window_reveal(mode->bar, is_shown && mode->patch.can_move);
    gtk_widget_set_sensitive(mode->reset, mode->chosen != FR_NONE);
}

void studio_patch_mode_update(StudioPatchMode *mode) {
    StudioPatch patch;
    bool is_there = find_patch(mode, &patch);
    bool is_same = is_there && g_strcmp0(mode->place, mode->window->selected) == 0 &&
                   fr_lattice_count(&patch.lattice) == fr_lattice_count(&mode->patch.lattice);
    if (!is_same) {
        mode->chosen = FR_NONE;
        mode->is_held = false;
        g_free(mode->place);
        mode->place = is_there ? g_strdup(mode->window->selected) : NULL;
    }
    if (is_there) {
        mode->patch = patch;
    }
    show(mode);
}

// ---- the pointer -------------------------------------------------------------------------------

static uint32_t point_under(const StudioPatchMode *mode, double x, double y) {
    StudioViewport *viewport = mode->window->viewport;
    return mode->place == NULL
               ? FR_NONE
               : studio_patch_under(&mode->patch, studio_viewport_camera(viewport),
                                    studio_viewport_aspect(viewport),
                                    gtk_widget_get_height(GTK_WIDGET(viewport)), x, y);
}

static gboolean on_press(StudioViewport *viewport, double x, double y, guint modifiers,
                         StudioPatchMode *mode) {
    (void)viewport;
    uint32_t point = (modifiers & GDK_SHIFT_MASK) != 0 ? FR_NONE : point_under(mode, x, y);
    if (point == FR_NONE) {
        return FALSE;
    }
    mode->chosen = point;
    mode->begun = mode->patch;
    mode->is_held = true;
    show(mode);
    return TRUE;
}

static void on_drag(StudioViewport *viewport, double x, double y, guint modifiers,
                    StudioPatchMode *mode) {
    if (mode->is_held) {
        studio_patch_drag(mode->window->document, &mode->begun, mode->chosen,
                          studio_viewport_camera(viewport), studio_viewport_aspect(viewport), x, y,
                          (modifiers & GDK_CONTROL_MASK) != 0);
    }
}

static void on_release(StudioViewport *viewport, double x, double y, gboolean moved,
                       StudioPatchMode *mode) {
    (void)viewport;
    (void)x;
    (void)y;
    if (mode->is_held && moved) {
        studio_document_seal(mode->window->document);
    }
    mode->is_held = false;
}

static void on_hover(StudioViewport *viewport, double x, double y, StudioPatchMode *mode) {
    bool is_over = point_under(mode, x, y) != FR_NONE;
    if (is_over != mode->is_hovering) {
        mode->is_hovering = is_over;
        gtk_widget_set_cursor_from_name(GTK_WIDGET(viewport), is_over ? "grab" : NULL);
    }
}

static void do_reset(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)parameter;
    StudioPatchMode *mode = data;
    bool is_all = g_strcmp0(g_action_get_name(G_ACTION(action)), "patch-reset-all") == 0;
    if (mode->place != NULL && (is_all || mode->chosen != FR_NONE)) {
        studio_patch_reset(mode->window->document, &mode->patch, is_all ? FR_NONE : mode->chosen);
    }
}

// ---- life --------------------------------------------------------------------------------------

static GtkWidget *text_button(const char *text, const char *action) {
    GtkWidget *button = gtk_button_new_with_label(text);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
    return button;
}

static void make_bar(StudioPatchMode *mode, GtkOverlay *overlay) {
    mode->bar = gtk_revealer_new();
    gtk_revealer_set_transition_type(GTK_REVEALER(mode->bar),
                                     GTK_REVEALER_TRANSITION_TYPE_CROSSFADE);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_widget_add_css_class(box, "busy");
    mode->text = gtk_label_new("Drag a point; with Ctrl both sides");
    mode->reset = text_button("Reset point", "win.patch-reset");
    mode->reset_all = text_button("Reset all", "win.patch-reset-all");
    gtk_box_append(GTK_BOX(box), mode->text);
    gtk_box_append(GTK_BOX(box), mode->reset);
    gtk_box_append(GTK_BOX(box), mode->reset_all);
    gtk_revealer_set_child(GTK_REVEALER(mode->bar), box);
    gtk_widget_set_halign(mode->bar, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(mode->bar, GTK_ALIGN_END);
    studio_window_reveal(mode->bar, false);
    gtk_overlay_add_overlay(overlay, mode->bar);
}

StudioPatchMode *studio_patch_mode_new(StudioWindow *window, GtkOverlay *overlay) {
    static const GActionEntry entries[] = {
        {.name = "patch-reset", .activate = do_reset},
        {.name = "patch-reset-all", .activate = do_reset},
    };
    StudioPatchMode *mode = g_new0(StudioPatchMode, 1);
    mode->window = window;
    mode->chosen = FR_NONE;
    make_bar(mode, overlay);
    g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), mode);
    g_signal_connect(window->viewport, "press", G_CALLBACK(on_press), mode);
    g_signal_connect(window->viewport, "drag", G_CALLBACK(on_drag), mode);
    g_signal_connect(window->viewport, "release", G_CALLBACK(on_release), mode);
    g_signal_connect(window->viewport, "hover", G_CALLBACK(on_hover), mode);
    return mode;
}

void studio_patch_mode_free(StudioPatchMode *mode) {
    if (mode != NULL) {
        g_signal_handlers_disconnect_by_data(mode->window->viewport, mode);
        g_free(mode->place);
        g_free(mode);
    }
}
