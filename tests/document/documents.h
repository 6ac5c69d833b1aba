/// Documents from strings, and what is said about them.
#pragma once

#include "frond/document.h"

#include <glib.h>
#include <string.h>

typedef struct Parsed {
    FrDocument *document;
    FrDiags *diags;
    FrStatus status;
} Parsed;

static inline Parsed parse_bytes(const char *text, size_t size) {
    Parsed parsed = {.diags = fr_diags_new()};
    FrContext context = fr_context_default();
    context.diags = parsed.diags;
    FrSource *source = fr_source_new("test.frond", text, size);
    parsed.status = fr_document_parse(source, NULL, &context, &parsed.document);
    fr_source_unref(source);
    return parsed;
}

static inline Parsed parse(const char *text) {
    return parse_bytes(text, strlen(text));
}

static inline void forget(Parsed *parsed) {
    fr_document_free(parsed->document);
    fr_diags_free(parsed->diags);
}

/// A document with `inner` in its root.
static inline char *in_root(const char *inner) {
    return g_strconcat("<frond version=\"1\">\n", inner, "\n</frond>\n", NULL);
}

/// The printed diagnostics.
static inline char *printed(const FrDiags *diags) {
    GString *text = g_string_new(NULL);
    fr_diags_print(diags, text);
    return g_string_free(text, FALSE);
}

/// Fails unless there is exactly one error, of that code, beginning at that line and column.
static inline void assert_one_error(const Parsed *parsed, FrStatus status, const char *code,
                                    uint32_t line, uint32_t column) {
    char *text = printed(parsed->diags);
    g_test_message("%s", text);
    g_free(text);
    g_assert_cmpint(parsed->status, ==, status);
    g_assert_cmpuint(fr_diags_error_count(parsed->diags), ==, 1);
    const FrDiag *diag = fr_diags_get(parsed->diags, 0);
    g_assert_cmpstr(diag->code, ==, code);
    uint32_t found_line, found_column;
    fr_source_position(diag->span.source, diag->span.begin, &found_line, &found_column);
    g_assert_cmpuint(found_line, ==, line);
    g_assert_cmpuint(found_column, ==, column);
}

/// The path of a file of the source tree; free with g_free().
static inline char *in_source(const char *path) {
    const char *root = g_getenv("FROND_SOURCE");
    g_assert_nonnull(root);
    return g_build_filename(root, path, NULL);
}

/// The paths of all documents in a folder of the source tree.
static inline GPtrArray *documents_in(const char *folder) {
    GPtrArray *paths = g_ptr_array_new_with_free_func(g_free);
    char *full = in_source(folder);
    GDir *directory = g_dir_open(full, 0, NULL);
    const char *name;
    while (directory != NULL && (name = g_dir_read_name(directory)) != NULL) {
        if (g_str_has_suffix(name, ".frond")) {
            g_ptr_array_add(paths, g_build_filename(full, name, NULL));
        }
    }
    if (directory != NULL) {
        g_dir_close(directory);
    }
    g_free(full);
    return paths;
}
