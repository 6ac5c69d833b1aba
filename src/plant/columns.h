/// @file columns.h
/// The columns of a plant's four tables as data, so that growing, copying, compacting, measuring
/// and hashing are one loop each over all of them.
#pragma once

#include "frond/plant.h"

/// What a fresh row holds.
typedef enum FrColumnFill {
    FR_FILL_ZERO,
    FR_FILL_NONE,     ///< FR_NONE
    FR_FILL_ONE,      ///< 1.0f
    FR_FILL_IDENTITY, ///< the rotation that does nothing
} FrColumnFill;

typedef struct FrColumn {
    size_t offset; ///< of the pointer in its table's struct
    size_t width;  ///< bytes a row
    FrColumnFill fill;
    bool is_cache; ///< can be rebuilt, so no part of the digest
} FrColumn;

typedef struct FrColumns {
    const FrColumn *columns;
    size_t count;
} FrColumns;

/// X(field, fill, is_cache) for every column of every table.
#define FR_NODE_COLUMNS(X)                                                                         \
    X(parent, NONE, false)                                                                         \
    X(next, NONE, false)                                                                           \
    X(axis, NONE, false)                                                                           \
    X(rotation, IDENTITY, false)                                                                   \
    X(length, ZERO, false)                                                                         \
    X(radius, ZERO, false)                                                                         \
    X(flatness, ONE, false)                                                                        \
    X(birth, ZERO, false)                                                                          \
    X(flags, ZERO, false)                                                                          \
    X(position, ZERO, true)                                                                        \
    X(frame, IDENTITY, true)

#define FR_AXIS_COLUMNS(X)                                                                         \
    X(first, NONE, false)                                                                          \
    X(last, NONE, false)                                                                           \
    X(bearer, NONE, false)                                                                         \
    X(offset, ZERO, false)                                                                         \
    X(base_radius, ZERO, false)                                                                    \
    X(order, ZERO, false)                                                                          \
    X(flags, ZERO, false)                                                                          \
    X(profile, NONE, false)                                                                        \
    X(finish, NONE, false)                                                                         \
    X(material, NONE, false)                                                                       \
    X(deformer, NONE, false)                                                                       \
    X(component, NONE, false)                                                                      \
    X(path, ZERO, false)

#define FR_ORGAN_COLUMNS(X)                                                                        \
    X(node, NONE, false)                                                                           \
    X(offset, ZERO, false)                                                                         \
    X(rotation, IDENTITY, false)                                                                   \
    X(scale, ONE, false)                                                                           \
    X(shape, NONE, false)                                                                          \
    X(material, NONE, false)                                                                       \
    X(birth, ZERO, false)                                                                          \
    X(flags, ZERO, false)                                                                          \
    X(deformer, NONE, false)                                                                       \
    X(component, NONE, false)                                                                      \
    X(path, ZERO, false)

#define FR_BUD_COLUMNS(X)                                                                          \
    X(node, NONE, false)                                                                           \
    X(kind, ZERO, false)                                                                           \
    X(state, ZERO, false)                                                                          \
    X(dormancy, ZERO, false)                                                                       \
    X(direction, ZERO, false)                                                                      \
    X(id, ZERO, false)

/// Numbers of columns: FR_NODE_AT_parent and so on.
#define FR_NODE_NUMBER(field, fill, is_cache) FR_NODE_AT_##field,
#define FR_AXIS_NUMBER(field, fill, is_cache) FR_AXIS_AT_##field,
enum { FR_NODE_COLUMNS(FR_NODE_NUMBER) };
enum { FR_AXIS_COLUMNS(FR_AXIS_NUMBER) };

extern const FrColumns fr_node_columns;
extern const FrColumns fr_axis_columns;
extern const FrColumns fr_organ_columns;
extern const FrColumns fr_bud_columns;

/// The array of one column of `table` (an FrNodes, FrAxes, FrOrgans or FrBuds).
void *fr_column_data(const void *table, const FrColumn *column);

/// Room for so many rows in all, so that appending them moves nothing.
void fr_columns_reserve(void *table, const FrColumns *columns, uint32_t capacity);
/// Appends `count` fresh rows to the table that `columns` describe; returns the first.
uint32_t fr_columns_append(void *table, const FrColumns *columns, uint32_t count);
/// The same for a caller who will write every row of the columns whose bit is set in `written`,
/// which hold anything until then.
uint32_t fr_columns_append_but(void *table, const FrColumns *columns, uint32_t count,
                               uint32_t written);
/// Appends rows that hold anything until fr_columns_fill() and the caller have written them.
void fr_columns_extend(void *table, const FrColumns *columns, uint32_t count);
/// Fills rows but for the columns whose bit is set in `written`.
void fr_columns_fill(void *table, const FrColumns *columns, uint32_t first, uint32_t count,
                     uint32_t written);
/// Makes `to` (uninitialized) a copy of `from`, without spare capacity.
void fr_columns_copy(void *to, const void *from, const FrColumns *columns);
/// Keeps row i where map[i] is not FR_NONE, moving it to map[i] ≤ i; the table then has `count`.
void fr_columns_compact(void *table, const FrColumns *columns, const uint32_t *map, uint32_t count);
void fr_columns_free(void *table, const FrColumns *columns);
uint64_t fr_columns_bytes(const void *table, const FrColumns *columns);
