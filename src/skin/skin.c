// Plant → mesh: plan, count, allocate once, write in parallel.
#include "frond/skin.h"

#include "plant/place.h"
#include "skin/job.h"
#include "skin/mesh.h"
#include "skin/patch.h"
#include "skin/took.h"

#include <string.h>

enum { PIECE_GRAIN = 512 };

#define FR_PARAM_STRUCT FrSkinParams
static const FrParam skin_rows[] = {FR_SKIN_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable skin_table = {
    .element = "skin",
    .meaning = "how a plant becomes triangles",
    .rows = skin_rows,
    .count = G_N_ELEMENTS(skin_rows),
    .struct_size = sizeof(FrSkinParams),
};

const FrParamTable *fr_skin_table(void) {
    return &skin_table;
}

FrSkinParams fr_skin_default(void) {
    FrSkinParams params;
    fr_params_init(&skin_table, &params);
    return params;
}

// ---- writing -----------------------------------------------------------------------------------

typedef struct Writing {
    FrSkinJob *job;
    FrSlab *slabs; // of wood by slot, then of organs
    FrBox *boxes;  // by worker, then slot of organs
} Writing;

static void write_runs(void *data, size_t begin, size_t end, int worker) {
    const Writing *writing = data;
    FrWood *wood = writing->job->wood;
    FrTook group = fr_took_begin(&wood->plan, begin);
    for (size_t i = begin; i < end; i++) {
        fr_write_run(&wood->plan, &g_array_index(wood->plan.runs, FrRun, i), writing->job->up,
                     writing->slabs, wood->boxes, fr_job_notes(writing->job, worker));
        fr_took_run(&group, i, true);
    }
    fr_took_end(&group);
}

static void write_organs(void *data, size_t begin, size_t end, int worker) {
    const Writing *writing = data;
    const FrSkinJob *job = writing->job;
    uint32_t slots = fr_job_slots(job);
    FrBox *boxes = writing->boxes + (size_t)worker * slots;
    for (size_t i = begin; i < end; i++) {
        uint32_t piece = (uint32_t)i, slot = fr_piece_slot(&job->organs, piece);
        FrBox box;
        fr_write_piece(&job->organs, piece, job->up, &writing->slabs[slots + slot],
                       FR_WRITE_VERTICES | FR_WRITE_INDICES, &box, fr_job_notes(job, worker));
        fr_box_join(&boxes[slot], &box);
    }
}

static FrMesh *make_mesh(const FrSkinJob *job, FrSlab *slabs) {
    FrMesh *mesh = fr_job_mesh(job, job->vertices, job->indices);
    for (uint32_t i = 0; mesh != NULL && i < 2 * fr_job_slots(job); i++) {
        if (job->part_of[i] != FR_NONE) {
            const FrMeshPart *part = &job->parts[job->part_of[i]];
            mesh->parts[job->part_of[i]] = *part;
            slabs[i] =
                (FrSlab){mesh->vertices + part->first_vertex, mesh->indices + part->first_index};
        }
    }
    return mesh;
}

static void set_bounds(const Writing *writing, int workers, FrMesh *mesh) {
    const FrSkinJob *job = writing->job;
    const FrPlan *plan = &job->wood->plan;
    FrBox *boxes = g_new(FrBox, 2 * (size_t)plan->slots);
    for (uint32_t i = 0; i < 2 * plan->slots; i++) {
        boxes[i] = fr_box_empty();
    }
    for (uint32_t i = 0; i < plan->tubes->len; i++) {
        const FrTube *tube = &g_array_index(plan->tubes, FrTube, i);
        fr_box_join(&boxes[tube->slot], &job->wood->boxes[i]);
    }
    for (uint32_t i = 0; i < (uint32_t)workers * plan->slots; i++) {
        fr_box_join(&boxes[plan->slots + i % plan->slots], &writing->boxes[i]);
    }
    for (uint32_t i = 0; i < 2 * plan->slots; i++) {
        if (job->part_of[i] != FR_NONE) {
            fr_part_set_box(&mesh->parts[job->part_of[i]], boxes[i].min, boxes[i].max);
        }
    }
    g_free(boxes);
}

static FrStatus patch_mesh(FrSkinJob *job, FrMesh **mesh) {
    FrPatch patch;
    fr_patch_init(&patch, job, *mesh);
    fr_face_ends(&patch);
    FrStatus status = fr_weld(&patch);
    status = status == FR_OK ? fr_patch_write(&patch, mesh) : status;
    fr_patch_clear(&patch);
    return status;
}

FrStatus fr_job_write(FrSkinJob *job, FrMesh **mesh) {
    const FrContext *context = job->wood->plan.context;
    uint32_t slots = fr_job_slots(job);
    int workers = fr_pool_threads(context->pool);
    size_t boxes = (size_t)workers * slots;
    Writing writing = {job, g_new0(FrSlab, 2 * (size_t)slots), g_new(FrBox, boxes)};
    for (size_t i = 0; i < boxes; i++) {
        writing.boxes[i] = fr_box_empty();
    }
    *mesh = make_mesh(job, writing.slabs);
    FrStatus status = *mesh != NULL ? FR_OK : FR_ERR_MACHINE;
    if (status == FR_OK) {
        fr_parallel_for(context->pool, job->wood->plan.runs->len, FR_RUN_GRAIN, write_runs,
                        &writing, context->progress);
        fr_progress_report(context->progress, "skin", 0.6);
        fr_parallel_for(context->pool, job->organs.piece_count, PIECE_GRAIN, write_organs, &writing,
                        context->progress);
        status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
    }
    if (status == FR_OK) {
        set_bounds(&writing, workers, *mesh);
    }
    g_free(writing.slabs);
    g_free(writing.boxes);
    return status == FR_OK && fr_job_is_patched(job) ? patch_mesh(job, mesh) : status;
}

FrStatus fr_skin_plant(const FrPlant *plant, const FrSkinParams *params, FrUpAxis up,
                       const FrContext *context, FrMesh **mesh) {
    FrSkinJob job;
    *mesh = NULL;
    FrStatus status = fr_job_begin(&job, plant, params, up, NULL, false, context);
    status = status == FR_OK ? fr_job_write(&job, mesh) : status;
    if (status == FR_OK) {
        fr_progress_report(context->progress, "skin", 1.0);
    } else {
        fr_mesh_free(*mesh);
        *mesh = NULL;
    }
    fr_job_report(&job, plant);
    fr_job_clear(&job);
    return status;
}

FrStatus fr_skin_shape(const FrPlant *plant, uint32_t shape, const FrSkinParams *params,
                       FrUpAxis up, const FrContext *context, FrMesh **mesh) {
    FR_ASSERT(shape < plant->shapes->len);
    *mesh = NULL;
    FrDetail detail = fr_detail(params);
    FrShapeMesh form;
    fr_shape_mesh_init(&form, plant, shape, &detail);
    FrStatus status = fr_limit_check(form.index_count / 3, context->limits.triangles, "triangles",
                                     "shape", fr_plant_place(plant), context->diags);
    if (status == FR_OK) {
        FrBox box = fr_box_empty();
        FrMesh *made = fr_mesh_new(form.vertex_count, form.index_count, 1);
        status = made != NULL ? FR_OK : FR_ERR_MACHINE;
        for (uint32_t i = 0; made != NULL && i < form.vertex_count; i++) {
            made->vertices[i] = form.vertices[i];
            vec3s at, normal;
            memcpy(at.raw, form.vertices[i].position, sizeof at.raw);
            memcpy(normal.raw, form.vertices[i].normal, sizeof normal.raw);
            at = fr_upright(at, up);
            normal = fr_upright(normal, up);
            memcpy(made->vertices[i].position, at.raw, sizeof at.raw);
            memcpy(made->vertices[i].normal, normal.raw, sizeof normal.raw);
            fr_box_widen(&box, &made->vertices[i], 1);
        }
        if (made != NULL && form.index_count > 0) {
            memcpy(made->indices, form.indices, form.index_count * sizeof *form.indices);
        }
        if (made != NULL) {
            made->parts[0] = (FrMeshPart){.material = FR_NONE,
                                          .is_foliage = form.is_foliage,
                                          .vertex_count = form.vertex_count,
                                          .index_count = form.index_count};
            memcpy(made->parts[0].min, box.min, sizeof box.min);
            memcpy(made->parts[0].max, box.max, sizeof box.max);
        }
        *mesh = made;
    }
    fr_shape_mesh_clear(&form);
    return status;
}
