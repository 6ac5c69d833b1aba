/// Documents of the studio: every change can be undone to the last byte, and saving loses nothing.
#include "studio.h"
#include "studio/model/history.h"

#include <glib/gstdio.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const char small[] = "<frond version=\"1\">\n"
                            "  <plant id=\"p\">\n"
                            "    <pgraph>\n"
                            "      <camera id=\"root\"/>\n"
                            "      <horn id=\"stem\" length=\"1\"/>\n"
                            "      <link from=\"root\" to=\"stem\"/>\n"
                            "    </pgraph>\n"
                            "  </plant>\n"
                            "</frond>\n";

static StudioDocument *small_document(void) {
    return studio_document_new(small, strlen(small), "small", NULL);
}

static void test_undo_all(void) {
    StudioDocument *document = open_example("examples/figure2.frond");
    FrDigest first = studio_document_digest(document);
    uint32_t plant = first_plant(document);
    g_assert_true(studio_set(document, element_of(document, "B"), "length", "2", false));
    g_assert_true(studio_add_component(document, plant, FR_COMPONENT_LEAF, "D", NULL));
    g_assert_true(studio_rename_component(document, plant, "D", "twig"));
    g_assert_true(studio_duplicate_component(document, plant, "twig", true, NULL));
    g_assert_true(studio_enable_component(document, plant, "C", false));
    g_assert_true(studio_remove_component(document, plant, "B"));
    g_assert_cmpuint(studio_document_steps(document), ==, 6);
    FrDigest last = studio_document_digest(document);
    while (studio_document_undo(document)) {
    }
    g_assert_cmphex(studio_document_digest(document), ==, first);
    g_assert_true(studio_document_is_saved(document));
    while (studio_document_redo(document)) {
    }
    g_assert_cmphex(studio_document_digest(document), ==, last);
    studio_document_free(document);
}

static void test_add_along_stem(void) {
    StudioDocument *document = open_example("examples/sunflower.frond");
    uint32_t plant = first_plant(document);
    g_assert_true(studio_add_component(document, plant, FR_COMPONENT_LEAF, "stem", NULL));
    g_assert_false(studio_document_is_broken(document));
    g_assert_nonnull(
        strstr(text_of(document), "<link from=\"stem\" to=\"leaf\" kind=\"branch\"/>"));
    studio_document_free(document);
}

static void test_add_to_no_plant(void) {
    static const char none[] = "<frond version=\"1\"/>";
    StudioDocument *document = studio_document_new(none, strlen(none), "none", NULL);
    g_assert_false(studio_add_component(document, FR_NONE, FR_COMPONENT_LEAF, NULL, NULL));
    studio_document_free(document);
}

static void test_names(void) {
    StudioDocument *document = small_document();
    g_assert_null(studio_document_undo_name(document));
    studio_set(document, element_of(document, "stem"), "length", "2", false);
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Change length of stem");
    studio_document_undo(document);
    g_assert_null(studio_document_undo_name(document));
    g_assert_cmpstr(studio_document_redo_name(document), ==, "Change length of stem");
    studio_set(document, element_of(document, "stem"), "radius", "2", false);
    g_assert_null(studio_document_redo_name(document));
    studio_document_free(document);
}

static void test_drag(void) {
    StudioDocument *document = small_document();
    char value[8];
    for (int i = 2; i < 50; i++) {
        g_snprintf(value, sizeof value, "%d", i);
        studio_set(document, element_of(document, "stem"), "length", value, true);
    }
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    studio_document_seal(document);
    studio_set(document, element_of(document, "stem"), "length", "60", true);
    g_assert_cmpuint(studio_document_steps(document), ==, 2);
    studio_document_undo(document);
    g_assert_nonnull(strstr(text_of(document), "length=\"49\""));
    studio_document_undo(document);
    g_assert_cmpstr(text_of(document), ==, small);
    studio_document_free(document);
}

static void test_abandon(void) {
    StudioDocument *document = small_document();
    uint32_t stem = element_of(document, "stem");
    g_assert_false(studio_document_abandon(document)); // nothing is pressed
    studio_set(document, stem, "length", "2", true);
    char *before = g_strdup(text_of(document));
    studio_document_hold(document);
    studio_set(document, stem, "length", "3", true); // goes on with the step before
    studio_set(document, stem, "radius", "0.3", true);
    g_assert_cmpuint(studio_document_steps(document), ==, 2);
    g_assert_true(studio_document_abandon(document));
    g_assert_cmpstr(text_of(document), ==, before);
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_null(studio_document_redo_name(document));
    g_assert_false(studio_set(document, stem, "length", "4", true)); // the rest of the drag
    studio_document_release(document);
    g_assert_cmpstr(text_of(document), ==, before);
    g_assert_true(studio_set(document, stem, "length", "5", true));
    studio_document_undo(document);
    g_assert_cmpstr(text_of(document), ==, before);
    studio_document_undo(document);
    g_assert_cmpstr(text_of(document), ==, small);
    g_assert_true(studio_document_is_saved(document));
    g_free(before);
    studio_document_free(document);
}

