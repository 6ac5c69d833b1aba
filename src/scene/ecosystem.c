/// Plants that grow bud by bud: from a document's seeds, solids and particles to a growth, and from
/// that to plants of the scene.
#include "scene/ecosystem.h"

#include "scene/contents.h"
#include "scene/floating.h"
#include "scene/habitat.h"
#include "scene/particles.h"
#include "scene/reaching.h"
#include "scene/sunken.h"

#include <string.h>

struct FrEcosystem {
    const FrDocument *document;
    int64_t seed;
    uint32_t history;
    GPtrArray *definitions; ///< FrPlantDef * of species, in the order of the document
    FrSpecies *species;     ///< as many
    FrDistance **envelopes; ///< as many; NULL
    GArray *seeds;          ///< FrSeed
    GArray *plants;         ///< uint32_t: the scene's plant of each seed
    GHashTable *ids;        ///< of seeds, each to 1 if it is the previous one's and not placed yet
    FrEcosystem *previous;  ///< to go on from, borrowed; NULL
    FrGrowth *growth;       ///< NULL before it begins
    FrDigest world;         ///< of what stood in the way when it began
};

void fr_ecosystem_free(FrEcosystem *ecosystem) {
    if (ecosystem == NULL) {
        return;
    }
    fr_growth_free(ecosystem->growth);
    fr_habitat_drop_species(ecosystem->species, ecosystem->envelopes, ecosystem->definitions->len);
    g_ptr_array_unref(ecosystem->definitions);
    g_array_unref(ecosystem->seeds);
    g_array_unref(ecosystem->plants);
    g_hash_table_unref(ecosystem->ids);
    g_free(ecosystem);
}

FrGrowth *fr_ecosystem_growth(const FrEcosystem *ecosystem) {
    return ecosystem->growth;
}

uint32_t fr_ecosystem_history(const FrEcosystem *ecosystem) {
    return ecosystem->history;
}

bool fr_ecosystem_is_empty(const FrEcosystem *ecosystem) {
    return ecosystem->seeds->len == 0;
}

void fr_ecosystem_mark(const FrEcosystem *ecosystem, uint8_t *is_growing) {
    for (guint i = 0; i < ecosystem->plants->len; i++) {
        is_growing[g_array_index(ecosystem->plants, uint32_t, i)] = 1;
    }
}

// ---- seeds ------------------------------------------------------------------------------------

static void list_definitions(FrEcosystem *ecosystem) {
    const GPtrArray *plants = fr_document_plants(ecosystem->document);
    g_ptr_array_set_size(ecosystem->definitions, 0);
    for (guint i = 0; i < plants->len; i++) {
        FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (plant->kind == FR_PLANT_SPECIES) {
            g_ptr_array_add(ecosystem->definitions, plant);
        }
    }
}

/// Adds a seed, and an empty plant of the scene for it.
static void add_seed(FrEcosystem *ecosystem, FrScene *scene, const FrSeed *seed,
                     const FrStand *from, bool is_old) {
    // Of an old one, the number of its stand and 1.
    g_hash_table_insert(ecosystem->ids, g_memdup2(&seed->id, sizeof seed->id),
                        GUINT_TO_POINTER(is_old ? scene->stands->len + 1 : 0));
    g_array_append_val(ecosystem->seeds, *seed);
    g_array_append_val(ecosystem->plants, scene->plants->len);
    const FrPlantDef *definition = g_ptr_array_index(ecosystem->definitions, seed->species);
    FrScenePlant made = {.plant = fr_plant_new(definition->id)};
    made.by_component = g_new0(uint64_t, 1);
    // A plant grows where it stands: upright, and of its own size.
    FrStand stand = {.plant = scene->plants->len,
                     .scale = 1,
                     .origin = from == NULL ? 0 : from->origin,
                     .number = from == NULL ? 0 : from->number};
    memcpy(stand.at, seed->at, sizeof stand.at);
    g_array_append_val(scene->plants, made);
    g_array_append_val(scene->stands, stand);
}

