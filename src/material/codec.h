/// @file codec.h
/// The picture formats behind image.h, and files of pictures.
#pragma once

#include "frond/image.h"

typedef enum FrPictureFormat {
    FR_PICTURE_UNKNOWN,
    FR_PICTURE_PNG,
    FR_PICTURE_JPEG
} FrPictureFormat;

/// Whose bytes are being read, for diagnostics.
typedef struct FrPictureOrigin {
    const char *name;
    FrSpan span;
    const FrContext *context;
} FrPictureOrigin;

/// By the first bytes, never by a name.
FrPictureFormat fr_picture_format(const void *data, size_t size);

/// The bytes of a regular file of at most limits.document_bytes.
FrStatus fr_picture_read_file(const char *path, FrSpan span, const FrContext *context,
                              GBytes **bytes);

FrStatus fr_png_read(const void *data, size_t size, const FrPictureOrigin *origin, FrImage **image);
FrStatus fr_jpeg_read(const void *data, size_t size, const FrPictureOrigin *origin,
                      FrImage **image);

/// True if a PNG declares transparency: an alpha channel, or a tRNS chunk before its pixels.
bool fr_png_declares_alpha(const void *data, size_t size);
