/// Presets of the user: a part of a plant is kept as one, called otherwise, removed; and any preset
/// is put into the graph of a plant.
#include "frond/presets.h"
#include "studio/accessible.h"
#include "studio/model/adopt.h"
#include "studio/model/presets.h"
#include "studio/model/subgraph.h"
#include "studio/preset_cards.h"
#include "studio/widgets.h"
#include "studio/window_private.h"

#include <string.h>

enum { CHOICE_WIDTH = 760, CHOICE_HEIGHT = 620 };

static const char key_what[] = "studio-what";

// ---- what is asked -----------------------------------------------------------------------------

// A question for a name, with what comes of it below.
typedef struct Asked {
    StudioWindow *window;
    AdwMessageDialog *dialog;
    GtkEditable *entry;
    GtkLabel *note;
    char *what;       // component that is kept, or preset that is renamed
    bool may_replace; // what is called so
    const char *verb;
} Asked;

static void asked_free(gpointer asked, GClosure *closure) {
    (void)closure;
    g_free(((Asked *)asked)->what);
    g_free(asked);
}

static bool is_among(GPtrArray *names, const char *name) {
    bool is_it = g_ptr_array_find_with_equal_func(names, name, g_str_equal, NULL);
    g_ptr_array_unref(names);
    return is_it;
}

static void on_name(GtkEditable *entry, Asked *asked) {
    const char *name = gtk_editable_get_text(entry);
    const char *refusal = studio_presets_name_refusal(name), *note = refusal;
    bool is_unchanged = !asked->may_replace && strcmp(name, asked->what) == 0;
    bool is_clash = !is_unchanged && is_among(studio_own_presets(), name);
    if (note == NULL && is_among(studio_shipped_presets(), name)) {
        note = refusal = "A preset that comes with the program is called so";
    } else if (note == NULL && is_clash && asked->may_replace) {
        note = "It takes the place of the one called so";
    } else if (note == NULL && is_clash) {
        note = refusal = "Another preset is called so";
    }
    bool is_replaced = is_clash && refusal == NULL;
    gtk_label_set_text(asked->note, note == NULL ? "" : note);
    adw_message_dialog_set_response_enabled(asked->dialog, "do", refusal == NULL && !is_unchanged);
    adw_message_dialog_set_response_label(asked->dialog, "do",
                                          is_replaced ? "_Replace" : asked->verb);
    adw_message_dialog_set_response_appearance(
        asked->dialog, "do", is_replaced ? ADW_RESPONSE_DESTRUCTIVE : ADW_RESPONSE_SUGGESTED);
}

static Asked *ask_name(StudioWindow *window, const char *heading, const char *body,
                       const char *verb, const char *what) {
    Asked *asked = g_new0(Asked, 1);
    GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(window), heading, body);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
    GtkWidget *entry = gtk_entry_new(), *note = gtk_label_new("");
    *asked = (Asked){window,
                     ADW_MESSAGE_DIALOG(dialog),
                     GTK_EDITABLE(entry),
                     GTK_LABEL(note),
                     g_strdup(what),
                     false,
                     verb};
    gtk_entry_set_activates_default(GTK_ENTRY(entry), TRUE);
    gtk_widget_set_name(entry, "preset-name");
    studio_name(entry, "Name of the preset");
    gtk_widget_set_name(note, "preset-note");
    gtk_widget_add_css_class(note, "dim-label");
    gtk_label_set_wrap(GTK_LABEL(note), TRUE);
    gtk_label_set_xalign(GTK_LABEL(note), 0);
    gtk_box_append(GTK_BOX(box), entry);
    gtk_box_append(GTK_BOX(box), note);
    adw_message_dialog_set_extra_child(asked->dialog, box);
    adw_message_dialog_add_responses(asked->dialog, "cancel", "_Cancel", "do", verb, NULL);
    adw_message_dialog_set_default_response(asked->dialog, "do");
    adw_message_dialog_set_close_response(asked->dialog, "cancel");
    return asked;
}

static void show_asked(Asked *asked, const char *name, GCallback answered) {
    g_signal_connect(asked->entry, "changed", G_CALLBACK(on_name), asked);
    g_signal_connect_data(asked->dialog, "response", answered, asked, asked_free, 0);
    gtk_editable_set_text(asked->entry, name);
    on_name(asked->entry, asked);
    gtk_window_present(GTK_WINDOW(asked->dialog));
    gtk_widget_grab_focus(GTK_WIDGET(asked->entry));
}

