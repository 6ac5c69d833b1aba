// Plant → rational surfaces: plan, count, allocate once, write in parallel.
#include "frond/nurbs_skin.h"

#include "skin/mesh.h"
#include "skin/nurbs.h"
#include "skin/organs.h"

#include <string.h>

enum { TUBE_GRAIN = 64, ORGAN_GRAIN = 256, SHAPE_GRAIN = 4 };

#define FR_PARAM_STRUCT FrNurbsParams
static const FrParam nurbs_rows[] = {FR_NURBS_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable nurbs_table = {
    .element = "nurbs",
    .meaning = "how a plant becomes rational surfaces",
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

/// Where what a tube or organ makes is written.
typedef struct FrNurbsPlace {
    uint64_t piece, point, knot;
    uint32_t section; ///< tubes
    uint32_t rows;    ///< tubes; 0: nothing
} FrNurbsPlace;

/// A shape and where its knots are kept, once for all organs that have it.
typedef struct FrNurbsShapeForms {
    GArray *forms; ///< FrNurbsForm; NULL if no organ has it
    uint64_t knot, points;
} FrNurbsShapeForms;

/// One call of fr_nurbs_plant().
typedef struct FrNurbsJob {
    const FrNurbsParams *params;
    const FrContext *context;
    FrPlan plan;
    FrScopes *scopes;    ///< of deformations; NULL
    FrPlant *moved;      ///< by the deformations of the skeleton; NULL
    FrDeformNote *notes; ///< by worker and deformation
    FrNurbsSections sections;
    uint64_t *section_knot;    ///< by section
    FrNurbsPlace *tubes;       ///< by tube
    FrNurbsPlace *organs;      ///< by organ
    FrNurbsShapeForms *shapes; ///< by shape
    FrNurbsPath *paths;        ///< by worker
    FrNurbsSkin *skin;
    uint64_t pieces, points, knots;
} FrNurbsJob;

static const double cap_knots[4] = {0, 0, 1, 1};

// ---- counting ----------------------------------------------------------------------------------

static void measure_tubes(void *data, size_t begin, size_t end, int worker) {
    FrNurbsJob *job = data;
    FrNurbsPath *path = &job->paths[worker];
    for (size_t i = begin; i < end; i++) {
        fr_nurbs_path(path, &job->plan, &g_array_index(job->plan.tubes, FrTube, i), job->params);
        job->tubes[i].rows = fr_nurbs_rows(path, job->params);
    }
}

// An axis that goes on from another with its own profile turns into it on its way.
static uint32_t profile_before(const FrPlan *plan, const FrTube *tube) {
    const FrPlant *plant = plan->plant;
    const FrAxes *axes = &plant->axes;
    uint32_t bearer = axes->bearer[tube->axis];
    bool goes_on = bearer != FR_NONE && (axes->flags[tube->axis] & FR_CONTINUES) != 0 &&
                   axes->first[tube->axis] == tube->first;
    return goes_on ? axes->profile[plant->nodes.axis[bearer]] : axes->profile[tube->axis];
}

static void place_tubes(FrNurbsJob *job) {
    const FrPlan *plan = &job->plan;
    for (uint32_t i = 0; i < plan->tubes->len; i++) {
        const FrTube *tube = &g_array_index(plan->tubes, FrTube, i);
        FrNurbsPlace *place = &job->tubes[i];
        place->section = fr_nurbs_section(&job->sections, plan, profile_before(plan, tube),
                                          plan->plant->axes.profile[tube->axis], job->params);
        if (place->rows == 0) {
            continue;
        }
        const FrNurbsSection *section =
            &g_array_index(job->sections.sections, FrNurbsSection, place->section);
        bool has_caps = job->params->caps && section->is_closed;
        place->piece = job->pieces;
        place->point = job->points;
        place->knot = job->knots;
        job->pieces += has_caps ? 3 : 1;
        job->points += (uint64_t)section->from.count * (place->rows + (has_caps ? 2 : 0));
        job->knots += place->rows + 4;
    }
    uint32_t count = job->sections.sections->len;
    job->section_knot = g_new(uint64_t, count);
    for (uint32_t i = 0; i < count; i++) {
        const FrNurbsCurve *curve = &g_array_index(job->sections.sections, FrNurbsSection, i).from;
        job->section_knot[i] = job->knots;
        job->knots += curve->count + curve->degree + 1;
    }
}

static void make_shapes(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrNurbsJob *job = data;
    const FrPlant *plant = job->plan.plant;
    for (size_t i = begin; i < end; i++) {
        FrNurbsShapeForms *shape = &job->shapes[i];
        if (shape->points == 0) {
            continue;
        }
        shape->forms =
            fr_nurbs_shape(plant, &g_array_index(plant->shapes, FrShape, i), job->params);
        shape->points = 0;
        for (uint32_t f = 0; f < shape->forms->len; f++) {
            const FrNurbsForm *form = &g_array_index(shape->forms, FrNurbsForm, f);
            shape->points += (uint64_t)form->count_u * form->count_v;
        }
    }
}

static FrStatus prepare_shapes(FrNurbsJob *job, uint32_t organs) {
    const FrPlant *plant = job->plan.plant;
    for (uint32_t i = 0; i < organs; i++) {
        if (plant->organs.shape[i] < plant->shapes->len) {
            job->shapes[plant->organs.shape[i]].points = 1; // until it is counted
        }
    }
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < plant->shapes->len; i++) {
        bool is_used = job->shapes[i].points > 0;
        const FrShape *shape = &g_array_index(plant->shapes, FrShape, i);
        bytes = fr_count_add(bytes, is_used ? fr_nurbs_shape_bytes_most(plant, shape) : 0);
    }
    FrStatus status = fr_limit_check(bytes, job->context->limits.bytes, "bytes", "shapes of organs",
                                     (FrSpan){0}, job->context->diags);
    if (status == FR_OK) {
        fr_parallel_for(job->context->pool, plant->shapes->len, SHAPE_GRAIN, make_shapes, job,
                        job->context->progress);
    }
    return status;
}

static void place_organs(FrNurbsJob *job, uint32_t organs) {
    const FrPlant *plant = job->plan.plant;
    for (uint32_t s = 0; s < plant->shapes->len; s++) {
        FrNurbsShapeForms *shape = &job->shapes[s];
        shape->knot = job->knots;
        for (uint32_t f = 0; shape->forms != NULL && f < shape->forms->len; f++) {
            const FrNurbsForm *form = &g_array_index(shape->forms, FrNurbsForm, f);
            job->knots += form->count_u + form->degree_u + form->count_v + form->degree_v + 2;
        }
    }
    for (uint32_t i = 0; i < organs; i++) {
        uint32_t form = plant->organs.shape[i];
        if (form >= plant->shapes->len || job->shapes[form].forms == NULL ||
            !fr_organ_is_drawn(&job->plan, i)) {
            continue;
        }
        FrNurbsPlace *place = &job->organs[i];
        place->piece = job->pieces;
        place->point = job->points;
        place->rows = job->shapes[form].forms->len;
        job->pieces += place->rows;
        job->points += job->shapes[form].points;
    }
}

static FrStatus allocate(FrNurbsJob *job, const char *name) {
    const FrContext *context = job->context;
    uint64_t bytes = fr_count_multiply(job->pieces, sizeof(FrNurbsPiece));
    bytes = fr_count_add(bytes, fr_count_multiply(job->points, 4 * sizeof(double)));
    bytes = fr_count_add(bytes, fr_count_multiply(job->knots, sizeof(double)));
    FrStatus status =
        fr_limit_check(bytes, context->limits.bytes, "bytes", name, (FrSpan){0}, context->diags);
    if (status != FR_OK) {
        return status;
    }
    FrNurbsSkin *skin = g_new0(FrNurbsSkin, 1);
    *skin = (FrNurbsSkin){
        .pieces = fr_mesh_allocate(job->pieces * sizeof *skin->pieces),
        .count = job->pieces,
        .knots = fr_mesh_allocate(job->knots * sizeof *skin->knots),
        .points = fr_mesh_allocate(job->points * sizeof *skin->points),
        .knot_count = job->knots,
        .point_count = job->points,
    };
    job->skin = skin;
    if (skin->pieces == NULL || skin->knots == NULL || skin->points == NULL) {
        fr_diags_add(context->diags, FR_ERROR, "out-of-memory", (FrSpan){0},
                     "%s: no memory for %" G_GUINT64_FORMAT " bytes of surfaces", name, bytes);
        return FR_ERR_MACHINE;
    }
    return FR_OK;
}

// ---- writing -----------------------------------------------------------------------------------

static void write_shared_knots(FrNurbsJob *job) {
    double *knots = job->skin->knots;
    memcpy(knots, cap_knots, sizeof cap_knots);
    for (uint32_t i = 0; i < job->sections.sections->len; i++) {
        const FrNurbsCurve *curve = &g_array_index(job->sections.sections, FrNurbsSection, i).from;
        memcpy(knots + job->section_knot[i], curve->knots,
               sizeof(double) * (curve->count + curve->degree + 1));
    }
    for (uint32_t s = 0; s < job->plan.plant->shapes->len; s++) {
        double *to = knots + job->shapes[s].knot;
        GArray *forms = job->shapes[s].forms;
        for (uint32_t f = 0; forms != NULL && f < forms->len; f++) {
            const FrNurbsForm *form = &g_array_index(forms, FrNurbsForm, f);
            memcpy(to, form->knots_u, sizeof(double) * (form->count_u + form->degree_u + 1));
            to += form->count_u + form->degree_u + 1;
            memcpy(to, form->knots_v, sizeof(double) * (form->count_v + form->degree_v + 1));
            to += form->count_v + form->degree_v + 1;
        }
    }
}

/// Takes control points through the free-form deformations around them.
static void deform(const FrNurbsJob *job, uint32_t scope, double (*points)[4], uint64_t count,
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

// A cap is ruled from the rim to the middle of the path's end. The row of the middle lies next to
// the tube's net, whose outermost row is the rim of both.
static void write_cap(const FrNurbsJob *job, FrNurbsPiece *piece, const FrNurbsPiece *tube,
                      bool is_tip, const double centre[3], double (*middle)[4]) {
    uint32_t width = tube->surface.count_u;
    const double(*rim)[4] = (const double(*)[4])(is_tip ? middle - width : middle + width);
    for (uint32_t i = 0; i < width; i++) {
        memcpy(middle[i], centre, 3 * sizeof(double));
        middle[i][3] = rim[i][3];
    }
    *piece = *tube;
    piece->kind = is_tip ? FR_NURBS_CAP : FR_NURBS_FOOT;
    piece->surface.degree_v = 1;
    piece->surface.count_v = 2;
    piece->surface.knots_v = job->skin->knots;
    piece->surface.points = is_tip ? rim : (const double(*)[4])middle;
}

// Where the path of a net begins: with a smooth join not at its first point.
static void net_begin(const FrNurbsPath *path, const FrNurbsParams *params, double centre[3]) {
    const FrNurbsStation *s = path->stations;
    bool is_blend = params->join == FR_JOIN_SMOOTH && path->shared == 3;
    for (int k = 0; k < 3; k++) {
        centre[k] = is_blend ? (s[0].at[k] + 4.0 * s[1].at[k] + s[2].at[k]) / 6.0 : s[0].at[k];
    }
}

static void write_tube(const FrNurbsJob *job, uint32_t index, int worker) {
    const FrPlan *plan = &job->plan;
    const FrTube *tube = &g_array_index(plan->tubes, FrTube, index);
    const FrNurbsPlace *place = &job->tubes[index];
    const FrNurbsSection *section =
        &g_array_index(job->sections.sections, FrNurbsSection, place->section);
    FrNurbsSkin *skin = job->skin;
    FrNurbsPath *path = &job->paths[worker];
    uint32_t width = section->from.count;
    bool has_caps = job->params->caps && section->is_closed;
    double(*all)[4] = skin->points + place->point, *knots = skin->knots + place->knot;
    double(*net)[4] = has_caps ? all + width : all;
    fr_nurbs_path(path, plan, tube, job->params);
    fr_nurbs_sweep(path, section, plan, job->params, net, knots);
    FrNurbsPiece *piece = &skin->pieces[place->piece];
    *piece = (FrNurbsPiece){
        .surface = {.degree_u = section->from.degree,
                    .degree_v = 3,
                    .count_u = width,
                    .count_v = place->rows,
                    .knots_u = skin->knots + job->section_knot[place->section],
                    .knots_v = knots,
                    .points = (const double(*)[4])net},
        .kind = FR_NURBS_TUBE,
        .material = plan->plant->axes.material[tube->axis],
        .axis = tube->axis,
        .organ = FR_NONE,
    };
    if (has_caps) {
        double centre[3];
        net_begin(path, job->params, centre);
        write_cap(job, piece + 1, piece, false, centre, all);
        write_cap(job, piece + 2, piece, true, path->stations[path->count - 1].at,
                  net + (size_t)width * place->rows);
    }
    deform(job, tube->scope, all, (uint64_t)width * (place->rows + (has_caps ? 2 : 0)), worker);
}

static void write_tubes(void *data, size_t begin, size_t end, int worker) {
    const FrNurbsJob *job = data;
    for (size_t i = begin; i < end; i++) {
        if (job->tubes[i].rows > 0) {
            write_tube(job, (uint32_t)i, worker);
        }
    }
}

static void write_form(const FrNurbsForm *form, const double axes[3][3], const double at[3],
                       double (*points)[4]) {
    for (size_t i = 0; i < (size_t)form->count_u * form->count_v; i++) {
        const double *p = form->points[i];
        for (int k = 0; k < 3; k++) {
            points[i][k] = at[k] + p[0] * axes[0][k] + p[1] * axes[1][k] + p[2] * axes[2][k];
        }
        points[i][3] = p[3];
    }
}

static void write_organ(const FrNurbsJob *job, uint32_t organ, int worker) {
    const FrPlant *plant = job->plan.plant;
    const FrNurbsPlace *place = &job->organs[organ];
    const FrNurbsShapeForms *shape = &job->shapes[plant->organs.shape[organ]];
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(plant, organ, &position, &rotation);
    const vec3s turned[3] = {fr_frame_left(rotation), fr_frame_up(rotation),
                             fr_frame_heading(rotation)};
    double axes[3][3], at[3], scale = (double)plant->organs.scale[organ];
    for (int k = 0; k < 3; k++) {
        at[k] = (double)position.raw[k];
        for (int a = 0; a < 3; a++) {
            axes[a][k] = scale * (double)turned[a].raw[k];
        }
    }
    double(*points)[4] = job->skin->points + place->point;
    const double *knots = job->skin->knots + shape->knot;
    for (uint32_t f = 0; f < place->rows; f++) {
        const FrNurbsForm *form = &g_array_index(shape->forms, FrNurbsForm, f);
        write_form(form, (const double(*)[3])axes, at, points);
        uint32_t knots_u = form->count_u + form->degree_u + 1;
        job->skin->pieces[place->piece + f] = (FrNurbsPiece){
            .surface = {form->degree_u, form->degree_v, form->count_u, form->count_v, knots,
                        knots + knots_u, (const double(*)[4])points},
            .kind = form->kind,
            .material = plant->organs.material[organ],
            .axis = FR_NONE,
            .organ = organ,
        };
        knots += knots_u + form->count_v + form->degree_v + 1;
        points += (size_t)form->count_u * form->count_v;
    }
    deform(job, fr_plan_scope(&job->plan, plant->organs.deformer[organ]),
           job->skin->points + place->point, shape->points, worker);
}

static void write_organs(void *data, size_t begin, size_t end, int worker) {
    const FrNurbsJob *job = data;
    for (size_t i = begin; i < end; i++) {
        if (job->organs[i].rows > 0) {
            write_organ(job, (uint32_t)i, worker);
        }
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
    g_free(job->shapes);
    g_free(job->paths);
    g_free(job->tubes);
    g_free(job->organs);
    g_free(job->section_knot);
    fr_nurbs_sections_clear(&job->sections);
    fr_plan_clear(&job->plan);
}

static FrStatus run(FrNurbsJob *job, uint32_t organs) {
    const FrContext *context = job->context;
    job->knots = G_N_ELEMENTS(cap_knots);
    fr_parallel_for(context->pool, job->plan.tubes->len, TUBE_GRAIN, measure_tubes, job,
                    context->progress);
    place_tubes(job);
    FrStatus status = prepare_shapes(job, organs);
    if (status == FR_OK && fr_progress_is_cancelled(context->progress)) {
        status = FR_CANCELLED;
    }
    if (status == FR_OK) {
        place_organs(job, organs);
        status = allocate(job, job->plan.plant->name);
    }
    if (status == FR_OK) {
        write_shared_knots(job);
        fr_progress_report(context->progress, "skin", 0.3);
        fr_parallel_for(context->pool, job->plan.tubes->len, TUBE_GRAIN, write_tubes, job,
                        context->progress);
        fr_parallel_for(context->pool, organs, ORGAN_GRAIN, write_organs, job, context->progress);
        status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
    }
    return status;
}

FrStatus fr_nurbs_plant(const FrPlant *plant, const FrNurbsParams *params, const FrContext *context,
                        FrNurbsSkin **skin) {
    *skin = NULL;
    int workers = fr_pool_threads(context->pool);
    FrNurbsJob job = {.params = params, .context = context};
    const FrPlant *posed = begin_deforming(&job, plant, workers);
    FrSkinParams plain = fr_skin_default();
    fr_plan_init(&job.plan, posed, job.scopes, &plain, context);
    fr_nurbs_sections_init(&job.sections);
    uint32_t organs = params->foliage ? posed->organs.count : 0;
    job.tubes = g_new0(FrNurbsPlace, (size_t)job.plan.tubes->len + 1);
    job.organs = g_new0(FrNurbsPlace, (size_t)organs + 1);
    job.shapes = g_new0(FrNurbsShapeForms, (size_t)posed->shapes->len + 1);
    job.paths = g_new0(FrNurbsPath, (size_t)workers);
    FrStatus status = run(&job, organs);
    if (status == FR_OK) {
        *skin = job.skin;
        fr_progress_report(context->progress, "skin", 1.0);
    } else {
        fr_nurbs_skin_free(job.skin);
    }
    job_clear(&job, workers);
    end_deforming(&job, plant, workers);
    return status;
}
