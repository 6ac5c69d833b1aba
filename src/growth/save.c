// The state of a growth as bytes: a head, the plants' columns as they are in memory, the cells that
// have owners, and a digest of all that. Numbers are little-endian.
#include "growth/climbing.h"

#include <math.h>
#include <string.h>

#define MAGIC "FrGrown3"

// ---- writing ----------------------------------------------------------------------------------

static void put(GByteArray *out, const void *data, size_t size) {
    if (size > 0) {
        g_byte_array_append(out, data, (guint)size);
    }
}

static void put_count(GByteArray *out, uint64_t count) {
    put(out, &count, sizeof count);
}

static void put_plant(GByteArray *out, const FrGrownPlant *plant) {
    const FrGrownNodes *nodes = &plant->nodes;
    put(out, plant->seed.at, sizeof plant->seed.at);
    put_count(out, plant->seed.id);
    put_count(out, plant->seed.species);
    put_count(out, plant->place);
    put_count(out, plant->max_order);
    put_count(out, plant->is_drawn);
    put_count(out, plant->is_dead);
    put_count(out, plant->starving);
    put_count(out, nodes->count);
    put_count(out, plant->axis_count);
    put_count(out, plant->bud_count);
    put(out, nodes->parent, nodes->count * sizeof *nodes->parent);
    put(out, nodes->axis, nodes->count * sizeof *nodes->axis);
    put(out, nodes->at, nodes->count * sizeof *nodes->at);
    put(out, nodes->birth, nodes->count * sizeof *nodes->birth);
    put(out, nodes->light, nodes->count * sizeof *nodes->light);
    put(out, nodes->wood, nodes->count * sizeof *nodes->wood);
    put(out, plant->axes, plant->axis_count * sizeof *plant->axes);
    put(out, plant->buds, plant->bud_count * sizeof *plant->buds);
}

/// Cells of a brick that have owners: how many, then (index, owner) each.
static void put_brick(void *data, FrCell first, FrBrick *brick) {
    GByteArray *out = data;
    uint32_t count = 0;
    for (uint32_t i = 0; i < FR_BRICK_CELLS; i++) {
        count += brick->owners[i] != FR_VOXEL_FREE;
    }
    if (count == 0) {
        return;
    }
    put(out, &first, sizeof first);
    put(out, &(uint16_t){(uint16_t)count}, sizeof(uint16_t));
    for (uint32_t i = 0; i < FR_BRICK_CELLS; i++) {
        if (brick->owners[i] != FR_VOXEL_FREE) {
            put(out, &(uint16_t){(uint16_t)i}, sizeof(uint16_t));
            put(out, &brick->owners[i], sizeof(uint32_t));
        }
    }
}

GBytes *fr_growth_save(const FrGrowth *growth) {
    GByteArray *out = g_byte_array_new();
    put(out, MAGIC, 8);
    put_count(out, growth->step);
    put_count(out, growth->is_world_new);
    put_count(out, growth->owner_count);
    put_count(out, growth->plant_count);
    for (uint32_t i = 0; i < growth->plant_count; i++) {
        put_plant(out, &growth->plants[i]);
    }
    fr_voxels_each_owned(growth->voxels, put_brick, out);
    put(out, &(FrCell){{-1, -1, -1}}, sizeof(FrCell));
    fr_growth_save_particles(growth, out);
    FrDigest digest = fr_digest(0, out->data, out->len);
    put(out, &digest, sizeof digest);
    return g_byte_array_free_to_bytes(out);
}

// ---- reading ----------------------------------------------------------------------------------

bool fr_bytes_take(FrBytesReader *reader, void *into, size_t size) {
    if (size > reader->left) {
        return false;
    }
    if (size > 0) {
        memcpy(into, reader->at, size);
    }
    reader->at += size;
    reader->left -= size;
    return true;
}

bool fr_bytes_take_count(FrBytesReader *reader, uint64_t limit, uint64_t *count) {
    return fr_bytes_take(reader, count, sizeof *count) && *count <= limit;
}

static bool is_finite3(vec3s vector) {
    return isfinite(vector.x) && isfinite(vector.y) && isfinite(vector.z);
}

static bool is_unit(vec3s vector) {
    float squared = vector.x * vector.x + vector.y * vector.y + vector.z * vector.z;
    return squared > 0.99f && squared < 1.01f; // and a number
}

/// True if a place of the plant lies in the arena.
static bool is_inside(const FrGrowth *growth, const FrGrownPlant *plant, vec3s at) {
    for (int axis = 0; axis < 3; axis++) {
        double where = plant->seed.at[axis] + (double)at.raw[axis];
        if (!(where >= (double)growth->params.min.raw[axis] &&
              where <= (double)growth->params.max.raw[axis])) {
            return false;
        }
    }
    return true;
}

