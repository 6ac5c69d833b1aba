/// A document built: each plant once for every seed it stands with.
#include "scene/grow.h"
#include "scene/obstacles.h"
#include "scene/rational.h"
#include "scene/rebuild.h"
#include "scene/sampled.h"
#include "scene/sequence.h"
#include "scene/simulation.h"
#include "scene/solids.h"
#include "scene/varied.h"

#include <math.h>
#include <string.h>

typedef struct Build {
    const FrDocument *document;
    const FrContext *context;
    FrScene *scene;
    GHashTable *built;  ///< "id seed" → index into plants + 1
    GHashTable *varied; ///< FrPlantDef * → FrVaried *
    int64_t seed;       ///< < 0: as the document says
    double time;        ///< of all clocks; NAN: as the document says
    uint64_t bytes;
    FrGrowing *growing;
    FrSceneParts *parts; ///< NULL
    FrSampled *sampled;
    FrHills *hills;         ///< NULL: the ground is level
    GPtrArray *definitions; ///< FrPlantDef *, by plant of the scene
    bool is_check;          ///< nothing is sampled or grown
    uint64_t steps;         ///< of growth bud by bud
    FrSequence *sequence;   ///< NULL
    FrEcosystem *ecosystem;
} Build;

void fr_scene_plant_clear(void *data) {
    FrScenePlant *plant = data;
    fr_plant_free(plant->plant);
    g_free(plant->by_component);
    g_free(plant->seconds);
}

static char *scene_name(const char *document) {
    char *name = g_path_get_basename(document);
    if (g_str_has_suffix(name, ".frond")) {
        name[strlen(name) - strlen(".frond")] = '\0';
    }
    return name;
}

uint32_t fr_scene_plant_count(const FrScene *scene) {
    return scene->plants->len - scene->obstacles;
}

uint32_t fr_scene_stand_count(const FrScene *scene) {
    return scene->stands->len - scene->obstacles;
}

void fr_scene_free(FrScene *scene) {
    if (scene == NULL) {
        return;
    }
    g_array_unref(scene->plants);
    g_array_unref(scene->stands);
    g_clear_pointer(&scene->steps, g_array_unref);
    g_ptr_array_unref(scene->views);
    g_free(scene->name);
    g_free(scene);
}

/// < 0: the plant's own.
static int64_t seed_of(const Build *build, int64_t own_seed) {
    if (own_seed < 0 || build->seed < 0) {
        return own_seed < 0 ? build->seed : own_seed;
    }
    FrKey mixed = fr_key_child(fr_key_root((uint64_t)build->seed), (uint64_t)own_seed);
    return (int64_t)(mixed & INT64_MAX);
}

/// Adds an instance of a varied plant to the scene; its base is built once.
static FrStatus vary_plant(Build *build, const FrPlantDef *definition, uint64_t seed) {
    FrVaried *varied = g_hash_table_lookup(build->varied, definition);
    if (varied == NULL) {
        FrStatus status =
            fr_varied_new(build->document, definition, build->time, build->context, &varied);
        if (status != FR_OK) {
            return status;
        }
        g_hash_table_insert(build->varied, (void *)definition, varied);
        build->bytes = fr_count_add(build->bytes, fr_plant_bytes(varied->base));
    }
    build->bytes = fr_count_add(build->bytes, fr_plant_bytes(varied->base));
    FrStatus status = fr_limit_check(build->bytes, build->context->limits.bytes, "bytes",
                                     "the scene", definition->span, build->context->diags);
    if (status == FR_OK) {
        FrScenePlant made = fr_varied_instance(varied, seed);
        g_array_append_val(build->scene->plants, made);
    }
    return status;
}

static bool can_be_seen(const FrPlant *plant) {
    bool is_seen = false;
    for (uint32_t i = 0; i < plant->organs.count && !is_seen; i++) {
        is_seen = (plant->organs.flags[i] & (FR_SHED | FR_HIDDEN)) == 0;
    }
    for (uint32_t i = 0; i < plant->nodes.count && !is_seen; i++) {
        unsigned flags = plant->nodes.flags[i] | plant->axes.flags[plant->nodes.axis[i]];
        is_seen = plant->nodes.length[i] > 0 && (flags & (FR_SHED | FR_HIDDEN)) == 0;
    }
    return is_seen;
}

static void warn_of_nothing(const Build *build, const FrPlantDef *definition,
                            const FrPlant *plant) {
    if (!can_be_seen(plant)) {
        fr_diags_add(build->context->diags, FR_WARNING, "nothing-to-see", definition->span,
                     "nothing of the plant '%s' can be seen at this time: it has no stem, leaf or "
                     "solid, or all of them are hidden or of size 0",
                     definition->id);
    }
}

