// Axes as Catmull-Rom splines through their nodes, in as many straight parts as they bend.
#include "growth/spline.h"

#include <cglm/struct.h>
#include <math.h>

#define BEND_OF_PART (8 * G_PI / 180)

static vec3s tip_of(const FrGrownPlant *plant, uint32_t node) {
    return node == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[node];
}

FrTangents fr_spline_tangents(const FrGrownPlant *plant) {
    const FrGrownNodes *nodes = &plant->nodes;
    FrTangents tangents = {g_new(vec3s, nodes->count + 1), g_new(vec3s, nodes->count + 1)};
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        vec3s along = glms_vec3_sub(nodes->at[i], tip_of(plant, parent));
        tangents.in[i] = tangents.out[i] = along;
        if (parent == FR_NONE || nodes->axis[parent] != nodes->axis[i]) {
            continue;
        }
        vec3s before = glms_vec3_sub(nodes->at[parent], tip_of(plant, nodes->parent[parent]));
        float a = glms_vec3_norm(before), b = glms_vec3_norm(along);
        vec3s mean = glms_vec3_add(glms_vec3_scale(before, 1 / fmaxf(a, 1e-6f)),
                                   glms_vec3_scale(along, 1 / fmaxf(b, 1e-6f)));
        float length = glms_vec3_norm(mean);
        if (length > 1e-3f) {
            mean = glms_vec3_scale(mean, 1 / length);
            tangents.out[parent] = glms_vec3_scale(mean, a);
            tangents.in[i] = glms_vec3_scale(mean, b);
        }
    }
    return tangents;
}

void fr_spline_clear(FrTangents *tangents) {
    g_free(tangents->in);
    g_free(tangents->out);
}

static vec3s hermite(vec3s a, vec3s b, vec3s from, vec3s to, float t) {
    float t2 = t * t, t3 = t2 * t;
    vec3s point = glms_vec3_scale(a, 2 * t3 - 3 * t2 + 1);
    point = glms_vec3_add(point, glms_vec3_scale(from, t3 - 2 * t2 + t));
    point = glms_vec3_add(point, glms_vec3_scale(b, 3 * t2 - 2 * t3));
    return glms_vec3_add(point, glms_vec3_scale(to, t3 - t2));
}

/// How many straight parts an internode needs.
static uint32_t parts_of(const FrSpeciesParams *params, vec3s in, vec3s out) {
    float a = glms_vec3_norm(in), b = glms_vec3_norm(out);
    if (!params->smooth || a <= 0 || b <= 0) {
        return 1;
    }
    float cosine = glms_vec3_dot(in, out) / (a * b);
    double bend = acos((double)CLAMP(cosine, -1, 1));
    return (uint32_t)CLAMP(ceil(bend / BEND_OF_PART), 1, FR_MOST_PARTS);
}

FrInternodeParts fr_spline_parts(const FrGrownPlant *plant, const FrSpeciesParams *params,
                                 const FrTangents *tangents, const float *radii, uint32_t node) {
    const FrGrownNodes *nodes = &plant->nodes;
    uint32_t parent = nodes->parent[node];
    bool is_first = parent == FR_NONE || nodes->axis[parent] != nodes->axis[node];
    vec3s in = tangents->in[node], out = tangents->out[node];
    FrInternodeParts parts = {.count = parts_of(params, in, out)};
    parts.at[0] = tip_of(plant, parent);
    parts.radius[0] = is_first ? radii[node] : radii[parent];
    for (uint32_t part = 1; part <= parts.count; part++) {
        float t = (float)part / (float)parts.count;
        parts.at[part] = part == parts.count ? nodes->at[node]
                                             : hermite(parts.at[0], nodes->at[node], in, out, t);
        parts.radius[part] = parts.radius[0] + (radii[node] - parts.radius[0]) * t;
    }
    return parts;
}
