// Diagnostics: what is kept, how it prints, and that nothing a user writes can spoil the print.
#include "frond/diag.h"

#include <jansson.h>
#include <string.h>

static FrSource *source_of(const char *text) {
    return fr_source_new("oak.frond", text, strlen(text));
}

static FrSpan span_of(FrSource *source, const char *word) {
    const char *text = fr_source_text(source, NULL);
    const char *at = strstr(text, word);
    g_assert_nonnull(at);
    return (FrSpan){source, (uint32_t)(at - text), (uint32_t)(at - text + (long)strlen(word))};
}

// Prints one error at `span` and compares.
static void check_print(FrSource *source, FrSpan span, const char *expected) {
    FrDiags *diags = fr_diags_new();
    fr_diags_add(diags, FR_ERROR, "a-code", span, "text");
    GString *out = g_string_new(NULL);
    fr_diags_print(diags, out);
    g_assert_cmpstr(out->str, ==, expected);
    g_string_free(out, TRUE);
    fr_diags_free(diags);
    fr_source_unref(source);
}

static void test_caret(void) {
    FrSource *source = source_of("first\nA(t) : t > 3 -> F(internodeLen)\nlast\n");
    check_print(source, span_of(source, "internodeLen"),
                "oak.frond:2:19: error: text [a-code]\n"
                "    2 | A(t) : t > 3 -> F(internodeLen)\n"
                "      |                   ^~~~~~~~~~~~\n");
}

static void test_tabs(void) {
    FrSource *source = source_of("\t<a\tb='1'/>\n");
    check_print(source, span_of(source, "b"),
                "oak.frond:1:5: error: text [a-code]\n"
                "    1 |     <a  b='1'/>\n"
                "      |         ^\n");
}

static void test_wide(void) {
    FrSource *source = source_of("樹é=x");
    check_print(source, span_of(source, "x"),
                "oak.frond:1:4: error: text [a-code]\n"
                "    1 | 樹é=x\n"
                "      |     ^\n");
}

static void test_many_lines(void) {
    FrSource *source = source_of("<a>\r\n  <b>\r\n</a>\r\n");
    check_print(source, span_of(source, "<b>\r\n</a>"),
                "oak.frond:2:3: error: text [a-code]\n"
                "    2 |   <b>\n"
                "      |   ^~~\n");
}

static void test_end_of_file(void) {
    FrSource *source = source_of("<a>");
    check_print(source, (FrSpan){source, 3, 3},
                "oak.frond:1:4: error: text [a-code]\n"
                "    1 | <a>\n"
                "      |    ^\n");
    source = source_of("<a>\n");
    check_print(source, (FrSpan){source, 4, 4},
                "oak.frond:2:1: error: text [a-code]\n"
                "    2 | \n"
                "      | ^\n");
}

static void test_span_outside(void) {
    FrSource *source = source_of("ab");
    check_print(source, (FrSpan){source, 1000, 3},
                "oak.frond:1:3: error: text [a-code]\n"
                "    1 | ab\n"
                "      |   ^\n");
}

static void test_empty_source(void) {
    FrSource *source = source_of("");
    check_print(source, (FrSpan){source, 0, 0}, "oak.frond:1:1: error: text [a-code]\n");
}

static void test_no_place(void) {
    FrSource *source = NULL;
    check_print(source, (FrSpan){0}, "error: text [a-code]\n");
}

static void test_hostile_bytes(void) {
    FrSource *source = source_of("\xff\x80\x1b[31m=x");
    check_print(source, span_of(source, "x"),
                "oak.frond:1:9: error: text [a-code]\n"
                "    1 | \xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd[31m=x\n"
                "      |         ^\n");
}

static void test_zero_bytes(void) {
    FrSource *source = fr_source_new("zero", "a\0b", 3);
    check_print(source, (FrSpan){source, 2, 3},
                "zero:1:3: error: text [a-code]\n"
                "    1 | a\xef\xbf\xbd"
                "b\n"
                "      |   ^\n");
}

