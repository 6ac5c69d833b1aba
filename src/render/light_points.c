// The light of a scene at points: balls in false colours among what stands there in grey, hidden
// where that is nearer to the eye.
#include "render/render.h"

#include "frond/lighting.h"
#include "render/camera.h"
#include "render/colour.h"
#include "render/light_scale.h"

#include <math.h>
#include <string.h>

// Radius and longest line of a ball, of the distance between the points of a grid …
#define GRID_RADIUS 0.11F
#define GRID_LINE 0.8F
// … and at organs of the size of the scene.
#define ORGAN_RADIUS 0.004F
#define ORGAN_LINE 0.03F
// No ball is smaller, in pixels; one that would hide so much of the picture is too near to the eye
// and left out.
#define LEAST_RADIUS 1.5F
#define MOST_PART 0.05F

/// A picture with the distance to what each pixel shows.
typedef struct Canvas {
    FrImage *image;
    float *distance;
    FrCamera camera;
    const FrWorld *world;
} Canvas;

/// What is asked for, in the world.
typedef struct Points {
    GArray *at; ///< vec3s
    FrLightAnswer *answers;
    float radius, line; ///< m
} Points;

// ---- where to ask -----------------------------------------------------------------------------

static float size_of(const double min[3], const double max[3]) {
    double size = 0;
    for (int c = 0; c < 3; c++) {
        size = fmax(size, max[c] - min[c]);
    }
    return size > 0 ? (float)size : 1;
}

static void place_grid(const FrScene *scene, uint32_t count, Points *points) {
    double min[3], max[3];
    uint32_t cells[3];
    fr_scene_bounds(scene, min, max);
    float spacing = size_of(min, max) / (float)count;
    for (int c = 0; c < 3; c++) {
        double size = fmax(max[c] - min[c], 0);
        cells[c] = (uint32_t)fmax(round(size / (double)spacing), 1);
        min[c] = 0.5 * (min[c] + max[c]) - 0.5 * (cells[c] - 1.0) * (double)spacing;
    }
    for (uint32_t i = 0; min[0] <= max[0] && i < cells[0] * cells[1] * cells[2]; i++) {
        uint32_t step[3] = {i % cells[0], i / cells[0] % cells[1], i / cells[0] / cells[1]};
        vec3s at;
        for (int c = 0; c < 3; c++) {
            at.raw[c] = (float)(min[c] + step[c] * (double)spacing);
        }
        g_array_append_val(points->at, at);
    }
    points->radius = GRID_RADIUS * spacing;
    points->line = GRID_LINE * spacing;
}

static void add_local(const FrStand *stand, vec3s local, GArray *points) {
    vec3s at = glms_vec3_rotate(glms_vec3_scale(local, (float)stand->scale), (float)stand->turn,
                                (vec3s){{0, 0, 1}});
    for (int c = 0; c < 3; c++) {
        at.raw[c] = (float)((double)at.raw[c] + stand->at[c]);
    }
    g_array_append_val(points, at);
}

static bool is_tip(const FrPlant *plant, uint32_t node) {
    uint32_t axis = plant->nodes.axis[node];
    return node + 1 >= plant->nodes.count || plant->nodes.axis[node + 1] != axis ||
           plant->nodes.parent[node + 1] != node;
}

static void place_at_organs(const FrScene *scene, Points *points) {
    double min[3], max[3];
    fr_scene_bounds(scene, min, max);
    for (guint s = 0; s < fr_scene_stand_count(scene); s++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, s);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        for (uint32_t i = 0; i < plant->organs.count; i++) {
            vec3s at;
            versors rotation;
            if ((plant->organs.flags[i] & (FR_SHED | FR_HIDDEN)) == 0) {
                fr_plant_organ_pose(plant, i, &at, &rotation);
                add_local(stand, at, points->at);
            }
        }
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            if (is_tip(plant, i) && (plant->nodes.flags[i] & (FR_SHED | FR_HIDDEN)) == 0) {
                add_local(stand, plant->nodes.position[i], points->at);
            }
        }
    }
    points->radius = ORGAN_RADIUS * size_of(min, max);
    points->line = ORGAN_LINE * size_of(min, max);
}

/// Refuses more than memory is allowed for, before it is taken.
static FrStatus count_organs(const FrScene *scene, const FrContext *context) {
    uint64_t count = 0;
    for (guint s = 0; s < scene->stands->len; s++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, s);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        count = fr_count_add(count, (uint64_t)plant->organs.count + plant->nodes.count);
    }
    return fr_limit_check(fr_count_multiply(count, sizeof(vec3s) + sizeof(FrLightAnswer)),
                          context->limits.bytes, "bytes", "the picture of light", (FrSpan){0},
                          context->diags);
}

