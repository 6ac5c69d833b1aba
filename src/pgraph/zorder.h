/// @file zorder.h
/// Places in space in an order in which those that are near mostly follow each other, so that what
/// is looked up for one is still in the cache for the next.
///
/// Morton. A computer oriented geodetic data base and a new technique in file sequencing. IBM 1966.
#pragma once

#include <stddef.h>
#include <stdint.h>

/// A box, cut into 1024 parts along each axis.
typedef struct FrZorder {
    double min[3], parts[3]; ///< a metre along an axis has so many parts
} FrZorder;

FrZorder fr_zorder(const double min[3], const double max[3]);
/// What fr_zorder_sort() takes: where a place stands in the order, and a number of the caller's.
uint64_t fr_zorder_item(const FrZorder *order, const double at[3], uint32_t number);
static inline uint32_t fr_zorder_number(uint64_t item) {
    return (uint32_t)item;
}
/// Sorts items by place; those of one place stay as they are. `spare` has room for as many.
void fr_zorder_sort(uint64_t *items, uint64_t *spare, size_t count);
