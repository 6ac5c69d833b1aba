// Ends of tubes. All of it is one surface that goes on from the outer wall: up the wall, over a
// dome, or over the lip and down the inner wall to a floor; so every band is written alike.
#include "skin/cap.h"

#include "frond/noise.h"
#include "skin/sweep.h"

#include <cglm/struct.h>

#include <math.h>

// Broken faces are facets: three triangles a side, none of which shares a vertex.
enum { TRIANGLES_OF_BREAK = 3, KEY_BREAK = 0x627265616b };

static uint32_t dome_rings(const FrPlan *plan) {
    return plan->detail.lod == 0 ? 5 : plan->detail.lod < 3 ? 2 : 1;
}

static bool is_hollow(const FrTube *tube) {
    return tube->end == FR_END_FLAT && tube->wall > 0.0F;
}

// Both ends are open: the inner wall meets the outer one below too.
static bool is_pipe(const FrTube *tube) {
    return is_hollow(tube) && tube->start == FR_START_FREE && tube->is_open;
}

// The outer ring at which the inner wall begins: above the collar.
static uint32_t inner_first(const FrTube *tube) {
    uint32_t collar = tube->start == FR_START_BRANCH ? tube->collar_rings : 0;
    return tube->has_join || collar == 0 ? collar : collar - 1;
}

// ---- counting ----------------------------------------------------------------------------------

static void count(FrTube *tube, uint64_t vertices, uint64_t triangles) {
    tube->vertices += vertices;
    tube->indices += 3 * triangles;
}

static void count_disc(FrTube *tube, uint64_t sides) {
    // Rough rings are closed around their centre.
    count(tube, sides + (tube->is_rough ? 1U : 0U), tube->is_rough ? sides : sides - 2);
}

static void count_inside(FrTube *tube, uint64_t columns, uint64_t sides) {
    uint64_t rings = tube->rings + tube->wall_rings - inner_first(tube);
    count(tube, 2 * columns, 2 * sides);
    count(tube, rings * columns, (rings - 1) * 2 * sides);
    if (is_pipe(tube)) {
        count(tube, 2 * columns, 2 * sides);
    } else {
        count(tube, sides + 1, sides);
    }
}

void fr_count_ends(const FrPlan *plan, FrTube *tube) {
    uint64_t columns = plan->sections[tube->section].count, sides = columns - 1;
    uint64_t before = tube->indices;
    if (tube->start == FR_START_FREE && !tube->is_open) {
        count_disc(tube, sides);
    }
    uint64_t base = tube->indices - before; // written last
    tube->wall_rings = 0;
    tube->face_indices = 0;
    if (tube->end != FR_END_FLAT) {
        return;
    }
    bool is_broken = tube->cap == FR_CAP_BROKEN;
    tube->wall_rings = tube->cap == FR_CAP_ROUND ? dome_rings(plan) : is_broken ? 1 : 0;
    count(tube, tube->wall_rings * columns, tube->wall_rings * 2 * sides);
    tube->face_index = tube->indices - base;
    if (tube->cap == FR_CAP_ROUND) {
        count(tube, sides, sides);
    } else if (is_hollow(tube)) {
        count_inside(tube, columns, sides);
    } else if (is_broken) {
        count(tube, 3 * TRIANGLES_OF_BREAK * sides, TRIANGLES_OF_BREAK * sides);
    } else if (tube->cap == FR_CAP_FLAT) {
        count_disc(tube, sides);
    }
    if (tube->face > 0 && tube->cap != FR_CAP_ROUND) {
        tube->face_indices = tube->indices - base - tube->face_index;
    }
}

// ---- discs -------------------------------------------------------------------------------------

static void put_flat(const FrSweep *sweep, FrVertex *out, const float at[3], vec3s normal,
                     const FrRing *ring, float x, float y) {
    const float *tile = sweep->plan->tiles[sweep->tube->slot];
    float radius = glms_vec3_norm(ring->across);
    memcpy(out->position, at, sizeof out->position);
    fr_put(out->normal, normal, sweep->up);
    out->uv[0] = sweep->bark.u + x * radius / tile[0];
    out->uv[1] = ring->v - y * radius / tile[1];
}

