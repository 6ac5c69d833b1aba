// Writes rings, the bands between them and pointed tips.
//
// For a round section a vertex is an affine function of its column's (x, y, u): eight floats in,
// eight floats out, the same four coefficient vectors for the whole ring.
#include "skin/sweep.h"

#include <cglm/struct.h>

#include <math.h>

static void set_coefficients(float out[8], vec3s position, vec3s normal, float u, float v,
                             FrUpAxis up) {
    fr_put(out, position, up);
    fr_put(out + 3, normal, up);
    out[6] = u;
    out[7] = v;
}

static void write_round(const FrSweep *sweep, const FrRing *ring) {
    float scale = 1.0F / sqrtf(1.0F + ring->slope * ring->slope);
    float base[8], by_x[8], by_y[8];
    set_coefficients(base, ring->at, glms_vec3_scale(ring->tangent, -ring->slope * scale),
                     sweep->bark.u, ring->v, sweep->up);
    set_coefficients(by_x, ring->across, glms_vec3_scale(ring->x, scale), 0, 0, sweep->up);
    set_coefficients(by_y, ring->upwards, glms_vec3_scale(ring->y, scale), 0, 0, sweep->up);
    const float by_u[8] = {0, 0, 0, 0, 0, 0, sweep->bark.around, 0};
    const FrColumn *column = sweep->section->columns;
    float *restrict out = (float *)sweep->vertex;
    for (uint32_t i = 0; i < sweep->section->count; i++, column++, out += 8) {
        float x = column->x, y = column->y, u = column->u;
        for (int k = 0; k < 8; k++) {
            out[k] = base[k] + x * by_x[k] + y * by_y[k] + u * by_u[k];
        }
    }
}

vec3s fr_ring_normal(const FrRing *ring, float x, float y) {
    vec3s normal = glms_vec3_scale(ring->tangent, -ring->slope);
    normal = glms_vec3_muladds(ring->x, x, normal);
    normal = glms_vec3_muladds(ring->y, y / MAX(ring->flatness, 1e-3F), normal);
    float length = glms_vec3_norm(normal);
    return length > 0.0F ? glms_vec3_scale(normal, 1.0F / length) : ring->x;
}

static void write_profile(const FrSweep *sweep, const FrRing *ring) {
    const FrColumn *column = sweep->section->columns;
    FrVertex *out = sweep->vertex;
    for (uint32_t i = 0; i < sweep->section->count; i++, column++, out++) {
        vec3s at = glms_vec3_muladds(ring->across, column->x, ring->at);
        fr_put(out->position, glms_vec3_muladds(ring->upwards, column->y, at), sweep->up);
        fr_put(out->normal, fr_ring_normal(ring, column->normal_x, column->normal_y), sweep->up);
        out->uv[0] = sweep->bark.u + sweep->bark.around * column->u;
        out->uv[1] = ring->v;
    }
}

// Quads between the last two rings written.
static void write_band(FrSweep *sweep) {
    uint32_t columns = sweep->section->count;
    uint32_t b = sweep->count - columns, a = b - columns;
    uint32_t *restrict index = sweep->index;
    for (uint32_t i = 0; i + 1 < columns; i++, index += 6) {
        index[0] = a + i;
        index[1] = a + i + 1;
        index[2] = b + i + 1;
        index[3] = a + i;
        index[4] = b + i + 1;
        index[5] = b + i;
    }
    sweep->index = index;
}

void fr_ring_done(FrSweep *sweep, bool has_band) {
    sweep->vertex += sweep->section->count;
    sweep->count += sweep->section->count;
    if (has_band) {
        write_band(sweep);
    }
}

void fr_write_ring(FrSweep *sweep, const FrRing *ring, bool has_band) {
    if (sweep->finish != NULL) {
        sweep->along += sweep->has_ring ? glms_vec3_distance(ring->at, sweep->ring.at) : 0.0F;
        fr_write_rough(sweep, ring);
    } else if (sweep->section->is_round && ring->flatness == 1.0F) {
        write_round(sweep, ring);
    } else {
        write_profile(sweep, ring);
    }
    fr_ring_done(sweep, has_band);
    sweep->ring = *ring;
    sweep->has_ring = true;
}

// One vertex for every side, so that each keeps its own normal and its own u at the very tip.
void fr_write_apex(FrSweep *sweep, const FrStation *tip, float slope) {
    const FrColumn *column = sweep->section->columns;
    uint32_t sides = sweep->section->count - 1, rim = sweep->count - sweep->section->count;
    FrRing ring = sweep->ring;
    ring.slope = slope;
    for (uint32_t i = 0; i < sides; i++, column++) {
        FrVertex *out = &sweep->vertex[i];
        fr_put(out->position, tip->at, sweep->up);
        float x = column[0].normal_x + column[1].normal_x;
        float y = column[0].normal_y + column[1].normal_y;
        float length = MAX(sqrtf(x * x + y * y), 1e-6F);
        vec3s normal = fr_ring_normal(&ring, x / length, y / length);
        fr_put(out->normal, normal, sweep->up);
        out->uv[0] = sweep->bark.u + sweep->bark.around * 0.5F * (column[0].u + column[1].u);
        out->uv[1] = tip->v;
        *sweep->index++ = rim + i;
        *sweep->index++ = rim + i + 1;
        *sweep->index++ = sweep->count + i;
    }
    sweep->vertex += sides;
    sweep->count += sides;
}
