/// @file scene/sequence.h
/// How fr_scene_begin() takes over what has grown in the last scene of a sequence.
#pragma once

#include "frond/sequence.h"
#include "scene/ecosystem.h"
#include "scene/growing.h"

/// Puts what has grown in the place of `ecosystem` and `growing`, which are freed, and what its
/// steps have done into the scene. False, and only the stage noted, if it has grown more than
/// `steps` steps bud by bud, or more than `growing` may, or on another stage.
bool fr_sequence_hand_over(FrSequence *sequence, FrScene *scene, uint64_t steps,
                           FrEcosystem **ecosystem, FrGrowing **growing);
