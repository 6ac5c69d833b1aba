// Normals of leaves other than those of their surface, for how a crown looks as a whole.
#include "skin/shape.h"

#include <cglm/struct.h>

#include <string.h>

// As from a ball below the blade, half of it and half its own.
static void round_normal(FrVertex *vertex, const FrBlade *blade) {
    float reach = blade->length + blade->rachis_length;
    vec3s middle = {{0, -0.3F * reach, blade->petiole_length + 0.5F * reach}}, at, own;
    memcpy(at.raw, vertex->position, sizeof at.raw);
    memcpy(own.raw, vertex->normal, sizeof own.raw);
    vec3s apart = glms_vec3_normalize(glms_vec3_sub(at, middle));
    vec3s normal = glms_vec3_add(own, apart);
    if (glms_vec3_norm(normal) > 1e-3F) {
        memcpy(vertex->normal, glms_vec3_normalize(normal).raw, sizeof vertex->normal);
    }
}

void fr_turn_normals(FrShapeMesh *mesh, const FrBlade *blade) {
    const float upper[3] = {0, 1, 0};
    mesh->is_crown = blade->normals == FR_NORMALS_CROWN;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (blade->normals == FR_NORMALS_FLAT) {
            memcpy(mesh->vertices[i].normal, upper, sizeof upper);
        } else if (blade->normals == FR_NORMALS_ROUND) {
            round_normal(&mesh->vertices[i], blade);
        }
    }
}
