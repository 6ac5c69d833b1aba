// Organs of a rational skin: copies of the surfaces of their shapes.
#include "skin/nurbs_job.h"

#include "plant/place.h"

#include <string.h>

enum { ORGAN_GRAIN = 256, SHAPE_GRAIN = 4 };
/// Sizes of copies that are near one another differ by this part.
#define NEAR_STEP 0.02

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
        shape->points = shape->textures = 0;
        for (uint32_t f = 0; f < shape->forms->len; f++) {
            const FrNurbsForm *form = &g_array_index(shape->forms, FrNurbsForm, f);
            uint64_t points = (uint64_t)form->count_u * form->count_v;
            shape->points += points;
            shape->textures += form->texture != NULL ? points : 0;
        }
    }
}

FrStatus fr_nurbs_make_shapes(FrNurbsJob *job) {
    const FrPlant *plant = job->plan.plant;
    for (uint32_t i = 0; i < job->organ_count; i++) {
        if (plant->organs.shape[i] < plant->shapes->len) {
            job->shapes[plant->organs.shape[i]].points = 1; // until it is counted
        }
    }
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < plant->shapes->len; i++) {
        bool is_used = job->shapes[i].points > 0;
        const FrShape *shape = &g_array_index(plant->shapes, FrShape, i);
        bytes =
            fr_count_add(bytes, is_used ? fr_nurbs_shape_bytes_most(plant, shape, job->params) : 0);
    }
    FrStatus status = fr_limit_check(bytes, job->context->limits.bytes, "bytes", "shapes of organs",
                                     fr_plant_place(plant), job->context->diags);
    if (status == FR_OK) {
        fr_parallel_for(job->context->pool, plant->shapes->len, SHAPE_GRAIN, make_shapes, job,
                        job->context->progress);
    }
    return status;
}

/// Nothing moves its control points but its place.
static bool may_be_copy(const FrNurbsJob *job, uint32_t organ) {
    return job->share != FR_SHARE_NO && !fr_nurbs_is_blown(job->params) &&
           fr_plan_scope(&job->plan, job->plan.plant->organs.deformer[organ]) == FR_NONE;
}

/// The size an organ has as a copy.
static double size_of(const FrNurbsJob *job, uint32_t organ) {
    double scale = (double)job->plan.plant->organs.scale[organ];
    bool is_rounded = job->share == FR_SHARE_NEAR && scale > 1e-6;
    return is_rounded ? exp(NEAR_STEP * ceil(log(scale) / NEAR_STEP)) : scale;
}

static bool is_drawn(const FrNurbsJob *job, uint32_t organ) {
    uint32_t form = job->plan.plant->organs.shape[organ];
    return form < job->plan.plant->shapes->len && job->shapes[form].forms != NULL &&
           job->shapes[form].forms->len > 0 && fr_organ_is_drawn(&job->plan, organ);
}

/// Finds which organs have their like.
static void find_models(FrNurbsJob *job) {
    GHashTable *index = g_hash_table_new_full(fr_key_hash, g_int64_equal, g_free, NULL);
    for (uint32_t i = 0; i < job->organ_count; i++) {
        job->organs[i].model = FR_NONE;
        if (!may_be_copy(job, i) || !is_drawn(job, i)) {
            continue;
        }
        float scale = (float)size_of(job, i);
        uint32_t shape = job->plan.plant->organs.shape[i], bits;
        memcpy(&bits, &scale, sizeof bits);
        uint64_t key = (uint64_t)shape << 32 | bits;
        gpointer found = g_hash_table_lookup(index, &key);
        if (found == NULL) {
            FrNurbsModel model = {.shape = shape, .scale = (double)scale};
            g_array_append_val(job->models, model);
            found = GUINT_TO_POINTER(job->models->len);
            g_hash_table_insert(index, g_memdup2(&key, sizeof key), found);
        }
        job->organs[i].model = GPOINTER_TO_UINT(found) - 1;
        g_array_index(job->models, FrNurbsModel, job->organs[i].model).uses++;
    }
    g_hash_table_unref(index);
}

