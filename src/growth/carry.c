// Climbers on trees that thicken: bark carries them outward. What lies nearer to the middle line of
// a stem than both are thick is moved off it until they touch; a shoot without a hold goes with
// what bears it. Cells and shadows follow.
#include "growth/climbing.h"

#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// New places of a plant's nodes.
typedef struct Move {
    uint32_t plant;
    vec3s *by;           ///< by node; NULL: none moves
    uint8_t *is_stirred; ///< by node: it or what bears it moves
} Move;

typedef struct Carrying {
    FrGrowth *growth;
    Move *moves;
} Carrying;

static void world_of(const FrGrownPlant *plant, uint32_t node, vec3s by, double at[3]) {
    for (int r = 0; r < 3; r++) {
        at[r] = plant->seed.at[r] + ((double)plant->nodes.at[node].raw[r] + (double)by.raw[r]);
    }
}

/// Out of bark, in a fork out of one stem after the other.
static vec3s push_out(const FrGrowth *growth, const FrGrownPlant *plant, uint32_t node, vec3s by,
                      double radius) {
    enum { TIMES = 6 };
    const double slack = 1e-4; // m
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    for (int k = 0; k < TIMES; k++) {
        double at[3];
        world_of(plant, node, by, at);
        FrBark bark = fr_stems_near(growth->bark, at, radius, params->climb_wood);
        if (bark.distance >= radius - slack) {
            break;
        }
        for (int r = 0; r < 3; r++) {
            by.raw[r] += (float)((radius - bark.distance) * bark.outward[r]);
        }
    }
    return by;
}

/// The same for the middle of an internode between nodes on two stems of a fork: its tip is moved.
static vec3s push_middle(const FrGrowth *growth, const FrGrownPlant *plant, uint32_t node,
                         const vec3s *moved, vec3s by) {
    double from[3], way[3];
    uint32_t parent = plant->nodes.parent[node];
    world_of(plant, parent, moved[parent], from);
    world_of(plant, node, by, way);
    for (int r = 0; r < 3; r++) {
        way[r] -= from[r];
    }
    FrBark bark;
    double room =
        fr_climb_room(growth, &fr_species_of(growth, plant)->params, from, way, 0.5, &bark);
    for (int r = 0; r < 3 && room < 0; r++) {
        by.raw[r] -= (float)(2 * room * bark.outward[r]);
    }
    return by;
}

/// Not farther than bark is known, and not into what is solid.
static vec3s held_back(const FrGrowth *growth, const FrGrownPlant *plant, uint32_t node, vec3s by) {
    float far = glms_vec3_norm(by);
    float most = (float)fr_growth_longest(&fr_species_of(growth, plant)->params);
    by = far > most ? glms_vec3_scale(by, most / far) : by;
    double at[3];
    FrCell cell;
    world_of(plant, node, by, at);
    if (!fr_voxels_cell(growth->voxels, at, &cell)) {
        return (vec3s){{0, 0, 0}};
    }
    uint32_t owner = fr_voxels_owner(growth->voxels, cell);
    bool is_solid = owner == FR_VOXEL_SOLID || owner == FR_VOXEL_GROUND;
    return is_solid ? (vec3s){{0, 0, 0}} : by;
}

static void find_move(const FrGrowth *growth, Move *move) {
    const FrGrownPlant *plant = &growth->plants[move->plant];
    const FrGrownNodes *nodes = &plant->nodes;
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    float *radii = fr_growth_radii_of(growth, plant);
    move->by = g_new0(vec3s, nodes->count + 1);
    move->is_stirred = g_new0(uint8_t, nodes->count + 1);
    bool is_any = false;
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        FrHold hold = fr_climb_feel(growth, params, fr_grown_tip(plant, i));
        bool is_held = hold.is_near && hold.distance <= hold.gap + params->step / 2;
        vec3s by = parent == FR_NONE || is_held ? (vec3s){{0, 0, 0}} : move->by[parent];
        by = push_out(growth, plant, i, by, (double)radii[i]);
        if (parent != FR_NONE) {
            by = push_middle(growth, plant, i, move->by, by);
            by = push_out(growth, plant, i, by, (double)radii[i]);
        }
        bool is_moved = glms_vec3_norm2(by) > 0;
        move->by[i] = is_moved ? held_back(growth, plant, i, by) : by;
        move->is_stirred[i] = glms_vec3_norm2(move->by[i]) > 0 ||
                              (parent != FR_NONE && glms_vec3_norm2(move->by[parent]) > 0);
        is_any |= move->is_stirred[i];
    }
    g_free(radii);
    if (!is_any) {
        g_clear_pointer(&move->by, g_free);
        g_clear_pointer(&move->is_stirred, g_free);
    }
}

