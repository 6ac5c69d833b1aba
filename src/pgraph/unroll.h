/// @file unroll.h
/// The p-graph with its recursions unrolled: no way leads back any more.
///
/// A *stage* is a prototype together with how often each counted member of its recursion stands on
/// the path from the root. All instances of a stage make the same children, so recursion, leaf
/// links and depth are settled here once, and expansion only follows a table. It also tells how
/// many instances there will be at least, before the first is made.
#pragma once

#include "pgraph/recursion.h"

typedef struct FrStageLink {
    uint32_t stage; ///< what it makes
    FrLinkKind kind;
    char symbol; ///< for FR_LINK_SYMBOL
} FrStageLink;

typedef struct FrStage {
    uint32_t component;
    uint32_t first_link, link_count; ///< into `links`
    uint32_t generation; ///< within its recursion, from 0; FR_NONE: as the instance it follows
    bool is_further;     ///< a second or later generation
} FrStage;

typedef struct FrUnrolled {
    GArray *stages;       ///< FrStage
    GArray *links;        ///< FrStageLink
    GArray *roots;        ///< uint32_t, stages
    GArray *replacements; ///< uint32_t, by edit: the stage that stands in for another, FR_NONE
} FrUnrolled;

/// Fails by a limit if there are more stages than a plant could use.
FrStatus fr_unroll(FrUnrolled *unrolled, const FrPgraph *graph, const FrRecursions *recursions,
                   const FrContext *context);
void fr_unrolled_clear(FrUnrolled *unrolled);
/// At least so many instances come of it, counting `multiplicity[c]` children for every link that
/// component c multiplies. Stops at UINT64_MAX. *culprit is the stage with the most.
uint64_t fr_unrolled_least(const FrUnrolled *unrolled, const FrPgraph *graph,
                           const uint64_t *multiplicity, const bool *is_flagged, uint32_t *culprit);
/// Whether component c of that kind makes several children for a link.
static inline bool fr_link_is_multiplied(FrComponentKind from, FrLinkKind link) {
    return fr_is_spreading(from) || link == FR_LINK_SYMBOL ||
           (from == FR_COMPONENT_TREE && link == FR_LINK_BRANCH);
}
