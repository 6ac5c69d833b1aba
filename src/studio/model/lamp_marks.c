// Lamps, the probe and the sun as marks.
#include "frond/daylight.h"
#include "frond/document.h"
#include "frond/scene.h"
#include "studio/model/lamp_private.h"

#include <math.h>
#include <string.h>

enum { POINT, SPOT, AREA };

static const float warm[4] = {1.0f, 0.84f, 0.45f, 0.95f};
static const float chosen[4] = {1.0f, 0.62f, 0.13f, 1.0f};
static const float faint[4] = {1.0f, 0.84f, 0.45f, 0.30f};
static const float axis_colours[3][4] = {
    {0.93f, 0.33f, 0.31f, 1}, {0.45f, 0.80f, 0.36f, 1}, {0.36f, 0.58f, 0.95f, 1}};

static void along(const double from[3], const double way[3], double length, double to[3]) {
    for (int i = 0; i < 3; i++) {
        to[i] = from[i] + length * way[i];
    }
}

void studio_across(const double direction[3], double x[3], double y[3]) {
    int least = fabs(direction[0]) < fabs(direction[1]) ? 0 : 1;
    least = fabs(direction[2]) < fabs(direction[least]) ? 2 : least;
    double other[3] = {0, 0, 0}, length = 0;
    other[least] = 1;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = direction[j] * other[k] - direction[k] * other[j];
        length += x[i] * x[i];
    }
    for (int i = 0; i < 3; i++) {
        x[i] /= sqrt(length);
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        y[i] = direction[j] * x[k] - direction[k] * x[j];
    }
}

static void direction_of(const FrLampParams *lamp, double way[3]) {
    vec3s unit = fr_scene_lamp(lamp).direction;
    bool is_one = isfinite(unit.x) && glms_vec3_norm(unit) > 0.5f;
    for (int i = 0; i < 3; i++) {
        way[i] = is_one ? (double)unit.raw[i] : i == 2 ? -1 : 0;
    }
}

void studio_aim_place(const FrLampParams *lamp, double reach, double at[3]) {
    double way[3];
    direction_of(lamp, way);
    for (int i = 0; i < 3; i++) {
        at[i] = (double)lamp->at.raw[i] + 1.6 * reach * way[i];
    }
}

// ---- lamps -------------------------------------------------------------------------------------

// A ball as three circles, with rays around it.
static void add_point(StudioOverlay *overlay, const double at[3], double radius,
                      const float colour[4]) {
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++) {
        studio_overlay_circle(overlay, at, axes[i], axes[(i + 1) % 3], radius, 1.5, colour);
        for (int side = -1; side <= 1; side += 2) {
            double from[3], to[3];
            along(at, axes[i], side * 1.5 * radius, from);
            along(at, axes[i], side * 2.4 * radius, to);
            studio_overlay_line(overlay, from, to, 1.5, colour);
        }
    }
}

static void add_spot(StudioOverlay *overlay, const FrLampParams *lamp, const double at[3],
                     double reach, const float colour[4]) {
    double way[3], x[3], y[3], centre[3], rim[3];
    direction_of(lamp, way);
    studio_across(way, x, y);
    along(at, way, reach * cos(lamp->angle), centre);
    double radius = reach * sin(lamp->angle);
    studio_overlay_circle(overlay, centre, x, y, radius, 1.5, colour);
    for (int k = 0; k < 8; k++) {
        for (int i = 0; i < 3; i++) {
            rim[i] = centre[i] + radius * (cos(k * G_PI / 4) * x[i] + sin(k * G_PI / 4) * y[i]);
        }
        studio_overlay_line(overlay, at, rim, 1, k % 2 == 0 ? colour : faint);
    }
}

static void add_area(StudioOverlay *overlay, const FrLampParams *params, const float colour[4]) {
    static const int turns[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    FrLamp lamp = fr_scene_lamp(params);
    double corners[5][3];
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < 3; i++) {
            corners[k][i] =
                (double)(lamp.position.raw[i] + (float)turns[k][0] * lamp.side[0].raw[i] +
                         (float)turns[k][1] * lamp.side[1].raw[i]);
        }
    }
    for (int k = 0; k < 4; k++) {
        studio_overlay_line(overlay, corners[k], corners[k + 1], 2, colour);
    }
    studio_overlay_triangle(overlay, corners[0], corners[1], corners[2], faint);
    studio_overlay_triangle(overlay, corners[0], corners[2], corners[3], faint);
}

