#include "studio/time_strip.h"

#include "studio/accessible.h"
#include "studio/key_track.h"
#include "studio/model/commands.h"
#include "studio/model/keys.h"
#include "studio/model/place.h"
#include "studio/model/values.h"
#include "studio/widgets.h"

#include <math.h>
#include <string.h>

struct _StudioTimeStrip {
    GtkBox parent;
    StudioDocument *document; // borrowed
    char *lsystem;            // place of the <lsystem>; NULL: the clock is shown
    gboolean is_showing, is_running, is_moved;
    gboolean is_growing;
    uint64_t step, step_count;
    char *keyed;       // place of what the key frames are of; NULL: nothing
    StudioClock clock; // of it
    double said;       // what the document says that the clock shows
    guint drags;       // of keys: each is a step of its own
    GtkWidget *stack, *play, *scale, *span, *years, *back, *steps;
    GtkWidget *track, *before, *after;
    GtkWidget *grow, *begin, *undo, *grown;
};

enum { FRAMES = 120 }; // from the beginning of the scale to its end

static const double inset = 10; // half of the clock's handle

static guint time_signal, step_signal;

G_DEFINE_TYPE(StudioTimeStrip, studio_time_strip, GTK_TYPE_BOX)

// ---- key frames --------------------------------------------------------------------------------

static double shown_time(StudioTimeStrip *strip) {
    return strip->is_moved ? gtk_range_get_value(GTK_RANGE(strip->scale)) : strip->said;
}

static uint32_t keyed_element(StudioTimeStrip *strip) {
    return studio_place_find(studio_document_contents(strip->document), strip->keyed);
}

static void show_keys(StudioTimeStrip *strip) {
    uint32_t element = strip->keyed == NULL ? FR_NONE : keyed_element(strip);
    GArray *times = element == FR_NONE ? g_array_new(FALSE, FALSE, sizeof(double))
                                       : studio_key_ages(strip->document, element);
    if (element != FR_NONE) {
        strip->clock = studio_clock_of(strip->document, element);
        strip->said = studio_clock_shown(strip->document, element);
    }
    for (guint i = 0; i < times->len; i++) {
        double *time = &g_array_index(times, double, i);
        *time = (*time - strip->clock.offset) / strip->clock.scale;
    }
    StudioKeyTrack *track = STUDIO_KEY_TRACK(strip->track);
    double now = shown_time(strip), span = gtk_spin_button_get_value(GTK_SPIN_BUTTON(strip->span));
    studio_key_track_show(track, times, now, span, inset);
    bool has_keys = times->len > 0;
    gtk_widget_set_visible(strip->track, has_keys);
    gtk_widget_set_visible(strip->before, has_keys);
    gtk_widget_set_visible(strip->after, has_keys);
    gtk_widget_set_sensitive(strip->before, !isnan(studio_key_track_next(track, now, -1)));
    gtk_widget_set_sensitive(strip->after, !isnan(studio_key_track_next(track, now, 1)));
    g_array_unref(times);
}

static void go_to_time(StudioTimeStrip *strip, double time) {
    GtkSpinButton *span = GTK_SPIN_BUTTON(strip->span);
    if (time > gtk_spin_button_get_value(span)) {
        gtk_spin_button_set_value(span, ceil(time));
    }
    bool is_there = gtk_range_get_value(GTK_RANGE(strip->scale)) == time;
    gtk_range_set_value(GTK_RANGE(strip->scale), time);
    if (is_there && !strip->is_moved) { // the clock shows what the document says, not this
        g_signal_emit_by_name(strip->scale, "value-changed");
    }
}

static void on_go(StudioKeyTrack *track, double time, StudioTimeStrip *strip) {
    (void)track;
    go_to_time(strip, time);
}

static void on_move(StudioKeyTrack *track, double from, double to, StudioTimeStrip *strip) {
    uint32_t element = keyed_element(strip);
    if (element == FR_NONE) {
        return;
    }
    StudioClock clock = strip->clock;
    double age = clock.scale * to + clock.offset;
    char *key = g_strdup_printf("keys %u", strip->drags);
    if (studio_move_keys(strip->document, element, clock.scale * from + clock.offset, &age, key)) {
        studio_key_track_hold(track, (age - clock.offset) / clock.scale);
    }
    g_free(key);
}

