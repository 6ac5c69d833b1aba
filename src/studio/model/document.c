#include "studio/model/document.h"

#include "frond/document.h"
#include "studio/model/carry.h"
#include "studio/model/history.h"

#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>

static const char lsystem_ending[] = ".l";

typedef struct Watcher {
    StudioChanged changed;
    void *user;
} Watcher;

struct StudioDocument {
    StudioHistory *history;
    FrSource *source;
    FrContents *contents; // of the last well-formed text; NULL if there was none
    bool is_broken;
    bool is_recovered; // the file holds another text than the first of the history
    FrDigest on_disk;  // of the file when it was read or saved …
    bool knows_disk;   // … if it was
    uint64_t revision;
    FrSource *held;      // the text when a pointer was pressed; NULL: none is
    uint32_t held_steps; // how many there were then
    bool is_abandoned;   // what that pointer does is to be ignored
    char *path, *name, *folder;
    GArray *watchers; // Watcher
};

static void notify(StudioDocument *document) {
    for (guint i = 0; i < document->watchers->len; i++) {
        Watcher watcher = g_array_index(document->watchers, Watcher, i);
        watcher.changed(watcher.user);
    }
}

// Brings all that follows from the text up to it.
static void follow_text(StudioDocument *document) {
    size_t size;
    const char *text = studio_history_text(document->history, &size);
    fr_source_unref(document->source);
    document->source = fr_source_new(document->name, text, size);
    FrContext context = fr_context_default();
    FrContents *contents;
    document->is_broken = fr_contents_read(document->source, &context, &contents) != FR_OK;
    if (!document->is_broken) {
        fr_contents_free(document->contents);
        document->contents = contents;
    }
    document->revision++;
}

StudioDocument *studio_document_new(const char *text, size_t size, const char *name,
                                    const char *folder) {
    StudioDocument *document = g_new0(StudioDocument, 1);
    document->history = studio_history_new(text, size);
    document->name = g_strdup(name);
    document->folder = g_strdup(folder == NULL ? "." : folder);
    document->watchers = g_array_new(FALSE, FALSE, sizeof(Watcher));
    document->source = fr_source_new(name, "", 0);
    follow_text(document);
    return document;
}

static void adopt_path(StudioDocument *document, const char *path) {
    char *own = g_canonicalize_filename(path, NULL);
    g_free(document->path);
    g_free(document->name);
    g_free(document->folder);
    document->path = own;
    document->name = g_path_get_basename(own);
    document->folder = g_path_get_dirname(own);
}

// The document of a plant that is the L-system of a file. It has no file of its own yet.
static StudioDocument *document_of_lsystem(const char *path, const char *text) {
    char *own = g_canonicalize_filename(path, NULL), *folder = g_path_get_dirname(own);
    char *base = g_path_get_basename(own);
    base[strlen(base) - strlen(lsystem_ending)] = '\0';
    char *view = g_strconcat(base, ".v", NULL), *beside = g_build_filename(folder, view, NULL);
    char *id = g_strdup(base);
    for (char *at = id; *at != '\0'; at++) {
        *at = g_ascii_isalnum(*at) ? *at : '_';
    }
    bool has_view = g_file_test(beside, G_FILE_TEST_IS_REGULAR);
    char *whole = fr_document_wrap_lsystem(fr_contents_is_id(id) ? id : "plant", text,
                                           has_view ? view : NULL);
    char *name = g_strconcat(base, ".frond", NULL);
    StudioDocument *document = studio_document_new(whole, strlen(whole), name, folder);
    char *const strings[] = {name, whole, id, beside, view, base, folder, own};
    for (size_t i = 0; i < G_N_ELEMENTS(strings); i++) {
        g_free(strings[i]);
    }
    return document;
}

