/// @file near.h
/// The nearest of many points in space, while more are added.
///
/// A hash table of cells about as wide as points are apart, made anew with finer cells each time
/// there are twice as many: it finds the nearest point sooner and has no say in which it is.
/// Questions about places that are near each other are best asked one after the other (zorder.h).
/// Points should lie on a surface. Cost of a point and of a question: constant on the average.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct FrNear FrNear;

/// `area` is that of the surface, `most` how many points there will be at most.
FrNear *fr_near_new(double area, uint32_t most);
void fr_near_free(FrNear *near);
void fr_near_add(FrNear *near, const double at[3]);
/// Lays all points anew for many questions before the next point.
void fr_near_settle(FrNear *near);
/// Squared distance from a place to the nearest point, `most` if none is nearer than that; may stop
/// as soon as it is not more than `enough`.
double fr_near_distance(const FrNear *near, const double at[3], double most, double enough);
