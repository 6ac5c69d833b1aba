/// @file nurbs_scene.h
/// The rational surfaces of a scene's plants, and numbers as CAD files write them.
#pragma once

#include "frond/io.h"

#include "io/meshes.h"
#include "io/output.h"

typedef struct FrIoNurbs {
    FrNurbsSkin **skins;    ///< one for each plant of the scene; NULL where it stands nowhere
    uint32_t length;        ///< plants of the scene
    uint32_t *first_colour; ///< by plant: number of its first colour
    uint32_t colours;
    uint64_t surfaces, points; ///< with every stand counted
} FrIoNurbs;

/// Makes the surfaces of every plant that stands somewhere; `params` are for plants that have none.
/// `shares`: organs may be copies. The text of all, `point_bytes` a
/// control point, counts against the limit of bytes.
FrStatus fr_io_nurbs_make(FrIoNurbs *nurbs, const FrScene *scene, const FrNurbsParams *params,
                          bool shares, uint64_t point_bytes, const FrContext *context);
void fr_io_nurbs_clear(FrIoNurbs *nurbs);

/// The number of a piece's colour, from 0. Each plant begins with its two defaults.
uint32_t fr_io_nurbs_colour(const FrIoNurbs *nurbs, uint32_t plant, const FrNurbsPiece *piece);
/// The sRGB of a plant's n-th colour, 0 to 1; false past its last.
bool fr_io_nurbs_rgb(const FrScene *scene, uint32_t plant, uint32_t n, double rgb[3]);

/// A control point where its plant stands, z up. The weight stays.
void fr_io_nurbs_posed(const FrPose *pose, const double point[4], double posed[4]);

enum { FR_REAL_ROOM = 40 };
/// A number of `digits` ≤ 17 digits with a decimal point, as IGES and STEP want it: `1.5`, `2.`,
/// `3.E-05`. Answers its length.
int fr_real_text(char text[FR_REAL_ROOM], double value, int digits);

/// What a format reports.
FrIoStats fr_io_nurbs_stats(const FrIoNurbs *nurbs, uint64_t bytes, gint64 start, gint64 skinned);
