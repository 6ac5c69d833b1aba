/// One plant of a row or an area: the one that was clicked, and those below the brush.
#include "studio/model/scene_single.h"
#include "studio/scene_tool_private.h"

#include <math.h>
#include <string.h>

// A plant of a row or an area that a brush may come over.
typedef struct One {
    char *place; // of the row or area
    uint32_t number;
    double at[2];
    bool is_gone;
} One;

// ---- the one that was clicked ------------------------------------------------------------------

void studio_scene_set_one(StudioSceneTool *tool, uint32_t element, uint32_t number,
                          const double at[3]) {
    const StudioDocument *document = tool->window->document;
    g_clear_pointer(&tool->one_of, g_free);
    if (studio_is_spread(document, element)) {
        tool->one_of = studio_place_of(studio_document_contents(document), element);
        tool->one = number;
        memcpy(tool->one_at, at, sizeof tool->one_at);
        char *text = g_strdup_printf(
            "Plant %u of this %s", number,
            fr_contents_at(studio_document_contents(document), element)->name[0] == 'r' ? "row"
                                                                                        : "area");
        gtk_label_set_text(GTK_LABEL(tool->one_label), text);
        g_free(text);
    }
    studio_scene_update_bars(tool);
    gtk_widget_queue_draw(tool->layer);
}

static uint32_t row_of(const StudioSceneTool *tool) {
    const StudioDocument *document = tool->window->document;
    return tool->one_of == NULL || studio_document_is_broken(document)
               ? FR_NONE
               : studio_place_find(studio_document_contents(document), tool->one_of);
}

static void do_take(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioSceneTool *tool = data;
    StudioWindow *window = tool->window;
    uint32_t row = row_of(tool);
    if (row != FR_NONE && studio_release(window->document, row, tool->one)) {
        studio_window_select(window, studio_scene_last(window->document, "place"));
    } else {
        studio_window_say(window, "Click a plant of a row or an area first, with the tool Move");
    }
}

static void do_leave_out(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioSceneTool *tool = data;
    uint32_t row = row_of(tool);
    if (row != FR_NONE) {
        g_clear_pointer(&tool->one_of, g_free);
        studio_leave_out(tool->window->document, row, &tool->one, 1, NULL);
    }
}

// ---- a model of its own ------------------------------------------------------------------------

// The row, area or place of the plant that is chosen; FR_NONE: none is.
static uint32_t element_of_one(const StudioSceneTool *tool) {
    const StudioDocument *document = tool->window->document;
    if (document == NULL || studio_document_is_broken(document) ||
        studio_document_contents(document) == NULL) {
        return FR_NONE;
    }
    uint32_t selected = studio_window_selected(tool->window), row = row_of(tool);
    bool is_place =
        selected != FR_NONE &&
        strcmp(fr_contents_at(studio_document_contents(document), selected)->name, "place") == 0;
    return row != FR_NONE ? row : is_place ? selected : FR_NONE;
}

bool studio_scene_is_one(const StudioSceneTool *tool) {
    return element_of_one(tool) != FR_NONE;
}

// The plant that is chosen, its name to be freed; false after a message.
static bool find_one(const StudioSceneTool *tool, StudioOne *one) {
    uint32_t element = element_of_one(tool);
    if (element == FR_NONE) {
        studio_window_say(tool->window, "Click a plant first, with the tool Move");
        return false;
    }
    const FrContents *contents = studio_document_contents(tool->window->document);
    const FrContentsElement *at = fr_contents_at(contents, element);
    bool is_place = strcmp(at->name, "place") == 0;
    // A stand knows where the name of its element begins, which is behind the bracket.
    *one = (StudioOne){.origin = at->begin + 1, .number = is_place ? 0 : tool->one};
    one->name = is_place ? fr_contents_get(contents, element, "plant")
                         : g_strdup_printf("%s-%u", at->name, tool->one);
    return true;
}

static void do_export_one(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    const StudioSceneTool *tool = data;
    StudioOne one;
    if (find_one(tool, &one)) {
        studio_window_export(tool->window, &one);
        g_free(one.name);
    }
}

static void do_export_one_to(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    const StudioSceneTool *tool = data;
    StudioOne one;
    if (find_one(tool, &one)) {
        studio_window_export_to(tool->window, &one, g_variant_get_string(parameter, NULL));
        g_free(one.name);
    }
}

