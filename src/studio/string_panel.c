#include "studio/string_panel.h"

#include "studio/accessible.h"
#include "studio/model/lstring.h"
#include "studio/model/values.h"
#include "studio/widgets.h"
#include "studio/window_private.h"

#include <math.h>
#include <string.h>

// Modules shown at once, how many of them the buttons go on by, and of how many ends of lines on
// these are thin, and no more drawn.
enum { PAGE = 2000, TURN = 1500, MANY_LINES = 200, MOST_LINES = 20000, HOVER_MILLISECONDS = 30 };

typedef struct Job {
    StudioStringPanel *panel; // NULL: it has gone
    FrSource *source;
    char *folder, *plant;
    FrProgress *progress;
    FrStatus status;
    StudioLstring *string;
} Job;

struct StudioStringPanel {
    StudioWindow *window;
    GtkWidget *box, *view, *title, *begin, *back, *next, *earlier, *later;
    GtkTextBuffer *buffer;
    GtkTextTag *tag;
    StudioLstring *string; // what is shown; NULL: nothing yet
    Job *job;              // that runs; NULL
    uint64_t asked;        // revision
    char *plant;           // its id; NULL: no L-system is shown
    bool is_due, is_matched;
    uint32_t first, end;         // modules of the page
    uint32_t marked, marked_end; // FR_NONE: none
    double pointer[2];           // in the viewport
    guint hover;                 // timer
};

// ---- what is pointed at ------------------------------------------------------------------------

typedef struct Look {
    StudioStringPanel *panel;
    double origin[3], direction[3], spread;
    uint32_t module; // found
    GArray *lines;   // found
} Look;

static void use_lines(void *user, const FrScene *scene) {
    Look *look = user;
    const StudioStringPanel *panel = look->panel;
    look->lines = studio_lstring_lines(panel->string, scene, panel->marked, panel->marked_end);
}

static void draw_lines(StudioStringPanel *panel) {
    static const float paint[4] = {0.35f, 0.75f, 1.0f, 1.0f};
    StudioViewport *viewport = panel->window->viewport;
    Look look = {.panel = panel};
    if (panel->marked != FR_NONE && panel->is_matched) {
        studio_builder_use(panel->window->builder, use_lines, &look);
    }
    double width = look.lines != NULL && look.lines->len > MANY_LINES ? 1.5 : 5;
    StudioOverlay *overlay = NULL;
    for (guint i = 0; look.lines != NULL && i + 1 < MIN(look.lines->len, MOST_LINES); i += 2) {
        const float *at = &g_array_index(look.lines, float, 3 * i);
        double ends[2][3] = {{(double)at[0], (double)at[1], (double)at[2]},
                             {(double)at[3], (double)at[4], (double)at[5]}};
        overlay = overlay == NULL ? studio_overlay_new() : overlay;
        overlay->through = 1;
        studio_overlay_line(overlay, ends[0], ends[1], width, paint);
    }
    studio_viewport_set_overlay(viewport, "string", overlay);
    g_clear_pointer(&look.lines, g_array_unref);
}

static void show_production(StudioStringPanel *panel) {
    FrSpan span = {0};
    if (panel->marked != FR_NONE) {
        studio_lstring_maker(panel->string, panel->marked, &span);
    }
    bool is_here = span.source != NULL &&
                   strcmp(fr_source_name(span.source),
                          fr_source_name(studio_document_source(panel->window->document))) == 0;
    studio_text_panel_mark(panel->window->lsystem, is_here ? span.begin : FR_NONE, span.end);
}

static void get_iter(StudioStringPanel *panel, uint32_t module, GtkTextIter *at) {
    size_t size;
    studio_lstring_text(panel->string, panel->first, module, &size);
    gtk_text_buffer_get_iter_at_offset(panel->buffer, at, (int)size); // it is ASCII
}

