// Making what an instance stands for: its axis, nodes, organs, and the rows of its children.
#include "pgraph/edit.h"
#include "pgraph/global.h"
#include "pgraph/instance.h"

#include "plant/frames.h"

#include <cglm/struct.h>
#include <math.h>

static const versors identity = {{0, 0, 0, 1}};
static const vec3s nowhere = {{0, 0, 0}};

// Steps of position and height (m) in which shapes that depend on them differ, so that leaves
// share shapes.
#define SHAPE_POSITIONS 64.0
#define SHAPE_HEIGHT 0.1
#define SHAPE_AGES 256.0

static const FrPrepared *prepared_of(const FrExpansion *expansion, uint32_t row) {
    return &expansion->prepared[fr_instance_stage(expansion, row)->component];
}

FrChild fr_single_child(const FrExpansion *expansion, uint32_t row, FrPose site) {
    const FrLevel *level = &expansion->level;
    return (FrChild){
        .site = site,
        .i = level->i[row],
        .n = level->n[row],
        .order = level->order[row],
        .x = level->x[row],
        .parent_length = level->parent_length[row],
        .parent_radius = level->parent_radius[row],
        .stretch = 1,
        .age = level->age[row],
        .axis = FR_NONE,
    };
}

// A tube or area goes on in the first such child only; another begins a new one.
static bool goes_on(const FrPrepared *from, const FrPrepared *to, uint32_t axis) {
    const FrSimpleParams *a = from->params;
    const FrSimpleParams *b = to->params;
    return axis != FR_NONE && from->is_point_set && to->is_point_set &&
           a->primitive == b->primitive;
}

uint32_t fr_make_single_children(const FrExpansion *expansion, uint32_t row, FrChild child,
                                 uint32_t at) {
    const FrLevel *level = &expansion->level;
    const FrStage *stage = fr_instance_stage(expansion, row);
    const FrPrepared *prepared = &expansion->prepared[stage->component];
    FrKey key = child.key != 0 ? child.key : level->key[row];
    for (uint32_t k = 0; k < stage->link_count; k++) {
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        const FrPrepared *to = fr_stage_prepared(expansion, link->stage);
        if (fr_link_is_multiplied(prepared->kind, link->kind) ||
            !fr_flags_allow(&to->flags, child.i, child.n)) {
            continue;
        }
        FrChild one = child;
        one.key =
            fr_is_global(prepared->kind) ? key : fr_key_child(key, FR_NONE - (uint64_t)link->kind);
        if (goes_on(prepared, to, child.axis)) {
            one.joint = FR_JOINT_SET;
            child.axis = FR_NONE;
        }
        fr_child_write(expansion, row, link, &one, at++);
    }
    return at;
}

// By hand.
static bool is_hidden(const FrExpansion *expansion, uint32_t row) {
    const FrGraphEdit *edit = fr_instance_edit(expansion, row);
    return edit != NULL && edit->params.hide;
}

uint32_t fr_write_organ(const FrExpansion *expansion, uint32_t row, uint32_t organ, FrPose pose,
                        uint32_t shape) {
    FrOrgans *organs = &expansion->plant->organs;
    organs->node[organ] = pose.bearer;
    organs->offset[organ] = pose.offset;
    organs->rotation[organ] = pose.rotation;
    organs->scale[organ] = (float)fmax(pose.scale, 1e-9);
    organs->shape[organ] = shape;
    organs->material[organ] = expansion->ramps == NULL ? fr_instance_material(expansion, row)
                                                       : fr_instance_look(expansion, row);
    organs->component[organ] = fr_instance_stage(expansion, row)->component;
    organs->deformer[organ] = expansion->level.deformer[row];
    organs->path[organ] = expansion->level.key[row];
    if (expansion->level.edit[row] != FR_EDIT_NOWHERE && is_hidden(expansion, row)) {
        organs->flags[organ] |= FR_HIDDEN;
    }
    return organ;
}

void fr_piece_write(const FrExpansion *expansion, uint32_t row, uint32_t organ,
                    const FrPiece *piece) {
    FrOrgans *organs = &expansion->plant->organs;
    bool has_own = piece->material != FR_NONE;
    organs->shape[organ] = piece->shape;
    organs->material[organ] = has_own ? piece->material : fr_instance_material(expansion, row);
}

