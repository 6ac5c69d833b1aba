// Rational surfaces: a plant of 100 000 branches as control nets, points of surfaces evaluated, and
// triangles cut from them.
#include "bench.h"

#include "frond/nurbs_skin.h"

#include <cglm/struct.h>
#include <string.h>

enum { TREES = 500, BRANCHES = 200, NODES_PER_BRANCH = 5, GRID = 16, SURFACES = 3000 };

static FrPlant *thicket(void) {
    FrPlant *plant = fr_plant_new("thicket");
    versors bend = glms_quatv(0.15F, (vec3s){{1, 0, 0}});
    for (uint32_t t = 0; t < TREES; t++) {
        uint32_t first = plant->nodes.count;
        for (uint32_t b = 0; b < BRANCHES; b++) {
            uint32_t bearer = b == 0 ? FR_NONE : first + (b - 1) * 2;
            vec3s at = {{b == 0 ? (float)t : 0.0F, 0, 0}};
            uint32_t axis = fr_plant_add_axis(plant, bearer, at, 0.03F);
            for (uint32_t i = 0; i < NODES_PER_BRANCH; i++) {
                fr_plant_add_node(plant, axis, bend, 0.1F, 0.03F - 0.004F * (float)i);
            }
        }
    }
    return plant;
}

typedef struct Sweeping {
    FrPlant *plant;
    FrNurbsParams params;
    FrContext context;
    uint64_t surfaces, points, bytes;
    FrNurbsSkin *skin; ///< the last one made
} Sweeping;

static void sweep(void *data) {
    Sweeping *sweeping = data;
    fr_nurbs_skin_free(sweeping->skin);
    FrStatus status =
        fr_nurbs_plant(sweeping->plant, &sweeping->params, &sweeping->context, &sweeping->skin);
    FR_ASSERT(status == FR_OK);
    sweeping->surfaces = sweeping->skin->count;
    sweeping->points = sweeping->skin->point_count;
    sweeping->bytes = fr_nurbs_skin_bytes(sweeping->skin);
}

/// What any way of making them must do at least: fresh memory of that size, written once.
static void plain_store(void *data) {
    const Sweeping *sweeping = data;
    void *bytes = g_malloc(sweeping->bytes);
    memset(bytes, 1, sweeping->bytes);
    bench_keep(bytes);
    g_free(bytes);
}

static void evaluate(void *data) {
    const Sweeping *sweeping = data;
    double sum = 0.0;
    for (uint64_t s = 0; s < SURFACES; s++) {
        const FrNurbsSurface *surface = &sweeping->skin->pieces[3 * s].surface;
        for (int n = 0; n < GRID * GRID; n++) {
            double point[3], along_u[3], along_v[3];
            fr_nurbs_surface_at(surface, (n % GRID) / (GRID - 1.0), (n / GRID) / (GRID - 1.0),
                                point, along_u, along_v);
            sum += point[0] + along_u[1] + along_v[2];
        }
    }
    bench_keep(&sum);
}

typedef struct Meshing {
    const FrPlant *plant;
    FrNurbsParams params;
    FrContext context;
    uint64_t vertices, triangles;
} Meshing;

static void mesh(void *data) {
    Meshing *meshing = data;
    FrMesh *made;
    FrStatus status = fr_nurbs_mesh(meshing->plant, &meshing->params, 0, FR_UP_Z, (FrSpan){0},
                                    &meshing->context, &made);
    FR_ASSERT(status == FR_OK);
    meshing->vertices = made->vertex_count;
    meshing->triangles = made->index_count / 3;
    fr_mesh_free(made);
}

/// What any way of making the vertices must do at least.
static void plain_vertices(void *data) {
    const Meshing *meshing = data;
    size_t size = meshing->vertices * sizeof(FrVertex);
    void *bytes = g_malloc(size);
    memset(bytes, 1, size);
    bench_keep(bytes);
    g_free(bytes);
}

static void bench_meshes(int threads) {
    FrPlant *plant = thicket();
    Meshing meshing = {.plant = plant, .params = fr_nurbs_default()};
    meshing.params.tolerance = 0.002;
    meshing.context = fr_context_default();
    meshing.context.pool = fr_pool_new(threads);
    double seconds = bench_shortest(3, mesh, &meshing);
    double plain = bench_shortest(3, plain_vertices, &meshing);
    double vertices = (double)meshing.vertices;
    bench_tell(
        threads == 1 ? "nurbs.mesh" : "nurbs.mesh-2-threads", vertices / seconds, vertices / plain,
        "vertices/s",
        "%d branches to surfaces and to triangles at most 2 mm away, in %.3f s: %.2f million "
        "vertices, %.2f million triangles, %d thread%s; limit: memset of as many fresh bytes",
        TREES * BRANCHES, seconds, vertices / 1e6, (double)meshing.triangles / 1e6, threads,
        threads == 1 ? "" : "s");
    fr_pool_free(meshing.context.pool);
    fr_plant_free(plant);
}

static void bench_sweeps(int threads) {
    Sweeping sweeping = {.plant = thicket(), .params = fr_nurbs_default()};
    sweeping.context = fr_context_default();
    sweeping.context.pool = fr_pool_new(threads);
    double seconds = bench_shortest(3, sweep, &sweeping);
    double plain = bench_shortest(3, plain_store, &sweeping);
    double surfaces = (double)sweeping.surfaces;
    bench_tell(threads == 1 ? "nurbs.sweep" : "nurbs.sweep-2-threads", surfaces / seconds,
               surfaces / plain, "surfaces/s",
               "%d branches of %d internodes with caps in %.3f s: %.2f million surfaces, %.1f "
               "million control points, %.0f bytes a surface, %d thread%s; limit: memset of as "
               "many fresh bytes",
               TREES * BRANCHES, NODES_PER_BRANCH, seconds, surfaces / 1e6,
               (double)sweeping.points / 1e6, (double)sweeping.bytes / surfaces, threads,
               threads == 1 ? "" : "s");
    if (threads == 1) {
        seconds = bench_shortest(3, evaluate, &sweeping);
        bench_tell("nurbs.evaluate", SURFACES * GRID * GRID / seconds, 0, "points/s",
                   "points with both derivatives, %d × %d on each of %d tubes, 1 thread", GRID,
                   GRID, SURFACES);
    }
    fr_nurbs_skin_free(sweeping.skin);
    fr_pool_free(sweeping.context.pool);
    fr_plant_free(sweeping.plant);
}

void bench_nurbs(void) {
    bench_sweeps(1);
    bench_sweeps(2);
    bench_meshes(1);
    bench_meshes(2);
}
