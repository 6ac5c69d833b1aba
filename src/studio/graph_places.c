/// Where things are in the graph panel.
#include "studio/graph_panel_private.h"

#include "studio/accessible.h"

#include <math.h>

enum { WHEEL_STEP = 40 };

static const double LEAST_SCALE = 0.85; // letters are 9 px then

static int width_of(StudioGraphPanel *panel) {
    return gtk_widget_get_width(GTK_WIDGET(panel));
}

static guint tools_in_row(StudioGraphPanel *panel) {
    return (guint)MAX(1, (width_of(panel) - 2 * TOOL_PAD) / TOOL);
}

double studio_graph_line(StudioGraphPanel *panel) {
    return 18 * studio_letter_scale(GTK_WIDGET(panel));
}

double studio_graph_tools_top(StudioGraphPanel *panel) {
    guint rows = (TOOL_END - 2) / tools_in_row(panel) + 1;
    return gtk_widget_get_height(GTK_WIDGET(panel)) - (double)rows * TOOL - 2.0 * TOOL_PAD -
           studio_graph_line(panel);
}

const char *studio_graph_tool_name(guint tool) {
    return tool == TOOL_PRESET ? "preset" : fr_pgraph_table((FrComponentKind)tool)->element;
}

// Tools are all kinds but the camera, which every graph has, and presets.
graphene_rect_t studio_graph_tool_rect(StudioGraphPanel *panel, guint kind) {
    guint place = kind - 1, in_row = tools_in_row(panel);
    return GRAPHENE_RECT_INIT((float)(TOOL_PAD + place % in_row * TOOL),
                              (float)(studio_graph_tools_top(panel) + TOOL_PAD +
                                      studio_graph_line(panel) + place / in_row * TOOL),
                              TOOL, TOOL);
}

// How the graph stands, and how large it is at full size. Where the tidy tree would be too small to
// read, an outline takes its place: it needs height, of which a panel has more than width.
typedef struct Form {
    bool is_outline;
    double wide, high, scale;
} Form;

static double scale_into(StudioGraphPanel *panel, const Form *form) {
    return fmin((width_of(panel) - 2 * PAD) / fmax(form->wide, 1),
                (studio_graph_tools_top(panel) - 2 * PAD) / fmax(form->high, 1));
}

static Form form_of(StudioGraphPanel *panel) {
    const StudioGraph *graph = panel->graph;
    double most = studio_letter_scale(GTK_WIDGET(panel)), least = LEAST_SCALE * most;
    Form tree = {.wide = graph->columns * (BOX_WIDTH + GAP_X) - GAP_X,
                 .high = graph->rows * (BOX_HEIGHT + GAP_Y) - GAP_Y};
    tree.scale = scale_into(panel, &tree);
    if (tree.scale >= least) {
        tree.scale = fmin(tree.scale, most);
        return tree;
    }
    guint lines = graph->boxes->len + graph->repeats->len;
    Form outline = {.is_outline = true,
                    .wide = (graph->rows - 1) * INDENT + BOX_WIDTH,
                    .high = lines * (double)(BOX_HEIGHT + GAP_LINE) - GAP_LINE};
    outline.scale = CLAMP(scale_into(panel, &outline), least, most);
    return outline;
}

double studio_graph_scale(StudioGraphPanel *panel) {
    return form_of(panel).scale;
}

void studio_graph_stand(StudioGraphPanel *panel, const StudioBox *box, double *x, double *y) {
    bool is_outline = form_of(panel).is_outline;
    *x = is_outline ? box->row * INDENT / BOX_WIDTH : box->column;
    *y = is_outline ? box->line : box->row;
}

static graphene_rect_t rect_at(StudioGraphPanel *panel, double column, double row, uint32_t line) {
    Form form = form_of(panel);
    double x = form.is_outline ? row * INDENT : column * (BOX_WIDTH + GAP_X);
    double y =
        form.is_outline ? line * (double)(BOX_HEIGHT + GAP_LINE) : row * (BOX_HEIGHT + GAP_Y);
    double left = fmax(PAD, 0.5 * (width_of(panel) - form.wide * form.scale));
    return GRAPHENE_RECT_INIT((float)(left + x * form.scale + panel->shift_x),
                              (float)(PAD + y * form.scale + panel->shift_y),
                              (float)(BOX_WIDTH * form.scale), (float)(BOX_HEIGHT * form.scale));
}

