// What a plant made of forks is made from. Private to variation.
#pragma once

#include "frond/ramified.h"

struct FrRamified {
    FrRamifiedParams params;
    FrMaterial *bark, *leaf;
    double rows[FR_RAMIFIED_ORDERS + 1][FR_RAMIFIED_ORDERS];
    FrSpan span; ///< where it is described
};

/// Fills the rows of random or perfect trees.
void fr_matrix_known(FrRamified *ramified);
/// Reads rows from a text: order 2 first, a row a line.
FrStatus fr_matrix_read(FrRamified *ramified, const FrSource *source, const FrContext *context);
