// Segments become internodes: a segment where the last one ended continues its axis, also behind
// branches; behind `[` and behind a jump begins a new one. What the turtle knows is written at
// once, in the plant's coordinates; frames follow a block at a time, while its rows are still in
// the nearest cache, eight abreast.
#include "lsystem/split.h"

#include "math/lanes.h"
#include "plant/columns.h"

#include <cglm/struct.h>

#define NODE(field) (1U << FR_NODE_AT_##field)
#define AXIS(field) (1U << FR_AXIS_AT_##field)
/// Columns of which every row is written here.
#define OWN_NODES                                                                                  \
    (NODE(parent) | NODE(axis) | NODE(rotation) | NODE(length) | NODE(radius) | NODE(position) |   \
     NODE(frame))
#define OWN_AXES                                                                                   \
    (AXIS(first) | AXIS(last) | AXIS(bearer) | AXIS(base_radius) | AXIS(profile) |                 \
     AXIS(material) | AXIS(component) | AXIS(path))

// ---- frames -----------------------------------------------------------------------------------

static inline FrLanes4 select4(FrLaneMask mask, FrLanes4 yes, FrLanes4 no) {
    return (FrLanes4){fr_lanes_select(mask, yes.x, no.x), fr_lanes_select(mask, yes.y, no.y),
                      fr_lanes_select(mask, yes.z, no.z), fr_lanes_select(mask, yes.w, no.w)};
}

