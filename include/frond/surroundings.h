/// @file surroundings.h
/// What plants of a document stand among: obstacles, lamps, the sun by date, and how plants sense
/// the light.
#pragma once

#include "frond/image.h"
#include "frond/light_density.h"
#include "frond/material.h"
#include "frond/mesh_file.h"
#include "frond/param.h"
#include "frond/variation.h"

/// An `<obstacle>`: something that stands in the way of light.
#define FR_OBSTACLE_PARAMS(X)                                                                      \
    X(TEXT, id, "", 0, 0, "", "", "its name, for --set; need not have one")                        \
    X(CHOICE, shape, "box", 0, 0, "", "box sphere cylinder cone square circle mesh sweep",         \
      "its form; square and circle are flat and stand, facing y; a mesh is read from `file`; a "   \
      "sweep is drawn along the points x,y,z of its text")                                         \
    X(VECTOR, at, "0, 0, 0", -1000000, 1000000, "m", "", "the middle of its base")                 \
    X(VECTOR, size, "1, 1, 1", 0.0001, 1000000, "m", "",                                           \
      "extent along x, y and z; of a mesh the factors of its own size; of a sweep its width, "     \
      "nothing, and its height over its line")                                                     \
    X(TEXT, file, "", 0, 0, "", "",                                                                \
      "file of triangles or surfaces for shape=mesh: .obj .gltf .glb with y up, others with z up") \
    X(REAL, tilt, "0", -360, 360, "deg", "", "turned about the x axis first …")                    \
    X(REAL, turn, "0", -360000, 360000, "deg", "", "… and then about the vertical")                \
    X(TEXT, material, "", 0, 0, "", "", "id of its material; empty: grey")                         \
    X(CHOICE, section, "round", 0, 0, "", "round square", "of a sweep")                            \
    X(CHOICE, line, "straight", 0, 0, "", "straight smooth",                                       \
      "a sweep goes from point to point, or on a curve through them")                              \
    X(SWITCH, visible, "yes", 0, 1, "", "",                                                        \
      "no: only keeps growing plants out; gives no shade and is in no model or picture")

/// A `<terrain>`: what plants stand on.
#define FR_TERRAIN_PARAMS(X)                                                                       \
    X(TEXT, file, "", 0, 0, "", "",                                                                \
      "a height map (.png, its top towards +y, white is high) or a mesh (.obj .gltf .glb with y "  \
      "up, .stl "                                                                                  \
      ".igs with z up)")                                                                           \
    X(VECTOR, at, "0, 0, 0", -1000000, 1000000, "m", "",                                           \
      "the middle of a height map's base, or the origin of a mesh")                                \
    X(VECTOR, size, "1, 1, 1", 0.0001, 1000000, "m", "",                                           \
      "extent of a height map along x, y and z; of a mesh the factors of its own size")            \
    X(REAL, turn, "0", -360000, 360000, "deg", "", "turned about the vertical")                    \
    X(INTEGER, points, "257", 2, 4097, "", "", "of the longer side of a height map at most")       \
    X(TEXT, material, "", 0, 0, "", "", "id of its material; empty: earth")

/// A `<lamp>`.
#define FR_LAMP_PARAMS(X)                                                                          \
    X(TEXT, id, "", 0, 0, "", "", "its name, for --set; need not have one")                        \
    X(CHOICE, kind, "point", 0, 0, "", "point spot area",                                          \
      "shines all around, in a cone, or from a rectangle")                                         \
    X(VECTOR, at, "0, 0, 2", -1000000, 1000000, "m", "", "where it hangs: its middle")             \
    X(REAL, power, "20", 0, 1000000, "W", "", "all the light it gives")                            \
    X(COLOUR, colour, "#fff1dc", 0, 1, "", "", "colour of its light")                              \
    X(VECTOR, direction, "0, 0, -1", -1000, 1000, "", "", "where a spot or an area shines")        \
    X(REAL, angle, "40", 0.1, 180, "deg", "", "half the opening of a spot's cone")                 \
    X(REAL, width, "0.5", 0.0001, 1000, "m", "", "of an area")                                     \
    X(REAL, height, "0.5", 0.0001, 1000, "m", "", "of an area")                                    \
    X(REAL, turn, "0", -360000, 360000, "deg", "", "an area turned about its direction")           \
    X(REAL, radius, "0.03", 0.0001, 100, "m", "", "of the ball that a point or a spot is seen as")

