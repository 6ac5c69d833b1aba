/// The palette of the scene's tools, and what can be set of the one that is chosen.
#include "studio/accessible.h"
#include "studio/model/adopt.h"
#include "studio/model/presets.h"
#include "studio/scene_tool_private.h"
#include "studio/wrap_box.h"

#include <string.h>

static const char preset_mark[] = "preset:";

// ---- what can be planted -----------------------------------------------------------------------

static GPtrArray *list_plants(const StudioSceneTool *tool) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    const StudioDocument *document = tool->window->document;
    const FrContents *contents = document == NULL ? NULL : studio_document_contents(document);
    uint32_t plant = contents == NULL ? FR_NONE : fr_contents_child(contents, 0, "plant");
    for (; plant != FR_NONE; plant = fr_contents_sibling(contents, plant)) {
        if (fr_contents_at(contents, plant)->id != NULL) {
            g_ptr_array_add(names, g_strdup(fr_contents_at(contents, plant)->id));
        }
    }
    GPtrArray *presets = studio_preset_names();
    for (guint i = 0; i < presets->len; i++) {
        const char *name = g_ptr_array_index(presets, i);
        g_ptr_array_add(names, g_strconcat(preset_mark, name, NULL));
    }
    g_ptr_array_unref(presets);
    return names;
}

static bool is_same_list(const GPtrArray *a, const GPtrArray *b) {
    bool is_same = a->len == b->len;
    for (guint i = 0; is_same && i < a->len; i++) {
        is_same = strcmp(g_ptr_array_index(a, i), g_ptr_array_index(b, i)) == 0;
    }
    return is_same;
}

static char *title_of(const char *name) {
    if (!g_str_has_prefix(name, preset_mark)) {
        return g_strdup(name);
    }
    char *title = studio_preset_title(name + strlen(preset_mark));
    char *whole = g_strdup_printf("Preset: %s", title);
    g_free(title);
    return whole;
}

static void choose_plant(StudioSceneTool *tool, const char *name) {
    for (guint i = 0; name != NULL && i < tool->plants->len; i++) {
        if (strcmp(g_ptr_array_index(tool->plants, i), name) == 0) {
            gtk_drop_down_set_selected(GTK_DROP_DOWN(tool->what), i);
        }
    }
}

static const char *chosen(const StudioSceneTool *tool) {
    guint index = gtk_drop_down_get_selected(GTK_DROP_DOWN(tool->what));
    return index < tool->plants->len ? g_ptr_array_index(tool->plants, index) : NULL;
}

static void list_again(StudioSceneTool *tool) {
    GPtrArray *names = list_plants(tool);
    if (is_same_list(names, tool->plants)) {
        g_ptr_array_unref(names);
        return;
    }
    char *before = g_strdup(chosen(tool));
    GtkStringList *titles = gtk_string_list_new(NULL);
    for (guint i = 0; i < names->len; i++) {
        char *title = title_of(g_ptr_array_index(names, i));
        gtk_string_list_append(titles, title);
        g_free(title);
    }
    g_ptr_array_unref(tool->plants);
    tool->plants = names;
    gtk_drop_down_set_model(GTK_DROP_DOWN(tool->what), G_LIST_MODEL(titles));
    choose_plant(tool, before);
    g_object_unref(titles);
    g_free(before);
}

char *studio_scene_chosen_plant(StudioSceneTool *tool, const char *key) {
    const char *name = chosen(tool);
    if (name == NULL || !g_str_has_prefix(name, preset_mark)) {
        return g_strdup(name);
    }
    char *id = NULL;
    StudioCarried carried =
        studio_window_bring(tool->window, name + strlen(preset_mark), studio_adopt_elements);
    if (carried.source != NULL &&
        studio_adopt(tool->window->document, carried.source, NULL, key, &id)) {
        list_again(tool);
        choose_plant(tool, id);
    } else {
        studio_carried_undo(&carried);
    }
    studio_carried_clear(&carried);
    return id;
}

// ---- options -----------------------------------------------------------------------------------

static GtkWidget *labelled(GtkWidget *box, const char *text, GtkWidget *widget, const char *tip) {
    GtkWidget *label = gtk_label_new_with_mnemonic(text);
    gtk_label_set_mnemonic_widget(GTK_LABEL(label), widget);
    gtk_widget_set_tooltip_text(widget, tip);
    studio_name_inside(widget, gtk_label_get_text(GTK_LABEL(label)));
    gtk_box_append(GTK_BOX(box), label);
    gtk_box_append(GTK_BOX(box), widget);
    return widget;
}

