/// How the graph panel looks.
#include "studio/graph_panel_private.h"

#include "studio/accessible.h"

#include <math.h>

enum { ICON = 20 };

typedef enum TextStyle { TEXT_PLAIN, TEXT_BOLD, TEXT_RIGHT } TextStyle;

static void rounded(cairo_t *cairo, double x, double y, double width, double height, double r) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, x + width - r, y + r, r, -G_PI / 2, 0);
    cairo_arc(cairo, x + width - r, y + height - r, r, 0, G_PI / 2);
    cairo_arc(cairo, x + r, y + height - r, r, G_PI / 2, G_PI);
    cairo_arc(cairo, x + r, y + r, r, G_PI, 1.5 * G_PI);
    cairo_close_path(cairo);
}

static void text_at(StudioGraphPanel *panel, cairo_t *cairo, const char *text, double x, double y,
                    double width, double size, TextStyle style) {
    PangoLayout *layout = gtk_widget_create_pango_layout(GTK_WIDGET(panel), text);
    PangoFontDescription *font = pango_font_description_copy(
        pango_context_get_font_description(gtk_widget_get_pango_context(GTK_WIDGET(panel))));
    pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
    if (style == TEXT_BOLD) {
        pango_font_description_set_weight(font, PANGO_WEIGHT_BOLD);
    }
    pango_layout_set_font_description(layout, font);
    if (width > 0) {
        pango_layout_set_width(layout, (int)(width * PANGO_SCALE));
        pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_END);
        pango_layout_set_alignment(layout,
                                   style == TEXT_RIGHT ? PANGO_ALIGN_RIGHT : PANGO_ALIGN_LEFT);
    }
    cairo_move_to(cairo, x, y);
    pango_cairo_show_layout(cairo, layout);
    pango_font_description_free(font);
    g_object_unref(layout);
}

// The line of a wire, or one beside it.
static void draw_line(cairo_t *cairo, const double at[4][2], double aside) {
    enum { PIECES = 24 };
    for (int k = 0; k <= PIECES; k++) {
        double t = (double)k / PIECES, s = 1 - t, point[2], along[2];
        for (int i = 0; i < 2; i++) {
            point[i] = s * s * s * at[0][i] + 3 * s * s * t * at[1][i] + 3 * s * t * t * at[2][i] +
                       t * t * t * at[3][i];
            along[i] = s * s * (at[1][i] - at[0][i]) + 2 * s * t * (at[2][i] - at[1][i]) +
                       t * t * (at[3][i] - at[2][i]);
        }
        double by = aside / fmax(hypot(along[0], along[1]), 1e-6);
        cairo_line_to(cairo, point[0] - by * along[1], point[1] + by * along[0]);
    }
    cairo_stroke(cairo);
}

// Child links are thin, branch links bold, leaf links dashed, and those of a recursion double, as
// in the paper.
static void draw_wire(StudioGraphPanel *panel, cairo_t *cairo, const StudioWire *wire,
                      const GdkRGBA *ink) {
    static const double dashes[] = {5, 4};
    double at[4][2], width = wire->kind == FR_LINK_BRANCH ? 3.2 : 1.3;
    studio_graph_wire_course(panel, wire, at);
    bool is_chosen = wire->element == panel->selected;
    cairo_set_source_rgba(cairo, is_chosen ? 1 : ink->red, is_chosen ? 0.62 : ink->green,
                          is_chosen ? 0.13 : ink->blue, is_chosen ? 1 : 0.6);
    cairo_set_dash(cairo, dashes, wire->kind == FR_LINK_LEAF ? 2 : 0, 0);
    cairo_set_line_width(cairo, wire->is_repeated ? 0.75 * width : width);
    double aside = wire->is_repeated ? 0.375 * width + 1 : 0;
    draw_line(cairo, at, aside);
    if (wire->is_repeated) {
        draw_line(cairo, at, -aside);
    }
    cairo_set_dash(cairo, NULL, 0, 0);
    double dx = at[3][0] - at[2][0], dy = at[3][1] - at[2][1], length = fmax(hypot(dx, dy), 1);
    dx *= 6 / length, dy *= 6 / length;
    cairo_move_to(cairo, at[3][0], at[3][1]);
    cairo_line_to(cairo, at[3][0] - dx - 0.6 * dy, at[3][1] - dy + 0.6 * dx);
    cairo_line_to(cairo, at[3][0] - dx + 0.6 * dy, at[3][1] - dy - 0.6 * dx);
    cairo_fill(cairo);
}

// "207 k", short enough for a box.
static char *short_count(uint64_t count) {
    return count < 1000     ? g_strdup_printf("%" G_GUINT64_FORMAT, count)
           : count < 9950   ? g_strdup_printf("%.1f k", (double)count / 1e3)
           : count < 999500 ? g_strdup_printf("%.0f k", (double)count / 1e3)
                            : g_strdup_printf("%.1f M", (double)count / 1e6);
}

