#include "studio/model/camera.h"

#include <glib.h>

#include <math.h>

static const double highest = 89.0 * G_PI / 180.0;
static const double nearest = 0.001, farthest = 100000.0;
static const double least_height = 0.02; // of the eye above the floor, in parts of the distance

StudioCamera studio_camera_default(void) {
    return (StudioCamera){.target = {0, 0, 0.5},
                          .distance = 4,
                          .azimuth = -30 * G_PI / 180,
                          .elevation = 10 * G_PI / 180,
                          .field_of_view = 35 * G_PI / 180};
}

void studio_camera_frame(StudioCamera *camera, const double min[3], const double max[3],
                         double aspect) {
    double radius = 0;
    for (int i = 0; i < 3; i++) {
        bool is_empty = !(max[i] >= min[i]);
        camera->target[i] = is_empty ? 0 : 0.5 * (min[i] + max[i]);
        radius += is_empty ? 0 : 0.25 * (max[i] - min[i]) * (max[i] - min[i]);
    }
    radius = radius > 1e-12 ? sqrt(radius) : 1;
    double half = 0.5 * camera->field_of_view;
    double narrow = aspect < 1 ? atan(tan(half) * aspect) : half;
    camera->distance = CLAMP(1.02 * radius / sin(narrow), nearest, farthest);
}

void studio_camera_see(StudioCamera *camera, const FrViewParams *view, const double min[3],
                       const double max[3], double aspect) {
    vec3s away = glms_vec3_sub(view->eye, view->target);
    double distance = (double)glms_vec3_norm(away);
    camera->field_of_view = view->field_of_view;
    if (distance > 0) { // in a room, say
        for (int i = 0; i < 3; i++) {
            camera->target[i] = (double)view->target.raw[i];
        }
        camera->distance = CLAMP(distance, nearest, farthest);
        camera->azimuth = atan2((double)away.x, (double)-away.y);
        camera->elevation = CLAMP(asin((double)away.z / distance), -highest, highest);
        return;
    }
    studio_camera_frame(camera, min, max, aspect);
    camera->distance = CLAMP(camera->distance / view->zoom, nearest, farthest);
    camera->azimuth = view->azimuth;
    camera->elevation = CLAMP(view->elevation, -highest, highest);
    for (int i = 0; i < 3; i++) {
        camera->target[i] += (double)view->look_at.raw[i];
    }
}

void studio_camera_orbit(StudioCamera *camera, double azimuth, double elevation) {
    camera->azimuth = remainder(camera->azimuth + azimuth, 2 * G_PI);
    camera->elevation = CLAMP(camera->elevation + elevation, -highest, highest);
}

// Unit vectors to the right, upwards and towards the camera.
static void axes_of(const StudioCamera *camera, double right[3], double up[3], double back[3]) {
    double ca = cos(camera->azimuth), sa = sin(camera->azimuth);
    double ce = cos(camera->elevation), se = sin(camera->elevation);
    right[0] = ca, right[1] = sa, right[2] = 0;
    back[0] = sa * ce, back[1] = -ca * ce, back[2] = se;
    up[0] = -sa * se, up[1] = ca * se, up[2] = ce;
}

void studio_camera_pan(StudioCamera *camera, double right, double up) {
    double x[3], y[3], z[3];
    axes_of(camera, x, y, z);
    double height = 2 * camera->distance * tan(0.5 * camera->field_of_view);
    for (int i = 0; i < 3; i++) {
        camera->target[i] += height * (right * x[i] + up * y[i]);
    }
}

void studio_camera_zoom(StudioCamera *camera, double factor) {
    double before[3], after[3];
    studio_camera_eye(camera, before);
    camera->distance = CLAMP(camera->distance * factor, nearest, farthest);
    studio_camera_eye(camera, after);
    double least = fmin(before[2], least_height * camera->distance);
    if (factor > 1 && before[2] >= 0 && after[2] < least) {
        camera->elevation = asin(CLAMP((least - camera->target[2]) / camera->distance, -1, 1));
    }
}

