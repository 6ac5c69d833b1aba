// Space colonization (Runions, Lane, Prusinkiewicz 2007, Modeling Trees with a Space Colonization
// Algorithm): every particle draws the nearest node within its influence; a node that is drawn
// grows a child along the mean of the directions; what comes near a node is taken away.
//
// Nodes never move, so a particle's nearest one changes only when a nearer one appears: only the
// nodes of the last step are compared. Where equally far ones compete, the older wins, then the one
// of the plant with the smaller key. Pulls are summed in whole numbers, in no order.
#include "growth/engine.h"
#include "math/lanes.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

enum {
    MOST_CHILDREN = 4,
    MOST_DEAD = 16, ///< one in so many particles may be dead: the dead are compared like the living
};
#define UNIT 0x1p24f
#define SAME_WAY 0.995f // cosine: a tenth of an internode between two children

/// Node (FR_NONE: the seed) of a plant, in the world.
typedef struct Site {
    vec3s at;
    uint32_t plant, node;
    float reach, kill; ///< squared
    float widest;      ///< m
} Site;

struct FrColony {
    float *nearest;     ///< by particle: squared distance, −1 if it has been reached
    uint32_t *site;     ///< its nearest: index into sites, FR_NONE
    uint32_t count;     ///< particles
    GPtrArray *site_of; ///< by plant, GArray of uint32_t: site of its seed, then of its nodes
    GArray *sites;      ///< Site, of all steps
    GArray *pulls;      ///< Pull, by site
    GArray *pulled;     ///< uint32_t: sites that are drawn in this step
    uint32_t known;     ///< sites that particles have been compared with
};

/// How a site is drawn, and what has grown there.
typedef struct Pull {
    int64_t sum[3];
    uint32_t count;
    uint32_t children;
    vec3s last; ///< direction of its last child
} Pull;

void fr_colony_free(FrColony *colony) {
    if (colony != NULL) {
        g_free(colony->nearest);
        g_free(colony->site);
        g_ptr_array_free(colony->site_of, TRUE);
        g_array_free(colony->sites, TRUE);
        g_array_free(colony->pulls, TRUE);
        g_array_free(colony->pulled, TRUE);
        g_free(colony);
    }
}

/// Tells the parent of a new node that it has grown.
static void note_child(const FrGrownPlant *plant, FrColony *colony, const GArray *site_of,
                       uint32_t node) {
    uint32_t parent = plant->nodes.parent[node]; // + 1 is its place, 0 that of the seed
    uint32_t site = g_array_index(site_of, uint32_t, parent + 1);
    Pull *pull = &g_array_index(colony->pulls, Pull, site);
    vec3s from = parent == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[parent];
    pull->children++;
    pull->last = glms_vec3_normalize(glms_vec3_sub(plant->nodes.at[node], from));
}

static void add_site(const FrGrowth *growth, FrColony *colony, uint32_t p, uint32_t node) {
    const FrGrownPlant *plant = &growth->plants[p];
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    Site site = {.plant = p,
                 .node = node,
                 .reach = (float)(params->influence * params->influence),
                 .kill = (float)(params->kill * params->kill),
                 .widest = (float)params->influence};
    for (int axis = 0; axis < 3; axis++) {
        double at = node == FR_NONE ? 0 : (double)plant->nodes.at[node].raw[axis];
        site.at.raw[axis] = (float)(plant->seed.at[axis] + at);
    }
    Pull pull = {.count = 0};
    uint32_t index = colony->sites->len;
    g_array_append_val(colony->sites, site);
    g_array_append_val(colony->pulls, pull);
    GArray *site_of = g_ptr_array_index(colony->site_of, p);
    g_array_append_val(site_of, index);
    if (node != FR_NONE) {
        note_child(plant, colony, site_of, node);
    }
}

static bool is_colonizer(const FrGrowth *growth, const FrGrownPlant *plant) {
    return plant->place == FR_PLACE_FREE &&
           fr_species_of(growth, plant)->params.fate == FR_FATE_COLONIZE;
}

