#include "studio/model/overlay.h"

#include <math.h>
#include <string.h>

enum { CIRCLE_SIDES = 48 };

static const float usual_through = 0.25f;
static const double head_part = 0.2; // of an arrow's length

StudioOverlay *studio_overlay_new(void) {
    StudioOverlay *overlay = g_new0(StudioOverlay, 1);
    overlay->triangles = g_array_new(FALSE, FALSE, sizeof(StudioMark));
    overlay->lines = g_array_new(FALSE, FALSE, sizeof(StudioMark));
    overlay->points = g_array_new(FALSE, FALSE, sizeof(StudioMark));
    overlay->through = usual_through;
    return overlay;
}

void studio_overlay_free(StudioOverlay *overlay) {
    if (overlay != NULL) {
        g_array_unref(overlay->triangles);
        g_array_unref(overlay->lines);
        g_array_unref(overlay->points);
        g_free(overlay);
    }
}

static void add(GArray *marks, const double at[3], double size, const float colour[4]) {
    StudioMark mark = {.at = {(float)at[0], (float)at[1], (float)at[2]}, .size = (float)size};
    memcpy(mark.colour, colour, sizeof mark.colour);
    g_array_append_val(marks, mark);
}

void studio_overlay_point(StudioOverlay *overlay, const double at[3], double size,
                          const float colour[4]) {
    add(overlay->points, at, size, colour);
}

void studio_overlay_line(StudioOverlay *overlay, const double from[3], const double to[3],
                         double width, const float colour[4]) {
    add(overlay->lines, from, width, colour);
    add(overlay->lines, to, width, colour);
}

void studio_overlay_triangle(StudioOverlay *overlay, const double a[3], const double b[3],
                             const double c[3], const float colour[4]) {
    add(overlay->triangles, a, 0, colour);
    add(overlay->triangles, b, 0, colour);
    add(overlay->triangles, c, 0, colour);
}

void studio_overlay_box(StudioOverlay *overlay, const double min[3], const double max[3],
                        double width, const float colour[4]) {
    for (int corner = 0; corner < 8; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            if ((corner >> axis & 1) != 0) {
                continue; // each edge from its lower end
            }
            double from[3], to[3];
            for (int i = 0; i < 3; i++) {
                from[i] = to[i] = (corner >> i & 1) != 0 ? max[i] : min[i];
            }
            to[axis] = max[axis];
            studio_overlay_line(overlay, from, to, width, colour);
        }
    }
}

void studio_overlay_circle(StudioOverlay *overlay, const double centre[3], const double x[3],
                           const double y[3], double radius, double width, const float colour[4]) {
    double before[3];
    for (int k = 0; k <= CIRCLE_SIDES; k++) {
        double angle = 2 * G_PI * k / CIRCLE_SIDES, at[3];
        for (int i = 0; i < 3; i++) {
            at[i] = centre[i] + radius * (cos(angle) * x[i] + sin(angle) * y[i]);
        }
        if (k > 0) {
            studio_overlay_line(overlay, before, at, width, colour);
        }
        memcpy(before, at, sizeof before);
    }
}

void studio_overlay_arrow(StudioOverlay *overlay, const double from[3], const double to[3],
                          double width, const float colour[4]) {
    double along[3], x[3] = {0, 0, 0}, y[3];
    for (int i = 0; i < 3; i++) {
        along[i] = to[i] - from[i];
    }
    studio_overlay_line(overlay, from, to, width, colour);
    // Two directions across it: with the axis that it runs along least.
    int least = fabs(along[0]) < fabs(along[1]) ? 0 : 1;
    least = fabs(along[2]) < fabs(along[least]) ? 2 : least;
    x[(least + 1) % 3] = along[(least + 2) % 3];
    x[(least + 2) % 3] = -along[(least + 1) % 3];
    double squared = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
    double across = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    if (across == 0) {
        return; // it has no length
    }
    double length = sqrt(squared);
    for (int i = 0; i < 3; i++) {
        x[i] /= across;
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        y[i] = (along[j] * x[k] - along[k] * x[j]) / length;
    }
    for (int side = 0; side < 4; side++) {
        double sign = side % 2 == 0 ? 0.4 : -0.4, barb[3];
        const double *out = side < 2 ? x : y;
        for (int i = 0; i < 3; i++) {
            barb[i] = to[i] - head_part * (along[i] + sign * length * out[i]);
        }
        studio_overlay_line(overlay, to, barb, width, colour);
    }
}
