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
