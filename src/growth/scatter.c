// Particles of a growth: given, strewn over the arena, or filling the envelopes of plants.
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

enum { TRIES = 64 };

/// How far the grid is mostly asked. Plants that colonize space ask dense particles, for which
/// small cells are worth while.
static float usual_reach(const FrGrowth *growth) {
    float reach = 0;
    for (uint32_t i = 0; i < growth->species_count; i++) {
        const FrSpeciesParams *params = &growth->species[i].params;
        float factor = params->fate == FR_FATE_COLONIZE ? 1 : 2;
        reach = fmaxf(reach, factor * (float)params->influence);
    }
    return reach;
}

static FrStatus check_count(uint64_t count, const FrContext *context) {
    FrStatus status =
        fr_limit_check(fr_count_multiply(count, 2 * sizeof(FrParticle)), context->limits.bytes,
                       "bytes", "the attraction particles", (FrSpan){0}, context->diags);
    if (status == FR_OK && count >= INT32_MAX) {
        status = fr_limit_check(count, INT32_MAX, "particles", "the growth", (FrSpan){0},
                                context->diags);
    }
    return status;
}

FrStatus fr_growth_add_particles(FrGrowth *growth, const FrParticle *particles, uint64_t count,
                                 const FrContext *context) {
    uint32_t old = 0;
    FrParticle *all =
        growth->particles == NULL ? NULL : fr_particles_living(growth->particles, &old);
    FrStatus status = check_count(fr_count_add(old, count), context);
    if (status == FR_OK && count > 0) {
        all = g_renew(FrParticle, all, old + count);
        memcpy(all + old, particles, count * sizeof *particles);
        FrParticles *made =
            fr_particles_new(all, (uint32_t)(old + count), usual_reach(growth), context->progress);
        if (made == NULL) {
            status = FR_CANCELLED;
        } else {
            fr_particles_free(growth->particles);
            fr_colony_free(growth->colony);
            growth->colony = NULL;
            growth->particles = made;
        }
    }
    g_free(all);
    return status;
}

/// The box that a plant's particles are drawn in, relative to its seed along its own upright.
static void box_of(const FrSpeciesParams *params, double *radius, double *low, double *high) {
    const FrPoints *outline = &params->envelope;
    *radius = 8 * params->step;
    *low = 0;
    *high = 2 * *radius;
    for (size_t i = 0; i < outline->count; i++) {
        *radius = i == 0 ? outline->at[i][0] : MAX(*radius, outline->at[i][0]);
        *low = i == 0 ? outline->at[i][1] : MIN(*low, outline->at[i][1]);
        *high = i == 0 ? outline->at[i][1] : MAX(*high, outline->at[i][1]);
    }
}

/// A plant without an envelope has its particles in a ball on the ground.
static bool is_in_ball(const FrSpeciesParams *params, double x, double y, double z, double radius) {
    z -= radius;
    return params->envelope.count > 0 || x * x + y * y + z * z <= radius * radius;
}

FrStatus fr_growth_fill_envelope(const FrGrowth *growth, const FrGrownPlant *plant,
                                 GArray *particles, const FrContext *context) {
    const FrReadySpecies *species = fr_species_of(growth, plant);
    const FrSpeciesParams *params = &species->params;
    double radius, low, high;
    box_of(params, &radius, &low, &high);
    versors frame = fr_frame_from_heading(growth->up, (vec3s){{0, 1, 0}});
    vec3s side[2] = {fr_frame_left(frame), fr_frame_up(frame)};
    for (uint32_t i = 0; i < params->particles; i++) {
        if (fr_progress_is_cancelled(context->progress)) {
            return FR_CANCELLED;
        }
        FrKey key = fr_key_child(plant->key, i);
        for (uint32_t k = 0; k < TRIES; k++) {
            double x = radius * fr_random_signed(key, FR_CHANCE_PARTICLE, 3 * k);
            double y = radius * fr_random_signed(key, FR_CHANCE_PARTICLE, 3 * k + 1);
            double z = low + (high - low) * fr_random(key, FR_CHANCE_PARTICLE, 3 * k + 2);
            vec3s at = glms_vec3_add(glms_vec3_scale(side[0], (float)x),
                                     glms_vec3_scale(side[1], (float)y));
            at = glms_vec3_add(at, glms_vec3_scale(growth->up, (float)z));
            if (is_in_ball(params, x, y, z, radius) && fr_envelope_holds(species, at, growth->up)) {
                FrParticle particle = {.w = 1, .kill = -1};
                for (int axis = 0; axis < 3; axis++) {
                    particle.at.raw[axis] = (float)(plant->seed.at[axis] + (double)at.raw[axis]);
                }
                g_array_append_val(particles, particle);
                break;
            }
        }
    }
    return FR_OK;
}