FrEcosystem *fr_ecosystem_new(const FrDocument *document, int64_t seed, uint32_t history,
                              FrEcosystem *previous, FrScene *scene) {
    FrEcosystem *made = g_new0(FrEcosystem, 1);
    *made = (FrEcosystem){.document = document,
                          .seed = seed,
                          .history = history,
                          .definitions = g_ptr_array_new(),
                          .seeds = g_array_new(FALSE, FALSE, sizeof(FrSeed)),
                          .plants = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
                          .ids = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL),
                          .previous = previous};
    list_definitions(made);
    uint32_t old = previous == NULL ? 0 : fr_growth_plant_count(previous->growth);
    for (uint32_t i = 0; i < old; i++) {
        FrSeed seed_of = fr_growth_seed(previous->growth, i);
        if (seed_of.species < made->definitions->len) {
            add_seed(made, scene, &seed_of, NULL, true);
        }
    }
    return made;
}

void fr_ecosystem_add(FrEcosystem *ecosystem, FrScene *scene, const FrPlaced *placed) {
    FrSeed seed = {.id = placed->key, .span = placed->span};
    memcpy(seed.at, placed->stand.at, sizeof seed.at);
    gpointer old;
    while (g_hash_table_lookup_extended(ecosystem->ids, &seed.id, NULL, &old)) {
        if (old != NULL) { // it stands there already
            FrStand *stand = &g_array_index(scene->stands, FrStand, GPOINTER_TO_UINT(old) - 1);
            stand->origin = placed->stand.origin;
            stand->number = placed->stand.number;
            g_hash_table_insert(ecosystem->ids, g_memdup2(&seed.id, sizeof seed.id), NULL);
            return;
        }
        seed.id = fr_key_child(seed.id, 1); // two of a kind at one place
    }
    guint index;
    bool is_known = g_ptr_array_find(ecosystem->definitions, placed->plant, &index);
    FR_ASSERT(is_known);
    seed.species = index;
    add_seed(ecosystem, scene, &seed, &placed->stand, false);
}

// ---- the habitat ------------------------------------------------------------------------------

/// All that stands in the scene and does not grow bud by bud.
static FrStatus add_solids(const FrEcosystem *ecosystem, FrHabitat *habitat, const FrScene *scene,
                           const FrHills *hills, const FrContext *context) {
    FrStatus status = fr_habitat_add_surroundings(habitat, scene, hills, context);
    uint8_t *is_growing = g_new0(uint8_t, scene->plants->len + 1);
    fr_ecosystem_mark(ecosystem, is_growing);
    for (guint i = 0; i < fr_scene_stand_count(scene) && status == FR_OK; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        if (!is_growing[stand->plant] && plant != NULL) {
            status = fr_solids_add_plant(&habitat->solids, plant, stand, context);
        }
    }
    g_free(is_growing);
    return status;
}

static void remember_steps(const FrEcosystem *ecosystem, FrHabitat *habitat) {
    FrGrowthParams *params = &habitat->setup.params;
    params->history = MAX(params->history, (int64_t)ecosystem->history);
}

/// Species of which no seed stands have no say in how wide cells are; where there is no seed yet,
/// all of them have.
static void mark_absent(const FrEcosystem *ecosystem, FrHabitat *habitat) {
    for (guint i = 0; i < habitat->setup.species_count; i++) {
        habitat->species[i].is_absent = ecosystem->seeds->len > 0;
    }
    for (guint i = 0; i < ecosystem->seeds->len; i++) {
        habitat->species[g_array_index(ecosystem->seeds, FrSeed, i).species].is_absent = false;
    }
}

static FrHabitat set_up(const FrEcosystem *ecosystem, const FrScene *scene) {
    FrHabitat habitat = fr_habitat_new(ecosystem->document, ecosystem->seed, scene);
    mark_absent(ecosystem, &habitat);
    remember_steps(ecosystem, &habitat);
    return habitat;
}

/// Hands the species on: the growth borrows what they point to.
static void keep_species(FrEcosystem *ecosystem, FrHabitat *habitat) {
    fr_habitat_drop_species(ecosystem->species, ecosystem->envelopes, ecosystem->definitions->len);
    ecosystem->species = habitat->species;
    ecosystem->envelopes = habitat->envelopes;
    habitat->species = NULL;
    habitat->envelopes = NULL;
    fr_habitat_clear(habitat);
}

/// Those of a previous growth are there already.
static FrStatus add_particles(FrEcosystem *ecosystem, guint first, const FrContext *context) {
    GArray *particles;
    FrStatus status =
        fr_particles_strewn(fr_document_growth(ecosystem->document), first, context, &particles);
    if (status == FR_OK) {
        status = fr_growth_add_particles(ecosystem->growth,
                                         (const FrParticle *)(const void *)particles->data,
                                         particles->len, context);
    }
    g_clear_pointer(&particles, g_array_unref);
    return status;
}

