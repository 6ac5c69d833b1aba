// Writes what is planned of a kept skin, but for the pieces that stand there already.
#include "skin/kept_state.h"
#include "skin/mesh.h"
#include "skin/stream.h"
#include "skin/took.h"

#include <string.h>

enum { BLOCK_GRAIN = 8 };

// Organs of more bytes than this are written past the caches.
#define STREAMED_FROM ((uint64_t)4 << 20)

// What one worker wrote of one part, and the box around what it saw of it.
typedef struct Touch {
    FrBox box;
    uint64_t vertex, vertex_end, index, index_end;
    uint64_t written; // runs or organs
} Touch;

typedef struct Writing {
    FrSkinState *now;
    const FrSkinState *before; // NULL: nothing of it is of use
    FrSlab *wood, *organs;     // by slot
    GHashTable *runs;          // digest → run of before, + 1; NULL where both have the same runs
    Touch *touches;            // by worker, then room
    bool is_streamed;
    bool is_wood_new; // else it has been written and timed before
} Writing;

static Touch *touch_of(const Writing *writing, int worker, uint32_t slot, bool is_organs) {
    return &writing->touches[((size_t)worker * writing->now->slots + slot) * 2 + is_organs];
}

static void touch(Touch *touch, uint64_t vertex, uint64_t vertices, uint64_t index,
                  uint64_t indices) {
    if (vertices > 0) {
        touch->vertex = MIN(touch->vertex, vertex);
        touch->vertex_end = MAX(touch->vertex_end, vertex + vertices);
    }
    if (indices > 0) {
        touch->index = MIN(touch->index, index);
        touch->index_end = MAX(touch->index_end, index + indices);
    }
    touch->written++;
}

// The run of the last state that stands where this one is to, and is the same; FR_NONE.
static uint32_t run_before(const Writing *writing, uint32_t run) {
    if (writing->before == NULL) {
        return FR_NONE;
    }
    if (writing->runs == NULL) {
        return run;
    }
    return GPOINTER_TO_UINT(g_hash_table_lookup(writing->runs, &writing->now->runs[run])) - 1;
}

static void write_runs(void *data, size_t begin, size_t end, int worker) {
    const Writing *writing = data;
    const FrSkinJob *job = &writing->now->job;
    const FrPlan *plan = &job->wood->plan;
    FrTook group = fr_took_begin(plan, begin);
    for (uint32_t i = (uint32_t)begin; i < end; i++) {
        const FrRun *run = &g_array_index(plan->runs, FrRun, i);
        uint32_t before = run_before(writing, i);
        if (before != FR_NONE) {
            const FrWood *wood = writing->before->job.wood;
            const FrRun *same = &g_array_index(wood->plan.runs, FrRun, before);
            if (wood != job->wood) {
                job->wood->plan.took[i] = wood->plan.took[before];
                memcpy(&job->wood->boxes[run->first_tube], &wood->boxes[same->first_tube],
                       run->tube_count * sizeof(FrBox));
            }
        } else {
            fr_write_run(plan, run, job->up, writing->wood, job->wood->boxes,
                         fr_job_notes(job, worker));
        }
        for (uint32_t k = run->first_tube; k < run->first_tube + run->tube_count; k++) {
            const FrTube *tube = &g_array_index(plan->tubes, FrTube, k);
            Touch *touched = touch_of(writing, worker, tube->slot, false);
            fr_box_join(&touched->box, &job->wood->boxes[k]);
            if (before == FR_NONE) {
                touch(touched, tube->first_vertex, tube->vertices, tube->first_index,
                      tube->indices);
                touched->written -= k > run->first_tube;
            }
        }
        fr_took_run(&group, i, before == FR_NONE && writing->is_wood_new);
    }
    fr_took_end(&group);
}