// Closes a ring whose vertices begin at `rim`: `facing` 1 towards the tip, −1 towards the base.
static void write_disc(FrSweep *sweep, const FrRing *ring, const FrVertex *rim, float facing) {
    const FrSection *section = sweep->section;
    uint32_t points = section->count - 1;
    bool is_front = facing > 0.0F;
    vec3s normal = glms_vec3_scale(ring->tangent, facing);
    for (uint32_t i = 0; i < points; i++) {
        put_flat(sweep, &sweep->vertex[i], rim[i].position, normal, ring, section->columns[i].x,
                 section->columns[i].y);
    }
    if (sweep->tube->is_rough) {
        float centre[3];
        fr_put(centre, ring->at, sweep->up);
        put_flat(sweep, &sweep->vertex[points], centre, normal, ring, 0.0F, 0.0F);
        for (uint32_t i = 0; i < points; i++) {
            uint32_t next = (i + 1) % points;
            *sweep->index++ = sweep->count + points;
            *sweep->index++ = sweep->count + (is_front ? i : next);
            *sweep->index++ = sweep->count + (is_front ? next : i);
        }
    }
    for (uint32_t i = 0; i < 3 * (points - 2) && !sweep->tube->is_rough; i += 3) {
        *sweep->index++ = sweep->count + section->cap[i];
        *sweep->index++ = sweep->count + section->cap[i + (is_front ? 1 : 2)];
        *sweep->index++ = sweep->count + section->cap[i + (is_front ? 2 : 1)];
    }
    uint32_t written = points + (sweep->tube->is_rough ? 1 : 0);
    sweep->vertex += written;
    sweep->count += written;
}

// ---- domes -------------------------------------------------------------------------------------

// Half an ellipsoid: r = R cos a, z = h R sin a.
static void write_dome(FrSweep *sweep) {
    const FrRing rim = sweep->ring;
    uint32_t rings = sweep->tube->wall_rings;
    float radius = glms_vec3_norm(rim.across), height = sweep->tube->cap_height * radius;
    FrStation tip = {.at = glms_vec3_muladds(rim.tangent, height, rim.at), .v = rim.v};
    float before = radius, v = rim.v;
    for (uint32_t k = 1; k <= rings + 1; k++) {
        float angle = 0.5F * (float)G_PI * (float)k / (float)(rings + 1);
        float thin = cosf(angle), at = sinf(angle) * height;
        float step = 0.5F * (float)G_PI * MAX(height, radius) / (float)(rings + 1);
        v -= fr_bark_along(&sweep->bark, step, before, radius * thin);
        before = radius * thin;
        if (k > rings) {
            tip.v = v;
            break;
        }
        FrRing ring = rim;
        ring.at = glms_vec3_muladds(rim.tangent, at, rim.at);
        ring.across = glms_vec3_scale(rim.across, thin);
        ring.upwards = glms_vec3_scale(rim.upwards, thin);
        ring.slope = -MIN(tanf(angle) / sweep->tube->cap_height, 8.0F);
        ring.v = v;
        fr_write_ring(sweep, &ring, true);
    }
    fr_write_apex(sweep, &tip, -8.0F);
}

// ---- breaks ------------------------------------------------------------------------------------

// How high wood stands above a break, 0 to 1, where the rim has the direction (x, y): long
// splinters on one side, short ones between.
static float splinter(FrKey key, float x, float y) {
    double slant = fr_noise2(key, 0.9 * (double)x, 0.9 * (double)y);
    double coarse = fr_noise2(fr_key_child(key, 1), 3.1 * (double)x, 3.1 * (double)y);
    double fine = fr_noise2(fr_key_child(key, 2), 9.7 * (double)x, 9.7 * (double)y);
    return (float)CLAMP(0.4 + 0.6 * slant + 0.45 * coarse + 0.3 * fine, 0.03, 1.0);
}

static FrKey break_key(const FrSweep *sweep) {
    return fr_key_child(sweep->plan->plant->axes.path[sweep->tube->axis], KEY_BREAK);
}

