// Space curves through given points, walked by arc length.
// Centripetal Catmull-Rom: no cusps or loops inside a segment. After: Yuksel, Schaefer, Keyser.
// Parameterization and applications of Catmull-Rom curves. Computer-Aided Design 43 (7), 2011.
#include "frond/curve.h"

#include <cglm/struct.h>

#include <math.h>

// Chords per segment: a quarter circle given by its ends and middle is off by 1e-4 of its radius.
#define CHORDS 16

// Points nearer than this repeat each other; coordinates beyond would overflow the formulas.
#define SAME 1e-9f
#define FARTHEST 1e12f

typedef struct Sample {
    vec3s point, tangent;
    double distance;
} Sample;

struct FrPath {
    gint references;
    size_t count;
    Sample samples[];
};

// False for infinities and NaN too.
static bool is_near(vec3s v) {
    return fabsf(v.x) < FARTHEST && fabsf(v.y) < FARTHEST && fabsf(v.z) < FARTHEST;
}

// Copies the points but those that repeat their forerunner, with room for one more at either end.
static vec3s *distinct_points(const vec3s *points, size_t count, size_t *kept) {
    vec3s *distinct = g_new(vec3s, count + 2);
    *kept = 0;
    for (size_t i = 0; i < count; i++) {
        if (!is_near(points[i])) {
            g_free(distinct);
            return NULL;
        }
        if (*kept == 0 || glms_vec3_distance(points[i], distinct[*kept]) > SAME) {
            distinct[++*kept] = points[i];
        }
    }
    return distinct;
}

// The parameter step between two points: the root of their distance.
static float knot_step(vec3s a, vec3s b) {
    return sqrtf(glms_vec3_distance(a, b));
}

// The derivative at b of the parabola through a, b, c with knot steps s and t.
static vec3s derivative(vec3s a, vec3s b, vec3s c, float s, float t) {
    vec3s before = glms_vec3_scale(glms_vec3_sub(b, a), t / (s * (s + t)));
    vec3s after = glms_vec3_scale(glms_vec3_sub(c, b), s / (t * (s + t)));
    return glms_vec3_add(before, after);
}

// Point and direction at u of the segment from p[1] to p[2].
static Sample sample_segment(const vec3s p[4], float u) {
    float step0 = knot_step(p[0], p[1]), step1 = knot_step(p[1], p[2]),
          step2 = knot_step(p[2], p[3]);
    vec3s chord = glms_vec3_sub(p[2], p[1]);
    vec3s m0 = glms_vec3_scale(derivative(p[0], p[1], p[2], step0, step1), step1);
    vec3s m1 = glms_vec3_scale(derivative(p[1], p[2], p[3], step1, step2), step1);
    // Hermite form: p1 + u m0 + u² (3 chord − 2 m0 − m1) + u³ (m0 + m1 − 2 chord)
    vec3s square =
        glms_vec3_sub(glms_vec3_scale(chord, 3), glms_vec3_add(glms_vec3_scale(m0, 2), m1));
    vec3s cube = glms_vec3_sub(glms_vec3_add(m0, m1), glms_vec3_scale(chord, 2));
    vec3s point = glms_vec3_add(
        p[1],
        glms_vec3_scale(
            glms_vec3_add(m0, glms_vec3_scale(glms_vec3_add(square, glms_vec3_scale(cube, u)), u)),
            u));
    vec3s tangent = glms_vec3_add(
        m0, glms_vec3_add(glms_vec3_scale(square, 2 * u), glms_vec3_scale(cube, 3 * u * u)));
    return (Sample){.point = point, .tangent = glms_vec3_normalize(tangent)};
}

// Fills samples 1 … of a path through `count` points p[1] … p[count].
static void sample_path(FrPath *path, vec3s *p, size_t count) {
    // Beyond the ends the curve would go straight on.
    p[0] = glms_vec3_sub(glms_vec3_scale(p[1], 2), p[2]);
    p[count + 1] = glms_vec3_sub(glms_vec3_scale(p[count], 2), p[count - 1]);
    path->samples[0] = sample_segment(p, 0);
    for (size_t i = 1; i < path->count; i++) {
        size_t segment = (i - 1) / CHORDS;
        float u = (float)(i - segment * CHORDS) / CHORDS;
        Sample *here = &path->samples[i];
        *here = sample_segment(p + segment, u);
        here->distance =
            here[-1].distance + (double)glms_vec3_distance(here[-1].point, here->point);
    }
}

FrPath *fr_path_new(const vec3s *points, size_t count) {
    size_t kept;
    vec3s *p = distinct_points(points, count, &kept);
    if (p == NULL || kept == 0) {
        g_free(p);
        return NULL;
    }
    size_t samples = (kept - 1) * CHORDS + 1;
    FrPath *path = g_malloc0(sizeof *path + samples * sizeof path->samples[0]);
    path->references = 1;
    path->count = samples;
    if (kept > 1) {
        sample_path(path, p, kept);
    } else {
        path->samples[0] = (Sample){.point = p[1], .tangent = {{0, 0, 1}}};
    }
    g_free(p);
    return path;
}

FrPath *fr_path_ref(FrPath *path) {
    g_atomic_int_inc(&path->references);
    return path;
}

void fr_path_unref(FrPath *path) {
    if (path != NULL && g_atomic_int_dec_and_test(&path->references)) {
        g_free(path);
    }
}

double fr_path_length(const FrPath *path) {
    return path->samples[path->count - 1].distance;
}

void fr_path_at(const FrPath *path, double distance, vec3s *point, vec3s *tangent) {
    const Sample *base = path->samples;
    size_t length = path->count - 1;
    double wanted = distance > 0 ? MIN(distance, fr_path_length(path)) : 0;
    while (length > 1) {
        size_t half = length / 2;
        base = wanted >= base[half].distance ? base + half : base;
        length -= half;
    }
    if (length == 0 || !(base[1].distance > base[0].distance)) {
        *point = base->point;
        *tangent = base->tangent;
        return;
    }
    float u = (float)((wanted - base[0].distance) / (base[1].distance - base[0].distance));
    *point = glms_vec3_lerp(base[0].point, base[1].point, u);
    vec3s blend = glms_vec3_lerp(base[0].tangent, base[1].tangent, u);
    *tangent = glms_vec3_norm2(blend) > 0 ? glms_vec3_normalize(blend) : base[0].tangent;
}