void studio_graph_scroll(StudioGraphPanel *panel, double dx, double dy) {
    Form form = form_of(panel);
    double right = width_of(panel) - 2 * PAD - form.wide * form.scale;
    double bottom = studio_graph_tools_top(panel) - 2 * PAD - form.high * form.scale;
    panel->shift_x = CLAMP(panel->shift_x - dx * WHEEL_STEP, fmin(0, right), 0);
    panel->shift_y = CLAMP(panel->shift_y - dy * WHEEL_STEP, fmin(0, bottom), 0);
}

graphene_rect_t studio_graph_box_rect(StudioGraphPanel *panel, uint32_t index) {
    const StudioBox *box = studio_graph_box(panel->graph, index);
    return rect_at(panel, box->column, box->row, box->line);
}

// A little smaller than a box.
graphene_rect_t studio_graph_repeat_rect(StudioGraphPanel *panel, uint32_t index) {
    const StudioRepeat *repeat = studio_graph_repeat(panel->graph, index);
    graphene_rect_t rect = rect_at(panel, repeat->column, repeat->row, repeat->line);
    graphene_rect_inset(&rect, 0.04f * rect.size.width, 0.08f * rect.size.height);
    return rect;
}

// The least move that brings a stretch into a room.
static double move_into(double begin, double size, double room) {
    return begin < PAD ? PAD - begin : fmin(0, room - PAD - begin - size);
}

void studio_graph_reveal(StudioGraphPanel *panel, uint32_t element) {
    for (guint i = 0; width_of(panel) > 0 && i < panel->graph->boxes->len; i++) {
        if (studio_graph_box(panel->graph, i)->element == element) {
            graphene_rect_t rect = studio_graph_box_rect(panel, i);
            panel->shift_x += move_into(rect.origin.x, rect.size.width, width_of(panel));
            panel->shift_y +=
                move_into(rect.origin.y, rect.size.height, studio_graph_tools_top(panel));
        }
    }
}

static bool is_within(const graphene_rect_t *rect, double x, double y) {
    graphene_point_t point = GRAPHENE_POINT_INIT((float)x, (float)y);
    return graphene_rect_contains_point(rect, &point);
}

uint32_t studio_graph_box_under(StudioGraphPanel *panel, double x, double y) {
    if (x < 0 || y < 0 || x >= width_of(panel)) {
        return FR_NONE; // a part of the graph that is out of sight
    }
    for (guint i = 0; y < studio_graph_tools_top(panel) && i < panel->graph->boxes->len; i++) {
        graphene_rect_t rect = studio_graph_box_rect(panel, i);
        if (is_within(&rect, x, y)) {
            return i;
        }
    }
    for (guint i = 0; y < studio_graph_tools_top(panel) && i < panel->graph->repeats->len; i++) {
        graphene_rect_t rect = studio_graph_repeat_rect(panel, i);
        if (is_within(&rect, x, y)) {
            return studio_graph_repeat(panel->graph, i)->box;
        }
    }
    return FR_NONE;
}

uint32_t studio_graph_tool_under(StudioGraphPanel *panel, double x, double y) {
    for (guint kind = 1; kind < TOOL_END; kind++) {
        graphene_rect_t rect = studio_graph_tool_rect(panel, kind);
        if (is_within(&rect, x, y)) {
            return kind;
        }
    }
    return FR_NONE;
}

const Load *studio_graph_load(StudioGraphPanel *panel, const StudioBox *box) {
    return panel->counts == NULL ? NULL : g_hash_table_lookup(panel->counts, box->id);
}