static void on_dropped(StudioKeyTrack *track, StudioTimeStrip *strip) {
    (void)track;
    strip->drags++;
    studio_document_seal(strip->document);
}

static void on_remove(StudioKeyTrack *track, double time, StudioTimeStrip *strip) {
    (void)track;
    uint32_t element = keyed_element(strip);
    if (element != FR_NONE) {
        studio_remove_keys(strip->document, element,
                           strip->clock.scale * time + strip->clock.offset);
    }
}

static void go_to_key(StudioTimeStrip *strip, int direction) {
    double next =
        studio_key_track_next(STUDIO_KEY_TRACK(strip->track), shown_time(strip), direction);
    if (!isnan(next)) {
        go_to_time(strip, next);
    }
}

static void on_before(GtkButton *button, StudioTimeStrip *strip) {
    (void)button;
    go_to_key(strip, -1);
}

static void on_after(GtkButton *button, StudioTimeStrip *strip) {
    (void)button;
    go_to_key(strip, 1);
}

// ---- the clock ---------------------------------------------------------------------------------

static void show_years(StudioTimeStrip *strip) {
    double years = gtk_range_get_value(GTK_RANGE(strip->scale));
    char *text = strip->is_moved ? g_strdup_printf("%.2f years", years) : g_strdup("as written");
    gtk_label_set_text(GTK_LABEL(strip->years), text);
    gtk_widget_set_sensitive(strip->back, strip->is_moved);
    show_keys(strip);
    g_free(text);
}

static void on_scale(GtkRange *range, StudioTimeStrip *strip) {
    if (!strip->is_showing) {
        strip->is_moved = TRUE;
        show_years(strip);
        g_signal_emit(strip, time_signal, 0, gtk_range_get_value(range));
    }
}

static void stop(StudioTimeStrip *strip) {
    strip->is_running = FALSE;
    gtk_button_set_icon_name(GTK_BUTTON(strip->play), "media-playback-start-symbolic");
    gtk_button_set_icon_name(GTK_BUTTON(strip->grow), "media-playback-start-symbolic");
}

static void show_said(StudioTimeStrip *strip) {
    stop(strip);
    strip->is_moved = FALSE;
    strip->is_showing = TRUE;
    gtk_range_set_value(GTK_RANGE(strip->scale), 0);
    strip->is_showing = FALSE;
    show_years(strip);
}

void studio_time_strip_reset(StudioTimeStrip *strip) {
    g_clear_pointer(&strip->keyed, g_free);
    show_said(strip);
}

static void on_back(GtkButton *button, StudioTimeStrip *strip) {
    (void)button;
    show_said(strip);
    g_signal_emit(strip, time_signal, 0, NAN);
}

static void on_span(GtkSpinButton *spin, StudioTimeStrip *strip) {
    double span = gtk_spin_button_get_value(spin);
    gtk_range_set_range(GTK_RANGE(strip->scale), 0, span);
    gtk_range_set_increments(GTK_RANGE(strip->scale), span / 100, span / 10);
    show_keys(strip);
}

static void go_to_step(StudioTimeStrip *strip, uint64_t step) {
    g_signal_emit(strip, step_signal, 0, (gint64)step);
}

void studio_time_strip_continue(StudioTimeStrip *strip) {
    if (!strip->is_running) {
        return;
    }
    if (strip->is_growing) {
        if (strip->step >= strip->step_count) {
            stop(strip);
        } else {
            go_to_step(strip, strip->step + 1);
        }
        return;
    }
    double span = gtk_spin_button_get_value(GTK_SPIN_BUTTON(strip->span));
    double next = gtk_range_get_value(GTK_RANGE(strip->scale)) + span / FRAMES;
    if (next >= span) {
        stop(strip);
    }
    gtk_range_set_value(GTK_RANGE(strip->scale), fmin(next, span));
}

