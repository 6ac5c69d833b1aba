#include "studio/preset_cards.h"

#include "frond/presets.h"
#include "studio/accessible.h"
#include "studio/files.h"
#include "studio/model/presets.h"

#include <adwaita.h>
#include <glib/gstdio.h>
#include <string.h>

enum { PICTURE_WIDTH = 120, PICTURE_HEIGHT = 150, LATER_MILLISECONDS = 150 };

struct _StudioPresetCards {
    GtkBox parent;
    GFileMonitor *monitor; // of the user's presets
    GHashTable *drawn;     // names of presets whose picture has been asked for
    GHashTable *broken;    // name → what is wrong with a preset
    guint later;           // timer: what has changed is shown
    GtkWidget *own_heading, *own;
};

static guint chosen;

G_DEFINE_TYPE(StudioPresetCards, studio_preset_cards, GTK_TYPE_BOX)

// ---- pictures ----------------------------------------------------------------------------------

static void draw_in_thread(GTask *task, gpointer source, gpointer name, GCancellable *cancellable) {
    (void)source;
    (void)cancellable;
    char *folder = fr_presets_folder(), *file = fr_presets_file(folder, name, ".frond");
    char *problem = studio_presets_problem(file);
    FrContext context = fr_context_default();
    bool is_drawn = problem == NULL && studio_presets_draw(folder, name, &context) == FR_OK;
    if (problem == NULL && !is_drawn) {
        problem = g_strdup("it has no picture, as nothing grows from it");
    }
    g_task_return_pointer(task, problem, g_free); // NULL: the monitor sees the picture
    g_free(file);
    g_free(folder);
}

static void fill_own(StudioPresetCards *cards);

static void on_drawn(GObject *object, GAsyncResult *result, gpointer data) {
    (void)data;
    StudioPresetCards *cards = STUDIO_PRESET_CARDS(object);
    char *problem = g_task_propagate_pointer(G_TASK(result), NULL);
    const char *name = g_task_get_task_data(G_TASK(result));
    if (cards->broken != NULL && problem != NULL) { // they are still there
        g_hash_table_insert(cards->broken, g_strdup(name), g_strdup(problem));
        fill_own(cards);
    } else if (cards->broken != NULL && g_hash_table_remove(cards->broken, name)) {
        fill_own(cards);
    }
    g_free(problem);
}

static void draw(StudioPresetCards *cards, const char *name) {
    if (g_hash_table_add(cards->drawn, g_strdup(name))) {
        GTask *task = g_task_new(cards, NULL, on_drawn, NULL);
        g_task_set_task_data(task, g_strdup(name), g_free);
        g_task_run_in_thread(task, draw_in_thread);
        g_object_unref(task);
    }
}

// ---- cards -------------------------------------------------------------------------------------

static GtkWidget *make_picture(const char *file, bool is_broken) {
    GtkWidget *picture;
    if (is_broken) {
        picture = gtk_image_new_from_icon_name("dialog-warning-symbolic");
        gtk_image_set_pixel_size(GTK_IMAGE(picture), 48);
        gtk_widget_add_css_class(picture, "warning");
        gtk_widget_set_name(picture, "broken");
    } else if (file != NULL) {
        picture = gtk_picture_new_for_filename(file);
        gtk_picture_set_can_shrink(GTK_PICTURE(picture), TRUE);
    } else {
        picture = gtk_image_new_from_icon_name("org.frond.Studio-symbolic");
        gtk_image_set_pixel_size(GTK_IMAGE(picture), 48);
        gtk_widget_set_opacity(picture, 0.4);
    }
    gtk_widget_set_size_request(picture, PICTURE_WIDTH, PICTURE_HEIGHT);
    gtk_widget_add_css_class(picture, "preset-picture");
    gtk_widget_set_overflow(picture, GTK_OVERFLOW_HIDDEN);
    GtkWidget *clamp = adw_clamp_new(); // or each would be as wide as its picture has pixels
    adw_clamp_set_maximum_size(ADW_CLAMP(clamp), PICTURE_WIDTH);
    adw_clamp_set_tightening_threshold(ADW_CLAMP(clamp), PICTURE_WIDTH);
    adw_clamp_set_child(ADW_CLAMP(clamp), picture);
    return clamp;
}

