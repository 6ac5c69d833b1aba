// Deformation along a line: what stands on the z axis comes to stand on a spline through points, by
// arc length, in frames that never twist, and goes on straight where the line ends.
#include "pgraph/preset.h"

#include "pgraph/instance.h"

#include <cglm/struct.h>

enum { SAMPLES = 97, ROWS = 4 };

// In the order of `rows`: the line, its x and y directions, its own.
static const char *const names[ROWS][3] = {{"at0", "at1", "at2"},
                                           {"side0", "side1", "side2"},
                                           {"up0", "up1", "up2"},
                                           {"ahead0", "ahead1", "ahead2"}};

typedef struct Samples {
    double rows[ROWS][3][SAMPLES][2];
} Samples;

static void sample(const FrPath *path, Samples *samples) {
    double length = fr_path_length(path);
    vec3s before, tangent;
    fr_path_at(path, 0, &before, &tangent);
    versors frame = fr_turned_towards((versors){{0, 0, 0, 1}}, (vec3s){{0, 0, 1}}, tangent, 1);
    for (int i = 0; i < SAMPLES; i++) {
        double part = (double)i / (SAMPLES - 1);
        vec3s point;
        fr_path_at(path, part * length, &point, &tangent);
        if (glms_vec3_distance(point, before) > 0) {
            frame = fr_frame_transport(frame, before, point, tangent);
        }
        const vec3s rows[ROWS] = {point, fr_frame_left(frame), fr_frame_up(frame), tangent};
        for (int row = 0; row < ROWS; row++) {
            for (int k = 0; k < 3; k++) {
                samples->rows[row][k][i][0] = part;
                samples->rows[row][k][i][1] = (double)rows[row].raw[k];
            }
        }
        before = point;
    }
}

void fr_preset_add_curve(FrScope *scope, const GArray *points) {
    FrPath *path = fr_path_new((const vec3s *)(const void *)points->data, points->len);
    FR_ASSERT(path != NULL);
    Samples *samples = g_new(Samples, 1);
    sample(path, samples);
    fr_scope_add_value(scope, "whole", fmax(fr_path_length(path), 1e-9));
    fr_path_unref(path);
    for (int row = 0; row < ROWS; row++) {
        for (int k = 0; k < 3; k++) {
            FrCurve *curve =
                fr_curve_new(FR_CURVE_LINEAR, (const double(*)[2])samples->rows[row][k], SAMPLES);
            FR_ASSERT(curve != NULL);
            fr_scope_add_curve(scope, names[row][k], curve);
            fr_curve_unref(curve);
        }
    }
    g_free(samples);
    FrStatus status = fr_scope_add_function(scope, "walked", "z", "clamp((z - low)/whole, 0, 1)",
                                            (FrSpan){0}, NULL);
    for (int k = 0; k < 3; k++) {
        char *name = g_strdup_printf("to%d", k);
        char *body = g_strdup_printf("at%d(walked(z)) + x*side%d(walked(z)) + y*up%d(walked(z)) + "
                                     "(z - low - whole*walked(z))*ahead%d(walked(z))",
                                     k, k, k, k);
        status = status == FR_OK
                     ? fr_scope_add_function(scope, name, "x, y, z", body, (FrSpan){0}, NULL)
                     : status;
        g_free(name);
        g_free(body);
    }
    FR_ASSERT(status == FR_OK);
}
