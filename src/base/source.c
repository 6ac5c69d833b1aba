// Texts that diagnostics point into.
#include "frond/diag.h"
#include "frond/limits.h"

#include "base/text.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MARK_STRIDE = 1 << 14 }; // bytes between marks

// Where a character begins, and its line and column: from the nearest mark before it, a place is
// found in one stride.
typedef struct Mark {
    size_t offset;
    uint32_t line, column;
} Mark;

struct FrSource {
    atomic_int references;
    char *name;
    char *text;
    size_t size;
    pthread_mutex_t lock; // guards `marks`
    GArray *marks;        // of Mark, the first at 0; NULL until a place is asked for
    FrSource *outer;      // the text around it, NULL
    uint32_t *origins;    // … and where in that each byte and the end stand
};

// Takes over `text`, which has a zero byte after `size`.
static FrSource *new_source(const char *name, char *text, size_t size) {
    FR_ASSERT(size < UINT32_MAX); // spans hold 32-bit offsets; readers are limited before
    FrSource *source = g_new0(FrSource, 1);
    atomic_init(&source->references, 1);
    pthread_mutex_init(&source->lock, NULL);
    source->name = g_strdup(name);
    source->text = text;
    source->size = size;
    return source;
}

FrSource *fr_source_new(const char *name, const char *text, size_t size) {
    char *copy = g_malloc(size + 1);
    if (size > 0) {
        memcpy(copy, text, size);
    }
    copy[size] = 0;
    return new_source(name, copy, size);
}

FrSource *fr_source_within(FrSource *outer, const char *text, size_t size,
                           const uint32_t *origins) {
    FrSource *source = fr_source_new(outer->name, text, size);
    source->outer = fr_source_ref(outer);
    source->origins = g_memdup2(origins, (size + 1) * sizeof *origins);
    return source;
}

FrSpan fr_span_outermost(FrSpan span) {
    while (span.source != NULL && span.source->outer != NULL) {
        const FrSource *source = span.source;
        uint32_t last = (uint32_t)source->size;
        uint32_t begin = MIN(span.begin, last), end = MIN(span.end, last);
        // The end is behind the last byte, wherever the next one stands.
        uint32_t outer_end = end > begin ? source->origins[end - 1] + 1 : source->origins[begin];
        span = (FrSpan){source->outer, source->origins[begin], outer_end};
    }
    return span;
}

static FrSource *fail(FrDiags *diags, FrStatus *status, FrStatus why, const char *path,
                      const char *reason) {
    fr_diags_add(diags, FR_ERROR, "cannot-read", (FrSpan){0}, "cannot read '%s': %s", path, reason);
    if (status != NULL) {
        *status = why;
    }
    return NULL;
}

static FrSource *fail_by_errno(FrDiags *diags, FrStatus *status, int error, const char *path) {
    bool is_wrong_path = error == ENOENT || error == ENOTDIR || error == EISDIR ||
                         error == ENAMETOOLONG || error == ELOOP || error == ENXIO;
    return fail(diags, status, is_wrong_path ? FR_ERR_DOCUMENT : FR_ERR_MACHINE, path,
                g_strerror(error));
}

// Reads until `capacity` bytes or the end; -1 with errno set on failure.
static ssize_t read_all(int file, char *to, size_t capacity) {
    size_t size = 0;
    while (size < capacity) {
        ssize_t got = read(file, to + size, capacity - size);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            return -1;
        }
        if (got == 0) {
            break;
        }
        size += (size_t)got;
    }
    return (ssize_t)size;
}

static FrSource *load_open_file(int file, const char *path, uint64_t max_bytes, FrDiags *diags,
                                FrStatus *status) {
    struct stat about;
    if (fstat(file, &about) != 0) {
        return fail_by_errno(diags, status, errno, path);
    }
    if (!S_ISREG(about.st_mode)) {
        return fail(diags, status, FR_ERR_DOCUMENT, path,
                    S_ISDIR(about.st_mode) ? "it is a folder" : "it is not a regular file");
    }
    if (max_bytes >= UINT32_MAX) {
        max_bytes = UINT32_MAX - 1;
    }
    FrStatus limited = fr_limit_check((uint64_t)about.st_size, max_bytes, "document_bytes", path,
                                      (FrSpan){0}, diags);
    if (limited != FR_OK) {
        if (status != NULL) {
            *status = limited;
        }
        return NULL;
    }
    char *text = g_try_malloc((size_t)about.st_size + 1);
    if (text == NULL) {
        return fail_by_errno(diags, status, ENOMEM, path);
    }
    ssize_t size = read_all(file, text, (size_t)about.st_size);
    if (size < 0) {
        int error = errno;
        g_free(text);
        return fail_by_errno(diags, status, error, path);
    }
    text[size] = 0;
    if (status != NULL) {
        *status = FR_OK;
    }
    return new_source(path, text, (size_t)size);
}

