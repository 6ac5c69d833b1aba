/// How p-graphs are read and laid out.
#include "studio.h"
#include "studio/model/graph.h"

#include <math.h>

static const StudioBox *box_of(const StudioGraph *graph, const char *id) {
    uint32_t box = studio_graph_find(graph, id);
    g_assert_cmpuint(box, !=, FR_NONE);
    return studio_graph_box(graph, box);
}

static StudioGraph *graph_of(const StudioDocument *document) {
    return studio_graph_new(studio_document_contents(document), first_plant(document));
}

// A link leads back: it is drawn to the repeat of its end, a row below.
static void assert_repeat(const StudioGraph *graph, const char *from, const char *to,
                          const char *words) {
    for (guint i = 0; i < graph->wires->len; i++) {
        const StudioWire *wire = studio_graph_wire(graph, i);
        if (wire->from == studio_graph_find(graph, from) &&
            wire->to == studio_graph_find(graph, to)) {
            g_assert_cmpuint(wire->again, <, graph->repeats->len);
            const StudioRepeat *repeat = studio_graph_repeat(graph, wire->again);
            char *told = studio_repeat_words(repeat);
            g_assert_cmpstr(told, ==, words);
            g_assert_cmpuint(repeat->box, ==, wire->to);
            g_assert_cmpfloat(repeat->row, ==, box_of(graph, from)->row + 1);
            g_assert_true(wire->is_repeated && box_of(graph, to)->is_recursive);
            g_free(told);
            return;
        }
    }
    g_assert_not_reached();
}

static void test_figure2(void) {
    StudioDocument *document = open_example("examples/figure2.frond");
    StudioGraph *graph = graph_of(document);
    g_assert_cmpuint(graph->boxes->len, ==, 4);
    g_assert_cmpuint(graph->wires->len, ==, 4);
    g_assert_true(box_of(graph, "D")->is_recursive);
    g_assert_false(box_of(graph, "C")->is_recursive);
    g_assert_cmpfloat(graph->rows, ==, 5);
    g_assert_cmpfloat(graph->columns, ==, 1);
    assert_repeat(graph, "D", "D", "again, 3 deep");
    g_assert_cmpuint(graph->repeats->len, ==, 1);
    g_assert_false(studio_graph_wire(graph, 2)->is_repeated); // C to D
    studio_graph_free(graph);
    studio_document_free(document);
}

static void test_slider_depth(void) {
    StudioDocument *document = open_example("examples/chestnut-recursive.frond");
    StudioGraph *graph = graph_of(document);
    assert_repeat(graph, "wood", "wood", "again, 4 deep");
    const StudioRepeat *again = studio_graph_repeat(graph, 0);
    g_assert_cmpfloat(again->row, ==, box_of(graph, "shoot")->row);
    g_assert_cmpfloat(again->column, ==, box_of(graph, "shoot")->column - 1);
    studio_graph_free(graph);
    studio_document_free(document);
}

static StudioGraph *graph_of_text(const char *text) {
    StudioDocument *document = studio_document_new(text, strlen(text), "x", NULL);
    StudioGraph *graph = graph_of(document);
    studio_document_free(document);
    return graph;
}

// What goes round by way of others ends at its first, as often as its member of the least depth;
// what hangs on it, or is led to across, is no part of it.
static void test_long_recursion(void) {
    StudioGraph *graph = graph_of_text(
        "<frond version='1'><plant id='p'><pgraph><camera id='a'/><horn id='b' depth='5'/>"
        "<horn id='c' depth=' 2 '/><horn id='d' depth='2..3'/><leaf id='e'/>"
        "<link from='a' to='b'/><link from='b' to='c'/><link from='b' to='e'/>"
        "<link from='c' to='d'/><link from='d' to='b'/><link from='d' to='e'/>"
        "<link from='d' to='d'/></pgraph></plant></frond>");
    assert_repeat(graph, "d", "b", "again, 2 deep");
    assert_repeat(graph, "d", "d", "again");
    g_assert_cmpuint(graph->repeats->len, ==, 2);
    static const bool is_repeated[] = {false, true, false, true, true, false, true};
    for (guint i = 0; i < graph->wires->len; i++) {
        g_assert_true(studio_graph_wire(graph, i)->is_repeated == is_repeated[i]);
    }
    g_assert_true(box_of(graph, "b")->is_recursive && box_of(graph, "c")->is_recursive);
    g_assert_false(box_of(graph, "a")->is_recursive || box_of(graph, "e")->is_recursive);
    studio_graph_free(graph);
}

