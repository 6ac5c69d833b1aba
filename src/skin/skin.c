// Plant → mesh: plan, count, allocate once, write in parallel.
#include "frond/skin.h"

#include "skin/mesh.h"
#include "skin/organs.h"
#include "skin/plan.h"
#include "skin/shape.h"
#include "skin/tube.h"

#include <string.h>

enum { RUN_GRAIN = 16, ORGAN_GRAIN = 512 };

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

/// One call of fr_skin_plant().
typedef struct FrSkinJob {
    FrPlan plan;
    FrOrganPlan organs;
    FrUpAxis up;
    FrMesh *mesh;
    uint32_t *wood_part, *organ_part; ///< by slot; FR_NONE without any
    FrBox *boxes;                     ///< by worker, then wood slots, then organ slots
    FrScopes *scopes;                 ///< of deformations; NULL
    FrPlant *moved;                   ///< moved by those of the skeleton; NULL
    uint32_t deformations;
    FrDeformNote *notes; ///< by worker, then deformation
} FrSkinJob;

static FrDeformNote *notes_of(const FrSkinJob *job, int worker) {
    return job->notes != NULL ? job->notes + (size_t)worker * job->deformations : NULL;
}

static void measure_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrSkinJob *job = data;
    fr_measure_runs(&job->plan, begin, end);
}

static void write_runs(void *data, size_t begin, size_t end, int worker) {
    FrSkinJob *job = data;
    FrBox *boxes = job->boxes + (size_t)worker * 2 * job->plan.slots;
    for (size_t i = begin; i < end; i++) {
        const FrRun *run = &g_array_index(job->plan.runs, FrRun, i);
        fr_write_run(&job->plan, run, job->up, job->mesh, job->wood_part, boxes,
                     notes_of(job, worker));
    }
}

static void write_organs(void *data, size_t begin, size_t end, int worker) {
    FrSkinJob *job = data;
    FrBox *boxes = job->boxes + ((size_t)worker * 2 + 1) * job->plan.slots;
    fr_write_organs(&job->organs, begin, end, job->up, job->mesh, job->organ_part, boxes,
                    notes_of(job, worker));
}

/// What a slot holds.
typedef struct FrSlotSum {
    uint64_t vertices, indices;
    bool is_foliage;
} FrSlotSum;

// Gives every tube its place in its part; answers the sums by slot, to be freed.
static FrSlotSum *place_tubes(FrPlan *plan) {
    FrSlotSum *sums = g_new0(FrSlotSum, plan->slots);
    for (uint32_t i = 0; i < plan->tubes->len; i++) {
        FrTube *tube = &g_array_index(plan->tubes, FrTube, i);
        FrSlotSum *sum = &sums[tube->slot];
        tube->first_vertex = sum->vertices;
        tube->first_index = sum->indices;
        sum->vertices = fr_count_add(sum->vertices, tube->vertices);
        sum->indices = fr_count_add(sum->indices, tube->indices);
        // A strip has no inside: it is seen from both sides, as a blade is.
        sum->is_foliage |= tube->rings > 0 && !plan->sections[tube->section].is_closed;
    }
    return sums;
}

static FrStatus check_limits(const FrSkinJob *job, const FrSlotSum *wood) {
    const FrContext *context = job->plan.context;
    uint64_t vertices = 0, indices = 0, largest = 0;
    for (uint32_t i = 0; i < job->plan.slots; i++) {
        uint64_t in_organs = job->organs.slot_vertices[i];
        vertices = fr_count_add(vertices, fr_count_add(wood[i].vertices, in_organs));
        indices = fr_count_add(indices, fr_count_add(wood[i].indices, job->organs.slot_indices[i]));
        largest = MAX(largest, MAX(wood[i].vertices, in_organs));
    }
    const char *who = job->plan.plant->name != NULL ? job->plan.plant->name : "plant";
    uint64_t bytes = fr_count_add(fr_count_multiply(vertices, sizeof(FrVertex)),
                                  fr_count_multiply(indices, sizeof(uint32_t)));
    FrStatus status = fr_limit_check(indices / 3, context->limits.triangles, "triangles", who,
                                     (FrSpan){0}, context->diags);
    if (status == FR_OK) {
        status =
            fr_limit_check(bytes, context->limits.bytes, "bytes", who, (FrSpan){0}, context->diags);
    }
    if (status == FR_OK) {
        status = fr_limit_check(largest, UINT32_MAX, "vertices of one material", who, (FrSpan){0},
                                context->diags);
    }
    return status;
}

// One part per material of wood, then one per material of organs, each in the order of materials.
static FrStatus make_parts(FrSkinJob *job, const FrSlotSum *wood) {
    uint32_t slots = job->plan.slots, count = 0;
    FrMeshPart *parts = g_new0(FrMeshPart, 2 * (size_t)slots);
    uint64_t vertex = 0, index = 0;
    for (uint32_t i = 0; i < 2 * slots; i++) {
        uint32_t slot = i % slots;
        bool is_organs = i >= slots;
        FrMeshPart part = {
            .material = slot == 0 ? FR_NONE : slot - 1,
            .is_foliage = is_organs ? job->organs.slot_foliage[slot] : wood[slot].is_foliage,
            .first_vertex = vertex,
            .vertex_count = is_organs ? job->organs.slot_vertices[slot] : wood[slot].vertices,
            .first_index = index,
            .index_count = is_organs ? job->organs.slot_indices[slot] : wood[slot].indices,
        };
        uint32_t *part_of = is_organs ? job->organ_part : job->wood_part;
        part_of[slot] = part.index_count > 0 ? count : FR_NONE;
        if (part.index_count > 0) {
            parts[count++] = part;
            vertex += part.vertex_count;
            index += part.index_count;
        }
    }
    job->mesh = fr_mesh_new(vertex, index, count);
    if (job->mesh != NULL) {
        for (uint32_t i = 0; i < count; i++) {
            job->mesh->parts[i] = parts[i];
        }
    } else {
        fr_diags_add(job->plan.context->diags, FR_ERROR, "out-of-memory", (FrSpan){0},
                     "There is no memory for a mesh of %" G_GUINT64_FORMAT " triangles", index / 3);
    }
    g_free(parts);
    return job->mesh != NULL ? FR_OK : FR_ERR_MACHINE;
}

