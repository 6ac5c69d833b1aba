/// frond presets and frond new: the species that come with the program, and presets of the user's
/// own.
#include "cli/cli.h"
#include "frond/presets.h"

#include <errno.h>
#include <fcntl.h>
#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { FOLDERS_UP = 4 };

/// What `frond new` begins with where no species is named.
static const char usual[] = "plant";

static const char document_ending[] = ".frond";

/// `folder`/presets if it is there, else NULL.
static char *presets_in(const char *folder) {
    char *presets = g_build_filename(folder, "presets", NULL);
    if (g_file_test(presets, G_FILE_TEST_IS_DIR)) {
        return presets;
    }
    g_free(presets);
    return NULL;
}

/// In data/ beside the program or beside a folder around it: a program run where it was built.
static char *presets_near_program(void) {
    char *program = g_file_read_link("/proc/self/exe", NULL);
    if (program == NULL) {
        return NULL;
    }
    char *presets = NULL;
    char *folder = g_path_get_dirname(program);
    for (int i = 0; i < FOLDERS_UP && presets == NULL; i++) {
        char *data = g_build_filename(folder, "data", NULL);
        presets = presets_in(data);
        g_free(data);
        char *outer = g_path_get_dirname(folder);
        g_free(folder);
        folder = outer;
    }
    g_free(folder);
    g_free(program);
    return presets;
}

/// The folder of presets: of $FROND_DATA, as installed, or near the program. NULL if there is none.
static char *find_presets(void) {
    const char *own = g_getenv("FROND_DATA");
    char *presets = own == NULL ? NULL : presets_in(own);
    if (presets == NULL && own == NULL) {
        presets = presets_in(FROND_DATADIR);
    }
    if (presets == NULL && own == NULL) {
        presets = presets_near_program();
    }
    if (presets == NULL) {
        cli_message("no presets in %s; the folder data/ may be named in FROND_DATA",
                    own == NULL ? FROND_DATADIR : own);
    }
    return presets;
}

/// Reads a preset; what is wrong with it is told with its place.
static FrStatus read_preset(CliSession *session, const char *folder, const char *name,
                            FrDocument **document) {
    char *path = fr_presets_file(folder, name, document_ending);
    FrStatus status = fr_document_load(path, &session->context, document);
    g_free(path);
    return status;
}

/// Tells of the presets in a folder: in a list, or line by line if `list` is NULL.
static void tell_presets(CliSession *session, const char *folder, bool is_own, json_t *list) {
    GPtrArray *names = fr_presets_list(folder);
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        FrDocument *document;
        bool is_right = read_preset(session, folder, name, &document) == FR_OK;
        char *title = is_right && !is_own ? fr_document_title(document) : NULL;
        const char *shown = title != NULL ? title
                            : !is_right   ? "not right: it cannot be used"
                            : is_own      ? "your own"
                                          : "";
        if (list != NULL) {
            json_array_append_new(list, json_pack("{s:s, s:s, s:b, s:b}", "name", name, "title",
                                                  title == NULL ? "" : title, "own", is_own,
                                                  "broken", !is_right));
        } else {
            printf("%-16s %s\n", name, shown);
        }
        g_free(title);
        fr_document_free(document);
    }
    g_ptr_array_unref(names);
}

FrStatus cli_presets(CliSession *session) {
    char *folder = find_presets();
    if (folder == NULL) {
        return FR_ERR_MACHINE;
    }
    json_t *list = session->options->is_json ? json_array() : NULL;
    char *own = fr_presets_folder();
    tell_presets(session, folder, false, list);
    tell_presets(session, own, true, list);
    if (list != NULL) {
        json_dumpf(list, stdout, JSON_INDENT(2));
        printf("\n");
    }
    json_decref(list);
    g_free(own);
    g_free(folder);
    return FR_OK;
}

