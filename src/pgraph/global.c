// Global components: FFD and Hyperpatch open a scope of deformation, World and Force a field, for
// all that follows on them.
#include "pgraph/global.h"

#include "frond/lattice.h"
#include "pgraph/preset.h"
#include "plant/frames.h"

#include <math.h>
#include <string.h>

// ---- control points ---------------------------------------------------------------------------

static bool read_whole(const char **text, int64_t most, uint32_t *value) {
    char *end;
    gint64 read = g_ascii_strtoll(*text, &end, 10);
    if (end == *text || read < 0 || read > most) {
        return false;
    }
    *value = (uint32_t)read;
    *text = end;
    return true;
}

static bool read_real(const char **text, double *value) {
    char *end;
    *value = g_ascii_strtod(*text, &end);
    if (end == *text || !(fabs(*value) <= 1e6)) {
        return false;
    }
    *text = end;
    return true;
}

static bool accept(const char **text, char wanted) {
    if (**text != wanted) {
        return false;
    }
    (*text)++;
    return true;
}

// One "i,j,k:x,y,z".
static bool move_point(FrLattice *lattice, const char *word) {
    uint32_t index[3];
    double by[3];
    for (int k = 0; k < 3; k++) {
        if (!read_whole(&word, lattice->degree[k], &index[k]) ||
            !accept(&word, k < 2 ? ',' : ':')) {
            return false;
        }
    }
    for (int k = 0; k < 3; k++) {
        if (!read_real(&word, &by[k]) || (k < 2 && !accept(&word, ','))) {
            return false;
        }
    }
    double *point = lattice->points[fr_lattice_index(lattice, index[0], index[1], index[2])];
    for (int k = 0; k < 3; k++) {
        point[k] += by[k];
    }
    return *word == '\0';
}

static FrStatus move_points(FrLattice *lattice, const char *text, const FrPrototype *prototype,
                            FrDiags *diags) {
    char **words = g_strsplit_set(text != NULL ? text : "", " \t\r\n", -1);
    FrStatus status = FR_OK;
    for (char **word = words; *word != NULL && status == FR_OK; word++) {
        if (**word != '\0' && !move_point(lattice, *word)) {
            fr_diags_add(diags, FR_ERROR, "wrong-points", prototype->span,
                         "'%.40s' in the points of '%s' is no control point and way like "
                         "0,1,2:0.1,0,0; its indices go up to %u,%u,%u",
                         *word, prototype->id, lattice->degree[0], lattice->degree[1],
                         lattice->degree[2]);
            status = FR_ERR_DOCUMENT;
        }
    }
    g_strfreev(words);
    return status;
}

// The regular lattice of a component; false if its box is flat.
static bool make_lattice(FrLattice *lattice, const FrScopeParams *scope) {
    *lattice = (FrLattice){
        .degree = {(uint32_t)scope->degree_x, (uint32_t)scope->degree_y, (uint32_t)scope->degree_z},
    };
    for (int k = 0; k < 3; k++) {
        double from = (double)scope->box_from.raw[k], to = (double)scope->box_to.raw[k];
        lattice->min[k] = fmin(from, to);
        lattice->max[k] = fmax(from, to);
        if (lattice->max[k] - lattice->min[k] < 1e-6) {
            return false;
        }
    }
    fr_lattice_reset(lattice);
    return true;
}

static FrStatus check_path(const char *path, const FrPrototype *prototype, FrDiags *diags) {
    GArray *points = fr_path_points(path, prototype, diags);
    FrStatus status = points != NULL ? FR_OK : FR_ERR_DOCUMENT;
    g_clear_pointer(&points, g_array_unref);
    return status;
}

FrStatus fr_check_global(const FrPrototype *prototype, FrDiags *diags) {
    if (prototype->kind == FR_COMPONENT_FORCE) {
        const FrForceParams *force = prototype->params;
        return force->kind == FR_FORCE_TO_CURVE ? check_path(force->path, prototype, diags) : FR_OK;
    }
    if (!fr_is_scope(prototype->kind)) {
        return FR_OK;
    }
    FrLattice lattice;
    if (!make_lattice(&lattice, prototype->params)) {
        fr_diags_add(diags, FR_ERROR, "flat-box", prototype->span,
                     "the box of '%s' is flat: box-from and box-to must differ in x, y and z",
                     prototype->id);
        return FR_ERR_DOCUMENT;
    }
    const FrFfdParams *ffd = prototype->params;
    if (prototype->kind == FR_COMPONENT_FFD && ffd->preset == FR_PRESET_CURVE) {
        return check_path(ffd->path, prototype, diags);
    }
    const FrHyperpatchParams *patch = prototype->params;
    return prototype->kind == FR_COMPONENT_HYPERPATCH
               ? move_points(&lattice, patch->points, prototype, diags)
               : FR_OK;
}

