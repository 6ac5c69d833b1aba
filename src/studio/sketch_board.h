/// @file sketch_board.h
/// The drawing board as a widget: what lies behind its plane is seen through it, and the pen draws
/// on it while wheel, keys, tilt, a slider or a device move it.
#pragma once

#include "studio/model/sketch_board.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_SKETCH_BOARD (studio_sketch_board_get_type())
G_DECLARE_FINAL_TYPE(StudioSketchBoard, studio_sketch_board, STUDIO, SKETCH_BOARD, GtkWidget)

/// Signals:
///   "drawn" ()      the pen was lifted: studio_sketch_board_events()
///   "raised" ()     the plane has another height

GtkWidget *studio_sketch_board_new(void);
/// Where it is; the caller may change it and then calls studio_sketch_board_update().
StudioBoard *studio_sketch_board_get(StudioSketchBoard *board);
void studio_sketch_board_update(StudioSketchBoard *board);
/// Lines of two layers: the plant behind, and what was drawn. References are taken; NULL: none.
void studio_sketch_board_set_lines(StudioSketchBoard *board, GArray *below, GArray *above);
/// Colours of the pen, and whether a straight arrow is drawn instead of a stroke.
void studio_sketch_board_set_pen(StudioSketchBoard *board, const uint8_t colour[4],
                                 gboolean is_arrow);
/// Whether the tilt of a pen gives the height.
void studio_sketch_board_set_tilting(StudioSketchBoard *board, gboolean is_tilting);
/// What the pen has done since it was down (FrPenEvent), borrowed.
const GArray *studio_sketch_board_events(StudioSketchBoard *board);
/// What a pen or a mouse tells of itself; NAN: it does not tell.
typedef struct StudioTouch {
    double pressure; ///< 0 to 1
    double tilt;     ///< to and from who draws, -1 to 1
    double time;     ///< s since it came down, which need not be told: then it is now
} StudioTouch;
/// It comes down on the board, moves and is lifted, at places of the widget.
void studio_sketch_board_press(StudioSketchBoard *board, double px, double py, StudioTouch touch);
void studio_sketch_board_draw(StudioSketchBoard *board, double px, double py, StudioTouch touch);
void studio_sketch_board_lift(StudioSketchBoard *board);
/// An event of a device, as if the pen had done it; places are metres on the board.
void studio_sketch_board_feed(StudioSketchBoard *board, const FrPenEvent *event);
