/// @file lamp_maps.h
/// Shadows of lamps: maps of what the brightest see, side by side in one picture of depths. A cone
/// or an area takes one map, a lamp that shines all around the six of a cube; lamps for which no
/// map is left cast none.
#pragma once

#include "studio/view/store.h"
#include "studio/view/target.h"

enum { STUDIO_LAMP_MAPS = 12 };

typedef struct StudioLampMaps {
    StudioTarget depths;
    uint32_t count, ready; ///< maps in use, and those that are drawn
    mat4s to_map[STUDIO_LAMP_MAPS];
    vec3s eye[STUDIO_LAMP_MAPS];
    uint32_t first[FR_SHADING_LAMPS]; ///< map of a lamp, …
    uint32_t faces[FR_SHADING_LAMPS]; ///< … and how many: 0, 1 or 6
    float wide[FR_SHADING_LAMPS];     ///< size of the lamp, in parts of a map, from a metre away
} StudioLampMaps;

void studio_lamp_maps_clear(StudioLampMaps *maps);
/// Chooses the lamps that cast shadows, the brightest first, in a scene within the box. None of
/// their maps is drawn yet.
void studio_lamp_maps_aim(StudioLampMaps *maps, const FrShading *shading, const double min[3],
                          const double max[3]);
/// What is drawn from then on goes to a map.
void studio_lamp_maps_open(const StudioLampMaps *maps, uint32_t map);
/// Clears that map.
void studio_lamp_maps_begin(const StudioLampMaps *maps, uint32_t map);
/// What a lamp sees there.
StudioOutlook studio_lamp_maps_outlook(const StudioLampMaps *maps, uint32_t map);
/// For a program of surfaces that is in use; without `is_shown` no lamp casts shadows.
void studio_lamp_maps_use(const StudioLampMaps *maps, GLuint program, bool is_shown);
