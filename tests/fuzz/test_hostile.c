// Documents written to do harm, given to the program itself: each ends with a diagnostic and a
// place, exit status 1 or 3, within a second and 100 MB.
#include <glib.h>
#include <glib/gstdio.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_KILOBYTES = 100000, MOST_SECONDS = 1 };

typedef struct Run {
    int status; // exit status, or -1 if a signal ended it
    double seconds;
    long kilobytes;
    char *messages;
} Run;

// Sanitizers take memory and time of their own; then only the outcome is checked.
static bool is_measured(void) {
    return g_getenv("FROND_SANITIZED") == NULL;
}

static void limit_child(gpointer data) {
    (void)data;
    struct rlimit cpu = {60, 60}; // a hang ends here, not with the whole test run
    setrlimit(RLIMIT_CPU, &cpu);
}

// Runs `frond build DOCUMENT -o OUTPUT`.
static Run run_frond(const char *document, const char *output, const char *log) {
    const char *program = g_getenv("FROND_PROGRAM");
    g_assert_nonnull(program);
    char *arguments[] = {(char *)program, (char *)"build", (char *)document,
                         (char *)"-o",    (char *)output,  NULL};
    FILE *messages = fopen(log, "w");
    g_assert_nonnull(messages);
    GPid child;
    g_assert_true(g_spawn_async_with_fds(
        NULL, arguments, NULL, G_SPAWN_DO_NOT_REAP_CHILD | G_SPAWN_STDOUT_TO_DEV_NULL, limit_child,
        NULL, &child, -1, -1, fileno(messages), NULL));
    fclose(messages);
    int status;
    struct rusage usage;
    g_assert_cmpint(wait4(child, &status, 0, &usage), ==, child);
    Run run = {
        .status = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
        // Of the processor: a busy machine must not fail the test.
        .seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                   (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6,
        .kilobytes = usage.ru_maxrss,
    };
    g_assert_true(g_file_get_contents(log, &run.messages, NULL, NULL));
    return run;
}

// ---- what is written --------------------------------------------------------------------------

static void repeat(GString *out, const char *text, int count) {
    for (int i = 0; i < count; i++) {
        g_string_append(out, text);
    }
}

static void open_graph(GString *out) {
    g_string_append(out, "<frond version=\"1\">\n<plant id=\"p\">\n<pgraph>\n<camera id=\"c\"/>\n");
}

static void close_graph(GString *out) {
    g_string_append(out, "</pgraph>\n</plant>\n</frond>\n");
}

// A graph with one component, linked to the camera.
static void write_component(GString *out, const char *component, const char *links) {
    open_graph(out);
    g_string_append(out, component);
    g_string_append(out, "\n<link from=\"c\" to=\"a\"/>");
    g_string_append(out, links);
    close_graph(out);
}

// Multipliers in a row, each with a million children.
static void write_million_to_the_fourth(GString *out) {
    open_graph(out);
    for (int i = 0; i < 4; i++) {
        g_string_append_printf(out, "<phiball id=\"b%d\" number=\"1000000\"/>\n", i);
        if (i == 0) {
            g_string_append(out, "<link from=\"c\" to=\"b0\"/>\n");
        } else {
            g_string_append_printf(out, "<link from=\"b%d\" to=\"b%d\"/>\n", i - 1, i);
        }
    }
    close_graph(out);
}

static void write_cycle(GString *out) {
    write_component(out, "<tree id=\"a\"/><tree id=\"b\"/>",
                    "<link from=\"a\" to=\"b\"/><link from=\"b\" to=\"a\"/>");
}

static void write_bushy_recursion(GString *out) {
    write_component(out, "<tree id=\"a\" depth=\"1000000\" number=\"3\"/>",
                    "<link from=\"a\" to=\"a\" kind=\"branch\"/>");
}

static void write_endless_recursion(GString *out) {
    write_component(out, "<horn id=\"a\" depth=\"1000000\"/>", "<link from=\"a\" to=\"a\"/>");
}

static void write_nesting(GString *out) {
    g_string_append(out, "<frond version=\"1\">");
    repeat(out, "<a>", 1000000);
}

static void write_siblings(GString *out) {
    g_string_append(out, "<frond version=\"1\">");
    repeat(out, "<view name=\"v\"/>", 1000000);
    g_string_append(out, "</frond>");
}

static void write_attributes(GString *out) {
    g_string_append(out, "<frond version=\"1\"><material id=\"m\"");
    for (int i = 0; i < 500000; i++) {
        g_string_append_printf(out, " a%d=\"1\"", i);
    }
    g_string_append(out, "/></frond>");
}

static void write_long_value(GString *out) {
    g_string_append(out, "<frond version=\"1\"><plant id=\"p\"><pgraph><camera id=\"");
    repeat(out, "0123456789", 1000000);
    g_string_append(out, "\"/></pgraph></plant></frond>");
}

static void write_parentheses(GString *out) {
    g_string_append(out, "<frond version=\"1\"><function id=\"f\" parameters=\"x\">");
    repeat(out, "(", 1000000);
    g_string_append(out, "</function></frond>");
}

static void write_long_sum(GString *out) {
    g_string_append(out, "<frond version=\"1\"><function id=\"f\" parameters=\"x\">x");
    repeat(out, "+x", 5000000);
    g_string_append(out, "</function></frond>");
}

// Each function calls the one before twice: written out, the last has 2^60 terms.
static void write_doubling(GString *out) {
    g_string_append(out,
                    "<frond version=\"1\"><function id=\"f0\" parameters=\"x\">x</function>\n");
    for (int i = 1; i <= 60; i++) {
        g_string_append_printf(out,
                               "<function id=\"f%d\" parameters=\"x\">f%d(x)+f%d(x)</function>\n",
                               i, i - 1, i - 1);
    }
    g_string_append(out, "<plant id=\"p\"><pgraph><camera id=\"c\"/>"
                         "<tree id=\"a\" length=\"1..2 : f60(t)\" number=\"5\"/>"
                         "<link from=\"c\" to=\"a\"/></pgraph></plant></frond>");
}

static void write_nan(GString *out) {
    write_component(out, "<tree id=\"a\" length=\"nan\" radius=\"inf\" gnarl=\"1e999\"/>", "");
}

static void write_many_segments(GString *out) {
    write_component(out,
                    "<tree id=\"a\" number=\"100000\"/>"
                    "<tree id=\"b\" segments=\"1000\"/>",
                    "<link from=\"a\" to=\"b\" kind=\"branch\"/>");
}

static void write_missing_texture(GString *out) {
    g_string_append(out, "<frond version=\"1\">\n<material id=\"m\" picture=\"nowhere.png\"/>\n"
                         "<plant id=\"p\"><pgraph><camera id=\"c\"/>"
                         "<tree id=\"a\" material=\"m\"/><link from=\"c\" to=\"a\"/></pgraph>"
                         "</plant></frond>");
}

static void write_device_texture(GString *out) {
    write_missing_texture(out);
    g_string_replace(out, "nowhere.png", "../../../../../../../../dev/zero", 0);
}

static void write_huge_texture(GString *out) {
    write_missing_texture(out);
    g_string_replace(out, "nowhere.png", "huge.png", 0);
}

static void write_latin1(GString *out) {
    g_string_append(out, "<frond version=\"1\"><plant id=\"ch\xeane\"/></frond>");
}

static void write_utf16(GString *out) {
    static const char text[] = "<frond version=\"1\"/>";
    g_string_append_len(out, "\xff\xfe", 2);
    for (size_t i = 0; i < sizeof text - 1; i++) {
        g_string_append_len(out, (char[]){text[i], 0}, 2);
    }
}

static void write_zero_byte(GString *out) {
    g_string_append_len(out, "<frond version=\"1\">\0</frond>", 28);
}

static void write_entities(GString *out) {
    g_string_append(out, "<!DOCTYPE frond [<!ENTITY a \"aaaaaaaaaa\">\n");
    for (char c = 'b'; c <= 'z'; c++) {
        g_string_append_printf(out, "<!ENTITY %c \"", c);
        char reference[] = {'&', (char)(c - 1), ';', 0};
        repeat(out, reference, 10);
        g_string_append(out, "\">\n");
    }
    g_string_append(out, "]>\n<frond version=\"1\">&z;</frond>");
}

static void write_external(GString *out) {
    g_string_append(out, "<!DOCTYPE frond [<!ENTITY x SYSTEM \"file:///etc/passwd\">]>\n"
                         "<frond version=\"1\">&x;</frond>");
}

static void write_nothing(GString *out) {
    g_string_append(out, "");
}

static void write_unclosed(GString *out) {
    g_string_append(out, "<frond version=\"1\">\n<plant id=\"p");
}

static void write_wrong_words(GString *out) {
    g_string_append(out, "<frond version=\"1\">\n");
    repeat(out, "<plnt sed=\"1\"/>\n", 100000);
    g_string_append(out, "</frond>\n");
}

// ---- how it ends ------------------------------------------------------------------------------

typedef struct Case {
    const char *name;
    void (*write)(GString *out);
    int status;       // expected
    const char *part; // of what is said, such as the code; NULL: anything
} Case;

static const Case CASES[] = {
    {"a million to the fourth instances are refused", write_million_to_the_fourth, 3, "[limit-"},
    {"a cycle without depth is refused", write_cycle, 1, NULL},
    {"a bushy recursion is refused", write_bushy_recursion, 3, "[limit-"},
    {"an endless recursion is refused", write_endless_recursion, 3, "[limit-"},
    {"a million nested elements are refused", write_nesting, 3, "[limit-"},
    {"a million siblings are refused", write_siblings, 3, "[limit-elements]"},
    {"half a million attributes are refused", write_attributes, -1, NULL},
    {"a value of ten megabytes is refused", write_long_value, -1, NULL},
    {"a million parentheses are refused", write_parentheses, -1, NULL},
    {"a sum of five million terms is refused", write_long_sum, -1, NULL},
    {"functions that double each other are refused", write_doubling, -1, NULL},
    {"numbers that are none are refused", write_nan, 1, NULL},
    {"a hundred thousand branches of a thousand segments are refused", write_many_segments, 3,
     "[limit-"},
    {"a missing texture is reported", write_missing_texture, 1, "nowhere.png"},
    {"a device is no texture", write_device_texture, 1, "/dev/zero"},
    {"a picture of 160 gigabytes is refused", write_huge_texture, -1, "huge.png"},
    {"letters of another encoding are refused", write_latin1, 1, NULL},
    {"another width of letters is refused", write_utf16, 1, NULL},
    {"a zero byte is refused", write_zero_byte, 1, NULL},
    {"entities that multiply are refused", write_entities, 1, NULL},
    {"files are not included", write_external, 1, NULL},
    {"an empty document is refused", write_nothing, 1, NULL},
    {"a document that breaks off is refused", write_unclosed, 1, NULL},
    {"a hundred thousand wrong words are reported", write_wrong_words, 1, "did you mean"},
};

// "file.frond:LINE:COLUMN: error: "
static bool has_place(const char *messages) {
    return g_regex_match_simple("hostile\\.frond:[1-9][0-9]*:[1-9][0-9]*: error: ", messages, 0, 0);
}

static void check_end(const Run *run, const Case *expected, const char *output) {
    g_test_message("exit %d, %.2f s, %ld kB\n%.2000s", run->status, run->seconds, run->kilobytes,
                   run->messages);
    if (expected->status >= 0) {
        g_assert_cmpint(run->status, ==, expected->status);
    } else {
        g_assert_true(run->status == 1 || run->status == 3);
    }
    g_assert_true(has_place(run->messages));
    g_assert_true(g_utf8_validate(run->messages, -1, NULL));
    g_assert_cmpuint(strlen(run->messages), <, 30000);
    if (expected->part != NULL) {
        g_assert_nonnull(strstr(run->messages, expected->part));
    }
    g_assert_false(g_file_test(output, G_FILE_TEST_EXISTS));
    if (is_measured()) {
        g_assert_cmpfloat(run->seconds, <, MOST_SECONDS);
        g_assert_cmpint(run->kilobytes, <, MOST_KILOBYTES);
    }
}

// The head of a picture of 200 000 by 200 000 pixels.
static void write_huge_picture(const char *path) {
    static const char png[] =
        "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\x03\x0d\x40\0\x03\x0d\x40\x08\x06\0\0\0\xf9\x3b\x88\x0a"
        "\0\0\0\x0cIDAT\x78\x9c\x63\x60\xa0\x3d\0\0\0\x64\0\x01\x86\x64\x3c\x35\0\0\0\0IEND"
        "\xae\x42\x60\x82";
    g_assert_true(g_file_set_contents(path, png, sizeof png - 1, NULL));
}

static void test_case(gconstpointer data) {
    const Case *hostile = data;
    char *folder = g_dir_make_tmp("frond-hostile-XXXXXX", NULL);
    char *document = g_build_filename(folder, "hostile.frond", NULL);
    char *output = g_build_filename(folder, "out.glb", NULL);
    char *log = g_build_filename(folder, "log", NULL);
    char *picture = g_build_filename(folder, "huge.png", NULL);
    write_huge_picture(picture);
    GString *text = g_string_new(NULL);
    hostile->write(text);
    g_assert_true(g_file_set_contents(document, text->str, (gssize)text->len, NULL));
    Run run = run_frond(document, output, log);
    check_end(&run, hostile, output);
    g_free(run.messages);
    g_string_free(text, TRUE);
    char *const paths[] = {document, output, log, picture};
    for (size_t i = 0; i < G_N_ELEMENTS(paths); i++) {
        g_remove(paths[i]);
        g_free(paths[i]);
    }
    g_assert_cmpint(g_rmdir(folder), ==, 0); // nothing half-written is left
    g_free(folder);
}

// What is no document at all has no place within one.
static void check_unreadable(const char *path, int status) {
    char *log = g_strdup_printf("%s/frond-hostile-%d.log", g_get_tmp_dir(), getpid());
    Run run = run_frond(path, "/nonexistent/out.glb", log);
    g_test_message("exit %d, %.2f s, %ld kB\n%.2000s", run.status, run.seconds, run.kilobytes,
                   run.messages);
    g_assert_cmpint(run.status, ==, status);
    g_assert_nonnull(strstr(run.messages, path));
    if (is_measured()) {
        g_assert_cmpfloat(run.seconds, <, MOST_SECONDS);
        g_assert_cmpint(run.kilobytes, <, MOST_KILOBYTES);
    }
    g_free(run.messages);
    g_remove(log);
    g_free(log);
}

static void test_no_document(void) {
    check_unreadable("/nonexistent/oak.frond", 1);
    check_unreadable("/dev/zero", 1);
    check_unreadable("/tmp", 1);
}

static void test_sparse_giant(void) {
    char *path = g_strdup_printf("%s/frond-hostile-%d.frond", g_get_tmp_dir(), getpid());
    g_assert_true(g_file_set_contents(path, "<frond", 6, NULL));
    g_assert_cmpint(truncate(path, G_GINT64_CONSTANT(1) << 40), ==, 0);
    check_unreadable(path, 3);
    g_remove(path);
    g_free(path);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(CASES); i++) {
        char *path = g_strconcat("/fuzz/hostile/", CASES[i].name, NULL);
        g_test_add_data_func(path, &CASES[i], test_case);
        g_free(path);
    }
    g_test_add_func("/fuzz/hostile/what is no file is no document", test_no_document);
    g_test_add_func("/fuzz/hostile/a file of a terabyte is refused", test_sparse_giant);
    return g_test_run();
}
