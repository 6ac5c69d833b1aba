#include "studio/sketch_panel_private.h"

#include <adwaita.h>
#include <math.h>
#include <string.h>

enum { PLAY_STEPS = 24 };

static guint said;

G_DEFINE_TYPE(StudioSketchPanel, studio_sketch_panel, GTK_TYPE_BOX)

void studio_sketch_say(StudioSketchPanel *panel, const char *text) {
    g_signal_emit(panel, said, 0, text);
}

const FrContents *studio_sketch_contents(StudioSketchPanel *panel) {
    return panel->document == NULL ? NULL : studio_document_contents(panel->document);
}

double studio_sketch_step(StudioSketchPanel *panel) {
    double min[3], max[3];
    if (panel->base == NULL) {
        return 1;
    }
    studio_sketch_bounds(panel->base->plant, min, max);
    double width = fmax(max[0] - min[0], max[1] - min[1]), height = max[2] - min[2];
    return fmax(1.2 * width, 0.3 * height);
}

// ---- asking ------------------------------------------------------------------------------------

static void ask_whole(StudioSketchPanel *panel) {
    guint first = panel->seed + (panel->is_sheet ? 0 : panel->chosen);
    FrSource *source =
        studio_sketch_preview(panel->document, &panel->of, first,
                              panel->is_sheet ? panel->count : 1, studio_sketch_step(panel));
    if (source != NULL) {
        studio_builder_request(panel->builder, source, studio_document_folder(panel->document),
                               ++panel->revision, (StudioMoment){NAN, -1});
        fr_source_unref(source);
    }
}

void studio_sketch_ask(StudioSketchPanel *panel) {
    if (studio_sketch_contents(panel) == NULL || panel->of.base == NULL) {
        return;
    }
    guint first = panel->seed + (panel->is_sheet ? 0 : panel->chosen);
    StudioSketchAsk ask = {first, panel->is_sheet ? panel->count : 1, panel->strength};
    panel->asked = studio_sketcher_ask(panel->sketcher, studio_document_source(panel->document),
                                       studio_document_folder(panel->document), &panel->of, ask);
    if (panel->is_whole && !panel->is_playing) {
        ask_whole(panel);
    }
}

// ---- what comes back ---------------------------------------------------------------------------

static void play_on(StudioSketchPanel *panel) {
    if (panel->is_playing) {
        panel->strength = fmin(1, panel->strength + 1.0 / PLAY_STEPS);
        panel->is_playing = panel->strength < 1;
        studio_sketch_ask(panel);
    }
}

static void take(StudioSketchPanel *panel, StudioSketched *done) {
    if (done->status != FR_OK && panel->done != NULL) { // the last good plant stays
        FrDiags *diags = done->diags;
        done->diags = panel->done->diags;
        panel->done->diags = diags;
        studio_sketched_free(done);
        studio_sketch_show_problem(panel);
        panel->is_playing = false;
        panel->strength = 1;
        return;
    }
    studio_sketched_free(panel->done);
    panel->done = done;
    studio_sketch_show_problem(panel);
    if (done->base != NULL && done->base != panel->base) {
        studio_sketch_take_base(panel, done->base);
        if (panel->is_whole) {
            ask_whole(panel); // now it is known how large the plant is
        }
    }
    studio_sketch_show_instances(panel);
    play_on(panel);
}

static gboolean on_idle(gpointer data) {
    StudioSketchPanel *panel = data;
    g_atomic_int_set(&panel->is_woken, 0);
    StudioSketched *done = studio_sketcher_take(panel->sketcher);
    if (done != NULL && panel->document != NULL) {
        take(panel, done);
    } else {
        studio_sketched_free(done);
    }
    return G_SOURCE_REMOVE;
}

static void wake(void *user) {
    StudioSketchPanel *panel = user;
    if (g_atomic_int_compare_and_exchange(&panel->is_woken, 0, 1)) {
        g_idle_add_full(G_PRIORITY_DEFAULT, on_idle, panel, NULL);
    }
}

static void collect(StudioSketchPanel *panel) {
    const StudioBuilt *built;
    if (panel->builder == NULL || !studio_viewport_is_ready(panel->viewport)) {
        return;
    }
    while ((built = studio_builder_collect(panel->builder)) != NULL) {
        panel->built = built->revision;
        if (built->view != NULL) {
            studio_viewport_take(panel->viewport, built->view);
        } else if (built->status != FR_OK && fr_diags_count(built->diags) > 0) {
            studio_sketch_say(panel, fr_diags_get(built->diags, 0)->text);
        }
        studio_builder_release(panel->builder);
    }
    StudioPicture picture;
    while (studio_builder_take_picture(panel->builder, &picture)) {
        studio_viewport_add_picture(panel->viewport, &picture);
        fr_image_unref(picture.image);
    }
}

