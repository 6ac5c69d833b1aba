#include "studio/model/removal.h"

#include "studio/model/borrowed.h"

#include <string.h>

enum { MOST_NAMED = 3 };

// What an element is called, or what it is. Free with g_free().
static char *name_of(const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    return at->id != NULL ? g_strdup(at->id) : g_strdup_printf("the %s", at->name);
}

// "stem", "stem and leaf", "stem, leaf, petal and 3 more".
static char *list_of(const FrContents *contents, const GArray *elements) {
    GString *words = g_string_new(NULL);
    guint named = elements->len <= MOST_NAMED + 1 ? elements->len : MOST_NAMED;
    for (guint i = 0; i < named; i++) {
        char *name = name_of(contents, g_array_index(elements, uint32_t, i));
        bool is_last = i + 1 == elements->len;
        g_string_append_printf(words, "%s%s", i == 0 ? "" : is_last ? " and " : ", ", name);
        g_free(name);
    }
    if (named < elements->len) {
        g_string_append_printf(words, " and %u more", elements->len - named);
    }
    return g_string_free(words, FALSE);
}

static bool leads(const FrContents *contents, uint32_t link, const char *attribute,
                  const char *id) {
    char *value = fr_contents_get(contents, link, attribute);
    bool is_it = g_strcmp0(value, id) == 0;
    g_free(value);
    return is_it;
}

// Whether the only links to a component come from itself and from `from`, of which there is one.
static bool hangs_on(const FrContents *contents, uint32_t component, const char *from) {
    const char *id = fr_contents_at(contents, component)->id;
    uint32_t graph = fr_contents_at(contents, component)->parent;
    bool is_linked = false;
    for (uint32_t link = fr_contents_child(contents, graph, "link"); link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        if (leads(contents, link, "to", id)) {
            bool is_from = leads(contents, link, "from", from);
            if (!is_from && !leads(contents, link, "from", id)) {
                return false;
            }
            is_linked = is_linked || is_from;
        }
    }
    return is_linked;
}

// The components that nothing leads to without `element`.
static GArray *left_alone(const FrContents *contents, uint32_t element) {
    GArray *alone = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    const FrContentsElement *at = fr_contents_at(contents, element);
    if (at->component < 0 || at->id == NULL) {
        return alone;
    }
    for (uint32_t other = fr_contents_at(contents, at->parent)->first; other != FR_NONE;
         other = fr_contents_at(contents, other)->next) {
        const FrContentsElement *its = fr_contents_at(contents, other);
        if (other != element && its->component >= 0 && its->id != NULL &&
            hangs_on(contents, other, at->id)) {
            g_array_append_val(alone, other);
        }
    }
    return alone;
}

char *studio_removal_words(const StudioDocument *document, uint32_t element) {
    const FrContents *contents = studio_document_contents(document);
    GArray *users = studio_users_of(contents, element), *alone = left_alone(contents, element);
    char *name = name_of(contents, element), *words;
    if (users->len > 0) {
        char *list = list_of(contents, users);
        words = g_strdup_printf("Removed %s, which %s still %s", name, list,
                                users->len == 1 ? "uses" : "use");
        g_free(list);
    } else if (alone->len > 0) {
        char *list = list_of(contents, alone);
        words = g_strdup_printf("Removed %s; nothing leads to %s now", name, list);
        g_free(list);
    } else {
        words = g_strdup_printf("Removed %s", name);
    }
    g_free(name);
    g_array_unref(alone);
    g_array_unref(users);
    return words;
}
