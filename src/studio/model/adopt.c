#include "studio/model/adopt.h"

#include "studio/model/commands.h"

#include <string.h>

static const char *const tags[] = {"curve", "function", "material", "plant"};

typedef enum Tag { TAG_CURVE, TAG_FUNCTION, TAG_MATERIAL, TAG_PLANT, TAG_NONE } Tag;

static Tag tag_of(const FrContentsElement *element) {
    for (int i = 0; i < TAG_NONE; i++) {
        if (strcmp(element->name, tags[i]) == 0) {
            return (Tag)i;
        }
    }
    return TAG_NONE;
}

static char *text_of(const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    return g_strndup(fr_source_text(fr_contents_source(contents), NULL) + at->begin,
                     at->end - at->begin);
}

// The thing of that kind and id at the top of a document; FR_NONE.
static uint32_t find_top(const FrContents *contents, const char *name, const char *id) {
    uint32_t element = fr_contents_child(contents, 0, name);
    while (element != FR_NONE && g_strcmp0(fr_contents_at(contents, element)->id, id) != 0) {
        element = fr_contents_sibling(contents, element);
    }
    return element;
}

// ---- new names ---------------------------------------------------------------------------------

// What of another document is called otherwise here: by kind, id → new id.
typedef struct Names {
    GHashTable *by_tag[TAG_NONE];
} Names;

static bool is_same(const FrContents *mine, const FrContents *theirs, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(theirs, element);
    uint32_t own = find_top(mine, at->name, at->id);
    char *a = own == FR_NONE ? NULL : text_of(mine, own), *b = text_of(theirs, element);
    bool is_equal = g_strcmp0(a, b) == 0;
    g_free(a);
    g_free(b);
    return is_equal;
}

// New names begin with that of the plant they are taken over with: oak_bark.
static void name_clashes(Names *names, const StudioDocument *document, const FrContents *theirs,
                         const char *plant) {
    const FrContents *mine = studio_document_contents(document);
    for (uint32_t i = fr_contents_at(theirs, 0)->first; i != FR_NONE;
         i = fr_contents_at(theirs, i)->next) {
        const FrContentsElement *at = fr_contents_at(theirs, i);
        Tag tag = tag_of(at);
        if (tag != TAG_NONE && at->id != NULL && find_top(mine, at->name, at->id) != FR_NONE &&
            !is_same(mine, theirs, i)) {
            char *id =
                tag == TAG_PLANT ? g_strdup(at->id) : g_strdup_printf("%s_%s", plant, at->id);
            g_strdelimit(id, "-", '_'); // in formulas it would be a minus
            g_hash_table_insert(names->by_tag[tag], g_strdup(at->id),
                                studio_free_id(document, 0, id));
            g_free(id);
        }
    }
}

// A text with whole words replaced. Free with g_free().
static char *replace_words(const char *text, GHashTable *names) {
    GString *out = g_string_new(NULL);
    const char *at = text;
    while (*at != '\0') {
        const char *end = at;
        while (g_ascii_isalnum(*end) || *end == '_') {
            end++;
        }
        char *word = g_strndup(at, (gsize)(end - at));
        const char *name = end > at ? g_hash_table_lookup(names, word) : NULL;
        g_string_append(out, name != NULL ? name : word);
        g_free(word);
        if (*end != '\0') {
            g_string_append_c(out, *end++);
        }
        at = end;
    }
    return g_string_free(out, FALSE);
}

// What an attribute may name: things of one kind, or curves and functions; NULL: nothing.
static bool may_name(const FrParam *row, Tag tag) {
    const char *name = row->name;
    if (row->kind != FR_PARAM_TEXT) {
        bool is_formula = row->kind == FR_PARAM_NUMBER || row->kind == FR_PARAM_CURVE ||
                          row->kind == FR_PARAM_FORMULA || row->kind == FR_PARAM_VECTOR;
        return is_formula && (tag == TAG_CURVE || tag == TAG_FUNCTION);
    }
    bool is_material = g_str_has_suffix(name, "material") || strcmp(name, "bark") == 0 ||
                       strcmp(name, "leaf") == 0 || strcmp(name, "colours") == 0;
    bool is_plant = strcmp(name, "plant") == 0 || strcmp(name, "base") == 0;
    return (is_material && tag == TAG_MATERIAL) || (is_plant && tag == TAG_PLANT);
}

