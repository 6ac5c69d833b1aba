/// @file lsystem/match.h
/// Which production applies to a module, contexts and all.
#pragma once

#include "lsystem/vm.h"

/// Where each module of a string begins, and the partner of each bracket.
typedef struct FrLindex {
    const uint32_t *words;
    uint32_t *at;      ///< word of module i
    uint32_t *partner; ///< of a bracket: the other one; FR_NONE
    uint32_t modules;
} FrLindex;

/// The modules of the old string that contexts are read from. `before` is the first module that
/// is replaced, `behind` the one after the last.
typedef struct FrLsite {
    const FrLindex *index; ///< NULL: no production has a context
    uint32_t before, behind;
} FrLsite;

/// What a search works with.
typedef struct FrLmatcher {
    FrLmachine *machine;
    const FrLunit *unit;
    const FrLproduction *productions;
    const FrLpattern *patterns;
    const FrLformal *formals;
} FrLmatcher;

void fr_lindex_build(FrLindex *index, const uint32_t *words, uint64_t count, uint64_t modules);
void fr_lindex_clear(FrLindex *index);
FrLmatcher fr_lmatcher(const FrLsystem *system, FrLmachine *machine, const FrLunit *unit);

/// The first production of the section that applies to the modules from `here` on (before `end`);
/// NULL for none. Its parameters are bound. `taken` receives the words of the predecessor.
const FrLproduction *fr_lmatch_first(const FrLmatcher *matcher, const FrLsection *section,
                                     const uint32_t *here, const uint32_t *end, const FrLsite *site,
                                     uint32_t *taken);
/// One of all that apply, by their weights; `draw` is uniform in [0, 1). Its parameters are bound,
/// and what its block changed is kept.
const FrLproduction *fr_lmatch_random(const FrLmatcher *matcher, const FrLsection *section,
                                      const uint32_t *here, const uint32_t *end,
                                      const FrLsite *site, double draw, uint32_t *taken);
/// Binds the parameters of a production that is known to apply.
void fr_lmatch_bind(const FrLmatcher *matcher, const FrLproduction *production,
                    const uint32_t *here, const uint32_t *end, const FrLsite *site);
/// Writes the successor to `out`, which has room for production->word_count words.
void fr_lmatch_produce(const FrLmatcher *matcher, const FrLproduction *production, uint32_t *out);
