/// `<pgraph>`: components by their element's name, and the links between them.
#include "document/reader.h"

#include "material/mesh_file.h"
#include "pgraph/params.h"
#include "skin/section.h"

#include <string.h>

typedef struct GraphReader {
    FrReader *reader;
    FrPgraph *graph;
    GHashTable *components; ///< id → index + 1
    GHashTable *materials;  ///< set of the FrMaterial * that the graph knows
} GraphReader;

FrMaterial *fr_read_material(FrReader *reader, uint32_t node, const char *attribute,
                             const char *id) {
    if (id == NULL || *id == '\0') {
        return NULL;
    }
    FrMaterial *material = g_hash_table_lookup(reader->material_ids, id);
    if (material != NULL) {
        return material;
    }
    const GPtrArray *materials = reader->document->materials;
    uint32_t count = fr_read_candidates(materials->len);
    const char **names = g_new(const char *, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        names[i] = fr_material_name(g_ptr_array_index(materials, i));
    }
    char *hint = fr_read_hint(reader, id, names, count);
    fr_read_error(reader, "unknown-material", fr_read_value_place(reader, node, attribute),
                  "there is no material '%.64s'%s", id, hint);
    g_free(hint);
    g_free(names);
    return NULL;
}

/// Hands the graph the materials that a component names.
static void add_materials(GraphReader *graph, uint32_t node, const FrParamTable *table,
                          const void *params) {
    FrReader *reader = graph->reader;
    for (size_t i = 0; i < table->count; i++) {
        const FrParam *row = &table->rows[i];
        if (row->kind != FR_PARAM_TEXT || !g_str_has_suffix(row->name, "material")) {
            continue;
        }
        const char *id = *(char *const *)(const void *)((const char *)params + row->offset);
        char *attribute = fr_param_attribute(row);
        FrMaterial *material = fr_read_material(reader, node, attribute, id);
        g_free(attribute);
        if (material != NULL && g_hash_table_add(graph->materials, material)) {
            fr_pgraph_add_material(graph->graph, material);
        }
    }
}

/// The numbers that a graft gives its plant.
static void read_defines(GraphReader *graph, uint32_t node, uint32_t component) {
    FrReader *reader = graph->reader;
    for (uint32_t child = fr_read_first(reader, node, FR_ELEMENT_DEFINE); child != FR_NONE;
         child = fr_read_next(reader, child, FR_ELEMENT_DEFINE)) {
        FrNumber value;
        char *id = fr_read_define(reader, child, &value);
        if (id != NULL && !fr_pgraph_define(graph->graph, component, id, &value)) {
            fr_read_error(reader, "duplicate-id", fr_read_value_place(reader, child, "id"),
                          "there is a number '%s' already", id);
        }
        fr_number_clear(&value);
        g_free(id);
    }
}

static bool is_file(const FrParam *row) {
    return row->kind == FR_PARAM_TEXT &&
           (strcmp(row->name, "file") == 0 || g_str_has_suffix(row->name, "_file"));
}

static void check_mesh_name(FrReader *reader, FrXmlRange place, const char *name) {
    bool is_named = name != NULL && *name != '\0';
    if (is_named && !fr_mesh_name_check(name, fr_xml_span(reader->tree, place), reader->diags)) {
        fr_read_note(reader, FR_ERR_DOCUMENT);
    }
}

/// The files that a component names must be there, and of triangles where it reads triangles.
static void check_files(FrReader *reader, uint32_t node, const FrParamTable *table,
                        const void *params) {
    for (size_t i = 0; i < table->count; i++) {
        const FrParam *row = &table->rows[i];
        if (is_file(row)) {
            char *attribute = fr_param_attribute(row);
            const char *name = *(char *const *)(const void *)((const char *)params + row->offset);
            size_t errors = fr_diags_error_count(reader->diags);
            fr_read_check_file(reader, node, attribute, name);
            bool is_there = fr_diags_error_count(reader->diags) == errors;
            if (is_there && strcmp(row->name, "file") == 0) {
                check_mesh_name(reader, fr_read_value_place(reader, node, attribute), name);
            }
            g_free(attribute);
        }
    }
}

