#include "variation/skeleton_mtg.h"

#include <string.h>

static const char head[] = "CODE:\tFORM-A\n\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\t"
                           "DEFINITION\n$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tFREE\tFREE\tEXPLICIT\n"
                           "\nFEATURES:\nNAME\tTYPE\nXX\tREAL\n\nMTG:\n";

static FrStatus read_graph(const char *text, FrContext *context, FrSegment **lines, size_t *count) {
    FrSource *source = fr_source_new("plant.mtg", text, strlen(text));
    *context = fr_context_default();
    context->diags = fr_diags_new();
    FrStatus status = fr_skeleton_read_mtg(source, context, lines, count);
    fr_source_unref(source);
    return status;
}

static void finish(FrContext *context, FrSegment *lines) {
    g_free(lines);
    fr_diags_free(context->diags);
}

static void assert_line(const FrSegment *line, vec3s from, vec3s to, double radius) {
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon((double)line->from.raw[k], (double)from.raw[k], 1e-6);
        g_assert_cmpfloat_with_epsilon((double)line->to.raw[k], (double)to.raw[k], 1e-6);
    }
    g_assert_cmpfloat_with_epsilon((double)line->radius, radius, 1e-6);
}

/// The example of the format's description: two internodes, a branch on the first.
static void branches(void) {
    char *text = g_strconcat(head,
                             "ENTITY-CODE\t\t\tDiameter\tXX\tYY\tZZ\n"
                             "/P1\t\t\t\t0\t0\t0\n"
                             "\t/A1/I1\t\t0.02\t0\t0\t1 \n"
                             "\t\t+A2/I1\t0.008\t0.5\t0\t1.5\r\n"
                             "\t\t+L1\t\t0.2\t0\t1\n"
                             "\n# a remark\n"
                             "\t^<I2\t\t0.018\t0\t0\t2\n",
                             NULL);
    FrContext context;
    FrSegment *lines;
    size_t count;
    g_assert_cmpint(read_graph(text, &context, &lines, &count), ==, FR_OK);
    g_assert_cmpuint(count, ==, 3); // the leaf has no diameter
    assert_line(&lines[0], (vec3s){{0, 0, 0}}, (vec3s){{0, 0, 1}}, 0.01);
    assert_line(&lines[1], (vec3s){{0, 0, 1}}, (vec3s){{0.5F, 0, 1.5F}}, 0.004);
    assert_line(&lines[2], (vec3s){{0, 0, 1}}, (vec3s){{0, 0, 2}}, 0.009);
    finish(&context, lines);
    g_free(text);
}

/// Graphs of the field often begin with all scales in one label, and have points alone.
static void points(void) {
    char *text = g_strconcat(head,
                             "ENTITY-CODE\t\tXX\tYY\tZZ\n"
                             "/P1/A1/I1\t\t1\t0\t0\n"
                             "\t+I2\t1\t1\t0\n"
                             "^<I3\t\t2\t0\t0\n"
                             "^<I4\t\t\t\t\n"
                             "/P2/A1/I1\t\t9\t0\t0\n"
                             "^<I2\t\t9\t0\t1\n",
                             NULL);
    FrContext context;
    FrSegment *lines;
    size_t count;
    g_assert_cmpint(read_graph(text, &context, &lines, &count), ==, FR_OK);
    g_assert_cmpuint(count, ==, 3);
    assert_line(&lines[0], (vec3s){{1, 0, 0}}, (vec3s){{1, 1, 0}}, 0.01);
    assert_line(&lines[1], (vec3s){{1, 0, 0}}, (vec3s){{2, 0, 0}}, 0.01);
    assert_line(&lines[2], (vec3s){{9, 0, 0}}, (vec3s){{9, 0, 1}}, 0.01);
    finish(&context, lines);
    g_free(text);
}

static void wrong_graphs(void) {
    static const struct {
        const char *code, *text;
        uint32_t line;
    } wrong[] = {
        {"mtg-section", "", 1},
        {"mtg-section", "0 0 0 0 0 1\n", 1},
        {"mtg-section", "MTG:\n", 1},
        {"mtg-coordinates", "MTG:\nENTITY-CODE\tLength\n/P1\t3\n", 2},
        {"mtg-coordinates", "MTG:\nENTITY-CODE\n/P1\n", 2},
        {"mtg-number", "MTG:\nENTITY-CODE\tXX\tYY\tZZ\n/P1\t1\tx\t0\n", 3},
        {"mtg-number", "MTG:\nENTITY-CODE\tXX\tYY\tZZ\n/P1\t1\tnan\t0\n", 3},
        {"mtg-number", "MTG:\nENTITY-CODE\tXX\tYY\tZZ\n/P1\t1\t1e30\t0\n", 3},
        {"mtg-entity", "MTG:\nENTITY-CODE\tXX\tYY\tZZ\nP1\t1\t1\t0\n", 3},
        {"mtg-entity", "MTG:\nENTITY-CODE\tXX\tYY\tZZ\n\t1\t1\t0\n", 3},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        FrContext context;
        FrSegment *lines;
        size_t count;
        g_assert_cmpint(read_graph(wrong[i].text, &context, &lines, &count), ==, FR_ERR_DOCUMENT);
        g_assert_cmpuint(count, ==, 0);
        g_assert_null(lines);
        const FrDiag *diag = fr_diags_get(context.diags, 0);
        g_assert_cmpstr(diag->code, ==, wrong[i].code);
        uint32_t line, column;
        fr_source_position(diag->span.source, diag->span.begin, &line, &column);
        g_assert_cmpuint(line, ==, wrong[i].line);
        finish(&context, lines);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/variation/mtg/branches hang on the entity one column before", branches);
    g_test_add_func("/variation/mtg/points alone become lines between them", points);
    g_test_add_func("/variation/mtg/what is no graph with places is refused where it stands",
                    wrong_graphs);
    return g_test_run();
}
