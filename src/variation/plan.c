// A variation made ready for a plant: which stroke and which indicators each branch has, and the
// rotations of branches that follow a stroke.
#include "variation/vary.h"

#include <cglm/struct.h>

#include <string.h>

enum { MOST_JOINTS = 16 }; // that a stroke asks for by its points

#define UPRIGHT 0.25f // the sine of what leaves the vertical by a seventh of a right angle

typedef struct Preparation {
    FrVaryPlan *plan;
    const FrContext *context;
    uint8_t *marks; ///< one a axis
} Preparation;

static FrStatus mark(Preparation *preparation, const char *choice, FrApply apply, FrSpan span) {
    const FrPlant *base = preparation->plan->base;
    if (fr_progress_is_cancelled(preparation->context->progress)) {
        return FR_CANCELLED;
    }
    memset(preparation->marks, 0, base->axes.count);
    FrStatus status =
        fr_choice_mark(choice, base, span, preparation->context->diags, preparation->marks);
    fr_apply_spread(base, apply, preparation->marks);
    return status;
}

static FrStatus associate(Preparation *preparation) {
    FrVaryPlan *plan = preparation->plan;
    FrStatus worst = FR_OK;
    for (guint s = 0; s < plan->vary->strokes->len; s++) {
        const FrDrawn *drawn = &g_array_index(plan->vary->strokes, FrDrawn, s);
        FrStatus status = mark(preparation, drawn->choice, drawn->apply, drawn->span);
        if (status == FR_CANCELLED) {
            return status;
        }
        worst = status != FR_OK ? status : worst;
        for (uint32_t a = 0; a < plan->base->axes.count; a++) {
            plan->stroke[a] = preparation->marks[a] != 0 ? s : plan->stroke[a];
        }
    }
    return worst;
}

static FrStatus sum_indicators(Preparation *preparation) {
    FrVaryPlan *plan = preparation->plan;
    const GArray *indicators = plan->vary->indicators;
    if (indicators->len == 0) {
        return FR_OK;
    }
    plan->indicator = g_new0(vec3s, plan->base->axes.count + 1);
    float scale = (float)tan(plan->vary->params.tilt);
    FrStatus worst = FR_OK;
    for (guint i = 0; i < indicators->len; i++) {
        const FrPushed *pushed = &g_array_index(indicators, FrPushed, i);
        FrStatus status = mark(preparation, pushed->choice, pushed->apply, pushed->span);
        if (status == FR_CANCELLED) {
            return status;
        }
        worst = status != FR_OK ? status : worst;
        vec3s push = glms_vec3_scale(pushed->vector, scale);
        for (uint32_t a = 0; a < plan->base->axes.count; a++) {
            if (preparation->marks[a] != 0) {
                plan->indicator[a] = glms_vec3_add(plan->indicator[a], push);
            }
        }
    }
    return worst;
}

/// What is left of a rotation when its turn of the z axis is taken away: the roll about z that
/// comes first.
static versors roll_of(versors rotation) {
    float norm = sqrtf(rotation.z * rotation.z + rotation.w * rotation.w);
    if (!(norm > 1e-6f)) {
        return GLMS_QUAT_IDENTITY;
    }
    return (versors){{0, 0, rotation.z / norm, rotation.w / norm}};
}

/// The turn of a stroke that begins along `from` onto a branch that begins along `to`. Where both
/// leave the vertical it is about the vertical first, so that a stroke that rises lets branches on
/// all sides rise; the rest, and all of it for upright ones, is the smallest rotation there is.
static versors aligned(vec3s from, vec3s to) {
    versors turn = GLMS_QUAT_IDENTITY;
    if (hypotf(from.x, from.y) > UPRIGHT && hypotf(to.x, to.y) > UPRIGHT) {
        float angle = atan2f(to.y, to.x) - atan2f(from.y, from.x);
        turn = fr_rotation_about((vec3s){{0, 0, 1}}, angle);
        from = glms_vec3_normalize(glms_quat_rotatev(turn, from));
    }
    return fr_frame_step(fr_rotation_between(from, to), turn);
}

typedef struct Scratch {
    float *lengths;
    vec3s *headings;
} Scratch;

/// Writes the rotations of an axis that follows its stroke. The stroke is turned so that it leaves
/// the bearer as the branch does; the roll of the joints, which says where leaves and branches
/// stand around the stem, is kept.
static void follow(FrVaryPlan *plan, uint32_t axis, Scratch scratch) {
    const FrNodes *nodes = &plan->base->nodes;
    const FrDrawn *drawn = &g_array_index(plan->vary->strokes, FrDrawn, plan->stroke[axis]);
    size_t count = 0;
    for (uint32_t i = plan->base->axes.first[axis]; i != FR_NONE; i = nodes->next[i]) {
        scratch.lengths[count++] = nodes->length[i];
    }
    fr_stroke_resample(drawn->stroke, scratch.lengths, count, scratch.headings);
    uint32_t first = plan->base->axes.first[axis];
    // Turned in the plant's coordinates, then seen from the first internode, which stays as it is.
    versors stands = nodes->frame[first];
    versors align = aligned(scratch.headings[0], glms_vec3_normalize(fr_frame_heading(stands)));
    align = fr_frame_step(glms_quat_conjugate(stands), align);
    versors frame = GLMS_QUAT_IDENTITY;
    size_t n = 1;
    for (uint32_t i = nodes->next[first]; i != FR_NONE; i = nodes->next[i], n++) {
        vec3s heading = glms_quat_rotatev(align, scratch.headings[n]);
        versors turn = fr_rotation_between(fr_frame_heading(frame), glms_vec3_normalize(heading));
        // Turned in space, then rolled about its own axis.
        versors next = fr_frame_step(fr_frame_step(turn, frame), roll_of(nodes->rotation[i]));
        plan->rotation[i] = fr_frame_step(glms_quat_conjugate(frame), next);
        frame = next;
    }
}

