/// Hostile files: each ends with a diagnostic at a place, exit 1 or 3, and little memory.
#include "program.h"

enum { MOST_BYTES = 100000000 };

typedef struct Hostile {
    const char *name;
    int exit;
    const char *err; ///< pattern
} Hostile;

static const Hostile hostile[] = {
    {"instances", 3, "*instances.frond:*error:*[limit-instances]*"},
    {"organs", 3, "*organs.frond:*error:*[limit-*"},
    {"cycle", 1, "*cycle.frond:*error:*"},
    {"deep-cycle", 3, "*deep-cycle.frond:*error:*[limit-*"},
    {"nested", 3, "*nested.frond:1:*error:*[limit-nesting]*"},
    {"flat", 3, "*flat.frond:1:*error:*[limit-elements]*"},
    {"nan", 1, "*nan.frond:1:*error:*"},
    {"infinite", 1, "*infinite.frond:1:*error:*"},
    {"picture", 1, "*picture.frond:1:*error:*[missing-file]*"},
    {"mesh-name", 1, "*mesh-name.frond:1:96: error:*[unknown-format]*"},
    {"bad-picture", 1, "*bad-picture.frond:1:*error:*"},
    {"latin1", 1, "*latin1.frond:1:*error:*[encoding]*"},
    {"utf16", 1, "*utf16.frond:1:1: error:*[encoding]*"},
    {"laughs", 1, "*laughs.frond:1:1: error:*[document-type]*"},
    {"external", 1, "*external.frond:1:1: error:*[document-type]*"},
    {"truncated", 1, "*truncated.frond:1:*error:*[not-well-formed]*"},
    {"duplicate", 1, "*duplicate.frond:1:*error:*"},
    {"empty", 1, "*empty.frond:1:1: error:*[not-well-formed]*"},
    {"binary", 1, "*binary.frond:1:*error:*[encoding]*"},
    {"long-line", 1, "*long-line.frond:1:*error:*"},
    {"expression", 1, "*expression.frond:1:*error:*"},
};

static void put(const char *name, const char *text, gssize size) {
    char *path = g_strconcat(name, ".frond", NULL);
    g_assert_true(g_file_set_contents(path, text, size, NULL));
    g_free(path);
}

static void put_graph(const char *name, const char *graph) {
    char *text = g_strconcat("<frond version='1'><plant id='p'><pgraph><camera id='r'/>", graph,
                             "</pgraph></plant></frond>", NULL);
    put(name, text, -1);
    g_free(text);
}

static void put_repeated(const char *name, const char *head, const char *part, int count,
                         const char *tail) {
    GString *text = g_string_new(head);
    for (int i = 0; i < count; i++) {
        g_string_append(text, part);
    }
    g_string_append(text, tail);
    put(name, text->str, (gssize)text->len);
    g_string_free(text, TRUE);
}

static void put_graphs(void) {
    put_graph("instances", "<phiball id='a' number='100000'/><phiball id='b' number='100000'/>"
                           "<phiball id='c' number='100000'/><phiball id='d' number='100000'/>"
                           "<horn id='e'/><link from='r' to='a'/><link from='a' to='b'/>"
                           "<link from='b' to='c'/><link from='c' to='d'/>"
                           "<link from='d' to='e'/>");
    put_graph("organs", "<phiball id='a' number='1000000'/><phiball id='b' number='1000'/>"
                        "<leaf id='e'/><link from='r' to='a'/><link from='a' to='b'/>"
                        "<link from='b' to='e'/>");
    put_graph("cycle", "<horn id='a'/><horn id='b'/><link from='r' to='a'/>"
                       "<link from='a' to='b'/><link from='b' to='a'/>");
    put_graph("deep-cycle", "<horn id='a' depth='100000'/><phiball id='b' number='10'/>"
                            "<link from='r' to='a'/><link from='a' to='b'/>"
                            "<link from='b' to='a'/>");
    put_graph("mesh-name", "<simple id='s' primitive='mesh' file='mesh-name.frond'/>"
                           "<link from='r' to='s'/>");
    put_graph("nan", "<horn id='a' length='nan'/><link from='r' to='a'/>");
    put_graph("infinite", "<horn id='a' length='1e400'/><link from='r' to='a'/>");
    put_graph("duplicate", "<horn id='a'/><horn id='a'/><link from='r' to='a'/>");
    put_repeated("expression",
                 "<frond version='1'><plant id='p'><pgraph><camera id='r'/><horn id='a' "
                 "length='= ",
                 "(", 1000000, "'/><link from='r' to='a'/></pgraph></plant></frond>");
}

