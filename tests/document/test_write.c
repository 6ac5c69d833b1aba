/// What is written back is what the user wrote, but for the bytes that were meant to change.
#include "documents.h"

#include <glib/gstdio.h>
#include <unistd.h>

static void assert_round_trip(const char *text, gsize size) {
    Parsed parsed = parse_bytes(text, size);
    g_assert_nonnull(parsed.document);
    size_t written_size;
    char *written = fr_document_text(parsed.document, &written_size);
    g_assert_cmpuint(written_size, ==, size);
    g_assert_cmpint(memcmp(written, text, size), ==, 0);
    g_free(written);
    forget(&parsed);
}

static void test_round_trip(void) {
    static const char *const folders[] = {"examples", "data/presets", "tests/document/versions"};
    for (size_t f = 0; f < G_N_ELEMENTS(folders); f++) {
        GPtrArray *paths = documents_in(folders[f]);
        for (guint i = 0; i < paths->len; i++) {
            char *text;
            gsize size;
            g_assert_true(g_file_get_contents(g_ptr_array_index(paths, i), &text, &size, NULL));
            assert_round_trip(text, size);
            g_free(text);
        }
        g_ptr_array_unref(paths);
    }
    static const char odd[] = "\xef\xbb\xbf<?xml version='1.0'?>\r\n\r\n<!-- c -->\t<frond\r\n"
                              "version = '1'  >\r\n\t<scene\tground=\"no\"\r\n/><?p q?>"
                              "<!---->\r\n</frond  >\n\n<!-- end -->\n\n";
    assert_round_trip(odd, sizeof odd - 1);
}

static const char oak[] = "<?xml version='1.0'?>\r\n"
                          "<frond version='1'> <!-- oak -->\r\n"
                          "  <material id='bark'\tcolour = '#6b5844'/>\r\n"
                          "  <plant id='oak' seed=\"7\"><pgraph>\r\n"
                          "    <camera id='root'/><horn id='trunk' length='3'  radius='0.2'/>\r\n"
                          "    <link from='root' to='trunk'/>\r\n"
                          "  </pgraph></plant>\r\n"
                          "  <plant id='elm'><pgraph>\r\n"
                          "    <camera id='root'/>\r\n"
                          "  </pgraph></plant>\r\n"
                          "  <function id='half' parameters='a'>a/2</function>\r\n"
                          "  <scene ground='no'><view name='far'/></scene>\r\n"
                          "</frond>\r\n";

typedef struct Edit {
    const char *path, *value;
    const char *old, *new; ///< the only difference in the text
} Edit;

static const Edit edits[] = {
    {"trunk.length", "9", "length='3'", "length='9'"},
    {"trunk.length", "= 4 + rand()", "length='3'", "length='= 4 + rand()'"},
    {"trunk.length", "= i < 2 && n > 1", "length='3'", "length='= i &lt; 2 &amp;&amp; n > 1'"},
    {"oak.trunk.length", "9", "length='3'", "length='9'"},
    {"trunk.rotate-x", "45", "radius='0.2'", "radius='0.2' rotate-x=\"45\""},
    {"trunk.rotate_x", "45", "radius='0.2'", "radius='0.2' rotate-x=\"45\""},
    {"oak.root.scale", "2", "<camera id='root'/><horn", "<camera id='root' scale=\"2\"/><horn"},
    {"elm.root.scale", "2", "<camera id='root'/>\r\n  </pgraph>",
     "<camera id='root' scale=\"2\"/>\r\n  </pgraph>"},
    {"bark.colour", "#000000", "colour = '#6b5844'", "colour = '#000000'"},
    {"oak.seed", "8", "seed=\"7\"", "seed=\"8\""},
    {"elm.seed", "8", "<plant id='elm'>", "<plant id='elm' seed=\"8\">"},
    {"scene.sun-elevation", "10", "ground='no'>", "ground='no' sun-elevation=\"10\">"},
    {"far.azimuth", "10", "name='far'/>", "name='far' azimuth=\"10\"/>"},
    {"trunk.material", "bark", "radius='0.2'", "radius='0.2' material=\"bark\""},
    {"half.parameters", "a b", "parameters='a'", "parameters='a b'"},
};

/// `oak` with one place replaced; free with g_free().
static char *edited(const Edit *edit) {
    const char *at = strstr(oak, edit->old);
    g_assert_nonnull(at);
    GString *text = g_string_new_len(oak, at - oak);
    g_string_append(text, edit->new);
    g_string_append(text, at + strlen(edit->old));
    return g_string_free(text, FALSE);
}

