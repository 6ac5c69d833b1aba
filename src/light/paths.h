/// @file paths.h
/// The ways of all photons, kept as linked rays. Private to light.
///
/// All photons have the same power. Every choice along a path is a hash of (seed, photon, bounce),
/// so a path depends on the scene it goes through and on nothing else, and where a scene changes
/// only the rays that meet the change need to be traced again.
#pragma once

#include "light/emitters.h"
#include "light/surfaces.h"

/// A part of a path, from where the photon started or bounced to what it met. 56 bytes.
typedef struct FrRay {
    float origin[3], direction[3]; ///< direction unit to rounding
    double distance;               ///< INFINITY: met nothing
    uint32_t next;                 ///< ray after the bounce; FR_NONE: escaped, absorbed or cut off
    uint32_t photon;               ///< FR_NONE: the slot is free
    uint32_t from, triangle;       ///< where it began and ended; FR_NONE
    uint16_t bounce;               ///< 0 for the ray from the lamp
    bool is_back;                  ///< met the triangle from behind
    bool is_stale;                 ///< was changed or freed since fr_paths_settle()
} FrRay;

typedef struct FrPaths {
    FrRay *rays;
    uint32_t count, capacity; ///< slots
    uint32_t *first;          ///< of each photon
    uint32_t photon_count;
    uint32_t most_bounces;
    FrKey key;
    GArray *free_slots; ///< uint32_t
    GArray *fresh;      ///< uint32_t, slots written since fr_paths_settle()
    uint64_t traced;    ///< rays traced since then
    bool is_all_new;    ///< everything was traced anew since then; `fresh` is empty
    uint64_t *met;      ///< how often each side of a triangle was met: front, back, front, …
    uint64_t met_count;
    FrSpan span; ///< where a document asks for them
} FrPaths;

/// What a photon takes at least.
#define FR_PHOTON_BYTES (sizeof(FrRay) + sizeof(uint32_t))

FrPaths *fr_paths_new(uint32_t photons, uint32_t most_bounces, uint64_t seed);
void fr_paths_free(FrPaths *paths);
/// Sends out all photons. FR_ERR_LIMIT if the rays take more than FrLimits.bytes, FR_CANCELLED;
/// then the paths are not whole and have to be traced anew.
FR_MUST_USE FrStatus fr_paths_trace(FrPaths *paths, const FrEmitters *emitters,
                                    const FrSurfaces *surfaces, const FrContext *context);
/// Traces again what the last change of the surfaces touched. Errors as above.
FR_MUST_USE FrStatus fr_paths_update(FrPaths *paths, const FrSurfaces *surfaces, uint32_t added,
                                     uint32_t removed, const FrContext *context);
/// Triangles have new numbers.
void fr_paths_renumber(FrPaths *paths, const uint32_t *remap, uint32_t triangle_count);
/// Whoever keeps references to rays has followed the changes.
void fr_paths_settle(FrPaths *paths);
/// Digest of all paths in the order of the photons; where the rays are stored does not matter.
FrDigest fr_paths_digest(const FrPaths *paths);
uint64_t fr_paths_ray_count(const FrPaths *paths);
uint64_t fr_paths_bytes(const FrPaths *paths);
