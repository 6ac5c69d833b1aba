// Rewrites a mesh of which some triangles are gone and to whose wood others are added.
#include "skin/patch.h"

#include "skin/mesh.h"

#include <string.h>

void fr_patch_init(FrPatch *patch, FrSkinJob *job, FrMesh *mesh) {
    *patch = (FrPatch){
        .job = job,
        .mesh = mesh,
        .is_gone = g_new0(uint8_t, mesh->index_count / 3 + 1),
        .additions = g_new0(FrAddition, fr_job_slots(job)),
    };
}

void fr_patch_clear(FrPatch *patch) {
    for (uint32_t i = 0; i < fr_job_slots(patch->job); i++) {
        if (patch->additions[i].vertices != NULL) {
            g_array_free(patch->additions[i].vertices, TRUE);
            g_array_free(patch->additions[i].indices, TRUE);
        }
    }
    g_free(patch->additions);
    g_free(patch->is_gone);
}

uint32_t fr_patch_add(FrPatch *patch, uint32_t slot, const FrVertex *vertices, uint32_t count) {
    FrAddition *addition = &patch->additions[slot];
    if (addition->vertices == NULL) {
        addition->vertices = g_array_new(FALSE, FALSE, sizeof(FrVertex));
        addition->indices = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    }
    bool has_part = patch->job->part_of[slot] != FR_NONE;
    uint64_t before = has_part ? fr_patch_part(patch, slot)->vertex_count : 0;
    uint32_t first = (uint32_t)before + addition->vertices->len;
    g_array_append_vals(addition->vertices, vertices, count);
    return first;
}

void fr_patch_add_triangle(FrPatch *patch, uint32_t slot, const uint32_t corner[3]) {
    g_array_append_vals(patch->additions[slot].indices, corner, 3);
}

// ---- counting ----------------------------------------------------------------------------------

// Which vertices of a part are still used; answers how many indices are left.
static uint64_t mark_used(const FrPatch *patch, const FrMeshPart *part, uint8_t *is_used) {
    uint64_t left = 0;
    for (uint64_t i = part->first_index; i < part->first_index + part->index_count; i += 3) {
        if (patch->is_gone[i / 3] == 0) {
            for (uint64_t k = i; k < i + 3; k++) {
                is_used[patch->mesh->indices[k]] = 1;
            }
            left += 3;
        }
    }
    return left;
}

static void count_part(const FrPatch *patch, const FrAddition *more, FrMeshPart *part) {
    uint8_t *is_used = g_new0(uint8_t, part->vertex_count + 1);
    uint64_t vertices = 0, indices = mark_used(patch, part, is_used);
    for (uint64_t i = 0; i < part->vertex_count; i++) {
        vertices += is_used[i];
    }
    g_free(is_used);
    part->vertex_count = vertices + (more->vertices != NULL ? more->vertices->len : 0);
    part->index_count = indices + (more->indices != NULL ? more->indices->len : 0);
}

// ---- writing -----------------------------------------------------------------------------------

// Writes what is left of a part and what is added to it.
static void write_part(const FrPatch *patch, const FrMeshPart *from, const FrAddition *more,
                       FrMesh *to, FrMeshPart *out) {
    uint64_t added = more->vertices != NULL ? more->vertices->len : 0;
    uint64_t all = from->vertex_count + added;
    uint8_t *is_used = g_new0(uint8_t, all + 1);
    uint32_t *place = g_new(uint32_t, all + 1);
    FrVertex *vertices = to->vertices + out->first_vertex;
    uint32_t *indices = to->indices + out->first_index, count = 0;
    mark_used(patch, from, is_used);
    memset(is_used + from->vertex_count, 1, added);
    for (uint64_t i = 0; i < all; i++) {
        place[i] = count;
        if (is_used[i] != 0) {
            vertices[count++] =
                i < from->vertex_count
                    ? patch->mesh->vertices[from->first_vertex + i]
                    : g_array_index(more->vertices, FrVertex, i - from->vertex_count);
        }
    }
    for (uint64_t i = from->first_index; i < from->first_index + from->index_count; i++) {
        if (patch->is_gone[i / 3] == 0) {
            *indices++ = place[patch->mesh->indices[i]];
        }
    }
    for (guint i = 0; more->indices != NULL && i < more->indices->len; i++) {
        *indices++ = place[g_array_index(more->indices, uint32_t, i)];
    }
    FrBox box = fr_box_empty();
    fr_box_widen(&box, vertices, count);
    fr_part_set_box(out, box.min, box.max);
    g_free(is_used);
    g_free(place);
}

// What a part was, and what is added to it, by slot of wood, then of organs.
typedef struct FrChange {
    FrMeshPart from;
    FrAddition more;
} FrChange;

static FrChange change_of(const FrPatch *patch, uint32_t i) {
    uint32_t slots = fr_job_slots(patch->job), slot = i % slots, part = patch->job->part_of[i];
    FrChange change = {.from = {.material = slot == 0 ? FR_NONE : slot - 1}};
    if (part != FR_NONE) {
        change.from = patch->mesh->parts[part];
    }
    if (i < slots) {
        change.more = patch->additions[i];
    }
    return change;
}

FrStatus fr_patch_write(FrPatch *patch, FrMesh **mesh) {
    FrSkinJob *job = patch->job;
    uint32_t rows = 2 * fr_job_slots(job);
    FrChange *changes = g_new(FrChange, rows);
    job->vertices = job->indices = 0;
    job->part_count = 0;
    for (uint32_t i = 0; i < rows; i++) {
        changes[i] = change_of(patch, i);
        FrMeshPart part = changes[i].from;
        if (changes[i].more.vertices != NULL || part.index_count > 0) {
            count_part(patch, &changes[i].more, &part);
        }
        part.first_vertex = job->vertices;
        part.first_index = job->indices;
        job->part_of[i] = part.index_count > 0 ? job->part_count : FR_NONE;
        if (part.index_count > 0) {
            job->parts[job->part_count++] = part;
            job->vertices += part.vertex_count;
            job->indices += part.index_count;
        }
    }
    FrStatus status = fr_job_check(job, job->vertices, job->indices);
    FrMesh *to = status == FR_OK ? fr_job_mesh(job, job->vertices, job->indices) : NULL;
    for (uint32_t i = 0; to != NULL && i < rows; i++) {
        if (job->part_of[i] != FR_NONE) {
            FrMeshPart *part = &job->parts[job->part_of[i]];
            write_part(patch, &changes[i].from, &changes[i].more, to, part);
            to->parts[job->part_of[i]] = *part;
        }
    }
    g_free(changes);
    if (to != NULL) {
        fr_mesh_free(*mesh);
        *mesh = patch->mesh = to;
    }
    return status == FR_OK && to == NULL ? FR_ERR_MACHINE : status;
}
