// Free-form deformation of vertices that have just been written.
#include "skin/tube.h"

#include <string.h>

// A vector of the mesh as the plant has it: fr_upright() undone.
static vec3s laid_down(const float v[3], FrUpAxis up) {
    return up == FR_UP_Y ? (vec3s){{v[0], -v[2], v[1]}} : (vec3s){{v[0], v[1], v[2]}};
}

void fr_deform_vertices(const FrPlan *plan, uint32_t scope, FrUpAxis up, FrVertex *vertices,
                        uint64_t count, uint32_t *indices, uint64_t index_count,
                        FrDeformNote *notes) {
    uint64_t inside_out = 0;
    for (uint64_t i = 0; i < count; i++) {
        vec3s at = laid_down(vertices[i].position, up);
        vec3s normal = laid_down(vertices[i].normal, up);
        inside_out += !fr_scopes_move_vertex(plan->scopes, scope, &at, &normal, notes);
        at = fr_upright(at, up);
        normal = fr_upright(normal, up);
        memcpy(vertices[i].position, at.raw, sizeof at.raw);
        memcpy(vertices[i].normal, normal.raw, sizeof normal.raw);
    }
    if (2 * inside_out <= count) {
        return;
    }
    for (uint64_t i = 0; i + 2 < index_count; i += 3) {
        uint32_t second = indices[i + 1];
        indices[i + 1] = indices[i + 2];
        indices[i + 2] = second;
    }
}
