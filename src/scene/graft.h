/// @file graft.h
/// Plants of a document as grafts of a p-graph. Private to scene.
#pragma once

#include "frond/light_field.h"
#include "frond/scene.h"

/// Who grows the grafts of a graph, and those of the graphs that are grafted in turn.
typedef struct FrGrafter {
    const FrDocument *document;
    double time;        ///< what clocks show; NAN: as the document says
    GHashTable *varied; ///< FrPlantDef * → FrVaried *: bases, built once; NULL for other plants
} FrGrafter;

/// Builds the bases of all varied plants that the graph may ask for.
FR_MUST_USE FrStatus fr_grafter_init(FrGrafter *grafter, const FrDocument *document,
                                     const FrPgraph *graph, double time, const FrContext *context);
void fr_grafter_clear(FrGrafter *grafter);
/// What the graph's build is given; the grafter must outlive it.
FrGraft fr_grafter_graft(FrGrafter *grafter, const FrLightField *light);
