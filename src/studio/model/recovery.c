#include "studio/model/recovery.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static const char group[] = "Recovery";

// Two files: X.frond is the text; X.ini, written after it, says what it belongs to.
struct StudioRecovery {
    StudioDocument *document;
    char *text_file, *note_file;
    uint64_t revision; // of the copy; 0: there is none
};

char *studio_recovery_folder(void) {
    return g_build_filename(g_get_user_state_dir(), "frond", "recovery", NULL);
}

// When a process began, in ticks since the machine did: numbers of processes come again. 0:
// unknown.
static gint64 start_of(gint64 process) {
    char *file = g_strdup_printf("/proc/%" G_GINT64_FORMAT "/stat", process);
    char *text = NULL;
    gint64 start = 0;
    if (g_file_get_contents(file, &text, NULL, NULL)) {
        // The name in brackets may hold blanks; the start is the 20th field behind it.
        const char *end = strrchr(text, ')');
        char **fields = g_strsplit(end == NULL ? "" : end + 2, " ", 22);
        start = g_strv_length(fields) > 19 ? g_ascii_strtoll(fields[19], NULL, 10) : 0;
        g_strfreev(fields);
    }
    g_free(text);
    g_free(file);
    return start;
}

StudioRecovery *studio_recovery_new(const char *folder, StudioDocument *document) {
    g_mkdir_with_parents(folder, 0700);
    StudioRecovery *recovery = g_new0(StudioRecovery, 1);
    recovery->document = document;
    char *name = g_uuid_string_random(); // no other program or window has it
    recovery->text_file = g_strdup_printf("%s/%s.frond", folder, name);
    recovery->note_file = g_strdup_printf("%s/%s.ini", folder, name);
    g_free(name);
    return recovery;
}

static void remove_copy(StudioRecovery *recovery) {
    g_unlink(recovery->note_file);
    g_unlink(recovery->text_file);
    recovery->revision = 0;
}

void studio_recovery_free(StudioRecovery *recovery) {
    if (recovery != NULL) {
        remove_copy(recovery);
        g_free(recovery->text_file);
        g_free(recovery->note_file);
        g_free(recovery);
    }
}

static bool write_whole(const char *file, const char *text, size_t size) {
    return g_file_set_contents_full(file, text, (gssize)size,
                                    G_FILE_SET_CONTENTS_CONSISTENT | G_FILE_SET_CONTENTS_DURABLE,
                                    0600, NULL);
}

static bool write_note(const StudioRecovery *recovery) {
    const StudioDocument *document = recovery->document;
    const char *path = studio_document_path(document);
    GKeyFile *note = g_key_file_new();
    g_key_file_set_int64(note, group, "process", getpid());
    g_key_file_set_int64(note, group, "start", start_of(getpid()));
    g_key_file_set_string(note, group, "name", studio_document_name(document));
    char *folder = g_canonicalize_filename(studio_document_folder(document), NULL);
    g_key_file_set_string(note, group, "folder", folder);
    if (path != NULL) {
        g_key_file_set_string(note, group, "path", path);
    }
    gsize size;
    char *text = g_key_file_to_data(note, &size, NULL);
    bool is_written = write_whole(recovery->note_file, text, size);
    g_free(text);
    g_free(folder);
    g_key_file_unref(note);
    return is_written;
}

bool studio_recovery_update(StudioRecovery *recovery) {
    const StudioDocument *document = recovery->document;
    if (studio_document_is_saved(document)) {
        if (recovery->revision != 0) {
            remove_copy(recovery);
        }
        return true;
    }
    uint64_t revision = studio_document_revision(document);
    if (revision == recovery->revision) {
        return true;
    }
    size_t size;
    const char *text = fr_source_text(studio_document_source(document), &size);
    bool is_written = write_whole(recovery->text_file, text, size) && write_note(recovery);
    recovery->revision = is_written ? revision : 0;
    return is_written;
}

FrStatus studio_recovery_save(StudioRecovery *recovery, const char *path, FrDiags *diags) {
    studio_recovery_update(recovery); // if that fails, saving is needed the more
    FrStatus status = studio_document_save(recovery->document, path, diags);
    if (status == FR_OK) {
        studio_recovery_update(recovery);
    }
    return status;
}

// ---- what was left -----------------------------------------------------------------------------

