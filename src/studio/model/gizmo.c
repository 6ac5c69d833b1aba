#include "studio/model/gizmo.h"

#include <math.h>

static const double arm = 84, ring_part = 0.72, grab = 9, middle_grab = 11; // pixels
static const double scale_away[2] = {62, -62};
static const double most = 1e6; // m, of any place

// ---- the picture -------------------------------------------------------------------------------

static double aspect_of(const StudioEye *eye) {
    return eye->height > 0 ? eye->width / eye->height : 1;
}

static double depth_of(const StudioEye *eye, const double point[3]) {
    mat4s view = studio_camera_view(&eye->camera);
    vec4s at = {{(float)point[0], (float)point[1], (float)point[2], 1}};
    return -(double)glms_mat4_mulv(view, at).z;
}

bool studio_eye_project(const StudioEye *eye, const double point[3], double pixel[2]) {
    mat4s view = studio_camera_view(&eye->camera);
    vec4s at = {{(float)point[0], (float)point[1], (float)point[2], 1}};
    vec4s seen = glms_mat4_mulv(view, at);
    double depth = -(double)seen.z;
    if (depth < 1e-4 * eye->camera.distance) {
        return false;
    }
    double half = tan(0.5 * eye->camera.field_of_view) * depth;
    pixel[0] = 0.5 * eye->width * (1 + (double)seen.x / (half * aspect_of(eye)));
    pixel[1] = 0.5 * eye->height * (1 - (double)seen.y / half);
    return true;
}

void studio_eye_ray(const StudioEye *eye, const double pixel[2], double origin[3],
                    double direction[3]) {
    studio_camera_ray(&eye->camera, aspect_of(eye), 2 * pixel[0] / eye->width - 1,
                      1 - 2 * pixel[1] / eye->height, origin, direction);
}

double studio_eye_pixel(const StudioEye *eye, const double point[3]) {
    return 2 * tan(0.5 * eye->camera.field_of_view) * depth_of(eye, point) / eye->height;
}

// ---- handles -----------------------------------------------------------------------------------

void studio_gizmo_pivot(const StudioGround *ground, const StudioStanding *standing,
                        double pivot[3]) {
    for (int k = 0; k < 3; k++) {
        pivot[k] = standing->at[k];
    }
    if (standing->is_on_ground) {
        pivot[2] += studio_ground_height(ground, pivot[0], pivot[1]);
    }
}

bool studio_gizmo_place(const StudioEye *eye, const double pivot[3], const StudioStanding *standing,
                        StudioGizmo *gizmo) {
    *gizmo = (StudioGizmo){.can_turn = standing->can_turn, .can_scale = standing->can_scale};
    if (!studio_eye_project(eye, pivot, gizmo->middle)) {
        return false;
    }
    double length = arm * studio_eye_pixel(eye, pivot);
    for (int k = 0; k < 3; k++) {
        double tip[3] = {pivot[0], pivot[1], pivot[2]};
        tip[k] += length;
        if (!studio_eye_project(eye, tip, gizmo->tips[k])) {
            return false;
        }
    }
    for (int i = 0; i < STUDIO_RING; i++) {
        double angle = 2 * G_PI * i / (STUDIO_RING - 1), radius = ring_part * length;
        double point[3] = {pivot[0] + radius * cos(angle), pivot[1] + radius * sin(angle),
                           pivot[2]};
        if (!studio_eye_project(eye, point, gizmo->ring[i])) {
            return false;
        }
    }
    for (int k = 0; k < 2; k++) {
        gizmo->scale[k] = gizmo->middle[k] + scale_away[k];
    }
    return true;
}

static double distance_to(const double pixel[2], const double a[2], const double b[2]) {
    double dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
    double t = length > 0 ? ((pixel[0] - a[0]) * dx + (pixel[1] - a[1]) * dy) / length : 0;
    t = CLAMP(t, 0, 1);
    return hypot(pixel[0] - a[0] - t * dx, pixel[1] - a[1] - t * dy);
}

StudioGrip studio_gizmo_under(const StudioGizmo *gizmo, const double pixel[2]) {
    if (hypot(pixel[0] - gizmo->middle[0], pixel[1] - gizmo->middle[1]) < middle_grab) {
        return STUDIO_GRIP_GROUND;
    }
    if (gizmo->can_scale &&
        hypot(pixel[0] - gizmo->scale[0], pixel[1] - gizmo->scale[1]) < middle_grab) {
        return STUDIO_GRIP_SCALE;
    }
    StudioGrip found = STUDIO_GRIP_NONE;
    double nearest = grab;
    for (int k = 0; k < 3; k++) {
        double away = distance_to(pixel, gizmo->middle, gizmo->tips[k]);
        found = away < nearest ? (StudioGrip)(STUDIO_GRIP_X + k) : found;
        nearest = fmin(nearest, away);
    }
    for (int i = 0; gizmo->can_turn && i + 1 < STUDIO_RING; i++) {
        double away = distance_to(pixel, gizmo->ring[i], gizmo->ring[i + 1]);
        found = away < nearest ? STUDIO_GRIP_TURN : found;
        nearest = fmin(nearest, away);
    }
    return found;
}

