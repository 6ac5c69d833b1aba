/// What is asked of the parts of windows and of dialogs, and what is done to them.
#include "studio/drive_private.h"
#include "studio/picture.h"
#include "studio/sketch_board.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- finding -----------------------------------------------------------------------------------

// What a button, a row, a label or an item of a menu says; NULL. Free with g_free().
static char *words_on(GtkWidget *widget) {
    static const char *const properties[] = {"heading", "title", "label", "text"};
    for (size_t i = 0; i < G_N_ELEMENTS(properties); i++) {
        GParamSpec *spec = g_object_class_find_property(G_OBJECT_GET_CLASS(widget), properties[i]);
        char *text = NULL;
        if (spec != NULL && spec->value_type == G_TYPE_STRING) {
            g_object_get(widget, properties[i], &text, NULL);
        }
        if (text != NULL && *text != '\0') {
            return text;
        }
        g_free(text);
    }
    return NULL;
}

static bool says(GtkWidget *widget, const char *words) {
    char *text = words_on(widget);
    if (text == NULL) {
        return false;
    }
    char *to = text; // without the underline of its key
    for (const char *from = text; *from != '\0'; from++) {
        if (*from != '_') {
            *to++ = *from;
        }
    }
    *to = '\0';
    bool is_it = strcmp(text, words) == 0;
    g_free(text);
    return is_it;
}

static bool is_called(GtkWidget *widget, const char *name) {
    return strcmp(gtk_widget_get_name(widget), name) == 0;
}

static GtkWidget *find(GtkWidget *within, const char *name,
                       bool (*is_it)(GtkWidget *widget, const char *name)) {
    if (!gtk_widget_get_mapped(within)) {
        return NULL;
    }
    if (is_it(within, name)) {
        return within;
    }
    GtkWidget *found = NULL;
    for (GtkWidget *child = gtk_widget_get_first_child(within); child != NULL && found == NULL;
         child = gtk_widget_get_next_sibling(child)) {
        found = find(child, name, is_it);
    }
    return found;
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

// By its name, else by what it says; in a dialog first.
static GtkWidget *find_part(StudioWindow *window, const char *name) {
    GtkWidget *const tops[] = {GTK_WIDGET(find_dialog(window)), GTK_WIDGET(window)};
    GtkWidget *found = strcmp(name, "window") == 0 ? GTK_WIDGET(window) : NULL;
    for (int i = 0; i < 2 && found == NULL; i++) {
        found = tops[i] == NULL ? NULL : find(tops[i], name, is_called);
    }
    for (int i = 0; i < 2 && found == NULL; i++) {
        found = tops[i] == NULL ? NULL : find(tops[i], name, says);
    }
    return found;
}

// ---- places ------------------------------------------------------------------------------------

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

void studio_drive_where(StudioDrive *drive, char *const *words, const char *name) {
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
        from = find_part(window, name);
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
        studio_answer("%.0f %.0f %.0f %.0f", x + shift_x, y + shift_y, (double)box.size.width,
                      (double)box.size.height);
    } else {
        studio_answer("error nothing is called %s", name);
    }
}

// How wide and high a part must be at least.
void studio_drive_needs(StudioDrive *drive, char *const *words, const char *name) {
    (void)words;
    GtkWidget *part = find_part(drive->window, name);
    int width = 0, height = 0;
    if (part == NULL) {
        studio_answer("error nothing is called %s", name);
        return;
    }
    gtk_widget_measure(part, GTK_ORIENTATION_HORIZONTAL, -1, &width, NULL, NULL, NULL);
    gtk_widget_measure(part, GTK_ORIENTATION_VERTICAL, -1, &height, NULL, NULL, NULL);
    studio_answer("%d %d", width, height);
}

void studio_drive_text(StudioDrive *drive, char *const *words, const char *name) {
    (void)words;
    GtkWidget *part = find_part(drive->window, name);
    char *text = part == NULL ? NULL
                 : GTK_IS_SWITCH(part)
                     ? g_strdup(gtk_switch_get_active(GTK_SWITCH(part)) ? "on" : "off")
                     : words_on(part);
    if (part == NULL) {
        studio_answer("error nothing is called %s", name);
    } else {
        studio_answer("%s", text == NULL ? "nothing" : text);
    }
    g_free(text);
}

// ---- dialogs and windows -----------------------------------------------------------------------

