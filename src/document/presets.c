#include "frond/presets.h"

#include <string.h>

static const char document_ending[] = ".frond";

char *fr_presets_folder(void) {
    return g_build_filename(g_get_user_data_dir(), "frond", "presets", NULL);
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

GPtrArray *fr_presets_list(const char *folder) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    GDir *directory = folder == NULL ? NULL : g_dir_open(folder, 0, NULL);
    const char *name;
    while (directory != NULL && (name = g_dir_read_name(directory)) != NULL) {
        if (g_str_has_suffix(name, document_ending)) {
            g_ptr_array_add(names, g_strndup(name, strlen(name) - strlen(document_ending)));
        }
    }
    g_clear_pointer(&directory, g_dir_close);
    g_ptr_array_sort(names, compare_names);
    return names;
}

char *fr_presets_file(const char *folder, const char *name, const char *ending) {
    return g_strdup_printf("%s/%s%s", folder, name, ending);
}
