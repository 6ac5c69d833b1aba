// Scopes within scopes: places taken through a chain of deformations, innermost first.
#include "plant/deform.h"

#include "plant/frames.h"

#include <math.h>

static const FrDeformer *scope_at(const FrScopes *scopes, uint32_t scope) {
    return &g_array_index(scopes->plant->deformers, FrDeformer, scope);
}

static const FrDeformation *deformation_of(const FrScopes *scopes, const FrDeformer *scope) {
    return &g_array_index(scopes->plant->deformations, FrDeformation, scope->deformation);
}

static FrFooting made_stand(const FrPlant *plant, const FrDeformer *scope) {
    vec3s at = scope->offset;
    versors rotation = scope->rotation;
    if (scope->node != FR_NONE) {
        versors frame = plant->nodes.frame[scope->node];
        vec3s tip = plant->nodes.position[scope->node];
        at = fr_turned(frame, at);
        at = (vec3s){{tip.x + at.x, tip.y + at.y, tip.z + at.z}};
        rotation = fr_frame_step(frame, rotation);
    }
    FrFooting stand = {.at = {(double)at.x, (double)at.y, (double)at.z}};
    fr_deform_matrix(rotation, stand.axes);
    return stand;
}

FrScopes *fr_scopes_new(const FrPlant *plant) {
    if (plant->deformers->len == 0) {
        return NULL;
    }
    FrScopes *scopes = g_new(FrScopes, 1);
    *scopes = (FrScopes){.plant = plant,
                         .stands = g_new0(FrScopeFooting, plant->deformers->len),
                         .has_triangles = g_new(bool, plant->deformers->len)};
    for (uint32_t s = 0; s < plant->deformers->len; s++) {
        const FrDeformer *scope = scope_at(scopes, s);
        const FrDeformation *deformation = deformation_of(scopes, scope);
        scopes->stands[s].made = scopes->stands[s].moved = made_stand(plant, scope);
        bool acts = deformation->kind != FR_DEFORM_NOTHING && scope->strength != 0;
        scopes->has_skeleton |= acts && deformation->is_skeleton;
        scopes->has_triangles[s] = (acts && !deformation->is_skeleton) ||
                                   (scope->outer != FR_NONE && scopes->has_triangles[scope->outer]);
    }
    return scopes;
}

void fr_scopes_free(FrScopes *scopes) {
    if (scopes != NULL) {
        g_free(scopes->stands);
        g_free(scopes->has_triangles);
        g_free(scopes);
    }
}

FrFlow fr_flow_at(const double at[3]) {
    return (FrFlow){
        .at = {at[0], at[1], at[2]},
        .turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    };
}

// Moves the flow as a rigid body from one stand to another.
static void carry_flow(FrFlow *flow, const FrFooting *from, const FrFooting *to) {
    double back[3][3], turn[3][3], way[3];
    for (int r = 0; r < 3; r++) {
        way[r] = flow->at[r] - from->at[r];
        for (int c = 0; c < 3; c++) {
            back[r][c] = from->axes[c][r];
        }
    }
    fr_deform_product(to->axes, (const double(*)[3])back, turn);
    for (int r = 0; r < 3; r++) {
        flow->at[r] = to->at[r] + turn[r][0] * way[0] + turn[r][1] * way[1] + turn[r][2] * way[2];
    }
    fr_deform_product((const double(*)[3])turn, (const double(*)[3])flow->turn, flow->turn);
}

bool fr_scopes_pass(const FrScopes *scopes, uint32_t scope, uint32_t end, FrDeformLevel level,
                    FrFlow *flow, FrDeformNote *notes) {
    bool is_skeleton = level == FR_LEVEL_SKELETON;
    for (uint32_t s = scope; s != FR_NONE && s != end;) {
        const FrDeformer *deformer = scope_at(scopes, s);
        const FrDeformation *deformation = deformation_of(scopes, deformer);
        const FrScopeFooting *stand = &scopes->stands[s];
        if (deformation->is_skeleton == is_skeleton) {
            FrDeformNote *note = notes != NULL ? &notes[deformer->deformation] : NULL;
            fr_deform_map(scopes->plant, deformer, is_skeleton ? &stand->made : &stand->moved, flow,
                          note);
        }
        if (deformation->is_cut) {
            FR_ASSERT(stand->is_known);
            carry_flow(flow, is_skeleton ? &stand->made : &stand->moved,
                       is_skeleton ? &stand->moved : &stand->carried);
            return false;
        }
        s = deformer->outer;
    }
    return true;
}