static GtkWidget *make_menu(const char *name) {
    static const char *const items[][2] = {{"_Rename…", "win.rename-preset"},
                                           {"Re_move…", "win.remove-preset"}};
    GMenu *menu = g_menu_new();
    for (size_t i = 0; i < G_N_ELEMENTS(items); i++) {
        GMenuItem *item = g_menu_item_new(items[i][0], NULL);
        g_menu_item_set_action_and_target(item, items[i][1], "s", name);
        g_menu_append_item(menu, item);
        g_object_unref(item);
    }
    GtkWidget *button = gtk_menu_button_new();
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "view-more-symbolic");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), G_MENU_MODEL(menu));
    gtk_widget_set_halign(button, GTK_ALIGN_END);
    gtk_widget_set_valign(button, GTK_ALIGN_START);
    gtk_widget_add_css_class(button, "preset-menu");
    studio_tell(button, "Rename or remove");
    char *called = g_strdup_printf("menu-of:%s", name);
    gtk_widget_set_name(button, called);
    g_free(called);
    g_object_unref(menu);
    return button;
}

// `problem`: what is wrong with it; NULL: nothing.
static GtkWidget *make_card(const char *name, bool is_own, const char *file, const char *problem) {
    char *title = is_own ? g_strdup(name) : studio_preset_title(name);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
    GtkWidget *label = gtk_label_new(title);
    gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
    gtk_box_append(GTK_BOX(box), make_picture(file, problem != NULL));
    gtk_box_append(GTK_BOX(box), label);
    GtkWidget *child = gtk_flow_box_child_new();
    if (is_own) {
        GtkWidget *overlay = gtk_overlay_new();
        gtk_overlay_set_child(GTK_OVERLAY(overlay), box);
        gtk_overlay_add_overlay(GTK_OVERLAY(overlay), make_menu(name));
        box = overlay;
    }
    gtk_flow_box_child_set_child(GTK_FLOW_BOX_CHILD(child), box);
    gtk_widget_add_css_class(child, "preset");
    gtk_widget_set_name(child, name);
    char *tip = problem == NULL ? g_strdup(title) : g_strdup_printf("%s: %s", title, problem);
    studio_tell(child, tip);
    g_free(tip);
    g_free(title);
    return child;
}

static void on_activated(GtkFlowBox *flow, GtkFlowBoxChild *child, StudioPresetCards *cards) {
    (void)flow;
    char *name = g_strdup(gtk_widget_get_name(GTK_WIDGET(child))); // the card may go with the page
    g_signal_emit(cards, chosen, 0, name);
    g_free(name);
}

static GtkWidget *make_flow(StudioPresetCards *cards) {
    GtkWidget *flow = gtk_flow_box_new();
    gtk_flow_box_set_selection_mode(GTK_FLOW_BOX(flow), GTK_SELECTION_NONE);
    gtk_flow_box_set_homogeneous(GTK_FLOW_BOX(flow), TRUE);
    gtk_flow_box_set_max_children_per_line(GTK_FLOW_BOX(flow), 12);
    gtk_flow_box_set_row_spacing(GTK_FLOW_BOX(flow), 6);
    gtk_flow_box_set_column_spacing(GTK_FLOW_BOX(flow), 6);
    gtk_widget_set_valign(flow, GTK_ALIGN_START);
    g_signal_connect(flow, "child-activated", G_CALLBACK(on_activated), cards);
    return flow;
}

static GtkWidget *make_heading(const char *text) {
    GtkWidget *label = gtk_label_new(text);
    gtk_widget_add_css_class(label, "heading");
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    return label;
}

// ---- the user's --------------------------------------------------------------------------------

// The picture of a preset; NULL: there is none that is as new as the preset.
static char *picture_of(const char *name) {
    char *document = studio_preset_file(name, ".frond"), *file = studio_preset_file(name, ".png");
    GStatBuf changed, drawn;
    if (file != NULL && document != NULL && g_stat(document, &changed) == 0 &&
        g_stat(file, &drawn) == 0 && drawn.st_mtime < changed.st_mtime) {
        g_clear_pointer(&file, g_free);
    }
    g_free(document);
    return file;
}

