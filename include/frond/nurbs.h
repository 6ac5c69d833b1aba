/// @file nurbs.h
/// Rational B-spline curves and surfaces in double precision: the basis, evaluation with
/// derivatives, knot insertion, exact circles, interpolation.
///
/// Control points hold their place in space and their weight, (x, y, z, w), as CAD files do; the
/// homogeneous point is (wx, wy, wz, w). Knots do not fall; there are count + degree + 1 of them.
#pragma once

#include "frond/api.h"

enum { FR_NURBS_DEGREE_MOST = 9 };

typedef struct FrNurbsCurve {
    uint32_t degree, count; ///< count > degree ≥ 1
    double *knots;          ///< owned
    double (*points)[4];    ///< owned
} FrNurbsCurve;

/// Borrows its arrays; many surfaces share the same knots.
typedef struct FrNurbsSurface {
    uint32_t degree_u, degree_v;
    uint32_t count_u, count_v;
    const double *knots_u, *knots_v;
    const double (*points)[4]; ///< point (i, j) is points[j * count_u + i]
} FrNurbsSurface;

/// How fine a grid of points on a surface shall be.
typedef struct FrNurbsFineness {
    double tolerance; ///< farthest that a plane cell may be from the surface, > 0
    double turn;      ///< radians, > 0: wanted turn from step to step; what is small may turn more
} FrNurbsFineness;

enum { FR_NURBS_STEPS_MOST = 64 };

/// The published ways to write the unit circle in the plane of x and y, all exact.
typedef enum FrNurbsCircle {
    FR_CIRCLE_TRIANGLE, ///< quadratic, seven points: a triangle's corners and the middles of sides
    FR_CIRCLE_SQUARE,   ///< quadratic, seven points on a square
    FR_CIRCLE_NINE,     ///< quadratic, nine points on a square: the most even speed
    FR_CIRCLE_CUBIC,    ///< cubic, seven points
} FrNurbsCircle;

/// The arc of a polynomial piece that holds u: the last i with knots[i] ≤ u, within
/// degree … count − 1. The end of the curve belongs to the last piece.
FR_API uint32_t fr_nurbs_span(const double *knots, uint32_t degree, uint32_t count, double u);
/// The degree + 1 basis functions that do not vanish on the piece `span`, at u, and their first
/// derivatives unless `slope` is NULL.
FR_API void fr_nurbs_basis(const double *knots, uint32_t degree, uint32_t span, double u,
                           double *basis, double *slope);

/// Point and first derivative; either may be NULL. u is clamped to the curve.
FR_API void fr_nurbs_curve_at(const FrNurbsCurve *curve, double u, double point[3],
                              double derivative[3]);
/// Point and partial derivatives; each may be NULL. u and v are clamped to the surface.
FR_API void fr_nurbs_surface_at(const FrNurbsSurface *surface, double u, double v, double point[3],
                                double along_u[3], double along_v[3]);
/// Pieces between knots.
FR_API uint32_t fr_nurbs_pieces(const double *knots, uint32_t degree, uint32_t count);
/// Into how many even steps each piece between knots is cut, both ways, each at most
/// FR_NURBS_STEPS_MOST; 0 for a piece that is part of the step before it.
FR_API void fr_nurbs_steps(const FrNurbsSurface *surface, const FrNurbsFineness *fineness,
                           uint8_t *steps_u, uint8_t *steps_v);
/// The parameters of these steps from end to end; answers how many: one more than steps.
FR_API uint32_t fr_nurbs_parameters(const double *knots, uint32_t degree, uint32_t count,
                                    const uint8_t *steps, double *at);
/// Points of a surface at rising parameters, `u` fastest, and unit normals along du × dv; where a
/// side is shrunk to a point, those beside it. `coordinates` (NULL: none) belong to the control
/// points and are blended as these are to `blended`.
FR_API void fr_nurbs_grid(const FrNurbsSurface *surface, const double *u, uint32_t count_u,
                          const double *v, uint32_t count_v, double (*points)[3],
                          double (*normals)[3], const double (*coordinates)[2],
                          double (*blended)[2]);