static void reach_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const FrGrowth *growth = data;
    for (size_t p = begin; p < end; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
        if (params->particle_rule != FR_PARTICLE_SPACE || params->fate == FR_FATE_COLONIZE) {
            continue;
        }
        for (uint32_t i = plant->nodes.count - plant->born; i < plant->nodes.count; i++) {
            fr_particles_kill(growth->particles, fr_grown_tip(plant, i), (float)params->kill);
        }
    }
}

void fr_growth_reach_particles(FrGrowth *growth, const FrContext *context) {
    if (growth->particles != NULL) {
        fr_parallel_for(context->pool, growth->plant_count, 1, reach_range, growth, NULL);
    }
}

/// Marks the particles that a growing bud is near enough to be drawn by.
static void mark_active(const FrGrowth *growth, bool *is_active) {
    const FrParticles *grid = growth->particles;
    FrRun runs[FR_MAX_RUNS];
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        float species = (float)fr_species_of(growth, plant)->params.influence;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            if (plant->buds[b].state != FR_LIVE_GROWING) {
                continue;
            }
            vec3s at = fr_bud_world(plant, &plant->buds[b]);
            uint32_t count =
                fr_particles_near(grid, at, fmaxf(species, grid->widest_influence), runs);
            for (uint32_t r = 0; r < count; r++) {
                for (uint32_t i = runs[r].begin; i < runs[r].end; i++) {
                    float reach = grid->influence[i] > 0 ? grid->influence[i] : species;
                    vec3s place = {{grid->x[i], grid->y[i], grid->z[i]}};
                    is_active[i] |= glms_vec3_distance(place, at) <= reach;
                }
            }
        }
    }
}

FrParticle *fr_growth_particles(const FrGrowth *growth, uint64_t *count, bool **is_active) {
    const FrParticles *grid = growth->particles;
    uint32_t living = 0;
    FrParticle *particles =
        grid == NULL ? g_new0(FrParticle, 1) : fr_particles_living(grid, &living);
    *count = living;
    if (is_active == NULL) {
        return particles;
    }
    *is_active = g_new0(bool, living + 1u);
    if (grid != NULL) {
        bool *marks = g_new0(bool, grid->count + 1u);
        mark_active(growth, marks);
        uint32_t out = 0;
        for (; out < grid->direction_count; out++) {
            (*is_active)[out] = true;
        }
        for (uint32_t i = 0; i < grid->count; i++) {
            if (!grid->is_dead[i]) {
                (*is_active)[out++] = marks[i];
            }
        }
        g_free(marks);
    }
    return particles;
}

FrStatus fr_growth_strew_particles(FrGrowth *growth, const FrContext *context) {
    uint32_t count = (uint32_t)growth->params.particles;
    FrStatus status = check_count(count, context);
    if (status != FR_OK) {
        return status;
    }
    FrParticle *particles = g_new(FrParticle, count + 1u);
    FrKey key = fr_key_root((uint64_t)growth->params.seed);
    for (uint32_t i = 0; i < count && !fr_progress_is_cancelled(context->progress); i++) {
        particles[i] = (FrParticle){.w = 1, .kill = -1};
        for (uint32_t axis = 0; axis < 3; axis++) {
            float low = growth->params.min.raw[axis], high = growth->params.max.raw[axis];
            double part = fr_random(fr_key_child(key, i), FR_CHANCE_PARTICLE, axis);
            particles[i].at.raw[axis] = low + (high - low) * (float)part;
        }
    }
    status = fr_progress_is_cancelled(context->progress)
                 ? FR_CANCELLED
                 : fr_growth_add_particles(growth, particles, count, context);
    g_free(particles);
    return status;
}

void fr_growth_save_particles(const FrGrowth *growth, GByteArray *out) {
    uint32_t count = 0;
    FrParticle *living =
        growth->particles == NULL ? NULL : fr_particles_living(growth->particles, &count);
    uint64_t written = count;
    g_byte_array_append(out, (const guint8 *)&written, sizeof written);
    if (count > 0) {
        g_byte_array_append(out, (const guint8 *)living, (guint)(count * sizeof *living));
    }
    g_free(living);
}

bool fr_growth_take_particles(FrGrowth *growth, FrBytesReader *reader) {
    uint64_t count;
    if (!fr_bytes_take_count(reader, reader->left / sizeof(FrParticle), &count)) {
        return false;
    }
    FrParticle *particles = g_new(FrParticle, count + 1);
    bool is_right = fr_bytes_take(reader, particles, count * sizeof *particles);
    for (uint64_t i = 0; is_right && i < count; i++) {
        const FrParticle *it = &particles[i];
        is_right = isfinite(it->at.x) && isfinite(it->at.y) && isfinite(it->at.z) &&
                   isfinite(it->w) && isfinite(it->influence) && isfinite(it->kill) &&
                   it->influence >= 0;
    }
    if (is_right && count > 0) {
        growth->particles = fr_particles_new(particles, (uint32_t)count, usual_reach(growth), NULL);
    }
    g_free(particles);
    return is_right;
}
