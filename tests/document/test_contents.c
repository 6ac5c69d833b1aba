/// Contents show what a text holds; splices change what they name and nothing else.
#include "documents.h"
#include "frond/contents.h"

static const char text[] = "<?xml version='1.0'?>\n"
                           "<frond version='1'>\n"
                           "  <!-- two plants -->\n"
                           "  <plant id='oak' seed='7'>\n"
                           "    <pgraph>\n"
                           "      <camera id='root'/>\n"
                           "      <horn id='stem'  length='3' radius='0.2'/>\n"
                           "      <link from='root' to='stem'/>\n"
                           "    </pgraph>\n"
                           "  </plant>\n"
                           "  <plant id='moss'><lsystem>F &lt; F</lsystem></plant>\n"
                           "  <oops id='stem'/>\n"
                           "</frond>\n";

static FrContents *contents_of(const char *of) {
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("test", of, strlen(of));
    FrContents *contents;
    g_assert_cmpint(fr_contents_read(source, &context, &contents), ==, FR_OK);
    fr_source_unref(source);
    return contents;
}

// The text after one splice; takes it. Free with g_free().
static char *after(const FrContents *contents, FrSplice splice) {
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    g_array_append_val(splices, splice);
    size_t size;
    char *result = fr_contents_apply(contents, splices, &size);
    g_assert_cmpuint(size, ==, strlen(result));
    g_assert_cmpuint(splices->len, ==, 0);
    g_array_unref(splices);
    return result;
}

// `text` with `old` replaced by `new`. Free with g_free().
static char *expected(const char *old, const char *new) {
    const char *at = strstr(text, old);
    g_assert_nonnull(at);
    return g_strdup_printf("%.*s%s%s", (int)(at - text), text, new, at + strlen(old));
}

static void assert_splice(const FrContents *contents, FrSplice splice, const char *old,
                          const char *new) {
    char *is = after(contents, splice), *should = expected(old, new);
    g_assert_cmpstr(is, ==, should);
    g_free(is);
    g_free(should);
}

static void test_elements(void) {
    FrContents *contents = contents_of(text);
    g_assert_cmpstr(fr_contents_at(contents, 0)->name, ==, "frond");
    uint32_t oak = fr_contents_child(contents, 0, "plant");
    g_assert_cmpstr(fr_contents_at(contents, oak)->id, ==, "oak");
    uint32_t moss = fr_contents_sibling(contents, oak);
    g_assert_cmpstr(fr_contents_at(contents, moss)->id, ==, "moss");
    g_assert_cmpuint(fr_contents_sibling(contents, moss), ==, FR_NONE);
    uint32_t stem = fr_contents_find(contents, oak, "stem");
    g_assert_cmpint(fr_contents_at(contents, stem)->component, ==, 2);
    g_assert_nonnull(fr_contents_at(contents, stem)->table);
    g_assert_cmpuint(fr_contents_find(contents, moss, "stem"), ==, FR_NONE);
    uint32_t oops = fr_contents_child(contents, 0, "oops");
    g_assert_null(fr_contents_at(contents, oops)->table);
    g_assert_cmpuint(fr_contents_at(contents, oops)->parent, ==, 0);
    fr_contents_free(contents);
}

static void test_values(void) {
    FrContents *contents = contents_of(text);
    uint32_t stem = fr_contents_find(contents, 0, "stem");
    char *length = fr_contents_get(contents, stem, "length");
    g_assert_cmpstr(length, ==, "3");
    g_assert_null(fr_contents_get(contents, stem, "taper"));
    FrSpan span = fr_contents_span(contents, stem, "length");
    g_assert_cmpint(strncmp(text + span.begin, "3' radius", 9), ==, 0);
    char *attribute;
    g_assert_cmpuint(fr_contents_around(contents, span.begin, &attribute), ==, stem);
    g_assert_cmpstr(attribute, ==, "length");
    g_free(attribute);
    char *content = fr_contents_text(
        contents, fr_contents_child(contents, fr_contents_find(contents, 0, "moss"), "lsystem"),
        &span);
    g_assert_cmpstr(content, ==, "F < F");
    g_assert_cmpuint(span.end - span.begin, ==, strlen("F &lt; F"));
    g_free(content);
    g_free(length);
    fr_contents_free(contents);
}

static void test_attributes(void) {
    FrContents *contents = contents_of(text);
    uint32_t stem = fr_contents_find(contents, 0, "stem");
    assert_splice(contents, fr_contents_set(contents, stem, "length", "4"), "length='3'",
                  "length='4'");
    assert_splice(contents, fr_contents_set(contents, stem, "length", "= i < 'n'"), "length='3'",
                  "length='= i &lt; &apos;n&apos;'");
    assert_splice(contents, fr_contents_set(contents, stem, "taper", "1"), "radius='0.2'",
                  "radius='0.2' taper=\"1\"");
    assert_splice(contents, fr_contents_set(contents, stem, "length", NULL), "  length='3'", "");
    assert_splice(contents, fr_contents_set(contents, stem, "taper", NULL), "stem", "stem");
    fr_contents_free(contents);
}

