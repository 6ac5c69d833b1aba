#include "studio/model/borrowed.h"

#include "studio/model/place.h"

#include <string.h>

static const char *const tags[] = {"curve", "function", "material", "plant", "slider"};

// ---- what it is --------------------------------------------------------------------------------

StudioTag studio_tag_of(const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    for (int tag = 0; tag < STUDIO_TAG_COMPONENT; tag++) {
        bool is_placed = tag == STUDIO_TAG_SLIDER || at->parent == 0;
        if (is_placed && strcmp(at->name, tags[tag]) == 0) {
            return (StudioTag)tag;
        }
    }
    return at->component >= 0 ? STUDIO_TAG_COMPONENT : STUDIO_TAG_COUNT;
}

bool studio_tag_is_top(StudioTag tag) {
    return tag <= STUDIO_TAG_PLANT;
}

uint32_t studio_tag_find(const FrContents *contents, uint32_t parent, StudioTag tag,
                         const char *id) {
    uint32_t element = fr_contents_at(contents, parent)->first;
    while (element != FR_NONE && (studio_tag_of(contents, element) != tag ||
                                  g_strcmp0(fr_contents_at(contents, element)->id, id) != 0)) {
        element = fr_contents_at(contents, element)->next;
    }
    return element;
}

static char *whole_text(const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    return g_strndup(fr_source_text(fr_contents_source(contents), NULL) + at->begin,
                     at->end - at->begin);
}

bool studio_is_same(const FrContents *mine, uint32_t own, const FrContents *theirs,
                    uint32_t element) {
    char *a = own == FR_NONE ? NULL : whole_text(mine, own), *b = whole_text(theirs, element);
    bool is_equal = g_strcmp0(a, b) == 0;
    g_free(a);
    g_free(b);
    return is_equal;
}

char *studio_element_text(const FrContents *contents, uint32_t element) {
    const char *text = fr_source_text(fr_contents_source(contents), NULL);
    uint32_t begin = fr_contents_at(contents, element)->begin, indent = 0;
    while (begin > indent && g_ascii_isspace(text[begin - indent - 1]) &&
           text[begin - indent - 1] != '\n') {
        indent++;
    }
    char *whole = whole_text(contents, element);
    char **lines = g_strsplit(whole, "\n", -1);
    for (char **line = lines + 1; *lines != NULL && *line != NULL; line++) {
        size_t blank = 0;
        while (blank < indent && (*line)[blank] == ' ') {
            blank++;
        }
        memmove(*line, *line + blank, strlen(*line + blank) + 1);
    }
    char *result = g_strjoinv("\n", lines);
    g_strfreev(lines);
    g_free(whole);
    return result;
}

// ---- words -------------------------------------------------------------------------------------

// What takes the place of a word; NULL: it stays.
typedef const char *(*Look)(const char *word, void *user);

// Each word of a text looked at. In formulas `-` parts words; else an id may have it. Free with
// g_free().
static char *map_words(const char *text, bool is_minus, Look look, void *user) {
    GString *out = g_string_new(NULL);
    const char *at = text;
    while (*at != '\0') {
        const char *end = at;
        while (g_ascii_isalnum(*end) || *end == '_' || (*end == '-' && !is_minus)) {
            end++;
        }
        char *word = g_strndup(at, (gsize)(end - at));
        const char *other = end > at ? look(word, user) : NULL;
        g_string_append(out, other != NULL ? other : word);
        g_free(word);
        if (*end != '\0') {
            g_string_append_c(out, *end++);
        }
        at = end;
    }
    return g_string_free(out, FALSE);
}

// Values of other kinds are formulas, too, where they begin with an equals sign.
static bool is_formula(const FrParam *row, const char *value) {
    bool is_plain = row->kind == FR_PARAM_TEXT || row->kind == FR_PARAM_CHOICE ||
                    row->kind == FR_PARAM_POINTS || row->kind == FR_PARAM_COLOUR;
    return !is_plain || *value == '=';
}

