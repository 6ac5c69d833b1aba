// A grid of directions to the light, interpolated along its three axes.
#include "frond/light_field.h"

#include <cglm/struct.h>
#include <math.h>

static vec3s turned(vec3s v, double angle) {
    return glms_vec3_rotate(v, (float)angle, (vec3s){{0, 0, 1}});
}

static vec3s grid_point(const FrLightField *field, size_t index) {
    size_t x = index % field->count[0], rest = index / field->count[0];
    size_t y = rest % field->count[1], z = rest / field->count[1];
    return (vec3s){{field->origin.x + field->cell * (float)x,
                    field->origin.y + field->cell * (float)y,
                    field->origin.z + field->cell * (float)z}};
}

FrStatus fr_light_field_new(FrLight *light, const FrLightPlace *place, vec3s min, vec3s max,
                            uint32_t cells, const FrContext *context, FrLightField **field) {
    FR_ASSERT(cells >= 1 && cells <= 256);
    *field = NULL;
    vec3s size = glms_vec3_maxv(glms_vec3_sub(max, min), glms_vec3_zero());
    float longest = fmaxf(fmaxf(size.x, size.y), fmaxf(size.z, 1e-3f));
    FrLightField *made = g_new0(FrLightField, 1);
    made->origin = min;
    made->cell = longest / (float)cells;
    size_t count = 1;
    for (int axis = 0; axis < 3; axis++) {
        made->count[axis] = (uint32_t)fminf(ceilf(size.raw[axis] / made->cell), 256) + 1;
        made->count[axis] = MAX(made->count[axis], 2);
        count *= made->count[axis];
    }
    vec3s *points = g_new(vec3s, count);
    FrLightAnswer *answers = g_new(FrLightAnswer, count);
    vec3s at = {{(float)place->at[0], (float)place->at[1], (float)place->at[2]}};
    for (size_t i = 0; i < count; i++) {
        vec3s local = glms_vec3_scale(grid_point(made, i), (float)place->scale);
        points[i] = glms_vec3_add(turned(local, place->turn), at);
    }
    FrStatus status = fr_light_query(light, points, count, context, answers);
    made->towards = g_new(vec3s, count);
    for (size_t i = 0; i < count && status == FR_OK; i++) {
        made->towards[i] = turned(answers[i].direction, -place->turn);
    }
    g_free(points);
    g_free(answers);
    if (status != FR_OK) {
        fr_light_field_free(made);
        return status;
    }
    *field = made;
    return FR_OK;
}

void fr_light_field_free(FrLightField *field) {
    if (field != NULL) {
        g_free(field->towards);
        g_free(field);
    }
}

vec3s fr_light_field_at(const FrLightField *field, vec3s at) {
    size_t low[3];
    float part[3];
    for (int axis = 0; axis < 3; axis++) {
        float last = (float)(field->count[axis] - 1);
        float place = (at.raw[axis] - field->origin.raw[axis]) / field->cell;
        place = fminf(fmaxf(place, 0), last); // what is no number goes to the lowest
        low[axis] = (size_t)fminf(place, last - 1);
        part[axis] = place - (float)low[axis];
    }
    vec3s sum = glms_vec3_zero();
    for (int corner = 0; corner < 8; corner++) {
        size_t x = corner & 1, y = corner >> 1 & 1, z = (size_t)corner >> 2;
        float weight =
            (x ? part[0] : 1 - part[0]) * (y ? part[1] : 1 - part[1]) * (z ? part[2] : 1 - part[2]);
        size_t index = ((low[2] + z) * field->count[1] + low[1] + y) * field->count[0] + low[0] + x;
        sum = glms_vec3_muladds(field->towards[index], weight, sum);
    }
    return sum;
}
