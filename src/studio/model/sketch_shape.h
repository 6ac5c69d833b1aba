/// @file sketch_shape.h
/// What the panes of a sketch show, as lines (StudioLine in a GArray).
#pragma once

#include "frond/variation.h"
#include "studio/model/camera.h"
#include "studio/model/sketch_lines.h"

#include <glib.h>

/// Colours of what is drawn: red, green, blue, opacity.
typedef struct StudioSketchColours {
    uint8_t bare[4], selected[4], undetermined[4]; ///< branches
    uint8_t shaped[4];                             ///< branches that follow a stroke
    uint8_t hand[4];                               ///< strokes as they were drawn
    uint8_t push[4];                               ///< indicators
    uint8_t leaf[4];
} StudioSketchColours;

StudioSketchColours studio_sketch_colours(bool is_dark);
/// What is chosen of a plant.
typedef enum StudioChosen {
    STUDIO_CHOSEN_PAINTED,   ///< what a selection has
    STUDIO_CHOSEN_ALL,       ///< every branch
    STUDIO_CHOSEN_COMPONENT, ///< what one component made
} StudioChosen;

/// The state of every axis (FrSelectionState), as many as the plant has. `component` is an index
/// into the plant's.
void studio_sketch_states(const FrPlant *plant, const FrSelection *selection, StudioChosen chosen,
                          uint32_t component, uint8_t *states);
/// All branches, coloured by their states. Of branches that are not chosen those of the lowest
/// orders, so that there are at most `most` internodes of them.
void studio_sketch_add_skeleton(GArray *lines, const FrPlant *plant, const uint8_t *states,
                                const StudioSketchColours *colours, uint32_t most);
/// All branches of an instance, coloured by the stroke each follows (NULL: none does).
void studio_sketch_add_instance(GArray *lines, const FrPlant *plant, const uint32_t *stroke,
                                const StudioSketchColours *colours, uint32_t most);
/// At most `most` leaves, spread over all, each a line as long as it is.
void studio_sketch_add_leaves(GArray *lines, const FrPlant *plant,
                              const StudioSketchColours *colours, uint32_t most);
/// A stroke begun at a point, `scale` times as large as it was drawn.
void studio_sketch_add_stroke_line(GArray *lines, const FrStroke *stroke, const float at[3],
                                   double scale, float width, const uint8_t colour[4]);
/// An arrow.
void studio_sketch_add_arrow(GArray *lines, const float from[3], const float to[3], float width,
                             const uint8_t colour[4]);
/// The box around a plant; min > max if it is empty.
void studio_sketch_bounds(const FrPlant *plant, double min[3], double max[3]);
/// Selected branches, or all if none is or `states` is NULL.
void studio_sketch_add_chosen(GArray *lines, const FrPlant *plant, const uint8_t *states);
/// Looks at lines (of arrays, NULL: none) from as near as all of them can be seen; the angles stay.
void studio_sketch_fit(StudioCamera *camera, GArray *const *layers, size_t count, double aspect);
/// The lens of a camera.
StudioLens studio_sketch_lens(const StudioCamera *camera, double aspect);
/// The first branch that is selected, FR_NONE.
uint32_t studio_sketch_first(const FrPlant *plant, const uint8_t *states);
/// Metres along an axis.
double studio_sketch_length(const FrPlant *plant, uint32_t axis);