/// Plants in the order of their keys, which is not that of their seeds.
static GArray *ordered_plants(const FrGrowth *growth) {
    GArray *order = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        if (is_colonizer(growth, &growth->plants[p])) {
            g_array_append_val(order, p);
        }
    }
    return order;
}

static int compare_plants(const void *a, const void *b, void *data) {
    const FrGrowth *growth = data;
    FrKey one = growth->plants[*(const uint32_t *)a].key;
    FrKey other = growth->plants[*(const uint32_t *)b].key;
    return one < other ? -1 : one > other;
}

static void add_plant_sites(const FrGrowth *growth, FrColony *colony, uint32_t p, uint64_t birth) {
    const FrGrownPlant *plant = &growth->plants[p];
    uint32_t i = plant->nodes.count;
    while (i > 0 && plant->nodes.birth[i - 1] >= birth) {
        i--;
    }
    for (; i < plant->nodes.count && plant->nodes.birth[i] == birth; i++) {
        add_site(growth, colony, p, i);
    }
}

/// Adds the nodes that were born in a step; step 0: the seeds.
static void add_sites(FrGrowth *growth, FrColony *colony, uint64_t birth) {
    GArray *order = ordered_plants(growth);
    g_array_sort_with_data(order, compare_plants, growth);
    for (guint i = 0; i < order->len; i++) {
        uint32_t p = g_array_index(order, uint32_t, i);
        if (birth == 0) {
            add_site(growth, colony, p, FR_NONE);
        } else {
            add_plant_sites(growth, colony, p, birth);
        }
    }
    g_array_free(order, TRUE);
}

static FrColony *new_colony(FrGrowth *growth, const FrProgress *progress) {
    FrColony *colony = g_new0(FrColony, 1);
    colony->count = growth->particles->count;
    colony->nearest = g_new(float, colony->count + 1);
    colony->site = g_new(uint32_t, colony->count + 1);
    for (uint32_t i = 0; i < colony->count; i++) {
        colony->nearest[i] = INFINITY;
        colony->site[i] = FR_NONE;
    }
    colony->site_of = g_ptr_array_new_with_free_func((GDestroyNotify)g_array_unref);
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        g_ptr_array_add(colony->site_of, g_array_new(FALSE, FALSE, sizeof(uint32_t)));
    }
    colony->sites = g_array_new(FALSE, FALSE, sizeof(Site));
    colony->pulls = g_array_new(FALSE, FALSE, sizeof(Pull));
    colony->pulled = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint64_t birth = 0; birth < growth->step && !fr_progress_is_cancelled(progress); birth++) {
        add_sites(growth, colony, birth);
    }
    return colony;
}

// ---- comparing --------------------------------------------------------------------------------

typedef struct Comparing {
    const FrParticles *particles;
    FrColony *colony;
    const FrProgress *progress;
} Comparing;

/// The plain case, without radii of particles' own, in a form that compilers turn into vectors.
FR_LANES_CLONES static void compare_run(const FrParticles *particles, FrColony *colony,
                                        const Site *site, uint32_t index, uint32_t begin,
                                        uint32_t end) {
    const float *restrict px = particles->x, *restrict py = particles->y;
    const float *restrict pz = particles->z;
    float *restrict nearest = colony->nearest;
    uint32_t *restrict sites = colony->site;
    float ax = site->at.x, ay = site->at.y, az = site->at.z;
    float reach = site->reach, kill = site->kill;
    for (uint32_t i = begin; i < end; i++) {
        float x = px[i] - ax, y = py[i] - ay, z = pz[i] - az;
        float squared = x * x + y * y + z * z;
        float old = nearest[i];
        bool is_nearer = (squared < old) & (squared <= reach);
        sites[i] = is_nearer ? index : sites[i];
        float now = is_nearer ? squared : old;
        nearest[i] = squared < kill ? -1 : now;
    }
}

static void compare_own(const FrParticles *particles, FrColony *colony, const Site *site,
                        uint32_t index, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++) {
        Site own = *site;
        if (particles->influence[i] > 0) {
            own.reach = particles->influence[i] * particles->influence[i];
        }
        if (particles->kill[i] >= 0) {
            own.kill = particles->kill[i] * particles->kill[i];
        }
        compare_run(particles, colony, &own, index, i, i + 1);
    }
}