// ---- keeping a part ----------------------------------------------------------------------------

static void keep(StudioWindow *window, const char *id, const char *name) {
    char *folder = fr_presets_folder();
    char *text = studio_subgraph_text(window->document, studio_window_plant(window), id, name);
    FrDiags *diags = fr_diags_new();
    if (text == NULL) {
        studio_window_say(window, "There is no such component");
    } else if (studio_presets_save(folder, name, text, studio_document_folder(window->document),
                                   diags) != FR_OK) {
        studio_window_say(window, "It is not kept: %s", fr_diags_get(diags, 0)->text);
    } else {
        studio_window_say(window, "Kept as the preset %s", name);
    }
    fr_diags_free(diags);
    g_free(text);
    g_free(folder);
}

static void on_keep(AdwMessageDialog *dialog, const char *response, Asked *asked) {
    (void)dialog;
    if (strcmp(response, "do") == 0 && asked->window->document != NULL) {
        keep(asked->window, asked->what, gtk_editable_get_text(asked->entry));
    }
}

static void do_save(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    const char *id = studio_window_component(window);
    if (id != NULL) {
        Asked *asked = ask_name(window, "Keep as a Preset?",
                                "The component and everything beneath it, with its materials and "
                                "curves, for other plants.",
                                "_Keep", id);
        asked->may_replace = true;
        show_asked(asked, id, G_CALLBACK(on_keep));
    }
}

static void do_save_as(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioWindow *window = data;
    const char *name = g_variant_get_string(parameter, NULL), *id = studio_window_component(window);
    if (id != NULL && studio_presets_name_refusal(name) == NULL) {
        keep(window, id, name);
    }
}

// ---- other names, and none ---------------------------------------------------------------------

static void on_rename(AdwMessageDialog *dialog, const char *response, Asked *asked) {
    (void)dialog;
    const char *to = gtk_editable_get_text(asked->entry);
    char *folder = fr_presets_folder();
    if (strcmp(response, "do") == 0 && !studio_presets_rename(folder, asked->what, to)) {
        studio_window_say(asked->window, "%s cannot be renamed", asked->what);
    }
    g_free(folder);
}

static void do_rename(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    const char *name = g_variant_get_string(parameter, NULL);
    Asked *asked = ask_name(data, "Rename the Preset", NULL, "_Rename", name);
    show_asked(asked, name, G_CALLBACK(on_rename));
}

static void on_remove(AdwMessageDialog *dialog, const char *response, StudioWindow *window) {
    const char *name = g_object_get_data(G_OBJECT(dialog), key_what);
    char *folder = fr_presets_folder();
    if (strcmp(response, "remove") == 0 && !studio_presets_remove(folder, name)) {
        studio_window_say(window, "%s cannot be removed", name);
    }
    g_free(folder);
}

static void do_remove(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    const char *name = g_variant_get_string(parameter, NULL);
    char *heading = g_strdup_printf("Remove the Preset %s?", name);
    GtkWidget *dialog = adw_message_dialog_new(
        GTK_WINDOW(data), heading, "Plants that it was put into stay. It cannot be brought back.");
    AdwMessageDialog *message = ADW_MESSAGE_DIALOG(dialog);
    adw_message_dialog_add_responses(message, "cancel", "_Cancel", "remove", "_Remove", NULL);
    adw_message_dialog_set_response_appearance(message, "remove", ADW_RESPONSE_DESTRUCTIVE);
    adw_message_dialog_set_default_response(message, "cancel");
    adw_message_dialog_set_close_response(message, "cancel");
    g_object_set_data_full(G_OBJECT(dialog), key_what, g_strdup(name), g_free);
    g_signal_connect(dialog, "response", G_CALLBACK(on_remove), data);
    gtk_window_present(GTK_WINDOW(dialog));
    g_free(heading);
}

// ---- putting one in ----------------------------------------------------------------------------

// What a preset is put on if nothing is chosen: the Camera. Free with g_free(); NULL: there is
// none.
static char *camera_of(StudioWindow *window) {
    const FrContents *contents = studio_document_contents(window->document);
    uint32_t graph = studio_graph_of(window->document, studio_window_plant(window));
    uint32_t camera = graph == FR_NONE ? FR_NONE : fr_contents_child(contents, graph, "camera");
    return camera == FR_NONE ? NULL : g_strdup(fr_contents_at(contents, camera)->id);
}

