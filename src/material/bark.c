#include "material/bark.h"

#include <math.h>

float fr_bark_smooth(float low, float high, float value) {
    float t = CLAMP((value - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// ---- noise --------------------------------------------------------------------------------------

static int wrap(int value, int period) {
    int rest = value % period;
    return rest < 0 ? rest + period : rest;
}

/// The same for whole numbers in floats, without an integer division in the inner loop.
static int wrap_whole(float value, float period) {
    return (int)(value - floorf(value / period) * period);
}

static float corner(FrKey key, int i, int j, float x, float y) {
    static const float directions[16][2] = {
        {1.0f, 0.0f},  {0.924f, 0.383f},   {0.707f, 0.707f},   {0.383f, 0.924f},
        {0.0f, 1.0f},  {-0.383f, 0.924f},  {-0.707f, 0.707f},  {-0.924f, 0.383f},
        {-1.0f, 0.0f}, {-0.924f, -0.383f}, {-0.707f, -0.707f}, {-0.383f, -0.924f},
        {0.0f, -1.0f}, {0.383f, -0.924f},  {0.707f, -0.707f},  {0.924f, -0.383f},
    };
    const float *gradient = directions[fr_random_bits(key, (uint32_t)i, (uint32_t)j) >> 60];
    return gradient[0] * x + gradient[1] * y;
}

static float fade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

float fr_bark_noise(FrKey key, float u, float v, int across, int along) {
    float x = u * (float)across, y = v * (float)along;
    float fx = floorf(x), fy = floorf(y);
    int i0 = wrap_whole(fx, (float)across), j0 = wrap_whole(fy, (float)along);
    int i1 = i0 + 1 == across ? 0 : i0 + 1, j1 = j0 + 1 == along ? 0 : j0 + 1;
    x -= fx;
    y -= fy;
    float sx = fade(x), sy = fade(y);
    float top0 = corner(key, i0, j0, x, y), top1 = corner(key, i1, j0, x - 1, y);
    float low0 = corner(key, i0, j1, x, y - 1), low1 = corner(key, i1, j1, x - 1, y - 1);
    float top = top0 + sx * (top1 - top0), low = low0 + sx * (low1 - low0);
    return 1.35f * (top + sy * (low - top));
}

float fr_bark_fractal(FrKey key, float u, float v, int across, int along, int octaves) {
    float sum = 0, strength = 0.6f;
    for (int octave = 0; octave < octaves; octave++) {
        FrKey own = fr_key_child(key, (uint64_t)octave);
        // Noise vanishes on its grid; shifted, the grids of the octaves do not coincide.
        float du = (float)(own >> 40) * 0x1.0p-24f, dv = (float)(own & 0xffffff) * 0x1.0p-24f;
        sum += strength * fr_bark_noise(own, u + du, v + dv, across << octave, along << octave);
        strength *= 0.5f;
    }
    return sum;
}

// ---- plates -------------------------------------------------------------------------------------

void fr_bark_cells_init(FrBarkCells *cells, FrKey key, int across, int along, float jitter) {
    size_t count = (size_t)across * (size_t)along;
    *cells = (FrBarkCells){.across = across, .along = along};
    cells->sites = g_new(float, count * 2);
    cells->random = g_new(float, count);
    for (size_t i = 0; i < count; i++) {
        uint32_t draw = (uint32_t)i;
        // Every other column is shifted by half a cell, like bricks on end.
        float shift = (i % (size_t)across) % 2 == 0 ? -0.25f : 0.25f;
        if (across % 2 != 0) {
            shift = 0;
        }
        cells->sites[2 * i] = 0.5f + 0.5f * jitter * (float)fr_random_signed(key, 0, draw);
        cells->sites[2 * i + 1] =
            0.5f + shift + 0.5f * jitter * (float)fr_random_signed(key, 1, draw);
        cells->random[i] = (float)fr_random(key, 2, draw);
    }
}

void fr_bark_cells_clear(FrBarkCells *cells) {
    g_free(cells->sites);
    g_free(cells->random);
}

typedef struct Site {
    float x, y; ///< from the place asked about
    size_t cell;
} Site;

enum { REACH = 2, SIDE = 2 * REACH + 1, SITES = SIDE * SIDE };

/// The sites of the cells around a place; returns the index of the nearest.
static int sites_around(const FrBarkCells *cells, float x, float y, Site sites[SITES]) {
    int column = (int)floorf(x) - REACH, row = (int)floorf(y) - REACH;
    int nearest = 0;
    float least = INFINITY;
    for (int j = 0; j < SIDE; j++) {
        size_t start = (size_t)wrap(row + j, cells->along) * (size_t)cells->across;
        int wrapped = wrap(column, cells->across);
        for (int i = 0; i < SIDE; i++) {
            size_t cell = start + (size_t)wrapped;
            Site site = {.x = (float)(column + i) + cells->sites[2 * cell] - x,
                         .y = (float)(row + j) + cells->sites[2 * cell + 1] - y,
                         .cell = cell};
            float squared = site.x * site.x + site.y * site.y;
            sites[j * SIDE + i] = site;
            if (squared < least) {
                least = squared;
                nearest = j * SIDE + i;
            }
            wrapped = wrapped + 1 == cells->across ? 0 : wrapped + 1;
        }
    }
    return nearest;
}

FrBarkPlate fr_bark_plate(const FrBarkCells *cells, float u, float v) {
    const float far = 0.6f; // borders beyond it weigh nothing
    Site sites[SITES];
    int own = sites_around(cells, u * (float)cells->across, v * (float)cells->along, sites);
    Site nearest = sites[own];
    FrBarkPlate plate = {.edge = INFINITY, .random = cells->random[nearest.cell]};
    float weights = 1e-9f, upright = 0, other = 0;
    for (int i = 0; i < SITES; i++) {
        float dx = sites[i].x - nearest.x, dy = sites[i].y - nearest.y;
        float apart = sqrtf(dx * dx + dy * dy);
        if (i == own || apart < 1e-4f) {
            continue;
        }
        float edge = 0.5f * ((nearest.x + sites[i].x) * dx + (nearest.y + sites[i].y) * dy) / apart;
        plate.edge = fminf(plate.edge, edge);
        if (edge < far) {
            // Weighted over all borders: with the nearest one alone it would jump inside a plate.
            float weight = expf(-12.0f * edge) + 1e-6f;
            weights += weight;
            upright += weight * fabsf(dx) / apart;
            other += weight * cells->random[sites[i].cell];
        }
    }
    plate.upright = upright / weights;
    plate.other = other / weights;
    return plate;
}
