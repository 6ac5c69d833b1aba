/// Sliders of plants: one handle for many numbers.
#include "documents.h"

#include "frond/param.h"

#include <math.h>

/// A plant of a trunk with leaves; `sliders` stand before its graph.
static Parsed parse_plant(const char *sliders, const char *trunk) {
    char *inner = g_strdup_printf("<plant id='p'>%s<pgraph><camera id='root'/><tree id='trunk' %s/>"
                                  "<leaf id='leaf'/><link from='root' to='trunk'/>"
                                  "<link from='trunk' to='leaf' kind='branch'/></pgraph></plant>",
                                  sliders, trunk);
    char *text = in_root(inner);
    Parsed parsed = parse(text);
    char *said = printed(parsed.diags);
    g_test_message("%s", said);
    g_assert_cmpint(parsed.status, ==, FR_OK);
    g_free(said);
    g_free(text);
    g_free(inner);
    return parsed;
}

static const FrPlantDef *plant_of(const Parsed *parsed) {
    return g_ptr_array_index(fr_document_plants(parsed->document), 0);
}

/// The value of one number of the trunk, for a child in the middle of its siblings.
static double number_of(const Parsed *parsed, const char *attribute) {
    FrPgraph *graph = plant_of(parsed)->pgraph;
    uint32_t trunk = fr_pgraph_find(graph, "trunk");
    const FrParam *row = fr_params_find(fr_pgraph_table(fr_pgraph_kind(graph, trunk)), attribute);
    const char *params = fr_pgraph_params(graph, trunk);
    FrVars vars = {.value = {[FR_VAR_t] = 0.5}};
    return fr_number_eval((const FrNumber *)(const void *)(params + row->offset), &vars, 0, NULL);
}

static uint64_t leaves_of(const FrPgraph *graph) {
    FrContext context = fr_context_default();
    FrPgraphCounts counts = {0};
    FrPlant *plant;
    g_assert_cmpint(fr_pgraph_build(graph, &context, &plant, &counts), ==, FR_OK);
    uint64_t leaves = counts.by_component[fr_pgraph_find(graph, "leaf")];
    g_free(counts.by_component);
    fr_plant_free(plant);
    return leaves;
}

static void test_forms(void) {
    static const struct {
        const char *length;
        double value;
    } rows[] = {
        {"2 | size", 6},                  // the slider stands at 3
        {"= 1 + size^2", 10},             // in an expression
        {"2..4 : t*size", 5},             // in a function: 2 + 0.5*3*2
        {"2 | size 0,0 6,1", 1},          // through a curve of its own: 2*0.5
        {"2..4 | size | parent fall", 9}, // with other curves; at the base of the parent
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *attribute = g_strdup_printf("length='%s'", rows[i].length);
        Parsed parsed = parse_plant("<slider id='size' max='5' initial='3'/>", attribute);
        g_assert_cmpfloat_with_epsilon(number_of(&parsed, "length"), rows[i].value, 1e-12);
        forget(&parsed);
        g_free(attribute);
    }
}

static void test_constant(void) {
    Parsed parsed = parse_plant("<slider id='size' max='5' initial='3'/>", "length='2 | size'");
    FrPgraph *graph = plant_of(&parsed)->pgraph;
    const FrParam *row = fr_params_find(fr_pgraph_table(FR_COMPONENT_TREE), "length");
    const char *params = fr_pgraph_params(graph, fr_pgraph_find(graph, "trunk"));
    g_assert_true(((const FrNumber *)(const void *)(params + row->offset))->is_constant);
    forget(&parsed);
}

static void test_whole_numbers(void) {
    Parsed parsed = parse_plant("<slider id='d' max='9' initial='2.6'/>",
                                "number='5' depth='= d' enabled='= d &gt; 2'");
    FrPgraph *graph = plant_of(&parsed)->pgraph;
    const char *params = fr_pgraph_params(graph, fr_pgraph_find(graph, "trunk"));
    const FrParamTable *table = fr_pgraph_table(FR_COMPONENT_TREE);
    const FrParam *depth = fr_params_find(table, "depth");
    g_assert_cmpint(*(const int64_t *)(const void *)(params + depth->offset), ==, 3);
    g_assert_true(*(const bool *)(params + fr_params_find(table, "enabled")->offset));
    forget(&parsed);
}

static void test_set(void) {
    const char *sliders = "<slider id='full' label='leaves' min='0' max='3' initial='1'/>";
    Parsed parsed = parse_plant(sliders, "number='10 | full'");
    FrContext context = fr_context_default();
    context.diags = parsed.diags;
    g_assert_cmpuint(leaves_of(plant_of(&parsed)->pgraph), ==, 10);
    g_assert_cmpint(fr_document_set(parsed.document, "p.full", "2.5", &context), ==, FR_OK);
    const FrSlider *slider = g_ptr_array_index(plant_of(&parsed)->sliders, 0);
    g_assert_cmpfloat(slider->value, ==, 2.5);
    g_assert_cmpfloat(slider->initial, ==, 1);
    g_assert_cmpuint(leaves_of(plant_of(&parsed)->pgraph), ==, 25);
    // Another individual of the plant goes by the same sliders.
    FrPgraph *other = fr_document_reseed(parsed.document, plant_of(&parsed), 7, NAN);
    g_assert_cmpuint(leaves_of(other), ==, 25);
    fr_pgraph_free(other);
    // Out of its range nothing changes.
    g_assert_cmpint(fr_document_set(parsed.document, "p.full", "3.5", &context), ==,
                    FR_ERR_DOCUMENT);
    g_assert_cmpuint(leaves_of(plant_of(&parsed)->pgraph), ==, 25);
    size_t size;
    char *text = fr_document_text(parsed.document, &size);
    g_assert_nonnull(strstr(text, "initial='1' value=\"2.5\"/>"));
    g_free(text);
    forget(&parsed);
}