static void fill_own(StudioPresetCards *cards) {
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(cards->own)) != NULL) {
        gtk_flow_box_remove(GTK_FLOW_BOX(cards->own), child);
    }
    GPtrArray *names = studio_own_presets();
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        char *file = picture_of(name);
        if (file == NULL) {
            draw(cards, name);
        }
        gtk_flow_box_append(GTK_FLOW_BOX(cards->own),
                            make_card(name, true, file, g_hash_table_lookup(cards->broken, name)));
        g_free(file);
    }
    gtk_widget_set_visible(cards->own_heading, names->len > 0);
    gtk_widget_set_visible(cards->own, names->len > 0);
    g_ptr_array_unref(names);
}

static gboolean on_later(gpointer data) {
    StudioPresetCards *cards = data;
    cards->later = 0;
    fill_own(cards);
    return G_SOURCE_REMOVE;
}

static void on_files(GFileMonitor *monitor, GFile *file, GFile *other, GFileMonitorEvent event,
                     StudioPresetCards *cards) {
    (void)monitor;
    (void)other;
    (void)event;
    char *name = g_file_get_basename(file);
    if (g_str_has_suffix(name, ".frond")) { // another one now, to be looked at again
        name[strlen(name) - strlen(".frond")] = '\0';
        g_hash_table_remove(cards->drawn, name);
        g_hash_table_remove(cards->broken, name);
    }
    g_free(name);
    if (cards->later == 0) {
        cards->later = g_timeout_add(LATER_MILLISECONDS, on_later, cards);
    }
}

static void watch_own(StudioPresetCards *cards) {
    char *folder = fr_presets_folder();
    g_mkdir_with_parents(folder, 0777); // else it could not be watched
    GFile *file = g_file_new_for_path(folder);
    cards->monitor = g_file_monitor_directory(file, G_FILE_MONITOR_NONE, NULL, NULL);
    if (cards->monitor != NULL) {
        g_signal_connect(cards->monitor, "changed", G_CALLBACK(on_files), cards);
    }
    g_object_unref(file);
    g_free(folder);
}

// ---- life --------------------------------------------------------------------------------------

static void add_shipped(StudioPresetCards *cards) {
    gtk_box_append(GTK_BOX(cards), make_heading("Presets"));
    GtkWidget *flow = make_flow(cards);
    GPtrArray *names = studio_shipped_presets();
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        char *relative = g_strconcat("presets/", name, ".png", NULL);
        char *file = studio_data_file(relative);
        gtk_flow_box_append(GTK_FLOW_BOX(flow), make_card(name, false, file, NULL));
        g_free(file);
        g_free(relative);
    }
    if (names->len == 0) {
        gtk_flow_box_append(
            GTK_FLOW_BOX(flow),
            gtk_label_new("No presets were found; FROND_DATA may name their folder"));
    }
    g_ptr_array_unref(names);
    gtk_box_append(GTK_BOX(cards), flow);
}

static void studio_preset_cards_dispose(GObject *object) {
    StudioPresetCards *cards = STUDIO_PRESET_CARDS(object);
    g_clear_handle_id(&cards->later, g_source_remove);
    if (cards->monitor != NULL) {
        g_signal_handlers_disconnect_by_data(cards->monitor, cards);
    }
    g_clear_object(&cards->monitor);
    g_clear_pointer(&cards->drawn, g_hash_table_unref);
    g_clear_pointer(&cards->broken, g_hash_table_unref);
    G_OBJECT_CLASS(studio_preset_cards_parent_class)->dispose(object);
}

static void studio_preset_cards_class_init(StudioPresetCardsClass *class) {
    G_OBJECT_CLASS(class)->dispose = studio_preset_cards_dispose;
    chosen = g_signal_new("chosen", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                          NULL, G_TYPE_NONE, 1, G_TYPE_STRING);
}

static void studio_preset_cards_init(StudioPresetCards *cards) {
    gtk_orientable_set_orientation(GTK_ORIENTABLE(cards), GTK_ORIENTATION_VERTICAL);
    gtk_box_set_spacing(GTK_BOX(cards), 12);
    cards->drawn = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    cards->broken = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    cards->own_heading = make_heading("Yours");
    cards->own = make_flow(cards);
    gtk_box_append(GTK_BOX(cards), cards->own_heading);
    gtk_box_append(GTK_BOX(cards), cards->own);
    fill_own(cards);
    watch_own(cards);
    add_shipped(cards);
}

GtkWidget *studio_preset_cards_new(void) {
    return g_object_new(STUDIO_TYPE_PRESET_CARDS, NULL);
}
