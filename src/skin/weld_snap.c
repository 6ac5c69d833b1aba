// Places on the triangles of a tube.
// Ericson. Real-Time Collision Detection. 2005, 5.1.5: the point of a triangle nearest to another.
#include "skin/weld.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

static vec3s at_of(const FrVertex *vertex) {
    return (vec3s){{vertex->position[0], vertex->position[1], vertex->position[2]}};
}

void fr_weld_grid_init(FrWeldGrid *grid, FrVertex *vertices, uint32_t columns, uint32_t rings) {
    *grid = (FrWeldGrid){.vertices = vertices, .columns = columns, .rings = rings};
    grid->around = vertices[columns - 1].uv[0] - vertices[0].uv[0];
    grid->bands = g_new(FrBox, rings);
    for (uint32_t i = 0; i + 1 < rings; i++) {
        grid->bands[i] = fr_box_empty();
        fr_box_widen(&grid->bands[i], vertices + (size_t)i * columns, 2 * (uint64_t)columns);
    }
}

void fr_weld_grid_clear(FrWeldGrid *grid) {
    g_clear_pointer(&grid->bands, g_free);
}

FrVertex fr_weld_grid_vertex(const FrWeldGrid *grid, int32_t column, uint32_t ring) {
    int32_t sides = (int32_t)grid->columns - 1, turns = column / sides;
    column -= turns * sides;
    if (column < 0) {
        column += sides;
        turns--;
    }
    FrVertex vertex = grid->vertices[(size_t)ring * grid->columns + (size_t)column];
    vertex.uv[0] += (float)turns * grid->around;
    return vertex;
}

// Parts of the second and third corner in the point nearest to `p`.
static void nearest_on(const vec3s corner[3], vec3s p, float *second, float *third) {
    vec3s ab = glms_vec3_sub(corner[1], corner[0]), ac = glms_vec3_sub(corner[2], corner[0]);
    vec3s ap = glms_vec3_sub(p, corner[0]), bp = glms_vec3_sub(p, corner[1]);
    vec3s cp = glms_vec3_sub(p, corner[2]);
    float d1 = glms_vec3_dot(ab, ap), d2 = glms_vec3_dot(ac, ap);
    float d3 = glms_vec3_dot(ab, bp), d4 = glms_vec3_dot(ac, bp);
    float d5 = glms_vec3_dot(ab, cp), d6 = glms_vec3_dot(ac, cp);
    float va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    *second = *third = 0.0F;
    if (d1 <= 0.0F && d2 <= 0.0F) {
        return;
    }
    if (d3 >= 0.0F && d4 <= d3) {
        *second = 1.0F;
    } else if (d6 >= 0.0F && d5 <= d6) {
        *third = 1.0F;
    } else if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) {
        *second = d1 / MAX(d1 - d3, 1e-30F);
    } else if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) {
        *third = d2 / MAX(d2 - d6, 1e-30F);
    } else if (va <= 0.0F && d4 >= d3 && d5 >= d6) {
        *third = (d4 - d3) / MAX(d4 - d3 + d5 - d6, 1e-30F);
        *second = 1.0F - *third;
    } else {
        float sum = MAX(va + vb + vc, 1e-30F);
        *second = vb / sum;
        *third = vc / sum;
    }
}

static FrVertex blend(const FrVertex corner[3], float second, float third) {
    FrVertex out = corner[0];
    float *to = (float *)&out;
    const float *a = (const float *)&corner[0], *b = (const float *)&corner[1];
    const float *c = (const float *)&corner[2];
    for (int k = 0; k < 8; k++) {
        to[k] = a[k] + second * (b[k] - a[k]) + third * (c[k] - a[k]);
    }
    vec3s normal = {{out.normal[0], out.normal[1], out.normal[2]}};
    float length = glms_vec3_norm(normal);
    if (length > 0.0F) {
        memcpy(out.normal, glms_vec3_scale(normal, 1.0F / length).raw, sizeof out.normal);
    }
    return out;
}

static float apart_from(const FrBox *box, const float point[3]) {
    float sum = 0.0F;
    for (int k = 0; k < 3; k++) {
        float out = MAX(MAX(box->min[k] - point[k], point[k] - box->max[k]), 0.0F);
        sum += out * out;
    }
    return sum;
}

typedef struct FrNearest {
    FrWeldFoot foot;
    float apart; ///< squared
} FrNearest;

// Triangle 0 of a quad is below its diagonal, 1 above.
static void try_triangle(const FrWeldGrid *grid, int32_t column, uint32_t ring, int which, vec3s p,
                         FrNearest *nearest) {
    FrVertex corner[3] = {
        fr_weld_grid_vertex(grid, column, ring),
        fr_weld_grid_vertex(grid, column + 1, which == 0 ? ring : ring + 1),
        fr_weld_grid_vertex(grid, column + (which == 0 ? 1 : 0), ring + 1),
    };
    vec3s at[3] = {at_of(&corner[0]), at_of(&corner[1]), at_of(&corner[2])};
    float second, third;
    nearest_on(at, p, &second, &third);
    FrVertex vertex = blend(corner, second, third);
    float apart = glms_vec3_distance2(at_of(&vertex), p);
    if (apart < nearest->apart) {
        float x = which == 0 ? second + third : second, y = which == 0 ? third : second + third;
        nearest->foot = (FrWeldFoot){(float)column + x, (float)ring + y, vertex};
        nearest->apart = apart;
    }
}

FrWeldFoot fr_weld_snap(const FrWeldGrid *grid, const float point[3]) {
    FrNearest nearest = {.apart = INFINITY};
    vec3s p = {{point[0], point[1], point[2]}};
    for (uint32_t ring = 0; ring + 1 < grid->rings; ring++) {
        if (apart_from(&grid->bands[ring], point) >= nearest.apart) {
            continue;
        }
        const FrVertex *low = grid->vertices + (size_t)ring * grid->columns;
        for (uint32_t i = 0; i + 1 < grid->columns; i++) {
            FrBox box = fr_box_empty();
            fr_box_widen(&box, low + i, 2);
            fr_box_widen(&box, low + grid->columns + i, 2);
            if (apart_from(&box, point) < nearest.apart) {
                try_triangle(grid, (int32_t)i, ring, 0, p, &nearest);
                try_triangle(grid, (int32_t)i, ring, 1, p, &nearest);
            }
        }
    }
    return nearest.foot;
}
