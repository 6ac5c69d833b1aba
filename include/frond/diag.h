/// @file diag.h
/// What is wrong with the user's data, and where: sources, spans and diagnostics.
///
/// A function that can fail because of its input returns an FrStatus and adds diagnostics to
/// the caller's FrDiags. A reader recovers and goes on, so one run reports many errors.
/// `code` is stable ("unknown-attribute"); tests and tools match it, people read `text`.
#pragma once

#include "frond/api.h"

#include <glib.h>

/// The outcome of a call; the values are the exit codes of the `frond` program.
typedef enum FrStatus {
    FR_OK = 0,
    FR_ERR_DOCUMENT = 1, ///< the document or an input file is wrong
    FR_ERR_USAGE = 2,    ///< a command line or call makes no sense
    FR_ERR_LIMIT = 3,    ///< more was asked for than FrLimits allows; nothing was allocated
    FR_ERR_MACHINE = 4,  ///< disk, memory or permission
    FR_CANCELLED = 5,    ///< the caller's FrProgress was cancelled
} FrStatus;

typedef enum FrSeverity { FR_NOTE, FR_WARNING, FR_ERROR } FrSeverity;

/// A text that spans point into. Reference counted and immutable.
typedef struct FrSource FrSource;

/// Takes a copy of `text` (need not end with a zero). `name` is what messages print.
FR_API FrSource *fr_source_new(const char *name, const char *text, size_t size);
/// Reads a file of at most `max_bytes`. NULL with a diagnostic if it cannot be read.
typedef struct FrDiags FrDiags;
FR_API FrSource *fr_source_load(const char *path, uint64_t max_bytes, FrDiags *diags,
                                FrStatus *status);
/// A text that stands within another: byte i of it came from byte origins[i] of `outer`, its end
/// from origins[size]. Diagnostics about it point into `outer`.
FR_API FrSource *fr_source_within(FrSource *outer, const char *text, size_t size,
                                  const uint32_t *origins);
FR_API FrSource *fr_source_ref(FrSource *source);
FR_API void fr_source_unref(FrSource *source);
FR_API const char *fr_source_name(const FrSource *source);
/// The text, always followed by a zero byte that `size` does not count.
FR_API const char *fr_source_text(const FrSource *source, size_t *size);
/// Line and column, both from 1; columns count code points, a tab is one.
FR_API void fr_source_position(const FrSource *source, size_t offset, uint32_t *line,
                               uint32_t *column);

/// Bytes [begin, end) of a source; `source` is borrowed. {0} means "no place".
typedef struct FrSpan {
    FrSource *source;
    uint32_t begin;
    uint32_t end;
} FrSpan;

/// fr_source_load() for a name relative to `folder`, or absolute; what is not there is reported at
/// `span`, where it was named.
FR_API FrSource *fr_source_load_beside(const char *name, const char *folder, FrSpan span,
                                       uint64_t max_bytes, FrDiags *diags, FrStatus *status);
/// A span that starts `begin` bytes into `outer` and ends `end` bytes into it.
FR_API FrSpan fr_span_inside(FrSpan outer, size_t begin, size_t end);

/// The place in the outermost text of a span of a text within others.
FR_API FrSpan fr_span_outermost(FrSpan span);

typedef struct FrDiag {
    FrSeverity severity;
    const char *code; ///< static, kebab-case
    FrSpan span;      ///< outermost; its source is kept alive by the FrDiags
    char *text;       ///< one sentence, no full stop
} FrDiag;

/// Up to 20 diagnostics are kept, all are counted. Adding is thread-safe; parallel code
/// nevertheless reports after its loop, in index order, so that the list is deterministic.
FR_API FrDiags *fr_diags_new(void);
FR_API void fr_diags_free(FrDiags *diags);
/// `diags` may be NULL: then nothing is kept.
FR_API void fr_diags_add(FrDiags *diags, FrSeverity severity, const char *code, FrSpan span,
                         const char *format, ...) FR_PRINTF(5, 6);
FR_API size_t fr_diags_count(const FrDiags *diags);
FR_API const FrDiag *fr_diags_get(const FrDiags *diags, size_t index);
/// All errors ever added, also those over the 20 kept.
FR_API size_t fr_diags_error_count(const FrDiags *diags);
/// Appends `file:line:col: error: text [code]`, the line and a caret for each diagnostic.
FR_API void fr_diags_print(const FrDiags *diags, GString *out);
/// Appends a JSON array of {severity, code, file, line, column, end_line, end_column, text}.
FR_API void fr_diags_print_json(const FrDiags *diags, GString *out);

/// The candidate nearest to `name` by edit distance, or NULL if none is near enough to be a
/// plausible slip of the finger. `-` and `_` are equal.
FR_API const char *fr_nearest_name(const char *name, const char *const *candidates, size_t count);
