// Meshes: tubes alone, and the shipped chestnut from its document to a mesh in memory.
#include "bench.h"

#include <cglm/struct.h>
#include <string.h>

enum { AXES = 20000, NODES_PER_AXIS = 24 };

/// Bent stems side by side, thick enough for eight sides.
static FrPlant *stems(void) {
    FrPlant *plant = fr_plant_new("stems");
    versors bend = glms_quatv(0.15f, (vec3s){{1, 0, 0}});
    for (uint32_t a = 0; a < AXES; a++) {
        uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{(float)a, 0, 0}}, 0.03f);
        for (uint32_t i = 0; i < NODES_PER_AXIS; i++) {
            fr_plant_add_node(plant, axis, bend, 0.1f, 0.03f - 0.001f * (float)i);
        }
    }
    return plant;
}

typedef struct Skinning {
    FrPlant *plant;
    FrSkinParams params;
    FrContext context;
    uint64_t vertices, triangles;

} Skinning;

static void skin(void *data) {
    Skinning *skinning = data;
    FrMesh *mesh;
    FrStatus status =
        fr_skin_plant(skinning->plant, &skinning->params, FR_UP_Y, &skinning->context, &mesh);
    FR_ASSERT(status == FR_OK);
    skinning->vertices = mesh->vertex_count;
    skinning->triangles = mesh->index_count / 3;
    fr_mesh_free(mesh);
}

/// What any mesher must do at least: fresh memory of that size, written once.
static void plain_store(void *data) {
    Skinning *skinning = data;
    size_t vertices = skinning->vertices * sizeof(FrVertex);
    size_t indices = skinning->triangles * 3 * sizeof(uint32_t);
    void *a = g_malloc(vertices);
    void *b = g_malloc(indices);
    memset(a, 1, vertices);
    memset(b, 1, indices);
    bench_keep(a);
    bench_keep(b);
    g_free(a);
    g_free(b);
}

static void bench_tubes(int threads) {
    Skinning skinning = {.plant = stems(), .params = fr_skin_default()};
    skinning.params.bend = 0.01; // a ring at every node
    skinning.context = fr_context_default();
    skinning.context.pool = fr_pool_new(threads);
    double seconds = bench_shortest(4, skin, &skinning);
    double plain = bench_shortest(4, plain_store, &skinning);
    double triangles = (double)skinning.triangles;
    bench_tell(threads == 1 ? "skin.tubes" : "skin.tubes-2-threads", triangles / seconds,
               triangles / plain, "triangles/s",
               "%.1f million triangles, %.1f million vertices of 32 bytes with indices, %d stems "
               "of %d internodes, %d thread%s; limit: memset of as many fresh bytes",
               triangles / 1e6, (double)skinning.vertices / 1e6, AXES, NODES_PER_AXIS, threads,
               threads == 1 ? "" : "s");
    fr_pool_free(skinning.context.pool);
    fr_plant_free(skinning.plant);
}

typedef struct Growing {
    FrContext context;
    const char *path;
    double read, build, skin;
    uint64_t organs, triangles;
} Growing;

static void grow(void *data) {
    Growing *growing = data;
    double start = bench_now();
    FrDocument *document;
    FrScene *scene;
    FrMesh *mesh;
    FrSkinParams params = fr_skin_default();
    FrStatus status = fr_document_load(growing->path, &growing->context, &document);
    FR_ASSERT(status == FR_OK);
    double loaded = bench_now();
    status = fr_scene_build(document, -1, &growing->context, &scene);
    FR_ASSERT(status == FR_OK);
    double built = bench_now();
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, 0).plant;
    status = fr_skin_plant(plant, &params, FR_UP_Y, &growing->context, &mesh);
    FR_ASSERT(status == FR_OK);
    growing->read = loaded - start;
    growing->build = built - loaded;
    growing->skin = bench_now() - built;
    growing->organs = plant->organs.count;
    growing->triangles = mesh->index_count / 3;
    fr_mesh_free(mesh);
    fr_scene_free(scene);
    fr_document_free(document);
}

static void bench_chestnut(void) {
    Growing growing = {.context = fr_context_default(), .path = BENCH_EXAMPLES "/chestnut.frond"};
    growing.context.pool = fr_pool_new(2);
    double seconds = bench_shortest(5, grow, &growing);
    bench_tell("skin.chestnut", 1.0 / seconds, 0, "trees/s",
               "examples/chestnut.frond from the file to a mesh in memory, freed again, in %.3f s "
               "(last run: read %.3f, build %.3f, skin %.3f): %" G_GUINT64_FORMAT
               " leaves, %.2f million triangles, 2 threads",
               seconds, growing.read, growing.build, growing.skin, growing.organs,
               (double)growing.triangles / 1e6);
    fr_pool_free(growing.context.pool);
}

void bench_skin(void) {
    bench_tubes(1);
    bench_tubes(2);
    bench_chestnut();
}