/// Compares a chunk of the particles with all new sites: no other thread writes there.
static void compare_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Comparing *comparing = data;
    const FrParticles *particles = comparing->particles;
    FrColony *colony = comparing->colony;
    FrRun runs[FR_MAX_RUNS];
    uint32_t end_site = colony->sites->len;
    for (uint32_t s = colony->known; s < end_site && !fr_progress_is_cancelled(comparing->progress);
         s++) {
        const Site *site = &g_array_index(colony->sites, Site, s);
        float widest =
            particles->has_own ? fmaxf(site->widest, particles->widest_influence) : site->widest;
        widest = fmaxf(widest, fmaxf(sqrtf(site->kill), particles->widest_kill));
        uint32_t count = fr_particles_near(particles, site->at, widest, runs);
        for (uint32_t r = 0; r < count; r++) {
            uint32_t from = MAX(runs[r].begin, (uint32_t)begin);
            uint32_t to = MIN(runs[r].end, (uint32_t)end);
            if (from < to && particles->has_own) {
                compare_own(particles, colony, site, s, from, to);
            } else if (from < to) {
                compare_run(particles, colony, site, s, from, to);
            }
        }
    }
}

static void compare_new(FrGrowth *growth, FrColony *colony, const FrContext *context) {
    Comparing comparing = {growth->particles, colony, context->progress};
    size_t threads = (size_t)fr_pool_threads(context->pool);
    size_t chunk = colony->count / (threads == 1 ? 1 : 4 * threads) + 1;
    fr_parallel_for(context->pool, colony->count, chunk, compare_range, &comparing,
                    context->progress);
    colony->known = colony->sites->len;
}

// ---- drawing ----------------------------------------------------------------------------------

/// Takes the reached particles out and sums up the pull of the others.
static void sum_up(FrParticles *particles, FrColony *colony) {
    g_array_set_size(colony->pulled, 0);
    Pull *pulls = (Pull *)(void *)colony->pulls->data;
    const Site *sites = (const Site *)(void *)colony->sites->data;
    for (uint32_t i = 0; i < colony->count; i++) {
        if (colony->nearest[i] == INFINITY) {
            continue; // too far from all sites
        }
        if (colony->nearest[i] < 0 && !particles->is_dead[i]) {
            particles->is_dead[i] = 1;
            particles->dead_count++;
        }
        uint32_t s = colony->site[i];
        if (s == FR_NONE || particles->is_dead[i]) {
            continue;
        }
        Pull *pull = &pulls[s];
        if (pull->count++ == 0) {
            g_array_append_val(colony->pulled, s);
        }
        float scale = UNIT / sqrtf(fmaxf(colony->nearest[i], 1e-20f));
        pull->sum[0] += lrintf((particles->x[i] - sites[s].at.x) * scale);
        pull->sum[1] += lrintf((particles->y[i] - sites[s].at.y) * scale);
        pull->sum[2] += lrintf((particles->z[i] - sites[s].at.z) * scale);
    }
}

/// The bud that a drawn node grows from: the apex of its axis, or the first of a new one.
static void add_bud(FrGrowth *growth, const Site *site, vec3s direction, uint32_t children) {
    FrGrownPlant *plant = &growth->plants[site->plant];
    uint32_t axis = 0;
    bool goes_on = true;
    if (site->node != FR_NONE) {
        axis = plant->nodes.axis[site->node];
        goes_on = plant->axes[axis].last == site->node;
    } else if (plant->nodes.count > 0) {
        goes_on = false; // further stems from the seed's place
    }
    FrKey key = fr_key_child(fr_key_child(plant->axes[axis].key, plant->axes[axis].internodes),
                             children + growth->step * MOST_CHILDREN);
    FrLiveBud *bud = fr_grown_add_bud(plant);
    bud->key = key;
    bud->node = site->node;
    bud->direction = bud->attraction = direction;
    bud->side = fr_frame_left(fr_frame_from_heading(direction, growth->up));
    bud->light = 1;
    bud->axis = goes_on ? axis : fr_grown_add_axis(plant, site->node, 0, key);
    plant->axes[bud->axis].birth = (uint16_t)MIN(growth->step, UINT16_MAX);
    bud->state = FR_LIVE_GROWING;
}