static FrStatus ask(const FrScene *scene, Points *points, const FrContext *context) {
    FrLighting *lighting = NULL;
    points->answers = g_new0(FrLightAnswer, points->at->len + 1);
    FrStatus status = fr_lighting_new(scene, context, &lighting);
    if (status == FR_OK) {
        status = fr_lighting_update(lighting, scene, context);
    }
    if (status == FR_OK) {
        status = fr_lighting_query(lighting, (const vec3s *)(void *)points->at->data,
                                   points->at->len, context, points->answers);
    }
    fr_lighting_free(lighting);
    return status;
}

// ---- drawing ----------------------------------------------------------------------------------

/// What stands there, in dim greys: brighter where it is light in colour and faces the eye.
static void draw_rows(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Canvas *canvas = data;
    const FrImage *image = canvas->image;
    for (size_t i = begin * image->width; i < end * image->width; i++) {
        float x = ((float)(i % image->width) + 0.5f) / (float)image->width;
        float y = ((float)(i / image->width) + 0.5f) / (float)image->height;
        vec3s direction = fr_camera_direction(&canvas->camera, x, y);
        FrSurface surface;
        FrMet met = fr_world_trace(canvas->world, canvas->camera.origin, direction, &surface);
        float grey = 14;
        if (met != FR_MET_SKY) {
            const FrBsdf *bsdf = &surface.bsdf;
            vec3s colour = glms_vec3_add(glms_vec3_add(bsdf->reflectance, bsdf->transmittance),
                                         glms_vec3_add(bsdf->mirror, bsdf->clear));
            float facing = fabsf(glms_vec3_dot(bsdf->normal, direction));
            grey = 24 + 60 * sqrtf(fr_luminance(colour)) * (0.4f + 0.6f * facing);
        }
        memset(image->pixels + 3 * i, (int)fminf(grey, 110), 3);
        canvas->distance[i] = surface.distance;
    }
}

/// Where a point is seen, in pixels; false behind the eye. `*size` is that of a metre there.
static bool project(const Canvas *canvas, vec3s point, float pixel[2], float *size) {
    const FrCamera *camera = &canvas->camera;
    vec3s away = glms_vec3_sub(point, camera->origin);
    float ahead = glms_vec3_dot(away, camera->forward);
    if (!(ahead > 1e-4f)) {
        return false;
    }
    float width = (float)canvas->image->width, height = (float)canvas->image->height;
    *size = 0.5f * width / (camera->half_width * ahead);
    pixel[0] = 0.5f * width + glms_vec3_dot(away, camera->right) * *size;
    pixel[1] = 0.5f * height - glms_vec3_dot(away, camera->up) * *size;
    return isfinite(pixel[0]) && isfinite(pixel[1]) && isfinite(*size);
}

static void put(const Canvas *canvas, int x, int y, float distance, const uint8_t colour[3],
                float shade) {
    const FrImage *image = canvas->image;
    if (x < 0 || y < 0 || x >= (int)image->width || y >= (int)image->height) {
        return;
    }
    size_t i = (size_t)y * image->width + (size_t)x;
    if (distance < canvas->distance[i]) {
        canvas->distance[i] = distance;
        for (int c = 0; c < 3; c++) {
            image->pixels[3 * i + (size_t)c] = (uint8_t)((float)colour[c] * shade);
        }
    }
}

static void draw_ball(const Canvas *canvas, vec3s at, float radius, const uint8_t colour[3]) {
    float middle[2], size;
    if (!project(canvas, at, middle, &size)) {
        return;
    }
    float most = (float)MAX(canvas->image->width, canvas->image->height);
    float reach = fmaxf(radius * size, LEAST_RADIUS);
    if (reach > fmaxf(MOST_PART * most, LEAST_RADIUS) || fabsf(middle[0]) > 3 * most ||
        fabsf(middle[1]) > 3 * most) {
        return;
    }
    float distance = glms_vec3_distance(at, canvas->camera.origin);
    for (int y = (int)floorf(middle[1] - reach); y <= (int)ceilf(middle[1] + reach); y++) {
        for (int x = (int)floorf(middle[0] - reach); x <= (int)ceilf(middle[0] + reach); x++) {
            float a = ((float)x + 0.5f - middle[0]) / reach;
            float b = ((float)y + 0.5f - middle[1]) / reach;
            float height = 1 - a * a - b * b;
            if (height > 0) {
                height = sqrtf(height);
                put(canvas, x, y, distance - radius * height, colour, 0.7f + 0.3f * height);
            }
        }
    }
}

