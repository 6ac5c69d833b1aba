/// @file strewn.h
/// Points strewn over triangles.
#pragma once

#include "frond/image.h"
#include "frond/mesh_file.h"
#include "frond/random.h"

/// What of a surface is strewn with points.
typedef struct FrStrewnSurface {
    const FrMeshFile *file;
    double least_slope, most_slope; ///< radians between the surface's normal and z
    double least_height, most_height;
    FrImage *map;    ///< owned reference; its brightness is the density; NULL: all alike
    double *below;   ///< area of triangles up to each; owned
    uint32_t *guide; ///< owned: the triangle up to which there is more than k / count of the area
    double area;     ///< of all that are as steep and lie as high as wanted
} FrStrewnSurface;

/// Sums the areas; the rest has been set.
void fr_strewn_init(FrStrewnSurface *surface);
/// Of one allocated by g_new(); NULL is none.
void fr_strewn_free(FrStrewnSurface *surface);

typedef struct FrStrewnPoint {
    double at[3], normal[3];
} FrStrewnPoint;

/// Strews `count` points, each the farthest from those before it among `candidates`. Where hardly
/// anything is between the heights, or the map is dark, some stand outside. The surface has an
/// area. Once `progress` (may be NULL) is cancelled they are left to chance: nobody will see them.
void fr_strew(const FrStrewnSurface *surface, FrStrewnPoint *points, uint32_t count,
              uint32_t candidates, FrKey key, const FrProgress *progress);
