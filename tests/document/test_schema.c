/// The schema and the reference page say what the reader does.
#include "documents.h"

#include "document/format.h"

#include <libxml/xmlschemas.h>

static void keep_quiet(void *user, const char *format, ...) {
    (void)user;
    (void)format;
}

static xmlSchema *compile(void) {
    char *text = fr_document_schema();
    xmlSchemaParserCtxt *parser = xmlSchemaNewMemParserCtxt(text, (int)strlen(text));
    xmlSchema *schema = xmlSchemaParse(parser);
    g_assert_nonnull(schema);
    xmlSchemaFreeParserCtxt(parser);
    g_free(text);
    return schema;
}

static bool is_valid(xmlSchema *schema, const char *text) {
    xmlDoc *document = xmlReadMemory(text, (int)strlen(text), "test.frond", NULL, XML_PARSE_NONET);
    g_assert_nonnull(document);
    xmlSchemaValidCtxt *validator = xmlSchemaNewValidCtxt(schema);
    if (!g_test_verbose()) {
        xmlSchemaSetValidErrors(validator, keep_quiet, keep_quiet, NULL);
    }
    bool is_right = xmlSchemaValidateDoc(validator, document) == 0;
    xmlSchemaFreeValidCtxt(validator);
    xmlFreeDoc(document);
    return is_right;
}

static void test_accepts(void) {
    static const char *const folders[] = {"examples", "data/presets", "tests/document/versions"};
    xmlSchema *schema = compile();
    for (size_t f = 0; f < G_N_ELEMENTS(folders); f++) {
        GPtrArray *paths = documents_in(folders[f]);
        for (guint i = 0; i < paths->len; i++) {
            char *text;
            g_assert_true(g_file_get_contents(g_ptr_array_index(paths, i), &text, NULL, NULL));
            g_test_message("%s", (const char *)g_ptr_array_index(paths, i));
            g_assert_true(is_valid(schema, text));
            g_free(text);
        }
        g_ptr_array_unref(paths);
    }
    xmlSchemaFree(schema);
}

/// What the schema and the reader must agree on: each right or wrong for both.
static void test_agrees_with_reader(void) {
    static const struct {
        const char *inner;
        bool is_right;
    } rows[] = {
        {"", true},
        {"<scene sun-elevation='10'/>", true},
        {"<scene sun-elevation='-1e1'/>", true},
        {"<scene sun-elevation='91'/>", false},
        {"<scene sun-elevation='NaN'/>", false},
        {"<scene sun-elevation='INF'/>", false},
        {"<scene sun-elevaton='10'/>", false},
        {"<scene ground='maybe'/>", false},
        {"<scene ground-colour='#123aBc'/>", true},
        {"<scene ground-colour='#12345'/>", false},
        {"<scene ground-colour='red'/>", false},
        {"<scene sun-elevation='= 9*5'/>", true},
        {"<scene ground='= 1 &gt; 2'/>", true},
        {"<plant id='p'><slider id='k' min='0' max='2'/><pgraph><horn id='h' length='2 | k'/>"
         "</pgraph></plant>",
         true},
        {"<plant id='p'><slider/><pgraph><horn id='h'/></pgraph></plant>", false},
        {"<oak/>", false},
        {"text", false},
        {"<material id='m'/>", true},
        {"<material/>", false},
        {"<material id='1'/>", false},
        {"<material id='a.b'/>", false},
        {"<material id='m' texture='leaf'/>", true},
        {"<material id='m' texture='laef'/>", false},
        {"<material id='m' size='512'/>", true},
        {"<material id='m' size='5.5'/>", false},
        {"<material id='m'/><material id='m'/>", false},
        {"<curve id='c' points='0,1 1,0.5'/>", true},
        {"<curve id='c' points='0 1'/>", false},
        {"<curve id='c'/>", false},
        {"<function id='f' parameters='a b'>a*b</function>", true},
        {"<function id='f'><![CDATA[1 < 2]]></function>", true},
        {"<scene><view name='v' look-at='1, 2, 3'/><view name='w' look-at='1'/></scene>", true},
        {"<scene><view name='v'/><view name='v'/></scene>", false},
        {"<scene><view name='v' look-at='1, 2'/></scene>", false},
        {"<scene><place plant='none'/></scene>", false},
        {"<plant id='p'><pgraph><camera id='r'/><horn id='h' length='3..2 ~ 0.5 : t^2'/>"
         "<link from='r' to='h' kind='branch'/></pgraph></plant>"
         "<scene><place plant='p'/></scene>",
         true},
        {"<plant id='p'><pgraph><camera id='r'/><horn id='h' length='= 2 + i'/>"
         "<link from='r' to='h'/></pgraph></plant>",
         true},
        {"<plant id='p'><pgraph><camera id='r'/><horn id='h' length='long'/>"
         "<link from='r' to='h'/></pgraph></plant>",
         false},
        {"<plant id='p'><pgraph><camera id='r'/><horn id='h'/>"
         "<link from='r' to='g'/></pgraph></plant>",
         false},
        {"<plant id='p'><pgraph><camera id='r'/><horn id='r'/></pgraph></plant>", false},
    };
    xmlSchema *schema = compile();
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text = in_root(rows[i].inner);
        Parsed parsed = parse(text);
        char *said = printed(parsed.diags);
        g_test_message("%s\n%s", rows[i].inner, said);
        g_assert_cmpint(parsed.status == FR_OK, ==, rows[i].is_right);
        g_assert_cmpint(is_valid(schema, text), ==, rows[i].is_right);
        g_free(said);
        forget(&parsed);
        g_free(text);
    }
    xmlSchemaFree(schema);
}

