/// @file sketch_canvas.h
/// Lines in space drawn onto a widget.
#pragma once

#include "studio/model/sketch_lines.h"

#include <gtk/gtk.h>

typedef struct StudioCanvas {
    StudioRaster raster;
} StudioCanvas;

void studio_canvas_clear(StudioCanvas *canvas);
/// Draws layers of lines (arrays of StudioLine, NULL: none), each over those before it where they
/// are equally far, into a part of the widget.
void studio_canvas_draw(StudioCanvas *canvas, GtkWidget *widget, GtkSnapshot *snapshot,
                        const graphene_rect_t *area, const StudioLens *lens, GArray *const *layers,
                        size_t count);