// The ends of a wire, and its two bends.
void studio_graph_wire_course(StudioGraphPanel *panel, const StudioWire *wire, double at[4][2]) {
    graphene_rect_t from = studio_graph_box_rect(panel, wire->from),
                    to = wire->again != FR_NONE ? studio_graph_repeat_rect(panel, wire->again)
                                                : studio_graph_box_rect(panel, wire->to);
    Form form = form_of(panel);
    double scale = form.scale;
    if (!wire->is_tree) { // out at the right and back from there
        double right = from.origin.x + from.size.width, other = to.origin.x + to.size.width;
        double bulge = 34 * scale;
        at[0][0] = right, at[0][1] = from.origin.y + 0.72 * from.size.height;
        at[3][0] = other, at[3][1] = to.origin.y + 0.28 * to.size.height;
        at[1][0] = right + bulge, at[1][1] = at[0][1];
        at[2][0] = other + bulge, at[2][1] = at[3][1];
        return;
    }
    if (form.is_outline) { // down, and to the right where it ends
        at[0][0] = from.origin.x + 0.4 * INDENT * scale,
        at[0][1] = from.origin.y + from.size.height;
        at[3][0] = to.origin.x, at[3][1] = to.origin.y + 0.5 * to.size.height;
        at[1][0] = at[2][0] = at[0][0], at[1][1] = at[2][1] = at[3][1];
        return;
    }
    double bend = 0.5 * GAP_Y * scale;
    at[0][0] = from.origin.x + 0.5 * from.size.width, at[0][1] = from.origin.y + from.size.height;
    at[3][0] = to.origin.x + 0.5 * to.size.width, at[3][1] = to.origin.y;
    at[1][0] = at[0][0], at[1][1] = at[0][1] + bend;
    at[2][0] = at[3][0], at[2][1] = at[3][1] - bend;
}

uint32_t studio_graph_wire_under(StudioGraphPanel *panel, double x, double y) {
    for (guint i = 0; i < panel->graph->wires->len; i++) {
        double at[4][2];
        studio_graph_wire_course(panel, studio_graph_wire(panel->graph, i), at);
        for (int k = 0; k <= 24; k++) {
            double t = k / 24.0, s = 1 - t;
            double w[] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
            double px = 0, py = 0;
            for (int j = 0; j < 4; j++) {
                px += w[j] * at[j][0];
                py += w[j] * at[j][1];
            }
            if (hypot(px - x, py - y) < WIRE_GRAB) {
                return i;
            }
        }
    }
    return FR_NONE;
}

bool studio_graph_is_beside_boxes(StudioGraphPanel *panel) {
    return panel->over == FR_NONE && panel->x >= 0 && panel->x < width_of(panel) && panel->y >= 0 &&
           panel->y < studio_graph_tools_top(panel);
}

// In words, with whether it can be done; NULL: nothing.
char *studio_graph_words_of_drop(StudioGraphPanel *panel, bool *is_refused) {
    *is_refused = false;
    if (panel->over == FR_NONE) {
        return panel->drag == DRAG_TOOL && studio_graph_is_beside_boxes(panel)
                   ? g_strdup("not linked yet")
                   : NULL;
    }
    const StudioBox *on = studio_graph_box(panel->graph, panel->over);
    if (panel->drag == DRAG_TOOL && panel->held == TOOL_PRESET) {
        return g_strdup_printf("a preset on %s", on->id);
    }
    FrComponentKind kind = panel->drag == DRAG_TOOL
                               ? (FrComponentKind)panel->held
                               : studio_graph_box(panel->graph, panel->held)->kind;
    if (panel->drag == DRAG_BOX) {
        const char *refusal = studio_link_refusal(panel->document, panel->plant, on->id,
                                                  studio_graph_box(panel->graph, panel->held)->id);
        if (refusal != NULL) {
            *is_refused = true;
            return g_strdup(refusal);
        }
        if (panel->over == panel->held) {
            return g_strdup("repeated upon itself");
        }
    }
    return g_strdup_printf("%s of %s",
                           studio_link_words(studio_likely_link(on->kind, kind), on->kind), on->id);
}
