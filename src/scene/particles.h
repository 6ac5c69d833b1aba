/// @file scene/particles.h
/// Attraction particles as a document strews them. Private to scene.
#pragma once

#include "frond/scene.h"

/// FR_ERR_LIMIT, at its place, if so many `<particles>` from number `first` on are too many.
FR_MUST_USE FrStatus fr_particles_check(const FrGrowthDef *growth, guint first,
                                        const FrContext *context);
/// FrParticle, of all `<particles>` from number `first` on; free with g_array_unref(). At most
/// FrLimits.organs of them.
FR_MUST_USE FrStatus fr_particles_strewn(const FrGrowthDef *growth, guint first,
                                         const FrContext *context, GArray **particles);
