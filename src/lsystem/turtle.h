/// @file lsystem/turtle.h
/// The turtle: symbols move and turn it; a builder, if there is one, receives what it draws.
///
/// It lives in the coordinates of its file: y up, heading (0,1,0), left (−1,0,0), up (0,0,−1) at
/// the start, so that up is −(heading × left). fr_lturtle_world() leads to the plant's.
#pragma once

#include "lsystem/derive.h"

#include <math.h>

#define FR_LTROPISMS 10
#define FR_LMOST_LENGTH 1e9F ///< of a move, and of a width

/// Where in the plant something begins: a node (FR_NONE: on the ground) and marks above it. One
/// word, because what is written in pieces and read as one soon after stalls the processor.
typedef uint64_t FrLstand;
#define FR_LSTAND_NODE UINT64_C(0xFFFFFFFF)
#define FR_LSTAND_TIP (UINT64_C(1) << 32)     ///< no jump since that node ended
#define FR_LSTAND_LATERAL (UINT64_C(1) << 33) ///< the next segment begins an axis
static inline uint32_t fr_lstand_node(FrLstand stand) {
    return (uint32_t)stand;
}

/// The turtle's state, in the precision of cpfg. What comes behind `last_heading` is only kept
/// over brackets where the string may change it.
typedef struct FrLpose {
    /// Fourths are 0: pairs compute faster, and none lies in two lines of the cache.
    _Alignas(16) double position[4], heading[4], left[4], up[4];
    float scale;
    float elasticity; ///< of the old tropism
    int32_t colour;
    int32_t spline; ///< 1: F and f add control points, 2: only @Gc and @Ge do, 0: there is none
    FrLstand stand; ///< from here to `last_heading`: what nearly every segment changes
    float width;
    double last_heading[3], last_up[3]; ///< of the segment before
    double elasticities[FR_LTROPISMS];
    float arrive, leave;         ///< tangent factors of generalized cylinders
    float radius_tangents[2][2]; ///< before and behind a control point; 0: straight
    bool scales_tangents;        ///< the latter are per length of the span
    int32_t contour;
    uint32_t sides;
} FrLpose;

/// What a segment is drawn with, as it begins. The vectors are borrowed.
typedef struct FrLsegment {
    const double *start, *heading, *left;
    double length;
    uint64_t module;
    uint32_t maker; ///< mark of its head
    int32_t colour;
    bool is_backward; ///< its length was negative
} FrLsegment;

/// A bicubic patch in the making: @PS, @PC, @PD.
typedef struct FrLpatch {
    int id;
    int basis;       ///< 1 Bézier, 2 B-spline, 3 cardinal
    uint16_t is_set; ///< bit 4·row + column
    double points[16][3];
} FrLpatch;

/// A control point of a generalized cylinder.
typedef struct FrLpoint {
    double position[3], heading[3], left[3], up[3];
    float width, arrive, leave;
    float radius_tangents[2][2];
    bool scales_tangents;
    int32_t contour;
    uint32_t sides;
} FrLpoint;

/// A generalized cylinder that is open. Brackets continue a copy of it.
typedef struct FrLtube {
    bool is_closed, is_b_spline;
    uint32_t count;     ///< control points so far
    uint32_t strips;    ///< of a span, unless a point says otherwise
    FrLpoint last;      ///< where the curve has come to
    FrLpoint recent[3]; ///< last control points of a B-spline
    FrLpoint first[3];  ///< of a closed one
    FrLstand stand;
} FrLtube;

typedef struct FrLbuilder FrLbuilder;

typedef struct FrLturtle {
    const FrLview *view;
    const FrLderivation *derivation;
    const FrContext *context;
    FrLbuilder *builder; ///< NULL: only moves
    FrLpose pose;
    FrLpose *stack;
    uint32_t depth, capacity; ///< of the stack
    bool keeps_all;           ///< brackets keep all of a pose
    bool has_segment;         ///< begun; it ends where its end width is known
    uint32_t node;            ///< that it is, FR_NONE: none, or none yet
    float start_width;        ///< of the segment
    FrLsegment segment;       ///< within a cylinder, whose nodes come first
    double vectors[3][3];     ///< its
    bool is_moved;            ///< its position has not been counted into the bounding box
    bool is_raw;              ///< the next module belongs to the one before
    char prefix;              ///< '~', '@' or '?' before, else 0
    char qualifier;           ///< second letter of @T, @G, @D, @b, @P before, else 0
    uint32_t skip;            ///< > 0: behind a cut, brackets deep
    GArray *corners;          ///< double[3]: of the polygons that are open
    GArray *polygons;         ///< FrLpolygon: open, the innermost last
    GArray *splines;          ///< FrLtube: open, one a bracket
    GArray *patches;          ///< FrLpatch
    GArray *scales;           ///< float: of called L-systems, around and within
    bool is_dollar_vertical;  ///< `$` turns as in The Algorithmic Beauty of Plants
    bool has_sites;           ///< some symbols place something
    uint64_t modules;
    uint8_t deeds[FR_LSYMBOLS]; ///< what the symbols do
    FrStatus status;
    double sine, cosine; ///< of the angle increment
    struct {
        float angle;
        double sine, cosine;
    } turns[16]; ///< angles met lately
} FrLturtle;

/// A polygon that is open: where it began.
typedef struct FrLpolygon {
    FrLpose pose;
    uint32_t first; ///< corner
    uint32_t maker; ///< mark of what began it
} FrLpolygon;

