/// @file habitat.h
/// What a growth is set up with, as a document says it. Private to scene.
#pragma once

#include "scene/solids.h"

/// A setup, and what of it is to be freed.
typedef struct FrHabitat {
    FrGrowthSetup setup;    ///< its obstacles are set by fr_habitat_setup()
    FrSpecies *species;     ///< in the order of the document
    FrDistance **envelopes; ///< as many; NULL
    vec3s *suns;
    FrSolids solids;
} FrHabitat;

/// All but the solids. `seed` < 0: that of the document.
FrHabitat fr_habitat_new(const FrDocument *document, int64_t seed, const FrScene *scene);
/// The same for a growth that keeps its species.
FrHabitat fr_habitat_without_species(const FrDocument *document, int64_t seed,
                                     const FrScene *scene);
/// One species alone on level ground, under a sky without sun.
FrHabitat fr_habitat_of_one(const FrDocument *document, const FrPlantDef *definition);
/// Its species are freed unless they were taken out.
void fr_habitat_clear(FrHabitat *habitat);
/// Frees species that were taken out of a habitat; NULL: none.
void fr_habitat_drop_species(FrSpecies *species, FrDistance **envelopes, guint count);
/// Adds the ground and all obstacles.
FR_MUST_USE FrStatus fr_habitat_add_surroundings(FrHabitat *habitat, const FrScene *scene,
                                                 const FrHills *hills, const FrContext *context);
/// The setup with all solids so far; borrowed, until one more is added.
const FrGrowthSetup *fr_habitat_setup(FrHabitat *habitat);
