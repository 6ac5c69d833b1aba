// Branch bases: the ring in which a branch meets its parent lies on the parent's surface, a little
// wider than the branch, and leads into the branch with the parent's normals.
//
// The columns of a branch are straight lines near its base. On a cylinder of radius R about `along`
// a line that is x_b sideways of the axis meets the surface at the angle asin(x_b / R); the angle
// is held below a quarter turn, so a branch thicker than its parent still sits on it. Coordinates
// (distance along, angle) found so are carried over to the parent as it is skinned, bends, taper
// and profile included: the ring cannot leave its surface.
#include "skin/collar.h"

#include <cglm/struct.h>

#include <math.h>

// Steepest branch treated exactly, as sine of the angle to the parent's surface: some 10°.
#define STEEPEST 0.17F
// No column meets the parent further around than this sine.
#define AROUND_MOST 0.99F
enum { WALK_MOST = 128 };

void fr_tube_at(const FrPlan *plan, const FrTube *tube, float distance, vec3s *at, float *radius) {
    const FrNodes *nodes = &plan->plant->nodes;
    vec3s from = fr_tube_origin(plan, tube);
    float base = fr_tube_base_radius(plan, tube);
    for (uint32_t node = tube->first;; node = fr_plan_next(plan, node)) {
        float length = nodes->length[node];
        if (distance < length || node == tube->last) {
            float part = length > 0.0F ? MIN(distance / length, 1.0F) : 0.0F;
            vec3s step = glms_vec3_sub(nodes->position[node], from);
            *at = glms_vec3_muladds(step, part, from);
            *radius = base + part * (nodes->radius[node] - base);
            return;
        }
        distance -= length;
        from = nodes->position[node];
        base = nodes->radius[node];
    }
}

// The length of a tube, or `enough` if it is longer.
static float length_up_to(const FrPlan *plan, const FrTube *tube, float enough) {
    float length = 0.0F;
    for (uint32_t node = tube->first; length < enough; node = fr_plan_next(plan, node)) {
        length += plan->plant->nodes.length[node];
        if (node == tube->last) {
            break;
        }
    }
    return MIN(length, enough);
}

static uint32_t node_before(const FrPlan *plan, uint32_t node) {
    const FrPlant *plant = plan->plant;
    uint32_t axis = plant->nodes.axis[node];
    bool is_base = plant->axes.first[axis] == node && plan->before[axis] == FR_NONE;
    return is_base ? FR_NONE : plant->nodes.parent[node];
}

// A component of `v` across unit `along`.
static vec3s across(vec3s v, vec3s along) {
    return glms_vec3_muladds(along, -glms_vec3_dot(v, along), v);
}

// The distance of a tube's surface from its axis towards `direction`, for node radius 1.
static float reach_towards(const FrPlant *plant, const FrSection *section, uint32_t node,
                           vec3s direction) {
    float flatness = plant->nodes.flatness[node];
    if (section->is_round && flatness == 1.0F) {
        return 1.0F;
    }
    versors frame = plant->nodes.frame[node];
    float x = glms_vec3_dot(direction, fr_frame_left(frame));
    float y = glms_vec3_dot(direction, fr_frame_up(frame)) / MAX(flatness, 1e-3F);
    float stretch = sqrtf(x * x + y * y);
    return stretch > 0.0F ? fr_section_reach(section, x, y) / stretch : 1.0F;
}

// ---- finding the base --------------------------------------------------------------------------

// The parent's internode as a cone.
typedef struct FrInternode {
    vec3s axis_point; ///< on its axis, nearest to the branch's origin
    vec3s along;
    float radius; ///< there
    float beyond; ///< m from its tip, negative before
} FrInternode;

static FrInternode internode_at(const FrPlan *plan, uint32_t node, vec3s origin) {
    const FrPlant *plant = plan->plant;
    vec3s tip = plant->nodes.position[node];
    vec3s along = fr_frame_heading(plant->nodes.frame[node]);
    float beyond = glms_vec3_dot(glms_vec3_sub(origin, tip), along);
    uint32_t before = node_before(plan, node);
    float base = before == FR_NONE ? plant->axes.base_radius[plant->nodes.axis[node]]
                                   : plant->nodes.radius[before];
    float length = plant->nodes.length[node];
    float part = length > 0.0F ? MIN(MAX(1.0F + beyond / length, 0.0F), 1.0F) : 1.0F;
    return (FrInternode){
        .axis_point = glms_vec3_muladds(along, beyond, tip),
        .along = along,
        .radius = base + part * (plant->nodes.radius[node] - base),
        .beyond = beyond,
    };
}

