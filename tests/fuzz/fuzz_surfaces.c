// Rational surfaces of IGES and Wavefront OBJ from any text: sound surfaces whose points are
// numbers, or a diagnostic.
#include "fuzz.h"

#include "material/nurbs_file.h"

#include <math.h>

static void surface_clear(void *data) {
    FrNurbsSurface *surface = data;
    g_free((void *)surface->knots_u);
    g_free((void *)surface->knots_v);
    g_free((void *)surface->points);
}

/// Looks at what is there for all who show it: the grid of a coarse and of a fine wish.
static void measure(const FrNurbsSurface *s) {
    FR_ASSERT(fr_nurbs_surface_is_valid(s));
    uint8_t *steps_u = g_malloc(s->count_u), *steps_v = g_malloc(s->count_v);
    for (int fine = 0; fine < 2; fine++) {
        const FrNurbsFineness fineness = {fine ? 1e-6 : 1.0, 0.45};
        fr_nurbs_steps(s, &fineness, steps_u, steps_v);
    }
    g_free(steps_u);
    g_free(steps_v);
    double u[2], v[2], point[3];
    fr_nurbs_range(s->knots_u, s->degree_u, s->count_u, u);
    fr_nurbs_range(s->knots_v, s->degree_v, s->count_v, v);
    FR_ASSERT(u[0] < u[1] && v[0] < v[1]);
    for (int i = 0; i <= 4; i++) {
        fr_nurbs_surface_at(s, u[0] + 0.25 * i * (u[1] - u[0]), v[0] + 0.25 * i * (v[1] - v[0]),
                            point, NULL, NULL);
        FR_ASSERT(isfinite(point[0]) && isfinite(point[1]) && isfinite(point[2]));
    }
}

static void keep_faces(const char *text, size_t size) {
    char *copy = g_memdup2(text, size);
    FR_ASSERT(size == 0 || !fr_obj_keep_faces(copy, size) || fr_obj_has_faces(text, size));
    g_free(copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size > 1 << 16) {
        return 0;
    }
    for (int way = 0; way < 2; way++) {
        FrContext context = fr_context_default();
        context.diags = fr_diags_new();
        FrSurfaceReader reader = {.name = "input",
                                  .context = &context,
                                  .surfaces = g_array_new(FALSE, FALSE, sizeof(FrNurbsSurface))};
        g_array_set_clear_func(reader.surfaces, surface_clear);
        (way == 0 ? fr_obj_surfaces : fr_iges_surfaces)(&reader, (const char *)data, size);
        FR_ASSERT(reader.status == FR_OK || fr_diags_error_count(context.diags) > 0);
        for (uint32_t i = 0; i < reader.surfaces->len; i++) {
            measure(&g_array_index(reader.surfaces, FrNurbsSurface, i));
        }
        g_array_unref(reader.surfaces);
        fr_diags_free(context.diags);
    }
    keep_faces((const char *)data, size);
    return 0;
}
