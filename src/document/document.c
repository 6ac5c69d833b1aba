/// Life of a document: from a file to its definitions.
#include "document/reader.h"

#include <string.h>

static void free_plant(void *data) {
    FrPlantDef *plant = data;
    fr_pgraph_free(plant->pgraph);
    fr_lmodel_free(plant->lsystem);
    fr_number_clear(&plant->season);
    fr_number_clear(&plant->health);
    fr_skeleton_free(plant->skeleton);
    fr_species_def_free(plant->species);
    fr_ramified_free(plant->ramified);
    fr_vary_free(plant->vary);
    g_ptr_array_unref(plant->sliders);
    g_free(plant->id);
    g_free(plant);
}

static void free_place(void *data) {
    fr_params_clear(fr_place_table(), data);
    g_free(data);
}

static void free_view(void *data) {
    fr_params_clear(fr_view_table(), data);
    g_free(data);
}

static void free_material(void *data) {
    fr_material_unref(data);
}

/// Takes the tree.
static FrDocument *new_document(FrXmlTree *tree, const char *folder) {
    FrDocument *document = g_new0(FrDocument, 1);
    document->tree = tree;
    document->folder = g_strdup(folder == NULL ? "." : folder);
    document->plants = g_ptr_array_new_with_free_func(free_plant);
    document->places = g_ptr_array_new_with_free_func(free_place);
    document->rows = fr_rows_new();
    document->strews = fr_strews_new();
    document->views = g_ptr_array_new_with_free_func(free_view);
    document->materials = g_ptr_array_new_with_free_func(free_material);
    document->scope = fr_scope_new();
    fr_params_init(fr_scene_table(), &document->scene);
    fr_surroundings_init(&document->surroundings);
    fr_growth_def_init(&document->growth);
    return document;
}

void fr_document_free(FrDocument *document) {
    if (document == NULL) {
        return;
    }
    g_ptr_array_unref(document->plants);
    g_ptr_array_unref(document->places);
    g_ptr_array_unref(document->rows);
    g_ptr_array_unref(document->strews);
    g_ptr_array_unref(document->views);
    g_ptr_array_unref(document->materials);
    fr_params_clear(fr_scene_table(), &document->scene);
    fr_surroundings_clear(&document->surroundings);
    fr_growth_def_clear(&document->growth);
    fr_scope_free(document->scope);
    fr_xml_free(document->tree);
    g_free(document->folder);
    g_free(document);
}

/// False if the root says that the rest cannot be understood.
static bool check_version(FrReader *reader, uint32_t root) {
    const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, root, "version");
    if (attribute == NULL) {
        fr_read_error(reader, "missing-version", reader->tree->nodes[root].name,
                      "<frond> needs version=\"%d\"", FR_DOCUMENT_VERSION);
        return true;
    }
    FrFrondParams params;
    const FrParamTable *table = fr_element(FR_ELEMENT_FROND).table;
    fr_params_init(table, &params);
    fr_read_attributes(reader, root, FR_ELEMENT_FROND, &params);
    if (params.version > FR_DOCUMENT_VERSION) {
        fr_read_error(reader, "newer-version", attribute->value,
                      "this is version %" G_GINT64_FORMAT
                      " of the format; this program reads versions up to %d",
                      params.version, FR_DOCUMENT_VERSION);
        return false;
    }
    return true;
}

FrStatus fr_document_read(FrDocument *document, const FrContext *context) {
    FrReader reader;
    fr_reader_open(&reader, document, context->diags);
    reader.context = context;
    uint32_t root = document->tree->root;
    FrXmlRange name = document->tree->nodes[root].name;
    if (!fr_xml_equals(document->tree, name, "frond")) {
        char *found = fr_xml_name(document->tree, name);
        fr_read_error(&reader, "not-a-document", name, "the root is <%s>, not <frond>", found);
        g_free(found);
    } else if (check_version(&reader, root)) {
        fr_read_check_children(&reader, root, FR_ELEMENT_FROND);
        fr_read_curves(&reader, root);
        fr_read_materials(&reader, root);
        fr_read_plants(&reader, root);
        fr_read_scenes(&reader, root);
        fr_read_warn_grafts(&reader);
    }
    fr_reader_close(&reader);
    return reader.status;
}

FrStatus fr_document_parse(FrSource *source, const char *folder, const FrContext *context,
                           FrDocument **document) {
    *document = NULL;
    FrXmlTree *tree;
    FrStatus status = fr_xml_read(source, context, &tree);
    if (status != FR_OK) {
        return status;
    }
    *document = new_document(tree, folder);
    return fr_document_read(*document, context);
}

FrStatus fr_document_load(const char *path, const FrContext *context, FrDocument **document) {
    *document = NULL;
    FrStatus status;
    FrSource *source =
        fr_source_load(path, context->limits.document_bytes, context->diags, &status);
    if (source == NULL) {
        return status;
    }
    char *folder = g_path_get_dirname(path);
    status = fr_document_parse(source, folder, context, document);
    g_free(folder);
    fr_source_unref(source);
    return status;
}

// ---- what is in it ----------------------------------------------------------------------------

const char *fr_document_name(const FrDocument *document) {
    return fr_source_name(document->tree->source);
}

char *fr_document_title(const FrDocument *document) {
    const FrXmlTree *tree = document->tree;
    for (uint32_t i = 0; i < tree->node_count; i++) {
        if (tree->nodes[i].kind == FR_XML_COMMENT) {
            FrXmlRange comment = tree->nodes[i].name;
            char *text = g_strndup(fr_source_text(tree->source, NULL) + comment.begin,
                                   comment.end - comment.begin);
            g_strchug(text);
            text[strcspn(text, "\r\n")] = '\0';
            return g_strchomp(text);
        }
    }
    return NULL;
}

FrSpan fr_document_span(const FrDocument *document) {
    return fr_xml_span(document->tree, document->tree->nodes[document->tree->root].name);
}

const char *fr_document_folder(const FrDocument *document) {
    return document->folder;
}

const GPtrArray *fr_document_plants(const FrDocument *document) {
    return document->plants;
}

const GPtrArray *fr_document_places(const FrDocument *document) {
    return document->places;
}

const GPtrArray *fr_document_rows(const FrDocument *document) {
    return document->rows;
}

const GPtrArray *fr_document_strews(const FrDocument *document) {
    return document->strews;
}

const GPtrArray *fr_document_views(const FrDocument *document) {
    return document->views;
}

const GPtrArray *fr_document_materials(const FrDocument *document) {
    return document->materials;
}

const FrSceneParams *fr_document_scene(const FrDocument *document) {
    return &document->scene;
}

const FrSurroundings *fr_document_surroundings(const FrDocument *document) {
    return &document->surroundings;
}

const FrGrowthDef *fr_document_growth(const FrDocument *document) {
    return &document->growth;
}
