/// The dialog that saves the view as a picture.
#include "frond/image.h"
#include "studio/accessible.h"
#include "studio/widgets.h"
#include "studio/window_private.h"

#include <string.h>

enum { LONGEST_SIDE = 4096, DIALOG_WIDTH = 460 };

static const char ending[] = ".png", usual_name[] = "plant";

typedef struct Asked {
    StudioWindow *window;
    GtkWindow *dialog;
    GtkEditable *name, *folder;
    GtkSpinButton *width, *height;
    GtkWidget *clear, *save; // a switch, a button
    GtkLabel *note;
} Asked;

// ---- where -------------------------------------------------------------------------------------

// The file that is asked for. Free with g_free(); NULL: there is no name for one.
static char *file_of(const Asked *asked) {
    const char *name = gtk_editable_get_text(asked->name);
    const char *folder = gtk_editable_get_text(asked->folder);
    if (*name == '\0' || strchr(name, '/') != NULL || *folder == '\0') {
        return NULL;
    }
    char *whole = g_str_has_suffix(name, ending) ? g_strdup(name) : g_strconcat(name, ending, NULL);
    char *file = g_build_filename(folder, whole, NULL);
    g_free(whole);
    return file;
}

// A name that no file of the folder has: "oak", "oak 2". Free with g_free().
static char *free_name(const char *folder, const char *stem) {
    char *name = g_strconcat(stem, ending, NULL), *file = g_build_filename(folder, name, NULL);
    for (int k = 2; g_file_test(file, G_FILE_TEST_EXISTS); k++) {
        g_free(name);
        g_free(file);
        name = g_strdup_printf("%s %d%s", stem, k, ending);
        file = g_build_filename(folder, name, NULL);
    }
    g_free(file);
    return name;
}

static void propose(Asked *asked) {
    const char *path = studio_document_path(asked->window->document);
    const char *pictures = g_get_user_special_dir(G_USER_DIRECTORY_PICTURES);
    char *folder = path != NULL       ? g_path_get_dirname(path)
                   : pictures != NULL ? g_strdup(pictures)
                                      : g_strdup(g_get_home_dir());
    char *stem = path == NULL ? g_strdup(usual_name) : g_path_get_basename(path);
    char *dot = strrchr(stem, '.');
    if (dot != NULL && dot != stem) {
        *dot = '\0';
    }
    char *name = free_name(folder, stem);
    gtk_editable_set_text(asked->folder, folder);
    gtk_editable_set_text(asked->name, name);
    g_free(name);
    g_free(stem);
    g_free(folder);
}

static void on_folder_chosen(GtkNativeDialog *chooser, int response, Asked *asked) {
    char *path = studio_chosen_path(chooser, response);
    if (path != NULL) {
        gtk_editable_set_text(asked->folder, path);
    }
    g_free(path);
    g_object_unref(chooser);
}

static void on_choose_folder(GtkButton *button, Asked *asked) {
    (void)button;
    GtkFileChooserNative *chooser =
        gtk_file_chooser_native_new("Folder of the Picture", asked->dialog,
                                    GTK_FILE_CHOOSER_ACTION_SELECT_FOLDER, "_Choose", "_Cancel");
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
    g_signal_connect(chooser, "response", G_CALLBACK(on_folder_chosen), asked);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
}

static void on_place(GtkEditable *editable, Asked *asked) {
    (void)editable;
    char *file = file_of(asked);
    bool is_there = file != NULL && g_file_test(file, G_FILE_TEST_EXISTS);
    gtk_label_set_text(asked->note, file == NULL ? "A name has no slashes, and is not empty"
                                    : is_there   ? "It takes the place of the one called so"
                                                 : "");
    gtk_widget_remove_css_class(GTK_WIDGET(asked->note), "error");
    gtk_widget_set_sensitive(asked->save, file != NULL);
    gtk_button_set_label(GTK_BUTTON(asked->save), is_there ? "_Replace" : "_Save");
    gtk_widget_remove_css_class(asked->save, is_there ? "suggested-action" : "destructive-action");
    gtk_widget_add_css_class(asked->save, is_there ? "destructive-action" : "suggested-action");
    g_free(file);
}

