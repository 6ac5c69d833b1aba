/// `<curve>` and `<function>`: the names that numbers and expressions may use. They are read
/// first and in their order, so a function may use what stands before it.
#include "document/reader.h"

#include <string.h>

static void report_taken(FrReader *reader, uint32_t node, const char *id) {
    fr_read_error(reader, "duplicate-id", fr_read_value_place(reader, node, "id"),
                  "there is a curve or function '%s' already", id);
}

static void read_curve(FrReader *reader, uint32_t node, const char *id) {
    FrCurveParams params;
    const FrParamTable *table = fr_element(FR_ELEMENT_CURVE).table;
    fr_params_init(table, &params);
    size_t errors = fr_diags_error_count(reader->diags);
    fr_read_attributes(reader, node, FR_ELEMENT_CURVE, &params);
    FrCurve *curve = fr_curve_new((FrCurveKind)params.kind, (const double(*)[2])params.points.at,
                                  params.points.count);
    if (curve == NULL) {
        if (errors == fr_diags_error_count(reader->diags)) {
            fr_read_error(reader, "bad-curve", fr_read_value_place(reader, node, "points"),
                          "the points of a curve need rising x");
        }
    } else if (!fr_scope_add_curve(reader->document->scope, id, curve)) {
        report_taken(reader, node, id);
    }
    fr_curve_unref(curve);
    fr_params_clear(table, &params);
}

char *fr_read_text(const FrReader *reader, uint32_t node, FrXmlRange *place) {
    GString *text = g_string_new(NULL);
    *place = reader->tree->nodes[node].name;
    bool is_first = true;
    for (uint32_t i = reader->tree->nodes[node].first; i != FR_NONE;
         i = reader->tree->nodes[i].next) {
        const FrXmlNode *child = &reader->tree->nodes[i];
        if (child->kind == FR_XML_TEXT) {
            char *part = fr_xml_decode(reader->tree, child->name, false);
            g_string_append(text, part);
            g_free(part);
        } else if (child->kind == FR_XML_CDATA) {
            g_string_append_len(text,
                                fr_source_text(reader->tree->source, NULL) + child->name.begin,
                                child->name.end - child->name.begin);
        } else {
            continue;
        }
        place->begin = is_first ? child->name.begin : place->begin;
        place->end = child->name.end;
        is_first = false;
    }
    return g_string_free(text, FALSE);
}

static void read_function(FrReader *reader, uint32_t node, const char *id) {
    FrFunctionParams params;
    const FrParamTable *table = fr_element(FR_ELEMENT_FUNCTION).table;
    fr_params_init(table, &params);
    fr_read_attributes(reader, node, FR_ELEMENT_FUNCTION, &params);
    FrXmlRange place;
    char *body = fr_read_text(reader, node, &place);
    fr_read_note(reader,
                 fr_scope_add_function(reader->document->scope, id,
                                       params.parameters == NULL ? "" : params.parameters, body,
                                       fr_xml_span(reader->tree, place), reader->diags));
    g_free(body);
    fr_params_clear(table, &params);
}

void fr_read_curves(FrReader *reader, uint32_t parent) {
    const FrXmlTree *tree = reader->tree;
    for (uint32_t node = fr_xml_element_from(tree, tree->nodes[parent].first); node != FR_NONE;
         node = fr_xml_element_from(tree, tree->nodes[node].next)) {
        bool is_curve = fr_xml_equals(tree, tree->nodes[node].name, "curve");
        if (!is_curve && !fr_xml_equals(tree, tree->nodes[node].name, "function")) {
            continue;
        }
        fr_read_check_children(reader, node, is_curve ? FR_ELEMENT_CURVE : FR_ELEMENT_FUNCTION);
        char *id = fr_read_id(reader, node);
        if (id != NULL && is_curve) {
            read_curve(reader, node, id);
        } else if (id != NULL) {
            read_function(reader, node, id);
        }
        g_free(id);
    }
}
