// Ray density: photons through clouds of leaves with the light back on every leaf, beside plain
// Embree rays; queries; updates; the whole step of a growing room.
#include "bench.h"

#include "frond/light_density.h"
#include "frond/rays.h"
#include "light/density.h"

#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>

enum { PHOTONS = 1 << 20, QUERIES = 10000 };

/// A mesh of rhombic leaves or of walls, every two triangles an element.
typedef struct Mesh {
    FrMesh mesh;
    FrMeshPart part;
    uint32_t *elements;
    FrLightMaterial material;
} Mesh;

static Mesh *new_mesh(uint32_t faces, FrOptics optics) {
    static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
    Mesh *made = g_new0(Mesh, 1);
    made->mesh.vertex_count = 4 * (uint64_t)faces;
    made->mesh.index_count = 6 * (uint64_t)faces;
    made->mesh.vertices = g_new0(FrVertex, made->mesh.vertex_count);
    made->mesh.indices = g_new(uint32_t, made->mesh.index_count);
    made->mesh.parts = &made->part;
    made->mesh.part_count = 1;
    made->part.vertex_count = made->mesh.vertex_count;
    made->part.index_count = made->mesh.index_count;
    made->elements = g_new(uint32_t, 2 * (size_t)faces);
    for (uint32_t i = 0; i < 6 * faces; i++) {
        made->mesh.indices[i] = i / 6 * 4 + order[i % 6];
        made->elements[i / 3] = i / 6;
    }
    made->material = (FrLightMaterial){.front = optics, .back = optics};
    return made;
}

static void free_mesh(Mesh *mesh) {
    g_free(mesh->mesh.vertices);
    g_free(mesh->mesh.indices);
    g_free(mesh->elements);
    g_free(mesh);
}

static void set_corner(Mesh *mesh, uint32_t corner, vec3s at) {
    memcpy(mesh->mesh.vertices[corner].position, at.raw, sizeof at.raw);
}

/// `count` leaves in a box, turned about the turtle's three axes one after the other by any angle.
static Mesh *leaves(uint32_t count, uint64_t seed, vec3s min, vec3s size, float length) {
    Mesh *mesh = new_mesh(count, (FrOptics){.diffuse = 0.1f, .transmit_diffuse = 0.1f});
    for (uint32_t i = 0; i < count; i++) {
        FrKey key = fr_key_child(fr_key_root(seed), i);
        vec3s at;
        float turn[3];
        for (uint32_t c = 0; c < 3; c++) {
            at.raw[c] = min.raw[c] + size.raw[c] * (float)fr_random(key, 1, c);
            turn[c] = (float)(2.0 * G_PI * fr_random(key, 2, c));
        }
        // The turtle starts along y; its up and left axes are z and x.
        versors frame = glms_quat_mul(glms_quat_mul(fr_rotation_about((vec3s){{0, 0, 1}}, turn[0]),
                                                    fr_rotation_about((vec3s){{1, 0, 0}}, turn[1])),
                                      fr_rotation_about((vec3s){{0, 1, 0}}, turn[2]));
        vec3s along = glms_quat_rotatev(frame, (vec3s){{0, length, 0}});
        vec3s across = glms_quat_rotatev(frame, (vec3s){{length / 3.0f, 0, 0}});
        vec3s middle = glms_vec3_add(at, glms_vec3_scale(along, 0.5f));
        set_corner(mesh, 4 * i, at);
        set_corner(mesh, 4 * i + 1, glms_vec3_add(middle, across));
        set_corner(mesh, 4 * i + 2, glms_vec3_add(at, along));
        set_corner(mesh, 4 * i + 3, glms_vec3_sub(middle, across));
    }
    return mesh;
}

typedef struct Cloud {
    FrLightMesh meshes[2];
    FrLightStand stands[2];
    Mesh *made[2];
    FrLamp lamp;
    FrLightScene scene;
    FrContext context;
    FrDensityParams params;
    FrLight *light;
    FrRays *rays;
} Cloud;

static void use(Cloud *cloud, int which, Mesh *mesh) {
    cloud->made[which] = mesh;
    cloud->meshes[which] = (FrLightMesh){.mesh = &mesh->mesh,
                                         .materials = &mesh->material,
                                         .elements = mesh->elements,
                                         .element_count = (uint32_t)mesh->mesh.vertex_count / 4};
    cloud->stands[which] = (FrLightStand){(uint32_t)which, glms_mat4_identity()};
}

