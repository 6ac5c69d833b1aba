/// What the panes of the sketch panel show.
#include "studio/param_row.h"
#include "studio/sketch_panel_private.h"

#include "studio/model/commands.h"
#include "studio/widgets.h"

#include <adwaita.h>
#include <math.h>
#include <string.h>

static StudioSketchColours colours_now(void) {
    return studio_sketch_colours(adw_style_manager_get_dark(adw_style_manager_get_default()));
}

static GArray *new_lines(void) {
    return g_array_new(FALSE, FALSE, sizeof(StudioLine));
}

// ---- the skeleton, also behind the board -------------------------------------------------------

// A colour nearer to that of the ground.
static void fade(uint8_t colour[4], double part) {
    double ground = adw_style_manager_get_dark(adw_style_manager_get_default()) ? 36 : 248;
    for (int i = 0; i < 3; i++) {
        colour[i] = (uint8_t)(ground + part * (colour[i] - ground));
    }
}

// What to do next, in a sentence.
static void show_hint(StudioSketchPanel *panel) {
    bool is_chosen = studio_sketch_first(panel->base->plant, panel->states) != FR_NONE;
    bool is_stroke = panel->pen == STUDIO_PEN_STROKE;
    const char *hint =
        is_stroke   ? (is_chosen ? "Draw on the board. The wheel moves it, also while you draw."
                                 : "Paint along branches in the skeleton to choose them.")
        : is_chosen ? "Draw an arrow for the chosen branches. Choose nothing for the whole plant."
                    : "Draw an arrow on the board. It is for the whole plant.";
    gtk_label_set_text(GTK_LABEL(panel->hint), hint);
}

void studio_sketch_show_skeleton(StudioSketchPanel *panel) {
    show_hint(panel);
    StudioSketchColours colours = colours_now();
    GArray *lines = new_lines(), *behind = new_lines();
    studio_sketch_add_skeleton(lines, panel->base->plant, panel->states, &colours, MOST_INTERNODES);
    fade(colours.bare, 0.4);
    fade(colours.selected, 0.6);
    studio_sketch_add_skeleton(behind, panel->base->plant, panel->states, &colours,
                               MOST_INTERNODES);
    studio_sketch_view_set_lines(panel->skeleton, lines, NULL);
    studio_sketch_board_set_lines(panel->board, behind, NULL);
    const uint8_t *pen = panel->pen == STUDIO_PEN_STROKE ? colours.hand : colours.push;
    studio_sketch_board_set_pen(panel->board, pen, panel->pen != STUDIO_PEN_STROKE);
    g_array_unref(lines);
    g_array_unref(behind);
}

void studio_sketch_show_height(StudioSketchPanel *panel) {
    const StudioBoard *board = studio_sketch_board_get(panel->board);
    panel->is_showing = true;
    gtk_range_set_range(GTK_RANGE(panel->height), -board->reach, board->reach);
    gtk_range_set_increments(GTK_RANGE(panel->height), board->size / 50, board->size / 10);
    gtk_range_set_value(GTK_RANGE(panel->height), board->height);
    char *text = g_strdup_printf("%+.2f m", board->height);
    gtk_label_set_text(GTK_LABEL(panel->height_text), text);
    g_free(text);
    panel->is_showing = false;
}

// ---- instances ---------------------------------------------------------------------------------

// Strokes as the hand drew them, each at the first branch that follows it and as long.
static void add_hands(StudioSketchPanel *panel, GArray *lines, const StudioSketchColours *colours) {
    const FrContents *contents = studio_sketch_contents(panel);
    const StudioSketched *done = panel->done;
    if (contents == NULL || done->stroke == NULL || done->instances->len == 0) {
        return;
    }
    const FrPlant *plant = g_ptr_array_index(done->instances, 0);
    GArray *marks = studio_sketch_marks(contents, studio_sketch_vary(contents, panel->of.varied));
    uint32_t number = 0;
    for (guint i = 0; i < marks->len; i++) {
        uint32_t mark = g_array_index(marks, uint32_t, i);
        if (strcmp(fr_contents_at(contents, mark)->name, "stroke") != 0) {
            continue;
        }
        char *text = fr_contents_text(contents, mark, NULL);
        FrStroke *stroke = text == NULL ? NULL : fr_stroke_parse(text, (FrSpan){0}, NULL);
        uint32_t axis = 0;
        while (axis < plant->axes.count && done->stroke[axis] != number) {
            axis++;
        }
        if (stroke != NULL && axis < plant->axes.count) {
            vec3s at = fr_plant_axis_origin(plant, axis);
            double scale = studio_sketch_length(plant, axis) / fr_stroke_length(stroke);
            studio_sketch_add_stroke_line(lines, stroke, at.raw, scale, 2.6f, colours->hand);
        }
        fr_stroke_unref(stroke);
        g_free(text);
        number++;
    }
    g_array_unref(marks);
}