// ---- saving ------------------------------------------------------------------------------------

// Why it could not be written (free with g_free()); NULL: it was.
static char *write_picture(const FrImage *image, const char *file) {
    GError *error = NULL;
    gsize size;
    GBytes *png = fr_image_to_png(image);
    const char *bytes = g_bytes_get_data(png, &size);
    char *problem = NULL;
    if (!g_file_set_contents(file, bytes, (gssize)size, &error)) {
        const char *reason = g_strrstr(error->message, ": "); // behind the names of files
        problem = g_strdup_printf("It cannot be written%s", reason == NULL ? "" : reason);
        g_error_free(error);
    }
    g_bytes_unref(png);
    return problem;
}

static void on_save(GtkWidget *widget, Asked *asked) {
    (void)widget;
    StudioWindow *window = asked->window;
    char *file = file_of(asked);
    if (file == NULL) {
        return;
    }
    FrImage *image =
        studio_viewport_picture(window->viewport, gtk_spin_button_get_value_as_int(asked->width),
                                gtk_spin_button_get_value_as_int(asked->height),
                                gtk_switch_get_active(GTK_SWITCH(asked->clear)));
    char *problem = image == NULL ? g_strdup("So large a picture is too much for the graphics card")
                                  : write_picture(image, file);
    if (problem == NULL) {
        studio_window_say(window, "Saved %s", file);
        gtk_window_close(asked->dialog);
    } else {
        gtk_label_set_text(asked->note, problem);
        gtk_widget_add_css_class(GTK_WIDGET(asked->note), "error");
    }
    if (image != NULL) {
        fr_image_unref(image);
    }
    g_free(problem);
    g_free(file);
}

// ---- the dialog --------------------------------------------------------------------------------

static GtkWidget *entry_row(AdwPreferencesGroup *group, const char *title, const char *name,
                            Asked *asked) {
    GtkWidget *row = adw_entry_row_new();
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
    gtk_widget_set_name(row, name);
    g_signal_connect(row, "entry-activated", G_CALLBACK(on_save), asked);
    g_signal_connect(row, "changed", G_CALLBACK(on_place), asked);
    adw_preferences_group_add(group, row);
    return row;
}

static GtkWidget *size_row(AdwPreferencesGroup *group, const char *title, const char *name,
                           int value) {
    GtkWidget *row = adw_action_row_new();
    GtkWidget *spin = gtk_spin_button_new_with_range(16, LONGEST_SIDE, 1);
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(spin), value);
    gtk_widget_set_valign(spin, GTK_ALIGN_CENTER);
    gtk_widget_set_name(spin, name);
    studio_name(spin, title);
    adw_action_row_add_suffix(ADW_ACTION_ROW(row), spin);
    adw_action_row_set_activatable_widget(ADW_ACTION_ROW(row), spin);
    adw_preferences_group_add(group, row);
    return spin;
}

static GtkWidget *clear_row(AdwPreferencesGroup *group) {
    GtkWidget *row = adw_action_row_new(), *toggle = gtk_switch_new();
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), "Transparent");
    adw_action_row_set_subtitle(ADW_ACTION_ROW(row),
                                "The plants alone, without floor and backdrop");
    gtk_widget_set_valign(toggle, GTK_ALIGN_CENTER);
    gtk_widget_set_name(toggle, "picture-clear");
    studio_name(toggle, "Transparent");
    adw_action_row_add_suffix(ADW_ACTION_ROW(row), toggle);
    adw_action_row_set_activatable_widget(ADW_ACTION_ROW(row), toggle);
    adw_preferences_group_add(group, row);
    return toggle;
}

