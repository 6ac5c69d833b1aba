/// @file lsystem/ask.h
/// The turtle's pass before a step: query modules are filled, open symbols are answered.
#pragma once

#include "lsystem/build.h"