static char *why_unread(const void *params, const FrParam *row, const void *kind) {
    return fr_pgraph_why_unread(*(const FrComponentKind *)kind, params, row);
}

/// What the cross-section of a stem or simple component is, if it is read.
static bool find_section(FrComponentKind kind, const void *params, FrProfile *section) {
    const FrStemParams *stem = params;
    const FrSimpleParams *simple = params;
    bool is_stem = kind == FR_COMPONENT_HORN || kind == FR_COMPONENT_TREE;
    if (!is_stem && kind != FR_COMPONENT_SIMPLE) {
        return false;
    }
    const FrPoints *points = is_stem ? &stem->section : &simple->section;
    int primitive = (int)(is_stem ? stem->primitive : simple->primitive);
    *section = (FrProfile){points->at, (uint32_t)points->count, primitive == FR_PRIMITIVE_TUBE};
    return points->count > 0 && primitive <= FR_PRIMITIVE_AREA;
}

static void check_section(FrReader *reader, uint32_t node, FrComponentKind kind,
                          const void *params) {
    FrProfile section;
    FrSectionFault fault = reader->diags != NULL && find_section(kind, params, &section)
                               ? fr_section_fault(&section)
                               : FR_SECTION_SOUND;
    if (fault == FR_SECTION_SOUND) {
        return;
    }
    FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "section"));
    if (fault == FR_SECTION_FEW) {
        fr_diags_add(reader->diags, FR_WARNING, "bad-section", span,
                     "this section is not used: it needs %d points that differ, no farther from "
                     "the middle than %d",
                     section.is_closed ? 3 : 2, FR_SECTION_FARTHEST);
    } else if (fault == FR_SECTION_FAR) {
        fr_diags_add(reader->diags, FR_WARNING, "bad-section", span,
                     "points of this section that are farther from the middle than %d are left out",
                     FR_SECTION_FARTHEST);
    } else {
        fr_diags_add(reader->diags, FR_WARNING, "bad-section", span,
                     "this section crosses, touches or runs back over itself, so what is made of "
                     "it is no sound solid; CAD programs refuse it");
    }
}

static void read_component(GraphReader *graph, uint32_t node, FrElementId element) {
    FrReader *reader = graph->reader;
    fr_read_check_children(reader, node, element);
    char *id = fr_read_id(reader, node);
    if (id == NULL) {
        return;
    }
    FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "id"));
    uint32_t component = fr_pgraph_add(
        graph->graph, (FrComponentKind)(element - FR_ELEMENT_COMPONENT), id, span, reader->diags);
    if (component == FR_NONE) {
        g_free(id);
        fr_read_note(reader, FR_ERR_DOCUMENT);
        return;
    }
    g_hash_table_insert(graph->components, id, GUINT_TO_POINTER(component + 1));
    void *params = fr_pgraph_params(graph->graph, component);
    FrStatus before = reader->status;
    reader->status = FR_OK;
    fr_read_attributes(reader, node, element, params);
    if (reader->status == FR_OK) {
        FrComponentKind kind = (FrComponentKind)(element - FR_ELEMENT_COMPONENT);
        fr_read_check_effects(reader, node, element, params, why_unread, &kind);
        check_section(reader, node, kind, params);
    }
    fr_read_note(reader, before);
    add_materials(graph, node, fr_element(element).table, params);
    if (element == FR_ELEMENT_COMPONENT + FR_COMPONENT_GRAFT) {
        read_defines(graph, node, component);
    }
    check_files(reader, node, fr_element(element).table, params);
}

