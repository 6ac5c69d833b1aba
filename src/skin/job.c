// Plans a skin: what moves is moved, rings and leaves are chosen, counted and given their places.
#include "skin/job.h"

#include "skin/mesh.h"
#include "skin/took.h"

#include "plant/place.h"
#include "plant/shapes.h"

// ---- wood --------------------------------------------------------------------------------------

static void measure_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    fr_measure_runs(data, begin, end);
}

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

FrDigest fr_wood_inputs(const FrPlant *plant) {
    uint32_t counts[] = {plant->materials->len, plant->profiles->len};
    FrDigest digest = fr_digest(0, counts, sizeof counts);
    if (plant->finishes->len > 0) {
        digest = fr_digest(digest, plant->finishes->data, plant->finishes->len * sizeof(FrFinish));
    }
    for (guint i = 0; i < plant->materials->len; i++) {
        const FrMaterial *material = g_ptr_array_index(plant->materials, i);
        const FrMaterialParams *params = fr_material_params(material);
        double tile[] = {params->tile_width, params->tile_height};
        digest = fr_digest(digest, tile, sizeof tile);
    }
    for (guint i = 0; i < plant->profiles->len; i++) {
        digest = fr_profile_digest(digest, &g_array_index(plant->profiles, FrProfile, i));
    }
    return digest;
}

static FrWood *wood_new(const FrPlant *posed, const FrScopes *scopes, const FrSkinParams *params,
                        bool is_timed, const FrContext *context) {
    FrWood *wood = g_atomic_rc_box_new0(FrWood);
    FrPlan *plan = &wood->plan;
    fr_plan_init(plan, posed, scopes, params, context);
    if (is_timed) {
        fr_took_init(plan);
    }
    fr_parallel_for(context->pool, plan->runs->len, FR_RUN_GRAIN, measure_range, plan,
                    context->progress);
    wood->inputs = fr_wood_inputs(posed);
    wood->sums = place_tubes(plan);
    wood->boxes = g_new(FrBox, (size_t)plan->tubes->len + 1);
    return wood;
}

static void wood_clear(gpointer data) {
    FrWood *wood = data;
    fr_plan_clear(&wood->plan);
    g_free(wood->sums);
    g_free(wood->boxes);
    g_free(wood->digests);
}

FrWood *fr_wood_ref(FrWood *wood) {
    return g_atomic_rc_box_acquire(wood);
}

void fr_wood_unref(FrWood *wood) {
    if (wood != NULL) {
        g_atomic_rc_box_release_full(wood, wood_clear);
    }
}

// ---- deformation -------------------------------------------------------------------------------

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

void fr_job_report(FrSkinJob *job, const FrPlant *plant) {
    const FrContext *context = job->wood->plan.context;
    if (job->scopes == NULL) {
        return;
    }
    for (int worker = 1; worker < fr_pool_threads(context->pool); worker++) {
        fr_deform_join_notes(job->notes, fr_job_notes(job, worker), job->deformations);
    }
    fr_deform_report(plant, job->notes, context->diags);
}

// ---- the whole ---------------------------------------------------------------------------------

// The component with the most organs, or axes where there are none: who asked for the triangles.
static const FrComponent *largest_of(const FrPlant *plant) {
    uint32_t count = plant->components->len, most = 0;
    uint64_t *made = g_new0(uint64_t, count + 1);
    bool has_organs = plant->organs.count > 0;
    const uint32_t *component = has_organs ? plant->organs.component : plant->axes.component;
    uint32_t rows = has_organs ? plant->organs.count : plant->axes.count;
    for (uint32_t i = 0; i < rows; i++) {
        made[MIN(component[i], count)]++;
    }
    for (uint32_t c = 1; c < count; c++) {
        most = made[c] > made[most] ? c : most;
    }
    g_free(made);
    return count > 0 ? &g_array_index(plant->components, FrComponent, most) : NULL;
}

// A slip of a digit is found here, before there is a mesh.
static FrStatus check_triangles(const FrPlan *plan, uint64_t triangles, const char *who) {
    const FrContext *context = plan->context;
    FrSpan place = fr_plant_place(plan->plant);
    if (triangles > context->limits.plant_triangles) {
        const FrComponent *largest = largest_of(plan->plant);
        return fr_limit_check(triangles, context->limits.plant_triangles, "plant_triangles",
                              largest != NULL ? largest->id : who,
                              largest != NULL ? largest->span : place, context->diags);
    }
    return fr_limit_check(triangles, context->limits.triangles, "triangles", who, place,
                          context->diags);
}

FrStatus fr_job_check(const FrSkinJob *job, uint64_t vertices, uint64_t indices) {
    const FrPlan *plan = &job->wood->plan;
    const FrContext *context = plan->context;
    const char *who = plan->plant->name != NULL ? plan->plant->name : "plant";
    uint64_t bytes = fr_count_add(fr_count_multiply(vertices, sizeof(FrVertex)),
                                  fr_count_multiply(indices, sizeof(uint32_t)));
    FrStatus status = check_triangles(plan, indices / 3, who);
    return status != FR_OK ? status
                           : fr_limit_check(bytes, context->limits.bytes, "bytes", who,
                                            fr_plant_place(plan->plant), context->diags);
}

