// Sources: reading files, positions, spans.
#include "frond/diag.h"

#include <glib/gstdio.h>
#include <string.h>
#include <sys/stat.h>

static void check_position(const FrSource *source, size_t offset, uint32_t line, uint32_t column) {
    uint32_t l, c;
    fr_source_position(source, offset, &l, &c);
    g_assert_cmpuint(l, ==, line);
    g_assert_cmpuint(c, ==, column);
}

static void test_positions(void) {
    // a, é (2 bytes), newline, tab, 樹 (3 bytes), z
    const char text[] = "a\xc3\xa9\n\t\xe6\xa8\xb9z";
    FrSource *source = fr_source_new("s", text, sizeof text - 1);
    check_position(source, 0, 1, 1);
    check_position(source, 1, 1, 2);
    check_position(source, 2, 1, 2); // inside é
    check_position(source, 3, 1, 3);
    check_position(source, 4, 2, 1);
    check_position(source, 5, 2, 2);
    check_position(source, 8, 2, 3);
    check_position(source, 9, 2, 4);
    check_position(source, 1000, 2, 4);
    fr_source_unref(source);
}

// Against counting from the start, at offsets around which an index might err.
static void test_positions_of_large_text(void) {
    GString *text = g_string_new(NULL);
    for (int i = 0; i < 30000; i++) {
        g_string_append(text, i % 7 == 0 ? "\n" : i % 3 == 0 ? "\xe6\xa8\xb9" : "ab");
        if (i > 12000 && i < 22000) {
            g_string_append(text, "\xe6\xa8"); // a cut character
        }
    }
    FrSource *source = fr_source_new("s", text->str, text->len);
    for (size_t stride = 1 << 10; stride <= 1 << 16; stride *= 2) {
        for (size_t offset = stride - 3; offset < stride + 4 && offset < text->len; offset++) {
            uint32_t line = 1, column = 1;
            for (size_t at = 0; at < offset;) {
                gunichar c = g_utf8_get_char_validated(text->str + at, (gssize)(text->len - at));
                size_t size =
                    c == '\n' || c >= (gunichar)-2 ? 1 : (size_t)g_unichar_to_utf8(c, NULL);
                at += size;
                line += c == '\n' ? 1 : 0;
                column = c == '\n' ? 1 : column + (at <= offset ? 1 : 0);
            }
            check_position(source, offset, line, column);
        }
    }
    fr_source_unref(source);
    g_string_free(text, TRUE);
}

// Twenty errors at the end of a large document are printed in one pass over it, not in twenty.
static void test_positions_are_found_at_once(void) {
    const size_t size = 20 << 20;
    char *text = g_malloc(size);
    memset(text, '\n', size);
    FrSource *source = fr_source_new("s", text, size);
    g_free(text);
    check_position(source, size, (uint32_t)size + 1, 1);
    gint64 began = g_get_monotonic_time();
    for (size_t i = 0; i < 1000; i++) {
        check_position(source, size - i, (uint32_t)(size - i) + 1, 1);
    }
    g_assert_cmpint(g_get_monotonic_time() - began, <, 1000000);
    fr_source_unref(source);
}

static void test_text_is_copied(void) {
    char text[] = "abc";
    FrSource *source = fr_source_new("s", text, 2);
    text[0] = 'X';
    size_t size;
    g_assert_cmpstr(fr_source_text(source, &size), ==, "ab");
    g_assert_cmpuint(size, ==, 2);
    fr_source_unref(source);
}

static void test_span_inside(void) {
    FrSpan outer = {NULL, 10, 20};
    FrSpan inner = fr_span_inside(outer, 2, 5);
    g_assert_cmpuint(inner.begin, ==, 12);
    g_assert_cmpuint(inner.end, ==, 15);
    inner = fr_span_inside(outer, 8, SIZE_MAX);
    g_assert_cmpuint(inner.begin, ==, 18);
    g_assert_cmpuint(inner.end, ==, 20);
    inner = fr_span_inside(outer, SIZE_MAX, 3);
    g_assert_cmpuint(inner.begin, ==, 20);
    g_assert_cmpuint(inner.end, ==, 20);
}