void fr_lturtle_init(FrLturtle *turtle, const FrLderivation *derivation, FrLbuilder *builder,
                     const FrContext *context);
void fr_lturtle_clear(FrLturtle *turtle);
/// Obeys one module; false where it must stop.
bool fr_lturtle_take(FrLturtle *turtle, const uint32_t *module, uint64_t origin);
/// Obeys the modules of a string that has no homomorphism, from a word to another; the first is
/// that many modules behind its begin.
void fr_lturtle_walk(FrLturtle *turtle, const uint32_t *words, uint64_t from, uint64_t to,
                     uint64_t module);
/// Ends the segment that is begun and counts the place into the bounding box.
void fr_lturtle_end_node(FrLturtle *turtle);
/// `@` and what follows; false where the symbol means nothing there and is obeyed by itself.
bool fr_lturtle_at(FrLturtle *turtle, char symbol, const uint32_t *module);
/// The third letter of @Gs, @Ts, @Di, @bo and the like.
void fr_lturtle_qualified(FrLturtle *turtle, char symbol, const uint32_t *module);
/// Patches: @PS, @PC, @PD.
void fr_lturtle_patch(FrLturtle *turtle, char symbol, const uint32_t *module);
/// Rolls until left is horizontal.
void fr_lturtle_level(FrLpose *pose);
/// The k-th parameter, or a default.
static inline double fr_lturtle_value(const uint32_t *module, unsigned k, double otherwise) {
    return k < fr_lhead_count(*module) ? (double)fr_lword_float(module[1 + k]) : otherwise;
}
/// Rotation of a pair of the pose's axes as cpfg turns them.
static inline void fr_lturtle_turn(double a[restrict 4], double b[restrict 4], double sine,
                                   double cosine) {
    for (int k = 0; k < 4; k++) {
        double x = a[k], y = b[k];
        a[k] = x * cosine + y * sine;
        b[k] = y * cosine - x * sine;
    }
}
/// Length of a move: single precision, as cpfg has it.
static inline float fr_lturtle_length(const FrLpose *pose, const uint32_t *module) {
    float length =
        fr_lhead_count(*module) > 0 ? fr_lword_float(module[1]) * pose->scale : pose->scale;
    return fabsf(length) <= FR_LMOST_LENGTH ? length : 0;
}
/// Sine and cosine of an angle in degrees, remembered.
void fr_lturtle_sine(FrLturtle *turtle, float degrees, double *sine, double *cosine);
/// A number as an int, as C converts it where that is defined.
static inline int fr_lturtle_int(double value) {
    return value > -2e9 && value < 2e9 ? (int)value : 0;
}
/// From the file's coordinates to the plant's.
static inline vec3s fr_lturtle_world(const double v[3]) {
    return (vec3s){{(float)v[0], (float)-v[2], (float)v[1]}};
}

// ---- turtle_shapes.c --------------------------------------------------------------------------

/// `{` and `}`.
void fr_lturtle_open_shape(FrLturtle *turtle, const uint32_t *module);
void fr_lturtle_close_shape(FrLturtle *turtle, const uint32_t *module);
/// Warns, at the end of the string, of polygons that are open still.
void fr_lturtle_warn_of_open(const FrLturtle *turtle);
/// `.`: a corner of a polygon or a control point of a cylinder.
void fr_lturtle_dot(FrLturtle *turtle, const uint32_t *module);
/// Adds the turtle's place to the polygon that is open.
void fr_lturtle_corner(FrLturtle *turtle);
/// `~` and what follows.
void fr_lturtle_surface(FrLturtle *turtle, char symbol, const uint32_t *module);

// ---- tropism.c --------------------------------------------------------------------------------

/// Bends the heading before a move (the tropisms of the view).
void fr_lturtle_bend(FrLturtle *turtle);
/// Bends it after the move (the old tropism).
void fr_lturtle_bend_old(FrLturtle *turtle);
/// Left and up by the least twist from the segment before.
void fr_lturtle_untwist(FrLpose *pose);
/// Up of `point` by the least twist from `before`, then rolled by `roll` radians; left after it.
void fr_lpoint_untwist(FrLpoint *point, const FrLpoint *before, double roll);
void fr_lvector_unit(double v[3]);
void fr_lvector_cross(const double a[3], const double b[3], double out[3]);
double fr_lvector_dot(const double a[3], const double b[3]);
/// Turns v about the unit axis.
void fr_lvector_rotate(double v[3], const double axis[3], double sine, double cosine);

// ---- spline.c ---------------------------------------------------------------------------------

/// Begins a generalized cylinder of kind 1 … 4 (`{(kind,strips)`), strips 0: 4.
void fr_lspline_begin(FrLturtle *turtle, int kind, int strips);
/// Adds the turtle's place as a control point; strips 0: as many as the cylinder has.
void fr_lspline_point(FrLturtle *turtle, int strips);
void fr_lspline_end(FrLturtle *turtle);
/// @Gs, @Gc, @Ge, @Gt, @Gr.
void fr_lspline_obey(FrLturtle *turtle, char symbol, const uint32_t *module);
/// A bracket opens: its cylinder is a copy of the one around it.
void fr_lspline_push(FrLturtle *turtle);
/// A bracket closes with its cylinder open, which is given up.
void fr_lspline_pop(FrLturtle *turtle);
