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

static void test_figure2(void) {
    StudioDocument *document = open_example("examples/figure2.frond");
    StudioGraph *graph = graph_of(document);
    g_assert_cmpuint(graph->boxes->len, ==, 4);
    g_assert_cmpuint(graph->wires->len, ==, 4);
    g_assert_true(box_of(graph, "D")->is_recursive);
    g_assert_false(box_of(graph, "C")->is_recursive);
    g_assert_cmpfloat(graph->rows, ==, 4);
    g_assert_cmpfloat(graph->columns, ==, 1);
    studio_graph_free(graph);
    studio_document_free(document);
}

static void assert_apart(const StudioGraph *graph) {
    for (guint i = 0; i < graph->boxes->len; i++) {
        for (guint j = 0; j < i; j++) {
            const StudioBox *a = studio_graph_box(graph, i), *b = studio_graph_box(graph, j);
            g_assert_true(a->row != b->row || fabs(a->column - b->column) >= 1);
        }
    }
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
                double below =
                    studio_graph_box(graph, a->to)->column - studio_graph_box(graph, b->to)->column;
                g_assert_true(above * below >= 0);
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
    StudioDocument *document = studio_document_new(text, strlen(text), "x", NULL);
    StudioGraph *graph = graph_of(document);
    g_assert_cmpuint(graph->boxes->len, ==, 4);
    g_assert_cmpuint(graph->wires->len, ==, 2);
    g_assert_false(box_of(graph, "b")->is_reached);
    g_assert_false(box_of(graph, "b")->is_enabled);
    assert_apart(graph);
    studio_graph_free(graph);
    studio_document_free(document);
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
    g_test_add_func("/studio/graph/presets are laid out apart and without crossings", test_layout);
    g_test_add_func("/studio/graph/what nothing leads to is shown too", test_unlinked);
    g_test_add_func("/studio/graph/links stand where they are most probably meant", test_likely);
    g_test_add_func(
        "/studio/graph/a component over the budget is heavy, one without instances empty",
        test_load);
    g_test_add_func("/studio/graph/a time is told where it can be felt", test_time);
    return g_test_run();
}