static GtkWidget *spin(double min, double max, double step, double value, guint digits) {
    GtkWidget *button = gtk_spin_button_new_with_range(min, max, step);
    gtk_spin_button_set_digits(GTK_SPIN_BUTTON(button), digits);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(button), value);
    gtk_editable_set_width_chars(GTK_EDITABLE(button), 5);
    gtk_editable_set_max_width_chars(GTK_EDITABLE(button), 6);
    return button;
}

static void on_option(GObject *object, GParamSpec *spec, StudioSceneTool *tool) {
    (void)object;
    (void)spec;
    gtk_widget_queue_draw(tool->layer);
}

static GtkWidget *make_options(StudioSceneTool *tool) {
    static const char *const shapes[] = {"Box", "Ball", "Cylinder", "Cone", "Mesh file…", NULL};
    GtkWidget *box = studio_wrap_box_new(12);
    GtkWidget *groups[SCENE_GROUP_COUNT];
    for (int i = 0; i < SCENE_GROUP_COUNT; i++) {
        groups[i] = i == SCENE_GROUP_ONE      ? studio_scene_one_bar(tool)
                    : i == SCENE_GROUP_EXPORT ? studio_scene_export_bar()
                                              : gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
        studio_wrap_box_append(STUDIO_WRAP_BOX(box), groups[i]);
    }
    tool->what = labelled(groups[0], "_What", gtk_drop_down_new_from_strings(NULL),
                          "What is planted: of this document, or a preset");
    gtk_drop_down_set_enable_search(GTK_DROP_DOWN(tool->what), TRUE);
    gtk_widget_set_name(tool->what, "scene-what");
    gtk_widget_set_size_request(tool->what, 130, -1);
    tool->radius =
        labelled(groups[1], "_Radius in m", spin(0.05, 500, 0.5, 4, 2), "How wide the brush is");
    tool->density = labelled(groups[2], "_Density", spin(0.01, 10000, 1, 8, 2),
                             "Plants on 100 m² at most; painting again fills gaps and no more");
    tool->shape = labelled(groups[3], "_Shape", gtk_drop_down_new_from_strings(shapes),
                           "What the obstacle is");
    tool->width = labelled(groups[4], "_Width in m", spin(0.1, 100, 0.5, 4, 1),
                           "Of the road; plants keep off it as high above it as it is wide");
    memcpy(tool->groups, groups, sizeof groups);
    GtkWidget *const watched[] = {tool->radius, tool->width};
    for (size_t i = 0; i < G_N_ELEMENTS(watched); i++) {
        g_signal_connect(watched[i], "notify::value", G_CALLBACK(on_option), tool);
    }
    return box;
}

static void on_done(GtkButton *button, StudioSceneTool *tool) {
    (void)button;
    studio_scene_choose(tool, SCENE_SELECT);
    gtk_widget_grab_focus(GTK_WIDGET(tool->window->viewport));
}

static GtkWidget *make_bar(StudioSceneTool *tool) {
    GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
    GtkWidget *top = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 14);
    tool->hint = gtk_label_new("");
    gtk_label_set_xalign(GTK_LABEL(tool->hint), 0);
    gtk_label_set_wrap(GTK_LABEL(tool->hint), TRUE);
    gtk_label_set_max_width_chars(GTK_LABEL(tool->hint), 48); // even lines
    gtk_widget_set_hexpand(tool->hint, TRUE);
    gtk_widget_add_css_class(tool->hint, "scene-hint");
    gtk_box_append(GTK_BOX(top), tool->hint);
    GtkWidget *done = gtk_button_new_with_label("Done");
    gtk_widget_set_tooltip_text(done, "Back to choosing branches and leaves (Esc)");
    g_signal_connect(done, "clicked", G_CALLBACK(on_done), tool);
    gtk_box_append(GTK_BOX(top), done);
    gtk_box_append(GTK_BOX(bar), top);
    gtk_box_append(GTK_BOX(bar), make_options(tool));
    gtk_widget_add_css_class(bar, "scene-bar");
    tool->bar = gtk_revealer_new();
    gtk_revealer_set_transition_type(GTK_REVEALER(tool->bar),
                                     GTK_REVEALER_TRANSITION_TYPE_CROSSFADE);
    gtk_revealer_set_child(GTK_REVEALER(tool->bar), bar);
    gtk_widget_set_halign(tool->bar, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(tool->bar, GTK_ALIGN_END);
    return tool->bar;
}

