// Attraction particles: a grid over sorted columns.
#include "frond/particles.h"

#include <math.h>

enum { MAX_CELLS = 1 << 24 };

/// Within a cell by place, then by what else is known: the order does not depend on how they came.
static bool comes_before(const FrParticle *a, const FrParticle *b) {
    for (int axis = 0; axis < 3; axis++) {
        if (a->at.raw[axis] != b->at.raw[axis]) {
            return a->at.raw[axis] < b->at.raw[axis];
        }
    }
    return a->influence != b->influence ? a->influence < b->influence : a->kill < b->kill;
}

/// Once it is cancelled all are alike, so that sorting ends soon.
static int compare_places(const void *a, const void *b, void *progress) {
    return fr_progress_is_cancelled(progress) ? 0
                                              : (int)comes_before(b, a) - (int)comes_before(a, b);
}

static void sort_cell(FrParticle *particles, uint32_t count, const FrProgress *progress) {
    enum { FEW = 32 };
    if (count > FEW) {
        g_qsort_with_data(particles, (gint)count, sizeof *particles, compare_places,
                          (void *)progress);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        FrParticle moving = particles[i];
        uint32_t k = i;
        for (; k > 0 && comes_before(&moving, &particles[k - 1]); k--) {
            particles[k] = particles[k - 1];
        }
        particles[k] = moving;
    }
}

/// Cells of half the reach, or wider where there would be too many.
static void lay_grid(FrParticles *grid, const FrParticle *places, uint32_t count, float reach) {
    float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            float at = places[i].at.raw[axis];
            low[axis] = i == 0 ? at : fminf(low[axis], at);
            high[axis] = i == 0 ? at : fmaxf(high[axis], at);
        }
    }
    double cells;
    grid->cell = fmaxf(reach / 2, 1e-6f);
    do {
        cells = 1;
        for (int axis = 0; axis < 3; axis++) {
            grid->origin[axis] = low[axis];
            double size = floor((double)(high[axis] - low[axis]) / (double)grid->cell) + 1;
            grid->size[axis] = (int)fmin(size, 1e9);
            cells *= size;
        }
        grid->cell *= cells > MAX_CELLS ? 1.5f : 1;
    } while (cells > MAX_CELLS);
    grid->inverse = 1 / grid->cell;
}

// Without the care of fmaxf() for what is no number: places are finite.
static inline float larger(float a, float b) {
    return a > b ? a : b;
}

static int cell_along(const FrParticles *grid, float at, int axis) {
    float where = (at - grid->origin[axis]) * grid->inverse;
    int last = grid->size[axis] - 1;
    if (!(where > 0)) {
        return 0;
    }
    return where < (float)last ? (int)where : last;
}

static uint32_t cell_of(const FrParticles *grid, const FrParticle *particle) {
    int at[3];
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = cell_along(grid, particle->at.raw[axis], axis);
    }
    return (uint32_t)((at[2] * grid->size[1] + at[1]) * grid->size[0] + at[0]);
}

static size_t cell_count(const FrParticles *grid) {
    return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
}

/// Brings places into the order of cells: counted, then each put where its cell begins.
static void sort_places(FrParticles *grid, const FrParticle *places, FrParticle *sorted,
                        const FrProgress *progress) {
    size_t cells = cell_count(grid);
    uint32_t *cell = g_new(uint32_t, grid->count + 1);
    grid->start = g_new0(uint32_t, cells + 2);
    for (uint32_t i = 0; i < grid->count; i++) {
        cell[i] = cell_of(grid, &places[i]);
        grid->start[cell[i] + 2]++;
    }
    for (size_t k = 0; k < cells; k++) {
        grid->start[k + 2] += grid->start[k + 1];
    }
    for (uint32_t i = 0; i < grid->count; i++) {
        sorted[grid->start[cell[i] + 1]++] = places[i];
    }
    for (size_t k = 0; k < cells && !fr_progress_is_cancelled(progress); k++) {
        sort_cell(sorted + grid->start[k], grid->start[k + 1] - grid->start[k], progress);
    }
    g_free(cell);
}