static void draw_second(cairo_t *cairo, const graphene_rect_t *rect, const double colour[3],
                        double strength) {
    rounded(cairo, rect->origin.x + 4, rect->origin.y - 4, rect->size.width, rect->size.height, 7);
    cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], 0.25 * strength);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], 0.5 * strength);
    cairo_set_line_width(cairo, 1);
    cairo_stroke(cairo);
}

static const double amber[3] = {0.93, 0.71, 0.08};

static StudioLoad weight_of(StudioGraphPanel *panel, const StudioBox *box) {
    const Load *load = studio_graph_load(panel, box);
    return load == NULL || !box->is_enabled // what is off makes nothing because it shall not
               ? STUDIO_LOAD_FINE
               : studio_load_of(load->instances, load->seconds, &panel->budget);
}

// What stands below a box's name: how many there are, and how long they take if that can be felt.
// In amber if either is much.
static void draw_count(StudioGraphPanel *panel, cairo_t *cairo, const StudioBox *box,
                       const graphene_rect_t *rect, const GdkRGBA *ink) {
    double scale = studio_graph_scale(panel), strength = box->is_enabled ? 0.6 : 0.24;
    double x = rect->origin.x + 30 * scale, y = rect->origin.y + 18 * scale;
    double width = rect->size.width - 34 * scale;
    const Load *load = studio_graph_load(panel, box);
    bool is_counted = box->is_enabled && load != NULL;
    char *shown = !box->is_enabled ? g_strdup("off")
                  : load == NULL   ? g_strdup(fr_pgraph_table(box->kind)->element)
                                   : short_count(load->instances);
    char *time = is_counted ? studio_time_text(load->seconds) : g_strdup("");
    cairo_set_source_rgba(cairo, ink->red, ink->green, ink->blue, strength);
    if (is_counted && weight_of(panel, box) == STUDIO_LOAD_HEAVY) {
        cairo_set_source_rgb(cairo, amber[0], amber[1], amber[2]);
    }
    text_at(panel, cairo, shown, x, y, width, 11 * scale, TEXT_PLAIN);
    text_at(panel, cairo, time, x, y, width, 11 * scale, TEXT_RIGHT);
    g_free(time);
    g_free(shown);
}

// A box's name, and the mark of one that is heavy.
static void draw_name(StudioGraphPanel *panel, cairo_t *cairo, const StudioBox *box,
                      const graphene_rect_t *rect, const GdkRGBA *ink) {
    double scale = studio_graph_scale(panel), strength = box->is_enabled ? 1 : 0.4;
    double x = rect->origin.x + 30 * scale, y = rect->origin.y + 3 * scale;
    bool is_heavy = weight_of(panel, box) == STUDIO_LOAD_HEAVY;
    double width = rect->size.width - (is_heavy ? 46 : 34) * scale;
    cairo_set_source_rgba(cairo, ink->red, ink->green, ink->blue, strength);
    text_at(panel, cairo, box->id, x, y, width, 12.5 * scale, TEXT_BOLD);
    if (is_heavy) {
        cairo_set_source_rgb(cairo, amber[0], amber[1], amber[2]);
        text_at(panel, cairo, "\u25b2", x, y, rect->size.width - 34 * scale, 11 * scale,
                TEXT_RIGHT);
    }
}

static void fill_ground(cairo_t *cairo, const GdkRGBA *ink) {
    double ground = ink->red > 0.5f ? 0.20 : 0.97; // light ink stands on a dark ground
    cairo_set_source_rgb(cairo, ground, ground, ground + 0.01);
    cairo_fill_preserve(cairo);
}

static void draw_icon(cairo_t *cairo, const StudioBox *box, double x, double y, double size,
                      double strength) {
    double colour[3];
    studio_component_colour(box->kind, colour);
    cairo_save(cairo);
    cairo_translate(cairo, x, y);
    cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], strength);
    studio_component_icon(cairo, box->kind, size);
    cairo_restore(cairo);
}