// Boxes, and behind them repeats.
static void stand_of(const StudioGraph *graph, guint i, double *column, double *row) {
    bool is_box = i < graph->boxes->len;
    const StudioBox *box = is_box ? studio_graph_box(graph, i) : NULL;
    const StudioRepeat *repeat = is_box ? NULL : studio_graph_repeat(graph, i - graph->boxes->len);
    *column = is_box ? box->column : repeat->column;
    *row = is_box ? box->row : repeat->row;
}

static void assert_apart(const StudioGraph *graph) {
    guint count = graph->boxes->len + graph->repeats->len;
    for (guint i = 0; i < count; i++) {
        for (guint j = 0; j < i; j++) {
            double column[2], row[2];
            stand_of(graph, i, &column[0], &row[0]);
            stand_of(graph, j, &column[1], &row[1]);
            g_assert_true(row[0] != row[1] || fabs(column[0] - column[1]) >= 1);
        }
    }
}

// Of an outline: lines are used once and without gaps, and what hangs on a box is below it.
static void assert_lines(const StudioGraph *graph) {
    guint count = graph->boxes->len + graph->repeats->len;
    bool *is_used = g_new0(bool, count + 1);
    for (guint i = 0; i < count; i++) {
        uint32_t line = i < graph->boxes->len
                            ? studio_graph_box(graph, i)->line
                            : studio_graph_repeat(graph, i - graph->boxes->len)->line;
        g_assert_cmpuint(line, <, count);
        g_assert_false(is_used[line]);
        is_used[line] = true;
    }
    for (guint i = 0; i < graph->wires->len; i++) {
        const StudioWire *wire = studio_graph_wire(graph, i);
        uint32_t end = wire->again != FR_NONE ? studio_graph_repeat(graph, wire->again)->line
                                              : studio_graph_box(graph, wire->to)->line;
        g_assert_true(!wire->is_tree || end > studio_graph_box(graph, wire->from)->line);
    }
    g_free(is_used);
}

static double end_of(const StudioGraph *graph, const StudioWire *wire) {
    return wire->again != FR_NONE ? studio_graph_repeat(graph, wire->again)->column
                                  : studio_graph_box(graph, wire->to)->column;
}

// Of two wires of the tree between the same rows none crosses the other.
static void assert_no_crossings(const StudioGraph *graph) {
    for (guint i = 0; i < graph->wires->len; i++) {
        for (guint j = 0; j < i; j++) {
            const StudioWire *a = studio_graph_wire(graph, i), *b = studio_graph_wire(graph, j);
            const StudioBox *from_a = studio_graph_box(graph, a->from),
                            *from_b = studio_graph_box(graph, b->from);
            if (a->is_tree && b->is_tree && from_a->row == from_b->row) {
                double above = from_a->column - from_b->column;
                g_assert_true(above * (end_of(graph, a) - end_of(graph, b)) >= 0);
            }
        }
    }
}

static void test_layout(void) {
    char *folder = project_file("data/presets");
    GDir *directory = g_dir_open(folder, 0, NULL);
    const char *name;
    int count = 0;
    while ((name = g_dir_read_name(directory)) != NULL) {
        if (g_str_has_suffix(name, ".frond")) {
            char *relative = g_strconcat("data/presets/", name, NULL);
            StudioDocument *document = open_example(relative);
            StudioGraph *graph = graph_of(document);
            assert_apart(graph);
            assert_no_crossings(graph);
            assert_lines(graph);
            studio_graph_free(graph);
            studio_document_free(document);
            g_free(relative);
            count++;
        }
    }
    g_assert_cmpint(count, >, 30);
    g_dir_close(directory);
    g_free(folder);
}