static void put_texts(void) {
    put_repeated("nested", "<frond version='1'>", "<plant>", 1000000, "");
    put_repeated("flat", "<frond version='1'>", "<plant/>", 1000000, "</frond>");
    put_repeated("long-line", "<frond version='1'>", "long line ", 2000000, "</frond>");
    put("picture", "<frond version='1'><material id='m' picture='none.png'/></frond>", -1);
    put("bad-picture", "<frond version='1'><material id='m' picture='bad-picture.frond'/></frond>",
        -1);
    put("latin1", "<?xml version='1.0' encoding='latin1'?><frond version='1'/>", -1);
    put("utf16", "\xff\xfe<\0/\0", 6);
    put("laughs",
        "<!DOCTYPE a [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;'>]>"
        "<frond version='1'>&b;</frond>",
        -1);
    put("external", "<!DOCTYPE a SYSTEM 'file:///dev/zero'><frond version='1'/>", -1);
    put("truncated", "<frond version='1'><material id='m'", -1);
    put("empty", "", 0);
    put("binary", "\177ELF\2\1\1\0\0\0\0", 11);
}

static void test_documents(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    put_graphs();
    put_texts();
    for (size_t i = 0; i < G_N_ELEMENTS(hostile); i++) {
        char *arguments = g_strdup_printf("check %s.frond --threads 2", hostile[i].name);
        Run did = run(arguments);
        bool is_small = IS_SANITIZED || did.peak_bytes < MOST_BYTES;
        if (did.exit != hostile[i].exit || !is_small ||
            !g_pattern_match_simple(hostile[i].err, did.err)) {
            g_test_fail_printf("%s: expected exit %d, errors '%s'", hostile[i].name,
                               hostile[i].exit, hostile[i].err);
        }
        clear(&did);
        g_free(arguments);
    }
    leave_folder(folder, previous);
}

static void test_no_documents(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    g_assert_cmpint(g_mkdir("folder.frond", 0777), ==, 0);
    static const char *const files[] = {"folder.frond", "none.frond", "/dev/null", "/dev/zero"};
    for (size_t i = 0; i < G_N_ELEMENTS(files); i++) {
        char *arguments = g_strdup_printf("check %s", files[i]);
        Run did = run(arguments);
        g_assert_true(did.exit == 1 || did.exit == 3 || did.exit == 4);
        g_assert_nonnull(strstr(did.err, files[i]));
        g_assert_nonnull(strstr(did.err, "error: "));
        if (!IS_SANITIZED) {
            g_assert_cmpuint(did.peak_bytes, <, MOST_BYTES);
        }
        clear(&did);
        g_free(arguments);
    }
    leave_folder(folder, previous);
}

static void test_models(void) {
    char *previous;
    char *folder = enter_folder(&previous);
    static const struct {
        const char *bytes;
        gssize size;
    } rows[] = {
        {"", 0},
        {"glTF", 4},
        {"glTF\2\0\0\0\24\0\0\0\377\377\377\377JSON", 20},
        {"glTF\2\0\0\0\24\0\0\0\20\0\0\0JSON{}", 22},
        {"glTF\1\0\0\0\24\0\0\0\2\0\0\0JSON{}", 22},
        {"glTF\2\0\0\0\26\0\0\0\2\0\0\0JSON[[", 22},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_assert_true(g_file_set_contents("m.glb", rows[i].bytes, rows[i].size, NULL));
        Run did = run("info m.glb");
        g_assert_true(did.exit == 1 || did.exit == 3);
        g_assert_nonnull(strstr(did.err, "m.glb"));
        clear(&did);
    }
    static const char odd[] = "{\"meshes\":[{\"primitives\":[{\"indices\":-3},{\"attributes\":"
                              "{\"POSITION\":7}}]}],\"nodes\":[{\"mesh\":5},{\"mesh\":\"x\"}]}";
    g_assert_true(g_file_set_contents("m.gltf", odd, -1, NULL));
    Run did = run("info m.gltf");
    g_assert_cmpint(did.exit, ==, 0);
    clear(&did);
    leave_folder(folder, previous);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/cli/hostile/documents end with a diagnostic at a place", test_documents);
    g_test_add_func("/cli/hostile/what is no document is said to be none", test_no_documents);
    g_test_add_func("/cli/hostile/broken models are said to be broken", test_models);
    return g_test_run();
}
