/// @file tangents.h
/// Tangents for normal maps, which FrVertex does not hold.
#pragma once

#include "frond/skin.h"

/// Four floats for each vertex of a part, as glTF wants them: the unit direction of growing u,
/// perpendicular to the normal, and the sign that makes sign · (normal × tangent) point up in the
/// picture. Free with g_free().
float (*fr_tangents_new(const FrMesh *mesh, const FrMeshPart *part, const FrContext *context))[4];
