#include "pgraph/instance.h"

#include "pgraph/edit.h"
#include "pgraph/global.h"
#include "pgraph/life.h"

#include "plant/frames.h"

#include <cglm/struct.h>
#include <math.h>

static const versors identity = {{0, 0, 0, 1}};

// Sizes stay where floats have room to spare, however deep a recursion goes.
#define SMALLEST 1e-9
#define LARGEST FR_LARGEST_SCALE
// Positions too: nothing is farther from its bearer than this, in metres.
#define FARTHEST 1e9f
// Draws anew have keys that no path has.
#define REDRAWN (UINT64_C(1) << 40)

static double share(uint32_t i, uint32_t n) {
    return n > 1 ? (double)i / (double)(n - 1) : 0;
}

static uint32_t component_of(const FrExpansion *expansion, uint32_t row) {
    return fr_instance_stage(expansion, row)->component;
}

static vec3s place_of(const FrExpansion *expansion, uint32_t row) {
    const FrLevel *level = &expansion->level;
    const FrNodes *nodes = &expansion->plant->nodes;
    uint32_t bearer = level->bearer[row];
    if (bearer == FR_NONE) {
        return level->offset[row];
    }
    vec3s offset = fr_turned(nodes->frame[bearer], level->offset[row]);
    return glms_vec3_add(nodes->position[bearer], offset);
}

void fr_instance_enter(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    uint32_t component = component_of(expansion, row);
    const FrPrepared *prepared = &expansion->prepared[component];
    evaluator->component = component;
    evaluator->instance = level->first + row;
    evaluator->vars.key = level->key[row];
    if (fr_is_global(prepared->kind)) {
        evaluator->vars.key = fr_key_child(level->key[row], prepared->key_word);
    }
    if (!prepared->varies) {
        return;
    }
    double *value = evaluator->vars.value;
    for (int var = 0; var < FR_VAR_COUNT; var++) {
        value[var] = 0;
    }
    value[FR_VAR_t] = share(level->i[row], level->n[row]);
    value[FR_VAR_i] = level->i[row];
    value[FR_VAR_n] = level->n[row];
    value[FR_VAR_i1] = level->i1[row];
    value[FR_VAR_n1] = level->n1[row];
    value[FR_VAR_i2] = level->i2[row];
    value[FR_VAR_n2] = level->n2[row];
    value[FR_VAR_depth] = level->generation[row];
    value[FR_VAR_order] = level->order[row];
    value[FR_VAR_x] = (double)level->x[row];
    value[FR_VAR_age] = (double)level->age[row];
    value[FR_VAR_time] = expansion->graph->state.time;
    value[FR_VAR_season] = expansion->graph->state.season;
    value[FR_VAR_health] = expansion->graph->state.health;
    value[FR_VAR_light] = 1;
    if (prepared->uses_place) {
        fr_place_set(&evaluator->vars, place_of(expansion, row));
    }
}

void fr_place_set(FrVars *vars, vec3s place) {
    vars->value[FR_VAR_px] = (double)place.x;
    vars->value[FR_VAR_py] = (double)place.y;
    vars->value[FR_VAR_pz] = vars->value[FR_VAR_height] = (double)place.z;
}

void fr_place_enter(FrEvaluator *place, const FrEvaluator *parent, const FrLevel *level,
                    uint32_t row, uint32_t i, uint32_t n, FrKey key) {
    double *value = place->vars.value;
    place->component = parent->component;
    place->instance = parent->instance;
    place->vars.key = key;
    for (int var = 0; var < FR_VAR_COUNT; var++) {
        value[var] = parent->vars.value[var];
    }
    value[FR_VAR_t] = share(i, n);
    value[FR_VAR_i] = i;
    value[FR_VAR_n] = n;
    value[FR_VAR_i1] = level->i[row];
    value[FR_VAR_n1] = level->n[row];
    value[FR_VAR_i2] = level->i1[row];
    value[FR_VAR_n2] = level->n1[row];
    value[FR_VAR_order] = level->order[row] + 1;
}

static versors turn_about(int axis, double angle) {
    vec3s unit = {{0, 0, 0}};
    unit.raw[axis] = 1;
    return fr_rotation_about(unit, (float)angle);
}

