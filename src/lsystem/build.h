/// @file lsystem/build.h
/// From what the turtle draws to an FrPlant.
#pragma once

#include "lsystem/turtle.h"

struct FrLbuilder {
    FrPlant *plant;
    const FrContext *context;
    const FrLview *view;
    FrLdrawn drawn;
    FrStatus status;
    uint32_t nodes; ///< in use; the plant has some more
    uint32_t segment_component, organ_component;
    uint32_t wood, leaf; ///< materials
    double unit;         ///< metres of one unit of the file
    const char *sites;   ///< symbols that place something, NULL
};

FrLbuilder *fr_lbuilder_new(const FrLderivation *derivation, const FrContext *context);
/// Ends the plant; NULL after a failure.
FrPlant *fr_lbuilder_end(FrLbuilder *builder);
void fr_lbuilder_free(FrLbuilder *builder);
/// Appends an internode where the pose stands; the pose then stands on it.
void fr_lbuilder_segment(FrLbuilder *builder, FrLpose *pose, const FrLsegment *segment);
/// Places something where the turtle is: an organ without a shape, of the symbol's component.
void fr_lbuilder_site(FrLbuilder *builder, const FrLpose *pose, char symbol, double scale);
/// A frame of the plant from the turtle's axes.
versors fr_lbuilder_frame(const double heading[3], const double left[3]);
/// Places an organ of a shape at a point with the turtle's axes.
void fr_lbuilder_organ(FrLbuilder *builder, const FrLpose *pose, const double at[3], uint32_t shape,
                       double scale, uint32_t material);

// ---- organs.c ---------------------------------------------------------------------------------

/// A filled polygon; `pose` is that of its begin.
void fr_lbuilder_polygon(FrLbuilder *builder, const FrLpose *pose, const FrLpoint *points,
                         uint32_t count);
void fr_lbuilder_sphere(FrLbuilder *builder, const FrLpose *pose, double diameter);
void fr_lbuilder_disc(FrLbuilder *builder, const FrLpose *pose, double diameter);
/// Draws a surface of the view, scaled along left, heading and up.
void fr_lbuilder_surface(FrLbuilder *builder, const FrLpose *pose, const FrLsurface *surface,
                         const double scale[3]);

// ---- cylinder.c -------------------------------------------------------------------------------

typedef enum FrLcylinderKind {
    FR_LHERMITE_OPEN = 1,
    FR_LHERMITE_CLOSED,
    FR_LSPLINE_OPEN,
    FR_LSPLINE_CLOSED
} FrLcylinderKind;

/// A generalized cylinder through or along control points.
void fr_lbuilder_cylinder(FrLbuilder *builder, FrLpose *pose, FrLcylinderKind kind,
                          const FrLpoint *points, uint32_t count);
