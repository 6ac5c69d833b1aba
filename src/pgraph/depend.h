/// @file depend.h
/// What instances depend on. This is the place where every input of a build must be known.
///
/// An instance is made from
///
/// - the build's own inputs: fr_depend_inputs(). An input that is no parameter (seed, time) goes
/// there;
/// - what its parent hands down (FR_LEVEL_SITE in level.h), all of which comes from the same;
/// - its stage: fr_depend_stages(). All parameters of its component count, those of the tables that
///   are yet to come included, but for the few that act on shapes and looks only; so do the links
///   of the stage and what instances read of the components they lead to.
///
/// What is read from anywhere else would be missed when it changes. tests/scene/test_rebuild.c
/// changes every parameter of every component and compares with a whole build.
#pragma once

#include "pgraph/instance.h"

/// Digest of what all instances depend on.
FrDigest fr_depend_inputs(const FrPgraph *graph);
/// Digests, by stage, of what its instances depend on besides; to be freed with g_free().
FrDigest *fr_depend_stages(const FrExpansion *expansion);
/// Digest of the indices that instances write into rows: of shapes, profiles, materials,
/// deformations, components.
FrDigest fr_depend_tables(const FrExpansion *expansion);
/// Whether leaves have shapes of their own, found while they are made.
bool fr_depend_has_own_shapes(const FrExpansion *expansion);