// The first component of a recursion once more, dim and double, at its end.
static void draw_repeat(StudioGraphPanel *panel, cairo_t *cairo, uint32_t index,
                        const GdkRGBA *ink) {
    const StudioRepeat *repeat = studio_graph_repeat(panel->graph, index);
    const StudioBox *box = studio_graph_box(panel->graph, repeat->box);
    graphene_rect_t rect = studio_graph_repeat_rect(panel, index);
    double x = rect.origin.x, y = rect.origin.y, scale = studio_graph_scale(panel);
    double colour[3], strength = box->is_enabled ? 0.6 : 0.3;
    bool is_chosen = box->element == panel->selected;
    studio_component_colour(box->kind, colour);
    draw_second(cairo, &rect, colour, strength);
    rounded(cairo, x, y, rect.size.width, rect.size.height, 6);
    fill_ground(cairo, ink);
    cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], is_chosen ? 0.25 : 0.08);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], strength);
    if (is_chosen) {
        cairo_set_source_rgba(cairo, 1.0, 0.62, 0.13, 0.7);
    }
    cairo_set_line_width(cairo, 1);
    cairo_stroke(cairo);
    draw_icon(cairo, box, x + 7 * scale, y + 3 * scale, 12 * scale, strength);
    char *words = studio_repeat_words(repeat);
    double left = x + 7 * scale, width = rect.size.width - 10 * scale;
    cairo_set_source_rgba(cairo, ink->red, ink->green, ink->blue, box->is_enabled ? 0.75 : 0.4);
    text_at(panel, cairo, box->id, left + 17 * scale, y + scale, width - 17 * scale, 11.5 * scale,
            TEXT_BOLD);
    text_at(panel, cairo, words, left, y + 15 * scale, width, 10.5 * scale, TEXT_PLAIN);
    g_free(words);
}

static void draw_box(StudioGraphPanel *panel, cairo_t *cairo, uint32_t index, const GdkRGBA *ink) {
    const StudioBox *box = studio_graph_box(panel->graph, index);
    graphene_rect_t rect = studio_graph_box_rect(panel, index);
    double x = rect.origin.x, y = rect.origin.y, scale = studio_graph_scale(panel);
    bool is_chosen = box->element == panel->selected;
    StudioLoad load = weight_of(panel, box);
    double colour[3], strength = box->is_enabled ? 1 : 0.4;
    studio_component_colour(box->kind, colour);
    if (box->is_recursive) { // drawn double: it follows upon itself
        draw_second(cairo, &rect, colour, strength);
    }
    rounded(cairo, x, y, rect.size.width, rect.size.height, 7);
    fill_ground(cairo, ink);
    cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2],
                          (is_chosen ? 0.45 : 0.2) * strength);
    cairo_fill_preserve(cairo);
    if (load == STUDIO_LOAD_NOTHING) {
        cairo_set_source_rgb(cairo, 0.88, 0.22, 0.2);
    } else if (load == STUDIO_LOAD_HEAVY) {
        cairo_set_source_rgb(cairo, amber[0], amber[1], amber[2]);
    } else if (is_chosen) {
        cairo_set_source_rgb(cairo, 1.0, 0.62, 0.13);
    } else {
        cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], 0.75 * strength);
    }
    bool is_target = panel->drag != DRAG_NOTHING && panel->is_dragged && panel->over == index;
    cairo_set_line_width(cairo, is_chosen || load != STUDIO_LOAD_FINE || is_target ? 2 : 1);
    cairo_stroke(cairo);
    draw_icon(cairo, box, x + 7 * scale, y + 9 * scale, 18 * scale, strength);
    draw_name(panel, cairo, box, &rect, ink);
    draw_count(panel, cairo, box, &rect, ink);
}

// A tool's icon at a place, on a ground of its colour if `ground` > 0.
static void draw_tool(cairo_t *cairo, guint tool, double x, double y, double ground) {
    static const double preset[3] = {0.62, 0.58, 0.86};
    double colour[3] = {preset[0], preset[1], preset[2]};
    if (tool != TOOL_PRESET) {
        studio_component_colour((FrComponentKind)tool, colour);
    }
    if (ground > 0) {
        rounded(cairo, x - 7, y - 7, TOOL, TOOL, 7);
        cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], ground);
        cairo_fill(cairo);
    }
    cairo_save(cairo);
    cairo_translate(cairo, x, y);
    cairo_set_source_rgb(cairo, colour[0], colour[1], colour[2]);
    if (tool != TOOL_PRESET) {
        studio_component_icon(cairo, (FrComponentKind)tool, ICON);
    } else { // some boxes that are linked, in a frame
        cairo_set_line_width(cairo, 1.5);
        rounded(cairo, 1.5, 1.5, ICON - 3, ICON - 3, 3);
        cairo_rectangle(cairo, 8, 5, 4, 3);
        cairo_rectangle(cairo, 5, 12, 4, 3);
        cairo_rectangle(cairo, 11.5, 12, 4, 3);
        cairo_stroke(cairo);
        cairo_move_to(cairo, 10, 8);
        cairo_line_to(cairo, 7, 12);
        cairo_move_to(cairo, 10, 8);
        cairo_line_to(cairo, 13.5, 12);
        cairo_stroke(cairo);
    }
    cairo_restore(cairo);
}