static FrContents *read_preset(const char *file) {
    FrContext context = fr_context_default();
    FrStatus status;
    FrSource *source =
        file == NULL ? NULL : fr_source_load(file, context.limits.document_bytes, NULL, &status);
    FrContents *contents = NULL;
    if (source != NULL && fr_contents_read(source, &context, &contents) != FR_OK) {
        contents = NULL;
    }
    fr_source_unref(source);
    return contents;
}

StudioCarried studio_window_bring(StudioWindow *window, const char *name,
                                  GHashTable *(*elements)(const FrContents *)) {
    char *file = studio_preset_file(name, ".frond");
    FrContents *theirs = read_preset(file);
    StudioCarried carried = {NULL, NULL, g_ptr_array_new_with_free_func(g_free)};
    carried.refusal = file == NULL ? NULL : studio_presets_problem(file);
    if (theirs == NULL && carried.refusal == NULL) {
        carried.refusal = g_strdup("It cannot be read");
    } else if (carried.refusal == NULL) {
        studio_carried_clear(&carried);
        GHashTable *wanted = elements(theirs);
        char *folder = g_path_get_dirname(file);
        carried = studio_bring(window->document, theirs, folder, wanted);
        g_free(folder);
        g_hash_table_unref(wanted);
    }
    if (carried.refusal != NULL) {
        studio_window_say(window, "The preset %s is not put in: %s", name, carried.refusal);
    }
    fr_contents_free(theirs);
    g_free(file);
    return carried;
}

// `on`: the component beneath which it comes; empty: beneath none.
static void insert(StudioWindow *window, const char *name, const char *on) {
    StudioCarried carried = studio_window_bring(window, name, studio_subgraph_elements);
    const char *refusal = carried.source == NULL ? NULL : studio_subgraph_refusal(carried.source);
    char *id = NULL;
    if (refusal != NULL) {
        studio_window_say(window, "The preset %s is not put in: %s", name, refusal);
    } else if (carried.source != NULL &&
               studio_insert_subgraph(window->document, studio_window_plant(window), carried.source,
                                      *on == '\0' ? NULL : on, &id)) {
        studio_window_select_component(window, id);
    } else {
        studio_carried_undo(&carried);
    }
    studio_carried_clear(&carried);
    g_free(id);
}

static char *usual_place(StudioWindow *window) {
    char *on = g_strdup(studio_window_component(window));
    on = on != NULL ? on : camera_of(window);
    return on != NULL ? on : g_strdup("");
}

static void on_chosen(GtkWidget *cards, const char *name, StudioWindow *window) {
    GtkWidget *dialog = GTK_WIDGET(gtk_widget_get_root(cards));
    char *on = g_strdup(g_object_get_data(G_OBJECT(dialog), key_what));
    gtk_window_destroy(GTK_WINDOW(dialog));
    insert(window, name, on);
    g_free(on);
}

static void ask_preset(StudioWindow *window, const char *on) {
    GtkWidget *dialog = adw_window_new(), *header = adw_header_bar_new();
    GtkWidget *cards = studio_preset_cards_new(), *scrolled = gtk_scrolled_window_new();
    char *where = *on == '\0' ? g_strdup("linked to nothing yet") : g_strdup_printf("onto %s", on);
    adw_header_bar_set_title_widget(ADW_HEADER_BAR(header),
                                    adw_window_title_new("Insert a Preset", where));
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), cards);
    gtk_widget_set_vexpand(scrolled, TRUE);
    gtk_widget_add_css_class(cards, "dialog-inside");
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_box_append(GTK_BOX(box), header);
    gtk_box_append(GTK_BOX(box), scrolled);
    adw_window_set_content(ADW_WINDOW(dialog), box);
    gtk_window_set_title(GTK_WINDOW(dialog), "Insert a Preset");
    gtk_window_set_default_size(GTK_WINDOW(dialog), CHOICE_WIDTH, CHOICE_HEIGHT);
    gtk_window_set_transient_for(GTK_WINDOW(dialog), GTK_WINDOW(window));
    gtk_window_set_modal(GTK_WINDOW(dialog), TRUE);
    gtk_widget_insert_action_group(dialog, "win", G_ACTION_GROUP(window)); // of the cards' menus
    g_object_set_data_full(G_OBJECT(dialog), key_what, g_strdup(on), g_free);
    g_signal_connect(cards, "chosen", G_CALLBACK(on_chosen), window);
    studio_close_on_escape(dialog);
    gtk_window_present(GTK_WINDOW(dialog));
    g_free(where);
}