// What of a piece is to be written, all but what stands in its place already.
static unsigned what_to_write(const Writing *writing, uint32_t piece, uint32_t slot) {
    const FrSkinState *now = writing->now, *last = writing->before;
    const FrOrganPlan *a = &now->job.organs, *b = &last->job.organs;
    const unsigned all = FR_WRITE_VERTICES | FR_WRITE_INDICES;
    uint32_t twin = b->slot_pieces[slot] + piece - a->slot_pieces[slot];
    if (twin >= b->slot_pieces[slot + 1] || a->pieces[piece].vertex != b->pieces[twin].vertex ||
        a->pieces[piece].index != b->pieces[twin].index) {
        return all;
    }
    const FrShapeDigest *shape = &now->shapes[now->shape_of[piece]];
    const FrShapeDigest *same = &last->shapes[last->shape_of[twin]];
    bool has_vertices = shape->vertices == same->vertices &&
                        now->poses[a->pieces[piece].organ] == last->poses[b->pieces[twin].organ];
    return (has_vertices ? 0u : FR_WRITE_VERTICES) |
           (shape->indices == same->indices ? 0u : FR_WRITE_INDICES);
}

// The box of a block whose vertices all stand there already; NULL if it is not known.
static const FrBox *box_before(const Writing *writing, const FrBlock *block) {
    const FrSkinState *now = writing->now, *last = writing->before;
    uint32_t index = (uint32_t)(block - now->blocks) - now->slot_blocks[block->slot] +
                     last->slot_blocks[block->slot];
    return last->blocks[index].count == block->count ? &last->blocks[index].box : NULL;
}

static void write_piece(const Writing *writing, const FrBlock *block, uint32_t piece, unsigned what,
                        Touch *touched, FrBox *box, FrDeformNote *notes) {
    const FrSkinJob *job = &writing->now->job;
    const FrShapeMesh *shape = &job->organs.shapes[writing->now->shape_of[piece]];
    FrOrganPiece place = job->organs.pieces[piece];
    fr_write_piece(&job->organs, piece, job->up, &writing->organs[block->slot],
                   what | (writing->is_streamed ? FR_WRITE_STREAM : 0u), box, notes);
    touch(touched, place.vertex, (what & FR_WRITE_VERTICES) != 0 ? shape->vertex_count : 0,
          place.index, (what & FR_WRITE_INDICES) != 0 ? shape->index_count : 0);
}

static void write_block(const Writing *writing, FrBlock *block, Touch *touched,
                        FrDeformNote *notes) {
    const FrSkinState *now = writing->now, *last = writing->before;
    const FrSlab *slab = &writing->organs[block->slot];
    bool is_new =
        last == NULL || block->slot >= fr_job_slots(&last->job) ||
        fr_room_of(now, block->slot, true)->serial != fr_room_of(last, block->slot, true)->serial;
    uint32_t kept[FR_BLOCK_PIECES], kept_count = 0;
    block->box = fr_box_empty();
    for (uint32_t piece = block->first; piece < block->first + block->count; piece++) {
        unsigned what = is_new ? FR_WRITE_VERTICES | FR_WRITE_INDICES
                               : what_to_write(writing, piece, block->slot);
        FrBox box = fr_box_empty();
        if (what != 0) {
            write_piece(writing, block, piece, what, touched, &box, notes);
        }
        if ((what & FR_WRITE_VERTICES) == 0) {
            kept[kept_count++] = piece;
        }
        fr_box_join(&block->box, &box);
    }
    const FrBox *before = kept_count == block->count ? box_before(writing, block) : NULL;
    if (before != NULL) {
        block->box = *before;
        return;
    }
    for (uint32_t k = 0; k < kept_count; k++) {
        const FrShapeMesh *shape = &now->job.organs.shapes[now->shape_of[kept[k]]];
        fr_box_widen(&block->box, slab->vertices + now->job.organs.pieces[kept[k]].vertex,
                     shape->vertex_count);
    }
}

