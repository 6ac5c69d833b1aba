/// @file curve.h
/// Hand-drawn curves y(x), closed and open outlines, and space curves with rotation-minimizing
/// frames.
#pragma once

#include "frond/digest.h"
#include "frond/vector.h"

#include <glib.h>

// ---- y(x) -------------------------------------------------------------------------------------

typedef enum FrCurveKind {
    FR_CURVE_SMOOTH, ///< monotone cubic (Fritsch, Carlson 1980): never overshoots its points
    FR_CURVE_LINEAR,
    FR_CURVE_STEP, ///< keeps the value of the point to the left
} FrCurveKind;

/// Immutable, reference counted.
typedef struct FrCurve FrCurve;

/// `points` are `count` ≥ 1 pairs (x, y) with strictly rising x, all finite and not so far apart
/// that a slope or the area overflows. NULL otherwise.
FR_API FrCurve *fr_curve_new(FrCurveKind kind, const double (*points)[2], size_t count);
/// One of the built-in curves: "flat", "ramp", "fall", "bell", "dome", "s", and the crown shapes of
/// Weber and Penn 1995 by their names ("conical", "spherical", "hemispherical", "cylindrical",
/// "tapered-cylindrical", "flame", "inverse-conical", "tend-flame"), with x = 0 at the base of the
/// crown and 1 at its top. NULL if there is none of that name.
FR_API FrCurve *fr_curve_builtin(const char *name);
/// The names fr_curve_builtin() knows.
FR_API const char *const *fr_curve_builtin_names(size_t *count);
FR_API FrCurve *fr_curve_ref(FrCurve *curve);
FR_API void fr_curve_unref(FrCurve *curve);
/// Outside the first and last x the end value holds. NaN gives the first value.
FR_API double fr_curve_eval(const FrCurve *curve, double x);
/// ∫ y dx from the first point to x, exact for the curve kind.
FR_API double fr_curve_integral(const FrCurve *curve, double x);
FR_API size_t fr_curve_point_count(const FrCurve *curve);
FR_API FrCurveKind fr_curve_kind(const FrCurve *curve);
FR_API void fr_curve_point(const FrCurve *curve, size_t index, double point[2]);
/// The digest of its kind and points, continued from `seed`: equal curves have equal ones.
FR_API FrDigest fr_curve_digest(FrDigest seed, const FrCurve *curve);

// ---- space curves -----------------------------------------------------------------------------

/// A polyline sampled from a centripetal Catmull-Rom spline through given points, parameterized by
/// arc length. Immutable, reference counted.
typedef struct FrPath FrPath;

/// Points that repeat the one before are left out. NULL without points or if one is not
/// finite or beyond 10¹² m.
FR_API FrPath *fr_path_new(const vec3s *points, size_t count);
FR_API FrPath *fr_path_ref(FrPath *path);
FR_API void fr_path_unref(FrPath *path);
FR_API double fr_path_length(const FrPath *path);
/// Point and unit tangent at `distance` metres along the path (clamped to its ends).
/// The tangent of a path of one point is up.
FR_API void fr_path_at(const FrPath *path, double distance, vec3s *point, vec3s *tangent);

/// Rotation-minimizing frames by double reflection (Wang, Jüttler, Zheng, Liu 2008): carries
/// `frame` from (point0, tangent = its z) to (point1, tangent1) with no twist about the tangent.
FR_API versors fr_frame_transport(versors frame, vec3s point0, vec3s point1, vec3s tangent1);