static void check_refused(const char *path, uint64_t max_bytes, FrStatus expected,
                          const char *code) {
    FrDiags *diags = fr_diags_new();
    FrStatus status = FR_OK;
    g_assert_null(fr_source_load(path, max_bytes, diags, &status));
    g_assert_cmpint(status, ==, expected);
    g_assert_cmpuint(fr_diags_count(diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, code);
    g_assert_nonnull(strstr(fr_diags_get(diags, 0)->text, path));
    fr_diags_free(diags);
}

typedef struct Folder {
    char *path, *file;
} Folder;

static Folder make_folder(void) {
    Folder folder = {.path = g_dir_make_tmp("frond-source-XXXXXX", NULL)};
    folder.file = g_build_filename(folder.path, "file", NULL);
    return folder;
}

static void remove_folder(Folder folder) {
    g_remove(folder.file);
    g_rmdir(folder.path);
    g_free(folder.file);
    g_free(folder.path);
}

static void test_within(void) {
    FrSource *outer = fr_source_new("outer", "<a>x &lt; y</a>", 15);
    const uint32_t origins[] = {3, 4, 5, 9, 10, 11};
    FrSource *inner = fr_source_within(outer, "x < y", 5, origins);
    FrSpan sign = fr_span_outermost((FrSpan){inner, 2, 3});
    g_assert_true(sign.source == outer);
    g_assert_cmpuint(sign.begin, ==, 5);
    g_assert_cmpuint(sign.end, ==, 6);
    FrSpan end = fr_span_outermost((FrSpan){inner, 5, 5});
    g_assert_cmpuint(end.begin, ==, 11);
    g_assert_cmpuint(end.end, ==, 11);
    FrDiags *diags = fr_diags_new();
    fr_diags_add(diags, FR_ERROR, "test", (FrSpan){inner, 4, 5}, "here");
    fr_source_unref(inner);
    fr_source_unref(outer);
    const FrDiag *diag = fr_diags_get(diags, 0);
    g_assert_cmpstr(fr_source_name(diag->span.source), ==, "outer");
    g_assert_cmpuint(diag->span.begin, ==, 10);
    fr_diags_free(diags);
}

static void test_load(void) {
    Folder folder = make_folder();
    g_assert_true(g_file_set_contents(folder.file, "a\0b\n", 4, NULL));
    FrStatus status = FR_ERR_MACHINE;
    FrSource *source = fr_source_load(folder.file, 4, NULL, &status);
    g_assert_cmpint(status, ==, FR_OK);
    size_t size;
    const char *text = fr_source_text(source, &size);
    g_assert_cmpuint(size, ==, 4);
    g_assert_true(memcmp(text, "a\0b\n", 5) == 0);
    g_assert_cmpstr(fr_source_name(source), ==, folder.file);
    fr_source_unref(source);
    remove_folder(folder);
}

static void test_load_beside(void) {
    Folder folder = make_folder();
    char *previous = g_get_current_dir();
    g_assert_true(g_file_set_contents(folder.file, "a", 1, NULL));
    g_assert_cmpint(g_chdir(folder.path), ==, 0);
    FrStatus status;
    FrSource *source = fr_source_load_beside("file", ".", (FrSpan){0}, 4, NULL, &status);
    g_assert_cmpint(g_chdir(previous), ==, 0);
    g_assert_cmpint(status, ==, FR_OK);
    g_assert_cmpstr(fr_source_name(source), ==, "file");
    fr_source_unref(source);
    g_free(previous);
    remove_folder(folder);
}

static void test_too_big(void) {
    Folder folder = make_folder();
    g_assert_true(g_file_set_contents(folder.file, "12345", 5, NULL));
    check_refused(folder.file, 4, FR_ERR_LIMIT, "limit-document_bytes");
    remove_folder(folder);
}

static void test_not_a_file(void) {
    Folder folder = make_folder();
    check_refused(folder.file, 100, FR_ERR_DOCUMENT, "cannot-read");
    check_refused(folder.path, 100, FR_ERR_DOCUMENT, "cannot-read");
    g_assert_cmpint(mkfifo(folder.file, 0600), ==, 0);
    check_refused(folder.file, 100, FR_ERR_DOCUMENT, "cannot-read"); // and does not wait for it
    check_refused("/dev/zero", 100, FR_ERR_DOCUMENT, "cannot-read");
    remove_folder(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/source/positions count lines and code points from one", test_positions);
    g_test_add_func("/base/source/positions in a large text are those counted from its start",
                    test_positions_of_large_text);
    g_test_add_func("/base/source/positions after many lines are found at once",
                    test_positions_are_found_at_once);
    g_test_add_func("/base/source/a source keeps its own copy", test_text_is_copied);
    g_test_add_func("/base/source/an inner span stays inside", test_span_inside);
    g_test_add_func("/base/source/what is wrong within a text is told of the text around it",
                    test_within);
    g_test_add_func("/base/source/a file is read whole, zero bytes too", test_load);
    g_test_add_func("/base/source/a file of this folder is called by its name alone",
                    test_load_beside);
    g_test_add_func("/base/source/a file over the limit is not read", test_too_big);
    g_test_add_func("/base/source/what is no file is refused at once", test_not_a_file);
    return g_test_run();
}
