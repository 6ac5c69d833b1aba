/// `<material>`: its picture files must be there, named relative to the document.
#include "document/reader.h"

#include "material/unread.h"

static const char *const map_attributes[FR_MAP_COUNT] = {[FR_MAP_COLOUR] = "picture",
                                                         [FR_MAP_NORMAL] = "normal-map",
                                                         [FR_MAP_ROUGHNESS] = "roughness-map"};

void fr_read_check_file(FrReader *reader, uint32_t node, const char *attribute, const char *file) {
    if (file == NULL || *file == '\0') {
        return;
    }
    FrXmlRange place = fr_read_value_place(reader, node, attribute);
    if (g_path_is_absolute(file)) {
        fr_read_error(reader, "absolute-path", place,
                      "files are named relative to the document, not '%s'", file);
        return;
    }
    char *path = g_build_filename(reader->document->folder, file, NULL);
    if (!g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        fr_read_error(reader, "missing-file", place,
                      g_file_test(path, G_FILE_TEST_EXISTS) ? "'%s' is not a file"
                                                            : "there is no file '%s'",
                      path);
    }
    g_free(path);
}

static char *why_unread(const void *params, const FrParam *row, const void *user) {
    (void)user;
    return fr_material_why_unread(params, row);
}

static void read_material(FrReader *reader, uint32_t node, const char *id) {
    const FrParamTable *table = fr_material_table();
    FrMaterialParams params;
    fr_params_init(table, &params);
    FrStatus before = reader->status;
    reader->status = FR_OK;
    fr_read_attributes(reader, node, FR_ELEMENT_MATERIAL, &params);
    if (reader->status == FR_OK) {
        fr_read_check_effects(reader, node, FR_ELEMENT_MATERIAL, &params, why_unread, NULL);
    }
    fr_read_note(reader, before);
    const char *files[FR_MAP_COUNT] = {[FR_MAP_COLOUR] = params.picture,
                                       [FR_MAP_NORMAL] = params.normal_map,
                                       [FR_MAP_ROUGHNESS] = params.roughness_map};
    for (int map = 0; map < FR_MAP_COUNT; map++) {
        fr_read_check_file(reader, node, map_attributes[map], files[map]);
    }
    FrSpan ramp = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "ramp"));
    if (!fr_material_check_ramp(params.ramp, ramp, reader->diags)) {
        fr_read_note(reader, FR_ERR_DOCUMENT);
    }
    if (g_hash_table_contains(reader->material_ids, id)) {
        fr_read_error(reader, "duplicate-id", fr_read_value_place(reader, node, "id"),
                      "there is a material '%s' already", id);
    } else {
        FrSpan span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
        FrMaterial *material = fr_material_new(id, &params, reader->document->folder, span);
        for (FrMap map = 0; map < FR_MAP_COUNT; map++) {
            FrXmlRange place = fr_read_value_place(reader, node, map_attributes[map]);
            fr_material_set_place(material, map, fr_xml_span(reader->tree, place));
        }
        g_ptr_array_add(reader->document->materials, material);
        g_hash_table_insert(reader->material_ids, g_strdup(id), material);
    }
    fr_params_clear(table, &params);
}

void fr_read_materials(FrReader *reader, uint32_t parent) {
    for (uint32_t node = fr_read_first(reader, parent, FR_ELEMENT_MATERIAL); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_MATERIAL)) {
        fr_read_check_children(reader, node, FR_ELEMENT_MATERIAL);
        char *id = fr_read_id(reader, node);
        if (id != NULL) {
            read_material(reader, node, id);
        }
        g_free(id);
    }
}