static void add_arrows(StudioOverlay *overlay, const double at[3], double reach) {
    for (int i = 0; i < 3; i++) {
        double to[3] = {at[0], at[1], at[2]};
        to[i] += reach;
        studio_overlay_arrow(overlay, at, to, 2.5, axis_colours[i]);
    }
}

static void add_lamp(StudioOverlay *overlay, const FrLampParams *lamp, bool is_selected,
                     double reach) {
    const float *colour = is_selected ? chosen : warm;
    double at[3], tip[3];
    for (int i = 0; i < 3; i++) {
        at[i] = (double)lamp->at.raw[i];
    }
    studio_aim_place(lamp, reach, tip);
    studio_overlay_point(overlay, at, 9, colour);
    if (lamp->kind == POINT) {
        add_point(overlay, at, fmax(0.25 * reach, lamp->radius), colour);
    } else if (lamp->kind == SPOT) {
        add_spot(overlay, lamp, at, reach, colour);
    } else {
        add_area(overlay, lamp, colour);
    }
    if (lamp->kind != POINT) {
        studio_overlay_arrow(overlay, at, tip, is_selected ? 2.5 : 1.2,
                             is_selected ? chosen : faint);
    }
    if (is_selected) {
        if (lamp->kind != POINT) {
            studio_overlay_point(overlay, tip, 9, chosen);
        }
        add_arrows(overlay, at, reach);
    }
}

// ---- the probe ---------------------------------------------------------------------------------

bool studio_probe_place(const StudioDocument *document, double at[3]) {
    uint32_t light = studio_find_in_scene(document, "light");
    FrLightParams params = {0};
    studio_read_params(document, light, fr_light_table(), &params);
    for (int i = 0; i < 3; i++) {
        at[i] = (double)params.reference.raw[i];
    }
    fr_params_clear(fr_light_table(), &params);
    return light != FR_NONE;
}

static void add_probe(StudioOverlay *overlay, const double at[3], bool is_selected, double reach) {
    static const float cyan[4] = {0.35f, 0.85f, 0.95f, 1};
    const float *colour = is_selected ? chosen : cyan;
    double corners[6][3];
    for (int k = 0; k < 6; k++) {
        memcpy(corners[k], at, sizeof corners[k]);
        corners[k][k / 2] += (k % 2 == 0 ? 0.3 : -0.3) * reach;
    }
    for (int a = 0; a < 6; a++) {
        for (int b = a + 1; b < 6; b++) {
            if (a / 2 != b / 2) {
                studio_overlay_line(overlay, corners[a], corners[b], 1.5, colour);
            }
        }
    }
    studio_overlay_point(overlay, at, 8, colour);
    if (is_selected) {
        add_arrows(overlay, at, reach);
    }
}

StudioOverlay *studio_lamp_marks(const StudioDocument *document, uint32_t selected, double reach) {
    StudioOverlay *overlay = studio_overlay_new();
    GArray *lamps = studio_lamps(document);
    double at[3];
    overlay->through = 0.45f;
    for (guint i = 0; i < lamps->len; i++) {
        const StudioLamp *lamp = &g_array_index(lamps, StudioLamp, i);
        add_lamp(overlay, &lamp->params, lamp->element == selected, reach);
    }
    if (studio_probe_place(document, at)) {
        add_probe(overlay, at, studio_find_in_scene(document, "light") == selected, reach);
    }
    g_array_unref(lamps);
    return overlay;
}

// ---- the sun -----------------------------------------------------------------------------------

