// Runs a fuzz harness on the files of a folder, one TAP test each, so that every input that once
// did harm is tried again by every ordinary test run, with any compiler.
#include "fuzz.h"

#include <glib.h>
#include <stdio.h>

static int compare_names(const void *a, const void *b) {
    return g_strcmp0(*(char *const *)a, *(char *const *)b);
}

static GPtrArray *sorted_names(const char *folder) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    GDir *dir = g_dir_open(folder, 0, NULL);
    for (const char *name; dir != NULL && (name = g_dir_read_name(dir)) != NULL;) {
        g_ptr_array_add(names, g_strdup(name));
    }
    if (dir != NULL) {
        g_dir_close(dir);
    }
    g_ptr_array_sort(names, compare_names);
    return names;
}

static bool replay(const char *folder, const char *name) {
    char *path = g_build_filename(folder, name, NULL);
    char *data = NULL;
    gsize size = 0;
    bool is_read = g_file_get_contents(path, &data, &size, NULL);
    if (is_read) {
        // A copy of the exact size, so that the address sanitizer sees a byte too far.
        uint8_t *exact = g_memdup2(data, size);
        LLVMFuzzerTestOneInput(exact, size);
        g_free(exact);
    }
    g_free(data);
    g_free(path);
    return is_read;
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s CORPUS-FOLDER\n", argv[0]);
        return 2;
    }
    char *corpus = g_path_get_basename(argv[1]);
    GPtrArray *names = sorted_names(argv[1]);
    printf("1..%u\n", names->len);
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        fprintf(stderr, "replaying %s\n", name); // says which, should it end the program
        printf("%s %u /fuzz/%s/%s\n", replay(argv[1], name) ? "ok" : "not ok", i + 1, corpus, name);
        fflush(stdout);
    }
    int status = names->len > 0 ? 0 : 1;
    g_ptr_array_unref(names);
    g_free(corpus);
    return status;
}
