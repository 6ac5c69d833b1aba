// The preprocessor of L-system files. It is that of C as the field's programs use it: `//` and
// `/* */` are comments even inside a string of modules, and a `#` that begins a line is a
// directive.
#include "lsystem/text.h"

#include "lsystem/macro.h"

#include <string.h>

#define MOST_INCLUDED 16
#define MOST_CONDITIONS 64

/// A state of the preprocessor: what is open, where output goes.
typedef struct Reader {
    FrLtext *text;
    FrLmacros macros;
    const FrContext *context;
    const char *folder;
    GHashTable *held; ///< names that are set from outside, borrowed
    int depth;        ///< of inclusion
    FrStatus status;
} Reader;

/// A logical line: comments removed, lines joined; each byte with its offset.
typedef struct Line {
    GString *bytes;
    GArray *origins; ///< uint32_t
    guint file;
    size_t begin, end; ///< in the source
    size_t comment;    ///< where one begins that nothing ends, else SIZE_MAX
} Line;

/// One #if: whether its branch is read now, whether any was.
typedef struct Branch {
    bool is_read, was_read, is_outer_read;
    size_t begin;
} Branch;

static void complain(Reader *reader, const Line *line, const char *code, const char *format,
                     const char *detail) {
    FrSpan span = {g_ptr_array_index(reader->text->sources, line->file), (uint32_t)line->begin,
                   (uint32_t)line->end};
    char *text = g_strdup_printf("%s%s", format, detail);
    fr_diags_add(reader->context->diags, FR_ERROR, code, span, "%s", text);
    g_free(text);
    reader->status = MAX(reader->status, FR_ERR_DOCUMENT);
}

static void put(Line *line, char c, size_t origin) {
    uint32_t offset = (uint32_t)origin;
    g_string_append_c(line->bytes, c);
    g_array_append_val(line->origins, offset);
}

// Reads one logical line that begins at `at`; returns where the next begins.
static size_t read_line(Line *line, const char *text, size_t size, size_t at) {
    g_string_truncate(line->bytes, 0);
    g_array_set_size(line->origins, 0);
    line->begin = at;
    bool is_quoted = false;
    while (at < size && text[at] != '\n') {
        char c = text[at], next = at + 1 < size ? text[at + 1] : '\0';
        if (c == '\\' &&
            (next == '\n' || (next == '\r' && at + 2 < size && text[at + 2] == '\n'))) {
            at += next == '\n' ? 2 : 3;
            continue;
        }
        if (!is_quoted && c == '/' && next == '/') {
            while (at < size && text[at] != '\n') {
                at++;
            }
            break;
        }
        if (!is_quoted && c == '/' && next == '*') {
            const char *close = g_strstr_len(text + at + 2, (gssize)(size - at - 2), "*/");
            put(line, ' ', at);
            line->comment = close == NULL ? at : SIZE_MAX;
            at = close == NULL ? size : (size_t)(close - text) + 2;
            continue;
        }
        if (is_quoted && c == '\\' && next != '\0') {
            put(line, c, at++);
            put(line, text[at], at);
            at++;
            continue;
        }
        is_quoted ^= c == '"';
        if (c != '\r' && c != '\0') {
            put(line, c, at);
        }
        at++;
    }
    line->end = at;
    return at < size ? at + 1 : at;
}

/// Where replaced bytes go.
typedef struct Target {
    FrLtext *text;
    const Line *line;
} Target;

static void append(void *data, const char *bytes, size_t size, size_t from) {
    Target *target = data;
    FrLtext *text = target->text;
    uint8_t file = (uint8_t)target->line->file;
    // What stands in the line as it is keeps its own places.
    bool is_same = from + size <= target->line->bytes->len &&
                   memcmp(target->line->bytes->str + from, bytes, size) == 0;
    g_string_append_len(text->bytes, bytes, (gssize)size);
    for (size_t i = 0; i < size; i++) {
        uint32_t origin = g_array_index(target->line->origins, uint32_t, is_same ? from + i : from);
        g_array_append_val(text->origins, origin);
        g_array_append_val(text->files, file);
    }
}

static void append_newline(Reader *reader, const Line *line) {
    FrLtext *text = reader->text;
    uint32_t origin = (uint32_t)line->end;
    uint8_t file = (uint8_t)line->file;
    g_string_append_c(text->bytes, '\n');
    g_array_append_val(text->origins, origin);
    g_array_append_val(text->files, file);
}

static void read_source(Reader *reader, FrSource *source);