// A line of a million characters is cut to a window around the span.
static void test_long_line(void) {
    enum { SIZE = 1000000 };
    char *text = g_malloc(SIZE);
    memset(text, 'a', SIZE);
    memcpy(text + 500000, "WORD", 4);
    FrSource *source = fr_source_new("long", text, SIZE);
    FrDiags *diags = fr_diags_new();
    fr_diags_add(diags, FR_ERROR, "a-code", (FrSpan){source, 500000, 500004}, "text");
    GString *out = g_string_new(NULL);
    fr_diags_print(diags, out);
    char **lines = g_strsplit(out->str, "\n", -1);
    g_assert_cmpstr(lines[0], ==, "long:1:500001: error: text [a-code]");
    g_assert_cmpint(g_utf8_strlen(lines[1], -1), <=, 8 + 162);
    g_assert_true(g_str_has_prefix(lines[1], "    1 | …aaa"));
    g_assert_true(g_str_has_suffix(lines[1], "aaa…"));
    long word = g_utf8_pointer_to_offset(lines[1], strstr(lines[1], "WORD"));
    g_assert_cmpint(word, ==, strchr(lines[2], '^') - lines[2]);
    g_assert_true(g_str_has_suffix(lines[2], " ^~~~"));
    g_strfreev(lines);
    g_string_free(out, TRUE);
    fr_diags_free(diags);
    fr_source_unref(source);
    g_free(text);
}

static void test_several(void) {
    FrSource *source = source_of("one two\nthree");
    FrDiags *diags = fr_diags_new();
    fr_diags_add(diags, FR_WARNING, "w", span_of(source, "two"), "number %d", 2);
    fr_diags_add(diags, FR_NOTE, "n", span_of(source, "three"), "number %d", 3);
    fr_source_unref(source); // the list keeps it
    GString *out = g_string_new(NULL);
    fr_diags_print(diags, out);
    g_assert_cmpstr(out->str, ==,
                    "oak.frond:1:5: warning: number 2 [w]\n"
                    "    1 | one two\n"
                    "      |     ^~~\n"
                    "oak.frond:2:1: note: number 3 [n]\n"
                    "    2 | three\n"
                    "      | ^~~~~\n");
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 0);
    g_string_free(out, TRUE);
    fr_diags_free(diags);
}

static void test_twenty(void) {
    FrDiags *diags = fr_diags_new();
    for (int i = 0; i < 25; i++) {
        fr_diags_add(diags, FR_ERROR, "a-code", (FrSpan){0}, "%d", i);
    }
    g_assert_cmpuint(fr_diags_count(diags), ==, 20);
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 25);
    g_assert_cmpstr(fr_diags_get(diags, 19)->text, ==, "19");
    GString *out = g_string_new(NULL);
    fr_diags_print(diags, out);
    g_assert_true(g_str_has_suffix(out->str, "error: 19 [a-code]\nand 5 more like these\n"));
    g_string_free(out, TRUE);
    fr_diags_free(diags);
}

static void test_error_displaces_note(void) {
    FrDiags *diags = fr_diags_new();
    for (int i = 0; i < 30; i++) {
        fr_diags_add(diags, FR_WARNING, "w", (FrSpan){0}, "%d", i);
    }
    fr_diags_add(diags, FR_ERROR, "e", (FrSpan){0}, "the reason");
    g_assert_cmpuint(fr_diags_count(diags), ==, 20);
    g_assert_cmpstr(fr_diags_get(diags, 19)->text, ==, "the reason");
    g_assert_cmpstr(fr_diags_get(diags, 18)->text, ==, "18");
    fr_diags_free(diags);
}

static void test_long_text(void) {
    char *name = g_strnfill(100000, 'x');
    name[10] = '\n';
    name[11] = '\x1b';
    FrDiags *diags = fr_diags_new();
    fr_diags_add(diags, FR_ERROR, "e", (FrSpan){0}, "unknown '%s'", name);
    const char *text = fr_diags_get(diags, 0)->text;
    g_assert_cmpuint(strlen(text), <, 500);
    g_assert_null(strpbrk(text, "\n\x1b"));
    g_assert_true(g_utf8_validate(text, -1, NULL));
    fr_diags_free(diags);
    g_free(name);
}

