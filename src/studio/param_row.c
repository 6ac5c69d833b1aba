#include "studio/param_row.h"

#include "studio/accessible.h"
#include "studio/curve_box.h"
#include "studio/curve_menu.h"
#include "studio/model/keys.h"
#include "studio/model/materials.h"
#include "studio/model/values.h"
#include "studio/short_entry.h"
#include "studio/widgets.h"

#include <math.h>
#include <string.h>

enum { SIGNAL_SET, SIGNAL_SEALED, SIGNAL_FOLLOW, SIGNAL_KEY, SIGNAL_UNKEY, SIGNAL_COUNT };

struct _StudioParamRow {
    GtkBox parent;
    const FrParam *param;
    char *attribute, *value; // `value` NULL: not given
    gboolean is_showing;     // signals of widgets are our own doing
    GtkWidget *name, *entry, *scale, *toggle, *choice, *colour, *reset, *curve, *offer, *note, *key;
    double age; // of key frames; NAN: none
    gboolean has_keys, is_at_key;
    int curve_kind; // FrCurveKind
};

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioParamRow, studio_param_row, GTK_TYPE_BOX)

static void set(StudioParamRow *row, const char *value, gboolean is_drag) {
    if (!row->is_showing) {
        g_signal_emit(row, signals[SIGNAL_SET], 0, value, is_drag);
    }
}

// ---- what the user does ------------------------------------------------------------------------

static void commit_entry(StudioParamRow *row) {
    const char *text = studio_short_entry_text(row->entry);
    const char *shown = row->value != NULL ? row->value : row->param->default_text;
    double value;
    if (row->is_showing || strcmp(text, shown) == 0) {
        return;
    }
    if (row->has_keys && studio_value_is_number(text, &value)) {
        g_signal_emit(row, signals[SIGNAL_KEY], 0, value, FALSE);
    } else {
        set(row, *text == '\0' ? NULL : text, FALSE);
    }
}

static void on_activate(GtkEntry *entry, StudioParamRow *row) {
    (void)entry;
    commit_entry(row);
}

static void on_leave(GtkEventControllerFocus *focus, StudioParamRow *row) {
    (void)focus;
    commit_entry(row);
}

static gboolean on_slide(GtkRange *range, GtkScrollType scroll, double value, StudioParamRow *row) {
    (void)scroll;
    GtkAdjustment *adjustment = gtk_range_get_adjustment(range);
    double min = gtk_adjustment_get_lower(adjustment), max = gtk_adjustment_get_upper(adjustment);
    char *text = row->param->kind == FR_PARAM_INTEGER
                     ? g_strdup_printf("%.0f", CLAMP(value, min, max))
                     : studio_value_text(CLAMP(value, min, max), max - min);
    if (row->has_keys) {
        g_signal_emit(row, signals[SIGNAL_KEY], 0, g_ascii_strtod(text, NULL), TRUE);
    } else {
        set(row, text, TRUE);
    }
    g_free(text);
    return FALSE;
}

static gboolean on_scale_event(GtkEventControllerLegacy *controller, GdkEvent *event,
                               StudioParamRow *row) {
    (void)controller;
    GdkEventType type = gdk_event_get_event_type(event);
    if (type == GDK_BUTTON_RELEASE || type == GDK_KEY_RELEASE || type == GDK_TOUCH_END) {
        g_signal_emit(row, signals[SIGNAL_SEALED], 0);
        studio_param_row_show(row, row->value); // the range goes by the new value now
    }
    return FALSE;
}

static void on_toggle(GtkSwitch *toggle, GParamSpec *spec, StudioParamRow *row) {
    (void)spec;
    set(row, gtk_switch_get_active(toggle) ? "yes" : "no", FALSE);
}

static void on_choice(GtkDropDown *choice, GParamSpec *spec, StudioParamRow *row) {
    (void)spec;
    GtkStringObject *item = gtk_drop_down_get_selected_item(choice);
    if (item != NULL) {
        set(row, gtk_string_object_get_string(item), FALSE);
    }
}

static void on_colour(GtkColorButton *button, StudioParamRow *row) {
    GdkRGBA colour;
    gtk_color_chooser_get_rgba(GTK_COLOR_CHOOSER(button), &colour);
    char text[8];
    g_snprintf(text, sizeof text, "#%02x%02x%02x", (unsigned)(colour.red * 255 + 0.5f),
               (unsigned)(colour.green * 255 + 0.5f), (unsigned)(colour.blue * 255 + 0.5f));
    set(row, text, FALSE);
}