FrStatus studio_document_open(const char *path, FrDiags *diags, StudioDocument **document) {
    *document = NULL;
    FrStatus status;
    FrLimits limits = fr_context_default().limits;
    FrSource *source = fr_source_load(path, limits.document_bytes, diags, &status);
    if (source == NULL) {
        return status;
    }
    size_t size;
    const char *text = fr_source_text(source, &size);
    if (g_str_has_suffix(path, lsystem_ending)) {
        *document = document_of_lsystem(path, text);
    } else {
        *document = studio_document_new(text, size, "", NULL);
        adopt_path(*document, path);
        follow_text(*document);
        (*document)->on_disk = fr_digest(0, text, size);
        (*document)->knows_disk = true;
    }
    fr_source_unref(source);
    return FR_OK;
}

void studio_document_free(StudioDocument *document) {
    if (document != NULL) {
        studio_history_free(document->history);
        fr_contents_free(document->contents);
        fr_source_unref(document->source);
        fr_source_unref(document->held);
        g_free(document->path);
        g_free(document->name);
        g_free(document->folder);
        g_array_unref(document->watchers);
        g_free(document);
    }
}

void studio_document_watch(StudioDocument *document, StudioChanged changed, void *user) {
    Watcher watcher = {changed, user};
    g_array_append_val(document->watchers, watcher);
}

void studio_document_unwatch(StudioDocument *document, StudioChanged changed, void *user) {
    for (guint i = document->watchers->len; i-- > 0;) {
        Watcher watcher = g_array_index(document->watchers, Watcher, i);
        if (watcher.changed == changed && watcher.user == user) {
            g_array_remove_index(document->watchers, i);
        }
    }
}

// ---- what it is --------------------------------------------------------------------------------

const char *studio_document_path(const StudioDocument *document) {
    return document->path;
}

const char *studio_document_name(const StudioDocument *document) {
    return document->name;
}

const char *studio_document_folder(const StudioDocument *document) {
    return document->folder;
}

FrSource *studio_document_source(const StudioDocument *document) {
    return document->source;
}

const FrContents *studio_document_contents(const StudioDocument *document) {
    return document->contents;
}

bool studio_document_is_broken(const StudioDocument *document) {
    return document->is_broken;
}

bool studio_document_is_text(const StudioDocument *document) {
    size_t size;
    const char *text = studio_history_text(document->history, &size);
    return g_utf8_validate(text, (gssize)size, NULL);
}

uint64_t studio_document_revision(const StudioDocument *document) {
    return document->revision;
}

FrDigest studio_document_digest(const StudioDocument *document) {
    size_t size;
    const char *text = studio_history_text(document->history, &size);
    return fr_digest(0, text, size);
}

// ---- changing it -------------------------------------------------------------------------------

static bool after_change(StudioDocument *document, bool is_changed) {
    if (is_changed) {
        follow_text(document);
        notify(document);
    }
    return is_changed;
}

bool studio_document_replace(StudioDocument *document, const char *text, size_t size,
                             const char *name, const char *key) {
    return !document->is_abandoned &&
           after_change(document, studio_history_replace(document->history, text, size, name, key));
}

static void drop_splices(GArray *splices) {
    for (guint i = 0; i < splices->len; i++) {
        g_free(g_array_index(splices, FrSplice, i).text);
    }
    g_array_set_size(splices, 0);
}

bool studio_document_splice(StudioDocument *document, GArray *splices, const char *name,
                            const char *key) {
    if (document->is_broken || document->contents == NULL) {
        drop_splices(splices);
        return false;
    }
    size_t size;
    char *text = fr_contents_apply(document->contents, splices, &size);
    bool is_changed = studio_document_replace(document, text, size, name, key);
    g_free(text);
    return is_changed;
}

bool studio_document_splice_one(StudioDocument *document, FrSplice splice, const char *name,
                                const char *key) {
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    g_array_append_val(splices, splice);
    bool is_changed = studio_document_splice(document, splices, name, key);
    g_array_unref(splices);
    return is_changed;
}

void studio_document_seal(StudioDocument *document) {
    studio_history_seal(document->history);
}

void studio_document_hold(StudioDocument *document) {
    fr_source_unref(document->held);
    document->held = fr_source_ref(document->source);
    document->held_steps = studio_history_count(document->history);
    document->is_abandoned = false;
}

