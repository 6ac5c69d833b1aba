// Ridges at the foot of a stem and furrows of its bark, as displacement of its rings outwards.
//
// A point of a ring is at + f · (x across + y upwards) with f ≥ 1; f is one plus the buttress that
// reaches there, in radii, plus the relief. A buttress is a plate that grows thin and low: in polar
// form its height over the trunk falls as the square of the distance from its crest, around as well
// as upwards. Relief is ridged noise (Musgrave; in Ebert et al., Texturing and Modeling, 1994) on
// the cylinder, so it closes around and never slides along.
#include "skin/cap.h"
#include "skin/sweep.h"

#include "frond/noise.h"

#include <cglm/struct.h>

#include <math.h>

enum { KEY_RELIEF = 1, KEY_CREST = 2, KEY_DEPTH = 3, KEY_HEIGHT = 4 };

// How much buttresses differ at irregularity 1: where they stand, in gaps; how deep; how high.
#define CREST_ASTRAY 0.35
#define LESS_DEEP 0.6
#define LESS_HIGH 0.5

// Where a crest is, in gaps between crests from the x direction.
static double crest_of(const FrSweep *sweep, uint32_t k) {
    double astray = CREST_ASTRAY * (double)sweep->finish->irregularity;
    return k + astray * fr_random_signed(sweep->key, KEY_CREST, k);
}

// How far the buttress nearest around stands out, m.
static double buttress_at(const FrSweep *sweep, double x, double y, double along) {
    const FrFinish *finish = sweep->finish;
    double above = along / ((double)sweep->foot * (double)finish->buttress_height);
    if (finish->buttresses == 0 || above >= 1.0) {
        return 0.0;
    }
    double count = finish->buttresses, most = 0.0;
    double place = atan2(y, x) / (2.0 * G_PI) * count; // in gaps
    double around = place < 0.0 ? place + count : place;
    for (uint32_t step = 0; step < 3; step++) {
        uint32_t k = ((uint32_t)around + finish->buttresses + step - 1) % finish->buttresses;
        double apart = fabs(around - crest_of(sweep, k));
        apart = fmin(apart, count - apart);
        double irregular = (double)finish->irregularity;
        double deep = 1.0 - LESS_DEEP * irregular * fr_random(sweep->key, KEY_DEPTH, k);
        double high = 1.0 - LESS_HIGH * irregular * fr_random(sweep->key, KEY_HEIGHT, k);
        double low = fmax(1.0 - above / high, 0.0);
        double near = fmax(1.0 - 2.0 * apart / (double)finish->buttress_width, 0.0);
        most = fmax(most, deep * low * low * near * near);
    }
    return most * (double)finish->buttress_depth * (double)sweep->foot;
}

// Depth of the relief, in radii.
static double relief_at(const FrSweep *sweep, double x, double y, double along) {
    const FrFinish *finish = sweep->finish;
    double depth = (double)finish->relief;
    if (!(depth > 0.0)) {
        return 0.0;
    }
    if (sweep->plan->detail.lod >= FR_RELIEF_GONE) {
        return 0.5 * depth; // as thick as it is on the average
    }
    double scale = (double)finish->relief_count / (2.0 * G_PI), size = hypot(x, y);
    double fx = scale * x / size, fy = scale * y / size;
    double fz = scale * along / ((double)sweep->foot * (double)finish->relief_stretch);
    FrKey key = fr_key_child(sweep->key, KEY_RELIEF);
    double ridge = 1.0 - fabs(fr_noise3(key, fx, fy, fz));
    double swell = fr_noise3(fr_key_child(key, 1), 2.3 * fx, 2.3 * fy, 2.3 * fz);
    return depth * CLAMP(0.75 * ridge * ridge + 0.125 + 0.25 * swell, 0.0, 1.0);
}

static vec3s point_at(const FrSweep *sweep, const FrRing *ring, const FrColumn *column,
                      float ahead) {
    float radius = MAX(glms_vec3_norm(ring->across), 1e-12F);
    double x = (double)column->x, y = (double)column->y, along = (double)(sweep->along + ahead);
    double out =
        1.0 + relief_at(sweep, x, y, along) + buttress_at(sweep, x, y, along) / (double)radius;
    float factor = (float)out * (1.0F + ring->slope * ahead / radius);
    vec3s at = glms_vec3_muladds(ring->tangent, ahead, ring->at);
    at = glms_vec3_muladds(ring->across, factor * column->x, at);
    return glms_vec3_muladds(ring->upwards, factor * column->y, at);
}

void fr_write_rough(const FrSweep *sweep, const FrRing *ring) {
    const FrColumn *columns = sweep->section->columns;
    uint32_t sides = sweep->section->count - 1;
    float ahead = 0.02F * MAX(glms_vec3_norm(ring->across), 1e-6F);
    vec3s before = point_at(sweep, ring, &columns[sides - 1], 0.0F);
    vec3s here = point_at(sweep, ring, &columns[0], 0.0F);
    for (uint32_t i = 0; i <= sides; i++) {
        vec3s after = point_at(sweep, ring, &columns[(i + 1) % sides], 0.0F);
        vec3s above = point_at(sweep, ring, &columns[i], ahead);
        vec3s around = glms_vec3_sub(after, before), along = glms_vec3_sub(above, here);
        vec3s normal = glms_vec3_cross(around, along);
        float length = glms_vec3_norm(normal);
        FrVertex *out = &sweep->vertex[i];
        normal = length > 0.0F ? glms_vec3_scale(normal, 1.0F / length)
                               : fr_ring_normal(ring, columns[i].normal_x, columns[i].normal_y);
        fr_put(out->position, here, sweep->up);
        fr_put(out->normal, normal, sweep->up);
        out->uv[0] = sweep->bark.u + sweep->bark.around * columns[i].u;
        out->uv[1] = ring->v;
        before = here;
        here = after;
    }
}
