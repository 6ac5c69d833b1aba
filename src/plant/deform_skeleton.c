// The skeleton taken through its scopes. Nodes go where the deformation takes their tips; what
// nodes bear keeps its place on them: along an internode in proportion, across it rigidly. So
// nothing comes off its bearer, however coarse the internodes are.
#include "plant/deform.h"

#include "plant/frames.h"

#include <cglm/struct.h>
#include <math.h>

typedef struct Mover {
    FrScopes *scopes;
    const FrPlant *plant; ///< as it was made
    FrPlant *copy;
    bool *is_touched; ///< by scope: the skeleton's level acts on what is in it
    vec3s *shift;     ///< by axis: from where its origin would go to where its bearer has it
    FrDeformNote *notes;
} Mover;

static void doubles(vec3s v, double out[3]) {
    for (int k = 0; k < 3; k++) {
        out[k] = (double)v.raw[k];
    }
}

static uint32_t scope_of_node(const FrPlant *plant, uint32_t node) {
    return node == FR_NONE ? FR_NONE : plant->axes.deformer[plant->nodes.axis[node]];
}

static bool is_touched(const Mover *mover, uint32_t scope) {
    return scope != FR_NONE && mover->is_touched[scope];
}

// The rotation of a flow; where it has none, the deformation is noted.
static void flow_rotation(const Mover *mover, uint32_t scope, const FrFlow *flow,
                          double rotation[3][3]) {
    bool is_sound = fr_deform_rotation((const double(*)[3])flow->turn, rotation);
    if (!is_sound && scope != FR_NONE && mover->notes != NULL) {
        uint32_t deformation =
            g_array_index(mover->plant->deformers, FrDeformer, scope).deformation;
        mover->notes[deformation].is_singular = true;
    }
}

static versors conjugate(versors q) {
    return (versors){{-q.x, -q.y, -q.z, q.w}};
}

// Where something goes that stands on `node` and is in `scope`.
static FrFooting attach(const Mover *mover, uint32_t node, uint32_t scope, const FrFooting *made) {
    const FrNodes *from = &mover->plant->nodes, *to = &mover->copy->nodes;
    FrFlow flow = fr_flow_at(made->at);
    bool follows = fr_scopes_pass(mover->scopes, scope, scope_of_node(mover->plant, node),
                                  FR_LEVEL_SKELETON, &flow, mover->notes);
    FrFooting stand;
    double rotation[3][3];
    flow_rotation(mover, scope, &flow, rotation);
    fr_deform_product((const double(*)[3])rotation, made->axes, stand.axes);
    for (int k = 0; k < 3; k++) {
        stand.at[k] = flow.at[k];
    }
    if (!follows || node == FR_NONE) {
        return stand;
    }
    vec3s way = {{(float)(stand.at[0] - (double)from->position[node].x),
                  (float)(stand.at[1] - (double)from->position[node].y),
                  (float)(stand.at[2] - (double)from->position[node].z)}};
    way = fr_turned(conjugate(from->frame[node]), way);
    way.z *= from->length[node] > 0 ? to->length[node] / from->length[node] : 1;
    way = glms_vec3_add(to->position[node], fr_turned(to->frame[node], way));
    doubles(way, stand.at);
    double turn[3][3];
    fr_deform_matrix(fr_frame_step(to->frame[node], conjugate(from->frame[node])), turn);
    fr_deform_product((const double(*)[3])turn, (const double(*)[3])stand.axes, stand.axes);
    return stand;
}

// Finds where a scope has moved to; what it stands on has been moved.
static void resolve(const Mover *mover, uint32_t scope) {
    FrScopes *scopes = mover->scopes;
    while (scope != FR_NONE && !scopes->stands[scope].is_known) {
        // The outermost one that is not known yet.
        uint32_t next = scope, outer;
        while ((outer = g_array_index(mover->plant->deformers, FrDeformer, next).outer) !=
                   FR_NONE &&
               !scopes->stands[outer].is_known) {
            next = outer;
        }
        const FrDeformer *deformer = &g_array_index(mover->plant->deformers, FrDeformer, next);
        scopes->stands[next].moved =
            attach(mover, deformer->node, deformer->outer, &scopes->stands[next].made);
        fr_scopes_carry(scopes, next);
    }
}

