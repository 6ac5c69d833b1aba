/// From a document's species, sun and surroundings to what a growth is set up with.
#include "scene/habitat.h"

#include "frond/daylight.h"

#include <string.h>

void fr_habitat_drop_species(FrSpecies *species, FrDistance **envelopes, guint count) {
    for (guint i = 0; i < count && species != NULL; i++) {
        fr_params_clear(fr_species_table(), &species[i].params);
        fr_distance_free(envelopes[i]);
    }
    g_free(species);
    g_free(envelopes);
}

static FrSpecies make_species(const FrPlantDef *definition, FrDistance **envelope) {
    const FrSpeciesDef *def = definition->species;
    FrSpecies species = {.name = definition->id,
                         .order_count = def->order_count,
                         .bark = def->bark,
                         .leaf = def->leaf};
    fr_params_copy(fr_species_table(), &species.params, &def->params);
    fr_species_apply_sliders(&def->sliders, &species.params);
    memcpy(species.orders, def->orders, sizeof species.orders);
    if (def->envelope != NULL) {
        *envelope = fr_distance_new(def->envelope->positions, def->envelope->vertex_count,
                                    def->envelope->indices, def->envelope->index_count);
    }
    species.envelope = *envelope;
    return species;
}

void fr_habitat_clear(FrHabitat *habitat) {
    fr_habitat_drop_species(habitat->species, habitat->envelopes, habitat->setup.species_count);
    g_free(habitat->suns);
    fr_solids_clear(&habitat->solids);
}

static void find_suns(FrHabitat *habitat, const FrScene *scene) {
    FrGrowthParams *params = &habitat->setup.params;
    if (params->suns == 0) {
        return;
    }
    const FrSunParams *sun = &scene->surroundings->sun;
    FrSunPath path =
        fr_light_sun_path(sun->latitude, scene->params->sun_azimuth, scene->params->sun_elevation);
    habitat->suns = g_new(vec3s, (size_t)params->suns);
    params->suns = (int64_t)fr_light_sun_places(path, (size_t)params->suns, habitat->suns);
    habitat->setup.suns = habitat->suns;
}

FrHabitat fr_habitat_without_species(const FrDocument *document, int64_t seed,
                                     const FrScene *scene) {
    FrHabitat habitat = {.setup = {.params = fr_document_growth(document)->params},
                         .solids = fr_solids_new()};
    FrGrowthParams *params = &habitat.setup.params;
    params->seed = seed < 0 ? params->seed : seed % 1000000000;
    find_suns(&habitat, scene);
    return habitat;
}

FrHabitat fr_habitat_new(const FrDocument *document, int64_t seed, const FrScene *scene) {
    FrHabitat habitat = fr_habitat_without_species(document, seed, scene);
    guint count = 0;
    const GPtrArray *plants = fr_document_plants(document);
    habitat.species = g_new0(FrSpecies, plants->len + 1);
    habitat.envelopes = g_new0(FrDistance *, plants->len + 1);
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (plant->kind == FR_PLANT_SPECIES) {
            habitat.species[count] = make_species(plant, &habitat.envelopes[count]);
            count++;
        }
    }
    habitat.setup.species = habitat.species;
    habitat.setup.species_count = count;
    return habitat;
}

FrHabitat fr_habitat_of_one(const FrDocument *document, const FrPlantDef *definition) {
    FrHabitat habitat = {
        .setup = {.params = fr_document_growth(document)->params, .species_count = 1},
        .species = g_new0(FrSpecies, 1),
        .envelopes = g_new0(FrDistance *, 1),
        .solids = fr_solids_new()};
    habitat.species[0] = make_species(definition, &habitat.envelopes[0]);
    habitat.setup.species = habitat.species;
    habitat.setup.params.suns = 0;
    const vec3s box[2] = {habitat.setup.params.min, habitat.setup.params.max};
    fr_solids_add_level(&habitat.solids, box);
    return habitat;
}

FrStatus fr_habitat_add_surroundings(FrHabitat *habitat, const FrScene *scene, const FrHills *hills,
                                     const FrContext *context) {
    const vec3s box[2] = {habitat->setup.params.min, habitat->setup.params.max};
    return fr_solids_add_surroundings(&habitat->solids, scene, hills, box, context);
}

const FrGrowthSetup *fr_habitat_setup(FrHabitat *habitat) {
    habitat->setup.obstacles = (const FrGrowthObstacle *)(const void *)habitat->solids.all->data;
    habitat->setup.obstacle_count = habitat->solids.all->len;
    return &habitat->setup;
}
