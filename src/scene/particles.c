/// Particles in balls and boxes, along strokes of a brush, and far away.
#include "scene/particles.h"

#include <cglm/struct.h>
#include <math.h>

/// A point of the ball of radius 1 (k even draws of a key).
static vec3s in_ball(FrKey key, uint32_t k) {
    double height = fr_random_signed(key, 0, k), around = 2 * G_PI * fr_random(key, 1, k);
    double radius = cbrt(fr_random(key, 2, k)), level = sqrt(1 - height * height);
    return (vec3s){{(float)(radius * level * cos(around)), (float)(radius * level * sin(around)),
                    (float)(radius * height)}};
}

/// Pressure of a stroke at a distance along it.
static double pressure_at(const FrStroke *stroke, double distance) {
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(stroke, &count);
    double reached = 0;
    for (size_t i = 1; i < count; i++) {
        double piece = (double)glms_vec3_distance(points[i - 1].at, points[i].at);
        if (reached + piece >= distance && piece > 0) {
            double part = (distance - reached) / piece;
            return (1 - part) * (double)points[i - 1].pressure + part * (double)points[i].pressure;
        }
        reached += piece;
    }
    return (double)points[count - 1].pressure;
}

static vec3s on_brush(const FrParticlesDef *def, FrKey key, uint32_t k) {
    double distance = fr_random(key, 3, k) * fr_stroke_length(def->along), at[3];
    fr_stroke_at(def->along, distance, at, NULL);
    double radius = def->radius * pressure_at(def->along, distance);
    vec3s off = glms_vec3_scale(in_ball(key, k), (float)radius);
    return glms_vec3_add((vec3s){{(float)at[0], (float)at[1], (float)at[2]}}, off);
}

static FrParticle draw(const FrParticlesDef *def, FrKey key, uint32_t k) {
    FrParticle particle = {.w = 1, .influence = (float)def->influence, .kill = (float)def->kill};
    vec3s half = glms_vec3_scale(def->size, 0.5F);
    switch (def->shape) {
    case FR_PARTICLES_BALL:
        particle.at = glms_vec3_add(def->at, glms_vec3_mul(half, in_ball(key, k)));
        break;
    case FR_PARTICLES_BOX:
        for (uint32_t axis = 0; axis < 3; axis++) {
            particle.at.raw[axis] =
                def->at.raw[axis] + half.raw[axis] * (float)fr_random_signed(key, axis, k);
        }
        break;
    case FR_PARTICLES_BRUSH:
        particle.at = on_brush(def, key, k);
        break;
    default:
        particle.at = glms_vec3_normalize(def->direction);
        particle.w = 0;
        break;
    }
    return particle;
}

FrStatus fr_particles_check(const FrGrowthDef *growth, guint first, const FrContext *context) {
    uint64_t wanted = 0;
    FrStatus status = FR_OK;
    for (guint i = first; i < growth->particles->len && status == FR_OK; i++) {
        const FrParticlesDef *def = g_ptr_array_index(growth->particles, i);
        wanted = fr_count_add(wanted, (uint64_t)def->number);
        status = fr_limit_check(wanted, context->limits.organs, "organs", "the particles",
                                def->span, context->diags);
    }
    return status;
}

FrStatus fr_particles_strewn(const FrGrowthDef *growth, guint first, const FrContext *context,
                             GArray **particles) {
    *particles = g_array_new(FALSE, FALSE, sizeof(FrParticle));
    FrStatus status = fr_particles_check(growth, first, context);
    for (guint i = first; i < growth->particles->len && status == FR_OK; i++) {
        const FrParticlesDef *def = g_ptr_array_index(growth->particles, i);
        FrKey key = fr_key_child(fr_key_root((uint64_t)def->seed), i);
        for (uint32_t k = 0; k < def->number && status == FR_OK; k++) {
            FrParticle particle = draw(def, key, k);
            g_array_append_val(*particles, particle);
            status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
        }
    }
    if (status != FR_OK) {
        g_clear_pointer(particles, g_array_unref);
    }
    return status;
}