// A ring of the wall that ends in splinters.
static void write_splinters(FrSweep *sweep) {
    const FrRing *ring = &sweep->ring;
    uint32_t columns = sweep->section->count;
    const FrVertex *rim = sweep->vertex - columns;
    float height = sweep->tube->cap_height * glms_vec3_norm(ring->across);
    float per_metre = sweep->bark.rate / MAX(glms_vec3_norm(ring->across), sweep->bark.thinnest);
    vec3s up = fr_upright(ring->tangent, sweep->up);
    FrKey key = break_key(sweep);
    for (uint32_t i = 0; i < columns; i++) {
        const FrColumn *column = &sweep->section->columns[i];
        float high = height * splinter(key, column->x, column->y);
        FrVertex *out = &sweep->vertex[i];
        *out = rim[i];
        for (int k = 0; k < 3; k++) {
            out->position[k] += high * up.raw[k];
        }
        out->uv[1] -= per_metre * high;
    }
    fr_ring_done(sweep, true);
}

static void write_facet(FrSweep *sweep, const FrRing *ring, const vec3s corner[3],
                        const float (*flat)[2]) {
    vec3s normal =
        glms_vec3_cross(glms_vec3_sub(corner[1], corner[0]), glms_vec3_sub(corner[2], corner[0]));
    float length = glms_vec3_norm(normal);
    for (int k = 0; k < 3; k++) {
        FrVertex *out = &sweep->vertex[k];
        put_flat(sweep, out, corner[k].raw, ring->tangent, ring, flat[k][0], flat[k][1]);
        if (length > 0.0F) {
            memcpy(out->normal, glms_vec3_scale(normal, 1.0F / length).raw, sizeof out->normal);
        }
        *sweep->index++ = sweep->count++;
    }
    sweep->vertex += 3;
}

// The face of a break: from the splinters of the rim to a ring of shorter ones to the middle.
static void write_break(FrSweep *sweep) {
    const FrRing *ring = &sweep->ring;
    uint32_t columns = sweep->section->count;
    const FrVertex *top = sweep->vertex - columns, *low = top - columns;
    float height = sweep->tube->cap_height * glms_vec3_norm(ring->across);
    vec3s up = fr_upright(ring->tangent, sweep->up), middle = fr_upright(ring->at, sweep->up);
    vec3s centre = glms_vec3_muladds(up, 0.25F * height, middle);
    FrKey key = fr_key_child(break_key(sweep), 3);
    vec3s outer[2], inner[2];
    for (uint32_t i = 0; i < columns; i++) {
        const FrColumn *c = &sweep->section->columns[i];
        outer[1] = (vec3s){{top[i].position[0], top[i].position[1], top[i].position[2]}};
        inner[1] = (vec3s){{low[i].position[0], low[i].position[1], low[i].position[2]}};
        inner[1] = glms_vec3_lerp(middle, inner[1], 0.55F);
        inner[1] = glms_vec3_muladds(up, 0.75F * height * splinter(key, c->x, c->y), inner[1]);
        if (i > 0) {
            const float flat[4][2] = {{c[-1].x, c[-1].y},
                                      {c->x, c->y},
                                      {0.55F * c[-1].x, 0.55F * c[-1].y},
                                      {0.55F * c->x, 0.55F * c->y}};
            const float middle_flat[3][2] = {
                {0, 0}, {flat[2][0], flat[2][1]}, {flat[3][0], flat[3][1]}};
            const float a[3][2] = {
                {flat[0][0], flat[0][1]}, {flat[1][0], flat[1][1]}, {flat[3][0], flat[3][1]}};
            const float b[3][2] = {
                {flat[0][0], flat[0][1]}, {flat[3][0], flat[3][1]}, {flat[2][0], flat[2][1]}};
            write_facet(sweep, ring, (vec3s[]){outer[0], outer[1], inner[1]}, a);
            write_facet(sweep, ring, (vec3s[]){outer[0], inner[1], inner[0]}, b);
            write_facet(sweep, ring, (vec3s[]){centre, inner[0], inner[1]}, middle_flat);
        }
        outer[0] = outer[1];
        inner[0] = inner[1];
    }
}

// ---- the inside --------------------------------------------------------------------------------

// A ring of the outer wall, as it was written.
static const FrVertex *outer_ring(const FrSweep *sweep, uint32_t ring) {
    const FrVertex *begin = sweep->vertex - (sweep->count - sweep->tube->first_vertex);
    return begin + (size_t)ring * sweep->section->count;
}