static FrStatus check_limits(const FrSkinJob *job) {
    const FrPlan *plan = &job->wood->plan;
    const FrSlotSum *wood = job->wood->sums;
    const FrContext *context = plan->context;
    uint64_t vertices = 0, indices = 0, largest = 0;
    for (uint32_t i = 0; i < plan->slots; i++) {
        uint64_t in_organs = job->organs.slot_vertices[i];
        vertices = fr_count_add(vertices, fr_count_add(wood[i].vertices, in_organs));
        indices = fr_count_add(indices, fr_count_add(wood[i].indices, job->organs.slot_indices[i]));
        largest = MAX(largest, MAX(wood[i].vertices, in_organs));
    }
    const char *who = plan->plant->name != NULL ? plan->plant->name : "plant";
    FrStatus status = fr_job_check(job, vertices, indices);
    if (status == FR_OK) {
        status = fr_limit_check(largest, UINT32_MAX, "vertices of one material", who,
                                fr_plant_place(plan->plant), context->diags);
    }
    return status;
}

// One part per material of wood, then one per material of organs, each in the order of materials.
static void make_parts(FrSkinJob *job) {
    const FrSlotSum *wood = job->wood->sums;
    uint32_t slots = fr_job_slots(job);
    job->parts = g_new0(FrMeshPart, 2 * (size_t)slots);
    job->part_of = g_new(uint32_t, 2 * (size_t)slots);
    for (uint32_t i = 0; i < 2 * slots; i++) {
        uint32_t slot = i % slots;
        bool is_organs = i >= slots;
        FrMeshPart part = {
            .material = slot == 0 ? FR_NONE : slot - 1,
            .is_foliage = is_organs ? job->organs.slot_foliage[slot] : wood[slot].is_foliage,
            .first_vertex = job->vertices,
            .vertex_count = is_organs ? job->organs.slot_vertices[slot] : wood[slot].vertices,
            .first_index = job->indices,
            .index_count = is_organs ? job->organs.slot_indices[slot] : wood[slot].indices,
        };
        job->part_of[i] = part.index_count > 0 ? job->part_count : FR_NONE;
        if (part.index_count > 0) {
            job->parts[job->part_count++] = part;
            job->vertices += part.vertex_count;
            job->indices += part.index_count;
        }
    }
}

FrStatus fr_job_begin(FrSkinJob *job, const FrPlant *plant, const FrSkinParams *params, FrUpAxis up,
                      const FrSkinJob *same, bool is_timed, const FrContext *context) {
    *job = (FrSkinJob){.up = up};
    fr_progress_report(context->progress, "skin", 0.0);
    if (same != NULL) {
        job->wood = fr_wood_ref(same->wood);
        job->wood->plan.plant = plant;
        job->wood->plan.context = context;
    } else {
        const FrPlant *posed = begin_deforming(job, plant, fr_pool_threads(context->pool));
        job->wood = wood_new(posed, job->scopes, params, is_timed, context);
    }
    FrStatus status =
        fr_organs_init(&job->organs, &job->wood->plan, same != NULL ? &same->organs : NULL);
    fr_progress_report(context->progress, "skin", 0.3);
    if (status == FR_OK && fr_progress_is_cancelled(context->progress)) {
        status = FR_CANCELLED;
    }
    status = status == FR_OK ? check_limits(job) : status;
    if (status == FR_OK) {
        make_parts(job);
    }
    return status;
}

bool fr_job_is_patched(const FrSkinJob *job) {
    const GArray *tubes = job->wood->plan.tubes;
    for (uint32_t i = 0; i < tubes->len; i++) {
        const FrTube *tube = &g_array_index(tubes, FrTube, i);
        if ((tube->is_welded || tube->face_indices > 0) && tube->rings > 0) {
            return true;
        }
    }
    return false;
}

FrMesh *fr_job_mesh(const FrSkinJob *job, uint64_t vertices, uint64_t indices) {
    FrMesh *mesh = fr_mesh_new(vertices, indices, job->part_count);
    if (mesh == NULL) {
        fr_diags_add(job->wood->plan.context->diags, FR_ERROR, "out-of-memory", (FrSpan){0},
                     "There is no memory for a mesh of %" G_GUINT64_FORMAT " triangles",
                     indices / 3);
    }
    return mesh;
}

void fr_job_clear(FrSkinJob *job) {
    if (job->wood != NULL) {
        fr_organs_clear(&job->organs);
    }
    fr_wood_unref(job->wood);
    g_free(job->parts);
    g_free(job->part_of);
    fr_plant_free(job->moved);
    if (job->scopes != NULL) {
        fr_scopes_free(job->scopes);
    }
    g_free(job->notes);
}
