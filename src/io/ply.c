// Stanford PLY, binary little endian, z up: one mesh of everything, with normals and coordinates.
#include "io/formats.h"
#include "io/meshes.h"
#include "io/output.h"

#include <string.h>

typedef struct FrPly {
    const FrScene *scene;
    const FrContext *context;
    FrIoMeshes meshes;
    uint64_t bytes;
} FrPly;

static void add_header(const FrPly *ply, FrOutput *output) {
    char *header = g_strdup_printf(
        "ply\nformat binary_little_endian 1.0\ncomment Frond " FR_VERSION ", metres, z up\n"
        "element vertex %" G_GUINT64_FORMAT "\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "property float s\nproperty float t\n"
        "element face %" G_GUINT64_FORMAT "\n"
        "property list uchar uint vertex_indices\nend_header\n",
        ply->meshes.count.vertices_everywhere, ply->meshes.count.triangles_everywhere);
    fr_output_text(output, header);
    g_free(header);
}

static void add_vertices(FrOutput *output, const FrMesh *mesh, const FrStand *stand) {
    FrPose pose = fr_io_pose(stand, FR_UP_Z);
    for (uint64_t v = 0; v < mesh->vertex_count; v++) {
        FrVertex vertex = fr_io_posed(&pose, &mesh->vertices[v]);
        vertex.uv[1] = 1.0f - vertex.uv[1]; // rows count from the bottom
        memcpy(fr_output_room(output, sizeof vertex), &vertex, sizeof vertex);
        output->used += sizeof vertex;
    }
}

static void add_faces(FrOutput *output, const FrMesh *mesh, uint32_t first) {
    enum { FACE = 1 + 3 * sizeof(uint32_t) };
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        uint32_t base = first + (uint32_t)part->first_vertex;
        const uint32_t *corner = mesh->indices + part->first_index;
        for (uint64_t i = 0; i + 2 < part->index_count; i += 3) {
            char *face = fr_output_room(output, FACE);
            uint32_t corners[3] = {base + corner[i], base + corner[i + 1], base + corner[i + 2]};
            face[0] = 3;
            memcpy(face + 1, corners, sizeof corners);
            output->used += FACE;
        }
    }
}

static bool write_ply(void *user, int descriptor) {
    FrPly *ply = user;
    const GArray *stands = ply->scene->stands;
    FrOutput output;
    fr_output_start(&output, descriptor, ply->context->progress);
    add_header(ply, &output);
    for (guint s = 0; s < stands->len && output.error == 0; s++) {
        const FrStand *stand = fr_io_stand(ply->scene, s);
        add_vertices(&output, ply->meshes.meshes[stand->plant], stand);
        fr_progress_report(ply->context->progress, "write", 0.5 * (s + 1) / stands->len);
    }
    uint64_t first = 0;
    for (guint s = 0; s < stands->len && output.error == 0; s++) {
        const FrMesh *mesh = ply->meshes.meshes[fr_io_stand(ply->scene, s)->plant];
        add_faces(&output, mesh, (uint32_t)first);
        first += mesh->vertex_count;
        fr_progress_report(ply->context->progress, "write", 0.5 + 0.5 * (s + 1) / stands->len);
    }
    bool is_whole = fr_output_finish(&output);
    ply->bytes = output.done;
    return is_whole;
}

FrStatus fr_ply_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats) {
    FrPly ply = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status = fr_io_meshes_make(&ply.meshes, scene, &options->skin, FR_UP_Z, true, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    const FrIoCount *count = &ply.meshes.count;
    status = fr_limit_check(count->vertices_everywhere, UINT32_MAX, "vertices", "a .ply file",
                            fr_io_largest_place(&ply.meshes, scene), context->diags);
    if (status == FR_OK) {
        status = fr_io_replace_file(path, write_ply, &ply, context->diags);
    }
    *stats = (FrIoStats){
        .meshes = count->meshes,
        .vertices = count->vertices_everywhere,
        .triangles = count->triangles_everywhere,
        .bytes = ply.bytes,
        .skin_seconds = (double)(skinned - start) * 1e-6,
        .write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6,
    };
    fr_io_meshes_clear(&ply.meshes);
    return status;
}
