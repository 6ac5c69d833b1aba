// Leaf blades, petals and sepals: a strip along a curved midrib, curved across.
// Lintermann, Deussen. Interactive Modeling of Plants. IEEE CG&A 19(1), 1999: blades from an
// outline, a longitudinal and a lateral curvature.
//
// The midrib is m(s) = ∫ (sin θ, cos θ) in the plane of y and z with θ(s) = θ0 + ∫ κ; across it
// runs a curve of the angle φ(t) = fold + ∫ κ from the midrib to each margin. Both keep arc length.
// From base to tip φ may differ: its fold and its curvature are then multiplied at each s.
// A curve over either curvature spreads the whole turn by its values: κ = turn · y(x) / ∫ |y|.
#include "skin/blade.h"

#include "frond/noise.h"
#include "skin/margin.h"
#include "skin/outline.h"
#include "skin/shape.h"

#include <cglm/struct.h>

#include <math.h>

enum { FINE = FR_BLADE_FINE, ROWS_MOST = 168, ACROSS_MOST = 32, KEY_BUMPS = 0x62756d70 };
/// From this level of detail on petioles are too thin to see.
enum { PETIOLE_GONE = 2 };

static double curve_at(const FrProfile *curve, double x) {
    const double(*p)[2] = (const double(*)[2])curve->points;
    if (x <= p[0][0]) {
        return p[0][1];
    }
    for (uint32_t i = 0; i + 1 < curve->count; i++) {
        if (x <= p[i + 1][0]) {
            double run = p[i + 1][0] - p[i][0];
            return run > 0.0 ? p[i][1] + (x - p[i][0]) / run * (p[i + 1][1] - p[i][1]) : p[i][1];
        }
    }
    return p[curve->count - 1][1];
}

static double finite_or_zero(double value) {
    return isfinite(value) ? value : 0.0;
}

// `late` is turned from `from` on, ever more.
static void bend(FrBent *bent, const FrPlant *plant, double start, double turn, uint32_t curve,
                 double late, double from) {
    const FrProfile *profile =
        curve < plant->profiles->len ? &g_array_index(plant->profiles, FrProfile, curve) : NULL;
    double step[FINE], all = 0.0;
    for (int i = 0; i < FINE; i++) {
        double x = (i + 0.5) / FINE;
        bool is_even = profile == NULL || profile->count == 0;
        step[i] = is_even ? 1.0 : finite_or_zero(curve_at(profile, x));
        all += fabs(step[i]);
    }
    bent->angle[0] = start;
    bent->x[0] = bent->y[0] = 0.0;
    for (int i = 0; i < FINE; i++) {
        double turned = all > 0.0 ? turn * step[i] / all : 0.0;
        double x = ((i + 0.5) / FINE - from) / (1.0 - from);
        turned += late != 0.0 && x > 0.0 ? late * 2.0 * x / (FINE * (1.0 - from)) : 0.0;
        double middle = bent->angle[i] + 0.5 * turned;
        bent->angle[i + 1] = bent->angle[i] + turned;
        // The chord of an arc is sin(a)/a of its length.
        double half = 0.5 * turned, chord = fabs(half) > 1e-6 ? sin(half) / half : 1.0;
        bent->x[i + 1] = bent->x[i] + chord * cos(middle) / FINE;
        bent->y[i + 1] = bent->y[i] + chord * sin(middle) / FINE;
    }
}

static void bent_at(const FrBent *bent, double at, double *x, double *y, double *angle) {
    double fine = at * FINE;
    int low = (int)fmin(fmax(fine, 0.0), FINE - 1);
    double part = fine - low, turned = part * (bent->angle[low + 1] - bent->angle[low]);
    double middle = bent->angle[low] + 0.5 * turned;
    *angle = bent->angle[low] + turned;
    *x = bent->x[low] + part / FINE * cos(middle);
    *y = bent->y[low] + part / FINE * sin(middle);
}

static double factor_at(const FrProfile *curve, double along) {
    return curve != NULL ? finite_or_zero(curve_at(curve, along)) : 1.0;
}

