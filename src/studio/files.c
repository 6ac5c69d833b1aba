#include "studio/files.h"

#include "frond/presets.h"

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

GPtrArray *studio_shipped_presets(void) {
    char *folder = studio_data_file("presets");
    GPtrArray *names = fr_presets_list(folder);
    g_free(folder);
    return names;
}

GPtrArray *studio_own_presets(void) {
    char *folder = fr_presets_folder();
    GPtrArray *names = fr_presets_list(folder);
    g_free(folder);
    return names;
}

GPtrArray *studio_preset_names(void) {
    GPtrArray *names = studio_own_presets(), *shipped = studio_shipped_presets();
    for (guint i = 0; i < shipped->len; i++) {
        const char *name = g_ptr_array_index(shipped, i);
        if (!g_ptr_array_find_with_equal_func(names, name, g_str_equal, NULL)) {
            g_ptr_array_add(names, g_strdup(name));
        }
    }
    g_ptr_array_unref(shipped);
    return names;
}

char *studio_preset_file(const char *name, const char *ending) {
    char *folder = fr_presets_folder();
    char *document = existing(fr_presets_file(folder, name, ".frond")), *file;
    if (document != NULL) {
        file = existing(fr_presets_file(folder, name, ending));
    } else {
        char *relative = g_strconcat("presets/", name, ending, NULL);
        file = studio_data_file(relative);
        g_free(relative);
    }
    g_free(document);
    g_free(folder);
    return file;
}

char *studio_preset_title(const char *name) {
    char *title = g_strdelimit(g_strdup(name), "-", ' ');
    title[0] = g_ascii_toupper(title[0]);
    return title;
}
