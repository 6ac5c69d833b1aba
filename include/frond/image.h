/// @file image.h
/// Pictures in memory and their PNG and JPEG forms.
#pragma once

#include "frond/context.h"

/// Rows from the top, 8 bits a channel. Immutable once shared; reference counted.
typedef struct FrImage {
    uint32_t width, height;
    uint32_t channels; ///< 1 grey, 3 RGB, 4 RGBA (alpha not premultiplied)
    uint8_t *pixels;   ///< width × height × channels bytes
} FrImage;

/// Zeroed. The caller has checked the size against FrLimits.pixels.
FR_API FrImage *fr_image_new(uint32_t width, uint32_t height, uint32_t channels);
FR_API FrImage *fr_image_ref(FrImage *image);
FR_API void fr_image_unref(FrImage *image);
/// Reads a PNG or JPEG, by content. NULL with a diagnostic at `span` if it cannot be read.
FR_API FrImage *fr_image_load(const char *path, FrSpan span, const FrContext *context,
                              FrStatus *status);
/// The bytes of a PNG file. Deterministic.
FR_API GBytes *fr_image_to_png(const FrImage *image);
/// Reads a PNG or JPEG from memory.
FR_API FrImage *fr_image_from_bytes(const void *data, size_t size, const char *name, FrSpan span,
                                    const FrContext *context, FrStatus *status);

/// Heights from a picture, rows from the top, 0 (black) to 1 (white).
typedef struct FrHeightMap {
    uint32_t width, height;
    float *heights; ///< owned
} FrHeightMap;

/// Reads a PNG of 8 or 16 bits a channel without any correction of brightness; colours count by how
/// bright they are. NULL, *status and a diagnostic at `span` if it cannot be read.
FR_API FrHeightMap *fr_height_map_load(const char *path, FrSpan span, const FrContext *context,
                                       FrStatus *status);
FR_API void fr_height_map_free(FrHeightMap *map);