static void start_cloud(Cloud *cloud, uint32_t count) {
    cloud->context = fr_context_default();
    cloud->params = fr_density_default();
    cloud->params.photons = PHOTONS;
    cloud->params.bounces = 4; // five meetings
    use(cloud, 0, leaves(count, 1, (vec3s){{0, 0, 0}}, (vec3s){{10, 10, 10}}, 0.06f));
    cloud->lamp = (FrLamp){.kind = FR_LAMP_SUN, .power = 1, .direction = {{0, -1, 0}}};
    cloud->scene = (FrLightScene){.meshes = cloud->meshes,
                                  .mesh_count = 1,
                                  .stands = cloud->stands,
                                  .stand_count = 1,
                                  .lamps = &cloud->lamp,
                                  .lamp_count = 1,
                                  .min = {{-0.06f, -0.06f, -0.06f}},
                                  .max = {{10.06f, 10.06f, 10.06f}}};
}

static void set(Cloud *cloud) {
    FrStatus status = fr_light_set_scene(cloud->light, &cloud->scene, &cloud->context);
    FR_ASSERT(status == FR_OK);
}

static void light_cloud(void *data) {
    Cloud *cloud = data;
    fr_light_free(cloud->light);
    FrStatus status = fr_light_density_new(&cloud->params, &cloud->context, &cloud->light);
    FR_ASSERT(status == FR_OK);
    set(cloud);
}

/// The same photons again, through the search tree that is there.
static void trace_again(void *data) {
    Cloud *cloud = data;
    FrDensity *density = (FrDensity *)(void *)cloud->light;
    FrEmitters *emitters = fr_emitters_new(&cloud->lamp, 1, cloud->scene.min, cloud->scene.max);
    FrStatus status = fr_paths_trace(density->paths, emitters, density->surfaces, &cloud->context);
    FR_ASSERT(status == FR_OK);
    fr_paths_settle(density->paths);
    fr_emitters_free(emitters);
}

/// What Embree alone does with the rays of all paths, in the same order, through the same leaves.
static void plain_rays(void *data) {
    const Cloud *cloud = data;
    const FrPaths *paths = ((FrDensity *)(void *)cloud->light)->paths;
    double sum = 0.0;
    for (uint32_t i = 0; i < paths->count; i++) {
        const FrRay *ray = &paths->rays[i];
        vec3s origin, direction;
        memcpy(origin.raw, ray->origin, sizeof ray->origin);
        memcpy(direction.raw, ray->direction, sizeof ray->direction);
        // Away from the leaf it starts on, which the paths know by its number.
        FrHit hit = fr_rays_trace(cloud->rays, origin, direction, 1e-5f, INFINITY);
        sum += hit.mesh != FR_NONE ? (double)hit.distance : 0.0;
    }
    bench_keep(&sum);
}

/// How many leaves QuasiMC (AlgorithmicBotany/vlab) reaches in a cloud of this kind. It sends its
/// rays from a disc as large as a ball around the scene, of which the cloud takes up only a part,
/// and absorbs nothing: at each of its five meetings a ray leaves most of its weight and goes on.
/// The same here: a box that is as large from the side, and leaves that let every photon go on.
static uint32_t reach_as_weights_do(uint32_t count) {
    Cloud cloud = {0};
    start_cloud(&cloud, count);
    Mesh *mesh = cloud.made[0];
    const FrOptics keeping = {.diffuse = 0.5f, .transmit_diffuse = 0.5f};
    mesh->material = (FrLightMaterial){.front = keeping, .back = keeping};
    float square = 0.0f;
    for (uint32_t v = 0; v < 4 * count; v++) {
        vec3s at;
        memcpy(at.raw, mesh->mesh.vertices[v].position, sizeof at.raw);
        square = fmaxf(square, glms_vec3_distance2(at, (vec3s){{5, 5, 5}}));
    }
    float half = 0.5f * sqrtf((float)G_PI * square);
    for (int c = 0; c < 3; c++) {
        cloud.scene.min.raw[c] = 5.0f - half;
        cloud.scene.max.raw[c] = 5.0f + half;
    }
    light_cloud(&cloud);
    const FrPaths *paths = ((FrDensity *)(void *)cloud.light)->paths;
    uint32_t reached = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t *met = &paths->met[4 * (size_t)i]; // two sides of two triangles
        reached += met[0] + met[1] + met[2] + met[3] > 0;
    }
    fr_light_free(cloud.light);
    free_mesh(mesh);
    return reached;
}

