// The light of a scene in false colours, along a slice. It is sampled on a grid and interpolated;
// the skeletons of plants are drawn on top.
#include "render/render.h"

#include "frond/lighting.h"

#include <cglm/struct.h>
#include <math.h>

enum { CELLS = 160 }; // along the longer side of the picture

/// Where the picture lies in the world: axes 0, 1, 2 are x, y, z.
typedef struct Slice {
    int across, up, depth; ///< which axis goes where
    double at;             ///< along `depth`
    double left, bottom;   ///< of the picture's corner
    double pixel;          ///< metres
    uint32_t width, height;
} Slice;

/// The grid of samples.
typedef struct Grid {
    uint32_t columns, rows;
    double cell; ///< pixels
    float *light;
} Grid;

static Slice frame_slice(const FrScene *scene, int axis, double at, uint32_t width,
                         uint32_t height) {
    static const int axes[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    Slice slice = {axes[axis][0], axes[axis][1], axis, at, 0, 0, 0, width, height};
    double min[3], max[3];
    fr_scene_bounds(scene, min, max);
    double size[2] = {max[slice.across] - min[slice.across], max[slice.up] - min[slice.up]};
    bool is_empty = !(size[0] > 0 && size[1] > 0);
    slice.pixel = is_empty ? 1.0 / width : 1.02 * fmax(size[0] / width, size[1] / height);
    double middle[2] = {is_empty ? 0 : 0.5 * (min[slice.across] + max[slice.across]),
                        is_empty ? 0 : 0.5 * (min[slice.up] + max[slice.up])};
    slice.left = middle[0] - 0.5 * slice.pixel * width;
    slice.bottom = middle[1] - 0.5 * slice.pixel * height;
    return slice;
}

static FrStatus sample(const Slice *slice, Grid *grid, FrLighting *lighting,
                       const FrContext *context) {
    uint32_t count = grid->columns * grid->rows;
    vec3s *points = g_new(vec3s, count);
    FrLightAnswer *answers = g_new(FrLightAnswer, count);
    for (uint32_t i = 0; i < count; i++) {
        double x = slice->left + slice->pixel * grid->cell * (i % grid->columns);
        double y = slice->bottom + slice->pixel * grid->cell * (i / grid->columns);
        points[i].raw[slice->across] = (float)x;
        points[i].raw[slice->up] = (float)y;
        points[i].raw[slice->depth] = (float)slice->at;
    }
    FrStatus status = fr_lighting_query(lighting, points, count, context, answers);
    for (uint32_t i = 0; i < count && status == FR_OK; i++) {
        grid->light[i] = answers[i].intensity;
    }
    g_free(points);
    g_free(answers);
    return status;
}

static void paint_light(const Grid *grid, float top, FrImage *image) {
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++) {
            double column = (x + 0.5) / grid->cell;
            double row = (image->height - y - 0.5) / grid->cell;
            uint32_t i = (uint32_t)column, j = (uint32_t)row;
            float u = (float)(column - i), v = (float)(row - j);
            const float *at = grid->light + (size_t)j * grid->columns + i;
            float lower = glm_lerp(at[0], at[1], u);
            float upper = glm_lerp(at[grid->columns], at[grid->columns + 1], u);
            fr_light_scale_paint(image->pixels + ((size_t)y * image->width + x) * 3,
                                 glm_lerp(lower, upper, v) / top);
        }
    }
}

/// A point of a plant in pixels of the picture.
static void project(const Slice *slice, const FrStand *stand, vec3s local, double pixel[2]) {
    double sine = sin(stand->turn), cosine = cos(stand->turn);
    double x = stand->scale * (double)local.x, y = stand->scale * (double)local.y;
    double world[3] = {stand->at[0] + cosine * x - sine * y, stand->at[1] + sine * x + cosine * y,
                       stand->at[2] + stand->scale * (double)local.z};
    pixel[0] = (world[slice->across] - slice->left) / slice->pixel;
    pixel[1] = slice->height - (world[slice->up] - slice->bottom) / slice->pixel;
}

/// White on dark light, black on bright one.
static void draw_line(FrImage *image, const double from[2], const double to[2]) {
    double length = fmax(fabs(to[0] - from[0]), fabs(to[1] - from[1]));
    int steps = (int)fmin(ceil(length), 100000);
    for (int i = 0; i <= steps; i++) {
        double part = steps == 0 ? 0 : (double)i / steps;
        double x = from[0] + part * (to[0] - from[0]), y = from[1] + part * (to[1] - from[1]);
        if (x >= 0 && y >= 0 && x < image->width && y < image->height) {
            uint8_t *pixel = image->pixels + ((size_t)y * image->width + (size_t)x) * 3;
            uint8_t shade = pixel[1] > 110 ? 20 : 235;
            pixel[0] = pixel[1] = pixel[2] = shade;
        }
    }
}

static void draw_plants(const FrScene *scene, const Slice *slice, FrImage *image) {
    for (guint s = 0; s < scene->stands->len; s++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, s);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            uint32_t axis = plant->nodes.axis[i], parent = plant->nodes.parent[i];
            vec3s base = plant->axes.first[axis] == i ? fr_plant_axis_origin(plant, axis)
                                                      : plant->nodes.position[parent];
            double from[2], to[2];
            project(slice, stand, base, from);
            project(slice, stand, plant->nodes.position[i], to);
            draw_line(image, from, to);
        }
    }
}

static FrStatus picture_of(const FrScene *scene, const Slice *slice, FrLighting *lighting,
                           const FrContext *context, FrImage **image) {
    Grid grid = {.cell = fmax((double)MAX(slice->width, slice->height) / CELLS, 1)};
    grid.columns = (uint32_t)ceil(slice->width / grid.cell) + 2;
    grid.rows = (uint32_t)ceil(slice->height / grid.cell) + 2;
    grid.light = g_new0(float, (size_t)grid.columns *grid.rows);
    FrStatus status = sample(slice, &grid, lighting, context);
    if (status == FR_OK) {
        *image = fr_image_new(slice->width, slice->height, 3);
        size_t count = (size_t)grid.columns * grid.rows;
        paint_light(&grid, fr_light_scale_top(scene, grid.light, count), *image);
        draw_plants(scene, slice, *image);
    }
    g_free(grid.light);
    return status;
}

FrStatus fr_render_light(const FrScene *scene, int axis, double at, const FrRenderParams *params,
                         const FrContext *context, FrImage **image) {
    *image = NULL;
    FR_ASSERT(axis >= 0 && axis < 3 && scene->surroundings != NULL);
    FrStatus status = fr_render_check_size(params, context);
    FrLighting *lighting = NULL;
    if (status == FR_OK) {
        status = fr_lighting_new(scene, context, &lighting);
    }
    if (status == FR_OK) {
        status = fr_lighting_update(lighting, scene, context);
    }
    if (status == FR_OK) {
        Slice slice =
            frame_slice(scene, axis, at, (uint32_t)params->width, (uint32_t)params->height);
        status = picture_of(scene, &slice, lighting, context, image);
    }
    fr_lighting_free(lighting);
    return status;
}
