/// Documents that mean harm, or are none.
#include "documents.h"

#include "frond/random.h"

static void test_no_text(void) {
    static const struct {
        const char *bytes;
        size_t size;
        const char *code;
        uint32_t line, column;
    } rows[] = {
        {"", 0, "not-well-formed", 1, 1},
        {"\xff\xfe<\0f\0", 6, "encoding", 1, 1},
        {"\xfe\xff\0<\0f", 6, "encoding", 1, 1},
        {"<\0f\0r\0", 6, "encoding", 1, 2},
        {"<frond version='1'>\n<!-- \xe9 -->\n</frond>", 39, "encoding", 2, 6},
        {"<frond version='1'>\n\0</frond>", 29, "encoding", 2, 1},
        {"<?xml version='1.0' encoding='ISO-8859-1'?><frond/>", 51, "encoding", 1, 31},
        {"\177ELF\2\1\1\0\0\0", 10, "encoding", 1, 8},
        {"\x89PNG\r\n\x1a\n", 8, "encoding", 1, 1},
        {"<frond>\xed\xa0\x80</frond>", 18, "encoding", 1, 8},
        {"<frond>\xc0\xaf</frond>", 17, "encoding", 1, 8},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        Parsed parsed = parse_bytes(rows[i].bytes, rows[i].size);
        g_assert_null(parsed.document);
        assert_one_error(&parsed, FR_ERR_DOCUMENT, rows[i].code, rows[i].line, rows[i].column);
        forget(&parsed);
    }
}

static void test_entities(void) {
    static const char billion_laughs[] =
        "<!DOCTYPE a [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>"
        "<!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;'>]>\n<frond version='1'>&c;</frond>";
    static const char *const texts[] = {
        billion_laughs,
        // a file of the machine
        "<!DOCTYPE a [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><frond version='1'>&a;</frond>",
        // the network
        "<!DOCTYPE a SYSTEM 'http://127.0.0.1:9/a.dtd'><frond version='1'/>",
        // a parameter entity
        "<!DOCTYPE a [<!ENTITY % a SYSTEM 'http://127.0.0.1:9/a.dtd'>%a;]><frond version='1'/>",
    };
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        Parsed parsed = parse(texts[i]);
        assert_one_error(&parsed, FR_ERR_DOCUMENT, "document-type", 1, 1);
        forget(&parsed);
    }
    Parsed undefined = parse("<frond version='1'>\n&a;</frond>");
    assert_one_error(&undefined, FR_ERR_DOCUMENT, "not-well-formed", 2, 4);
    forget(&undefined);
}

static char *repeated(const char *open, const char *close, size_t count) {
    GString *text = g_string_new("<frond version='1'>\n");
    for (size_t i = 0; i < count; i++) {
        g_string_append(text, open);
    }
    for (size_t i = 0; i < count && *close != '\0'; i++) {
        g_string_append(text, close);
    }
    g_string_append(text, "</frond>\n");
    return g_string_free(text, FALSE);
}

static void test_limits(void) {
    static const struct {
        const char *open, *close, *code;
        FrStatus status;
    } rows[] = {
        {"<a>", "</a>", "limit-nesting", FR_ERR_LIMIT},
        {"<plant>", "", "limit-nesting", FR_ERR_LIMIT},
        {"<a/>", "", "limit-elements", FR_ERR_LIMIT},
        {"<!---->", "", "limit-elements", FR_ERR_LIMIT},
        {"<?a?>", "", "limit-elements", FR_ERR_LIMIT},
        {"<![CDATA[]]>", "", "limit-elements", FR_ERR_LIMIT},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text = repeated(rows[i].open, rows[i].close, 250000);
        Parsed parsed = parse(text);
        g_assert_cmpint(parsed.status, ==, rows[i].status);
        g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 1);
        g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, rows[i].code);
        g_assert_cmpuint(fr_diags_get(parsed.diags, 0)->span.begin, >, 0);
        forget(&parsed);
        g_free(text);
    }
}

