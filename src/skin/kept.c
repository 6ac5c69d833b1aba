// A skin that is kept: what is written is only what a change has moved or formed anew.
//
// Every part has memory of its own with some room to spare, so that parts grow without moving each
// other. A piece (a run of tubes, an organ) is written unless what stands in its place was made
// from the same; digests tell (piece.h). Writing cannot fail: all memory is taken before it begins.
#include "skin/kept_state.h"

#include "skin/mesh.h"

#include <stdlib.h>
#include <string.h>

FrSkin *fr_skin_new(const FrSkinParams *params, FrUpAxis up) {
    FrSkin *skin = g_new0(FrSkin, 1);
    skin->params = *params;
    skin->up = up;
    return skin;
}

// ---- rooms -------------------------------------------------------------------------------------

void fr_room_free(FrRoom *room) {
    free(room->slab.vertices);
    free(room->slab.indices);
    *room = (FrRoom){0};
}

void fr_skin_state_free(FrSkinState *state) {
    if (state == NULL) {
        return;
    }
    fr_job_clear(&state->job);
    fr_mesh_free(state->patched);
    g_free(state->rooms);
    g_free(state->runs);
    g_clear_pointer(&state->poses, g_atomic_rc_box_release);
    g_free(state->shapes);
    g_clear_pointer(&state->shape_of, g_atomic_rc_box_release);
    g_free(state->blocks);
    g_free(state->slot_blocks);
    g_free(state);
}

// Takes more memory where a part has outgrown its own; some to spare lets it grow on.
static bool take_room(FrSkin *skin, FrRoom *room, const FrMeshPart *part) {
    if (part->vertex_count <= room->vertices && part->index_count <= room->indices) {
        return true;
    }
    bool is_first = room->serial == 0;
    uint64_t vertices = part->vertex_count + (is_first ? 0 : part->vertex_count / 4);
    uint64_t indices = part->index_count + (is_first ? 0 : part->index_count / 4);
    *room = (FrRoom){
        .slab = {fr_mesh_allocate(vertices * sizeof(FrVertex)),
                 fr_mesh_allocate(indices * sizeof(uint32_t))},
        .vertices = vertices,
        .indices = indices,
        .serial = ++skin->serial,
        .is_new = true,
    };
    return room->slab.vertices != NULL && room->slab.indices != NULL;
}

static FrStatus take_rooms(FrSkin *skin, FrSkinState *state, FrDiags *diags) {
    uint32_t before = skin->state != NULL ? skin->state->slots : 0;
    bool is_there = true;
    state->rooms = g_new0(FrRoom, 2 * (size_t)MAX(state->slots, before));
    for (uint32_t i = 0; i < 2 * before; i++) {
        state->rooms[i] = skin->state->rooms[i];
        state->rooms[i].is_new = false;
    }
    for (uint32_t i = 0; i < 2 * state->slots && is_there; i++) {
        uint32_t part = state->job.part_of[i % 2 * state->slots + i / 2];
        is_there = part == FR_NONE || take_room(skin, &state->rooms[i], &state->job.parts[part]);
    }
    state->slots = MAX(state->slots, before);
    if (!is_there) {
        fr_diags_add(diags, FR_ERROR, "out-of-memory", (FrSpan){0},
                     "There is no memory for a mesh of %" G_GUINT64_FORMAT " triangles",
                     state->job.indices / 3);
    }
    return is_there ? FR_OK : FR_ERR_MACHINE;
}

// ---- planning ----------------------------------------------------------------------------------

static void digest_places(FrSkinState *state) {
    const FrPlan *plan = &state->job.wood->plan;
    state->runs = g_new(FrDigest, plan->runs->len + 1);
    for (uint32_t i = 0; i < plan->runs->len; i++) {
        const FrRun *run = &g_array_index(plan->runs, FrRun, i);
        FrDigest digest = state->job.wood->digests[i];
        for (uint32_t k = 0; k < run->tube_count; k++) {
            const FrTube *tube = &g_array_index(plan->tubes, FrTube, run->first_tube + k);
            digest = fr_digest_both(digest, tube->first_vertex);
            digest = fr_digest_both(digest, tube->first_index);
            digest = fr_digest_both(digest, fr_room_of(state, tube->slot, false)->serial);
        }
        state->runs[i] = digest;
    }
}

static void digest_all(FrSkinState *state, const FrSkinState *before) {
    FrSkinJob *job = &state->job;
    if (job->wood->digests == NULL) {
        fr_digest_wood(job->wood);
    }
    digest_places(state);
    state->poses = job->organs.shares_pieces ? g_atomic_rc_box_acquire(before->poses)
                                             : fr_digest_poses(&job->organs);
    state->shapes = fr_digest_shapes(&job->organs);
    state->is_known = true;
}

static void note_shapes(FrSkinState *state, const FrSkinState *before) {
    const FrOrganPlan *organs = &state->job.organs;
    if (organs->shares_pieces) {
        state->shape_of = g_atomic_rc_box_acquire(before->shape_of);
        return;
    }
    state->shape_of = g_atomic_rc_box_alloc(MAX(organs->piece_count, 1) * sizeof(uint32_t));
    for (uint32_t i = 0; i < organs->piece_count; i++) {
        state->shape_of[i] = organs->plan->plant->organs.shape[organs->pieces[i].organ];
    }
}