static bool read_vector(const FrContents *contents, uint32_t mark, const char *name,
                        float vector[3]) {
    char *text = fr_contents_get(contents, mark, name);
    char **parts = text == NULL ? NULL : g_strsplit(text, ",", 3);
    bool is_whole = parts != NULL && g_strv_length(parts) == 3;
    for (int i = 0; i < 3; i++) {
        vector[i] = is_whole ? (float)g_ascii_strtod(parts[i], NULL) : 0;
    }
    g_strfreev(parts);
    g_free(text);
    return is_whole;
}

// Indicators, one beside the other before the plant.
static void add_pushes(StudioSketchPanel *panel, GArray *lines, const double min[3],
                       const double max[3], const StudioSketchColours *colours) {
    const FrContents *contents = studio_sketch_contents(panel);
    if (contents == NULL) {
        return;
    }
    GArray *marks = studio_sketch_marks(contents, studio_sketch_vary(contents, panel->of.varied));
    uint32_t number = 0;
    for (guint i = 0; i < marks->len; i++) {
        uint32_t mark = g_array_index(marks, uint32_t, i);
        float from[3], to[3], at[3], end[3];
        if (strcmp(fr_contents_at(contents, mark)->name, "indicator") != 0 ||
            !read_vector(contents, mark, "to", to)) {
            continue;
        }
        read_vector(contents, mark, "from", from);
        double share = 0.85 - 0.09 * (double)(number++ % 8);
        for (int k = 0; k < 3; k++) {
            at[k] = (float)(k == 2 ? min[k] + share * (max[k] - min[k]) : 0.5 * (min[k] + max[k]));
            at[k] -= 0.5f * (to[k] - from[k]);
            end[k] = at[k] + (to[k] - from[k]);
        }
        studio_sketch_add_arrow(lines, at, end, 3.2f, colours->push);
    }
    g_array_unref(marks);
}

static void show_sheet(StudioSketchPanel *panel, const StudioSketchColours *colours) {
    const StudioSketched *done = panel->done;
    GPtrArray *cells = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
    guint count = MAX(done->instances->len, 1);
    for (guint i = 0; i < count; i++) {
        const FrPlant *plant =
            done->instances->len == 0 ? done->base->plant : g_ptr_array_index(done->instances, i);
        GArray *lines = new_lines();
        studio_sketch_add_instance(lines, plant, NULL, colours, MOST_INTERNODES / count);
        studio_sketch_add_leaves(lines, plant, colours, MOST_LEAVES / count);
        g_ptr_array_add(cells, lines);
    }
    studio_sketch_sheet_choose(panel->sheet, MIN(panel->chosen, count - 1));
    studio_sketch_sheet_show(panel->sheet, cells, panel->seed);
    g_ptr_array_unref(cells);
}

void studio_sketch_show_instances(StudioSketchPanel *panel) {
    const StudioSketched *done = panel->done;
    if (done == NULL || done->base == NULL) {
        return;
    }
    StudioSketchColours colours = colours_now();
    if (panel->is_sheet) {
        show_sheet(panel, &colours);
        return;
    }
    bool is_varied = done->instances->len > 0;
    const FrPlant *plant =
        is_varied ? g_ptr_array_index(done->instances, 0) : (FrPlant *)done->base->plant;
    GArray *lines = new_lines(), *above = new_lines();
    double min[3], max[3];
    studio_sketch_add_instance(lines, plant, is_varied ? done->stroke : NULL, &colours,
                               MOST_INTERNODES);
    studio_sketch_bounds(plant, min, max);
    add_hands(panel, above, &colours);
    add_pushes(panel, above, min, max, &colours);
    studio_sketch_view_set_lines(panel->strokes, lines, above);
    if (!panel->is_framed) {
        panel->is_framed = true;
        studio_sketch_view_frame(panel->strokes);
    } else if (!panel->is_playing) {
        studio_sketch_view_keep_framed(panel->strokes);
    }
    g_array_unref(lines);
    g_array_unref(above);
}

void studio_sketch_show_page(StudioSketchPanel *panel) {
    gtk_stack_set_visible_child_name(GTK_STACK(panel->pages), panel->is_whole   ? "whole"
                                                              : panel->is_sheet ? "sheet"
                                                                                : "strokes");
}

void studio_sketch_show_problem(StudioSketchPanel *panel) {
    const FrDiag *worst = NULL;
    const FrDiags *diags = panel->done == NULL ? NULL : panel->done->diags;
    for (size_t i = 0; diags != NULL && i < fr_diags_count(diags); i++) {
        const FrDiag *diag = fr_diags_get(diags, i);
        if (diag->severity == FR_ERROR && worst == NULL) {
            worst = diag;
        }
    }
    gtk_revealer_set_reveal_child(GTK_REVEALER(panel->problem), worst != NULL);
    if (worst != NULL) {
        char *text = g_strdup(worst->text);
        text[0] = g_ascii_toupper(text[0]);
        gtk_label_set_text(GTK_LABEL(panel->problem_text), text);
        gtk_widget_set_tooltip_text(panel->problem_text, text);
        g_free(text);
    }
}

// ---- lists -------------------------------------------------------------------------------------