static void test_set(void) {
    for (size_t i = 0; i < G_N_ELEMENTS(edits); i++) {
        Parsed parsed = parse(oak);
        g_assert_cmpint(parsed.status, ==, FR_OK);
        FrContext context = fr_context_default();
        context.diags = parsed.diags;
        FrStatus status = fr_document_set(parsed.document, edits[i].path, edits[i].value, &context);
        char *said = printed(parsed.diags);
        g_test_message("%s=%s\n%s", edits[i].path, edits[i].value, said);
        g_assert_cmpint(status, ==, FR_OK);
        char *expected = edited(&edits[i]);
        char *text = fr_document_text(parsed.document, NULL);
        g_assert_cmpstr(text, ==, expected);
        g_free(text);
        g_free(expected);
        g_free(said);
        forget(&parsed);
    }
}

static void test_definitions_follow(void) {
    Parsed parsed = parse(oak);
    FrContext context = fr_context_default();
    g_assert_cmpint(fr_document_set(parsed.document, "oak.seed", "8", &context), ==, FR_OK);
    g_assert_cmpint(fr_document_set(parsed.document, "scene.ground", "yes", &context), ==, FR_OK);
    const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(parsed.document), 0);
    g_assert_cmpuint(plant->seed, ==, 8);
    g_assert_true(fr_document_scene(parsed.document)->ground);
    forget(&parsed);
}

static void test_bad_set(void) {
    static const struct {
        const char *path, *value, *code, *said;
        FrStatus status;
    } rows[] = {
        {"trunk", "1", "bad-path", "id.attribute", FR_ERR_USAGE},
        {"a.b.c.d", "1", "bad-path", "id.attribute", FR_ERR_USAGE},
        {"trnk.length", "1", "unknown-path", "did you mean 'trunk'?", FR_ERR_USAGE},
        {"xyzzy.length", "1", "unknown-path", "bark, oak, oak.root, oak.trunk", FR_ERR_USAGE},
        {"oak.rot.scale", "1", "unknown-path", "did you mean 'oak.root'?", FR_ERR_USAGE},
        {"trunk.lenght", "1", "unknown-path", "did you mean 'length'?", FR_ERR_USAGE},
        {"root.scale", "1", "ambiguous-path", "'oak.root' and 'elm.root'", FR_ERR_USAGE},
        {"trunk.length", "long", NULL, "", FR_ERR_DOCUMENT},
        {"trunk.length", "\xff", "encoding", "not UTF-8", FR_ERR_USAGE},
        {"trunk.length", "\x01", "not-well-formed", "", FR_ERR_DOCUMENT},
        {"trunk.material", "brak", NULL, "", FR_ERR_DOCUMENT},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        Parsed parsed = parse(oak);
        FrContext context = fr_context_default();
        context.diags = parsed.diags;
        FrStatus status = fr_document_set(parsed.document, rows[i].path, rows[i].value, &context);
        char *said = printed(parsed.diags);
        g_test_message("%s=%s\n%s", rows[i].path, rows[i].value, said);
        g_assert_cmpint(status, ==, rows[i].status);
        g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 1);
        if (rows[i].code != NULL) {
            g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, rows[i].code);
        }
        g_assert_nonnull(strstr(said, rows[i].said));
        char *text = fr_document_text(parsed.document, NULL);
        g_assert_cmpstr(text, ==, oak);
        g_free(text);
        g_free(said);
        forget(&parsed);
    }
}

static void test_save(void) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    char *file = g_build_filename(folder, "oak.frond", NULL);
    char *link = g_build_filename(folder, "link.frond", NULL);
    g_assert_true(g_file_set_contents(file, "old", -1, NULL));
    g_assert_cmpint(g_chmod(file, 0640), ==, 0);
    g_assert_cmpint(symlink("oak.frond", link), ==, 0);
    Parsed parsed = parse(oak);
    g_assert_cmpint(fr_document_save(parsed.document, link, parsed.diags), ==, FR_OK);
    char *text;
    g_assert_true(g_file_get_contents(file, &text, NULL, NULL));
    g_assert_cmpstr(text, ==, oak);
    GStatBuf status;
    g_assert_cmpint(g_lstat(link, &status), ==, 0);
    g_assert_true(S_ISLNK(status.st_mode));
    g_assert_cmpint(g_stat(file, &status), ==, 0);
    g_assert_cmpuint(status.st_mode & 07777, ==, 0640);
    g_free(text);

    char *nowhere = g_build_filename(folder, "none", "oak.frond", NULL);
    g_assert_cmpint(fr_document_save(parsed.document, nowhere, parsed.diags), ==, FR_ERR_MACHINE);
    g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, "save");
    g_free(nowhere);
    g_unlink(link);
    g_unlink(file);
    g_assert_cmpint(g_rmdir(folder), ==, 0); // nothing is left behind
    forget(&parsed);
    g_free(link);
    g_free(file);
    g_free(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/write/an unchanged document is written byte for byte",
                    test_round_trip);
    g_test_add_func("/document/write/setting an attribute changes only its bytes", test_set);
    g_test_add_func("/document/write/definitions follow what is set", test_definitions_follow);
    g_test_add_func("/document/write/a bad path or value changes nothing", test_bad_set);
    g_test_add_func("/document/write/saving keeps links and permissions", test_save);
    return g_test_run();
}