// Where the sun stands, and on which way over the day.
static FrSunPath sun_of(const StudioDocument *document, double *azimuth, double *elevation) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t dated = studio_find_in_scene(document, "sun");
    FrSunParams sun = {0};
    FrSceneParams scene = {0};
    studio_read_params(document, dated, fr_sun_table(), &sun);
    studio_read_params(document, fr_contents_child(contents, 0, "scene"), fr_scene_table(), &scene);
    *azimuth = scene.sun_azimuth;
    *elevation = scene.sun_elevation;
    if (dated != FR_NONE && !fr_sun_where(&sun, azimuth, elevation)) {
        *azimuth = scene.sun_azimuth; // the date is none: it is told elsewhere
    }
    FrSunPath path = fr_light_sun_path(sun.latitude, *azimuth, *elevation);
    fr_params_clear(fr_sun_table(), &sun);
    fr_params_clear(fr_scene_table(), &scene);
    return path;
}

// The sun's direction at an hour angle.
static void sun_at(const FrSunPath *path, double hour, double way[3]) {
    double sine = sin(path->latitude), cosine = cos(path->latitude);
    double up = sin(path->declination), out = cos(path->declination);
    way[0] = -out * sin(hour);
    way[1] = up * cosine - out * cos(hour) * sine;
    way[2] = up * sine + out * cos(hour) * cosine;
}

static void add_way(StudioOverlay *overlay, const FrSunPath *path, const double centre[3],
                    double radius) {
    static const float night[4] = {0.45f, 0.55f, 0.75f, 0.25f};
    double before[3], way[3], at[3];
    for (int k = 0; k <= 96; k++) {
        sun_at(path, 2 * G_PI * k / 96 - G_PI, way);
        along(centre, way, radius, at);
        if (k > 0) {
            bool is_day = way[2] > 0;
            studio_overlay_line(overlay, before, at, is_day ? 2.5 : 1, is_day ? warm : night);
        }
        if (k % 4 == 0 && way[2] > 0) { // the hours by the sun
            studio_overlay_point(overlay, at, 6, warm);
        }
        memcpy(before, at, sizeof before);
    }
}

// A ring on the ground with a mark to the north and shorter ones to the other sides.
static void add_compass(StudioOverlay *overlay, const double centre[3], double radius) {
    static const float grey[4] = {0.75f, 0.77f, 0.8f, 0.5f};
    static const double east[3] = {1, 0, 0}, north[3] = {0, 1, 0};
    studio_overlay_circle(overlay, centre, east, north, radius, 1.2, grey);
    for (int k = 0; k < 8; k++) {
        double way[3] = {sin(k * G_PI / 4), cos(k * G_PI / 4), 0}, from[3], to[3];
        along(centre, way, radius, from);
        along(centre, way, radius * (k == 0 ? 1.14 : k % 2 == 0 ? 1.06 : 1.03), to);
        if (k == 0) {
            studio_overlay_arrow(overlay, centre, to, 1.2, axis_colours[0]);
        } else {
            studio_overlay_line(overlay, from, to, 1.5, grey);
        }
    }
}

StudioOverlay *studio_sun_marks(const StudioDocument *document, const double min[3],
                                const double max[3]) {
    StudioOverlay *overlay = studio_overlay_new();
    double azimuth, elevation, centre[3], half = 0.25;
    FrSunPath path = sun_of(document, &azimuth, &elevation);
    for (int i = 0; i < 3; i++) {
        bool is_empty = !(max[i] >= min[i]);
        centre[i] = is_empty ? 0 : 0.5 * (min[i] + max[i]);
        half = fmax(half, is_empty ? 0 : 0.5 * (max[i] - min[i]));
    }
    centre[2] = fmin(0, max[2] >= min[2] ? min[2] : 0);
    double radius = 1.5 * half;
    vec3s direction = fr_light_sun_direction(azimuth, elevation);
    double way[3], at[3];
    for (int i = 0; i < 3; i++) {
        way[i] = (double)direction.raw[i];
    }
    along(centre, way, radius, at);
    add_compass(overlay, centre, radius);
    add_way(overlay, &path, centre, radius);
    studio_overlay_point(overlay, at, 26, (const float[4]){1.0f, 0.84f, 0.45f, 0.35f});
    studio_overlay_point(overlay, at, 16, (const float[4]){1.0f, 0.93f, 0.70f, 1});
    studio_overlay_line(overlay, at, centre, 1, faint);
    return overlay;
}
