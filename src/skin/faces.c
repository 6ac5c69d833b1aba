// Ends of another material than their tubes: their triangles go over to its part of the mesh.
#include "skin/patch.h"

static void move_face(FrPatch *patch, const FrTube *tube) {
    const FrPlan *plan = &patch->job->wood->plan;
    const FrMeshPart *part = fr_patch_part(patch, tube->slot);
    uint64_t first = part->first_index + tube->first_index + tube->face_index;
    const uint32_t *corner = patch->mesh->indices + first;
    uint32_t low = UINT32_MAX, high = 0;
    for (uint64_t i = 0; i < tube->face_indices; i++) {
        low = MIN(low, corner[i]);
        high = MAX(high, corner[i]);
    }
    // All of them are of the end alone.
    uint32_t count = high - low + 1;
    FrVertex *vertices =
        g_memdup2(patch->mesh->vertices + part->first_vertex + low, count * sizeof *vertices);
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            vertices[i].uv[k] *= plan->tiles[tube->slot][k] / plan->tiles[tube->face][k];
        }
    }
    uint32_t begin = fr_patch_add(patch, tube->face, vertices, count);
    g_free(vertices);
    for (uint64_t i = 0; i < tube->face_indices; i += 3) {
        uint32_t moved[3];
        for (int k = 0; k < 3; k++) {
            moved[k] = begin + corner[i + (uint64_t)k] - low;
        }
        fr_patch_add_triangle(patch, tube->face, moved);
        patch->is_gone[(first + i) / 3] = 1;
    }
}

void fr_face_ends(FrPatch *patch) {
    const GArray *tubes = patch->job->wood->plan.tubes;
    for (uint32_t i = 0; i < tubes->len; i++) {
        const FrTube *tube = &g_array_index(tubes, FrTube, i);
        if (tube->rings > 0 && tube->face_indices > 0) {
            move_face(patch, tube);
        }
    }
}