static void include(Reader *reader, const Line *line, const char *rest) {
    const char *begin = strchr(rest, '"');
    const char *end = begin == NULL ? NULL : strchr(begin + 1, '"');
    if (end == NULL) {
        complain(reader, line, "include", "#include needs a file name in quotes", "");
        return;
    }
    if (reader->folder == NULL || reader->depth >= MOST_INCLUDED ||
        reader->text->sources->len >= 255) {
        complain(reader, line, "include",
                 reader->folder == NULL ? "there is no folder to include from"
                                        : "files include each other too deeply",
                 "");
        return;
    }
    char *name = g_strndup(begin + 1, (gsize)(end - begin - 1));
    char *path =
        g_path_is_absolute(name) ? g_strdup(name) : g_build_filename(reader->folder, name, NULL);
    FrStatus status = FR_OK;
    FrSource *source = NULL;
    if (g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        source = fr_source_load(path, reader->context->limits.document_bytes,
                                reader->context->diags, &status);
    } else {
        complain(reader, line, "include", "cannot include a file that is not there: ", name);
    }
    if (source != NULL) {
        reader->depth++;
        read_source(reader, source);
        reader->depth--;
        fr_source_unref(source);
    }
    reader->status = MAX(reader->status, status);
    g_free(path);
    g_free(name);
}

/// Whether the name that a directive is about is set from outside.
static bool is_held(Reader *reader, const char *rest, bool is_defined) {
    rest += strspn(rest, " \t");
    size_t length = 0;
    while (g_ascii_isalnum(rest[length]) || rest[length] == '_') {
        length++;
    }
    char *name = g_strndup(rest, length);
    bool is_known = g_hash_table_contains(reader->held, name);
    if (is_defined) {
        g_ptr_array_add(reader->text->defined, g_strdup(name));
    }
    if (is_known) {
        g_hash_table_add(reader->text->held, name);
    } else {
        g_free(name);
    }
    return is_known;
}

static bool is_true(Reader *reader, const Line *line, const char *word, const char *rest) {
    if (strcmp(word, "ifdef") == 0 || strcmp(word, "ifndef") == 0) {
        char *name = g_strstrip(g_strdup(rest));
        bool is_defined =
            is_held(reader, rest, false) || g_hash_table_contains(reader->macros.table, name);
        g_free(name);
        return is_defined == (word[2] == 'd');
    }
    bool is_valid;
    long long value = fr_lmacros_condition(&reader->macros, rest, &is_valid);
    if (!is_valid) {
        complain(reader, line, "directive", "this is no condition: ", rest + strspn(rest, " \t"));
    }
    return is_valid && value != 0;
}

// #if, #ifdef, #ifndef, #elif, #else, #endif. False for other directives.
static bool obey_condition(Reader *reader, const Line *line, GArray *branches, const char *word,
                           const char *rest) {
    Branch *inner = branches->len == 0 ? NULL : &g_array_index(branches, Branch, branches->len - 1);
    bool is_read = inner == NULL || inner->is_read;
    if (g_str_has_prefix(word, "if")) {
        if (branches->len >= MOST_CONDITIONS) {
            complain(reader, line, "directive", "conditions are nested too deeply", "");
            return true;
        }
        bool is_taken = is_read && is_true(reader, line, word, rest);
        Branch branch = {is_taken, is_taken, is_read, line->begin};
        g_array_append_val(branches, branch);
        return true;
    }
    bool is_else = strcmp(word, "else") == 0, is_elif = strcmp(word, "elif") == 0;
    bool is_end = strcmp(word, "endif") == 0;
    if (!is_else && !is_elif && !is_end) {
        return false;
    }
    if (inner == NULL) {
        complain(reader, line, "directive", "there is no #if for this #", word);
    } else if (is_end) {
        g_array_set_size(branches, branches->len - 1);
    } else {
        bool may = inner->is_outer_read && !inner->was_read;
        inner->is_read = may && (is_else || is_true(reader, line, word, rest));
        inner->was_read |= inner->is_read;
    }
    return true;
}

static void obey(Reader *reader, const Line *line, GArray *branches, const char *directive) {
    while (*directive == ' ' || *directive == '\t') {
        directive++;
    }
    size_t length = 0;
    while (g_ascii_isalpha(directive[length])) {
        length++;
    }
    char *word = g_strndup(directive, length);
    const char *rest = directive + length;
    bool is_condition = obey_condition(reader, line, branches, word, rest);
    bool is_read = branches->len == 0 || g_array_index(branches, Branch, branches->len - 1).is_read;
    if (is_condition || !is_read || (length == 0 && *rest == '\0')) {
        // nothing more to do
    } else if (strcmp(word, "define") == 0) {
        if (!is_held(reader, rest, true) && !fr_lmacros_define(&reader->macros, rest)) {
            complain(reader, line, "directive", "#define needs a name", "");
        }
    } else if (strcmp(word, "undef") == 0) {
        char *name = g_strstrip(g_strdup(rest));
        g_hash_table_remove(reader->macros.table, name);
        g_free(name);
    } else if (strcmp(word, "include") == 0) {
        include(reader, line, rest);
    } else if (strcmp(word, "error") == 0) {
        complain(reader, line, "directive", "#error", rest);
    } else if (strcmp(word, "pragma") != 0 && strcmp(word, "line") != 0) {
        complain(reader, line, "directive",
                 "a '#' that begins a line begins a directive, and there is none of this name "
                 "(a predecessor '#' is written '* < #'): #",
                 directive);
    }
    g_free(word);
}

