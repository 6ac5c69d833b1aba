/// @file output.h
/// Putting bytes into a file: whole arrays as they are, or small pieces through one buffer.
#pragma once

#include "frond/progress.h"

/// A piece of a file, borrowed.
typedef struct FrChunk {
    const void *data;
    size_t size;
} FrChunk;

/// Writes arrays where they lie, without copying. False with errno (ECANCELED if `progress` was
/// cancelled).
bool fr_write_chunks(int descriptor, const FrChunk *chunks, size_t count, FrProgress *progress);

enum { FR_OUTPUT_BUFFER = 1 << 18 };

/// A buffered file. Errors are kept and told by fr_output_finish().
typedef struct FrOutput {
    int descriptor;
    int error;     ///< errno of the first failure, 0
    uint64_t done; ///< bytes written before the buffer
    size_t used;
    char *buffer;
    FrProgress *progress;
} FrOutput;

void fr_output_start(FrOutput *output, int descriptor, FrProgress *progress);
/// Writes the rest and frees the buffer. False with errno if anything failed.
bool fr_output_finish(FrOutput *output);
void fr_output_flush(FrOutput *output);

/// Room for `size` ≤ FR_OUTPUT_BUFFER bytes; the caller fills them and adds them to `used`.
static inline char *fr_output_room(FrOutput *output, size_t size) {
    if (output->used + size > FR_OUTPUT_BUFFER) {
        fr_output_flush(output);
    }
    return output->buffer + output->used;
}

void fr_output_bytes(FrOutput *output, const void *data, size_t size);
void fr_output_text(FrOutput *output, const char *text);
void fr_output_integer(FrOutput *output, uint64_t value);
/// Decimal fraction with `decimals` ≤ 6 places, trailing zeros left out, always with a point.
void fr_output_fixed(FrOutput *output, double value, int decimals);