static void write_blocks(void *data, size_t begin, size_t end, int worker) {
    const Writing *writing = data;
    FrDeformNote *notes = fr_job_notes(&writing->now->job, worker);
    for (size_t i = begin; i < end; i++) {
        FrBlock *block = &writing->now->blocks[i];
        Touch *touched = touch_of(writing, worker, block->slot, true);
        write_block(writing, block, touched, notes);
        fr_box_join(&touched->box, &block->box);
    }
    fr_stream_end();
}

// Runs of the last state by their digest, unless all are where they were.
static GHashTable *index_runs(const FrSkinState *now, const FrSkinState *before) {
    uint32_t count = now->job.wood->plan.runs->len, last = before->job.wood->plan.runs->len;
    if (count == last && memcmp(now->runs, before->runs, count * sizeof *now->runs) == 0) {
        return NULL;
    }
    GHashTable *index = g_hash_table_new(g_int64_hash, g_int64_equal);
    for (uint32_t i = 0; i < last; i++) {
        g_hash_table_insert(index, &before->runs[i], GUINT_TO_POINTER(i + 1));
    }
    return index;
}

static void join_touches(const Writing *writing, int workers) {
    size_t rooms = 2 * (size_t)writing->now->slots;
    for (size_t i = rooms; i < (size_t)workers * rooms; i++) {
        const Touch *other = &writing->touches[i];
        Touch *all = &writing->touches[i % rooms];
        fr_box_join(&all->box, &other->box);
        all->vertex = MIN(all->vertex, other->vertex);
        all->vertex_end = MAX(all->vertex_end, other->vertex_end);
        all->index = MIN(all->index, other->index);
        all->index_end = MAX(all->index_end, other->index_end);
        all->written += other->written;
    }
}

static void list_parts(FrSkin *skin, const Writing *writing) {
    const FrSkinState *now = writing->now;
    const FrSkinJob *job = &now->job;
    skin->parts = g_renew(FrSkinPart, skin->parts, job->part_count);
    skin->part_count = job->part_count;
    skin->work = (FrSkinWork){.runs = job->wood->plan.runs->len, .organs = job->organs.piece_count};
    for (uint32_t i = 0; i < 2 * fr_job_slots(job); i++) {
        const Touch *touched = &writing->touches[i];
        *(i % 2 == 0 ? &skin->work.runs_written : &skin->work.organs_written) += touched->written;
        uint32_t index = job->part_of[i % 2 * fr_job_slots(job) + i / 2];
        if (index == FR_NONE) {
            continue;
        }
        const FrRoom *room = &now->rooms[i];
        FrSkinPart *part = &skin->parts[index];
        *part = (FrSkinPart){
            .part = job->parts[index],
            .vertices = room->slab.vertices,
            .indices = room->slab.indices,
            .is_moved = room->is_new,
            .changed_vertex = MIN(touched->vertex, touched->vertex_end),
            .changed_vertex_end = touched->vertex_end,
            .changed_index = MIN(touched->index, touched->index_end),
            .changed_index_end = touched->index_end,
        };
        fr_part_set_box(&part->part, touched->box.min, touched->box.max);
    }
}

// The new state takes the place of the last one, whose memory goes where it was outgrown.
static void settle(FrSkin *skin) {
    FrSkinState *before = skin->state;
    for (uint32_t i = 0; before != NULL && i < 2 * before->slots; i++) {
        if (before->rooms[i].serial != skin->planned->rooms[i].serial) {
            fr_room_free(&before->rooms[i]);
        }
    }
    fr_skin_state_free(before);
    skin->state = skin->planned;
    skin->planned = NULL;
}

