/// @file shot.h
/// A picture that is being drawn: what is the same for all that it shows, and what is around
/// plants.
#pragma once

#include "studio/model/camera.h"
#include "studio/view/display.h"
#include "studio/view/lamp_maps.h"
#include "studio/view/program.h"
#include "studio/view/store.h"
#include "studio/view/target.h"

typedef struct StudioPrograms {
    GLuint surface, plain, still, shadow, floor, line, backdrop, show;
} StudioPrograms;

/// False with an error if the driver is not good enough.
bool studio_programs_new(StudioPrograms *programs, GError **error);
void studio_programs_clear(StudioPrograms *programs);

typedef struct StudioShot {
    const StudioPrograms *programs;
    const StudioStore *store;
    const StudioDisplay *display;
    GLuint shadow; ///< map of depths from the sun
    bool has_shadow;
    const StudioLampMaps *lamps;
    bool is_plain; ///< quick rather than fine
    mat4s to_shadow, clip;
    float eye[3];
    float near, far; ///< planes
    float reach;     ///< m, of what shades its surroundings
    double distance; ///< m, of the target
    double radius;   ///< m, around the target of the camera: all is in it
} StudioShot;

/// Without programs and shadow.
StudioShot studio_shot_new(const StudioStore *store, const StudioCamera *camera,
                           const StudioDisplay *display, double aspect);
StudioOutlook studio_shot_outlook(const StudioShot *shot);
/// Begins a picture: backdrop and floor.
void studio_shot_begin(const StudioShot *shot, const StudioTarget *target,
                       const StudioCamera *camera);
/// Uses a program of surfaces.
void studio_shot_use(const StudioShot *shot, GLuint program);
void studio_shot_draw_skeletons(StudioShot *shot);