void fr_scopes_carry(FrScopes *scopes, uint32_t scope) {
    FrScopeFooting *stand = &scopes->stands[scope];
    FrFlow flow = fr_flow_at(stand->moved.at);
    uint32_t outer = scope_at(scopes, scope)->outer;
    fr_scopes_pass(scopes, outer, FR_NONE, FR_LEVEL_TRIANGLES, &flow, NULL);
    double rotation[3][3];
    fr_deform_rotation((const double(*)[3])flow.turn, rotation);
    for (int k = 0; k < 3; k++) {
        stand->carried.at[k] = flow.at[k];
    }
    fr_deform_product((const double(*)[3])rotation, (const double(*)[3])stand->moved.axes,
                      stand->carried.axes);
    stand->is_known = true;
}

void fr_scopes_settle(FrScopes *scopes) {
    for (uint32_t s = 0; s < scopes->plant->deformers->len; s++) {
        if (!scopes->stands[s].is_known) {
            fr_scopes_carry(scopes, s);
        }
    }
}

// The side of a surface whose normal was `normal`, after space was deformed: the inverse
// transpose of the Jacobian. False if it is turned inside out; *is_flat if there is no side.
static bool turn_normal(const double jacobian[3][3], vec3s *normal, bool *is_flat) {
    double cofactors[3][3], lengths = 0, turned[3], length = 0;
    fr_deform_cofactors(jacobian, cofactors);
    double determinant = fr_deform_determinant(jacobian);
    double sign = determinant < 0 ? -1 : 1;
    for (int r = 0; r < 3; r++) {
        turned[r] = 0;
        for (int c = 0; c < 3; c++) {
            lengths += jacobian[r][c] * jacobian[r][c];
            turned[r] += sign * cofactors[r][c] * (double)normal->raw[c];
        }
        length += turned[r] * turned[r];
    }
    length = sqrt(length);
    *is_flat = !(length > 1e-9 * lengths) || determinant == 0;
    if (!*is_flat) {
        for (int r = 0; r < 3; r++) {
            normal->raw[r] = (float)(turned[r] / length);
        }
    }
    return *is_flat || determinant > 0;
}

bool fr_scopes_move_vertex(const FrScopes *scopes, uint32_t scope, vec3s *at, vec3s *normal,
                           FrDeformNote *notes) {
    double from[3] = {(double)at->x, (double)at->y, (double)at->z};
    FrFlow flow = fr_flow_at(from);
    fr_scopes_pass(scopes, scope, FR_NONE, FR_LEVEL_TRIANGLES, &flow, notes);
    for (int k = 0; k < 3; k++) {
        at->raw[k] = (float)flow.at[k];
    }
    bool is_flat;
    bool is_upright = turn_normal((const double(*)[3])flow.turn, normal, &is_flat);
    if (is_flat && notes != NULL) {
        notes[scope_at(scopes, scope)->deformation].is_singular = true;
    }
    return is_upright;
}

void fr_deform_join_notes(FrDeformNote *to, const FrDeformNote *from, uint32_t count) {
    for (uint32_t d = 0; d < count; d++) {
        to[d].is_singular |= from[d].is_singular;
        bool is_first =
            from[d].fault.code != NULL &&
            (to[d].fault.code == NULL || from[d].axis < to[d].axis ||
             (from[d].axis == to[d].axis && from[d].fault.span.begin < to[d].fault.span.begin));
        if (is_first) {
            to[d].fault = from[d].fault;
            to[d].axis = from[d].axis;
        }
    }
}

void fr_deform_report(const FrPlant *plant, const FrDeformNote *notes, FrDiags *diags) {
    for (uint32_t d = 0; d < plant->deformations->len; d++) {
        uint32_t component = g_array_index(plant->deformations, FrDeformation, d).component;
        const FrComponent *who = component < plant->components->len
                                     ? &g_array_index(plant->components, FrComponent, component)
                                     : NULL;
        const char *id = who != NULL ? who->id : plant->name;
        if (notes[d].fault.code != NULL) {
            char *what = g_strdup_printf("to-%c of '%s'", 'x' + notes[d].axis, id);
            fr_expr_report_fault(&notes[d].fault, what, diags);
            g_free(what);
        }
        if (notes[d].is_singular) {
            fr_diags_add(diags, FR_WARNING, "singular-deformation",
                         who != NULL ? who->span : (FrSpan){0},
                         "'%s' flattens what it deforms; normals there stay as they were", id);
        }
    }
}
