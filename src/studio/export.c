/// The dialog that writes a model for another program.
#include "studio/accessible.h"
#include "studio/model/profile.h"
#include "studio/widgets.h"
#include "studio/window_private.h"

// An export that runs: it outlives its dialog.
typedef struct Job {
    StudioWindow *window; // a reference
    GtkWidget *dialog;    // weak
    GtkWidget *bar, *write, *hosts, *lod, *place;
    char *path, *name; // name: of the file that is proposed, without its ending
    StudioExport how;
    StudioWhich which;
    StudioCopy *copy; // of what stands
    FrProgress *progress;
    FrDiags *diags;
    StudioExported exported;
    gint fraction; // atomic, in thousandths
    guint timer;
} Job;

static const StudioProfile *profile_of(const Job *job) {
    size_t count;
    const StudioProfile *profiles = studio_profiles(&count);
    return &profiles[adw_combo_row_get_selected(ADW_COMBO_ROW(job->hosts))];
}

static void report(void *user, const char *stage, double fraction) {
    (void)stage;
    g_atomic_int_set(&((Job *)user)->fraction, (gint)(1000 * fraction));
}

static gboolean on_timer(gpointer data) {
    Job *job = data;
    if (job->dialog != NULL) {
        gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(job->bar),
                                      g_atomic_int_get(&job->fraction) / 1000.0);
    }
    return G_SOURCE_CONTINUE;
}

static void job_free(Job *job) {
    if (job->dialog != NULL) {
        g_object_remove_weak_pointer(G_OBJECT(job->dialog), (gpointer *)&job->dialog);
    }
    g_clear_handle_id(&job->timer, g_source_remove);
    studio_copy_free(job->copy);
    fr_progress_free(job->progress);
    fr_diags_free(job->diags);
    g_free(job->path);
    g_free(job->name);
    g_object_unref(job->window);
    g_free(job);
}

static void work(GTask *task, gpointer source, gpointer data, GCancellable *cancellable) {
    (void)source;
    (void)cancellable;
    Job *job = data;
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(0);
    context.progress = job->progress;
    context.diags = job->diags;
    job->exported = studio_export(job->copy, job->path, &job->how, &context);
    fr_pool_free(context.pool);
    g_task_return_boolean(task, TRUE);
}

static void on_done(GObject *source, GAsyncResult *result, gpointer data) {
    (void)source;
    (void)result;
    Job *job = data;
    job->window->exports--;
    if (job->exported.status == FR_OK) {
        char *size = g_format_size(job->exported.stats.bytes);
        studio_window_say(job->window, "Wrote %s, %s%s", job->path, size,
                          job->exported.is_behind ? ": the last plants that could be made" : "");
        g_free(size);
    } else if (job->exported.status == FR_CANCELLED) {
        studio_window_say(job->window, "Nothing was written");
    } else {
        studio_window_say(job->window, "%s",
                          fr_diags_count(job->diags) > 0 ? fr_diags_get(job->diags, 0)->text
                                                         : "The model could not be written");
    }
    GtkWidget *dialog = job->dialog;
    job_free(job);
    if (dialog != NULL) {
        gtk_window_destroy(GTK_WINDOW(dialog));
    }
}

static void start(Job *job) {
    studio_window_request(job->window); // drawing branches does not
    job->copy = studio_builder_copy(job->window->builder, &job->which);
    job->window->exports++;
    job->timer = g_timeout_add(100, on_timer, job);
    GTask *task = g_task_new(NULL, NULL, on_done, job);
    g_task_set_task_data(task, job, NULL);
    g_task_run_in_thread(task, work);
    g_object_unref(task);
}

static void begin(Job *job, const char *path) {
    const StudioProfile *profile = profile_of(job);
    job->path = g_str_has_suffix(path, profile->extension)
                    ? g_strdup(path)
                    : g_strconcat(path, profile->extension, NULL);
    job->how.leaves = profile->leaves;
    job->how.lod = (int)gtk_spin_button_get_value(GTK_SPIN_BUTTON(job->lod));
    job->which.in_place = job->place != NULL && gtk_switch_get_active(GTK_SWITCH(job->place));
    gtk_widget_set_sensitive(job->write, FALSE);
    gtk_widget_set_visible(job->bar, TRUE);
    start(job);
}

static void on_chosen(GtkNativeDialog *chooser, int response, Job *job) {
    char *path = studio_chosen_path(chooser, response);
    if (path != NULL && job->dialog != NULL) {
        begin(job, path);
    }
    g_free(path);
    g_object_unref(chooser);
}

static void on_write(GtkButton *button, Job *job) {
    (void)button;
    const StudioProfile *profile = profile_of(job);
    GtkFileChooserNative *chooser =
        gtk_file_chooser_native_new("Export the Model", GTK_WINDOW(job->dialog),
                                    GTK_FILE_CHOOSER_ACTION_SAVE, "_Export", "_Cancel");
    char *whole = g_strconcat(job->name, profile->extension, NULL);
    gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), whole);
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(chooser), TRUE);
    g_signal_connect(chooser, "response", G_CALLBACK(on_chosen), job);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(chooser));
    g_free(whole);
}

static void on_host(GObject *row, GParamSpec *spec, Job *job) {
    (void)spec;
    const StudioProfile *profile = profile_of(job);
    adw_action_row_set_subtitle(ADW_ACTION_ROW(row), profile->note);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(job->lod), profile->lod);
}

