/// @file pipes.h
/// Stems of radius-mode=pipe: as thick as all they bear.
#pragma once

#include "pgraph/instance.h"

/// Whether any component that is made has such stems.
bool fr_has_pipes(const FrExpansion *expansion);
/// Gives their nodes the radii, once all is there; what stands on their surface is moved out to it.
void fr_pipes_apply(const FrExpansion *expansion);
