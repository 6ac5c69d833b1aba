// Where plants were written. Private to the layers above.
#pragma once

#include "frond/plant.h"

/// The place of the first component, for what is said of the plant as a whole; none if that has
/// none.
FrSpan fr_plant_place(const FrPlant *plant);
