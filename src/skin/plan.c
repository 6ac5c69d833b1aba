// Finds the runs and tubes of a plant: which axes continue one another, what is visible, how each
// tube begins and ends.
#include "skin/plan.h"

#include <cglm/struct.h>

#include <math.h>

static float clamped(double value, double low, double high) {
    return (float)(value >= low ? (value <= high ? value : high) : low);
}

static uint32_t whole(double value, uint32_t low, uint32_t high) {
    return value >= low ? (value <= high ? (uint32_t)value : high) : low;
}

FrDetail fr_detail(const FrSkinParams *params) {
    int lod = (int)whole((double)params->lod, 0, 8);
    // A tube has as many triangles as sides times rings, so each shrinks by the root of 0.4. What a
    // chord misses grows with the square of its length.
    double coarser = 1.0;
    for (int i = 0; i < lod; i++) {
        coarser *= 1.0 / sqrt(0.4);
    }
    double bend = fmin(clamped(params->bend, 0.008, 1.58) * coarser, 2.0);
    uint32_t max_sides = whole((double)params->max_sides, 3, 128);
    uint32_t min_sides = whole((double)params->min_sides, 3, max_sides);
    double side_length = clamped(params->side_length, 0.0001, 10.0);
    return (FrDetail){
        .lod = lod,
        .bend_chord = (float)(2.0 * sin(0.5 * bend)),
        .sag_share = (float)(0.15 * coarser * coarser),
        .sag_length = (float)(0.05 * side_length * coarser * coarser),
        .taper_twig = (float)(0.05 * coarser * coarser),
        .taper_stem = (float)(0.004 * coarser * coarser),
        .taper_length = (float)(0.02 * side_length * coarser * coarser),
        .side_length = (float)(side_length * coarser),
        .min_sides = whole(floor((double)min_sides / coarser + 0.5), 3, max_sides),
        .max_sides = whole(floor((double)max_sides / coarser + 0.5), 3, max_sides),
        .collar = clamped(params->collar, 0.0, 4.0),
        .caps = params->caps,
        .foliage = params->foliage,
    };
}

// ---- what is visible ---------------------------------------------------------------------------

static bool any_flag(const uint16_t *flags, uint32_t count, uint16_t mask) {
    uint16_t all = 0;
    for (uint32_t i = 0; i < count; i++) {
        all = (uint16_t)(all | flags[i]);
    }
    return (all & mask) != 0;
}

static void mark_gone(FrPlan *plan) {
    const FrNodes *nodes = &plan->plant->nodes;
    const FrAxes *axes = &plan->plant->axes;
    if (!any_flag(nodes->flags, nodes->count, FR_SHED) &&
        !any_flag(axes->flags, axes->count, FR_SHED)) {
        return;
    }
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        bool is_shed = ((nodes->flags[i] | axes->flags[nodes->axis[i]]) & FR_SHED) != 0;
        if (is_shed || (parent != FR_NONE && (plan->marks[parent] & FR_NODE_GONE) != 0)) {
            plan->marks[i] |= FR_NODE_GONE;
        }
    }
}

static bool is_axis_drawn(const FrPlan *plan, uint32_t axis) {
    const FrAxes *axes = &plan->plant->axes;
    uint32_t bearer = axes->bearer[axis];
    return axes->first[axis] != FR_NONE && (axes->flags[axis] & (FR_SHED | FR_HIDDEN)) == 0 &&
           (bearer == FR_NONE || (plan->marks[bearer] & FR_NODE_GONE) == 0);
}

static bool is_node_drawn(const FrPlan *plan, uint32_t node) {
    const FrPlant *plant = plan->plant;
    return (plan->marks[node] & FR_NODE_GONE) == 0 &&
           (plant->nodes.flags[node] & (FR_SHED | FR_HIDDEN)) == 0 &&
           is_axis_drawn(plan, plant->nodes.axis[node]);
}

// ---- runs --------------------------------------------------------------------------------------

