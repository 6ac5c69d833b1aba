/// @file light_marks.h
/// Light as marks of an overlay: rays, cells, slices and points in the false colours of
/// fr_light_scale_paint().
#pragma once

#include "frond/render.h"
#include "studio/model/overlay.h"

/// A slice across an axis through the box around a scene, as a grid of samples.
typedef struct StudioSlice {
    int across, up, depth; ///< axes of the grid, and the one it lies across
    double at;             ///< m, along `depth`
    double corner[2];      ///< m, of the first sample along `across` and `up`
    double cell;           ///< m, between two samples
    uint32_t columns, rows;
} StudioSlice;

/// `part` of the way through the box, 0 to 1.
StudioSlice studio_slice_of(const FrScene *scene, int axis, double part);
/// Where light is asked for (vec3s), row by row.
GArray *studio_slice_places(const StudioSlice *slice);
/// `top` receives what the brightest colour stands for.
StudioOverlay *studio_slice_marks(const FrScene *scene, const StudioSlice *slice,
                                  const GArray *places, const FrLightAnswer *answers, double *top);
StudioOverlay *studio_light_points(const FrScene *scene, const FrLightPlaces *places,
                                   const FrLightAnswer *answers, double *top);
/// FrLightRay: yellow from the lamp, redder with every bounce.
StudioOverlay *studio_ray_marks(const GArray *rays);
/// FrLightCell: brighter where more rays pass through, for its size.
StudioOverlay *studio_cell_marks(const GArray *cells);
/// The colour of a part of the scale.
void studio_light_colour(float part, float opaque, float colour[4]);