uint32_t fr_write_pieces(const FrExpansion *expansion, uint32_t row, uint32_t organ, FrPose pose) {
    const FrPrepared *prepared = prepared_of(expansion, row);
    for (uint32_t k = 0; k < prepared->piece_count; k++, organ++) {
        fr_write_organ(expansion, row, organ, pose, FR_NONE);
        fr_piece_write(expansion, row, organ, &prepared->pieces[k]);
    }
    return organ;
}

static void write_axis(const FrExpansion *expansion, uint32_t row, uint32_t axis, FrPose pose,
                       double radius, uint16_t flags) {
    FrAxes *axes = &expansion->plant->axes;
    axes->bearer[axis] = pose.bearer;
    axes->offset[axis] = pose.offset;
    axes->base_radius[axis] = (float)radius;
    axes->order[axis] = expansion->level.order[row];
    axes->flags[axis] = is_hidden(expansion, row) ? flags | FR_HIDDEN : flags;
    axes->profile[axis] = prepared_of(expansion, row)->profile;
    axes->material[axis] = fr_instance_look(expansion, row);
    axes->component[axis] = fr_instance_stage(expansion, row)->component;
    axes->deformer[axis] = expansion->level.deformer[row];
    axes->path[axis] = expansion->level.key[row];
}

// ---- leaf -------------------------------------------------------------------------------------

// A field's direction; where it has none the leaf keeps to the plain one.
static vec3s direction_of(const double field[3], vec3s plain) {
    double size = sqrt(field[0] * field[0] + field[1] * field[1] + field[2] * field[2]);
    return size > 1e-9 ? (vec3s){{(float)(field[0] / size), (float)(field[1] / size),
                                  (float)(field[2] / size)}}
                       : plain;
}

static void leaf_fields(const FrExpansion *expansion, uint32_t row, FrPose pose,
                        FrEvaluator *evaluator, vec3s *down, vec3s *shine) {
    const FrNodes *nodes = &expansion->plant->nodes;
    FrFields fields = fr_instance_fields(expansion, row, evaluator);
    vec3s place = pose.offset;
    if (pose.bearer != FR_NONE) {
        place = fr_turned(nodes->frame[pose.bearer], place);
        place = glms_vec3_add(nodes->position[pose.bearer], place);
    }
    double at[3] = {(double)place.x, (double)place.y, (double)place.z}, field[3];
    fr_field_gravity(&fields, at, field);
    *down = direction_of(field, *down);
    fr_field_light(&fields, at, field);
    *shine = direction_of(field, *shine);
}

static versors leaf_rotation(const FrExpansion *expansion, uint32_t row, FrPose pose,
                             FrEvaluator *evaluator) {
    const FrLeafParams *leaf = prepared_of(expansion, row)->params;
    double light = fr_value(evaluator, &leaf->phototropism, FR_LEAF_phototropism);
    double weight = fr_value(evaluator, &leaf->gravitropism, FR_LEAF_gravitropism);
    if (light == 0 && weight == 0) {
        return pose.rotation;
    }
    versors bearer = pose.bearer != FR_NONE ? expansion->plant->nodes.frame[pose.bearer] : identity;
    versors frame = fr_frame_step(bearer, pose.rotation);
    vec3s down = {{0, 0, -1}}, shine = {{0, 0, 1}};
    if (expansion->level.field[row] != FR_NONE) {
        leaf_fields(expansion, row, pose, evaluator, &down, &shine);
    }
    if (weight != 0) {
        vec3s along = weight > 0 ? down : glms_vec3_negate(down);
        frame = fr_turned_towards(frame, fr_frame_heading(frame), along, fabs(weight));
    }
    if (light != 0) {
        frame = fr_turned_towards(frame, fr_frame_up(frame), shine, light);
    }
    versors back = {{-bearer.x, -bearer.y, -bearer.z, bearer.w}};
    return fr_frame_step(back, frame);
}

// Ages a leaf shares its shape with: steps of 1/256 of a year, or of the age's power of two.
static double rounded_age(double age) {
    double step = fmax(1, exp2(floor(log2(fmax(age, 1))))) / SHAPE_AGES;
    return round(age / step) * step;
}

void fr_enter_leaf_shape(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrPrepared *prepared = prepared_of(expansion, row);
    uint32_t variant = (uint32_t)(expansion->level.key[row] % prepared->variant_count);
    double *value = evaluator->vars.value;
    value[FR_VAR_x] = round(value[FR_VAR_x] * SHAPE_POSITIONS) / SHAPE_POSITIONS;
    value[FR_VAR_px] = round(value[FR_VAR_px] / SHAPE_HEIGHT) * SHAPE_HEIGHT;
    value[FR_VAR_py] = round(value[FR_VAR_py] / SHAPE_HEIGHT) * SHAPE_HEIGHT;
    value[FR_VAR_pz] = round(value[FR_VAR_pz] / SHAPE_HEIGHT) * SHAPE_HEIGHT;
    value[FR_VAR_height] = value[FR_VAR_pz];
    value[FR_VAR_age] = rounded_age(value[FR_VAR_age]);
    evaluator->vars.key = fr_variant_key(expansion->graph, prepared, variant);
}

