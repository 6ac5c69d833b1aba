// Photons from lamps (Jensen 2001, Realistic Image Synthesis Using Photon Mapping, chapter 5), all
// of the same power.
//
// Photon i takes the i-th of equal pieces of [0, 1): a lamp owns as much of it as it has of the
// power, and within its part the digits are dealt out to two or four coordinates (Z-order, Morton
// 1966). So every lamp sends its share to within one photon, starting places are spread evenly,
// and those of neighbouring photons are near each other.
#include "light/emitters.h"

#include "frond/digest.h"

#include <cglm/struct.h>
#include <math.h>

enum { SKY_HEIGHTS = 96, SKY_TURNS = 192, SKY_CELLS = SKY_HEIGHTS * SKY_TURNS };

typedef struct Emitter {
    FrLamp lamp;
    double begin;     ///< of its part of [0, 1)
    double power;     ///< sent out, or through the box
    double w[3];      ///< unit: spot's axis, area's normal, where the sun's light goes
    double *sky_ends; ///< SKY_CELLS ends of the parts of [0, 1) that cells of the sky own
} Emitter;

struct FrEmitters {
    Emitter *lamps;
    uint32_t count;
    double power;
    double min[3], max[3];
    FrDigest digest;
};

enum { PURPOSE_EMIT = 1 };

static void unit(const vec3s from, double out[3]) {
    double length = sqrt((double)from.x * (double)from.x + (double)from.y * (double)from.y +
                         (double)from.z * (double)from.z);
    for (int c = 0; c < 3; c++) {
        out[c] = length > 0.0 ? (double)from.raw[c] / length : (c == 2 ? 1.0 : 0.0);
    }
}

static double face_area(const FrEmitters *emitters, int axis) {
    int b = (axis + 1) % 3, c = (axis + 2) % 3;
    return (emitters->max[b] - emitters->min[b]) * (emitters->max[c] - emitters->min[c]);
}

// The area of the box as seen along a direction.
static double seen_area(const FrEmitters *emitters, const double direction[3]) {
    double area = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        area += fabs(direction[axis]) * face_area(emitters, axis);
    }
    return area;
}

// A direction towards the sky. Heights and turns are even in solid angle.
static void sky_direction(double height, double turn, double out[3]) {
    double side = sqrt(fmax(0.0, 1.0 - height * height));
    out[0] = side * cos(2.0 * G_PI * turn);
    out[1] = side * sin(2.0 * G_PI * turn);
    out[2] = height;
}

// How much of the sky's light comes through the box from each of its cells.
static double prepare_sky(const FrEmitters *emitters, Emitter *sky) {
    sky->sky_ends = g_new(double, SKY_CELLS);
    double level = 0.0, through = 0.0;
    for (int cell = 0; cell < SKY_CELLS; cell++) {
        double direction[3];
        sky_direction((cell / SKY_TURNS + 0.5) / SKY_HEIGHTS, (cell % SKY_TURNS + 0.5) / SKY_TURNS,
                      direction);
        double brightness = fr_lamp_sky_brightness(
            &sky->lamp, (vec3s){{(float)direction[0], (float)direction[1], (float)direction[2]}});
        level += brightness * direction[2];
        through += brightness * seen_area(emitters, direction);
        sky->sky_ends[cell] = through;
    }
    for (int cell = 0; cell < SKY_CELLS && through > 0.0; cell++) {
        sky->sky_ends[cell] /= through;
    }
    return level > 0.0 ? sky->lamp.power * through / level : 0.0;
}

static void prepare(const FrEmitters *emitters, Emitter *emitter) {
    const FrLamp *lamp = &emitter->lamp;
    emitter->power = lamp->power > 0.0 ? lamp->power : 0.0;
    unit(lamp->kind == FR_LAMP_AREA ? glms_vec3_cross(lamp->side[0], lamp->side[1])
                                    : lamp->direction,
         emitter->w);
    if (lamp->kind == FR_LAMP_SUN) {
        emitter->power *= seen_area(emitters, emitter->w);
    } else if (lamp->kind == FR_LAMP_SKY && emitter->power > 0.0) {
        emitter->power = prepare_sky(emitters, emitter);
    }
}