bool studio_document_abandon(StudioDocument *document) {
    if (document->held == NULL) {
        return false;
    }
    size_t size;
    const char *text = fr_source_text(document->held, &size);
    FrDigest now = studio_document_digest(document);
    studio_history_return(document->history, document->held_steps, text, size);
    document->is_abandoned = true;
    after_change(document, studio_document_digest(document) != now);
    return true;
}

void studio_document_release(StudioDocument *document) {
    bool was_abandoned = document->is_abandoned;
    g_clear_pointer(&document->held, fr_source_unref);
    document->is_abandoned = false;
    if (was_abandoned) {
        notify(document);
    }
}

bool studio_document_is_abandoned(const StudioDocument *document) {
    return document->is_abandoned;
}

bool studio_document_undo(StudioDocument *document) {
    return after_change(document, studio_history_undo(document->history));
}

bool studio_document_redo(StudioDocument *document) {
    return after_change(document, studio_history_redo(document->history));
}

const char *studio_document_undo_name(const StudioDocument *document) {
    return studio_history_undo_name(document->history);
}

const char *studio_document_redo_name(const StudioDocument *document) {
    return studio_history_redo_name(document->history);
}

uint32_t studio_document_steps(const StudioDocument *document) {
    return studio_history_count(document->history);
}

// ---- keeping it --------------------------------------------------------------------------------

bool studio_document_is_saved(const StudioDocument *document) {
    return !document->is_recovered && studio_history_is_saved(document->history);
}

void studio_document_mark_unsaved(StudioDocument *document) {
    document->is_recovered = true;
    notify(document);
}

// Whether the file is another than the one that was read or saved; one that has gone is not.
static bool is_changed_elsewhere(const StudioDocument *document) {
    char *text = NULL;
    gsize size = 0;
    bool is_other = document->knows_disk &&
                    g_file_get_contents(document->path, &text, &size, NULL) &&
                    fr_digest(0, text, size) != document->on_disk;
    g_free(text);
    return is_other;
}

// The pictures and meshes that a document names go with it into another folder: adds to `made` what
// is made there. Returns the name of one that stays behind, to be freed with g_free(), or NULL.
static char *take_files_along(const StudioDocument *document, const char *path, GPtrArray *made) {
    char *own = g_canonicalize_filename(path, NULL), *to = g_path_get_dirname(own);
    char *from = g_canonicalize_filename(document->folder, NULL);
    char *left = document->contents == NULL || strcmp(from, to) == 0
                     ? NULL
                     : studio_carry_along(document->contents, from, to, made);
    g_free(from);
    g_free(to);
    g_free(own);
    return left;
}

FrStatus studio_document_save(StudioDocument *document, const char *path, FrDiags *diags) {
    const char *to = path == NULL ? document->path : path;
    FR_ASSERT(to != NULL);
    size_t size;
    const char *text = studio_history_text(document->history, &size);
    if (path == NULL && is_changed_elsewhere(document)) {
        fr_diags_add(diags, FR_ERROR, "changed-file", (FrSpan){0},
                     "%s was changed elsewhere since it was opened: open it again, or save this as "
                     "another file",
                     document->name);
        return FR_ERR_MACHINE;
    }
    bool is_moved = g_strcmp0(to, document->path) != 0;
    GPtrArray *made = g_ptr_array_new_with_free_func(g_free);
    char *left = is_moved ? take_files_along(document, to, made) : NULL;
    FrStatus status = fr_contents_save(text, size, to, diags);
    if (status != FR_OK) {
        studio_remove_made(made);
    } else if (left != NULL) {
        fr_diags_add(diags, FR_WARNING, "file-left", (FrSpan){0},
                     "its file %s could not be taken along", left);
    }
    g_ptr_array_unref(made);
    g_free(left);
    if (status == FR_OK) {
        if (is_moved) {
            adopt_path(document, to);
            follow_text(document); // the files it names may be others there
        }
        document->is_recovered = false;
        document->on_disk = fr_digest(0, text, size);
        document->knows_disk = true;
        studio_history_mark_saved(document->history);
        notify(document);
    }
    return status;
}