GtkWidget *studio_scene_export_bar(void) {
    GtkWidget *button = gtk_button_new_with_label("Export This Plant…");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), "win.export-one");
    gtk_widget_set_tooltip_text(button, "Writes a model of it alone, as it has grown among the "
                                        "others (Ctrl+Shift+E)");
    gtk_widget_set_name(button, "export-one");
    return button;
}

// ---- what is done with it ----------------------------------------------------------------------

void studio_scene_add_one_actions(StudioSceneTool *tool) {
    static const GActionEntry entries[] = {
        {"take-one", do_take, NULL, NULL, NULL, {0}},
        {"leave-one-out", do_leave_out, NULL, NULL, NULL, {0}},
        {"export-one", do_export_one, NULL, NULL, NULL, {0}},
        {"export-one-to", do_export_one_to, "s", NULL, NULL, {0}},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(tool->window), entries, G_N_ELEMENTS(entries),
                                    tool);
}

GtkWidget *studio_scene_one_bar(StudioSceneTool *tool) {
    static const char *const buttons[][3] = {
        {"Take This Plant Out", "win.take-one",
         "It gets a place of its own, so that it can be moved by itself (T)"},
        {"Leave It Out", "win.leave-one-out", "The row or area stays without it (Shift+Delete)"},
    };
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    tool->one_label = gtk_label_new("");
    gtk_box_append(GTK_BOX(box), tool->one_label);
    for (size_t i = 0; i < G_N_ELEMENTS(buttons); i++) {
        GtkWidget *button = gtk_button_new_with_label(buttons[i][0]);
        gtk_actionable_set_action_name(GTK_ACTIONABLE(button), buttons[i][1]);
        gtk_widget_set_tooltip_text(button, buttons[i][2]);
        gtk_widget_set_name(button, buttons[i][1] + strlen("win."));
        gtk_box_append(GTK_BOX(box), button);
    }
    return box;
}

// ---- the brush ---------------------------------------------------------------------------------

static void clear_one(gpointer data) {
    g_free(((One *)data)->place);
}

GArray *studio_scene_ones(const StudioSceneTool *tool) {
    GArray *ones = g_array_new(FALSE, FALSE, sizeof(One));
    GArray *stands = studio_builder_stands(tool->window->builder);
    const FrContents *contents = studio_document_contents(tool->window->document);
    g_array_set_clear_func(ones, clear_one);
    uint32_t origin = 0, element = FR_NONE;
    for (guint i = 0; i < stands->len; i++) {
        const StudioStand *stand = &g_array_index(stands, StudioStand, i);
        if (stand->origin != origin) { // those of a row stand together
            origin = stand->origin;
            element = studio_scene_element(tool, origin);
        }
        if (studio_is_spread(tool->window->document, element)) {
            One one = {studio_place_of(contents, element),
                       stand->number,
                       {stand->at[0], stand->at[1]},
                       false};
            g_array_append_val(ones, one);
        }
    }
    g_array_unref(stands);
    return ones;
}

// Those of one row or area that the brush comes over.
static GArray *below(GArray *ones, guint first, const double at[3], double radius) {
    GArray *numbers = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    const char *place = g_array_index(ones, One, first).place;
    for (guint i = first; i < ones->len; i++) {
        One *one = &g_array_index(ones, One, i);
        if (!one->is_gone && strcmp(one->place, place) == 0 &&
            hypot(one->at[0] - at[0], one->at[1] - at[1]) <= radius) {
            one->is_gone = true;
            g_array_append_val(numbers, one->number);
        }
    }
    return numbers;
}

void studio_scene_leave_out(StudioSceneTool *tool, const double at[3], double radius) {
    StudioDocument *document = tool->window->document;
    for (guint i = 0; i < tool->ones->len; i++) {
        const One *one = &g_array_index(tool->ones, One, i);
        if (one->is_gone || hypot(one->at[0] - at[0], one->at[1] - at[1]) > radius) {
            continue;
        }
        GArray *numbers = below(tool->ones, i, at, radius);
        uint32_t row = studio_place_find(studio_document_contents(document), one->place);
        studio_leave_out(document, row, (const uint32_t *)(const void *)numbers->data, numbers->len,
                         tool->key);
        g_array_unref(numbers);
    }
}