static void fill_columns(FrParticles *grid, const FrParticle *places) {
    uint32_t count = grid->count;
    grid->x = g_new(float, count + 1);
    grid->y = g_new(float, count + 1);
    grid->z = g_new(float, count + 1);
    grid->influence = g_new(float, count + 1);
    grid->kill = g_new(float, count + 1);
    grid->is_dead = g_new0(uint8_t, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        const FrParticle *particle = &places[i];
        grid->x[i] = particle->at.x;
        grid->y[i] = particle->at.y;
        grid->z[i] = particle->at.z;
        grid->influence[i] = particle->influence;
        grid->kill[i] = particle->kill;
        grid->widest_influence = fmaxf(grid->widest_influence, particle->influence);
        grid->widest_kill = fmaxf(grid->widest_kill, particle->kill);
        grid->has_own |= particle->influence > 0 || particle->kill >= 0;
    }
}

FrParticles *fr_particles_new(const FrParticle *particles, uint32_t count, float reach,
                              const FrProgress *progress) {
    FrParticles *grid = g_new0(FrParticles, 1);
    FrParticle *places = g_new(FrParticle, count + 1), *sorted = g_new(FrParticle, count + 1);
    grid->directions = g_new(FrParticle, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        if (particles[i].w == 1) {
            places[grid->count++] = particles[i];
        } else {
            grid->directions[grid->direction_count++] = particles[i];
        }
    }
    lay_grid(grid, places, grid->count, reach);
    sort_places(grid, places, sorted, progress);
    fill_columns(grid, sorted);
    g_free(places);
    g_free(sorted);
    if (fr_progress_is_cancelled(progress)) {
        g_clear_pointer(&grid, fr_particles_free);
    }
    return grid;
}

void fr_particles_compact(FrParticles *grid, uint32_t *kept) {
    uint32_t left = 0, i = 0;
    size_t cells = cell_count(grid);
    for (size_t cell = 0; cell < cells; cell++) {
        uint32_t end = grid->start[cell + 1];
        grid->start[cell] = left;
        for (; i < end; i++) {
            if (grid->is_dead[i]) {
                continue;
            }
            grid->x[left] = grid->x[i];
            grid->y[left] = grid->y[i];
            grid->z[left] = grid->z[i];
            grid->influence[left] = grid->influence[i];
            grid->kill[left] = grid->kill[i];
            grid->is_dead[left] = 0;
            kept[left++] = i;
        }
    }
    grid->start[cells] = left;
    grid->count = left;
    grid->dead_count = 0;
}

void fr_particles_free(FrParticles *particles) {
    if (particles == NULL) {
        return;
    }
    g_free(particles->x);
    g_free(particles->y);
    g_free(particles->z);
    g_free(particles->influence);
    g_free(particles->kill);
    g_free(particles->is_dead);
    g_free(particles->directions);
    g_free(particles->start);
    g_free(particles);
}

/// How far `at` is from the nearest point of cells [cell, cell + 1) along an axis.
static float away(const FrParticles *grid, float at, int cell, int axis) {
    float low = grid->origin[axis] + grid->cell * (float)cell;
    return larger(0, larger(low - at, at - (low + grid->cell)));
}

/// Appends the particles of cells first … last of a row, if there are any. Most rows of sparse
/// particles have none, which no branch foresees.
static uint32_t append_run(const FrParticles *grid, uint32_t row, int first, int last, bool is_near,
                           FrRun *runs, uint32_t count) {
    FrRun run = {grid->start[row + (uint32_t)first], grid->start[row + (uint32_t)last + 1]};
    runs[count] = run;
    return count + (uint32_t)(is_near & (run.end > run.begin));
}

