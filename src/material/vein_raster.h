/// @file vein_raster.h
/// Veins drawn into fields of the size of a texture.
#pragma once

#include "material/venation.h"

typedef struct FrVeinField {
    int size;
    float *cover;  ///< 0 to 1: how much of the texel is vein, finer veins fainter
    float *groove; ///< 0 to 1: how deep the texel lies in the valley along a vein
} FrVeinField;

FrVeinField *fr_vein_field_new(const FrVenation *venation, const FrOutline *outline, int size,
                               const FrContext *context);
void fr_vein_field_free(FrVeinField *field);