/// Builds a p-graph that takes over what it can from the last scene's.
static FrStatus rebuild_plant(Build *build, const FrPlantDef *definition, int64_t seed,
                              const char *key, FrScenePlant *made) {
    FrSceneParts *parts = build->parts;
    FrPgraphBuild *kept;
    bool is_own = (uint64_t)seed == definition->seed && isnan(build->time);
    FrPgraph *reseeded =
        is_own ? NULL
               : fr_document_reseed(build->document, definition, (uint64_t)seed, build->time);
    FrStatus status = fr_pgraph_rebuild(reseeded != NULL ? reseeded : definition->pgraph,
                                        parts->last_of(parts->data, key), build->context, &kept);
    fr_pgraph_free(reseeded);
    if (status == FR_OK) {
        const FrPgraphCounts *counts = fr_pgraph_build_counts(kept);
        FrPlant *plant = (FrPlant *)fr_pgraph_build_plant(kept);
        guint components = plant->components->len;
        *made = (FrScenePlant){plant, counts->instances, g_new0(uint64_t, components + 1), 0};
        memcpy(made->by_component, counts->by_component, components * sizeof(uint64_t));
        made->seconds = g_memdup2(counts->seconds, components * sizeof(double));
        g_array_index(parts->parts, FrScenePart, parts->parts->len - 1).build = kept;
    }
    return status;
}

/// Of a graph with grafts nobody knows all that it is made of.
static bool can_be_rebuilt(const Build *build, const FrPlantDef *definition) {
    bool is_whole = build->parts != NULL && definition->kind == FR_PLANT_PGRAPH;
    for (uint32_t c = 0; is_whole && c < fr_pgraph_count(definition->pgraph); c++) {
        is_whole = fr_pgraph_kind(definition->pgraph, c) != FR_COMPONENT_GRAFT;
    }
    return is_whole;
}

/// Builds a plant of its own; where scenes are built again and again it tells how long its
/// components take.
static FrStatus grow_plant(Build *build, const FrPlantDef *definition, int64_t seed,
                           FrScenePlant *made) {
    double request = 0;
    bool is_timed = build->parts != NULL && definition->kind == FR_PLANT_PGRAPH;
    FrPgraphCounts counts = {.seconds = is_timed ? &request : NULL};
    FrStatus status = fr_scene_grow(build->document, definition, seed, build->time, build->context,
                                    made, &counts);
    if (counts.seconds == &request) {
        counts.seconds = NULL; // it has not come to that
    }
    if (status == FR_OK && counts.seconds != NULL) {
        guint components = made->plant->components->len;
        guint known = MIN(components, fr_pgraph_count(definition->pgraph));
        made->seconds = g_new(double, (gsize)components + 1);
        for (guint i = 0; i < components; i++) {
            made->seconds[i] = i < known ? counts.seconds[i] : (double)NAN;
        }
    }
    fr_pgraph_counts_clear(&counts);
    return status;
}

/// Builds a definition with a seed and adds it to the scene.
static FrStatus build_plant(Build *build, const FrPlantDef *definition, int64_t seed,
                            const char *key) {
    if (definition->kind == FR_PLANT_VARIED) {
        return vary_plant(build, definition, seed < 0 ? definition->seed : (uint64_t)seed);
    }
    FrScenePlant made;
    FrStatus status = can_be_rebuilt(build, definition)
                          ? rebuild_plant(build, definition, seed, key, &made)
                          : grow_plant(build, definition, seed, &made);
    if (status == FR_OK) {
        warn_of_nothing(build, definition, made.plant);
        g_array_append_val(build->scene->plants, made);
        build->bytes = fr_count_add(build->bytes, fr_plant_bytes(made.plant));
        status = fr_limit_check(build->bytes, build->context->limits.bytes, "bytes", "the scene",
                                definition->span, build->context->diags);
    }
    return status;
}

/// The scene's index of a plant with a seed, built now if it was not.
static FrStatus use_plant(Build *build, const FrPlantDef *definition, int64_t own_seed,
                          uint32_t *index) {
    int64_t seed = seed_of(build, own_seed);
    if (seed < 0 && (definition->kind != FR_PLANT_LSYSTEM || definition->has_seed)) {
        seed = (int64_t)definition->seed;
    }
    char *key = g_strdup_printf("%s %" G_GINT64_FORMAT, definition->id, seed);
    uint32_t found = GPOINTER_TO_UINT(g_hash_table_lookup(build->built, key));
    if (found != 0) {
        *index = found - 1;
        g_free(key);
        return FR_OK;
    }
    *index = build->scene->plants->len;
    g_hash_table_insert(build->built, key, GUINT_TO_POINTER(*index + 1));
    if (build->parts != NULL) {
        FrScenePart part = {*index, g_strdup(key), NULL};
        g_array_append_val(build->parts->parts, part);
    }
    return build_plant(build, definition, seed, key);
}