/// Diagnostics of a growth, which knows no places, get that of `<growth>`.
typedef struct Told {
    FrContext context;
    const FrContext *outer;
} Told;

static Told listen(const FrContext *context) {
    Told told = {*context, context};
    told.context.diags = fr_diags_new();
    return told;
}

static void tell(Told *told, const FrDocument *document) {
    FrSpan span = fr_document_growth(document)->span;
    span = span.source == NULL ? fr_document_span(document) : span;
    for (size_t i = 0; i < fr_diags_count(told->context.diags); i++) {
        const FrDiag *diag = fr_diags_get(told->context.diags, i);
        fr_diags_add(told->outer->diags, diag->severity, diag->code,
                     diag->span.source == NULL ? span : diag->span, "%s", diag->text);
    }
    fr_diags_free(told->context.diags);
}

static FrStatus check_previous(const FrEcosystem *ecosystem, const FrContext *context) {
    const FrEcosystem *previous = ecosystem->previous;
    double cell = fr_document_growth(ecosystem->document)->params.cell;
    if (previous->definitions->len != ecosystem->definitions->len ||
        fr_document_growth(previous->document)->params.cell != cell) {
        fr_diags_add(context->diags, FR_ERROR, "other-world", (FrSpan){0},
                     "a growth goes on with as many species and cells as wide as it began with");
        return FR_ERR_DOCUMENT;
    }
    return FR_OK;
}

/// Takes over the growth of the previous one, or makes one.
static FrStatus make_growth(FrEcosystem *ecosystem, FrHabitat *habitat, const FrContext *context) {
    FrEcosystem *previous = ecosystem->previous;
    if (previous == NULL) {
        return fr_growth_new(fr_habitat_setup(habitat), context, &ecosystem->growth);
    }
    FrStatus status = check_previous(ecosystem, context);
    if (status == FR_OK) {
        status = fr_growth_change(previous->growth, fr_habitat_setup(habitat), context);
    }
    if (status == FR_OK) {
        ecosystem->growth = previous->growth;
        previous->growth = NULL;
    }
    return status;
}

/// Which seeds from the `first` on lie too deep in the ground, or stand on nothing: on none of the
/// obstacles of `setup` either, NULL where not all are known.
static void tell_ground(const FrEcosystem *ecosystem, uint32_t first, const FrScene *scene,
                        const FrHills *hills, const FrGrowthSetup *setup,
                        const FrContext *context) {
    if (first == ecosystem->seeds->len) {
        return;
    }
    const FrSeed *seeds = (const FrSeed *)(const void *)ecosystem->seeds->data + first;
    uint32_t count = ecosystem->seeds->len - first;
    fr_sunken_tell(seeds, count, ecosystem->definitions, scene, hills, context);
    if (setup != NULL) {
        fr_floating_tell(seeds, count, ecosystem->definitions, scene, hills, setup, context);
    }
}

static FrStatus begin(FrEcosystem *ecosystem, const FrScene *scene, const FrHills *hills,
                      const FrContext *context) {
    FrHabitat habitat = set_up(ecosystem, scene);
    FrStatus status = add_solids(ecosystem, &habitat, scene, hills, context);
    if (status != FR_OK) {
        fr_habitat_clear(&habitat);
        return status;
    }
    const FrEcosystem *previous = ecosystem->previous;
    guint old_particles =
        previous == NULL ? 0 : fr_document_growth(previous->document)->particles->len;
    status = make_growth(ecosystem, &habitat, context);
    ecosystem->world = fr_solids_digest(&habitat.solids);
    uint32_t old = status == FR_OK ? fr_growth_plant_count(ecosystem->growth) : 0;
    if (status == FR_OK) {
        tell_ground(ecosystem, old, scene, hills, fr_habitat_setup(&habitat), context);
    }
    keep_species(ecosystem, &habitat);
    if (status == FR_OK) {
        const FrSeed *seeds = (const FrSeed *)(const void *)ecosystem->seeds->data;
        status = fr_growth_add_seeds(ecosystem->growth, seeds + old, ecosystem->seeds->len - old,
                                     context);
    }
    return status == FR_OK ? add_particles(ecosystem, old_particles, context) : status;
}