static int compare_sites(const void *a, const void *b) {
    uint32_t one = *(const uint32_t *)a, other = *(const uint32_t *)b;
    return one < other ? -1 : one > other;
}

/// Buds where nodes are drawn, older nodes first.
static void grow_pulled(FrGrowth *growth, FrColony *colony) {
    g_array_sort(colony->pulled, compare_sites);
    for (guint k = 0; k < colony->pulled->len; k++) {
        uint32_t s = g_array_index(colony->pulled, uint32_t, k);
        Pull *pull = &g_array_index(colony->pulls, Pull, s);
        vec3s sum;
        for (int axis = 0; axis < 3; axis++) {
            sum.raw[axis] = (float)pull->sum[axis];
            pull->sum[axis] = 0;
        }
        pull->count = 0;
        float length = glms_vec3_norm(sum);
        if (length < UNIT * 1e-3f || pull->children >= MOST_CHILDREN) {
            continue;
        }
        vec3s direction = glms_vec3_scale(sum, 1 / length);
        if (pull->children > 0 && glms_vec3_dot(direction, pull->last) > SAME_WAY) {
            continue; // between two equally far particles it would do so forever
        }
        add_bud(growth, &g_array_index(colony->sites, Site, s), direction, pull->children);
    }
}

/// A plant that nothing has drawn yet rises on its first axis.
static void rise(FrGrowth *growth) {
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        bool is_drawn = plant->axis_count != 1 || plant->bud_count > 0 || plant->is_drawn;
        if (!is_colonizer(growth, plant) || is_drawn) {
            plant->is_drawn |= plant->bud_count > 0;
            continue;
        }
        Site site = {.plant = p, .node = plant->axes[0].last};
        add_bud(growth, &site, growth->up, 0);
    }
}

/// Many particles being dead, the living move together.
static void compact(FrParticles *particles, FrColony *colony) {
    uint32_t *kept = g_new(uint32_t, particles->count + 1);
    fr_particles_compact(particles, kept);
    for (uint32_t i = 0; i < particles->count; i++) {
        colony->nearest[i] = colony->nearest[kept[i]];
        colony->site[i] = colony->site[kept[i]];
    }
    colony->count = particles->count;
    g_free(kept);
}

/// Compares the new nodes with the particles. Once it is cancelled the colony is to be made anew.
static FrStatus compare(FrGrowth *growth, const FrContext *context) {
    if (growth->colony != NULL && growth->colony->count != growth->particles->count) {
        fr_colony_free(growth->colony);
        growth->colony = NULL;
    }
    if (growth->colony == NULL) {
        growth->colony = new_colony(growth, context->progress);
    } else {
        add_sites(growth, growth->colony, growth->step - 1);
    }
    compare_new(growth, growth->colony, context);
    if (fr_progress_is_cancelled(context->progress)) {
        fr_colony_free(growth->colony);
        growth->colony = NULL;
        return FR_CANCELLED;
    }
    return FR_OK;
}

FrStatus fr_growth_colonize(FrGrowth *growth, const FrContext *context, bool *has_colonizers) {
    *has_colonizers = false;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        *has_colonizers |= is_colonizer(growth, &growth->plants[p]);
    }
    bool has_particles = growth->particles != NULL;
    FrStatus status = *has_colonizers && has_particles ? compare(growth, context) : FR_OK;
    if (status != FR_OK || !*has_colonizers) {
        return status;
    }
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        if (is_colonizer(growth, &growth->plants[p])) {
            growth->plants[p].bud_count = 0; // the seed's bud: whether it grows is decided below
        }
    }
    if (has_particles) {
        sum_up(growth->particles, growth->colony);
        grow_pulled(growth, growth->colony);
        if (growth->particles->dead_count > growth->particles->count / MOST_DEAD) {
            compact(growth->particles, growth->colony);
        }
    }
    rise(growth);
    return FR_OK;
}