FrSource *fr_source_load(const char *path, uint64_t max_bytes, FrDiags *diags, FrStatus *status) {
    // What is beside a file of this folder is called as it is there.
    while (g_str_has_prefix(path, "./") && path[2] != '/' && path[2] != '\0') {
        path += 2;
    }
    // Not blocking: opening a pipe that nobody writes to must not hang.
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        return fail_by_errno(diags, status, errno, path);
    }
    FrSource *source = load_open_file(file, path, max_bytes, diags, status);
    close(file);
    return source;
}

FrSource *fr_source_load_beside(const char *name, const char *folder, FrSpan span,
                                uint64_t max_bytes, FrDiags *diags, FrStatus *status) {
    char *path = g_path_is_absolute(name) ? g_strdup(name) : g_build_filename(folder, name, NULL);
    FrSource *source = NULL;
    if (g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        source = fr_source_load(path, max_bytes, diags, status);
    } else {
        fr_diags_add(diags, FR_ERROR, "missing-file", span, "the file '%s' is not there", name);
        *status = FR_ERR_DOCUMENT;
    }
    g_free(path);
    return source;
}

FrSource *fr_source_ref(FrSource *source) {
    if (source != NULL) {
        atomic_fetch_add(&source->references, 1);
    }
    return source;
}

void fr_source_unref(FrSource *source) {
    if (source == NULL || atomic_fetch_sub(&source->references, 1) > 1) {
        return;
    }
    if (source->marks != NULL) {
        g_array_unref(source->marks);
    }
    pthread_mutex_destroy(&source->lock);
    fr_source_unref(source->outer);
    g_free(source->origins);
    g_free(source->name);
    g_free(source->text);
    g_free(source);
}

const char *fr_source_name(const FrSource *source) {
    return source->name;
}

const char *fr_source_text(const FrSource *source, size_t *size) {
    if (size != NULL) {
        *size = source->size;
    }
    return source->text;
}

// Steps on while the character at the mark ends before or at `target`. An offset within a character
// has the column of that character.
static Mark walk(const FrSource *source, Mark at, size_t target) {
    const char *end = source->text + source->size;
    while (at.offset < target) {
        TextChar c = fr_text_char(source->text + at.offset, end);
        if (at.offset + c.size > target) {
            break;
        }
        at.offset += c.size;
        at.column++;
        if (c.code == '\n') {
            at.line++;
            at.column = 1;
        }
    }
    return at;
}

static GArray *make_marks(const FrSource *source) {
    GArray *marks = g_array_new(FALSE, FALSE, sizeof(Mark));
    Mark at = {0, 1, 1};
    g_array_append_val(marks, at);
    for (size_t target = MARK_STRIDE; target <= source->size; target += MARK_STRIDE) {
        at = walk(source, at, target);
        g_array_append_val(marks, at);
    }
    return marks;
}

void fr_source_position(const FrSource *source, size_t offset, uint32_t *line, uint32_t *column) {
    FrSource *cache = (FrSource *)source; // the marks are a cache: they do not change the source
    pthread_mutex_lock(&cache->lock);
    if (cache->marks == NULL) {
        cache->marks = make_marks(source);
    }
    pthread_mutex_unlock(&cache->lock);
    size_t target = offset < source->size ? offset : source->size;
    Mark mark = g_array_index(source->marks, Mark, target / MARK_STRIDE);
    mark = walk(source, mark, target);
    *line = mark.line;
    *column = mark.column;
}

FrSpan fr_span_inside(FrSpan outer, size_t begin, size_t end) {
    size_t size = outer.end - outer.begin;
    size_t inner_begin = begin < size ? begin : size;
    size_t inner_end = end < size ? end : size;
    return (FrSpan){
        .source = outer.source,
        .begin = outer.begin + (uint32_t)inner_begin,
        .end = outer.begin + (uint32_t)(inner_end < inner_begin ? inner_begin : inner_end),
    };
}
