/// @file expand.h
/// One build on its way, for the files that share the work of build.c.
#pragma once

#include "pgraph/graft.h"

typedef struct FrBuild {
    FrExpansion expansion;
    const FrContext *context;
    FrPgraphCounts *counts;
    const FrGraft *graft; ///< who grows grafts; NULL
    FrGrafting grafting;
    uint64_t instances;        ///< of all levels so far
    uint64_t considered;       ///< with those that flags left out
    uint64_t taken_over;       ///< from the last build
    uint8_t *has_place;        ///< by edit; owned
    uint32_t *numbers;         ///< in the i-tree, of the rows of the level before; owned; NULL
    FrPgraphBuild *made;       ///< what is kept of it; NULL: only the plant
    const FrPgraphBuild *last; ///< NULL
    GArray *levels;            ///< FrLevel, those that have been made; NULL if they are not kept
} FrBuild;

/// What a level will make.
typedef struct FrLevelSums {
    uint64_t children, considered, nodes, axes, organs, scopes, fields;
    uint32_t most_children, most_nodes, most_organs; ///< rows that make the most of each
} FrLevelSums;

/// Sums what has been measured; `children` only when they have been counted.
FrLevelSums fr_level_sum(const FrExpansion *expansion);
/// Whether the plant with one level more keeps to the limits.
FrStatus fr_build_check_level(const FrBuild *build, const FrLevelSums *sums);
/// One limit, which the instance in `row` of the level meets first.
FrStatus fr_build_check(const FrBuild *build, uint64_t wanted, uint64_t limit, const char *name,
                        uint32_t row);
/// A lower bound of instances from the numbers' ranges, so that absurd plants are refused at once.
FrStatus fr_build_check_least(const FrBuild *build);

/// Expands all levels into the plant; what was prepared must be there.
FrStatus fr_build_expand(FrBuild *build);

// record.c
/// Empty counts, with or without an i-tree as the caller asked; nothing without counts.
void fr_build_begin_counts(FrBuild *build);
/// Adds a level that has been measured to the counts.
void fr_build_record_level(FrBuild *build);
/// Warns of edits without a place, and hands on which have one.
void fr_build_finish_edits(FrBuild *build);

// faults.c
/// Reports each parameter that had no value somewhere once, first instances first.
void fr_build_report_faults(const FrBuild *build, int workers);