// Shepperd's method (1978): the largest component first. z is the heading, x the left.
static inline FrLanes4 frame_of(FrLanes3 z, FrLanes3 x) {
    FrLanes3 y = fr_lanes3_cross(z, x);
    FrLanes trace = x.x + y.y + z.z;
    FrLanes4 by_w = {y.z - z.y, z.x - x.z, x.y - y.x, trace + 1};
    FrLanes4 by_x = {1 + x.x - y.y - z.z, y.x + x.y, z.x + x.z, y.z - z.y};
    FrLanes4 by_y = {y.x + x.y, 1 + y.y - x.x - z.z, z.y + y.z, z.x - x.z};
    FrLanes4 by_z = {z.x + x.z, z.y + y.z, 1 + z.z - x.x - y.y, x.y - y.x};
    FrLanes4 q = select4((x.x > y.y) & (x.x > z.z), by_x, select4(y.y > z.z, by_y, by_z));
    q = select4(trace > 0, by_w, q);
    FrLanes square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    FrLaneMask is_some = square > 0;
    FrLanes scale = 1 / fr_lanes_sqrt(square), none = {0};
    FrLanes4 unit = {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
    return select4(is_some, unit, (FrLanes4){none, none, none, 1 + none});
}

/// conj(a)·b
static inline FrLanes4 between(FrLanes4 a, FrLanes4 b) {
    return (FrLanes4){a.w * b.x - a.x * b.w - (a.y * b.z - a.z * b.y),
                      a.w * b.y - a.y * b.w - (a.z * b.x - a.x * b.z),
                      a.w * b.z - a.z * b.w - (a.x * b.y - a.y * b.x),
                      a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z};
}

static inline void write_rows(versors *to, FrLanes4 lanes, uint32_t count) {
    FrRow rows[FR_LANES];
    fr_lanes4_rows(lanes, rows);
    if (count == FR_LANES) {
        memcpy(to, rows, sizeof rows);
    } else {
        memcpy(to, rows, count * sizeof *to);
    }
}

FR_LANES_CLONES
versors fr_lbuilder_frame(const double heading[3], const double left[3]) {
    vec3s z = fr_lturtle_world(heading), x = fr_lturtle_world(left);
    FrLanes none = {0}; // subtracted, it keeps also the sign of a zero
    versors frame;
    write_rows(&frame,
               frame_of((FrLanes3){z.x - none, z.y - none, z.z - none},
                        (FrLanes3){x.x - none, x.y - none, x.z - none}),
               1);
    return frame;
}

FR_LANES_CLONES
void fr_lbuilder_settle_frames(FrLbuilder *builder) {
    FrNodes *nodes = &builder->plant->nodes;
    uint32_t first = builder->framed, count = builder->nodes - first;
    for (uint32_t i = 0; i < count; i += FR_LANES) {
        FrLanes axes[6];
        for (int k = 0; k < 6; k++) {
            memcpy(&axes[k], &builder->waiting[k][i], sizeof axes[k]);
        }
        FrLanes4 frames =
            frame_of((FrLanes3){axes[0], axes[1], axes[2]}, (FrLanes3){axes[3], axes[4], axes[5]});
        uint32_t some = MIN(FR_LANES, count - i), bearer[FR_LANES];
        write_rows(nodes->frame + first + i, frames, some);
        FrLaneBits parents = {0};
        memcpy(&parents, nodes->parent + first + i, some * sizeof *bearer);
        // In place of none and of those that another part writes: one that is there.
        FrLaneMask is_borne = (FrLaneMask)((parents != FR_NONE) & (parents >= builder->first_node));
        parents = (parents & (FrLaneBits)is_borne) | (first & ~(FrLaneBits)is_borne);
        memcpy(bearer, &parents, sizeof bearer);
        FrLanes4 turned = between(fr_lanes4_gather(nodes->frame, bearer), frames);
        write_rows(nodes->rotation + first + i, select4(is_borne, turned, frames), some);
    }
    builder->framed = builder->nodes;
}

/// The rotation of one node from its parent, of which both frames are known.
FR_LANES_CLONES
static void turn_from(FrNodes *nodes, uint32_t parent, uint32_t node) {
    uint32_t from[FR_LANES], to[FR_LANES];
    for (int k = 0; k < FR_LANES; k++) {
        from[k] = parent;
        to[k] = node;
    }
    write_rows(nodes->rotation + node,
               between(fr_lanes4_gather(nodes->frame, from), fr_lanes4_gather(nodes->frame, to)),
               1);
}

// ---- rows -------------------------------------------------------------------------------------

/// Room for one more node; false after a failure.
static bool grow_nodes(FrLbuilder *builder, uint32_t maker, uint64_t module) {
    builder->maker = maker;
    builder->module = module;
    fr_lbuilder_settle_frames(builder);
    if (builder->part != NULL) {
        uint32_t count = MIN(builder->part->end_node - builder->nodes, FR_LBLOCK);
        fr_columns_fill(&builder->plant->nodes, &fr_node_columns, builder->nodes, count, OWN_NODES);
        builder->node_room += count;
        FR_ASSERT(count > 0); // they were counted
        return true;
    }
    uint64_t most = MIN(builder->context->limits.nodes, FR_NONE - UINT64_C(1));
    FrStatus status =
        fr_lbuilder_limit(builder, builder->nodes + UINT64_C(1), most, "nodes", "the string");
    if (status != FR_OK) {
        builder->status = status;
        return false;
    }
    fr_columns_append_but(&builder->plant->nodes, &fr_node_columns,
                          (uint32_t)MIN(most - builder->nodes, FR_LBLOCK), OWN_NODES);
    builder->node_room = builder->plant->nodes.count;
    return true;
}

static void grow_axes(FrLbuilder *builder) {
    FrAxes *axes = &builder->plant->axes;
    if (builder->part != NULL) {
        uint32_t count = MIN(builder->part->end_axis - builder->axes, FR_LBLOCK);
        FR_ASSERT(count > 0);
        fr_columns_fill(axes, &fr_axis_columns, builder->axes, count, OWN_AXES);
        builder->axis_room += count;
    } else {
        // There are never more than nodes.
        fr_columns_append_but(axes, &fr_axis_columns, FR_LBLOCK, OWN_AXES);
        builder->axis_room = axes->count;
    }
}

uint32_t fr_lbuilder_painted(FrLbuilder *builder, int32_t colour, uint32_t otherwise) {
    FrMaterial *material = builder->palette == NULL ? NULL : builder->palette[colour & 255];
    return material == NULL ? otherwise : fr_plant_add_material(builder->plant, material);
}

/// Tells the plant what made something: the production whose successor its module was in, or the
/// axiom.
static uint32_t add_component(FrLbuilder *builder, uint32_t maker) {
    const FrLproduction *production = fr_lderive_maker(builder->derivation, maker);
    maker = production == NULL ? 0 : maker;
    if (builder->components[maker] == FR_NONE) {
        const FrLunit *unit = g_ptr_array_index(builder->derivation->system->units, 0);
        builder->components[maker] =
            fr_plant_add_component(builder->plant, production == NULL ? "axiom" : production->name,
                                   production == NULL ? unit->axiom_span : production->span);
    }
    return builder->components[maker];
}

uint32_t fr_lbuilder_component(FrLbuilder *builder, uint32_t maker) {
    bool is_known = maker < builder->makers && builder->components[maker] != FR_NONE;
    return is_known ? builder->components[maker] : add_component(builder, maker);
}

// ---- parts ------------------------------------------------------------------------------------

/// What is known of a node before the part.
static const FrLfoot *foot_of(const FrLbuilder *builder, uint32_t node) {
    const FrLbuilderPart *part = builder->part;
    uint32_t k = part->feet_count - 1;
    while (k > 0 && part->feet[k].node != node) {
        k--;
    }
    return &part->feet[k];
}

/// The tie by which the part came to an axis that began before it.
static FrLtie *tie_of(const FrLbuilderPart *part, uint32_t axis) {
    FrLtie *ties = (FrLtie *)(void *)part->ties->data;
    guint k = part->ties->len - 1;
    while (k > 0 && !(ties[k].goes_on && ties[k].axis == axis)) {
        k--;
    }
    return &ties[k];
}

static inline uint16_t order_of(const FrLbuilder *builder, uint32_t axis) {
    return builder->part != NULL && axis < builder->part->first_axis
               ? tie_of(builder->part, axis)->order
               : builder->plant->axes.order[axis];
}

static inline void set_last(FrLbuilder *builder, uint32_t axis, uint32_t node) {
    if (builder->part != NULL && axis < builder->part->first_axis) {
        tie_of(builder->part, axis)->last = node;
    } else {
        builder->plant->axes.last[axis] = node;
    }
}

void fr_lbuilder_join(FrLbuilder *whole, const FrLbuilderPart *part) {
    FrNodes *nodes = &whole->plant->nodes;
    FrAxes *axes = &whole->plant->axes;
    for (guint k = 0; k < part->ties->len; k++) {
        const FrLtie *tie = &g_array_index(part->ties, FrLtie, k);
        turn_from(nodes, tie->parent, tie->node);
        if (tie->goes_on) {
            nodes->next[tie->parent] = tie->node;
            axes->last[tie->axis] = tie->last;
        } else if (tie->is_offset) {
            axes->offset[tie->axis] =
                glms_vec3_sub(axes->offset[tie->axis], nodes->position[tie->parent]);
        }
    }
}

/// Begins an axis with the node made last; its offset is in the plant's coordinates until the end.
static uint32_t begin_axis(FrLbuilder *builder, const FrLsegment *segment, FrLstand stand,
                           float width) {
    FrPlant *plant = builder->plant;
    FrAxes *axes = &plant->axes;
    if (builder->axes == builder->axis_room) {
        grow_axes(builder);
    }
    uint32_t axis = builder->axes++, node = fr_lstand_node(stand);
    bool is_elsewhere = node < builder->first_node;
    if (node == FR_NONE) {
        axes->offset[axis] = fr_lturtle_world(segment->start);
    } else {
        uint16_t order = is_elsewhere ? foot_of(builder, node)->order
                                      : order_of(builder, plant->nodes.axis[node]);
        axes->order[axis] = (uint16_t)(order + (order < UINT16_MAX));
        if ((stand & FR_LSTAND_TIP) == 0 && is_elsewhere) {
            axes->offset[axis] = fr_lturtle_world(segment->start);
        } else if ((stand & FR_LSTAND_TIP) == 0) {
            vec3s start = fr_lturtle_world(segment->start);
            axes->offset[axis] = glms_vec3_sub(start, plant->nodes.position[node]);
        }
    }
    axes->first[axis] = builder->nodes - 1;
    axes->bearer[axis] = node;
    axes->base_radius[axis] = width / 2;
    axes->component[axis] =
        builder->part != NULL ? segment->maker : fr_lbuilder_component(builder, segment->maker);
    axes->material[axis] = fr_lbuilder_painted(builder, segment->colour, builder->wood);
    axes->profile[axis] = builder->section;
    axes->path[axis] = fr_key_child(fr_key_root(0), segment->module);
    return axis;
}

/// Whether an axis has the colour of a segment; another begins another axis.
static inline bool is_coloured(FrLbuilder *builder, uint32_t axis, int32_t colour) {
    return builder->palette == NULL || builder->plant->axes.material[axis] ==
                                           fr_lbuilder_painted(builder, colour, builder->wood);
}

/// The axis of the node made last, where its parent is before the part.
static uint32_t tie_axis(FrLbuilder *builder, const FrLsegment *segment, FrLstand stand,
                         float width) {
    uint32_t parent = fr_lstand_node(stand);
    const FrLfoot *foot = foot_of(builder, parent);
    FrLtie tie = {.node = builder->nodes - 1,
                  .parent = parent,
                  .axis = foot->axis,
                  .order = foot->order,
                  .goes_on = (stand & ~FR_LSTAND_NODE) == FR_LSTAND_TIP,
                  .is_offset = (stand & FR_LSTAND_TIP) == 0};
    if (!tie.goes_on) {
        tie.axis = begin_axis(builder, segment, stand, width);
    }
    g_array_append_val(builder->part->ties, tie);
    return tie.axis;
}

uint32_t fr_lbuilder_begin(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment,
                           float width) {
    if (builder->nodes == builder->node_room &&
        !grow_nodes(builder, segment->maker, segment->module)) {
        return FR_NONE;
    }
    FrNodes *nodes = &builder->plant->nodes;
    uint32_t node = builder->nodes++, parent = fr_lstand_node(*stand), axis;
    if (parent < builder->first_node) {
        axis = tie_axis(builder, segment, *stand, width);
    } else if (parent != FR_NONE && (*stand & ~FR_LSTAND_NODE) == FR_LSTAND_TIP &&
               nodes->next[parent] == FR_NONE &&
               is_coloured(builder, nodes->axis[parent], segment->colour)) {
        axis = nodes->axis[parent];
        nodes->next[parent] = node;
    } else {
        axis = begin_axis(builder, segment, *stand, width);
    }
    set_last(builder, axis, node);
    nodes->parent[node] = parent;
    nodes->axis[node] = axis;
    nodes->length[node] = (float)segment->length;
    vec3s heading = fr_lturtle_world(segment->heading), left = fr_lturtle_world(segment->left);
    float sign = segment->is_backward ? -1 : 1;
    float axes[6] = {sign * heading.x, sign * heading.y, sign * heading.z, left.x, left.y, left.z};
    for (int k = 0; k < 6; k++) {
        builder->waiting[k][node - builder->framed] = axes[k];
    }
    if (builder->origins != NULL) {
        uint64_t origin = segment->module << 16 | segment->maker;
        g_array_append_val(builder->origins, origin);
    }
    *stand = node | FR_LSTAND_TIP;
    return node;
}

void fr_lbuilder_node(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment,
                      const float widths[2], const double end[3]) {
    uint32_t node =
        segment->length > 0 ? fr_lbuilder_begin(builder, stand, segment, widths[0]) : FR_NONE;
    if (node != FR_NONE) {
        fr_lbuilder_finish(builder, node, widths[1], end);
    }
}