static bool continues(const FrPlan *plan, uint32_t axis) {
    const FrPlant *plant = plan->plant;
    const FrAxes *axes = &plant->axes;
    uint32_t bearer = axes->bearer[axis];
    if ((axes->flags[axis] & FR_CONTINUES) == 0 || bearer == FR_NONE ||
        !is_axis_drawn(plan, axis) || !is_node_drawn(plan, bearer)) {
        return false;
    }
    uint32_t parent = plant->nodes.axis[bearer];
    return parent < axis && axes->last[parent] == bearer && plan->successor[parent] == FR_NONE &&
           axes->profile[parent] == axes->profile[axis] &&
           ((axes->flags[parent] ^ axes->flags[axis]) & FR_POINT_SETS) == 0;
}

static void find_successors(FrPlan *plan) {
    const FrPlant *plant = plan->plant;
    const FrAxes *axes = &plant->axes;
    for (uint32_t k = 0; k < axes->count; k++) {
        plan->successor[k] = plan->before[k] = FR_NONE;
    }
    for (uint32_t k = 0; k < axes->count; k++) {
        uint32_t bearer = axes->bearer[k];
        if (continues(plan, k)) {
            uint32_t parent = plant->nodes.axis[bearer];
            plan->successor[parent] = k;
            plan->before[k] = parent;
        } else if (bearer != FR_NONE && is_axis_drawn(plan, k) &&
                   axes->base_radius[k] >= 0.3F * plant->nodes.radius[bearer]) {
            plan->marks[bearer] |= FR_NODE_BLUNT;
        }
    }
}

static void begin_tube(FrPlan *plan, uint32_t axis, uint32_t from, uint32_t first,
                       FrTubeStart start) {
    const FrAxes *axes = &plan->plant->axes;
    FrTube tube = {
        .axis = axis,
        .from = from,
        .first = first,
        .slot = fr_slot(axes->material[axis]),
        .scope = fr_plan_scope(plan, axes->deformer[axis]),
        .start = (uint8_t)start,
        .end = FR_END_FLAT,
        .is_point_sets = (axes->flags[axis] & FR_POINT_SETS) != 0,
    };
    const FrFinish *finish = fr_plan_finish(plan, axis);
    tube.is_open = finish != NULL && finish->is_open != 0;
    g_array_append_val(plan->tubes, tube);
}

static FrTubeStart start_of_axis(const FrPlan *plan, uint32_t axis) {
    const FrPlant *plant = plan->plant;
    uint32_t bearer = plant->axes.bearer[axis];
    const FrFinish *finish = fr_plan_finish(plan, axis);
    bool is_plain = finish != NULL && finish->junction == FR_JUNCTION_PLAIN;
    if (bearer == FR_NONE || !is_node_drawn(plan, bearer) || is_plain ||
        (plant->axes.flags[axis] & FR_POINT_SETS) != 0) {
        return FR_START_FREE;
    }
    const FrSection *of_parent =
        fr_plan_profile(plan, plant->axes.profile[plant->nodes.axis[bearer]]);
    const FrSection *own = fr_plan_profile(plan, plant->axes.profile[axis]);
    bool is_strip =
        (of_parent != NULL && !of_parent->is_closed) || (own != NULL && !own->is_closed);
    // What is much thicker than its parent can neither sit on its surface nor begin within it.
    bool is_thicker = plant->nodes.next[bearer] != FR_NONE &&
                      plant->axes.base_radius[axis] > FR_THICKER * plant->nodes.radius[bearer];
    return is_strip || is_thicker ? FR_START_FREE : FR_START_BRANCH;
}

// Adds the nodes first … last of `axis` to the open tube, or begins another.
static bool add_span(FrPlan *plan, uint32_t axis, uint32_t from, uint32_t first, uint32_t last,
                     bool is_open) {
    FrTube *open = is_open ? &g_array_index(plan->tubes, FrTube, plan->tubes->len - 1) : NULL;
    if (open == NULL || open->slot != fr_slot(plan->plant->axes.material[axis]) ||
        open->scope != fr_plan_scope(plan, plan->plant->axes.deformer[axis])) {
        FrTubeStart start = open != NULL      ? FR_START_JOINT
                            : from == FR_NONE ? start_of_axis(plan, axis)
                                              : FR_START_FREE;
        if (open != NULL) {
            open->end = FR_END_OPEN;
            from = open->last;
        }
        begin_tube(plan, axis, from, first, start);
        open = &g_array_index(plan->tubes, FrTube, plan->tubes->len - 1);
    }
    open->last = last;
    return true;
}