/// A `<sun>`: where it stands by date, time and place.
#define FR_SUN_PARAMS(X)                                                                           \
    X(TEXT, date, "2025-06-21", 0, 0, "", "", "year-month-day")                                    \
    X(REAL, time, "12", 0, 24, "h", "", "by the clock")                                            \
    X(REAL, zone, "0", -14, 14, "h", "", "of the clock before universal time")                     \
    X(REAL, latitude, "48", -90, 90, "deg", "", "to the north")                                    \
    X(REAL, longitude, "0", -180, 180, "deg", "", "to the east")

/// A `<light>`: how plants sense the light.
#define FR_LIGHT_PARAMS(X)                                                                         \
    X(CHOICE, by, "views", 0, 0, "", "views density shadows",                                      \
      "looking at sun, sky and lamps; the density of rays, with light from walls; or shadows in "  \
      "voxels")                                                                                    \
    X(INTEGER, views, "20", 1, 4096, "", "", "directions that are looked into")                    \
    X(SWITCH, even, "no", 0, 1, "", "", "all views count the same, not by their light")            \
    X(CHOICE, towards, "brightest", 0, 0, "", "brightest mean",                                    \
      "the direction of the light is the brightest spot or the mean of all that is seen")          \
    X(REAL, near, "0.02", 0, 1000, "m", "", "what is nearer to a place does not shade it")         \
    X(INTEGER, suns, "8", 1, 1000, "", "", "places of the sun on its path over the day")           \
    X(REAL, cell, "0.2", 0.001, 1000, "m", "", "width of the shadows' voxels")                     \
    X(SWITCH, relative, "no", 0, 1, "", "", "light is told as a part of that at `reference`")      \
    X(VECTOR, reference, "0, 0, 0", -1000000, 1000000, "m", "", "a place in full light")

enum { FR_LIGHT_BY_VIEWS, FR_LIGHT_BY_DENSITY, FR_LIGHT_BY_SHADOWS };
enum { FR_LIGHT_TOWARDS_BRIGHTEST, FR_LIGHT_TOWARDS_MEAN };

enum { FR_OBSTACLE_MESH = 6, FR_OBSTACLE_SWEEP };
enum { FR_SECTION_ROUND, FR_SECTION_SQUARE };
enum { FR_LINE_STRAIGHT, FR_LINE_SMOOTH };

typedef struct FrObstacle {
    FR_OBSTACLE_PARAMS(FR_PARAM_FIELD)
    FrMaterial *made_of; ///< borrowed from the document; NULL: grey, or what the file says
    FrMeshFile *mesh;    ///< of FR_OBSTACLE_MESH, owned; else NULL
    FrStroke *along;     ///< of FR_OBSTACLE_SWEEP, owned; else NULL
    FrSpan span;
} FrObstacle;
typedef struct FrTerrain {
    FR_TERRAIN_PARAMS(FR_PARAM_FIELD)
    FrMaterial *made_of;  ///< borrowed from the document; NULL: earth, or what the file says
    FrMeshFile *mesh;     ///< of a file of triangles, owned; else NULL
    FrHeightMap *heights; ///< of a picture, owned; else NULL
    FrSpan span;
} FrTerrain;
typedef struct FrLampParams {
    FR_LAMP_PARAMS(FR_PARAM_FIELD)
    FrSpan span;
} FrLampParams;
typedef struct FrSunParams {
    FR_SUN_PARAMS(FR_PARAM_FIELD)
} FrSunParams;
typedef struct FrLightParams {
    FR_LIGHT_PARAMS(FR_PARAM_FIELD)
    FR_DENSITY_PARAMS(FR_PARAM_FIELD)
    bool is_given; ///< the document has a `<light>`
    FrSpan span;
    FrSpan photons_place, reference_place; ///< of those attributes, else as `span`
} FrLightParams;

FR_API const FrParamTable *fr_obstacle_table(void);
FR_API const FrParamTable *fr_terrain_table(void);
FR_API const FrParamTable *fr_lamp_table(void);
FR_API const FrParamTable *fr_sun_table(void);
FR_API const FrParamTable *fr_light_table(void);
/// Where the sun stands by date, time and place, in radians as fr_light_sun() has them. False if
/// the date is none.
FR_API bool fr_sun_where(const FrSunParams *sun, double *azimuth, double *elevation);

/// What stands around the plants of a document.
typedef struct FrSurroundings {
    GPtrArray *obstacles; ///< FrObstacle *
    FrTerrain *terrain;   ///< NULL: level ground
    GPtrArray *lamps;     ///< FrLampParams *
    FrSunParams sun;
    FrLightParams light;
} FrSurroundings;