static void tag_modules(StudioStringPanel *panel) {
    GtkTextIter begin, end;
    gtk_text_buffer_get_bounds(panel->buffer, &begin, &end);
    gtk_text_buffer_remove_tag(panel->buffer, panel->tag, &begin, &end);
    if (panel->marked != FR_NONE && panel->marked < panel->end &&
        panel->marked_end > panel->first) {
        get_iter(panel, MAX(panel->marked, panel->first), &begin);
        get_iter(panel, MIN(panel->marked_end, panel->end), &end);
        gtk_text_buffer_apply_tag(panel->buffer, panel->tag, &begin, &end);
    }
}

static void show_page(StudioStringPanel *panel, uint32_t first) {
    size_t size = 0;
    const char *text = "";
    bool is_shown = panel->string != NULL && studio_lstring_is_shown(panel->string);
    uint32_t count = is_shown ? (uint32_t)studio_lstring_count(panel->string) : 0;
    panel->first = MIN(first, count - MIN(count, PAGE));
    panel->end = MIN(panel->first + PAGE, count);
    if (is_shown) {
        text = studio_lstring_text(panel->string, panel->first, panel->end, &size);
    }
    gtk_text_buffer_set_text(panel->buffer, text, (int)size);
    gtk_widget_set_visible(panel->earlier, count > PAGE);
    gtk_widget_set_visible(panel->later, count > PAGE);
    gtk_widget_set_sensitive(panel->earlier, panel->first > 0);
    gtk_widget_set_sensitive(panel->later, panel->end < count);
}

// Marks modules here, in the picture and in the text; FR_NONE: none.
static void mark(StudioStringPanel *panel, uint32_t module) {
    if (module == panel->marked) {
        return;
    }
    panel->marked = module;
    panel->marked_end = module == FR_NONE ? FR_NONE : studio_lstring_end_of(panel->string, module);
    tag_modules(panel);
    draw_lines(panel);
    show_production(panel);
}

static void on_string_motion(GtkEventControllerMotion *motion, double x, double y,
                             StudioStringPanel *panel) {
    (void)motion;
    GtkTextIter at;
    int left, top;
    gtk_text_view_window_to_buffer_coords(GTK_TEXT_VIEW(panel->view), GTK_TEXT_WINDOW_WIDGET,
                                          (int)x, (int)y, &left, &top);
    bool is_on = panel->end > panel->first &&
                 gtk_text_view_get_iter_at_location(GTK_TEXT_VIEW(panel->view), &at, left, top);
    uint32_t from = is_on ? studio_lstring_begin(panel->string, panel->first) : 0;
    mark(panel,
         is_on ? studio_lstring_at(panel->string, from + (uint32_t)gtk_text_iter_get_offset(&at))
               : FR_NONE);
}

static void on_leave(GtkEventControllerMotion *motion, StudioStringPanel *panel) {
    (void)motion;
    g_clear_handle_id(&panel->hover, g_source_remove);
    mark(panel, FR_NONE);
}

// The cursor goes from module to module by keys.
static void on_cursor(GtkTextBuffer *buffer, GParamSpec *spec, StudioStringPanel *panel) {
    (void)spec;
    GtkTextIter at;
    if (panel->end > panel->first && gtk_widget_has_focus(panel->view)) {
        gtk_text_buffer_get_iter_at_mark(buffer, &at, gtk_text_buffer_get_insert(buffer));
        mark(panel,
             studio_lstring_at(panel->string, studio_lstring_begin(panel->string, panel->first) +
                                                  (uint32_t)gtk_text_iter_get_offset(&at)));
    }
}

// ---- the picture -------------------------------------------------------------------------------

static void use_pick(void *user, const FrScene *scene) {
    Look *look = user;
    look->module = studio_lstring_pick(look->panel->string, scene, look->origin, look->direction,
                                       look->spread);
}