FrStatus fr_ecosystem_begin(FrEcosystem *ecosystem, const FrScene *scene, const FrHills *hills,
                            const FrContext *context) {
    Told told = listen(context);
    FrStatus status = begin(ecosystem, scene, hills, &told.context);
    tell(&told, ecosystem->document);
    FrEcosystem *previous = ecosystem->previous;
    if (status != FR_OK && previous != NULL && previous->growth == NULL) {
        // The growth goes back, with the species that it borrows by now.
        previous->growth = g_steal_pointer(&ecosystem->growth);
        fr_habitat_drop_species(previous->species, previous->envelopes, previous->definitions->len);
        previous->species = g_steal_pointer(&ecosystem->species);
        previous->envelopes = g_steal_pointer(&ecosystem->envelopes);
    }
    return status;
}

FrStatus fr_ecosystem_check(const FrEcosystem *ecosystem, const FrScene *scene,
                            const FrHills *hills, const FrContext *context) {
    if (ecosystem->definitions->len == 0) {
        return FR_OK;
    }
    FrHabitat habitat = set_up(ecosystem, scene);
    FrStatus status = fr_habitat_add_surroundings(&habitat, scene, hills, context);
    Told told = listen(context);
    if (status == FR_OK) {
        // Other plants, which seeds may stand on, are not made here.
        bool is_all = fr_scene_stand_count(scene) == ecosystem->seeds->len;
        tell_ground(ecosystem, 0, scene, hills, is_all ? fr_habitat_setup(&habitat) : NULL,
                    &told.context);
        status = fr_growth_check(fr_habitat_setup(&habitat),
                                 (const FrSeed *)(const void *)ecosystem->seeds->data,
                                 ecosystem->seeds->len, &told.context);
    }
    if (status == FR_OK) {
        status = fr_particles_check(fr_document_growth(ecosystem->document), 0, &told.context);
    }
    tell(&told, ecosystem->document);
    fr_habitat_clear(&habitat);
    return status;
}

FrStatus fr_ecosystem_renew(FrEcosystem *ecosystem, const FrScene *scene, const FrHills *hills,
                            const FrContext *context) {
    FrHabitat habitat = fr_habitat_without_species(ecosystem->document, ecosystem->seed, scene);
    habitat.setup.species_count = ecosystem->definitions->len;
    remember_steps(ecosystem, &habitat);
    FrStatus status = add_solids(ecosystem, &habitat, scene, hills, context);
    if (status == FR_OK) {
        Told told = listen(context);
        status = fr_growth_change(ecosystem->growth, fr_habitat_setup(&habitat), &told.context);
        tell(&told, ecosystem->document);
    }
    fr_habitat_clear(&habitat);
    return status;
}

// ---- growing ----------------------------------------------------------------------------------

FrStatus fr_ecosystem_step(FrEcosystem *ecosystem, FrScene *scene, const FrContext *context) {
    gint64 began = g_get_monotonic_time();
    Told told = listen(context);
    FrStatus status = fr_growth_step(ecosystem->growth, &told.context);
    tell(&told, ecosystem->document);
    if (status != FR_OK) {
        return status;
    }
    FrGrowthStats stats = fr_growth_stats_on(ecosystem->growth, context->pool);
    FrSceneStep step = {.step = stats.step,
                        .seconds = (double)(g_get_monotonic_time() - began) * 1e-6,
                        .light_seconds = stats.light_seconds,
                        .nodes = stats.nodes,
                        .organs = stats.leaves,
                        .grows_buds = true,
                        .active_buds = stats.active_buds,
                        .shed = stats.shed,
                        .collisions = stats.collisions,
                        .digest = stats.digest};
    g_array_append_val(scene->steps, step);
    scene->light_seconds += stats.light_seconds;
    return FR_OK;
}

/// Shows plants where they stand, or farther from the middle of all.
static void stand_apart(const FrEcosystem *ecosystem, FrScene *scene) {
    uint32_t count = fr_growth_plant_count(ecosystem->growth);
    double(*shifts)[2] = fr_growth_spread(ecosystem->growth, scene->params->apart);
    GHashTable *seeds = g_hash_table_new(NULL, NULL); // of the scene's plants, and one more
    for (uint32_t i = 0; i < count; i++) {
        uint32_t plant = g_array_index(ecosystem->plants, uint32_t, i);
        g_hash_table_insert(seeds, GUINT_TO_POINTER(plant), GUINT_TO_POINTER(i + 1));
    }
    for (guint i = 0; i < scene->stands->len; i++) {
        FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        guint found = GPOINTER_TO_UINT(g_hash_table_lookup(seeds, GUINT_TO_POINTER(stand->plant)));
        if (found != 0) {
            FrSeed seed = fr_growth_seed(ecosystem->growth, found - 1);
            for (int axis = 0; axis < 2; axis++) {
                stand->at[axis] = seed.at[axis] + shifts[found - 1][axis];
            }
        }
    }
    g_hash_table_unref(seeds);
    g_free(shifts);
}