// Where the branch's axis leaves the parent's surface.
static void find_exit(const FrPlan *plan, uint32_t node, const FrInternode *internode,
                      FrCollar *collar) {
    const FrPlant *plant = plan->plant;
    vec3s aside = across(glms_vec3_sub(collar->origin, internode->axis_point), internode->along);
    vec3s leaving = across(collar->direction, internode->along);
    float offset = glms_vec3_norm(aside), sine = glms_vec3_norm(leaving);
    vec3s outward = sine > 1e-3F                         ? glms_vec3_scale(leaving, 1.0F / sine)
                    : offset > 1e-3F * internode->radius ? glms_vec3_scale(aside, 1.0F / offset)
                                                         : fr_frame_left(plant->nodes.frame[node]);
    // Any round section will do: the parent's own may not be chosen yet.
    const FrSection *profile = fr_plan_profile(plan, plant->axes.profile[plant->nodes.axis[node]]);
    const FrSection *section = profile != NULL ? profile : &plan->sections[3];
    float reach = reach_towards(plant, section, node, outward);
    float radius = internode->radius * reach;
    collar->parent_radius = radius;

    float half = glms_vec3_dot(aside, leaving);
    float below = half * half - sine * sine * (offset * offset - radius * radius);
    if (sine >= STEEPEST && below >= 0.0F) {
        collar->exit_distance = (sqrtf(below) - half) / (sine * sine);
    } else if (offset > radius) {
        collar->exit_distance = 0.0F;
        outward = glms_vec3_scale(aside, 1.0F / offset);
    } else {
        collar->exit_distance = (radius - glms_vec3_dot(aside, outward)) / STEEPEST;
    }
    vec3s exit = glms_vec3_muladds(collar->direction, collar->exit_distance, collar->origin);
    float forth = glms_vec3_dot(glms_vec3_sub(exit, internode->axis_point), internode->along);
    vec3s centre = glms_vec3_muladds(internode->along, forth, internode->axis_point);
    vec3s out = across(glms_vec3_sub(exit, centre), internode->along);
    if (sine >= STEEPEST && below >= 0.0F && glms_vec3_norm(out) > 0.5F * radius) {
        outward = glms_vec3_normalize(out);
    }
    collar->exit = glms_vec3_muladds(outward, radius, centre);
    collar->outward = outward;
    collar->along = internode->along;
}

// The cosine between branch and surface normal, never quite tangential.
static float lift(const FrCollar *collar) {
    float cosine = glms_vec3_dot(collar->direction, collar->outward);
    return MAX(cosine, STEEPEST);
}

// True if the parent has `forth` metres of surface beyond the tip of `node` and `back` before it.
static bool parent_reaches(const FrPlan *plan, uint32_t node, float forth, float back) {
    const FrNodes *nodes = &plan->plant->nodes;
    int walk = 0;
    for (uint32_t next = fr_plan_next(plan, node);
         forth > 0.0F && next != FR_NONE && walk < WALK_MOST; walk++) {
        forth -= nodes->length[next];
        next = fr_plan_next(plan, next);
    }
    for (uint32_t at = node; back > 0.0F && at != FR_NONE && walk < 2 * WALK_MOST; walk++) {
        back -= nodes->length[at];
        at = node_before(plan, at);
    }
    return forth <= 0.0F && back <= 0.0F;
}

static bool is_point(const FrPlan *plan, uint32_t node) {
    const FrPlant *plant = plan->plant;
    return fr_plan_next(plan, node) == FR_NONE && (plan->marks[node] & FR_NODE_BLUNT) == 0 &&
           (plant->axes.flags[plant->nodes.axis[node]] & (FR_CUT | FR_POINT_SETS)) == 0;
}

