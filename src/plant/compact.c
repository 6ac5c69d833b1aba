// Removing what has been shed, in one forward pass: parents come first, so whether a node's
// bearer is gone is known when the node is reached.
#include "plant/columns.h"

static bool is_gone(const uint32_t *map, uint32_t index) {
    return index != FR_NONE && map[index] == FR_NONE;
}

static uint32_t mapped(const uint32_t *map, uint32_t index) {
    return index == FR_NONE ? FR_NONE : map[index];
}

/// New number of each node, FR_NONE if it goes.
static uint32_t map_nodes(const FrPlant *plant, uint32_t *map) {
    const FrNodes *nodes = &plant->nodes;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        bool goes = (nodes->flags[i] & FR_SHED) != 0 ||
                    (plant->axes.flags[nodes->axis[i]] & FR_SHED) != 0 ||
                    is_gone(map, nodes->parent[i]);
        map[i] = goes ? FR_NONE : kept++;
    }
    return kept;
}

/// An axis goes if it is marked, if its bearer goes, or if it loses its first node.
static uint32_t map_axes(const FrPlant *plant, const uint32_t *node_map, uint32_t *map) {
    const FrAxes *axes = &plant->axes;
    uint32_t kept = 0;
    for (uint32_t a = 0; a < axes->count; a++) {
        bool goes = (axes->flags[a] & FR_SHED) != 0 || is_gone(node_map, axes->bearer[a]) ||
                    is_gone(node_map, axes->first[a]);
        map[a] = goes ? FR_NONE : kept++;
    }
    return kept;
}

static void renumber_nodes(FrPlant *plant, const uint32_t *node_map, const uint32_t *axis_map) {
    FrNodes *nodes = &plant->nodes;
    FrAxes *axes = &plant->axes;
    for (uint32_t i = 0; i < nodes->count; i++) {
        if (node_map[i] == FR_NONE) {
            continue;
        }
        nodes->parent[i] = mapped(node_map, nodes->parent[i]);
        nodes->next[i] = mapped(node_map, nodes->next[i]);
        if (nodes->next[i] == FR_NONE) {
            axes->last[nodes->axis[i]] = node_map[i]; // also where the rest of the axis fell off
        }
        nodes->axis[i] = axis_map[nodes->axis[i]];
    }
    for (uint32_t a = 0; a < axes->count; a++) {
        if (axis_map[a] != FR_NONE) {
            axes->first[a] = mapped(node_map, axes->first[a]);
            axes->bearer[a] = mapped(node_map, axes->bearer[a]);
        }
    }
}

static void compact_organs(FrPlant *plant, const uint32_t *node_map) {
    FrOrgans *organs = &plant->organs;
    uint32_t *map = g_new(uint32_t, organs->count);
    uint32_t kept = 0;
    for (uint32_t o = 0; o < organs->count; o++) {
        bool goes = (organs->flags[o] & FR_SHED) != 0 || is_gone(node_map, organs->node[o]);
        map[o] = goes ? FR_NONE : kept++;
        organs->node[o] = mapped(node_map, organs->node[o]);
    }
    fr_columns_compact(organs, &fr_organ_columns, map, kept);
    g_free(map);
}

static void compact_buds(FrPlant *plant, const uint32_t *node_map) {
    FrBuds *buds = &plant->buds;
    uint32_t *map = g_new(uint32_t, buds->count);
    uint32_t kept = 0;
    for (uint32_t b = 0; b < buds->count; b++) {
        map[b] = is_gone(node_map, buds->node[b]) ? FR_NONE : kept++;
        buds->node[b] = mapped(node_map, buds->node[b]);
    }
    fr_columns_compact(buds, &fr_bud_columns, map, kept);
    g_free(map);
}

// Where a scope has fallen with all that was in it, its row stays for the indices' sake.
static void renumber_deformers(FrPlant *plant, const uint32_t *node_map) {
    for (guint i = 0; i < plant->deformers->len; i++) {
        FrDeformer *deformer = &g_array_index(plant->deformers, FrDeformer, i);
        deformer->node = mapped(node_map, deformer->node);
    }
}

void fr_plant_compact(FrPlant *plant) {
    uint32_t *node_map = g_new(uint32_t, plant->nodes.count);
    uint32_t *axis_map = g_new(uint32_t, plant->axes.count);
    uint32_t nodes_kept = map_nodes(plant, node_map);
    uint32_t axes_kept = map_axes(plant, node_map, axis_map);
    renumber_nodes(plant, node_map, axis_map);
    fr_columns_compact(&plant->nodes, &fr_node_columns, node_map, nodes_kept);
    fr_columns_compact(&plant->axes, &fr_axis_columns, axis_map, axes_kept);
    compact_organs(plant, node_map);
    compact_buds(plant, node_map);
    renumber_deformers(plant, node_map);
    g_free(node_map);
    g_free(axis_map);
}
