// Paths in the i-tree as text: trunk/branch[3]/twig[2]. A number in brackets is the iteration of
// what is multiplied; behind ~ stands at each fork of the stem which arm: trunk~01/branch[3].
#include "pgraph/edit.h"

#include "pgraph/global.h"

#include <string.h>

enum { MOST_FORKS = 8 };

static bool read_number(const char **text, uint32_t *number) {
    guint64 value = 0;
    const char *begin = *text;
    while (g_ascii_isdigit(**text) && value <= UINT32_MAX) {
        value = 10 * value + (guint64)g_ascii_digit_value(*(*text)++);
    }
    *number = (uint32_t)value;
    return *text > begin && value < UINT32_MAX;
}

static bool read_step(const char **text, FrPathStep *step) {
    *step = (FrPathStep){0};
    size_t size = strcspn(*text, "[]~/");
    if (size == 0 || size >= sizeof step->id) {
        return false;
    }
    memcpy(step->id, *text, size);
    *text += size;
    if (**text == '[') {
        (*text)++;
        step->is_multiplied = true;
        if (!read_number(text, &step->iteration) || *(*text)++ != ']') {
            return false;
        }
    }
    if (**text == '~') {
        (*text)++;
        uint32_t fork = 0;
        for (; **text >= '0' && **text <= '3' && fork < MOST_FORKS; fork++) {
            step->arms |= (uint16_t)((uint32_t)(*(*text)++ - '0') << 2 * fork);
        }
        if (fork == 0) {
            return false;
        }
    }
    return **text == '/' || **text == '\0';
}

bool fr_edit_path_read(const char *text, GArray *steps) {
    while (text != NULL) {
        FrPathStep step;
        if (!read_step(&text, &step)) {
            return false;
        }
        if (steps != NULL) {
            g_array_append_val(steps, step);
        }
        if (*text == '\0') {
            return true;
        }
        text++;
    }
    return false;
}

// ---- from the i-tree ---------------------------------------------------------------------------

static void append_arms(GString *path, uint32_t arms) {
    if (arms != 0) {
        g_string_append_c(path, '~');
        for (; arms != 0; arms >>= 2) {
            g_string_append_c(path, (char)('0' + (arms & 3)));
        }
    }
}

char *fr_pgraph_path(const FrPgraph *graph, const FrPgraphCounts *counts, uint32_t instance) {
    GArray *way = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint32_t at = instance; at != FR_NONE; at = counts->parent[at]) {
        g_array_append_val(way, at);
    }
    GString *path = g_string_new(NULL);
    uint64_t place = 0; // of the first of some that are no part of paths
    bool has_place = false;
    for (guint k = way->len; k-- > 0;) {
        uint32_t at = g_array_index(way, uint32_t, k);
        uint32_t component = counts->component[at];
        FrComponentKind kind = fr_pgraph_kind(graph, component);
        place = has_place ? place : counts->place[at];
        has_place = fr_is_global(kind);
        if (has_place || kind == FR_COMPONENT_CAMERA) {
            continue;
        }
        if (path->len > 0) {
            append_arms(path, (uint32_t)(place >> 1) & 0xffff);
            g_string_append_c(path, '/');
        }
        g_string_append(path, fr_pgraph_id(graph, component));
        if ((place & 1) != 0) {
            g_string_append_printf(path, "[%u]", (uint32_t)(place >> 32));
        }
    }
    g_array_unref(way);
    return g_string_free(path, FALSE);
}
