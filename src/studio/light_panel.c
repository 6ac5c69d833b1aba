#include "studio/light_panel.h"

#include "studio/accessible.h"
#include "studio/model/lamps.h"
#include "studio/model/light_marks.h"
#include "studio/model/values.h"

#include <math.h>
#include <string.h>

enum { SIGNAL_SELECTED, SIGNAL_SLICE, SIGNAL_PHOTONS, SIGNAL_COUNT };
enum { LEGEND_HEIGHT = 12 };

struct _StudioLightPanel {
    GtkBox parent;
    GtkWidget *list;
    GtkWidget *field, *slice, *slice_row, *slice_at;
    GtkWidget *photons_row, *photons;
    GtkWidget *legend, *legend_row, *top;
    GtkWidget *rays, *cells, *growth, *found;
    const StudioDocument *document;
    uint64_t revision;
    gboolean is_showing; // widgets are set, not moved by hand
};

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioLightPanel, studio_light_panel, GTK_TYPE_BOX)

static const char key[] = "studio-element";

// ---- the list ----------------------------------------------------------------------------------

static void on_row(GtkListBox *list, GtkListBoxRow *row, StudioLightPanel *panel) {
    (void)list;
    if (row != NULL && !panel->is_showing) {
        g_signal_emit(panel, signals[SIGNAL_SELECTED], 0,
                      GPOINTER_TO_UINT(g_object_get_data(G_OBJECT(row), key)));
    }
}

static GtkWidget *action_button(const char *label, const char *action, const char *tip) {
    GtkWidget *button = gtk_button_new_with_label(label);
    gtk_actionable_set_detailed_action_name(GTK_ACTIONABLE(button), action);
    gtk_widget_set_tooltip_text(button, tip);
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    return button;
}

// A row of the list; `more` (may be NULL) stands at its end.
static void add_row(StudioLightPanel *panel, uint32_t element, const char *icon, const char *title,
                    const char *note, GtkWidget *more) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkWidget *name = gtk_label_new(title), *said = gtk_label_new(note);
    gtk_label_set_xalign(GTK_LABEL(name), 0);
    gtk_label_set_ellipsize(GTK_LABEL(name), PANGO_ELLIPSIZE_END);
    gtk_widget_set_hexpand(name, TRUE);
    gtk_widget_add_css_class(said, "dim-label");
    gtk_widget_add_css_class(said, "caption");
    gtk_box_append(GTK_BOX(box), gtk_image_new_from_icon_name(icon));
    gtk_box_append(GTK_BOX(box), name);
    gtk_box_append(GTK_BOX(box), said);
    if (more != NULL) {
        gtk_box_append(GTK_BOX(box), more);
    }
    GtkWidget *row = gtk_list_box_row_new();
    gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
    gtk_list_box_row_set_selectable(GTK_LIST_BOX_ROW(row), element != FR_NONE);
    g_object_set_data(G_OBJECT(row), key, GUINT_TO_POINTER(element));
    char *words = g_strdup_printf("%s, %s", title, note);
    studio_name(row, words);
    g_free(words);
    gtk_list_box_append(GTK_LIST_BOX(panel->list), row);
}

static void add_lamps(StudioLightPanel *panel, StudioDocument *document) {
    static const char *const kinds[] = {"point", "spot", "area"};
    GArray *lamps = studio_lamps(document);
    for (guint i = 0; i < lamps->len; i++) {
        const StudioLamp *lamp = &g_array_index(lamps, StudioLamp, i);
        char *title = studio_lamp_title(document, lamp->element);
        char *power = studio_value_text(lamp->params.power, 100);
        char *note = g_strdup_printf("%s, %s W", kinds[lamp->params.kind], power);
        add_row(panel, lamp->element, "display-brightness-symbolic", title, note, NULL);
        g_free(note);
        g_free(power);
        g_free(title);
    }
    g_array_unref(lamps);
}

static void fill(StudioLightPanel *panel, StudioDocument *document) {
    const FrContents *contents = studio_document_contents(document);
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(panel->list)) != NULL) {
        gtk_list_box_remove(GTK_LIST_BOX(panel->list), child);
    }
    add_lamps(panel, document);
    uint32_t sun = studio_find_in_scene(document, "sun");
    uint32_t light = studio_find_in_scene(document, "light");
    char *date = sun == FR_NONE ? NULL : fr_contents_get(contents, sun, "date");
    add_row(panel, sun != FR_NONE ? sun : fr_contents_child(contents, 0, "scene"),
            "weather-clear-symbolic", "Sun",
            sun == FR_NONE ? "by its angles"
            : date == NULL ? "by date"
                           : date,
            sun == FR_NONE ? action_button("By Date", "win.make-of-scene::sun",
                                           "Let the sun stand by date, time and place")
                           : NULL);
    char *by = light == FR_NONE ? NULL : fr_contents_get(contents, light, "by");
    char *note =
        light == FR_NONE ? g_strdup("none") : g_strdup_printf("by %s", by == NULL ? "views" : by);
    add_row(panel, light, "find-location-symbolic", "Light and probe", note,
            light == FR_NONE ? action_button("Add", "win.make-of-scene::light",
                                             "Let plants sense the light, and place a probe in it")
                             : NULL);
    g_free(note);
    g_free(by);
    g_free(date);
}

