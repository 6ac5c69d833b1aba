// Tangents from texture coordinates (Lengyel 2001, Computing tangent space basis vectors for an
// arbitrary mesh): each triangle adds its direction of growing u to its corners, weighted by its
// area in the picture; then the sum is made perpendicular to the normal.
#include "io/tangents.h"

#include <math.h>
#include <string.h>

typedef struct FrTangents {
    const FrVertex *vertices;
    float (*tangent)[4];
} FrTangents;

static void add_triangle(FrTangents *tangents, const uint32_t corners[3]) {
    const FrVertex *a = &tangents->vertices[corners[0]];
    const FrVertex *b = &tangents->vertices[corners[1]];
    const FrVertex *c = &tangents->vertices[corners[2]];
    float du1 = b->uv[0] - a->uv[0];
    float dv1 = b->uv[1] - a->uv[1];
    float du2 = c->uv[0] - a->uv[0];
    float dv2 = c->uv[1] - a->uv[1];
    float area = du1 * dv2 - du2 * dv1;
    float sign = area < 0.0f ? -1.0f : 1.0f;
    float sum[4];
    for (int k = 0; k < 3; k++) {
        sum[k] = sign * ((b->position[k] - a->position[k]) * dv2 -
                         (c->position[k] - a->position[k]) * dv1);
    }
    sum[3] = area;
    for (int corner = 0; corner < 3; corner++) {
        float *tangent = tangents->tangent[corners[corner]];
        for (int k = 0; k < 4; k++) {
            tangent[k] += sum[k];
        }
    }
}

/// Some unit vector perpendicular to a unit vector (Duff et al. 2017).
static void perpendicular(const float n[3], float t[4]) {
    float sign = copysignf(1.0f, n[2]);
    float a = -1.0f / (sign + n[2]);
    t[0] = 1.0f + sign * n[0] * n[0] * a;
    t[1] = sign * n[0] * n[1] * a;
    t[2] = -sign * n[0];
}

static void finish_vertices(void *data, size_t begin, size_t end, int worker) {
    FrTangents *tangents = data;
    (void)worker;
    for (size_t v = begin; v < end; v++) {
        const float *n = tangents->vertices[v].normal;
        float *t = tangents->tangent[v];
        float before = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
        float along = t[0] * n[0] + t[1] * n[1] + t[2] * n[2];
        for (int k = 0; k < 3; k++) {
            t[k] -= along * n[k];
        }
        float after = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
        // Nothing reliable is left of a direction that was almost the normal's.
        if (after > 1e-8f * before && after > 1e-30f) {
            float scale = 1.0f / sqrtf(after);
            for (int k = 0; k < 3; k++) {
                t[k] *= scale;
            }
        } else {
            perpendicular(n, t);
        }
        // Rows of a picture count downwards: turned like the picture, a face has area < 0.
        t[3] = t[3] > 0.0f ? -1.0f : 1.0f;
    }
}

float (*fr_tangents_new(const FrMesh *mesh, const FrMeshPart *part, const FrContext *context))[4] {
    FrTangents tangents = {
        .vertices = mesh->vertices + part->first_vertex,
        .tangent = g_malloc0_n(part->vertex_count, sizeof(float[4])),
    };
    const uint32_t *corners = mesh->indices + part->first_index;
    for (uint64_t i = 0; i + 2 < part->index_count; i += 3) {
        add_triangle(&tangents, corners + i);
    }
    fr_parallel_for(context->pool, part->vertex_count, 1 << 16, finish_vertices, &tangents, NULL);
    return tangents.tangent;
}
