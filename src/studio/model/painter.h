/// @file painter.h
/// Makes the pictures of materials on a thread of its own, each look once.
#pragma once

#include "studio/model/builder.h"

typedef struct StudioPainter StudioPainter;

StudioPainter *studio_painter_new(StudioWake wake, void *user);
/// Waits for the pictures that are being made.
void studio_painter_free(StudioPainter *painter);
/// Asks for the maps of a look, unless it was asked for before. Any thread may.
void studio_painter_add(StudioPainter *painter, FrMaterial *material, FrDigest digest);
/// The next picture that is ready; false: none.
bool studio_painter_take(StudioPainter *painter, StudioPicture *picture);
bool studio_painter_is_busy(StudioPainter *painter);
