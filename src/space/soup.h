/// @file soup.h
/// A soup of world triangles that come and go, and the first of them that a ray meets. Private to
/// the library.
///
/// The answer depends on the ray and on which triangles there are, never on when they were added
/// or how they are searched: Embree only names candidates, and distances are compared in doubles,
/// equal ones by the triangles' keys. So a ray traced long ago and one traced now agree in every
/// bit.
#pragma once

#include "frond/rays.h"

typedef struct FrSoup FrSoup;

typedef struct FrSoupHit {
    double distance;   ///< in lengths of the direction; INFINITY: nothing
    uint32_t triangle; ///< FR_NONE: nothing
    bool is_back;      ///< met from the side from which its corners turn clockwise
    double normal[3];  ///< across its front, not of unit length
} FrSoupHit;

/// True if the ray goes on through this point of a triangle. Called from any thread.
typedef bool (*FrSoupHoleFn)(void *user, uint32_t triangle, double u, double v);

/// `threads` may build. `hole` may be NULL.
FrSoup *fr_soup_new(int threads, FrSoupHoleFn hole, void *user);
void fr_soup_free(FrSoup *soup);
/// Adds triangles (at least one), finite and with an area, and returns the number of the first;
/// they are numbered in order. Takes `corners` (from g_malloc, with FR_SOUP_PADDING bytes behind
/// the last) and `keys`. No two triangles may have the same key.
uint32_t fr_soup_add(FrSoup *soup, float (*corners)[9], uint64_t *keys, uint32_t count);
enum { FR_SOUP_PADDING = 16 };
void fr_soup_remove(FrSoup *soup, uint32_t triangle);
bool fr_soup_has(const FrSoup *soup, uint32_t triangle);
/// How many numbers have been given away.
uint32_t fr_soup_count(const FrSoup *soup);
/// What a ray meets first beyond its origin, other than the triangle `except`.
FrSoupHit fr_soup_trace(const FrSoup *soup, const float origin[3], const float direction[3],
                        uint32_t except);
/// What a ray, which met `triangle` at `distance` before the last call of fr_soup_add(), meets of
/// that call's triangles instead; nothing if it still meets what it met.
FrSoupHit fr_soup_trace_last(const FrSoup *soup, const float origin[3], const float direction[3],
                             double distance, uint32_t triangle);
/// True if so much was added and removed that queries suffer.
bool fr_soup_wants_compaction(const FrSoup *soup);
/// Merges batches and numbers what is left anew, in the same order. remap[old] = new or FR_NONE.
void fr_soup_compact(FrSoup *soup, uint32_t *remap);
uint64_t fr_soup_bytes(const FrSoup *soup);
