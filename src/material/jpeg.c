#include "frond/image.h"

#include "material/codec.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <jerror.h>
#include <jpeglib.h>

/// A progressive file of a few bytes may ask for thousands of passes over its pixels.
enum { MOST_SCANS = 200 };

typedef struct Decoder {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    jmp_buf escape;
    char message[JMSG_LENGTH_MAX];
    bool is_cut_short;
    FrStatus status;
    FrImage *image;
    uint8_t *row; ///< four channels of ink, only where the file has them
} Decoder;

static Decoder *decoder_of(j_common_ptr jpeg) {
    return jpeg->client_data;
}

G_GNUC_NORETURN static void leave(j_common_ptr jpeg) {
    jpeg->err->format_message(jpeg, decoder_of(jpeg)->message);
    longjmp(decoder_of(jpeg)->escape, 1);
}

/// libjpeg fills what is missing with grey and only warns.
static void listen(j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) {
        decoder_of(jpeg)->is_cut_short = true;
    }
}

static void say_nothing(j_common_ptr jpeg) {
    (void)jpeg;
}

static void count_scans(j_common_ptr jpeg) {
    Decoder *decoder = decoder_of(jpeg);
    if (decoder->jpeg.input_scan_number > MOST_SCANS) {
        g_strlcpy(decoder->message, "too many scans", sizeof decoder->message);
        longjmp(decoder->escape, 1);
    }
}

/// Four inks to three lights; Adobe writes the inks inverted.
static void inks_to_rgb(const uint8_t *inks, uint8_t *rgb, uint32_t width, bool is_inverted) {
    for (uint32_t x = 0; x < width; x++, inks += 4, rgb += 3) {
        for (int c = 0; c < 3; c++) {
            int ink = is_inverted ? inks[c] : 255 - inks[c];
            int black = is_inverted ? inks[3] : 255 - inks[3];
            rgb[c] = (uint8_t)(ink * black / 255);
        }
    }
}

static void read_rows(Decoder *decoder) {
    struct jpeg_decompress_struct *jpeg = &decoder->jpeg;
    FrImage *image = decoder->image;
    size_t stride = (size_t)image->width * image->channels;
    while (jpeg->output_scanline < jpeg->output_height) {
        uint8_t *target = image->pixels + jpeg->output_scanline * stride;
        uint8_t *row = decoder->row != NULL ? decoder->row : target;
        jpeg_read_scanlines(jpeg, &row, 1);
        if (decoder->row != NULL) {
            inks_to_rgb(row, target, image->width, jpeg->saw_Adobe_marker != 0);
        }
    }
}

/// The part that may jump out. Everything it makes hangs on the decoder.
static void decode(Decoder *decoder, const void *data, size_t size, const FrPictureOrigin *origin) {
    struct jpeg_decompress_struct *jpeg = &decoder->jpeg;
    jpeg_create_decompress(jpeg);
    jpeg->client_data = decoder;
    jpeg->progress = &decoder->progress;
    jpeg_mem_src(jpeg, data, (unsigned long)size);
    jpeg_read_header(jpeg, TRUE);
    decoder->status = fr_limit_check(fr_count_multiply(jpeg->image_width, jpeg->image_height),
                                     origin->context->limits.pixels, "pixels", origin->name,
                                     origin->span, origin->context->diags);
    if (decoder->status != FR_OK) {
        return;
    }
    bool has_inks = jpeg->jpeg_color_space == JCS_CMYK || jpeg->jpeg_color_space == JCS_YCCK;
    bool is_grey = jpeg->jpeg_color_space == JCS_GRAYSCALE;
    jpeg->out_color_space = has_inks ? JCS_CMYK : is_grey ? JCS_GRAYSCALE : JCS_RGB;
    jpeg->dct_method = JDCT_ISLOW; // the same pixels on every machine
    jpeg_start_decompress(jpeg);
    decoder->image = fr_image_new(jpeg->output_width, jpeg->output_height, is_grey ? 1 : 3);
    if (has_inks) {
        decoder->row = g_malloc((size_t)jpeg->output_width * 4);
    }
    read_rows(decoder);
    jpeg_finish_decompress(jpeg);
}

FrStatus fr_jpeg_read(const void *data, size_t size, const FrPictureOrigin *origin,
                      FrImage **image) {
    Decoder *decoder = g_new0(Decoder, 1); // on the heap: a jump leaves its fields defined
    decoder->jpeg.err = jpeg_std_error(&decoder->errors);
    decoder->jpeg.client_data = decoder;
    decoder->errors.error_exit = leave;
    decoder->errors.emit_message = listen;
    decoder->errors.output_message = say_nothing;
    decoder->progress.progress_monitor = count_scans;
    bool has_failed = setjmp(decoder->escape) != 0;
    if (!has_failed) {
        decode(decoder, data, size, origin);
    }
    if (decoder->is_cut_short && !has_failed) {
        g_strlcpy(decoder->message, "it ends too early", sizeof decoder->message);
        has_failed = true;
    }
    if (has_failed) {
        fr_diags_add(origin->context->diags, FR_ERROR, "picture-damaged", origin->span,
                     "'%s' is not a whole JPEG picture: %s", origin->name, decoder->message);
        g_clear_pointer(&decoder->image, fr_image_unref);
        decoder->status = FR_ERR_DOCUMENT;
    }
    jpeg_destroy_decompress(&decoder->jpeg);
    *image = decoder->image;
    FrStatus status = decoder->status;
    g_free(decoder->row);
    g_free(decoder);
    return status;
}
