// Chooses where rings stand and counts what they make.
//
// A band of quads may span several internodes as long as it turns less than the wanted angle, cuts
// no corner visibly and meets every node's radius on its way. The radii are a swinging door: the
// slopes that satisfy all nodes so far form an interval that only shrinks, so one pass suffices.
#include "skin/cap.h"
#include "skin/collar.h"
#include "skin/plan.h"
#include "skin/took.h"

#include <cglm/struct.h>

#include <math.h>

typedef struct FrBand {
    uint32_t anchor; ///< node of its first ring; FR_NONE: the start of the tube
    vec3s heading;   ///< of its first internode
    float radius;    ///< of its first ring
    float length;    ///< so far
    float chord;     ///< greatest distance of a heading from the first
    float low, high; ///< slopes that meet all radii so far
} FrBand;

static FrBand band_at(uint32_t anchor, float radius) {
    return (FrBand){.anchor = anchor, .radius = radius, .low = -INFINITY, .high = INFINITY};
}

// Takes an internode into the band; false if it must begin a new one.
static bool extend(const FrDetail *detail, FrBand *band, float length, vec3s heading,
                   float radius) {
    FrBand next = *band;
    if (band->length <= 0.0F) {
        next.heading = heading;
    }
    next.length += length;
    next.chord = MAX(band->chord, glms_vec3_distance(next.heading, heading));
    float slope = next.length > 0.0F ? (radius - band->radius) / next.length : 0.0F;
    float sag = 0.25F * next.length * next.chord;
    float thick = MAX(radius, band->radius);
    if (band->length > 0.0F &&
        (next.chord > detail->bend_chord || sag > detail->sag_share * thick + detail->sag_length ||
         slope < band->low || slope > band->high)) {
        return false;
    }
    if (next.length > 0.0F) {
        float stem = detail->taper_stem * thick + detail->taper_length;
        float slack = MIN(detail->taper_twig * thick, stem) / next.length;
        next.low = MAX(band->low, slope - slack);
        next.high = MIN(band->high, slope + slack);
    }
    *band = next;
    return true;
}

// Marks the nodes of a tube where rings stand; answers how many, without start and end. False if
// the tube has no length.
static bool thin_out(FrPlan *plan, const FrTube *tube, const FrCollar *collar, float rough,
                     uint32_t *kept, FrBand *last_band) {
    const FrNodes *nodes = &plan->plant->nodes;
    float clear = collar != NULL ? collar->clear : 0.0F, along = 0.0F;
    FrBand band = band_at(FR_NONE, fr_tube_base_radius(plan, tube));
    uint32_t before = FR_NONE;
    *kept = 0;
    for (uint32_t node = tube->first;; node = fr_plan_next(plan, node)) {
        float length = nodes->length[node];
        vec3s heading = fr_frame_heading(nodes->frame[node]);
        // What is straight now may be bent when it is deformed: then every node has its ring.
        bool is_wanted = tube->scope != FR_NONE || along < rough ||
                         (before != FR_NONE && (plan->marks[before] & FR_NODE_RING) != 0);
        bool is_ended = is_wanted && band.length > 0.0F;
        if (is_ended || !extend(&plan->detail, &band, length, heading, nodes->radius[node])) {
            // `band.length` is positive, so there is a node before.
            float least = fr_smallest_length(nodes->position[before], nodes->radius[before]);
            bool is_too_near = band.length < least || along < clear;
            if (!is_too_near) {
                plan->keep[before] = FR_KEEP_RING;
                (*kept)++;
            }
            band = band_at(is_too_near ? band.anchor : before, nodes->radius[before]);
            extend(&plan->detail, &band, length, heading, nodes->radius[node]);
        }
        along += length;
        before = node;
        if (node == tube->last) {
            break;
        }
    }
    float least = fr_smallest_length(nodes->position[tube->last], nodes->radius[tube->last]);
    plan->keep[tube->last] = FR_KEEP_RING;
    if (along - clear < least) {
        return along >= least && collar != NULL;
    }
    if (band.length < least && band.anchor != FR_NONE) {
        plan->keep[band.anchor] = 0;
        (*kept)--;
    }
    *last_band = band;
    return true;
}

