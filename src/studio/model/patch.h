/// @file patch.h
/// The control points of a Hyperpatch in the picture: where they are, and what a drag of one does.
#pragma once

#include "frond/lattice.h"
#include "frond/scene.h"
#include "studio/model/camera.h"
#include "studio/model/document.h"
#include "studio/model/overlay.h"

/// Where a component that deforms stands in the scene, the first of its kind.
typedef struct StudioFooting {
    char *plant, *component; ///< ids
    double origin[3];
    double axes[3][3]; ///< of its coordinates, each as long as one metre of them
} StudioFooting;

/// Of all that deform in a scene (StudioFooting). Free with g_array_unref().
GArray *studio_footings_of(const FrScene *scene);
/// NULL: there is none (`footings` NULL: none at all).
const StudioFooting *studio_footing_find(const GArray *footings, const char *plant,
                                         const char *component);

typedef struct StudioPatch {
    uint32_t element;
    FrLattice lattice;                       ///< regular
    double moves[FR_LATTICE_MOST_POINTS][3]; ///< how far each is moved
    double origin[3], axes[3][3];            ///< as of a footing
    bool can_move;                           ///< false: functions move them
} StudioPatch;

/// The lattice of an element, which stands there. False: it has none, or what it says is wrong.
bool studio_patch_read(const StudioDocument *document, uint32_t element,
                       const StudioFooting *footing, StudioPatch *patch);
/// Where a control point is in the scene.
void studio_patch_place(const StudioPatch *patch, uint32_t point, double at[3]);
/// The lattice as lines and its points as handles; `chosen` (FR_NONE: none) is marked.
StudioOverlay *studio_patch_marks(const StudioPatch *patch, uint32_t chosen);
/// The control point at a place of the picture (−1 to 1, so many pixels high); FR_NONE.
uint32_t studio_patch_under(const StudioPatch *patch, const StudioCamera *camera, double aspect,
                            double height, double x, double y);
/// Moves a point parallel to the picture's plane so that it is seen at x, y; with `is_mirrored`
/// also the one across the middle in x, by as much to the other side. `from` is the patch when the
/// drag began. Calls in a row are one step. False if nothing changed.
bool studio_patch_drag(StudioDocument *document, const StudioPatch *from, uint32_t point,
                       const StudioCamera *camera, double aspect, double x, double y,
                       bool is_mirrored);
/// Puts a point (FR_NONE: all) back to its regular place.
bool studio_patch_reset(StudioDocument *document, const StudioPatch *patch, uint32_t point);
