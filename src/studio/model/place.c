#include "studio/model/place.h"

#include <string.h>

static char *step_of(const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    if (at->id != NULL) {
        return g_strdup_printf("%s:%s", at->name, at->id);
    }
    uint32_t number = 0;
    uint32_t first = at->parent == FR_NONE ? element : fr_contents_at(contents, at->parent)->first;
    for (uint32_t i = first; i != element; i = fr_contents_at(contents, i)->next) {
        number += strcmp(fr_contents_at(contents, i)->name, at->name) == 0;
    }
    return number == 0 ? g_strdup(at->name) : g_strdup_printf("%s#%u", at->name, number);
}

char *studio_place_of(const FrContents *contents, uint32_t element) {
    char *place = step_of(contents, element);
    for (uint32_t i = fr_contents_at(contents, element)->parent; i != FR_NONE;
         i = fr_contents_at(contents, i)->parent) {
        char *step = step_of(contents, i);
        char *longer = g_strconcat(step, "/", place, NULL);
        g_free(step);
        g_free(place);
        place = longer;
    }
    return place;
}

uint32_t *studio_place_numbers(const FrContents *contents) {
    uint32_t count = fr_contents_count(contents);
    uint32_t *numbers = g_new0(uint32_t, count);
    // The last one of a tag and parent → its index + 1.
    GHashTable *last = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    for (uint32_t i = 0; i < count; i++) {
        const FrContentsElement *at = fr_contents_at(contents, i);
        char *which = g_strdup_printf("%u/%s", at->parent, at->name);
        uint32_t before = GPOINTER_TO_UINT(g_hash_table_lookup(last, which));
        if (before != 0) {
            numbers[before - 1] = MAX(numbers[before - 1], 1);
            numbers[i] = numbers[before - 1] + 1;
        }
        g_hash_table_replace(last, which, GUINT_TO_POINTER(i + 1));
    }
    g_hash_table_unref(last);
    return numbers;
}

// The element of that step among siblings from one on, FR_NONE.
static uint32_t find_step(const FrContents *contents, uint32_t first, const char *step) {
    size_t length = strcspn(step, ":#");
    const char *id = step[length] == ':' ? step + length + 1 : NULL;
    guint64 number = step[length] == '#' ? g_ascii_strtoull(step + length + 1, NULL, 10) : 0;
    for (uint32_t i = first; i != FR_NONE; i = fr_contents_at(contents, i)->next) {
        const FrContentsElement *at = fr_contents_at(contents, i);
        if (strncmp(at->name, step, length) != 0 || at->name[length] != '\0') {
            continue;
        }
        bool is_it = id != NULL ? g_strcmp0(at->id, id) == 0 : number == 0 && at->id == NULL;
        if (is_it) {
            return i;
        }
        if (id == NULL && number-- == 0) { // that one has an id now
            return FR_NONE;
        }
    }
    return FR_NONE;
}

uint32_t studio_place_find(const FrContents *contents, const char *place) {
    if (contents == NULL || place == NULL) {
        return FR_NONE;
    }
    char **steps = g_strsplit(place, "/", -1);
    uint32_t found = FR_NONE, among = 0;
    for (char **step = steps; *step != NULL; step++) {
        found = find_step(contents, among, *step);
        if (found == FR_NONE) {
            break;
        }
        among = fr_contents_at(contents, found)->first;
    }
    g_strfreev(steps);
    return found;
}

uint32_t studio_place_plant(const FrContents *contents, uint32_t element) {
    while (element != FR_NONE && strcmp(fr_contents_at(contents, element)->name, "plant") != 0) {
        element = fr_contents_at(contents, element)->parent;
    }
    return element;
}
