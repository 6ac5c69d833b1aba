/// @file preset.h
/// Deformations of FFDs that are ready made.
#pragma once

#include "pgraph/params.h"

/// The functions of a preset for the component's box, new references; false if it has none.
/// `path` are the points (vec3s) of preset=curve, else NULL.
bool fr_preset_map(const FrFfdParams *ffd, const GArray *path, FrExpr *map[3]);

/// Adds what the functions of preset=curve are made of: numbers and curves of the line through some
/// points, and functions of them.
void fr_preset_add_curve(FrScope *scope, const GArray *points);
