// Which branch is seen where: the skeleton drawn with branches for colours.
#include "frond/variation.h"

#include <cglm/struct.h>

#include <math.h>

#define NEAREST_W 1e-6f

/// A point of the view: pixels from the top left, and depth.
typedef struct Seen {
    double x, y, depth;
} Seen;

static Seen seen(const FrIdBuffer *buffer, vec4s at) {
    double w = (double)at.w;
    return (Seen){(0.5 + 0.5 * (double)at.x / w) * buffer->width,
                  (0.5 - 0.5 * (double)at.y / w) * buffer->height, (double)at.z / w};
}

static void put(FrIdBuffer *buffer, size_t pixel, double depth, uint32_t branch) {
    if (depth < (double)buffer->depth[pixel]) {
        buffer->depth[pixel] = (float)depth;
        buffer->branch[pixel] = branch;
    }
}

/// The part of a row that a line of half thickness r crosses at most.
static void row_range(Seen a, Seen b, double y, double r, double *left, double *right) {
    double from = 0, to = 1;
    double rise = b.y - a.y;
    if (fabs(rise) > 1e-9) {
        double one = (y - r - a.y) / rise, other = (y + r - a.y) / rise;
        from = fmin(fmax(fmin(one, other), 0), 1);
        to = fmin(fmax(fmax(one, other), 0), 1);
    }
    double x0 = a.x + from * (b.x - a.x), x1 = a.x + to * (b.x - a.x);
    *left = fmin(x0, x1) - r;
    *right = fmax(x0, x1) + r;
}

static void draw_line(FrIdBuffer *buffer, Seen a, Seen b, double r, uint32_t branch) {
    double dx = b.x - a.x, dy = b.y - a.y;
    double square = dx * dx + dy * dy;
    if (!isfinite(square)) {
        return;
    }
    double last_row = fmin(fmax(a.y, b.y) + r, buffer->height - 1.0);
    for (double row = fmax(floor(fmin(a.y, b.y) - r), 0); row <= last_row; row++) {
        double y = row + 0.5, left, right;
        row_range(a, b, y, r, &left, &right);
        right = fmin(right, buffer->width - 1.0);
        for (double column = fmax(floor(left), 0); column <= right; column++) {
            double x = column + 0.5;
            double t = square > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / square : 0;
            t = fmin(fmax(t, 0), 1);
            double off_x = a.x + t * dx - x, off_y = a.y + t * dy - y;
            if (off_x * off_x + off_y * off_y <= r * r) {
                put(buffer, (size_t)row * buffer->width + (size_t)column,
                    a.depth + t * (b.depth - a.depth), branch);
            }
        }
    }
}

/// Draws the part of an internode that lies before the eye.
static void draw_internode(FrIdBuffer *buffer, mat4s project, vec3s from, vec3s to, double r,
                           uint32_t branch) {
    vec4s a = glms_mat4_mulv(project, glms_vec4(from, 1));
    vec4s b = glms_mat4_mulv(project, glms_vec4(to, 1));
    if (!(a.w > NEAREST_W) && !(b.w > NEAREST_W)) {
        return;
    }
    if (!(a.w > NEAREST_W)) {
        a = glms_vec4_lerp(b, a, (b.w - NEAREST_W) / (b.w - a.w));
        a.w = NEAREST_W;
    } else if (!(b.w > NEAREST_W)) {
        b = glms_vec4_lerp(a, b, (a.w - NEAREST_W) / (a.w - b.w));
        b.w = NEAREST_W;
    }
    draw_line(buffer, seen(buffer, a), seen(buffer, b), r, branch);
}

static FrIdBuffer *new_buffer(uint32_t width, uint32_t height) {
    size_t pixels = (size_t)width * height;
    FrIdBuffer *buffer = g_new0(FrIdBuffer, 1);
    *buffer = (FrIdBuffer){width, height, g_new(uint32_t, pixels), g_new(float, pixels)};
    for (size_t i = 0; i < pixels; i++) {
        buffer->branch[i] = FR_NONE;
        buffer->depth[i] = INFINITY;
    }
    return buffer;
}

FrStatus fr_id_buffer_draw(const FrPlant *plant, mat4s project, uint32_t width, uint32_t height,
                           double thickness, const FrContext *context, FrIdBuffer **buffer) {
    *buffer = NULL;
    FrStatus status = fr_limit_check(fr_count_multiply(width, height), context->limits.pixels,
                                     "pixels", "the view", (FrSpan){0}, context->diags);
    if (status != FR_OK) {
        return status;
    }
    FrIdBuffer *made = new_buffer(width, height);
    double r = 0.5 * fmin(fmax(thickness, 1), 100);
    const FrNodes *nodes = &plant->nodes;
    for (uint32_t i = 0; i < nodes->count; i++) {
        if (i % 1024 == 0 && fr_progress_is_cancelled(context->progress)) {
            fr_id_buffer_free(made);
            return FR_CANCELLED;
        }
        uint32_t axis = nodes->axis[i];
        if (((nodes->flags[i] | plant->axes.flags[axis]) & (FR_SHED | FR_HIDDEN)) == 0) {
            vec3s from = plant->axes.first[axis] == i ? fr_plant_axis_origin(plant, axis)
                                                      : nodes->position[nodes->parent[i]];
            draw_internode(made, project, from, nodes->position[i], r, axis);
        }
    }
    *buffer = made;
    return FR_OK;
}

void fr_id_buffer_free(FrIdBuffer *buffer) {
    if (buffer != NULL) {
        g_free(buffer->branch);
        g_free(buffer->depth);
        g_free(buffer);
    }
}