// What the dialog is called, once it can be seen.
void studio_drive_dialog(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    GtkWindow *dialog = find_dialog(drive->window);
    bool is_there = dialog != NULL && gtk_widget_get_mapped(GTK_WIDGET(dialog));
    char *text = is_there ? words_on(GTK_WIDGET(dialog)) : NULL;
    studio_answer("%s", !is_there ? "nothing" : text == NULL ? G_OBJECT_TYPE_NAME(dialog) : text);
    g_free(text);
}

void studio_drive_picture_of_dialog(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    GtkWindow *dialog = find_dialog(drive->window);
    bool is_saved = dialog != NULL && studio_picture_save(GTK_WIDGET(dialog), rest);
    studio_answer("%s", is_saved ? "ok" : "error no picture");
}

void studio_drive_close_dialog(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    (void)rest;
    GtkWindow *dialog = find_dialog(drive->window);
    if (dialog != NULL) {
        gtk_window_close(dialog);
    }
    studio_answer("%s", dialog != NULL ? "ok" : "error there is no dialog");
}

void studio_drive_take(StudioDrive *drive, StudioWindow *window) {
    GtkApplication *application = GTK_APPLICATION(g_application_get_default());
    for (GList *at = gtk_application_get_windows(application); at != NULL && window == NULL;
         at = at->next) {
        window = STUDIO_IS_WINDOW(at->data) ? at->data : NULL;
    }
    g_set_weak_pointer(&drive->window, window);
}

// Each window has a number; they count up from 1.
static StudioWindow *window_of(int number) {
    GtkApplication *application = GTK_APPLICATION(g_application_get_default());
    GtkWindow *window = gtk_application_get_window_by_id(application, (guint)number);
    return STUDIO_IS_WINDOW(window) ? STUDIO_WINDOW(window) : NULL;
}

void studio_drive_windows(StudioDrive *drive, char *const *words, const char *rest) {
    (void)drive;
    (void)words;
    (void)rest;
    GString *text = g_string_new(NULL);
    for (int number = 1; number < 100; number++) {
        if (window_of(number) != NULL) {
            g_string_append_printf(text, "%s%d", text->len > 0 ? " " : "", number);
        }
    }
    studio_answer("%s", text->str);
    g_string_free(text, TRUE);
}

void studio_drive_window(StudioDrive *drive, char *const *words, const char *rest) {
    (void)rest;
    StudioWindow *window = window_of(atoi(words[1]));
    if (window != NULL) {
        studio_drive_take(drive, window);
        studio_answer("ok");
    } else {
        studio_answer("error there is no window %s", words[1]);
    }
}

// ---- the keyboard ------------------------------------------------------------------------------

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
void studio_drive_focus(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    GtkWindow *dialog = find_dialog(drive->window);
    GtkWidget *has = gtk_window_get_focus(dialog != NULL ? dialog : GTK_WINDOW(drive->window));
    GString *text = g_string_new(NULL);
    if (strcmp(rest, "all") == 0) {
        list_focusable(text, GTK_WIDGET(drive->window));
    } else if (has != NULL) {
        name_widget(text, has);
    }
    studio_answer("%s", text->len == 0 ? "nothing" : text->str);
    g_string_free(text, TRUE);
}

// ---- a pen -------------------------------------------------------------------------------------

// Below what GDK delivers: no display without a screen has a pen.
void studio_drive_pen(StudioDrive *drive, char *const *words, const char *rest) {
    (void)words;
    char what[8] = "";
    double x = 0, y = 0, shift_x, shift_y, at_x, at_y;
    StudioTouch touch;
    GtkWidget *widget = find_part(drive->window, "sketch-board");
    int count = sscanf(rest, "%7s %lf %lf %lf %lf %lf", what, &x, &y, &touch.pressure, &touch.tilt,
                       &touch.time);
    bool is_up = strcmp(what, "up") == 0;
    if (!STUDIO_IS_SKETCH_BOARD(widget) || (count != 6 && !is_up)) {
        studio_answer("error there is no board, or too little is said of the pen");
        return;
    }
    StudioSketchBoard *board = STUDIO_SKETCH_BOARD(widget);
    gtk_native_get_surface_transform(GTK_NATIVE(drive->window), &shift_x, &shift_y);
    gtk_widget_translate_coordinates(GTK_WIDGET(drive->window), widget, x - shift_x, y - shift_y,
                                     &at_x, &at_y);
    if (is_up) {
        studio_sketch_board_lift(board);
    } else if (strcmp(what, "down") == 0) {
        studio_sketch_board_press(board, at_x, at_y, touch);
    } else {
        studio_sketch_board_draw(board, at_x, at_y, touch);
    }
    studio_answer("ok");
}