static bool is_copy(const FrNurbsJob *job, uint32_t organ) {
    uint32_t model = job->organs[organ].model;
    return model != FR_NONE && g_array_index(job->models, FrNurbsModel, model).uses > 1;
}

static void place_shapes(FrNurbsJob *job) {
    for (uint32_t s = 0; s < job->plan.plant->shapes->len; s++) {
        FrNurbsShapeForms *shape = &job->shapes[s];
        shape->knot = job->knots;
        shape->texture = job->textures;
        job->textures += shape->textures;
        for (uint32_t f = 0; shape->forms != NULL && f < shape->forms->len; f++) {
            const FrNurbsForm *form = &g_array_index(shape->forms, FrNurbsForm, f);
            job->knots += form->count_u + form->degree_u + form->count_v + form->degree_v + 2;
        }
    }
}

// Models of copies come last, with surfaces of their own.
static void place_models(FrNurbsJob *job) {
    job->own_pieces = job->pieces;
    for (uint32_t m = 0; m < job->models->len; m++) {
        FrNurbsModel *model = &g_array_index(job->models, FrNurbsModel, m);
        if (model->uses > 1) {
            model->piece = job->pieces;
            model->point = job->points;
            job->pieces += job->shapes[model->shape].forms->len;
            job->points += job->shapes[model->shape].points;
        }
    }
}

void fr_nurbs_place_organs(FrNurbsJob *job) {
    const FrPlant *plant = job->plan.plant;
    place_shapes(job);
    find_models(job);
    for (uint32_t i = 0; i < job->organ_count; i++) {
        if (!is_drawn(job, i)) {
            continue;
        }
        FrNurbsPlace *place = &job->organs[i];
        const FrNurbsShapeForms *shape = &job->shapes[plant->organs.shape[i]];
        place->rows = shape->forms->len;
        if (is_copy(job, i)) {
            place->piece = job->copies++;
        } else {
            place->piece = job->pieces;
            place->point = job->points;
            job->pieces += place->rows;
            job->points += shape->points;
        }
    }
    place_models(job);
}

