#include "document/reader.h"

#include <stdarg.h>
#include <string.h>

enum { HINTS = 20 };

void fr_reader_open(FrReader *reader, FrDocument *document, FrDiags *diags) {
    *reader =
        (FrReader){.document = document,
                   .tree = document->tree,
                   .diags = diags,
                   .scope = document->scope,
                   .material_ids = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
                   .plant_ids = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL)};
}

void fr_reader_close(FrReader *reader) {
    g_hash_table_unref(reader->material_ids);
    g_hash_table_unref(reader->plant_ids);
}

void fr_read_note(FrReader *reader, FrStatus status) {
    reader->status = MAX(reader->status, status);
}

void fr_read_error(FrReader *reader, const char *code, FrXmlRange place, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    char *text = g_strdup_vprintf(format, arguments);
    va_end(arguments);
    fr_diags_add(reader->diags, FR_ERROR, code, fr_xml_span(reader->tree, place), "%s", text);
    g_free(text);
    fr_read_note(reader, FR_ERR_DOCUMENT);
}

char *fr_read_hint(FrReader *reader, const char *name, const char *const *candidates,
                   size_t count) {
    const char *near = NULL;
    if (reader->hints < HINTS) {
        reader->hints++;
        near = fr_nearest_name(name, candidates, count);
    }
    return near == NULL ? g_strdup("") : g_strdup_printf("; did you mean '%s'?", near);
}

// ---- children ---------------------------------------------------------------------------------

static uint32_t find_from(const FrReader *reader, uint32_t node, FrElementId id) {
    const char *name = fr_element(id).name;
    for (node = fr_xml_element_from(reader->tree, node); node != FR_NONE;
         node = fr_xml_element_from(reader->tree, reader->tree->nodes[node].next)) {
        if (fr_xml_equals(reader->tree, reader->tree->nodes[node].name, name)) {
            return node;
        }
    }
    return FR_NONE;
}

uint32_t fr_read_first(const FrReader *reader, uint32_t parent, FrElementId id) {
    return find_from(reader, reader->tree->nodes[parent].first, id);
}

uint32_t fr_read_next(const FrReader *reader, uint32_t node, FrElementId id) {
    return find_from(reader, reader->tree->nodes[node].next, id);
}

/// The names of the elements in a set, for hints.
static size_t names_of(FrElementSet set, const char *names[FR_ELEMENT_COUNT]) {
    size_t count = 0;
    for (FrElementId id = 0; id < FR_ELEMENT_COUNT; id++) {
        if ((set >> id & 1) != 0) {
            names[count++] = fr_element(id).name;
        }
    }
    return count;
}

static void report_unknown_child(FrReader *reader, const FrXmlNode *child,
                                 const FrElement *parent) {
    char *name = fr_xml_name(reader->tree, child->name);
    const char *names[FR_ELEMENT_COUNT];
    size_t count = names_of(parent->children, names);
    if (fr_element_find(name) != FR_ELEMENT_COUNT) {
        fr_read_error(reader, "misplaced-element", child->name, "<%s> does not belong in <%s>",
                      name, parent->name);
    } else {
        char *hint = fr_read_hint(reader, name, names, count);
        fr_read_error(reader, "unknown-element", child->name, "unknown element <%s> in <%s>%s",
                      name, parent->name, hint);
        g_free(hint);
    }
    g_free(name);
}

/// A text or CDATA section where an element has none.
static void check_no_text(FrReader *reader, const FrXmlNode *child, const FrElement *parent) {
    const char *text = fr_source_text(reader->tree->source, NULL);
    FrXmlRange range = child->name;
    while (range.begin < range.end && g_ascii_isspace(text[range.begin])) {
        range.begin++;
    }
    while (range.begin < range.end && g_ascii_isspace(text[range.end - 1])) {
        range.end--;
    }
    if (range.begin < range.end) {
        fr_read_error(reader, "unexpected-text", range, "there is no text in <%s>", parent->name);
    }
}

