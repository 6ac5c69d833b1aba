// Meshes: memory and digest.
#include "skin/mesh.h"

#include <stdlib.h>
#include <sys/mman.h>

// Arrays are written once from end to end; huge pages spare most of the page faults of that.
void *fr_mesh_allocate(uint64_t bytes) {
    const size_t huge = 2 << 20;
    if (bytes < huge) {
        return malloc(bytes > 0 ? bytes : 1);
    }
    void *memory = NULL;
    if (posix_memalign(&memory, huge, bytes) != 0) {
        return NULL;
    }
    madvise(memory, bytes, MADV_HUGEPAGE);
    return memory;
}

FrMesh *fr_mesh_new(uint64_t vertices, uint64_t indices, uint32_t parts) {
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->vertex_count = vertices;
    mesh->index_count = indices;
    mesh->part_count = parts;
    mesh->parts = g_new0(FrMeshPart, parts);
    mesh->vertices = fr_mesh_allocate(vertices * sizeof(FrVertex));
    mesh->indices = fr_mesh_allocate(indices * sizeof(uint32_t));
    if (mesh->vertices == NULL || mesh->indices == NULL) {
        fr_mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

void fr_mesh_free(FrMesh *mesh) {
    if (mesh != NULL) {
        free(mesh->vertices);
        free(mesh->indices);
        g_free(mesh->parts);
        g_free(mesh);
    }
}

void fr_part_set_box(FrMeshPart *part, const float min[3], const float max[3]) {
    for (int k = 0; k < 3; k++) {
        part->min[k] = min[k] + 0.0F;
        part->max[k] = max[k] + 0.0F;
    }
}

FrDigest fr_mesh_digest(const FrMesh *mesh) {
    FrDigest digest = fr_digest(0, mesh->vertices, mesh->vertex_count * sizeof(FrVertex));
    digest = fr_digest(digest, mesh->indices, mesh->index_count * sizeof(uint32_t));
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const FrMeshPart *part = &mesh->parts[i];
        const uint64_t numbers[] = {part->material,     part->is_foliage,  part->first_vertex,
                                    part->vertex_count, part->first_index, part->index_count};
        digest = fr_digest(digest, numbers, sizeof numbers);
        digest = fr_digest(digest, part->min, sizeof part->min);
        digest = fr_digest(digest, part->max, sizeof part->max);
    }
    return digest;
}

void fr_mesh_uv(const FrMesh *mesh, uint32_t part, uint32_t triangle, float u, float v,
                float uv[2]) {
    const FrMeshPart *range = &mesh->parts[part];
    const FrVertex *vertices = mesh->vertices + range->first_vertex;
    const uint32_t *corner = mesh->indices + range->first_index + 3 * (uint64_t)triangle;
    const float *a = vertices[corner[0]].uv;
    const float *b = vertices[corner[1]].uv;
    const float *c = vertices[corner[2]].uv;
    float w = 1.0f - u - v;
    uv[0] = w * a[0] + u * b[0] + v * c[0];
    uv[1] = w * a[1] + u * b[1] + v * c[1];
}
