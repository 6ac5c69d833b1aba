#include "frond/contents.h"

#include "document/format.h"
#include "document/splice.h"

#include <string.h>

struct FrContents {
    FrSource *source;
    FrXmlTree *tree;
    GArray *elements;    // FrContentsElement
    GArray *nodes;       // uint32_t: node of the tree, by element
    uint32_t *by_node;   // element by node, FR_NONE
    GStringChunk *names; // of tags and ids
};

static FrContentsElement describe(FrContents *contents, uint32_t node) {
    const FrXmlTree *tree = contents->tree;
    const FrXmlNode *at = &tree->nodes[node];
    char *name = fr_xml_name(tree, at->name);
    FrElementId kind = fr_element_find(name);
    FrElement known = {0};
    if (kind != FR_ELEMENT_COUNT) {
        known = fr_element(kind);
    }
    const FrXmlAttribute *id = fr_xml_attribute(tree, node, "id");
    if (id == NULL && kind == FR_ELEMENT_VIEW) {
        id = fr_xml_attribute(tree, node, "name");
    }
    char *called = id == NULL ? NULL : fr_xml_decode(tree, id->value, true);
    FrContentsElement element = {
        .name = g_string_chunk_insert_const(contents->names, name),
        .id = called == NULL ? NULL : g_string_chunk_insert(contents->names, called),
        .table = known.table,
        .component = kind >= FR_ELEMENT_COMPONENT && kind < FR_ELEMENT_COUNT
                         ? (int)(kind - FR_ELEMENT_COMPONENT)
                         : -1,
        .has_text = known.has_text,
        .parent = at->parent == FR_NONE ? FR_NONE : contents->by_node[at->parent],
        .first = FR_NONE,
        .next = FR_NONE,
        .begin = at->all.begin,
        .end = at->all.end,
    };
    g_free(called);
    g_free(name);
    return element;
}

// Links children and siblings: elements stand in document order.
static void link_elements(FrContents *contents) {
    uint32_t count = contents->elements->len;
    FrContentsElement *elements = (FrContentsElement *)(void *)contents->elements->data;
    uint32_t *last = g_new(uint32_t, count);
    for (uint32_t i = 0; i < count; i++) {
        last[i] = FR_NONE;
        uint32_t parent = elements[i].parent;
        if (parent != FR_NONE) {
            uint32_t *link =
                last[parent] == FR_NONE ? &elements[parent].first : &elements[last[parent]].next;
            *link = i;
            last[parent] = i;
        }
    }
    g_free(last);
}

FrStatus fr_contents_read(FrSource *source, const FrContext *context, FrContents **result) {
    *result = NULL;
    FrXmlTree *tree;
    FrStatus status = fr_xml_read(source, context, &tree);
    if (status != FR_OK) {
        return status;
    }
    FrContents *contents = g_new0(FrContents, 1);
    contents->source = fr_source_ref(source);
    contents->tree = tree;
    contents->elements = g_array_new(FALSE, FALSE, sizeof(FrContentsElement));
    contents->nodes = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    contents->names = g_string_chunk_new(1024);
    contents->by_node = g_new(uint32_t, tree->node_count);
    for (uint32_t node = 0; node < tree->node_count; node++) {
        contents->by_node[node] = FR_NONE;
        if (tree->nodes[node].kind == FR_XML_ELEMENT) {
            FrContentsElement element = describe(contents, node);
            contents->by_node[node] = contents->elements->len;
            g_array_append_val(contents->elements, element);
            g_array_append_val(contents->nodes, node);
        }
    }
    link_elements(contents);
    *result = contents;
    return FR_OK;
}

void fr_contents_free(FrContents *contents) {
    if (contents != NULL) {
        fr_xml_free(contents->tree);
        g_array_unref(contents->elements);
        g_array_unref(contents->nodes);
        g_free(contents->by_node);
        g_string_chunk_free(contents->names);
        fr_source_unref(contents->source);
        g_free(contents);
    }
}

// ---- looking -----------------------------------------------------------------------------------

FrSource *fr_contents_source(const FrContents *contents) {
    return contents->source;
}

uint32_t fr_contents_count(const FrContents *contents) {
    return contents->elements->len;
}

const FrContentsElement *fr_contents_at(const FrContents *contents, uint32_t element) {
    FR_ASSERT(element < contents->elements->len);
    return &g_array_index(contents->elements, FrContentsElement, element);
}

static uint32_t node_of(const FrContents *contents, uint32_t element) {
    FR_ASSERT(element < contents->nodes->len);
    return g_array_index(contents->nodes, uint32_t, element);
}

