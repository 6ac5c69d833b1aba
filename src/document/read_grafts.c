/// Grafts of a document's plants: what stands there must be known, know the numbers it is given,
/// and not stand in itself.
#include "document/reader.h"

#include <string.h>

/// Plants that stand within one another, at most.
enum { MOST_WITHIN = 16 };

static const FrPlantDef *find_plant(const FrReader *reader, const char *id) {
    return id == NULL ? NULL : g_hash_table_lookup(reader->plant_ids, id);
}

/// The plant that a graft names.
static const FrPlantDef *find_grafted(FrReader *reader, uint32_t node) {
    const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, node, "plant");
    if (attribute == NULL) {
        return NULL; // reported as missing
    }
    char *id = fr_xml_decode(reader->tree, attribute->value, true);
    const FrPlantDef *plant = find_plant(reader, id);
    if (plant == NULL) {
        const GPtrArray *plants = reader->document->plants;
        uint32_t count = fr_read_candidates(plants->len);
        const char **names = g_new(const char *, count + 1);
        for (uint32_t i = 0; i < count; i++) {
            names[i] = ((const FrPlantDef *)g_ptr_array_index(plants, i))->id;
        }
        char *hint = fr_read_hint(reader, id, names, count);
        fr_read_error(reader, "unknown-plant", attribute->value,
                      "there is no plant '%.64s' to graft%s", id, hint);
        g_free(hint);
        g_free(names);
    }
    g_free(id);
    return plant;
}

/// Numbers that the plant does not know.
static void check_defines(FrReader *reader, uint32_t node, const FrPlantDef *plant) {
    for (uint32_t child = fr_read_first(reader, node, FR_ELEMENT_DEFINE); child != FR_NONE;
         child = fr_read_next(reader, child, FR_ELEMENT_DEFINE)) {
        const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, child, "id");
        char *id = attribute == NULL ? NULL : fr_xml_decode(reader->tree, attribute->value, true);
        bool is_known = plant->kind == FR_PLANT_LSYSTEM && id != NULL &&
                        fr_lmodel_find_value(plant->lsystem, id) != FR_NONE;
        if (id != NULL && !is_known) {
            fr_read_error(reader, "unused-value", attribute->value,
                          "the plant '%s' has no <define> of '%.64s'", plant->id, id);
        }
        g_free(id);
    }
}

/// Steps and symbols are of L-systems only.
static void check_plain(FrReader *reader, uint32_t graph, uint32_t node, const FrPlantDef *plant) {
    if (plant->kind == FR_PLANT_LSYSTEM) {
        return;
    }
    const FrXmlAttribute *steps = fr_xml_attribute(reader->tree, node, "steps");
    if (steps != NULL) {
        fr_read_error(reader, "wrong-graft", steps->value,
                      "the plant '%s' is no L-system, it has no steps", plant->id);
    }
    const FrXmlAttribute *own = fr_xml_attribute(reader->tree, node, "id");
    char *id = own == NULL ? NULL : fr_xml_decode(reader->tree, own->value, true);
    for (uint32_t link = fr_read_first(reader, graph, FR_ELEMENT_LINK);
         link != FR_NONE && id != NULL; link = fr_read_next(reader, link, FR_ELEMENT_LINK)) {
        const FrXmlAttribute *from = fr_xml_attribute(reader->tree, link, "from");
        const FrXmlAttribute *symbol = fr_xml_attribute(reader->tree, link, "symbol");
        char *text = from == NULL ? NULL : fr_xml_decode(reader->tree, from->value, true);
        if (symbol != NULL && g_strcmp0(text, id) == 0) {
            fr_read_error(reader, "wrong-symbol", symbol->value,
                          "the plant '%s' is no L-system, it has no symbols", plant->id);
        }
        g_free(text);
    }
    g_free(id);
}

// ---- plants within plants ---------------------------------------------------------------------

typedef struct Nesting {
    FrReader *reader;
    GHashTable *depths; ///< FrPlantDef * → plants within one another, itself included
} Nesting;