// The line across at `along`, `part` of the way from midrib to margin.
static void across_at(const FrBladeForm *form, double along, double part, double *out, double *up) {
    double phi, fold = form->blade->fold;
    if (form->across_along == NULL) {
        bent_at(&form->across, part, out, up, &phi);
    } else { // the same turns, each multiplied
        double factor = factor_at(form->across_along, along);
        *out = *up = 0.0;
        for (int i = 0; i < FINE && part * FINE > i; i++) {
            double step = fmin(part * FINE - i, 1.0);
            double turn = step * (form->across.angle[i + 1] - form->across.angle[i]);
            phi = fold + factor * (form->across.angle[i] - fold + 0.5 * turn);
            *out += step / FINE * cos(phi);
            *up += step / FINE * sin(phi);
        }
    }
    if (form->fold_along != NULL) {
        double turn = fold * (factor_at(form->fold_along, along) - 1.0), x = *out;
        *out = cos(turn) * x - sin(turn) * *up;
        *up = sin(turn) * x + cos(turn) * *up;
    }
}

static double twist_at(const FrBladeForm *form, double along) {
    if (form->blade->twist_along == 0) {
        return form->blade->twist * along;
    }
    int low = (int)fmin(fmax(along * FINE, 0.0), FINE - 1);
    return form->twist[low] + (along * FINE - low) * (form->twist[low + 1] - form->twist[low]);
}

// Bumps of the surface, none where it begins.
static double bump_at(const FrBladeForm *form, double along, double aside) {
    const FrBlade *blade = form->blade;
    if (!(blade->undulation > 0.0F)) {
        return 0.0;
    }
    double each = (double)blade->length / (double)blade->undulations;
    double x = aside / each, y = along * (double)blade->undulations;
    double noise = fr_noise2(fr_key_root(KEY_BUMPS), x + (double)blade->phase, y);
    return (double)blade->undulation * form->width * noise * fmin(6.0 * along, 1.0);
}

void fr_blade_point(const FrBladeForm *form, double along, double aside, double point[3]) {
    const FrBlade *blade = form->blade;
    double forth, lift, theta, out, up;
    bent_at(&form->along, along, &forth, &lift, &theta);
    across_at(form, along, fabs(aside) / form->half, &out, &up);
    double x = copysign(out * form->half, -aside), y = up * form->half;
    double part = aside / form->half, phase = aside < 0.0 ? 0.35 : 0.0;
    double wave = blade->wave * factor_at(form->wave_along, along);
    y += wave * form->width * part * part * sin(2.0 * G_PI * (blade->waves * along + phase));
    y += bump_at(form, along, aside);
    double twist = twist_at(form, along), cosine = cos(twist), sine = sin(twist);
    double turned_x = cosine * x - sine * y, turned_y = sine * x + cosine * y;
    point[0] = form->base.x + turned_x;
    point[1] = form->base.y + blade->length * lift + turned_y * cos(theta);
    point[2] = form->base.z + blade->length * forth - turned_y * sin(theta);
}

vec3s fr_blade_normal(const FrBladeForm *form, double along, double aside) {
    const double step = 1e-3;
    double base[3], tip[3], left[3], right[3], a[3], b[3];
    fr_blade_point(form, fmax(along - step, 0.0), aside, base);
    fr_blade_point(form, fmin(along + step, 1.0), aside, tip);
    fr_blade_point(form, along, aside - step * form->half, left);
    fr_blade_point(form, along, aside + step * form->half, right);
    for (int k = 0; k < 3; k++) {
        a[k] = right[k] - left[k];
        b[k] = tip[k] - base[k];
    }
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    double z = a[0] * b[1] - a[1] * b[0], length = sqrt(x * x + y * y + z * z);
    if (!(length > 0.0)) {
        return (vec3s){{0, 1, 0}};
    }
    return (vec3s){{(float)(x / length), (float)(y / length), (float)(z / length)}};
}

static uint32_t put_vertex(FrShapeMesh *mesh, const FrBladeForm *form, double along, double aside) {
    double u = fmin(fmax(0.5 + aside / form->width, 0.0), 1.0), point[3];
    fr_blade_point(form, along, aside, point);
    vec3s position = {{(float)point[0], (float)point[1], (float)point[2]}};
    return fr_shape_vertex(mesh, position, fr_blade_normal(form, along, aside), (float)u,
                           (float)(1.0 - along));
}

