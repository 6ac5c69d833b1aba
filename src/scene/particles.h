/// @file scene/particles.h
/// Attraction particles as a document strews them. Private to scene.
#pragma once

#include "frond/scene.h"

/// FrParticle, of all `<particles>` from number `first` on; free with g_array_unref(). At most
/// FrLimits.organs of them.
FR_MUST_USE FrStatus fr_particles_strewn(const FrGrowthDef *growth, guint first,
                                         const FrContext *context, GArray **particles);
