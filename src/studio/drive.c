#include "studio/drive_private.h"

#include "studio/picture.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WAIT_MILLISECONDS = 15, SETTLE = 4, HEARD_FRAMES = 3 };

void studio_answer(const char *format, ...) {
    va_list list;
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    printf("\n");
    fflush(stdout);
}

static gboolean on_line(GIOChannel *channel, GIOCondition condition, gpointer data);

static void listen(StudioDrive *drive) {
    g_io_add_watch(drive->input, G_IO_IN | G_IO_HUP, on_line, drive);
}

// ---- commands ----------------------------------------------------------------------------------

static void do_action(StudioDrive *drive, char *const *words, const char *detailed) {
    (void)words;
    StudioWindow *window = drive->window;
    char *name;
    GVariant *target;
    GError *error = NULL;
    if (!g_action_parse_detailed_name(detailed, &name, &target, &error)) {
        studio_answer("error %s", error->message);
        g_error_free(error);
        return;
    }
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(window), name);
    if (action == NULL || !g_action_get_enabled(action)) {
        studio_answer("error %s is %s", name, action == NULL ? "no action" : "not possible now");
    } else if (g_action_get_state_type(action) != NULL && target != NULL) {
        g_action_change_state(action, target);
        studio_answer("ok");
    } else {
        g_action_activate(action, target);
        studio_answer("ok");
    }
    g_clear_pointer(&target, g_variant_unref);
    g_free(name);
}

// Seconds from the last request to a picture; 0: there was none.
static double seen_after(const StudioWindow *window, gint64 seen) {
    return seen == 0 ? 0 : (double)(seen - window->asked_time) * 1e-6;
}

static void state(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    StudioWindow *window = drive->window;
    StudioDocument *document = window->document;
    StudioPace pace = studio_viewport_pace(window->viewport);
    StudioAmount amount = studio_viewport_amount(window->viewport);
    if (document == NULL) {
        studio_answer("{}");
        return;
    }
    const char *selected = window->selected;
    studio_answer(
        "{\"digest\": \"%016" G_GINT64_MODIFIER "x\", \"steps\": %u, \"saved\": %s, "
        "\"problems\": %zu, \"selected\": \"%s\", \"triangles\": %" G_GUINT64_FORMAT
        ", \"leaves\": %" G_GUINT64_FORMAT ", \"read\": %.6f, \"build\": %.6f, \"view\": %.6f, "
        "\"upload\": %.6f, \"coarse\": %.6f, \"fine\": %.6f, \"coarse_triangles\": "
        "%" G_GUINT64_FORMAT ", \"first\": %.6f, \"whole\": %.6f}",
        (guint64)studio_document_digest(document), studio_document_steps(document),
        studio_document_is_saved(document) ? "true" : "false",
        window->diags == NULL ? 0 : fr_diags_error_count(window->diags),
        selected == NULL ? "" : selected, amount.triangles, amount.leaves, window->times.read,
        window->times.build, window->times.view, amount.uploaded_seconds, pace.coarse_seconds,
        pace.fine_seconds, pace.coarse_triangles, seen_after(window, window->first_seen),
        seen_after(window, window->whole_seen));
}

static void sketch(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    char *text = studio_sketch_panel_state(drive->window->sketch);
    studio_answer("%s", text);
    g_free(text);
}

static void pointed(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    char *text = studio_string_panel_state(drive->window->string);
    studio_answer("%s", text == NULL ? "nothing" : text);
    g_free(text);
}

static void said(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    const char *text = studio_messages_said(drive->window->over_picture);
    text = text == NULL ? studio_messages_said(drive->window->over_all) : text;
    studio_answer("%s", text == NULL ? "nothing" : text);
}

static void let_messages_stay(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    gboolean stays = strcmp(rest, "no") != 0;
    studio_messages_stay(drive->window->over_picture, stays);
    studio_messages_stay(drive->window->over_all, stays);
    studio_answer("ok");
}

static gboolean on_wait(gpointer data) {
    StudioDrive *drive = data;
    drive->settled = studio_window_is_idle(drive->window) ? drive->settled + 1 : 0;
    if (drive->settled < SETTLE) {
        return G_SOURCE_CONTINUE;
    }
    studio_answer("ok");
    listen(drive);
    return G_SOURCE_REMOVE;
}