// ---- the palette -------------------------------------------------------------------------------

static GtkWidget *make_ground_button(void) {
    GMenu *menu = g_menu_new();
    g_menu_append(menu, "_Height Map or Mesh…", "win.terrain");
    g_menu_append(menu, "_Level Ground", "win.terrain-from::");
    GtkWidget *button = gtk_menu_button_new();
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "studio-tool-ground-symbolic");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), G_MENU_MODEL(menu));
    gtk_menu_button_set_direction(GTK_MENU_BUTTON(button), GTK_ARROW_RIGHT);
    gtk_widget_set_tooltip_text(button, "The ground: hills from a picture or a mesh");
    studio_name(button, "The ground");
    g_object_unref(menu);
    return button;
}

static GtkWidget *make_palette(void) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
    for (int i = 0; i < SCENE_TOOL_COUNT; i++) {
        const SceneToolKind *kind = studio_scene_kind((SceneTool)i);
        GtkWidget *button = gtk_toggle_button_new();
        gtk_button_set_icon_name(GTK_BUTTON(button), kind->icon);
        gtk_actionable_set_action_name(GTK_ACTIONABLE(button), "win.scene-tool");
        gtk_actionable_set_action_target(GTK_ACTIONABLE(button), "s", kind->name);
        studio_tell(button, kind->tip);
        gtk_widget_add_css_class(button, "flat");
        char *name = g_strdup_printf("tool-%s", kind->name);
        gtk_widget_set_name(button, name);
        g_free(name);
        gtk_box_append(GTK_BOX(box), button);
    }
    GtkWidget *ground = make_ground_button();
    gtk_widget_add_css_class(ground, "flat");
    gtk_box_append(GTK_BOX(box), ground);
    gtk_widget_add_css_class(box, "scene-palette");
    gtk_widget_set_halign(box, GTK_ALIGN_START);
    gtk_widget_set_valign(box, GTK_ALIGN_START); // the options below it may be high
    return box;
}

void studio_scene_add_bars(StudioSceneTool *tool, GtkOverlay *overlay) {
    gtk_overlay_add_overlay(overlay, make_palette());
    gtk_overlay_add_overlay(overlay, make_bar(tool));
}

void studio_scene_show_hint(StudioSceneTool *tool) {
    const char *words = tool->over != STUDIO_GRIP_NONE ? studio_grip_words(tool->over)
                                                       : studio_scene_kind(tool->tool)->hint;
    // No word stands alone in the last line.
    const char *last = strrchr(words, ' ');
    char *text = last == NULL
                     ? g_strdup(words)
                     : g_strdup_printf("%.*s\u00a0%s", (int)(last - words), words, last + 1);
    gtk_label_set_text(GTK_LABEL(tool->hint), text);
    g_free(text);
}

void studio_scene_update_bars(StudioSceneTool *tool) {
    static const bool shown[SCENE_TOOL_COUNT][SCENE_GROUP_COUNT] = {
        [SCENE_MOVE] = {[SCENE_GROUP_ONE] = true, [SCENE_GROUP_EXPORT] = true},
        [SCENE_PLANT] = {true},
        [SCENE_PAINT] = {true, true, true},
        [SCENE_TAKE_OUT] = {false, true},
        [SCENE_OBSTACLE] = {false, false, false, true},
        [SCENE_ROAD] = {false, false, false, false, true},
    };
    list_again(tool);
    for (int i = 0; i < SCENE_GROUP_COUNT; i++) {
        bool is_wanted = i == SCENE_GROUP_ONE      ? tool->one_of != NULL
                         : i == SCENE_GROUP_EXPORT ? studio_scene_is_one(tool)
                                                   : true;
        gtk_widget_set_visible(tool->groups[i], shown[tool->tool][i] && is_wanted);
    }
    studio_scene_show_hint(tool);
    studio_window_reveal(tool->bar, tool->tool != SCENE_SELECT);
}