static void check_element(FrReader *reader, const FrXmlNode *child, const FrElement *parent,
                          FrElementSet *seen) {
    char *name = fr_xml_name(reader->tree, child->name);
    FrElementId id = fr_element_find(name);
    g_free(name);
    if (id == FR_ELEMENT_COUNT || (parent->children >> id & 1) == 0) {
        report_unknown_child(reader, child, parent);
        return;
    }
    FrElementSet bit = (FrElementSet)1 << id;
    if ((*seen & bit) != 0 && fr_element(id).is_once) {
        fr_read_error(reader, "repeated-element", child->name, "more than one <%s> in <%s>",
                      fr_element(id).name, parent->name);
    }
    *seen |= bit;
}

void fr_read_check_children(FrReader *reader, uint32_t node, FrElementId id) {
    FrElement element = fr_element(id);
    FrElementSet seen = 0;
    for (uint32_t i = reader->tree->nodes[node].first; i != FR_NONE;
         i = reader->tree->nodes[i].next) {
        const FrXmlNode *child = &reader->tree->nodes[i];
        if (child->kind == FR_XML_ELEMENT) {
            check_element(reader, child, &element, &seen);
        } else if (!element.has_text &&
                   (child->kind == FR_XML_TEXT || child->kind == FR_XML_CDATA)) {
            check_no_text(reader, child, &element);
        }
    }
}

// ---- attributes -------------------------------------------------------------------------------

static void report_unknown_attribute(FrReader *reader, FrXmlRange place, const FrElement *element) {
    size_t rows = element->table == NULL ? 0 : element->table->count;
    const char **names = g_new0(const char *, rows + 1);
    for (size_t i = 0; i < rows; i++) {
        names[i] = fr_param_attribute(&element->table->rows[i]);
    }
    names[rows] = "id";
    char *name = fr_xml_name(reader->tree, place);
    char *hint = fr_read_hint(reader, name, names, rows + (element->has_id ? 1 : 0));
    fr_read_error(reader, "unknown-attribute", place, "unknown attribute '%s' of <%s>%s", name,
                  element->name, hint);
    g_free(hint);
    g_free(name);
    for (size_t i = 0; i < rows; i++) {
        g_free((char *)names[i]);
    }
    g_free(names);
}

/// The row an attribute sets, or NULL. `_` stands only in our own names.
static const FrParam *find_row(const FrReader *reader, const FrElement *element, FrXmlRange range) {
    const char *text = fr_source_text(reader->tree->source, NULL) + range.begin;
    size_t length = range.end - range.begin;
    if (element->table == NULL || length > FR_LONGEST_ID || memchr(text, '_', length) != NULL) {
        return NULL;
    }
    char *name = g_strndup(text, length);
    const FrParam *row = fr_params_find(element->table, name);
    g_free(name);
    return row;
}

/// What XML itself and schema-aware editors put on the root.
static bool is_foreign(const FrReader *reader, uint32_t node, FrXmlRange name) {
    const char *text = fr_source_text(reader->tree->source, NULL) + name.begin;
    return node == reader->tree->root &&
           (fr_xml_equals(reader->tree, name, "xmlns:xsi") || strncmp(text, "xsi:", 4) == 0 ||
            strncmp(text, "xml:", 4) == 0);
}

static void set_attribute(FrReader *reader, uint32_t node, const FrXmlAttribute *attribute,
                          const FrElement *element, void *object) {
    if (element->has_id && fr_xml_equals(reader->tree, attribute->name, "id")) {
        return;
    }
    const FrParam *row = find_row(reader, element, attribute->name);
    if (row == NULL) {
        if (!is_foreign(reader, node, attribute->name)) {
            report_unknown_attribute(reader, attribute->name, element);
        }
        return;
    }
    char *value = fr_xml_decode(reader->tree, attribute->value, true);
    fr_read_note(reader, fr_params_set(element->table, object, row, value,
                                       fr_xml_span(reader->tree, attribute->value), reader->scope,
                                       reader->diags));
    g_free(value);
}

void fr_read_attributes(FrReader *reader, uint32_t node, FrElementId id, void *object) {
    FrElement element = fr_element(id);
    const FrXmlNode *at = &reader->tree->nodes[node];
    for (uint32_t i = 0; i < at->attribute_count; i++) {
        set_attribute(reader, node, &reader->tree->attributes[at->attribute + i], &element, object);
    }
    for (size_t i = 0; element.table != NULL && i < element.table->count; i++) {
        char *name = fr_param_attribute(&element.table->rows[i]);
        if (fr_element_requires(&element, name) &&
            fr_xml_attribute(reader->tree, node, name) == NULL) {
            fr_read_error(reader, "missing-attribute", at->name, "<%s> needs the attribute '%s'",
                          element.name, name);
        }
        g_free(name);
    }
}