/// Adds a plant where `stand` says, by the way it is grown.
static FrStatus stand_plant(Build *build, const FrPlantDef *definition, int64_t own_seed,
                            FrStand *stand) {
    if (fr_growing_is_wanted(build->scene, definition)) {
        int64_t seed = seed_of(build, own_seed);
        seed = seed < 0 && definition->has_seed ? (int64_t)definition->seed : seed;
        return fr_growing_add(build->growing, build->scene, definition, seed, stand,
                              build->context);
    }
    if (!build->is_check && fr_sampled_is_wanted(build->scene, definition)) {
        fr_sampled_add(build->sampled, build->scene, definition, seed_of(build, own_seed),
                       build->time, stand);
        return FR_OK;
    }
    FrStatus status = use_plant(build, definition, own_seed, &stand->plant);
    if (status == FR_OK) {
        g_array_append_val(build->scene->stands, *stand);
    }
    return status;
}

/// What definitions say of surfaces, once all plants are there.
static void set_surfaces(const Build *build) {
    for (guint i = 0; i < build->definitions->len; i++) {
        const FrPlantDef *definition = g_ptr_array_index(build->definitions, i);
        if (definition != NULL) {
            fr_rational_set(&g_array_index(build->scene->plants, FrScenePlant, i), definition,
                            build->time);
        }
    }
}

static FrStatus build_place(Build *build, const FrPlaced *placed) {
    if (fr_progress_is_cancelled(build->context->progress)) {
        return FR_CANCELLED;
    }
    guint before = build->scene->plants->len;
    FrStand stand = placed->stand;
    FrStatus status = FR_OK;
    if (placed->plant->kind == FR_PLANT_SPECIES) {
        fr_ecosystem_add(build->ecosystem, build->scene, placed);
    } else {
        status = stand_plant(build, placed->plant, placed->seed, &stand);
    }
    for (guint i = before; i < build->scene->plants->len; i++) {
        g_ptr_array_add(build->definitions, (void *)placed->plant);
    }
    return status;
}

/// Without places: the first plant at the origin.
static FrStatus build_first(Build *build) {
    const GPtrArray *plants = fr_document_plants(build->document);
    if (plants->len == 0) {
        fr_diags_add(build->context->diags, FR_ERROR, "no-plant", fr_document_span(build->document),
                     "there is no plant in this document");
        return FR_ERR_DOCUMENT;
    }
    FrPlaced placed = {.plant = g_ptr_array_index(plants, 0),
                       .stand = {.scale = 1},
                       .seed = -1,
                       .key = fr_key_root(1)};
    double *height = &placed.stand.at[2];
    if (build->hills != NULL && !fr_hills_height(build->hills, 0, 0, height)) {
        *height = 0;
    }
    return build_place(build, &placed);
}

static FrStatus build_places(Build *build) {
    const FrDocument *document = build->document;
    if (fr_document_places(document)->len + fr_document_rows(document)->len +
            fr_document_strews(document)->len ==
        0) {
        return build_first(build);
    }
    GArray *placed;
    FrStatus status = fr_scene_places(document, build->hills, build->context, &placed);
    for (guint i = 0; status == FR_OK && i < placed->len; i++) {
        status = build_place(build, &g_array_index(placed, FrPlaced, i));
    }
    g_clear_pointer(&placed, g_array_unref);
    return status;
}

/// The obstacles, last of plants and stands.
static FrStatus build_obstacles(Build *build) {
    FrScene *scene = build->scene;
    FrScenePlant made = {0};
    FrStatus status =
        fr_obstacles_plant(scene->surroundings, build->hills, build->context, &made.plant);
    if (status != FR_OK || made.plant == NULL) {
        return status;
    }
    made.by_component = g_new0(uint64_t, 1);
    FrStand stand = {.plant = scene->plants->len, .scale = 1};
    g_array_append_val(scene->plants, made);
    g_array_append_val(scene->stands, stand);
    scene->obstacles = 1;
    return FR_OK;
}