static void test_unlinked(void) {
    static const char text[] = "<frond version='1'><plant id='p'><pgraph><camera id='a'/>"
                               "<horn id='b' enabled='no'/><horn id='c'/><horn id='d'/>"
                               "<link from='c' to='d'/><link from='d' to='c'/>"
                               "<link from='a' to='x'/></pgraph></plant></frond>";
    StudioGraph *graph = graph_of_text(text);
    g_assert_cmpuint(graph->boxes->len, ==, 4);
    g_assert_cmpuint(graph->wires->len, ==, 2);
    g_assert_false(box_of(graph, "b")->is_reached);
    g_assert_false(box_of(graph, "b")->is_enabled);
    assert_repeat(graph, "d", "c", "again");
    assert_apart(graph);
    assert_lines(graph);
    studio_graph_free(graph);
}

static void test_likely(void) {
    g_assert_cmpint(studio_likely_link(FR_COMPONENT_TREE, FR_COMPONENT_LEAF), ==, FR_LINK_BRANCH);
    g_assert_cmpint(studio_likely_link(FR_COMPONENT_HORN, FR_COMPONENT_LEAF), ==, FR_LINK_CHILD);
    g_assert_cmpint(studio_likely_link(FR_COMPONENT_TREE, FR_COMPONENT_PHIBALL), ==, FR_LINK_CHILD);
    g_assert_cmpstr(studio_link_words(FR_LINK_BRANCH, FR_COMPONENT_TREE), ==, "along the stem");
}

static void test_load(void) {
    static const StudioBudget none = {0, 0}, ten = {10, 0}, quick = {0, 0.1};
    g_assert_cmpint(studio_load_of(0, NAN, &none), ==, STUDIO_LOAD_NOTHING);
    g_assert_cmpint(studio_load_of(0, 9, &ten), ==, STUDIO_LOAD_NOTHING);
    g_assert_cmpint(studio_load_of(10, 9, &ten), ==, STUDIO_LOAD_FINE);
    g_assert_cmpint(studio_load_of(11, NAN, &ten), ==, STUDIO_LOAD_HEAVY);
    g_assert_cmpint(studio_load_of(UINT64_MAX, 9, &none), ==, STUDIO_LOAD_FINE);
    g_assert_cmpint(studio_load_of(11, 0.1, &quick), ==, STUDIO_LOAD_FINE);
    g_assert_cmpint(studio_load_of(1, 0.11, &quick), ==, STUDIO_LOAD_HEAVY);
    g_assert_cmpint(studio_load_of(1, NAN, &quick), ==, STUDIO_LOAD_FINE);
}

static void test_time(void) {
    static const struct {
        double seconds;
        const char *text;
    } rows[] = {
        {NAN, ""},          {0, ""},           {0.00099, ""},   {0.001, "1 ms"}, {0.0384, "38 ms"},
        {0.9994, "999 ms"}, {0.9996, "1.0 s"}, {1.24, "1.2 s"}, {9.94, "9.9 s"}, {12.4, "12 s"}};
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text = studio_time_text(rows[i].seconds);
        g_assert_cmpstr(text, ==, rows[i].text);
        g_free(text);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/graph/figure 2 is a chain with a recursion", test_figure2);
    g_test_add_func("/studio/graph/the depth of a recursion may be a slider's", test_slider_depth);
    g_test_add_func("/studio/graph/a recursion by way of others ends at its first once more",
                    test_long_recursion);
    g_test_add_func("/studio/graph/presets are laid out apart and without crossings", test_layout);
    g_test_add_func("/studio/graph/what nothing leads to is shown too", test_unlinked);
    g_test_add_func("/studio/graph/links stand where they are most probably meant", test_likely);
    g_test_add_func(
        "/studio/graph/a component over the budget is heavy, one without instances empty",
        test_load);
    g_test_add_func("/studio/graph/a time is told where it can be felt", test_time);
    return g_test_run();
}