static gboolean on_built(gpointer data) {
    StudioSketchPanel *panel = data;
    g_atomic_int_set(&panel->is_built, 0);
    collect(panel);
    return G_SOURCE_REMOVE;
}

static void wake_built(void *user) {
    StudioSketchPanel *panel = user;
    if (g_atomic_int_compare_and_exchange(&panel->is_built, 0, 1)) {
        g_idle_add_full(G_PRIORITY_DEFAULT, on_built, panel, NULL);
    }
}

static void on_ready(StudioViewport *viewport, StudioSketchPanel *panel) {
    (void)viewport;
    collect(panel);
}

// ---- following the document --------------------------------------------------------------------

static void read_seed(StudioSketchPanel *panel, const FrContents *contents) {
    uint32_t vary = studio_sketch_vary(contents, panel->of.varied);
    char *seed = vary == FR_NONE
                     ? NULL
                     : fr_contents_get(contents, fr_contents_at(contents, vary)->parent, "seed");
    guint64 value = 1;
    panel->seed = seed != NULL && g_ascii_string_to_unsigned(seed, 10, 0, G_MAXINT32, &value, NULL)
                      ? (guint)value
                      : 1;
    g_free(seed);
}

void studio_sketch_panel_follow(StudioSketchPanel *panel) {
    const FrContents *contents = studio_sketch_contents(panel);
    if (contents == NULL || panel->of.base == NULL) {
        return;
    }
    if (studio_sketch_vary(contents, panel->of.varied) == FR_NONE) {
        g_clear_pointer(&panel->of.varied, g_free);
    }
    GPtrArray *variations = studio_sketch_variations(contents, panel->of.base);
    if (panel->of.varied == NULL && !panel->is_new && variations->len > 0) {
        panel->of.varied = g_strdup(g_ptr_array_index(variations, 0));
    }
    g_ptr_array_unref(variations);
    panel->is_new = panel->is_new && panel->of.varied == NULL;
    read_seed(panel, contents);
    studio_sketch_show_lists(panel);
    studio_sketch_ask(panel);
}

void studio_sketch_panel_begin(StudioSketchPanel *panel, StudioDocument *document, uint32_t plant) {
    studio_sketch_panel_end(panel);
    panel->document = document;
    if (panel->sketcher == NULL) {
        panel->sketcher = studio_sketcher_new(wake, panel);
        panel->builder = studio_builder_new(wake_built, panel);
    }
    const FrContents *contents = studio_sketch_contents(panel);
    if (contents != NULL) {
        panel->of = studio_sketch_of(contents, plant);
        uint32_t vary = studio_sketch_vary(contents, panel->last);
        char *base = vary == FR_NONE ? NULL : fr_contents_get(contents, vary, "base");
        const char *shown = plant == FR_NONE ? NULL : fr_contents_at(contents, plant)->id;
        if (base != NULL && g_strcmp0(base, shown) == 0) { // goes on where it was left
            g_free(panel->of.varied);
            panel->of.varied = g_strdup(panel->last);
        }
        g_free(base);
    }
    panel->is_new = false;
    studio_viewport_display(panel->viewport)->is_dark =
        adw_style_manager_get_dark(adw_style_manager_get_default());
    studio_sketch_show_page(panel);
    studio_sketch_panel_follow(panel);
}

void studio_sketch_panel_end(StudioSketchPanel *panel) {
    panel->document = NULL;
    panel->is_playing = false;
    panel->strength = 1;
    panel->chosen = 0;
    panel->is_framed = false;
    if (panel->of.varied != NULL) {
        g_free(panel->last);
        panel->last = g_steal_pointer(&panel->of.varied);
    }
    studio_sketch_of_clear(&panel->of);
    g_clear_pointer(&panel->device, studio_device_close);
    g_clear_pointer(&panel->done, studio_sketched_free);
    g_clear_pointer(&panel->selection, fr_selection_free);
    g_clear_pointer(&panel->states, g_free);
    g_clear_pointer(&panel->seen, fr_id_buffer_free);
    g_clear_pointer(&panel->base, studio_base_unref);
    studio_sketch_view_set_lines(panel->strokes, NULL, NULL);
    studio_sketch_view_set_lines(panel->skeleton, NULL, NULL);
    studio_sketch_board_set_lines(panel->board, NULL, NULL);
    studio_viewport_forget(panel->viewport);
}

