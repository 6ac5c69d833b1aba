#include "studio/files.h"

#include <string.h>

enum { FOLDERS_UP = 4 };

static char *existing(char *path) {
    if (path != NULL && !g_file_test(path, G_FILE_TEST_EXISTS)) {
        g_free(path);
        return NULL;
    }
    return path;
}

// `folder`/`name` beside the program or beside a folder around it.
static char *near_program(const char *folder_name, const char *name) {
    char *program = g_file_read_link("/proc/self/exe", NULL);
    char *folder = program == NULL ? NULL : g_path_get_dirname(program);
    char *found = NULL;
    for (int i = 0; folder != NULL && i < FOLDERS_UP && found == NULL; i++) {
        found = existing(g_build_filename(folder, folder_name, name, NULL));
        char *outer = g_path_get_dirname(folder);
        g_free(folder);
        folder = outer;
    }
    g_free(folder);
    g_free(program);
    return found;
}

char *studio_data_file(const char *name) {
    const char *own = g_getenv("FROND_DATA");
    if (own != NULL) {
        return existing(g_build_filename(own, name, NULL));
    }
    char *found = near_program("data", name);
    return found != NULL ? found : existing(g_build_filename(FROND_DATADIR, name, NULL));
}

char *studio_manual_page(const char *name) {
    char *found = near_program("docs", name);
    return found != NULL ? found : existing(g_build_filename(FROND_DOCDIR, name, NULL));
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

GPtrArray *studio_preset_names(void) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    char *folder = studio_data_file("presets");
    GDir *directory = folder == NULL ? NULL : g_dir_open(folder, 0, NULL);
    const char *name;
    while (directory != NULL && (name = g_dir_read_name(directory)) != NULL) {
        if (g_str_has_suffix(name, ".frond")) {
            g_ptr_array_add(names, g_strndup(name, strlen(name) - strlen(".frond")));
        }
    }
    g_clear_pointer(&directory, g_dir_close);
    g_ptr_array_sort(names, compare_names);
    g_free(folder);
    return names;
}

char *studio_preset_file(const char *name, const char *ending) {
    char *relative = g_strconcat("presets/", name, ending, NULL);
    char *file = studio_data_file(relative);
    g_free(relative);
    return file;
}

char *studio_preset_title(const char *name) {
    char *title = g_strdelimit(g_strdup(name), "-", ' ');
    title[0] = g_ascii_toupper(title[0]);
    return title;
}
