#include "studio/levels_panel.h"

#include "frond/species.h"
#include "studio/accessible.h"
#include "studio/model/commands.h"
#include "studio/model/place.h"

#include <string.h>

enum { SIX = 6 };

struct _StudioLevelsPanel {
    GtkBox parent;
    StudioSettings *settings;
    GtkWidget *inspector, *stack, *levels[3], *name, *model, *scales[SIX], *numbers[SIX];
    StudioDocument *document; // borrowed
    char *place;              // of the <species>; NULL: nothing is shown
    gboolean is_whole, is_showing;
};

G_DEFINE_TYPE(StudioLevelsPanel, studio_levels_panel, GTK_TYPE_BOX)

static const char level_setting[] = "level";

static StudioLevel level_of(const StudioLevelsPanel *panel) {
    return (StudioLevel)CLAMP(studio_settings_int(panel->settings, level_setting, STUDIO_LEVEL_SIX),
                              STUDIO_LEVEL_PLANT, STUDIO_LEVEL_ALL);
}

static uint32_t species_of(const StudioLevelsPanel *panel) {
    return panel->document == NULL || studio_document_is_broken(panel->document)
               ? FR_NONE
               : studio_place_find(studio_document_contents(panel->document), panel->place);
}

static const FrParam *slider(int index) {
    return &fr_species_sliders_table()->rows[index];
}

// ---- showing -----------------------------------------------------------------------------------

static void show_level(StudioLevelsPanel *panel) {
    static const char *const pages[] = {"plant", "six", "all"};
    StudioLevel level = level_of(panel);
    panel->is_showing = TRUE;
    for (int i = 0; i < 3; i++) {
        gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(panel->levels[i]), i + 1 == (int)level);
    }
    panel->is_showing = FALSE;
    gtk_stack_set_visible_child_name(GTK_STACK(panel->stack), pages[level - 1]);
    bool is_species = panel->place != NULL;
    gtk_widget_set_visible(GTK_WIDGET(panel), is_species);
    gtk_widget_set_visible(panel->inspector,
                           !is_species || !panel->is_whole || level == STUDIO_LEVEL_ALL);
}

static void show_number(StudioLevelsPanel *panel, int index) {
    char *text = g_strdup_printf("%.2f", gtk_range_get_value(GTK_RANGE(panel->scales[index])));
    gtk_label_set_text(GTK_LABEL(panel->numbers[index]), text);
    g_free(text);
}

static void show_model(StudioLevelsPanel *panel, uint32_t species) {
    char *model = fr_contents_get(studio_document_contents(panel->document), species, "model");
    const FrParam *row = fr_params_find(fr_species_table(), "model");
    char **choices = g_strsplit(row->choices, " ", -1);
    for (guint i = 0; choices[i] != NULL; i++) {
        if (strcmp(choices[i], model == NULL ? row->default_text : model) == 0) {
            gtk_drop_down_set_selected(GTK_DROP_DOWN(panel->model), i);
        }
    }
    g_strfreev(choices);
    g_free(model);
}

void studio_levels_panel_show(StudioLevelsPanel *panel, StudioDocument *document, uint32_t selected,
                              uint32_t shown) {
    uint32_t species = studio_levels_species(document, selected, shown);
    const FrContents *contents = studio_document_contents(document);
    panel->document = document;
    g_clear_pointer(&panel->place, g_free);
    if (species != FR_NONE) {
        panel->place = studio_place_of(contents, species);
        panel->is_whole = studio_levels_are_whole(document, selected);
        const char *id = fr_contents_at(contents, fr_contents_at(contents, species)->parent)->id;
        gtk_label_set_text(GTK_LABEL(panel->name), id == NULL ? "" : id);
        panel->is_showing = TRUE;
        show_model(panel, species);
        for (int i = 0; i < SIX; i++) {
            gtk_range_set_value(GTK_RANGE(panel->scales[i]),
                                studio_levels_get(document, species, slider(i)->name));
            show_number(panel, i);
        }
        panel->is_showing = FALSE;
    }
    show_level(panel);
}