// ---- preparing --------------------------------------------------------------------------------

// Control points go where the functions take them.
static void map_points(FrLattice *lattice, FrExpr *const map[3], uint32_t component,
                       FrEvaluator *evaluator) {
    static const FrVars nothing = {0};
    for (uint32_t p = 0; p < fr_lattice_count(lattice); p++) {
        double *point = lattice->points[p];
        const double values[4] = {point[0], point[1], point[2], 1};
        for (int k = 0; k < 3; k++) {
            FrExprFault fault = {0};
            if (map[k] != NULL) {
                double to = fr_expr_eval_with(map[k], &nothing, values, &fault);
                point[k] = fmax(-1e6, fmin(to, 1e6));
            }
            fr_value_note(evaluator, component, FR_FFD_to_x + (uint32_t)k, &fault);
        }
    }
}

// The functions that an FFD moves points by, as its own references.
static void own_map(const FrPrototype *prototype, FrExpr *map[3]) {
    const FrFfdParams *ffd = prototype->params;
    GArray *path =
        ffd->preset == FR_PRESET_CURVE ? fr_path_points(ffd->path, prototype, NULL) : NULL;
    bool has_preset = fr_preset_map(ffd, path, map);
    g_clear_pointer(&path, g_array_unref);
    if (has_preset) {
        return;
    }
    FrExpr *const own[3] = {ffd->to_x, ffd->to_y, ffd->to_z};
    for (int k = 0; k < 3; k++) {
        map[k] = own[k] != NULL ? fr_expr_ref(own[k]) : NULL;
    }
}

static void prepare_scope(FrPrepared *made, const FrPrototype *prototype, uint32_t component,
                          FrPlant *plant, FrEvaluator *evaluator) {
    const FrScopeParams *scope = prototype->params;
    FrDeformation deformation = {
        .kind = FR_DEFORM_LATTICE,
        .is_skeleton = scope->moves == FR_MOVES_SKELETON,
        .is_cut = !scope->preceding,
        .component = component,
    };
    bool is_whole = make_lattice(&deformation.lattice, scope);
    FR_ASSERT(is_whole);
    FrExpr *map[3] = {NULL};
    if (prototype->kind == FR_COMPONENT_HYPERPATCH) {
        const FrHyperpatchParams *patch = prototype->params;
        FrStatus status = move_points(&deformation.lattice, patch->points, prototype, NULL);
        FR_ASSERT(status == FR_OK);
    } else {
        const FrFfdParams *ffd = prototype->params;
        own_map(prototype, map);
        if (ffd->form == FR_FFD_BY_LATTICE) {
            map_points(&deformation.lattice, map, component, evaluator);
        } else {
            deformation.kind = FR_DEFORM_FUNCTIONS;
            memcpy(deformation.map, map, sizeof map);
        }
    }
    made->deformation = fr_plant_add_deformation(plant, &deformation);
    for (int k = 0; k < 3; k++) {
        fr_expr_unref(map[k]);
    }
    made->step = scope->step;
}

void fr_prepare_global(FrPrepared *made, const FrPrototype *prototype, uint32_t component,
                       FrPlant *plant, GHashTable *faults) {
    FrEvaluator evaluator = {.faults = faults, .component = component};
    if (fr_is_scope(prototype->kind)) {
        prepare_scope(made, prototype, component, plant, &evaluator);
    } else if (prototype->kind == FR_COMPONENT_WORLD) {
        const FrWorldParams *world = prototype->params;
        made->step = world->step;
    } else if (prototype->kind == FR_COMPONENT_FORCE) {
        const FrForceParams *force = prototype->params;
        made->step = force->step;
        if (force->kind == FR_FORCE_TO_CURVE) {
            made->path = fr_path_points(force->path, prototype, NULL);
            FR_ASSERT(made->path != NULL);
        }
    }
}

