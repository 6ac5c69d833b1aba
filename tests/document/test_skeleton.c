/// Skeletons within documents: what is read, and where errors are.
#include "documents.h"

#include <cglm/struct.h>

#define HOLD(attributes, within)                                                                   \
    "<frond version='1'>\n<plant id='scan'><skeleton" attributes ">" within                        \
    "</skeleton></plant>\n"                                                                        \
    "</frond>\n"

static void error_at(const char *text, const char *code, uint32_t line, uint32_t column) {
    Parsed parsed = parse(text);
    assert_one_error(&parsed, FR_ERR_DOCUMENT, code, line, column);
    forget(&parsed);
}

static void places(void) {
    error_at(HOLD("", ""), "missing-text", 2, 19);
    error_at(HOLD(" file='none.txt'", ""), "missing-file", 2, 34);
    error_at(HOLD(" file='none.txt'", "0 0 0 0 0 1"), "two-definitions", 2, 34);
    error_at(HOLD("", "\n0 0 0 0 0 1 0.1\n0 0 1 0 0\n"), "bad-table", 4, 1);
    error_at(HOLD("", "\n<![CDATA[\n0 0 0 0 0 1 0.1\n 0 0 1 0 0 2 -1]]>"), "bad-table", 5, 1);
    error_at(HOLD(" material='bark'", "0 0 0 0 0 1"), "unknown-material", 2, 38);
    error_at(HOLD(" unit='0'", "0 0 0 0 0 1"), "out-of-range", 2, 34);
}

static void a_plant(void) {
    // In centimetres: a stem of two lines and a branch where they meet.
    Parsed parsed = parse(HOLD(" unit='0.01'", "<![CDATA[0,0,0 0,0,100 10\n"
                                               "0,0,100 0,0,180 8 # goes on\n"
                                               "0,0,100 60,0,180 4]]>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    const FrPlantDef *definition = g_ptr_array_index(fr_document_plants(parsed.document), 0);
    g_assert_cmpint(definition->kind, ==, FR_PLANT_SKELETON);
    FrContext context = fr_context_default();
    FrPlant *plant;
    g_assert_cmpint(fr_skeleton_grow(definition->skeleton, "scan", &context, &plant), ==, FR_OK);
    g_assert_cmpuint(plant->axes.count, ==, 2);
    g_assert_cmpuint(plant->nodes.count, ==, 3);
    g_assert_cmpfloat_with_epsilon(plant->nodes.position[1].z, 1.8f, 1e-6f);
    g_assert_cmpfloat_with_epsilon(plant->nodes.position[2].x, 0.6f, 1e-6f);
    g_assert_cmpfloat_with_epsilon(plant->axes.base_radius[0], 0.1f, 1e-7f);
    fr_plant_free(plant);
    forget(&parsed);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/skeleton/errors are where they were written", places);
    g_test_add_func("/document/skeleton/a table of lines becomes a plant", a_plant);
    return g_test_run();
}
