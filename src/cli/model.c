/// What is in a glTF 2.0 model: the JSON of a .gltf, or the JSON chunk of a .glb (Khronos glTF 2.0
/// specification, section 4.4).
#include "cli/cli.h"

#include <stdio.h>
#include <string.h>

enum { GLB_MAGIC = 0x46546c67, GLB_JSON = 0x4e4f534a, GLB_HEADER_BYTES = 20 };

typedef struct ModelCounts {
    uint64_t nodes, meshes, primitives, vertices, triangles, materials, images;
} ModelCounts;

bool cli_is_model(const char *path) {
    const char *extension = strrchr(path, '.');
    return extension != NULL && (g_ascii_strcasecmp(extension, ".glb") == 0 ||
                                 g_ascii_strcasecmp(extension, ".gltf") == 0);
}

static FrStatus fail(CliSession *session, FrStatus status, const char *path, const char *why) {
    fr_diags_add(session->context.diags, FR_ERROR, "not-a-model", (FrSpan){0}, "%s: %s", path, why);
    return status;
}

static uint32_t little_endian(const unsigned char *bytes) {
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

/// The JSON chunk of a .glb; only that is read, however large the model is.
static FrStatus read_glb(CliSession *session, const char *path, json_t **json) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return fail(session, FR_ERR_DOCUMENT, path, "cannot be opened");
    }
    FrStatus status = FR_ERR_DOCUMENT;
    unsigned char header[GLB_HEADER_BYTES];
    char *text = NULL;
    if (fread(header, 1, sizeof header, file) != sizeof header ||
        little_endian(header) != GLB_MAGIC || little_endian(header + 4) != 2 ||
        little_endian(header + 16) != GLB_JSON) {
        status = fail(session, status, path, "not a binary glTF 2.0 model");
    } else {
        uint32_t size = little_endian(header + 12);
        FrStatus allowed =
            fr_limit_check(size, session->options->limits.document_bytes, "document_bytes", path,
                           (FrSpan){0}, session->context.diags);
        text = allowed == FR_OK ? g_try_malloc(size + (size_t)1) : NULL;
        size_t read = text == NULL ? 0 : fread(text, 1, size, file);
        if (allowed != FR_OK) {
            status = allowed;
        } else if (read != size) {
            status = fail(session, status, path, "the model is cut off");
        } else {
            *json = json_loadb(text, size, 0, NULL);
            status = *json == NULL ? fail(session, status, path, "its JSON is wrong") : FR_OK;
        }
    }
    g_free(text);
    fclose(file);
    return status;
}

static FrStatus read_gltf(CliSession *session, const char *path, json_t **json) {
    FrStatus status;
    FrSource *source = fr_source_load(path, session->options->limits.document_bytes,
                                      session->context.diags, &status);
    if (source == NULL) {
        return status;
    }
    size_t size;
    const char *text = fr_source_text(source, &size);
    *json = json_loadb(text, size, 0, NULL);
    fr_source_unref(source);
    return *json == NULL ? fail(session, FR_ERR_DOCUMENT, path, "its JSON is wrong") : FR_OK;
}

static uint64_t count_of(const json_t *accessors, const json_t *index) {
    if (!json_is_integer(index) || json_integer_value(index) < 0) {
        return 0;
    }
    const json_t *accessor = json_array_get(accessors, (size_t)json_integer_value(index));
    json_int_t count = json_integer_value(json_object_get(accessor, "count"));
    return count > 0 ? (uint64_t)count : 0;
}

/// Adds the primitives of a mesh that is drawn `times` times; vertices count once.
static void add_mesh(ModelCounts *counts, const json_t *root, const json_t *mesh, uint64_t times,
                     bool is_first) {
    const json_t *accessors = json_object_get(root, "accessors");
    size_t i;
    json_t *primitive;
    json_array_foreach(json_object_get(mesh, "primitives"), i, primitive) {
        const json_t *mode = json_object_get(primitive, "mode");
        const json_t *attributes = json_object_get(primitive, "attributes");
        uint64_t vertices = count_of(accessors, json_object_get(attributes, "POSITION"));
        const json_t *indices = json_object_get(primitive, "indices");
        uint64_t corners = indices == NULL ? vertices : count_of(accessors, indices);
        if (mode == NULL || json_integer_value(mode) == 4) {
            counts->triangles =
                fr_count_add(counts->triangles, fr_count_multiply(corners / 3, times));
        }
        if (is_first) {
            counts->vertices = fr_count_add(counts->vertices, vertices);
            counts->primitives++;
        }
    }
}

/// How often EXT_mesh_gpu_instancing draws a node's mesh; 1 without.
static uint64_t instances_of(const json_t *root, const json_t *node) {
    const json_t *extension =
        json_object_get(json_object_get(node, "extensions"), "EXT_mesh_gpu_instancing");
    const json_t *attributes = json_object_get(extension, "attributes");
    const json_t *index = json_object_get(attributes, "TRANSLATION");
    return index == NULL ? 1 : count_of(json_object_get(root, "accessors"), index);
}

static ModelCounts count_model(const json_t *root) {
    const json_t *meshes = json_object_get(root, "meshes");
    ModelCounts counts = {.nodes = json_array_size(json_object_get(root, "nodes")),
                          .meshes = json_array_size(meshes),
                          .materials = json_array_size(json_object_get(root, "materials")),
                          .images = json_array_size(json_object_get(root, "images"))};
    size_t i;
    json_t *mesh, *node;
    json_array_foreach(meshes, i, mesh) {
        add_mesh(&counts, root, mesh, 0, true);
    }
    json_array_foreach(json_object_get(root, "nodes"), i, node) {
        const json_t *index = json_object_get(node, "mesh");
        if (json_is_integer(index) && json_integer_value(index) >= 0) {
            add_mesh(&counts, root, json_array_get(meshes, (size_t)json_integer_value(index)),
                     instances_of(root, node), false);
        }
    }
    return counts;
}

static void print_counts(const CliSession *session, const char *path, const ModelCounts *counts) {
    const struct {
        const char *name;
        uint64_t count;
    } rows[] = {{"nodes", counts->nodes},           {"meshes", counts->meshes},
                {"primitives", counts->primitives}, {"vertices", counts->vertices},
                {"triangles", counts->triangles},   {"materials", counts->materials},
                {"images", counts->images}};
    json_t *object = json_object();
    char *name = g_utf8_make_valid(path, -1);
    json_object_set_new(object, "model", json_string(name));
    if (!session->options->is_json) {
        printf("%s\n", path);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text = cli_count_text(rows[i].count);
        if (!session->options->is_json) {
            printf("  %-12s %12s\n", rows[i].name, text);
        }
        json_object_set_new(object, rows[i].name, json_integer((json_int_t)rows[i].count));
        g_free(text);
    }
    if (session->options->is_json) {
        json_dumpf(object, stdout, JSON_INDENT(2));
        printf("\n");
    }
    g_free(name);
    json_decref(object);
}

FrStatus cli_model_info(CliSession *session, const char *path) {
    json_t *json = NULL;
    const char *extension = strrchr(path, '.');
    FrStatus status = g_ascii_strcasecmp(extension, ".glb") == 0 ? read_glb(session, path, &json)
                                                                 : read_gltf(session, path, &json);
    if (status == FR_OK) {
        ModelCounts counts = count_model(json);
        print_counts(session, path, &counts);
    }
    json_decref(json);
    return status;
}
