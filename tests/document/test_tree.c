/// The tree is the text: every byte belongs to it, and every place is right.
#include "document/tree.h"

#include "documents.h"

static FrXmlTree *read_tree(const char *text, FrDiags *diags, FrStatus *status) {
    FrContext context = fr_context_default();
    context.diags = diags;
    FrSource *source = fr_source_new("test.frond", text, strlen(text));
    FrXmlTree *tree;
    *status = fr_xml_read(source, &context, &tree);
    fr_source_unref(source);
    return tree;
}

static char *text_of(const FrXmlTree *tree, FrXmlRange range) {
    return g_strndup(fr_source_text(tree->source, NULL) + range.begin, range.end - range.begin);
}

static void assert_text(const FrXmlTree *tree, FrXmlRange range, const char *expected) {
    char *text = text_of(tree, range);
    g_assert_cmpstr(text, ==, expected);
    g_free(text);
}

static void test_spans(void) {
    FrStatus status;
    FrXmlTree *tree = read_tree("<?xml version='1.0'?>\n<!-- oak -->\n<a  b = 'c>d'\te=\"\">x"
                                "<![CDATA[<y>]]><f/><?p q?></a >\n",
                                NULL, &status);
    g_assert_cmpint(status, ==, FR_OK);
    const struct {
        FrXmlKind kind;
        const char *all, *name;
    } expected[] = {
        {FR_XML_INSTRUCTION, "<?xml version='1.0'?>", "xml version='1.0'"},
        {FR_XML_TEXT, "\n", "\n"},
        {FR_XML_COMMENT, "<!-- oak -->", " oak "},
        {FR_XML_TEXT, "\n", "\n"},
        {FR_XML_ELEMENT, "<a  b = 'c>d'\te=\"\">x<![CDATA[<y>]]><f/><?p q?></a >", "a"},
        {FR_XML_TEXT, "x", "x"},
        {FR_XML_CDATA, "<![CDATA[<y>]]>", "<y>"},
        {FR_XML_ELEMENT, "<f/>", "f"},
        {FR_XML_INSTRUCTION, "<?p q?>", "p q"},
        {FR_XML_TEXT, "\n", "\n"},
    };
    g_assert_cmpuint(tree->node_count, ==, G_N_ELEMENTS(expected));
    for (uint32_t i = 0; i < tree->node_count; i++) {
        g_assert_cmpint(tree->nodes[i].kind, ==, expected[i].kind);
        assert_text(tree, tree->nodes[i].all, expected[i].all);
        assert_text(tree, tree->nodes[i].name, expected[i].name);
    }
    g_assert_cmpuint(tree->root, ==, 4);
    g_assert_cmpuint(tree->nodes[4].attribute_count, ==, 2);
    assert_text(tree, tree->attributes[0].name, "b");
    assert_text(tree, tree->attributes[0].value, "c>d");
    assert_text(tree, tree->attributes[1].name, "e");
    assert_text(tree, tree->attributes[1].value, "");
    fr_xml_free(tree);
}

/// The top-level nodes, end to end, are the whole text.
static void test_lossless(void) {
    static const char text[] = "\xef\xbb\xbf<!--1--> <a>\r\n <b\r\n/>\t<c>&lt;</c ></a>\n<!--2-->";
    FrStatus status;
    FrXmlTree *tree = read_tree(text, NULL, &status);
    g_assert_cmpint(status, ==, FR_OK);
    uint32_t at = 3;
    for (uint32_t i = 0; i != FR_NONE; i = tree->nodes[i].next) {
        g_assert_cmpuint(tree->nodes[i].all.begin, ==, at);
        at = tree->nodes[i].all.end;
    }
    g_assert_cmpuint(at, ==, strlen(text));
    fr_xml_free(tree);
}

static void test_decode(void) {
    static const struct {
        const char *text, *value;
    } rows[] = {
        {"a &lt; b &amp;&amp; c &gt; d", "a < b && c > d"},
        {"&quot;&apos;", "\"'"},
        {"&#65;&#x42;&#xe9;&#x1F33F;", "AB\xc3\xa9\xf0\x9f\x8c\xbf"},
        {"a\tb\nc", "a b c"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text = g_strdup_printf("<a b='%s'/>", rows[i].text);
        FrStatus status;
        FrXmlTree *tree = read_tree(text, NULL, &status);
        g_assert_cmpint(status, ==, FR_OK);
        char *value = fr_xml_decode(tree, tree->attributes[0].value, true);
        g_assert_cmpstr(value, ==, rows[i].value);
        g_free(value);
        fr_xml_free(tree);
        g_free(text);
    }
}

static void test_malformed(void) {
    static const struct {
        const char *text;
        uint32_t line;
    } rows[] = {
        {"<a>\n<b></a>\n", 2},
        {"<a>\n<b c=d/></a>", 2},
        {"<a>\n<b c/></a>", 2},
        {"<a b='1' b='2'/>", 1},
        {"<a>\n\n&oak;</a>", 3},
        {"<a/>\n<b/>", 2},
        {"<a>\n", 2},
        {"oak", 1},
        {"<a b='<'/>", 1},
        {"<a>\n<!-- a -- b --></a>", 2},
        {"<a>]]></a>", 1},
        {"<a b='1'c='2'/>", 1},
        {"<>", 1},
        {"<a>&#0;</a>", 1},
        {"<1/>", 1},
        {"<a><?xml version='1.0'?></a>", 1},
        {"\n<a></a", 2},
        {"<a>\x01</a>", 1},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        FrDiags *diags = fr_diags_new();
        FrStatus status;
        FrXmlTree *tree = read_tree(rows[i].text, diags, &status);
        g_test_message("%s", rows[i].text);
        g_assert_null(tree);
        g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
        g_assert_cmpuint(fr_diags_error_count(diags), ==, 1);
        const FrDiag *diag = fr_diags_get(diags, 0);
        g_assert_cmpstr(diag->code, ==, "not-well-formed");
        uint32_t line, column;
        fr_source_position(diag->span.source, diag->span.begin, &line, &column);
        g_assert_cmpuint(line, ==, rows[i].line);
        fr_diags_free(diags);
    }
}

/// libxml2 has the last word; our splitting must not be stricter.
static void test_as_lenient_as_xml(void) {
    static const char *const texts[] = {
        "<a\n\t b\n=\n'1'\n/>",     "<a b='>'/>",
        "<a><!----></a>",           "<a.b-c_d/>",
        "<\xc3\xa9t\xc3\xa9/>",     "<a>]] ></a>",
        "<a b='/>'></a>",           "<?x?><a/><?y z ? >?>",
        "<a b=\"'\" c='\"'/>",      "<a><![CDATA[]]]]></a>",
        "<a xmlns:x='u' x:y='1'/>",
    };
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        FrStatus status;
        FrXmlTree *tree = read_tree(texts[i], NULL, &status);
        g_test_message("%s", texts[i]);
        g_assert_cmpint(status, ==, FR_OK);
        fr_xml_free(tree);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/tree/every node knows its bytes", test_spans);
    g_test_add_func("/document/tree/the nodes are the whole text", test_lossless);
    g_test_add_func("/document/tree/references are resolved", test_decode);
    g_test_add_func("/document/tree/what is not well-formed is refused at its line",
                    test_malformed);
    g_test_add_func("/document/tree/what is well-formed is read", test_as_lenient_as_xml);
    return g_test_run();
}
