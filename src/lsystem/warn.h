/// @file lsystem/warn.h
#pragma once

#include "lsystem/program.h"

/// Warns of what a compiled file says without effect, or likely by mistake. Each thing once.
void fr_lwarn(const FrLsystem *system, FrDiags *diags);
