/// @file level.h
/// One generation of instances: columns of where each stands and what it was handed down.
#pragma once

#include "frond/plant.h"
#include "frond/random.h"

/// How an instance follows on its parent.
enum {
    FR_JOINT_NONE,
    FR_JOINT_TIP, ///< at the tip of a stem, in its direction: a stem goes on from here
    FR_JOINT_SET, ///< next point set of the parent's: belongs to `axis`
};

/// What an instance is handed down: X(type, column). Sites are relative to the tip and frame of the
/// bearer.
#define FR_LEVEL_SITE(X)                                                                           \
    X(uint32_t, stage)   /* of the unrolled p-graph */                                             \
    X(uint32_t, parent)  /* instance of the level before */                                        \
    X(uint32_t, bearer)  /* node, FR_NONE: the ground */                                           \
    X(vec3s, offset)     /* m */                                                                   \
    X(versors, rotation) /* site to bearer frame */                                                \
    X(float, scale)      /* handed down, its own not counted */                                    \
    X(FrKey, key)        /* of its path */                                                         \
    X(uint32_t, i)       /* iteration of the nearest multiplier above … */                       \
    X(uint32_t, n)       /* … of so many */                                                      \
    X(uint32_t, i1)      /* of the next outside */                                                 \
    X(uint32_t, n1)                                                                                \
    X(uint32_t, i2)                                                                                \
    X(uint32_t, n2)                                                                                \
    X(uint16_t, generation) /* within the nearest recursion */                                     \
    X(uint16_t, order)      /* branch order */                                                     \
    X(uint8_t, joint)       /* FR_JOINT_… */                                                     \
    X(float, x)             /* position along the parent stem */                                   \
    X(float, parent_length) /* of the stem it stands on, m at scale 1; < 0: there is none */       \
    X(float, parent_radius) /* the same, where it stands */                                        \
    X(float, stretch)       /* factor of its length, from its parent */                            \
    X(float, clock)         /* years of the clock around it; < 0: not yet there */                 \
    X(uint32_t, edit)       /* where it stands on the paths of edits, see edit.h */                \
    X(uint32_t, material)   /* of the plant, FR_NONE */                                            \
    X(uint32_t, deformer)   /* scope it is in, of the plant; FR_NONE */                            \
    X(uint32_t, field)      /* field it is in; FR_NONE */                                          \
    X(uint16_t, scopes)     /* how many scopes and fields are around it */                         \
    X(float, step)          /* m, most of an internode in them; 0: any */                          \
    X(uint32_t, axis)       /* for FR_JOINT_SET */                                                 \
    X(uint32_t, twin)       /* row of the last build that was made from the same; FR_NONE */

/// What it makes: X(type, column). In a level that has been made, one row more tells where the last
/// instance's end.
#define FR_LEVEL_COUNTS(X)                                                                         \
    X(float, age)             /* years of its own clock */                                         \
    X(uint8_t, is_absent)     /* not born, dead, left out by chance */                             \
    X(uint8_t, ramp)          /* step on the ramp of its material */                               \
    X(uint32_t, tips)         /* ends where single children stand */                               \
    X(uint32_t, places)       /* children of a multiplier, flagged-out ones counted */             \
    X(uint32_t, child_count)  /* then: index of the first child in the next level */               \
    X(uint32_t, node_count)   /* then: index of its first node in the plant */                     \
    X(uint32_t, axis_count)   /* then: index of its axis */                                        \
    X(uint32_t, organ_count)  /* then: index of its first organ */                                 \
    X(uint32_t, global_count) /* then: index of its scope in the plant, or of its field */

#define FR_LEVEL_COLUMNS(X) FR_LEVEL_SITE(X) FR_LEVEL_COUNTS(X)

typedef struct FrLevel {
    uint32_t count;
    uint64_t first; ///< number of its first instance in the plant
#define FR_LEVEL_FIELD(type, column) type *column;
    FR_LEVEL_COLUMNS(FR_LEVEL_FIELD)
#undef FR_LEVEL_FIELD
} FrLevel;

/// Bytes of one instance in all columns.
uint64_t fr_level_row_bytes(void);
/// Uninitialized columns for `count` instances.
void fr_level_init(FrLevel *level, uint32_t count);
void fr_level_clear(FrLevel *level);