static void on_play(GtkButton *button, StudioTimeStrip *strip) {
    if (strip->is_running) {
        stop(strip);
        return;
    }
    double span = gtk_spin_button_get_value(GTK_SPIN_BUTTON(strip->span));
    if (gtk_range_get_value(GTK_RANGE(strip->scale)) >= span) {
        gtk_range_set_value(GTK_RANGE(strip->scale), 0);
    }
    strip->is_running = TRUE;
    gtk_button_set_icon_name(button, "media-playback-pause-symbolic");
    studio_time_strip_continue(strip);
}

// ---- growth bud by bud -------------------------------------------------------------------------

static void on_grow(GtkButton *button, StudioTimeStrip *strip) {
    if (strip->is_running) {
        stop(strip);
        return;
    }
    strip->is_running = TRUE;
    gtk_button_set_icon_name(button, "media-playback-pause-symbolic");
    go_to_step(strip, strip->step >= strip->step_count ? 0 : strip->step + 1);
}

static void on_one_step(GtkButton *button, StudioTimeStrip *strip) {
    (void)button;
    stop(strip);
    go_to_step(strip, strip->step + 1);
}

static void on_step_back(GtkButton *button, StudioTimeStrip *strip) {
    (void)button;
    stop(strip);
    if (strip->step > 0) {
        go_to_step(strip, strip->step - 1);
    }
}

static void on_begin(GtkButton *button, StudioTimeStrip *strip) {
    (void)button;
    stop(strip);
    go_to_step(strip, 0);
}

void studio_time_strip_show_growth(StudioTimeStrip *strip, uint64_t step, uint64_t count) {
    strip->is_growing = TRUE;
    strip->step = step;
    strip->step_count = count;
    char *text =
        step > count // farther than the document goes by itself
            ? g_strdup_printf("Step %" G_GUINT64_FORMAT, step)
            : g_strdup_printf("Step %" G_GUINT64_FORMAT " of %" G_GUINT64_FORMAT, step, count);
    gtk_label_set_text(GTK_LABEL(strip->grown), text);
    gtk_widget_set_sensitive(strip->undo, step > 0);
    gtk_widget_set_sensitive(strip->begin, step > 0);
    gtk_stack_set_visible_child_name(GTK_STACK(strip->stack), "growth");
    g_free(text);
}

static GtkWidget *make_growth(StudioTimeStrip *strip) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    strip->begin = studio_bar_button(box, "media-skip-backward-symbolic", "Back to the seeds",
                                     G_CALLBACK(on_begin), strip);
    strip->undo = studio_bar_button(box, "media-seek-backward-symbolic", "A step back",
                                    G_CALLBACK(on_step_back), strip);
    strip->grow = studio_bar_button(box, "media-playback-start-symbolic", "Grow or pause",
                                    G_CALLBACK(on_grow), strip);
    studio_bar_button(box, "media-seek-forward-symbolic", "A step", G_CALLBACK(on_one_step), strip);
    strip->grown = gtk_label_new("");
    gtk_widget_add_css_class(strip->grown, "numeric");
    gtk_widget_set_margin_start(strip->grown, 8);
    gtk_box_append(GTK_BOX(box), strip->grown);
    return box;
}

// ---- steps -------------------------------------------------------------------------------------

static void on_steps(GtkSpinButton *spin, StudioTimeStrip *strip) {
    uint32_t element = studio_place_find(studio_document_contents(strip->document), strip->lsystem);
    if (!strip->is_showing && element != FR_NONE) {
        char text[16];
        g_snprintf(text, sizeof text, "%d", gtk_spin_button_get_value_as_int(spin));
        studio_set(strip->document, element, "steps", text, true);
    }
}

static const char as_said[] = "as its text says";

static gboolean on_steps_output(GtkSpinButton *spin, gpointer data) {
    (void)data;
    bool is_said = gtk_spin_button_get_value_as_int(spin) < 0;
    if (is_said && strcmp(gtk_editable_get_text(GTK_EDITABLE(spin)), as_said) != 0) {
        gtk_editable_set_text(GTK_EDITABLE(spin), as_said);
    }
    return is_said;
}

