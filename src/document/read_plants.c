/// `<plant>`: an id, a seed, and one engine's definition within.
#include "document/reader.h"

static FrPlantDef *read_plant(FrReader *reader, uint32_t node, char *id) {
    FrPlantParams params;
    const FrParamTable *table = fr_element(FR_ELEMENT_PLANT).table;
    fr_params_init(table, &params);
    fr_read_attributes(reader, node, FR_ELEMENT_PLANT, &params);
    FrPlantDef *plant = g_new0(FrPlantDef, 1);
    *plant = (FrPlantDef){.id = id,
                          .seed = (uint64_t)params.seed,
                          .kind = FR_PLANT_PGRAPH,
                          .span = fr_xml_span(reader->tree, reader->tree->nodes[node].name)};
    fr_params_clear(table, &params);

    FrScope *scope = fr_scope_new_within(reader->document->scope);
    plant->sliders = fr_read_sliders(reader, node, scope);
    reader->scope = scope;
    plant->pgraph = fr_pgraph_new(id, plant->seed);
    uint32_t graph = fr_read_first(reader, node, FR_ELEMENT_PGRAPH);
    uint32_t vary = fr_read_first(reader, node, FR_ELEMENT_VARY);
    if (graph == FR_NONE && vary == FR_NONE) {
        fr_read_error(reader, "missing-element", reader->tree->nodes[node].name,
                      "the plant '%s' has no <pgraph> and no <vary>", id);
    } else if (graph != FR_NONE && vary != FR_NONE) {
        fr_read_error(reader, "two-definitions", reader->tree->nodes[vary].name,
                      "the plant '%s' is a <pgraph> already", id);
    } else if (vary != FR_NONE) {
        plant->kind = FR_PLANT_VARIED;
        if (plant->sliders->len > 0) {
            fr_read_error(reader, "misplaced-element", reader->tree->nodes[vary].name,
                          "the sliders of a varied plant are those of the plant it is made from");
        }
        plant->vary = fr_read_vary(reader, vary);
    } else {
        fr_read_pgraph(reader, graph, plant->pgraph);
        fr_read_check_sliders(reader, node, plant->pgraph);
    }
    reader->scope = reader->document->scope;
    fr_scope_free(scope);
    return plant;
}

/// The `<plant>` whose name stands at a place of the text.
static uint32_t find_node(const FrXmlTree *tree, uint32_t begin) {
    uint32_t node = fr_xml_element_from(tree, tree->nodes[tree->root].first);
    while (node != FR_NONE && tree->nodes[node].name.begin != begin) {
        node = fr_xml_element_from(tree, tree->nodes[node].next);
    }
    return node;
}

FrPgraph *fr_document_reseed(const FrDocument *document, const FrPlantDef *plant, uint64_t seed) {
    // Reading a graph changes nothing in the document.
    FrReader reader;
    fr_reader_open(&reader, (FrDocument *)document, NULL);
    for (guint i = 0; i < document->materials->len; i++) {
        FrMaterial *material = g_ptr_array_index(document->materials, i);
        g_hash_table_insert(reader.material_ids, g_strdup(fr_material_name(material)), material);
    }
    FrScope *scope = fr_scope_new_within(document->scope);
    for (guint i = 0; i < plant->sliders->len; i++) {
        const FrSlider *slider = g_ptr_array_index(plant->sliders, i);
        fr_scope_add_value(scope, slider->id, slider->value);
    }
    reader.scope = scope;
    FrPgraph *graph = fr_pgraph_new(plant->id, seed);
    uint32_t node = find_node(document->tree, plant->span.begin);
    FR_ASSERT(node != FR_NONE);
    uint32_t definition = fr_read_first(&reader, node, FR_ELEMENT_PGRAPH);
    if (definition != FR_NONE) {
        fr_read_pgraph(&reader, definition, graph);
    }
    fr_reader_close(&reader);
    fr_scope_free(scope);
    return graph;
}

void fr_read_plants(FrReader *reader, uint32_t parent) {
    for (uint32_t node = fr_read_first(reader, parent, FR_ELEMENT_PLANT); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_PLANT)) {
        fr_read_check_children(reader, node, FR_ELEMENT_PLANT);
        char *id = fr_read_id(reader, node);
        if (id != NULL) {
            FrPlantDef *plant = read_plant(reader, node, id);
            g_ptr_array_add(reader->document->plants, plant);
            if (!g_hash_table_insert(reader->plant_ids, g_strdup(plant->id), plant)) {
                fr_read_error(reader, "duplicate-id", fr_read_value_place(reader, node, "id"),
                              "there is a plant '%s' already", id);
            }
        }
    }
    fr_read_check_bases(reader);
}
