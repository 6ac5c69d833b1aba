/// @file swatches.h
/// How the materials of a document look, in small.
#pragma once

#include "studio/model/builder.h"
#include "studio/model/document.h"

#include <gtk/gtk.h>

typedef struct StudioSwatches StudioSwatches;

/// `changed` is called when one may look different.
StudioSwatches *studio_swatches_new(void (*changed)(void *user), void *user);
void studio_swatches_free(StudioSwatches *swatches);
/// Who makes pictures.
void studio_swatches_set_builder(StudioSwatches *swatches, StudioBuilder *builder);
void studio_swatches_add(StudioSwatches *swatches, const StudioPicture *picture);
/// Of a material of the document, so many pixels a side; asks for its picture if it has one that is
/// not there yet. To be unreferenced.
GdkTexture *studio_swatches_get(StudioSwatches *swatches, const StudioDocument *document,
                                uint32_t material, uint32_t size);
/// An image of the library as a texture. To be unreferenced.
GdkTexture *studio_texture_of(const FrImage *image);
