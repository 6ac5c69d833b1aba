// Shapes that files hold: copied as they are, simplified for levels of detail.
// Garland, Heckbert. Surface Simplification Using Quadric Error Metrics. SIGGRAPH 1997, as done by
// meshoptimizer.
#include "skin/shape.h"

#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

// How far a simplified surface may be off, in parts of its extent.
#define MOST_OFF 0.1F

// The part of a shape; NULL if there is none.
static const FrMeshFile *file_of(const FrPlant *plant, const FrShape *shape) {
    if (shape->detail >= plant->files->len) {
        return NULL;
    }
    const FrMeshFile *file = g_ptr_array_index(plant->files, shape->detail);
    return shape->outline < file->part_count ? file : NULL;
}

uint64_t fr_shape_file_vertices(const FrPlant *plant, const FrShape *shape) {
    const FrMeshFile *file = file_of(plant, shape);
    return file != NULL ? file->parts[shape->outline].index_count : 0;
}

// The part's indices, fewer at every level of detail; to be freed.
static uint32_t *simplified(const FrMeshFile *file, const FrMeshFilePart *part, int lod,
                            size_t *count) {
    const uint32_t *from = file->indices + part->first_index;
    uint32_t *indices = g_memdup2(from, part->index_count * sizeof *from);
    double target = part->index_count;
    for (int k = 0; k < lod; k++) {
        target *= 0.4;
    }
    *count = part->index_count;
    if (lod > 0) {
        *count = meshopt_simplify(indices, from, part->index_count, file->positions[0].raw,
                                  file->vertex_count, sizeof *file->positions,
                                  3 * (size_t)(target / 3), MOST_OFF, 0, NULL);
    }
    return indices;
}

void fr_shape_file(FrShapeMesh *mesh, const FrPlant *plant, const FrShape *shape,
                   const FrDetail *detail) {
    const FrMeshFile *file = file_of(plant, shape);
    if (file == NULL) {
        return;
    }
    mesh->is_foliage = !file->is_closed;
    size_t count;
    uint32_t *indices = simplified(file, &file->parts[shape->outline], detail->lod, &count);
    uint32_t *number = g_new(uint32_t, file->vertex_count);
    memset(number, 0xff, file->vertex_count * sizeof *number);
    for (size_t i = 0; i < count; i++) {
        uint32_t vertex = indices[i];
        if (number[vertex] == FR_NONE) {
            vec3s at = file->positions[vertex], normal = file->normals[vertex];
            for (int k = 0; k < 3; k++) {
                at.raw[k] *= shape->size.raw[k];
                normal.raw[k] /= fmaxf(shape->size.raw[k], 1e-6F);
            }
            float size = sqrtf(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
            normal = (vec3s){{normal.x / size, normal.y / size, normal.z / size}};
            number[vertex] =
                fr_shape_vertex(mesh, at, normal, file->uvs[vertex][0], file->uvs[vertex][1]);
        }
        indices[i] = number[vertex];
    }
    for (size_t i = 0; i + 3 <= count; i += 3) {
        fr_shape_triangle(mesh, indices[i], indices[i + 1], indices[i + 2]);
    }
    g_free(number);
    g_free(indices);
}