FrPose fr_pose_moved(FrPose pose, vec3s by, versors turn) {
    vec3s moved = fr_turned(pose.rotation, by);
    pose.offset = glms_vec3_add(pose.offset, moved);
    for (int k = 0; k < 3; k++) {
        pose.offset.raw[k] = fmaxf(-FARTHEST, fminf(pose.offset.raw[k], FARTHEST));
    }
    pose.rotation = fr_frame_step(pose.rotation, turn);
    return pose;
}

const FrGraphEdit *fr_instance_edit(const FrExpansion *expansion, uint32_t row) {
    FrEditState state = expansion->level.edit[row];
    uint32_t edit = state != FR_EDIT_NOWHERE ? fr_edits_at(expansion->edits, state) : FR_NONE;
    return edit != FR_NONE ? fr_graph_edit(expansion->graph, edit) : NULL;
}

// A pose turned and scaled by hand. What is no stem bends at its base.
static G_GNUC_NO_INLINE FrPose edited(const FrExpansion *expansion, uint32_t row, FrPose pose) {
    const FrGraphEdit *edit = fr_instance_edit(expansion, row);
    if (edit == NULL) {
        return pose;
    }
    const FrEditParams *by = &edit->params;
    bool is_stem = fr_stage_prepared(expansion, expansion->level.stage[row])->is_stem;
    double x = by->rotate_x - (is_stem ? 0 : by->bend);
    double y = by->rotate_y + (is_stem ? 0 : by->bend_aside), z = by->rotate_z;
    versors turn =
        fr_frame_step(turn_about(2, z), fr_frame_step(turn_about(1, y), turn_about(0, x)));
    pose.rotation = fr_frame_step(pose.rotation, turn);
    pose.is_turned_or_moved |= x != 0 || y != 0 || z != 0;
    pose.scale *= by->scale;
    return pose;
}

// Turns one of a pose's own axes to those of the plant, one after the other.
static G_GNUC_NO_INLINE FrPose drawn(const FrExpansion *expansion, FrPose pose,
                                     const FrBasicParams *basic, FrEvaluator *evaluator) {
    const double parts[] = {
        fr_value(evaluator, &basic->tropism_x, FR_BASIC_tropism_x),
        fr_value(evaluator, &basic->tropism_y, FR_BASIC_tropism_y),
        fr_value(evaluator, &basic->tropism_z, FR_BASIC_tropism_z),
    };
    const FrNodes *nodes = &expansion->plant->nodes;
    versors bearer = pose.bearer != FR_NONE ? nodes->frame[pose.bearer] : identity;
    versors frame = fr_frame_step(bearer, pose.rotation);
    for (int k = 0; k < 3; k++) {
        vec3s own = {{0, 0, 0}}, world = {{0, 0, 0}};
        own.raw[basic->tropism_axis] = 1;
        world.raw[k] = parts[k] < 0 ? -1 : 1;
        frame = fr_turned_towards(frame, fr_turned(frame, own), world, fabs(parts[k]));
        pose.is_turned_or_moved |= parts[k] != 0;
    }
    versors back = {{-bearer.x, -bearer.y, -bearer.z, bearer.w}};
    pose.rotation = fr_frame_step(back, frame);
    return pose;
}

versors fr_turned_towards(versors frame, vec3s from, vec3s to, double part) {
    if (part == 0) {
        return frame;
    }
    vec3s axis = glms_vec3_cross(from, to);
    float sine = glms_vec3_norm(axis);
    float angle = atan2f(sine, glms_vec3_dot(from, to));
    if (sine > 1e-6f) {
        axis = glms_vec3_divs(axis, sine);
    } else { // straight away from it, about whichever of its own axes is across
        bool is_across = fabsf(glms_vec3_dot(from, fr_frame_left(frame))) < 0.7f;
        axis = is_across ? fr_frame_left(frame) : fr_frame_up(frame);
    }
    return fr_frame_step(fr_rotation_about(axis, (float)part * angle), frame);
}