// Whether a value may name things of a kind.
static bool may_name(const FrParam *row, const char *value, StudioTag tag) {
    const char *name = row->name;
    if (is_formula(row, value) &&
        (tag == STUDIO_TAG_CURVE || tag == STUDIO_TAG_FUNCTION || tag == STUDIO_TAG_SLIDER)) {
        return true;
    }
    if (row->kind != FR_PARAM_TEXT) {
        return false;
    }
    switch (tag) {
    case STUDIO_TAG_MATERIAL:
        return g_str_has_suffix(name, "material") || strcmp(name, "bark") == 0 ||
               strcmp(name, "leaf") == 0 || strcmp(name, "colours") == 0;
    case STUDIO_TAG_PLANT:
        return strcmp(name, "plant") == 0 || strcmp(name, "base") == 0;
    case STUDIO_TAG_COMPONENT:
        return strcmp(name, "from") == 0 || strcmp(name, "to") == 0;
    default:
        return false;
    }
}

// ---- what is used ------------------------------------------------------------------------------

typedef struct Use {
    const FrContents *contents;
    uint32_t plant;
    StudioTag tag;
    GHashTable *used;
    GArray *found; // uint32_t
} Use;

static const char *note_use(const char *word, void *user) {
    Use *use = user;
    uint32_t parent = studio_tag_is_top(use->tag) ? 0 : use->plant;
    uint32_t element =
        parent == FR_NONE ? FR_NONE : studio_tag_find(use->contents, parent, use->tag, word);
    if (element != FR_NONE && g_hash_table_add(use->used, GUINT_TO_POINTER(element))) {
        g_array_append_val(use->found, element);
    }
    return NULL;
}

static void note_text(Use *use, const char *text, const FrParam *row) {
    for (int tag = 0; tag < STUDIO_TAG_COMPONENT; tag++) {
        use->tag = (StudioTag)tag;
        bool may = row != NULL ? may_name(row, text, use->tag)
                               : tag == STUDIO_TAG_CURVE || tag == STUDIO_TAG_FUNCTION;
        if (may) {
            g_free(map_words(text, row == NULL || row->kind != FR_PARAM_TEXT, note_use, use));
        }
    }
}

// What an element names itself.
static void note_element(Use *use, uint32_t element) {
    const FrContents *contents = use->contents;
    const FrContentsElement *at = fr_contents_at(contents, element);
    for (size_t r = 0; at->table != NULL && r < at->table->count; r++) {
        char *attribute = fr_param_attribute(&at->table->rows[r]);
        char *value = fr_contents_get(contents, element, attribute);
        if (value != NULL) {
            note_text(use, value, &at->table->rows[r]);
        }
        g_free(value);
        g_free(attribute);
    }
    if (studio_tag_of(contents, element) == STUDIO_TAG_FUNCTION) {
        char *text = fr_contents_text(contents, element, NULL);
        note_text(use, text, NULL);
        g_free(text);
    }
}

void studio_add_used(const FrContents *contents, uint32_t plant, uint32_t element,
                     GHashTable *used) {
    Use use = {contents, plant, STUDIO_TAG_COUNT, used,
               g_array_new(FALSE, FALSE, sizeof(uint32_t))};
    note_element(&use, element);
    const FrContentsElement *at = fr_contents_at(contents, element);
    for (uint32_t child = at->first; child != FR_NONE;
         child = fr_contents_at(contents, child)->next) {
        studio_add_used(contents, plant, child, used);
    }
    for (guint i = 0; i < use.found->len; i++) {
        studio_add_used(contents, plant, g_array_index(use.found, uint32_t, i), used);
    }
    g_array_unref(use.found);
}

GArray *studio_users_of(const FrContents *contents, uint32_t element) {
    GArray *users = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint32_t i = 0; i < fr_contents_count(contents); i++) {
        Use use = {contents, studio_place_plant(contents, i), STUDIO_TAG_COUNT,
                   g_hash_table_new(NULL, NULL), g_array_new(FALSE, FALSE, sizeof(uint32_t))};
        note_element(&use, i);
        if (i != element && g_hash_table_contains(use.used, GUINT_TO_POINTER(element))) {
            g_array_append_val(users, i);
        }
        g_hash_table_unref(use.used);
        g_array_unref(use.found);
    }
    return users;
}

// ---- new names ---------------------------------------------------------------------------------

void studio_names_init(StudioNames *names, uint32_t plant) {
    for (int tag = 0; tag < STUDIO_TAG_COUNT; tag++) {
        names->by_tag[tag] = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    }
    names->plant = plant;
    names->taken = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
}

void studio_names_clear(StudioNames *names) {
    for (int tag = 0; tag < STUDIO_TAG_COUNT; tag++) {
        g_hash_table_unref(names->by_tag[tag]);
    }
    g_hash_table_unref(names->taken);
}