static void on_reset(GtkButton *button, StudioParamRow *row) {
    (void)button;
    set(row, NULL, FALSE);
}

static void on_key(GtkButton *button, StudioParamRow *row) {
    (void)button;
    if (row->is_at_key) {
        g_signal_emit(row, signals[SIGNAL_UNKEY], 0);
    } else {
        g_signal_emit(row, signals[SIGNAL_KEY], 0, NAN, FALSE);
    }
}

static void on_dice(GtkButton *button, StudioParamRow *row) {
    (void)button;
    char text[16];
    g_snprintf(text, sizeof text, "%d", g_random_int_range(1, 1000000));
    set(row, text, FALSE);
}

static void on_curve(StudioCurveBox *box, const char *points, gboolean is_drag,
                     StudioParamRow *row) {
    (void)box;
    set(row, points, TRUE);
    if (!is_drag) {
        g_signal_emit(row, signals[SIGNAL_SEALED], 0);
    }
}

static void on_follow(GtkButton *button, StudioParamRow *row) {
    (void)button;
    if (row->value != NULL) {
        g_signal_emit(row, signals[SIGNAL_FOLLOW], 0, row->value);
    }
}

// ---- its parts ---------------------------------------------------------------------------------

static GtkWidget *make_entry(StudioParamRow *row) {
    row->entry = studio_short_entry_new();
    gtk_editable_set_width_chars(GTK_EDITABLE(row->entry), 10);
    gtk_editable_set_max_width_chars(GTK_EDITABLE(row->entry), 10);
    gtk_entry_set_alignment(GTK_ENTRY(row->entry), 1);
    gtk_widget_set_valign(row->entry, GTK_ALIGN_CENTER);
    g_signal_connect(row->entry, "activate", G_CALLBACK(on_activate), row);
    GtkEventController *focus = gtk_event_controller_focus_new();
    g_signal_connect(focus, "leave", G_CALLBACK(on_leave), row);
    gtk_widget_add_controller(row->entry, focus);
    return row->entry;
}

static GtkWidget *make_choice(StudioParamRow *row) {
    char **names = g_strsplit(row->param->choices, " ", -1);
    row->choice = gtk_drop_down_new_from_strings((const char *const *)names);
    g_strfreev(names);
    gtk_widget_set_valign(row->choice, GTK_ALIGN_CENTER);
    g_signal_connect(row->choice, "notify::selected", G_CALLBACK(on_choice), row);
    return row->choice;
}

static GtkWidget *make_value(StudioParamRow *row) {
    switch (row->param->kind) {
    case FR_PARAM_SWITCH:
        row->toggle = gtk_switch_new();
        gtk_widget_set_valign(row->toggle, GTK_ALIGN_CENTER);
        g_signal_connect(row->toggle, "notify::active", G_CALLBACK(on_toggle), row);
        return row->toggle;
    case FR_PARAM_CHOICE:
        return make_choice(row);
    case FR_PARAM_COLOUR:
        row->colour = gtk_color_button_new();
        gtk_widget_set_valign(row->colour, GTK_ALIGN_CENTER);
        g_signal_connect(row->colour, "color-set", G_CALLBACK(on_colour), row);
        return row->colour;
    default:
        return make_entry(row);
    }
}

static void make_scale(StudioParamRow *row) {
    row->scale = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, 0, 1, 0.01);
    gtk_scale_set_draw_value(GTK_SCALE(row->scale), FALSE);
    gtk_widget_add_css_class(row->scale, "row-scale");
    g_signal_connect(row->scale, "change-value", G_CALLBACK(on_slide), row);
    // The scale has the pointer for itself; this one only watches for its release.
    GtkEventController *watch = gtk_event_controller_legacy_new();
    gtk_event_controller_set_propagation_phase(watch, GTK_PHASE_CAPTURE);
    g_signal_connect(watch, "event", G_CALLBACK(on_scale_event), row);
    gtk_widget_add_controller(row->scale, watch);
    gtk_box_append(GTK_BOX(row), row->scale);
}

static bool names_something(const FrParam *param) {
    return param->kind == FR_PARAM_CURVE || studio_names_material(param);
}