static void test_document_bytes(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.document_bytes = 10;
    FrSource *source = fr_source_new("test.frond", "<frond version='1'/>", 20);
    FrDocument *document;
    FrStatus status = fr_document_parse(source, NULL, &context, &document);
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
    g_assert_null(document);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-document_bytes");
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

static void test_attributes(void) {
    GString *text = g_string_new("<frond version='1'><scene");
    for (int i = 0; i < 1000000; i++) {
        g_string_append_printf(text, " a%d=''", i);
    }
    g_string_append(text, "/></frond>");
    Parsed parsed = parse(text->str);
    g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, "too-many-attributes");
    forget(&parsed);
    // The same behind something that is not well-formed.
    g_string_insert(text, 19, "<a b=c/>");
    parsed = parse(text->str);
    g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, "not-well-formed");
    g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 1);
    forget(&parsed);
    g_string_free(text, TRUE);
}

/// Every element wrong: all counted, twenty kept, in time linear in the document.
static void test_many_errors(void) {
    GString *text = g_string_new("<frond version='1'><plant id='p'><pgraph>");
    for (int i = 0; i < 10000; i++) {
        g_string_append_printf(text, "<horn id='some-rather-long-component-name-%d'/>", i);
    }
    for (int i = 0; i < 10000; i++) {
        g_string_append_printf(text, "<link from='some-rather-lnog-component-name-%d' to=''/>", i);
    }
    g_string_append(text, "</pgraph></plant></frond>");
    Parsed parsed = parse(text->str);
    g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_error_count(parsed.diags), >=, 10000);
    g_assert_cmpuint(fr_diags_count(parsed.diags), ==, 20);
    forget(&parsed);
    g_string_free(text, TRUE);
}

static char *version_one(gsize *size) {
    char *path = in_source("tests/document/versions/1.frond");
    char *text;
    g_assert_true(g_file_get_contents(path, &text, size, NULL));
    g_free(path);
    return text;
}

static void test_truncated(void) {
    gsize size;
    char *text = version_one(&size);
    gsize whole = (gsize)(g_strrstr(text, "</frond>") - text) + strlen("</frond>");
    for (gsize cut = 0; cut < whole; cut++) {
        Parsed parsed = parse_bytes(text, cut);
        g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
        g_assert_null(parsed.document);
        g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 1);
        forget(&parsed);
    }
    g_free(text);
}

static void test_mutated(void) {
    gsize size;
    char *text = version_one(&size);
    static const char bytes[] = "<>&'\"=/!-[]?;#x0 \n\x80\xff";
    for (uint32_t round = 0; round < 3000; round++) {
        FrKey key = fr_key_root(round);
        char *copy = g_memdup2(text, size + 1);
        for (uint32_t k = 0; k < 3; k++) {
            size_t at = fr_random_bits(key, 1, k) % size;
            copy[at] = bytes[fr_random_bits(key, 2, k) % (sizeof bytes - 1)];
        }
        Parsed parsed = parse_bytes(copy, size);
        bool is_said = fr_diags_error_count(parsed.diags) > 0;
        g_assert_true(is_said == (parsed.status != FR_OK));
        forget(&parsed);
        g_free(copy);
    }
    g_free(text);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/hostile/only UTF-8 is read", test_no_text);
    g_test_add_func("/document/hostile/entities and document types are refused", test_entities);
    g_test_add_func("/document/hostile/a quarter of a million elements stop at a limit",
                    test_limits);
    g_test_add_func("/document/hostile/bytes are limited", test_document_bytes);
    g_test_add_func("/document/hostile/a million attributes are refused", test_attributes);
    g_test_add_func("/document/hostile/ten thousand errors are counted", test_many_errors);
    g_test_add_func("/document/hostile/a document cut off anywhere is refused", test_truncated);
    g_test_add_func("/document/hostile/changed bytes do no harm", test_mutated);
    return g_test_run();
}
