// What a view says; functions and curves evaluated.
#include "lsystem/companion.h"

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
        g_free(g_array_index(view->functions, FrLspline, i).points);
    }
    for (guint i = 0; i < view->contours->len; i++) {
        g_free(g_array_index(view->contours, FrLcontour, i).points);
    }
    for (guint i = 0; i < view->curves->len; i++) {
        g_free(g_array_index(view->curves, FrLcontour, i).points);
        g_free(g_array_index(view->curves, FrLcontour, i).controls);
        g_free(g_array_index(view->curves, FrLcontour, i).lengths);
    }
    for (guint i = 0; i < view->surfaces->len; i++) {
        g_free(g_array_index(view->surfaces, FrLsurface, i).corners);
        g_free(g_array_index(view->surfaces, FrLsurface, i).hull);
    }
    g_free(view->section);
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
    if (function == NULL) {
        return 0;
    }
    x = x >= 0 ? MIN(x, 1) : 0;
    if (function->samples == NULL) {
        return fr_lspline_value((const double(*)[3])function->points, function->point_count, x);
    }
    double at = x * (function->count - 1);
    uint32_t i = MIN((uint32_t)at, function->count - 1);
    if (i == function->count - 1) {
        return function->samples[i];
    }
    return (1 - at + i) * function->samples[i] + (at - i) * function->samples[i + 1];
}

// The parameter is found in a table of lengths, then the curve itself is evaluated.
double fr_lview_curve(const FrLview *view, double id, double t, int axis) {
    const FrLcontour *curve = view == NULL ? NULL : numbered(view->curves, sizeof(FrLcontour), id);
    if (curve == NULL || curve->count < 2) {
        return 0;
    }
    uint32_t low = 0, high = curve->count - 1;
    while (high - low > 1) {
        uint32_t middle = (low + high) / 2;
        if (curve->lengths[middle] > t) {
            high = middle;
        } else {
            low = middle;
        }
    }
    double step = curve->lengths[high] - curve->lengths[low], point[3];
    double part = step > 0 ? (t - curve->lengths[low]) / step : 0;
    fr_lcurve_point(curve, CLAMP((low + part) / (curve->count - 1), 0, 1), point);
    return point[axis];
}

double fr_lview_curve_length(const FrLview *view, double id) {
    const FrLcontour *curve = view == NULL ? NULL : numbered(view->curves, sizeof(FrLcontour), id);
    return curve == NULL ? 0 : curve->length;
}