void studio_camera_eye(const StudioCamera *camera, double eye[3]) {
    double x[3], y[3], z[3];
    axes_of(camera, x, y, z);
    for (int i = 0; i < 3; i++) {
        eye[i] = camera->target[i] + camera->distance * z[i];
    }
}

mat4s studio_camera_view(const StudioCamera *camera) {
    double x[3], y[3], z[3], eye[3];
    axes_of(camera, x, y, z);
    studio_camera_eye(camera, eye);
    mat4s view = GLMS_MAT4_IDENTITY;
    double move[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        view.raw[i][0] = (float)x[i];
        view.raw[i][1] = (float)y[i];
        view.raw[i][2] = (float)z[i];
        move[0] -= x[i] * eye[i];
        move[1] -= y[i] * eye[i];
        move[2] -= z[i] * eye[i];
    }
    for (int i = 0; i < 3; i++) {
        view.raw[3][i] = (float)move[i];
    }
    return view;
}

mat4s studio_camera_projection(const StudioCamera *camera, double aspect, double radius) {
    double far = camera->distance + 2 * radius + 4 * camera->distance;
    double near = 0.02 * camera->distance; // the floor begins at the feet
    return glms_perspective((float)camera->field_of_view, (float)aspect, (float)near, (float)far);
}

void studio_camera_ray(const StudioCamera *camera, double aspect, double x, double y,
                       double origin[3], double direction[3]) {
    double right[3], up[3], back[3], length = 0;
    axes_of(camera, right, up, back);
    studio_camera_eye(camera, origin);
    double half = tan(0.5 * camera->field_of_view);
    for (int i = 0; i < 3; i++) {
        direction[i] = -back[i] + half * (aspect * x * right[i] + y * up[i]);
        length += direction[i] * direction[i];
    }
    for (int i = 0; i < 3; i++) {
        direction[i] /= sqrt(length);
    }
}

double studio_camera_step(const StudioCamera *camera, double part) {
    double wanted = 2 * part * camera->distance * tan(0.5 * camera->field_of_view);
    double power = pow(10, floor(log10(wanted)));
    double rest = wanted / power;
    return power * (rest >= 5 ? 5 : rest >= 2 ? 2 : 1);
}

StudioScale studio_camera_scale(const StudioCamera *camera, double height, double room) {
    double shown = 2 * camera->distance * tan(0.5 * camera->field_of_view); // m, top to bottom
    double length = studio_camera_step(camera, room / height);
    return (StudioScale){.length = length, .pixels = length / shown * height};
}

bool studio_camera_meet(const StudioCamera *camera, double aspect, double x, double y,
                        const double grip[3], double hit[3]) {
    double origin[3], way[3], eye[3], steep = 0, ahead = 0;
    studio_camera_ray(camera, aspect, x, y, origin, way);
    studio_camera_eye(camera, eye);
    for (int k = 0; k < 3; k++) {
        double normal = camera->target[k] - eye[k];
        steep += way[k] * normal;
        ahead += (grip[k] - origin[k]) * normal;
    }
    double away = steep == 0 ? -1 : ahead / steep;
    for (int k = 0; k < 3; k++) {
        hit[k] = origin[k] + away * way[k];
    }
    return away > 0;
}

bool studio_camera_project(const StudioCamera *camera, double aspect, const double point[3],
                           double *x, double *y) {
    double right[3], up[3], back[3], eye[3], at[3] = {0, 0, 0};
    axes_of(camera, right, up, back);
    studio_camera_eye(camera, eye);
    for (int i = 0; i < 3; i++) {
        at[0] += (point[i] - eye[i]) * right[i];
        at[1] += (point[i] - eye[i]) * up[i];
        at[2] -= (point[i] - eye[i]) * back[i];
    }
    if (!(at[2] > 0)) {
        return false;
    }
    double half = at[2] * tan(0.5 * camera->field_of_view);
    *x = at[0] / (half * aspect);
    *y = at[1] / half;
    return true;
}
