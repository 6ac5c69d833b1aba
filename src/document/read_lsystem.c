/// `<lsystem>`: an L-system as text, or in a file beside the document, and the numbers it is given.
#include "document/reader.h"

#include <string.h>

FrSource *fr_read_source(const FrReader *reader, uint32_t node) {
    const FrXmlTree *tree = reader->tree;
    GString *text = g_string_new(NULL);
    GArray *origins = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    uint32_t end = tree->nodes[node].name.end;
    for (uint32_t i = tree->nodes[node].first; i != FR_NONE; i = tree->nodes[i].next) {
        const FrXmlNode *child = &tree->nodes[i];
        if (child->kind == FR_XML_TEXT) {
            fr_xml_decode_text(tree, child->name, text, origins);
        } else if (child->kind == FR_XML_CDATA) {
            g_string_append_len(text, fr_source_text(tree->source, NULL) + child->name.begin,
                                child->name.end - child->name.begin);
            for (uint32_t at = child->name.begin; at < child->name.end; at++) {
                g_array_append_val(origins, at);
            }
        } else {
            continue;
        }
        end = child->name.end;
    }
    g_array_append_val(origins, end);
    bool is_blank = text->str[strspn(text->str, " \t\r\n")] == '\0';
    FrSource *source = is_blank ? NULL
                                : fr_source_within(tree->source, text->str, text->len,
                                                   (const uint32_t *)(const void *)origins->data);
    g_array_unref(origins);
    g_string_free(text, TRUE);
    return source;
}

char *fr_read_define(FrReader *reader, uint32_t node, FrNumber *value) {
    const FrParamTable *table = fr_element(FR_ELEMENT_DEFINE).table;
    fr_read_check_children(reader, node, FR_ELEMENT_DEFINE);
    FrDefineParams params;
    fr_params_init(table, &params);
    fr_read_attributes(reader, node, FR_ELEMENT_DEFINE, &params);
    *value = fr_number_copy(&params.value);
    fr_params_clear(table, &params);
    return fr_read_id(reader, node);
}

static void read_define(FrReader *reader, uint32_t node, FrLmodel *model) {
    FrNumber value;
    char *id = fr_read_define(reader, node, &value);
    FrXmlRange place = fr_read_value_place(reader, node, "id");
    if (id != NULL && !fr_lmodel_define(model, id, &value, fr_xml_span(reader->tree, place))) {
        bool is_taken = fr_lmodel_find_value(model, id) != FR_NONE;
        fr_read_error(reader, is_taken ? "duplicate-id" : "bad-id", place,
                      is_taken ? "there is a number '%s' already"
                               : "'%s' is no name in an L-system: letters, digits and '_'",
                      id);
    }
    fr_number_clear(&value);
    g_free(id);
}

/// The materials of colours, by the names of an attribute.
static void read_colours(FrReader *reader, uint32_t node, const char *text, FrLmodel *model) {
    enum { COLOURS = 255 };
    FrMaterial *materials[COLOURS];
    size_t count = 0;
    char **names = g_strsplit_set(text == NULL ? "" : text, " \t\r\n", -1);
    for (char **name = names; *name != NULL; name++) {
        if (**name == '\0') {
            continue;
        }
        FrMaterial *material = fr_read_material(reader, node, "colours", *name);
        if (count == COLOURS) {
            fr_read_error(reader, "too-many-colours", fr_read_value_place(reader, node, "colours"),
                          "there are at most %d colours", COLOURS);
            break;
        }
        if (material != NULL) {
            materials[count++] = material;
        }
    }
    g_strfreev(names);
    fr_lmodel_set_colours(model, materials, count);
}

FrSource *fr_read_own_source(FrReader *reader, uint32_t node, const char *file) {
    FrSource *text = fr_read_source(reader, node);
    FrXmlRange name = reader->tree->nodes[node].name;
    if (text == NULL && file == NULL) {
        fr_read_error(reader, "missing-text", name, "this <%.*s> has neither a text nor a file",
                      (int)(name.end - name.begin),
                      fr_source_text(reader->tree->source, NULL) + name.begin);
    } else if (text != NULL && file != NULL) {
        fr_read_error(reader, "two-definitions", fr_read_value_place(reader, node, "file"),
                      "this <%.*s> has a text already", (int)(name.end - name.begin),
                      fr_source_text(reader->tree->source, NULL) + name.begin);
    }
    return text;
}

FrLmodel *fr_read_lsystem(FrReader *reader, uint32_t node) {
    FrStatus before = reader->status;
    reader->status = FR_OK;
    fr_read_check_children(reader, node, FR_ELEMENT_LSYSTEM);
    FrLsystemParams params;
    fr_params_init(fr_lsystem_table(), &params);
    fr_read_attributes(reader, node, FR_ELEMENT_LSYSTEM, &params);
    FrLmodel *model = fr_lmodel_new(&params);
    for (uint32_t child = fr_read_first(reader, node, FR_ELEMENT_DEFINE); child != FR_NONE;
         child = fr_read_next(reader, child, FR_ELEMENT_DEFINE)) {
        read_define(reader, child, model);
    }
    fr_lmodel_set_materials(model, fr_read_material(reader, node, "material", params.material),
                            fr_read_material(reader, node, "leaf-material", params.leaf_material));
    read_colours(reader, node, params.colours, model);
    FrSource *text = fr_read_own_source(reader, node, params.file);
    if (reader->status == FR_OK) {
        FrXmlRange place = fr_read_value_place(reader, node, "file");
        fr_read_note(reader, fr_lmodel_compile(model, text, reader->document->folder,
                                               fr_xml_span(reader->tree, place), reader->context));
    }
    fr_source_unref(text);
    fr_params_clear(fr_lsystem_table(), &params);
    fr_read_note(reader, before);
    return model;
}