static FrScene *new_scene(const FrDocument *document, int64_t seed) {
    FrScene *scene = g_new0(FrScene, 1);
    scene->name = scene_name(fr_document_name(document));
    scene->plants = g_array_new(FALSE, FALSE, sizeof(FrScenePlant));
    g_array_set_clear_func(scene->plants, fr_scene_plant_clear);
    scene->stands = g_array_new(FALSE, FALSE, sizeof(FrStand));
    scene->steps = g_array_new(FALSE, FALSE, sizeof(FrSceneStep));
    scene->views = g_ptr_array_new();
    const GPtrArray *views = fr_document_views(document);
    for (guint i = 0; i < views->len; i++) {
        g_ptr_array_add(scene->views, g_ptr_array_index(views, i));
    }
    scene->params = fr_document_scene(document);
    scene->surroundings = fr_document_surroundings(document);
    const GPtrArray *plants = fr_document_plants(document);
    if (seed >= 0) {
        scene->seed = (uint64_t)seed;
    } else if (plants->len > 0) {
        scene->seed = ((const FrPlantDef *)g_ptr_array_index(plants, 0))->seed;
    }
    return scene;
}

/// How far L-systems grow until a time: a step a frame.
static uint64_t steps_at(const FrDocument *document, double time) {
    double frame = fr_document_scene(document)->frame_time;
    return isnan(time) ? UINT64_MAX : (uint64_t)fmin(round(time / frame), 1e18);
}

static void free_varied(void *varied) {
    fr_varied_free(varied);
}

void fr_scene_forget_parts(FrScene *scene, const FrSceneParts *parts) {
    for (guint i = 0; i < parts->parts->len; i++) {
        const FrScenePart *part = &g_array_index(parts->parts, FrScenePart, i);
        if (part->build != NULL && part->plant < scene->plants->len) {
            g_array_index(scene->plants, FrScenePlant, part->plant).plant = NULL;
        }
    }
}

/// What grows step by step, before its first step.
static FrStatus begin_growing(Build *build) {
    FrScene *scene = build->scene;
    FrStatus status = FR_OK;
    if (!fr_ecosystem_is_empty(build->ecosystem) || fr_growing_asks_space(build->growing)) {
        fr_solids_tell_open(scene->surroundings, build->context);
    }
    if (build->is_check) {
        status = fr_ecosystem_check(build->ecosystem, scene, build->hills, build->context);
    } else if (!fr_ecosystem_is_empty(build->ecosystem)) {
        status = fr_ecosystem_begin(build->ecosystem, scene, build->hills, build->context);
    }
    if (status == FR_OK) {
        uint8_t *is_moving = g_new0(uint8_t, scene->plants->len + 1);
        fr_ecosystem_mark(build->ecosystem, is_moving);
        status = fr_growing_begin(build->growing, scene, is_moving, build->context);
        g_free(is_moving);
    }
    return status;
}

/// Everything but what grows step by step.
static FrStatus build_all(Build *build) {
    FrScene *scene = build->scene;
    FrStatus status = fr_hills_new(scene->surroundings->terrain, build->context, &build->hills);
    if (status == FR_OK) {
        status = build_places(build);
    }
    if (status == FR_OK) {
        status = build_obstacles(build);
    }
    if (status == FR_OK) {
        status = fr_sampled_build(build->sampled, build->document, scene, build->context);
    }
    if (status == FR_OK &&
        (build->sequence == NULL || !fr_sequence_hand_over(build->sequence, scene, build->steps,
                                                           &build->ecosystem, &build->growing))) {
        status = begin_growing(build);
    }
    if (status == FR_OK) {
        set_surfaces(build);
    }
    return status;
}

/// Steps after which all that grows by steps stops, as is asked for and by the clock.
static uint64_t steps_at_most(const FrDocument *document, const FrSceneHow *how) {
    uint64_t asked = how->options.steps < 0 ? UINT64_MAX : (uint64_t)how->options.steps;
    return how->is_check ? 0 : MIN(asked, steps_at(document, how->options.time));
}

/// Steps of growth bud by bud: without being asked, as many as the document says.
static uint64_t steps_of(const FrDocument *document, const FrSceneHow *how) {
    uint64_t said = (uint64_t)fr_document_growth(document)->params.steps;
    uint64_t most = steps_at_most(document, how);
    return how->options.steps < 0 ? MIN(said, most) : most;
}

/// Steps that the document itself wants to be kept.
static uint32_t said_history(const FrDocument *document) {
    return (uint32_t)fr_document_growth(document)->params.history;
}