static gboolean on_dialog_close(GtkWindow *dialog, Job *job) {
    (void)dialog;
    if (job->timer != 0) {
        fr_progress_cancel(job->progress);
        return TRUE; // it goes when the work has stopped
    }
    g_object_remove_weak_pointer(G_OBJECT(job->dialog), (gpointer *)&job->dialog);
    job->dialog = NULL;
    job_free(job);
    return FALSE;
}

static GtkWidget *make_hosts(Job *job) {
    size_t count;
    const StudioProfile *profiles = studio_profiles(&count);
    GtkStringList *names = gtk_string_list_new(NULL);
    for (size_t i = 0; i < count; i++) {
        gtk_string_list_append(names, profiles[i].name);
    }
    job->hosts = adw_combo_row_new();
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(job->hosts), "For");
    adw_combo_row_set_model(ADW_COMBO_ROW(job->hosts), G_LIST_MODEL(names));
    adw_action_row_set_subtitle(ADW_ACTION_ROW(job->hosts), profiles[0].note);
    g_object_unref(names);
    g_signal_connect(job->hosts, "notify::selected", G_CALLBACK(on_host), job);
    return job->hosts;
}

static GtkWidget *make_level(Job *job) {
    GtkWidget *row = adw_action_row_new();
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), "Level of detail");
    adw_action_row_set_subtitle(ADW_ACTION_ROW(row), "0 is finest; each has some 40 %");
    job->lod = gtk_spin_button_new_with_range(0, 8, 1);
    gtk_widget_set_valign(job->lod, GTK_ALIGN_CENTER);
    studio_name(job->lod, "Level of detail");
    adw_action_row_add_suffix(ADW_ACTION_ROW(row), job->lod);
    return row;
}

static GtkWidget *make_place(Job *job) {
    GtkWidget *row = adw_action_row_new();
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), "Where it stands");
    adw_action_row_set_subtitle(ADW_ACTION_ROW(row), "Else its foot is at the origin");
    job->place = gtk_switch_new();
    gtk_widget_set_valign(job->place, GTK_ALIGN_CENTER);
    gtk_widget_set_name(job->place, "export-in-place");
    studio_name(job->place, "Where it stands");
    adw_action_row_add_suffix(ADW_ACTION_ROW(row), job->place);
    adw_action_row_set_activatable_widget(ADW_ACTION_ROW(row), job->place);
    return row;
}

static char *name_of(StudioWindow *window, const StudioOne *one) {
    char *name = g_strdup(studio_document_name(window->document));
    if (g_str_has_suffix(name, ".frond")) {
        name[strlen(name) - strlen(".frond")] = '\0';
    }
    char *whole = one == NULL ? g_strdup(name) : g_strdup_printf("%s-%s", name, one->name);
    g_free(name);
    return whole;
}

static Job *job_new(StudioWindow *window, const StudioOne *one) {
    Job *job = g_new0(Job, 1);
    job->window = g_object_ref(window);
    job->name = name_of(window, one);
    job->which = (StudioWhich){.is_one = one != NULL,
                               .origin = one == NULL ? 0 : one->origin,
                               .number = one == NULL ? 0 : one->number};
    job->progress = fr_progress_new(report, job);
    job->diags = fr_diags_new();
    return job;
}

void studio_window_export_to(StudioWindow *window, const StudioOne *one, const char *path) {
    Job *job = job_new(window, one);
    job->path = g_strdup(path);
    start(job);
}

void studio_window_export(StudioWindow *window, const StudioOne *one) {
    Job *job = job_new(window, one);
    job->dialog = adw_window_new();
    g_object_add_weak_pointer(G_OBJECT(job->dialog), (gpointer *)&job->dialog);
    GtkWidget *group = adw_preferences_group_new();
    adw_preferences_group_set_description(
        ADW_PREFERENCES_GROUP(group),
        one == NULL ? "Writes the plants as they are now, saved or not."
                    : "Writes this plant alone, as it has grown among the others.");
    adw_preferences_group_add(ADW_PREFERENCES_GROUP(group), make_hosts(job));
    adw_preferences_group_add(ADW_PREFERENCES_GROUP(group), make_level(job));
    if (one != NULL) {
        adw_preferences_group_add(ADW_PREFERENCES_GROUP(group), make_place(job));
    }
    job->bar = gtk_progress_bar_new();
    gtk_widget_set_visible(job->bar, FALSE);
    job->write = gtk_button_new_with_label("Write…");
    gtk_widget_add_css_class(job->write, "suggested-action");
    g_signal_connect(job->write, "clicked", G_CALLBACK(on_write), job);
    GtkWidget *header = adw_header_bar_new();
    adw_header_bar_pack_end(ADW_HEADER_BAR(header), job->write);
    GtkWidget *inside = gtk_box_new(GTK_ORIENTATION_VERTICAL, 18);
    gtk_widget_add_css_class(inside, "dialog-inside");
    gtk_box_append(GTK_BOX(inside), group);
    gtk_box_append(GTK_BOX(inside), job->bar);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_box_append(GTK_BOX(box), header);
    gtk_box_append(GTK_BOX(box), inside);
    adw_window_set_content(ADW_WINDOW(job->dialog), box);
    gtk_window_set_title(GTK_WINDOW(job->dialog), one == NULL ? "Export" : "Export This Plant");
    gtk_window_set_default_size(GTK_WINDOW(job->dialog), 480, -1);
    gtk_window_set_transient_for(GTK_WINDOW(job->dialog), GTK_WINDOW(window));
    gtk_window_set_modal(GTK_WINDOW(job->dialog), TRUE);
    g_signal_connect(job->dialog, "close-request", G_CALLBACK(on_dialog_close), job);
    gtk_window_present(GTK_WINDOW(job->dialog));
}
