/// Copies of unsaved documents outlive the program, and only then.
#include "studio.h"
#include "studio/model/recovery.h"

#include <glib/gstdio.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

static const char text[] = "<frond version='1'/>\n", other[] = "<frond version='1'></frond>\n";

typedef struct Fixture {
    char *folder, *file;
} Fixture;

static void set_up(Fixture *fixture, gconstpointer data) {
    (void)data;
    fixture->folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    fixture->file = g_build_filename(fixture->folder, "x.frond", NULL);
    g_assert_true(g_file_set_contents(fixture->file, text, -1, NULL));
}

static void tear_down(Fixture *fixture, gconstpointer data) {
    (void)data;
    GDir *left = g_dir_open(fixture->folder, 0, NULL);
    const char *name;
    while ((name = g_dir_read_name(left)) != NULL) {
        char *file = g_build_filename(fixture->folder, name, NULL);
        g_unlink(file);
        g_free(file);
    }
    g_dir_close(left);
    g_rmdir(fixture->folder);
    g_free(fixture->file);
    g_free(fixture->folder);
}

static guint count_files(const Fixture *fixture) {
    GDir *directory = g_dir_open(fixture->folder, 0, NULL);
    guint count = 0;
    while (g_dir_read_name(directory) != NULL) {
        count++;
    }
    g_dir_close(directory);
    return count;
}

static bool has_note(const Fixture *fixture) {
    GDir *directory = g_dir_open(fixture->folder, 0, NULL);
    const char *name;
    bool is_there = false;
    while ((name = g_dir_read_name(directory)) != NULL) {
        is_there = is_there || g_str_has_suffix(name, ".ini");
    }
    g_dir_close(directory);
    return is_there;
}

static guint count_left(const Fixture *fixture) {
    GPtrArray *list = studio_recovery_list(fixture->folder);
    guint count = list->len;
    g_ptr_array_unref(list);
    return count;
}

static void test_saved_leaves_nothing(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document;
    g_assert_cmpint(studio_document_open(fixture->file, NULL, &document), ==, FR_OK);
    StudioRecovery *recovery = studio_recovery_new(fixture->folder, document);
    g_assert_true(studio_recovery_update(recovery));
    g_assert_cmpuint(count_files(fixture), ==, 1);
    studio_document_replace(document, other, strlen(other), "Type", NULL);
    g_assert_true(studio_recovery_update(recovery));
    g_assert_cmpuint(count_files(fixture), ==, 3);
    g_assert_cmpint(studio_document_save(document, NULL, NULL), ==, FR_OK);
    g_assert_true(studio_recovery_update(recovery));
    g_assert_cmpuint(count_files(fixture), ==, 1);
    studio_document_undo(document);
    studio_recovery_update(recovery);
    studio_recovery_free(recovery);
    g_assert_cmpuint(count_files(fixture), ==, 1);
    studio_document_free(document);
}

// Edits a document in a process of its own until it is killed.
static void edit_for_ever(const Fixture *fixture) {
    StudioDocument *document;
    if (studio_document_open(fixture->file, NULL, &document) != FR_OK) {
        _exit(1);
    }
    StudioRecovery *recovery = studio_recovery_new(fixture->folder, document);
    for (uint32_t i = 0;; i++) {
        char *next = g_strdup_printf("<frond version='1'><!-- %u --></frond>\n", i);
        studio_document_replace(document, next, strlen(next), "Type", NULL);
        g_free(next);
        studio_recovery_update(recovery);
    }
}

static void test_killed(Fixture *fixture, gconstpointer data) {
    (void)data;
    for (int i = 0; i < 20; i++) {
        pid_t child = fork();
        if (child == 0) {
            edit_for_ever(fixture);
        }
        while (!has_note(fixture)) {
            g_usleep(200);
        }
        g_assert_cmpuint(count_left(fixture), ==, 0); // it still runs
        g_usleep((gulong)g_test_rand_int_range(0, 9000));
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
        GPtrArray *list = studio_recovery_list(fixture->folder);
        g_assert_cmpuint(list->len, ==, 1);
        const StudioLeft *left = g_ptr_array_index(list, 0);
        g_assert_cmpstr(left->path, ==, fixture->file);
        StudioDocument *document = studio_recovery_restore(left, NULL);
        g_assert_nonnull(document);
        g_assert_false(studio_document_is_saved(document));
        g_assert_true(g_str_has_prefix(text_of(document), "<frond version='1'><!-- "));
        g_assert_true(g_str_has_suffix(text_of(document), " --></frond>\n"));
        studio_document_undo(document);
        g_assert_cmpstr(text_of(document), ==, text);
        g_assert_false(studio_document_is_saved(document));
        studio_document_free(document);
        studio_recovery_discard(left);
        g_assert_cmpuint(count_left(fixture), ==, 0);
        g_ptr_array_unref(list);
        tear_down(fixture, NULL); // half-written copies too
        set_up(fixture, NULL);
    }
}

static void test_without_file(Fixture *fixture, gconstpointer data) {
    (void)data;
    char *gone = g_build_filename(fixture->folder, "1-0.frond", NULL);
    char *note = g_build_filename(fixture->folder, "1-0.ini", NULL);
    g_assert_true(g_file_set_contents(gone, other, -1, NULL));
    g_assert_true(g_file_set_contents(
        note, "[Recovery]\nprocess=1\nstart=-5\nname=New plant\nfolder=/x\n", -1, NULL));
    GPtrArray *list = studio_recovery_list(fixture->folder);
    g_assert_cmpuint(list->len, ==, 1);
    StudioDocument *document = studio_recovery_restore(g_ptr_array_index(list, 0), NULL);
    g_assert_cmpstr(studio_document_name(document), ==, "New plant");
    g_assert_null(studio_document_path(document));
    g_assert_cmpstr(text_of(document), ==, other);
    studio_document_free(document);
    g_ptr_array_unref(list);
    g_free(gone);
    g_free(note);
}

#define ADD(name, function) g_test_add(name, Fixture, NULL, set_up, function, tear_down)

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    ADD("/studio/recovery/what is saved or closed leaves no copy", test_saved_leaves_nothing);
    ADD("/studio/recovery/killed while editing the last copy is whole", test_killed);
    ADD("/studio/recovery/a document without a file is recovered by name", test_without_file);
    return g_test_run();
}
