/// L-systems within documents: where their errors are, which numbers they are given.
#include "documents.h"

#define HOLD(attributes, within)                                                                   \
    "<frond version='1'>\n<plant id='bush'><lsystem" attributes ">" within "</lsystem></plant>\n"  \
    "</frond>\n"

static void error_at(const char *text, const char *code, uint32_t line, uint32_t column) {
    Parsed parsed = parse(text);
    assert_one_error(&parsed, FR_ERR_DOCUMENT, code, line, column);
    forget(&parsed);
}

static void places_in_cdata(void) {
    error_at(HOLD("", "<![CDATA[\nw : A\np1 : A -> F(1+)A\n]]>"), "syntax", 4, 15);
    error_at(HOLD("", "<![CDATA[\n#if 1\nw : A\n]]>"), "directive", 3, 1);
    error_at(HOLD("", "<![CDATA[\nLsystem: 1\naxiom: F(sni(30))\n\nendlsystem\n]]>"),
             "unknown-function", 4, 10);
}

static void places_behind_references(void) {
    error_at(HOLD("", "\nw : A(1)\np1 : A(x) : x &lt; 3 &amp;&amp; x &lt;&lt; 4 -> A(x)\n"),
             "syntax", 4, 39);
}

static void many_errors(void) {
    Parsed parsed = parse(HOLD("", "<![CDATA[\nw : A\np1 : A -> F(1+)A\np2 : B -> F(+2)\n]]>"));
    g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 2);
    forget(&parsed);
}

// What asks for a number may stand where the text has not been understood.
static void numbers_of_wrong_texts(void) {
    error_at(HOLD("", "<![CDATA[\nw : A\np1 : A( F[+(r)A]\n]]><define id='r' value='1'/>"),
             "syntax", 4, 10);
    error_at(HOLD("", "<![CDATA[\nw : A\np1 : A -> F(r) /* B\n]]><define id='s' value='1'/>"),
             "comment", 4, 16);
}

static void wrong_definitions(void) {
    error_at(HOLD("", ""), "missing-text", 2, 19);
    error_at(HOLD(" file='none.l'", ""), "missing-file", 2, 33);
    error_at(HOLD(" file='none.l'", "w : A"), "two-definitions", 2, 33);
    error_at(HOLD(" view='none.v'", "w : A"), "missing-file", 2, 19);
    error_at(HOLD(" material='bark'", "w : A"), "unknown-material", 2, 37);
    error_at(HOLD(" stepps='3'", "w : A"), "unknown-attribute", 2, 27);
    error_at("<frond version='1'>\n<plant id='a'><lsystem>w : A</lsystem><vary base='b'/></plant>"
             "\n<plant id='b'><lsystem>w : A</lsystem></plant>\n</frond>\n",
             "two-definitions", 2, 40);
}

static void wrong_numbers(void) {
    error_at(HOLD("", "w : A(r)<define id='r' value='1'/>\n<define id='s' value='1'/>"),
             "unused-value", 3, 13);
    error_at(HOLD("", "w : A(r)<define id='r' value='1'/>\n<define id='r' value='1'/>"),
             "duplicate-id", 3, 13);
    error_at(HOLD("", "w : A(r)\n<define id='r-s' value='1'/>"), "bad-id", 3, 13);
    error_at(HOLD("", "w : A(r)\n<define id='r'/>"), "missing-attribute", 3, 2);
}

#define GRAFT(attributes, within, rest)                                                            \
    "<frond version='1'>\n<plant id='a'><pgraph><horn id='h'/>"                                    \
    "<graft id='g'" attributes ">" within "</graft>\n" rest "</pgraph></plant>\n"                  \
    "<plant id='twig'><lsystem>w : A(r)<define id='r' value='1'/></lsystem></plant></frond>"