// ---- making -----------------------------------------------------------------------------------

static void make_scope(const FrExpansion *expansion, uint32_t row, FrPose pose,
                       FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = fr_stage_prepared(expansion, level->stage[row]);
    const FrScopeParams *params = prepared->params;
    uint32_t scope = level->global_count[row];
    FrDeformer *deformer = &g_array_index(expansion->plant->deformers, FrDeformer, scope);
    deformer->outer = level->deformer[row];
    deformer->deformation = prepared->deformation;
    deformer->node = pose.bearer;
    deformer->offset = pose.offset;
    deformer->rotation = pose.rotation;
    deformer->scale = (float)pose.scale;
    deformer->strength = (float)fr_value(evaluator, &params->strength, FR_SCOPE_strength);
    if (prepared->kind == FR_COMPONENT_FFD) {
        const FrFfdParams *ffd = prepared->params;
        deformer->amount = (float)fr_value(evaluator, &ffd->amount, FR_FFD_amount);
    }
    level->deformer[row] = scope;
}

static void make_field(const FrExpansion *expansion, uint32_t row, FrPose pose,
                       FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrNodes *nodes = &expansion->plant->nodes;
    const FrPrepared *prepared = fr_stage_prepared(expansion, level->stage[row]);
    vec3s at = pose.offset;
    versors rotation = pose.rotation;
    if (pose.bearer != FR_NONE) {
        vec3s tip = nodes->position[pose.bearer];
        at = fr_turned(nodes->frame[pose.bearer], at);
        at = (vec3s){{tip.x + at.x, tip.y + at.y, tip.z + at.z}};
        rotation = fr_frame_step(nodes->frame[pose.bearer], rotation);
    }
    FrField field = {
        .outer = level->field[row],
        .component = fr_instance_stage(expansion, row)->component,
        .at = {(double)at.x, (double)at.y, (double)at.z},
        .scale = pose.scale,
        .order = level->order[row],
    };
    const vec3s axes[3] = {fr_frame_left(rotation), fr_frame_up(rotation),
                           fr_frame_heading(rotation)};
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            field.axes[r][c] = (double)axes[c].raw[r];
        }
    }
    if (prepared->kind == FR_COMPONENT_WORLD) {
        const FrWorldParams *world = prepared->params;
        double azimuth = fr_value(evaluator, &world->sun_azimuth, FR_WORLD_sun_azimuth);
        double elevation = fr_value(evaluator, &world->sun_elevation, FR_WORLD_sun_elevation);
        field.sun[0] = cos(elevation) * sin(azimuth);
        field.sun[1] = cos(elevation) * cos(azimuth);
        field.sun[2] = sin(elevation);
    } else if (prepared->kind == FR_COMPONENT_FORCE) {
        const FrForceParams *force = prepared->params;
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++) {
                field.at[r] += field.axes[r][c] * (double)force->place.raw[c] * pose.scale;
            }
        }
        field.strength = fr_value(evaluator, &force->strength, FR_FORCE_strength);
        field.radius = fr_value(evaluator, &force->radius, FR_FORCE_radius);
        field.pitch = fr_value(evaluator, &force->pitch, FR_FORCE_pitch);
    }
    g_array_index(expansion->fields, FrField, level->global_count[row]) = field;
    level->field[row] = level->global_count[row];
}

void fr_make_global(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = fr_stage_prepared(expansion, level->stage[row]);
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    if (fr_is_scope(prepared->kind)) {
        const FrScopeParams *params = prepared->params;
        make_scope(expansion, row, pose, evaluator);
        level->scopes[row] =
            (uint16_t)(params->preceding ? MIN(level->scopes[row] + 1, UINT16_MAX) : 1);
    } else {
        make_field(expansion, row, pose, evaluator);
        level->scopes[row] = (uint16_t)MIN(level->scopes[row] + 1, UINT16_MAX);
    }
    float step = (float)(prepared->step * pose.scale);
    level->step[row] = level->step[row] > 0 ? fminf(level->step[row], step) : step;
    FrChild child = fr_single_child(expansion, row, pose);
    child.joint = level->joint[row] == FR_JOINT_TIP && !pose.is_turned_or_moved ? FR_JOINT_TIP
                                                                                : FR_JOINT_NONE;
    fr_make_single_children(expansion, row, child, level->child_count[row]);
}