// Shows what is seen below the pointer, on its own page and scrolled to.
static gboolean on_hover(gpointer data) {
    StudioStringPanel *panel = data;
    GtkWidget *viewport = GTK_WIDGET(panel->window->viewport);
    int width = gtk_widget_get_width(viewport), height = gtk_widget_get_height(viewport);
    const StudioCamera *camera = studio_viewport_camera(panel->window->viewport);
    Look look = {
        .panel = panel, .spread = 6 * tan(0.5 * camera->field_of_view) / height, .module = FR_NONE};
    panel->hover = 0;
    if (panel->is_matched) {
        studio_camera_ray(camera, (double)width / height, 2 * panel->pointer[0] / width - 1,
                          1 - 2 * panel->pointer[1] / height, look.origin, look.direction);
        studio_builder_use(panel->window->builder, use_pick, &look);
    }
    mark(panel, look.module);
    if (look.module != FR_NONE) {
        GtkTextIter at;
        if (look.module < panel->first || look.module >= panel->end) {
            show_page(panel, look.module - MIN(look.module, PAGE / 2));
            tag_modules(panel);
        }
        get_iter(panel, look.module, &at);
        gtk_text_view_scroll_to_iter(GTK_TEXT_VIEW(panel->view), &at, 0.1, FALSE, 0, 0);
    }
    return G_SOURCE_REMOVE;
}

static void on_viewport_motion(GtkEventControllerMotion *motion, double x, double y,
                               StudioStringPanel *panel) {
    GdkModifierType state =
        gtk_event_controller_get_current_event_state(GTK_EVENT_CONTROLLER(motion));
    bool is_held = (state & (GDK_BUTTON1_MASK | GDK_BUTTON2_MASK | GDK_BUTTON3_MASK)) != 0;
    panel->pointer[0] = x;
    panel->pointer[1] = y;
    if (panel->hover == 0 && !is_held && panel->is_matched && gtk_widget_get_mapped(panel->view)) {
        panel->hover = g_timeout_add(HOVER_MILLISECONDS, on_hover, panel);
    }
}

static void show_title(StudioStringPanel *panel) {
    const StudioLstring *string = panel->string;
    uint64_t step = string == NULL ? 0 : studio_lstring_step(string);
    char *text = NULL;
    if (string != NULL) {
        char *words = studio_lstring_words(string);
        text = g_strconcat(words,
                           !studio_lstring_is_shown(string) ? ", too many to show"
                           : panel->is_matched              ? ""
                                                            : ", not in the picture",
                           NULL);
        g_free(words);
    }
    gtk_label_set_text(GTK_LABEL(panel->title), text == NULL ? "" : text);
    gtk_widget_set_tooltip_text(panel->title, text);
    gtk_widget_set_sensitive(panel->begin, step > 0);
    gtk_widget_set_sensitive(panel->back, step > 0);
    gtk_widget_set_sensitive(panel->next, string != NULL);
    g_free(text);
}

static void use_match(void *user, const FrScene *scene) {
    StudioStringPanel *panel = user;
    panel->is_matched = studio_lstring_match(panel->string, scene);
}

void studio_string_panel_match(StudioStringPanel *panel) {
    panel->is_matched = false;
    if (panel->string != NULL && panel->window->builder != NULL) {
        studio_builder_use(panel->window->builder, use_match, panel);
        draw_lines(panel);
    }
    show_title(panel);
}

// ---- deriving ----------------------------------------------------------------------------------

static void take(StudioStringPanel *panel, StudioLstring *string) {
    uint32_t first = panel->first;
    mark(panel, FR_NONE);
    studio_lstring_free(panel->string);
    panel->string = string;
    show_page(panel, first);
    studio_string_panel_match(panel);
}

static void work(GTask *task, gpointer source, gpointer data, GCancellable *cancellable) {
    (void)source;
    (void)cancellable;
    Job *job = data;
    FrContext context = fr_context_default();
    context.progress = job->progress;
    job->status = studio_lstring_new(job->source, job->folder, job->plant, &context, &job->string);
    g_task_return_boolean(task, TRUE);
}

static void begin(StudioStringPanel *panel);

static void on_done(GObject *source, GAsyncResult *result, gpointer data) {
    (void)source;
    (void)result;
    Job *job = data;
    StudioStringPanel *panel = job->panel;
    if (panel != NULL) {
        panel->job = NULL;
        if (job->status == FR_OK && !panel->is_due) { // else the last good one stays
            take(panel, g_steal_pointer(&job->string));
        }
        if (panel->is_due) {
            begin(panel);
        }
    }
    studio_lstring_free(job->string);
    fr_source_unref(job->source);
    fr_progress_free(job->progress);
    g_free(job->folder);
    g_free(job->plant);
    g_free(job);
}

