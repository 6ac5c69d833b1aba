/// @file life.h
/// When instances are there, and how far they have grown.
///
/// Every instance has a clock of its own. It shows (a − birth) · time-scale where the clock around
/// it shows a: that of its parent, but of what stands on a growing stem from the moment at which
/// the tip came by. So the life of a leaf is embedded in that of its twig.
#pragma once

#include "pgraph/instance.h"

/// Notes of what its instances have a life; nothing if all is neutral.
void fr_prepare_life(FrPrepared *made);
/// Sets the age of the instance in `row`. False if it is not there: not yet or no longer, or left
/// out by its chance.
bool fr_instance_lives(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// The part of its size that the instance whose variables are set has, of a component that grows.
double fr_growth_now(const FrPrepared *prepared, FrEvaluator *evaluator);
/// The part of the time of growth after which a part of the size is there.
double fr_growth_when(const FrCurve *curve, double part);
