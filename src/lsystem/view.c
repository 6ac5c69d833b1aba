// What a view says; functions and curves evaluated.
#include "lsystem/view.h"

#include <math.h>

FrLview *fr_lview_new(void) {
    FrLview *view = g_new0(FrLview, 1);
    *view = (FrLview){.angle = 45,
                      .width = 1,
                      .scale = 1,
                      .scale_step = 1,
                      .style = FR_LSTYLE_PIXEL,
                      .tapers = true,
                      .draws_past_cut = true,
                      .contour_sides = 8,
                      .colour = 128,
                      .colour_step = 1,
                      .old_direction = {0, 1, 0}};
    view->tropisms = g_array_new(FALSE, TRUE, sizeof(FrLtropism));
    view->functions = g_array_new(FALSE, TRUE, sizeof(FrLspline));
    view->contours = g_array_new(FALSE, TRUE, sizeof(FrLcontour));
    view->curves = g_array_new(FALSE, TRUE, sizeof(FrLcontour));
    view->surfaces = g_array_new(FALSE, TRUE, sizeof(FrLsurface));
    return view;
}

void fr_lview_free(FrLview *view) {
    if (view == NULL) {
        return;
    }
    for (guint i = 0; i < view->functions->len; i++) {
        g_free(g_array_index(view->functions, FrLspline, i).name);
        g_free(g_array_index(view->functions, FrLspline, i).samples);
    }
    for (guint i = 0; i < view->contours->len; i++) {
        g_free(g_array_index(view->contours, FrLcontour, i).points);
    }
    for (guint i = 0; i < view->curves->len; i++) {
        g_free(g_array_index(view->curves, FrLcontour, i).points);
    }
    for (guint i = 0; i < view->surfaces->len; i++) {
        g_free(g_array_index(view->surfaces, FrLsurface, i).corners);
        g_free(g_array_index(view->surfaces, FrLsurface, i).hull);
    }
    g_array_unref(view->tropisms);
    g_array_unref(view->functions);
    g_array_unref(view->contours);
    g_array_unref(view->curves);
    g_array_unref(view->surfaces);
    g_free(view);
}

FrLname *fr_lview_names(const FrLview *view, size_t *count) {
    *count = 0;
    if (view == NULL) {
        return NULL;
    }
    FrLname *names = g_new0(FrLname, view->functions->len + 1);
    for (guint i = 0; i < view->functions->len; i++) {
        const FrLspline *function = &g_array_index(view->functions, FrLspline, i);
        if (function->name != NULL) {
            names[(*count)++] = (FrLname){function->name, (int)i + 1, false};
        }
    }
    return names;
}

/// The element that a number from 1 on names, or NULL.
static const void *numbered(const GArray *array, size_t size, double id) {
    if (array == NULL || !(id >= 1 && id < (double)array->len + 1)) {
        return NULL;
    }
    return array->data + ((size_t)id - 1) * size;
}

double fr_lview_function(const FrLview *view, double id, double x) {
    const FrLspline *function =
        view == NULL ? NULL : numbered(view->functions, sizeof(FrLspline), id);
    if (function == NULL || function->count == 0) {
        return 0;
    }
    x = x >= 0 ? MIN(x, 1) : 0;
    double at = x * (function->count - 1);
    uint32_t i = MIN((uint32_t)at, function->count - 1), next = MIN(i + 1, function->count - 1);
    double part = at - i;
    return function->samples[i] * (1 - part) + function->samples[next] * part;
}

double fr_lview_curve(const FrLview *view, double id, double t, int axis) {
    const FrLcontour *curve = view == NULL ? NULL : numbered(view->curves, sizeof(FrLcontour), id);
    if (curve == NULL || curve->count == 0) {
        return 0;
    }
    double left = (t >= 0 ? MIN(t, 1) : 0) * curve->length;
    for (uint32_t i = 0; i + 1 < curve->count; i++) {
        const double *a = curve->points[i], *b = curve->points[i + 1];
        double length = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                             (b[2] - a[2]) * (b[2] - a[2]));
        if (left <= length && length > 0) {
            return a[axis] + (b[axis] - a[axis]) * (left / length);
        }
        left -= length;
    }
    return curve->points[curve->count - 1][axis];
}

double fr_lview_curve_length(const FrLview *view, double id) {
    const FrLcontour *curve = view == NULL ? NULL : numbered(view->curves, sizeof(FrLcontour), id);
    return curve == NULL ? 0 : curve->length;
}
