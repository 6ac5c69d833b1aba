/// @file companions.h
/// Files that a mesh names itself: materials and pictures of an .obj, buffers and pictures of a
/// .gltf.
#pragma once

#include <glib.h>

/// Adds the names (char *, owned) that a file with these bytes names, by its ending. Data within
/// the file is none.
void studio_add_companions(const char *name, GBytes *bytes, GPtrArray *names);
