// Cutting internodes into equal pieces: the same plant with more joints to bend at.
#include "plant/columns.h"

#include <cglm/struct.h>

typedef struct Refinement {
    const FrPlant *plant;
    uint32_t *pieces; ///< of each node
    uint32_t *last;   ///< the last piece of each node, in the finer plant
} Refinement;

/// Pieces of every internode of an axis, so that it has `joints` at least.
static uint32_t pieces_of(const FrPlant *plant, uint32_t axis, uint16_t joints) {
    uint32_t count = 0;
    if ((plant->axes.flags[axis] & FR_POINT_SETS) != 0) {
        return 1; // its rings stand at its joints
    }
    for (uint32_t i = plant->axes.first[axis]; i != FR_NONE && count < joints;
         i = plant->nodes.next[i]) {
        count++;
    }
    return count == 0 || count >= joints ? 1 : (joints + count - 1) / count;
}

uint64_t fr_plant_refined_nodes(const FrPlant *plant, const uint16_t *joints) {
    uint64_t total = 0;
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        uint64_t pieces = pieces_of(plant, a, joints[a]);
        for (uint32_t i = plant->axes.first[a]; i != FR_NONE; i = plant->nodes.next[i]) {
            total += pieces;
        }
    }
    return total;
}

static uint32_t number_pieces(Refinement *refinement, const uint16_t *joints) {
    const FrPlant *plant = refinement->plant;
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        uint32_t pieces = pieces_of(plant, a, joints[a]);
        for (uint32_t i = plant->axes.first[a]; i != FR_NONE; i = plant->nodes.next[i]) {
            refinement->pieces[i] = pieces;
        }
    }
    uint32_t total = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        total += refinement->pieces[i];
        refinement->last[i] = total - 1;
    }
    return total;
}

static uint32_t mapped(const Refinement *refinement, uint32_t node) {
    return node == FR_NONE ? FR_NONE : refinement->last[node];
}

/// Writes the pieces of node i; what widens or flattens along it does so evenly.
static void cut(const Refinement *refinement, uint32_t i, FrNodes *fine) {
    const FrNodes *nodes = &refinement->plant->nodes;
    const FrAxes *axes = &refinement->plant->axes;
    uint32_t count = refinement->pieces[i], axis = nodes->axis[i];
    uint32_t first = refinement->last[i] + 1 - count;
    bool is_first = axes->first[axis] == i;
    float radius = is_first ? axes->base_radius[axis] : nodes->radius[nodes->parent[i]];
    float flatness = is_first ? nodes->flatness[i] : nodes->flatness[nodes->parent[i]];
    for (uint32_t k = 0; k < count; k++) {
        uint32_t piece = first + k;
        float along = (float)(k + 1) / (float)count;
        bool is_tip = k + 1 == count;
        fine->parent[piece] = k == 0 ? mapped(refinement, nodes->parent[i]) : piece - 1;
        fine->next[piece] = is_tip ? FR_NONE : piece + 1;
        fine->axis[piece] = axis;
        if (k == 0) {
            fine->rotation[piece] = nodes->rotation[i];
        }
        fine->length[piece] = nodes->length[i] / (float)count;
        fine->radius[piece] =
            is_tip ? nodes->radius[i] : radius + along * (nodes->radius[i] - radius);
        fine->flatness[piece] =
            is_tip ? nodes->flatness[i] : flatness + along * (nodes->flatness[i] - flatness);
        fine->birth[piece] = nodes->birth[i];
        fine->flags[piece] = nodes->flags[i];
    }
    if (nodes->next[i] != FR_NONE) {
        uint32_t next = nodes->next[i];
        fine->next[refinement->last[i]] = refinement->last[next] + 1 - refinement->pieces[next];
    }
}

/// The piece beside which something stands, whose offset from the node's tip becomes one from the
/// tip of the piece.
static void attach(const Refinement *refinement, uint32_t *node, vec3s *offset) {
    uint32_t i = *node;
    if (i == FR_NONE) {
        return;
    }
    uint32_t count = refinement->pieces[i];
    float length = refinement->plant->nodes.length[i] / (float)count;
    uint32_t back = 0; // pieces between the tip and where it stands
    if (count > 1 && length > 0 && offset->z < 0) {
        back = (uint32_t)fminf(floorf(-offset->z / length), (float)(count - 1));
    }
    *node = refinement->last[i] - back;
    offset->z += (float)back * length;
}

FrPlant *fr_plant_refined(const FrPlant *plant, const uint16_t *joints) {
    Refinement refinement = {plant, g_new(uint32_t, plant->nodes.count + 1),
                             g_new(uint32_t, plant->nodes.count + 1)};
    uint32_t total = number_pieces(&refinement, joints);
    FrPlant *copy = fr_plant_copy(plant);
    FrNodes fine = {0};
    fr_columns_append(&fine, &fr_node_columns, total);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        cut(&refinement, i, &fine);
    }
    fr_columns_free(&copy->nodes, &fr_node_columns);
    copy->nodes = fine;
    for (uint32_t a = 0; a < copy->axes.count; a++) {
        FrAxes *axes = &copy->axes;
        uint32_t first = axes->first[a];
        if (first != FR_NONE) {
            axes->first[a] = refinement.last[first] + 1 - refinement.pieces[first];
            axes->last[a] = refinement.last[axes->last[a]];
        }
        attach(&refinement, &axes->bearer[a], &axes->offset[a]);
        if (first != FR_NONE) {
            copy->nodes.parent[axes->first[a]] = axes->bearer[a];
        }
    }
    for (uint32_t o = 0; o < copy->organs.count; o++) {
        attach(&refinement, &copy->organs.node[o], &copy->organs.offset[o]);
    }
    for (uint32_t b = 0; b < copy->buds.count; b++) {
        copy->buds.node[b] = mapped(&refinement, copy->buds.node[b]);
    }
    for (guint d = 0; d < copy->deformers->len; d++) {
        FrDeformer *deformer = &g_array_index(copy->deformers, FrDeformer, d);
        attach(&refinement, &deformer->node, &deformer->offset);
    }
    g_free(refinement.pieces);
    g_free(refinement.last);
    fr_plant_update_frames(copy, 0);
    return copy;
}
