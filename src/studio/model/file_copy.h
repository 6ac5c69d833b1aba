/// @file file_copy.h
/// Reading files that a document names, and writing copies that take the place of nothing.
#pragma once

#include <glib.h>
#include <stdbool.h>

/// Whether a name is that of a file beneath a folder: not absolute, and without `..`.
bool studio_name_is_inside(const char *name);
/// The bytes of a regular file of at most `most`, its name relative to `folder` or absolute.
/// `is_inside`: it must lie beneath the folder, and no link be on the way. Free with
/// g_bytes_unref(); NULL, and `*why` (a constant) completes a sentence that begins with its name.
GBytes *studio_file_read(const char *folder, const char *name, bool is_inside, size_t most,
                         const char **why);

typedef enum StudioTarget {
    STUDIO_TARGET_FREE,  ///< nothing is called so
    STUDIO_TARGET_SAME,  ///< a file with these bytes
    STUDIO_TARGET_OTHER, ///< anything else, a link too
} StudioTarget;

StudioTarget studio_target_state(const char *path, GBytes *bytes);
/// Writes a file that is not there yet; false, and nothing is left of it.
bool studio_file_create(const char *path, GBytes *bytes);