// The name, and buttons for what is done to the value.
static GtkWidget *make_line(StudioParamRow *row, const char *title) {
    GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    row->name = gtk_label_new(title);
    gtk_label_set_xalign(GTK_LABEL(row->name), 0);
    gtk_label_set_wrap(GTK_LABEL(row->name), TRUE);
    gtk_widget_set_hexpand(row->name, TRUE);
    gtk_box_append(GTK_BOX(line), row->name);
    row->reset = studio_row_button("edit-undo-symbolic", "Back to the default");
    g_signal_connect(row->reset, "clicked", G_CALLBACK(on_reset), row);
    gtk_box_append(GTK_BOX(line), row->reset);
    // When it lives says what its age is: that cannot go by its age.
    bool is_of_life =
        strcmp(row->param->name, "birth") == 0 || strcmp(row->param->name, "time_scale") == 0;
    if (row->param->kind == FR_PARAM_NUMBER && !is_of_life) {
        row->key = studio_row_button("studio-key-symbolic", "Set a key frame at this time");
        gtk_widget_add_css_class(row->key, "key-button");
        char *name = g_strconcat(row->attribute, "-key", NULL);
        gtk_widget_set_name(row->key, name);
        g_free(name);
        g_signal_connect(row->key, "clicked", G_CALLBACK(on_key), row);
        gtk_box_append(GTK_BOX(line), row->key);
    }
    if (names_something(row->param)) {
        row->offer = studio_row_button("go-jump-symbolic", "Show what it names");
        g_signal_connect(row->offer, "clicked", G_CALLBACK(on_follow), row);
        gtk_box_append(GTK_BOX(line), row->offer);
    }
    if (strcmp(row->param->name, "seed") == 0) {
        GtkWidget *dice = studio_row_button("studio-dice-symbolic", "Another seed");
        g_signal_connect(dice, "clicked", G_CALLBACK(on_dice), row);
        gtk_box_append(GTK_BOX(line), dice);
    }
    gtk_box_append(GTK_BOX(row), line);
    return line;
}

static void make_below(StudioParamRow *row, const char *title) {
    const FrParam *param = row->param;
    bool is_number = param->kind == FR_PARAM_NUMBER || param->kind == FR_PARAM_REAL ||
                     param->kind == FR_PARAM_INTEGER;
    if (is_number && strcmp(param->name, "seed") != 0) {
        make_scale(row);
        char *name = g_strconcat(row->attribute, "-scale", NULL);
        gtk_widget_set_name(row->scale, name);
        studio_name(row->scale, title);
        g_free(name);
    }
    if (param->kind == FR_PARAM_CURVE || param->kind == FR_PARAM_POINTS) {
        row->curve = studio_curve_box_new(param->kind == FR_PARAM_CURVE ||
                                          strcmp(param->name, "points") == 0);
        char *name = g_strconcat(row->attribute, "-curve", NULL);
        gtk_widget_set_name(row->curve, name);
        studio_name(row->curve, title);
        g_free(name);
        g_signal_connect(row->curve, "edited", G_CALLBACK(on_curve), row);
        gtk_box_append(GTK_BOX(row), row->curve);
        GtkWidget *menu = studio_curve_menu_new(STUDIO_CURVE_BOX(row->curve));
        name = g_strconcat(row->attribute, "-menu", NULL);
        gtk_widget_set_name(menu, name);
        g_free(name);
        studio_param_row_put(row, menu);
    }
    row->note = gtk_label_new(NULL);
    gtk_label_set_xalign(GTK_LABEL(row->note), 0);
    gtk_label_set_wrap(GTK_LABEL(row->note), TRUE);
    gtk_widget_add_css_class(row->note, "row-note");
    gtk_widget_set_visible(row->note, FALSE);
    gtk_box_append(GTK_BOX(row), row->note);
}