static void show_variations(StudioSketchPanel *panel, const FrContents *contents) {
    GtkStringList *names = gtk_string_list_new(NULL);
    GPtrArray *variations = studio_sketch_variations(contents, panel->of.base);
    guint selected = variations->len;
    for (guint i = 0; i < variations->len; i++) {
        const char *id = g_ptr_array_index(variations, i);
        gtk_string_list_append(names, id);
        selected = g_strcmp0(id, panel->of.varied) == 0 ? i : selected;
    }
    gtk_string_list_append(names, "New variation");
    gtk_drop_down_set_model(GTK_DROP_DOWN(panel->variation), G_LIST_MODEL(names));
    gtk_drop_down_set_selected(GTK_DROP_DOWN(panel->variation), selected);
    g_ptr_array_unref(variations);
    g_object_unref(names);
}

static void on_remove_mark(GtkButton *button, StudioSketchPanel *panel) {
    guint index = GPOINTER_TO_UINT(g_object_get_data(G_OBJECT(button), "mark"));
    const FrContents *contents = studio_sketch_contents(panel);
    GArray *marks = studio_sketch_marks(contents, studio_sketch_vary(contents, panel->of.varied));
    uint32_t mark = index < marks->len ? g_array_index(marks, uint32_t, index) : FR_NONE;
    g_array_unref(marks);
    if (mark != FR_NONE) {
        studio_sketch_remove(panel->document, mark);
    }
}

// What a stroke or an indicator is for, in words. Free with g_free().
static char *words_of(const FrContents *contents, uint32_t mark) {
    char *kind = fr_contents_get(contents, mark, "kind");
    char *select = fr_contents_get(contents, mark, "select");
    char *apply = fr_contents_get(contents, mark, "apply");
    bool is_stroke = strcmp(fr_contents_at(contents, mark)->name, "stroke") == 0;
    guint paths = 0;
    for (const char *at = select; at != NULL && *at != '\0'; at++) {
        paths += *at == '#';
    }
    char *whom = select == NULL || *select == '\0' ? g_strdup("all branches")
                 : paths == 1                      ? g_strdup("one branch")
                 : paths > 1                       ? g_strdup_printf("%u branches", paths)
                                                   : g_strdup(select);
    const char *borne = g_strcmp0(apply, "descendants") == 0 ? "what is borne by "
                        : g_strcmp0(apply, "both") == 0      ? "all from "
                                                             : "";
    const char *what = is_stroke ? "stroke" : kind == NULL ? "wind" : kind;
    char *words = g_strdup_printf("%s for %s%s", what, borne, whom);
    words[0] = g_ascii_toupper(words[0]);
    g_free(whom);
    g_free(apply);
    g_free(select);
    g_free(kind);
    return words;
}

static void remove_children(GtkWidget *box) {
    for (GtkWidget *child; (child = gtk_widget_get_first_child(box)) != NULL;) {
        gtk_box_remove(GTK_BOX(box), child);
    }
}

static void show_marks(StudioSketchPanel *panel, const FrContents *contents) {
    remove_children(panel->marks);
    GArray *marks = studio_sketch_marks(contents, studio_sketch_vary(contents, panel->of.varied));
    for (guint i = 0; i < marks->len; i++) {
        char *words = words_of(contents, g_array_index(marks, uint32_t, i));
        GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
        GtkWidget *label = gtk_label_new(words);
        gtk_label_set_xalign(GTK_LABEL(label), 0);
        gtk_widget_set_hexpand(label, TRUE);
        GtkWidget *button = studio_flat_button("user-trash-symbolic", "Remove it");
        g_object_set_data(G_OBJECT(button), "mark", GUINT_TO_POINTER(i));
        g_signal_connect(button, "clicked", G_CALLBACK(on_remove_mark), panel);
        gtk_box_append(GTK_BOX(row), label);
        gtk_box_append(GTK_BOX(row), button);
        gtk_box_append(GTK_BOX(panel->marks), row);
        g_free(words);
    }
    if (marks->len == 0) {
        gtk_box_append(GTK_BOX(panel->marks), gtk_label_new("Nothing is drawn yet"));
    }
    char *label = g_strdup_printf("Drawn: %u", marks->len);
    gtk_menu_button_set_label(GTK_MENU_BUTTON(panel->drawn), label);
    g_free(label);
    g_array_unref(marks);
}

static void show_growth(StudioSketchPanel *panel, const FrContents *contents) {
    uint32_t vary = studio_sketch_vary(contents, panel->of.varied);
    gtk_widget_set_sensitive(panel->growth, vary != FR_NONE);
    for (GtkWidget *row = gtk_widget_get_first_child(panel->growth_rows);
         row != NULL && vary != FR_NONE; row = gtk_widget_get_next_sibling(row)) {
        StudioParamRow *param = STUDIO_PARAM_ROW(row);
        char *value = fr_contents_get(contents, vary, studio_param_row_attribute(param));
        studio_param_row_show(param, value);
        g_free(value);
    }
}

void studio_sketch_show_lists(StudioSketchPanel *panel) {
    const FrContents *contents = studio_sketch_contents(panel);
    if (contents != NULL) {
        panel->is_showing = true;
        show_variations(panel, contents);
        show_marks(panel, contents);
        show_growth(panel, contents);
        panel->is_showing = false;
    }
}
