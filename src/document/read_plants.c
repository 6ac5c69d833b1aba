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

    plant->pgraph = fr_pgraph_new(id, plant->seed);
    uint32_t graph = fr_read_first(reader, node, FR_ELEMENT_PGRAPH);
    if (graph == FR_NONE) {
        fr_read_error(reader, "missing-element", reader->tree->nodes[node].name,
                      "the plant '%s' has no <pgraph>", id);
    } else {
        fr_read_pgraph(reader, graph, plant->pgraph);
    }
    return plant;
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
}