static void write_shared(const FrNurbsJob *job, const FrNurbsShapeForms *shape) {
    double *to = job->skin->knots + shape->knot;
    double(*texture)[2] = job->skin->textures + shape->texture;
    for (uint32_t f = 0; f < shape->forms->len; f++) {
        const FrNurbsForm *form = &g_array_index(shape->forms, FrNurbsForm, f);
        memcpy(to, form->knots_u, sizeof(double) * (form->count_u + form->degree_u + 1));
        to += form->count_u + form->degree_u + 1;
        memcpy(to, form->knots_v, sizeof(double) * (form->count_v + form->degree_v + 1));
        to += form->count_v + form->degree_v + 1;
        if (form->texture != NULL) {
            size_t points = (size_t)form->count_u * form->count_v;
            memcpy(texture, form->texture, points * sizeof *texture);
            texture += points;
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

/// Writes the surfaces of a shape, placed, and what they belong to.
static void write_forms(const FrNurbsJob *job, const FrNurbsShapeForms *shape,
                        const double axes[3][3], const double at[3], double (*points)[4],
                        FrNurbsPiece *pieces, FrNurbsPiece like) {
    const double *knots = job->skin->knots + shape->knot;
    const double(*texture)[2] = (const double(*)[2])(job->skin->textures + shape->texture);
    for (uint32_t f = 0; f < shape->forms->len; f++) {
        const FrNurbsForm *form = &g_array_index(shape->forms, FrNurbsForm, f);
        write_form(form, axes, at, points);
        uint32_t knots_u = form->count_u + form->degree_u + 1;
        pieces[f] = like;
        pieces[f].surface = (FrNurbsSurface){form->degree_u,
                                             form->degree_v,
                                             form->count_u,
                                             form->count_v,
                                             knots,
                                             knots + knots_u,
                                             (const double(*)[4])points};
        pieces[f].kind = form->kind;
        pieces[f].texture = form->texture != NULL ? texture : NULL;
        knots += knots_u + form->count_v + form->degree_v + 1;
        points += (size_t)form->count_u * form->count_v;
        texture += form->texture != NULL ? (size_t)form->count_u * form->count_v : 0;
    }
}

static void pose_of(const FrPlant *plant, uint32_t organ, double scale, double axes[3][3],
                    double at[3]) {
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(plant, organ, &position, &rotation);
    const vec3s turned[3] = {fr_frame_left(rotation), fr_frame_up(rotation),
                             fr_frame_heading(rotation)};
    for (int k = 0; k < 3; k++) {
        at[k] = (double)position.raw[k];
        for (int a = 0; a < 3; a++) {
            axes[a][k] = scale * (double)turned[a].raw[k];
        }
    }
}

static void write_organ(const FrNurbsJob *job, uint32_t organ, int worker) {
    const FrPlant *plant = job->plan.plant;
    const FrNurbsPlace *place = &job->organs[organ];
    const FrNurbsShapeForms *shape = &job->shapes[plant->organs.shape[organ]];
    double axes[3][3], at[3];
    double scale = is_copy(job, organ) ? 1.0 : (double)plant->organs.scale[organ];
    pose_of(plant, organ, scale, axes, at);
    if (is_copy(job, organ)) {
        FrNurbsCopy *copy = &job->skin->copies[place->piece];
        const FrNurbsModel *model = &g_array_index(job->models, FrNurbsModel, place->model);
        *copy =
            (FrNurbsCopy){.organ = organ, .piece_count = place->rows, .first_piece = model->piece};
        memcpy(copy->axes, axes, sizeof axes);
        memcpy(copy->at, at, sizeof at);
        return;
    }
    double(*points)[4] = job->skin->points + place->point;
    FrNurbsPiece *pieces = &job->skin->pieces[place->piece];
    FrNurbsPiece like = {
        .material = plant->organs.material[organ], .axis = FR_NONE, .organ = organ};
    write_forms(job, shape, (const double(*)[3])axes, at, points, pieces, like);
    if (fr_nurbs_is_blown(job->params)) {
        fr_nurbs_blow_organ(job->params, plant, organ, pieces, place->rows, points);
    }
    fr_nurbs_deform(job, fr_plan_scope(&job->plan, plant->organs.deformer[organ]), points,
                    shape->points, worker);
}

static void write_organs(void *data, size_t begin, size_t end, int worker) {
    const FrNurbsJob *job = data;
    for (size_t i = begin; i < end; i++) {
        if (job->organs[i].rows > 0) {
            write_organ(job, (uint32_t)i, worker);
        }
    }
}

void fr_nurbs_write_organs(FrNurbsJob *job) {
    static const double origin[3] = {0};
    for (uint32_t s = 0; s < job->plan.plant->shapes->len; s++) {
        if (job->shapes[s].forms != NULL) {
            write_shared(job, &job->shapes[s]);
        }
    }
    for (uint32_t m = 0; m < job->models->len; m++) {
        const FrNurbsModel *model = &g_array_index(job->models, FrNurbsModel, m);
        const double axes[3][3] = {
            {model->scale, 0, 0}, {0, model->scale, 0}, {0, 0, model->scale}};
        if (model->uses > 1) {
            FrNurbsPiece like = {.material = FR_NONE, .axis = FR_NONE, .organ = FR_NONE};
            write_forms(job, &job->shapes[model->shape], axes, origin,
                        job->skin->points + model->point, &job->skin->pieces[model->piece], like);
        }
    }
    fr_parallel_for(job->context->pool, job->organ_count, ORGAN_GRAIN, write_organs, job,
                    job->context->progress);
}