static void fill(StudioParamRow *row) {
    char *title = g_strdelimit(g_strdup(row->param->name), "_", ' ');
    title[0] = g_ascii_toupper(title[0]);
    GtkWidget *line = make_line(row, title);
    GtkWidget *value = make_value(row);
    gtk_widget_set_name(value, row->attribute);
    studio_name(value, title);
    studio_describe(value, row->param->meaning);
    gtk_box_append(GTK_BOX(line), value);
    GtkWidget *unit = gtk_label_new(strcmp(row->param->unit, "deg") == 0 ? "°" : row->param->unit);
    gtk_widget_add_css_class(unit, "dim-label");
    gtk_label_set_width_chars(GTK_LABEL(unit), 2);
    gtk_label_set_xalign(GTK_LABEL(unit), 0);
    gtk_box_append(GTK_BOX(line), unit);
    make_below(row, title);
    char *tip = studio_value_tip(row->param);
    gtk_widget_set_tooltip_text(GTK_WIDGET(row), tip);
    g_free(tip);
    g_free(title);
}

// ---- showing -----------------------------------------------------------------------------------

// What can be done about key frames now; `*value` receives what they say at the age.
static void show_key(StudioParamRow *row, const char *text, double *value) {
    StudioKeys keys;
    double plain;
    bool may = row->key != NULL && !isnan(row->age) && studio_keys_read(text, &keys, &plain);
    row->has_keys = may && keys.points->len > 0;
    row->is_at_key = may && studio_keys_find(&keys, row->age) != FR_NONE;
    *value = row->has_keys ? studio_keys_value(&keys, row->age) : NAN;
    if (may) {
        studio_keys_clear(&keys);
    }
    if (row->key == NULL) {
        return;
    }
    const char *tip =
        row->is_at_key ? "Remove the key frame at this time" : "Set a key frame at this time";
    gtk_widget_set_visible(row->key, may);
    gtk_button_set_icon_name(GTK_BUTTON(row->key),
                             row->is_at_key ? "studio-key-set-symbolic" : "studio-key-symbolic");
    studio_tell(row->key, tip);
    if (row->has_keys) {
        gtk_widget_add_css_class(row->key, "keyed");
    } else {
        gtk_widget_remove_css_class(row->key, "keyed");
    }
}

static void show_scale(StudioParamRow *row, const char *text, double keyed) {
    double value = keyed;
    bool is_number = !isnan(keyed) || studio_value_is_number(text, &value);
    gtk_widget_set_visible(row->scale, is_number);
    if (!is_number) {
        return;
    }
    GtkAdjustment *adjustment = gtk_range_get_adjustment(GTK_RANGE(row->scale));
    bool is_held = (gtk_widget_get_state_flags(row->scale) & GTK_STATE_FLAG_ACTIVE) != 0;
    double min = gtk_adjustment_get_lower(adjustment), max = gtk_adjustment_get_upper(adjustment);
    if (!is_held) {
        studio_value_range(row->param, value, &min, &max);
    }
    double step = studio_value_step(row->param, min, max);
    gtk_adjustment_configure(adjustment, value, min, max, step, 10 * step, 0);
}

static void show_choice(StudioParamRow *row, const char *text) {
    char **names = g_strsplit(row->param->choices, " ", -1);
    for (guint i = 0; names[i] != NULL; i++) {
        if (strcmp(names[i], text) == 0) {
            gtk_drop_down_set_selected(GTK_DROP_DOWN(row->choice), i);
        }
    }
    g_strfreev(names);
}

void studio_param_row_show(StudioParamRow *row, const char *value) {
    char *own = g_strdup(value);
    g_free(row->value);
    row->value = own;
    const char *text = own != NULL ? own : row->param->default_text;
    row->is_showing = TRUE;
    gtk_widget_set_opacity(row->reset, own != NULL ? 1 : 0);
    gtk_widget_set_can_target(row->reset, own != NULL);
    gtk_widget_set_can_focus(row->reset, own != NULL);
    if (own != NULL) {
        gtk_widget_add_css_class(GTK_WIDGET(row), "given");
    } else {
        gtk_widget_remove_css_class(GTK_WIDGET(row), "given");
    }
    if (row->entry != NULL) {
        studio_short_entry_show(row->entry, text);
    }
    double keyed;
    show_key(row, text, &keyed);
    if (row->scale != NULL) {
        show_scale(row, text, keyed);
    }
    if (row->toggle != NULL) {
        gtk_switch_set_active(GTK_SWITCH(row->toggle), strcmp(text, "yes") == 0);
    }
    if (row->choice != NULL) {
        show_choice(row, text);
    }
    GdkRGBA colour;
    if (row->colour != NULL && gdk_rgba_parse(&colour, text)) {
        gtk_color_chooser_set_rgba(GTK_COLOR_CHOOSER(row->colour), &colour);
    }
    if (row->curve != NULL) {
        GArray *points = studio_points_read(text);
        gtk_widget_set_visible(row->curve, points != NULL);
        studio_curve_box_show(STUDIO_CURVE_BOX(row->curve), text, row->curve_kind);
        g_clear_pointer(&points, g_array_unref);
    }
    if (row->offer != NULL) {
        gtk_widget_set_visible(row->offer, own != NULL && *own != '\0' && strchr(own, ',') == NULL);
    }
    row->is_showing = FALSE;
}

