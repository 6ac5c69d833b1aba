/// @file growing_parts.h
/// What the files of growing plants share. Private to them.
#pragma once

#include "scene/answers.h"
#include "scene/clearance.h"
#include "scene/growing.h"

/// One plant.
typedef struct FrSprout {
    const FrPlantDef *definition;
    char *id; ///< of the definition, which may end before the plant does
    FrLderivation *derivation;
    FrStand stand;
    uint32_t plant; ///< of the scene
    int64_t seed;
    FrAnswers answers; ///< to its open symbols so far
    FrPlant *ahead;    ///< it as it is now, drawn for others before its own next step; NULL
    FrLdrawn drawn;    ///< of that
} FrSprout;

struct FrGrowing {
    GPtrArray *sprouts;     ///< FrSprout *
    FrLighting *lighting;   ///< NULL: the scene has no light of its own
    FrClearance *clearance; ///< NULL: nobody asks for it
    uint64_t steps;         ///< at most
    uint64_t queries;       ///< answered in this step
    uint64_t done;          ///< steps
    FrEnvironment environment;
    FrSprout *asking;
    bool is_regrowing; ///< answers are those of before
    FrGrowingWatch watch;
};

void fr_sprout_free(void *sprout);
/// A plant at its axiom.
FR_MUST_USE FrStatus fr_growing_derive(const FrGrowing *growing, const FrPlantDef *definition,
                                       int64_t seed, const FrContext *context,
                                       FrLderivation **derivation);
/// Derives a plant to a step, by its answers alone and with all of them. FR_ERR_DOCUMENT if they
/// are others, or it does not come to `string` (NULL: to any).
FR_MUST_USE FrStatus fr_growing_regrow(FrGrowing *growing, FrSprout *sprout, uint64_t step,
                                       const FrDigest *string, const FrContext *context);
/// Answers open symbols of the plant that asks, anew or as they were (FrEnvironment).
FrStatus fr_growing_answer(void *growing, const FrLquery *queries, size_t count,
                           const FrContext *context);
