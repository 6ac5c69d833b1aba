#include "skin/piece.h"

#include "plant/shapes.h"

#include <cglm/struct.h>

#include <string.h>

enum { RUN_GRAIN = 32, PIECE_GRAIN = 2048 };

typedef struct Digesting {
    FrWood *wood;
    uint32_t *run_of;  // by axis
    uint32_t *ordinal; // by axis: of its run's
} Digesting;

// ---- wood --------------------------------------------------------------------------------------

static FrDigest digest_nodes(FrDigest digest, const FrPlan *plan, uint32_t first, uint32_t count) {
    const FrNodes *nodes = &plan->plant->nodes;
#define FR_ADD(column) digest = fr_digest(digest, &(column)[first], count * sizeof *(column))
    FR_ADD(nodes->position);
    FR_ADD(nodes->frame);
    FR_ADD(nodes->length);
    FR_ADD(nodes->radius);
    FR_ADD(nodes->flatness);
    FR_ADD(plan->marks);
#undef FR_ADD
    return digest;
}

static FrDigest digest_axis(FrDigest digest, const FrPlan *plan, uint32_t axis) {
    const FrPlant *plant = plan->plant;
    const FrAxes *axes = &plant->axes;
    vec3s origin = fr_plant_axis_origin(plant, axis);
    float sizes[] = {origin.x, origin.y, origin.z, axes->base_radius[axis], axes->flags[axis]};
    digest = fr_digest(digest, sizes, sizeof sizes);
    digest = fr_digest_both(digest, axes->path[axis]); // which turns its bark
    if (axes->profile[axis] < plant->profiles->len) {
        const FrProfile *profile = &g_array_index(plant->profiles, FrProfile, axes->profile[axis]);
        digest = fr_profile_digest(digest, profile);
    }
    const FrFinish *finish = fr_plan_finish(plan, axis);
    if (finish != NULL) {
        digest = fr_digest(digest, finish, sizeof *finish);
    }
    // Nodes mostly follow each other: one block, else several.
    for (uint32_t first = axes->first[axis]; first != FR_NONE;) {
        uint32_t count = 1;
        while (plant->nodes.next[first + count - 1] == first + count) {
            count++;
        }
        digest = digest_nodes(digest, plan, first, count);
        first = plant->nodes.next[first + count - 1];
    }
    return digest;
}

// What a tube adds to the nodes it is swept along: they may be of several tubes.
static FrDigest digest_tube(FrDigest digest, const FrPlan *plan, const FrTube *tube) {
    const FrAxes *axes = &plan->plant->axes;
    uint32_t base = axes->first[tube->axis];
    uint32_t numbers[] = {tube->start,
                          tube->end,
                          tube->is_point_sets,
                          plan->sections[tube->section].count,
                          tube->first - base,
                          tube->last - tube->first,
                          tube->from == FR_NONE ? FR_NONE : tube->from - base,
                          tube->rings};
    digest = fr_digest(digest, plan->tiles[tube->slot], sizeof plan->tiles[tube->slot]);
    return fr_digest(digest, numbers, sizeof numbers);
}

static void digest_runs(void *data, size_t begin, size_t end, int worker) {
    const Digesting *digesting = data;
    const FrPlan *plan = &digesting->wood->plan;
    (void)worker;
    for (size_t i = begin; i < end; i++) {
        const FrRun *run = &g_array_index(plan->runs, FrRun, i);
        const FrTube *tubes = &g_array_index(plan->tubes, FrTube, run->first_tube);
        FrDigest digest = 0;
        uint32_t ordinal = 0;
        for (uint32_t axis = tubes[0].axis; axis != FR_NONE; axis = plan->successor[axis]) {
            digest = digest_axis(digest, plan, axis);
            digesting->run_of[axis] = (uint32_t)i;
            digesting->ordinal[axis] = ordinal++;
        }
        for (uint32_t k = 0; k < run->tube_count; k++) {
            digest = digest_tube(digest, plan, &tubes[k]);
        }
        digesting->wood->digests[i] = digest;
    }
}

// Adds what the run stands on, which comes before it.
static void add_bearers(const Digesting *digesting) {
    const FrPlan *plan = &digesting->wood->plan;
    const FrPlant *plant = plan->plant;
    FrDigest *digests = digesting->wood->digests;
    for (uint32_t i = 0; i < plan->runs->len; i++) {
        const FrRun *run = &g_array_index(plan->runs, FrRun, i);
        const FrTube *tube = &g_array_index(plan->tubes, FrTube, run->first_tube);
        if (tube->start != FR_START_BRANCH) {
            continue;
        }
        uint32_t bearer = plant->axes.bearer[tube->axis], axis = plant->nodes.axis[bearer];
        uint64_t place[] = {digests[digesting->run_of[axis]], digesting->ordinal[axis],
                            bearer - plant->axes.first[axis]};
        digests[i] = fr_digest(digests[i], place, sizeof place);
    }
}

void fr_digest_wood(FrWood *wood) {
    const FrPlan *plan = &wood->plan;
    uint32_t axes = plan->plant->axes.count;
    Digesting digesting = {wood, g_new(uint32_t, axes + 1), g_new(uint32_t, axes + 1)};
    wood->digests = g_new(FrDigest, plan->runs->len + 1);
    fr_parallel_for(plan->context->pool, plan->runs->len, RUN_GRAIN, digest_runs, &digesting, NULL);
    add_bearers(&digesting);
    g_free(digesting.run_of);
    g_free(digesting.ordinal);
}

// ---- organs ------------------------------------------------------------------------------------

typedef struct Posing {
    const FrOrganPlan *organs;
    FrDigest *digests;
} Posing;

static void digest_poses(void *data, size_t begin, size_t end, int worker) {
    const Posing *posing = data;
    (void)worker;
    for (size_t i = begin; i < end; i++) {
        FrOrganPose pose = fr_piece_pose(posing->organs, (uint32_t)i);
        float numbers[] = {pose.at.x,       pose.at.y,       pose.at.z,       pose.scale,
                           pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w};
        uint64_t words[4];
        memcpy(words, numbers, sizeof words);
        uint32_t organ = posing->organs->pieces[i].organ;
        FrDigest digest =
            fr_digest_both(fr_digest_both(words[0], words[1]), fr_digest_both(words[2], words[3]));
        uint32_t shape = posing->organs->plan->plant->organs.shape[organ];
        if (posing->organs->shapes[shape].is_crown) {
            digest = fr_digest(digest, &posing->organs->crown, sizeof posing->organs->crown);
        }
        posing->digests[organ] = digest;
    }
}

FrDigest *fr_digest_poses(const FrOrganPlan *organs) {
    uint32_t count = organs->plan->plant->organs.count;
    Posing posing = {organs, g_atomic_rc_box_alloc(MAX(count, 1) * sizeof(FrDigest))};
    fr_parallel_for(organs->plan->context->pool, organs->piece_count, PIECE_GRAIN, digest_poses,
                    &posing, NULL);
    return posing.digests;
}

FrShapeDigest *fr_digest_shapes(const FrOrganPlan *organs) {
    FrShapeDigest *digests = g_new0(FrShapeDigest, organs->shape_count + 1);
    for (uint32_t i = 0; i < organs->shape_count; i++) {
        const FrShapeMesh *shape = &organs->shapes[i];
        if (shape->index_count > 0) {
            digests[i].vertices =
                fr_digest(0, shape->vertices, shape->vertex_count * sizeof *shape->vertices);
            digests[i].indices =
                fr_digest(0, shape->indices, shape->index_count * sizeof *shape->indices);
        }
    }
    return digests;
}