uint32_t fr_instance_leaf_shape(const FrExpansion *expansion, uint32_t row, uint32_t organ,
                                FrEvaluator *evaluator) {
    const FrPrepared *prepared = prepared_of(expansion, row);
    if (prepared->shape_choice == FR_SHAPE_SAME) {
        return prepared->shape;
    }
    uint32_t variant = (uint32_t)(expansion->level.key[row] % prepared->variant_count);
    if (prepared->shape_choice == FR_SHAPE_VARIANT) {
        return prepared->variants[variant];
    }
    fr_enter_leaf_shape(expansion, row, evaluator);
    expansion->blades[organ - expansion->first_organ] = fr_leaf_shape(prepared, evaluator);
    return FR_NONE; // found after the loop
}

static void make_leaf(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    FrPose placed = pose;
    placed.rotation = leaf_rotation(expansion, row, pose, evaluator);
    uint32_t organ = level->organ_count[row];
    fr_write_organ(expansion, row, organ, placed,
                   fr_instance_leaf_shape(expansion, row, organ, evaluator));
    if (fr_instance_stage(expansion, row)->link_count > 0) {
        fr_make_single_children(expansion, row, fr_single_child(expansion, row, pose),
                                level->child_count[row]);
    }
}

// ---- simple -----------------------------------------------------------------------------------

// The next ring of a chain of point sets: a node from the last set's place to this one's. Returns
// the pose of what follows, on that node.
static FrPose add_point_set(const FrExpansion *expansion, uint32_t row, FrPose pose,
                            const FrSimpleParams *simple) {
    const FrLevel *level = &expansion->level;
    FrNodes *nodes = &expansion->plant->nodes;
    FrAxes *axes = &expansion->plant->axes;
    uint32_t axis = level->axis[row], node = level->node_count[row];
    // The last set stands at the row's site: on its own node, or at the axis' origin.
    uint32_t before = level->bearer[row];
    vec3s chord = glms_vec3_sub(pose.offset, level->offset[row]);
    float length = glms_vec3_norm(chord);
    versors rotation = pose.rotation;
    if (length > 0) {
        vec3s heading = fr_frame_heading(rotation);
        rotation =
            fr_frame_step(fr_rotation_between(heading, glms_vec3_divs(chord, length)), rotation);
    }
    nodes->parent[node] = before;
    nodes->axis[node] = axis;
    nodes->rotation[node] = rotation;
    nodes->length[node] = length;
    nodes->radius[node] = (float)(0.5 * (double)simple->size.x * pose.scale);
    nodes->flatness[node] = simple->size.x > 0 ? simple->size.y / simple->size.x : 1;
    if (axes->first[axis] == FR_NONE) {
        axes->first[axis] = node;
    } else {
        nodes->next[before] = node;
    }
    axes->last[axis] = node;
    fr_update_frame(nodes, axes, node);
    versors back = {{-rotation.x, -rotation.y, -rotation.z, rotation.w}};
    pose.bearer = node;
    pose.offset = nowhere;
    pose.rotation = fr_frame_step(back, pose.rotation);
    return pose;
}

static void make_simple(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = prepared_of(expansion, row);
    const FrSimpleParams *simple = prepared->params;
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    uint32_t axis = FR_NONE;
    if (prepared->is_point_set && level->joint[row] == FR_JOINT_SET) {
        axis = level->axis[row];
        pose = add_point_set(expansion, row, pose, simple);
    } else if (prepared->is_point_set) {
        axis = level->axis_count[row];
        write_axis(expansion, row, axis, pose, 0.5 * (double)simple->size.x * pose.scale,
                   FR_POINT_SETS | FR_CUT);
    } else if (prepared->piece_count > 0) {
        fr_write_pieces(expansion, row, level->organ_count[row], pose);
        vec3s top = {{0, 0, (float)(prepared->top * pose.scale)}};
        pose = fr_pose_moved(pose, top, identity);
    }
    FrChild child = fr_single_child(expansion, row, pose);
    child.axis = axis;
    fr_make_single_children(expansion, row, child, level->child_count[row]);
}

