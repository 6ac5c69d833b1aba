/// @file kept_state.h
/// What a kept skin holds, for kept.c, which plans it, and rewrite.c, which writes it.
#pragma once

#include "skin/kept.h"
#include "skin/piece.h"

/// Memory of one part.
typedef struct FrRoom {
    FrSlab slab;
    uint64_t vertices, indices;
    uint64_t serial; ///< other memory has other bits in it
    bool is_new;     ///< taken by this plan
} FrRoom;

/// Some pieces of one slot, and the box around their vertices.
typedef struct FrBlock {
    uint32_t slot, first, count;
    FrBox box;
} FrBlock;

enum { FR_BLOCK_PIECES = 64 };

/// What stands in the rooms of a skin, or is to.
typedef struct FrSkinState {
    FrSkinJob job;
    uint32_t slots;
    FrMesh *patched;       ///< what is to be copied to the rooms as it is; NULL: pieces are written
    FrRoom *rooms;         ///< two a slot: of wood, of organs
    bool is_known;         ///< not where deformations act: then everything is written
    FrDigest *runs;        ///< by run, with its places and rooms
    FrDigest *poses;       ///< by organ; atomic rc box
    FrShapeDigest *shapes; ///< by shape
    uint32_t *shape_of;    ///< by piece; atomic rc box
    FrBlock *blocks;       ///< all pieces, slot by slot
    uint32_t block_count;
    uint32_t *slot_blocks; ///< by slot of the job: its first block
    FrDigest forms;        ///< of all the plant's shapes
    FrLimits limits;
} FrSkinState;

struct FrSkin {
    FrSkinParams params;
    FrUpAxis up;
    FrSkinState *state;   ///< NULL before the first update
    FrSkinState *planned; ///< NULL but between fr_skin_plan() and fr_skin_write()
    bool is_unchanged;    ///< what is planned is what stands there already
    FrSkinPart *parts;
    uint32_t part_count;
    uint64_t serial; ///< of the last memory taken
    FrSkinWork work;
};

static inline FrRoom *fr_room_of(const FrSkinState *state, uint32_t slot, bool is_organs) {
    return &state->rooms[2 * (size_t)slot + is_organs];
}

void fr_room_free(FrRoom *room);
void fr_skin_state_free(FrSkinState *state);