/// Writes a file that was not there before; false with errno set.
static bool write_new_file(const char *path, const char *text, gsize size) {
    int file = g_open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) {
        return false;
    }
    bool is_whole = write(file, text, size) == (gssize)size;
    is_whole = close(file) == 0 && is_whole;
    if (!is_whole) {
        int reason = errno;
        g_unlink(path);
        errno = reason;
    }
    return is_whole;
}

static FrStatus copy_preset(const char *folder, const char *preset, const char *path) {
    char *from = fr_presets_file(folder, preset, document_ending);
    char *text = NULL;
    gsize size;
    GError *error = NULL;
    FrStatus status = FR_ERR_MACHINE;
    if (!g_file_get_contents(from, &text, &size, &error)) {
        cli_message("%s", error->message);
        g_error_free(error);
    } else if (!write_new_file(path, text, size)) {
        cli_message(errno == EEXIST ? "'%s' is there already and is not overwritten: %s"
                                    : "cannot write '%s': %s",
                    path, g_strerror(errno));
    } else {
        status = FR_OK;
    }
    g_free(text);
    g_free(from);
    return status;
}

/// Whether a document can begin with a preset; what is wrong with it is told with its place.
static FrStatus check_preset(CliSession *session, const char *folder, const char *preset) {
    FrDocument *document;
    FrScene *scene = NULL;
    FrStatus status = read_preset(session, folder, preset, &document);
    if (status == FR_OK && fr_document_plants(document)->len > 0) {
        status = fr_scene_check(document, -1, &session->context, &scene);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    if (status != FR_OK) {
        cli_session_flush(session);
        cli_message("the preset '%s' is not right: no document is begun with it", preset);
    }
    return status;
}

/// NAME.frond of a name without a folder's end; NULL after a message. Free with g_free().
static char *new_path(const char *name) {
    bool is_name = *name != '\0' && !g_str_has_suffix(name, "/");
    if (!is_name) {
        cli_message("'%s' is no name for a document", name);
        return NULL;
    }
    return g_str_has_suffix(name, ".frond") ? g_strdup(name) : g_strconcat(name, ".frond", NULL);
}

/// The folder, of two, that has a preset; NULL after a message.
static const char *folder_of(const char *preset, const char *shipped, const char *own) {
    const char *const folders[] = {own, shipped};
    GPtrArray *all = g_ptr_array_new_with_free_func(g_free);
    const char *found = NULL;
    for (int i = 0; i < 2; i++) {
        GPtrArray *names = fr_presets_list(folders[i]);
        if (found == NULL && g_ptr_array_find_with_equal_func(names, preset, g_str_equal, NULL)) {
            found = folders[i];
        }
        g_ptr_array_extend_and_steal(all, names);
    }
    if (found == NULL) {
        char *hint = cli_hint(preset, (const char *const *)all->pdata, all->len);
        cli_message("there is no preset '%s'%s", preset,
                    *hint == '\0' ? "; frond presets lists them" : hint);
        g_free(hint);
    }
    g_ptr_array_unref(all);
    return found;
}

FrStatus cli_new(CliSession *session) {
    const CliOptions *options = session->options;
    char *shipped = find_presets(), *own = fr_presets_folder();
    FrStatus status = shipped == NULL ? FR_ERR_MACHINE : FR_ERR_USAGE;
    const char *preset = options->preset == NULL ? usual : options->preset;
    const char *folder = shipped == NULL ? NULL : folder_of(preset, shipped, own);
    char *path = folder == NULL ? NULL : new_path(g_ptr_array_index(options->files, 0));
    if (path != NULL) {
        status = folder == own ? check_preset(session, folder, preset) : FR_OK;
        status = status == FR_OK ? copy_preset(folder, preset, path) : status;
        if (status == FR_OK && !options->is_quiet) {
            printf("%s\n", path);
        }
    }
    g_free(path);
    g_free(own);
    g_free(shipped);
    return status;
}