/// Tells stands whose seeds wait.
static void note_waiting(const FrEcosystem *ecosystem, FrScene *scene) {
    bool *waits = g_new0(bool, scene->plants->len + 1u);
    for (guint i = 0; i < fr_growth_plant_count(ecosystem->growth); i++) {
        waits[g_array_index(ecosystem->plants, uint32_t, i)] =
            fr_growth_is_waiting(ecosystem->growth, i);
    }
    for (guint i = 0; i < scene->stands->len; i++) {
        FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        stand->is_waiting = waits[stand->plant];
    }
    g_free(waits);
}

FrStatus fr_ecosystem_draw(const FrEcosystem *ecosystem, FrScene *scene, const FrContext *context,
                           GPtrArray *old) {
    uint64_t bytes = 0;
    FrStatus status = FR_OK;
    for (guint i = 0; i < fr_growth_plant_count(ecosystem->growth) && status == FR_OK; i++) {
        FrPlant *drawn;
        status = fr_growth_plant(ecosystem->growth, i, context, &drawn);
        if (status != FR_OK) {
            break;
        }
        uint32_t index = g_array_index(ecosystem->plants, uint32_t, i);
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, index);
        g_ptr_array_add(old, plant->plant);
        g_free(plant->by_component);
        plant->plant = drawn;
        plant->by_component = g_new0(uint64_t, drawn->components->len + 1);
        bytes = fr_count_add(bytes, fr_plant_bytes(drawn));
        status = fr_limit_check(bytes, context->limits.bytes, "bytes", "the scene",
                                fr_document_span(ecosystem->document), context->diags);
    }
    note_waiting(ecosystem, scene);
    if (scene->params->apart > 0) {
        stand_apart(ecosystem, scene);
    }
    return status;
}

void fr_ecosystem_tell_grown(const FrEcosystem *ecosystem, const FrScene *scene,
                             const FrContext *context) {
    Told told = listen(context);
    const FrSeeds seeds = {
        .at = (const FrSeed *)(const void *)ecosystem->seeds->data,
        .plants = (const uint32_t *)(const void *)ecosystem->plants->data,
        .count = ecosystem->seeds->len,
        .definitions = ecosystem->definitions,
    };
    fr_reaching_tell(scene, &seeds, &told.context);
    fr_growth_tell_bare(ecosystem->growth, seeds.at, &told.context);
    tell(&told, ecosystem->document);
}

FrDigest fr_ecosystem_digest(const FrEcosystem *ecosystem) {
    FrDigest digest = fr_contents_digest(ecosystem->world, ecosystem->document);
    return fr_digest(digest, &ecosystem->seed, sizeof ecosystem->seed);
}

// ---- alone ------------------------------------------------------------------------------------

static FrStatus run_alone(const FrGrowthSetup *setup, uint64_t seed, const FrContext *context,
                          FrPlant **plant) {
    FrGrowth *growth;
    FrStatus status = fr_growth_new(setup, context, &growth);
    const FrSeed one = {.id = fr_key_root(seed)};
    if (status == FR_OK) {
        status = fr_growth_add_seeds(growth, &one, 1, context);
    }
    for (int64_t i = 0; i < setup->params.steps && status == FR_OK; i++) {
        status = fr_growth_step(growth, context);
        status =
            status == FR_OK && fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : status;
    }
    if (status == FR_OK) {
        status = fr_growth_plant(growth, 0, context, plant);
    }
    fr_growth_free(growth);
    return status;
}

FrStatus fr_ecosystem_grow_alone(const FrDocument *document, const FrPlantDef *definition,
                                 uint64_t seed, const FrContext *context, FrPlant **plant) {
    *plant = NULL;
    FrHabitat habitat = fr_habitat_of_one(document, definition);
    Told told = listen(context);
    FrStatus status = run_alone(fr_habitat_setup(&habitat), seed, &told.context, plant);
    tell(&told, document);
    fr_habitat_clear(&habitat);
    return status;
}