void studio_param_row_set_age(StudioParamRow *row, double age) {
    row->age = age;
}

void studio_param_row_set_curve_kind(StudioParamRow *row, int kind) {
    row->curve_kind = kind;
    studio_param_row_show(row, row->value);
}

void studio_param_row_mark(StudioParamRow *row, const char *message, int begin, int end) {
    gtk_widget_set_visible(row->note, message != NULL);
    gtk_label_set_text(GTK_LABEL(row->note), message == NULL ? "" : message);
    if (row->entry == NULL) {
        return;
    }
    PangoAttrList *list = pango_attr_list_new();
    if (message != NULL) {
        PangoAttribute *line = pango_attr_underline_new(PANGO_UNDERLINE_ERROR);
        line->start_index = (guint)MAX(begin, 0);
        line->end_index = end > begin ? (guint)end : G_MAXUINT;
        pango_attr_list_insert(list, line);
        gtk_widget_add_css_class(row->entry, "error");
    } else {
        gtk_widget_remove_css_class(row->entry, "error");
    }
    gtk_entry_set_attributes(GTK_ENTRY(row->entry), list);
    pango_attr_list_unref(list);
}

void studio_param_row_put(StudioParamRow *row, GtkWidget *widget) {
    GtkWidget *line = gtk_widget_get_first_child(GTK_WIDGET(row));
    gtk_box_insert_child_after(GTK_BOX(line), widget, row->name);
}

// ---- asking ------------------------------------------------------------------------------------

const FrParam *studio_param_row_param(StudioParamRow *row) {
    return row->param;
}

const char *studio_param_row_value(StudioParamRow *row) {
    return row->value;
}

const char *studio_param_row_attribute(StudioParamRow *row) {
    return row->attribute;
}

gboolean studio_param_row_is_given(StudioParamRow *row) {
    return row->value != NULL;
}

gboolean studio_param_row_matches(StudioParamRow *row, const char *words) {
    return g_str_match_string(words, row->attribute, TRUE) ||
           g_str_match_string(words, row->param->meaning, TRUE) ||
           strstr(row->attribute, words) != NULL;
}

static void studio_param_row_finalize(GObject *object) {
    g_free(STUDIO_PARAM_ROW(object)->attribute);
    g_free(STUDIO_PARAM_ROW(object)->value);
    G_OBJECT_CLASS(studio_param_row_parent_class)->finalize(object);
}

static void studio_param_row_class_init(StudioParamRowClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_param_row_finalize;
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_SET] = g_signal_new("set", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                       G_TYPE_NONE, 2, G_TYPE_STRING, G_TYPE_BOOLEAN);
    signals[SIGNAL_SEALED] =
        g_signal_new("sealed", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    signals[SIGNAL_FOLLOW] = g_signal_new("follow", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                          G_TYPE_NONE, 1, G_TYPE_STRING);
    signals[SIGNAL_KEY] = g_signal_new("key", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                       G_TYPE_NONE, 2, G_TYPE_DOUBLE, G_TYPE_BOOLEAN);
    signals[SIGNAL_UNKEY] =
        g_signal_new("unkey", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
}

static void studio_param_row_init(StudioParamRow *row) {
    gtk_orientable_set_orientation(GTK_ORIENTABLE(row), GTK_ORIENTATION_VERTICAL);
    gtk_widget_add_css_class(GTK_WIDGET(row), "param-row");
}

GtkWidget *studio_param_row_new(const FrParam *param) {
    StudioParamRow *row = g_object_new(STUDIO_TYPE_PARAM_ROW, NULL);
    row->param = param;
    row->age = NAN;
    row->attribute = fr_param_attribute(param);
    fill(row);
    studio_param_row_show(row, NULL);
    return GTK_WIDGET(row);
}
