/// @file lsystem/turtle.h
/// The turtle: symbols move and turn it; a builder, if there is one, receives what it draws.
///
/// It lives in the coordinates of its file: y up, heading (0,1,0), left (−1,0,0), up (0,0,−1) at
/// the start, so that up is −(heading × left). fr_lturtle_world() leads to the plant's.
#pragma once

#include "lsystem/derive.h"

#define FR_LTROPISMS 8

typedef struct FrLpose {
    double position[3], heading[3], left[3], up[3];
    double last_heading[3], last_up[3]; ///< of the segment before
    double width, scale;
    double elasticity;                 ///< of the old tropism
    double elasticities[FR_LTROPISMS]; ///< of the others
    double arrive, leave;              ///< tangent factors of generalized cylinders
    int32_t colour;
    int32_t contour;
    uint32_t sides;
    uint32_t node;   ///< of the plant that it stands on, FR_NONE
    bool is_at_tip;  ///< no jump since that node ended
    bool is_lateral; ///< the next segment begins an axis
} FrLpose;

/// What a segment is drawn with.
typedef struct FrLsegment {
    double start[3], end[3], heading[3], left[3], up[3];
    double start_width, end_width;
    uint64_t module;
    char symbol;
} FrLsegment;

/// A corner of a polygon or a control point of a generalized cylinder.
typedef struct FrLpoint {
    double position[3], heading[3], up[3];
    double width, arrive, leave;
    uint32_t strips;
} FrLpoint;

typedef struct FrLbuilder FrLbuilder;

typedef struct FrLturtle {
    const FrLview *view;
    const FrContext *context;
    FrLbuilder *builder; ///< NULL: only moves
    FrLpose pose;
    GArray *stack;      ///< FrLpose
    FrLsegment segment; ///< begun, to be drawn when its end width is known
    bool has_segment;
    bool is_raw;             ///< the next module belongs to the one before
    char prefix;             ///< '~', '@' or '?' before, else 0
    char qualifier;          ///< second letter of @T, @G, @D, @b, @P before, else 0
    uint32_t skip;           ///< > 0: behind a cut, brackets deep
    GArray *points;          ///< FrLpoint: corners and control points that are open
    GArray *shapes;          ///< Open: polygons and cylinders that are open
    GArray *scales;          ///< double: of called L-systems
    bool is_dollar_vertical; ///< `$` turns as in The Algorithmic Beauty of Plants
    bool is_cylinder;        ///< @Gs was met
    bool has_sites;          ///< some symbols place something
    uint64_t modules;
    FrStatus status;
    struct {
        float angle;
        double sine, cosine;
    } turns[16]; ///< angles met lately
} FrLturtle;

void fr_lturtle_init(FrLturtle *turtle, const FrLderivation *derivation, FrLbuilder *builder,
                     const FrContext *context);
void fr_lturtle_clear(FrLturtle *turtle);
/// Obeys one module; false where it must stop.
bool fr_lturtle_take(FrLturtle *turtle, const uint32_t *module, uint64_t origin);
/// Draws the segment that is begun.
void fr_lturtle_close_segment(FrLturtle *turtle);
/// `@` and what follows.
void fr_lturtle_at(FrLturtle *turtle, char symbol, const uint32_t *module);
/// The third letter of @Gs, @Ts, @Di, @bo and the like.
void fr_lturtle_qualified(FrLturtle *turtle, char symbol, const uint32_t *module);
/// Control points of a generalized cylinder: @Gs, @Gc, @Ge, @Gt.
void fr_lturtle_control(FrLturtle *turtle, char symbol, const uint32_t *module);
/// Rolls until left is horizontal.
void fr_lturtle_level(FrLpose *pose);
/// The k-th parameter, or a default.
static inline double fr_lturtle_value(const uint32_t *module, unsigned k, double otherwise) {
    return k < fr_lhead_count(*module) ? (double)fr_lword_float(module[1 + k]) : otherwise;
}
/// Rotation of a pair of axes as cpfg turns them.
void fr_lturtle_turn(double a[3], double b[3], double sine, double cosine);
/// Sine and cosine of an angle in degrees, remembered.
void fr_lturtle_sine(FrLturtle *turtle, float degrees, double *sine, double *cosine);
/// From the file's coordinates to the plant's.
static inline vec3s fr_lturtle_world(const double v[3]) {
    return (vec3s){{(float)v[0], (float)-v[2], (float)v[1]}};
}

// ---- tropism.c --------------------------------------------------------------------------------

/// Bends the heading before a move (the tropisms of the view).
void fr_lturtle_bend(FrLturtle *turtle);
/// Bends it after the move (the old tropism).
void fr_lturtle_bend_old(FrLturtle *turtle);
/// Left and up by the least twist from the segment before.
void fr_lturtle_untwist(FrLpose *pose);
void fr_lvector_unit(double v[3]);
void fr_lvector_cross(const double a[3], const double b[3], double out[3]);
double fr_lvector_dot(const double a[3], const double b[3]);
/// Turns v about the unit axis.
void fr_lvector_rotate(double v[3], const double axis[3], double sine, double cosine);
