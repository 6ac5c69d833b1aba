/// @file tree.h
/// A document's text as a tree of places in it. Nothing is copied: an element, an attribute, a
/// comment is a range of the source's bytes, and the bytes themselves are what is saved.
#pragma once

#include "frond/context.h"

typedef enum FrXmlKind {
    FR_XML_ELEMENT,
    FR_XML_TEXT,
    FR_XML_CDATA,
    FR_XML_COMMENT,
    FR_XML_INSTRUCTION, ///< also the XML declaration
} FrXmlKind;

/// Bytes [begin, end) of the source.
typedef struct FrXmlRange {
    uint32_t begin, end;
} FrXmlRange;

typedef struct FrXmlNode {
    FrXmlKind kind;
    uint32_t parent, next, first; ///< node indices, FR_NONE
    FrXmlRange all;               ///< with its tags and delimiters
    FrXmlRange name;              ///< elements: the tag's name; others: their content
    uint32_t attribute;           ///< index of the first
    uint32_t attribute_count;
} FrXmlNode;

typedef struct FrXmlAttribute {
    FrXmlRange name;
    FrXmlRange value; ///< within the quotes
} FrXmlAttribute;

typedef struct FrXmlTree {
    FrSource *source;
    FrXmlNode *nodes; ///< in document order
    uint32_t node_count;
    FrXmlAttribute *attributes;
    uint32_t attribute_count;
    uint32_t root; ///< the root element's node
} FrXmlTree;

/// Reads UTF-8 without document type. Whatever is wrong gives a diagnostic with its place and a
/// NULL tree; the limits document_bytes, elements and nesting hold.
FR_MUST_USE FrStatus fr_xml_read(FrSource *source, const FrContext *context, FrXmlTree **tree);
void fr_xml_free(FrXmlTree *tree);

/// Splits the text at its markup. For FR_ERR_DOCUMENT *stop is where the text is not well-formed,
/// without a diagnostic, or FR_NONE with one.
FR_MUST_USE FrStatus fr_xml_scan(FrXmlTree *tree, const FrContext *context, uint32_t *stop);
/// UTF-8 throughout and declared as such, no NUL, no document type.
FR_MUST_USE FrStatus fr_xml_check_encoding(FrSource *source, FrDiags *diags);
/// Has libxml2 judge the text; a diagnostic if it is not well-formed.
FR_MUST_USE FrStatus fr_xml_check_well_formed(FrSource *source, FrDiags *diags);

FrSpan fr_xml_span(const FrXmlTree *tree, FrXmlRange range);
bool fr_xml_equals(const FrXmlTree *tree, FrXmlRange range, const char *text);
/// A copy of a name, shortened where it is too long to print. Free with g_free().
char *fr_xml_name(const FrXmlTree *tree, FrXmlRange range);
/// What a value or text means: references resolved, in values white space made blanks. Free with
/// g_free(). Without references every byte keeps its offset.
char *fr_xml_decode(const FrXmlTree *tree, FrXmlRange range, bool is_value);
/// Appends what a text means to `out` and where each byte of that stands to `origins` (uint32_t).
void fr_xml_decode_text(const FrXmlTree *tree, FrXmlRange range, GString *out, GArray *origins);
/// The attribute of that name, or NULL.
const FrXmlAttribute *fr_xml_attribute(const FrXmlTree *tree, uint32_t node, const char *name);
/// The next element among `node` and its later siblings, FR_NONE if there is none.
uint32_t fr_xml_element_from(const FrXmlTree *tree, uint32_t node);