static void size(StudioDrive *drive, char *const *words, const char *rest) {
    (void)rest;
    gtk_window_set_default_size(GTK_WINDOW(drive->window), atoi(words[1]), atoi(words[2]));
    studio_answer("ok");
}

// How much larger letters are than usual.
static void letters(StudioDrive *drive, char *const *words, const char *rest) {
    (void)rest;
    GtkSettings *settings = gtk_widget_get_settings(GTK_WIDGET(drive->window));
    g_object_set(settings, "gtk-xft-dpi", (int)(96 * 1024 * g_ascii_strtod(words[1], NULL)), NULL);
    studio_answer("ok");
}

static void turn(StudioDrive *drive, char *const *words, const char *rest) {
    (void)rest;
    double azimuth = g_ascii_strtod(words[1], NULL) * G_PI / 180;
    double elevation = g_ascii_strtod(words[2], NULL) * G_PI / 180;
    studio_viewport_move(drive->window->viewport, azimuth, elevation,
                         g_ascii_strtod(words[3], NULL));
    studio_answer("ok");
}

static void open_file(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    StudioDocument *document;
    bool is_open = studio_document_open(rest, NULL, &document) == FR_OK;
    if (is_open) {
        studio_window_take(drive->window, document);
    }
    studio_answer("%s", is_open ? "ok" : "error it cannot be opened");
}

static void picture(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    studio_answer("%s",
                  studio_picture_save(GTK_WIDGET(drive->window), rest) ? "ok" : "error no picture");
}

// At the coordinates of `where`: those of the window's surface.
static void colour(StudioDrive *drive, char *const *words, const char *rest) {
    (void)rest;
    double shift_x, shift_y;
    uint8_t rgb[3];
    gtk_native_get_surface_transform(GTK_NATIVE(drive->window), &shift_x, &shift_y);
    if (studio_picture_colour(GTK_WIDGET(drive->window), atoi(words[1]) - (int)shift_x,
                              atoi(words[2]) - (int)shift_y, rgb)) {
        studio_answer("%d %d %d", rgb[0], rgb[1], rgb[2]);
    } else {
        studio_answer("error that is outside");
    }
}

static void write_text(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    size_t size;
    const char *text = fr_source_text(studio_document_source(drive->window->document), &size);
    bool is_written = g_file_set_contents(rest, text, (gssize)size, NULL);
    studio_answer("%s", is_written ? "ok" : "error it cannot be written");
}

static void keep(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    studio_answer("%s",
                  studio_recovery_update(drive->window->recovery) ? "ok" : "error the disk failed");
}

static void restore(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    char *folder = studio_recovery_folder();
    GPtrArray *list = studio_recovery_list(folder);
    StudioDocument *document =
        list->len == 0 ? NULL : studio_recovery_restore(g_ptr_array_index(list, 0), NULL);
    if (document != NULL) {
        studio_window_take(drive->window, document);
        studio_recovery_discard(g_ptr_array_index(list, 0));
    }
    studio_answer("%s", document != NULL ? "ok" : "error nothing was left");
    g_ptr_array_unref(list);
    g_free(folder);
}

static gboolean on_orbit(GtkWidget *viewport, GdkFrameClock *clock, gpointer data) {
    (void)clock;
    StudioDrive *drive = data;
    if (drive->frames-- > 0) {
        studio_viewport_move(STUDIO_VIEWPORT(viewport), 0.03, 0, 1);
        return G_SOURCE_CONTINUE;
    }
    studio_answer("%.6f", (double)(g_get_monotonic_time() - drive->began) * 1e-6);
    listen(drive);
    return G_SOURCE_REMOVE;
}

static void orbit(StudioDrive *drive, char *const *words, const char *rest) {
    (void)rest;
    drive->frames = atoi(words[1]);
    drive->began = g_get_monotonic_time();
    gtk_widget_add_tick_callback(GTK_WIDGET(drive->window->viewport), on_orbit, drive, NULL);
}

static gboolean on_heard(GtkWidget *window, GdkFrameClock *clock, gpointer data) {
    (void)window;
    (void)clock;
    StudioDrive *drive = data;
    return drive->frames-- > 0 ? G_SOURCE_CONTINUE : G_SOURCE_REMOVE;
}

