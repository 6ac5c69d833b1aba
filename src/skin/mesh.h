// Memory of meshes.
#pragma once

#include "frond/skin.h"

/// A mesh with that much room and no contents. NULL if the machine has no memory for it.
FrMesh *fr_mesh_new(uint64_t vertices, uint64_t indices, uint32_t parts);
/// Memory for a large array that is written once from end to end; NULL if there is none. free() it.
void *fr_mesh_allocate(uint64_t bytes);
/// Sets a part's bounds. Zeros become one of both, whatever was written first.
void fr_part_set_box(FrMeshPart *part, const float min[3], const float max[3]);
