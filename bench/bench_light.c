// Views of the sky through a cloud of leaves, shadow voxels, and the growth loop of the room of
// four flowers.
#include "bench.h"

#include "frond/shadows.h"
#include "frond/sky_views.h"

#include <cglm/struct.h>
#include <math.h>

enum { LEAVES = 50000, QUERIES = 20000, CASTS = 200000, STEPS = 12 };

// Voxels in a pyramid of depth 6.
#define PYRAMID 455

static vec3s random_point(uint64_t seed, uint32_t i, float size) {
    FrKey key = fr_key_child(fr_key_root(seed), i);
    return (vec3s){{size * (float)fr_random(key, 0, 0), size * (float)fr_random(key, 1, 0),
                    size * (float)fr_random(key, 2, 0)}};
}

/// Triangles of 4 by 6 cm at random in a cube of 10 m.
static FrMesh *leaf_cloud(FrMeshPart *part) {
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->vertex_count = mesh->index_count = UINT64_C(3) * LEAVES;
    mesh->vertices = g_new0(FrVertex, mesh->vertex_count);
    mesh->indices = g_new(uint32_t, mesh->index_count);
    mesh->parts = part;
    mesh->part_count = 1;
    *part = (FrMeshPart){.vertex_count = mesh->vertex_count, .index_count = mesh->index_count};
    for (uint32_t i = 0; i < 3 * LEAVES; i++) {
        vec3s at = glms_vec3_add(random_point(1, i / 3, 10), random_point(2, i, 0.06f));
        memcpy(mesh->vertices[i].position, at.raw, sizeof at.raw);
        mesh->indices[i] = i;
    }
    return mesh;
}

typedef struct Views {
    FrLight *light;
    vec3s *points;
    FrLightAnswer *answers;
    FrContext context;
} Views;

static void ask(void *data) {
    Views *views = data;
    FrStatus status =
        fr_light_query(views->light, views->points, QUERIES, &views->context, views->answers);
    FR_ASSERT(status == FR_OK);
}

static void bench_views(int threads) {
    FrMeshPart part;
    FrMesh *mesh = leaf_cloud(&part);
    FrLightMaterial material = {.front = {.diffuse = 0.1f}, .back = {.diffuse = 0.1f}};
    FrLightMesh lit = {.mesh = mesh, .materials = &material};
    FrLightStand stand = {.transform = glms_mat4_identity()};
    FrLamp sky = {.kind = FR_LAMP_SKY, .power = 1};
    FrLightScene scene = {.meshes = &lit,
                          .mesh_count = 1,
                          .stands = &stand,
                          .stand_count = 1,
                          .lamps = &sky,
                          .lamp_count = 1,
                          .min = {{1, 1, 1}}};
    FrSkyViewSettings settings = fr_sky_views_default();
    Views views = {.light = fr_sky_views_new(&settings),
                   .points = g_new(vec3s, QUERIES),
                   .answers = g_new(FrLightAnswer, QUERIES),
                   .context = fr_context_default()};
    views.context.pool = fr_pool_new(threads);
    for (uint32_t i = 0; i < QUERIES; i++) {
        views.points[i] = random_point(3, i, 10);
    }
    FrStatus status = fr_light_set_scene(views.light, &scene, &views.context);
    FR_ASSERT(status == FR_OK);
    double processor = bench_processor();
    double seconds = bench_shortest(3, ask, &views);
    processor = (bench_processor() - processor) / 3.0;
    bench_tell(threads == 1 ? "light.views" : "light.views2", QUERIES / seconds, 0, "queries/s",
               "%d points with 20 views each through %d leaves, %d thread%s: %.3f s, %.3f s of "
               "processor",
               QUERIES, LEAVES, threads, threads == 1 ? "" : "s", seconds, processor);
    fr_light_free(views.light);
    fr_pool_free(views.context.pool);
    g_free(views.points);
    g_free(views.answers);
    g_free(mesh->vertices);
    g_free(mesh->indices);
    g_free(mesh);
}

typedef struct Shadows {
    FrShadows *shadows;
    vec3s *points;
    FrContext context;
} Shadows;

static void cast(void *data) {
    Shadows *shadows = data;
    fr_shadows_cast(shadows->shadows, shadows->points, CASTS, false, &shadows->context);
}

static void bench_shadows(void) {
    Shadows shadows = {.points = g_new(vec3s, CASTS), .context = fr_context_default()};
    FrShadowSettings settings = fr_shadows_default();
    FrStatus status = fr_shadows_new(&settings, &shadows.context, &shadows.shadows);
    FR_ASSERT(status == FR_OK);
    for (uint32_t i = 0; i < CASTS; i++) {
        vec3s shift = {{-100, -100, 0}};
        shadows.points[i] = glms_vec3_add(random_point(4, i, 200), shift);
    }
    double seconds = bench_shortest(3, cast, &shadows);
    bench_tell("light.shadows", (double)CASTS * PYRAMID / seconds, 0, "voxels/s",
               "%d pyramids of %d voxels into 201^3, one thread", CASTS, PYRAMID);
    fr_shadows_free(shadows.shadows);
    g_free(shadows.points);
}

static void bench_loop(void) {
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(2);
    FrDocument *document;
    FrScene *scene;
    FrStatus status = fr_document_load(BENCH_EXAMPLES "/room-flowers.frond", &context, &document);
    FR_ASSERT(status == FR_OK);
    char *steps = g_strdup_printf("%d", STEPS);
    status = fr_document_set(document, "light.photons", "1000000", &context);
    status = MAX(status, fr_document_set(document, "lsystem.steps", steps, &context));
    FR_ASSERT(status == FR_OK);
    double processor = bench_processor(), began = bench_now();
    status = fr_scene_build(document, -1, &context, &scene);
    FR_ASSERT(status == FR_OK);
    double seconds = bench_now() - began;
    processor = bench_processor() - processor;
    const FrSceneStep *first = &g_array_index(scene->steps, FrSceneStep, 0);
    bench_tell("light.loop", STEPS / seconds, 0, "steps/s",
               "four flowers in a room, 10^6 photons, 2 threads: %.2f s a step (%.2f s of "
               "processor), the first %.2f s",
               seconds / STEPS, processor / STEPS, first->seconds);
    g_free(steps);
    fr_scene_free(scene);
    fr_document_free(document);
    fr_pool_free(context.pool);
}

void bench_light(void) {
    bench_views(1);
    bench_views(2);
    bench_shadows();
    bench_loop();
}
