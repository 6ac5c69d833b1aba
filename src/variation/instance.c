// Instances: one loop over the branches, from bearers to what they bear.
#include "plant/frames.h"
#include "variation/vary.h"

#include <cglm/struct.h>

#include <string.h>

typedef struct Growth {
    const FrVaryPlan *plan;
    const versors *rotation; ///< as the branches should grow
    FrPlant *instance;
    FrKey key;
} Growth;

/// a* · b
static versors between(versors a, versors b) {
    return fr_frame_step((versors){{-a.x, -a.y, -a.z, a.w}}, b);
}

/// Copies the rotations of an axis.
static void grow_straight(const Growth *growth, uint32_t first) {
    FrNodes *nodes = &growth->instance->nodes;
    for (uint32_t i = first; i != FR_NONE; i = nodes->next[i]) {
        nodes->rotation[i] = growth->rotation[i];
        fr_update_frame(nodes, &growth->instance->axes, i);
    }
}

/// Grows an axis by the controller. `wanted` is the frame that the joint should have, seen from the
/// first internode as it really stands.
static void grow_controlled(const Growth *growth, uint32_t axis, vec3s indicator, bool is_pushed) {
    const FrController *controller = &growth->plan->controller;
    FrPlant *plant = growth->instance;
    FrNodes *nodes = &plant->nodes;
    uint32_t i = plant->axes.first[axis];
    nodes->rotation[i] = growth->rotation[i];
    fr_update_frame(nodes, &plant->axes, i);
    versors wanted = nodes->frame[i];
    bool is_drawn = growth->plan->stroke[axis] != FR_NONE && controller->late > 0;
    FrControl control;
    FrKey path = plant->axes.path[axis];
    fr_control_begin(&control, fr_key_child(growth->key, path != 0 ? path : axis));
    for (uint32_t last = i; (i = nodes->next[last]) != FR_NONE; last = i) {
        vec3s drive = {{0, 0, 0}};
        vec3s before = is_drawn ? fr_frame_heading(wanted) : drive;
        wanted = fr_frame_step(wanted, growth->rotation[i]);
        if (is_drawn) {
            vec3s turn = fr_turn_between(before, fr_frame_heading(wanted));
            drive = glms_vec3_scale(turn, -controller->late);
        }
        if (is_pushed) {
            vec3s turn = fr_indicator_turn(fr_frame_heading(wanted), indicator);
            drive = glms_vec3_add(drive, glms_vec3_scale(turn, controller->gain));
        }
        vec3s error = fr_control_next(controller, &control, wanted, drive);
        versors frame = fr_frame_step(fr_rotation_of(error), wanted);
        nodes->rotation[i] = between(nodes->frame[last], frame);
        fr_update_frame(nodes, &plant->axes, i);
    }
}

static void grow(const Growth *growth) {
    const FrVaryPlan *plan = growth->plan;
    const FrAxes *axes = &growth->instance->axes;
    const FrController *controller = &plan->controller;
    for (uint32_t a = 0; a < axes->count; a++) {
        if (axes->first[a] == FR_NONE) {
            continue;
        }
        vec3s indicator = plan->indicator == NULL ? (vec3s){{0, 0, 0}} : plan->indicator[a];
        bool is_pushed = indicator.x != 0 || indicator.y != 0 || indicator.z != 0;
        bool is_drawn = plan->stroke[a] != FR_NONE && controller->late > 0;
        if (is_pushed || is_drawn || controller->start > 0) {
            grow_controlled(growth, a, indicator, is_pushed);
        } else {
            grow_straight(growth, axes->first[a]);
        }
    }
}

void fr_vary_into(const FrVaryPlan *plan, uint64_t seed, FrPlant *instance) {
    FR_ASSERT(instance != plan->base && instance->nodes.count == plan->base->nodes.count);
    Growth growth = {.plan = plan,
                     .rotation =
                         plan->rotation != NULL ? plan->rotation : plan->base->nodes.rotation,
                     .instance = instance,
                     .key = fr_key_root(seed)};
    grow(&growth);
}

FrPlant *fr_vary_instance(const FrVaryPlan *plan, uint64_t seed) {
    FrPlant *instance = fr_plant_copy(plan->base);
    fr_vary_into(plan, seed, instance);
    return instance;
}

typedef struct Collection {
    const FrVaryPlan *plan;
    uint64_t seed;
    FrPlant **instances;
    const FrContext *context;
    gint done; ///< atomic
    uint32_t count;
} Collection;

static void make_instances(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    Collection *collection = data;
    for (size_t i = begin; i < end; i++) {
        fr_vary_into(collection->plan, collection->seed + i, collection->instances[i]);
        gint done = g_atomic_int_add(&collection->done, 1) + 1;
        fr_progress_report(collection->context->progress, "vary", (double)done / collection->count);
    }
}

FrStatus fr_vary_collection(const FrVaryPlan *plan, uint64_t seed, uint32_t count,
                            const FrContext *context, FrPlant **instances) {
    memset(instances, 0, count * sizeof *instances);
    FrStatus status = fr_limit_check(count, context->limits.plants, "plants", "the collection",
                                     (FrSpan){0}, context->diags);
    uint64_t bytes = fr_count_multiply(count, fr_plant_bytes(plan->base));
    if (status == FR_OK) {
        status = fr_limit_check(bytes, context->limits.bytes, "bytes", "the collection",
                                (FrSpan){0}, context->diags);
    }
    if (status != FR_OK) {
        return status;
    }
    // Copying takes references to materials and sources and so happens here, in their order.
    for (uint32_t i = 0; i < count; i++) {
        instances[i] = fr_plant_copy(plan->base);
    }
    Collection collection = {plan, seed, instances, context, 0, count};
    fr_parallel_for(context->pool, count, 1, make_instances, &collection, context->progress);
    if (fr_progress_is_cancelled(context->progress)) {
        for (uint32_t i = 0; i < count; i++) {
            fr_plant_free(instances[i]);
            instances[i] = NULL;
        }
        return FR_CANCELLED;
    }
    return FR_OK;
}

FrDigest fr_vary_topology_digest(const FrPlant *plant) {
    const FrNodes *nodes = &plant->nodes;
    const FrAxes *axes = &plant->axes;
    const FrOrgans *organs = &plant->organs;
    FrDigest digest = fr_digest(0, &nodes->count, sizeof nodes->count);
#define ADD(table, column)                                                                         \
    digest = fr_digest(digest, (table)->column, (table)->count * sizeof *(table)->column)
    ADD(nodes, parent);
    ADD(nodes, next);
    ADD(nodes, axis);
    ADD(nodes, length);
    ADD(nodes, radius);
    ADD(nodes, flatness);
    ADD(nodes, flags);
    ADD(axes, bearer);
    ADD(axes, offset);
    ADD(axes, base_radius);
    ADD(axes, flags);
    ADD(axes, path);
    ADD(organs, node);
    ADD(organs, offset);
    ADD(organs, rotation);
    ADD(organs, scale);
    ADD(organs, shape);
#undef ADD
    // The angle at which a branch leaves its bearer.
    for (uint32_t a = 0; a < axes->count; a++) {
        if (axes->first[a] != FR_NONE) {
            digest = fr_digest(digest, &nodes->rotation[axes->first[a]], sizeof(versors));
        }
    }
    return digest;
}