static int on_steps_input(GtkSpinButton *spin, double *value, gpointer data) {
    (void)data;
    const char *text = gtk_editable_get_text(GTK_EDITABLE(spin));
    bool is_said = *text == '\0' || strcmp(text, as_said) == 0;
    *value = -1;
    return is_said; // numbers are read as ever
}

static void show_steps(StudioTimeStrip *strip, uint32_t element) {
    char *steps = fr_contents_get(studio_document_contents(strip->document), element, "steps");
    double value = -1;
    gboolean is_given = steps != NULL && studio_value_is_number(steps, &value);
    strip->is_showing = TRUE;
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(strip->steps), is_given ? value : -1);
    strip->is_showing = FALSE;
    g_free(steps);
}

void studio_time_strip_show(StudioTimeStrip *strip, StudioDocument *document, uint32_t plant,
                            uint32_t selected) {
    const FrContents *contents = studio_document_contents(document);
    strip->document = document;
    g_free(strip->keyed);
    strip->keyed = plant != FR_NONE && studio_has_keys(document, selected)
                       ? studio_place_of(contents, selected)
                       : NULL;
    show_keys(strip);
    uint32_t element = plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "lsystem");
    g_free(strip->lsystem);
    strip->lsystem = element == FR_NONE ? NULL : studio_place_of(contents, element);
    if (element != FR_NONE) {
        show_steps(strip, element);
    }
    gtk_widget_set_visible(GTK_WIDGET(strip), plant != FR_NONE);
    bool is_species = plant != FR_NONE && fr_contents_child(contents, plant, "species") != FR_NONE;
    if (!is_species) {
        strip->is_growing = FALSE;
    }
    gtk_stack_set_visible_child_name(GTK_STACK(strip->stack), is_species           ? "growth"
                                                              : element != FR_NONE ? "steps"
                                                                                   : "clock");
}

// ---- life --------------------------------------------------------------------------------------

static GtkWidget *key_button(StudioTimeStrip *strip, const char *icon, const char *tip,
                             GCallback callback) {
    GtkWidget *button = studio_flat_button(icon, tip);
    gtk_widget_set_name(button, tip);
    gtk_widget_set_visible(button, FALSE);
    g_signal_connect(button, "clicked", callback, strip);
    return button;
}

static GtkWidget *make_track(StudioTimeStrip *strip) {
    strip->before =
        key_button(strip, "go-previous-symbolic", "The key before", G_CALLBACK(on_before));
    strip->after = key_button(strip, "go-next-symbolic", "The next key", G_CALLBACK(on_after));
    strip->track = studio_key_track_new();
    gtk_widget_set_name(strip->track, "keys");
    gtk_widget_set_visible(strip->track, FALSE);
    g_signal_connect(strip->track, "go", G_CALLBACK(on_go), strip);
    g_signal_connect(strip->track, "move", G_CALLBACK(on_move), strip);
    g_signal_connect(strip->track, "dropped", G_CALLBACK(on_dropped), strip);
    g_signal_connect(strip->track, "remove", G_CALLBACK(on_remove), strip);
    return strip->track;
}

