/// `<scene>`: sun, sky and ground, and `<view>`s.
#include "document/reader.h"

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
    fr_read_placing(reader, scene);
    fr_read_growth(reader, scene);
    fr_read_surroundings(reader, scene);
    GHashTable *names = g_hash_table_new(g_str_hash, g_str_equal);
    for (uint32_t node = fr_read_first(reader, scene, FR_ELEMENT_VIEW); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_VIEW)) {
        read_view(reader, node, names);
    }
    g_hash_table_unref(names);
}