void studio_sketch_panel_set_widths(StudioSketchPanel *panel, const int widths[2]) {
    gtk_paned_set_position(GTK_PANED(panel->outer), widths[0]);
    gtk_paned_set_position(GTK_PANED(panel->inner), widths[1]);
}

void studio_sketch_panel_get_widths(StudioSketchPanel *panel, int widths[2]) {
    widths[0] = gtk_paned_get_position(GTK_PANED(panel->outer));
    widths[1] = gtk_paned_get_position(GTK_PANED(panel->inner));
}

gboolean studio_sketch_panel_is_idle(StudioSketchPanel *panel) {
    double fraction, seconds;
    if (panel->document == NULL) {
        return TRUE;
    }
    bool is_whole = panel->is_whole && gtk_widget_get_mapped(GTK_WIDGET(panel->viewport));
    return !studio_sketcher_is_busy(panel->sketcher) && g_atomic_int_get(&panel->is_woken) == 0 &&
           !panel->is_playing &&
           (!is_whole ||
            (panel->built == panel->revision &&
             !studio_builder_is_busy(panel->builder, &fraction, &seconds) &&
             !studio_builder_is_painting(panel->builder) &&
             g_atomic_int_get(&panel->is_built) == 0 && studio_viewport_is_done(panel->viewport)));
}

char *studio_sketch_panel_state(StudioSketchPanel *panel) {
    guint counts[3] = {0, 0, 0};
    for (uint32_t a = 0; panel->base != NULL && a < panel->base->plant->axes.count; a++) {
        counts[panel->states[a] % 3]++;
    }
    const StudioSketched *done = panel->done;
    guint shaped = 0;
    for (uint32_t a = 0; done != NULL && done->stroke != NULL && panel->base != NULL &&
                         a < panel->base->plant->axes.count;
         a++) {
        shaped += done->stroke[a] != FR_NONE;
    }
    return g_strdup_printf("{\"base\": \"%s\", \"varied\": \"%s\", \"unselected\": %u, "
                           "\"selected\": %u, \"undetermined\": %u, \"shaped\": %u, "
                           "\"instances\": %u, \"seconds\": %.6f, \"height\": %.6f}",
                           panel->of.base == NULL ? "" : panel->of.base,
                           panel->of.varied == NULL ? "" : panel->of.varied, counts[0], counts[1],
                           counts[2], shaped, done == NULL ? 0 : done->instances->len,
                           done == NULL ? 0 : done->seconds,
                           studio_sketch_board_get(panel->board)->height);
}

// ---- life --------------------------------------------------------------------------------------

static void studio_sketch_panel_dispose(GObject *object) {
    StudioSketchPanel *panel = STUDIO_SKETCH_PANEL(object);
    if (panel->strokes != NULL) {
        studio_sketch_panel_end(panel);
        panel->strokes = NULL;
    }
    g_clear_pointer(&panel->last, g_free);
    g_clear_pointer(&panel->sketcher, studio_sketcher_free);
    g_clear_pointer(&panel->builder, studio_builder_free);
    while (g_idle_remove_by_data(panel)) {
    }
    G_OBJECT_CLASS(studio_sketch_panel_parent_class)->dispose(object);
}

static void studio_sketch_panel_class_init(StudioSketchPanelClass *class) {
    G_OBJECT_CLASS(class)->dispose = studio_sketch_panel_dispose;
    said = g_signal_new("said", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                        G_TYPE_NONE, 1, G_TYPE_STRING);
}

static void studio_sketch_panel_init(StudioSketchPanel *panel) {
    panel->strength = 1;
    panel->count = 7;
    panel->seed = 1;
    panel->keeps_path = true;
    panel->path_end = FR_NONE;
}

GtkWidget *studio_sketch_panel_new(GActionMap *actions) {
    StudioSketchPanel *panel =
        g_object_new(STUDIO_TYPE_SKETCH_PANEL, "orientation", GTK_ORIENTATION_VERTICAL, NULL);
    panel->actions = actions;
    studio_sketch_add_actions(panel);
    studio_sketch_make(panel);
    g_signal_connect(panel->viewport, "ready", G_CALLBACK(on_ready), panel);
    return GTK_WIDGET(panel);
}