// So many pictures were drawn, or the window went meanwhile.
static void on_hearing_done(gpointer data) {
    studio_answer("ok");
    listen(data);
}

// Answers when all that pointer and keys have done so far was handled. Motion waits for the next
// picture, and what it leads to may wait for another.
static void hear(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    drive->frames = HEARD_FRAMES;
    gdk_display_sync(gtk_widget_get_display(GTK_WIDGET(drive->window)));
    gtk_widget_add_tick_callback(GTK_WIDGET(drive->window), on_heard, drive, on_hearing_done);
}

static void wait_for_rest(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    drive->settled = 0;
    g_timeout_add(WAIT_MILLISECONDS, on_wait, drive);
}

static void quit(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    studio_answer("ok");
    StudioWindow *window = drive->window;
    g_clear_weak_pointer(&drive->window);
    window->is_closing = true;
    gtk_window_close(GTK_WINDOW(window));
    g_io_channel_unref(drive->input);
    g_free(drive);
}

static const struct {
    const char *name;
    StudioOrder *obey;
    guint words;  // at least
    bool is_last; // another line is read only when it has been done, or never
} commands[] = {
    {"do", do_action, 2, false},
    {"open", open_file, 2, false},
    {"wait", wait_for_rest, 1, true},
    {"hear", hear, 1, true},
    {"size", size, 3, false},
    {"letters", letters, 2, false},
    {"turn", turn, 4, false},
    {"orbit", orbit, 2, true},
    {"where", studio_drive_where, 2, false},
    {"needs", studio_drive_needs, 2, false},
    {"write", write_text, 2, false},
    {"picture", picture, 2, false},
    {"colour", colour, 3, false},
    {"picture-of-dialog", studio_drive_picture_of_dialog, 2, false},
    {"dialog", studio_drive_dialog, 1, false},
    {"text", studio_drive_text, 2, false},
    {"windows", studio_drive_windows, 1, false},
    {"window", studio_drive_window, 2, false},
    {"pen", studio_drive_pen, 2, false},
    {"close-dialog", studio_drive_close_dialog, 1, false},
    {"state", state, 1, false},
    {"sketch", sketch, 1, false},
    {"pointed", pointed, 1, false},
    {"said", said, 1, false},
    {"stay", let_messages_stay, 1, false},
    {"focus", studio_drive_focus, 1, false},
    {"keep", keep, 1, false},
    {"restore", restore, 1, false},
    {"quit", quit, 1, true},
};

// False if the next line has to wait.
static bool obey(StudioDrive *drive, const char *line) {
    if (drive->window == NULL) { // it was closed: goes on with another one
        studio_drive_take(drive, NULL);
    }
    char **words = g_strsplit(line, " ", 4);
    const char *rest = strchr(line, ' ') == NULL ? "" : strchr(line, ' ') + 1;
    bool goes_on = true, is_known = false;
    for (size_t i = 0; i < G_N_ELEMENTS(commands) && !is_known; i++) {
        is_known = words[0] != NULL && strcmp(words[0], commands[i].name) == 0 &&
                   g_strv_length(words) >= commands[i].words;
        if (is_known) {
            goes_on = !commands[i].is_last;
            commands[i].obey(drive, words, rest);
        }
    }
    if (!is_known) {
        studio_answer("error '%s' is no command", line);
    }
    g_strfreev(words);
    return goes_on;
}

static gboolean on_line(GIOChannel *channel, GIOCondition condition, gpointer data) {
    (void)condition;
    char *line = NULL;
    gsize end;
    if (g_io_channel_read_line(channel, &line, NULL, &end, NULL) != G_IO_STATUS_NORMAL) {
        return G_SOURCE_REMOVE;
    }
    line[end] = '\0';
    bool goes_on = obey(data, line);
    g_free(line);
    return goes_on;
}

void studio_drive(StudioWindow *window) {
    StudioDrive *drive = g_new0(StudioDrive, 1);
    studio_drive_take(drive, window);
    drive->input = g_io_channel_unix_new(STDIN_FILENO);
    listen(drive);
}
