/// Height maps from PNG files: all of their 8 or 16 bits, as they are.
#include "frond/image.h"

#include "material/codec.h"

#include <png.h>
#include <string.h>

/// A file in memory that libpng reads; it jumps back here where it fails.
typedef struct Feed {
    const uint8_t *data;
    size_t size, at;
    const char *reason;
} Feed;

static void feed_bytes(png_structp png, png_bytep out, png_size_t count) {
    Feed *feed = png_get_io_ptr(png);
    if (count > feed->size - feed->at) {
        png_error(png, "it ends too early");
    }
    memcpy(out, feed->data + feed->at, count);
    feed->at += count;
}

static void fail(png_structp png, png_const_charp message) {
    Feed *feed = png_get_error_ptr(png);
    feed->reason = g_intern_string(message);
    png_longjmp(png, 1);
}

static void ignore(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

/// Rows of 16 bits a pixel, high byte first; NULL after a failure. Nothing here is freed by hand
/// between setjmp and its end: `rows` holds it all.
static GByteArray *decode(png_structp png, png_infop info, GByteArray *rows, FrHeightMap *map,
                          uint64_t most) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return NULL;
    }
    png_read_info(png, info);
    map->width = png_get_image_width(png, info);
    map->height = png_get_image_height(png, info);
    if (fr_count_multiply(map->width, map->height) > most) {
        return rows;
    }
    png_set_expand_16(png);
    png_set_strip_alpha(png);
    if ((png_get_color_type(png, info) & PNG_COLOR_MASK_COLOR) != 0) {
        png_set_rgb_to_gray(png, PNG_ERROR_ACTION_NONE, PNG_RGB_TO_GRAY_DEFAULT,
                            PNG_RGB_TO_GRAY_DEFAULT);
    }
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    size_t stride = png_get_rowbytes(png, info);
    g_byte_array_set_size(rows, (guint)(stride * map->height));
    memset(rows->data, 0, rows->len);
    for (int pass = 0; pass < passes; pass++) {
        for (uint32_t y = 0; y < map->height; y++) {
            png_read_row(png, rows->data + y * stride, NULL);
        }
    }
    return rows;
}

static FrStatus read_rows(Feed *feed, const char *name, FrSpan span, const FrContext *context,
                          FrHeightMap *map) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, feed, fail, ignore);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    FR_ASSERT(info != NULL);
    png_set_read_fn(png, feed, feed_bytes);
    // Its rows must fit a byte array, however much the limit allows.
    uint64_t most = MIN(context->limits.pixels, (uint64_t)1 << 30);
    GByteArray *rows = g_byte_array_new();
    GByteArray *read = decode(png, info, rows, map, most);
    png_destroy_read_struct(&png, &info, NULL);
    FrStatus status = FR_OK;
    if (read == NULL) {
        fr_diags_add(context->diags, FR_ERROR, "picture-damaged", span,
                     "'%s' is not a whole PNG picture: %s", name, feed->reason);
        status = FR_ERR_DOCUMENT;
    } else {
        status = fr_limit_check(fr_count_multiply(map->width, map->height), most, "pixels", name,
                                span, context->diags);
    }
    if (status == FR_OK) {
        size_t count = (size_t)map->width * map->height;
        map->heights = g_new(float, count);
        for (size_t i = 0; i < count; i++) {
            map->heights[i] =
                (float)((uint32_t)rows->data[2 * i] << 8 | rows->data[2 * i + 1]) / 65535.0F;
        }
    }
    g_byte_array_unref(rows);
    return status;
}

FrHeightMap *fr_height_map_load(const char *path, FrSpan span, const FrContext *context,
                                FrStatus *status) {
    GBytes *bytes = NULL;
    *status = fr_picture_read_file(path, span, context, &bytes);
    if (*status != FR_OK) {
        return NULL;
    }
    Feed feed = {.reason = "it is damaged"};
    feed.data = g_bytes_get_data(bytes, &feed.size);
    FrHeightMap *map = g_new0(FrHeightMap, 1);
    if (feed.size < 8 || png_sig_cmp(feed.data, 0, 8) != 0) {
        fr_diags_add(context->diags, FR_ERROR, "picture-format", span,
                     "'%s' is no PNG picture; height maps are", path);
        *status = FR_ERR_DOCUMENT;
    } else {
        *status = read_rows(&feed, path, span, context, map);
    }
    g_bytes_unref(bytes);
    if (*status != FR_OK) {
        fr_height_map_free(map);
        return NULL;
    }
    return map;
}

void fr_height_map_free(FrHeightMap *map) {
    if (map != NULL) {
        g_free(map->heights);
        g_free(map);
    }
}
