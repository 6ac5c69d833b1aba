// Files that the language reads: fopen(), fscanf(), fclose().
#include "lsystems.h"

#include <glib/gstdio.h>

/// The axiom of an L-system beside `content`, whose Start block is given; what was told.
static char *axiom_of(const char *content, const char *start, const char *axiom, char **said) {
    char *folder = g_dir_make_tmp("frond-files-XXXXXX", NULL);
    char *path = g_build_filename(folder, "data.txt", NULL);
    g_assert_true(g_file_set_contents(path, content, -1, NULL));
    char *text = g_strdup_printf("Lsystem: 1\ndefine: { array a[3] = {7,8,9}; }\nStart: { %s }\n"
                                 "axiom: A(%s)\nX --> X\nendlsystem\n",
                                 start, axiom);
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("test.l", text, strlen(text));
    FrLoptions options = {.folder = folder};
    FrLsystem *system;
    FrLderivation *derivation;
    g_assert_cmpint(fr_lsystem_compile(source, &options, &context, &system), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_new(system, NULL, &context, &derivation), ==, FR_OK);
    GString *out = g_string_new(NULL);
    fr_lstring_print(fr_lderivation_string(derivation), out);
    *said = diag_text(context.diags);
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    g_free(text);
    return g_string_free(out, FALSE);
}

static void check(const char *content, const char *start, const char *axiom, const char *expected) {
    char *said, *got = axiom_of(content, start, axiom, &said);
    g_test_message("%s", said);
    g_assert_cmpstr(got, ==, expected);
    g_assert_cmpstr(said, ==, "");
    g_free(said);
    g_free(got);
}

static void numbers(void) {
    check("Time step: 24.5\nRates: 1 -2.5e1\n\t3\nend 100%\n",
          "f = fopen(\"data.txt\",\"r\"); fscanf(f,\"Time step: %lf\\n\",&t); fscanf(f,\"Rates:\");"
          "i = 0; while (i < 3) { fscanf(f,\"%lf\",&a[i]); i = i + 1; }"
          "n = fscanf(f,\" end %f%%\",&p); fclose(f);",
          "t,a[0],a[1],a[2],n,p", "A(24.5,1,-25,3,1,100)");
}

// What a file does not have leaves the variables as they were.
static void missing(void) {
    check(
        "1 x 2\n",
        "f = fopen(\"data.txt\",\"r\"); p = 5; q = 6; n = fscanf(f,\"%lf %lf %lf\",&p,&q,&a[1]);"
        "m = fscanf(f,\"%*d\"); fscanf(f,\"x\"); k = fscanf(f,\"%d\",&r); e = fscanf(f,\"%d\",&r);",
        "p,q,a[1],n,m,k,r,e", "A(1,6,8,1,0,1,2,-1)");
}

static void refused(void) {
    static const char *const names[] = {"none.txt", "../data.txt", "/etc/passwd", ""};
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        char *start =
            g_strdup_printf("f = fopen(\"%s\",\"r\"); n = fscanf(f,\"%%lf\",&p);", names[i]);
        char *said, *got = axiom_of("1", start, "f,n,p", &said);
        g_assert_cmpstr(got, ==, "A(-1,-1,0)");
        g_assert_nonnull(strstr(said, "test.l:3:14: warning:"));
        g_assert_nonnull(strstr(said, "[missing-file]"));
        g_free(said);
        g_free(got);
        g_free(start);
    }
    char *said, *got = axiom_of("1", "f = fopen(\"data.txt\",\"w\");", "f", &said);
    g_assert_cmpstr(got, ==, "A(-1)");
    g_assert_nonnull(strstr(said, "[left-out]"));
    g_free(said);
    g_free(got);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/files/numbers are read by formats", numbers);
    g_test_add_func("/lsystem/files/what is not there changes nothing", missing);
    g_test_add_func("/lsystem/files/only files beside the L-system are read", refused);
    return g_test_run();
}
