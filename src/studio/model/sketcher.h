/// @file sketcher.h
/// Grows the plant that is sketched over and its instances, off the main thread: skeletons only, so
/// that a stroke shows at once. The base is grown anew only when the document but for its variation
/// has changed; of requests that wait only the last is done.
#pragma once

#include "frond/variation.h"
#include "studio/model/sketch_edit.h"

typedef struct StudioSketcher StudioSketcher;

/// A plant that several hold. `plant` is as it stands, deformations included.
typedef struct StudioBase {
    FrPlant *plant;
} StudioBase;

StudioBase *studio_base_ref(StudioBase *base);
void studio_base_unref(StudioBase *base);

/// What is asked for.
typedef struct StudioSketchAsk {
    uint64_t seed;
    uint32_t count;  ///< instances
    double strength; ///< part of the turn that indicators give in the end, 0 to 1
} StudioSketchAsk;

typedef struct StudioSketched {
    uint64_t serial;
    FrStatus status;
    FrDiags *diags;       ///< what is wrong, with places in the text
    StudioBase *base;     ///< NULL: it could not be grown
    GPtrArray *instances; ///< FrPlant *; empty without a variation
    uint32_t *stroke;     ///< of each axis: the number of the stroke it follows, FR_NONE; NULL
                          ///< without a variation
    double seconds;
} StudioSketched;

/// `wake` is called from another thread when something can be collected.
StudioSketcher *studio_sketcher_new(void (*wake)(void *user), void *user);
/// Cancels what runs and waits for it.
void studio_sketcher_free(StudioSketcher *sketcher);
/// Returns the serial number of what will come of it.
uint64_t studio_sketcher_ask(StudioSketcher *sketcher, FrSource *source, const char *folder,
                             const StudioSketchOf *of, StudioSketchAsk ask);
/// What is done; NULL: nothing new. Free with studio_sketched_free().
StudioSketched *studio_sketcher_take(StudioSketcher *sketcher);
void studio_sketched_free(StudioSketched *sketched);
bool studio_sketcher_is_busy(StudioSketcher *sketcher);
