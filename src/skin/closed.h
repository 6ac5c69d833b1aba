// Whether meshes are closed. Private to skin and to writers of files that must be.
#pragma once

#include "frond/skin.h"

/// The place of each corner: the first vertex that is there, in the whole mesh. Free with g_free().
uint32_t *fr_mesh_places(const FrMesh *mesh);
/// Edges of the mesh that do not have as many triangles one way as the other; points at one place
/// count as one. `is_closed` (NULL: nobody asks) receives, by triangle, whether the connected
/// surface it is part of has none.
uint64_t fr_mesh_open_edges(const FrMesh *mesh, bool *is_closed);