static void find_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Carrying *carrying = data;
    for (size_t i = begin; i < end; i++) {
        find_move(carrying->growth, &carrying->moves[i]);
    }
}

// ---- what goes along --------------------------------------------------------------------------

/// Takes the free cells of a plant's internodes.
static void take_cells(FrGrowth *growth, const FrGrownPlant *plant) {
    FrCell cells[FR_WALK_CELLS];
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        uint32_t owner = plant->axes[plant->nodes.axis[i]].owner;
        uint32_t count = owner == FR_NONE ? 0
                                          : fr_growth_walk(growth, plant, plant->nodes.parent[i],
                                                           plant->nodes.at[i], cells);
        for (uint32_t k = 1; k < count; k++) {
            FrBrick *brick = fr_voxels_reserve(growth->voxels, cells[k]);
            uint64_t *taken = &brick->taken[cells[k].at[2] & 7];
            uint64_t bit = UINT64_C(1) << fr_voxels_bit(cells[k]);
            if ((*taken & bit) == 0) {
                *fr_voxels_at(brick, cells[k]) = owner;
                *taken |= bit;
            }
        }
    }
}

/// Shadows of internodes that have cast one before: at their bases.
static void shift_shadows(FrGrowth *growth, const FrGrownPlant *plant, const Move *move,
                          bool is_taken_back, const FrContext *context) {
    GArray *bases = g_array_new(FALSE, FALSE, sizeof(vec3s));
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        if (move->is_stirred[i] && plant->nodes.birth[i] != MIN(growth->step, UINT16_MAX)) {
            vec3s base = fr_grown_base(plant, i);
            g_array_append_val(bases, base);
        }
    }
    fr_shadows_cast(growth->shadows, (const vec3s *)(void *)bases->data, bases->len, is_taken_back,
                    context);
    g_array_free(bases, TRUE);
}

static void apply(FrGrowth *growth, const Move *move, const FrContext *context) {
    FrGrownPlant *plant = &growth->plants[move->plant];
    fr_growth_free_cells(growth, plant, move->is_stirred);
    if (growth->shadows != NULL) {
        shift_shadows(growth, plant, move, true, context);
    }
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        plant->nodes.at[i] = glms_vec3_add(plant->nodes.at[i], move->by[i]);
    }
    if (growth->shadows != NULL) {
        shift_shadows(growth, plant, move, false, context);
    }
    take_cells(growth, plant);
}

static int compare_keys(const void *a, const void *b, void *data) {
    const FrGrowth *growth = data;
    FrKey p = growth->plants[((const Move *)a)->plant].key;
    FrKey q = growth->plants[((const Move *)b)->plant].key;
    return memcmp(&p, &q, sizeof p);
}

void fr_growth_carry(FrGrowth *growth, const FrContext *context) {
    if (growth->bark == NULL) {
        return;
    }
    GArray *moves = g_array_new(FALSE, FALSE, sizeof(Move));
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        if (fr_species_climbs(&fr_species_of(growth, &growth->plants[p])->params)) {
            Move move = {.plant = p};
            g_array_append_val(moves, move);
        }
    }
    Carrying carrying = {growth, (Move *)(void *)moves->data};
    fr_parallel_for(context->pool, moves->len, 1, find_range, &carrying, NULL);
    // Where two come into one cell, the order says whose it is: that of keys.
    g_qsort_with_data(moves->data, (gint)moves->len, sizeof(Move), compare_keys, growth);
    for (uint32_t i = 0; i < moves->len; i++) {
        Move *move = &g_array_index(moves, Move, i);
        if (move->by != NULL) {
            apply(growth, move, context);
        }
        g_free(move->by);
        g_free(move->is_stirred);
    }
    g_array_free(moves, TRUE);
}
