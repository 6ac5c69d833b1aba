// Plant → rational surfaces: plan, count, allocate once, write in parallel.
#include "frond/nurbs_skin.h"

#include "plant/place.h"
#include "skin/nurbs_job.h"

#include <string.h>

#define FR_PARAM_STRUCT FrNurbsParams
static const FrParam nurbs_rows[] = {FR_NURBS_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable nurbs_table = {
    .element = "nurbs",
    .meaning = "the plant is shown as rational surfaces, made and bent like this",
    .rows = nurbs_rows,
    .count = G_N_ELEMENTS(nurbs_rows),
    .struct_size = sizeof(FrNurbsParams),
};

const FrParamTable *fr_nurbs_table(void) {
    return &nurbs_table;
}

FrNurbsParams fr_nurbs_default(void) {
    FrNurbsParams params;
    fr_params_init(&nurbs_table, &params);
    return params;
}

static FrStatus allocate(FrNurbsJob *job, const char *name) {
    const FrContext *context = job->context;
    uint64_t bytes = fr_count_multiply(job->pieces, sizeof(FrNurbsPiece));
    bytes = fr_count_add(bytes, fr_count_multiply(job->copies, sizeof(FrNurbsCopy)));
    bytes = fr_count_add(bytes, fr_count_multiply(job->points, 4 * sizeof(double)));
    bytes = fr_count_add(bytes, fr_count_multiply(job->textures, 2 * sizeof(double)));
    bytes = fr_count_add(bytes, fr_count_multiply(job->knots, sizeof(double)));
    FrStatus status = fr_limit_check(bytes, context->limits.bytes, "bytes", name,
                                     fr_plant_place(job->plan.plant), context->diags);
    if (status != FR_OK) {
        return status;
    }
    FrNurbsSkin *skin = g_new0(FrNurbsSkin, 1);
    *skin = (FrNurbsSkin){
        .pieces = fr_mesh_allocate(job->pieces * sizeof *skin->pieces),
        .count = job->own_pieces,
        .copies = fr_mesh_allocate(job->copies * sizeof *skin->copies),
        .copy_count = job->copies,
        .textures = fr_mesh_allocate(job->textures * sizeof *skin->textures),
        .texture_count = job->textures,
        .knots = fr_mesh_allocate(job->knots * sizeof *skin->knots),
        .points = fr_mesh_allocate(job->points * sizeof *skin->points),
        .knot_count = job->knots,
        .point_count = job->points,
    };
    job->skin = skin;
    if (skin->pieces == NULL || skin->knots == NULL || skin->points == NULL ||
        skin->copies == NULL || skin->textures == NULL) {
        fr_diags_add(context->diags, FR_ERROR, "out-of-memory", (FrSpan){0},
                     "%s: no memory for %" G_GUINT64_FORMAT " bytes of surfaces", name, bytes);
        return FR_ERR_MACHINE;
    }
    return FR_OK;
}

static void write_shared_knots(FrNurbsJob *job) {
    double *knots = job->skin->knots;
    static const double ruled[FR_RULED_KNOTS] = {0, 0, 1, 1};
    memcpy(knots, ruled, sizeof ruled);
    memcpy(knots + FR_RULED_KNOTS, fr_fork_knots, sizeof fr_fork_knots);
    for (uint32_t i = 0; i < job->sections.sections->len; i++) {
        const FrNurbsCurve *curve = &g_array_index(job->sections.sections, FrNurbsSection, i).from;
        memcpy(knots + job->section_knot[i], curve->knots,
               sizeof(double) * (curve->count + curve->degree + 1));
    }
}

void fr_nurbs_deform(const FrNurbsJob *job, uint32_t scope, double (*points)[4], uint64_t count,
                     int worker) {
    if (scope == FR_NONE) {
        return;
    }
    FrDeformNote *notes = job->notes + (size_t)worker * job->plan.plant->deformations->len;
    for (uint64_t i = 0; i < count; i++) {
        FrFlow flow = fr_flow_at(points[i]);
        fr_scopes_pass(job->scopes, scope, FR_NONE, FR_LEVEL_TRIANGLES, &flow, notes);
        memcpy(points[i], flow.at, sizeof flow.at);
    }
}

// ---- the whole ---------------------------------------------------------------------------------

// Moves the skeleton; what moves the skin waits for its control points.
static const FrPlant *begin_deforming(FrNurbsJob *job, const FrPlant *plant, int workers) {
    job->scopes = fr_scopes_new(plant);
    if (job->scopes == NULL) {
        return plant;
    }
    job->notes = g_new0(FrDeformNote, (size_t)workers * plant->deformations->len);
    if (job->scopes->has_skeleton) {
        job->moved = fr_scopes_move_skeleton(job->scopes, job->notes);
    }
    fr_scopes_settle(job->scopes);
    return job->moved != NULL ? job->moved : plant;
}

static void end_deforming(FrNurbsJob *job, const FrPlant *plant, int workers) {
    if (job->scopes == NULL) {
        return;
    }
    uint32_t count = plant->deformations->len;
    for (int worker = 1; worker < workers; worker++) {
        fr_deform_join_notes(job->notes, job->notes + (size_t)worker * count, count);
    }
    fr_deform_report(plant, job->notes, job->context->diags);
    fr_plant_free(job->moved);
    fr_scopes_free(job->scopes);
    g_free(job->notes);
}

static void job_clear(FrNurbsJob *job, int workers) {
    for (uint32_t s = 0; s < job->plan.plant->shapes->len; s++) {
        if (job->shapes[s].forms != NULL) {
            g_array_unref(job->shapes[s].forms);
        }
    }
    for (int worker = 0; worker < workers; worker++) {
        fr_nurbs_path_clear(&job->paths[worker]);
    }
    g_array_unref(job->models);
    g_free(job->shapes);
    g_free(job->paths);
    g_free(job->tubes);
    g_free(job->organs);
    g_free(job->section_knot);
    fr_nurbs_sections_clear(&job->sections);
    fr_plan_clear(&job->plan);
}

static FrStatus run(FrNurbsJob *job) {
    const FrContext *context = job->context;
    job->knots = FR_RULED_KNOTS + FR_FORK_KNOTS;
    fr_nurbs_place_tubes(job);
    FrStatus status = fr_nurbs_make_shapes(job);
    if (status == FR_OK && fr_progress_is_cancelled(context->progress)) {
        status = FR_CANCELLED;
    }
    if (status == FR_OK) {
        fr_nurbs_place_organs(job);
        status = allocate(job, job->plan.plant->name);
    }
    if (status == FR_OK) {
        write_shared_knots(job);
        fr_progress_report(context->progress, "skin", 0.3);
        fr_nurbs_write_tubes(job);
        fr_nurbs_write_organs(job);
        status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
    }
    return status;
}

static FrStatus skin_plant(const FrPlant *plant, const FrNurbsParams *params, int share,
                           const FrContext *context, FrNurbsSkin **skin) {
    *skin = NULL;
    int workers = fr_pool_threads(context->pool);
    FrNurbsJob job = {.params = params, .context = context, .share = share};
    FrPlant *weighed = fr_nurbs_posed(plant, params);
    const FrPlant *before = weighed != NULL ? weighed : plant;
    const FrPlant *posed = begin_deforming(&job, before, workers);
    FrSkinParams plain = fr_skin_default();
    fr_plan_init(&job.plan, posed, job.scopes, &plain, context);
    fr_nurbs_sections_init(&job.sections);
    job.organ_count = params->foliage ? posed->organs.count : 0;
    job.tubes = g_new0(FrNurbsPlace, (size_t)job.plan.tubes->len + 1);
    job.organs = g_new0(FrNurbsPlace, (size_t)job.organ_count + 1);
    job.shapes = g_new0(FrNurbsShapeForms, (size_t)posed->shapes->len + 1);
    job.models = g_array_new(FALSE, FALSE, sizeof(FrNurbsModel));
    job.paths = g_new0(FrNurbsPath, (size_t)workers);
    FrStatus status = run(&job);
    if (status == FR_OK) {
        fr_nurbs_tell_left_out(&job);
        *skin = job.skin;
        fr_progress_report(context->progress, "skin", 1.0);
    } else {
        fr_nurbs_skin_free(job.skin);
    }
    job_clear(&job, workers);
    end_deforming(&job, before, workers);
    fr_plant_free(weighed);
    return status;
}

FrStatus fr_nurbs_plant(const FrPlant *plant, const FrNurbsParams *params, const FrContext *context,
                        FrNurbsSkin **skin) {
    return skin_plant(plant, params, FR_SHARE_NO, context, skin);
}

FrStatus fr_nurbs_plant_shared(const FrPlant *plant, const FrNurbsParams *params,
                               const FrContext *context, FrNurbsSkin **skin) {
    return skin_plant(plant, params, params->share, context, skin);
}