static void begin(StudioStringPanel *panel) {
    const StudioDocument *document = panel->window->document;
    panel->is_due = panel->plant != NULL && panel->job != NULL;
    if (panel->job != NULL) {
        fr_progress_cancel(panel->job->progress);
    } else if (panel->plant != NULL) {
        Job *job = panel->job = g_new0(Job, 1);
        job->panel = panel;
        job->source = fr_source_ref(studio_document_source(document));
        job->folder = g_strdup(studio_document_folder(document));
        job->plant = g_strdup(panel->plant);
        job->progress = fr_progress_new(NULL, NULL);
        GTask *task = g_task_new(NULL, NULL, on_done, job);
        g_task_set_task_data(task, job, NULL);
        g_task_run_in_thread(task, work);
        g_object_unref(task);
    }
}

void studio_string_panel_update(StudioStringPanel *panel) {
    const StudioWindow *window = panel->window;
    const FrContents *contents =
        window->document == NULL ? NULL : studio_document_contents(window->document);
    uint32_t plant = contents == NULL ? FR_NONE : studio_window_plant(window);
    bool is_one =
        plant != FR_NONE && fr_contents_child(contents, plant, "lsystem") != FR_NONE &&
        g_strcmp0(gtk_stack_get_visible_child_name(GTK_STACK(window->side)), "lsystem") == 0;
    const char *id = is_one ? fr_contents_at(contents, plant)->id : NULL;
    uint64_t revision = id == NULL ? 0 : studio_document_revision(window->document);
    bool is_other = g_strcmp0(id, panel->plant) != 0;
    if (is_other) {
        g_free(panel->plant);
        panel->plant = g_strdup(id);
        panel->first = 0;
        take(panel, NULL);
    }
    if (is_other || revision != panel->asked) {
        panel->asked = revision;
        begin(panel);
    }
}

bool studio_string_panel_is_idle(const StudioStringPanel *panel) {
    return panel->job == NULL && panel->hover == 0;
}

char *studio_string_panel_state(const StudioStringPanel *panel) {
    size_t size;
    FrSpan span;
    if (panel->marked == FR_NONE) {
        return NULL;
    }
    const char *text = studio_lstring_text(panel->string, panel->marked, panel->marked_end, &size);
    const char *maker = studio_lstring_maker(panel->string, panel->marked, &span);
    return g_strdup_printf("%.*s by %s", (int)size, text, maker == NULL ? "the axiom" : maker);
}

// ---- steps -------------------------------------------------------------------------------------

// To a step; that which the text asks for by itself needs no number.
static void go(StudioStringPanel *panel, uint64_t step) {
    StudioDocument *document = panel->window->document;
    uint32_t plant = studio_window_plant(panel->window);
    uint32_t element =
        plant == FR_NONE ? FR_NONE
                         : fr_contents_child(studio_document_contents(document), plant, "lsystem");
    if (element != FR_NONE && !studio_document_is_broken(document)) {
        char *text = g_strdup_printf("%" G_GUINT64_FORMAT, step);
        bool is_whole = step == studio_lstring_length(panel->string);
        studio_set(document, element, "steps", is_whole ? NULL : text, true);
        g_free(text);
    }
}

static void on_step(GtkButton *button, StudioStringPanel *panel) {
    if (panel->string != NULL) {
        uint64_t step = studio_lstring_step(panel->string);
        GtkWidget *which = GTK_WIDGET(button);
        go(panel, which == panel->begin  ? 0
                  : which == panel->back ? step - MIN(step, 1)
                                         : step + 1);
    }
}

static void on_page(GtkButton *button, StudioStringPanel *panel) {
    uint32_t first = panel->first;
    mark(panel, FR_NONE);
    show_page(panel, GTK_WIDGET(button) == panel->later ? first + TURN : first - MIN(first, TURN));
}

// ---- life --------------------------------------------------------------------------------------