const char *studio_names_get(const StudioNames *names, StudioTag tag, const char *id) {
    const char *other = g_hash_table_lookup(names->by_tag[tag], id);
    return other != NULL ? other : id;
}

void studio_names_add(StudioNames *names, const FrContents *mine, uint32_t inside,
                      const FrContents *theirs, uint32_t element, const char *stem) {
    char *id = g_strdup(stem);
    size_t length = strlen(stem);
    while (length > 1 && g_ascii_isdigit(stem[length - 1])) {
        length--;
    }
    for (uint32_t k = 2;
         fr_contents_find(mine, inside, id) != FR_NONE ||
         fr_contents_find(theirs, 0, id) != FR_NONE || g_hash_table_contains(names->taken, id);
         k++) {
        g_free(id);
        id = g_strdup_printf("%.*s%u", (int)length, stem, k);
    }
    g_hash_table_add(names->taken, g_strdup(id));
    g_hash_table_insert(names->by_tag[studio_tag_of(theirs, element)],
                        g_strdup(fr_contents_at(theirs, element)->id), id);
}

static const char *new_name(const char *word, void *user) {
    return g_hash_table_lookup(user, word);
}

// What is told in ids of sliders and components holds in one plant alone.
static bool is_meant(const FrContents *contents, uint32_t element, StudioTag tag,
                     const StudioNames *names) {
    uint32_t at = element;
    while (!studio_tag_is_top(tag) && at != FR_NONE && at != 0 && at != names->plant) {
        at = fr_contents_at(contents, at)->parent;
    }
    return studio_tag_is_top(tag) || at == names->plant;
}

static void rename_attributes(const FrContents *theirs, uint32_t element, const StudioNames *names,
                              GArray *splices) {
    const FrContentsElement *at = fr_contents_at(theirs, element);
    for (size_t r = 0; at->table != NULL && r < at->table->count; r++) {
        const FrParam *row = &at->table->rows[r];
        char *attribute = fr_param_attribute(row);
        char *old = fr_contents_get(theirs, element, attribute), *now = g_strdup(old);
        for (int tag = 0; old != NULL && tag < STUDIO_TAG_COUNT; tag++) {
            if (may_name(row, old, (StudioTag)tag) &&
                is_meant(theirs, element, (StudioTag)tag, names)) {
                char *next =
                    map_words(now, row->kind != FR_PARAM_TEXT, new_name, names->by_tag[tag]);
                g_free(now);
                now = next;
            }
        }
        if (g_strcmp0(old, now) != 0) {
            FrSplice splice = fr_contents_set(theirs, element, attribute, now);
            g_array_append_val(splices, splice);
        }
        g_free(now);
        g_free(old);
        g_free(attribute);
    }
}

static void rename_text(const FrContents *theirs, uint32_t element, const StudioNames *names,
                        GArray *splices) {
    char *old = fr_contents_text(theirs, element, NULL);
    char *some = map_words(old, true, new_name, names->by_tag[STUDIO_TAG_CURVE]);
    char *now = map_words(some, true, new_name, names->by_tag[STUDIO_TAG_FUNCTION]);
    if (strcmp(old, now) != 0) {
        FrSplice splice = fr_contents_set_text(theirs, element, now);
        g_array_append_val(splices, splice);
    }
    g_free(now);
    g_free(some);
    g_free(old);
}

FrContents *studio_renamed(const FrContents *contents, const StudioNames *names) {
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    for (uint32_t i = 1; i < fr_contents_count(contents); i++) {
        StudioTag tag = studio_tag_of(contents, i);
        const char *id = fr_contents_at(contents, i)->id;
        const char *name =
            tag == STUDIO_TAG_COUNT || id == NULL || !is_meant(contents, i, tag, names)
                ? NULL
                : g_hash_table_lookup(names->by_tag[tag], id);
        if (name != NULL) {
            FrSplice splice = fr_contents_set(contents, i, "id", name);
            g_array_append_val(splices, splice);
        }
        rename_attributes(contents, i, names, splices);
        if (tag == STUDIO_TAG_FUNCTION) {
            rename_text(contents, i, names, splices);
        }
    }
    size_t size;
    char *text = fr_contents_apply(contents, splices, &size);
    FrSource *source = fr_source_new("borrowed", text, size);
    FrContext context = fr_context_default();
    FrContents *result;
    if (fr_contents_read(source, &context, &result) != FR_OK) {
        result = NULL;
    }
    fr_source_unref(source);
    g_free(text);
    g_array_unref(splices);
    return result;
}