uint32_t fr_particles_near(const FrParticles *grid, vec3s at, float radius, FrRun *runs) {
    enum { FEW = 3 }; ///< cells of a row that are not worth trimming
    uint32_t count = 0;
    // A little more than asked for: cells are found with rounding.
    float reach = radius + grid->cell * 1e-3f;
    int from[3], to[3];
    for (int axis = 0; axis < 3; axis++) {
        from[axis] = cell_along(grid, at.raw[axis] - reach, axis);
        to[axis] = cell_along(grid, at.raw[axis] + reach, axis);
    }
    bool is_coarse = (to[1] - from[1] + 1) * (to[2] - from[2] + 1) > FR_MAX_RUNS;
    if (grid->count == 0 || is_coarse) {
        runs[0] = (FrRun){0, grid->count};
        return grid->count > 0;
    }
    bool is_short = to[0] - from[0] < FEW;
    for (int z = from[2]; z <= to[2]; z++) {
        float dz = away(grid, at.z, z, 2);
        for (int y = from[1]; y <= to[1]; y++) {
            float dy = away(grid, at.y, y, 1);
            float left = reach * reach - dz * dz - dy * dy;
            uint32_t row = (uint32_t)((z * grid->size[1] + y) * grid->size[0]);
            if (is_short) {
                count = append_run(grid, row, from[0], to[0], left >= 0, runs, count);
            } else if (left >= 0) {
                float half = sqrtf(left);
                int first = cell_along(grid, at.x - half - grid->cell * 1e-3f, 0);
                int last = cell_along(grid, at.x + half + grid->cell * 1e-3f, 0);
                count = append_run(grid, row, first, last, true, runs, count);
            }
        }
    }
    return count;
}

FrParticle *fr_particles_living(const FrParticles *particles, uint32_t *count) {
    FrParticle *living = g_new(FrParticle, particles->count + particles->direction_count + 1);
    *count = 0;
    for (uint32_t i = 0; i < particles->direction_count; i++) {
        living[(*count)++] = particles->directions[i];
    }
    for (uint32_t i = 0; i < particles->count; i++) {
        if (!particles->is_dead[i]) {
            living[(*count)++] =
                (FrParticle){.at = {{particles->x[i], particles->y[i], particles->z[i]}},
                             .w = 1,
                             .influence = particles->influence[i],
                             .kill = particles->kill[i]};
        }
    }
    return living;
}

/// True if a particle is within its own kill radius of a point, or within `radius` if it has none.
static bool is_reached(const FrParticles *particles, uint32_t i, vec3s at, float radius) {
    float x = particles->x[i] - at.x, y = particles->y[i] - at.y, z = particles->z[i] - at.z;
    float reach = particles->kill[i] >= 0 ? particles->kill[i] : radius;
    return x * x + y * y + z * z < reach * reach;
}

uint32_t fr_particles_kill(FrParticles *particles, vec3s at, float radius) {
    FrRun runs[FR_MAX_RUNS];
    float widest = fmaxf(radius, particles->widest_kill);
    uint32_t run_count = fr_particles_near(particles, at, widest, runs);
    uint32_t killed = 0;
    for (uint32_t r = 0; r < run_count; r++) {
        for (uint32_t i = runs[r].begin; i < runs[r].end; i++) {
            uint8_t *is_dead = &particles->is_dead[i];
            if (!__atomic_load_n(is_dead, __ATOMIC_RELAXED) &&
                is_reached(particles, i, at, radius)) {
                killed += !__atomic_exchange_n(is_dead, 1, __ATOMIC_RELAXED);
            }
        }
    }
    __atomic_fetch_add(&particles->dead_count, killed, __ATOMIC_RELAXED);
    return killed;
}

bool fr_particles_reach(const FrParticles *particles, vec3s at, float radius) {
    FrRun runs[FR_MAX_RUNS];
    float widest = fmaxf(radius, particles->widest_kill);
    uint32_t run_count = fr_particles_near(particles, at, widest, runs);
    for (uint32_t r = 0; r < run_count; r++) {
        for (uint32_t i = runs[r].begin; i < runs[r].end; i++) {
            if (!particles->is_dead[i] && is_reached(particles, i, at, radius)) {
                return true;
            }
        }
    }
    return false;
}
