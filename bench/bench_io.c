// Model files of ten million triangles, beside one write() of as many bytes.
#include "bench.h"

#include <cglm/struct.h>
#include <fcntl.h>
#include <glib/gstdio.h>
#include <string.h>
#include <unistd.h>

enum { NODES_PER_AXIS = 24, TRIANGLES = 10000000 };

static FrScene *scene_of(FrPlant *plant) {
    FrScene *scene = g_new0(FrScene, 1);
    scene->name = g_strdup("bench");
    scene->plants = g_array_new(FALSE, FALSE, sizeof(FrScenePlant));
    scene->stands = g_array_new(FALSE, FALSE, sizeof(FrStand));
    scene->views = g_ptr_array_new();
    FrScenePlant entry = {.plant = plant, .instances = 1};
    FrStand stand = {.scale = 1.0};
    g_array_append_val(scene->plants, entry);
    g_array_append_val(scene->stands, stand);
    return scene;
}

/// Stems side by side.
static FrPlant *stems(uint32_t axes) {
    FrPlant *plant = fr_plant_new("stems");
    versors bend = glms_quatv(0.15f, (vec3s){{1, 0, 0}});
    for (uint32_t a = 0; a < axes; a++) {
        uint32_t axis =
            fr_plant_add_axis(plant, FR_NONE, (vec3s){{(float)(a % 1000), 0, 0}}, 0.03f);
        for (uint32_t i = 0; i < NODES_PER_AXIS; i++) {
            fr_plant_add_node(plant, axis, bend, 0.1f, 0.03f - 0.001f * (float)i);
        }
    }
    return plant;
}

static uint64_t triangles_of(const FrPlant *plant, const FrSkinParams *params) {
    FrContext context = fr_context_default();
    FrMesh *mesh;
    FrStatus status = fr_skin_plant(plant, params, FR_UP_Y, &context, &mesh);
    FR_ASSERT(status == FR_OK);
    uint64_t triangles = mesh->index_count / 3;
    fr_mesh_free(mesh);
    return triangles;
}

/// Seconds to write so many bytes from memory at once, with and without waiting for the disk.
static double plain_write(const char *path, uint64_t bytes, bool waits) {
    char *data = g_malloc(bytes);
    memset(data, 1, bytes);
    double start = bench_now();
    int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    for (uint64_t done = 0; done < bytes;) {
        ssize_t written = write(descriptor, data + done, bytes - done);
        FR_ASSERT(written > 0);
        done += (uint64_t)written;
    }
    if (waits) {
        fsync(descriptor);
    }
    close(descriptor);
    double seconds = bench_now() - start;
    g_free(data);
    return seconds;
}

static void bench_format(const FrScene *scene, const char *folder, const char *extension,
                         const FrIoOptions *options) {
    char *path = g_strdup_printf("%s/model%s", folder, extension);
    char *name = g_strdup_printf("io%s", extension);
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(0);
    FrIoStats stats = {.write_seconds = 1e30};
    double shortest = 1e30;
    for (int i = 0; i < 3; i++) {
        FrStatus status = fr_io_write(scene, path, options, &context, &stats);
        FR_ASSERT(status == FR_OK);
        shortest = MIN(shortest, stats.write_seconds);
    }
    double cached = plain_write(path, stats.bytes, false);
    double flushed = plain_write(path, stats.bytes, true);
    g_remove(path);
    double triangles = (double)stats.triangles;
    bench_tell(g_intern_string(name), triangles / shortest, triangles / flushed, "triangles/s",
               "%.1f million triangles, %.0f MB written in %.3f s until it is on the disk; limit: "
               "write and fsync of as many bytes (%.3f s; to the page cache alone %.3f s)",
               triangles / 1e6, (double)stats.bytes / 1e6, shortest, flushed, cached);
    fr_pool_free(context.pool);
    g_free(name);
    g_free(path);
}

void bench_io(void) {
    FrIoOptions options = fr_io_options_default();
    options.skin.bend = 0.5;
    FrPlant *sample = stems(100);
    uint64_t each = MAX(triangles_of(sample, &options.skin) / 100, 1);
    fr_plant_free(sample);
    FrPlant *plant = stems((uint32_t)(TRIANGLES / each));
    FrScene *scene = scene_of(plant);
    char *folder = g_dir_make_tmp("frond-bench-XXXXXX", NULL);
    bench_format(scene, folder, ".glb", &options);
    bench_format(scene, folder, ".stl", &options);
    bench_format(scene, folder, ".ply", &options);
    g_rmdir(folder);
    g_free(folder);
    fr_scene_free(scene);
    fr_plant_free(plant);
}
