#include "studio/model/history.h"

#include <string.h>

// Bytes that were at `begin`, and those that took their place.
typedef struct Step {
    size_t begin;
    GBytes *old, *new;
    char *name, *key;
} Step;

struct StudioHistory {
    GString *text;
    GPtrArray *steps; // Step *
    guint done;       // steps that have been done; the others can be redone
    guint saved;      // how many were done when it was saved; G_MAXUINT: never to be reached again
    bool is_sealed;
};

static void step_free(gpointer data) {
    Step *step = data;
    g_bytes_unref(step->old);
    g_bytes_unref(step->new);
    g_free(step->name);
    g_free(step->key);
    g_free(step);
}

StudioHistory *studio_history_new(const char *text, size_t size) {
    StudioHistory *history = g_new0(StudioHistory, 1);
    history->text = g_string_new_len(text, (gssize)size);
    history->steps = g_ptr_array_new_with_free_func(step_free);
    return history;
}

void studio_history_free(StudioHistory *history) {
    if (history != NULL) {
        g_string_free(history->text, TRUE);
        g_ptr_array_unref(history->steps);
        g_free(history);
    }
}

const char *studio_history_text(const StudioHistory *history, size_t *size) {
    if (size != NULL) {
        *size = history->text->len;
    }
    return history->text->str;
}

static Step *last_step(const StudioHistory *history) {
    return history->done == 0 ? NULL : g_ptr_array_index(history->steps, history->done - 1);
}

static void put(StudioHistory *history, size_t begin, GBytes *out, GBytes *in) {
    gsize size;
    const char *bytes = g_bytes_get_data(in, &size);
    g_string_erase(history->text, (gssize)begin, (gssize)g_bytes_get_size(out));
    g_string_insert_len(history->text, (gssize)begin, bytes, (gssize)size);
}

// What differs between the text and a new one.
static Step *difference(const GString *from, const char *to, size_t size) {
    size_t shorter = MIN(from->len, size), begin = 0, end = 0;
    while (begin < shorter && from->str[begin] == to[begin]) {
        begin++;
    }
    while (end < shorter - begin && from->str[from->len - 1 - end] == to[size - 1 - end]) {
        end++;
    }
    Step *step = g_new0(Step, 1);
    step->begin = begin;
    step->old = g_bytes_new(from->str + begin, from->len - begin - end);
    step->new = g_bytes_new(to + begin, size - begin - end);
    return step;
}

static void forget_redo(StudioHistory *history) {
    if (history->saved > history->done) {
        history->saved = G_MAXUINT;
    }
    g_ptr_array_set_size(history->steps, (gint)history->done);
}

bool studio_history_replace(StudioHistory *history, const char *text, size_t size, const char *name,
                            const char *key) {
    if (size == history->text->len && memcmp(text, history->text->str, size) == 0) {
        return false;
    }
    const Step *last = last_step(history);
    bool is_continued = !history->is_sealed && key != NULL && last != NULL &&
                        g_strcmp0(key, last->key) == 0 && history->saved != history->done;
    forget_redo(history);
    if (is_continued) {
        studio_history_undo(history);
        forget_redo(history);
    }
    Step *step = difference(history->text, text, size);
    if (g_bytes_get_size(step->old) == 0 && g_bytes_get_size(step->new) == 0) {
        step_free(step); // a drag has come back to where it began
        return true;
    }
    step->name = g_strdup(name);
    step->key = g_strdup(key);
    put(history, step->begin, step->old, step->new);
    g_ptr_array_add(history->steps, step);
    history->done++;
    history->is_sealed = false;
    return true;
}

void studio_history_seal(StudioHistory *history) {
    history->is_sealed = true;
}

bool studio_history_undo(StudioHistory *history) {
    const Step *step = last_step(history);
    if (step != NULL) {
        put(history, step->begin, step->new, step->old);
        history->done--;
        history->is_sealed = true;
    }
    return step != NULL;
}

bool studio_history_redo(StudioHistory *history) {
    if (history->done == history->steps->len) {
        return false;
    }
    const Step *step = g_ptr_array_index(history->steps, history->done);
    put(history, step->begin, step->old, step->new);
    history->done++;
    history->is_sealed = true;
    return true;
}

void studio_history_return(StudioHistory *history, uint32_t count, const char *text, size_t size) {
    bool is_far = history->done != count || size != history->text->len ||
                  memcmp(text, history->text->str, size) != 0;
    while (history->done > count) {
        studio_history_undo(history);
    }
    if (is_far) {
        forget_redo(history);
        const Step *step = last_step(history);
        bool can_go_on = step != NULL && history->saved != history->done;
        history->is_sealed = !can_go_on;
        char *name = g_strdup(step == NULL ? NULL : step->name);
        char *key = g_strdup(can_go_on ? step->key : NULL);
        studio_history_replace(history, text, size, name, key);
        g_free(name);
        g_free(key);
    }
    history->is_sealed = true;
}

const char *studio_history_undo_name(const StudioHistory *history) {
    const Step *step = last_step(history);
    return step == NULL ? NULL : step->name;
}

const char *studio_history_redo_name(const StudioHistory *history) {
    return history->done == history->steps->len
               ? NULL
               : ((const Step *)g_ptr_array_index(history->steps, history->done))->name;
}

void studio_history_mark_saved(StudioHistory *history) {
    history->saved = history->done;
    history->is_sealed = true;
}

bool studio_history_is_saved(const StudioHistory *history) {
    return history->saved == history->done;
}

uint32_t studio_history_count(const StudioHistory *history) {
    return history->done;
}