static void draw_tools(StudioGraphPanel *panel, cairo_t *cairo, const GdkRGBA *ink) {
    double top = studio_graph_tools_top(panel);
    bool is_light_ink = ink->red > 0.5f;
    double ground = is_light_ink ? 0.14 : 0.92;
    cairo_set_source_rgb(cairo, ground, ground, ground + 0.01);
    cairo_rectangle(cairo, 0, top, gtk_widget_get_width(GTK_WIDGET(panel)),
                    gtk_widget_get_height(GTK_WIDGET(panel)) - top);
    cairo_fill(cairo);
    cairo_set_source_rgba(cairo, ink->red, ink->green, ink->blue, 0.55);
    const char *tip = "Drag a component onto another";
    uint32_t kind =
        panel->drag == DRAG_NOTHING ? studio_graph_tool_under(panel, panel->x, panel->y) : FR_NONE;
    text_at(panel, cairo, kind != FR_NONE ? studio_graph_tool_name(kind) : tip, TOOL_PAD + 2,
            top + 7, gtk_widget_get_width(GTK_WIDGET(panel)) - 2 * TOOL_PAD,
            11.5 * studio_letter_scale(GTK_WIDGET(panel)), TEXT_PLAIN);
    for (guint i = 1; i < TOOL_END; i++) {
        graphene_rect_t rect = studio_graph_tool_rect(panel, i);
        if (i == kind) {
            rounded(cairo, rect.origin.x + 1, rect.origin.y + 1, TOOL - 2, TOOL - 2, 6);
            cairo_set_source_rgba(cairo, ink->red, ink->green, ink->blue, 0.12);
            cairo_fill(cairo);
        }
        draw_tool(cairo, i, rect.origin.x + 7, rect.origin.y + 7, 0);
    }
}

// What is dragged, and what would come of it.
static void draw_drag(StudioGraphPanel *panel, cairo_t *cairo) {
    guint tool = panel->drag == DRAG_TOOL
                     ? panel->held
                     : (guint)studio_graph_box(panel->graph, panel->held)->kind;
    bool is_refused;
    char *words = studio_graph_words_of_drop(panel, &is_refused);
    draw_tool(cairo, tool, panel->x - 0.5 * ICON, panel->y - 0.5 * ICON, 0.35);
    if (words != NULL) {
        double letter = studio_letter_scale(GTK_WIDGET(panel));
        double width = fmin(gtk_widget_get_width(GTK_WIDGET(panel)) - 12,
                            8 + 6.6 * letter * (double)g_utf8_strlen(words, -1));
        double x = CLAMP(panel->x - 0.5 * width, 6,
                         fmax(6, gtk_widget_get_width(GTK_WIDGET(panel)) - width - 6));
        rounded(cairo, x, panel->y + 22, width, 22 * letter, 6);
        cairo_set_source_rgba(cairo, is_refused ? 0.75 : 0.1, 0.12, 0.12, 0.92);
        cairo_fill(cairo);
        cairo_set_source_rgb(cairo, 1, 1, 1);
        text_at(panel, cairo, words, x + 8, panel->y + 25, width - 12, 12 * letter, TEXT_PLAIN);
    }
    g_free(words);
}

void studio_graph_draw(StudioGraphPanel *panel, GtkSnapshot *snapshot) {
    GtkWidget *widget = GTK_WIDGET(panel);
    int width = gtk_widget_get_width(widget), height = gtk_widget_get_height(widget);
    graphene_rect_t bounds = GRAPHENE_RECT_INIT(0, 0, (float)width, (float)height);
    gtk_snapshot_push_clip(snapshot, &bounds);
    cairo_t *cairo = gtk_snapshot_append_cairo(snapshot, &bounds);
    GdkRGBA ink;
    gtk_style_context_get_color(gtk_widget_get_style_context(widget), &ink);
    for (guint i = 0; i < panel->graph->wires->len; i++) {
        draw_wire(panel, cairo, studio_graph_wire(panel->graph, i), &ink);
    }
    for (guint i = 0; i < panel->graph->boxes->len; i++) {
        draw_box(panel, cairo, i, &ink);
    }
    for (guint i = 0; i < panel->graph->repeats->len; i++) {
        draw_repeat(panel, cairo, i, &ink);
    }
    if (panel->graph->boxes->len == 0) {
        cairo_set_source_rgba(cairo, ink.red, ink.green, ink.blue, 0.6);
        text_at(panel, cairo, "No components: see Contents and Text", PAD, 2 * PAD, width - 2 * PAD,
                13 * studio_letter_scale(widget), TEXT_PLAIN);
    } else {
        draw_tools(panel, cairo, &ink);
    }
    if (panel->is_dragged && (panel->drag == DRAG_TOOL || panel->drag == DRAG_BOX)) {
        draw_drag(panel, cairo);
    }
    cairo_destroy(cairo);
    gtk_snapshot_pop(snapshot);
}
