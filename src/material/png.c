#include "frond/image.h"

#include "material/codec.h"

#include <png.h>
#include <string.h>

// ---- reading ----------------------------------------------------------------------------------

static FrStatus refuse(const FrPictureOrigin *origin, png_image *png) {
    fr_diags_add(origin->context->diags, FR_ERROR, "picture-damaged", origin->span,
                 "'%s' is not a whole PNG picture: %s", origin->name, png->message);
    png_image_free(png);
    return FR_ERR_DOCUMENT;
}

FrStatus fr_png_read(const void *data, size_t size, const FrPictureOrigin *origin,
                     FrImage **image) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    *image = NULL;
    if (!png_image_begin_read_from_memory(&png, data, size)) {
        return refuse(origin, &png);
    }
    FrStatus status =
        fr_limit_check(fr_count_multiply(png.width, png.height), origin->context->limits.pixels,
                       "pixels", origin->name, origin->span, origin->context->diags);
    if (status != FR_OK) {
        png_image_free(&png);
        return status;
    }
    // 16 bits a channel would otherwise be taken for linear light.
    png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    bool has_alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    bool has_colour = (png.format & PNG_FORMAT_FLAG_COLOR) != 0;
    png.format = has_alpha ? PNG_FORMAT_RGBA : has_colour ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
    uint32_t channels = has_alpha ? 4 : has_colour ? 3 : 1;
    FrImage *result = fr_image_new(png.width, png.height, channels);
    if (!png_image_finish_read(&png, NULL, result->pixels, 0, NULL)) {
        fr_image_unref(result);
        return refuse(origin, &png);
    }
    *image = result;
    return FR_OK;
}

static uint32_t big_endian(const uint8_t *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

bool fr_png_declares_alpha(const void *data, size_t size) {
    enum { SIGNATURE = 8, AROUND_CHUNK = 12, COLOUR_TYPE = 25, WITH_ALPHA = 4 };
    const uint8_t *bytes = data;
    if (size <= COLOUR_TYPE) {
        return false;
    }
    if ((bytes[COLOUR_TYPE] & WITH_ALPHA) != 0) {
        return true;
    }
    for (size_t at = SIGNATURE; size - at >= AROUND_CHUNK;) {
        if (memcmp(bytes + at + 4, "tRNS", 4) == 0) {
            return true;
        }
        uint64_t step = (uint64_t)big_endian(bytes + at) + AROUND_CHUNK;
        if (memcmp(bytes + at + 4, "IDAT", 4) == 0 || step > size - at) {
            break;
        }
        at += (size_t)step;
    }
    return false;
}

// ---- writing ----------------------------------------------------------------------------------
// Not with png_image: that adds an sRGB chunk, which would be wrong for a normal map.

static void append(png_structp png, png_bytep data, png_size_t size) {
    g_byte_array_append(png_get_io_ptr(png), data, (guint)size);
}

static void flush_nothing(png_structp png) {
    (void)png;
}

/// libpng fails here only if memory ends, which ends the program as everywhere else.
static void fail(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
    const bool libpng_can_write = false;
    FR_ASSERT(libpng_can_write);
}

static void ignore(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

GBytes *fr_image_to_png(const FrImage *image) {
    int type = image->channels == 1   ? PNG_COLOR_TYPE_GRAY
               : image->channels == 3 ? PNG_COLOR_TYPE_RGB
                                      : PNG_COLOR_TYPE_RGBA;
    GByteArray *out = g_byte_array_new();
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, fail, ignore);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    FR_ASSERT(info != NULL);
    png_set_write_fn(png, out, append, flush_nothing);
    png_set_compression_level(png, 4);
    png_set_IHDR(png, info, image->width, image->height, 8, type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    size_t stride = (size_t)image->width * image->channels;
    for (uint32_t row = 0; row < image->height; row++) {
        png_write_row(png, image->pixels + row * stride);
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    return g_byte_array_free_to_bytes(out);
}
