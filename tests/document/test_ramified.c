/// `<ramified>` and `<nurbs>` in documents: what is read, and where errors are.
#include "documents.h"

#define HOLD(attributes, within)                                                                   \
    "<frond version='1'>\n<plant id='tree'><ramified" attributes ">" within                        \
    "</ramified></plant>\n"                                                                        \
    "</frond>\n"
#define BENT(attributes)                                                                           \
    "<frond version='1'>\n<plant id='tree'><nurbs" attributes "/><ramified/></plant>\n</frond>\n"

static void error_at(const char *text, const char *code, uint32_t line, uint32_t column) {
    Parsed parsed = parse(text);
    assert_one_error(&parsed, FR_ERR_DOCUMENT, code, line, column);
    forget(&parsed);
}

static void places(void) {
    error_at(HOLD(" by='matrix'", ""), "missing-text", 2, 19);
    error_at(HOLD(" by='strands'", "0.5 0.5"), "misplaced-text", 2, 19);
    error_at(HOLD(" by='matrix' order='2'", "\n0.5 0.2"), "bad-matrix", 3, 1);
    error_at(HOLD(" by='matrix' order='3'", "\n0.5 0.5\n 0.5 0.5"), "bad-matrix", 4, 2);
    error_at(HOLD(" by='chance'", ""), "unknown-choice", 2, 32);
    error_at(HOLD(" order='31'", ""), "out-of-range", 2, 35);
    error_at(HOLD(" leaf-material='green'", ""), "unknown-material", 2, 43);
    error_at(BENT(" wind='east'"), "bad-value", 2, 31);
    error_at(BENT(" voxel='-1'"), "out-of-range", 2, 32);
    error_at(BENT(" circel='nine'"), "unknown-attribute", 2, 25);
    error_at("<frond version='1'>\n<plant id='a'><nurbs/><nurbs/><ramified/></plant>\n</frond>\n",
             "repeated-element", 2, 24);
}

static void settings(void) {
    Parsed parsed = parse(BENT(" wind='2, 0, 0' circle='nine' weights='pipe'"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    const FrPlantDef *definition = g_ptr_array_index(fr_document_plants(parsed.document), 0);
    g_assert_cmpint(definition->kind, ==, FR_PLANT_RAMIFIED);
    g_assert_true(definition->has_nurbs);
    g_assert_cmpint(definition->nurbs.circle, ==, FR_CIRCLE_NINE);
    g_assert_cmpint(definition->nurbs.weights, ==, FR_WEIGHTS_PIPE);
    g_assert_cmpfloat(definition->nurbs.wind.x, ==, 2);
    FrContext context = fr_context_default();
    FrPlant *plant;
    g_assert_cmpint(fr_ramified_grow(definition->ramified, "tree", 1, &context, &plant), ==, FR_OK);
    g_assert_cmpuint(plant->nodes.count % 2, ==, 1);
    fr_plant_free(plant);
    forget(&parsed);
}

static void spare_rows(void) {
    Parsed parsed = parse(HOLD(" by='matrix' order='2'", "\n0.5 0.5\n0 0.5 0.5\n0 0 0.5 0.5"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(parsed.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, "unused-rows");
    forget(&parsed);
}

/// A document of a horn with that section, and how many warnings it has; the first is at the
/// section.
static uint32_t warnings_of(const char *section, const char *more) {
    char *text = g_strdup_printf("<frond version='1'>\n<plant id='a'><pgraph><camera id='c'/>"
                                 "<horn id='h' section='%s'%s/><link from='c' to='h'/>"
                                 "</pgraph></plant>\n</frond>\n",
                                 section, more);
    Parsed parsed = parse(text);
    g_assert_cmpint(parsed.status, ==, FR_OK);
    uint32_t count = (uint32_t)fr_diags_count(parsed.diags), line, column;
    if (count > 0) {
        const FrDiag *diag = fr_diags_get(parsed.diags, 0);
        g_assert_cmpstr(diag->code, ==, "bad-section");
        g_assert_cmpint(diag->severity, ==, FR_WARNING);
        fr_source_position(diag->span.source, diag->span.begin, &line, &column);
        g_assert_cmpuint(line, ==, 2);
        g_assert_cmpuint(column, ==, 61);
    }
    forget(&parsed);
    g_free(text);
    return count;
}

static void sections(void) {
    static const char *const bad[] = {"0,0 1,0 0,0 1,0 2,0", "1,0", "0,0 0,0 0,0",
                                      "1e30,0 0,1e30 -1e30,0", "1e30,0 0,1 -1,0 0,-1"};
    for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
        g_assert_cmpuint(warnings_of(bad[i], ""), ==, 1);
    }
    g_assert_cmpuint(warnings_of("1,0 0,1 -1,0 0,-1", ""), ==, 0);
    g_assert_cmpuint(warnings_of("", ""), ==, 0);
    g_assert_cmpuint(warnings_of("-1,0 1,0", " primitive='area'"), ==, 0);
    g_assert_cmpuint(warnings_of("1,0", " primitive='area'"), ==, 1);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/ramified/errors are where they were written", places);
    g_test_add_func("/document/ramified/sections that make no sound surface are told", sections);
    g_test_add_func("/document/ramified/rows that are not used are told", spare_rows);
    g_test_add_func("/document/ramified/settings reach the plant", settings);
    return g_test_run();
}