/// First and last value of the parameter.
FR_API void fr_nurbs_range(const double *knots, uint32_t degree, uint32_t count, double range[2]);
/// True if counts, knots, points and weights (> 0) are as they must be; for what was imported.
FR_API bool fr_nurbs_surface_is_valid(const FrNurbsSurface *surface);

/// Puts a range of the parameter within that of a spline. True if the spline must be cut to have it
/// from end to end: it is longer, or its ends are not clamped.
FR_API bool fr_nurbs_is_cut(const double *knots, uint32_t degree, uint32_t count, double range[2]);
/// The clamped knots of the part of a valid spline within such a range, which is not empty; `cut`
/// has room for count + 3 · (degree + 1). Answers the number of control points.
FR_API uint32_t fr_nurbs_cut_knots(const double *knots, uint32_t degree, uint32_t count,
                                   const double range[2], double *cut);
/// The control points of that part; points are `stride` apart, those made `cut_stride`.
FR_API void fr_nurbs_cut(const double *knots, uint32_t degree, uint32_t count,
                         const double (*points)[4], size_t stride, const double *cut,
                         uint32_t cut_count, double (*cut_points)[4], size_t cut_stride);

/// A control point through a projective map of homogeneous coordinates, row by row.
FR_API void fr_nurbs_project(const double map[4][4], const double point[4], double image[4]);

FR_API void fr_nurbs_curve_clear(FrNurbsCurve *curve);
FR_API FrNurbsCurve fr_nurbs_curve_copy(const FrNurbsCurve *curve);
/// The unit circle, counter-clockwise, closed.
FR_API FrNurbsCurve fr_nurbs_circle(FrNurbsCircle form);
/// The uniform spline with this control polygon in the plane of x and y, weights 1, clamped where
/// it begins and ends. A closed one is smooth there too and has count + degree points, an open one
/// reaches its end points. `count` ≥ 2; the degree is lowered where an open polygon is too short.
FR_API FrNurbsCurve fr_nurbs_from_polygon(const double (*points)[2], uint32_t count, bool is_closed,
                                          uint32_t degree);
/// Inserts a knot once (Boehm 1980): the curve stays the same and has a point more. `knot` must lie
/// inside the range.
FR_API void fr_nurbs_curve_insert(FrNurbsCurve *curve, double knot);
/// Gives two clamped curves of one degree on [0, 1] the same knots, by insertion.
FR_API void fr_nurbs_curves_merge(FrNurbsCurve *a, FrNurbsCurve *b);

/// Mean of the `degree` knots that a control point depends on: where it has its weight.
FR_API double fr_nurbs_greville(const double *knots, uint32_t degree, uint32_t index);
/// The bilinear Coons patch of four sides, as a net of bottom->count × left->count points: u runs
/// along `bottom` and `top`, v along `left` and `right`. Opposite sides have the same knots, on
/// [0, 1], all sides meet at the corners, and weights are 1.
FR_API void fr_nurbs_coons(const FrNurbsCurve *bottom, const FrNurbsCurve *top,
                           const FrNurbsCurve *left, const FrNurbsCurve *right,
                           double (*points)[4]);
/// Clamped knots for `count` points at the rising parameters `at`: averages of `degree` of them (de
/// Boor), so that interpolation at `at` has a solution.
FR_API void fr_nurbs_average_knots(const double *at, uint32_t count, uint32_t degree,
                                   double *knots);
/// Replaces `count` values of `dimensions` numbers each, `stride` apart, that a spline shall take
/// at the parameters `at`, by its control values.
FR_API void fr_nurbs_interpolate(const double *knots, uint32_t degree, const double *at,
                                 uint32_t count, double *values, uint32_t dimensions,
                                 uint32_t stride);