// From the left margin to the right: one vertex where the blade has no width.
static uint32_t put_row(FrShapeMesh *mesh, const FrBladeForm *form, const FrOutlineRow *row,
                        uint32_t across, uint32_t columns, uint32_t *first) {
    *first = mesh->vertex_count;
    if (row->left + row->right < 2e-3) {
        put_vertex(mesh, form, row->along, 0.0);
        return 1;
    }
    // A margin may touch the midrib, but columns stay apart.
    double left = fmax(row->left, 1e-3) * form->width, right = fmax(row->right, 1e-3) * form->width;
    for (uint32_t i = 0; i < columns; i++) {
        double part = columns == 2 ? (i == 0 ? -1.0 : 1.0) : (double)i / across - 1.0;
        put_vertex(mesh, form, row->along, part * (part < 0.0 ? left : right));
    }
    return columns;
}

static void join_rows(FrShapeMesh *mesh, uint32_t low, uint32_t low_count, uint32_t high,
                      uint32_t high_count) {
    uint32_t columns = MAX(low_count, high_count);
    for (uint32_t i = 0; i + 1 < columns; i++) {
        uint32_t a = low_count == 1 ? low : low + i, b = low_count == 1 ? low : low + i + 1;
        uint32_t d = high_count == 1 ? high : high + i, c = high_count == 1 ? high : high + i + 1;
        fr_shape_triangle(mesh, a, b, c);
        fr_shape_triangle(mesh, a, c, d);
    }
}

void fr_blade_segments(const FrBlade *blade, const FrDetail *detail, uint32_t *along,
                       uint32_t *across) {
    uint32_t waves = blade->wave != 0.0F ? (uint32_t)fminf(4.0F * fabsf(blade->waves), 64.0F) : 0;
    uint32_t bumps = blade->undulation > 0.0F ? (uint32_t)(3.0F * blade->undulations) : 0;
    uint32_t lobes = blade->margin == FR_MARGIN_LOBED ? 8 * MIN(blade->teeth, FR_LOBES_MOST) : 0;
    uint32_t wanted = MAX(MAX(blade->segments_along, waves), MAX(bumps, lobes));
    *along = fr_shape_segments(wanted, 1, ROWS_MOST, detail);
    uint32_t fine = blade->undulation > 0.0F ? 3 : blade->edge_curl != 0.0F ? 4 : 0;
    *across = fr_shape_segments(MAX(blade->segments_across, fine), 1, ACROSS_MOST, detail);
}

static void lay_blade(FrShapeMesh *mesh, const FrPlant *plant, const FrBladeForm *form,
                      const FrDetail *detail) {
    const FrBlade *blade = form->blade;
    FrOutline outline;
    FrOutlineRow rows[ROWS_MOST + 1];
    fr_outline_init(&outline, plant, blade->outline);
    if (!(outline.area > 1e-6)) {
        return;
    }
    fr_outline_lobe(&outline, blade);
    if (detail->lod < PETIOLE_GONE) {
        fr_outline_thicken(&outline, blade);
    }
    uint32_t along, across;
    fr_blade_segments(blade, detail, &along, &across);
    bool is_level = blade->curvature_across == 0.0F && blade->fold == 0.0F && blade->wave == 0.0F &&
                    blade->twist == 0.0F && blade->edge_curl == 0.0F && blade->undulation == 0.0F;
    // Two columns do where nothing bends across, and from far away.
    uint32_t columns = across == 1 && (is_level || detail->lod > 3) ? 2 : 2 * across + 1;
    fr_outline_rows(&outline, along, rows);
    uint32_t low = 0, low_count = 0;
    for (uint32_t i = 0; i <= along; i++) {
        uint32_t first, count = put_row(mesh, form, &rows[i], across, columns, &first);
        if (i > 0) {
            join_rows(mesh, low, low_count, first, count);
        }
        low = first;
        low_count = count;
    }
    fr_margin_teeth(mesh, form, rows, along + 1, detail);
}