void studio_light_panel_show(StudioLightPanel *panel, StudioDocument *document, uint32_t selected) {
    panel->is_showing = TRUE;
    if (panel->document != document || panel->revision != studio_document_revision(document)) {
        fill(panel, document);
        panel->document = document;
        panel->revision = studio_document_revision(document);
    }
    gtk_list_box_unselect_all(GTK_LIST_BOX(panel->list));
    for (int i = 0; selected != FR_NONE; i++) {
        GtkListBoxRow *row = gtk_list_box_get_row_at_index(GTK_LIST_BOX(panel->list), i);
        if (row == NULL) {
            break;
        }
        if (GPOINTER_TO_UINT(g_object_get_data(G_OBJECT(row), key)) == selected) {
            gtk_list_box_select_row(GTK_LIST_BOX(panel->list), row);
        }
    }
    panel->is_showing = FALSE;
}

// ---- what is seen ------------------------------------------------------------------------------

void studio_light_panel_set_wish(StudioLightPanel *panel, const StudioLightWish *wish) {
    bool is_slice = wish->field >= STUDIO_FIELD_X && wish->field <= STUDIO_FIELD_Z;
    panel->is_showing = TRUE;
    gtk_drop_down_set_selected(GTK_DROP_DOWN(panel->field), wish->field);
    gtk_range_set_value(GTK_RANGE(panel->slice), wish->slice);
    gtk_range_set_value(GTK_RANGE(panel->photons), log10(wish->photons));
    gtk_widget_set_visible(panel->slice_row, is_slice);
    gtk_widget_set_visible(panel->photons_row, wish->rays);
    gtk_widget_set_visible(panel->legend_row, wish->field != STUDIO_FIELD_NONE);
    panel->is_showing = FALSE;
}

static char *where_from(const FrLightAnswer *probe) {
    static const char *const sides[] = {"north", "north-east", "east", "south-east",
                                        "south", "south-west", "west", "north-west"};
    double up = asin(CLAMP((double)probe->direction.z, -1, 1)) * 180 / G_PI;
    double azimuth = atan2((double)probe->direction.x, (double)probe->direction.y);
    int side = (int)lround(azimuth / (G_PI / 4));
    return up > 80 ? g_strdup("from above")
                   : g_strdup_printf("%.0f° above the %s", up, sides[(side + 8) % 8]);
}

static void say_found(StudioLightPanel *panel, const StudioSight *sight) {
    GString *text = g_string_new(NULL);
    if (sight->problem != NULL) {
        g_string_append(text, sight->problem);
    }
    if (sight->has_probe) {
        char *from = where_from(&sight->probe);
        g_string_append_printf(text, "At the probe %.3g, %s, confidence %.0f\u00a0%%",
                               (double)sight->probe.intensity, from,
                               100 * (double)sight->probe.confidence);
        g_free(from);
    }
    if (sight->stats.photons > 0) {
        char *photons = studio_count_text(sight->stats.photons);
        char *rays = studio_count_text(sight->stats.rays);
        char *cells = studio_count_text(sight->stats.cells);
        g_string_append_printf(text, "%s%s photons, %s rays, %s cells", text->len > 0 ? "\n" : "",
                               photons, rays, cells);
        g_free(cells);
        g_free(rays);
        g_free(photons);
    }
    gtk_label_set_text(GTK_LABEL(panel->found), text->str);
    gtk_widget_set_visible(panel->found, text->len > 0);
    g_string_free(text, TRUE);
}

void studio_light_panel_set_sight(StudioLightPanel *panel, const StudioSight *sight) {
    const char *tip = sight->has_rays ? NULL : "Only light by=\"density\" keeps rays and cells";
    gtk_widget_set_sensitive(panel->rays, sight->has_rays);
    gtk_widget_set_sensitive(panel->cells, sight->has_rays);
    gtk_widget_set_tooltip_text(gtk_widget_get_parent(panel->rays), tip);
    gtk_widget_set_visible(panel->growth, sight->has_growth);
    char *at = g_strdup_printf("%.2f m", sight->slice_at);
    gtk_label_set_text(GTK_LABEL(panel->slice_at), at);
    g_free(at);
    char *top = sight->top > 0 ? g_strdup_printf("%.3g", sight->top) : g_strdup("");
    gtk_label_set_text(GTK_LABEL(panel->top), top);
    g_free(top);
    say_found(panel, sight);
}

