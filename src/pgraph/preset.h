/// @file preset.h
/// Deformations of FFDs that are ready made.
#pragma once

#include "pgraph/params.h"

/// The functions of a preset for the component's box, new references; false if it has none.
bool fr_preset_map(const FrFfdParams *ffd, FrExpr *map[3]);
