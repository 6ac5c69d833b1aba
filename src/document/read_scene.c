/// `<scene>`: sun, sky and ground, `<place>`s and `<view>`s.
#include "document/reader.h"

static void check_plant_exists(FrReader *reader, uint32_t node, const char *id) {
    if (g_hash_table_contains(reader->plant_ids, id)) {
        return;
    }
    const GPtrArray *plants = reader->document->plants;
    uint32_t count = fr_read_candidates(plants->len);
    const char **names = g_new(const char *, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        names[i] = ((const FrPlantDef *)g_ptr_array_index(plants, i))->id;
    }
    char *hint = fr_read_hint(reader, id, names, count);
    fr_read_error(reader, "unknown-plant", fr_read_value_place(reader, node, "plant"),
                  "there is no plant '%.64s'%s", id, hint);
    g_free(hint);
    g_free(names);
}

static void read_place(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_PLACE);
    FrPlace *place = g_new0(FrPlace, 1);
    fr_params_init(fr_place_table(), place);
    place->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_PLACE, place);
    g_ptr_array_add(reader->document->places, place);
    if (place->plant != NULL) {
        check_plant_exists(reader, node, place->plant);
    }
}

static void read_view(FrReader *reader, uint32_t node, GHashTable *names) {
    fr_read_check_children(reader, node, FR_ELEMENT_VIEW);
    FrViewParams *view = g_new0(FrViewParams, 1);
    fr_params_init(fr_view_table(), view);
    fr_read_attributes(reader, node, FR_ELEMENT_VIEW, view);
    g_ptr_array_add(reader->document->views, view);
    if (view->name != NULL && !g_hash_table_add(names, view->name)) {
        fr_read_error(reader, "duplicate-id", fr_read_value_place(reader, node, "name"),
                      "there is a view '%.64s' already", view->name);
    }
}

void fr_read_scenes(FrReader *reader, uint32_t parent) {
    uint32_t scene = fr_read_first(reader, parent, FR_ELEMENT_SCENE);
    if (scene == FR_NONE) {
        return;
    }
    fr_read_check_children(reader, scene, FR_ELEMENT_SCENE);
    fr_read_attributes(reader, scene, FR_ELEMENT_SCENE, &reader->document->scene);
    for (uint32_t node = fr_read_first(reader, scene, FR_ELEMENT_PLACE); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_PLACE)) {
        read_place(reader, node);
    }
    fr_read_surroundings(reader, scene);
    GHashTable *names = g_hash_table_new(g_str_hash, g_str_equal);
    for (uint32_t node = fr_read_first(reader, scene, FR_ELEMENT_VIEW); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_VIEW)) {
        read_view(reader, node, names);
    }
    g_hash_table_unref(names);
}