// A branch at its parent's end, and the arm of a fork, go on from a ring within their parent.
static void nest(const FrPlan *plan, uint32_t node, const FrInternode *internode, float length,
                 bool is_fine, FrCollar *collar) {
    float radius = MIN(0.985F * collar->parent_radius, 1.5F * collar->radius);
    vec3s centre =
        glms_vec3_muladds(internode->along, -MAX(internode->beyond, 0.0F), internode->axis_point);
    vec3s facing = internode->along;
    float depth = is_point(plan, node) ? 2.2F * radius : 0.2F * radius;
    float forth = glms_vec3_dot(collar->direction, facing);
    if (forth < -0.5F) {
        // It turns back too far for that: a ring across itself, far enough down the parent.
        radius = MIN(collar->radius, 0.8F * collar->parent_radius);
        float sine = sqrtf(MAX(1.0F - forth * forth, 0.0F));
        centre = glms_vec3_muladds(facing, -1.2F * radius * sine, centre);
        facing = collar->direction;
        depth = 0.0F;
    }
    float least = fr_smallest_length(centre, collar->radius);
    radius = MAX(radius, least);
    float join = MIN(0.7F * (radius + collar->radius), 0.4F * length);
    collar->is_nested = true;
    collar->exit = glms_vec3_muladds(facing, -depth, centre);
    collar->along = facing;
    collar->parent_radius = radius;
    collar->exit_distance = 0.0F;
    collar->has_join = is_fine && join > 0.5F * collar->radius;
    collar->rings = collar->has_join && plan->detail.lod == 0 ? 3 : 1;
    collar->join = join;
    collar->clear = collar->has_join ? join + 0.3F * collar->radius : 0.5F * join;
}

FrCollar fr_collar_find(const FrPlan *plan, const FrTube *tube, uint32_t sides) {
    const FrPlant *plant = plan->plant;
    uint32_t node = plant->axes.bearer[tube->axis];
    FrCollar collar = {
        .origin = fr_tube_origin(plan, tube),
        .direction = fr_frame_heading(plant->nodes.frame[tube->first]),
        .radius = fr_tube_base_radius(plan, tube),
    };
    FrInternode internode = internode_at(plan, node, collar.origin);
    find_exit(plan, node, &internode, &collar);
    if (collar.exit_distance > plant->nodes.length[tube->first] && tube->first != tube->last) {
        // Bent before it comes out: seen from the origin it leaves in another direction.
        vec3s at;
        float radius;
        fr_tube_at(plan, tube, collar.exit_distance, &at, &radius);
        vec3s chord = glms_vec3_sub(at, collar.origin);
        if (glms_vec3_norm(chord) > 0.1F * collar.exit_distance) {
            collar.direction = glms_vec3_normalize(chord);
            find_exit(plan, node, &internode, &collar);
        }
    }
    float up = lift(&collar), radius = collar.radius;
    float slant = sqrtf(MAX(1.0F - up * up, 0.0F)) / up;
    float last_exit = MAX(collar.exit_distance + radius * slant, 0.0F);
    float blend = (0.35F + 0.65F * MIN(plan->detail.collar, 2.0F)) * radius;
    float length = length_up_to(plan, tube, 2.0F * (last_exit + blend + radius));

    float shift = glms_vec3_dot(glms_vec3_sub(collar.exit, internode.axis_point), internode.along);
    float half = radius * (1.0F + FR_COLLAR_FLARE * plan->detail.collar) / up +
                 collar.parent_radius * fabsf(glms_vec3_dot(collar.direction, collar.along)) / up;
    float forth = internode.beyond + shift + half, back = -(internode.beyond + shift - half);
    bool is_fine = sides > 5 && plan->detail.lod < 2;
    bool is_thicker = plant->axes.base_radius[tube->axis] > FR_THICKER * plant->nodes.radius[node];
    bool is_fork = (plant->axes.flags[tube->axis] & FR_FORK) != 0;
    if (is_fork || is_thicker || !parent_reaches(plan, node, forth, back) ||
        last_exit > 0.6F * length ||
        !(collar.parent_radius > fr_smallest_length(collar.origin, radius))) {
        nest(plan, node, &internode, length, is_fine, &collar);
        return collar;
    }
    collar.has_join = is_fine && last_exit + blend < 0.6F * length;
    collar.rings = collar.has_join && sides > 7 && plan->detail.lod == 0 ? 3 : 1;
    collar.join = last_exit + blend;
    collar.clear = collar.has_join ? collar.join + 0.5F * radius
                                   : MIN(last_exit + 0.5F * radius, 0.6F * length);
    return collar;
}