static FrDigest digest_of(const FrLamp *lamp, FrDigest digest) {
    double numbers[20] = {lamp->kind, lamp->power, (double)lamp->angle, lamp->sky};
    const vec3s vectors[5] = {lamp->position, lamp->direction, lamp->side[0], lamp->side[1],
                              lamp->sun};
    for (int i = 0; i < 15; i++) {
        numbers[4 + i] = (double)vectors[i / 3].raw[i % 3];
    }
    return fr_digest(digest, numbers, sizeof numbers);
}

FrEmitters *fr_emitters_new(const FrLamp *lamps, uint32_t count, vec3s min, vec3s max) {
    FrEmitters *emitters = g_new0(FrEmitters, 1);
    emitters->lamps = g_new0(Emitter, count);
    emitters->count = count;
    for (int c = 0; c < 3; c++) {
        emitters->min[c] = (double)min.raw[c];
        emitters->max[c] = (double)max.raw[c];
    }
    emitters->digest = fr_digest(0, emitters->min, sizeof emitters->min);
    emitters->digest = fr_digest(emitters->digest, emitters->max, sizeof emitters->max);
    for (uint32_t i = 0; i < count; i++) {
        Emitter *emitter = &emitters->lamps[i];
        emitter->lamp = lamps[i];
        emitters->digest = digest_of(&lamps[i], emitters->digest);
        prepare(emitters, emitter);
        emitter->begin = emitters->power;
        emitters->power += emitter->power;
    }
    for (uint32_t i = 0; i < count && emitters->power > 0.0; i++) {
        emitters->lamps[i].begin /= emitters->power;
    }
    return emitters;
}

void fr_emitters_free(FrEmitters *emitters) {
    if (emitters == NULL) {
        return;
    }
    for (uint32_t i = 0; i < emitters->count; i++) {
        g_free(emitters->lamps[i].sky_ends);
    }
    g_free(emitters->lamps);
    g_free(emitters);
}

double fr_emitters_power(const FrEmitters *emitters) {
    return emitters->power;
}

FrDigest fr_emitters_digest(const FrEmitters *emitters) {
    return emitters->digest;
}

/// Every second of the lower bits of x, brought together.
static uint64_t every_second(uint64_t x) {
    x &= UINT64_C(0x5555555555555555);
    x = (x | x >> 1) & UINT64_C(0x3333333333333333);
    x = (x | x >> 2) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    x = (x | x >> 4) & UINT64_C(0x00ff00ff00ff00ff);
    x = (x | x >> 8) & UINT64_C(0x0000ffff0000ffff);
    return (x | x >> 16) & UINT64_C(0x00000000ffffffff);
}

/// Deals the binary digits of s out to two or four coordinates in turn; what is left of those is
/// random.
static void deal(double s, int count, const double jitter[4], double out[4]) {
    uint64_t digits = (uint64_t)(s * 0x1p52);
    uint64_t part[4] = {every_second(digits >> 1), every_second(digits)};
    if (count == 4) {
        part[3] = every_second(part[1]);
        part[1] = every_second(part[1] >> 1);
        part[2] = every_second(part[0]);
        part[0] = every_second(part[0] >> 1);
    }
    double scale = count == 4 ? 0x1p-13 : 0x1p-26;
    for (int i = 0; i < count; i++) {
        out[i] = MIN(((double)part[i] + jitter[i]) * scale, 0x1.fffffffffffffp-1);
    }
}

// Where parallel light along w enters the box, at (a, b) of what is seen of it, moved back a
// little.
static void enter_box(const FrEmitters *emitters, const double w[3], double a, double b,
                      double out[3]) {
    double area = seen_area(emitters, w);
    double diagonal = 0.0;
    int axis = 0;
    for (; axis < 2; axis++) {
        double part = fabs(w[axis]) * face_area(emitters, axis) / area;
        if (a < part) {
            a /= part;
            break;
        }
        a -= part;
    }
    if (axis == 2) {
        a /= fabs(w[2]) * face_area(emitters, 2) / area;
    }
    int next = (axis + 1) % 3, last = (axis + 2) % 3;
    out[axis] = w[axis] > 0.0 ? emitters->min[axis] : emitters->max[axis];
    out[next] = emitters->min[next] + MIN(a, 1.0) * (emitters->max[next] - emitters->min[next]);
    out[last] = emitters->min[last] + b * (emitters->max[last] - emitters->min[last]);
    for (int c = 0; c < 3; c++) {
        diagonal += emitters->max[c] - emitters->min[c];
    }
    for (int c = 0; c < 3; c++) {
        out[c] -= 0.01 * diagonal * w[c];
    }
}