/// How many plants stand within one another from this one on; more than MOST_WITHIN where `above`
/// of them already do or where one stands in itself.
static uint32_t depth_of(const Nesting *nesting, const FrPlantDef *plant, uint32_t above) {
    uint32_t depth = GPOINTER_TO_UINT(g_hash_table_lookup(nesting->depths, plant));
    if (plant == NULL || depth > 0) {
        return depth;
    }
    if (above > MOST_WITHIN) {
        return MOST_WITHIN + 1;
    }
    if (plant->kind == FR_PLANT_VARIED) {
        const char *base = fr_vary_params(plant->vary)->base;
        depth = depth_of(nesting, find_plant(nesting->reader, base), above + 1);
    }
    uint32_t count = plant->kind == FR_PLANT_PGRAPH ? fr_pgraph_count(plant->pgraph) : 0;
    for (uint32_t c = 0; c < count && depth <= MOST_WITHIN; c++) {
        if (fr_pgraph_kind(plant->pgraph, c) == FR_COMPONENT_GRAFT) {
            const char *id = fr_pgraph_grafted(plant->pgraph, c);
            depth = MAX(depth, depth_of(nesting, find_plant(nesting->reader, id), above + 1));
        }
    }
    depth++;
    g_hash_table_insert(nesting->depths, (void *)plant, GUINT_TO_POINTER(depth));
    return depth;
}

static void check_nesting(FrReader *reader) {
    Nesting nesting = {reader, g_hash_table_new(NULL, NULL)};
    const GPtrArray *plants = reader->document->plants;
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (depth_of(&nesting, plant, 1) > MOST_WITHIN) {
            FrXmlRange place = {plant->span.begin, plant->span.end};
            fr_read_error(reader, "graft-cycle", place,
                          "by its grafts the plant '%s' stands in itself, or more than %d plants "
                          "stand within one another",
                          plant->id, MOST_WITHIN);
            break;
        }
    }
    g_hash_table_unref(nesting.depths);
}

/// A graft with the graph that it is in.
typedef void (*GraftFn)(FrReader *reader, uint32_t graph, uint32_t node);

static void for_each_graft(FrReader *reader, GraftFn look) {
    const FrElementId graft = FR_ELEMENT_COMPONENT + FR_COMPONENT_GRAFT;
    const FrXmlTree *tree = reader->tree;
    for (uint32_t plant = fr_read_first(reader, tree->root, FR_ELEMENT_PLANT); plant != FR_NONE;
         plant = fr_read_next(reader, plant, FR_ELEMENT_PLANT)) {
        uint32_t graph = fr_read_first(reader, plant, FR_ELEMENT_PGRAPH);
        for (uint32_t node = graph == FR_NONE ? FR_NONE : fr_read_first(reader, graph, graft);
             node != FR_NONE; node = fr_read_next(reader, node, graft)) {
            look(reader, graph, node);
        }
    }
}

static void check_graft(FrReader *reader, uint32_t graph, uint32_t node) {
    const FrPlantDef *grafted = find_grafted(reader, node);
    if (grafted != NULL) {
        check_defines(reader, node, grafted);
        check_plain(reader, graph, node, grafted);
    }
}

void fr_read_check_grafts(FrReader *reader) {
    for_each_graft(reader, check_graft);
    check_nesting(reader);
}

static void warn_graft(FrReader *reader, uint32_t graph, uint32_t node) {
    (void)graph;
    const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, node, "plant");
    char *id = attribute == NULL ? NULL : fr_xml_decode(reader->tree, attribute->value, true);
    const FrPlantDef *plant = find_plant(reader, id);
    if (plant != NULL && plant->kind == FR_PLANT_LSYSTEM &&
        fr_lsystem_is_open(fr_lmodel_system(plant->lsystem))) {
        fr_diags_add(reader->diags, FR_WARNING, "unlit-graft",
                     fr_xml_span(reader->tree, attribute->value),
                     "grafted, the L-system '%s' does not see the light of the scene; where it has "
                     "a <place> of its own it does",
                     plant->id);
    }
    g_free(id);
}

void fr_read_warn_grafts(FrReader *reader) {
    if (reader->status == FR_OK && reader->document->surroundings.light.is_given) {
        for_each_graft(reader, warn_graft);
    }
}