static bool nodes_are_right(const FrGrowth *growth, const FrGrownPlant *plant) {
    const FrGrownNodes *nodes = &plant->nodes;
    for (uint32_t i = 0; i < nodes->count; i++) {
        if ((nodes->parent[i] != FR_NONE && nodes->parent[i] >= i) ||
            nodes->axis[i] >= plant->axis_count || !isfinite(nodes->wood[i]) ||
            !is_inside(growth, plant, nodes->at[i])) {
            return false;
        }
    }
    return true;
}

static bool is_node(const FrGrownPlant *plant, uint32_t node) {
    return node == FR_NONE || node < plant->nodes.count;
}

static bool axes_are_right(const FrGrowth *growth, const FrGrownPlant *plant) {
    for (uint32_t i = 0; i < plant->axis_count; i++) {
        const FrGrownAxis *axis = &plant->axes[i];
        if (!is_node(plant, axis->bearer) || !is_node(plant, axis->first) ||
            !is_node(plant, axis->last) || (axis->first == FR_NONE) != (axis->last == FR_NONE) ||
            axis->is_growing > 1 || !isfinite(axis->vigour) ||
            (axis->owner != FR_NONE && axis->owner >= growth->owner_count)) {
            return false;
        }
        if (axis->first != FR_NONE && (plant->nodes.axis[axis->first] != i ||
                                       plant->nodes.parent[axis->first] != axis->bearer)) {
            return false;
        }
    }
    return true;
}

static bool buds_are_right(const FrGrowth *growth, const FrGrownPlant *plant) {
    uint32_t rows = fr_species_of(growth, plant)->order_count;
    for (uint32_t i = 0; i < plant->bud_count; i++) {
        const FrLiveBud *bud = &plant->buds[i];
        if (!is_node(plant, bud->node) || bud->axis >= plant->axis_count ||
            bud->state > FR_LIVE_DONE || bud->row > MAX(rows, FR_MAX_ORDERS) ||
            !is_unit(bud->direction) || !is_unit(bud->side) || !is_finite3(bud->brightest) ||
            !is_finite3(bud->attraction) || !(bud->light >= 0 && bud->light <= 1) ||
            !isfinite(bud->vigour) || bud->is_relay > 1 ||
            !(bud->unheld >= 0 && bud->unheld < INFINITY)) {
            return false;
        }
    }
    return true;
}

static bool take_plant(FrBytesReader *reader, const FrGrowth *growth, FrGrownPlant *plant) {
    uint64_t species, place, max_order, is_drawn, is_dead, starving, nodes, axes, buds;
    if (!fr_bytes_take(reader, plant->seed.at, sizeof plant->seed.at) ||
        !fr_bytes_take(reader, &plant->seed.id, sizeof plant->seed.id) ||
        growth->species_count == 0 ||
        !fr_bytes_take_count(reader, growth->species_count - 1, &species) ||
        !fr_bytes_take_count(reader, FR_PLACE_LOST, &place) ||
        !fr_bytes_take_count(reader, 255, &max_order) ||
        !fr_bytes_take_count(reader, 1, &is_drawn) || !fr_bytes_take_count(reader, 1, &is_dead) ||
        !fr_bytes_take_count(reader, UINT16_MAX, &starving) ||
        !fr_bytes_take_count(reader, reader->left, &nodes) ||
        !fr_bytes_take_count(reader, reader->left, &axes) ||
        !fr_bytes_take_count(reader, reader->left, &buds) ||
        nodes + axes + buds > reader->left / 4 ||
        (place != FR_PLACE_FREE && nodes + axes + buds > 0)) {
        return false;
    }
    plant->seed.species = (uint32_t)species;
    plant->place = (uint8_t)place;
    plant->max_order = (uint8_t)max_order;
    plant->is_drawn = (uint8_t)is_drawn;
    plant->is_dead = (uint8_t)is_dead;
    plant->starving = (uint16_t)starving;
    plant->key = fr_key_child(fr_key_root((uint64_t)growth->params.seed), plant->seed.id);
    fr_grown_reserve(plant, (uint32_t)nodes, (uint32_t)axes, (uint32_t)buds);
    FrGrownNodes *into = &plant->nodes;
    into->count = (uint32_t)nodes;
    plant->axis_count = (uint32_t)axes;
    plant->bud_count = (uint32_t)buds;
    return fr_bytes_take(reader, into->parent, nodes * sizeof *into->parent) &&
           fr_bytes_take(reader, into->axis, nodes * sizeof *into->axis) &&
           fr_bytes_take(reader, into->at, nodes * sizeof *into->at) &&
           fr_bytes_take(reader, into->birth, nodes * sizeof *into->birth) &&
           fr_bytes_take(reader, into->light, nodes * sizeof *into->light) &&
           fr_bytes_take(reader, into->wood, nodes * sizeof *into->wood) &&
           fr_bytes_take(reader, plant->axes, axes * sizeof *plant->axes) &&
           fr_bytes_take(reader, plant->buds, buds * sizeof *plant->buds) &&
           nodes_are_right(growth, plant) && axes_are_right(growth, plant) &&
           buds_are_right(growth, plant);
}