// ---- making it ---------------------------------------------------------------------------------

static void on_field(GtkDropDown *field, GParamSpec *spec, StudioLightPanel *panel) {
    (void)spec;
    static const char *const names[] = {"none", "x", "y", "z", "points", "organs"};
    guint selected = gtk_drop_down_get_selected(field);
    if (!panel->is_showing && selected < G_N_ELEMENTS(names)) {
        gtk_widget_activate_action(GTK_WIDGET(panel), "win.light-field", "s", names[selected]);
    }
}

static void on_slice(GtkRange *range, StudioLightPanel *panel) {
    if (!panel->is_showing) {
        g_signal_emit(panel, signals[SIGNAL_SLICE], 0, gtk_range_get_value(range));
    }
}

static void on_photons(GtkRange *range, StudioLightPanel *panel) {
    if (!panel->is_showing) {
        g_signal_emit(panel, signals[SIGNAL_PHOTONS], 0,
                      (guint)lround(pow(10, gtk_range_get_value(range))));
    }
}

static void draw_legend(GtkDrawingArea *area, cairo_t *cairo, int width, int height,
                        gpointer data) {
    (void)area;
    (void)data;
    for (int x = 0; x < width; x++) {
        float colour[4];
        studio_light_colour(((float)x + 0.5f) / (float)width, 1, colour);
        cairo_set_source_rgb(cairo, (double)colour[0], (double)colour[1], (double)colour[2]);
        cairo_rectangle(cairo, x, 0, 1, height);
        cairo_fill(cairo);
    }
}

static GtkWidget *heading(const char *text) {
    GtkWidget *label = gtk_label_new(text);
    gtk_widget_add_css_class(label, "heading");
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    gtk_widget_set_hexpand(label, TRUE);
    return label;
}

static GtkWidget *make_add(void) {
    GMenu *menu = g_menu_new();
    g_menu_append(menu, "_Point", "win.add-lamp::point");
    g_menu_append(menu, "_Spot", "win.add-lamp::spot");
    g_menu_append(menu, "_Area", "win.add-lamp::area");
    GtkWidget *button = gtk_menu_button_new();
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "list-add-symbolic");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), G_MENU_MODEL(menu));
    gtk_widget_set_tooltip_text(button, "Hang a lamp into the scene");
    studio_name(button, "Add a lamp");
    g_object_unref(menu);
    return button;
}

static GtkWidget *check(GtkWidget *box, const char *label, const char *action, const char *tip) {
    GtkWidget *button = gtk_check_button_new_with_mnemonic(label);
    char **parts = g_strsplit(label, "_", 2); // GTK would have the line below the letter read
    char *name = g_strjoinv("", parts);
    studio_name(button, name);
    g_free(name);
    g_strfreev(parts);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
    gtk_widget_set_tooltip_text(button, tip);
    gtk_box_append(GTK_BOX(box), button);
    return button;
}

static GtkWidget *make_scale(double min, double max, double step, const char *name) {
    GtkWidget *scale = gtk_scale_new_with_range(GTK_ORIENTATION_HORIZONTAL, min, max, step);
    gtk_widget_set_hexpand(scale, TRUE);
    studio_name(scale, name);
    return scale;
}

static GtkWidget *labelled(const char *label, GtkWidget *widget) {
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkWidget *text = gtk_label_new(label);
    gtk_box_append(GTK_BOX(row), text);
    gtk_box_append(GTK_BOX(row), widget);
    return row;
}

static void add_field(StudioLightPanel *panel, GtkWidget *box) {
    static const char *const fields[] = {"Not shown",
                                         "Slice across x",
                                         "Slice across y",
                                         "Slice across z",
                                         "Points of a grid",
                                         "Leaves and tips",
                                         NULL};
    panel->field = gtk_drop_down_new_from_strings(fields);
    gtk_widget_set_name(panel->field, "light-field");
    gtk_widget_set_hexpand(panel->field, TRUE);
    gtk_widget_set_tooltip_text(panel->field, "The light that plants sense, in false colours");
    studio_name(panel->field, "Light in colours");
    g_signal_connect(panel->field, "notify::selected", G_CALLBACK(on_field), panel);
    gtk_box_append(GTK_BOX(box), labelled("Light", panel->field));
    panel->slice = make_scale(0, 1, 0.01, "Where the slice lies");
    gtk_widget_set_name(panel->slice, "light-slice");
    g_signal_connect(panel->slice, "value-changed", G_CALLBACK(on_slice), panel);
    panel->slice_row = labelled("At", panel->slice);
    panel->slice_at = gtk_label_new("");
    gtk_label_set_width_chars(GTK_LABEL(panel->slice_at), 8);
    gtk_box_append(GTK_BOX(panel->slice_row), panel->slice_at);
    gtk_box_append(GTK_BOX(box), panel->slice_row);
    panel->legend = gtk_drawing_area_new();
    gtk_widget_set_hexpand(panel->legend, TRUE);
    gtk_widget_set_valign(panel->legend, GTK_ALIGN_CENTER);
    gtk_drawing_area_set_content_height(GTK_DRAWING_AREA(panel->legend), LEGEND_HEIGHT);
    gtk_drawing_area_set_draw_func(GTK_DRAWING_AREA(panel->legend), draw_legend, NULL, NULL);
    panel->legend_row = labelled("0", panel->legend);
    panel->top = gtk_label_new("");
    gtk_box_append(GTK_BOX(panel->legend_row), panel->top);
    gtk_widget_set_tooltip_text(panel->legend_row, "What the colours stand for");
    gtk_box_append(GTK_BOX(box), panel->legend_row);
}

