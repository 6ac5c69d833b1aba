// The tables of what stands and shines around plants.
#include "frond/surroundings.h"

#define FR_PARAM_STRUCT FrObstacle
static const FrParam obstacle_rows[] = {FR_OBSTACLE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrTerrain
static const FrParam terrain_rows[] = {FR_TERRAIN_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrLampParams
static const FrParam lamp_rows[] = {FR_LAMP_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrSunParams
static const FrParam sun_rows[] = {FR_SUN_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrLightParams
static const FrParam light_rows[] = {FR_LIGHT_PARAMS(FR_PARAM_ROW) FR_DENSITY_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

#define TABLE(name, struct_type, text)                                                             \
    const FrParamTable *fr_##name##_table(void) {                                                  \
        static const FrParamTable table = {.element = #name,                                       \
                                           .meaning = text,                                        \
                                           .rows = name##_rows,                                    \
                                           .count = G_N_ELEMENTS(name##_rows),                     \
                                           .struct_size = sizeof(struct_type)};                    \
        return &table;                                                                             \
    }

TABLE(obstacle, FrObstacle, "something that stands in the way of plants and light")
TABLE(terrain, FrTerrain, "ground with hills that plants stand on")
TABLE(lamp, FrLampParams, "a lamp; plants and pictures are lit by it")
TABLE(sun, FrSunParams, "where the sun stands, by date, time and place instead of by two angles")
TABLE(light, FrLightParams, "how plants sense the light where they stand")
