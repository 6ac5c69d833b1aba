/// @file camera.h
/// Where the view is seen from: a point that is looked at, a distance and two angles. z is up.
#pragma once

#include "frond/document.h"

#include <cglm/struct.h>

typedef struct StudioCamera {
    double target[3];
    double distance;      ///< m, > 0
    double azimuth;       ///< radians about the vertical, from −y
    double elevation;     ///< radians above the horizon
    double field_of_view; ///< radians, of the height
} StudioCamera;

StudioCamera studio_camera_default(void);
/// Shows all of a box at a width over height of `aspect`; a box without size gets a metre.
void studio_camera_frame(StudioCamera *camera, const double min[3], const double max[3],
                         double aspect);
/// Looks as a view of a document does, which frames such a box or has an eye of its own.
void studio_camera_see(StudioCamera *camera, const FrViewParams *view, const double min[3],
                       const double max[3], double aspect);
/// Turns about the target; the elevation stays short of the poles.
void studio_camera_orbit(StudioCamera *camera, double azimuth, double elevation);
/// Moves target and camera by parts of the picture's height.
void studio_camera_pan(StudioCamera *camera, double right, double up);
/// Multiplies the distance; it stays between a millimetre and 100 km. A camera that goes away above
/// the floor stays above it: it rises where its way back would lead below.
void studio_camera_zoom(StudioCamera *camera, double factor);
/// Where the camera stands.
void studio_camera_eye(const StudioCamera *camera, double eye[3]);
mat4s studio_camera_view(const StudioCamera *camera);
/// `radius` about the target is certainly between the planes.
mat4s studio_camera_projection(const StudioCamera *camera, double aspect, double radius);
/// The ray through a point of the picture: x from −1 at the left to 1, y from −1 at the bottom.
void studio_camera_ray(const StudioCamera *camera, double aspect, double x, double y,
                       double origin[3], double direction[3]);
/// Where the ray through a point of the picture meets the plane through `grip` that faces the
/// camera. False: behind it.
bool studio_camera_meet(const StudioCamera *camera, double aspect, double x, double y,
                        const double grip[3], double hit[3]);
/// Where a point is in the picture, as in studio_camera_ray(). False: it is not before the camera.
bool studio_camera_project(const StudioCamera *camera, double aspect, const double point[3],
                           double *x, double *y);
/// A step of 1, 2 or 5 times a power of ten that is about `part` of the height of the picture.
double studio_camera_step(const StudioCamera *camera, double part);

/// A bar that tells how large things are.
typedef struct StudioScale {
    double length; ///< m
    double pixels; ///< its length in the picture, at the target
} StudioScale;

/// The longest such step that has room in so many pixels of a picture so many pixels high, both >
/// 0.
StudioScale studio_camera_scale(const StudioCamera *camera, double height, double room);
