// Less noise without less detail: non-local means between the two halves of the film (Rousselle,
// Knaus, Zwicker 2012, Adaptive Rendering with Non-Local Means Filtering). Pixels are averaged only
// as far as their neighbourhoods agree within the noise that the halves' difference shows, and the
// weights of one half come from the other, so its noise is not mistaken for likeness. Light is
// divided by the colour of what is seen first, which has next to no noise, so patterns of ground,
// bark and leaves stay out of it.
#include "render/colour.h"
#include "render/film.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

enum { REACH = 5, PATCH = 2, BAND = 16 };

// Larger: more is taken for noise. The variance of the difference of two pixels counts this often.
#define TOLERANCE 0.5f
#define NORMAL_SPREAD 0.12f
#define COVER_SPREAD 0.04f
#define ALBEDO_SPREAD 0.35f
#define DARKEST_ALBEDO 0.004f

typedef struct Denoise {
    const FrFilm *film;
    vec3s *half[2];  ///< light over albedo
    vec3s *variance; ///< of a half, averaged over the neighbourhood
    vec3s *result;
    FrProgress *progress;
} Denoise;

static vec3s divisor(const FrFilm *film, size_t i) {
    return glms_vec3_maxv(film->albedo[i],
                          (vec3s){{DARKEST_ALBEDO, DARKEST_ALBEDO, DARKEST_ALBEDO}});
}

static void divide_rows(void *data, size_t begin, size_t end, int worker) {
    Denoise *job = data;
    const FrFilm *film = job->film;
    (void)worker;
    for (size_t i = begin * film->width; i < end * film->width; i++) {
        vec3s by = divisor(film, i);
        job->half[0][i] = glms_vec3_div(film->half[0][i], by);
        job->half[1][i] = glms_vec3_div(film->half[1][i], by);
    }
}

/// The variance of one half, from the squared differences of both around each pixel.
static void estimate_rows(void *data, size_t begin, size_t end, int worker) {
    Denoise *job = data;
    int width = (int)job->film->width;
    int height = (int)job->film->height;
    (void)worker;
    for (int y = (int)begin; y < (int)end; y++) {
        for (int x = 0; x < width; x++) {
            vec3s sum = glms_vec3_zero();
            float count = 0.0f;
            for (int dy = -PATCH; dy <= PATCH; dy++) {
                for (int dx = -PATCH; dx <= PATCH; dx++) {
                    int px = x + dx;
                    int py = y + dy;
                    if (px < 0 || py < 0 || px >= width || py >= height) {
                        continue;
                    }
                    size_t i = (size_t)py * (size_t)width + (size_t)px;
                    vec3s difference = glms_vec3_sub(job->half[0][i], job->half[1][i]);
                    sum = glms_vec3_add(sum, glms_vec3_mul(difference, difference));
                    count += 1.0f;
                }
            }
            job->variance[(size_t)y * (size_t)width + (size_t)x] =
                glms_vec3_scale(sum, 0.5f / count);
        }
    }
}

/// How unlike two pixels of a half are: 0 if they differ by no more than their noise.
static float unlikeness(const Denoise *job, const vec3s *half, size_t p, size_t q) {
    float sum = 0.0f;
    for (int c = 0; c < 3; c++) {
        float difference = half[p].raw[c] - half[q].raw[c];
        float noise = job->variance[p].raw[c];
        float other = job->variance[q].raw[c];
        sum += (difference * difference - noise - fminf(noise, other)) /
               (1e-10f + TOLERANCE * TOLERANCE * (noise + other));
    }
    return sum / 3.0f;
}

/// Whether two pixels show the same kind of surface, 1 to 0.
static float kinship(const FrFilm *film, size_t p, size_t q) {
    vec3s normal = glms_vec3_sub(film->normal[p], film->normal[q]);
    float cover = film->cover[p] - film->cover[q];
    float unlike = glms_vec3_dot(normal, normal) / (NORMAL_SPREAD * NORMAL_SPREAD) +
                   cover * cover / (COVER_SPREAD * COVER_SPREAD);
    for (int c = 0; c < 3; c++) {
        float ratio = logf((film->albedo[p].raw[c] + DARKEST_ALBEDO) /
                           (film->albedo[q].raw[c] + DARKEST_ALBEDO));
        unlike += ratio * ratio / (ALBEDO_SPREAD * ALBEDO_SPREAD);
    }
    return expf(-unlike);
}

/// The rows of a band with room for the patches around them, for one offset.
typedef struct Band {
    int top, rows, width, height;
    float *unlike[2]; ///< (rows + 2 PATCH) × width
    float *across[2]; ///< the same, summed along x
    vec3s *sum[2];    ///< rows × width
    float *weight[2];
} Band;

static void fill_unlikeness(const Denoise *job, Band *band, int dx, int dy) {
    for (int row = 0; row < band->rows + 2 * PATCH; row++) {
        int y = MIN(MAX(band->top + row - PATCH, 0), band->height - 1);
        int other_y = MIN(MAX(y + dy, 0), band->height - 1);
        for (int x = 0; x < band->width; x++) {
            int other_x = MIN(MAX(x + dx, 0), band->width - 1);
            size_t p = (size_t)y * (size_t)band->width + (size_t)x;
            size_t q = (size_t)other_y * (size_t)band->width + (size_t)other_x;
            size_t at = (size_t)row * (size_t)band->width + (size_t)x;
            band->unlike[0][at] = unlikeness(job, job->half[0], p, q);
            band->unlike[1][at] = unlikeness(job, job->half[1], p, q);
        }
    }
}

