#include "document/splice.h"

#include <string.h>

static const char *text_of(const FrXmlTree *tree) {
    return fr_source_text(tree->source, NULL);
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

static void append_escaped(GString *out, const char *value, char quote) {
    for (const char *at = value; *at != '\0'; at++) {
        if (*at == '&') {
            g_string_append(out, "&amp;");
        } else if (*at == '<') {
            g_string_append(out, "&lt;");
        } else if (*at == quote) {
            g_string_append(out, quote == '"' ? "&quot;" : "&apos;");
        } else if (*at == '\t' || *at == '\n' || *at == '\r') {
            g_string_append_printf(out, "&#%d;", *at);
        } else {
            g_string_append_c(out, *at);
        }
    }
}

// ---- attributes --------------------------------------------------------------------------------

// Behind the last attribute, or the name.
static uint32_t end_of_attributes(const FrXmlTree *tree, uint32_t node) {
    const FrXmlNode *element = &tree->nodes[node];
    uint32_t count = element->attribute_count;
    return count == 0 ? element->name.end
                      : tree->attributes[element->attribute + count - 1].value.end + 1;
}

static FrSplice splice_attribute_away(const FrXmlTree *tree, const FrXmlAttribute *old) {
    const char *text = text_of(tree);
    uint32_t begin = old->name.begin;
    while (g_ascii_isspace(text[begin - 1])) {
        begin--;
    }
    return (FrSplice){begin, old->value.end + 1, g_strdup("")};
}

FrSplice fr_splice_attribute(const FrXmlTree *tree, uint32_t node, const char *name,
                             const char *value, FrXmlRange *place) {
    const FrXmlAttribute *old = fr_xml_attribute(tree, node, name);
    if (value == NULL) {
        uint32_t end = end_of_attributes(tree, node);
        return old == NULL ? (FrSplice){end, end, g_strdup("")} : splice_attribute_away(tree, old);
    }
    GString *out = g_string_new(NULL);
    FrSplice splice;
    uint32_t before = 0;
    if (old != NULL) {
        append_escaped(out, value, text_of(tree)[old->value.end]);
        splice = (FrSplice){.begin = old->value.begin, .end = old->value.end};
    } else {
        uint32_t end = end_of_attributes(tree, node);
        g_string_append_printf(out, " %s=\"", name);
        before = (uint32_t)out->len;
        append_escaped(out, value, '"');
        splice = (FrSplice){.begin = end, .end = end};
    }
    if (place != NULL) {
        *place = (FrXmlRange){splice.begin + before, splice.begin + (uint32_t)out->len};
    }
    if (old == NULL) {
        g_string_append_c(out, '"');
    }
    splice.text = g_string_free(out, FALSE);
    return splice;
}

// ---- content -----------------------------------------------------------------------------------

static bool has_one_tag(const FrXmlTree *tree, uint32_t node) {
    return text_of(tree)[tree->nodes[node].all.end - 2] == '/';
}

FrXmlRange fr_splice_inside(const FrXmlTree *tree, uint32_t node) {
    const char *text = text_of(tree);
    uint32_t begin = end_of_attributes(tree, node);
    if (has_one_tag(tree, node)) {
        return (FrXmlRange){begin, begin};
    }
    while (text[begin] != '>') {
        begin++;
    }
    uint32_t end = tree->nodes[node].all.end - 1;
    while (text[end] != '<') {
        end--;
    }
    return (FrXmlRange){begin + 1, end};
}

// An element's tags with this between them.
static FrSplice splice_inside(const FrXmlTree *tree, uint32_t node, char *inside) {
    FrXmlRange range = fr_splice_inside(tree, node);
    if (!has_one_tag(tree, node)) {
        return (FrSplice){range.begin, range.end, inside};
    }
    char *name = fr_xml_name(tree, tree->nodes[node].name);
    FrSplice splice = {range.begin, tree->nodes[node].all.end,
                       g_strdup_printf(">%s</%s>", inside, name)};
    g_free(name);
    g_free(inside);
    return splice;
}

static bool is_text(const FrXmlTree *tree, uint32_t node) {
    const FrXmlNode *at = &tree->nodes[node];
    if (at->kind != FR_XML_TEXT) {
        return at->kind == FR_XML_CDATA;
    }
    const char *text = text_of(tree);
    for (uint32_t i = at->all.begin; i < at->all.end; i++) {
        if (!g_ascii_isspace(text[i])) {
            return true;
        }
    }
    return false;
}

bool fr_splice_text_range(const FrXmlTree *tree, uint32_t node, FrXmlRange *range) {
    uint32_t first = FR_NONE, last = FR_NONE;
    bool has_other = false, is_parted = false, is_open = false;
    for (uint32_t child = tree->nodes[node].first; child != FR_NONE;
         child = tree->nodes[child].next) {
        FrXmlKind kind = tree->nodes[child].kind;
        if (is_text(tree, child)) {
            is_parted = is_parted || is_open;
            first = first == FR_NONE ? child : first;
            last = child;
        } else if (kind != FR_XML_TEXT) {
            has_other = true;
            is_open = last != FR_NONE;
        }
    }
    FrXmlRange inside = fr_splice_inside(tree, node);
    if (first != FR_NONE) {
        *range = (FrXmlRange){tree->nodes[first].all.begin, tree->nodes[last].all.end};
    } else {
        *range = has_other ? (FrXmlRange){inside.end, inside.end} : inside;
    }
    return !is_parted;
}

static bool has_cdata(const FrXmlTree *tree, uint32_t node) {
    for (uint32_t child = tree->nodes[node].first; child != FR_NONE;
         child = tree->nodes[child].next) {
        if (tree->nodes[child].kind == FR_XML_CDATA) {
            return true;
        }
    }
    return false;
}

// Within a CDATA section, which cannot hold the mark of its own end: it ends there and another
// begins.
static char *in_section(const char *text) {
    GString *out = g_string_new("<![CDATA[");
    for (const char *at = text; *at != '\0'; at++) {
        if (g_str_has_prefix(at, "]]>")) {
            g_string_append(out, "]]]]><![CDATA[>");
            at += 2;
        } else {
            g_string_append_c(out, *at);
        }
    }
    g_string_append(out, "]]>");
    return g_string_free(out, FALSE);
}

FrSplice fr_splice_content(const FrXmlTree *tree, uint32_t node, const char *text) {
    FrXmlRange range;
    if (!fr_splice_text_range(tree, node, &range)) {
        return (FrSplice){range.begin, range.begin, g_strdup("")};
    }
    bool is_plain = strpbrk(text, "&<") == NULL && strstr(text, "]]>") == NULL;
    char *written = is_plain && !has_cdata(tree, node) ? g_strdup(text) : in_section(text);
    return has_one_tag(tree, node) ? splice_inside(tree, node, written)
                                   : (FrSplice){range.begin, range.end, written};
}

// ---- elements ----------------------------------------------------------------------------------

// The blanks that a line begins with, if nothing else stands before `at`. Free with g_free().
static char *indent_at(const FrXmlTree *tree, uint32_t at) {
    const char *text = text_of(tree);
    uint32_t begin = at;
    while (begin > 0 && is_blank(text[begin - 1])) {
        begin--;
    }
    bool is_line = begin == 0 || text[begin - 1] == '\n';
    return is_line ? g_strndup(text + begin, at - begin) : g_strdup("");
}

static uint32_t last_element(const FrXmlTree *tree, uint32_t parent) {
    uint32_t last = FR_NONE;
    for (uint32_t child = fr_xml_element_from(tree, tree->nodes[parent].first); child != FR_NONE;
         child = fr_xml_element_from(tree, tree->nodes[child].next)) {
        last = child;
    }
    return last;
}

static char *indented(const char *xml, const char *indent) {
    char **lines = g_strsplit(xml, "\n", -1);
    char *separator = g_strconcat("\n", indent, NULL);
    char *joined = g_strjoinv(separator, lines);
    g_free(separator);
    g_strfreev(lines);
    return joined;
}

FrSplice fr_splice_insert(const FrXmlTree *tree, uint32_t parent, uint32_t after, const char *xml) {
    uint32_t last = after == FR_NONE ? last_element(tree, parent) : after;
    FrSplice splice;
    if (last != FR_NONE) {
        char *indent = indent_at(tree, tree->nodes[last].all.begin);
        char *element = indented(xml, indent);
        uint32_t end = tree->nodes[last].all.end;
        splice = (FrSplice){end, end, g_strconcat("\n", indent, element, NULL)};
        g_free(element);
        g_free(indent);
    } else {
        char *outer = indent_at(tree, tree->nodes[parent].all.begin);
        char *indent = g_strconcat(outer, "  ", NULL);
        char *element = indented(xml, indent);
        splice = splice_inside(tree, parent, g_strconcat("\n", indent, element, "\n", outer, NULL));
        g_free(element);
        g_free(indent);
        g_free(outer);
    }
    return splice;
}

FrSplice fr_splice_remove(const FrXmlTree *tree, uint32_t node) {
    const char *text = text_of(tree);
    FrXmlRange all = tree->nodes[node].all;
    uint32_t begin = all.begin, end = all.end;
    while (begin > 0 && is_blank(text[begin - 1])) {
        begin--;
    }
    while (is_blank(text[end]) || text[end] == '\r') {
        end++;
    }
    bool is_alone = begin > 0 && text[begin - 1] == '\n' && text[end] == '\n';
    return is_alone ? (FrSplice){begin, end + 1, g_strdup("")}
                    : (FrSplice){all.begin, all.end, g_strdup("")};
}

// ---- doing them --------------------------------------------------------------------------------

static int compare_places(const void *a, const void *b) {
    const FrSplice *first = a, *second = b;
    return (first->begin > second->begin) - (first->begin < second->begin);
}

char *fr_splice_apply(const FrXmlTree *tree, GArray *splices, size_t *size) {
    size_t length;
    const char *text = fr_source_text(tree->source, &length);
    GString *out = g_string_sized_new(length + 64);
    uint32_t at = 0;
    g_array_sort(splices, compare_places);
    for (guint i = 0; i < splices->len; i++) {
        FrSplice *splice = &g_array_index(splices, FrSplice, i);
        FR_ASSERT(splice->begin >= at && splice->end >= splice->begin && splice->end <= length);
        g_string_append_len(out, text + at, (gssize)(splice->begin - at));
        g_string_append(out, splice->text);
        at = splice->end;
        g_free(splice->text);
    }
    g_string_append_len(out, text + at, (gssize)(length - at));
    g_array_set_size(splices, 0);
    if (size != NULL) {
        *size = out->len;
    }
    return g_string_free(out, FALSE);
}
