// STL, binary, z up: triangles and nothing else, for printers and mesh repair.
#include "io/formats.h"
#include "io/meshes.h"
#include "io/output.h"

#include <math.h>
#include <string.h>

typedef struct FrStl {
    const FrScene *scene;
    const FrContext *context;
    FrIoMeshes meshes;
    uint64_t bytes;
} FrStl;

/// The unit normal of a face, or zero for one without area, as the format wants.
static void face_normal(float corners[3][3], float normal[3]) {
    double a[3];
    double b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)corners[1][k] - (double)corners[0][k];
        b[k] = (double)corners[2][k] - (double)corners[0][k];
    }
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) {
        normal[k] = length > 0.0 ? (float)(n[k] / length) : 0.0f;
    }
}

static void add_mesh(FrOutput *output, const FrMesh *mesh, const FrStand *stand) {
    enum { FACE = 12 * sizeof(float) + sizeof(uint16_t) };
    FrPose pose = fr_io_pose(stand, FR_UP_Z);
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        const FrVertex *vertices = mesh->vertices + part->first_vertex;
        const uint32_t *index = mesh->indices + part->first_index;
        for (uint64_t i = 0; i + 2 < part->index_count; i += 3) {
            float corners[3][3];
            float normal[3];
            for (int k = 0; k < 3; k++) {
                FrVertex vertex = fr_io_posed(&pose, &vertices[index[i + (uint64_t)k]]);
                memcpy(corners[k], vertex.position, sizeof corners[k]);
            }
            face_normal(corners, normal);
            char *face = fr_output_room(output, FACE);
            memcpy(face, normal, sizeof normal);
            memcpy(face + sizeof normal, corners, sizeof corners);
            memset(face + 12 * sizeof(float), 0, sizeof(uint16_t));
            output->used += FACE;
        }
    }
}

static bool write_stl(void *user, int descriptor) {
    FrStl *stl = user;
    const GArray *stands = stl->scene->stands;
    FrOutput output;
    fr_output_start(&output, descriptor, stl->context->progress);
    char header[80] = "Frond " FR_VERSION ", metres, z up";
    uint32_t count = (uint32_t)stl->meshes.count.triangles_everywhere;
    fr_output_bytes(&output, header, sizeof header);
    fr_output_bytes(&output, &count, sizeof count);
    for (guint s = 0; s < stands->len && output.error == 0; s++) {
        const FrStand *stand = fr_io_stand(stl->scene, s);
        add_mesh(&output, stl->meshes.meshes[stand->plant], stand);
        fr_progress_report(stl->context->progress, "write", (double)(s + 1) / stands->len);
    }
    bool is_whole = fr_output_finish(&output);
    stl->bytes = output.done;
    return is_whole;
}

FrStatus fr_stl_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats) {
    FrStl stl = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status = fr_io_meshes_make(&stl.meshes, scene, &options->skin, FR_UP_Z, true, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    const FrIoCount *count = &stl.meshes.count;
    status = fr_limit_check(count->triangles_everywhere, UINT32_MAX, "triangles", "a .stl file",
                            fr_io_largest_place(&stl.meshes, scene), context->diags);
    if (status == FR_OK) {
        status = fr_io_replace_file(path, write_stl, &stl, context->diags);
    }
    *stats = (FrIoStats){
        .meshes = count->meshes,
        .vertices = count->vertices_everywhere,
        .triangles = count->triangles_everywhere,
        .bytes = stl.bytes,
        .skin_seconds = (double)(skinned - start) * 1e-6,
        .write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6,
    };
    fr_io_meshes_clear(&stl.meshes);
    return status;
}
