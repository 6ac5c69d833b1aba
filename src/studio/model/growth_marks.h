/// @file growth_marks.h
/// What growing plants feel and fill, as marks of an overlay. `apart` is that of the scene: marks
/// go with the plants that it moves.
#pragma once

#include "frond/growth.h"
#include "studio/model/overlay.h"

/// Buds in the false colours of their light, with a line to it; those that sleep smaller and grey.
StudioOverlay *studio_bud_marks(const FrGrowth *growth, double apart);
/// Cells that branches occupy, each plant in a colour of its own, and those of obstacles in grey.
StudioOverlay *studio_voxel_marks(const FrGrowth *growth, double apart);
/// Particles: blue where they draw a bud, else black. They go with the plant whose seed is nearest.
StudioOverlay *studio_particle_marks(const FrGrowth *growth, double apart);