static void test_drag_back(void) {
    StudioDocument *document = small_document();
    studio_set(document, element_of(document, "stem"), "length", "2", true);
    studio_set(document, element_of(document, "stem"), "length", "1", true);
    g_assert_cmpuint(studio_document_steps(document), ==, 0);
    g_assert_true(studio_document_is_saved(document));
    studio_document_free(document);
}

static void test_default(void) {
    StudioDocument *document = small_document();
    uint32_t stem = element_of(document, "stem");
    g_assert_false(studio_set(document, stem, "taper", "0.8", false));
    g_assert_true(studio_set(document, stem, "taper", "0.5", false));
    g_assert_true(studio_set(document, stem, "taper", NULL, false));
    g_assert_cmpstr(text_of(document), ==, small);
    studio_document_free(document);
}

static void test_components(void) {
    StudioDocument *document = small_document();
    char *id;
    g_assert_true(
        studio_add_component(document, first_plant(document), FR_COMPONENT_HORN, "stem", &id));
    g_assert_cmpstr(id, ==, "horn");
    g_assert_nonnull(strstr(text_of(document), "<horn id=\"stem\" length=\"1\"/>\n"
                                               "      <horn id=\"horn\"/>\n"
                                               "      <link from=\"root\" to=\"stem\"/>\n"
                                               "      <link from=\"stem\" to=\"horn\"/>\n"
                                               "    </pgraph>"));
    g_free(id);
    g_assert_true(
        studio_add_component(document, first_plant(document), FR_COMPONENT_HORN, "horn", &id));
    g_assert_cmpstr(id, ==, "horn2");
    g_free(id);
    g_assert_true(studio_remove_component(document, first_plant(document), "horn2"));
    g_assert_true(studio_remove_component(document, first_plant(document), "horn"));
    g_assert_cmpstr(text_of(document), ==, small);
    studio_document_free(document);
}

static void test_material(void) {
    static const char text[] =
        "<frond version='1'><material id='bark' texture='bark-smooth'/>"
        "<material id='blade' texture='leaf'/><plant id='p'><pgraph><camera id='r'/></pgraph>"
        "</plant></frond>";
    StudioDocument *document = studio_document_new(text, strlen(text), "m", NULL);
    studio_add_component(document, first_plant(document), FR_COMPONENT_LEAF, "r", NULL);
    g_assert_nonnull(strstr(text_of(document), "<leaf id=\"leaf\" material=\"blade\"/>"));
    studio_add_component(document, first_plant(document), FR_COMPONENT_TREE, "r", NULL);
    g_assert_nonnull(strstr(text_of(document), "<tree id=\"tree\" material=\"bark\"/>"));
    studio_document_free(document);
}

static void test_links(void) {
    StudioDocument *document = small_document();
    uint32_t plant = first_plant(document);
    g_assert_nonnull(studio_link_refusal(document, plant, "stem", "root"));
    g_assert_nonnull(studio_link_refusal(document, plant, "root", "stem"));
    g_assert_false(studio_add_link(document, plant, "root", "stem", FR_LINK_CHILD));
    g_assert_true(studio_add_link(document, plant, "stem", "stem", FR_LINK_CHILD));
    g_assert_nonnull(strstr(text_of(document), "length=\"1\" depth=\"3\""));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    studio_document_free(document);
}

