// Framing: for a fixed direction of view, the nearest point from which everything lies between the
// four planes of the picture's frame. Each plane touches the scene in its extreme point, so the
// answer is exact for the points looked at.
#include "render/camera.h"

#include "render/colour.h"

#include <math.h>

#define MARGIN 0.06f
#define DEGREE (G_PI / 180.0)
#define DEFAULT_AZIMUTH (-30.0 * DEGREE)
#define DEFAULT_FIELD (35.0 * DEGREE)

// With more vertices than this, every so many are looked at.
enum { POINTS_LOOKED_AT = 4000000 };

typedef void (*PointFn)(void *data, vec3s point);

static void for_each_point(const FrWorld *world, PointFn look, void *data) {
    uint64_t total = 0;
    for (guint i = 0; i < world->stands->len; i++) {
        uint32_t mesh = g_array_index(world->stands, FrWorldStand, i).mesh;
        total += g_array_index(world->meshes, FrWorldMesh, mesh).mesh->vertex_count;
    }
    uint64_t stride = total / POINTS_LOOKED_AT + 1;
    for (guint i = 0; i < world->stands->len; i++) {
        const FrWorldStand *stand = &g_array_index(world->stands, FrWorldStand, i);
        const FrMesh *mesh = g_array_index(world->meshes, FrWorldMesh, stand->mesh).mesh;
        for (uint64_t v = 0; v < mesh->vertex_count; v += stride) {
            vec3s local = fr_vec3_of(mesh->vertices[v].position);
            vec3s point = glms_mat4_mulv3(stand->transform, local, 1.0f);
            if (isfinite(point.x) && isfinite(point.y) && isfinite(point.z)) {
                look(data, point);
            }
        }
    }
}

typedef struct Box {
    vec3s min, max;
} Box;

static void grow_box(void *data, vec3s point) {
    Box *box = data;
    box->min = glms_vec3_minv(box->min, point);
    box->max = glms_vec3_maxv(box->max, point);
}

static Box bounds(const FrWorld *world) {
    if (world->is_framed) {
        return (Box){world->frame_min, world->frame_max};
    }
    Box box = {{{INFINITY, INFINITY, INFINITY}}, {{-INFINITY, -INFINITY, -INFINITY}}};
    for_each_point(world, grow_box, &box);
    if (!(box.min.x <= box.max.x)) {
        box = (Box){{{-0.5f, -0.5f, 0.0f}}, {{0.5f, 0.5f, 1.0f}}};
    }
    return box;
}

/// The extremes of x ± depth·slope and y ± depth·slope in the camera's frame.
typedef struct Extremes {
    const FrCamera *camera;
    float slope_x, slope_y;
    float right, left, top, bottom;
} Extremes;

static void touch_planes(void *data, vec3s point) {
    Extremes *extremes = data;
    const FrCamera *camera = extremes->camera;
    float x = glms_vec3_dot(point, camera->right);
    float y = glms_vec3_dot(point, camera->up);
    float depth = glms_vec3_dot(point, camera->forward);
    extremes->right = fmaxf(extremes->right, x - depth * extremes->slope_x);
    extremes->left = fmaxf(extremes->left, -x - depth * extremes->slope_x);
    extremes->top = fmaxf(extremes->top, y - depth * extremes->slope_y);
    extremes->bottom = fmaxf(extremes->bottom, -y - depth * extremes->slope_y);
}

static void touch_box(Extremes *extremes, const Box *box) {
    for (int i = 0; i < 8; i++) {
        touch_planes(extremes, (vec3s){{(i & 1) != 0 ? box->max.x : box->min.x,
                                        (i & 2) != 0 ? box->max.y : box->min.y,
                                        (i & 4) != 0 ? box->max.z : box->min.z}});
    }
}

