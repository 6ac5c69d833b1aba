/// The string beside the picture: what each module drew, and what made it.
#include "studio/model/lstring.h"

#include "frond/document.h"
#include "studio.h"

static const char weed[] = "<frond version=\"1\">\n"
                           "  <plant id=\"weed\"><lsystem unit=\"0.1\"><![CDATA[\n"
                           "w : A\n"
                           "p1 : A -> F[+F@O(1)]FA\n"
                           "]]></lsystem></plant>\n"
                           "  <scene>\n"
                           "    <place plant=\"weed\" at=\"0,0,0\"/>\n"
                           "    <place plant=\"weed\" at=\"5,0,0\" scale=\"2\"/>\n"
                           "  </scene>\n"
                           "</frond>\n";

typedef struct Both {
    FrSource *source;
    FrDocument *document;
    FrScene *scene;
    StudioLstring *string;
} Both;

// The weed after some steps, as a scene and as a string.
static Both make(const char *text, const char *steps) {
    char *given = g_strdup_printf("<lsystem steps=\"%s\"", steps);
    char **parts = g_strsplit(text, "<lsystem", 2);
    char *whole = g_strjoinv(given, parts);
    Both both = {.source = fr_source_new("weed", whole, strlen(whole))};
    FrContext context = fr_context_default();
    g_assert_cmpint(fr_document_parse(both.source, ".", &context, &both.document), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(both.document, -1, &context, &both.scene), ==, FR_OK);
    g_assert_cmpint(studio_lstring_new(both.source, ".", "weed", &context, &both.string), ==,
                    FR_OK);
    g_strfreev(parts);
    g_free(given);
    g_free(whole);
    return both;
}

static void clear(Both *both) {
    studio_lstring_free(both->string);
    fr_scene_free(both->scene);
    fr_document_free(both->document);
    fr_source_unref(both->source);
}

static void check_text(const StudioLstring *string, uint32_t first, uint32_t end,
                       const char *wanted) {
    size_t size;
    const char *text = studio_lstring_text(string, first, end, &size);
    char *own = g_strndup(text, size);
    g_assert_cmpstr(own, ==, wanted);
    g_free(own);
}

static void text(void) {
    Both both = make(weed, "2");
    check_text(both.string, 0, 17, "F[+F@O(1)]FF[+F@O(1)]FA");
    check_text(both.string, 4, 6, "@O(1)");
    g_assert_cmpuint(studio_lstring_count(both.string), ==, 17);
    g_assert_cmpuint(studio_lstring_step(both.string), ==, 2);
    for (uint32_t i = 0; i < 17; i++) {
        g_assert_cmpuint(studio_lstring_at(both.string, studio_lstring_begin(both.string, i)), ==,
                         i);
    }
    g_assert_cmpuint(studio_lstring_at(both.string, 7), ==, 5); // within the parameters of O
    g_assert_cmpuint(studio_lstring_at(both.string, 1000), ==, 16);
    clear(&both);
}

static void brackets(void) {
    Both both = make(weed, "2");
    g_assert_cmpuint(studio_lstring_end_of(both.string, 0), ==, 1);
    g_assert_cmpuint(studio_lstring_end_of(both.string, 1), ==, 7);
    g_assert_cmpuint(studio_lstring_end_of(both.string, 9), ==, 15);
    clear(&both);
}

static void makers(void) {
    Both both = make(weed, "1");
    FrSpan span;
    uint32_t line, column;
    g_assert_cmpstr(studio_lstring_maker(both.string, 0, &span), ==, "p1");
    g_assert_true(span.source == both.source);
    fr_source_position(span.source, span.begin, &line, &column);
    g_assert_cmpuint(line, ==, 4);
    clear(&both);
    both = make(weed, "0");
    g_assert_null(studio_lstring_maker(both.string, 0, &span));
    fr_source_position(span.source, span.begin, &line, &column);
    g_assert_cmpuint(line, ==, 3);
    clear(&both);
}