void studio_levels_panel_open(StudioLevelsPanel *panel) {
    studio_settings_set_int(panel->settings, level_setting, STUDIO_LEVEL_ALL);
    show_level(panel);
}

// ---- what is done ------------------------------------------------------------------------------

static void on_level(GtkToggleButton *button, StudioLevelsPanel *panel) {
    for (int i = 0; i < 3 && !panel->is_showing; i++) {
        if (GTK_WIDGET(button) == panel->levels[i] && gtk_toggle_button_get_active(button)) {
            studio_settings_set_int(panel->settings, level_setting, i + 1);
        }
    }
    if (!panel->is_showing) {
        show_level(panel);
    }
}

static void on_model(GtkDropDown *model, GParamSpec *spec, StudioLevelsPanel *panel) {
    (void)spec;
    uint32_t species = species_of(panel);
    GObject *chosen = gtk_drop_down_get_selected_item(model);
    if (!panel->is_showing && species != FR_NONE && chosen != NULL) {
        studio_set(panel->document, species, "model",
                   gtk_string_object_get_string(GTK_STRING_OBJECT(chosen)), false);
    }
}

static void on_scale(GtkRange *range, StudioLevelsPanel *panel) {
    uint32_t species = species_of(panel);
    for (int i = 0; i < SIX && !panel->is_showing && species != FR_NONE; i++) {
        if (GTK_WIDGET(range) == panel->scales[i]) {
            show_number(panel, i);
            studio_levels_set(panel->document, species, slider(i)->name,
                              gtk_range_get_value(range));
        }
    }
}

// ---- life --------------------------------------------------------------------------------------

static GtkWidget *make_levels(StudioLevelsPanel *panel) {
    static const char *const levels[3][2] = {
        {"Plant", "Choose how it grows, and plant it"},
        {"Shape", "Six plain numbers for the whole of it"},
        {"All", "Everything that can be set"},
    };
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    gtk_widget_add_css_class(box, "linked");
    gtk_box_set_homogeneous(GTK_BOX(box), TRUE);
    for (int i = 0; i < 3; i++) {
        panel->levels[i] = gtk_toggle_button_new_with_label(levels[i][0]);
        gtk_widget_set_tooltip_text(panel->levels[i], levels[i][1]);
        gtk_widget_set_hexpand(panel->levels[i], TRUE);
        char *name = g_strdup_printf("level-%d", i + 1);
        gtk_widget_set_name(panel->levels[i], name);
        g_free(name);
        if (i > 0) {
            gtk_toggle_button_set_group(GTK_TOGGLE_BUTTON(panel->levels[i]),
                                        GTK_TOGGLE_BUTTON(panel->levels[0]));
        }
        g_signal_connect(panel->levels[i], "toggled", G_CALLBACK(on_level), panel);
        gtk_box_append(GTK_BOX(box), panel->levels[i]);
    }
    return box;
}

static GtkWidget *make_plant(StudioLevelsPanel *panel) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8);
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkWidget *label = gtk_label_new("Grows like");
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    gtk_widget_set_hexpand(label, TRUE);
    char **choices = g_strsplit(fr_params_find(fr_species_table(), "model")->choices, " ", -1);
    panel->model = gtk_drop_down_new_from_strings((const char *const *)choices);
    g_strfreev(choices);
    gtk_drop_down_set_enable_search(GTK_DROP_DOWN(panel->model), TRUE);
    studio_name(panel->model, "Grows like");
    g_signal_connect(panel->model, "notify::selected", G_CALLBACK(on_model), panel);
    gtk_box_append(GTK_BOX(row), label);
    gtk_box_append(GTK_BOX(row), panel->model);
    gtk_box_append(GTK_BOX(box), row);
    GtkWidget *plant = gtk_button_new_with_label("Plant It");
    gtk_actionable_set_detailed_action_name(GTK_ACTIONABLE(plant), "win.scene-tool::plant");
    gtk_widget_set_tooltip_text(plant, "Then click the ground; the buttons below the picture let "
                                       "it grow");
    gtk_box_append(GTK_BOX(box), plant);
    return box;
}