static vec3s point_of(const FrFooting *stand) {
    return (vec3s){{(float)stand->at[0], (float)stand->at[1], (float)stand->at[2]}};
}

static void move_axis(const Mover *mover, uint32_t axis) {
    const FrPlant *plant = mover->plant;
    FrPlant *copy = mover->copy;
    uint32_t bearer = plant->axes.bearer[axis], scope = plant->axes.deformer[axis];
    mover->shift[axis] = (vec3s){{0, 0, 0}};
    resolve(mover, scope);
    if (!is_touched(mover, scope) && !is_touched(mover, scope_of_node(plant, bearer))) {
        return;
    }
    FrFooting made;
    doubles(fr_plant_axis_origin(plant, axis), made.at);
    fr_deform_matrix(GLMS_QUAT_IDENTITY, made.axes);
    FrFooting stand = attach(mover, bearer, scope, &made);
    FrFlow exact = fr_flow_at(made.at);
    fr_scopes_pass(mover->scopes, scope, FR_NONE, FR_LEVEL_SKELETON, &exact, NULL);
    for (int k = 0; k < 3; k++) {
        mover->shift[axis].raw[k] = (float)(stand.at[k] - exact.at[k]);
    }
    vec3s origin = point_of(&stand);
    if (bearer != FR_NONE) {
        origin = glms_vec3_sub(origin, copy->nodes.position[bearer]);
        origin = fr_turned(conjugate(copy->nodes.frame[bearer]), origin);
    }
    copy->axes.offset[axis] = origin;
}

static void move_node(const Mover *mover, uint32_t node) {
    FrNodes *to = &mover->copy->nodes;
    const FrNodes *from = &mover->plant->nodes;
    uint32_t axis = from->axis[node], scope = mover->plant->axes.deformer[axis];
    if (is_touched(mover, scope)) {
        uint32_t parent = to->parent[node];
        vec3s start = mover->copy->axes.offset[axis];
        if (parent != FR_NONE) {
            vec3s offset = {{0, 0, 0}};
            if (to->axis[parent] != axis) {
                offset = fr_turned(to->frame[parent], start);
            }
            start = glms_vec3_add(to->position[parent], offset);
        }
        double tip[3], rotation[3][3], frame[3][3];
        doubles(from->position[node], tip);
        FrFlow flow = fr_flow_at(tip);
        fr_scopes_pass(mover->scopes, scope, FR_NONE, FR_LEVEL_SKELETON, &flow, mover->notes);
        flow_rotation(mover, scope, &flow, rotation);
        fr_deform_matrix(from->frame[node], frame);
        fr_deform_product((const double(*)[3])rotation, (const double(*)[3])frame, frame);
        versors turned = fr_deform_quaternion((const double(*)[3])frame);
        vec3s target = {{(float)flow.at[0], (float)flow.at[1], (float)flow.at[2]}};
        vec3s chord = glms_vec3_sub(glms_vec3_add(target, mover->shift[axis]), start);
        float length = glms_vec3_norm(chord);
        if (length > 0) {
            vec3s heading = glms_vec3_normalize(fr_frame_heading(turned));
            turned =
                fr_frame_step(fr_rotation_between(heading, glms_vec3_divs(chord, length)), turned);
        }
        to->length[node] = length;
        to->rotation[node] =
            parent != FR_NONE ? fr_frame_step(conjugate(to->frame[parent]), turned) : turned;
    }
    fr_update_frame(to, &mover->copy->axes, node);
}