static bool add_axis(FrPlan *plan, uint32_t axis, bool has_marks, bool is_open) {
    const FrPlant *plant = plan->plant;
    uint32_t first = plant->axes.first[axis], last = plant->axes.last[axis];
    if (!has_marks) {
        return add_span(plan, axis, FR_NONE, first, last, is_open);
    }
    uint32_t from = FR_NONE;
    for (uint32_t node = first; node != FR_NONE; node = plant->nodes.next[node]) {
        is_open = is_node_drawn(plan, node) && add_span(plan, axis, from, node, node, is_open);
        from = node;
    }
    return is_open;
}

// A last tube whose run ends visibly ends as its axis says; all others stay flat.
static void set_end(FrPlan *plan, uint32_t axis) {
    const FrPlant *plant = plan->plant;
    FrTube *tube = &g_array_index(plan->tubes, FrTube, plan->tubes->len - 1);
    const FrSection *section = fr_plan_profile(plan, plant->axes.profile[axis]);
    bool is_flat = (plant->axes.flags[axis] & (FR_CUT | FR_POINT_SETS)) != 0 ||
                   (plan->marks[tube->last] & FR_NODE_BLUNT) != 0 ||
                   (section != NULL && !section->is_closed);
    const FrFinish *finish = fr_plan_finish(plan, axis);
    if (!is_flat) {
        tube->end = FR_END_POINT;
    } else if (finish != NULL && !tube->is_point_sets) {
        tube->cap = (uint8_t)finish->cap;
        tube->cap_height = finish->cap_height;
        tube->face = finish->face < plan->slots && finish->face != tube->slot ? finish->face : 0;
        tube->wall = finish->cap != FR_CAP_ROUND ? finish->wall : 0.0F;
    }
}

static void find_runs(FrPlan *plan) {
    const FrPlant *plant = plan->plant;
    bool has_marks = any_flag(plant->nodes.flags, plant->nodes.count, FR_SHED | FR_HIDDEN) ||
                     any_flag(plant->axes.flags, plant->axes.count, FR_SHED);
    for (uint32_t k = 0; k < plant->axes.count; k++) {
        if (plan->before[k] != FR_NONE || !is_axis_drawn(plan, k)) {
            continue;
        }
        FrRun run = {.first_tube = plan->tubes->len, .finish = FR_NONE};
        const FrFinish *finish = fr_plan_finish(plan, k);
        if (finish != NULL && (finish->buttresses > 0 || finish->relief > 0.0F)) {
            run.finish = plant->axes.finish[k];
        }
        bool is_open = false;
        uint32_t end = k;
        for (uint32_t axis = k; axis != FR_NONE; axis = plan->successor[axis]) {
            is_open = add_axis(plan, axis, has_marks, is_open);
            end = axis;
        }
        run.tube_count = plan->tubes->len - run.first_tube;
        if (is_open) {
            set_end(plan, end);
        }
        if (run.tube_count > 0) {
            g_array_append_val(plan->runs, run);
        }
    }
}

// A hole for a welded branch lies between the rings next to it.
static void mark_welds(FrPlan *plan) {
    const FrPlant *plant = plan->plant;
    if (plan->detail.lod >= FR_WELD_GONE) {
        return;
    }
    for (uint32_t k = 0; k < plant->axes.count; k++) {
        const FrFinish *finish = fr_plan_finish(plan, k);
        uint32_t bearer = plant->axes.bearer[k];
        if (bearer == FR_NONE || finish == NULL || finish->junction != FR_JUNCTION_WELDED) {
            continue;
        }
        uint32_t before = plant->nodes.parent[bearer], after = plant->nodes.next[bearer];
        plan->marks[bearer] |= FR_NODE_RING;
        if (before != FR_NONE) {
            plan->marks[before] |= FR_NODE_RING;
        }
        if (after != FR_NONE) {
            plan->marks[after] |= FR_NODE_RING;
        }
    }
}

// ---- tables ------------------------------------------------------------------------------------