/// `theirs`: how many leaves QuasiMC reaches.
static void bench_cloud(const char *name, const char *rate_name, uint32_t count, uint32_t theirs) {
    Cloud cloud = {0};
    start_cloud(&cloud, count);
    double processor = bench_processor();
    double seconds = bench_shortest(2, light_cloud, &cloud);
    processor = 0.5 * (bench_processor() - processor);
    uint64_t rays = fr_light_stats(cloud.light).rays;
    uint32_t hit = 0;
    double total = 0.0;
    const double *absorbed = fr_light_absorbed(cloud.light, 0);
    for (uint32_t i = 0; i < count; i++) {
        hit += absorbed[i] > 0.0;
        total += absorbed[i];
    }
    bench_tell(name, PHOTONS / seconds, 0, "photons/s",
               "%u leaves, %d photons, %" G_GUINT64_FORMAT " rays, light back on every leaf, in "
               "%.2f s on one thread (%.2f s of processor), search tree included: %u leaves hit, "
               "total %.2f, %.0f MB; with rays that lose weight instead of ending %u leaves, "
               "QuasiMC %u",
               count, PHOTONS, rays, seconds, processor, hit, total,
               (double)fr_light_stats(cloud.light).bytes / 1e6, reach_as_weights_do(count), theirs);
    cloud.rays = fr_rays_new(NULL, NULL);
    fr_rays_add_stand(cloud.rays, fr_rays_add_mesh(cloud.rays, &cloud.made[0]->mesh),
                      glms_mat4_identity());
    fr_rays_commit(cloud.rays);
    double traced = bench_shortest(3, trace_again, &cloud);
    double plain = bench_shortest(3, plain_rays, &cloud);
    bench_tell(rate_name, (double)rays / traced, (double)rays / plain, "rays/s",
               "%" G_GUINT64_FORMAT " rays traced and stored in %.2f s, 1 thread; limit: Embree "
               "alone on the same rays in the same order",
               rays, traced);
    fr_rays_free(cloud.rays);
    fr_light_free(cloud.light);
    free_mesh(cloud.made[0]);
}

/// A new branch in the cloud, of a size that cuts some twentieth of the rays.
static void bench_update(void) {
    Cloud cloud = {0};
    start_cloud(&cloud, 250000);
    double full = bench_shortest(1, light_cloud, &cloud);
    double traced = bench_shortest(2, trace_again, &cloud);
    set(&cloud);
    uint64_t rays = fr_light_stats(cloud.light).rays;
    use(&cloud, 1,
        leaves(15000, 2, (vec3s){{3.3f, 7.5f, 3.3f}}, (vec3s){{2.7f, 1.5f, 2.7f}}, 0.06f));
    cloud.scene.mesh_count = 2;
    cloud.scene.stand_count = 2;
    double start = bench_now();
    set(&cloud);
    double seconds = bench_now() - start;
    uint64_t recast = fr_light_stats(cloud.light).recast;
    bench_tell("density.update", (double)recast / seconds, (double)rays / traced, "rays/s",
               "15000 leaves more among 250000: %.1f %% of %" G_GUINT64_FORMAT " rays traced again "
               "in %.3f s, 1/%.1f of a full trace (%.2f s), 1/%.1f of a new light (%.2f s), 1 "
               "thread; limit: the full trace's rate",
               100.0 * (double)recast / (double)rays, rays, seconds, traced / seconds, traced,
               full / seconds, full);
    fr_light_free(cloud.light);
    free_mesh(cloud.made[0]);
    free_mesh(cloud.made[1]);
}

typedef struct Room {
    Cloud cloud;
    vec3s points[QUERIES];
    FrLightAnswer answers[QUERIES];
} Room;

