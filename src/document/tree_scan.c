/// Splits well-formed XML 1.0 without document type at its markup. Iterative: nesting costs no
/// stack, and the limits are checked before each element is stored.
#include "document/tree.h"

#include <string.h>

enum {
    ATTRIBUTES_PER_ELEMENT = 256, // libxml2 compares each with each
    ATTRIBUTES_PER_NODE = 8,      // of the whole document, on average
};

typedef struct Scan {
    const FrContext *context;
    FrXmlTree *tree;
    const char *text;
    uint32_t at, size;
    GArray *nodes, *attributes;
    uint64_t counted; ///< nodes but texts
    uint32_t open;    ///< element whose end tag is awaited
    uint32_t last;    ///< last child of `open` so far
    uint32_t depth;
    bool is_diagnosed; ///< what is wrong has been said
} Scan;

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool starts(const Scan *scan, const char *mark) {
    size_t length = strlen(mark);
    return scan->size - scan->at >= length && memcmp(scan->text + scan->at, mark, length) == 0;
}

static FrXmlNode *node_at(const Scan *scan, uint32_t index) {
    return &g_array_index(scan->nodes, FrXmlNode, index);
}

static uint32_t add_node(Scan *scan, FrXmlKind kind, FrXmlRange all, FrXmlRange name) {
    FrXmlNode node = {.kind = kind,
                      .parent = scan->open,
                      .next = FR_NONE,
                      .first = FR_NONE,
                      .all = all,
                      .name = name,
                      .attribute = scan->attributes->len};
    uint32_t index = scan->nodes->len;
    g_array_append_val(scan->nodes, node);
    if (scan->last != FR_NONE) {
        node_at(scan, scan->last)->next = index;
    } else if (scan->open != FR_NONE) {
        node_at(scan, scan->open)->first = index;
    }
    scan->last = index;
    return index;
}

/// One more node that is no text; `place` is where it begins.
static FrStatus count_node(Scan *scan, FrXmlRange place) {
    scan->counted++;
    FrSpan span = fr_xml_span(scan->tree, place);
    return fr_limit_check(scan->counted, scan->context->limits.elements, "elements", "the document",
                          span, scan->context->diags);
}

/// A comment, instruction or CDATA section: from `open` to the next `close`.
static FrStatus scan_delimited(Scan *scan, FrXmlKind kind, const char *open, const char *close) {
    uint32_t begin = scan->at;
    uint32_t inner = begin + (uint32_t)strlen(open);
    const char *end = memmem(scan->text + inner, scan->size - inner, close, strlen(close));
    if (end == NULL) {
        return FR_ERR_DOCUMENT;
    }
    FrStatus status = count_node(scan, (FrXmlRange){begin, inner});
    if (status != FR_OK) {
        return status;
    }
    uint32_t inner_end = (uint32_t)(end - scan->text);
    scan->at = inner_end + (uint32_t)strlen(close);
    add_node(scan, kind, (FrXmlRange){begin, scan->at}, (FrXmlRange){inner, inner_end});
    return FR_OK;
}

static FrXmlRange scan_name(Scan *scan) {
    FrXmlRange name = {.begin = scan->at};
    while (scan->at < scan->size && !is_blank(scan->text[scan->at]) &&
           strchr("=/><\"'&", scan->text[scan->at]) == NULL) {
        scan->at++;
    }
    name.end = scan->at;
    return name;
}

static bool skip_blanks(Scan *scan) {
    uint32_t begin = scan->at;
    while (scan->at < scan->size && is_blank(scan->text[scan->at])) {
        scan->at++;
    }
    return scan->at > begin;
}

static FrStatus add_attribute(Scan *scan, FrXmlNode *element, FrXmlAttribute attribute) {
    FrSpan span = fr_xml_span(scan->tree, attribute.name);
    if (element->attribute_count == ATTRIBUTES_PER_ELEMENT) {
        fr_diags_add(scan->context->diags, FR_ERROR, "too-many-attributes", span,
                     "more than %d attributes in one element", ATTRIBUTES_PER_ELEMENT);
        scan->is_diagnosed = true;
        return FR_ERR_DOCUMENT;
    }
    FrStatus status =
        fr_limit_check(scan->attributes->len / ATTRIBUTES_PER_NODE, scan->context->limits.elements,
                       "elements", "the document's attributes", span, scan->context->diags);
    if (status == FR_OK) {
        g_array_append_val(scan->attributes, attribute);
        element->attribute_count++;
    }
    return status;
}

static FrStatus scan_attribute(Scan *scan, FrXmlNode *element) {
    FrXmlAttribute attribute = {.name = scan_name(scan)};
    skip_blanks(scan);
    if (attribute.name.begin == attribute.name.end || !starts(scan, "=")) {
        return FR_ERR_DOCUMENT;
    }
    scan->at++;
    skip_blanks(scan);
    if (!starts(scan, "\"") && !starts(scan, "'")) {
        return FR_ERR_DOCUMENT;
    }
    attribute.value.begin = scan->at + 1;
    const char *end =
        memchr(scan->text + scan->at + 1, scan->text[scan->at], scan->size - scan->at - 1);
    if (end == NULL) {
        return FR_ERR_DOCUMENT;
    }
    attribute.value.end = (uint32_t)(end - scan->text);
    scan->at = attribute.value.end + 1;

    return add_attribute(scan, element, attribute);
}