static Writing begin_writing(const FrSkin *skin, int workers) {
    FrSkinState *now = skin->planned;
    const FrSkinState *before = skin->state;
    Writing writing = {
        .now = now,
        .before = before != NULL && before->is_known && now->is_known ? before : NULL,
        .wood = g_new(FrSlab, now->slots),
        .organs = g_new(FrSlab, now->slots),
        .touches = g_new(Touch, 2 * (size_t)workers * now->slots),
    };
    uint64_t bytes = 0;
    for (uint32_t slot = 0; slot < now->slots; slot++) {
        writing.wood[slot] = fr_room_of(now, slot, false)->slab;
        writing.organs[slot] = fr_room_of(now, slot, true)->slab;
        bytes += slot < fr_job_slots(&now->job)
                     ? now->job.organs.slot_vertices[slot] * sizeof(FrVertex)
                     : 0;
    }
    for (size_t i = 0; i < 2 * (size_t)workers * now->slots; i++) {
        writing.touches[i] =
            (Touch){.box = fr_box_empty(), .vertex = UINT64_MAX, .index = UINT64_MAX};
    }
    writing.is_streamed = bytes > STREAMED_FROM;
    writing.is_wood_new = before == NULL || before->job.wood != now->job.wood;
    writing.runs = writing.before != NULL ? index_runs(now, writing.before) : NULL;
    return writing;
}

static void note_unchanged(FrSkin *skin) {
    for (uint32_t i = 0; i < skin->part_count; i++) {
        FrSkinPart *part = &skin->parts[i];
        part->is_moved = false;
        part->changed_vertex = part->changed_vertex_end = 0;
        part->changed_index = part->changed_index_end = 0;
    }
    skin->work.runs_written = skin->work.organs_written = 0;
    skin->is_unchanged = false;
}

// Copies a mesh that is made already into the rooms.
static void write_patched(const Writing *writing) {
    const FrSkinState *now = writing->now;
    const FrMesh *mesh = now->patched;
    for (uint32_t i = 0; i < 2 * fr_job_slots(&now->job); i++) {
        uint32_t index = now->job.part_of[i % 2 * fr_job_slots(&now->job) + i / 2];
        if (index == FR_NONE) {
            continue;
        }
        const FrMeshPart *part = &mesh->parts[index];
        memcpy(now->rooms[i].slab.vertices, mesh->vertices + part->first_vertex,
               part->vertex_count * sizeof(FrVertex));
        memcpy(now->rooms[i].slab.indices, mesh->indices + part->first_index,
               part->index_count * sizeof(uint32_t));
        Touch *touched = &writing->touches[i];
        touched->vertex = touched->index = 0;
        touched->vertex_end = part->vertex_count;
        touched->index_end = part->index_count;
        memcpy(touched->box.min, part->min, sizeof part->min);
        memcpy(touched->box.max, part->max, sizeof part->max);
    }
    writing->touches[0].written = now->job.wood->plan.runs->len;
    writing->touches[1].written = now->job.organs.piece_count;
}

static void write_pieces(const FrSkin *skin, Writing *writing, const FrContext *context) {
    fr_parallel_for(context->pool, writing->now->job.wood->plan.runs->len, FR_RUN_GRAIN, write_runs,
                    writing, NULL);
    fr_progress_report(context->progress, "skin", 0.6);
    fr_parallel_for(context->pool, skin->planned->block_count, BLOCK_GRAIN, write_blocks, writing,
                    NULL);
    join_touches(writing, fr_pool_threads(context->pool));
}

void fr_skin_write(FrSkin *skin, const FrPlant *plant, const FrContext *context) {
    if (skin->is_unchanged) {
        note_unchanged(skin);
        return;
    }
    FrSkinJob *job = &skin->planned->job;
    int workers = fr_pool_threads(context->pool);
    Writing writing = begin_writing(skin, workers);
    if (skin->planned->patched != NULL) {
        write_patched(&writing);
        g_clear_pointer(&skin->planned->patched, fr_mesh_free);
    } else {
        write_pieces(skin, &writing, context);
    }
    list_parts(skin, &writing);
    fr_job_report(job, plant);
    g_free(writing.wood);
    g_free(writing.organs);
    g_free(writing.touches);
    g_clear_pointer(&writing.runs, g_hash_table_unref);
    settle(skin);
    fr_progress_report(context->progress, "skin", 1.0);
}
