/// @file drive.h
/// The program driven from outside: for tests, and for the pictures of the manual.
#pragma once

#include "studio/window.h"

/// Reads commands from standard input, one a line, and answers each with a line:
///
///   do ACTION              activates an action of the window: add::leaf, mode('skeleton'), undo
///   open FILE              opens a document in the window
///   wait                   answers when all is built, painted and drawn
///   hear                   answers when what pointer and keys did has been handled
///   size WIDTH HEIGHT      of the window
///   letters FACTOR         makes all letters larger
///   focus, focus all       answers what has the keyboard; all that may have it
///   turn AZIMUTH ELEVATION ZOOM    the view, by degrees and a factor
///   orbit FRAMES           turns the view so often; answers how many seconds that took
///   where NAME             answers X Y WIDTH HEIGHT of a widget by its name or by what it says, in
///   a dialog
///                        first, or of the box of a component; at:X,Y,Z is a point of the scene
///   needs NAME             answers WIDTH HEIGHT that a widget needs at least
///   text NAME              answers what a widget says; of a switch, "on" or "off"
///   write FILE             the text as it is, to a file that the document does not have then
///   colour X Y             answers R G B of what is shown there, as `where` counts
///   picture FILE           writes a PNG of the window
///   picture-of-dialog FILE, close-dialog    the same of the dialog above it, which goes
///   stay                   lets messages of the window go only for others
///   dialog                 answers what that dialog is called; "nothing": there is none
///   windows, window N      answers the numbers of all windows; goes on with another one
///   pen down|move X Y PRESSURE TILT SECONDS, pen up    what a pen tells the board of the sketch
///                        mode, at the places of `where`; nan: it does not tell
///   keep, restore          writes the copy for a crash; opens what a crash has left
///   state                  answers with what the document and the view are, as JSON
///   sketch                  answers with what is chosen and drawn in the sketch mode, as JSON
///   quit                   ends without a question
void studio_drive(StudioWindow *window);