static void close_element(Scan *scan) {
    FrXmlNode *element = node_at(scan, scan->open);
    element->all.end = scan->at;
    scan->last = scan->open;
    scan->open = element->parent;
    scan->depth--;
}

static FrStatus open_element(Scan *scan, FrXmlRange all, FrXmlRange name) {
    FrStatus status = count_node(scan, name);
    if (status == FR_OK) {
        status =
            fr_limit_check(scan->depth + 1, scan->context->limits.nesting, "nesting",
                           "the document", fr_xml_span(scan->tree, name), scan->context->diags);
    }
    if (status != FR_OK) {
        return status;
    }
    if (scan->open == FR_NONE) {
        if (scan->tree->root != FR_NONE) {
            return FR_ERR_DOCUMENT;
        }
        scan->tree->root = scan->nodes->len;
    }
    scan->open = add_node(scan, FR_XML_ELEMENT, all, name);
    scan->last = FR_NONE;
    scan->depth++;
    return FR_OK;
}

static FrStatus scan_start_tag(Scan *scan) {
    uint32_t begin = scan->at++;
    FrXmlRange name = scan_name(scan);
    if (name.begin == name.end) {
        return FR_ERR_DOCUMENT;
    }
    FrStatus status = open_element(scan, (FrXmlRange){begin, begin}, name);
    while (status == FR_OK) {
        bool has_blanks = skip_blanks(scan);
        if (starts(scan, ">")) {
            scan->at++;
            return FR_OK;
        }
        if (starts(scan, "/>")) {
            scan->at += 2;
            close_element(scan);
            return FR_OK;
        }
        status = has_blanks ? scan_attribute(scan, node_at(scan, scan->open)) : FR_ERR_DOCUMENT;
    }
    return status;
}

static FrStatus scan_end_tag(Scan *scan) {
    scan->at += 2;
    FrXmlRange name = scan_name(scan);
    skip_blanks(scan);
    if (scan->open == FR_NONE || !starts(scan, ">")) {
        return FR_ERR_DOCUMENT;
    }
    FrXmlRange opened = node_at(scan, scan->open)->name;
    if (opened.end - opened.begin != name.end - name.begin ||
        memcmp(scan->text + opened.begin, scan->text + name.begin, name.end - name.begin) != 0) {
        return FR_ERR_DOCUMENT;
    }
    scan->at++;
    close_element(scan);
    return FR_OK;
}

static FrStatus scan_text(Scan *scan) {
    uint32_t begin = scan->at;
    const char *end = memchr(scan->text + begin, '<', scan->size - begin);
    scan->at = end == NULL ? scan->size : (uint32_t)(end - scan->text);
    FrXmlRange range = {begin, scan->at};
    add_node(scan, FR_XML_TEXT, range, range);
    return FR_OK;
}

static FrStatus scan_one(Scan *scan) {
    if (!starts(scan, "<")) {
        return scan_text(scan);
    }
    if (starts(scan, "<!--")) {
        return scan_delimited(scan, FR_XML_COMMENT, "<!--", "-->");
    }
    if (starts(scan, "<![CDATA[")) {
        return scan_delimited(scan, FR_XML_CDATA, "<![CDATA[", "]]>");
    }
    if (starts(scan, "<?")) {
        return scan_delimited(scan, FR_XML_INSTRUCTION, "<?", "?>");
    }
    if (starts(scan, "<!DOCTYPE")) {
        fr_diags_add(scan->context->diags, FR_ERROR, "document-type",
                     fr_xml_span(scan->tree, (FrXmlRange){scan->at, scan->at + 9}),
                     "a document type (<!DOCTYPE>) is not allowed: documents have no entities");
        scan->is_diagnosed = true;
        return FR_ERR_DOCUMENT;
    }
    if (starts(scan, "<!")) {
        return FR_ERR_DOCUMENT;
    }
    return starts(scan, "</") ? scan_end_tag(scan) : scan_start_tag(scan);
}

FrStatus fr_xml_scan(FrXmlTree *tree, const FrContext *context, uint32_t *stop) {
    size_t size;
    Scan scan = {.context = context,
                 .tree = tree,
                 .text = fr_source_text(tree->source, &size),
                 .nodes = g_array_new(FALSE, FALSE, sizeof(FrXmlNode)),
                 .attributes = g_array_new(FALSE, FALSE, sizeof(FrXmlAttribute)),
                 .open = FR_NONE,
                 .last = FR_NONE};
    scan.size = (uint32_t)size;
    scan.at = size >= 3 && memcmp(scan.text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    tree->root = FR_NONE;
    FrStatus status = FR_OK;
    while (scan.at < scan.size && status == FR_OK) {
        *stop = scan.at;
        status = scan_one(&scan);
    }
    if (status == FR_OK && (scan.open != FR_NONE || tree->root == FR_NONE)) {
        *stop = scan.size;
        status = FR_ERR_DOCUMENT;
    }
    if (scan.is_diagnosed) {
        *stop = FR_NONE;
    }
    tree->node_count = scan.nodes->len;
    tree->attribute_count = scan.attributes->len;
    tree->nodes = (FrXmlNode *)(void *)g_array_free(scan.nodes, FALSE);
    tree->attributes = (FrXmlAttribute *)(void *)g_array_free(scan.attributes, FALSE);
    return status;
}
