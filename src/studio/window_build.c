/// Between the window and its builder.
#include "studio/window_private.h"

#include "frond/pick.h"
#include "studio/accessible.h"
#include "studio/model/values.h"

#include <math.h>

static const double busy_after = 0.3; // seconds until it says that it is building
enum { POLL_MILLISECONDS = 100 };

// ---- what comes back ---------------------------------------------------------------------------

// What there is, and how long an edit took; opening a document is no edit.
static void show_amount(StudioWindow *window, const StudioTimes *times, bool is_edit) {
    StudioAmount amount = studio_viewport_amount(window->viewport);
    double milliseconds =
        1000 * (times->read + times->build + times->view + amount.uploaded_seconds);
    char *leaves = studio_count_words(amount.leaves, "leaf", "leaves");
    char *triangles = studio_count_words(amount.triangles, "triangle", "triangles");
    char *time = is_edit ? g_strdup_printf("   %.0f ms", milliseconds) : g_strdup("");
    char *text = g_strdup_printf("%s   %s%s", leaves, triangles, time);
    gtk_label_set_text(GTK_LABEL(window->amount), text);
    gtk_widget_set_visible(window->amount, TRUE);
    char *words = g_strdup_printf("%s, %s", leaves, triangles);
    studio_describe(GTK_WIDGET(window->viewport), words);
    g_free(words);
    g_free(text);
    g_free(time);
    g_free(triangles);
    g_free(leaves);
}

static void take(StudioWindow *window, const StudioBuilt *built) {
    studio_viewport_set_overlay(window->viewport, "ahead", NULL);
    if (built->view != NULL) {
        studio_viewport_take(window->viewport, built->view);
        studio_viewport_stamp(window->viewport, &window->whole_seen);
    }
    if (built->is_forgotten) { // it must not be what the document that came is framed by
        studio_viewport_forget(window->viewport);
        return;
    }
    window->shown = built->revision;
    g_clear_pointer(&window->diags, fr_diags_free);
    window->diags = fr_diags_new();
    for (size_t i = 0; i < fr_diags_count(built->diags); i++) {
        const FrDiag *diag = fr_diags_get(built->diags, i);
        fr_diags_add(window->diags, diag->severity, diag->code, diag->span, "%s", diag->text);
    }
    if (built->view != NULL) {
        window->times = built->times;
        show_amount(window, &built->times, studio_document_steps(window->document) > 0);
        studio_graph_panel_set_counts(window->graph, built->counts);
        studio_things_panel_set_loads(window->things, built->loads);
        studio_string_panel_match(window->string);
    }
    if (built->is_growing) {
        window->moment.step = (int64_t)built->step;
        window->asked_moment.step = window->moment.step;
        studio_time_strip_show_growth(window->strip, built->step, built->step_count);
    }
    studio_time_strip_continue(window->strip);
    studio_window_update_problem(window);
    studio_inspector_set_diags(window->inspector, window->diags);
    studio_window_show_texts(window);
    studio_light_mode_update(window->light);
    studio_patch_mode_update(window->patch);
}

void studio_window_collect(StudioWindow *window) {
    if (window->builder == NULL || !studio_viewport_is_ready(window->viewport)) {
        return;
    }
    StudioOverlay *ahead = studio_builder_take_ahead(window->builder);
    if (ahead != NULL) {
        studio_viewport_set_overlay(window->viewport, "ahead", ahead);
        studio_viewport_stamp(window->viewport, &window->first_seen);
    }
    const StudioBuilt *built;
    while ((built = studio_builder_collect(window->builder)) != NULL) {
        take(window, built);
        studio_builder_release(window->builder);
    }
    StudioPicture picture;
    while (studio_builder_take_picture(window->builder, &picture)) {
        studio_viewport_add_picture(window->viewport, &picture);
        studio_swatches_add(studio_inspector_swatches(window->inspector), &picture);
        fr_image_unref(picture.image);
    }
    studio_light_mode_collect(window->light);
}

static gboolean on_idle(gpointer data) {
    StudioWindow *window = data;
    g_atomic_int_set(&window->is_woken, 0);
    studio_window_collect(window);
    return G_SOURCE_REMOVE;
}

void studio_window_wake(void *user) {
    StudioWindow *window = user;
    if (g_atomic_int_compare_and_exchange(&window->is_woken, 0, 1)) {
        g_idle_add_full(G_PRIORITY_DEFAULT, on_idle, window, NULL);
    }
}

static gboolean on_poll(gpointer data) {
    StudioWindow *window = data;
    double fraction = 0, seconds = 0;
    bool is_busy = studio_builder_is_busy(window->builder, &fraction, &seconds);
    bool is_long = is_busy && seconds > busy_after;
    studio_window_reveal(window->busy, is_long);
    if (is_long) {
        gtk_label_set_text(GTK_LABEL(window->busy_text),
                           studio_builder_is_looking(window->builder) ? "Light" : "Building");
    }
    gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(window->busy_bar), CLAMP(fraction, 0, 1));
    if (!is_busy) {
        window->progress = 0;
    }
    return is_busy;
}

