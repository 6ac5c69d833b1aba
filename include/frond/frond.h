/// @file frond.h
/// Everything, for programs that want one include. Engines and libraries include what they use.
#pragma once

#include "frond/io.h"
#include "frond/rebuild.h"
#include "frond/render.h"
#include "frond/shading.h"
