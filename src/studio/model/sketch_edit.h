/// @file sketch_edit.h
/// What a sketch is in a document: a plant with a `<vary>` of the one that was drawn over, with its
/// strokes and indicators. Every call that changes something is one step that can be undone.
#pragma once

#include "frond/variation.h"
#include "studio/model/document.h"

/// What is drawn on the board.
typedef enum StudioPen {
    STUDIO_PEN_STROKE,
    STUDIO_PEN_WIND,
    STUDIO_PEN_SUN,
    STUDIO_PEN_RAIN
} StudioPen;

/// A plant that is sketched over, and its variation; ids.
typedef struct StudioSketchOf {
    char *base;   ///< NULL: there is nothing to sketch over
    char *varied; ///< NULL: none yet, the first stroke makes one
} StudioSketchOf;

void studio_sketch_of_clear(StudioSketchOf *of);
/// What is sketched when `plant` is shown: a variation and its base, or a plant and the first
/// variation of it.
StudioSketchOf studio_sketch_of(const FrContents *contents, uint32_t plant);
/// The variations of a plant (const char *, borrowed from the contents). Free with
/// g_ptr_array_unref().
GPtrArray *studio_sketch_variations(const FrContents *contents, const char *base);
/// The `<vary>` of a variation, FR_NONE.
uint32_t studio_sketch_vary(const FrContents *contents, const char *varied);
/// Its strokes and indicators (uint32_t elements), in their order. Free with g_array_unref().
GArray *studio_sketch_marks(const FrContents *contents, uint32_t vary);

/// A stroke for the branches of a choice (NULL or "": all). Makes the variation if there is none
/// and sets of->varied. False: the text is broken.
bool studio_sketch_add_stroke(StudioDocument *document, StudioSketchOf *of, const FrStroke *stroke,
                              const char *choice, FrApply apply);
/// An indicator, likewise. `pen` is what it stands for.
bool studio_sketch_add_indicator(StudioDocument *document, StudioSketchOf *of, StudioPen pen,
                                 vec3s vector, const char *choice, FrApply apply);
bool studio_sketch_remove(StudioDocument *document, uint32_t mark);
/// Stands `count` instances in the scene, of seeds from `seed` on, in a row `step` metres apart to
/// the right of what is placed there. What a document without places shows gets a place, too.
bool studio_sketch_place(StudioDocument *document, const StudioSketchOf *of, uint64_t seed,
                         uint32_t count, double step);

/// The document with nothing in its scene but `count` instances (of the base if there is no
/// variation), in rows `step` metres apart: what is looked at while sketching. NULL if the text is
/// broken. Free with fr_source_unref().
FrSource *studio_sketch_preview(const StudioDocument *document, const StudioSketchOf *of,
                                uint64_t seed, uint32_t count, double step);
