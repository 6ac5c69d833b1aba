/// @file grow.h
/// One plant in the light of its scene. Private to scene.
#pragma once

#include "frond/light_field.h"
#include "frond/scene.h"

/// Frees what a FrScenePlant holds.
void fr_scene_plant_clear(void *plant);
/// Internodes and organs by the component that made them (for internodes: that their axis begins
/// with).
uint64_t *fr_scene_count_made(const FrPlant *plant);
/// As fr_scene_grow(); Worlds that sample the light find it in `light`, in the plant's coordinates.
FR_MUST_USE FrStatus fr_scene_grow_in_light(const FrDocument *document,
                                            const FrPlantDef *definition, int64_t seed, double time,
                                            const FrLightField *light, const FrContext *context,
                                            FrScenePlant *plant, FrPgraphCounts *counts);
