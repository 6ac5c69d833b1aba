// Copying a graft into the plant, and its places to the rows of children.
#include "pgraph/graft.h"

#include "plant/frames.h"

#include <cglm/struct.h>
#include <math.h>

static uint32_t moved_index(uint32_t index, uint32_t first) {
    return index == FR_NONE ? FR_NONE : first + index;
}

/// A place of the scion's own coordinates in the bearer's frame.
static vec3s place_of(const FrPose *pose, vec3s at) {
    vec3s scaled = glms_vec3_scale(at, (float)pose->scale);
    return glms_vec3_add(pose->offset, fr_turned(pose->rotation, scaled));
}

static uint32_t material_of(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                            uint32_t material) {
    return material == FR_NONE ? fr_instance_material(expansion, row) : scion->materials[material];
}

/// Whether the main axis goes on where a stem ended, in its direction.
static bool goes_on(const FrLevel *level, uint32_t row, const FrScion *scion, const FrPose *pose) {
    const FrAxes *axes = &scion->plant->axes;
    return level->joint[row] == FR_JOINT_TIP && !pose->is_turned_or_moved &&
           axes->first[0] != FR_NONE && axes->bearer[0] == FR_NONE &&
           glms_vec3_norm(axes->offset[0]) == 0 &&
           fabsf(scion->plant->nodes.rotation[axes->first[0]].w) > 0.9999F;
}

/// The scope of a part: that of the scion, or the one around all of it.
static uint32_t scope_of(const FrLevel *level, uint32_t row, const FrScion *scion,
                         uint32_t deformer) {
    return deformer == FR_NONE ? level->deformer[row] : scion->deformers + deformer;
}

static void copy_axes(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                      const FrPose *pose) {
    const FrLevel *level = &expansion->level;
    const FrAxes *from = &scion->plant->axes;
    FrAxes *to = &expansion->plant->axes;
    uint32_t first_node = level->node_count[row];
    for (uint32_t i = 0; i < from->count; i++) {
        uint32_t axis = level->axis_count[row] + i;
        bool is_root = from->bearer[i] == FR_NONE;
        to->first[axis] = moved_index(from->first[i], first_node);
        to->last[axis] = moved_index(from->last[i], first_node);
        to->bearer[axis] = is_root ? pose->bearer : first_node + from->bearer[i];
        to->offset[axis] = is_root ? place_of(pose, from->offset[i])
                                   : glms_vec3_scale(from->offset[i], (float)pose->scale);
        to->base_radius[axis] = from->base_radius[i] * (float)pose->scale;
        to->order[axis] = (uint16_t)MIN(level->order[row] + from->order[i], UINT16_MAX);
        to->flags[axis] =
            (uint16_t)(from->flags[i] |
                       (i == 0 && goes_on(level, row, scion, pose) ? FR_CONTINUES : 0u));
        to->profile[axis] =
            from->profile[i] == FR_NONE ? FR_NONE : scion->profiles[from->profile[i]];
        to->material[axis] = material_of(expansion, row, scion, from->material[i]);
        to->finish[axis] = from->finish[i] == FR_NONE ? FR_NONE : scion->finishes[from->finish[i]];
        to->deformer[axis] = scope_of(level, row, scion, from->deformer[i]);
        to->component[axis] = fr_instance_stage(expansion, row)->component;
        to->path[axis] = fr_key_child(level->key[row], from->path[i]);
    }
}

/// Parents come before their children, so frames follow at once.
static void copy_nodes(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                       const FrPose *pose) {
    const FrLevel *level = &expansion->level;
    const FrNodes *from = &scion->plant->nodes;
    FrNodes *to = &expansion->plant->nodes;
    uint32_t first = level->node_count[row];
    for (uint32_t i = 0; i < from->count; i++) {
        uint32_t node = first + i;
        bool is_root = from->parent[i] == FR_NONE;
        to->parent[node] = is_root ? pose->bearer : first + from->parent[i];
        to->next[node] = moved_index(from->next[i], first);
        to->axis[node] = level->axis_count[row] + from->axis[i];
        to->rotation[node] =
            is_root ? fr_frame_step(pose->rotation, from->rotation[i]) : from->rotation[i];
        to->length[node] = from->length[i] * (float)pose->scale;
        to->radius[node] = from->radius[i] * (float)pose->scale;
        to->flatness[node] = from->flatness[i];
        to->birth[node] = from->birth[i];
        to->flags[node] = from->flags[i];
        fr_update_frame(to, &expansion->plant->axes, node);
    }
}

/// Where an organ of the scion stands in the plant.
static FrPose organ_pose(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                         const FrPose *pose, uint32_t i) {
    const FrOrgans *from = &scion->plant->organs;
    bool is_root = from->node[i] == FR_NONE;
    return (FrPose){
        .bearer = is_root ? pose->bearer : expansion->level.node_count[row] + from->node[i],
        .offset = is_root ? place_of(pose, from->offset[i])
                          : glms_vec3_scale(from->offset[i], (float)pose->scale),
        .rotation = is_root ? fr_frame_step(pose->rotation, from->rotation[i]) : from->rotation[i],
        .scale = pose->scale * (double)from->scale[i],
    };
}