static void move_organ(const Mover *mover, uint32_t organ) {
    const FrPlant *plant = mover->plant;
    FrPlant *copy = mover->copy;
    uint32_t node = plant->organs.node[organ], scope = plant->organs.deformer[organ];
    resolve(mover, scope);
    if (!is_touched(mover, scope) && !is_touched(mover, scope_of_node(plant, node))) {
        return;
    }
    vec3s at;
    versors rotation;
    FrFooting made;
    fr_plant_organ_pose(plant, organ, &at, &rotation);
    doubles(at, made.at);
    fr_deform_matrix(rotation, made.axes);
    FrFooting stand = attach(mover, node, scope, &made);
    at = point_of(&stand);
    rotation = fr_deform_quaternion((const double(*)[3])stand.axes);
    if (node != FR_NONE) {
        versors back = conjugate(copy->nodes.frame[node]);
        at = fr_turned(back, glms_vec3_sub(at, copy->nodes.position[node]));
        rotation = fr_frame_step(back, rotation);
    }
    copy->organs.offset[organ] = at;
    copy->organs.rotation[organ] = rotation;
}

// The copy's scopes stand where they have moved to; those of the skeleton have done their work.
static void settle_copy(const Mover *mover) {
    FrPlant *copy = mover->copy;
    for (uint32_t s = 0; s < copy->deformers->len; s++) {
        resolve(mover, s);
        FrDeformer *deformer = &g_array_index(copy->deformers, FrDeformer, s);
        const FrFooting *moved = &mover->scopes->stands[s].moved;
        deformer->offset = point_of(moved);
        deformer->rotation = fr_deform_quaternion(moved->axes);
        if (deformer->node != FR_NONE) {
            versors back = conjugate(copy->nodes.frame[deformer->node]);
            vec3s way = glms_vec3_sub(deformer->offset, copy->nodes.position[deformer->node]);
            deformer->offset = fr_turned(back, way);
            deformer->rotation = fr_frame_step(back, deformer->rotation);
        }
    }
    for (uint32_t d = 0; d < copy->deformations->len; d++) {
        FrDeformation *deformation = &g_array_index(copy->deformations, FrDeformation, d);
        if (deformation->is_skeleton) {
            deformation->kind = FR_DEFORM_NOTHING;
        }
    }
}

FrPlant *fr_scopes_move_skeleton(FrScopes *scopes, FrDeformNote *notes) {
    const FrPlant *plant = scopes->plant;
    Mover mover = {
        .scopes = scopes,
        .plant = plant,
        .copy = fr_plant_copy(plant),
        .is_touched = g_new0(bool, plant->deformers->len),
        .shift = g_new(vec3s, plant->axes.count),
        .notes = notes,
    };
    for (uint32_t s = 0; s < plant->deformers->len; s++) {
        const FrDeformer *deformer = &g_array_index(plant->deformers, FrDeformer, s);
        const FrDeformation *deformation =
            &g_array_index(plant->deformations, FrDeformation, deformer->deformation);
        mover.is_touched[s] =
            (deformation->is_skeleton && deformation->kind != FR_DEFORM_NOTHING) ||
            is_touched(&mover, deformer->outer);
    }
    for (uint32_t node = 0; node < plant->nodes.count; node++) {
        uint32_t axis = plant->nodes.axis[node];
        if (plant->axes.first[axis] == node) {
            move_axis(&mover, axis);
        }
        move_node(&mover, node);
    }
    for (uint32_t axis = 0; axis < plant->axes.count; axis++) {
        if (plant->axes.first[axis] == FR_NONE) {
            move_axis(&mover, axis);
        }
    }
    for (uint32_t organ = 0; organ < plant->organs.count; organ++) {
        move_organ(&mover, organ);
    }
    settle_copy(&mover);
    g_free(mover.is_touched);
    g_free(mover.shift);
    return mover.copy;
}

FrPlant *fr_plant_deformed(const FrPlant *plant) {
    FrScopes *scopes = fr_scopes_new(plant);
    FrPlant *moved = scopes != NULL && scopes->has_skeleton ? fr_scopes_move_skeleton(scopes, NULL)
                                                            : fr_plant_copy(plant);
    fr_scopes_free(scopes);
    return moved;
}