FrPose fr_instance_pose(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrStage *stage = fr_instance_stage(expansion, row);
    const FrPrepared *prepared = &expansion->prepared[stage->component];
    const FrBasicParams *basic = prepared->params;
#define FR_GET(field) fr_value(evaluator, &basic->field, FR_BASIC_##field)
    FrPose pose = {
        .bearer = level->bearer[row],
        .offset = level->offset[row],
        .rotation = level->rotation[row],
        .scale = (double)level->scale[row],
    };
    versors turn = identity;
    if (stage->is_further) {
        double angle = FR_GET(recursion_angle);
        pose.scale *= FR_GET(recursion_scale);
        pose.is_turned_or_moved = angle != 0;
        turn = turn_about(0, angle);
        pose.rotation = angle != 0 ? fr_frame_step(pose.rotation, turn) : pose.rotation;
    }
    if (!prepared->is_unmoved) {
        double x = FR_GET(rotate_x), y = FR_GET(rotate_y), z = FR_GET(rotate_z);
        vec3s by = {{(float)(FR_GET(translate_x) * pose.scale),
                     (float)(FR_GET(translate_y) * pose.scale),
                     (float)(FR_GET(translate_z) * pose.scale)}};
        turn = fr_frame_step(turn_about(2, z), fr_frame_step(turn_about(1, y), turn_about(0, x)));
        pose = fr_pose_moved(pose, by, turn);
        pose.is_turned_or_moved |=
            x != 0 || y != 0 || z != 0 || by.x != 0 || by.y != 0 || by.z != 0;
    }
    if (prepared->is_drawn) {
        pose = drawn(expansion, pose, basic, evaluator);
    }
    pose.scale *= FR_GET(scale);
    if (prepared->grows && !prepared->is_stem) {
        pose.scale *= fr_growth_now(prepared, evaluator);
    }
    if (level->edit[row] != FR_EDIT_NOWHERE) {
        pose = edited(expansion, row, pose);
    }
    if (pose.scale > LARGEST) {
        const FrExprFault fault = {.code = FR_OUTGROWN};
        fr_value_note(evaluator, stage->component, FR_BASIC_scale, &fault);
    }
    pose.scale = fmax(SMALLEST, fmin(pose.scale, LARGEST));
#undef FR_GET
    return pose;
}

// How far it is from a stem's base straight ahead to what stems end at; less than 0: nowhere.
static double way_ahead(const FrExpansion *expansion, uint32_t row, FrPose pose) {
    enum { FAR = 1000 };
    const FrNodes *nodes = &expansion->plant->nodes;
    versors frame = pose.rotation;
    vec3s at = pose.offset;
    if (pose.bearer != FR_NONE) {
        frame = fr_frame_step(nodes->frame[pose.bearer], frame);
        at = glms_vec3_add(nodes->position[pose.bearer], fr_turned(nodes->frame[pose.bearer], at));
    }
    FrFields fields = fr_instance_fields(expansion, row, NULL);
    double free = FAR, before;
    do { // the shorter the way that is looked at, the better it is known
        uint64_t out = 0;
        bool is_cut;
        before = free;
        free = fr_field_free(&fields, frame, at, before, &out, &is_cut);
        free = free < before ? free + 1e-3 * before : before;
    } while (free < 0.5 * before);
    return free < FAR ? free - 1e-3 * before : -1;
}

FrStemBase fr_instance_stem_base(const FrExpansion *expansion, uint32_t row, FrPose pose) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = fr_stage_prepared(expansion, level->stage[row]);
    const FrGraphEdit *edit =
        level->edit[row] != FR_EDIT_NOWHERE ? fr_instance_edit(expansion, row) : NULL;
    return (FrStemBase){
        .bend = edit != NULL ? edit->params.bend : 0,
        .bend_aside = edit != NULL ? edit->params.bend_aside : 0,
        .axis = edit != NULL ? edit->axis : NULL,
        .scale = pose.scale,
        .ahead = prepared->is_ahead ? way_ahead(expansion, row, pose) : -1,
        .place = (double)level->x[row],
        .parent_length = (double)level->parent_length[row],
        .parent_radius = (double)level->parent_radius[row],
        .stretch = (double)level->stretch[row],
        .has_parent = level->parent_length[row] >= 0,
        .step = (double)level->step[row],
        .is_in_field = level->field[row] != FR_NONE,
        .order = level->order[row],
        .is_on_ground = level->bearer[row] == FR_NONE,
        .heading = pose.bearer != FR_NONE && prepared->is_aligned
                       ? fr_frame_heading(expansion->plant->nodes.frame[pose.bearer])
                       : (vec3s){{0, 0, 1}},
    };
}

FrFields fr_instance_fields(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    return (FrFields){
        .fields = (const FrField *)(const void *)expansion->fields->data,
        .prepared = expansion->prepared,
        .innermost = expansion->level.field[row],
        .order = expansion->level.order[row],
        .evaluator = evaluator,
        .light = expansion->light,
    };
}

