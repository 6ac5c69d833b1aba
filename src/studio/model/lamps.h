/// @file lamps.h
/// Lamps, the reference probe and the sun of a document: as marks of an overlay, and as handles
/// that are dragged. All from the text alone, so that nothing waits for a build.
#pragma once

#include "frond/surroundings.h"
#include "studio/model/camera.h"
#include "studio/model/document.h"
#include "studio/model/overlay.h"

/// A `<lamp>` as the document has it.
typedef struct StudioLamp {
    uint32_t element;
    FrLampParams params; ///< what makes no sense has its default
} StudioLamp;

/// All lamps (StudioLamp), in the order of the document. Free with g_array_unref().
GArray *studio_lamps(const StudioDocument *document);
/// What a lamp is called: its id, or "Lamp 2". Free with g_free().
char *studio_lamp_title(const StudioDocument *document, uint32_t element);
/// Puts a lamp of a kind (FR_LAMP_PARAMS) at a place into the scene, which is made if there is
/// none. FR_NONE if the document cannot be changed, else the new element.
uint32_t studio_add_lamp(StudioDocument *document, const char *kind, const double at[3]);
/// The `<sun>` or `<light>` of the scene, made if there is none; FR_NONE as above.
uint32_t studio_make_of_scene(StudioDocument *document, const char *name);
/// The `<light>` or `<sun>`; FR_NONE: there is none.
uint32_t studio_find_in_scene(const StudioDocument *document, const char *name);

/// Lamps as they are, with where they shine; the selected one with arrows to drag. With the probe
/// where there is a `<light>`.
StudioOverlay *studio_lamp_marks(const StudioDocument *document, uint32_t selected, double reach);
/// The sun's way over the day about the middle of a box, where it stands now, and the compass.
StudioOverlay *studio_sun_marks(const StudioDocument *document, const double min[3],
                                const double max[3]);

// ---- handles -----------------------------------------------------------------------------------

typedef enum StudioHandleKind {
    STUDIO_HANDLE_NONE,
    STUDIO_HANDLE_PLACE, ///< parallel to the picture
    STUDIO_HANDLE_X,     ///< along an axis
    STUDIO_HANDLE_Y,
    STUDIO_HANDLE_Z,
    STUDIO_HANDLE_AIM, ///< where a spot or an area shines
} StudioHandleKind;

/// What was taken hold of.
typedef struct StudioHandle {
    StudioHandleKind kind;
    uint32_t element; ///< the lamp, or the `<light>` whose reference it is
    double begin[3];  ///< where it was
    double grip[3];   ///< where the pointer took it
    double pivot[3];  ///< of an aim: where the lamp hangs
} StudioHandle;

/// The handle at a point of the picture of so many pixels in height; arrows and aims are those of
/// the selected lamp. `reach` is as long as arrows are, m.
StudioHandle studio_handle_at(const StudioDocument *document, uint32_t selected, double reach,
                              const StudioCamera *camera, double aspect, double height, double x,
                              double y);
/// Drags it to a point of the picture; drags in a row are one step. False if nothing changed.
bool studio_handle_drag(StudioDocument *document, const StudioHandle *handle,
                        const StudioCamera *camera, double aspect, double x, double y);
