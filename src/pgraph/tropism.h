/// @file tropism.h
/// How far a stem turns in a field, whatever number of internodes it is made of.
///
/// With α the angle between stem and vertical, and strengths per length of stem,
///
///     dα/ds = −up α + down (π − α) − flat (α − π/2)
///
/// has the exact solution below, so two half steps turn a stem as far as one whole step: the
/// tip of a straight stem that light draws with strength κ stands at α₀ e^−κ for any number.
#pragma once

#include "frond/vector.h"

typedef struct FrTropism {
    double up, down, flat; ///< phototropism, gravitropism, plagiotropism over the stem's length
} FrTropism;

static inline bool fr_tropism_acts(FrTropism tropism) {
    return tropism.up != 0 || tropism.down != 0 || tropism.flat != 0;
}

/// The angle from the vertical after a part `step` of the stem's length, in [0, π].
double fr_tropism_angle(FrTropism tropism, double angle, double step);
/// The rotation, in the plant's coordinates, that turns `frame` as far.
versors fr_tropism_turn(FrTropism tropism, versors frame, double step);
/// The rotation that turns `frame` to a direction, the angle between them times e^−strength.
versors fr_align_turn(double strength, vec3s to, versors frame);
/// The rotation that lets `frame` sag: with dα/ds = k sin α the tangent of half its angle from the
/// vertical grows by e^strength.
versors fr_sag_turn(double strength, versors frame);
