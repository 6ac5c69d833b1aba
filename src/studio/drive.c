#include "studio/drive.h"

#include "studio/picture.h"
#include "studio/window_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WAIT_MILLISECONDS = 15, SETTLE = 4 };

typedef struct Drive {
    StudioWindow *window;
    GIOChannel *input;
    int settled; // checks in a row that found nothing to wait for
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

static void do_action(StudioWindow *window, const char *detailed) {
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

static void where(StudioWindow *window, const char *name) {
    graphene_rect_t box;
    GtkWidget *from = GTK_WIDGET(window->graph);
    bool is_there = studio_graph_panel_where(window->graph, name, &box);
    if (!is_there) {
        from = find_widget(GTK_WIDGET(window), name);
        is_there = from != NULL;
        if (is_there) {
            box = GRAPHENE_RECT_INIT(0, 0, (float)gtk_widget_get_width(from),
                                     (float)gtk_widget_get_height(from));
        }
    }
    double x, y, shift_x, shift_y;
    if (is_there && gtk_widget_translate_coordinates(from, GTK_WIDGET(window), box.origin.x,
                                                     box.origin.y, &x, &y)) {
        gtk_native_get_surface_transform(GTK_NATIVE(window), &shift_x, &shift_y);
        answer("%.0f %.0f %.0f %.0f", x + shift_x, y + shift_y, (double)box.size.width,
               (double)box.size.height);
    } else {
        answer("error nothing is called %s", name);
    }
}

static void state(StudioWindow *window) {
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
           "%" G_GUINT64_FORMAT "}",
           (guint64)studio_document_digest(document), studio_document_steps(document),
           studio_document_is_saved(document) ? "true" : "false",
           window->diags == NULL ? 0 : fr_diags_error_count(window->diags),
           selected == NULL ? "" : selected, amount.triangles, amount.leaves, window->times.read,
           window->times.build, window->times.view, amount.uploaded_seconds, pace.coarse_seconds,
           pace.fine_seconds, pace.coarse_triangles);
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

static void turn(StudioWindow *window, char *const *words) {
    double azimuth = g_ascii_strtod(words[1], NULL) * G_PI / 180;
    double elevation = g_ascii_strtod(words[2], NULL) * G_PI / 180;
    studio_viewport_move(window->viewport, azimuth, elevation, g_ascii_strtod(words[3], NULL));
    answer("ok");
}

// False if the next line has to wait.
static bool obey(Drive *drive, char *line) {
    StudioWindow *window = drive->window;
    char **words = g_strsplit(line, " ", 4);
    guint count = g_strv_length(words);
    const char *rest = strchr(line, ' ') == NULL ? "" : strchr(line, ' ') + 1;
    bool goes_on = true;
    if (count == 0 || strcmp(words[0], "wait") == 0) {
        drive->settled = 0;
        g_timeout_add(WAIT_MILLISECONDS, on_wait, drive);
        goes_on = false;
    } else if (strcmp(words[0], "do") == 0) {
        do_action(window, rest);
    } else if (strcmp(words[0], "open") == 0) {
        window->is_closing = true;
        FrDiags *diags = fr_diags_new();
        StudioDocument *document;
        bool is_open = studio_document_open(rest, diags, &document) == FR_OK;
        if (is_open) {
            studio_window_take(window, document);
        }
        answer("%s", is_open ? "ok" : "error it cannot be opened");
        fr_diags_free(diags);
    } else if (strcmp(words[0], "size") == 0 && count == 3) {
        gtk_window_set_default_size(GTK_WINDOW(window), atoi(words[1]), atoi(words[2]));
        answer("ok");
    } else if (strcmp(words[0], "turn") == 0 && count == 4) {
        turn(window, words);
    } else if (strcmp(words[0], "where") == 0) {
        where(window, rest);
    } else if (strcmp(words[0], "picture") == 0) {
        answer("%s", studio_picture_save(GTK_WIDGET(window), rest) ? "ok" : "error no picture");
    } else if (strcmp(words[0], "state") == 0) {
        state(window);
    } else if (strcmp(words[0], "quit") == 0) {
        answer("ok");
        window->is_closing = true;
        gtk_window_close(GTK_WINDOW(window));
        g_io_channel_unref(drive->input);
        g_free(drive);
        goes_on = false;
    } else {
        answer("error %s is no command", words[0]);
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
