/// Copies of unsaved documents outlive the program, and only then.
#include "studio.h"
#include "studio/model/recovery.h"

#include <glib/gstdio.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
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

// Whether the child has not ended by itself. What it does may take long on a busy machine, but it
// ends where a file cannot be written or a check fails.
static bool lives(pid_t child) {
    return waitpid(child, NULL, WNOHANG) == 0;
}

// How often a test kills: FROND_KILLS, else 100 times, or few where sanitizers make it slow.
static int count_kills(void) {
    const char *given = g_getenv("FROND_KILLS");
    int usual = g_getenv("FROND_SANITIZED") == NULL ? 100 : 10;
    return given == NULL ? usual : atoi(given);
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
    for (int i = 0; i < count_kills(); i++) {
        pid_t child = fork();
        if (child == 0) {
            edit_for_ever(fixture);
        }
        while (!has_note(fixture)) {
            g_assert_true(lives(child));
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

// ---- killed while saving -----------------------------------------------------------------------

enum { SAVE_EVERY = 3 }; // the states 3, 6, 9 … are saved, the others have copies only

// What the child has surely done when it is killed.
typedef struct Done {
    volatile int copied, saved; // states
} Done;

// The text of a state, of 0 to 20 kB. Free with g_free().
static char *state_text(int state) {
    int length = (int)((unsigned)state * 7919 % 20000);
    char *filling = g_strnfill((gsize)length, 'x');
    char *whole = g_strdup_printf("<frond version='1'><!-- %d %s --></frond>\n", state, filling);
    g_free(filling);
    return whole;
}

// The state whose text that is to the byte.
static int state_of(const char *found) {
    int state = 0;
    if (strcmp(found, text) != 0) {
        g_assert_cmpint(sscanf(found, "<frond version='1'><!-- %d ", &state), ==, 1);
        char *whole = state_text(state);
        g_assert_cmpstr(found, ==, whole);
        g_free(whole);
    }
    return state;
}

// Edits and saves in a process of its own until it is killed.
static void save_for_ever(const Fixture *fixture, int state, Done *done) {
    StudioDocument *document;
    if (studio_document_open(fixture->file, NULL, &document) != FR_OK) {
        _exit(1);
    }
    StudioRecovery *recovery = studio_recovery_new(fixture->folder, document);
    for (;; state++) {
        char *next = state_text(state);
        studio_document_replace(document, next, strlen(next), "Type", NULL);
        g_free(next);
        if (state % SAVE_EVERY != 0) {
            if (studio_recovery_update(recovery)) {
                done->copied = state;
            }
        } else if (studio_recovery_save(recovery, NULL, NULL) == FR_OK) {
            done->saved = state;
        }
    }
}

static int saved_state(const Fixture *fixture) {
    StudioDocument *document;
    g_assert_cmpint(studio_document_open(fixture->file, NULL, &document), ==, FR_OK);
    g_assert_false(studio_document_is_broken(document));
    int state = state_of(text_of(document));
    g_assert_cmpint(state % SAVE_EVERY, ==, 0);
    studio_document_free(document);
    return state;
}

// The newest state that is offered to be recovered, which it takes away; 0: none is.
static int offered_state(const Fixture *fixture) {
    GPtrArray *list = studio_recovery_list(fixture->folder);
    g_assert_cmpuint(list->len, <=, 1);
    int state = 0;
    if (list->len == 1) {
        const StudioLeft *left = g_ptr_array_index(list, 0);
        StudioDocument *document = studio_recovery_restore(left, NULL);
        g_assert_nonnull(document);
        state = state_of(text_of(document));
        studio_document_free(document);
        studio_recovery_discard(left);
    }
    g_ptr_array_unref(list);
    return state;
}

// What earlier children have left half-written stays in the folder and must not matter.
static void test_killed_saving(Fixture *fixture, gconstpointer data) {
    (void)data;
    Done *done =
        mmap(NULL, sizeof *done, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    g_assert_true(done != MAP_FAILED);
    int first = 0, most_saved = 0, offers = 0;
    for (int i = 0; i < count_kills(); i++) {
        *done = (Done){.copied = first, .saved = first};
        pid_t child = fork();
        if (child == 0) {
            save_for_ever(fixture, first + 1, done);
        }
        int wanted = first + g_test_rand_int_range(0, 2 * SAVE_EVERY + 1);
        while (MAX(done->copied, done->saved) < wanted) {
            g_assert_true(lives(child));
            g_usleep(100);
        }
        g_usleep((gulong)g_test_rand_int_range(0, 9000));
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
        int saved = saved_state(fixture), offered = offered_state(fixture);
        g_assert_cmpint(saved, >=, done->saved);
        g_assert_true(offered == 0 || offered > saved);
        g_assert_true(done->copied <= saved || offered >= done->copied);
        most_saved = MAX(most_saved, saved - first);
        offers += offered != 0;
        first = saved;
    }
    g_assert_cmpint(munmap(done, sizeof *done), ==, 0);
    g_test_message("%d kills: %d recoveries offered, at most %d states in one life", count_kills(),
                   offers, most_saved);
}

static void test_saved_just_before(Fixture *fixture, gconstpointer data) {
    (void)data;
    char *copy = g_build_filename(fixture->folder, "1-0.frond", NULL);
    char *note = g_build_filename(fixture->folder, "1-0.ini", NULL);
    char *says = g_strdup_printf("[Recovery]\nprocess=1\nstart=-5\nname=x\nfolder=/\npath=%s\n",
                                 fixture->file);
    g_assert_true(g_file_set_contents(note, says, -1, NULL));
    g_assert_true(g_file_set_contents(copy, other, -1, NULL));
    g_assert_cmpuint(count_left(fixture), ==, 1);
    g_assert_true(g_file_set_contents(copy, text, -1, NULL));
    g_assert_cmpuint(count_left(fixture), ==, 0);
    g_assert_cmpuint(count_files(fixture), ==, 1); // the document alone
    g_free(says);
    g_free(note);
    g_free(copy);
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
    ADD("/studio/recovery/killed while saving the file is whole and only newer states are offered",
        test_killed_saving);
    ADD("/studio/recovery/a copy that the file holds just so is not offered",
        test_saved_just_before);
    ADD("/studio/recovery/a document without a file is recovered by name", test_without_file);
    return g_test_run();
}