static int sky_cell(const double *ends, double s) {
    int low = 0, high = SKY_CELLS - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (s < ends[middle]) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

// Light from the sky: its cell is chosen by a third coordinate, which is then even within the cell.
static void emit_sky(const FrEmitters *emitters, const Emitter *sky, const double at[4],
                     double origin[3], double direction[3]) {
    int cell = sky_cell(sky->sky_ends, at[2]);
    double begin = cell > 0 ? sky->sky_ends[cell - 1] : 0.0;
    double part = CLAMP((at[2] - begin) / (sky->sky_ends[cell] - begin), 0.0, 1.0);
    double toward[3];
    sky_direction((cell / SKY_TURNS + at[3]) / SKY_HEIGHTS, (cell % SKY_TURNS + part) / SKY_TURNS,
                  toward);
    for (int c = 0; c < 3; c++) {
        direction[c] = -toward[c];
    }
    enter_box(emitters, direction, at[0], at[1], origin);
}

static void emit_from(const FrEmitters *emitters, const Emitter *emitter, double s,
                      const double jitter[4], double origin[3], double direction[3]) {
    const FrLamp *lamp = &emitter->lamp;
    bool is_wide = lamp->kind == FR_LAMP_AREA || lamp->kind == FR_LAMP_SKY;
    double at[4];
    deal(s, is_wide ? 4 : 2, jitter, at);
    for (int c = 0; c < 3; c++) {
        origin[c] = (double)lamp->position.raw[c];
        direction[c] = emitter->w[c];
    }
    switch (lamp->kind) {
    case FR_LAMP_POINT:
        fr_direction_about((const double[3]){0, 0, 1}, 1.0 - 2.0 * at[0], at[1], direction);
        break;
    case FR_LAMP_SPOT:
        fr_direction_about(emitter->w, 1.0 - at[0] * (1.0 - cos((double)lamp->angle)), at[1],
                           direction);
        break;
    case FR_LAMP_AREA:
        for (int c = 0; c < 3; c++) {
            origin[c] +=
                at[0] * (double)lamp->side[0].raw[c] + at[1] * (double)lamp->side[1].raw[c];
        }
        fr_direction_about(emitter->w, sqrt(1.0 - at[2]), at[3], direction);
        break;
    case FR_LAMP_SUN:
        enter_box(emitters, emitter->w, at[0], at[1], origin);
        break;
    case FR_LAMP_SKY:
        emit_sky(emitters, emitter, at, origin, direction);
        break;
    }
}

FrEmission fr_emitters_emit(const FrEmitters *emitters, FrKey key, uint64_t index, uint64_t count) {
    double jitter[4];
    for (uint32_t k = 0; k < 4; k++) {
        jitter[k] = fr_random(key, PURPOSE_EMIT, k);
    }
    double s = ((double)index + fr_random(key, PURPOSE_EMIT, 4)) / (double)count;
    uint32_t l = 0;
    while (l + 1 < emitters->count && s >= emitters->lamps[l + 1].begin) {
        l++;
    }
    // Lamps without power own nothing; rounding may still lead to one at the end.
    while (l > 0 && emitters->lamps[l].power <= 0.0) {
        l--;
    }
    const Emitter *emitter = &emitters->lamps[l];
    double width = emitter->power / emitters->power;
    double origin[3], direction[3];
    emit_from(emitters, emitter, CLAMP((s - emitter->begin) / width, 0.0, 0x1.fffffffffffffp-1),
              jitter, origin, direction);
    FrEmission emission;
    for (int c = 0; c < 3; c++) {
        emission.origin[c] = (float)origin[c];
        emission.direction[c] = (float)direction[c];
    }
    return emission;
}