// ---- what is asked for -------------------------------------------------------------------------

void studio_window_start_builder(StudioWindow *window) {
    if (window->builder == NULL) {
        window->builder = studio_builder_new(studio_window_wake, window);
        studio_light_mode_watch(window->light);
        studio_swatches_set_builder(studio_inspector_swatches(window->inspector), window->builder);
    }
    studio_builder_forget(window->builder);
    window->asked = window->shown = 0;
}

static bool is_same_moment(StudioMoment a, StudioMoment b) {
    return a.step == b.step && (a.time == b.time || (isnan(a.time) && isnan(b.time)));
}

void studio_window_request(StudioWindow *window) {
    uint64_t revision = studio_document_revision(window->document);
    if (revision == window->asked && is_same_moment(window->moment, window->asked_moment)) {
        return;
    }
    window->asked = revision;
    window->asked_moment = window->moment;
    window->asked_time = g_get_monotonic_time();
    window->first_seen = window->whole_seen = 0;
    studio_builder_request(window->builder, studio_document_source(window->document),
                           studio_document_folder(window->document), revision, window->moment);
    studio_window_poll(window);
}

void studio_window_poll(StudioWindow *window) {
    if (window->progress == 0) {
        window->progress = g_timeout_add(POLL_MILLISECONDS, on_poll, window);
    }
}

bool studio_window_is_idle(StudioWindow *window) {
    double fraction, seconds;
    if (window->document != NULL && studio_window_is_sketching(window)) {
        return window->exports == 0 && studio_sketch_panel_is_idle(window->sketch);
    }
    return window->document == NULL ||
           (window->shown == window->asked && studio_string_panel_is_idle(window->string) &&
            window->exports == 0 && !studio_builder_is_busy(window->builder, &fraction, &seconds) &&
            !studio_builder_is_painting(window->builder) &&
            g_atomic_int_get(&window->is_woken) == 0 && studio_viewport_is_done(window->viewport));
}

// ---- picking -----------------------------------------------------------------------------------

void studio_window_unpick(StudioWindow *window) {
    if (window->picked.lines != NULL) {
        studio_picked_clear(&window->picked);
        window->picked = (StudioPicked){0};
        studio_viewport_highlight(window->viewport, NULL, 0);
    }
    studio_window_reveal(window->picked_bar, FALSE);
}

static void show_picked(StudioWindow *window) {
    const StudioPicked *picked = &window->picked;
    studio_viewport_highlight(
        window->viewport, (const float(*)[3])(const void *)picked->lines->data, picked->lines->len);
    char *text = g_strdup_printf("One of %s, %.2f m away", picked->component, picked->distance);
    gtk_label_set_text(GTK_LABEL(window->picked_text), text);
    g_free(text);
    studio_window_reveal(window->picked_bar, TRUE);
}

void studio_window_pick(StudioWindow *window, double x, double y) {
    double origin[3], direction[3];
    int width = gtk_widget_get_width(GTK_WIDGET(window->viewport));
    int height = gtk_widget_get_height(GTK_WIDGET(window->viewport));
    const StudioCamera *camera = studio_viewport_camera(window->viewport);
    studio_camera_ray(camera, (double)width / height, x, y, origin, direction);
    double spread = 6 * tan(0.5 * camera->field_of_view) / height;
    StudioPicked picked;
    studio_window_unpick(window);
    if (window->builder == NULL ||
        !studio_builder_pick(window->builder, origin, direction, spread, &picked)) {
        studio_window_select(window, FR_NONE);
        return;
    }
    const FrContents *contents = studio_document_contents(window->document);
    uint32_t plant = picked.plant == NULL ? FR_NONE : fr_contents_find(contents, 0, picked.plant);
    uint32_t graph = plant == FR_NONE ? FR_NONE : studio_graph_of(window->document, plant);
    uint32_t element = graph == FR_NONE || picked.component == NULL
                           ? FR_NONE
                           : fr_contents_find(contents, graph, picked.component);
    studio_window_select(window, element == FR_NONE ? plant : element);
    window->picked = picked;
    if (element != FR_NONE) {
        show_picked(window);
    } else {
        studio_viewport_highlight(window->viewport,
                                  (const float(*)[3])(const void *)picked.lines->data,
                                  picked.lines->len);
    }
}

void studio_window_edit_picked(StudioWindow *window, const char *attribute, const char *name) {
    const StudioPicked *picked = &window->picked;
    if (picked->lines == NULL || picked->plant == NULL || picked->component == NULL) {
        return;
    }
    char *path = studio_hand_path(studio_document_source(window->document),
                                  studio_document_folder(window->document), picked->plant,
                                  picked->component, picked->path);
    uint32_t plant = fr_contents_find(studio_document_contents(window->document), 0, picked->plant);
    if (path == NULL || plant == FR_NONE) {
        studio_window_say(window, "This one has no path of its own and cannot be edited by hand");
    } else {
        studio_edit_instance(window->document, plant, path, name, attribute, "yes", NULL);
    }
    studio_window_unpick(window);
    g_free(path);
}