static void copy_organs(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                        const FrPose *pose) {
    const FrOrgans *from = &scion->plant->organs;
    FrOrgans *to = &expansion->plant->organs;
    uint32_t organ = expansion->level.organ_count[row];
    for (uint32_t i = 0; i < from->count; i++) {
        if (from->shape[i] == FR_NONE) {
            continue;
        }
        FrPose placed = organ_pose(expansion, row, scion, pose, i);
        fr_write_organ(expansion, row, organ, placed, scion->shapes[from->shape[i]]);
        to->material[organ] = material_of(expansion, row, scion, from->material[i]);
        to->deformer[organ] = scope_of(&expansion->level, row, scion, from->deformer[i]);
        to->birth[organ] = from->birth[i];
        to->flags[organ] = from->flags[i];
        to->path[organ] = fr_key_child(expansion->level.key[row], from->path[i]);
        organ++;
    }
}

/// Scopes of the scion stand where it stands.
static void place_scopes(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                         const FrPose *pose) {
    const FrLevel *level = &expansion->level;
    for (guint i = 0; i < scion->plant->deformers->len; i++) {
        FrDeformer *scope =
            &g_array_index(expansion->plant->deformers, FrDeformer, scion->deformers + i);
        bool is_root = scope->node == FR_NONE;
        scope->outer = scope_of(level, row, scion, scope->outer);
        scope->offset = is_root ? place_of(pose, scope->offset)
                                : glms_vec3_scale(scope->offset, (float)pose->scale);
        scope->rotation =
            is_root ? fr_frame_step(pose->rotation, scope->rotation) : scope->rotation;
        scope->node = is_root ? pose->bearer : level->node_count[row] + scope->node;
        scope->scale *= (float)pose->scale;
    }
}

// ---- children ---------------------------------------------------------------------------------

/// The child at a place: the k-th of n of its symbol.
static FrChild place_child(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                           const FrPose *pose, uint32_t organ, uint32_t k, uint32_t n) {
    const FrLevel *level = &expansion->level;
    const FrPlant *plant = scion->plant;
    uint32_t node = plant->organs.node[organ];
    uint64_t symbol = (uint64_t)*fr_scion_symbol(plant, organ);
    FrChild child = fr_single_child(expansion, row, organ_pose(expansion, row, scion, pose, organ));
    child.key = fr_key_child(fr_key_child(level->key[row], UINT32_MAX + symbol), k);
    child.i = k;
    child.n = n;
    child.is_multiplied = true;
    child.x = n > 1 ? (float)k / (float)(n - 1) : 0;
    if (node != FR_NONE) {
        uint32_t axis = plant->nodes.axis[node];
        child.order = (uint16_t)MIN(level->order[row] + plant->axes.order[axis] + 1, UINT16_MAX);
        child.parent_length = scion->lengths[axis];
        child.parent_radius = plant->nodes.radius[node];
    }
    return child;
}

/// Writes what a link makes at all places of its symbol; returns the row after.
static uint32_t make_places(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                            const FrPose *pose, const FrStageLink *link, uint32_t at) {
    const FrOrgans *organs = &scion->plant->organs;
    const FrFlags *flags = &fr_stage_prepared(expansion, link->stage)->flags;
    uint32_t n = fr_scion_places(scion, link->symbol), k = 0;
    for (uint32_t organ = 0; organ < organs->count && k < n; organ++) {
        if (organs->shape[organ] != FR_NONE ||
            *fr_scion_symbol(scion->plant, organ) != link->symbol) {
            continue;
        }
        if (fr_flags_allow(flags, k, n)) {
            FrChild child = place_child(expansion, row, scion, pose, organ, k, n);
            fr_child_write(expansion, row, link, &child, at++);
        }
        k++;
    }
    return at;
}

/// The pose at the end of the main axis, where what follows without a symbol goes on.
static FrPose tip_of(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                     FrPose pose) {
    if (scion->plant->axes.count > 0 && scion->plant->axes.last[0] != FR_NONE) {
        pose.bearer = expansion->plant->axes.last[expansion->level.axis_count[row]];
        pose.offset = (vec3s){{0, 0, 0}};
        pose.rotation = (versors){{0, 0, 0, 1}};
    }
    return pose;
}

static void make_children(const FrExpansion *expansion, uint32_t row, const FrScion *scion,
                          const FrPose *pose) {
    const FrLevel *level = &expansion->level;
    const FrStage *stage = fr_instance_stage(expansion, row);
    uint32_t at = level->child_count[row];
    for (uint32_t k = 0; k < stage->link_count; k++) {
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        if (link->kind == FR_LINK_SYMBOL) {
            at = make_places(expansion, row, scion, pose, link, at);
        }
    }
    FrChild child = fr_single_child(expansion, row, tip_of(expansion, row, scion, *pose));
    if (scion->plant->axes.count > 0 && scion->plant->axes.last[0] != FR_NONE) {
        uint32_t last = scion->plant->axes.last[0];
        child.joint = FR_JOINT_TIP;
        child.x = 1;
        child.parent_length = scion->lengths[0];
        child.parent_radius = scion->plant->nodes.radius[last];
    }
    fr_make_single_children(expansion, row, child, at);
}

void fr_make_graft(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrScion *scion = fr_scion_of(expansion->grafting, row);
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    copy_axes(expansion, row, scion, &pose);
    copy_nodes(expansion, row, scion, &pose);
    copy_organs(expansion, row, scion, &pose);
    place_scopes(expansion, row, scion, &pose);
    make_children(expansion, row, scion, &pose);
}
