// Rendering a scene: tiles of pixels, each pixel done whole by one thread in the order of its
// samples, so that the picture is the same for any number of threads.
#include "render/render.h"

#include "render/camera.h"
#include "render/colour.h"
#include "render/film.h"
#include "render/path.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

enum { TILE = 16, FILTER_STEPS = 64 };

// Pixels' filters reach this far from their middles, in pixels.
#define FILTER_RADIUS 1.5f
// Distant ground is hazy from so many camera distances on.
#define HAZE_DISTANCES 16.0f

#define FR_PARAM_STRUCT FrRenderParams
static const FrParam render_rows[] = {FR_RENDER_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable render_table = {
    .element = "render",
    .meaning = "a path-traced still",
    .rows = render_rows,
    .count = sizeof render_rows / sizeof render_rows[0],
    .struct_size = sizeof(FrRenderParams),
};

const FrParamTable *fr_render_table(void) {
    return &render_table;
}

typedef struct Job {
    const FrWorld *world;
    FrCamera camera;
    FrFilm *film;
    uint32_t samples, bounces;
    uint32_t tiles_across, tile_count;
    float
        filter[FILTER_STEPS + 1]; ///< offsets from the middle at even parts of the filter's weight
    FrProgress *progress;
    atomic_uint tiles_done;
} Job;

/// The inverse of the running integral of a Blackman-Harris window over −radius … radius. Samples
/// are placed by it instead of weighted (Ernst, Stamminger, Greiner 2006, Filter Importance
/// Sampling), so no pixel needs another's samples.
static void make_filter(float *filter) {
    enum { CELLS = 4096 };
    double sums[CELLS + 1];
    sums[0] = 0.0;
    for (int i = 0; i < CELLS; i++) {
        double turn = 2.0 * G_PI * (i + 0.5) / CELLS;
        double weight =
            0.35875 - 0.48829 * cos(turn) + 0.14128 * cos(2 * turn) - 0.01168 * cos(3 * turn);
        sums[i + 1] = sums[i] + weight;
    }
    int cell = 0;
    for (int i = 0; i <= FILTER_STEPS; i++) {
        double wanted = sums[CELLS] * i / FILTER_STEPS;
        while (cell < CELLS - 1 && sums[cell + 1] < wanted) {
            cell++;
        }
        double inside = (wanted - sums[cell]) / (sums[cell + 1] - sums[cell]);
        filter[i] = FILTER_RADIUS * (float)(2.0 * (cell + inside) / CELLS - 1.0);
    }
}

static float filter_offset(const float *filter, float u) {
    float place = u * FILTER_STEPS;
    int step = (int)fminf(place, FILTER_STEPS - 1);
    float part = place - (float)step;
    return filter[step] * (1.0f - part) + filter[step + 1] * part;
}

static void render_pixel(const Job *job, uint32_t x, uint32_t y) {
    FrFilm *film = job->film;
    vec3s light[2] = {glms_vec3_zero(), glms_vec3_zero()};
    vec3s albedo = glms_vec3_zero();
    vec3s normal = glms_vec3_zero();
    float cover = 0.0f;
    for (uint32_t i = 0; i < job->samples; i++) {
        FrSampler sampler = fr_sampler(x, y, i, job->samples);
        float u;
        float v;
        fr_sampler_pair(&sampler, &u, &v);
        float at_x = ((float)x + 0.5f + filter_offset(job->filter, u)) / (float)film->width;
        float at_y = ((float)y + 0.5f + filter_offset(job->filter, v)) / (float)film->height;
        vec3s direction = fr_camera_direction(&job->camera, at_x, at_y);
        FrPathSample sample =
            fr_path_trace(job->world, job->camera.origin, direction, &sampler, job->bounces);
        light[i & 1] = glms_vec3_add(light[i & 1], sample.radiance);
        albedo = glms_vec3_add(albedo, sample.albedo);
        normal = glms_vec3_add(normal, sample.normal);
        cover += sample.is_sky ? 0.0f : 1.0f;
    }
    size_t pixel = (size_t)y * film->width + x;
    float count = (float)job->samples;
    film->half[0][pixel] = glms_vec3_scale(light[0], 1.0f / (float)((job->samples + 1) / 2));
    film->half[1][pixel] = job->samples > 1
                               ? glms_vec3_scale(light[1], 1.0f / (float)(job->samples / 2))
                               : film->half[0][pixel];
    film->albedo[pixel] = glms_vec3_scale(albedo, 1.0f / count);
    film->normal[pixel] = glms_vec3_scale(normal, 1.0f / count);
    film->cover[pixel] = cover / count;
}

static void render_tiles(void *data, size_t begin, size_t end, int worker) {
    Job *job = data;
    (void)worker;
    for (size_t tile = begin; tile < end; tile++) {
        uint32_t left = (uint32_t)(tile % job->tiles_across) * TILE;
        uint32_t top = (uint32_t)(tile / job->tiles_across) * TILE;
        uint32_t right = MIN(left + TILE, job->film->width);
        uint32_t bottom = MIN(top + TILE, job->film->height);
        for (uint32_t y = top; y < bottom; y++) {
            for (uint32_t x = left; x < right; x++) {
                if (fr_progress_is_cancelled(job->progress)) {
                    return;
                }
                render_pixel(job, x, y);
            }
        }
        unsigned done = atomic_fetch_add(&job->tiles_done, 1) + 1;
        fr_progress_report(job->progress, "render", (double)done / job->tile_count);
    }
}

FrStatus fr_render_check_size(const FrRenderParams *params, const FrContext *context) {
    if (params->width < 1 || params->height < 1 || params->width > UINT32_MAX ||
        params->height > UINT32_MAX || params->samples < 1 || params->samples > UINT32_MAX ||
        params->bounces < 0 || params->bounces > UINT32_MAX) {
        fr_diags_add(context->diags, FR_ERROR, "picture-size", (FrSpan){0},
                     "a picture needs a width, a height and samples of at least 1");
        return FR_ERR_USAGE;
    }
    uint64_t pixels = fr_count_multiply((uint64_t)params->width, (uint64_t)params->height);
    FrStatus status = fr_limit_check(pixels, context->limits.pixels, "pixels", "the picture",
                                     (FrSpan){0}, context->diags);
    if (status == FR_OK) {
        status = fr_limit_check(fr_film_bytes(pixels), context->limits.bytes, "bytes",
                                "the picture", (FrSpan){0}, context->diags);
    }
    return status;
}

FrStatus fr_render_find_view(const FrScene *scene, const char *name, const FrContext *context,
                             const FrViewParams **view) {
    *view = NULL;
    if (name == NULL || *name == '\0') {
        if (scene->views->len > 0) {
            *view = g_ptr_array_index(scene->views, 0);
        }
        return FR_OK;
    }
    const char **names = g_new0(const char *, scene->views->len + 1);
    size_t count = 0;
    for (guint i = 0; i < scene->views->len && *view == NULL; i++) {
        const FrViewParams *candidate = g_ptr_array_index(scene->views, i);
        if (candidate->name == NULL) {
            continue;
        }
        names[count++] = candidate->name;
        if (strcmp(candidate->name, name) == 0) {
            *view = candidate;
        }
    }
    if (*view == NULL) {
        const char *near = fr_nearest_name(name, names, count);
        fr_diags_add(context->diags, FR_ERROR, "unknown-view", (FrSpan){0},
                     near != NULL ? "there is no view '%s'; did you mean '%s'?"
                                  : "there is no view '%s'",
                     name, near);
    }
    g_free(names);
    return *view != NULL ? FR_OK : FR_ERR_USAGE;
}

FrStatus fr_render_world(FrWorld *world, const FrViewParams *view, double stops,
                         const FrRenderParams *params, const FrContext *context, FrImage **image) {
    uint32_t width = (uint32_t)params->width;
    uint32_t height = (uint32_t)params->height;
    Job job = {
        .world = world,
        .camera = fr_camera_frame(world, view, (float)width / (float)height),
        .film = fr_film_new(width, height),
        .samples = (uint32_t)params->samples,
        .bounces = (uint32_t)params->bounces,
        .tiles_across = (width + TILE - 1) / TILE,
        .progress = context->progress,
    };
    job.tile_count = job.tiles_across * ((height + TILE - 1) / TILE);
    make_filter(job.filter);
    if (world->ground != NULL) {
        world->ground->haze = HAZE_DISTANCES * job.camera.distance;
    }
    fr_parallel_for(context->pool, job.tile_count, 1, render_tiles, &job, context->progress);
    FrStatus status = FR_CANCELLED;
    vec3s *light = NULL;
    if (!fr_progress_is_cancelled(context->progress)) {
        light = fr_film_denoise(job.film, context);
    }
    if (light != NULL) {
        float white = fr_luminance(world->white) / FR_PI_F;
        float exposure = fr_film_exposure(job.film, light, white) * (float)exp2(stops);
        *image = fr_film_develop(job.film, light, exposure, fr_film_balance(world->white));
        status = FR_OK;
    }
    g_free(light);
    fr_film_free(job.film);
    return status;
}

FrStatus fr_render(const FrScene *scene, const FrRenderParams *params, const FrSkinParams *skin,
                   const FrContext *context, FrImage **image) {
    *image = NULL;
    const FrViewParams *view = NULL;
    FrStatus status = fr_render_check_size(params, context);
    if (status == FR_OK) {
        status = fr_render_find_view(scene, params->view, context, &view);
    }
    FrWorld *world = NULL;
    if (status == FR_OK) {
        status = fr_world_of_scene(scene, skin, context, &world);
    }
    if (status == FR_OK) {
        status = fr_render_world(world, view, scene->params->exposure, params, context, image);
    }
    fr_world_free(world);
    return status;
}
