/// @file outline.h
/// Lines (float[3], in pairs) that show parts of a plant where it stands.
#pragma once

#include "frond/scene.h"

/// Along an axis.
void studio_outline_axis(GArray *lines, const FrStand *stand, const FrPlant *plant, uint32_t axis);
/// Along an internode.
void studio_outline_node(GArray *lines, const FrStand *stand, const FrPlant *plant, uint32_t node);
/// A diamond about the organ, as large as it is.
void studio_outline_organ(GArray *lines, const FrStand *stand, const FrPlant *plant,
                          uint32_t organ);