static void test_rename(void) {
    static const char edited[] = "<frond version=\"1\"><plant id=\"p\"><pgraph><camera id=\"r\"/>"
                                 "<tree id=\"a\"/><leaf id=\"ab\"/><link from=\"r\" to=\"a\"/>"
                                 "<link from=\"a\" to=\"ab\" kind=\"branch\"/></pgraph><edits>"
                                 "<edit at=\"a/ab[3]\" prune=\"yes\"/></edits></plant></frond>";
    StudioDocument *document = studio_document_new(edited, strlen(edited), "e", NULL);
    uint32_t plant = first_plant(document);
    g_assert_false(studio_rename_component(document, plant, "a", "ab"));
    g_assert_false(studio_rename_component(document, plant, "a", "1x"));
    g_assert_false(studio_rename_component(document, plant, "a", ""));
    char *longest = g_strnfill(65, 'x'); // and one more
    g_assert_false(studio_rename_component(document, plant, "a", longest));
    g_free(longest);
    g_assert_true(studio_rename_component(document, plant, "a", "b"));
    g_assert_cmpstr(text_of(document), ==,
                    "<frond version=\"1\"><plant id=\"p\"><pgraph><camera id=\"r\"/>"
                    "<tree id=\"b\"/><leaf id=\"ab\"/><link from=\"r\" to=\"b\"/>"
                    "<link from=\"b\" to=\"ab\" kind=\"branch\"/></pgraph><edits>"
                    "<edit at=\"b/ab[3]\" prune=\"yes\"/></edits></plant></frond>");
    studio_document_free(document);
}

static void test_hand(void) {
    StudioDocument *document = small_document();
    studio_edit_instance(document, first_plant(document), "stem", "Prune %s", "prune", "yes", NULL);
    g_assert_nonnull(strstr(text_of(document), "    </pgraph>\n    <edits>\n"
                                               "      <edit at=\"stem\" prune=\"yes\"/>\n"
                                               "    </edits>\n"));
    studio_edit_instance(document, first_plant(document), "stem", "Hide %s", "hide", "yes", NULL);
    g_assert_nonnull(strstr(text_of(document), "<edit at=\"stem\" prune=\"yes\" hide=\"yes\"/>"));
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Hide stem");
    studio_document_free(document);
}

static void test_broken(void) {
    StudioDocument *document = small_document();
    static const char broken[] = "<frond><oops>";
    studio_document_replace(document, broken, strlen(broken), "Type", NULL);
    g_assert_true(studio_document_is_broken(document));
    uint32_t stem = element_of(document, "stem");
    g_assert_false(studio_set(document, stem, "length", "2", false));
    g_assert_cmpstr(text_of(document), ==, broken);
    studio_document_undo(document);
    g_assert_false(studio_document_is_broken(document));
    studio_document_free(document);
}

static void test_foreign(void) {
    static const char *const foreign[] = {"<frond><!-- caf\xe9 --></frond>", "<frond/>\0"};
    for (size_t i = 0; i < G_N_ELEMENTS(foreign); i++) {
        StudioDocument *document =
            studio_document_new(foreign[i], strlen(foreign[i]) + i, "foreign", NULL);
        g_assert_false(studio_document_is_text(document));
        g_assert_true(studio_document_is_broken(document));
        g_assert_false(studio_add_component(document, FR_NONE, FR_COMPONENT_LEAF, NULL, NULL));
        g_assert_cmpuint(studio_document_steps(document), ==, 0);
        studio_document_free(document);
    }
    StudioDocument *document = small_document();
    g_assert_true(studio_document_is_text(document));
    studio_document_free(document);
}

static void assert_saved_unchanged(const char *folder, const char *name) {
    StudioDocument *document = open_example(name);
    char *path = g_build_filename(folder, "x.frond", NULL), *from = project_file(name);
    g_assert_cmpint(studio_document_save(document, path, NULL), ==, FR_OK);
    char *written, *read;
    gsize written_size, read_size;
    g_assert_true(g_file_get_contents(path, &written, &written_size, NULL));
    g_assert_true(g_file_get_contents(from, &read, &read_size, NULL));
    if (written_size != read_size || memcmp(written, read, read_size) != 0) {
        g_error("%s: other bytes are saved", name);
    }
    g_assert_cmpstr(studio_document_name(document), ==, "x.frond");
    g_free(written);
    g_free(read);
    g_unlink(path);
    g_free(path);
    g_free(from);
    studio_document_free(document);
}

static void test_unchanged_save(void) {
    static const char *const folders[] = {"examples", "data/presets"};
    char *saved = g_dir_make_tmp("studio-XXXXXX", NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(folders); i++) {
        char *folder = project_file(folders[i]);
        GDir *dir = g_dir_open(folder, 0, NULL);
        int count = 0;
        for (const char *file; (file = g_dir_read_name(dir)) != NULL;) {
            char *name = g_build_filename(folders[i], file, NULL);
            if (g_str_has_suffix(name, ".frond")) {
                assert_saved_unchanged(saved, name);
                count++;
            }
            g_free(name);
        }
        g_assert_cmpint(count, >, 20);
        g_dir_close(dir);
        g_free(folder);
    }
    remove_tree(saved); // with meshes that were taken along
    g_free(saved);
}