static void set_bounds(FrSkinJob *job, int workers) {
    uint32_t slots = job->plan.slots;
    for (uint32_t i = 0; i < 2 * slots; i++) {
        uint32_t index = i < slots ? job->wood_part[i] : job->organ_part[i - slots];
        if (index == FR_NONE) {
            continue;
        }
        FrMeshPart *part = &job->mesh->parts[index];
        FrBox box = fr_box_empty();
        for (int w = 0; w < workers; w++) {
            const FrBox *other = &job->boxes[(size_t)w * 2 * slots + i];
            for (int k = 0; k < 3; k++) {
                box.min[k] = MIN(box.min[k], other->min[k]);
                box.max[k] = MAX(box.max[k], other->max[k]);
            }
        }
        for (int k = 0; k < 3; k++) {
            // Adding zero makes one of both zeros, whichever thread came first.
            part->min[k] = box.min[k] + 0.0F;
            part->max[k] = box.max[k] + 0.0F;
        }
    }
}

static FrStatus write_all(FrSkinJob *job) {
    const FrContext *context = job->plan.context;
    int workers = fr_pool_threads(context->pool);
    size_t boxes = (size_t)workers * 2 * job->plan.slots;
    job->boxes = g_new(FrBox, boxes);
    for (size_t i = 0; i < boxes; i++) {
        job->boxes[i] = fr_box_empty();
    }
    fr_parallel_for(context->pool, job->plan.runs->len, RUN_GRAIN, write_runs, job,
                    context->progress);
    fr_progress_report(context->progress, "skin", 0.6);
    size_t organs = job->plan.detail.foliage ? job->plan.plant->organs.count : 0;
    fr_parallel_for(context->pool, organs, ORGAN_GRAIN, write_organs, job, context->progress);
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    set_bounds(job, workers);
    return FR_OK;
}

// Moves the skeleton; what moves triangles waits for them.
static const FrPlant *begin_deforming(FrSkinJob *job, const FrPlant *plant, int workers) {
    job->scopes = fr_scopes_new(plant);
    if (job->scopes == NULL) {
        return plant;
    }
    job->deformations = plant->deformations->len;
    job->notes = g_new0(FrDeformNote, (size_t)workers * job->deformations);
    if (job->scopes->has_skeleton) {
        job->moved = fr_scopes_move_skeleton(job->scopes, job->notes);
    }
    fr_scopes_settle(job->scopes);
    return job->moved != NULL ? job->moved : plant;
}

static void end_deforming(FrSkinJob *job, const FrPlant *plant, int workers) {
    if (job->scopes == NULL) {
        return;
    }
    for (int worker = 1; worker < workers; worker++) {
        fr_deform_join_notes(job->notes, notes_of(job, worker), job->deformations);
    }
    fr_deform_report(plant, job->notes, job->plan.context->diags);
    fr_plant_free(job->moved);
    fr_scopes_free(job->scopes);
    g_free(job->notes);
}

FrStatus fr_skin_plant(const FrPlant *plant, const FrSkinParams *params, FrUpAxis up,
                       const FrContext *context, FrMesh **mesh) {
    *mesh = NULL;
    FrSkinJob job = {.up = up};
    fr_progress_report(context->progress, "skin", 0.0);
    int workers = fr_pool_threads(context->pool);
    const FrPlant *posed = begin_deforming(&job, plant, workers);
    fr_plan_init(&job.plan, posed, job.scopes, params, context);
    fr_parallel_for(context->pool, job.plan.runs->len, RUN_GRAIN, measure_range, &job,
                    context->progress);
    FrStatus status = fr_organs_init(&job.organs, &job.plan);
    fr_progress_report(context->progress, "skin", 0.3);
    job.wood_part = g_new(uint32_t, job.plan.slots);
    job.organ_part = g_new(uint32_t, job.plan.slots);

    if (status == FR_OK && fr_progress_is_cancelled(context->progress)) {
        status = FR_CANCELLED;
    }
    if (status == FR_OK) {
        FrSlotSum *wood = place_tubes(&job.plan);
        status = check_limits(&job, wood);
        status = status == FR_OK ? make_parts(&job, wood) : status;
        g_free(wood);
    }
    status = status == FR_OK ? write_all(&job) : status;
    if (status == FR_OK) {
        *mesh = job.mesh;
        fr_progress_report(context->progress, "skin", 1.0);
    } else {
        fr_mesh_free(job.mesh);
    }
    g_free(job.boxes);
    g_free(job.wood_part);
    g_free(job.organ_part);
    fr_organs_clear(&job.organs);
    fr_plan_clear(&job.plan);
    end_deforming(&job, plant, workers);
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
                                     "shape", (FrSpan){0}, context->diags);
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
