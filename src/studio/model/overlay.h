/// @file overlay.h
/// Lines, points and translucent triangles that are drawn over the picture: handles, rays, cells,
/// paths. Made without a display; studio_viewport_set_overlay() shows them.
#pragma once

#include "frond/api.h"

#include <glib.h>

/// A point of an overlay, in the scene's coordinates.
typedef struct StudioMark {
    float at[3];
    float size;      ///< pixels at a scale of 1: how wide a line is, how large a point
    float colour[4]; ///< red, green, blue as a screen shows them, and how opaque
} StudioMark;

typedef struct StudioOverlay {
    GArray *triangles; ///< StudioMark, in threes; drawn first
    GArray *lines;     ///< StudioMark, in pairs
    GArray *points;    ///< StudioMark; drawn last
    float through;     ///< how much is seen of what plants hide, 0 to 1
} StudioOverlay;

/// An empty one of which a quarter shines through what hides it.
StudioOverlay *studio_overlay_new(void);
void studio_overlay_free(StudioOverlay *overlay);
void studio_overlay_point(StudioOverlay *overlay, const double at[3], double size,
                          const float colour[4]);
void studio_overlay_line(StudioOverlay *overlay, const double from[3], const double to[3],
                         double width, const float colour[4]);
void studio_overlay_triangle(StudioOverlay *overlay, const double a[3], const double b[3],
                             const double c[3], const float colour[4]);
/// The twelve edges of a box.
void studio_overlay_box(StudioOverlay *overlay, const double min[3], const double max[3],
                        double width, const float colour[4]);
/// A circle about `centre` in the plane of two unit vectors, in lines.
void studio_overlay_circle(StudioOverlay *overlay, const double centre[3], const double x[3],
                           const double y[3], double radius, double width, const float colour[4]);
/// A line with a head of lines that is a fifth as long.
void studio_overlay_arrow(StudioOverlay *overlay, const double from[3], const double to[3],
                          double width, const float colour[4]);
