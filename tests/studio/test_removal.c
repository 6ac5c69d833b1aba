#include "studio/model/removal.h"

#include "studio.h"
#include "studio/model/commands.h"

#define BUSH                                                                                       \
    "<frond version=\"1\">\n"                                                                      \
    "  <material id=\"bark\"/><curve id=\"bend\" points=\"0,0 1,1\"/>\n"                           \
    "  <plant id=\"p\"><pgraph>\n"                                                                 \
    "    <camera id=\"root\"/>\n"                                                                  \
    "    <tree id=\"t\" material=\"bark\" length=\"bend(0.5)\"/>\n"                                \
    "    <horn id=\"twig\" material=\"bark\"/><horn id=\"spur\" material=\"bark\"/>\n"             \
    "    <horn id=\"root-horn\" material=\"bark\"/><leaf id=\"leaf\" material=\"bark\"/>\n"        \
    "    <link from=\"root\" to=\"t\"/><link from=\"t\" to=\"twig\"/>\n"                           \
    "    <link from=\"t\" to=\"spur\"/><link from=\"spur\" to=\"spur\"/>\n"                        \
    "    <link from=\"t\" to=\"leaf\"/><link from=\"twig\" to=\"leaf\"/>\n"                        \
    "  </pgraph></plant>\n"                                                                        \
    "  <scene><place plant=\"p\"/><view name=\"front\" eye=\"1,0,0\" target=\"0,0,0\"/></scene>\n" \
    "</frond>\n"

static void test_words(void) {
    static const char *const cases[][2] = {
        {"bend", "Removed bend, which t still uses"},
        {"bark", "Removed bark, which t, twig, spur and 2 more still use"},
        {"p", "Removed p, which the place still uses"},
        // What another one leads to as well, or what stood alone before, is not told.
        {"t", "Removed t; nothing leads to twig and spur now"},
        {"twig", "Removed twig"},
        {"root", "Removed root; nothing leads to t now"},
    };
    StudioDocument *document = studio_document_new(BUSH, strlen(BUSH), "test", NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        uint32_t element = fr_contents_find(studio_document_contents(document), 0, cases[i][0]);
        char *words = studio_removal_words(document, element);
        g_assert_cmpstr(words, ==, cases[i][1]);
        g_free(words);
    }
    const FrContents *contents = studio_document_contents(document);
    uint32_t scene = fr_contents_child(contents, 0, "scene");
    char *words = studio_removal_words(document, fr_contents_child(contents, scene, "view"));
    g_assert_cmpstr(words, ==, "Removed front");
    g_free(words);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/removal/it is told who still needs what is removed", test_words);
    return g_test_run();
}
