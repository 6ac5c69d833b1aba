#include "studio/model/companions.h"

#include <jansson.h>
#include <stdbool.h>
#include <string.h>

static void add(GPtrArray *names, const char *name) {
    if (*name != '\0' && !g_ptr_array_find_with_equal_func(names, name, g_str_equal, NULL)) {
        g_ptr_array_add(names, g_strdup(name));
    }
}

// ---- text of .obj and .mtl ---------------------------------------------------------------------

// `mtllib` has names, a map has options and a name at its end.
static void add_line(GPtrArray *names, const char *line) {
    char **words = g_strsplit_set(line, " \t\r", -1);
    guint count = 0;
    for (char **word = words; *word != NULL; word++) {
        if (**word == '\0') {
            g_free(*word);
        } else {
            words[count++] = *word;
        }
    }
    words[count] = NULL;
    bool is_library = count > 0 && strcmp(words[0], "mtllib") == 0;
    for (guint i = is_library ? 1 : MAX(count, 2) - 1; i < count; i++) {
        add(names, words[i]);
    }
    g_strfreev(words);
}

static bool is_telling(const char *line, gsize size) {
    static const char *const words[] = {"mtllib", "map_", "bump", "disp", "decal", "norm", "refl"};
    bool is_it = false;
    for (gsize i = 0; i < G_N_ELEMENTS(words) && !is_it; i++) {
        is_it = size > strlen(words[i]) && memcmp(line, words[i], strlen(words[i])) == 0;
    }
    return is_it;
}

static void add_lines(GPtrArray *names, const char *text, gsize size) {
    const char *end = text + size;
    for (const char *line = text; line < end;) {
        const char *stop = memchr(line, '\n', (gsize)(end - line));
        stop = stop == NULL ? end : stop;
        while (line < stop && (*line == ' ' || *line == '\t')) {
            line++;
        }
        if (is_telling(line, (gsize)(stop - line))) {
            char *own = g_strndup(line, (gsize)(stop - line));
            add_line(names, own);
            g_free(own);
        }
        line = stop + 1;
    }
}

// ---- .gltf -------------------------------------------------------------------------------------

static void add_uris(GPtrArray *names, const json_t *list) {
    for (size_t i = 0; i < json_array_size(list); i++) {
        const char *uri = json_string_value(json_object_get(json_array_get(list, i), "uri"));
        char *name =
            uri == NULL || g_str_has_prefix(uri, "data:") ? NULL : g_uri_unescape_string(uri, "/");
        if (name != NULL) {
            add(names, name);
        }
        g_free(name);
    }
}

void studio_add_companions(const char *name, GBytes *bytes, GPtrArray *names) {
    gsize size;
    const char *data = g_bytes_get_data(bytes, &size);
    char *lower = g_ascii_strdown(name, -1);
    if (g_str_has_suffix(lower, ".obj") || g_str_has_suffix(lower, ".mtl")) {
        add_lines(names, data, size);
    } else if (g_str_has_suffix(lower, ".gltf")) {
        json_t *root = json_loadb(data, size, 0, NULL);
        add_uris(names, json_object_get(root, "buffers"));
        add_uris(names, json_object_get(root, "images"));
        json_decref(root);
    }
    g_free(lower);
}
