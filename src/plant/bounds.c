// The size of a plant's skeleton: the smallest box around it, how many internodes it has.
#include "frond/plant.h"

#include <math.h>

uint32_t fr_plant_internodes(const FrPlant *plant) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        count += (plant->nodes.flags[i] & FR_PART) == 0;
    }
    return count;
}

void fr_plant_bounds(const FrPlant *plant, vec3s *min, vec3s *max) {
    const uint16_t unseen = FR_SHED | FR_HIDDEN;
    const FrNodes *nodes = &plant->nodes;
    float low[3] = {INFINITY, INFINITY, INFINITY};
    float high[3] = {-INFINITY, -INFINITY, -INFINITY};
#define FR_WIDEN(point)                                                                            \
    for (int k = 0; k < 3; k++) {                                                                  \
        low[k] = (point).raw[k] < low[k] ? (point).raw[k] : low[k];                                \
        high[k] = (point).raw[k] > high[k] ? (point).raw[k] : high[k];                             \
    }
    for (uint32_t i = 0; i < nodes->count; i++) {
        if ((nodes->flags[i] & unseen) == 0 && (plant->axes.flags[nodes->axis[i]] & unseen) == 0) {
            FR_WIDEN(nodes->position[i]);
        }
    }
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if ((plant->axes.flags[a] & unseen) == 0) {
            vec3s origin = fr_plant_axis_origin(plant, a);
            FR_WIDEN(origin);
        }
    }
    for (uint32_t o = 0; o < plant->organs.count; o++) {
        if ((plant->organs.flags[o] & unseen) == 0) {
            vec3s position;
            versors rotation;
            fr_plant_organ_pose(plant, o, &position, &rotation);
            FR_WIDEN(position);
        }
    }
#undef FR_WIDEN
    *min = (vec3s){{low[0], low[1], low[2]}};
    *max = (vec3s){{high[0], high[1], high[2]}};
}