static void add_shown(StudioLightPanel *panel, GtkWidget *box) {
    gtk_box_append(GTK_BOX(box), heading("Show"));
    check(box, "La_mps and probe", "win.show-lamps", "Marks to see and to drag them by");
    check(box, "The _sun’s path", "win.show-sun",
          "Its way over the day, its hours, where it stands, and the compass");
    GtkWidget *traced = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    panel->rays =
        check(traced, "_Rays", "win.show-rays", "The ways of photons, redder with each bounce");
    panel->photons = make_scale(1, 4.5, 0.1, "Photons whose rays are shown");
    g_signal_connect(panel->photons, "value-changed", G_CALLBACK(on_photons), panel);
    panel->photons_row = labelled("Few to many", panel->photons);
    gtk_box_append(GTK_BOX(traced), panel->photons_row);
    panel->cells = check(traced, "_Cells of the octree", "win.show-cells",
                         "The cells in which rays are looked for, brighter where there are more");
    gtk_box_append(GTK_BOX(box), traced);
    add_field(panel, box);
    panel->growth = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    gtk_box_append(GTK_BOX(panel->growth), heading("Growth"));
    check(panel->growth, "_Buds", "win.show-buds",
          "In the colours of their light, with a line to it; those that sleep are grey");
    check(panel->growth, "_Occupied space", "win.show-voxels",
          "Cells that branches and obstacles fill");
    check(panel->growth, "_Particles", "win.show-particles",
          "Blue where they draw a bud, else black");
    gtk_box_append(GTK_BOX(box), panel->growth);
    panel->found = gtk_label_new("");
    gtk_label_set_wrap(GTK_LABEL(panel->found), TRUE);
    gtk_label_set_xalign(GTK_LABEL(panel->found), 0);
    gtk_widget_add_css_class(panel->found, "dim-label");
    gtk_box_append(GTK_BOX(box), panel->found);
}

static void studio_light_panel_class_init(StudioLightPanelClass *class) {
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_SELECTED] = g_signal_new("selected", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                                            NULL, G_TYPE_NONE, 1, G_TYPE_UINT);
    signals[SIGNAL_SLICE] = g_signal_new("slice", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                         G_TYPE_NONE, 1, G_TYPE_DOUBLE);
    signals[SIGNAL_PHOTONS] = g_signal_new("photons", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                           G_TYPE_NONE, 1, G_TYPE_UINT);
}

static void studio_light_panel_init(StudioLightPanel *panel) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8);
    gtk_widget_add_css_class(box, "light-panel");
    GtkWidget *top = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_box_append(GTK_BOX(top), heading("Lamps"));
    gtk_box_append(GTK_BOX(top), make_add());
    gtk_box_append(GTK_BOX(box), top);
    panel->list = gtk_list_box_new();
    gtk_widget_add_css_class(panel->list, "boxed-list");
    studio_name(panel->list, "Lamps, sun and probe");
    g_signal_connect(panel->list, "row-selected", G_CALLBACK(on_row), panel);
    gtk_box_append(GTK_BOX(box), panel->list);
    add_shown(panel, box);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), box);
    gtk_widget_set_vexpand(scrolled, TRUE);
    gtk_widget_set_hexpand(scrolled, TRUE);
    gtk_box_append(GTK_BOX(panel), scrolled);
    StudioLightWish nothing = {.slice = 0.5, .photons = 200};
    StudioSight unseen = {0};
    studio_light_panel_set_wish(panel, &nothing);
    studio_light_panel_set_sight(panel, &unseen);
}

GtkWidget *studio_light_panel_new(void) {
    return g_object_new(STUDIO_TYPE_LIGHT_PANEL, NULL);
}