static void follow_strokes(FrVaryPlan *plan) {
    const FrPlant *base = plan->base;
    uint32_t longest = 0;
    for (uint32_t a = 0; a < base->axes.count; a++) {
        uint32_t count = 0;
        if (plan->stroke[a] != FR_NONE) {
            for (uint32_t i = base->axes.first[a]; i != FR_NONE; i = base->nodes.next[i]) {
                count++;
            }
        }
        longest = MAX(longest, count);
    }
    if (longest < 2) {
        return; // first internodes keep their direction
    }
    plan->rotation = g_new(versors, base->nodes.count);
    memcpy(plan->rotation, base->nodes.rotation, base->nodes.count * sizeof *plan->rotation);
    Scratch scratch = {g_new(float, longest), g_new(vec3s, longest)};
    for (uint32_t a = 0; a < base->axes.count; a++) {
        if (plan->stroke[a] != FR_NONE && base->axes.first[a] != FR_NONE) {
            follow(plan, a, scratch);
        }
    }
    g_free(scratch.lengths);
    g_free(scratch.headings);
}

/// Internodes that each axis needs to follow what reaches it: a stroke wants as many as it has
/// points.
static uint16_t *joints_needed(const FrVaryPlan *plan) {
    const FrVaryParams *params = &plan->vary->params;
    uint16_t *joints = g_new0(uint16_t, plan->base->axes.count + 1);
    for (uint32_t a = 0; a < plan->base->axes.count; a++) {
        bool is_pushed = plan->indicator != NULL && glms_vec3_norm2(plan->indicator[a]) > 0;
        if (plan->stroke[a] != FR_NONE) {
            const FrDrawn *drawn = &g_array_index(plan->vary->strokes, FrDrawn, plan->stroke[a]);
            size_t points;
            fr_stroke_points(drawn->stroke, &points);
            joints[a] = (uint16_t)MAX((int)MIN(points, MOST_JOINTS), params->joints);
        } else if (is_pushed || params->scatter > 0) {
            joints[a] = (uint16_t)params->joints;
        }
    }
    return joints;
}

/// Gives branches with few joints, which a straight stem has, more of them.
static FrStatus refine(FrVaryPlan *plan, const FrContext *context) {
    uint16_t *joints = joints_needed(plan);
    uint64_t count = fr_plant_refined_nodes(plan->base, joints);
    FrStatus status = FR_OK;
    if (count > plan->base->nodes.count) {
        status = fr_limit_check(count, context->limits.nodes, "nodes", "the variation", (FrSpan){0},
                                context->diags);
        if (status == FR_OK) {
            plan->refined = fr_plant_refined(plan->base, joints);
            plan->base = plan->refined;
        }
    }
    g_free(joints);
    return status;
}

/// Axes looked at, for all words of all choices.
static FrStatus check_work(const FrVary *vary, const FrPlant *base, const FrContext *context) {
    uint64_t words = 0;
    FrSpan span = {0};
    for (guint s = 0; s < vary->strokes->len; s++) {
        const FrDrawn *drawn = &g_array_index(vary->strokes, FrDrawn, s);
        words = fr_count_add(words, fr_choice_words(drawn->choice));
        span = drawn->span;
    }
    for (guint i = 0; i < vary->indicators->len; i++) {
        const FrPushed *pushed = &g_array_index(vary->indicators, FrPushed, i);
        words = fr_count_add(words, fr_choice_words(pushed->choice));
        span = pushed->span;
    }
    uint64_t work = fr_count_multiply(words, base->axes.count + 1);
    FrStatus status = fr_limit_check(work, context->limits.iterations, "iterations",
                                     "choosing branches", span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    uint64_t bytes = fr_count_multiply(base->nodes.count, sizeof(versors));
    return fr_limit_check(bytes, context->limits.bytes, "bytes", "the variation", span,
                          context->diags);
}

FrStatus fr_vary_prepare(const FrVary *vary, const FrPlant *base, const FrContext *context,
                         FrVaryPlan **plan) {
    *plan = NULL;
    FrStatus status = check_work(vary, base, context);
    if (status != FR_OK) {
        return status;
    }
    FrVaryPlan *made = g_new0(FrVaryPlan, 1);
    *made = (FrVaryPlan){.vary = vary,
                         .base = base,
                         .controller = fr_controller_of(&vary->params),
                         .stroke = g_new(uint32_t, base->axes.count + 1)};
    memset(made->stroke, 0xff, (base->axes.count + 1) * sizeof *made->stroke);
    Preparation preparation = {made, context, g_new0(uint8_t, base->axes.count + 1)};
    status = associate(&preparation);
    FrStatus summed = status == FR_CANCELLED ? status : sum_indicators(&preparation);
    status = summed != FR_OK ? summed : status;
    g_free(preparation.marks);
    status = status == FR_OK ? refine(made, context) : status;
    if (status != FR_OK) {
        fr_vary_plan_free(made);
        return status;
    }
    follow_strokes(made);
    *plan = made;
    return FR_OK;
}

void fr_vary_plan_free(FrVaryPlan *plan) {
    if (plan != NULL) {
        g_free(plan->stroke);
        g_free(plan->rotation);
        g_free(plan->indicator);
        fr_plant_free(plan->refined);
        g_free(plan);
    }
}

const FrPlant *fr_vary_plan_base(const FrVaryPlan *plan) {
    return plan->base;
}

uint32_t fr_vary_stroke_of(const FrVaryPlan *plan, uint32_t axis) {
    return plan->stroke[axis];
}