static GtkWidget *make_bar(StudioStringPanel *panel) {
    GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    gtk_widget_add_css_class(bar, "string-bar");
    GCallback step = G_CALLBACK(on_step), page = G_CALLBACK(on_page);
    panel->begin =
        studio_bar_button(bar, "media-skip-backward-symbolic", "Back to the axiom", step, panel);
    panel->back =
        studio_bar_button(bar, "media-seek-backward-symbolic", "A step less", step, panel);
    panel->next = studio_bar_button(bar, "media-seek-forward-symbolic", "A step more", step, panel);
    panel->title = gtk_label_new("");
    gtk_widget_add_css_class(panel->title, "numeric");
    gtk_label_set_wrap(GTK_LABEL(panel->title), TRUE);
    gtk_label_set_wrap_mode(GTK_LABEL(panel->title), PANGO_WRAP_WORD_CHAR);
    gtk_label_set_xalign(GTK_LABEL(panel->title), 0);
    gtk_widget_set_margin_start(panel->title, 6);
    gtk_widget_set_hexpand(panel->title, TRUE);
    gtk_box_append(GTK_BOX(bar), panel->title);
    panel->earlier = studio_bar_button(bar, "go-previous-symbolic", "Earlier modules", page, panel);
    panel->later = studio_bar_button(bar, "go-next-symbolic", "Later modules", page, panel);
    return bar;
}

static GtkWidget *make_view(StudioStringPanel *panel) {
    panel->buffer = gtk_text_buffer_new(NULL);
    GdkRGBA ground = {0.21f, 0.52f, 0.89f, 0.65f};
    panel->tag = gtk_text_buffer_create_tag(panel->buffer, NULL, "background-rgba", &ground, NULL);
    panel->view = gtk_text_view_new_with_buffer(panel->buffer);
    g_object_unref(panel->buffer);
    GtkTextView *view = GTK_TEXT_VIEW(panel->view);
    gtk_text_view_set_editable(view, FALSE);
    gtk_text_view_set_monospace(view, TRUE);
    gtk_text_view_set_wrap_mode(view, GTK_WRAP_CHAR);
    gtk_text_view_set_left_margin(view, 10);
    gtk_text_view_set_right_margin(view, 10);
    gtk_text_view_set_top_margin(view, 6);
    gtk_text_view_set_accepts_tab(view, FALSE);
    gtk_widget_set_name(panel->view, "string");
    studio_name(panel->view, "String of the L-system");
    g_signal_connect(panel->buffer, "notify::cursor-position", G_CALLBACK(on_cursor), panel);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), panel->view);
    gtk_widget_set_vexpand(scrolled, TRUE);
    return scrolled;
}

static void listen(StudioStringPanel *panel, GtkWidget *widget, GCallback motion) {
    GtkEventController *controller = gtk_event_controller_motion_new();
    g_signal_connect(controller, "motion", motion, panel);
    g_signal_connect(controller, "leave", G_CALLBACK(on_leave), panel);
    gtk_widget_add_controller(widget, controller);
}

StudioStringPanel *studio_string_panel_new(StudioWindow *window) {
    StudioStringPanel *panel = g_new0(StudioStringPanel, 1);
    panel->window = window;
    panel->marked = panel->marked_end = FR_NONE;
    panel->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_box_append(GTK_BOX(panel->box), make_bar(panel));
    gtk_box_append(GTK_BOX(panel->box), make_view(panel));
    listen(panel, panel->view, G_CALLBACK(on_string_motion));
    listen(panel, GTK_WIDGET(window->viewport), G_CALLBACK(on_viewport_motion));
    show_title(panel);
    show_page(panel, 0);
    return panel;
}

void studio_string_panel_free(StudioStringPanel *panel) {
    if (panel == NULL) {
        return;
    }
    g_clear_handle_id(&panel->hover, g_source_remove);
    if (panel->job != NULL) {
        panel->job->panel = NULL;
        fr_progress_cancel(panel->job->progress);
    }
    studio_lstring_free(panel->string);
    g_free(panel->plant);
    g_free(panel);
}

GtkWidget *studio_string_panel_widget(StudioStringPanel *panel) {
    return panel->box;
}