static GtkWidget *make_six(StudioLevelsPanel *panel) {
    GtkWidget *grid = gtk_grid_new();
    gtk_grid_set_column_spacing(GTK_GRID(grid), 8);
    gtk_grid_set_row_spacing(GTK_GRID(grid), 2);
    for (int i = 0; i < SIX; i++) {
        const FrParam *row = slider(i);
        char *title = g_strdup(row->name);
        title[0] = g_ascii_toupper(title[0]);
        GtkWidget *label = gtk_label_new(title), *number = gtk_label_new("");
        GtkWidget *scale =
            gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, row->min, row->max, 0.05);
        gtk_label_set_xalign(GTK_LABEL(label), 0);
        gtk_widget_add_css_class(number, "numeric");
        gtk_label_set_width_chars(GTK_LABEL(number), 5);
        gtk_scale_set_draw_value(GTK_SCALE(scale), FALSE);
        gtk_scale_add_mark(GTK_SCALE(scale), 0, GTK_POS_BOTTOM, NULL);
        gtk_widget_set_hexpand(scale, TRUE);
        gtk_widget_set_tooltip_text(scale, row->meaning);
        gtk_widget_set_tooltip_text(label, row->meaning);
        char *name = g_strdup_printf("six-%s", row->name);
        gtk_widget_set_name(scale, name);
        g_free(name);
        studio_name(scale, title);
        g_free(title);
        g_signal_connect(scale, "value-changed", G_CALLBACK(on_scale), panel);
        gtk_grid_attach(GTK_GRID(grid), label, 0, i, 1, 1);
        gtk_grid_attach(GTK_GRID(grid), scale, 1, i, 1, 1);
        gtk_grid_attach(GTK_GRID(grid), number, 2, i, 1, 1);
        panel->scales[i] = scale;
        panel->numbers[i] = number;
    }
    return grid;
}

static void studio_levels_panel_dispose(GObject *object) {
    StudioLevelsPanel *panel = STUDIO_LEVELS_PANEL(object);
    panel->is_showing = TRUE;
    g_clear_pointer(&panel->place, g_free);
    G_OBJECT_CLASS(studio_levels_panel_parent_class)->dispose(object);
}

static void studio_levels_panel_class_init(StudioLevelsPanelClass *class) {
    G_OBJECT_CLASS(class)->dispose = studio_levels_panel_dispose;
}

static void studio_levels_panel_init(StudioLevelsPanel *panel) {
    gtk_orientable_set_orientation(GTK_ORIENTABLE(panel), GTK_ORIENTATION_VERTICAL);
    gtk_box_set_spacing(GTK_BOX(panel), 10);
    gtk_widget_add_css_class(GTK_WIDGET(panel), "levels");
    panel->name = gtk_label_new("");
    gtk_widget_add_css_class(panel->name, "heading");
    gtk_label_set_xalign(GTK_LABEL(panel->name), 0);
    panel->stack = gtk_stack_new();
    gtk_stack_set_vhomogeneous(GTK_STACK(panel->stack), FALSE);
    GtkWidget *all = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_stack_add_named(GTK_STACK(panel->stack), make_plant(panel), "plant");
    gtk_stack_add_named(GTK_STACK(panel->stack), make_six(panel), "six");
    gtk_stack_add_named(GTK_STACK(panel->stack), all, "all");
    gtk_box_append(GTK_BOX(panel), panel->name);
    gtk_box_append(GTK_BOX(panel), make_levels(panel));
    gtk_box_append(GTK_BOX(panel), panel->stack);
}

GtkWidget *studio_levels_panel_new(StudioSettings *settings, GtkWidget *inspector) {
    StudioLevelsPanel *panel = g_object_new(STUDIO_TYPE_LEVELS_PANEL, NULL);
    panel->settings = settings;
    panel->inspector = inspector;
    gtk_widget_set_visible(GTK_WIDGET(panel), FALSE);
    return GTK_WIDGET(panel);
}