// ---- the parent as it is skinned ---------------------------------------------------------------

static struct FrLimbRing ring_of(const FrPlan *plan, uint32_t node) {
    const FrNodes *nodes = &plan->plant->nodes;
    return (struct FrLimbRing){
        .at = nodes->position[node],
        .radius = is_point(plan, node) ? 0.0F : nodes->radius[node],
    };
}

// The rings before the tip of `node`, nearest first; at least one.
static uint32_t gather_back(const FrPlan *plan, uint32_t node, float enough,
                            struct FrLimbRing *rings) {
    const FrPlant *plant = plan->plant;
    uint32_t count = 0;
    for (int walk = 0; count < FR_LIMB_MOST / 2 && walk <= WALK_MOST; walk++) {
        enough -= plant->nodes.length[node];
        uint32_t before = node_before(plan, node);
        if (before == FR_NONE) {
            uint32_t axis = plant->nodes.axis[node];
            rings[count++] = (struct FrLimbRing){.at = fr_plant_axis_origin(plant, axis),
                                                 .radius = plant->axes.base_radius[axis]};
            break;
        }
        node = before;
        if (plan->keep[node] || walk == WALK_MOST) {
            rings[count++] = ring_of(plan, node);
            if (enough <= 0.0F) {
                break;
            }
        }
    }
    return count;
}

// The rings from the tip of `node` on, after at least one in `rings[-1]`. A node may add two.
static uint32_t gather_forth(const FrPlan *plan, uint32_t node, float enough,
                             struct FrLimbRing *rings) {
    const FrNodes *nodes = &plan->plant->nodes;
    uint32_t count = 0;
    for (int walk = 0; count + 1 < FR_LIMB_MOST / 2 && walk <= WALK_MOST; walk++) {
        bool is_end = fr_plan_next(plan, node) == FR_NONE;
        if (plan->keep[node] == FR_KEEP_SHOULDER) {
            struct FrLimbRing *before = &rings[(int)count - 1];
            float part = fr_shoulder_part(before->at, nodes->position[node], nodes->radius[node]);
            vec3s step = glms_vec3_sub(nodes->position[node], before->at);
            rings[count++] = (struct FrLimbRing){
                .at = glms_vec3_muladds(step, part, before->at),
                .radius = before->radius + part * (nodes->radius[node] - before->radius)};
        }
        if (plan->keep[node] || is_end || walk == WALK_MOST) {
            rings[count++] = ring_of(plan, node);
            if (enough <= 0.0F || is_end) {
                break;
            }
        }
        node = fr_plan_next(plan, node);
        enough -= nodes->length[node];
    }
    return count;
}

static void measure_limb(FrLimb *limb, vec3s exit_axis) {
    struct FrLimbRing *rings = limb->rings;
    float nearest = INFINITY;
    rings[0].s = 0.0F;
    for (uint32_t i = 0; i + 1 < limb->count; i++) {
        vec3s step = glms_vec3_sub(rings[i + 1].at, rings[i].at);
        float length = glms_vec3_norm(step);
        rings[i + 1].s = rings[i].s + length;
        vec3s unit = glms_vec3_scale(step, length > 0.0F ? 1.0F / length : 0.0F);
        // Each end has the mean of the directions on both sides.
        rings[i].tangent = i == 0 ? unit : glms_vec3_add(rings[i].tangent, unit);
        rings[i + 1].tangent = unit;
        float along = glms_vec3_dot(glms_vec3_sub(exit_axis, rings[i].at), unit);
        along = MIN(MAX(along, 0.0F), length);
        float apart = glms_vec3_distance2(glms_vec3_muladds(unit, along, rings[i].at), exit_axis);
        if (apart < nearest) {
            nearest = apart;
            limb->exit = rings[i].s + along;
        }
    }
    for (uint32_t i = 0; i < limb->count; i++) {
        rings[i].tangent = glms_vec3_normalize(rings[i].tangent);
    }
}