static void sum_across(Band *band) {
    for (int half = 0; half < 2; half++) {
        for (int row = 0; row < band->rows + 2 * PATCH; row++) {
            const float *from = band->unlike[half] + (size_t)row * (size_t)band->width;
            float *to = band->across[half] + (size_t)row * (size_t)band->width;
            for (int x = 0; x < band->width; x++) {
                float sum = 0.0f;
                for (int d = -PATCH; d <= PATCH; d++) {
                    sum += from[MIN(MAX(x + d, 0), band->width - 1)];
                }
                to[x] = sum;
            }
        }
    }
}

static float patch_weight(const Band *band, int half, int row, int x) {
    float sum = 0.0f;
    for (int d = 0; d <= 2 * PATCH; d++) {
        sum += band->across[half][(size_t)(row + d) * (size_t)band->width + (size_t)x];
    }
    float mean = sum / (float)((2 * PATCH + 1) * (2 * PATCH + 1));
    return expf(-fmaxf(mean, 0.0f));
}

static void gather_offset(const Denoise *job, Band *band, int dx, int dy) {
    fill_unlikeness(job, band, dx, dy);
    sum_across(band);
    int first = MAX(0, -dx);
    int last = MIN(band->width, band->width - dx);
    for (int row = 0; row < band->rows; row++) {
        int y = band->top + row;
        if (y + dy < 0 || y + dy >= band->height) {
            continue;
        }
        for (int x = first; x < last; x++) {
            size_t p = (size_t)y * (size_t)band->width + (size_t)x;
            size_t q = (size_t)(y + dy) * (size_t)band->width + (size_t)(x + dx);
            size_t at = (size_t)row * (size_t)band->width + (size_t)x;
            float kin = kinship(job->film, p, q);
            if (kin < 1e-4f) {
                continue;
            }
            for (int half = 0; half < 2; half++) {
                float weight = kin * patch_weight(band, 1 - half, row, x);
                band->sum[half][at] =
                    glms_vec3_muladds(job->half[half][q], weight, band->sum[half][at]);
                band->weight[half][at] += weight;
            }
        }
    }
}

static void finish_band(const Denoise *job, const Band *band) {
    for (int row = 0; row < band->rows; row++) {
        for (int x = 0; x < band->width; x++) {
            size_t at = (size_t)row * (size_t)band->width + (size_t)x;
            size_t p = (size_t)(band->top + row) * (size_t)band->width + (size_t)x;
            vec3s a = glms_vec3_scale(band->sum[0][at], 0.5f / band->weight[0][at]);
            vec3s b = glms_vec3_scale(band->sum[1][at], 0.5f / band->weight[1][at]);
            job->result[p] = glms_vec3_mul(glms_vec3_add(a, b), divisor(job->film, p));
        }
    }
}

static void denoise_bands(void *data, size_t begin, size_t end, int worker) {
    Denoise *job = data;
    (void)worker;
    size_t width = job->film->width;
    size_t padded = (BAND + 2 * PATCH) * width;
    float *floats = g_new(float, 4 * padded + 2 * BAND * width);
    vec3s *sums = g_new(vec3s, 2 * BAND * width);
    for (size_t i = begin; i < end && !fr_progress_is_cancelled(job->progress); i++) {
        int top = (int)i * BAND;
        Band band = {
            .top = top,
            .rows = MIN(BAND, (int)job->film->height - top),
            .width = (int)width,
            .height = (int)job->film->height,
            .unlike = {floats, floats + padded},
            .across = {floats + 2 * padded, floats + 3 * padded},
            .sum = {sums, sums + BAND * width},
            .weight = {floats + 4 * padded, floats + 4 * padded + BAND * width},
        };
        memset(sums, 0, 2 * BAND * width * sizeof *sums);
        memset(band.weight[0], 0, 2 * BAND * width * sizeof(float));
        for (int dy = -REACH; dy <= REACH; dy++) {
            for (int dx = -REACH; dx <= REACH; dx++) {
                gather_offset(job, &band, dx, dy);
            }
        }
        finish_band(job, &band);
    }
    g_free(floats);
    g_free(sums);
}

vec3s *fr_film_denoise(const FrFilm *film, const FrContext *context) {
    size_t count = (size_t)film->width * film->height;
    size_t bands = (film->height + BAND - 1) / BAND;
    Denoise job = {
        .film = film,
        .half = {g_new(vec3s, count), g_new(vec3s, count)},
        .variance = g_new(vec3s, count),
        .result = g_new(vec3s, count),
        .progress = context->progress,
    };
    fr_parallel_for(context->pool, film->height, 16, divide_rows, &job, NULL);
    fr_parallel_for(context->pool, film->height, 16, estimate_rows, &job, NULL);
    fr_parallel_for(context->pool, bands, 1, denoise_bands, &job, context->progress);
    g_free(job.half[0]);
    g_free(job.half[1]);
    g_free(job.variance);
    if (fr_progress_is_cancelled(context->progress)) {
        g_free(job.result);
        return NULL;
    }
    return job.result;
}