// ---- stem -------------------------------------------------------------------------------------

static void make_string(const FrExpansion *expansion, uint32_t row, const FrStem *stem, FrPose base,
                        versors tip) {
    const FrLevel *level = &expansion->level;
    uint32_t organ = level->organ_count[row], first = level->node_count[row];
    bool is_stepped = stem->course == FR_COURSE_STEPS;
    if (is_stepped) {
        base.scale = fr_stem_radius(stem, 0);
        organ = fr_write_pieces(expansion, row, organ, base);
    }
    FrLimb whole = fr_stem_whole(stem);
    for (uint32_t l = 0; l < stem->limb_count; l++) {
        const FrLimb *limb = fr_stem_limb(stem, &whole, l);
        double each = (limb->end - limb->start) / limb->internodes;
        for (uint32_t k = 0; k < limb->internodes; k++) {
            uint32_t node = first + limb->first + k;
            float length = expansion->plant->nodes.length[node];
            double at = limb->start + (k + (is_stepped ? 1 : 0.5)) * each;
            FrPose bead = {
                .bearer = node,
                .offset = {{0, 0, is_stepped ? 0 : -length}},
                .rotation = is_stepped ? tip : identity,
                .scale = fr_limb_radius(stem, limb, at),
            };
            organ = fr_write_pieces(expansion, row, organ, bead);
        }
    }
}

// Makes the axis that a limb begins.
static void begin_axis(const FrExpansion *expansion, uint32_t row, const FrStem *stem,
                       const FrLimb *limb, FrPose pose) {
    const FrLevel *level = &expansion->level;
    const FrStemParams *params = stem->prepared->params;
    bool is_base = limb->before == FR_NONE;
    bool continues = is_base && level->joint[row] == FR_JOINT_TIP && !pose.is_turned_or_moved;
    unsigned flags = (continues ? FR_CONTINUES : 0u) | (is_base ? 0u : FR_FORK) |
                     (params->tip != FR_TIP_POINTED || stem->slim < 1 ? FR_CUT : 0u) |
                     (stem->course == FR_COURSE_STEPS ? FR_POINT_SETS : 0u) |
                     (params->primitive > FR_PRIMITIVE_AREA ? FR_HIDDEN : 0u);
    if (is_base && stem->course == FR_COURSE_PATH) {
        vec3s start = g_array_index(stem->path, vec3s, 0);
        pose = fr_pose_moved(pose, glms_vec3_scale(start, (float)pose.scale), identity);
    }
    write_axis(expansion, row, level->axis_count[row] + limb->axis, pose,
               fr_limb_radius(stem, limb, limb->start), (uint16_t)flags);
    FrAxes *axes = &expansion->plant->axes;
    uint32_t axis = level->axis_count[row] + limb->axis, finish = stem->prepared->finish;
    axes->finish[axis] = finish != FR_NONE ? finish + stem->is_broken : FR_NONE;
    if (!is_base) {
        axes->path[axis] = limb->key;
    }
}

// Makes axes and nodes. `tips` receives the pose at the end of each limb.
static void grow_stem(const FrExpansion *expansion, uint32_t row, const FrStem *stem, FrPose pose,
                      FrEvaluator *evaluator, FrPose *tips) {
    const FrLevel *level = &expansion->level;
    FrFields fields = fr_instance_fields(expansion, row, evaluator);
    FrLimb whole = fr_stem_whole(stem);
    for (uint32_t l = 0; l < stem->limb_count; l++) {
        const FrLimb *limb = fr_stem_limb(stem, &whole, l);
        uint32_t first = level->node_count[row] + limb->first;
        FrPose base = pose;
        if (limb->before != FR_NONE) {
            // What has ended before its fork takes the arms with it.
            const FrLimb *before = &stem->limbs[limb->before];
            base = tips[limb->before];
            base.bearer = level->node_count[row] + before->first + before->internodes - 1;
        }
        if (limb->internodes == 0) {
            tips[l] = base;
            continue;
        }
        if (limb->begins_axis) {
            begin_axis(expansion, row, stem, limb, base);
        }
        tips[l] = base;
        tips[l].rotation =
            fr_limb_grow(stem, limb, expansion->plant, level->axis_count[row] + limb->axis, first,
                         base.rotation, &fields, &tips[l].bearer);
        tips[l].offset = nowhere;
    }
    if (stem->prepared->is_string) {
        make_string(expansion, row, stem, pose, tips[0].rotation);
    }
}

