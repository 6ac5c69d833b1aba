// What pieces of a mesh are made from, as digests: a piece whose digest and place are as they were
// has the bits that it had.
//
// A run of tubes depends on its nodes and axes, on what its branches stand on (which depends in
// turn on what that stands on), on cross-sections, bark tiles and the settings. An organ depends on
// where it is and on its shape. What is read from anywhere else by what fr_write_run() and
// fr_write_piece() call belongs in here.
#pragma once

#include "skin/job.h"

/// Fills wood->digests, by run. Places are no part of them.
void fr_digest_wood(FrWood *wood);
/// Digests of where organs are, by organ, of those that are pieces; to be freed with
/// g_atomic_rc_box_release().
FrDigest *fr_digest_poses(const FrOrganPlan *organs);

/// Digests of the meshes of shapes.
typedef struct FrShapeDigest {
    FrDigest vertices, indices;
} FrShapeDigest;

/// By shape; to be freed with g_free().
FrShapeDigest *fr_digest_shapes(const FrOrganPlan *organs);

/// Two digests as one.
static inline FrDigest fr_digest_both(FrDigest a, FrDigest b) {
    return fr_key_child(a, b);
}