// A file may not grow beyond some bytes: as on a disk that is full.
static void test_full_disk(void) {
    char *folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    char *path = g_build_filename(folder, "x.frond", NULL), *read;
    gsize size, size_after;
    StudioDocument *document = small_document();
    g_assert_cmpint(studio_document_save(document, path, NULL), ==, FR_OK);
    g_assert_true(g_file_get_contents(path, &read, &size, NULL));
    g_free(read);
    studio_set(document, element_of(document, "stem"), "length", "2", false);
    struct rlimit before, little = {16, RLIM_INFINITY};
    FrDiags *diags = fr_diags_new();
    getrlimit(RLIMIT_FSIZE, &before);
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &little);
    FrStatus status = studio_document_save(document, path, diags);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, handler);
    g_assert_cmpint(status, ==, FR_ERR_MACHINE);
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 1);
    g_assert_false(studio_document_is_saved(document));
    g_assert_true(g_file_get_contents(path, &read, &size_after, NULL));
    g_assert_cmpuint(size_after, ==, size);
    g_free(read);
    fr_diags_free(diags);
    studio_document_free(document);
    g_unlink(path);
    g_assert_cmpint(g_rmdir(folder), ==, 0); // nothing is left beside it
    g_free(path);
    g_free(folder);
}

static void test_changed_elsewhere(void) {
    static const char theirs[] = "<frond version='1'/>\n";
    char *folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    char *path = g_build_filename(folder, "x.frond", NULL), *read;
    StudioDocument *document = small_document();
    g_assert_cmpint(studio_document_save(document, path, NULL), ==, FR_OK);
    studio_set(document, element_of(document, "stem"), "length", "2", false);
    g_assert_cmpint(studio_document_save(document, NULL, NULL), ==, FR_OK);
    g_assert_true(g_file_set_contents(path, theirs, -1, NULL));
    studio_set(document, element_of(document, "stem"), "length", "3", false);
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(studio_document_save(document, NULL, diags), ==, FR_ERR_MACHINE);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "changed-file");
    g_assert_false(studio_document_is_saved(document));
    g_assert_true(g_file_get_contents(path, &read, NULL, NULL));
    g_assert_cmpstr(read, ==, theirs);
    // Who names the file means it.
    g_assert_cmpint(studio_document_save(document, path, NULL), ==, FR_OK);
    g_assert_true(studio_document_is_saved(document));
    fr_diags_free(diags);
    studio_document_free(document);
    g_free(read);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
}

static void test_saved(void) {
    char *folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    char *path = g_build_filename(folder, "x.frond", NULL);
    StudioDocument *document = small_document();
    studio_set(document, element_of(document, "stem"), "length", "2", false);
    g_assert_false(studio_document_is_saved(document));
    g_assert_cmpint(studio_document_save(document, path, NULL), ==, FR_OK);
    g_assert_true(studio_document_is_saved(document));
    studio_document_undo(document);
    g_assert_false(studio_document_is_saved(document));
    studio_set(document, element_of(document, "stem"), "length", "3", false);
    studio_document_undo(document);
    g_assert_false(studio_document_is_saved(document));
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(studio_document_save(document, "/nowhere/x.frond", diags), ==, FR_ERR_MACHINE);
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 1);
    g_assert_cmpstr(studio_document_path(document), ==, path);
    fr_diags_free(diags);
    studio_document_free(document);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
}

static void count_change(void *user) {
    ++*(int *)user;
}

static void test_watchers(void) {
    StudioDocument *document = small_document();
    int changes = 0;
    studio_document_watch(document, count_change, &changes);
    studio_set(document, element_of(document, "stem"), "length", "2", false);
    studio_set(document, element_of(document, "stem"), "length", "2", false);
    g_assert_cmpint(changes, ==, 1);
    studio_document_unwatch(document, count_change, &changes);
    studio_document_undo(document);
    g_assert_cmpint(changes, ==, 1);
    studio_document_free(document);
}

// A process of its own saves two texts in turn until it is killed.
static void save_for_ever(const char *path, const char *const texts[2]) {
    StudioDocument *document = studio_document_new(texts[0], strlen(texts[0]), "x", NULL);
    for (int i = 0;; i = !i) {
        studio_document_replace(document, texts[i], strlen(texts[i]), "Type", NULL);
        if (studio_document_save(document, path, NULL) != FR_OK) {
            _exit(1);
        }
    }
}