// What follows at the tips.
static void make_tips(const FrExpansion *expansion, uint32_t row, const FrStem *stem,
                      const FrPose *tips, uint32_t at) {
    FrLimb whole = fr_stem_whole(stem);
    for (uint32_t l = 0; l < stem->limb_count; l++) {
        const FrLimb *limb = fr_stem_limb(stem, &whole, l);
        if (limb->end < 1) {
            continue;
        }
        FrChild child = fr_single_child(expansion, row, tips[l]);
        child.key = limb->axis > 0 ? limb->key : 0;
        child.arms = limb->arms;
        child.joint = stem->internodes > 0 ? FR_JOINT_TIP : FR_JOINT_NONE;
        child.x = 1;
        child.parent_length = (float)(stem->length / stem->reach / tips[l].scale);
        child.parent_radius = (float)(fr_limb_radius(stem, limb, 1) / tips[l].scale);
        at = fr_make_single_children(expansion, row, child, at);
    }
}

void fr_make_stem(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                  FrEvaluator *place) {
    const FrLevel *level = &expansion->level;
    FrPose pose = fr_instance_pose(expansion, row, evaluator), tip;
    FrStem stem = fr_stem_measure(prepared_of(expansion, row), evaluator,
                                  fr_instance_stem_base(expansion, row, pose));
    FrPose *tips = stem.limb_count > 1 ? g_new(FrPose, stem.limb_count) : &tip;
    grow_stem(expansion, row, &stem, pose, evaluator, tips);
    uint32_t at = level->child_count[row];
    if (level->places[row] > 0) {
        at = fr_make_branches(expansion, row, &stem, pose, evaluator, place, at);
    }
    make_tips(expansion, row, &stem, tips, at);
    if (tips != &tip) {
        g_free(tips);
    }
    fr_stem_clear(&stem);
}

// What follows in the place of a variation goes on like it.
static void make_choice(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrStage *stage = fr_instance_stage(expansion, row);
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    if (stage->link_count == 0) {
        return;
    }
    const FrStageLink *link = fr_stage_link(expansion, stage, level->places[row]);
    const FrFlags *flags = &fr_stage_prepared(expansion, link->stage)->flags;
    if (!fr_flags_allow(flags, level->i[row], level->n[row])) {
        return;
    }
    FrChild child = fr_single_child(expansion, row, pose);
    child.key = fr_key_child(level->key[row], FR_NONE - (uint64_t)link->kind);
    if (level->joint[row] == FR_JOINT_TIP && !pose.is_turned_or_moved) {
        child.joint = FR_JOINT_TIP;
    }
    child.stretch = level->stretch[row];
    fr_child_write(expansion, row, link, &child, level->child_count[row]);
}

void fr_instance_make(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                      FrEvaluator *place) {
    if (expansion->level.is_absent[row]) {
        return;
    }
    fr_instance_enter(expansion, row, evaluator);
    switch (prepared_of(expansion, row)->kind) {
    case FR_COMPONENT_HORN:
    case FR_COMPONENT_TREE:
        fr_make_stem(expansion, row, evaluator, place);
        break;
    case FR_COMPONENT_LEAF:
        make_leaf(expansion, row, evaluator);
        break;
    case FR_COMPONENT_SIMPLE:
        make_simple(expansion, row, evaluator);
        break;
    case FR_COMPONENT_PHIBALL:
    case FR_COMPONENT_PHYLLOTAXIS:
        fr_make_golden(expansion, row, evaluator, place);
        break;
    case FR_COMPONENT_HYDRA:
    case FR_COMPONENT_WREATH:
        fr_make_star(expansion, row, evaluator, place);
        break;
    case FR_COMPONENT_SCATTER:
        fr_make_scatter(expansion, row, evaluator, place);
        break;
    case FR_COMPONENT_REVO:
        fr_make_revo(expansion, row, evaluator);
        break;
    case FR_COMPONENT_VARIATION:
        make_choice(expansion, row, evaluator);
        break;
    case FR_COMPONENT_GRAFT:
        fr_make_graft(expansion, row, evaluator);
        break;
    case FR_COMPONENT_FFD:
    case FR_COMPONENT_HYPERPATCH:
    case FR_COMPONENT_WORLD:
    case FR_COMPONENT_FORCE:
        fr_make_global(expansion, row, evaluator);
        break;
    default:
        fr_make_single_children(
            expansion, row,
            fr_single_child(expansion, row, fr_instance_pose(expansion, row, evaluator)),
            expansion->level.child_count[row]);
    }
}
