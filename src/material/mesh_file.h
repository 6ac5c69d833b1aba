// Private to the two files that read triangles.
#pragma once

#include "frond/mesh_file.h"

/// True for a relative path that does not lead upwards.
bool fr_mesh_path_is_inside(const char *name);
/// True for a name that a file of triangles may have; a diagnostic if not.
bool fr_mesh_name_check(const char *name, FrSpan span, FrDiags *diags);
/// Reads a file whose name and size have been looked at; parts may have unsound triangles. `text`
/// (NULL: none) is read in the place of what is in the file.
FrMeshFile *fr_mesh_file_import(const char *path, const char *name, const GBytes *text, FrSpan span,
                                const FrContext *context, FrStatus *status);