void fr_read_check_effects(FrReader *reader, uint32_t node, FrElementId id, const void *object,
                           FrWhyUnread why, const void *user) {
    FrElement element = fr_element(id);
    const FrXmlNode *at = &reader->tree->nodes[node];
    for (uint32_t i = 0; i < at->attribute_count; i++) {
        const FrXmlAttribute *attribute = &reader->tree->attributes[at->attribute + i];
        const FrParam *row = find_row(reader, &element, attribute->name);
        char *when = row != NULL ? why(object, row, user) : NULL;
        if (when != NULL) {
            char *name = fr_param_attribute(row);
            fr_diags_add(reader->diags, FR_WARNING, "without-effect",
                         fr_xml_span(reader->tree, attribute->name),
                         "'%s' has no effect here: it is read where %s", name, when);
            g_free(name);
        }
        g_free(when);
    }
}

void fr_read_attribute(FrReader *reader, uint32_t node, const FrXmlAttribute *attribute,
                       FrElementId id, void *object) {
    FrElement element = fr_element(id);
    set_attribute(reader, node, attribute, &element, object);
}

char *fr_read_id(FrReader *reader, uint32_t node) {
    FrXmlRange name_place = reader->tree->nodes[node].name;
    const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, node, "id");
    if (attribute == NULL) {
        char *name = fr_xml_name(reader->tree, name_place);
        fr_read_error(reader, "missing-attribute", name_place, "<%s> needs the attribute 'id'",
                      name);
        g_free(name);
        return NULL;
    }
    char *id = fr_xml_decode(reader->tree, attribute->value, true);
    if (strlen(id) > FR_LONGEST_ID || !fr_id_is_valid(id)) {
        fr_read_error(
            reader, "bad-id", attribute->value,
            "an id is a letter followed by letters, digits, '-' and '_', at most %d bytes",
            FR_LONGEST_ID);
        g_free(id);
        return NULL;
    }
    return id;
}

FrXmlRange fr_read_value_place(const FrReader *reader, uint32_t node, const char *attribute) {
    const FrXmlAttribute *found = fr_xml_attribute(reader->tree, node, attribute);
    return found == NULL ? reader->tree->nodes[node].name : found->value;
}

// ---- lines and pictures -----------------------------------------------------------------------

FrStroke *fr_read_line(FrReader *reader, uint32_t node) {
    FrXmlRange place;
    char *text = fr_read_text(reader, node, &place);
    FrStroke *line = fr_stroke_parse(text, fr_xml_span(reader->tree, place), reader->diags);
    if (line == NULL) {
        fr_read_note(reader, FR_ERR_DOCUMENT);
    }
    g_free(text);
    return line;
}

void fr_read_check_no_line(FrReader *reader, uint32_t node, const char *message) {
    FrXmlRange place;
    char *text = fr_read_text(reader, node, &place);
    if (*g_strstrip(text) != '\0') {
        fr_read_error(reader, "unexpected-text", place, "%s", message);
    }
    g_free(text);
}

char *fr_read_path(FrReader *reader, uint32_t node, const char *attribute, const char *file) {
    if (file == NULL || *file == '\0' || reader->context == NULL) {
        return NULL;
    }
    if (g_path_is_absolute(file)) {
        fr_read_error(reader, "absolute-path", fr_read_value_place(reader, node, attribute),
                      "files are named relative to the document, not '%s'", file);
        return NULL;
    }
    return g_build_filename(reader->document->folder, file, NULL);
}

FrImage *fr_read_picture(FrReader *reader, uint32_t node, const char *attribute, const char *file) {
    char *path = fr_read_path(reader, node, attribute, file);
    FrStatus status = FR_OK;
    FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, attribute));
    FrImage *image = path == NULL ? NULL : fr_image_load(path, span, reader->context, &status);
    fr_read_note(reader, status);
    g_free(path);
    return image;
}
