/// @file picked.h
/// From what a ray meets to what the user sees of it.
#pragma once

#include "frond/pick.h"
#include "studio/model/builder.h"

/// Names it and draws lines along it.
StudioPicked studio_picked_of(const FrScene *scene, const FrPick *pick);