/// Where the camera has to stand, in its own frame: (x, y, depth).
static vec3s stand_back(const FrWorld *world, const FrCamera *camera, const Box *box) {
    Extremes extremes = {
        .camera = camera,
        .slope_x = camera->half_width * (1.0f - 2.0f * MARGIN),
        .slope_y = camera->half_height * (1.0f - 2.0f * MARGIN),
        .right = -INFINITY,
        .left = -INFINITY,
        .top = -INFINITY,
        .bottom = -INFINITY,
    };
    if (!world->is_framed) {
        for_each_point(world, touch_planes, &extremes);
    }
    if (isinf(extremes.right)) {
        touch_box(&extremes, box);
    }
    float depth_x = -(extremes.right + extremes.left) / (2.0f * extremes.slope_x);
    float depth_y = -(extremes.top + extremes.bottom) / (2.0f * extremes.slope_y);
    return (vec3s){{0.5f * (extremes.right - extremes.left),
                    0.5f * (extremes.top - extremes.bottom), fminf(depth_x, depth_y)}};
}

/// Low before trees, looking down on herbs.
static double default_elevation(const Box *box) {
    double height = fmax((double)(box->max.z - fmaxf(box->min.z, 0.0f)), 1e-3);
    double part = fmin(fmax(log(height / 0.4) / log(6.0 / 0.4), 0.0), 1.0);
    return (16.0 + part * (3.0 - 16.0)) * DEGREE;
}

static void set_directions(FrCamera *camera, double azimuth, double elevation) {
    vec3s back = {{(float)(sin(azimuth) * cos(elevation)), (float)(-cos(azimuth) * cos(elevation)),
                   (float)sin(elevation)}};
    camera->forward = glms_vec3_negate(back);
    camera->right = (vec3s){{(float)cos(azimuth), (float)sin(azimuth), 0}};
    camera->up = glms_vec3_cross(camera->right, camera->forward);
}

/// A camera that stands where the view says.
static FrCamera placed_camera(const FrWorld *world, const FrViewParams *view, float aspect) {
    vec3s back = glms_vec3_sub(view->eye, view->target);
    vec3s shift = {{(float)world->origin[0], (float)world->origin[1], (float)world->origin[2]}};
    FrCamera camera = {.half_height = (float)tan(0.5 * view->field_of_view),
                       .distance = glms_vec3_norm(back),
                       .origin = glms_vec3_sub(view->eye, shift)};
    camera.half_width = camera.half_height * aspect;
    set_directions(&camera, atan2((double)back.x, (double)-back.y),
                   atan2((double)back.z, hypot((double)back.x, (double)back.y)));
    return camera;
}

FrCamera fr_camera_frame(const FrWorld *world, const FrViewParams *view, float aspect) {
    if (view != NULL && !glms_vec3_eqv(view->eye, view->target)) {
        return placed_camera(world, view, aspect);
    }
    Box box = bounds(world);
    double azimuth = view != NULL ? view->azimuth : DEFAULT_AZIMUTH;
    double elevation = view != NULL ? view->elevation : default_elevation(&box);
    double field = view != NULL ? view->field_of_view : DEFAULT_FIELD;
    float zoom = view != NULL ? (float)view->zoom : 1.0f;
    FrCamera camera = {.half_height = (float)tan(0.5 * field)};
    camera.half_width = camera.half_height * aspect;
    set_directions(&camera, azimuth, elevation);

    vec3s place = stand_back(world, &camera, &box);
    vec3s middle = glms_vec3_scale(glms_vec3_add(box.min, box.max), 0.5f);
    float middle_depth = glms_vec3_dot(middle, camera.forward);
    float size = glms_vec3_norm(glms_vec3_sub(box.max, box.min));
    camera.distance = fmaxf(middle_depth - place.z, 1e-3f * size + 1e-6f) / zoom;
    camera.origin = fr_from_basis(camera.right, camera.up, camera.forward,
                                  (vec3s){{place.x, place.y, middle_depth - camera.distance}});
    if (view != NULL) {
        camera.origin = glms_vec3_add(camera.origin, view->look_at);
    }
    if (world->ground != NULL) {
        camera.origin.z = fmaxf(camera.origin.z, 0.01f * camera.distance);
    }
    return camera;
}

vec3s fr_camera_direction(const FrCamera *camera, float x, float y) {
    vec3s local = {
        {(2.0f * x - 1.0f) * camera->half_width, (1.0f - 2.0f * y) * camera->half_height, 1.0f}};
    return glms_vec3_normalize(fr_from_basis(camera->right, camera->up, camera->forward, local));
}