static uint32_t named_from(const FrContents *contents, uint32_t element, const char *name) {
    while (element != FR_NONE && strcmp(fr_contents_at(contents, element)->name, name) != 0) {
        element = fr_contents_at(contents, element)->next;
    }
    return element;
}

uint32_t fr_contents_child(const FrContents *contents, uint32_t parent, const char *name) {
    return named_from(contents, fr_contents_at(contents, parent)->first, name);
}

uint32_t fr_contents_sibling(const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    return named_from(contents, at->next, at->name);
}

uint32_t fr_contents_find(const FrContents *contents, uint32_t inside, const char *id) {
    const FrContentsElement *around = fr_contents_at(contents, inside);
    for (uint32_t i = inside + 1; i < contents->elements->len; i++) {
        const FrContentsElement *element = fr_contents_at(contents, i);
        if (element->begin >= around->end) {
            break;
        }
        if (element->id != NULL && strcmp(element->id, id) == 0) {
            return i;
        }
    }
    return FR_NONE;
}

uint32_t fr_contents_around(const FrContents *contents, uint32_t offset, char **attribute) {
    uint32_t found = FR_NONE;
    for (uint32_t i = 0; i < contents->elements->len; i++) {
        const FrContentsElement *element = fr_contents_at(contents, i);
        if (element->begin <= offset && offset < element->end) {
            found = i;
        }
    }
    if (attribute != NULL) {
        *attribute = NULL;
    }
    if (found == FR_NONE || attribute == NULL) {
        return found;
    }
    const FrXmlNode *node = &contents->tree->nodes[node_of(contents, found)];
    for (uint32_t i = 0; i < node->attribute_count; i++) {
        const FrXmlAttribute *at = &contents->tree->attributes[node->attribute + i];
        if (at->name.begin <= offset && offset <= at->value.end) {
            *attribute = fr_xml_name(contents->tree, at->name);
        }
    }
    return found;
}

char *fr_contents_get(const FrContents *contents, uint32_t element, const char *attribute) {
    const FrXmlAttribute *at =
        fr_xml_attribute(contents->tree, node_of(contents, element), attribute);
    return at == NULL ? NULL : fr_xml_decode(contents->tree, at->value, true);
}

FrSpan fr_contents_span(const FrContents *contents, uint32_t element, const char *attribute) {
    uint32_t node = node_of(contents, element);
    const FrXmlAttribute *at = fr_xml_attribute(contents->tree, node, attribute);
    return fr_xml_span(contents->tree, at == NULL ? contents->tree->nodes[node].name : at->value);
}

char *fr_contents_text(const FrContents *contents, uint32_t element, FrSpan *place) {
    const FrXmlTree *tree = contents->tree;
    uint32_t node = node_of(contents, element);
    GString *text = g_string_new(NULL);
    GArray *origins = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    FrXmlRange range;
    fr_splice_text_range(tree, node, &range);
    for (uint32_t child = tree->nodes[node].first; child != FR_NONE;
         child = tree->nodes[child].next) {
        const FrXmlNode *at = &tree->nodes[child];
        if (at->all.begin < range.begin || at->all.end > range.end) {
            continue;
        }
        if (at->kind == FR_XML_CDATA) {
            g_string_append_len(text, fr_source_text(tree->source, NULL) + at->name.begin,
                                (gssize)(at->name.end - at->name.begin));
        } else if (at->kind == FR_XML_TEXT) {
            fr_xml_decode_text(tree, at->all, text, origins);
        }
    }
    if (place != NULL) {
        *place = fr_xml_span(tree, range);
    }
    g_array_unref(origins);
    return g_string_free(text, FALSE);
}

bool fr_contents_is_id(const char *id) {
    return fr_id_is_valid(id) && strlen(id) <= FR_LONGEST_ID;
}

// ---- edits -------------------------------------------------------------------------------------

FrSplice fr_contents_set(const FrContents *contents, uint32_t element, const char *attribute,
                         const char *value) {
    return fr_splice_attribute(contents->tree, node_of(contents, element), attribute, value, NULL);
}

FrSplice fr_contents_set_text(const FrContents *contents, uint32_t element, const char *text) {
    return fr_splice_content(contents->tree, node_of(contents, element), text);
}

FrSplice fr_contents_insert(const FrContents *contents, uint32_t parent, uint32_t after,
                            const char *xml) {
    return fr_splice_insert(contents->tree, node_of(contents, parent),
                            after == FR_NONE ? FR_NONE : node_of(contents, after), xml);
}

FrSplice fr_contents_remove(const FrContents *contents, uint32_t element) {
    return fr_splice_remove(contents->tree, node_of(contents, element));
}

char *fr_contents_apply(const FrContents *contents, GArray *splices, size_t *size) {
    return fr_splice_apply(contents->tree, splices, size);
}
