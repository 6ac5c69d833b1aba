/// The three levels of a species show and change what the document holds.
#include "studio/model/levels.h"

#include "studio.h"

#define WOOD(species)                                                                              \
    "<frond version=\"1\">\n  <plant id=\"tree\">\n    " species "\n  </plant>\n"                  \
    "  <plant id=\"stem\"><pgraph><horn id=\"h\"/></pgraph></plant>\n"                             \
    "  <scene>\n    <place plant=\"tree\"/>\n    <place plant=\"stem\"/>\n    <obstacle/>\n"       \
    "  </scene>\n</frond>\n"

static StudioDocument *document_of(const char *text) {
    return studio_document_new(text, strlen(text), "wood", NULL);
}

static uint32_t find(const StudioDocument *document, const char *parent, const char *tag) {
    const FrContents *contents = studio_document_contents(document);
    return fr_contents_child(contents, fr_contents_child(contents, 0, parent), tag);
}

static void test_meant(void) {
    StudioDocument *document = document_of(WOOD("<species><order/></species>"));
    const FrContents *contents = studio_document_contents(document);
    uint32_t species = find(document, "plant", "species");
    uint32_t place = find(document, "scene", "place");
    g_assert_cmpuint(studio_levels_species(document, FR_NONE, first_plant(document)), ==, species);
    g_assert_cmpuint(studio_levels_species(document, species + 1, FR_NONE), ==, species);
    g_assert_cmpuint(studio_levels_species(document, place, FR_NONE), ==, species);
    g_assert_cmpuint(studio_levels_species(document, fr_contents_sibling(contents, place), species),
                     ==, FR_NONE);
    g_assert_cmpuint(studio_levels_species(document, find(document, "scene", "obstacle"), species),
                     ==, FR_NONE);
    g_assert_cmpuint(studio_levels_species(document, element_of(document, "h"), FR_NONE), ==,
                     FR_NONE);
    g_assert_true(studio_levels_are_whole(document, species));
    g_assert_true(studio_levels_are_whole(document, FR_NONE));
    g_assert_false(studio_levels_are_whole(document, species + 1));
    g_assert_false(studio_levels_are_whole(document, place));
    studio_document_free(document);
}

// The first number adds the element, and a drag is one step all the same.
static void test_added(void) {
    StudioDocument *document = document_of(WOOD("<species step=\"0.4\"/>"));
    uint32_t species = find(document, "plant", "species");
    g_assert_cmpfloat(studio_levels_get(document, species, "light"), ==, 0);
    g_assert_false(studio_levels_set(document, species, "light", 0));
    g_assert_true(studio_levels_set(document, species, "light", 0.25));
    g_assert_true(studio_levels_set(document, species, "light", 0.5));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_cmpfloat(studio_levels_get(document, species, "light"), ==, 0.5);
    g_assert_nonnull(strstr(text_of(document), "<sliders light=\"0.5\"/>"));
    g_assert_true(studio_levels_set(document, species, "gravity", -1));
    g_assert_cmpuint(studio_document_steps(document), ==, 2);
    g_assert_true(studio_document_undo(document) && studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, WOOD("<species step=\"0.4\"/>"));
    studio_document_free(document);
}

static void test_kept(void) {
    StudioDocument *document =
        document_of(WOOD("<species><sliders twist=\"-0.3\"/><order/></species>"));
    uint32_t species = find(document, "plant", "species");
    g_assert_cmpfloat(studio_levels_get(document, species, "twist"), ==, -0.3);
    g_assert_true(studio_levels_set(document, species, "density", 0.7));
    g_assert_nonnull(
        strstr(text_of(document), "<sliders twist=\"-0.3\" density=\"0.7\"/><order/>"));
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/levels/a species is meant by its plant and its places", test_meant);
    g_test_add_func("/studio/levels/the first number adds the six in the same step", test_added);
    g_test_add_func("/studio/levels/a number changes no other", test_kept);
    return g_test_run();
}
