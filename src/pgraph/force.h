/// @file force.h
/// Where forces draw.
#pragma once

#include "pgraph/field.h"

/// A point of the plant in a field's own coordinates.
void fr_field_local(const FrField *field, const double at[3], double local[3]);
/// The unit direction, or nothing, in which a stem with this heading is drawn. Returns how strong
/// the force is there, 0 to 1.
double fr_force_at(const FrField *force, const FrPrepared *prepared, const double at[3],
                   const double heading[3], double direction[3]);
/// Metres from a point to the surface of a force at its radius, negative within, and the unit
/// vector away from it. Endless for a force without a place.
double fr_force_clearance(const FrField *force, const FrPrepared *prepared, const double at[3],
                          double outward[3]);
