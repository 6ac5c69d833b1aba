/// @file opf.h
/// An OPF file while it is written.
#pragma once

#include "io/meshes.h"
#include "io/organ_groups.h"
#include "io/output.h"
#include "io/topology.h"

/// What is kept of a plant that stands somewhere. Numbers are those of the file; a plant has one
/// material more than it names, the default, and a bark for each.
typedef struct FrOpfPlant {
    FrTopology topology;
    GArray *groups;          ///< FrOrganGroup; NULL: it stands nowhere
    FrMesh **meshes;         ///< by group
    uint32_t *group;         ///< by organ: its group; FR_NONE: nothing to see
    uint32_t first_material; ///< and first bark
    uint32_t first_group;    ///< shape of the first group
    uint32_t first_mesh;     ///< mesh of the first group
    vec3s *colours;          ///< sRGB, by material
} FrOpfPlant;

typedef struct FrOpf {
    const FrScene *scene;
    const FrContext *context;
    const FrIoOptions *options;
    FrOpfPlant *plants; ///< by plant of the scene
    uint32_t materials; ///< of all plants: the barks come first among the shapes
    const FrOpfPlant *plant;
    const FrStand *stand;
    FrPose pose; ///< of the stand
    FrOutput output;
    uint32_t id; ///< of the last entity
    uint64_t bytes;
} FrOpf;

/// Meshes and colours of all plants that stand somewhere.
FrStatus fr_opf_make_references(FrOpf *opf);
void fr_opf_clear_references(FrOpf *opf);
/// The tables before the topology: meshes, materials, shapes and attributes.
void fr_opf_add_references(FrOpf *opf);