static void do_insert(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    char *on = usual_place(data);
    ask_preset(data, on);
    g_free(on);
}

static void do_insert_on(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    ask_preset(data, g_variant_get_string(parameter, NULL));
}

static void do_insert_named(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    char *on = usual_place(data);
    insert(data, g_variant_get_string(parameter, NULL), on);
    g_free(on);
}

// ---- the clipboard -----------------------------------------------------------------------------

// What is copied is a document: it can be pasted into a text as well.
static void do_copy(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    const char *id = studio_window_component(window);
    char *text = id == NULL
                     ? NULL
                     : studio_subgraph_text(window->document, studio_window_plant(window), id, id);
    if (text != NULL) {
        gdk_clipboard_set_text(gtk_widget_get_clipboard(GTK_WIDGET(window)), text);
        studio_window_say(window, "Copied %s with everything beneath it", id);
    }
    g_free(text);
}

// A file that what was copied names and that is not beside the document. Free with g_free().
static char *missing_file(const StudioWindow *window, FrSource *source) {
    FrContext context = fr_context_default();
    FrContents *contents;
    char *missing = NULL;
    GPtrArray *names = fr_contents_read(source, &context, &contents) == FR_OK
                           ? studio_named_files(contents)
                           : g_ptr_array_new();
    for (guint i = 0; i < names->len && missing == NULL; i++) {
        const char *name = g_ptr_array_index(names, i);
        char *path = g_build_filename(studio_document_folder(window->document), name, NULL);
        missing = g_file_test(path, G_FILE_TEST_EXISTS) ? NULL : g_strdup(name);
        g_free(path);
    }
    g_ptr_array_unref(names);
    fr_contents_free(contents);
    return missing;
}

static void paste(StudioWindow *window, const char *text) {
    FrSource *source = fr_source_new("clipboard", text, strlen(text));
    char *on = usual_place(window), *id = NULL, *missing = missing_file(window, source);
    const char *refusal = studio_subgraph_refusal(source);
    if (refusal != NULL) {
        studio_window_say(window, "What was copied is no part of a plant");
    } else if (missing != NULL) {
        studio_window_say(window, "It needs the file %s, which a preset would bring", missing);
    } else if (studio_insert_subgraph(window->document, studio_window_plant(window), source,
                                      *on == '\0' ? NULL : on, &id)) {
        studio_window_select_component(window, id);
    }
    g_free(missing);
    g_free(id);
    g_free(on);
    fr_source_unref(source);
}

static void on_clipboard(GObject *clipboard, GAsyncResult *result, gpointer data) {
    StudioWindow *window = data;
    char *text = gdk_clipboard_read_text_finish(GDK_CLIPBOARD(clipboard), result, NULL);
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(window), "paste-part");
    if (text != NULL && window->document != NULL && g_action_get_enabled(action)) {
        paste(window, text);
    }
    g_free(text);
    g_object_unref(window);
}

static void do_paste(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    gdk_clipboard_read_text_async(gtk_widget_get_clipboard(data), NULL, on_clipboard,
                                  g_object_ref(data));
}

void studio_window_add_preset_actions(StudioWindow *window) {
    static const GActionEntry entries[] = {
        {.name = "save-preset", .activate = do_save},
        {.name = "save-preset-as", .activate = do_save_as, .parameter_type = "s"},
        {.name = "rename-preset", .activate = do_rename, .parameter_type = "s"},
        {.name = "remove-preset", .activate = do_remove, .parameter_type = "s"},
        {.name = "copy-part", .activate = do_copy},
        {.name = "paste-part", .activate = do_paste},
        {.name = "insert-preset", .activate = do_insert},
        {.name = "insert-preset-on", .activate = do_insert_on, .parameter_type = "s"},
        {.name = "insert-preset-named", .activate = do_insert_named, .parameter_type = "s"},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), window);
}
