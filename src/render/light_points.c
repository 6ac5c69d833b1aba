// The light of a scene at points: balls in false colours among what stands there in grey, hidden
// where that is nearer to the eye.
#include "render/render.h"

#include "frond/lighting.h"
#include "render/camera.h"
#include "render/colour.h"

#include <math.h>
#include <string.h>

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

/// What is asked for, and what was answered.
typedef struct Points {
    FrLightPlaces places;
    FrLightAnswer *answers;
} Points;

static FrStatus ask(const FrScene *scene, Points *points, const FrContext *context) {
    FrLighting *lighting = NULL;
    points->answers = g_new0(FrLightAnswer, points->places.at->len + 1);
    FrStatus status = fr_lighting_new(scene, context, &lighting);
    if (status == FR_OK) {
        status = fr_lighting_update(lighting, scene, context);
    }
    if (status == FR_OK) {
        status = fr_lighting_query(lighting, (const vec3s *)(void *)points->places.at->data,
                                   points->places.at->len, context, points->answers);
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
    size_t count = points->places.at->len;
    float *light = g_new(float, count + 1);
    for (size_t i = 0; i < count; i++) {
        light[i] = points->answers[i].intensity;
    }
    float top = fr_light_scale_top(scene, light, count);
    for (size_t i = 0; i < count; i++) {
        const FrLightAnswer *answer = &points->answers[i];
        vec3s at = g_array_index(points->places.at, vec3s, i);
        for (int c = 0; c < 3; c++) {
            at.raw[c] = (float)((double)at.raw[c] - canvas->world->origin[c]);
        }
        uint8_t colour[3];
        fr_light_scale_paint(colour, light[i] / top);
        float length = points->places.line * answer->confidence;
        draw_ball(canvas, at, points->places.radius, colour);
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
    Points points = {0};
    if (status == FR_OK) {
        status = fr_light_places(scene, where, count, context, &points.places);
    }
    if (status != FR_OK) {
        return status;
    }
    status = ask(scene, &points, context);
    if (status == FR_OK) {
        status = draw(scene, &points, view, params, skin, context, image);
    }
    g_free(points.answers);
    g_array_unref(points.places.at);
    return status;
}