static GtkWidget *make_clock(StudioTimeStrip *strip) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    strip->play = studio_flat_button("media-playback-start-symbolic", "Let the clock run");
    g_signal_connect(strip->play, "clicked", G_CALLBACK(on_play), strip);
    strip->scale = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, 0, 10, 0.1);
    gtk_scale_set_draw_value(GTK_SCALE(strip->scale), FALSE);
    gtk_widget_set_hexpand(strip->scale, TRUE);
    gtk_widget_set_name(strip->scale, "clock");
    studio_name(strip->scale, "Time of the plants in years");
    g_signal_connect(strip->scale, "value-changed", G_CALLBACK(on_scale), strip);
    strip->years = gtk_label_new("");
    gtk_label_set_width_chars(GTK_LABEL(strip->years), 11);
    gtk_widget_add_css_class(strip->years, "numeric");
    strip->span = gtk_spin_button_new_with_range(1, 1000, 1);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(strip->span), 10);
    gtk_editable_set_width_chars(GTK_EDITABLE(strip->span), 3);
    studio_tell(strip->span, "Years from end to end");
    g_signal_connect(strip->span, "value-changed", G_CALLBACK(on_span), strip);
    strip->back = studio_flat_button("edit-clear-symbolic", "Show the time that the document says");
    g_signal_connect(strip->back, "clicked", G_CALLBACK(on_back), strip);
    GtkWidget *line = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_widget_set_hexpand(line, TRUE);
    gtk_widget_set_size_request(line, 60, -1);
    gtk_box_append(GTK_BOX(line), make_track(strip));
    gtk_box_append(GTK_BOX(line), strip->scale);
    GtkWidget *parts[] = {strip->play,  strip->before, line,       strip->after,
                          strip->years, strip->back,   strip->span};
    for (size_t i = 0; i < G_N_ELEMENTS(parts); i++) {
        gtk_widget_set_valign(parts[i], GTK_ALIGN_CENTER);
        gtk_box_append(GTK_BOX(box), parts[i]);
    }
    return box;
}

static GtkWidget *make_steps(StudioTimeStrip *strip) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkWidget *name = gtk_label_new("Steps of the L-system");
    strip->steps = gtk_spin_button_new_with_range(-1, 100000, 1);
    gtk_widget_set_tooltip_text(strip->steps,
                                "Below 0, or with nothing in it: as many as its text says");
    gtk_spin_button_set_numeric(GTK_SPIN_BUTTON(strip->steps), FALSE); // words are shown, too
    gtk_editable_set_width_chars(GTK_EDITABLE(strip->steps), (int)strlen(as_said));
    gtk_widget_set_name(strip->steps, "steps");
    g_signal_connect(strip->steps, "input", G_CALLBACK(on_steps_input), NULL);
    g_signal_connect(strip->steps, "output", G_CALLBACK(on_steps_output), NULL);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(strip->steps), -1);
    gtk_spin_button_update(GTK_SPIN_BUTTON(strip->steps));
    studio_name(strip->steps, "Steps of the L-system");
    g_signal_connect(strip->steps, "value-changed", G_CALLBACK(on_steps), strip);
    gtk_box_append(GTK_BOX(box), name);
    gtk_box_append(GTK_BOX(box), strip->steps);
    return box;
}

static void studio_time_strip_finalize(GObject *object) {
    g_free(STUDIO_TIME_STRIP(object)->keyed);
    g_free(STUDIO_TIME_STRIP(object)->lsystem);
    G_OBJECT_CLASS(studio_time_strip_parent_class)->finalize(object);
}

static void studio_time_strip_class_init(StudioTimeStripClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_time_strip_finalize;
    time_signal = g_signal_new("time", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                               NULL, G_TYPE_NONE, 1, G_TYPE_DOUBLE);
    step_signal = g_signal_new("step", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                               NULL, G_TYPE_NONE, 1, G_TYPE_INT64);
}

static void studio_time_strip_init(StudioTimeStrip *strip) {
    strip->clock.scale = 1;
    strip->stack = gtk_stack_new();
    gtk_widget_set_hexpand(strip->stack, TRUE);
    gtk_stack_add_named(GTK_STACK(strip->stack), make_clock(strip), "clock");
    gtk_stack_add_named(GTK_STACK(strip->stack), make_steps(strip), "steps");
    gtk_stack_add_named(GTK_STACK(strip->stack), make_growth(strip), "growth");
    gtk_box_append(GTK_BOX(strip), strip->stack);
    gtk_widget_add_css_class(GTK_WIDGET(strip), "time-strip");
    show_years(strip);
}

GtkWidget *studio_time_strip_new(void) {
    return g_object_new(STUDIO_TYPE_TIME_STRIP, NULL);
}
