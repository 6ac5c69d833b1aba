// Instances: one loop over the branches, from bearers to what they bear.
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

/// Copies the rotations of an axis. Like grow_controlled() it leaves in `frame` where the
/// internodes point, for what they bear; positions come last, for the whole plant.
static void grow_straight(const Growth *growth, uint32_t axis, versors frame) {
    FrNodes *nodes = &growth->instance->nodes;
    for (uint32_t i = growth->instance->axes.first[axis]; i != FR_NONE; i = nodes->next[i]) {
        nodes->rotation[i] = growth->rotation[i];
        frame = fr_frame_step(frame, growth->rotation[i]);
        nodes->frame[i] = frame;
    }
}

/// Grows an axis by the controller. `wanted` is the frame that a joint should have, seen from the
/// first internode as it really stands.
static void grow_controlled(const Growth *growth, uint32_t axis, versors bearer, vec3s indicator) {
    const FrController *controller = &growth->plan->controller;
    FrPlant *plant = growth->instance;
    FrNodes *nodes = &plant->nodes;
    bool is_pushed = indicator.x != 0 || indicator.y != 0 || indicator.z != 0;
    bool is_drawn = growth->plan->stroke[axis] != FR_NONE && controller->late > 0;
    uint32_t i = plant->axes.first[axis];
    nodes->rotation[i] = growth->rotation[i];
    versors wanted = fr_frame_step(bearer, growth->rotation[i]);
    versors last = wanted;
    nodes->frame[i] = wanted;
    FrControl control;
    FrKey path = plant->axes.path[axis];
    fr_control_begin(&control, fr_key_child(growth->key, path != 0 ? path : axis));
    while ((i = nodes->next[i]) != FR_NONE) {
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
        if (controller->start > 0) {
            fr_control_draw(controller, &control, wanted);
        }
        vec4s error = fr_control_next(controller, &control, glms_vec4(drive, 0));
        versors frame = fr_frame_step(fr_rotation_of(error), wanted);
        nodes->rotation[i] = between(last, frame);
        nodes->frame[i] = frame;
        last = frame;
    }
}

static void grow(const Growth *growth) {
    static const versors ground = {{0, 0, 0, 1}};
    const FrVaryPlan *plan = growth->plan;
    const FrAxes *axes = &growth->instance->axes;
    const FrController *controller = &plan->controller;
    for (uint32_t a = 0; a < axes->count; a++) {
        if (axes->first[a] == FR_NONE) {
            continue;
        }
        versors bearer =
            axes->bearer[a] == FR_NONE ? ground : growth->instance->nodes.frame[axes->bearer[a]];
        vec3s indicator = plan->indicator == NULL ? (vec3s){{0, 0, 0}} : plan->indicator[a];
        bool is_pushed = glms_vec3_norm2(indicator) > 0;
        bool is_drawn = plan->stroke[a] != FR_NONE && controller->late > 0;
        if (is_pushed || is_drawn || controller->start > 0) {
            grow_controlled(growth, a, bearer, indicator);
        } else {
            grow_straight(growth, a, bearer);
        }
    }
    fr_plant_update_frames(growth->instance, 0);
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
