/// @file scene/simulation.h
/// A scene between steps. Private to scene.
#pragma once

#include "frond/simulation.h"
#include "scene/ecosystem.h"
#include "scene/growing.h"
#include "scene/rebuild.h"

struct FrSimulation {
    const FrDocument *document;
    FrScene *scene;
    FrEcosystem *ecosystem; ///< empty where nothing grows bud by bud
    FrGrowing *growing;     ///< L-systems that answer the light
    FrHills *hills;         ///< NULL
    uint64_t steps;         ///< that are asked for
    int64_t seed;
    uint32_t most_back; ///< steps that are kept to go back
    GPtrArray *back;    ///< FrBack *, of before the last steps, the last one last
    bool is_drawn;      ///< the scene has the plants that grow bud by bud as they are now …
    bool is_shown;      ///< … and the L-systems
};

/// Frees one step back.
void fr_simulation_forget(void *back);

/// How a scene is begun.
typedef struct FrSceneHow {
    FrSceneOptions options;
    uint32_t history;             ///< steps that can be undone
    const FrSimulation *previous; ///< whose plants go on growing; then its ecosystem is an empty
                                  ///< shell. NULL: none
    struct FrSequence *sequence;  ///< whose last scene may have grown part of the way; NULL
    FrSceneParts *parts;          ///< NULL
    FrGrowingWatch watch;
    bool is_check; ///< nothing is sampled or grown
} FrSceneHow;

/// Builds a document up to its first step. After a failure there is nothing to clear.
FR_MUST_USE FrStatus fr_scene_begin(const FrDocument *document, const FrSceneHow *how,
                                    const FrContext *context, FrSimulation *simulation);
/// Frees all but the struct itself.
void fr_simulation_clear(FrSimulation *simulation);
/// Makes what stands in the way of buds anew after a state was taken up.
FR_MUST_USE FrStatus fr_simulation_take_up(FrSimulation *simulation, const FrContext *context);
/// All steps that are asked for, and the plants as they stand then.
FR_MUST_USE FrStatus fr_simulation_run(FrSimulation *simulation, const FrSceneOptions *options,
                                       const FrContext *context);
/// Steps of growth bud by bud so far.
uint64_t fr_simulation_done(const FrSimulation *simulation);
/// Builds a document with all its steps.
FR_MUST_USE FrStatus fr_scene_run(const FrDocument *document, const FrSceneHow *how,
                                  const FrContext *context, FrScene **scene);