void fr_limb_find(const FrPlan *plan, const FrTube *tube, const FrCollar *collar, FrLimb *limb) {
    const FrPlant *plant = plan->plant;
    uint32_t node = plant->axes.bearer[tube->axis];
    float enough = 2.0F * (collar->parent_radius + collar->radius) / lift(collar) +
                   glms_vec3_distance(collar->exit, plant->nodes.position[node]);
    struct FrLimbRing back[FR_LIMB_MOST / 2];
    uint32_t before = gather_back(plan, node, enough, back);
    for (uint32_t i = 0; i < before; i++) {
        limb->rings[i] = back[before - 1 - i];
    }
    limb->count = before + gather_forth(plan, node, enough, limb->rings + before);
    limb->node = node;
    limb->section = &plan->sections[plan->section[plant->nodes.axis[node]]];
    limb->exit = 0.0F;
    float half_side = (float)G_PI / (float)MAX(limb->section->count - 1, 3);
    limb->sink = 0.985F * (limb->section->is_round ? cosf(half_side) : 1.0F);
    vec3s exit_axis = glms_vec3_muladds(collar->outward, -collar->parent_radius, collar->exit);
    measure_limb(limb, exit_axis);
}

// Centre, direction and radius of the limb at s, as the bands between its rings have it.
static struct FrLimbRing limb_at(const FrLimb *limb, float s) {
    const struct FrLimbRing *rings = limb->rings;
    uint32_t i = 0;
    while (i + 2 < limb->count && rings[i + 1].s < s) {
        i++;
    }
    if (limb->count < 2) {
        return rings[0];
    }
    float length = rings[i + 1].s - rings[i].s;
    float part = length > 0.0F ? MIN(MAX((s - rings[i].s) / length, 0.0F), 1.0F) : 0.0F;
    struct FrLimbRing between = {.radius = rings[i].radius +
                                           part * (rings[i + 1].radius - rings[i].radius)};
    vec3s step = glms_vec3_sub(rings[i + 1].at, rings[i].at);
    between.at = glms_vec3_muladds(step, part, rings[i].at);
    vec3s a = rings[i].tangent, b = rings[i + 1].tangent;
    between.tangent = glms_vec3_normalize(glms_vec3_muladds(glms_vec3_sub(b, a), part, a));
    return between;
}

/// Where a column meets the parent, in the parent's coordinates.
typedef struct FrFootprint {
    float along;        ///< m from the exit
    float sine, cosine; ///< of the angle around the parent
    float distance;     ///< m along the branch
} FrFootprint;

static FrFootprint footprint(const FrCollar *collar, vec3s spoke) {
    vec3s sideways = glms_vec3_cross(collar->along, collar->outward);
    float up = lift(collar), forth = glms_vec3_dot(collar->direction, collar->along);
    float side = glms_vec3_dot(collar->direction, sideways);
    float slip = -glms_vec3_dot(spoke, collar->outward) / up;
    float sine = (glms_vec3_dot(spoke, sideways) + slip * side) / collar->parent_radius;
    sine = CLAMP(sine, -AROUND_MOST, AROUND_MOST);
    float cosine = sqrtf(1.0F - sine * sine);
    float drop = collar->parent_radius * (1.0F - cosine) / up;
    return (FrFootprint){
        .along = glms_vec3_dot(spoke, collar->along) + (slip - drop) * forth,
        .sine = sine,
        .cosine = cosine,
        .distance = collar->exit_distance + slip - drop,
    };
}

float fr_collar_distance(const FrCollar *collar, vec3s spoke) {
    return footprint(collar, spoke).distance;
}

void fr_collar_foot(const FrPlan *plan, const FrCollar *collar, const FrLimb *limb, vec3s spoke,
                    vec3s *position, vec3s *normal) {
    FrFootprint print = footprint(collar, spoke);
    struct FrLimbRing ring = limb_at(limb, limb->exit + print.along);
    vec3s out = across(collar->outward, ring.tangent);
    float length = glms_vec3_norm(out);
    out = length > 1e-3F ? glms_vec3_scale(out, 1.0F / length) : collar->outward;
    vec3s around = glms_vec3_cross(ring.tangent, out);
    *normal = glms_vec3_muladds(around, print.sine, glms_vec3_scale(out, print.cosine));
    float reach =
        ring.radius * limb->sink * reach_towards(plan->plant, limb->section, limb->node, *normal);
    float least = fr_smallest_length(ring.at, collar->radius);
    reach = MAX(reach, least);
    *position = glms_vec3_muladds(*normal, reach, ring.at);
}