/// A room of 5 × 5 × 3 m with white walls and a long lamp at its ceiling.
static void start_room(Room *room, int threads) {
    Cloud *cloud = &room->cloud;
    static const vec3s corner[8] = {{{0, 0, 0}}, {{5, 0, 0}}, {{5, 5, 0}}, {{0, 5, 0}},
                                    {{0, 0, 3}}, {{5, 0, 3}}, {{5, 5, 3}}, {{0, 5, 3}}};
    static const int faces[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                    {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
    Mesh *walls = new_mesh(6, (FrOptics){.diffuse = 0.5f});
    for (uint32_t i = 0; i < 24; i++) {
        set_corner(walls, i, corner[faces[i / 4][i % 4]]);
    }
    use(cloud, 0, walls);
    cloud->context = fr_context_default();
    cloud->context.pool = fr_pool_new(threads);
    cloud->params = fr_density_default();
    cloud->params.photons = 1000000;
    cloud->lamp = (FrLamp){.kind = FR_LAMP_AREA,
                           .power = 40,
                           .position = {{1.5f, 2.4f, 2.99f}},
                           .side = {{{0, 0.2f, 0}}, {{2, 0, 0}}}};
    cloud->scene = (FrLightScene){.meshes = cloud->meshes,
                                  .mesh_count = 1,
                                  .stands = cloud->stands,
                                  .stand_count = 1,
                                  .lamps = &cloud->lamp,
                                  .lamp_count = 1,
                                  .max = {{5, 5, 3}}};
    // Four plants of half a metre ask for light where they grow.
    for (uint32_t i = 0; i < QUERIES; i++) {
        FrKey key = fr_key_child(fr_key_root(3), i);
        const float at[2] = {i % 2 == 0 ? 1.2f : 3.6f, i % 4 < 2 ? 1.1f : 3.4f};
        for (uint32_t c = 0; c < 3; c++) {
            room->points[i].raw[c] = (c < 2 ? at[c] : 0.2f) + 0.5f * (float)fr_random(key, 1, c);
        }
    }
}

static void ask(void *data) {
    Room *room = data;
    FrStatus status = fr_light_query(room->cloud.light, room->points, QUERIES, &room->cloud.context,
                                     room->answers);
    FR_ASSERT(status == FR_OK);
}

/// One step of growth: new leaves, their light, and the next round of points.
static double grow_room(Room *room, uint32_t step) {
    Cloud *cloud = &room->cloud;
    Mesh *grown =
        leaves(500 * step, 7, (vec3s){{1.2f, 1.1f, 0.2f}}, (vec3s){{0.5f, 0.5f, 0.5f}}, 0.06f);
    if (cloud->made[1] != NULL) {
        free_mesh(cloud->made[1]);
    }
    use(cloud, 1, grown);
    cloud->scene.mesh_count = 2;
    cloud->scene.stand_count = 2;
    double start = bench_now();
    set(cloud);
    ask(room);
    fr_light_forget(cloud->light);
    return bench_now() - start;
}

/// The other estimators at the same points.
static void bench_estimators(Room *room) {
    static const char *const names[3] = {NULL, "density.query-nearest", "density.query-track"};
    FrDensity *density = (FrDensity *)(void *)room->cloud.light;
    for (int estimator = 1; estimator < 3; estimator++) {
        density->params.estimator = estimator;
        double seconds = bench_shortest(2, ask, room);
        bench_tell(names[estimator], QUERIES / seconds, 0, "queries/s",
                   "the same points, %s, 1 thread",
                   estimator == 1 ? "50 nearest rays" : "lengths of rays within the distance");
    }
    density->params.estimator = 0;
}

static void bench_room(int threads) {
    Room *room = g_new0(Room, 1);
    start_room(room, threads);
    double processor = bench_processor(), start = bench_now();
    light_cloud(&room->cloud);
    double traced = bench_now() - start;
    start = bench_now();
    ask(room);
    double first = bench_now() - start;
    double first_processor = bench_processor() - processor;
    double again = bench_shortest(3, ask, room);
    FrLightStats stats = fr_light_stats(room->cloud.light);
    uint64_t samples = 0;
    for (int i = 0; i < QUERIES; i++) {
        samples += room->answers[i].samples;
    }
    bench_tell(threads == 1 ? "density.query" : "density.query-2-threads", QUERIES / again, 0,
               "queries/s",
               "%d points in a room, %.0f rays each of %" G_GUINT64_FORMAT
               ", %d threads; the first time %.2f s with %" G_GUINT64_FORMAT " cells to make",
               QUERIES, (double)samples / QUERIES, stats.rays, threads, first, stats.cells);
    if (threads == 1) {
        bench_estimators(room);
    }
    double sum = 0.0;
    processor = bench_processor();
    for (uint32_t step = 1; step <= 5; step++) {
        sum += grow_room(room, step);
    }
    processor = bench_processor() - processor;
    bench_tell(threads == 1 ? "density.step" : "density.step-2-threads", 5.0 / sum, 0, "steps/s",
               "a million photons, 500 leaves more and %d queries a step: %.2f s a step (%.2f s of "
               "processor), the first with all photons %.2f s (%.2f s), %d threads",
               QUERIES, sum / 5.0, processor / 5.0, traced + first, first_processor, threads);
    fr_light_free(room->cloud.light);
    fr_pool_free(room->cloud.context.pool);
    free_mesh(room->cloud.made[0]);
    free_mesh(room->cloud.made[1]);
    g_free(room);
}

void bench_density(void) {
    bench_cloud("density.photon-25k", "density.rays-25k", 25000, 22403);
    bench_cloud("density.photon-250k", "density.rays-250k", 250000, 213749);
    bench_update();
    bench_room(1);
    bench_room(2);
}