FrStatus fr_scene_begin(const FrDocument *document, const FrSceneHow *how, const FrContext *context,
                        FrSimulation *simulation) {
    const FrSceneOptions *options = &how->options;
    FrScene *scene = new_scene(document, options->seed);
    Build build = {.document = document,
                   .context = context,
                   .scene = scene,
                   .built = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
                   .varied = g_hash_table_new_full(NULL, NULL, NULL, free_varied),
                   .seed = options->seed,
                   .time = options->time,
                   .growing = fr_growing_new(steps_at_most(document, how), how->watch),
                   .parts = how->parts,
                   .sampled = fr_sampled_new(),
                   .definitions = g_ptr_array_new(),
                   .is_check = how->is_check,
                   .steps = steps_of(document, how),
                   .sequence = how->sequence};
    build.ecosystem =
        fr_ecosystem_new(document, options->seed, how->history,
                         how->previous == NULL ? NULL : how->previous->ecosystem, scene);
    g_ptr_array_set_size(build.definitions, (gint)scene->plants->len);
    FrStatus status = build_all(&build);
    g_ptr_array_unref(build.definitions);
    fr_sampled_free(build.sampled);
    g_hash_table_unref(build.built);
    g_hash_table_unref(build.varied);
    *simulation = (FrSimulation){.document = document,
                                 .scene = scene,
                                 .ecosystem = build.ecosystem,
                                 .growing = build.growing,
                                 .hills = build.hills,
                                 .steps = build.steps,
                                 .most_back = MAX(how->history, said_history(document)),
                                 .back = g_ptr_array_new_with_free_func(fr_simulation_forget),
                                 .seed = options->seed};
    if (status != FR_OK) {
        if (how->parts != NULL) {
            fr_scene_forget_parts(scene, how->parts);
        }
        fr_simulation_clear(simulation);
    }
    return status;
}

FrStatus fr_scene_build_with(const FrDocument *document, const FrSceneOptions *options,
                             const FrContext *context, FrScene **scene) {
    return fr_scene_run(document, &(FrSceneHow){.options = *options}, context, scene);
}

FrStatus fr_scene_check(const FrDocument *document, int64_t seed, const FrContext *context,
                        FrScene **scene) {
    const FrSceneHow how = {.options = {.seed = seed, .time = NAN}, .is_check = true};
    return fr_scene_run(document, &how, context, scene);
}

bool fr_scene_is_lit(const FrDocument *document, const FrPlantDef *definition) {
    FrScene scene = {.surroundings = fr_document_surroundings(document)};
    return fr_growing_is_wanted(&scene, definition);
}

FrStatus fr_scene_derive(const FrDocument *document, const FrPlantDef *definition, int64_t seed,
                         const FrContext *context, FrDerivedFn see, void *user) {
    const FrSceneHow how = {.options = {.seed = seed, .time = NAN, .steps = -1},
                            .watch = {definition, see, user}};
    FrScene *scene;
    FrStatus status = fr_scene_run(document, &how, context, &scene);
    fr_scene_free(scene);
    return status;
}

FrStatus fr_scene_build_parts(const FrDocument *document, int64_t seed, const FrContext *context,
                              FrSceneParts *parts, FrScene **scene) {
    const FrSceneHow how = {.options = {.seed = seed, .time = NAN, .steps = -1}, .parts = parts};
    return fr_scene_run(document, &how, context, scene);
}

FrStatus fr_scene_build_at(const FrDocument *document, int64_t seed, double time,
                           const FrContext *context, FrScene **scene) {
    const FrSceneHow how = {.options = {.seed = seed, .time = time, .steps = -1}};
    return fr_scene_run(document, &how, context, scene);
}

FrStatus fr_scene_build(const FrDocument *document, int64_t seed, const FrContext *context,
                        FrScene **scene) {
    return fr_scene_build_at(document, seed, NAN, context, scene);
}

FrDigest fr_scene_digest(const FrScene *scene) {
    FrDigest digest = 0;
    for (guint i = 0; i < scene->plants->len; i++) {
        const FrScenePlant *built = &g_array_index(scene->plants, FrScenePlant, i);
        FrDigest plant = fr_plant_digest(built->plant);
        digest = fr_rational_digest(fr_digest(digest, &plant, sizeof plant), built);
    }
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        digest = fr_digest(digest, &stand->plant, sizeof stand->plant);
        digest = fr_digest(digest, stand->at, sizeof stand->at);
        digest = fr_digest(digest, &stand->turn, sizeof stand->turn);
        digest = fr_digest(digest, &stand->scale, sizeof stand->scale);
    }
    return digest;
}