static void test_every_row(void) {
    char *schema = fr_document_schema();
    char *reference = fr_document_reference();
    size_t rows = 0;
    for (FrElementId id = 0; id < FR_ELEMENT_COUNT; id++) {
        FrElement element = fr_element(id);
        char *in_schema = g_strdup_printf("<xs:element name=\"%s\">", element.name);
        char *in_reference = g_strdup_printf("\n## `<%s>`\n", element.name);
        const char *schema_part = strstr(schema, in_schema);
        const char *reference_part = strstr(reference, in_reference);
        g_assert_nonnull(schema_part);
        g_assert_nonnull(reference_part);
        for (size_t i = 0; element.table != NULL && i < element.table->count; i++) {
            char *name = fr_param_attribute(&element.table->rows[i]);
            char *attribute = g_strdup_printf("<xs:attribute name=\"%s\"", name);
            char *cell = g_strdup_printf("\n| `%s` |", name);
            const char *schema_end = strstr(schema_part, "</xs:element>\n");
            const char *reference_end = strstr(reference_part + 1, "\n## ");
            const char *attribute_at = strstr(schema_part, attribute);
            const char *cell_at = strstr(reference_part, cell);
            g_assert_true(attribute_at != NULL && attribute_at < schema_end);
            g_assert_true(cell_at != NULL && (reference_end == NULL || cell_at < reference_end));
            g_free(cell);
            g_free(attribute);
            g_free(name);
            rows++;
        }
        g_free(in_schema);
        g_free(in_reference);
    }
    g_assert_cmpuint(rows, >, 100);
    g_free(schema);
    g_free(reference);
}

static void assert_committed(const char *path, char *text) {
    char *full = in_source(path);
    char *committed;
    g_assert_true(g_file_get_contents(full, &committed, NULL, NULL));
    g_assert_cmpstr(committed, ==, text);
    g_free(committed);
    g_free(full);
    g_free(text);
}

static void test_committed(void) {
    assert_committed("data/schema/frond.xsd", fr_document_schema());
    assert_committed("docs/reference.md", fr_document_reference());
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/schema/examples and presets are valid", test_accepts);
    g_test_add_func("/document/schema/what is wrong for the reader is wrong for the schema",
                    test_agrees_with_reader);
    g_test_add_func("/document/schema/every parameter is in schema and reference", test_every_row);
    g_test_add_func("/document/schema/the files beside the program are up to date", test_committed);
    return g_test_run();
}
