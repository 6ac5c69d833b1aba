/// The XML Schema (XSD 1.0) of the format, from the element and parameter rows.
#include "document/format.h"

#include <string.h>

/// A number as documents write it: no infinity, no NaN, no hexadecimal.
#define REAL "[+\\-]?([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+\\-]?[0-9]+)?"

static const char head[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<!-- The .frond document, version 1. Made by `frond schema`; do not edit. -->\n"
    "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\" elementFormDefault=\"qualified\">\n";

static const char types[] =
    "  <xs:simpleType name=\"id\">\n"
    "    <xs:restriction base=\"xs:NCName\"><xs:pattern value=\"[^.]+\"/>"
    "<xs:maxLength value=\"64\"/></xs:restriction>\n"
    "  </xs:simpleType>\n"
    "  <xs:simpleType name=\"real\">\n"
    "    <xs:restriction base=\"xs:double\"><xs:pattern value=\"" REAL "\"/></xs:restriction>\n"
    "  </xs:simpleType>\n"
    "  <xs:simpleType name=\"fixed\">\n"
    "    <xs:annotation><xs:documentation>= 2*size, of numbers and sliders</xs:documentation>"
    "</xs:annotation>\n"
    "    <xs:restriction base=\"xs:token\"><xs:pattern value=\"=.*\"/></xs:restriction>\n"
    "  </xs:simpleType>\n"
    "  <xs:simpleType name=\"number\">\n"
    "    <xs:annotation><xs:documentation>45, 80..30, 45 ~ 5, 80..30 ~ 5 : t^2, "
    "= 3 + 2*i, keys 0,10 5,80, 45 | parent dome</xs:documentation></xs:annotation>\n"
    "    <xs:restriction base=\"xs:token\"><xs:pattern value=\"=.*|keys .*|" REAL "( ?\\.\\. ?" REAL
    ")?( ?~ ?" REAL ")?( ?[:|].*)?\"/></xs:restriction>\n"
    "  </xs:simpleType>\n"
    "  <xs:simpleType name=\"switch\">\n"
    "    <xs:restriction base=\"xs:token\"><xs:pattern value=\"yes|no|=.*\"/></xs:restriction>\n"
    "  </xs:simpleType>\n"
    "  <xs:simpleType name=\"points\">\n"
    "    <xs:restriction base=\"xs:token\"><xs:pattern value=\"(" REAL " ?, ?" REAL "( " REAL
    " ?, ?" REAL ")*)?|=.*\"/></xs:restriction>\n"
    "  </xs:simpleType>\n"
    "  <xs:simpleType name=\"vector\">\n"
    "    <xs:restriction base=\"xs:token\"><xs:pattern value=\"" REAL "( ?, ?" REAL " ?, ?" REAL
    ")?|=.*\"/></xs:restriction>\n"
    "  </xs:simpleType>\n"
    "  <xs:simpleType name=\"colour\">\n"
    "    <xs:restriction base=\"xs:token\"><xs:pattern value=\"#[0-9a-fA-F]{6}|=.*\"/>"
    "</xs:restriction>\n"
    "  </xs:simpleType>\n";

/// Appends formatted text whose string arguments are escaped.
#define APPEND(out, ...)                                                                           \
    do {                                                                                           \
        char *escaped = g_markup_printf_escaped(__VA_ARGS__);                                      \
        g_string_append(out, escaped);                                                             \
        g_free(escaped);                                                                           \
    } while (0)

static const char *type_name(FrParamKind kind) {
    static const char *const names[] = {
        [FR_PARAM_NUMBER] = "number",      [FR_PARAM_REAL] = "real",
        [FR_PARAM_INTEGER] = "xs:integer", [FR_PARAM_SWITCH] = "switch",
        [FR_PARAM_CHOICE] = "xs:token",    [FR_PARAM_TEXT] = "xs:string",
        [FR_PARAM_CURVE] = "xs:string",    [FR_PARAM_POINTS] = "points",
        [FR_PARAM_VECTOR] = "vector",      [FR_PARAM_COLOUR] = "colour",
        [FR_PARAM_FORMULA] = "xs:string",
    };
    return names[kind];
}

static void append_bound(GString *out, const char *facet, double value) {
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    APPEND(out, "<xs:%s value=\"%s\"/>", facet,
           g_ascii_formatd(number, sizeof number, "%.17g", value));
}

/// The type of one attribute where a named type does not say all.
static void append_own_type(GString *out, const FrParam *row) {
    bool is_choice = row->kind == FR_PARAM_CHOICE;
    g_string_append(out, "      <xs:simpleType>");
    g_string_append(out, "<xs:union memberTypes=\"fixed\"><xs:simpleType>");
    APPEND(out, "<xs:restriction base=\"%s\">", type_name(row->kind));
    if (is_choice) {
        char **choices = g_strsplit(row->choices, " ", -1);
        for (char **choice = choices; *choice != NULL; choice++) {
            APPEND(out, "<xs:enumeration value=\"%s\"/>", *choice);
        }
        g_strfreev(choices);
    } else {
        append_bound(out, "minInclusive", row->min);
        append_bound(out, "maxInclusive", row->max);
    }
    g_string_append(out, "</xs:restriction>");
    g_string_append(out, "</xs:simpleType></xs:union>");
    g_string_append(out, "</xs:simpleType>\n");
}

static void append_attribute(GString *out, const FrParam *row, const FrElement *element) {
    char *name = fr_param_attribute(row);
    // Sliders that choose have names for their values.
    bool may_be_named = strcmp(element->name, "slider") == 0 &&
                        (strcmp(name, "value") == 0 || strcmp(name, "initial") == 0);
    bool has_own_type =
        !may_be_named && (row->kind == FR_PARAM_CHOICE || row->kind == FR_PARAM_REAL ||
                          row->kind == FR_PARAM_INTEGER);
    APPEND(out, "    <xs:attribute name=\"%s\"", name);
    if (!has_own_type) {
        APPEND(out, " type=\"%s\"", may_be_named ? "xs:token" : type_name(row->kind));
    }
    if (fr_element_requires(element, name)) {
        g_string_append(out, " use=\"required\"");
    } else if (*row->default_text != '\0') {
        APPEND(out, " default=\"%s\"", row->default_text);
    }
    APPEND(out,
           ">\n      <xs:annotation><xs:documentation>%s%s%s</xs:documentation>"
           "</xs:annotation>\n",
           row->meaning, *row->unit == '\0' ? "" : ", ", row->unit);
    if (has_own_type) {
        append_own_type(out, row);
    }
    g_string_append(out, "    </xs:attribute>\n");
    g_free(name);
}

static void append_children(GString *out, const FrElement *element) {
    g_string_append(out, "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n");
    for (FrElementId id = 0; id < FR_ELEMENT_COUNT; id++) {
        if ((element->children >> id & 1) != 0) {
            APPEND(out, "      <xs:element ref=\"%s\"/>\n", fr_element(id).name);
        }
    }
    g_string_append(out, "    </xs:choice>\n");
}

/// Ids that must differ, and attributes that must name one of them.
static void append_keys(GString *out, FrElementId id) {
    if (id == FR_ELEMENT_FROND) {
        g_string_append(
            out, "    <xs:key name=\"plants\"><xs:selector xpath=\"plant\"/>"
                 "<xs:field xpath=\"@id\"/></xs:key>\n"
                 "    <xs:key name=\"materials\"><xs:selector xpath=\"material\"/>"
                 "<xs:field xpath=\"@id\"/></xs:key>\n"
                 "    <xs:key name=\"names\"><xs:selector xpath=\"curve|function\"/>"
                 "<xs:field xpath=\"@id\"/></xs:key>\n"
                 "    <xs:key name=\"views\"><xs:selector xpath=\"scene/view\"/>"
                 "<xs:field xpath=\"@name\"/></xs:key>\n"
                 "    <xs:keyref name=\"placed\" refer=\"plants\">"
                 "<xs:selector xpath=\"scene/place\"/><xs:field xpath=\"@plant\"/></xs:keyref>\n"
                 "    <xs:keyref name=\"varied\" refer=\"plants\">"
                 "<xs:selector xpath=\"plant/vary\"/><xs:field xpath=\"@base\"/></xs:keyref>\n");
    } else if (id == FR_ELEMENT_PGRAPH) {
        g_string_append(out, "    <xs:key name=\"components\"><xs:selector xpath=\"");
        for (int i = 0; i < FR_COMPONENT_COUNT; i++) {
            APPEND(out, "%s%s", i == 0 ? "" : "|",
                   fr_element((FrElementId)(FR_ELEMENT_COMPONENT + i)).name);
        }
        g_string_append(out, "\"/><xs:field xpath=\"@id\"/></xs:key>\n"
                             "    <xs:keyref name=\"linked-from\" refer=\"components\">"
                             "<xs:selector xpath=\"link\"/><xs:field xpath=\"@from\"/>"
                             "</xs:keyref>\n"
                             "    <xs:keyref name=\"linked-to\" refer=\"components\">"
                             "<xs:selector xpath=\"link\"/><xs:field xpath=\"@to\"/>"
                             "</xs:keyref>\n");
    }
}

static void append_element(GString *out, FrElementId id) {
    FrElement element = fr_element(id);
    APPEND(out,
           "  <xs:element name=\"%s\">\n    <xs:annotation><xs:documentation>%s"
           "</xs:documentation></xs:annotation>\n",
           element.name, element.meaning);
    g_string_append_printf(out, "    <xs:complexType%s>\n",
                           element.has_text ? " mixed=\"true\"" : "");
    if (element.children != 0) {
        append_children(out, &element);
    }
    if (element.has_id) {
        g_string_append(out, "    <xs:attribute name=\"id\" type=\"id\" use=\"required\"/>\n");
    }
    for (size_t i = 0; element.table != NULL && i < element.table->count; i++) {
        append_attribute(out, &element.table->rows[i], &element);
    }
    g_string_append(out, "    </xs:complexType>\n");
    append_keys(out, id);
    g_string_append(out, "  </xs:element>\n");
}

char *fr_document_schema(void) {
    GString *out = g_string_new(head);
    g_string_append(out, types);
    for (FrElementId id = 0; id < FR_ELEMENT_COUNT; id++) {
        append_element(out, id);
    }
    g_string_append(out, "</xs:schema>\n");
    return g_string_free(out, FALSE);
}