// The base and every node of an axis of point sets has a ring, but for those that coincide with the
// one before.
static void keep_point_sets(FrPlan *plan, FrTube *tube) {
    const FrNodes *nodes = &plan->plant->nodes;
    uint32_t rings = 1;
    vec3s at = fr_tube_origin(plan, tube);
    float radius = fr_tube_base_radius(plan, tube);
    for (uint32_t node = tube->first;; node = fr_plan_next(plan, node)) {
        float least = fr_smallest_length(nodes->position[node], 0.0F);
        bool is_same = glms_vec3_distance(nodes->position[node], at) < least &&
                       fabsf(nodes->radius[node] - radius) < least;
        plan->keep[node] = is_same ? 0 : FR_KEEP_RING;
        if (!is_same) {
            rings++;
            at = nodes->position[node];
            radius = nodes->radius[node];
        }
        if (node == tube->last) {
            break;
        }
    }
    tube->rings = rings < 2 ? 0 : rings;
}

// How far up a run ridges and relief want a ring at every node, m.
static float rough_length(const FrPlan *plan, const FrRun *run) {
    if (run->finish == FR_NONE) {
        return 0.0F;
    }
    const FrFinish *finish = &g_array_index(plan->plant->finishes, FrFinish, run->finish);
    const FrTube *first = &g_array_index(plan->tubes, FrTube, run->first_tube);
    float ridges = finish->buttress_height * fr_tube_base_radius(plan, first);
    return finish->relief > 0.0F && plan->detail.lod < FR_RELIEF_GONE ? INFINITY
           : finish->buttresses > 0 && plan->detail.lod < 3           ? ridges
                                                                      : 0.0F;
}

static void count_rings(FrPlan *plan, FrTube *tube, float rough) {
    const FrNodes *nodes = &plan->plant->nodes;
    uint32_t sides = plan->sections[tube->section].count - 1;
    FrCollar collar = {0};
    bool is_branch = tube->start == FR_START_BRANCH;
    if (is_branch) {
        collar = fr_collar_find(plan, tube, sides);
        tube->collar_rings = collar.rings;
        tube->has_join = collar.has_join;
        const FrFinish *finish = fr_plan_finish(plan, tube->axis);
        tube->is_welded = finish != NULL && finish->junction == FR_JUNCTION_WELDED &&
                          !collar.is_nested && collar.rings > 0 && plan->detail.lod < FR_WELD_GONE;
    }
    uint32_t kept = 0;
    FrBand band = band_at(FR_NONE, 0.0F);
    if (!thin_out(plan, tube, is_branch ? &collar : NULL, rough, &kept, &band)) {
        tube->rings = 0;
        return;
    }
    float tip = nodes->radius[tube->last];
    bool is_coarse = plan->detail.lod > 0 && sides < 6;
    tube->has_shoulder = tube->end == FR_END_POINT && tip > 0.35F * band.radius && !is_coarse &&
                         band.length > 4.0F * fr_smallest_length(nodes->position[tube->last], tip);
    if (tube->has_shoulder) {
        plan->keep[tube->last] = FR_KEEP_SHOULDER;
    }
    uint32_t start = is_branch ? tube->collar_rings + (tube->has_join ? 1U : 0U) : 1U;
    start = start == 0 ? 1 : start;
    tube->rings =
        start + kept + (tube->has_shoulder ? 1U : 0U) + (tube->end == FR_END_POINT ? 0U : 1U);
}

