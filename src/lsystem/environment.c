// A simple environment: light from one direction, an obstacle, heights.
//
// R(roll, pitch) becomes \(roll) &(pitch) /(roll) (van Haevre et al. 2004): up is rolled to the
// side where the light is, then the heading is pitched towards it.
#include "frond/lsystem.h"

#include <cglm/struct.h>

#include <math.h>

FrLsimple fr_lsimple_default(void) {
    return (FrLsimple){.intensity = 1, .light = {{0, 0, 1}}, .shade = 1};
}

static float intensity_at(const FrLsimple *simple, vec3s position) {
    return position.z < simple->shade_height ? simple->intensity * simple->shade
                                             : simple->intensity;
}

static float distance_to(const FrLsimple *simple, vec3s position) {
    return simple->obstacle_radius > 0
               ? glms_vec3_distance(position, simple->obstacle) - simple->obstacle_radius
               : 1e6F;
}

void fr_lquery_bend(const FrLquery *query, vec3s light) {
    float ahead = glms_vec3_dot(light, query->heading);
    float up = glms_vec3_dot(light, query->up);
    float left = glms_vec3_dot(light, query->left);
    float side = hypotf(up, left);
    float roll = side > 1e-6F ? atan2f(left, up) : 0, pitch = side > 1e-6F ? atan2f(side, ahead)
                                                              : ahead < 0  ? GLM_PIf
                                                                           : 0;
    float most = query->count > 1 && (query->asked & 2) == 0 ? query->parameters[1] : 180;
    query->parameters[0] = glm_deg(roll);
    if (query->count > 1) {
        query->parameters[1] = fminf(glm_deg(pitch), fmaxf(most, 0));
    }
}

static FrStatus answer(void *data, const FrLquery *queries, size_t count,
                       const FrContext *context) {
    (void)context;
    const FrLsimple *simple = data;
    for (size_t i = 0; i < count; i++) {
        const FrLquery *query = &queries[i];
        if (query->count == 0) {
            continue;
        }
        switch (query->symbol) {
        case 'R':
            fr_lquery_bend(query, simple->light);
            break;
        case 'D':
            query->parameters[0] = distance_to(simple, query->position);
            break;
        case 'Y':
            query->parameters[0] = query->position.z;
            break;
        default:
            query->parameters[0] = intensity_at(simple, query->position);
            break;
        }
    }
    return FR_OK;
}

FrEnvironment fr_lsimple_environment(FrLsimple *simple) {
    return (FrEnvironment){simple, answer};
}
