// What a tube has beyond its outer wall: caps of its ends, and the inner wall of a hollow one.
//
//        dome            splinters           hollow
//       .--.             /\  /|  /\        ┌─┐   ┌─┐  lip
//      /    \           |  \/ |_/  |       │ │   │ │
//     |      |          |          |       │ └───┘ │  floor
#pragma once

#include "skin/plan.h"

/// From this level of detail on relief is too fine to see.
enum { FR_RELIEF_GONE = 2 };

/// Adds what closes a tube with rings to its counts, and sets its `wall_rings`. For closed sections
/// where caps are wanted.
void fr_count_ends(const FrPlan *plan, FrTube *tube);