static void wrong_grafts(void) {
    error_at(GRAFT(" plant='twgi'", "", ""), "unknown-plant", 2, 58);
    error_at(GRAFT(" plant='a'", "", ""), "graft-cycle", 2, 2);
    error_at(
        GRAFT(" plant='b'", "", "</pgraph></plant><plant id='b'><pgraph><graft id='k' plant='a'/>"),
        "graft-cycle", 2, 2);
    error_at(
        GRAFT(" plant='b' steps='3'", "", "</pgraph></plant><plant id='b'><pgraph><horn id='k'/>"),
        "wrong-graft", 2, 68);
    error_at(GRAFT(" plant='b'", "<define id='s' value='1'/>",
                   "</pgraph></plant><plant id='b'><pgraph><horn id='k'/>"),
             "unused-value", 2, 73);
    error_at(GRAFT(" plant='b'", "",
                   "<link from='g' to='h' symbol='L'/></pgraph></plant><plant id='b'><pgraph>"
                   "<horn id='k'/>"),
             "wrong-symbol", 3, 31);
    error_at(GRAFT("", "", ""), "missing-attribute", 2, 38);
    error_at(GRAFT(" plant='twig'", "<define id='s' value='1'/>", ""), "unused-value", 2, 76);
    error_at(GRAFT(" plant='twig'", "", "<link from='h' to='g' symbol='L'/>"), "wrong-symbol", 3,
             31);
    error_at(GRAFT(" plant='twig'", "", "<link from='g' to='h' symbol='Leaf'/>"), "wrong-symbol", 3,
             31);
    error_at(GRAFT(" plant='twig'", "", "<link from='g' to='h' symbol='+'/>"), "wrong-symbol", 3,
             31);
}

static void manual(void) {
    char *path = g_build_filename(g_getenv("FROND_SOURCE"), "docs", "lsystems.md", NULL), *page;
    g_assert_true(g_file_get_contents(path, &page, NULL, NULL));
    const char *begin = strstr(page, "    <plant id=\"bush\"");
    g_assert_nonnull(begin);
    const char *end = strstr(begin, "</plant>");
    g_assert_nonnull(end);
    char *text =
        g_strdup_printf("<frond version='1'>%.*s</plant></frond>", (int)(end - begin), begin);
    Parsed parsed = parse(text);
    g_assert_cmpint(parsed.status, ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(parsed.diags), ==, 0);
    forget(&parsed);
    g_free(text);
    g_free(page);
    g_free(path);
}

/// The string of the first plant after `steps` steps.
static char *derived(const FrDocument *document, uint64_t steps) {
    FrContext context = fr_context_default();
    const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(document), 0);
    g_assert_cmpint(plant->kind, ==, FR_PLANT_LSYSTEM);
    FrLsettings settings = fr_lmodel_settings(plant->lsystem);
    FrLderivation *derivation;
    g_assert_cmpint(fr_lmodel_derive(plant->lsystem, &settings, &context, &derivation), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_run(derivation, steps, &context), ==, FR_OK);
    GString *text = g_string_new(NULL);
    fr_lstring_print(fr_lderivation_string(derivation), text);
    fr_lderivation_free(derivation);
    return g_string_free(text, FALSE);
}

static void check_derived(const FrDocument *document, uint64_t steps, const char *expected) {
    char *text = derived(document, steps);
    g_assert_cmpstr(text, ==, expected);
    g_free(text);
}