static void make_sections(FrPlan *plan) {
    uint32_t round = plan->detail.max_sides + 1;
    plan->section_count = round + plan->plant->profiles->len;
    plan->sections = g_new0(FrSection, plan->section_count);
    for (uint32_t sides = 3; sides < round; sides++) {
        fr_section_round(&plan->sections[sides], sides);
    }
    bool *is_used = g_new0(bool, plan->plant->profiles->len + 1);
    for (uint32_t k = 0; k < plan->plant->axes.count; k++) {
        uint32_t profile = plan->plant->axes.profile[k];
        if (profile < plan->plant->profiles->len) {
            is_used[profile] = true;
        }
    }
    for (uint32_t i = 0; i < plan->plant->profiles->len; i++) {
        if (is_used[i]) {
            const FrProfile *profile = &g_array_index(plan->plant->profiles, FrProfile, i);
            fr_section_profile(&plan->sections[round + i], profile);
        }
    }
    g_free(is_used);
}

static void read_tiles(FrPlan *plan) {
    plan->slots = plan->plant->materials->len + 1;
    plan->tiles = g_malloc_n(plan->slots, sizeof *plan->tiles);
    plan->tiles[0][0] = plan->tiles[0][1] = 0.5F;
    for (uint32_t i = 1; i < plan->slots; i++) {
        const FrMaterial *material = g_ptr_array_index(plan->plant->materials, i - 1);
        const FrMaterialParams *params = fr_material_params(material);
        plan->tiles[i][0] = clamped(params->tile_width, 0.001, 100.0);
        plan->tiles[i][1] = clamped(params->tile_height, 0.001, 100.0);
    }
}

void fr_plan_init(FrPlan *plan, const FrPlant *plant, const FrScopes *scopes,
                  const FrSkinParams *params, const FrContext *context) {
    *plan = (FrPlan){
        .plant = plant,
        .context = context,
        .scopes = scopes,
        .detail = fr_detail(params),
        .successor = g_new(uint32_t, plant->axes.count),
        .before = g_new(uint32_t, plant->axes.count),
        .marks = g_new0(uint8_t, plant->nodes.count),
        .keep = g_new0(uint8_t, plant->nodes.count),
        .section = g_new0(uint32_t, plant->axes.count),
        .runs = g_array_new(FALSE, FALSE, sizeof(FrRun)),
        .tubes = g_array_new(FALSE, FALSE, sizeof(FrTube)),
    };
    make_sections(plan);
    read_tiles(plan);
    mark_gone(plan);
    find_successors(plan);
    mark_welds(plan);
    find_runs(plan);
}

void fr_plan_clear(FrPlan *plan) {
    for (uint32_t i = 0; i < plan->section_count; i++) {
        fr_section_clear(&plan->sections[i]);
    }
    g_free(plan->sections);
    g_free(plan->successor);
    g_free(plan->before);
    g_free(plan->marks);
    g_free(plan->keep);
    g_free(plan->section);
    g_free(plan->tiles);
    g_array_free(plan->runs, TRUE);
    g_array_free(plan->tubes, TRUE);
    g_free(plan->took);
}

vec3s fr_tube_origin(const FrPlan *plan, const FrTube *tube) {
    return tube->from == FR_NONE ? fr_plant_axis_origin(plan->plant, tube->axis)
                                 : plan->plant->nodes.position[tube->from];
}

float fr_tube_base_radius(const FrPlan *plan, const FrTube *tube) {
    return tube->from == FR_NONE ? plan->plant->axes.base_radius[tube->axis]
                                 : plan->plant->nodes.radius[tube->from];
}

const FrFinish *fr_plan_finish(const FrPlan *plan, uint32_t axis) {
    uint32_t finish = plan->plant->axes.finish[axis];
    return finish != FR_NONE ? &g_array_index(plan->plant->finishes, FrFinish, finish) : NULL;
}

const FrSection *fr_plan_profile(const FrPlan *plan, uint32_t profile) {
    if (profile == FR_NONE) {
        return NULL;
    }
    const FrSection *section = &plan->sections[plan->detail.max_sides + 1 + profile];
    return section->columns != NULL ? section : NULL;
}

float fr_shoulder_part(vec3s from, vec3s tip, float radius) {
    float length = glms_vec3_distance(from, tip);
    return length > 0.0F ? 1.0F - fminf(2.0F * radius / length, 0.5F) : 0.5F;
}
