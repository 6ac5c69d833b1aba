// Columns of one growing plant. They only grow; compaction (shed.c) keeps their order.
#include "growth/engine.h"

#include <string.h>
#include <sys/mman.h>

static uint32_t more(uint32_t capacity) {
    return capacity < 16 ? 16 : capacity + capacity / 2;
}

static void grow_nodes(FrGrownNodes *nodes, uint32_t capacity) {
    nodes->capacity = capacity;
    nodes->parent = g_renew(uint32_t, nodes->parent, capacity);
    nodes->axis = g_renew(uint32_t, nodes->axis, capacity);
    nodes->at = g_renew(vec3s, nodes->at, capacity);
    nodes->birth = g_renew(uint16_t, nodes->birth, capacity);
    nodes->light = g_renew(uint8_t, nodes->light, capacity);
    nodes->wood = g_renew(float, nodes->wood, capacity);
}

uint32_t fr_grown_add_node(FrGrownPlant *plant, uint32_t parent, uint32_t axis, vec3s at) {
    FrGrownNodes *nodes = &plant->nodes;
    if (nodes->count == nodes->capacity) {
        grow_nodes(nodes, more(nodes->capacity));
    }
    uint32_t node = nodes->count++;
    nodes->parent[node] = parent;
    nodes->axis[node] = axis;
    nodes->at[node] = at;
    nodes->birth[node] = 0;
    nodes->light[node] = 255;
    nodes->wood[node] = 0;
    FrGrownAxis *of = &plant->axes[axis];
    if (of->first == FR_NONE) {
        of->first = node;
    }
    of->last = node;
    of->internodes++;
    return node;
}

uint32_t fr_grown_add_axis(FrGrownPlant *plant, uint32_t bearer, uint8_t row, FrKey key) {
    if (plant->axis_count == plant->axis_capacity) {
        plant->axis_capacity = more(plant->axis_capacity);
        plant->axes = g_renew(FrGrownAxis, plant->axes, plant->axis_capacity);
    }
    uint32_t order = bearer == FR_NONE ? 0 : plant->axes[plant->nodes.axis[bearer]].order + 1u;
    FrGrownAxis *axis = &plant->axes[plant->axis_count];
    memset(axis, 0, sizeof *axis); // padding too: states are saved as they are
    axis->key = key;
    axis->bearer = bearer;
    axis->first = axis->last = axis->owner = FR_NONE;
    axis->row = row;
    axis->order = (uint8_t)MIN(order, 255);
    axis->is_growing = true;
    return plant->axis_count++;
}

FrLiveBud *fr_grown_add_bud(FrGrownPlant *plant) {
    if (plant->bud_count == plant->bud_capacity) {
        plant->bud_capacity = more(plant->bud_capacity);
        plant->buds = g_renew(FrLiveBud, plant->buds, plant->bud_capacity);
    }
    FrLiveBud *bud = &plant->buds[plant->bud_count++];
    memset(bud, 0, sizeof *bud); // padding too: digests read the bytes
    return bud;
}

void fr_grown_reserve(FrGrownPlant *plant, uint32_t nodes, uint32_t axes, uint32_t buds) {
    if (nodes > plant->nodes.capacity) {
        grow_nodes(&plant->nodes, nodes);
    }
    if (axes > plant->axis_capacity) {
        plant->axis_capacity = axes;
        plant->axes = g_renew(FrGrownAxis, plant->axes, axes);
    }
    if (buds > plant->bud_capacity) {
        plant->bud_capacity = buds;
        plant->buds = g_renew(FrLiveBud, plant->buds, buds);
    }
}

void fr_grown_clear(FrGrownPlant *plant) {
    FrGrownNodes *nodes = &plant->nodes;
    g_free(nodes->parent);
    g_free(nodes->axis);
    g_free(nodes->at);
    g_free(nodes->birth);
    g_free(nodes->light);
    g_free(nodes->wood);
    g_free(plant->axes);
    g_free(plant->buds);
    memset(plant, 0, sizeof *plant);
}

FrDigest fr_grown_digest(const FrGrownPlant *plant) {
    const FrGrownNodes *nodes = &plant->nodes;
    FrDigest digest = fr_digest(0, &plant->seed.id, sizeof plant->seed.id);
    digest = fr_digest(digest, plant->seed.at, sizeof plant->seed.at);
    const uint16_t life[2] = {plant->is_dead, plant->starving};
    digest = fr_digest(digest, life, sizeof life);
    digest = fr_digest(digest, nodes->parent, nodes->count * sizeof *nodes->parent);
    digest = fr_digest(digest, nodes->at, nodes->count * sizeof *nodes->at);
    digest = fr_digest(digest, nodes->birth, nodes->count * sizeof *nodes->birth);
    digest = fr_digest(digest, nodes->light, nodes->count * sizeof *nodes->light);
    digest = fr_digest(digest, nodes->wood, nodes->count * sizeof *nodes->wood);
    return fr_digest(digest, plant->buds, plant->bud_count * sizeof *plant->buds);
}

uint64_t fr_grown_bytes(const FrGrownPlant *plant) {
    enum { A_NODE = 4 + 4 + 12 + 2 + 1 + 4 };
    return (uint64_t)plant->nodes.count * A_NODE + plant->axis_count * sizeof(FrGrownAxis) +
           plant->bud_count * sizeof(FrLiveBud);
}

vec3s fr_grown_tip(const FrGrownPlant *plant, uint32_t node) {
    vec3s at = node == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[node];
    for (int axis = 0; axis < 3; axis++) {
        at.raw[axis] = (float)(plant->seed.at[axis] + (double)at.raw[axis]);
    }
    return at;
}

vec3s fr_grown_base(const FrGrownPlant *plant, uint32_t node) {
    return fr_grown_tip(plant, plant->nodes.parent[node]);
}

void *fr_scratch_take(FrScratch *scratch, size_t size) {
    enum { HUGE_PAGE = 1 << 21 };
    if (size > scratch->size) {
        fr_scratch_clear(scratch);
        scratch->size = size + size / 2;
        scratch->memory =
            g_aligned_alloc(1, scratch->size, scratch->size < HUGE_PAGE ? 64 : HUGE_PAGE);
        if (scratch->size >= HUGE_PAGE) { // large pages, where the machine has them
            madvise(scratch->memory, scratch->size & ~(size_t)(HUGE_PAGE - 1), MADV_HUGEPAGE);
        }
    }
    return scratch->memory;
}

void fr_scratch_clear(FrScratch *scratch) {
    g_aligned_free(scratch->memory);
    *scratch = (FrScratch){0};
}
