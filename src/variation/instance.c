// Instances: one loop over the branches, from bearers to what they bear.
#include "variation/vary.h"

#include "plant/frames.h"

#include <cglm/struct.h>

#include <string.h>

typedef struct Growth {
    const FrVaryPlan *plan;
    const versors *rotation; ///< as the branches should grow
    FrPlant *instance;
    FrKey key;
} Growth;

/// Branches that do not bear each other, walked abreast.
typedef struct Abreast {
    uint32_t axis[FR_LANES];
    uint32_t count;
    bool is_pushed, is_drawn; ///< any of them
} Abreast;

static bool is_drawn(const Growth *growth, uint32_t axis) {
    return growth->plan->stroke[axis] != FR_NONE && growth->plan->controller.late > 0;
}

static bool is_pushed(const Growth *growth, uint32_t axis) {
    return growth->plan->indicator != NULL && glms_vec3_norm2(growth->plan->indicator[axis]) > 0;
}

/// Copies the rotations of an axis and brings its cache up to date.
static void grow_straight(const Growth *growth, uint32_t axis) {
    FrNodes *nodes = &growth->instance->nodes;
    const FrAxes *axes = &growth->instance->axes;
    for (uint32_t i = axes->first[axis]; i != FR_NONE; i = nodes->next[i]) {
        nodes->rotation[i] = growth->rotation[i];
        fr_update_frame(nodes, axes, i);
    }
}

/// Makes the first internodes, which stay as they are, and hands out their frames. An unused lane
/// repeats the first.
static FrLanes4 begin_abreast(const Growth *growth, const Abreast *abreast, FrControl *control,
                              FrLanes3 *indicator, uint32_t node[FR_LANES]) {
    FrPlant *plant = growth->instance;
    for (uint32_t k = 0; k < FR_LANES; k++) {
        uint32_t axis = abreast->axis[k < abreast->count ? k : 0];
        uint32_t first = node[k] = plant->axes.first[axis];
        plant->nodes.rotation[first] = growth->rotation[first];
        fr_update_frame(&plant->nodes, &plant->axes, first);
        FrKey path = plant->axes.path[axis];
        control->key[k] = fr_key_child(growth->key, path != 0 ? path : axis);
        if (is_pushed(growth, axis)) {
            vec3s push = growth->plan->indicator[axis];
            indicator->x[k] = push.x;
            indicator->y[k] = push.y;
            indicator->z[k] = push.z;
        }
    }
    return fr_lanes4_gather(plant->nodes.frame, node);
}

/// Goes on to the next internodes; false where all have ended. One that has ended stays.
static bool go_on(const FrNodes *nodes, uint32_t count, uint32_t node[FR_LANES],
                  bool is_on[FR_LANES]) {
    bool is_any = false;
    for (uint32_t k = 0; k < FR_LANES; k++) {
        uint32_t next = nodes->next[node[k]];
        is_on[k] = k < count && next != FR_NONE;
        node[k] = next != FR_NONE ? next : node[k];
        is_any |= is_on[k];
    }
    return is_any;
}

/// Grows axes by the controller. `wanted` are the frames that joints should have, seen from the
/// first internodes as they really stand.
FR_LANES_CLONES static void grow_abreast(const Growth *growth, const Abreast *abreast) {
    const FrController *controller = &growth->plan->controller;
    FrNodes *nodes = &growth->instance->nodes;
    uint32_t node[FR_LANES];
    bool is_on[FR_LANES];
    FrControl control = {0};
    FrLanes3 indicator = {0};
    FrLanes4 wanted = begin_abreast(growth, abreast, &control, &indicator, node);
    FrLanes late = {0};
    for (uint32_t k = 0; k < abreast->count; k++) {
        late[k] = is_drawn(growth, abreast->axis[k]) ? controller->late : 0;
    }
    FrLanes4 frame = wanted;
    FrLanes3 tip = fr_lanes3_gather(nodes->position, node);
    while (go_on(nodes, abreast->count, node, is_on)) {
        FrLanes3 drive = {0};
        FrLanes4 rotation = fr_lanes4_gather(growth->rotation, node);
        FrLanes4 before = wanted;
        wanted = fr_lanes_frame_step(wanted, rotation);
        if (abreast->is_drawn) {
            FrLanes3 turn = fr_turn_between(fr_lanes_heading(before), fr_lanes_heading(wanted));
            drive = fr_lanes3_scale(turn, -late);
        }
        if (abreast->is_pushed) {
            FrLanes3 turn = fr_indicator_turn(fr_lanes_heading(wanted), indicator);
            FrLanes gain = controller->gain - (FrLanes){0};
            drive = fr_lanes3_add(drive, fr_lanes3_scale(turn, gain));
        }
        if (controller->start > 0) {
            fr_control_draw(controller, &control, wanted);
        }
        FrLanes3 error = fr_control_next(controller, &control, drive);
        FrLanes4 back = {-frame.x, -frame.y, -frame.z, frame.w};
        FrLanes4 turned = fr_lanes_frame_step(fr_rotation_of(error), wanted);
        rotation = fr_lanes_frame_step(back, turned);
        // Now as fr_update_frame() does it, to the bit.
        frame = fr_lanes_frame_step(frame, rotation);
        FrLanes length = fr_lanes_gather(nodes->length, node);
        tip = fr_lanes3_add(tip, fr_lanes3_scale(fr_lanes_heading(frame), length));
        fr_lanes4_scatter(nodes->rotation, node, rotation, is_on);
        fr_lanes4_scatter(nodes->frame, node, frame, is_on);
        fr_lanes3_scatter(nodes->position, node, tip, is_on);
    }
}

static void grow_waiting(const Growth *growth, Abreast *abreast) {
    if (abreast->count > 0) {
        grow_abreast(growth, abreast);
        *abreast = (Abreast){.count = 0};
    }
}

/// Whether the axis is borne by one of those that wait.
static bool is_borne(const FrPlant *plant, const Abreast *abreast, uint32_t axis) {
    uint32_t bearer = plant->axes.bearer[axis];
    bool is_borne = false;
    for (uint32_t k = 0; k < abreast->count && bearer != FR_NONE; k++) {
        is_borne |= plant->nodes.axis[bearer] == abreast->axis[k];
    }
    return is_borne;
}

static void grow(const Growth *growth) {
    FrPlant *plant = growth->instance;
    Abreast waiting = {.count = 0};
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (plant->axes.first[a] == FR_NONE) {
            continue;
        }
        if (is_borne(plant, &waiting, a)) {
            grow_waiting(growth, &waiting);
        }
        bool has_push = is_pushed(growth, a), has_stroke = is_drawn(growth, a);
        if (!has_push && !has_stroke && !(growth->plan->controller.start > 0)) {
            grow_straight(growth, a);
            continue;
        }
        waiting.axis[waiting.count++] = a;
        waiting.is_pushed |= has_push;
        waiting.is_drawn |= has_stroke;
        if (waiting.count == FR_LANES) {
            grow_waiting(growth, &waiting);
        }
    }
    grow_waiting(growth, &waiting);
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
