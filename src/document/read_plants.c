/// `<plant>`: an id, a seed, and one engine's definition within.
#include "document/reader.h"

#include <math.h>

/// The one engine's definition of a plant.
static void read_definition(FrReader *reader, uint32_t node, FrPlantDef *plant) {
    static const struct {
        FrElementId element;
        FrPlantKind kind;
    } engines[] = {{FR_ELEMENT_PGRAPH, FR_PLANT_PGRAPH},     {FR_ELEMENT_LSYSTEM, FR_PLANT_LSYSTEM},
                   {FR_ELEMENT_SKELETON, FR_PLANT_SKELETON}, {FR_ELEMENT_SPECIES, FR_PLANT_SPECIES},
                   {FR_ELEMENT_RAMIFIED, FR_PLANT_RAMIFIED}, {FR_ELEMENT_VARY, FR_PLANT_VARIED}};
    uint32_t definition = FR_NONE;
    const char *first = NULL;
    for (size_t i = 0; i < G_N_ELEMENTS(engines); i++) {
        uint32_t found = fr_read_first(reader, node, engines[i].element);
        if (found != FR_NONE && definition != FR_NONE) {
            fr_read_error(reader, "two-definitions", reader->tree->nodes[found].name,
                          "the plant '%s' has a <%s> already", plant->id, first);
        } else if (found != FR_NONE) {
            definition = found;
            first = fr_element(engines[i].element).name;
            plant->kind = engines[i].kind;
        }
    }
    uint32_t edits = fr_read_first(reader, node, FR_ELEMENT_EDITS);
    if (edits != FR_NONE && plant->kind != FR_PLANT_PGRAPH) {
        fr_read_error(reader, "misplaced-element", reader->tree->nodes[edits].name,
                      "only plants of a <pgraph> have <edits>");
    }
    if (definition == FR_NONE) {
        fr_read_error(
            reader, "missing-element", reader->tree->nodes[node].name,
            "the plant '%s' has no <pgraph>, <lsystem>, <skeleton>, <ramified>, <species> "
            "or <vary>",
            plant->id);
    } else if (plant->kind == FR_PLANT_VARIED) {
        if (plant->sliders->len > 0) {
            fr_read_error(reader, "misplaced-element", reader->tree->nodes[definition].name,
                          "the sliders of a varied plant are those of the plant it is made from");
        }
        plant->vary = fr_read_vary(reader, definition);
    } else if (plant->kind == FR_PLANT_LSYSTEM) {
        plant->lsystem = fr_read_lsystem(reader, definition);
    } else if (plant->kind == FR_PLANT_SKELETON) {
        plant->skeleton = fr_read_skeleton(reader, definition);
    } else if (plant->kind == FR_PLANT_SPECIES) {
        plant->species = fr_read_species(reader, definition);
    } else if (plant->kind == FR_PLANT_RAMIFIED) {
        plant->ramified = fr_read_ramified(reader, definition);
    } else {
        fr_read_pgraph(reader, definition, plant->pgraph);
        fr_read_check_sliders(reader, node, plant->pgraph);
    }
}

/// Sets what is the same for the whole plant at a time of its clock.
static void set_state(FrPgraph *graph, const FrPlantDef *plant, double time) {
    FrVars vars = {0};
    vars.value[FR_VAR_time] = time;
    vars.value[FR_VAR_age] = plant->age + time;
    FrPgraphState state = {
        .age = plant->age,
        .time = time,
        .season = fr_number_eval(&plant->season, &vars, 0, NULL),
        .health = fr_number_eval(&plant->health, &vars, 0, NULL),
    };
    fr_pgraph_set_state(graph, &state);
}

/// What its attributes say, in which its sliders are known.
static void read_attributes(FrReader *reader, uint32_t node, FrPlantDef *plant) {
    FrPlantParams params;
    const FrParamTable *table = fr_element(FR_ELEMENT_PLANT).table;
    fr_params_init(table, &params);
    fr_read_attributes(reader, node, FR_ELEMENT_PLANT, &params);
    plant->seed = (uint64_t)params.seed;
    plant->age = params.age;
    plant->time = params.time;
    plant->season = fr_number_copy(&params.season);
    plant->health = fr_number_copy(&params.health);
    fr_params_clear(table, &params);
}

static void read_nurbs(FrReader *reader, uint32_t node, FrPlantDef *plant) {
    plant->nurbs = fr_nurbs_default();
    uint32_t nurbs = fr_read_first(reader, node, FR_ELEMENT_NURBS);
    if (nurbs != FR_NONE) {
        plant->has_nurbs = true;
        plant->nurbs_span = fr_xml_span(reader->tree, reader->tree->nodes[nurbs].name);
        fr_read_check_children(reader, nurbs, FR_ELEMENT_NURBS);
        fr_read_attributes(reader, nurbs, FR_ELEMENT_NURBS, &plant->nurbs);
    }
}

static FrPlantDef *read_plant(FrReader *reader, uint32_t node, char *id) {
    FrPlantDef *plant = g_new0(FrPlantDef, 1);
    *plant = (FrPlantDef){.id = id,
                          .kind = FR_PLANT_PGRAPH,
                          .span = fr_xml_span(reader->tree, reader->tree->nodes[node].name)};
    FrScope *scope = fr_scope_new_within(reader->document->scope);
    plant->sliders = fr_read_sliders(reader, node, scope);
    reader->scope = scope;
    read_attributes(reader, node, plant);
    plant->pgraph = fr_pgraph_new(id, plant->seed);
    set_state(plant->pgraph, plant, plant->time);
    plant->has_seed = fr_xml_attribute(reader->tree, node, "seed") != NULL;
    read_nurbs(reader, node, plant);
    read_definition(reader, node, plant);
    reader->scope = reader->document->scope;
    fr_scope_free(scope);
    return plant;
}

uint32_t fr_read_find_plant(const FrXmlTree *tree, const FrPlantDef *plant) {
    uint32_t node = fr_xml_element_from(tree, tree->nodes[tree->root].first);
    while (node != FR_NONE && tree->nodes[node].name.begin != plant->span.begin) {
        node = fr_xml_element_from(tree, tree->nodes[node].next);
    }
    FR_ASSERT(node != FR_NONE);
    return node;
}

FrPgraph *fr_document_reseed(const FrDocument *document, const FrPlantDef *plant, uint64_t seed,
                             double time) {
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
    set_state(graph, plant, isnan(time) ? plant->time : time);
    uint32_t node = fr_read_find_plant(document->tree, plant);
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
    fr_read_check_grafts(reader);
}
