// The edge of a blade: teeth as triangles of their own, lobes as its outline.
#pragma once

#include "skin/blade.h"
#include "skin/outline.h"
#include "skin/shape.h"

/// Adds the teeth of both sides to a blade whose rows are laid. None from the second level of
/// detail on.
void fr_margin_teeth(FrShapeMesh *mesh, const FrBladeForm *form, const FrOutlineRow *rows,
                     uint32_t count, const FrDetail *detail);
/// At most so many vertices these take.
uint64_t fr_margin_vertices_most(const FrBlade *blade);

// ---- teeth, whoever makes something of them ----------------------------------------------------

enum { FR_TOOTH_STEPS_MOST = 6 };

/// One side's edge: a polygon through the ends of the rows.
typedef struct FrEdge {
    const FrBladeForm *form;
    const FrOutlineRow *rows;
    uint32_t count;
    double side;     ///< −1 left, 1 right
    double *way;     ///< m, up to each row; owned
    double *corners; ///< 3 a row; owned
} FrEdge;

/// A step of a tooth: where along it, how far the upper point leans on, how high it is.
typedef struct FrToothStep {
    double along, lean, height;
} FrToothStep;

/// A point above the edge.
typedef struct FrToothCorner {
    double along, half; ///< of its foot: along the blade, and metres from the midrib
    vec3s foot, top, normal;
} FrToothCorner;

/// Where a tooth stands: of a number of teeth, from base to tip.
typedef struct FrTooth {
    double from, length; ///< parts of the edge
    double height;       ///< m
} FrTooth;

bool fr_blade_has_teeth(const FrBlade *blade);
void fr_edge_init(FrEdge *edge, const FrBladeForm *form, const FrOutlineRow *rows, uint32_t count,
                  double side);
void fr_edge_clear(FrEdge *edge);
/// The steps of a blade's teeth, and how many but one.
uint32_t fr_tooth_steps(const FrBlade *blade, bool is_coarse,
                        FrToothStep steps[FR_TOOTH_STEPS_MOST + 1]);
FrTooth fr_tooth_at(const FrBladeForm *form, uint32_t tooth, uint32_t teeth);
FrToothCorner fr_tooth_corner(const FrEdge *edge, const FrTooth *tooth, const FrToothStep *step);