static void numbers(void) {
    FrContext context = fr_context_default();
    Parsed parsed = parse(HOLD("", "<define id='r' value='0.5'/><![CDATA[\n#define r 0.25\n"
                                   "#define half(x) ((x)*r)\nw : A(1)\np : A(x) -> F(x)A(half(x))\n"
                                   "]]>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    check_derived(parsed.document, 2, "F(1)F(0.5)A(0.25)");
    g_assert_cmpint(fr_document_set(parsed.document, "r.value", "0.1", &context), ==, FR_OK);
    check_derived(parsed.document, 2, "F(1)F(0.1)A(0.01)");
    g_assert_cmpint(fr_document_set(parsed.document, "bush.r.value", "2", &context), ==, FR_OK);
    check_derived(parsed.document, 2, "F(1)F(2)A(4)");
    g_assert_cmpint(fr_document_set(parsed.document, "bush.lsystem.steps", "3", &context), ==,
                    FR_OK);
    const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(parsed.document), 0);
    g_assert_cmpint(fr_lmodel_params(plant->lsystem)->steps, ==, 3);
    forget(&parsed);
}

static void conditions(void) {
    Parsed parsed = parse(HOLD("", "<define id='r' value='3'/><![CDATA[\n#ifndef r\n#define r 2\n"
                                   "#endif\nw : A(r)\n]]>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    check_derived(parsed.document, 0, "A(3)");
    forget(&parsed);
}

static void text_is_kept(void) {
    const char *text = HOLD(" steps='2'", "<!-- a -->\n<![CDATA[w : A]]> \r\n"
                                          "<define id = 'r'  value='1'/>\np : A -> F(r &lt; 2)A\n");
    Parsed parsed = parse(text);
    g_assert_cmpint(parsed.status, ==, FR_OK);
    size_t size;
    char *written = fr_document_text(parsed.document, &size);
    g_assert_cmpstr(written, ==, text);
    g_free(written);
    check_derived(parsed.document, 2, "F(1)F(1)A");
    forget(&parsed);
}

static char *extracted(const FrDocument *document) {
    FrContext context = fr_context_default();
    char *text;
    g_assert_cmpint(fr_document_extract_lsystem(document,
                                                g_ptr_array_index(fr_document_plants(document), 0),
                                                &context, &text),
                    ==, FR_OK);
    return text;
}

static void check_extracted(const char *document, const char *expected) {
    Parsed parsed = parse(document);
    g_assert_cmpint(parsed.status, ==, FR_OK);
    char *text = extracted(parsed.document);
    g_assert_cmpstr(text, ==, expected);
    g_free(text);
    forget(&parsed);
}

static void to_files(void) {
    check_extracted(HOLD("", "<![CDATA[\nw : A\np : A -> F(1 < 2)A\n]]>"),
                    "w : A\np : A -> F(1 < 2)A\n");
    check_extracted(HOLD(" steps='3' brackets='round'",
                         "<define id='r' value='0.5'/><define id='s' value='-2'/><![CDATA[\n"
                         "#define r 0.25\nw : F\np : F -> F(+F)F : r*s*s\n]]>"),
                    "#define s (-2)\nderivation length: 3\nbrackets: round\n#define r 0.5\n"
                    "w : F\np : F -> F(+F)F : r*s*s\n");
    check_extracted("<frond version='1'><plant id='a' seed='9'><lsystem steps='4'>\n"
                    "Lsystem: 1\nseed: 3\nderivation  length: 2\naxiom: A\nA --> AB\nendlsystem\n"
                    "</lsystem></plant></frond>",
                    "Lsystem: 1\nseed: 9\nderivation length: 4\naxiom: A\nA --> AB\n"
                    "endlsystem\n");
}

static void from_files(void) {
    const char *text = "/* ]]> & < */\nw : A\np : A -> F(1 < 2 && 2 > 1)A\n";
    char *document = fr_document_wrap_lsystem("bush", text, NULL);
    check_extracted(document, text);
    g_free(document);
}

static void round_brackets(void) {
    Parsed parsed = parse(HOLD(" brackets='round'", "w : F\np : F -> F(+F)F"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    char *text = derived(parsed.document, 1);
    g_assert_cmpstr(text, ==, "F[+F]F");
    g_free(text);
    forget(&parsed);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/lsystem/an error in CDATA is where it is in the document",
                    places_in_cdata);
    g_test_add_func("/document/lsystem/an error behind references is where it is in the document",
                    places_behind_references);
    g_test_add_func("/document/lsystem/all errors are told in one run", many_errors);
    g_test_add_func("/document/lsystem/a text with errors is not said to leave numbers unread",
                    numbers_of_wrong_texts);
    g_test_add_func("/document/lsystem/the manual's L-system can be pasted into a document",
                    manual);
    g_test_add_func("/document/lsystem/wrong definitions have a code and a place",
                    wrong_definitions);
    g_test_add_func("/document/lsystem/wrong numbers have a code and a place", wrong_numbers);
    g_test_add_func("/document/lsystem/wrong grafts have a code and a place", wrong_grafts);
    g_test_add_func("/document/lsystem/a number stands in the place of a macro of its name",
                    numbers);
    g_test_add_func("/document/lsystem/a number is defined for #ifndef", conditions);
    g_test_add_func("/document/lsystem/the text is written back as it was", text_is_kept);
    g_test_add_func("/document/lsystem/it becomes a file of its own", to_files);
    g_test_add_func("/document/lsystem/a file becomes a document and is the same again",
                    from_files);
    g_test_add_func("/document/lsystem/round brackets may branch", round_brackets);
    return g_test_run();
}
