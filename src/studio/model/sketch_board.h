/// @file sketch_board.h
/// The drawing board: a plane in the space of the plant that is moved along its normal while one
/// draws on it, and a window into what lies behind it.
///
///     StudioBoard board = …;
///     pen events in metres on the board → studio_board_stroke() → FrStroke in the plant's space
#pragma once

#include "frond/variation.h"
#include "studio/model/sketch_lines.h"

typedef struct StudioBoard {
    double centre[3]; ///< the middle of the board at height 0, in the plant's coordinates
    double size;      ///< m, height of what is seen in the plane itself, > 0
    double azimuth;   ///< radians about the vertical: from where it is looked at, as a camera's
    bool is_level;    ///< it lies, is looked at from above and is raised; else it stands, and its
                      ///< height is how far it is moved towards who draws
    double height;    ///< m from its centre, −reach to reach
    double reach;     ///< m
} StudioBoard;

/// A board that shows all lines at a width over height of `aspect`, and reaches through them.
/// Without any it is a metre high.
void studio_board_frame(StudioBoard *board, const StudioLine *lines, size_t count, double aspect);
/// Moves the plane, as far as the board reaches.
void studio_board_raise(StudioBoard *board, double by);
/// The height to which a pen moves the plane: leaning towards who draws (−1, as tablets tell it) as
/// near as the board reaches, upright 0, leaning away (1) as far. NAN: it tells none, and the plane
/// stays.
double studio_board_lean(const StudioBoard *board, double tilt);
/// How hard a pen is pressed, 0 to 1; NAN: it tells none, and is pressed as a mouse is.
double studio_pen_pressure(double told);
/// Unit vectors to the right, upwards on the board, and towards who draws.
void studio_board_axes(const StudioBoard *board, double right[3], double up[3], double out[3]);
/// A place on the board (metres from its middle) at a height, in the plant's coordinates.
void studio_board_point(const StudioBoard *board, double x, double y, double height, double at[3]);
/// How high above the board's centre a point is.
double studio_board_height_of(const StudioBoard *board, const double at[3]);
/// A view through the board: nothing before it is seen, and a point on it is seen at its place.
StudioLens studio_board_lens(const StudioBoard *board, double aspect);
/// The stroke that events of a pen on the board have drawn, from the origin on, in the plant's
/// directions; coordinates to a
/// ten-thousandth of the board or less. NULL: it has no length.
FrStroke *studio_board_stroke(const StudioBoard *board, const FrPenEvent *events, size_t count);
/// The same events as a vector from where the pen began to where it ended. False: it has no length.
bool studio_board_vector(const StudioBoard *board, const FrPenEvent *events, size_t count,
                         vec3s *vector);
