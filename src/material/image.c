#include "frond/image.h"

#include "material/codec.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <string.h>

/// The reference count stands in front of what callers see.
typedef struct CountedImage {
    gatomicrefcount references;
    FrImage image;
} CountedImage;

static CountedImage *counted(FrImage *image) {
    return (CountedImage *)(void *)((char *)image - offsetof(CountedImage, image));
}

FrImage *fr_image_new(uint32_t width, uint32_t height, uint32_t channels) {
    FR_ASSERT(width > 0 && height > 0);
    FR_ASSERT(channels == 1 || channels == 3 || channels == 4);
    uint64_t bytes = fr_count_multiply(fr_count_multiply(width, height), channels);
    FR_ASSERT(bytes < SIZE_MAX);
    CountedImage *self = g_new0(CountedImage, 1);
    g_atomic_ref_count_init(&self->references);
    self->image = (FrImage){.width = width, .height = height, .channels = channels};
    self->image.pixels = g_malloc0((size_t)bytes);
    return &self->image;
}

FrImage *fr_image_ref(FrImage *image) {
    g_atomic_ref_count_inc(&counted(image)->references);
    return image;
}

void fr_image_unref(FrImage *image) {
    if (image == NULL) {
        return;
    }
    CountedImage *self = counted(image);
    if (g_atomic_ref_count_dec(&self->references)) {
        g_free(image->pixels);
        g_free(self);
    }
}

FrPictureFormat fr_picture_format(const void *data, size_t size) {
    static const uint8_t png[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const uint8_t jpeg[3] = {0xff, 0xd8, 0xff};
    if (size >= sizeof png && memcmp(data, png, sizeof png) == 0) {
        return FR_PICTURE_PNG;
    }
    if (size >= sizeof jpeg && memcmp(data, jpeg, sizeof jpeg) == 0) {
        return FR_PICTURE_JPEG;
    }
    return FR_PICTURE_UNKNOWN;
}

FrImage *fr_image_from_bytes(const void *data, size_t size, const char *name, FrSpan span,
                             const FrContext *context, FrStatus *status) {
    FrPictureOrigin origin = {.name = name, .span = span, .context = context};
    FrImage *image = NULL;
    FrStatus outcome = FR_ERR_DOCUMENT;
    switch (fr_picture_format(data, size)) {
    case FR_PICTURE_PNG:
        outcome = fr_png_read(data, size, &origin, &image);
        break;
    case FR_PICTURE_JPEG:
        outcome = fr_jpeg_read(data, size, &origin, &image);
        break;
    case FR_PICTURE_UNKNOWN:
        fr_diags_add(context->diags, FR_ERROR, "picture-format", span,
                     "'%s' is neither a PNG nor a JPEG picture", name);
        break;
    }
    if (status != NULL && outcome != FR_OK) {
        *status = outcome;
    }
    return image;
}

/// Devices and pipes are refused before they are opened: reading them may never end.
FrStatus fr_picture_read_file(const char *path, FrSpan span, const FrContext *context,
                              GBytes **bytes) {
    GStatBuf information;
    *bytes = NULL;
    if (g_stat(path, &information) != 0) {
        int reason = errno;
        fr_diags_add(context->diags, FR_ERROR, "picture-missing", span,
                     "cannot open picture '%s': %s", path, g_strerror(reason));
        return reason == EACCES || reason == EIO ? FR_ERR_MACHINE : FR_ERR_DOCUMENT;
    }
    if (!S_ISREG(information.st_mode)) {
        fr_diags_add(context->diags, FR_ERROR, "picture-missing", span, "'%s' is not a file", path);
        return FR_ERR_DOCUMENT;
    }
    FrStatus status = fr_limit_check((uint64_t)information.st_size, context->limits.document_bytes,
                                     "document_bytes", path, span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    char *contents = NULL;
    gsize size = 0;
    GError *error = NULL;
    if (!g_file_get_contents(path, &contents, &size, &error)) {
        fr_diags_add(context->diags, FR_ERROR, "picture-missing", span, "cannot read picture: %s",
                     error->message);
        g_error_free(error);
        return FR_ERR_MACHINE;
    }
    *bytes = g_bytes_new_take(contents, size);
    return FR_OK;
}

FrImage *fr_image_load(const char *path, FrSpan span, const FrContext *context, FrStatus *status) {
    GBytes *bytes = NULL;
    FrStatus outcome = fr_picture_read_file(path, span, context, &bytes);
    if (outcome != FR_OK) {
        if (status != NULL) {
            *status = outcome;
        }
        return NULL;
    }
    gsize size = 0;
    const void *data = g_bytes_get_data(bytes, &size);
    FrImage *image = fr_image_from_bytes(data, size, path, span, context, status);
    g_bytes_unref(bytes);
    return image;
}
