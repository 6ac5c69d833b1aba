/// frond presets and frond new: the species that come with the program, and presets of the user's
/// own.
#include "cli/cli.h"

#include <errno.h>
#include <fcntl.h>
#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { FOLDERS_UP = 4 };

/// What `frond new` begins with where no species is named.
static const char usual[] = "plant";

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

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/// The folder of presets that the user has kept in the studio.
static char *own_presets(void) {
    return g_build_filename(g_get_user_data_dir(), "frond", "presets", NULL);
}

/// The names of the presets in a folder, sorted; none if it is not there.
static GPtrArray *list_presets(const char *folder) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    GDir *directory = g_dir_open(folder, 0, NULL);
    const char *name;
    while (directory != NULL && (name = g_dir_read_name(directory)) != NULL) {
        if (g_str_has_suffix(name, ".frond")) {
            g_ptr_array_add(names, g_strndup(name, strlen(name) - strlen(".frond")));
        }
    }
    if (directory != NULL) {
        g_dir_close(directory);
    }
    g_ptr_array_sort(names, compare_names);
    return names;
}

static char *preset_path(const char *folder, const char *name) {
    char *file = g_strconcat(name, ".frond", NULL);
    char *path = g_build_filename(folder, file, NULL);
    g_free(file);
    return path;
}

static char *title_of(CliSession *session, const char *folder, const char *name) {
    char *path = preset_path(folder, name);
    FrDocument *document;
    FrStatus status = fr_document_load(path, &session->context, &document);
    char *title = document == NULL || status != FR_OK ? NULL : fr_document_title(document);
    fr_document_free(document);
    g_free(path);
    return title == NULL ? g_strdup("") : title;
}

/// Tells of the presets in a folder: in a list, or line by line if `list` is NULL.
static void tell_presets(CliSession *session, const char *folder, bool is_own, json_t *list) {
    GPtrArray *names = list_presets(folder);
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        char *title = is_own ? g_strdup("your own") : title_of(session, folder, name);
        if (list != NULL) {
            json_array_append_new(list, json_pack("{s:s, s:s, s:b}", "name", name, "title",
                                                  is_own ? "" : title, "own", is_own));
        } else {
            printf("%-16s %s\n", name, title);
        }
        g_free(title);
    }
    g_ptr_array_unref(names);
}

FrStatus cli_presets(CliSession *session) {
    char *folder = find_presets();
    if (folder == NULL) {
        return FR_ERR_MACHINE;
    }
    json_t *list = session->options->is_json ? json_array() : NULL;
    char *own = own_presets();
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
    char *from = preset_path(folder, preset);
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
        GPtrArray *names = list_presets(folders[i]);
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
    char *shipped = find_presets(), *own = own_presets();
    FrStatus status = shipped == NULL ? FR_ERR_MACHINE : FR_ERR_USAGE;
    const char *preset = options->preset == NULL ? usual : options->preset;
    const char *folder = shipped == NULL ? NULL : folder_of(preset, shipped, own);
    char *path = folder == NULL ? NULL : new_path(g_ptr_array_index(options->files, 0));
    if (path != NULL) {
        status = copy_preset(folder, preset, path);
        if (status == FR_OK && !options->is_quiet) {
            printf("%s\n", path);
        }
    }
    g_free(path);
    g_free(own);
    g_free(shipped);
    return status;
}
