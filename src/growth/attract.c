// Attraction particles and buds (Beneš, Andrysco, Šťava 2009, sections 3.1 and 3.4; Runions, Lane,
// Prusinkiewicz 2007, Modeling Trees with a Space Colonization Algorithm). A particle draws the
// nearest live bud within its influence; homogeneous coordinates make places and directions one.
//
// The published rule kills the bud together with the particle that it reaches; Runions' kills the
// particle alone. The published direction is to the nearest particle, Runions' the mean of all.
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

typedef struct Attracting {
    FrGrowth *growth;
    const FrLiveBudAt *buds; ///< growing, gathered
    uint8_t *may_draw;       ///< by bud: some particle knew none nearer when it was asked
    uint64_t *nearest;       ///< by particle: bits of the squared distance, then of the bud's key
} Attracting;

static float influence_of(const FrParticles *particles, uint32_t i, float species) {
    return particles->has_own && particles->influence[i] > 0 ? particles->influence[i] : species;
}

/// Distance first, so that the smallest number is the nearest; the key tells equals apart.
static uint64_t code(float squared, FrKey key) {
    uint32_t bits;
    memcpy(&bits, &squared, sizeof bits);
    return (uint64_t)bits << 32 | (uint32_t)(key >> 32);
}

static float squared_distance(const FrParticles *particles, uint32_t i, vec3s at) {
    float x = particles->x[i] - at.x, y = particles->y[i] - at.y, z = particles->z[i] - at.z;
    return x * x + y * y + z * z;
}

