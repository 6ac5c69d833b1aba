#include "io/output.h"

#include <errno.h>
#include <glib.h>
#include <math.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

// Written at most so much at once, so that progress moves and Ctrl-C is heard.
static const size_t stride = (size_t)64 << 20;
enum { FR_PIECES = 64 };

bool fr_write_chunks(int descriptor, const FrChunk *chunks, size_t count, FrProgress *progress) {
    uint64_t total = 0;
    for (size_t i = 0; i < count; i++) {
        total += chunks[i].size;
    }
    uint64_t done = 0;
    size_t at = 0;     // chunk
    size_t offset = 0; // in it
    while (at < count) {
        if (fr_progress_is_cancelled(progress)) {
            errno = ECANCELED;
            return false;
        }
        struct iovec pieces[FR_PIECES];
        int used = 0;
        size_t room = stride;
        for (size_t i = at; i < count && used < FR_PIECES && room > 0; i++) {
            size_t begin = i == at ? offset : 0;
            size_t size = MIN(chunks[i].size - begin, room);
            pieces[used].iov_base = (char *)chunks[i].data + begin;
            pieces[used++].iov_len = size;
            room -= size;
        }
        ssize_t written = writev(descriptor, pieces, used);
        if (written < 0 && errno != EINTR) {
            return false;
        }
        size_t left = written > 0 ? (size_t)written : 0;
        done += left;
        while (at < count && left >= chunks[at].size - offset) {
            left -= chunks[at].size - offset;
            offset = 0;
            at++;
        }
        offset += left;
        fr_progress_report(progress, "write", (double)done / (double)MAX(total, 1));
    }
    return true;
}

void fr_output_start(FrOutput *output, int descriptor, FrProgress *progress) {
    *output = (FrOutput){
        .descriptor = descriptor,
        .buffer = g_malloc(FR_OUTPUT_BUFFER),
        .progress = progress,
    };
}

void fr_output_flush(FrOutput *output) {
    FrChunk chunk = {output->buffer, output->used};
    if (output->error == 0) {
        if (fr_progress_is_cancelled(output->progress)) {
            output->error = ECANCELED;
        } else if (!fr_write_chunks(output->descriptor, &chunk, 1, NULL)) {
            output->error = errno;
        }
    }
    output->done += output->used;
    output->used = 0;
}

bool fr_output_finish(FrOutput *output) {
    fr_output_flush(output);
    g_clear_pointer(&output->buffer, g_free);
    errno = output->error;
    return output->error == 0;
}

void fr_output_bytes(FrOutput *output, const void *data, size_t size) {
    const char *bytes = data;
    while (size > 0) {
        size_t part = MIN(size, (size_t)FR_OUTPUT_BUFFER);
        memcpy(fr_output_room(output, part), bytes, part);
        output->used += part;
        bytes += part;
        size -= part;
    }
}

void fr_output_text(FrOutput *output, const char *text) {
    fr_output_bytes(output, text, strlen(text));
}

/// Writes the digits of `value` before `end`, at least `least` of them; returns where they begin.
static char *digits_before(char *end, uint64_t value, int least) {
    do {
        *--end = (char)('0' + value % 10);
        value /= 10;
        least--;
    } while (value > 0 || least > 0);
    return end;
}

void fr_output_integer(FrOutput *output, uint64_t value) {
    char digits[24];
    char *begin = digits_before(digits + sizeof digits, value, 1);
    fr_output_bytes(output, begin, (size_t)(digits + sizeof digits - begin));
}

void fr_output_fixed(FrOutput *output, double value, int decimals) {
    static const double power[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
    double steps = nearbyint(fabs(value) * power[decimals]);
    // Beyond any model; kept from overflowing, and no number becomes 0.
    uint64_t scaled = steps < 9e18 ? (uint64_t)steps : 0;
    char text[32];
    char *end = text + sizeof text;
    uint64_t one = (uint64_t)power[decimals];
    uint64_t fraction = scaled % one;
    char *begin = end;
    if (fraction > 0) {
        while (fraction % 10 == 0) {
            fraction /= 10;
            decimals--;
        }
        begin = digits_before(begin, fraction, decimals);
        *--begin = '.';
    }
    begin = digits_before(begin, scaled / one, 1);
    if (value < 0 && scaled > 0) {
        *--begin = '-';
    }
    fr_output_bytes(output, begin, (size_t)(end - begin));
}