static void draw_line(const Canvas *canvas, vec3s from, vec3s to, const uint8_t colour[3]) {
    float begin[2], end[2], size;
    if (!project(canvas, from, begin, &size) || !project(canvas, to, end, &size)) {
        return;
    }
    float length = fmaxf(fabsf(end[0] - begin[0]), fabsf(end[1] - begin[1]));
    int steps = (int)fminf(ceilf(length), (float)canvas->image->width);
    for (int i = 1; i <= steps; i++) {
        float part = (float)i / (float)steps;
        vec3s at = glms_vec3_lerp(from, to, part);
        float pixel[2];
        if (project(canvas, at, pixel, &size) && fabsf(pixel[0]) < 1e6f && fabsf(pixel[1]) < 1e6f) {
            put(canvas, (int)floorf(pixel[0]), (int)floorf(pixel[1]),
                glms_vec3_distance(at, canvas->camera.origin), colour, 1);
        }
    }
}

static void draw_points(const Canvas *canvas, const FrScene *scene, const Points *points) {
    size_t count = points->at->len;
    float *light = g_new(float, count + 1);
    for (size_t i = 0; i < count; i++) {
        light[i] = points->answers[i].intensity;
    }
    float top = fr_light_scale_top(scene, light, count);
    for (size_t i = 0; i < count; i++) {
        const FrLightAnswer *answer = &points->answers[i];
        vec3s at = g_array_index(points->at, vec3s, i);
        for (int c = 0; c < 3; c++) {
            at.raw[c] = (float)((double)at.raw[c] - canvas->world->origin[c]);
        }
        uint8_t colour[3];
        fr_light_scale_paint(colour, light[i] / top);
        float length = points->line * answer->confidence;
        draw_ball(canvas, at, points->radius, colour);
        draw_line(canvas, at, glms_vec3_muladds(answer->direction, length, at), colour);
    }
    g_free(light);
}

static FrStatus draw(const FrScene *scene, const Points *points, const FrViewParams *view,
                     const FrRenderParams *params, const FrSkinParams *skin,
                     const FrContext *context, FrImage **image) {
    FrWorld *world;
    FrStatus status = fr_world_of_scene(scene, skin, context, &world);
    if (status != FR_OK) {
        return status;
    }
    uint32_t width = (uint32_t)params->width, height = (uint32_t)params->height;
    Canvas canvas = {.image = fr_image_new(width, height, 3),
                     .distance = g_new(float, (size_t)width *height),
                     .camera = fr_camera_frame(world, view, (float)width / (float)height),
                     .world = world};
    fr_parallel_for(context->pool, height, 4, draw_rows, &canvas, context->progress);
    if (fr_progress_is_cancelled(context->progress)) {
        fr_image_unref(canvas.image);
        status = FR_CANCELLED;
    } else {
        draw_points(&canvas, scene, points);
        *image = canvas.image;
    }
    g_free(canvas.distance);
    fr_world_free(world);
    return status;
}

FrStatus fr_render_light_points(const FrScene *scene, FrLightAt where, uint32_t count,
                                const FrRenderParams *params, const FrSkinParams *skin,
                                const FrContext *context, FrImage **image) {
    *image = NULL;
    FR_ASSERT(count >= 1 && count <= 128 && scene->surroundings != NULL);
    const FrViewParams *view;
    FrStatus status = fr_render_check_size(params, context);
    if (status == FR_OK) {
        status = fr_render_find_view(scene, params->view, context, &view);
    }
    if (status == FR_OK && where == FR_LIGHT_AT_ORGANS) {
        status = count_organs(scene, context);
    }
    if (status != FR_OK) {
        return status;
    }
    Points points = {.at = g_array_new(FALSE, FALSE, sizeof(vec3s))};
    if (where == FR_LIGHT_AT_GRID) {
        place_grid(scene, count, &points);
    } else {
        place_at_organs(scene, &points);
    }
    status = ask(scene, &points, context);
    if (status == FR_OK) {
        status = draw(scene, &points, view, params, skin, context, image);
    }
    g_free(points.answers);
    g_array_unref(points.at);
    return status;
}
