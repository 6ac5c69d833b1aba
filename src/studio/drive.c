#include "studio/drive.h"

#include "studio/picture.h"
#include "studio/window_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WAIT_MILLISECONDS = 15, SETTLE = 4, HEARD_FRAMES = 3 };

typedef struct Drive {
    StudioWindow *window;
    GIOChannel *input;
    int settled; // checks in a row that found nothing to wait for
    int frames;  // still to be drawn by orbit or hear
    gint64 began;
} Drive;

static void answer(const char *format, ...) G_GNUC_PRINTF(1, 2);

static void answer(const char *format, ...) {
    va_list list;
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    printf("\n");
    fflush(stdout);
}

static gboolean on_line(GIOChannel *channel, GIOCondition condition, gpointer data);

static void listen(Drive *drive) {
    g_io_add_watch(drive->input, G_IO_IN | G_IO_HUP, on_line, drive);
}

// ---- commands ----------------------------------------------------------------------------------

static void do_action(Drive *drive, char *const *words, const char *detailed) {
    (void)words;
    StudioWindow *window = drive->window;
    char *name;
    GVariant *target;
    GError *error = NULL;
    if (!g_action_parse_detailed_name(detailed, &name, &target, &error)) {
        answer("error %s", error->message);
        g_error_free(error);
        return;
    }
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(window), name);
    if (action == NULL || !g_action_get_enabled(action)) {
        answer("error %s is %s", name, action == NULL ? "no action" : "not possible now");
    } else if (g_action_get_state_type(action) != NULL && target != NULL) {
        g_action_change_state(action, target);
        answer("ok");
    } else {
        g_action_activate(action, target);
        answer("ok");
    }
    g_clear_pointer(&target, g_variant_unref);
    g_free(name);
}

static GtkWidget *find_widget(GtkWidget *within, const char *name) {
    if (strcmp(gtk_widget_get_name(within), name) == 0 && gtk_widget_get_mapped(within)) {
        return within;
    }
    GtkWidget *found = NULL;
    for (GtkWidget *child = gtk_widget_get_first_child(within); child != NULL && found == NULL;
         child = gtk_widget_get_next_sibling(child)) {
        found = find_widget(child, name);
    }
    return found;
}

// Where "at:x,y,z" of the scene is in the viewport.
static bool where_in_picture(StudioViewport *viewport, const char *name, graphene_rect_t *box) {
    double at[3], x, y;
    if (sscanf(name, "at:%lf,%lf,%lf", &at[0], &at[1], &at[2]) != 3 ||
        !studio_camera_project(studio_viewport_camera(viewport), studio_viewport_aspect(viewport),
                               at, &x, &y)) {
        return false;
    }
    double width = gtk_widget_get_width(GTK_WIDGET(viewport));
    double height = gtk_widget_get_height(GTK_WIDGET(viewport));
    *box =
        GRAPHENE_RECT_INIT((float)(0.5 * (1 + x) * width), (float)(0.5 * (1 - y) * height), 0, 0);
    return true;
}

static void where(Drive *drive, char *const *words, const char *name) {
    (void)words;
    StudioWindow *window = drive->window;
    graphene_rect_t box;
    GtkWidget *from = GTK_WIDGET(window->graph);
    bool is_there = studio_graph_panel_where(window->graph, name, &box);
    if (!is_there && where_in_picture(window->viewport, name, &box)) {
        is_there = true;
        from = GTK_WIDGET(window->viewport);
    }
    if (!is_there) {
        from = strcmp(name, "window") == 0 ? GTK_WIDGET(window)
                                           : find_widget(GTK_WIDGET(window), name);
        is_there = from != NULL;
        if (is_there) {
            box = GRAPHENE_RECT_INIT(0, 0, (float)gtk_widget_get_width(from),
                                     (float)gtk_widget_get_height(from));
        }
    }
    double x, y, shift_x, shift_y;
    GtkNative *native = from == NULL ? NULL : gtk_widget_get_native(from);
    if (is_there && native != NULL &&
        gtk_widget_translate_coordinates(from, GTK_WIDGET(native), box.origin.x, box.origin.y, &x,
                                         &y)) {
        gtk_native_get_surface_transform(native, &shift_x, &shift_y);
        if (GTK_IS_POPOVER(native)) { // a surface of its own
            GdkPopup *popup = GDK_POPUP(gtk_native_get_surface(native));
            shift_x += gdk_popup_get_position_x(popup);
            shift_y += gdk_popup_get_position_y(popup);
        }
        answer("%.0f %.0f %.0f %.0f", x + shift_x, y + shift_y, (double)box.size.width,
               (double)box.size.height);
    } else {
        answer("error nothing is called %s", name);
    }
}