/// The axes' numbers in the voxels, each at most once.
static bool take_owners(FrGrowth *growth) {
    fr_growth_reserve_owners(growth, growth->owner_count);
    for (uint32_t i = 0; i < growth->owner_count; i++) {
        growth->owners[i] = (FrOwner){.plant = FR_NONE};
    }
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t a = 0; a < plant->axis_count; a++) {
            uint32_t owner = plant->axes[a].owner;
            if (owner != FR_NONE) {
                if (growth->owners[owner].plant != FR_NONE) {
                    return false;
                }
                growth->owners[owner] = (FrOwner){p, a, plant->axes[a].bearer, FR_NONE, 0};
            }
        }
    }
    return true;
}

static bool take_cells(FrBytesReader *reader, FrGrowth *growth) {
    FrCell first;
    while (fr_bytes_take(reader, &first, sizeof first)) {
        if (first.at[0] == -1) {
            return true;
        }
        uint16_t count;
        for (int axis = 0; axis < 3; axis++) {
            if (first.at[axis] < 0 || first.at[axis] >= FR_VOXELS_WIDTH ||
                first.at[axis] % FR_BRICK_WIDTH != 0) {
                return false;
            }
        }
        if (!fr_bytes_take(reader, &count, sizeof count) || count > FR_BRICK_CELLS) {
            return false;
        }
        FrBrick *brick = fr_voxels_reserve(growth->voxels, first);
        for (uint32_t i = 0; i < count; i++) {
            uint16_t index;
            uint32_t owner;
            if (!fr_bytes_take(reader, &index, sizeof index) || index >= FR_BRICK_CELLS ||
                !fr_bytes_take(reader, &owner, sizeof owner) || owner >= growth->owner_count ||
                growth->owners[owner].plant == FR_NONE) {
                return false;
            }
            brick->owners[index] = owner;
        }
        fr_voxels_note_owners(brick);
    }
    return false;
}

static bool take_growth(FrBytesReader *reader, FrGrowth *growth, const FrLimits *limits) {
    char magic[8];
    uint64_t is_world_new, owners, plants;
    if (!fr_bytes_take(reader, magic, 8) || memcmp(magic, MAGIC, 8) != 0 ||
        !fr_bytes_take_count(reader, UINT32_MAX, &growth->step) ||
        !fr_bytes_take_count(reader, 1, &is_world_new) ||
        !fr_bytes_take_count(reader, INT32_MAX, &owners) || owners > reader->left ||
        !fr_bytes_take_count(reader, limits->plants, &plants)) {
        return false;
    }
    growth->is_world_new = is_world_new != 0;
    growth->owner_count = (uint32_t)owners;
    growth->plants = g_new0(FrGrownPlant, plants);
    for (; growth->plant_count < plants; growth->plant_count++) {
        if (!take_plant(reader, growth, &growth->plants[growth->plant_count])) {
            fr_grown_clear(&growth->plants[growth->plant_count]);
            return false;
        }
    }
    return take_owners(growth) && take_cells(reader, growth) &&
           fr_growth_take_particles(growth, reader) && reader->left == 0;
}

/// Puts what was read in the place of what was.
static void exchange(FrGrowth *growth, FrGrowth *read) {
    FrGrowth old = *growth;
    growth->plants = read->plants;
    growth->plant_count = read->plant_count;
    growth->owners = read->owners;
    growth->owner_count = read->owner_count;
    growth->owner_capacity = read->owner_capacity;
    growth->step = read->step;
    growth->is_world_new = read->is_world_new;
    // What stands in the way stays as it is.
    fr_voxels_take_owners(growth->voxels, read->voxels);
    read->plants = old.plants;
    read->plant_count = old.plant_count;
    read->owners = old.owners;
    read->shadows = old.shadows;
    growth->shadows = NULL; // cast anew by the next step
    read->colony = old.colony;
    growth->colony = NULL;
    FrParticles *particles = growth->particles;
    growth->particles = read->particles;
    read->particles = particles;
}

FrStatus fr_growth_restore(FrGrowth *growth, const void *bytes, size_t size, FrSpan span,
                           const FrContext *context) {
    FrDigest digest = 0;
    FrBytesReader reader = {bytes, size < sizeof digest ? 0 : size - sizeof digest};
    bool is_right = size >= sizeof digest;
    if (is_right) {
        memcpy(&digest, reader.at + reader.left, sizeof digest);
        is_right = digest == fr_digest(0, bytes, reader.left);
    }
    // Read beside the old state, with its species and arena.
    FrGrowth read = {.params = growth->params,
                     .species = growth->species,
                     .species_count = growth->species_count};
    if (is_right) {
        read.voxels = fr_voxels_new(growth->voxels->origin, growth->voxels->cell);
        is_right = take_growth(&reader, &read, &context->limits);
    }
    if (is_right) {
        exchange(growth, &read);
        fr_growth_find_bark(growth, context);
    } else {
        fr_diags_add(context->diags, FR_ERROR, "growth-state", span,
                     "this is no saved state of growth, or one of another document");
    }
    fr_growth_drop_state(&read);
    return is_right ? FR_OK : FR_ERR_DOCUMENT;
}