static void test_elements_come_and_go(void) {
    FrContents *contents = contents_of(text);
    uint32_t graph = fr_contents_child(contents, fr_contents_find(contents, 0, "oak"), "pgraph");
    uint32_t stem = fr_contents_find(contents, 0, "stem");
    assert_splice(contents, fr_contents_remove(contents, stem),
                  "      <horn id='stem'  length='3' radius='0.2'/>\n", "");
    assert_splice(contents, fr_contents_insert(contents, graph, stem, "<leaf id='l'/>"),
                  "radius='0.2'/>\n", "radius='0.2'/>\n      <leaf id='l'/>\n");
    assert_splice(contents, fr_contents_insert(contents, graph, FR_NONE, "<a>\n  <b/>\n</a>"),
                  "to='stem'/>\n", "to='stem'/>\n      <a>\n        <b/>\n      </a>\n");
    assert_splice(
        contents,
        fr_contents_insert(contents, fr_contents_child(contents, 0, "oops"), FR_NONE, "<b/>"),
        "<oops id='stem'/>", "<oops id='stem'>\n    <b/>\n  </oops>");
    fr_contents_free(contents);
}

static void test_text(void) {
    FrContents *contents = contents_of(text);
    uint32_t lsystem =
        fr_contents_child(contents, fr_contents_find(contents, 0, "moss"), "lsystem");
    assert_splice(contents, fr_contents_set_text(contents, lsystem, "F > F"), "F &lt; F", "F > F");
    assert_splice(contents, fr_contents_set_text(contents, lsystem, "a<b]]>c"), "F &lt; F",
                  "<![CDATA[a<b]]]]><![CDATA[>c]]>");
    char *written = after(contents, fr_contents_set_text(contents, lsystem, "a<b]]>c"));
    FrContents *again = contents_of(written);
    char *content = fr_contents_text(
        again, fr_contents_child(again, fr_contents_find(again, 0, "moss"), "lsystem"), NULL);
    g_assert_cmpstr(content, ==, "a<b]]>c");
    g_free(content);
    g_free(written);
    fr_contents_free(again);
    fr_contents_free(contents);
}

static void test_text_among_others(void) {
    static const char odd[] = "<frond><function id='f'>\n  <!-- a -->\n  <define id='d'/>\n"
                              "  <![CDATA[x<y]]>\n</function><function id='g'>a<b/>c</function>"
                              "<function id='h'><b/></function></frond>";
    FrContents *contents = contents_of(odd);
    uint32_t first = fr_contents_find(contents, 0, "f"),
             parted = fr_contents_find(contents, 0, "g");
    char *content = fr_contents_text(contents, first, NULL);
    g_assert_cmpstr(content, ==, "x<y");
    char *written = after(contents, fr_contents_set_text(contents, first, "x>y"));
    g_assert_nonnull(
        strstr(written, "  <!-- a -->\n  <define id='d'/>\n  <![CDATA[x>y]]>\n</func"));
    g_free(written);
    written = after(contents, fr_contents_set_text(contents, parted, "z"));
    g_assert_cmpstr(written, ==, odd);
    g_free(written);
    written =
        after(contents, fr_contents_set_text(contents, fr_contents_find(contents, 0, "h"), "z"));
    g_assert_nonnull(strstr(written, "<function id='h'><b/>z</function>"));
    g_free(written);
    g_free(content);
    fr_contents_free(contents);
}

static void test_several(void) {
    FrContents *contents = contents_of(text);
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    uint32_t stem = fr_contents_find(contents, 0, "stem");
    FrSplice two[] = {fr_contents_set(contents, stem, "radius", "1"),
                      fr_contents_set(contents, 0, "version", "2")};
    g_array_append_vals(splices, two, 2);
    char *is = fr_contents_apply(contents, splices, NULL);
    g_assert_nonnull(strstr(is, "<frond version='2'>\n"));
    g_assert_nonnull(strstr(is, "length='3' radius='1'/>"));
    g_assert_cmpuint(strlen(is), ==, strlen(text) - 2);
    g_free(is);
    g_array_unref(splices);
    fr_contents_free(contents);
}

static void test_broken(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("test", "<frond><plant></frond>", 22);
    FrContents *contents;
    g_assert_cmpint(fr_contents_read(source, &context, &contents), ==, FR_ERR_DOCUMENT);
    g_assert_null(contents);
    g_assert_cmpuint(fr_diags_error_count(context.diags), ==, 1);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/contents/elements have names, tables and kin", test_elements);
    g_test_add_func("/document/contents/values are found with their places", test_values);
    g_test_add_func("/document/contents/an attribute is set, added, taken away", test_attributes);
    g_test_add_func("/document/contents/elements come and go with their lines",
                    test_elements_come_and_go);
    g_test_add_func("/document/contents/text is written so that it reads as meant", test_text);
    g_test_add_func("/document/contents/text among other things leaves them",
                    test_text_among_others);
    g_test_add_func("/document/contents/several splices are done at once", test_several);
    g_test_add_func("/document/contents/what is not well-formed has no contents", test_broken);
    return g_test_run();
}
