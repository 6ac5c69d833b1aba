// Documents from any bytes: reading gives definitions or diagnostics with places, an untouched
// document is written back byte for byte, and building it stays within small limits.
#include "fuzz.h"

#include "frond/scene.h"

#include <string.h>

static FrLimits small_limits(void) {
    FrLimits limits = fr_limits_default();
    limits.document_bytes = 1 << 20;
    limits.elements = 2000;
    limits.instances = 2000;
    limits.nodes = 10000;
    limits.organs = 5000;
    limits.shapes = 64;
    limits.depth = 64;
    limits.plants = 8;
    limits.triangles = 100000;
    limits.pixels = 65536;
    limits.bytes = 20000000;
    return limits;
}

static void check_text(const FrDocument *document, const uint8_t *data, size_t size) {
    size_t text_size = 0;
    char *text = fr_document_text(document, &text_size);
    FR_ASSERT(text_size == size && (size == 0 || memcmp(text, data, size) == 0));
    g_free(text);
}

/// The same plant at every level of detail that a viewer may ask for.
static void skin(const FrScene *scene, const FrContext *context) {
    for (guint i = 0; i < scene->plants->len; i++) {
        FrSkinParams params = fr_skin_default();
        for (params.lod = 0; params.lod < 4; params.lod++) {
            FrMesh *mesh;
            FrStatus status = fr_skin_plant(g_array_index(scene->plants, FrScenePlant, i).plant,
                                            &params, FR_UP_Y, context, &mesh);
            FR_ASSERT((status == FR_OK) == (mesh != NULL));
            fr_mesh_free(mesh);
        }
    }
}

static void build(const FrDocument *document, const FrContext *context) {
    FrScene *scene = NULL;
    FrStatus status = fr_scene_build(document, -1, context, &scene);
    FR_ASSERT((status == FR_OK) == (scene != NULL));
    FR_ASSERT(status == FR_OK || fr_diags_error_count(context->diags) > 0);
    if (scene != NULL) {
        double min[3], max[3];
        fr_scene_bounds(scene, min, max);
        fr_scene_digest(scene);
        skin(scene, context);
        fr_scene_free(scene);
    }
}

static void print_all(const FrDiags *diags) {
    GString *out = g_string_new(NULL);
    fr_diags_print(diags, out);
    fr_diags_print_json(diags, out);
    g_string_free(out, TRUE);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size > 1 << 20) {
        return 0;
    }
    FrContext context = fr_context_default();
    context.limits = small_limits();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("input.frond", (const char *)data, size);
    FrDocument *document = NULL;
    FrStatus status = fr_document_parse(source, "/nonexistent", &context, &document);
    FR_ASSERT(status == FR_OK || fr_diags_error_count(context.diags) > 0);
    if (document != NULL) {
        check_text(document, data, size);
    }
    if (status == FR_OK) {
        build(document, &context);
    }
    print_all(context.diags);
    fr_document_free(document);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    return 0;
}