// How wide and high a part must be at least.
static void needs(Drive *drive, char *const *words, const char *name) {
    (void)words;
    GtkWidget *window = GTK_WIDGET(drive->window);
    GtkWidget *part = strcmp(name, "window") == 0 ? window : find_widget(window, name);
    int width = 0, height = 0;
    if (part == NULL) {
        answer("error nothing is called %s", name);
        return;
    }
    gtk_widget_measure(part, GTK_ORIENTATION_HORIZONTAL, -1, &width, NULL, NULL, NULL);
    gtk_widget_measure(part, GTK_ORIENTATION_VERTICAL, -1, &height, NULL, NULL, NULL);
    answer("%d %d", width, height);
}

// Seconds from the last request to a picture; 0: there was none.
static double seen_after(const StudioWindow *window, gint64 seen) {
    return seen == 0 ? 0 : (double)(seen - window->asked_time) * 1e-6;
}

static void state(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    StudioWindow *window = drive->window;
    StudioDocument *document = window->document;
    StudioPace pace = studio_viewport_pace(window->viewport);
    StudioAmount amount = studio_viewport_amount(window->viewport);
    if (document == NULL) {
        answer("{}");
        return;
    }
    const char *selected = window->selected;
    answer("{\"digest\": \"%016" G_GINT64_MODIFIER "x\", \"steps\": %u, \"saved\": %s, "
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

static void sketch(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    char *text = studio_sketch_panel_state(drive->window->sketch);
    answer("%s", text);
    g_free(text);
}

static void pointed(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    char *text = studio_string_panel_state(drive->window->string);
    answer("%s", text == NULL ? "nothing" : text);
    g_free(text);
}

static void said(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    const char *text = studio_messages_said(drive->window->over_picture);
    text = text == NULL ? studio_messages_said(drive->window->over_all) : text;
    answer("%s", text == NULL ? "nothing" : text);
}

static gboolean on_wait(gpointer data) {
    Drive *drive = data;
    drive->settled = studio_window_is_idle(drive->window) ? drive->settled + 1 : 0;
    if (drive->settled < SETTLE) {
        return G_SOURCE_CONTINUE;
    }
    answer("ok");
    listen(drive);
    return G_SOURCE_REMOVE;
}

static void size(Drive *drive, char *const *words, const char *rest) {
    (void)rest;
    gtk_window_set_default_size(GTK_WINDOW(drive->window), atoi(words[1]), atoi(words[2]));
    answer("ok");
}

// How much larger letters are than usual.
static void letters(Drive *drive, char *const *words, const char *rest) {
    (void)rest;
    GtkSettings *settings = gtk_widget_get_settings(GTK_WIDGET(drive->window));
    g_object_set(settings, "gtk-xft-dpi", (int)(96 * 1024 * g_ascii_strtod(words[1], NULL)), NULL);
    answer("ok");
}

static void turn(Drive *drive, char *const *words, const char *rest) {
    (void)rest;
    double azimuth = g_ascii_strtod(words[1], NULL) * G_PI / 180;
    double elevation = g_ascii_strtod(words[2], NULL) * G_PI / 180;
    studio_viewport_move(drive->window->viewport, azimuth, elevation,
                         g_ascii_strtod(words[3], NULL));
    answer("ok");
}

static void open_file(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    StudioDocument *document;
    bool is_open = studio_document_open(rest, NULL, &document) == FR_OK;
    if (is_open) {
        studio_window_take(drive->window, document);
    }
    answer("%s", is_open ? "ok" : "error it cannot be opened");
}

static void picture(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    answer("%s", studio_picture_save(GTK_WIDGET(drive->window), rest) ? "ok" : "error no picture");
}

// At the coordinates of `where`: those of the window's surface.
static void colour(Drive *drive, char *const *words, const char *rest) {
    (void)rest;
    double shift_x, shift_y;
    uint8_t rgb[3];
    gtk_native_get_surface_transform(GTK_NATIVE(drive->window), &shift_x, &shift_y);
    if (studio_picture_colour(GTK_WIDGET(drive->window), atoi(words[1]) - (int)shift_x,
                              atoi(words[2]) - (int)shift_y, rgb)) {
        answer("%d %d %d", rgb[0], rgb[1], rgb[2]);
    } else {
        answer("error that is outside");
    }
}

static void write_text(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    size_t size;
    const char *text = fr_source_text(studio_document_source(drive->window->document), &size);
    bool is_written = g_file_set_contents(rest, text, (gssize)size, NULL);
    answer("%s", is_written ? "ok" : "error it cannot be written");
}

// The dialog above the window; NULL.
static GtkWindow *find_dialog(StudioWindow *window) {
    GtkWindow *found = NULL;
    GList *all = gtk_window_list_toplevels();
    for (GList *at = all; at != NULL; at = at->next) {
        if (gtk_window_get_transient_for(at->data) == GTK_WINDOW(window)) {
            found = at->data;
        }
    }
    g_list_free(all);
    return found;
}

static void picture_of_dialog(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    GtkWindow *dialog = find_dialog(drive->window);
    bool is_saved = dialog != NULL && studio_picture_save(GTK_WIDGET(dialog), rest);
    answer("%s", is_saved ? "ok" : "error no picture");
}

static void close_dialog(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    GtkWindow *dialog = find_dialog(drive->window);
    if (dialog != NULL) {
        gtk_window_close(dialog);
    }
    answer("%s", dialog != NULL ? "ok" : "error there is no dialog");
}

// A widget as a word: which one it is, its type, and its name or that of what it is in.
static void name_widget(GString *words, GtkWidget *widget) {
    GtkWidget *named = widget;
    while (named != NULL && strcmp(gtk_widget_get_name(named), G_OBJECT_TYPE_NAME(named)) == 0) {
        named = gtk_widget_get_parent(named);
    }
    char *name = g_strdelimit(g_strdup(named == NULL ? "" : gtk_widget_get_name(named)), " ", '-');
    g_string_append_printf(words, "%s%p:%s:%s", words->len > 0 ? " " : "", (void *)widget,
                           G_OBJECT_TYPE_NAME(widget), name);
    g_free(name);
}

static void list_focusable(GString *words, GtkWidget *within) {
    if (!gtk_widget_get_mapped(within) || !gtk_widget_is_sensitive(within) ||
        !gtk_widget_get_can_focus(within)) {
        return;
    }
    if (gtk_widget_get_focusable(within)) {
        name_widget(words, within);
    }
    for (GtkWidget *child = gtk_widget_get_first_child(within); child != NULL;
         child = gtk_widget_get_next_sibling(child)) {
        list_focusable(words, child);
    }
}

// What has the keyboard, or with "all", what may have it.
static void focus(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    GtkWidget *has = gtk_window_get_focus(GTK_WINDOW(drive->window));
    GString *text = g_string_new(NULL);
    if (strcmp(rest, "all") == 0) {
        list_focusable(text, GTK_WIDGET(drive->window));
    } else if (has != NULL) {
        name_widget(text, has);
    }
    answer("%s", text->len == 0 ? "nothing" : text->str);
    g_string_free(text, TRUE);
}

static void keep(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    answer("%s", studio_recovery_update(drive->window->recovery) ? "ok" : "error the disk failed");
}

static void restore(Drive *drive, char *const *words, const char *rest) {
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
    answer("%s", document != NULL ? "ok" : "error nothing was left");
    g_ptr_array_unref(list);
    g_free(folder);
}

static gboolean on_orbit(GtkWidget *viewport, GdkFrameClock *clock, gpointer data) {
    (void)clock;
    Drive *drive = data;
    if (drive->frames-- > 0) {
        studio_viewport_move(STUDIO_VIEWPORT(viewport), 0.03, 0, 1);
        return G_SOURCE_CONTINUE;
    }
    answer("%.6f", (double)(g_get_monotonic_time() - drive->began) * 1e-6);
    listen(drive);
    return G_SOURCE_REMOVE;
}

static void orbit(Drive *drive, char *const *words, const char *rest) {
    (void)rest;
    drive->frames = atoi(words[1]);
    drive->began = g_get_monotonic_time();
    gtk_widget_add_tick_callback(GTK_WIDGET(drive->window->viewport), on_orbit, drive, NULL);
}

static gboolean on_heard(GtkWidget *window, GdkFrameClock *clock, gpointer data) {
    (void)window;
    (void)clock;
    Drive *drive = data;
    if (drive->frames-- > 0) {
        return G_SOURCE_CONTINUE;
    }
    answer("ok");
    listen(drive);
    return G_SOURCE_REMOVE;
}

// Answers when all that pointer and keys have done so far was handled. Motion waits for the next
// picture, and what it leads to may wait for another.
static void hear(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    drive->frames = HEARD_FRAMES;
    gdk_display_sync(gtk_widget_get_display(GTK_WIDGET(drive->window)));
    gtk_widget_add_tick_callback(GTK_WIDGET(drive->window), on_heard, drive, NULL);
}

static void wait_for_rest(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    drive->settled = 0;
    g_timeout_add(WAIT_MILLISECONDS, on_wait, drive);
}

static void quit(Drive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    answer("ok");
    drive->window->is_closing = true;
    gtk_window_close(GTK_WINDOW(drive->window));
    g_io_channel_unref(drive->input);
    g_free(drive);
}

static const struct {
    const char *name;
    void (*obey)(Drive *drive, char *const *words, const char *rest);
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
    {"where", where, 2, false},
    {"needs", needs, 2, false},
    {"write", write_text, 2, false},
    {"picture", picture, 2, false},
    {"colour", colour, 3, false},
    {"picture-of-dialog", picture_of_dialog, 2, false},
    {"close-dialog", close_dialog, 1, false},
    {"state", state, 1, false},
    {"sketch", sketch, 1, false},
    {"pointed", pointed, 1, false},
    {"said", said, 1, false},
    {"focus", focus, 1, false},
    {"keep", keep, 1, false},
    {"restore", restore, 1, false},
    {"quit", quit, 1, true},
};

// False if the next line has to wait.
static bool obey(Drive *drive, const char *line) {
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
        answer("error '%s' is no command", line);
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
    Drive *drive = g_new0(Drive, 1);
    drive->window = window;
    drive->input = g_io_channel_unix_new(STDIN_FILENO);
    listen(drive);
}