static void find_nearest(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Attracting *attracting = data;
    const FrParticles *particles = attracting->growth->particles;
    FrRun runs[FR_MAX_RUNS];
    for (size_t b = begin; b < end; b++) {
        const FrLiveBudAt *bud = &attracting->buds[b];
        if (bud->params->fate == FR_FATE_COLONIZE) {
            continue;
        }
        float widest = fmaxf(bud->influence, particles->widest_influence);
        uint32_t count = fr_particles_near(particles, bud->world, widest, runs);
        for (uint32_t r = 0; r < count; r++) {
            for (uint32_t i = runs[r].begin; i < runs[r].end; i++) {
                float squared = squared_distance(particles, i, bud->world);
                float reach = influence_of(particles, i, bud->influence);
                if (particles->is_dead[i] || squared > reach * reach) {
                    continue;
                }
                uint64_t mine = code(squared, bud->bud->key);
                uint64_t old = __atomic_load_n(&attracting->nearest[i], __ATOMIC_RELAXED);
                attracting->may_draw[b] |= mine <= old;
                while (mine < old &&
                       !__atomic_compare_exchange_n(&attracting->nearest[i], &old, mine, true,
                                                    __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
                }
            }
        }
    }
}

/// Adds the directions that draw all buds alike.
static vec3s towards_directions(const FrParticles *particles, vec3s at) {
    vec3s sum = {{0, 0, 0}};
    for (uint32_t i = 0; i < particles->direction_count; i++) {
        const FrParticle *far = &particles->directions[i];
        vec3s towards = glms_vec3_sub(far->at, glms_vec3_scale(at, far->w));
        float length = glms_vec3_norm(towards);
        if (length > 0) {
            sum = glms_vec3_add(sum, glms_vec3_scale(towards, 1 / length));
        }
    }
    return sum;
}

/// What a bud has seen of its particles.
typedef struct Pull {
    int64_t sum[3]; ///< of unit vectors in whole numbers: the order of particles has no say
    float least;    ///< squared distance of the nearest
    vec3s nearest;  ///< where it is
} Pull;

#define UNIT 0x1p30

static bool comes_before(vec3s a, vec3s b) {
    for (int axis = 0; axis < 3; axis++) {
        if (a.raw[axis] != b.raw[axis]) {
            return a.raw[axis] < b.raw[axis];
        }
    }
    return false;
}

static void add_pull(Pull *pull, vec3s place, vec3s at, float squared) {
    float scale = 1 / sqrtf(squared);
    for (int axis = 0; axis < 3; axis++) {
        double part = (double)((place.raw[axis] - at.raw[axis]) * scale);
        pull->sum[axis] += (int64_t)llround(part * UNIT);
    }
    if (squared < pull->least || (squared == pull->least && comes_before(place, pull->nearest))) {
        pull->least = squared;
        pull->nearest = place;
    }
}

static Pull pull_of(const Attracting *attracting, const FrLiveBudAt *bud) {
    const FrParticles *particles = attracting->growth->particles;
    FrRun runs[FR_MAX_RUNS];
    Pull pull = {.least = INFINITY};
    float widest = fmaxf(bud->influence, particles->widest_influence);
    uint32_t count = fr_particles_near(particles, bud->world, widest, runs);
    for (uint32_t r = 0; r < count; r++) {
        for (uint32_t i = runs[r].begin; i < runs[r].end; i++) {
            float squared = squared_distance(particles, i, bud->world);
            if (squared > 0 && attracting->nearest[i] == code(squared, bud->bud->key)) {
                vec3s place = {{particles->x[i], particles->y[i], particles->z[i]}};
                add_pull(&pull, place, bud->world, squared);
            }
        }
    }
    return pull;
}

static void sum_up(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Attracting *attracting = data;
    for (size_t b = begin; b < end; b++) {
        const FrLiveBudAt *bud = &attracting->buds[b];
        if (bud->params->fate == FR_FATE_COLONIZE) {
            continue;
        }
        vec3s far = towards_directions(attracting->growth->particles, bud->world);
        if (!attracting->may_draw[b] && glms_vec3_norm2(far) == 0) {
            bud->bud->attraction = far;
            continue;
        }
        Pull pull = pull_of(attracting, bud);
        vec3s nearest = far, all = far;
        if (pull.least < INFINITY) {
            vec3s towards = glms_vec3_sub(pull.nearest, bud->world);
            nearest = glms_vec3_add(far, glms_vec3_scale(towards, 1 / sqrtf(pull.least)));
        }
        for (int axis = 0; axis < 3; axis++) {
            all.raw[axis] += (float)((double)pull.sum[axis] / UNIT);
        }
        vec3s wanted = bud->params->particle_mean == FR_PARTICLES_NEAREST ? nearest : all;
        // Particles on both sides cancel out; then the nearest decides.
        if (glms_vec3_norm(wanted) < 1e-4f) {
            wanted = nearest;
        }
        float length = glms_vec3_norm(wanted);
        bud->bud->attraction = length > 1e-4f ? glms_vec3_scale(wanted, 1 / length) : (vec3s){0};
    }
}

/// True if some species is drawn by particles, and if some follow the published rule.
static bool is_anyone_drawn(const FrGrowth *growth, bool *by_published_rule) {
    bool is_anyone = false;
    *by_published_rule = false;
    for (uint32_t i = 0; i < growth->species_count; i++) {
        const FrSpeciesParams *params = &growth->species[i].params;
        is_anyone |= params->fate != FR_FATE_COLONIZE;
        *by_published_rule |= params->particle_rule == FR_PARTICLE_BUD;
    }
    return is_anyone;
}

/// The published rule: what a bud reaches dies together with it. Serial, since it takes particles.
static void meet(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count) {
    for (uint32_t b = 0; b < count; b++) {
        if (buds[b].params->particle_rule == FR_PARTICLE_BUD) {
            buds[b].bud->is_reached =
                fr_particles_reach(growth->particles, buds[b].world, (float)buds[b].params->kill);
        }
    }
    for (uint32_t b = 0; b < count; b++) {
        if (buds[b].params->particle_rule == FR_PARTICLE_BUD) {
            fr_particles_kill(growth->particles, buds[b].world, (float)buds[b].params->kill);
        }
    }
}

FrStatus fr_growth_attract(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                           const FrContext *context) {
    enum { GRAIN = 64 };
    FrParticles *particles = growth->particles;
    bool by_published_rule;
    if (particles == NULL || !is_anyone_drawn(growth, &by_published_rule)) {
        return FR_OK;
    }
    Attracting attracting = {.growth = growth, .buds = buds};
    attracting.nearest = g_new(uint64_t, particles->count + 1);
    attracting.may_draw = g_new0(uint8_t, count + 1);
    memset(attracting.nearest, 0xff, particles->count * sizeof(uint64_t));
    if (by_published_rule) {
        meet(growth, buds, count);
    }
    fr_parallel_for(context->pool, count, GRAIN, find_nearest, &attracting, context->progress);
    fr_parallel_for(context->pool, count, GRAIN, sum_up, &attracting, context->progress);
    g_free(attracting.nearest);
    g_free(attracting.may_draw);
    return fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
}
