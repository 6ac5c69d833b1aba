/// @file kept.h
/// A build that is kept, so that the next one can take over what a change did not reach.
///
/// Instances of the new build have *twins* in the last one: rows of the level of the same depth
/// that were made from the same. Twins are found from the roots on: a child of a twin is a twin if
/// its stage depends on the same as before (depend.h). Twins are copied (twin.c), all others are
/// made. If every instance has its twin in its own place, nothing is copied: both builds share the
/// rows.
#pragma once

#include "pgraph/expand.h"

/// What an expansion fills: the long columns, and the levels that they came from.
typedef struct FrRows {
    gatomicrefcount references;
    FrNodes nodes;
    FrAxes axes;
    FrOrgans organs;
    FrBuds buds;
    GArray *deformers; ///< FrDeformer
    GArray *levels;    ///< FrLevel, whose counts have become indices
} FrRows;

struct FrPgraphBuild {
    FrPlant *plant; ///< its columns belong to `rows`
    FrRows *rows;
    FrPgraphCounts counts;
    FrUnrolled unrolled;
    FrDigest inputs;     ///< what every instance depends on
    FrDigest *stages;    ///< by stage: what its instances depend on besides
    FrDigest tables;     ///< the indices that rows hold: of shapes, profiles, materials …
    bool has_own_shapes; ///< of single leaves, besides those of components
    bool has_faults;     ///< expressions without value: warned of anew by a whole build only
    bool is_changed;     ///< its rows were, once all were there: nothing can be taken over from it
    FrLimits limits;
    uint64_t taken_over; ///< instances
};

/// How the stages of a build and of the last one correspond.
typedef struct FrTwins {
    const FrPgraphBuild *last;
    uint32_t *was;    ///< by stage: the last build's; FR_NONE
    uint32_t *is_now; ///< by stage of the last build; FR_NONE
    bool *is_same;    ///< by stage: its instances depend on what they depended on
    bool is_all;      ///< every instance has a twin in its own place
} FrTwins;

/// Fills in what `made` depends on, once its components have been prepared, and finds the stages
/// that are as they were. `last` may be NULL.
void fr_kept_begin(FrPgraphBuild *made, const FrBuild *build, const FrPgraphBuild *last,
                   FrTwins *twins);
void fr_twins_clear(FrTwins *twins);
/// What an instance of a component of `graph` took to make when the last build was made; NAN.
double fr_kept_seconds(const FrPgraphBuild *last, const FrPgraph *graph, uint32_t component);
/// Gives `made` the rows of the last build instead of its own.
void fr_kept_share_rows(FrPgraphBuild *made, const FrPgraphBuild *last);
/// Takes the columns of made->plant into rows of its own, with the levels.
void fr_kept_own_rows(FrPgraphBuild *made, GArray *levels);

// ---- twin.c: rows that are copied --------------------------------------------------------------

/// Gives the instances of the first level their twins.
void fr_twins_of_roots(const FrExpansion *expansion);
/// Counts of an instance that has a twin.
void fr_twin_measure(const FrExpansion *expansion, uint32_t row);
/// How many children it has.
uint32_t fr_twin_children(const FrExpansion *expansion, uint32_t row);
/// How many instances from `row` on, before `end`, can be copied at once; 0: it is to be made.
uint32_t fr_twin_run(const FrExpansion *expansion, uint32_t row, uint32_t end);
/// Copies what the twins of `count` instances made, to where these have their place.
void fr_twin_copy(const FrExpansion *expansion, uint32_t row, uint32_t count,
                  FrEvaluator *evaluator);
/// Gives the children of an instance that has been made although it has a twin theirs.
void fr_twin_pass_on(const FrExpansion *expansion, uint32_t row);
