/// frond presets and frond new: the species that come with the program.
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

/// The names of the presets in a folder, sorted.
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

FrStatus cli_presets(CliSession *session) {
    char *folder = find_presets();
    if (folder == NULL) {
        return FR_ERR_MACHINE;
    }
    GPtrArray *names = list_presets(folder);
    json_t *list = json_array();
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        char *title = title_of(session, folder, name);
        if (session->options->is_json) {
            json_array_append_new(list, json_pack("{s:s, s:s}", "name", name, "title", title));
        } else {
            printf("%-16s %s\n", name, title);
        }
        g_free(title);
    }
    if (session->options->is_json) {
        json_dumpf(list, stdout, JSON_INDENT(2));
        printf("\n");
    }
    json_decref(list);
    g_ptr_array_unref(names);
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

FrStatus cli_new(CliSession *session) {
    const CliOptions *options = session->options;
    char *folder = find_presets();
    if (folder == NULL) {
        return FR_ERR_MACHINE;
    }
    GPtrArray *names = list_presets(folder);
    FrStatus status = FR_ERR_USAGE;
    const char *preset = options->preset == NULL ? usual : options->preset;
    if (!g_ptr_array_find_with_equal_func(names, preset, g_str_equal, NULL)) {
        char *hint = cli_hint(preset, (const char *const *)names->pdata, names->len);
        cli_message("there is no preset '%s'%s", preset,
                    *hint == '\0' ? "; frond presets lists them" : hint);
        g_free(hint);
    } else {
        char *path = new_path(g_ptr_array_index(options->files, 0));
        status = path == NULL ? FR_ERR_USAGE : copy_preset(folder, preset, path);
        if (status == FR_OK && !options->is_quiet) {
            printf("%s\n", path);
        }
        g_free(path);
    }
    g_ptr_array_unref(names);
    g_free(folder);
    return status;
}