uint32_t fr_instance_material(const FrExpansion *expansion, uint32_t row) {
    uint32_t own = expansion->prepared[component_of(expansion, row)].material;
    return own != FR_NONE ? own : expansion->level.material[row];
}

uint32_t fr_instance_look(const FrExpansion *expansion, uint32_t row) {
    uint32_t material = fr_instance_material(expansion, row);
    bool has_ramp =
        expansion->ramps != NULL && material != FR_NONE && expansion->ramps[material] != FR_NONE;
    return has_ramp ? expansion->ramps[material] + expansion->level.ramp[row] : material;
}

// Hands a child its place on the paths of edits, and does what makes it another.
static G_GNUC_NO_INLINE void write_edit(const FrExpansion *expansion, uint32_t row,
                                        uint32_t component, const FrChild *child, uint32_t at) {
    const FrLevel *level = &expansion->level;
    const FrLevel *next = &expansion->next;
    FrStep step = {
        .component = component,
        .iteration = child->i,
        .is_multiplied = child->is_multiplied,
        .is_global = fr_is_global(expansion->prepared[component].kind),
        .arms = child->arms,
    };
    bool is_below_global = fr_is_global(fr_stage_prepared(expansion, level->stage[row])->kind);
    next->edit[at] =
        fr_edits_step(expansion->edits, level->edit[row], is_below_global, child->i, &step);
    uint32_t edit = step.is_global || next->edit[at] == FR_EDIT_NOWHERE
                        ? FR_NONE
                        : fr_edits_at(expansion->edits, next->edit[at]);
    if (edit != FR_NONE) {
        fr_edit_apply(expansion, next, at, edit);
    }
}

void fr_edit_apply(const FrExpansion *expansion, const FrLevel *level, uint32_t at, uint32_t edit) {
    uint32_t stage = g_array_index(expansion->unrolled->replacements, uint32_t, edit);
    int64_t redraw = fr_graph_edit(expansion->graph, edit)->params.redraw;
    level->stage[at] = stage != FR_NONE ? stage : level->stage[at];
    if (redraw != 0) {
        level->key[at] = fr_key_child(level->key[at], REDRAWN + (uint64_t)redraw);
    }
}

void fr_child_write(const FrExpansion *expansion, uint32_t row, const FrStageLink *link,
                    const FrChild *child, uint32_t at) {
    const FrLevel *level = &expansion->level;
    const FrLevel *next = &expansion->next;
    const FrStage *stage = &g_array_index(expansion->unrolled->stages, FrStage, link->stage);
    uint32_t generation = stage->generation;
    next->stage[at] = link->stage;
    next->parent[at] = row;
    next->bearer[at] = child->site.bearer;
    next->offset[at] = child->site.offset;
    next->rotation[at] = child->site.rotation;
    next->scale[at] = (float)fmax(SMALLEST, fmin(child->site.scale, LARGEST));
    next->key[at] = fr_path_key(child->key, &expansion->prepared[stage->component]);
    next->i[at] = child->i;
    next->n[at] = child->n;
    next->i1[at] = child->is_multiplied ? level->i[row] : level->i1[row];
    next->n1[at] = child->is_multiplied ? level->n[row] : level->n1[row];
    next->i2[at] = child->is_multiplied ? level->i1[row] : level->i2[row];
    next->n2[at] = child->is_multiplied ? level->n1[row] : level->n2[row];
    next->generation[at] =
        generation != FR_NONE ? (uint16_t)MIN(generation, UINT16_MAX) : level->generation[row];
    next->order[at] = child->order;
    next->joint[at] = child->joint;
    next->x[at] = child->x;
    next->parent_length[at] = child->parent_length;
    next->parent_radius[at] = child->parent_radius;
    next->stretch[at] = child->stretch;
    next->clock[at] = child->age;
    next->material[at] = fr_instance_material(expansion, row);
    next->deformer[at] = level->deformer[row];
    next->field[at] = level->field[row];
    next->scopes[at] = level->scopes[row];
    next->step[at] = level->step[row];
    next->axis[at] = child->axis;
    next->twin[at] = FR_NONE;
    next->edit[at] = FR_EDIT_NOWHERE;
    if (level->edit[row] != FR_EDIT_NOWHERE) {
        write_edit(expansion, row, stage->component, child, at);
    }
    if (expansion->places != NULL) {
        expansion->places[at] =
            (uint64_t)child->i << 32 | (uint64_t)child->arms << 1 | child->is_multiplied;
    }
}