static void rename_attributes(const FrContents *theirs, uint32_t element, const Names *names,
                              GArray *splices) {
    const FrContentsElement *at = fr_contents_at(theirs, element);
    for (size_t r = 0; at->table != NULL && r < at->table->count; r++) {
        const FrParam *row = &at->table->rows[r];
        char *attribute = fr_param_attribute(row);
        char *old = fr_contents_get(theirs, element, attribute), *now = g_strdup(old);
        for (int tag = 0; old != NULL && tag < TAG_NONE; tag++) {
            if (may_name(row, (Tag)tag)) {
                char *next = replace_words(now, names->by_tag[tag]);
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

static void rename_text(const FrContents *theirs, uint32_t element, const Names *names,
                        GArray *splices) {
    char *old = fr_contents_text(theirs, element, NULL);
    char *some = replace_words(old, names->by_tag[TAG_CURVE]);
    char *now = replace_words(some, names->by_tag[TAG_FUNCTION]);
    if (strcmp(old, now) != 0) {
        FrSplice splice = fr_contents_set_text(theirs, element, now);
        g_array_append_val(splices, splice);
    }
    g_free(now);
    g_free(some);
    g_free(old);
}

// The other document with the new names in it.
static FrContents *renamed(const FrContents *theirs, const Names *names) {
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    for (uint32_t i = 1; i < fr_contents_count(theirs); i++) {
        const FrContentsElement *at = fr_contents_at(theirs, i);
        Tag tag = at->parent == 0 ? tag_of(at) : TAG_NONE;
        const char *name = tag == TAG_NONE || at->id == NULL
                               ? NULL
                               : g_hash_table_lookup(names->by_tag[tag], at->id);
        if (name != NULL) {
            FrSplice splice = fr_contents_set(theirs, i, "id", name);
            g_array_append_val(splices, splice);
        }
        rename_attributes(theirs, i, names, splices);
        if (tag == TAG_FUNCTION) {
            rename_text(theirs, i, names, splices);
        }
    }
    size_t size;
    char *text = fr_contents_apply(theirs, splices, &size);
    FrSource *source = fr_source_new("adopted", text, size);
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

// ---- copies ------------------------------------------------------------------------------------

// Lines after the first without the indent that the first has in its document.
static char *without_indent(const FrContents *theirs, uint32_t element) {
    const char *text = fr_source_text(fr_contents_source(theirs), NULL);
    uint32_t begin = fr_contents_at(theirs, element)->begin, indent = 0;
    while (begin > indent && g_ascii_isspace(text[begin - indent - 1]) &&
           text[begin - indent - 1] != '\n') {
        indent++;
    }
    char *whole = text_of(theirs, element);
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

// The last thing before the scene that such things stand behind; FR_NONE: none is there.
static uint32_t last_top(const FrContents *mine) {
    uint32_t last = FR_NONE;
    for (uint32_t i = fr_contents_at(mine, 0)->first; i != FR_NONE;
         i = fr_contents_at(mine, i)->next) {
        last = tag_of(fr_contents_at(mine, i)) != TAG_NONE ? i : last;
    }
    return last;
}

static bool insert_all(StudioDocument *document, const FrContents *theirs, const char *plant) {
    const FrContents *mine = studio_document_contents(document);
    GString *xml = g_string_new(NULL);
    for (uint32_t i = fr_contents_at(theirs, 0)->first; i != FR_NONE;
         i = fr_contents_at(theirs, i)->next) {
        if (tag_of(fr_contents_at(theirs, i)) != TAG_NONE && !is_same(mine, theirs, i)) {
            char *text = without_indent(theirs, i);
            g_string_append_printf(xml, "%s%s", xml->len > 0 ? "\n" : "", text);
            g_free(text);
        }
    }
    char *name = g_strdup_printf("Take over %s", plant);
    bool is_changed =
        xml->len == 0 ||
        studio_document_splice_one(document, fr_contents_insert(mine, 0, last_top(mine), xml->str),
                                   name, NULL);
    g_free(name);
    g_string_free(xml, TRUE);
    return is_changed;
}

bool studio_adopt(StudioDocument *document, FrSource *from, const char *plant, char **id) {
    *id = NULL;
    FrContext context = fr_context_default();
    FrContents *theirs;
    if (studio_document_is_broken(document) || studio_document_contents(document) == NULL ||
        fr_contents_read(from, &context, &theirs) != FR_OK) {
        return false;
    }
    uint32_t wanted =
        plant == NULL ? fr_contents_child(theirs, 0, "plant") : find_top(theirs, "plant", plant);
    const char *own = wanted == FR_NONE ? NULL : fr_contents_at(theirs, wanted)->id;
    if (own != NULL) {
        Names names;
        for (int i = 0; i < TAG_NONE; i++) {
            names.by_tag[i] = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
        }
        name_clashes(&names, document, theirs, own);
        const char *new = g_hash_table_lookup(names.by_tag[TAG_PLANT], own);
        *id = g_strdup(new != NULL ? new : own);
        FrContents *copies = renamed(theirs, &names);
        if (copies == NULL || !insert_all(document, copies, *id)) {
            g_clear_pointer(id, g_free);
        }
        fr_contents_free(copies);
        for (int i = 0; i < TAG_NONE; i++) {
            g_hash_table_unref(names.by_tag[i]);
        }
    }
    fr_contents_free(theirs);
    return *id != NULL;
}
