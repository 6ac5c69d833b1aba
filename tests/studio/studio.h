/// @file studio.h
/// What tests of the studio's model share.
#pragma once

#include "studio/model/builder.h"
#include "studio/model/commands.h"

#include <glib/gstdio.h>
#include <string.h>

/// A file of the project. Free with g_free().
static inline char *project_file(const char *name) {
    const char *source = g_getenv("FROND_SOURCE");
    return g_build_filename(source == NULL ? "." : source, name, NULL);
}

static inline StudioDocument *open_example(const char *name) {
    char *path = project_file(name);
    StudioDocument *document;
    g_assert_cmpint(studio_document_open(path, NULL, &document), ==, FR_OK);
    g_free(path);
    return document;
}

static inline const char *text_of(const StudioDocument *document) {
    return fr_source_text(studio_document_source(document), NULL);
}

static inline uint32_t first_plant(const StudioDocument *document) {
    return fr_contents_child(studio_document_contents(document), 0, "plant");
}

static inline uint32_t element_of(const StudioDocument *document, const char *id) {
    uint32_t element = fr_contents_find(studio_document_contents(document), 0, id);
    g_assert_cmpuint(element, !=, FR_NONE);
    return element;
}

/// Removes a folder with all in it, a link without what it leads to. Returns how many files.
static inline guint remove_tree(const char *path) {
    GDir *directory = g_file_test(path, G_FILE_TEST_IS_SYMLINK) ? NULL : g_dir_open(path, 0, NULL);
    guint files = 0;
    if (directory == NULL) {
        g_assert_cmpint(g_unlink(path), ==, 0);
        return 1;
    }
    for (const char *name; (name = g_dir_read_name(directory)) != NULL;) {
        char *within = g_build_filename(path, name, NULL);
        files += remove_tree(within);
        g_free(within);
    }
    g_dir_close(directory);
    g_assert_cmpint(g_rmdir(path), ==, 0);
    return files;
}
