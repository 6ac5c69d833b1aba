// glTF 2.0 (Khronos 2021, ISO/IEC 12113) as one .glb, or as .gltf with a .bin and pictures beside.
// The buffer is written from the arrays of the meshes where they lie.
#include "io/gltf.h"

#include "io/formats.h"
#include "io/replace_file.h"

#include <string.h>

static void mesh_free(gpointer mesh) {
    fr_mesh_free(mesh);
}

static void gltf_init(FrGltf *gltf, const FrScene *scene, const char *path,
                      const FrContext *context) {
    *gltf = (FrGltf){
        .scene = scene,
        .context = context,
        .meshes = json_array(),
        .accessors = json_array(),
        .views = json_array(),
        .nodes = g_string_new(NULL),
        .roots = json_array(),
        .chunks = g_array_new(FALSE, FALSE, sizeof(FrChunk)),
        .kept = g_ptr_array_new_with_free_func(g_free),
        .kept_meshes = g_ptr_array_new_with_free_func(mesh_free),
    };
    char *stem = fr_io_stem(path);
    fr_surfaces_init(&gltf->surfaces, stem);
    g_free(stem);
}

static void gltf_clear(FrGltf *gltf) {
    fr_surfaces_clear(&gltf->surfaces);
    json_decref(gltf->meshes);
    json_decref(gltf->accessors);
    json_decref(gltf->views);
    json_decref(gltf->roots);
    g_string_free(gltf->nodes, TRUE);
    g_array_unref(gltf->chunks);
    g_ptr_array_unref(gltf->kept);
    g_ptr_array_unref(gltf->kept_meshes);
}

/// What holds for the whole file.
static json_t *head_of(const FrGltf *gltf) {
    char digest[17];
    g_snprintf(digest, sizeof digest, "%016" G_GINT64_MODIFIER "x", fr_scene_digest(gltf->scene));
    json_t *root = json_object();
    json_object_set_new(root, "asset",
                        json_pack("{s:s, s:s, s:{s:I, s:s}}", "version", "2.0", "generator",
                                  "Frond " FR_VERSION, "extras", "seed",
                                  (json_int_t)gltf->scene->seed, "digest", digest));
    if (gltf->instances) {
        // A reader without it would show one leaf in place of thousands, so it is required.
        json_object_set_new(root, "extensionsUsed", json_pack("[s]", "EXT_mesh_gpu_instancing"));
        json_object_set_new(root, "extensionsRequired",
                            json_pack("[s]", "EXT_mesh_gpu_instancing"));
    }
    json_t *scene = json_object();
    if (gltf->scene->name != NULL && *gltf->scene->name != '\0') {
        json_object_set_new(scene, "name", fr_gltf_name(gltf->scene->name));
    }
    if (json_array_size(gltf->roots) > 0) {
        json_object_set(scene, "nodes", gltf->roots);
    }
    json_object_set_new(root, "scene", json_integer(0));
    json_object_set_new(root, "scenes", json_pack("[o]", scene));
    return root;
}

/// glTF has no empty arrays: what there is none of is left out.
static void remove_empty(json_t *root) {
    const char *key;
    void *next;
    json_t *value;
    json_object_foreach_safe(root, next, key, value) {
        if (json_is_array(value) && json_array_size(value) == 0) {
            json_object_del(root, key);
        }
    }
}

/// The JSON text. `uri` of the buffer; NULL: it is the .glb's, and so are the pictures.
static GString *text_of(FrGltf *gltf, const char *uri) {
    json_t *root = head_of(gltf);
    json_object_set(root, "meshes", gltf->meshes);
    fr_gltf_add_materials(gltf, root, uri != NULL);
    json_object_set(root, "accessors", gltf->accessors);
    json_object_set(root, "bufferViews", gltf->views);
    if (gltf->size > 0) {
        json_t *buffer = json_pack("{s:I}", "byteLength", (json_int_t)gltf->size);
        if (uri != NULL) {
            json_object_set_new(buffer, "uri", json_string(uri));
        }
        json_object_set_new(root, "buffers", json_pack("[o]", buffer));
    }
    remove_empty(root);
    char *json = json_dumps(root, JSON_COMPACT | JSON_REAL_PRECISION(9));
    json_decref(root);
    GString *text = g_string_new(json);
    free(json);
    if (gltf->node_count > 0) {
        g_string_truncate(text, text->len - 1); // the closing brace
        g_string_append(text, ",\"nodes\":[");
        g_string_append_len(text, gltf->nodes->str, (gssize)gltf->nodes->len);
        g_string_append(text, "]}");
    }
    return text;
}

/// Chunks and where to report.
typedef struct FrChunkList {
    const FrChunk *chunks;
    size_t count;
    FrProgress *progress;
} FrChunkList;

static bool write_list(void *user, int descriptor) {
    const FrChunkList *list = user;
    return fr_write_chunks(descriptor, list->chunks, list->count, list->progress);
}

static void put32(uint8_t *at, uint64_t value) {
    for (int k = 0; k < 4; k++) {
        at[k] = (uint8_t)(value >> (8 * k));
    }
}