static void test_killed(void) {
    char *folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    char *path = g_build_filename(folder, "x.frond", NULL);
    char *texts[2];
    for (int i = 0; i < 2; i++) {
        char *filling = g_strnfill(200000, i == 0 ? 'a' : 'b');
        texts[i] = g_strdup_printf("<frond version=\"1\"><!-- %s --></frond>\n", filling);
        g_free(filling);
    }
    g_assert_true(g_file_set_contents(path, texts[0], -1, NULL));
    for (int i = 0; i < 100; i++) {
        pid_t child = fork();
        if (child == 0) {
            save_for_ever(path, (const char *const *)texts);
        }
        g_usleep(1000 + (gulong)g_test_rand_int_range(0, 9000));
        kill(child, SIGKILL);
        int status;
        g_assert_cmpint(waitpid(child, &status, 0), ==, child);
        g_assert_true(WIFSIGNALED(status));
        char *read;
        g_assert_true(g_file_get_contents(path, &read, NULL, NULL));
        g_assert_true(strcmp(read, texts[0]) == 0 || strcmp(read, texts[1]) == 0);
        g_free(read);
    }
    GDir *left = g_dir_open(folder, 0, NULL);
    const char *name;
    while ((name = g_dir_read_name(left)) != NULL) {
        char *file = g_build_filename(folder, name, NULL);
        g_unlink(file);
        g_free(file);
    }
    g_dir_close(left);
    g_rmdir(folder);
    g_free(texts[0]);
    g_free(texts[1]);
    g_free(path);
    g_free(folder);
}

static void test_lsystem(void) {
    char *folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    char *file = g_build_filename(folder, "my weed.l", NULL);
    char *view = g_build_filename(folder, "my weed.v", NULL);
    const char *text = "Lsystem: 1\nderivation length: 1\naxiom: A\nA --> F\nendlsystem\n";
    g_assert_true(g_file_set_contents(file, text, -1, NULL));
    g_assert_true(g_file_set_contents(view, "angle factor: 8\n", -1, NULL));
    StudioDocument *document;
    g_assert_cmpint(studio_document_open(file, NULL, &document), ==, FR_OK);
    g_assert_null(studio_document_path(document));
    g_assert_cmpstr(studio_document_name(document), ==, "my weed.frond");
    g_assert_nonnull(strstr(text_of(document), "<plant id=\"my_weed\">"));
    g_assert_nonnull(strstr(text_of(document), "view=\"my weed.v\""));
    FrContext context = fr_context_default();
    FrDocument *read;
    g_assert_cmpint(fr_document_parse(studio_document_source(document),
                                      studio_document_folder(document), &context, &read),
                    ==, FR_OK);
    fr_document_free(read);
    studio_document_free(document);
    g_unlink(view);
    g_unlink(file);
    g_rmdir(folder);
    g_free(view);
    g_free(file);
    g_free(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/document/undoing all gives the first bytes", test_undo_all);
    g_test_add_func("/studio/document/a leaf is added along a stem", test_add_along_stem);
    g_test_add_func("/studio/document/nothing is added to no plant", test_add_to_no_plant);
    g_test_add_func("/studio/document/steps have names", test_names);
    g_test_add_func("/studio/document/a drag is one step", test_drag);
    g_test_add_func("/studio/document/what a pointer did is taken back and the rest ignored",
                    test_abandon);
    g_test_add_func("/studio/document/a drag back to its start is none", test_drag_back);
    g_test_add_func("/studio/document/a default is not written", test_default);
    g_test_add_func("/studio/document/components come with their links", test_components);
    g_test_add_func("/studio/document/a new component has a material that suits", test_material);
    g_test_add_func("/studio/document/links are refused with a reason", test_links);
    g_test_add_func("/studio/document/a new name reaches links and edits", test_rename);
    g_test_add_func("/studio/document/edits by hand are gathered", test_hand);
    g_test_add_func("/studio/document/a broken text refuses edits of elements", test_broken);
    g_test_add_func("/studio/document/what is not UTF-8 is no text and refuses edits",
                    test_foreign);
    g_test_add_func("/studio/document/every example saved unchanged is the same file",
                    test_unchanged_save);
    g_test_add_func("/studio/document/on a full disk the file stays and it is told",
                    test_full_disk);
    g_test_add_func("/studio/document/what another has written meanwhile is not written over",
                    test_changed_elsewhere);
    g_test_add_func("/studio/document/it knows whether it is saved", test_saved);
    g_test_add_func("/studio/document/watchers hear of each change once", test_watchers);
    g_test_add_func("/studio/document/killed while saving 100 times the file is whole",
                    test_killed);
    g_test_add_func("/studio/document/an L-system becomes a document with its view", test_lsystem);
    return g_test_run();
}
