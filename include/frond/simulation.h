/// @file simulation.h
/// A scene that grows step by step and can be looked at, changed and saved between steps: the loop
/// of Beneš, Andrysco, Šťava 2009, Figure 2.
///
///     fr_simulation_new(document, -1, 20, &context, &simulation);
///     fr_simulation_step(simulation, &context);              as often as wished
///     fr_simulation_scene(simulation, &context, &scene);     look
///     fr_document_set(document, "growth.gravity", "1, 0, -1", &context);
///     fr_simulation_change(simulation, document, &context);  go on with what has changed
///     fr_simulation_undo(simulation);
#pragma once

#include "frond/scene.h"

typedef struct FrSimulation FrSimulation;

/// The scene of a document before its first step. Steps back to be kept are `history`; `seed` as in
/// fr_scene_build(). The document must outlive the simulation, or its next change.
FR_API FR_MUST_USE FrStatus fr_simulation_new(const FrDocument *document, int64_t seed,
                                              uint32_t history, const FrContext *context,
                                              FrSimulation **simulation);
FR_API void fr_simulation_free(FrSimulation *simulation);
/// True if any plant grows bud by bud.
FR_API bool fr_simulation_is_growing(const FrSimulation *simulation);
/// One step of everything. FR_CANCELLED and errors leave the plants as they were, buds and
/// L-systems alike. Where nothing has a step left it does nothing.
FR_API FR_MUST_USE FrStatus fr_simulation_step(FrSimulation *simulation, const FrContext *context);
/// Takes the last step back, of buds, particles and L-systems; false if there is none to take.
/// L-systems are derived again from what they have been answered. Changes of the document stay.
FR_API bool fr_simulation_undo(FrSimulation *simulation);
/// Goes on with another document, or with the same one after changes of it: species, world,
/// obstacles and particles change for what will grow; wood stays as it has grown. What is placed
/// anew begins as a seed; what has been placed stays. An L-system goes on if the changed one comes
/// to where it stands by the same answers, else it begins at its axiom. `<growth cell>` and how
/// many species there are must be as they were, else FR_ERR_DOCUMENT and nothing has changed.
FR_API FR_MUST_USE FrStatus fr_simulation_change(FrSimulation *simulation,
                                                 const FrDocument *document,
                                                 const FrContext *context);
/// What the last step has done; zero where nothing grows bud by bud.
FR_API FrGrowthStats fr_simulation_stats(const FrSimulation *simulation);
/// NULL where nothing grows bud by bud.
FR_API const FrGrowth *fr_simulation_growth(const FrSimulation *simulation);
/// How many steps the document asks for.
FR_API uint64_t fr_simulation_step_count(const FrSimulation *simulation);
/// The scene as it stands now, owned by the simulation until its next call. Looking changes
/// nothing.
FR_API FR_MUST_USE FrStatus fr_simulation_scene(FrSimulation *simulation, const FrContext *context,
                                                const FrScene **scene);

/// All that has grown, to go on with later: bud by bud as it stands, L-systems as what they have
/// been answered. NULL with a diagnostic where nothing grows by steps. Free with g_bytes_unref().
FR_API GBytes *fr_simulation_save(const FrSimulation *simulation, const FrContext *context);
/// Takes up a saved state; steps before it cannot be taken back. FR_ERR_DOCUMENT with a diagnostic
/// at `span`, and nothing changed, if the bytes are damaged, or were saved by another version of
/// the program, from another document or with another seed.
FR_API FR_MUST_USE FrStatus fr_simulation_restore(FrSimulation *simulation, const void *bytes,
                                                  size_t size, FrSpan span,
                                                  const FrContext *context);

/// How a scene is built.
typedef struct FrSceneOptions {
    int64_t seed;       ///< < 0: as the document says
    double time;        ///< of all clocks, in years; NAN: as the document says
    int64_t steps;      ///< of growth bud by bud; < 0: as the document says
    const void *resume; ///< a saved state to go on from; NULL: none
    size_t resume_size;
    FrSpan resume_span;
    /// Called after each step of plants that grow by steps; NULL. Anything but FR_OK ends it.
    FrStatus (*after_step)(void *data, const FrSimulation *simulation, const FrContext *context);
    void *data;
} FrSceneOptions;

/// As fr_scene_build_at(), with more to choose.
FR_API FR_MUST_USE FrStatus fr_scene_build_with(const FrDocument *document,
                                                const FrSceneOptions *options,
                                                const FrContext *context, FrScene **scene);
