/// @file lsystem/view.h
/// What a view file says that the language and the turtle need to know.
#pragma once

#include "lsystem/text.h"

#include "frond/lsystem.h"

typedef enum FrLstyle { FR_LSTYLE_PIXEL, FR_LSTYLE_POLYGON, FR_LSTYLE_CYLINDER } FrLstyle;

/// A pull on the heading (or, for a torque, on up).
typedef struct FrLtropism {
    double direction[3]; ///< unit times intensity, at most 1 long
    double angle;        ///< radians from the direction (γ)
    double elasticity, step;
    bool is_torque;
} FrLtropism;

/// A function of x in [0, 1]: a clamped cubic B-spline. Where it is sampled, values between
/// samples are straight.
typedef struct FrLspline {
    char *name;
    double (*points)[3]; ///< control points
    uint32_t point_count;
    double *samples; ///< NULL: not sampled
    uint32_t count;
} FrLspline;

/// Points of a contour or curve.
typedef struct FrLcontour {
    int id;
    double (*points)[3];
    uint32_t count;
    bool is_closed;
    double length;
    double (*controls)[3]; ///< of a curve: control points of its B-spline; NULL for contours
    uint32_t control_count;
    bool is_clamped; ///< the curve ends in its first and last control point
    double *lengths; ///< of a curve: from its begin to each of `count` points, over the whole
} FrLcontour;

/// Triangles of a surface, in the turtle's axes (x left, y heading, z up).
typedef struct FrLsurface {
    char symbol;
    float (*corners)[3]; ///< three a triangle
    uint32_t count;      ///< of corners
    double end[3];       ///< where the turtle goes
    bool is_mesh;        ///< given as triangles; the turtle stays where it is
    double (*hull)[3];   ///< control points, which bound it
    uint32_t hull_count;
} FrLsurface;

struct FrLview {
    double angle, width, width_step, scale, scale_step;
    FrLstyle style;
    bool tapers, twists, draws_past_cut;
    bool answers_before; ///< the environment answers before the string is drawn
    bool is_framed;      ///< has a box:, so that nothing is drawn to find one
    uint32_t contour_sides;
    int colour, colour_step;
    double old_direction[3], old_elasticity, old_step;
    GArray *tropisms;     ///< FrLtropism
    GArray *functions;    ///< FrLspline
    GArray *contours;     ///< FrLcontour
    GArray *curves;       ///< FrLcontour
    GArray *surfaces;     ///< FrLsurface
    double (*section)[2]; ///< of what `line:` draws segments with, closed: left and −up, for a
                          ///< radius of 1; NULL: round
    uint32_t section_count;
};

/// Defaults of all commands. Never NULL; fr_lview_free() frees it.
FrLview *fr_lview_new(void);
/// Names of functions with their numbers, from 1. Free with g_free(); the names are borrowed.
FrLname *fr_lview_names(const FrLview *view, size_t *count);
/// func(id, x); 0 where there is none.
double fr_lview_function(const FrLview *view, double id, double x);
/// A coordinate of the point of a curve at t of its length.
double fr_lview_curve(const FrLview *view, double id, double t, int axis);
double fr_lview_curve_length(const FrLview *view, double id);