/// The component an attribute of a link names, FR_NONE with an error.
static uint32_t find_component(GraphReader *graph, uint32_t node, const char *attribute,
                               const char *id) {
    if (id == NULL) {
        return FR_NONE; // reported as missing
    }
    uint32_t found = GPOINTER_TO_UINT(g_hash_table_lookup(graph->components, id));
    if (found != 0) {
        return found - 1;
    }
    uint32_t count = fr_read_candidates(fr_pgraph_count(graph->graph));
    const char **names = g_new(const char *, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        names[i] = fr_pgraph_id(graph->graph, i);
    }
    char *hint = fr_read_hint(graph->reader, id, names, count);
    fr_read_error(graph->reader, "unknown-component",
                  fr_read_value_place(graph->reader, node, attribute),
                  "there is no component '%.64s' in this graph%s", id, hint);
    g_free(hint);
    g_free(names);
    return FR_NONE;
}

static void read_link(GraphReader *graph, uint32_t node) {
    FrReader *reader = graph->reader;
    fr_read_check_children(reader, node, FR_ELEMENT_LINK);
    const FrParamTable *table = fr_element(FR_ELEMENT_LINK).table;
    FrLinkParams params;
    fr_params_init(table, &params);
    fr_read_attributes(reader, node, FR_ELEMENT_LINK, &params);
    uint32_t from = find_component(graph, node, "from", params.from);
    uint32_t to = find_component(graph, node, "to", params.to);
    if (from != FR_NONE && to != FR_NONE) {
        FrSpan span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
        FrXmlRange symbol = fr_read_value_place(reader, node, "symbol");
        if (params.symbol != NULL && strlen(params.symbol) != 1) {
            fr_read_error(reader, "wrong-symbol", symbol, "a symbol is one letter or digit");
        } else if (params.symbol != NULL) {
            fr_read_note(reader,
                         fr_pgraph_link_symbol(graph->graph, from, to, *params.symbol,
                                               fr_xml_span(reader->tree, symbol), reader->diags));
        } else {
            fr_read_note(reader, fr_pgraph_link(graph->graph, from, to, (FrLinkKind)params.kind,
                                                span, reader->diags));
        }
    }
    fr_params_clear(table, &params);
}

static void read_parts(GraphReader *graph, uint32_t parent) {
    const FrXmlTree *tree = graph->reader->tree;
    for (uint32_t node = fr_xml_element_from(tree, tree->nodes[parent].first); node != FR_NONE;
         node = fr_xml_element_from(tree, tree->nodes[node].next)) {
        char *name = fr_xml_name(tree, tree->nodes[node].name);
        FrElementId element = fr_element_find(name);
        g_free(name);
        if (element >= FR_ELEMENT_COMPONENT && element < FR_ELEMENT_COUNT) {
            read_component(graph, node, element);
        }
    }
    for (uint32_t node = fr_read_first(graph->reader, parent, FR_ELEMENT_LINK); node != FR_NONE;
         node = fr_read_next(graph->reader, node, FR_ELEMENT_LINK)) {
        read_link(graph, node);
    }
}

void fr_read_pgraph(FrReader *reader, uint32_t node, FrPgraph *definition) {
    GraphReader graph = {
        .reader = reader,
        .graph = definition,
        .components = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
        .materials = g_hash_table_new(NULL, NULL),
    };
    FrStatus before = reader->status;
    reader->status = FR_OK;
    fr_pgraph_set_folder(definition, reader->document->folder);
    fr_read_check_children(reader, node, FR_ELEMENT_PGRAPH);
    read_parts(&graph, node);
    fr_read_edits(reader, reader->tree->nodes[node].parent, definition);
    if (reader->status == FR_OK && fr_pgraph_count(definition) == 0) {
        fr_read_error(reader, "no-component", reader->tree->nodes[node].name,
                      "this <pgraph> has no component, so its plant is empty");
    }
    // What is wrong as a whole may only follow from what was reported already.
    if (reader->status == FR_OK) {
        fr_read_note(reader, fr_pgraph_check(definition, reader->diags));
    }
    fr_read_note(reader, before);
    g_hash_table_unref(graph.components);
    g_hash_table_unref(graph.materials);
}