static void left_free(gpointer data) {
    StudioLeft *left = data;
    g_free(left->text_file);
    g_free(left->path);
    g_free(left->name);
    g_free(left->folder);
    g_free(left);
}

static bool is_alive(gint64 process, gint64 start) {
    return process > 0 && (kill((pid_t)process, 0) == 0 || errno == EPERM) &&
           start_of(process) == start;
}

// Whether the file holds what the copy does: the program ended after saving.
static bool is_saved(const StudioLeft *left) {
    char *file = NULL, *copy = NULL;
    gsize file_size, copy_size;
    bool is_same = left->path != NULL && g_file_get_contents(left->path, &file, &file_size, NULL) &&
                   g_file_get_contents(left->text_file, &copy, &copy_size, NULL) &&
                   file_size == copy_size && memcmp(file, copy, file_size) == 0;
    g_free(file);
    g_free(copy);
    return is_same;
}

// What a note tells of; NULL if its program still runs or it makes no sense.
static StudioLeft *read_note(const char *file) {
    GKeyFile *note = g_key_file_new();
    StudioLeft *left = NULL;
    char *text_file = g_strdup_printf("%.*s.frond", (int)(strlen(file) - strlen(".ini")), file);
    if (g_key_file_load_from_file(note, file, G_KEY_FILE_NONE, NULL) &&
        !is_alive(g_key_file_get_int64(note, group, "process", NULL),
                  g_key_file_get_int64(note, group, "start", NULL)) &&
        g_file_test(text_file, G_FILE_TEST_IS_REGULAR)) {
        left = g_new0(StudioLeft, 1);
        left->text_file = g_steal_pointer(&text_file);
        left->path = g_key_file_get_string(note, group, "path", NULL);
        left->name = g_key_file_get_string(note, group, "name", NULL);
        left->folder = g_key_file_get_string(note, group, "folder", NULL);
    }
    g_free(text_file);
    g_key_file_unref(note);
    return left;
}

static gint64 age_of(const StudioLeft *left) {
    GStatBuf status;
    return g_stat(left->text_file, &status) == 0 ? (gint64)status.st_mtime : 0;
}

static int compare_ages(const void *a, const void *b) {
    gint64 first = age_of(*(StudioLeft *const *)a), second = age_of(*(StudioLeft *const *)b);
    return (first > second) - (first < second);
}

GPtrArray *studio_recovery_list(const char *folder) {
    GPtrArray *list = g_ptr_array_new_with_free_func(left_free);
    GDir *directory = g_dir_open(folder, 0, NULL);
    const char *name;
    while (directory != NULL && (name = g_dir_read_name(directory)) != NULL) {
        if (g_str_has_suffix(name, ".ini")) {
            char *file = g_build_filename(folder, name, NULL);
            StudioLeft *left = read_note(file);
            if (left != NULL && is_saved(left)) {
                studio_recovery_discard(left);
                left_free(left);
            } else if (left != NULL) {
                g_ptr_array_add(list, left);
            }
            g_free(file);
        }
    }
    g_clear_pointer(&directory, g_dir_close);
    g_ptr_array_sort(list, compare_ages);
    return list;
}

StudioDocument *studio_recovery_restore(const StudioLeft *left, FrDiags *diags) {
    FrStatus status;
    StudioDocument *document = NULL;
    FrDiags *none = NULL;
    if (left->path != NULL && studio_document_open(left->path, none, &document) != FR_OK) {
        document = NULL;
    }
    FrSource *copy =
        fr_source_load(left->text_file, fr_context_default().limits.document_bytes, diags, &status);
    if (copy == NULL) {
        studio_document_free(document);
        return NULL;
    }
    size_t size;
    const char *text = fr_source_text(copy, &size);
    if (document != NULL) {
        // The file as it is comes first, so that undo leads back to it.
        studio_document_replace(document, text, size, "Recover unsaved changes", NULL);
    } else {
        document = studio_document_new(text, size, left->name != NULL ? left->name : "Recovered",
                                       left->folder);
    }
    studio_document_mark_unsaved(document);
    fr_source_unref(copy);
    return document;
}

void studio_recovery_discard(const StudioLeft *left) {
    char *note = g_strdup_printf("%.*s.ini", (int)(strlen(left->text_file) - strlen(".frond")),
                                 left->text_file);
    g_unlink(note);
    g_unlink(left->text_file);
    g_free(note);
}
