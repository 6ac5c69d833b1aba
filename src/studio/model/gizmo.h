/// @file gizmo.h
/// Handles that move, turn and scale what stands in a scene: where they are in the picture, and
/// what a drag of one does. Points of the picture are in pixels from its upper left corner.
#pragma once

#include "studio/model/camera.h"
#include "studio/model/ground.h"
#include "studio/model/standing.h"

/// A camera and the size of its picture.
typedef struct StudioEye {
    StudioCamera camera;
    double width, height;
} StudioEye;

/// False: the point is behind the camera.
bool studio_eye_project(const StudioEye *eye, const double point[3], double pixel[2]);
void studio_eye_ray(const StudioEye *eye, const double pixel[2], double origin[3],
                    double direction[3]);
/// How many metres a pixel is at a point.
double studio_eye_pixel(const StudioEye *eye, const double point[3]);

typedef enum StudioGrip {
    STUDIO_GRIP_NONE,
    STUDIO_GRIP_X,
    STUDIO_GRIP_Y,
    STUDIO_GRIP_Z,
    STUDIO_GRIP_GROUND, ///< the middle: along the ground
    STUDIO_GRIP_TURN,   ///< the ring
    STUDIO_GRIP_SCALE,  ///< the square beside it
} StudioGrip;

enum { STUDIO_RING = 49 }; ///< points of the ring, the last as the first

/// The handles in the picture.
typedef struct StudioGizmo {
    double middle[2], tips[3][2]; ///< of the arrows along x, y, z
    double ring[STUDIO_RING][2];
    double scale[2];
    bool can_turn, can_scale;
} StudioGizmo;

/// Where an element stands in the scene.
void studio_gizmo_pivot(const StudioGround *ground, const StudioStanding *standing,
                        double pivot[3]);
/// False: it is behind the camera.
bool studio_gizmo_place(const StudioEye *eye, const double pivot[3], const StudioStanding *standing,
                        StudioGizmo *gizmo);
/// The handle at a point of the picture.
StudioGrip studio_gizmo_under(const StudioGizmo *gizmo, const double pixel[2]);
/// In words what a handle does, for a hint.
const char *studio_grip_words(StudioGrip handle);
/// Where what stood as `from` comes to when a handle is dragged from one point to another, in steps
/// of `step` metres and `turn_step` degrees; 0: any. Along a ground things keep their height above
/// it.
StudioStanding studio_gizmo_drag(const StudioEye *eye, const StudioGround *ground,
                                 StudioGrip handle, const StudioStanding *from,
                                 const double begin[2], const double end[2], double step,
                                 double turn_step);