// A tube of three sides, one flat strip from far away. It takes its colour from the midrib in the
// lower part of the picture.
static void lay_petiole(FrShapeMesh *mesh, const FrBlade *blade, const FrBent *bent,
                        const FrDetail *detail) {
    bool is_strip = detail->lod > 0;
    uint32_t segments = fabsf(blade->petiole_bend) > 0.2F && !is_strip ? 3 : 1;
    uint32_t sides = is_strip ? 2 : 3;
    for (uint32_t j = 0; j <= segments; j++) {
        double forth, lift, theta;
        bent_at(bent, (double)j / segments, &forth, &lift, &theta);
        for (uint32_t i = 0; i < sides; i++) {
            double angle = is_strip ? G_PI * i : G_PI * (0.5 + 2.0 * i / 3.0);
            float x = (float)cos(angle), up = is_strip ? 0.0F : (float)sin(angle);
            vec3s aside = {{x, up * (float)cos(theta), -up * (float)sin(theta)}};
            vec3s at = {
                {0, blade->petiole_length * (float)lift, blade->petiole_length * (float)forth}};
            vec3s normal = is_strip ? (vec3s){{0, (float)cos(theta), -(float)sin(theta)}} : aside;
            fr_shape_vertex(mesh, glms_vec3_muladds(aside, blade->petiole_radius, at), normal,
                            0.5F - 0.005F * x, 0.94F - 0.04F * (float)j / (float)segments);
        }
        for (uint32_t i = 0; j > 0 && i < (is_strip ? 1 : sides); i++) {
            uint32_t base = (j - 1) * sides, a = base + i, b = base + (i + 1) % sides;
            fr_shape_triangle(mesh, a, b, b + sides);
            fr_shape_triangle(mesh, a, b + sides, a + sides);
        }
    }
}

static const FrProfile *factor_of(const FrPlant *plant, uint32_t along) {
    const FrProfile *curve = along > 0 && along <= plant->profiles->len
                                 ? &g_array_index(plant->profiles, FrProfile, along - 1)
                                 : NULL;
    return curve != NULL && curve->count > 0 ? curve : NULL;
}

static void vary_along(FrBladeForm *form, const FrPlant *plant) {
    const FrBlade *blade = form->blade;
    form->across_along = factor_of(plant, blade->across_along);
    form->fold_along = factor_of(plant, blade->fold_along);
    form->wave_along = factor_of(plant, blade->wave_along);
    const FrProfile *twist = factor_of(plant, blade->twist_along);
    for (int i = 0; i < FINE && blade->twist_along != 0; i++) {
        form->twist[i + 1] =
            form->twist[i] + blade->twist * factor_at(twist, (i + 0.5) / FINE) / FINE;
    }
}

bool fr_blade_form_init(FrBladeForm *form, const FrPlant *plant, const FrBlade *blade) {
    *form = (FrBladeForm){.blade = blade, .width = blade->width, .half = 0.5 * blade->width};
    double start = 0.0;
    if (blade->petiole_length > 0.0F) {
        double forth, lift;
        bend(&form->petiole, plant, 0.0, blade->petiole_bend, FR_NONE, 0.0, 0.0);
        bent_at(&form->petiole, 1.0, &forth, &lift, &start);
        form->base.y = blade->petiole_length * (float)lift;
        form->base.z = blade->petiole_length * (float)forth;
    }
    if (!(blade->length > 0.0F && blade->width > 0.0F)) {
        return false;
    }
    bend(&form->along, plant, start, blade->curvature_along, blade->along_curve, -blade->tip_droop,
         0.5);
    bend(&form->across, plant, blade->fold, blade->curvature_across, blade->across_curve,
         blade->edge_curl, 0.67);
    vary_along(form, plant);
    return true;
}

void fr_blade_petiole(const FrBladeForm *form, double along, double point[3]) {
    double forth, lift, theta, length = (double)form->blade->petiole_length;
    bent_at(&form->petiole, along, &forth, &lift, &theta);
    point[0] = 0.0;
    point[1] = length * lift;
    point[2] = length * forth;
}

void fr_lay_blade(FrShapeMesh *mesh, const FrPlant *plant, const FrBlade *blade,
                  const FrDetail *detail) {
    FrBladeForm form;
    bool has_blade = fr_blade_form_init(&form, plant, blade);
    if (blade->petiole_length > 0.0F && blade->petiole_radius > 0.0F &&
        detail->lod < PETIOLE_GONE) {
        lay_petiole(mesh, blade, &form.petiole, detail);
    }
    if (has_blade) {
        lay_blade(mesh, plant, &form, detail);
    }
}

void fr_shape_blade(FrShapeMesh *mesh, const FrPlant *plant, const FrBlade *blade,
                    const FrDetail *detail) {
    mesh->is_foliage = true;
    if (blade->compound == FR_COMPOUND_SIMPLE) {
        fr_lay_blade(mesh, plant, blade, detail);
    } else {
        fr_lay_compound(mesh, plant, blade, detail);
    }
    fr_turn_normals(mesh, blade);
}