const char *studio_grip_words(StudioGrip handle) {
    static const char *const words[] = {
        "",
        "Drag to move along x; Ctrl in steps",
        "Drag to move along y; Ctrl in steps",
        "Drag to move up and down; Ctrl in steps",
        "Drag to move along the ground; Ctrl in steps",
        "Drag to turn; Ctrl by 15°",
        "Drag away to make larger",
    };
    return words[handle];
}

// ---- drags -------------------------------------------------------------------------------------

static double rounded(double value, double step) {
    return step > 0 ? round(value / step) * step : value;
}

// Along an axis through the pivot, where a ray comes nearest to it.
static double along_axis(const StudioEye *eye, const double pivot[3], int axis,
                         const double pixel[2]) {
    double origin[3], direction[3], away[3];
    studio_eye_ray(eye, pixel, origin, direction);
    for (int k = 0; k < 3; k++) {
        away[k] = pivot[k] - origin[k];
    }
    double b = direction[axis];
    double d = away[0] * direction[0] + away[1] * direction[1] + away[2] * direction[2];
    double bend = 1 - b * b;
    return bend > 1e-6 ? (b * d - away[axis]) / bend : 0;
}

// Where a ray meets the level plane through a point.
static bool meet_level(const StudioEye *eye, const double pivot[3], const double pixel[2],
                       double at[3]) {
    double origin[3], direction[3];
    studio_eye_ray(eye, pixel, origin, direction);
    double t = direction[2] != 0 ? (pivot[2] - origin[2]) / direction[2] : -1;
    for (int k = 0; k < 3; k++) {
        at[k] = origin[k] + t * direction[k];
    }
    return t > 0;
}

// What is grabbed above the ground moves along the plane it is in; what lies on hills follows them.
static void move_on_ground(const StudioEye *eye, const StudioGround *ground, const double pivot[3],
                           const double pixels[2][2], double step, StudioStanding *to) {
    double from[3], now[3];
    if (!meet_level(eye, pivot, pixels[0], from) || !meet_level(eye, pivot, pixels[1], now)) {
        return;
    }
    double before = studio_ground_height(ground, to->at[0], to->at[1]);
    for (int k = 0; k < 2; k++) {
        double moved = to->at[k] + now[k] - from[k];
        to->at[k] = CLAMP(rounded(moved, step), -most, most);
    }
    if (!to->is_on_ground) {
        to->at[2] += studio_ground_height(ground, to->at[0], to->at[1]) - before;
    }
}

static void turn_about(const StudioEye *eye, const double pivot[3], const double pixels[2][2],
                       double step, StudioStanding *to) {
    double from[3], now[3];
    if (meet_level(eye, pivot, pixels[0], from) && meet_level(eye, pivot, pixels[1], now)) {
        double angle = atan2(now[1] - pivot[1], now[0] - pivot[0]) -
                       atan2(from[1] - pivot[1], from[0] - pivot[0]);
        to->turn = rounded(to->turn + angle * 180 / G_PI, step);
    }
}

StudioStanding studio_gizmo_drag(const StudioEye *eye, const StudioGround *ground,
                                 StudioGrip handle, const StudioStanding *from,
                                 const double begin[2], const double end[2], double step,
                                 double turn_step) {
    StudioStanding to = *from;
    double pivot[3];
    studio_gizmo_pivot(ground, from, pivot);
    const double pixels[2][2] = {{begin[0], begin[1]}, {end[0], end[1]}};
    if (handle == STUDIO_GRIP_GROUND) {
        move_on_ground(eye, ground, pivot, pixels, step, &to);
    } else if (handle == STUDIO_GRIP_TURN) {
        turn_about(eye, pivot, pixels, turn_step, &to);
    } else if (handle == STUDIO_GRIP_SCALE) {
        double middle[2];
        if (studio_eye_project(eye, pivot, middle)) {
            double before = hypot(begin[0] - middle[0], begin[1] - middle[1]);
            double after = hypot(end[0] - middle[0], end[1] - middle[1]);
            to.scale = from->scale * CLAMP(after / fmax(before, 1), 0.02, 50);
        }
    } else if (handle != STUDIO_GRIP_NONE) {
        int axis = (int)handle - STUDIO_GRIP_X;
        double moved = from->at[axis] + along_axis(eye, pivot, axis, end) -
                       along_axis(eye, pivot, axis, begin);
        to.at[axis] = CLAMP(rounded(moved, step), -most, most);
    }
    return to;
}