static void make_blocks(FrSkinState *state) {
    const FrOrganPlan *organs = &state->job.organs;
    uint32_t slots = fr_job_slots(&state->job);
    state->blocks = g_new(FrBlock, organs->piece_count / FR_BLOCK_PIECES + slots);
    state->slot_blocks = g_new(uint32_t, slots + 1);
    for (uint32_t slot = 0; slot < slots; slot++) {
        state->slot_blocks[slot] = state->block_count;
        for (uint32_t first = organs->slot_pieces[slot]; first < organs->slot_pieces[slot + 1];
             first += FR_BLOCK_PIECES) {
            uint32_t left = organs->slot_pieces[slot + 1] - first;
            state->blocks[state->block_count++] =
                (FrBlock){.slot = slot, .first = first, .count = MIN(left, FR_BLOCK_PIECES)};
        }
    }
    state->slot_blocks[slots] = state->block_count;
}

// Where tubes are one with others or end in another part, a piece is more than itself, so all is
// made before the rooms are.
static FrStatus patch_all(FrSkinState *state) {
    return fr_job_write(&state->job, &state->patched);
}

FrStatus fr_skin_plan(FrSkin *skin, const FrPlant *plant, bool has_same_rows,
                      const FrContext *context) {
    const FrSkinState *before = skin->state;
    const GArray *shapes = plant->shapes;
    FrDigest forms = fr_digest(0, shapes->data, shapes->len * sizeof(FrShape));
    for (guint i = 0; i < plant->files->len; i++) {
        const FrMeshFile *file = g_ptr_array_index(plant->files, i);
        forms = fr_digest(forms, &file->digest, sizeof file->digest);
    }
    bool is_same = has_same_rows && before != NULL && before->is_known &&
                   before->job.wood->inputs == fr_wood_inputs(plant) && plant->deformers->len == 0;
    skin->is_unchanged = is_same && before->forms == forms &&
                         memcmp(&before->limits, &context->limits, sizeof before->limits) == 0;
    if (skin->is_unchanged) {
        return FR_OK;
    }
    FrSkinState *state = skin->planned = g_new0(FrSkinState, 1);
    state->forms = forms;
    state->limits = context->limits;
    FrStatus status = fr_job_begin(&state->job, plant, &skin->params, skin->up,
                                   is_same ? &before->job : NULL, true, context);
    if (status == FR_OK && fr_job_is_patched(&state->job)) {
        status = patch_all(state);
    }
    if (status == FR_OK) {
        state->slots = fr_job_slots(&state->job);
        status = take_rooms(skin, state, context->diags);
    }
    if (status != FR_OK) {
        fr_skin_drop(skin);
        return status;
    }
    if (state->job.scopes == NULL && state->patched == NULL) {
        digest_all(state, before);
    }
    note_shapes(state, before);
    make_blocks(state);
    return FR_OK;
}

void fr_skin_drop(FrSkin *skin) {
    FrSkinState *state = skin->planned;
    for (uint32_t i = 0; state != NULL && state->rooms != NULL && i < 2 * state->slots; i++) {
        if (state->rooms[i].is_new) {
            fr_room_free(&state->rooms[i]);
        }
    }
    fr_skin_state_free(state);
    skin->planned = NULL;
    skin->is_unchanged = false;
}

// ---- the skin as others see it -----------------------------------------------------------------

FrStatus fr_skin_update(FrSkin *skin, const FrPlant *plant, bool has_same_rows,
                        const FrContext *context) {
    FrStatus status = fr_skin_plan(skin, plant, has_same_rows, context);
    if (status == FR_OK) {
        fr_skin_write(skin, plant, context);
    }
    return status;
}

void fr_skin_free(FrSkin *skin) {
    if (skin == NULL) {
        return;
    }
    fr_skin_drop(skin);
    for (uint32_t i = 0; skin->state != NULL && i < 2 * skin->state->slots; i++) {
        fr_room_free(&skin->state->rooms[i]);
    }
    fr_skin_state_free(skin->state);
    g_free(skin->parts);
    g_free(skin);
}

const FrSkinPart *fr_skin_parts(const FrSkin *skin, uint32_t *count) {
    *count = skin->part_count;
    return skin->parts;
}

FrSkinWork fr_skin_work(const FrSkin *skin) {
    return skin->work;
}

FrMesh *fr_skin_mesh(const FrSkin *skin) {
    uint64_t vertices = 0, indices = 0;
    for (uint32_t i = 0; i < skin->part_count; i++) {
        vertices += skin->parts[i].part.vertex_count;
        indices += skin->parts[i].part.index_count;
    }
    FrMesh *mesh = fr_mesh_new(vertices, indices, skin->part_count);
    for (uint32_t i = 0; mesh != NULL && i < skin->part_count; i++) {
        const FrSkinPart *part = &skin->parts[i];
        mesh->parts[i] = part->part;
        memcpy(mesh->vertices + part->part.first_vertex, part->vertices,
               part->part.vertex_count * sizeof(FrVertex));
        memcpy(mesh->indices + part->part.first_index, part->indices,
               part->part.index_count * sizeof(uint32_t));
    }
    return mesh;
}