static const void *field_of(const Parsed *parsed, const char *attribute) {
    FrPgraph *graph = plant_of(parsed)->pgraph;
    uint32_t trunk = fr_pgraph_find(graph, "trunk");
    const FrParam *row = fr_params_find(fr_pgraph_table(FR_COMPONENT_TREE), attribute);
    return (const char *)fr_pgraph_params(graph, trunk) + row->offset;
}

// A choice, a curve, points, a vector, a text: whatever is no number follows a slider by picking.
static void test_picking(void) {
    Parsed parsed = parse_plant(
        "<slider id='kind' choices='slim broad flat' initial='broad'/><slider id='w' max='9'/>",
        "course='= pick(kind, grown; steps; steps)' profile='= pick(kind+1, fall; fall; ramp)' "
        "section='= pick(kind, 0,0 1,1; 0,0 1,1 2,0; 0,0 1,0)' step-translate='= w, 2*w, max(w, "
        "3)' "
        "only='= pick(kind - 7, odd; even)'");
    FrContext context = fr_context_default();
    g_assert_cmpint(*(const int *)field_of(&parsed, "course"), ==, 2);
    g_assert_cmpfloat(fr_curve_eval(*(FrCurve *const *)field_of(&parsed, "profile"), 1), ==, 1);
    g_assert_cmpuint(((const FrPoints *)field_of(&parsed, "section"))->count, ==, 3);
    const vec3s *by = field_of(&parsed, "step-translate");
    g_assert_cmpfloat(by->x, ==, 1);
    g_assert_cmpfloat(by->y, ==, 2);
    g_assert_cmpfloat(by->z, ==, 3);
    g_assert_cmpstr(*(char *const *)field_of(&parsed, "only"), ==, "odd");
    g_assert_cmpint(fr_document_set(parsed.document, "p.kind", "slim", &context), ==, FR_OK);
    g_assert_cmpint(*(const int *)field_of(&parsed, "course"), ==, 0);
    g_assert_cmpuint(((const FrPoints *)field_of(&parsed, "section"))->count, ==, 2);
    g_assert_cmpint(fr_document_set(parsed.document, "p.kind", "2", &context), ==, FR_OK);
    char *name = fr_slider_choice(g_ptr_array_index(plant_of(&parsed)->sliders, 0));
    g_assert_cmpstr(name, ==, "flat");
    g_free(name);
    forget(&parsed);
}

// What is wrong in a list is told where it stands, chosen or not.
static void test_wrong_picks(void) {
    static const struct {
        const char *trunk, *code;
        uint32_t column;
    } rows[] = {
        {"crown='= pick(k, conical; flam)'", "unknown-choice", 101},
        {"crown='= pick(k, )'", "unknown-choice", 92},
        {"crown='= pick(k)'", "bad-value", 82},
        {"crown='= pick(x, conical; flame)'", "not-fixed", 89},
        {"profile='= pick(k, fall; 0,0 0,1)'", "curve-order", 104},
        {"step-translate='= k, 1'", "bad-value", 91},
        {"step-translate='= k, 1, 2, 3'", "bad-value", 101},
        {"step-translate='= 5000*k, 1, 2'", "out-of-range", 92},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *inner = g_strdup_printf(
            "<plant id='p'><slider id='k'/><pgraph><camera id='root'/><tree id='trunk' %s/>"
            "</pgraph></plant>",
            rows[i].trunk);
        char *text = in_root(inner);
        Parsed parsed = parse(text);
        assert_one_error(&parsed, FR_ERR_DOCUMENT, rows[i].code, 2, rows[i].column);
        forget(&parsed);
        g_free(text);
        g_free(inner);
    }
    char *text = in_root("<plant id='p'><slider id='k' choices='a b a'/><pgraph><leaf id='l'/>"
                         "</pgraph></plant>");
    Parsed parsed = parse(text);
    assert_one_error(&parsed, FR_ERR_DOCUMENT, "bad-choices", 2, 39);
    forget(&parsed);
    g_free(text);
}

static void test_own(void) {
    char *text = in_root("<plant id='a'><slider id='k' max='9' initial='2'/><pgraph>"
                         "<horn id='h' length='1 | k'/></pgraph></plant>"
                         "<plant id='b'><pgraph><horn id='h' length='1 | k'/></pgraph></plant>");
    Parsed parsed = parse(text);
    assert_one_error(&parsed, FR_ERR_DOCUMENT, "unknown-name", 2, 152);
    forget(&parsed);
    g_free(text);
}

int main(int argc, char *argv[]) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/sliders/a slider multiplies, or stands in expressions", test_forms);
    g_test_add_func("/document/sliders/a number times a slider is a constant", test_constant);
    g_test_add_func("/document/sliders/whole numbers and switches follow sliders",
                    test_whole_numbers);
    g_test_add_func("/document/sliders/setting a plant's slider changes all that use it", test_set);
    g_test_add_func("/document/sliders/choices, curves, points, vectors and texts follow sliders",
                    test_picking);
    g_test_add_func("/document/sliders/what may be picked must be right", test_wrong_picks);
    g_test_add_func("/document/sliders/a slider belongs to its plant alone", test_own);
    return g_test_run();
}