static GtkWidget *make_header(Asked *asked) {
    GtkWidget *header = adw_header_bar_new();
    GtkWidget *cancel = gtk_button_new_with_mnemonic("_Cancel");
    asked->save = gtk_button_new_with_mnemonic("_Save");
    gtk_widget_set_name(asked->save, "picture-save");
    gtk_widget_add_css_class(asked->save, "suggested-action");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(cancel), "window.close");
    g_signal_connect(asked->save, "clicked", G_CALLBACK(on_save), asked);
    adw_header_bar_set_show_start_title_buttons(ADW_HEADER_BAR(header), FALSE);
    adw_header_bar_set_show_end_title_buttons(ADW_HEADER_BAR(header), FALSE);
    adw_header_bar_pack_start(ADW_HEADER_BAR(header), cancel);
    adw_header_bar_pack_end(ADW_HEADER_BAR(header), asked->save);
    return header;
}

static GtkWidget *make_contents(Asked *asked) {
    GtkWidget *place = adw_preferences_group_new(), *look = adw_preferences_group_new();
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 12);
    GtkWidget *viewport = GTK_WIDGET(asked->window->viewport);
    int scale = gtk_widget_get_scale_factor(viewport);
    asked->note = GTK_LABEL(gtk_label_new(""));
    gtk_label_set_wrap(asked->note, TRUE);
    gtk_label_set_xalign(asked->note, 0);
    gtk_widget_set_name(GTK_WIDGET(asked->note), "picture-note");
    AdwPreferencesGroup *places = ADW_PREFERENCES_GROUP(place),
                        *looks = ADW_PREFERENCES_GROUP(look);
    GtkWidget *name = entry_row(places, "Name", "picture-name", asked);
    GtkWidget *folder = entry_row(places, "Folder", "picture-folder", asked);
    GtkWidget *choose = studio_flat_button("folder-open-symbolic", "Choose a folder");
    gtk_widget_set_valign(choose, GTK_ALIGN_CENTER);
    g_signal_connect(choose, "clicked", G_CALLBACK(on_choose_folder), asked);
    adw_entry_row_add_suffix(ADW_ENTRY_ROW(folder), choose);
    asked->name = GTK_EDITABLE(name);
    asked->folder = GTK_EDITABLE(folder);
    asked->width = GTK_SPIN_BUTTON(
        size_row(looks, "Width", "picture-width", scale * gtk_widget_get_width(viewport)));
    asked->height = GTK_SPIN_BUTTON(
        size_row(looks, "Height", "picture-height", scale * gtk_widget_get_height(viewport)));
    asked->clear = clear_row(looks);
    gtk_widget_add_css_class(box, "dialog-inside");
    gtk_box_append(GTK_BOX(box), place);
    gtk_box_append(GTK_BOX(box), GTK_WIDGET(asked->note));
    gtk_box_append(GTK_BOX(box), look);
    return box;
}

void studio_window_ask_picture(StudioWindow *window) {
    Asked *asked = g_new0(Asked, 1);
    GtkWidget *dialog = adw_window_new(), *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    asked->window = window;
    asked->dialog = GTK_WINDOW(dialog);
    g_object_set_data_full(G_OBJECT(dialog), "studio-asked", asked, g_free);
    gtk_box_append(GTK_BOX(box), make_header(asked));
    gtk_box_append(GTK_BOX(box), make_contents(asked));
    adw_window_set_content(ADW_WINDOW(dialog), box);
    propose(asked);
    gtk_window_set_title(asked->dialog, "Save the Picture");
    gtk_window_set_default_size(asked->dialog, DIALOG_WIDTH, -1);
    gtk_window_set_transient_for(asked->dialog, GTK_WINDOW(window));
    gtk_window_set_destroy_with_parent(asked->dialog, TRUE);
    gtk_window_set_modal(asked->dialog, TRUE);
    gtk_window_set_default_widget(asked->dialog, asked->save);
    studio_close_on_escape(dialog);
    gtk_window_present(asked->dialog);
    gtk_widget_grab_focus(GTK_WIDGET(asked->name));
}