static vec3s middle_of(const FrVertex *ring, uint32_t points) {
    vec3s sum = {{0, 0, 0}};
    for (uint32_t i = 0; i < points; i++) {
        sum = glms_vec3_add(
            sum, (vec3s){{ring[i].position[0], ring[i].position[1], ring[i].position[2]}});
    }
    return glms_vec3_scale(sum, 1.0F / (float)points);
}

// Writes outer ring `ring` moved inwards by `part` of its radius. `normal` NULL: facing inwards.
static void write_inner(FrSweep *sweep, uint32_t ring, float part, const vec3s *normal,
                        bool has_band) {
    uint32_t columns = sweep->section->count;
    const FrVertex *from = outer_ring(sweep, ring);
    vec3s middle = middle_of(from, columns - 1);
    for (uint32_t i = 0; i < columns; i++) {
        FrVertex *out = &sweep->vertex[i];
        *out = from[i];
        for (int k = 0; k < 3; k++) {
            out->position[k] += part * (middle.raw[k] - from[i].position[k]);
            out->normal[k] = normal != NULL ? normal->raw[k] : -from[i].normal[k];
        }
    }
    fr_ring_done(sweep, has_band);
}

static void write_floor(FrSweep *sweep, vec3s up) {
    uint32_t points = sweep->section->count - 1;
    const FrVertex *rim = sweep->vertex - sweep->section->count;
    vec3s middle = middle_of(rim, points);
    for (uint32_t i = 0; i < points; i++) {
        sweep->vertex[i] = rim[i];
        *sweep->index++ = sweep->count + points;
        *sweep->index++ = sweep->count + i;
        *sweep->index++ = sweep->count + (i + 1) % points;
    }
    sweep->vertex[points] = rim[0];
    memcpy(sweep->vertex[points].position, middle.raw, sizeof middle.raw);
    for (uint32_t i = 0; i <= points; i++) {
        memcpy(sweep->vertex[i].normal, up.raw, sizeof up.raw);
    }
    sweep->vertex += points + 1;
    sweep->count += points + 1;
}

// From the lip down to the floor, or out of the other end.
static void write_inside(FrSweep *sweep) {
    const FrTube *tube = sweep->tube;
    uint32_t top = tube->rings + tube->wall_rings - 1, first = inner_first(tube);
    uint32_t points = sweep->section->count - 1;
    float wall = MIN(tube->wall, 0.999F);
    vec3s up = fr_upright(sweep->ring.tangent, sweep->up);
    write_inner(sweep, top, 0.0F, &up, false);
    write_inner(sweep, top, wall, &up, true);
    for (uint32_t ring = top + 1; ring-- > first;) {
        write_inner(sweep, ring, wall, NULL, ring < top);
    }
    vec3s low = middle_of(outer_ring(sweep, first), points);
    vec3s high = middle_of(outer_ring(sweep, first + 1), points);
    vec3s along = glms_vec3_normalize(glms_vec3_sub(high, low));
    if (is_pipe(tube)) {
        vec3s down = glms_vec3_negate(along);
        write_inner(sweep, first, wall, &down, false);
        write_inner(sweep, first, 0.0F, &down, true);
    } else {
        write_floor(sweep, along);
    }
}

void fr_write_ends(FrSweep *sweep, const FrRing *first) {
    const FrTube *tube = sweep->tube;
    if (!sweep->plan->detail.caps || !sweep->section->is_closed) {
        return;
    }
    FrRing last = sweep->ring;
    if (tube->end == FR_END_FLAT && tube->cap == FR_CAP_ROUND) {
        write_dome(sweep);
    } else if (tube->end == FR_END_FLAT) {
        const FrVertex *rim = sweep->vertex - sweep->section->count;
        if (tube->cap == FR_CAP_BROKEN) {
            write_splinters(sweep);
        }
        if (is_hollow(tube)) {
            write_inside(sweep);
        } else if (tube->cap == FR_CAP_BROKEN) {
            write_break(sweep);
        } else if (tube->cap == FR_CAP_FLAT) {
            write_disc(sweep, &last, rim, 1.0F);
        }
    }
    if (tube->start == FR_START_FREE && !tube->is_open) {
        write_disc(sweep, first, outer_ring(sweep, 0), -1.0F);
    }
}
