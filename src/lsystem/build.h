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
    uint32_t nodes, axes; ///< in use; the plant has some more
    const FrLderivation *derivation;
    uint32_t *components; ///< by the mark of a head: component of the plant, FR_NONE: none so far
    uint32_t maker;       ///< mark of the module at work
    uint64_t module;      ///< its index in the string
    uint32_t wood, leaf;  ///< materials
    uint32_t section;     ///< profile of segments, FR_NONE: round
    uint32_t *colours;    ///< materials of the colours from 1
    uint32_t colour_count;
    FrMaterial *const *palette; ///< by colour index, NULL
    double unit;                ///< metres of one unit of the file
    const char *sites;          ///< symbols that place something, NULL
};

FrLbuilder *fr_lbuilder_new(const FrLderivation *derivation, const FrContext *context);
/// fr_limit_check() for what the module at work asks for.
FR_MUST_USE FrStatus fr_lbuilder_limit(const FrLbuilder *builder, uint64_t wanted, uint64_t limit,
                                       const char *limit_name, const char *what);
/// Room for about what the symbols of a string draw, if nothing replaces them.
void fr_lbuilder_reserve(FrLbuilder *builder, const FrLstring *string);
/// Ends the plant: what was kept in the plant's coordinates becomes relative to its bearers.
FrPlant *fr_lbuilder_end(FrLbuilder *builder);
void fr_lbuilder_free(FrLbuilder *builder);
/// Places something where the turtle is: an organ without a shape, of the symbol's component.
void fr_lbuilder_site(FrLbuilder *builder, const FrLpose *pose, char symbol, double scale);
/// Appends an internode; it is where one then stands. Counted apart if it is a segment of F or G.
void fr_lbuilder_segment(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment);
/// Appends an internode that is not counted as drawn.
void fr_lbuilder_node(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment);
/// Counts a line from one point to the other as drawn, if it is long enough to be.
void fr_lbuilder_count(FrLbuilder *builder, const FrLsegment *segment);
/// Counts a point into the bounding box.
static inline void fr_lbuilder_include(FrLbuilder *builder, const double at[3]) {
    FrLdrawn *drawn = &builder->drawn;
    for (int k = 0; k < 3; k++) {
        drawn->min[k] = at[k] < drawn->min[k] ? at[k] : drawn->min[k];
        drawn->max[k] = at[k] > drawn->max[k] ? at[k] : drawn->max[k];
    }
}
/// A frame of the plant from the turtle's axes.
versors fr_lbuilder_frame(const double heading[3], const double left[3]);
/// The material of the pose's colour; `plain` if that has none of its own.
uint32_t fr_lbuilder_material(FrLbuilder *builder, const FrLpose *pose, uint32_t plain);
/// Places an organ of a shape at a point with the turtle's axes.
void fr_lbuilder_organ(FrLbuilder *builder, const FrLpose *pose, const double at[3], uint32_t shape,
                       double scale, uint32_t material);

// ---- organs.c ---------------------------------------------------------------------------------

/// A filled polygon; `pose` is that of its begin.
void fr_lbuilder_polygon(FrLbuilder *builder, const FrLpose *pose, const double (*points)[3],
                         uint32_t count);
void fr_lbuilder_sphere(FrLbuilder *builder, const FrLpose *pose, double diameter);
/// A disc in the plane of heading and left; with a hole of that diameter a ring.
void fr_lbuilder_disc(FrLbuilder *builder, const FrLpose *pose, double diameter, double hole,
                      bool faces_viewer);
/// Triangles, three corners each, in the file's coordinates.
void fr_lbuilder_triangles(FrLbuilder *builder, const FrLpose *pose, const double (*corners)[3],
                           uint32_t count);
/// Draws a surface of the view, scaled along left, heading and up.
void fr_lbuilder_surface(FrLbuilder *builder, const FrLpose *pose, const FrLsurface *surface,
                         const double scale[3]);