static void count_triangles(const FrPlan *plan, FrTube *tube) {
    tube->vertices = tube->indices = 0;
    if (tube->rings == 0) {
        return;
    }
    const FrSection *section = &plan->sections[tube->section];
    uint64_t columns = section->count, sides = columns - 1, rings = tube->rings;
    uint64_t triangles = 2 * sides * (rings - 1);
    tube->vertices = columns * rings;
    if (tube->end == FR_END_POINT) {
        tube->vertices += sides;
        triangles += sides;
    }
    tube->indices = 3 * triangles;
    if (plan->detail.caps && section->is_closed) {
        fr_count_ends(plan, tube);
    }
}

static void survey(const FrPlan *plan, const FrTube *tube, FrRun *run) {
    const FrNodes *nodes = &plan->plant->nodes;
    float base = fr_tube_base_radius(plan, tube);
    run->radius = MAX(run->radius, base);
    for (uint32_t node = tube->first;; node = fr_plan_next(plan, node)) {
        run->radius = MAX(run->radius, nodes->radius[node]);
        run->follows_frames = run->follows_frames || nodes->flatness[node] != 1.0F;
        if (node == tube->last) {
            return;
        }
    }
}

static uint32_t sides_for(const FrDetail *detail, float radius) {
    float wanted = (float)(2.0 * G_PI) * radius / detail->side_length + 0.5F;
    if (!(wanted > (float)detail->min_sides)) {
        return MIN(detail->min_sides, detail->max_sides);
    }
    return wanted < (float)detail->max_sides ? (uint32_t)wanted : detail->max_sides;
}

// Ridges and furrows need sides to show on.
static uint32_t rough_sides(const FrPlan *plan, const FrRun *run, uint32_t sides) {
    const FrFinish *finish = &g_array_index(plan->plant->finishes, FrFinish, run->finish);
    uint32_t most = plan->detail.max_sides;
    if (finish->relief > 0.0F && plan->detail.lod < FR_RELIEF_GONE) {
        sides = MAX(sides, MIN((uint32_t)(3.0F * finish->relief_count), most));
    }
    if (finish->buttresses > 0) {
        // A multiple, so that all ridges are alike.
        uint32_t each = MAX(MAX(sides, most) / finish->buttresses, 3U);
        sides = MIN(each * finish->buttresses, most);
    }
    return sides;
}

static void measure_run(FrPlan *plan, FrRun *run) {
    FrTube *tubes = &g_array_index(plan->tubes, FrTube, run->first_tube);
    uint32_t axis = tubes[0].axis, profile = plan->plant->axes.profile[axis];
    run->radius = 0.0F;
    run->follows_frames = fr_plan_profile(plan, profile) != NULL;
    for (uint32_t i = 0; i < run->tube_count; i++) {
        survey(plan, &tubes[i], run);
    }
    const FrSection *own = fr_plan_profile(plan, profile);
    if (own != NULL && !own->is_closed) {
        run->finish = FR_NONE; // a strip has no bark
    }
    uint32_t section =
        own != NULL ? plan->detail.max_sides + 1 + profile : sides_for(&plan->detail, run->radius);
    if (own == NULL && run->finish != FR_NONE) {
        section = rough_sides(plan, run, section);
    }
    float rough = rough_length(plan, run);
    for (uint32_t k = axis; k != FR_NONE; k = plan->successor[k]) {
        plan->section[k] = section;
    }
    for (uint32_t i = 0; i < run->tube_count; i++) {
        tubes[i].section = section;
        tubes[i].rings = 0;
        tubes[i].is_rough = run->finish != FR_NONE;
        if (run->radius > 1e-7F && isfinite(run->radius)) {
            if (tubes[i].is_point_sets) {
                keep_point_sets(plan, &tubes[i]);
            } else {
                count_rings(plan, &tubes[i], rough);
            }
        }
        count_triangles(plan, &tubes[i]);
    }
}

void fr_measure_runs(FrPlan *plan, size_t begin, size_t end) {
    FrTook group = fr_took_begin(plan, begin);
    for (size_t i = begin; i < end; i++) {
        measure_run(plan, &g_array_index(plan->runs, FrRun, i));
        fr_took_run(&group, i, true);
    }
    fr_took_end(&group);
}
