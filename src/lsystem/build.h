/// @file lsystem/build.h
/// From what the turtle draws to an FrPlant.
#pragma once

#include "lsystem/turtle.h"

/// Rows are appended to the plant by so many at once: few enough to be in the nearest cache still
/// when they are written.
enum { FR_LBLOCK = 256 };

struct FrLbuilder {
    FrPlant *plant;
    const FrContext *context;
    const FrLview *view;
    FrLdrawn drawn;
    FrStatus status;
    uint32_t nodes, axes;          ///< in use; the plant has some more
    uint32_t node_room, axis_room; ///< rows that are there and filled
    uint32_t framed;               ///< nodes whose frames are known
    uint32_t first_node;           ///< that it writes; those before are another part's
    struct FrLbuilderPart *part;   ///< NULL: it writes all of the plant
    float waiting[6][FR_LBLOCK];   ///< heading and left of those behind
    const FrLderivation *derivation;
    uint32_t *components; ///< by the mark of a head: component of the plant, FR_NONE: none so far
    uint32_t makers;      ///< how many of them
    uint32_t maker;       ///< mark of the module at work
    uint64_t module;      ///< its index in the string
    uint32_t wood, leaf;  ///< materials
    uint32_t section;     ///< profile of segments, FR_NONE: round
    uint32_t *colours;    ///< materials of the colours from 1
    uint32_t colour_count;
    FrMaterial *const *palette; ///< by colour index, NULL
    double unit;                ///< metres of one unit of the file
    const char *sites;          ///< symbols that place something, NULL
    GArray *origins;            ///< as FrLderivation.origins
    GArray *organ_origins;      ///< as FrLderivation.organ_origins
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
// ---- internodes.c -----------------------------------------------------------------------------

/// The material of a colour in the palette, or `otherwise` where that does not say.
uint32_t fr_lbuilder_painted(FrLbuilder *builder, int32_t colour, uint32_t otherwise);
/// The plant's component of what the production of a mark made.
uint32_t fr_lbuilder_component(FrLbuilder *builder, uint32_t maker);
/// A frame of the plant from the turtle's axes.
versors fr_lbuilder_frame(const double heading[3], const double left[3]);
/// Computes the frames of the nodes that have none yet.
void fr_lbuilder_settle_frames(FrLbuilder *builder);
/// Appends an internode of a length that is not 0; it is where one then stands. FR_NONE: failed.
uint32_t fr_lbuilder_begin(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment,
                           float width);
/// Where it ends and how wide it is there.
static inline void fr_lbuilder_finish(FrLbuilder *builder, uint32_t node, float width,
                                      const double end[3]) {
    builder->plant->nodes.radius[node] = width / 2;
    builder->plant->nodes.position[node] = fr_lturtle_world(end);
}
/// Both, unless it has no length.
void fr_lbuilder_node(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment,
                      const float widths[2], const double end[3]);
/// Counts a line as drawn, unless it is too short for cpfg.
static inline void fr_lbuilder_count(FrLbuilder *builder, double length, float end_width) {
    if (length * length > 1e-5 && end_width > 0) {
        builder->drawn.segments++;
        builder->drawn.length += length;
    }
}

// ---- build.c ----------------------------------------------------------------------------------

/// Counts a point into the bounding box.
static inline void fr_lbuilder_include(FrLbuilder *builder, const double at[3]) {
    FrLdrawn *drawn = &builder->drawn;
    for (int k = 0; k < 3; k++) {
        drawn->min[k] = at[k] < drawn->min[k] ? at[k] : drawn->min[k];
        drawn->max[k] = at[k] > drawn->max[k] ? at[k] : drawn->max[k];
    }
}
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
