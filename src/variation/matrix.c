// Matrices of ramification: how often a branch of order k forks into which two.
// Viennot, Eyrolles, Janey, Arquès, SIGGRAPH 1989. Row k has the probabilities of forks into orders
// (k, 1) … (k, k − 1) and (k − 1, k − 1); no other pair makes a branch of order k. Random binary
// trees have 2⁻ⁱ and 2⁻⁽ᵏ⁻¹⁾, perfect ones only the last.
#include "variation/ramified.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A row may differ from 1 by so much: measured ones are rounded.
#define ROUNDING 0.011

void fr_matrix_known(FrRamified *ramified) {
    bool is_perfect = ramified->params.by == FR_RAMIFIED_PERFECT;
    for (uint32_t k = 2; k <= FR_RAMIFIED_ORDERS; k++) {
        double *row = ramified->rows[k];
        for (uint32_t i = 1; i < k; i++) {
            row[i - 1] = is_perfect ? 0.0 : ldexp(1.0, -(int)i);
        }
        row[k - 1] = is_perfect ? 1.0 : ldexp(1.0, 1 - (int)k);
    }
}

typedef struct FrMatrixReader {
    FrRamified *ramified;
    const FrSource *source;
    FrDiags *diags;
    uint32_t order; ///< of the next row
    FrStatus status;
} FrMatrixReader;

static void report(FrMatrixReader *reader, size_t begin, size_t end, const char *format, ...)
    FR_PRINTF(4, 5);
static void report(FrMatrixReader *reader, size_t begin, size_t end, const char *format, ...) {
    FrSpan span = {(FrSource *)reader->source, (uint32_t)begin, (uint32_t)end};
    va_list arguments;
    va_start(arguments, format);
    char *text = g_strdup_vprintf(format, arguments);
    va_end(arguments);
    fr_diags_add(reader->diags, FR_ERROR, "bad-matrix", span, "%s", text);
    g_free(text);
    reader->status = FR_ERR_DOCUMENT;
}

static void take_row(FrMatrixReader *reader, const double *numbers, uint32_t count, size_t begin,
                     size_t end) {
    uint32_t k = reader->order;
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        sum += numbers[i];
    }
    if (count != k) {
        report(reader, begin, end, "the row of order %u has %u numbers, not %u", k, k, count);
    } else if (fabs(sum - 1.0) > ROUNDING) {
        report(reader, begin, end, "the probabilities of a row are 1 together, these are %g", sum);
    } else if (!(numbers[k - 1] > 0.0)) {
        report(reader, begin, end, "the last number of a row is not 0, or branches never end");
    }
    for (uint32_t i = 0; i < k && i < count; i++) {
        reader->ramified->rows[k][i] = numbers[i] / sum;
    }
    if (k == (uint32_t)reader->ramified->params.order + 1) {
        FrSpan span = {(FrSource *)reader->source, (uint32_t)begin, (uint32_t)end};
        fr_diags_add(reader->diags, FR_WARNING, "unused-rows", span,
                     "rows from order %u on are not used, as 'order' is %d", k,
                     (int)reader->ramified->params.order);
    }
    reader->order++;
}

static void read_row(FrMatrixReader *reader, const char *text, size_t begin, size_t end) {
    double numbers[FR_RAMIFIED_ORDERS];
    uint32_t count = 0;
    size_t first = begin;
    for (size_t at = begin; at < end;) {
        while (at < end && strchr(" \t\r,;", text[at]) != NULL) {
            at++;
        }
        if (at >= end || text[at] == '#') {
            break;
        }
        first = count == 0 ? at : first;
        char *stop;
        double number = g_ascii_strtod(text + at, &stop);
        size_t next = (size_t)(stop - text);
        if (next == at || next > end || !(number >= 0.0 && number <= 1.0)) {
            report(reader, at, end, "a row has probabilities from 0 to 1");
            return;
        }
        if (count == FR_RAMIFIED_ORDERS || reader->order > FR_RAMIFIED_ORDERS) {
            report(reader, at, end, "a matrix has rows for orders up to %d", FR_RAMIFIED_ORDERS);
            return;
        }
        numbers[count++] = number;
        at = next;
        end = MAX(end, at);
    }
    if (count > 0) {
        take_row(reader, numbers, count, first, end);
    }
}

FrStatus fr_matrix_read(FrRamified *ramified, const FrSource *source, const FrContext *context) {
    size_t size;
    const char *text = fr_source_text(source, &size);
    char *copy = g_strndup(text, size); // ends with a zero, where numbers cannot run on
    size_t length = strlen(copy);
    FrMatrixReader reader = {ramified, source, context->diags, 2, FR_OK};
    for (size_t begin = 0; begin < length && reader.status == FR_OK;) {
        const char *next = memchr(copy + begin, '\n', length - begin);
        size_t end = next != NULL ? (size_t)(next - copy) : length;
        read_row(&reader, copy, begin, end);
        begin = end + 1;
    }
    if (reader.status == FR_OK && reader.order <= ramified->params.order) {
        report(&reader, 0, length, "an order of %d needs rows for orders 2 to %d, not to %u",
               (int)ramified->params.order, (int)ramified->params.order, reader.order - 1);
    }
    g_free(copy);
    return reader.status;
}