static void read_lines(Reader *reader, Line *line, GArray *branches, FrSource *source) {
    size_t size;
    const char *text = fr_source_text(source, &size);
    bool has_mark = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0; // of UTF-8
    for (size_t at = has_mark ? 3 : 0; at < size && !reader->macros.is_full;) {
        at = read_line(line, text, size, at);
        const char *begin = line->bytes->str;
        while (*begin == ' ' || *begin == '\t') {
            begin++;
        }
        if (*begin == '#') {
            obey(reader, line, branches, begin + 1);
        } else if (branches->len == 0 ||
                   g_array_index(branches, Branch, branches->len - 1).is_read) {
            Target target = {reader->text, line};
            fr_lmacros_expand(&reader->macros, line->bytes->str, line->bytes->len, append, &target);
            append_newline(reader, line);
        }
    }
}

static void read_source(Reader *reader, FrSource *source) {
    g_ptr_array_add(reader->text->sources, fr_source_ref(source));
    Line line = {.bytes = g_string_new(NULL),
                 .origins = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
                 .file = reader->text->sources->len - 1,
                 .comment = SIZE_MAX};
    GArray *branches = g_array_new(FALSE, FALSE, sizeof(Branch));
    read_lines(reader, &line, branches, source);
    if (line.comment != SIZE_MAX) {
        line.begin = line.comment;
        line.end = line.begin + 2;
        complain(reader, &line, "comment", "no '*/' ends the comment that begins here", "");
        reader->text->is_cut = true;
    } else if (branches->len > 0) {
        line.begin = g_array_index(branches, Branch, branches->len - 1).begin;
        line.end = line.begin + 3;
        complain(reader, &line, "directive", "there is no #endif for this #if", "");
    }
    g_array_unref(branches);
    g_array_unref(line.origins);
    g_string_free(line.bytes, TRUE);
}

FrLtext *fr_ltext_new(FrSource *source, const char *folder, const FrLname *names, size_t count,
                      const FrContext *context, FrStatus *status) {
    FrLtext *text = g_new(FrLtext, 1);
    *text = (FrLtext){g_string_new(NULL),
                      g_array_new(FALSE, FALSE, sizeof(uint32_t)),
                      g_array_new(FALSE, FALSE, sizeof(uint8_t)),
                      g_ptr_array_new_with_free_func((GDestroyNotify)fr_source_unref),
                      g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
                      g_ptr_array_new_with_free_func(g_free),
                      false};
    Reader reader = {.text = text,
                     .context = context,
                     .folder = folder,
                     .held = g_hash_table_new(g_str_hash, g_str_equal),
                     .status = FR_OK};
    fr_lmacros_init(&reader.macros, context->limits.document_bytes);
    for (size_t i = 0; i < count; i++) {
        if (names[i].is_held) {
            g_hash_table_add(reader.held, (gpointer)names[i].name);
            continue;
        }
        char *definition = g_strdup_printf("%s %d", names[i].name, names[i].value);
        fr_lmacros_define(&reader.macros, definition);
        g_free(definition);
    }
    read_source(&reader, source);
    if (reader.macros.is_full) {
        reader.status = fr_limit_check(UINT64_MAX, context->limits.document_bytes, "document_bytes",
                                       "replacing the macros of this file", (FrSpan){source, 0, 0},
                                       context->diags);
    } else if (reader.macros.is_deep) {
        fr_diags_add(context->diags, FR_ERROR, "directive", (FrSpan){source, 0, 0},
                     "macros are nested too deeply");
        reader.status = MAX(reader.status, FR_ERR_DOCUMENT);
    }
    fr_lmacros_clear(&reader.macros);
    g_hash_table_unref(reader.held);
    *status = reader.status;
    if (reader.status == FR_ERR_LIMIT) {
        fr_ltext_free(text);
        return NULL;
    }
    return text;
}

void fr_ltext_free(FrLtext *text) {
    if (text == NULL) {
        return;
    }
    g_string_free(text->bytes, TRUE);
    g_array_unref(text->origins);
    g_array_unref(text->files);
    g_ptr_array_unref(text->sources);
    g_hash_table_unref(text->held);
    g_ptr_array_unref(text->defined);
    g_free(text);
}

FrSpan fr_ltext_span(const FrLtext *text, size_t begin, size_t end) {
    size_t size = text->bytes->len;
    if (size == 0) {
        return (FrSpan){g_ptr_array_index(text->sources, 0), 0, 0};
    }
    size_t first = MIN(begin, size - 1), last = end > first ? MIN(end, size) - 1 : first;
    guint file = g_array_index(text->files, uint8_t, first);
    uint32_t from = g_array_index(text->origins, uint32_t, first);
    uint32_t to = g_array_index(text->origins, uint32_t, last) + (end > begin);
    bool is_whole = g_array_index(text->files, uint8_t, last) == file && to >= from;
    return (FrSpan){g_ptr_array_index(text->sources, file), from, is_whole ? to : from + 1};
}