// The second internode of the stem of the second plant runs from 1 to 2 times 0.2 m.
static void lines(void) {
    Both both = make(weed, "2");
    g_assert_true(studio_lstring_match(both.string, both.scene));
    GArray *found = studio_lstring_lines(both.string, both.scene, 7, 8);
    g_assert_cmpuint(found->len, ==, 4);
    const float *from = &g_array_index(found, float, 6), *to = from + 3;
    g_assert_cmpfloat_with_epsilon((double)from[0], 5, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)from[2], 0.2, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)to[2], 0.4, 1e-6);
    g_array_unref(found);
    found = studio_lstring_lines(both.string, both.scene, 1, 7); // a branch with a ball on it
    g_assert_cmpuint(found->len, ==, 2 * (2 + 8));
    g_array_unref(found);
    found = studio_lstring_lines(both.string, both.scene, 2, 3); // a turn
    g_assert_cmpuint(found->len, ==, 0);
    g_array_unref(found);
    clear(&both);
}

static void picked(void) {
    static const double there[3] = {5, -3, 0.3}, beside[3] = {9, -3, 0.3}, ahead[3] = {0, 1, 0};
    Both both = make(weed, "2");
    g_assert_cmpuint(studio_lstring_pick(both.string, both.scene, there, ahead, 0.001), ==,
                     FR_NONE); // not before they are matched
    studio_lstring_match(both.string, both.scene);
    g_assert_cmpuint(studio_lstring_pick(both.string, both.scene, there, ahead, 0.001), ==, 7);
    g_assert_cmpuint(studio_lstring_pick(both.string, both.scene, beside, ahead, 0.001), ==,
                     FR_NONE);
    g_assert_cmpuint(studio_lstring_pick(both.string, NULL, there, ahead, 0.001), ==, FR_NONE);
    clear(&both);
}

static void other(void) {
    Both both = make(weed, "2"), later = make(weed, "3");
    g_assert_false(studio_lstring_match(both.string, later.scene));
    GArray *found = studio_lstring_lines(both.string, later.scene, 0, 17);
    g_assert_cmpuint(found->len, ==, 0);
    g_array_unref(found);
    clear(&both);
    clear(&later);
}

static void too_long(void) {
    static const char doubled[] = "<frond version=\"1\"><plant id=\"weed\"><lsystem>w : A\n"
                                  "p1 : A -> AA\n</lsystem></plant></frond>\n";
    Both both = make(doubled, "20");
    g_assert_cmpuint(studio_lstring_count(both.string), ==, 1 << 20);
    g_assert_false(studio_lstring_is_shown(both.string));
    g_assert_false(studio_lstring_match(both.string, both.scene));
    clear(&both);
}

static void words(void) {
    static const struct {
        const char *length, *words;
    } cases[] = {{"derivation length: 3\n", "Step 2 of 3 · 17 modules"},
                 {"derivation length: 1\n", "Step 2, 1 beyond the length · 17 modules"},
                 {"", "Step 2 · 17 modules"}};
    char **parts = g_strsplit(weed, "w : A", 2);
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        char *text = g_strconcat(parts[0], cases[i].length, "w : A", parts[1], NULL);
        Both both = make(text, "2");
        char *said = studio_lstring_words(both.string);
        g_assert_cmpstr(said, ==, cases[i].words);
        g_free(said);
        clear(&both);
        g_free(text);
    }
    g_strfreev(parts);
}

static void no_lsystem(void) {
    static const char horn[] = "<frond version=\"1\"><plant id=\"weed\"><pgraph><horn id=\"h\"/>"
                               "</pgraph></plant></frond>\n";
    FrSource *source = fr_source_new("horn", horn, strlen(horn));
    FrContext context = fr_context_default();
    StudioLstring *string;
    g_assert_cmpint(studio_lstring_new(source, ".", "weed", &context, &string), ==, FR_ERR_USAGE);
    g_assert_null(string);
    g_assert_cmpint(studio_lstring_new(source, ".", "tree", &context, &string), ==, FR_ERR_USAGE);
    fr_source_unref(source);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/lstring/modules are read as they are printed", text);
    g_test_add_func("/studio/lstring/a bracket belongs to the one that closes it", brackets);
    g_test_add_func("/studio/lstring/a module knows the production that made it", makers);
    g_test_add_func("/studio/lstring/a module knows what it drew wherever that stands", lines);
    g_test_add_func("/studio/lstring/what a ray meets knows its module", picked);
    g_test_add_func("/studio/lstring/another plant is not taken for it", other);
    g_test_add_func("/studio/lstring/a string that is too long is only counted", too_long);
    g_test_add_func("/studio/lstring/steps beyond the length are none of it", words);
    g_test_add_func("/studio/lstring/a plant that is no L-system has none", no_lsystem);
    return g_test_run();
}
