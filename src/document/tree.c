/// Life of a tree and the questions asked of it.
#include "document/tree.h"

#include <string.h>

enum { PRINTED_NAME_BYTES = 64 };

FrStatus fr_xml_read(FrSource *source, const FrContext *context, FrXmlTree **tree) {
    *tree = NULL;
    size_t size;
    fr_source_text(source, &size);
    uint64_t allowed = MIN(context->limits.document_bytes, INT32_MAX);
    FrSpan start = {.source = source};
    FrStatus status =
        fr_limit_check(size, allowed, "document_bytes", "the document", start, context->diags);
    if (status == FR_OK) {
        status = fr_xml_check_encoding(source, context->diags);
    }
    if (status != FR_OK) {
        return status;
    }
    FrXmlTree *made = g_new0(FrXmlTree, 1);
    made->source = fr_source_ref(source);
    uint32_t stop = 0;
    status = fr_xml_scan(made, context, &stop);
    // libxml2 decides what is well-formed and says why not; it sees only text within the limits.
    if (status == FR_OK || (status == FR_ERR_DOCUMENT && stop != FR_NONE)) {
        FrStatus judged = fr_xml_check_well_formed(source, context->diags);
        if (judged == FR_OK && status != FR_OK) {
            fr_diags_add(context->diags, FR_ERROR, "not-well-formed",
                         fr_xml_span(made, (FrXmlRange){stop, stop + 1}), "not well-formed XML");
        }
        status = judged == FR_OK ? status : judged;
    }
    if (status != FR_OK) {
        fr_xml_free(made);
        return status;
    }
    *tree = made;
    return FR_OK;
}

void fr_xml_free(FrXmlTree *tree) {
    if (tree == NULL) {
        return;
    }
    fr_source_unref(tree->source);
    g_free(tree->nodes);
    g_free(tree->attributes);
    g_free(tree);
}

FrSpan fr_xml_span(const FrXmlTree *tree, FrXmlRange range) {
    return (FrSpan){.source = tree->source, .begin = range.begin, .end = range.end};
}

bool fr_xml_equals(const FrXmlTree *tree, FrXmlRange range, const char *text) {
    size_t length = strlen(text);
    return range.end - range.begin == length &&
           memcmp(fr_source_text(tree->source, NULL) + range.begin, text, length) == 0;
}

char *fr_xml_name(const FrXmlTree *tree, FrXmlRange range) {
    const char *begin = fr_source_text(tree->source, NULL) + range.begin;
    size_t length = range.end - range.begin;
    if (length <= PRINTED_NAME_BYTES) {
        return g_strndup(begin, length);
    }
    const char *end = g_utf8_find_prev_char(begin, begin + PRINTED_NAME_BYTES);
    return g_strdup_printf("%.*s…", (int)(end - begin), begin);
}

/// Appends the character a reference `&…;` stands for; its length in bytes, 0 if it is none.
static size_t decode_reference(const char *text, size_t length, GString *out) {
    static const struct {
        const char *text;
        char meaning;
    } known[] = {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};
    for (size_t i = 0; i < G_N_ELEMENTS(known); i++) {
        size_t known_length = strlen(known[i].text);
        if (length >= known_length && memcmp(text, known[i].text, known_length) == 0) {
            g_string_append_c(out, known[i].meaning);
            return known_length;
        }
    }
    const char *end = memchr(text, ';', length);
    if (end == NULL || length < 4 || text[1] != '#') {
        return 0;
    }
    bool is_hex = text[2] == 'x';
    uint64_t code = g_ascii_strtoull(text + (is_hex ? 3 : 2), NULL, is_hex ? 16 : 10);
    if (code > 0x10ffff || !g_unichar_validate((gunichar)code)) {
        return 0;
    }
    g_string_append_unichar(out, (gunichar)code);
    return (size_t)(end - text) + 1;
}

char *fr_xml_decode(const FrXmlTree *tree, FrXmlRange range, bool is_value) {
    const char *text = fr_source_text(tree->source, NULL) + range.begin;
    size_t length = range.end - range.begin;
    GString *out = g_string_sized_new(length + 1);
    for (size_t i = 0; i < length;) {
        size_t used = text[i] == '&' ? decode_reference(text + i, length - i, out) : 0;
        if (used == 0) {
            bool is_blank = is_value && (text[i] == '\t' || text[i] == '\n' || text[i] == '\r');
            g_string_append_c(out, is_blank ? ' ' : text[i]);
            used = 1;
        }
        i += used;
    }
    return g_string_free(out, FALSE);
}

void fr_xml_decode_text(const FrXmlTree *tree, FrXmlRange range, GString *out, GArray *origins) {
    const char *text = fr_source_text(tree->source, NULL);
    for (uint32_t at = range.begin; at < range.end;) {
        size_t used = text[at] == '&' ? decode_reference(text + at, range.end - at, out) : 0;
        if (used == 0) {
            g_string_append_c(out, text[at]);
            used = 1;
        }
        while (origins->len < out->len) {
            g_array_append_val(origins, at);
        }
        at += (uint32_t)used;
    }
}

const FrXmlAttribute *fr_xml_attribute(const FrXmlTree *tree, uint32_t node, const char *name) {
    const FrXmlNode *element = &tree->nodes[node];
    for (uint32_t i = 0; i < element->attribute_count; i++) {
        const FrXmlAttribute *attribute = &tree->attributes[element->attribute + i];
        if (fr_xml_equals(tree, attribute->name, name)) {
            return attribute;
        }
    }
    return NULL;
}

uint32_t fr_xml_element_from(const FrXmlTree *tree, uint32_t node) {
    while (node != FR_NONE && tree->nodes[node].kind != FR_XML_ELEMENT) {
        node = tree->nodes[node].next;
    }
    return node;
}