static void test_null_list(void) {
    fr_diags_add(NULL, FR_ERROR, "e", (FrSpan){0}, "dropped");
    g_assert_cmpuint(fr_diags_count(NULL), ==, 0);
    g_assert_cmpuint(fr_diags_error_count(NULL), ==, 0);
    fr_diags_free(NULL);
}

static void test_json(void) {
    FrSource *source = source_of("one\ntwo \"quoted\" \xff");
    FrDiags *diags = fr_diags_new();
    fr_diags_add(diags, FR_ERROR, "a-code", span_of(source, "\"quoted\""), "is \"wrong\"");
    fr_diags_add(diags, FR_WARNING, "b-code", (FrSpan){0}, "no place");
    GString *out = g_string_new(NULL);
    fr_diags_print_json(diags, out);
    json_t *array = json_loads(out->str, 0, NULL);
    g_assert_cmpuint(json_array_size(array), ==, 2);
    json_t *first = json_array_get(array, 0);
    g_assert_cmpstr(json_string_value(json_object_get(first, "severity")), ==, "error");
    g_assert_cmpstr(json_string_value(json_object_get(first, "code")), ==, "a-code");
    g_assert_cmpstr(json_string_value(json_object_get(first, "file")), ==, "oak.frond");
    g_assert_cmpint(json_integer_value(json_object_get(first, "line")), ==, 2);
    g_assert_cmpint(json_integer_value(json_object_get(first, "column")), ==, 5);
    g_assert_cmpint(json_integer_value(json_object_get(first, "end_line")), ==, 2);
    g_assert_cmpint(json_integer_value(json_object_get(first, "end_column")), ==, 13);
    g_assert_cmpstr(json_string_value(json_object_get(first, "text")), ==, "is \"wrong\"");
    g_assert_null(json_object_get(json_array_get(array, 1), "file"));
    json_decref(array);
    g_string_free(out, TRUE);
    fr_diags_free(diags);
    fr_source_unref(source);
}

static void test_json_empty(void) {
    FrDiags *diags = fr_diags_new();
    GString *out = g_string_new(NULL);
    fr_diags_print_json(diags, out);
    g_assert_cmpstr(out->str, ==, "[]\n");
    g_string_free(out, TRUE);
    fr_diags_free(diags);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/diag/the line and a caret show the place", test_caret);
    g_test_add_func("/base/diag/the caret stands right after tabs", test_tabs);
    g_test_add_func("/base/diag/the caret stands right after wide letters", test_wide);
    g_test_add_func("/base/diag/a span over several lines marks the first", test_many_lines);
    g_test_add_func("/base/diag/the end of a file has a place", test_end_of_file);
    g_test_add_func("/base/diag/a span outside its source is clamped", test_span_outside);
    g_test_add_func("/base/diag/an empty source has a place", test_empty_source);
    g_test_add_func("/base/diag/a diagnostic may have no place", test_no_place);
    g_test_add_func("/base/diag/bytes that are no text cannot reach a terminal",
                    test_hostile_bytes);
    g_test_add_func("/base/diag/zero bytes do not end a line", test_zero_bytes);
    g_test_add_func("/base/diag/a very long line is cut around the place", test_long_line);
    g_test_add_func("/base/diag/several diagnostics print in order", test_several);
    g_test_add_func("/base/diag/twenty are kept and all are counted", test_twenty);
    g_test_add_func("/base/diag/an error takes the place of a warning", test_error_displaces_note);
    g_test_add_func("/base/diag/a long name is cut and cleaned", test_long_text);
    g_test_add_func("/base/diag/without a list diagnostics are dropped", test_null_list);
    g_test_add_func("/base/diag/tools get the same in JSON", test_json);
    g_test_add_func("/base/diag/no diagnostics are an empty array", test_json_empty);
    return g_test_run();
}