static FrStatus write_glb(FrGltf *gltf, const char *path, uint64_t *bytes) {
    GString *text = text_of(gltf, NULL);
    while (text->len % 4 != 0) {
        g_string_append_c(text, ' ');
    }
    uint64_t total = 12 + 8 + text->len + (gltf->size > 0 ? 8 + gltf->size : 0);
    FrStatus status = FR_OK;
    if (total > UINT32_MAX) {
        fr_diags_add(gltf->context->diags, FR_ERROR, "glb-too-large", (FrSpan){0},
                     "'%s' would have %" G_GUINT64_FORMAT
                     " bytes and a .glb holds 4294967295; write .gltf, or a coarser --lod",
                     path, total);
        status = FR_ERR_LIMIT;
    } else {
        uint8_t head[20];
        uint8_t binary_head[8];
        memcpy(head, "glTF", 4);
        put32(head + 4, 2);
        put32(head + 8, total);
        put32(head + 12, text->len);
        memcpy(head + 16, "JSON", 4);
        put32(binary_head, gltf->size);
        memcpy(binary_head + 4, "BIN\0", 4);
        FrChunk front[3] = {{head, 20}, {text->str, text->len}, {binary_head, 8}};
        g_array_prepend_vals(gltf->chunks, front, gltf->size > 0 ? 3 : 2);
        FrChunkList list = {(const FrChunk *)gltf->chunks->data, gltf->chunks->len,
                            gltf->context->progress};
        status = fr_io_replace_file(path, write_list, &list, gltf->context->diags);
    }
    g_string_free(text, TRUE);
    *bytes = total;
    return status;
}

/// Writes the pieces beside the final names first; then all appear, the .gltf last.
static FrStatus write_gltf(FrGltf *gltf, const char *path, uint64_t *bytes) {
    FrDiags *diags = gltf->context->diags;
    FrProgress *progress = gltf->context->progress;
    char *stem = fr_io_stem(path);
    char *name = g_strconcat(stem, ".bin", NULL);
    char *uri = g_uri_escape_string(name, NULL, FALSE);
    char *binary = fr_io_beside(path, name);
    GString *text = text_of(gltf, uri);
    GArray *files = fr_replacements_new();
    FrStatus status = fr_surfaces_write(&gltf->surfaces, path, files, gltf->context, bytes);
    if (status == FR_OK && gltf->size > 0) {
        FrChunkList list = {(const FrChunk *)gltf->chunks->data, gltf->chunks->len, progress};
        status = fr_replacements_write(files, binary, write_list, &list, diags);
    }
    if (status == FR_OK) {
        FrChunk chunk = {text->str, text->len};
        FrChunkList list = {&chunk, 1, NULL};
        status = fr_replacements_write(files, path, write_list, &list, diags);
    }
    if (status == FR_OK) {
        status = fr_replacements_commit(files, diags);
    }
    *bytes += gltf->size + text->len;
    g_array_unref(files);
    g_string_free(text, TRUE);
    g_free(binary);
    g_free(uri);
    g_free(name);
    g_free(stem);
    return status;
}

/// The options of a scene: where plants are deformed no two leaves need be alike, so all are
/// written into the meshes.
static FrIoOptions options_for(const FrScene *scene, const FrIoOptions *options) {
    FrIoOptions own = *options;
    for (guint p = 0; p < scene->plants->len; p++) {
        if (fr_io_plant(scene, p)->deformers->len > 0) {
            own.leaves = FR_LEAVES_MERGED;
        }
    }
    return own;
}

static FrStatus write_asset(const FrScene *scene, const char *path, const FrIoOptions *wanted,
                            bool is_binary, const FrContext *context, FrIoStats *stats) {
    FrIoOptions own = options_for(scene, wanted);
    const FrIoOptions *options = &own;
    FrSkinParams skin = options->skin;
    skin.foliage = skin.foliage && options->leaves == FR_LEAVES_MERGED;
    FrIoMeshes meshes;
    gint64 start = g_get_monotonic_time();
    FrStatus status = fr_io_meshes_make(&meshes, scene, &skin, FR_UP_Y, false, context);
    gint64 skinned = g_get_monotonic_time();
    if (status != FR_OK) {
        return status;
    }
    FrGltf gltf;
    gltf_init(&gltf, scene, path, context);
    status = fr_gltf_add_scene(&gltf, &meshes, options);
    if (status == FR_OK) {
        status = is_binary ? write_glb(&gltf, path, &stats->bytes)
                           : write_gltf(&gltf, path, &stats->bytes);
    }
    stats->meshes = json_array_size(gltf.meshes);
    stats->vertices = gltf.vertices;
    stats->triangles = gltf.triangles;
    stats->skin_seconds = (double)(skinned - start) * 1e-6;
    stats->write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6;
    gltf_clear(&gltf);
    fr_io_meshes_clear(&meshes);
    return status;
}

FrStatus fr_glb_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats) {
    return write_asset(scene, path, options, true, context, stats);
}

FrStatus fr_gltf_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                       const FrContext *context, FrIoStats *stats) {
    return write_asset(scene, path, options, false, context, stats);
}
