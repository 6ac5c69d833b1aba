/// @file skeleton.h
/// Plants as bare lines, and plants from bare lines: skeletons of other programs, cylinders fitted
/// to laser scans.
///
///     FrSkeleton *skeleton = fr_skeleton_new(&params);
///     fr_skeleton_load(skeleton, NULL, folder, span, &context);      reads params.file
///     fr_skeleton_grow(skeleton, "oak", &context, &plant);
#pragma once

#include "frond/param.h"
#include "frond/plant.h"

/// A line of a skeleton, such as a cylinder fitted to a laser scan.
typedef struct FrSegment {
    vec3s from, to; ///< m
    float radius;   ///< m, at both ends
} FrSegment;

/// The lines of a plant: its internodes, cut where branches stand along them. A branch begins on
/// the middle of its bearer. Reads the cache. Free the array with g_free().
FR_API FrSegment *fr_skeleton_segments(const FrPlant *plant, size_t *count);
/// A plant from lines alone, in any order and direction. Ends nearer than `tolerance` (< 0: 1e-5 of
/// the height) are one joint. What is connected is one stem with its branches, rooted in its lowest
/// end; where lines part, the axis goes on along the thickest, then the straightest. Axes of order
/// 0 are of the component `stem`, the others of `branch`. Lines that close a loop or have no length
/// are left out with a warning at `span`; stems that begin high above the others get one too.
FR_API FR_MUST_USE FrStatus fr_skeleton_weld(const FrSegment *segments, size_t count,
                                             double tolerance, const char *name, FrSpan span,
                                             const FrContext *context, FrPlant **plant);
/// Reads a table of lines: `x y z x y z r` a row, from the first end to the second, numbers
/// separated by blanks, commas or semicolons; `#` begins a comment, the radius may be left out
/// (then 0.01). Frees the array with g_free().
FR_API FR_MUST_USE FrStatus fr_skeleton_read(const FrSource *source, const FrContext *context,
                                             FrSegment **segments, size_t *count);

// ---- a skeleton in a document -----------------------------------------------------------------

#define FR_SKELETON_PARAMS(X)                                                                      \
    X(TEXT, file, "", 0, 0, "", "",                                                                \
      "table of lines, or .mtg, beside the document; empty: the text within")                      \
    X(REAL, unit, "1", 0.000001, 1000000, "m", "", "length of one unit of the table")              \
    X(REAL, tolerance, "-1", -1, 1000, "m", "",                                                    \
      "ends nearer than this are one joint; -1: 1/100000 of the height")                           \
    X(TEXT, material, "", 0, 0, "", "", "id of the material of its axes")

typedef struct FrSkeletonParams {
    FR_SKELETON_PARAMS(FR_PARAM_FIELD)
} FrSkeletonParams;

FR_API const FrParamTable *fr_skeleton_table(void);

typedef struct FrSkeleton FrSkeleton;

/// Copies the parameters.
FR_API FrSkeleton *fr_skeleton_new(const FrSkeletonParams *params);
FR_API void fr_skeleton_free(FrSkeleton *skeleton);
/// The file it is read from, NULL for a text within the document.
FR_API const char *fr_skeleton_file(const FrSkeleton *skeleton);
/// The material of its axes; NULL: none. Takes a reference.
FR_API void fr_skeleton_set_material(FrSkeleton *skeleton, FrMaterial *material);
/// Reads `text`, or the file of the parameters if that is NULL, relative to `folder`. `span` is
/// where the skeleton is described. Once a skeleton.
FR_API FR_MUST_USE FrStatus fr_skeleton_load(FrSkeleton *skeleton, const FrSource *text,
                                             const char *folder, FrSpan span,
                                             const FrContext *context);
/// A plant of its lines, as fr_skeleton_weld() makes it.
FR_API FR_MUST_USE FrStatus fr_skeleton_grow(const FrSkeleton *skeleton, const char *name,
                                             const FrContext *context, FrPlant **plant);
