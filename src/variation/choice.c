// Branches by name: components, their n-th axis, paths.
#include "variation/vary.h"

#include <string.h>

#define BLANKS " \t\r\n"

uint64_t fr_choice_words(const char *choice) {
    uint64_t words = 0;
    for (const char *at = choice + strspn(choice, BLANKS); *at != '\0'; words++) {
        at += strcspn(at, BLANKS);
        at += strspn(at, BLANKS);
    }
    return words == 0 ? 1 : words;
}

static bool mark_path(const char *word, const FrPlant *plant, uint8_t *marks) {
    guint64 path;
    bool is_found = false;
    if (g_ascii_string_to_unsigned(word, 16, 0, G_MAXUINT64, &path, NULL)) {
        for (uint32_t a = 0; a < plant->axes.count; a++) {
            if (plant->axes.path[a] == path) {
                marks[a] = 1;
                is_found = true;
            }
        }
    }
    return is_found;
}

/// `ordinal` counts from 1; 0 is all.
static bool mark_component(const char *id, uint64_t ordinal, const FrPlant *plant, uint8_t *marks) {
    uint32_t component = 0;
    while (component < plant->components->len &&
           strcmp(g_array_index(plant->components, FrComponent, component).id, id) != 0) {
        component++;
    }
    uint64_t met = 0;
    bool is_found = false;
    for (uint32_t a = 0; a < plant->axes.count && component < plant->components->len; a++) {
        if (plant->axes.component[a] == component) {
            met++;
            if (ordinal == 0 || met == ordinal) {
                marks[a] = 1;
                is_found = true;
            }
        }
    }
    return is_found;
}

static bool mark_word(char *word, const FrPlant *plant, uint8_t *marks) {
    if (word[0] == '#') {
        return mark_path(word + 1, plant, marks);
    }
    guint64 ordinal = 0;
    char *colon = strrchr(word, ':');
    if (colon != NULL) {
        *colon = '\0';
        if (!g_ascii_string_to_unsigned(colon + 1, 10, 1, G_MAXUINT64, &ordinal, NULL)) {
            return false;
        }
    }
    return mark_component(word, ordinal, plant, marks);
}

static void report(const char *word, const FrPlant *plant, FrSpan span, FrDiags *diags) {
    guint count = plant->components->len;
    const char **names = g_new(const char *, count + 1);
    for (guint i = 0; i < count; i++) {
        names[i] = g_array_index(plant->components, FrComponent, i).id;
    }
    const char *near = fr_nearest_name(word, names, count);
    bool is_other = near != NULL && strcmp(near, word) != 0;
    fr_diags_add(diags, FR_ERROR, "unknown-branch", span,
                 "no branch of this plant is '%.64s'%s%s%s", word,
                 is_other ? "; did you mean '" : "", is_other ? near : "", is_other ? "'?" : "");
    g_free(names);
}

FrStatus fr_choice_mark(const char *choice, const FrPlant *plant, FrSpan span, FrDiags *diags,
                        uint8_t *marks) {
    const char *at = choice + strspn(choice, BLANKS);
    if (*at == '\0') {
        memset(marks, 1, plant->axes.count);
        return FR_OK;
    }
    FrStatus status = FR_OK;
    while (*at != '\0') {
        size_t length = strcspn(at, BLANKS);
        char *word = g_strndup(at, length);
        if (!mark_word(word, plant, marks)) {
            char *whole = g_strndup(at, length);
            report(whole, plant, span, diags);
            g_free(whole);
            status = FR_ERR_DOCUMENT;
        }
        g_free(word);
        at += length + strspn(at + length, BLANKS);
    }
    return status;
}

void fr_apply_spread(const FrPlant *plant, FrApply apply, uint8_t *marks) {
    if (apply == FR_APPLY_SELECTED) {
        return;
    }
    // Bit 0: chosen; bit 1: borne by one that is, or by one with bit 1. Bearers come first.
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        uint32_t bearer = plant->axes.bearer[a];
        if (bearer != FR_NONE && marks[plant->nodes.axis[bearer]] != 0) {
            marks[a] |= 2;
        }
    }
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        marks[a] = apply == FR_APPLY_BOTH ? marks[a] != 0 : marks[a] >> 1;
    }
}
