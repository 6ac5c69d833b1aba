/// @file surfaces.h
/// The triangles of a light scene in the world, and what changes from one scene to the next.
/// Private to light.
///
/// A triangle is its corners and what it does with light. Equal ones count once, for the first of
/// their owners, and triangles of one scene that are also in the next stay what they are, whatever
/// mesh or stand they come from then. So a plant that is built anew each step changes only where
/// it has grown.
#pragma once

#include "frond/light.h"
#include "space/soup.h"

typedef struct FrSurfaces FrSurfaces;

FrSurfaces *fr_surfaces_new(int threads);
void fr_surfaces_free(FrSurfaces *surfaces);
/// Makes the soup hold what the scene has. `*added` and `*removed` count the difference; what was
/// added is the soup's last batch. FR_ERR_LIMIT, said at `span`, before anything has changed.
FR_MUST_USE FrStatus fr_surfaces_set(FrSurfaces *surfaces, const FrLightScene *scene, FrSpan span,
                                     const FrContext *context, uint32_t *added, uint32_t *removed);
const FrSoup *fr_surfaces_soup(const FrSurfaces *surfaces);
/// What happens to light on that side of a triangle.
const FrOptics *fr_surfaces_optics(const FrSurfaces *surfaces, uint32_t triangle, bool is_back);
enum { FR_MOST_BOXES = 9 };
/// Boxes around the triangles of the last batch: the first around all of them, the others around
/// those in each octant about their middle. Returns how many there are.
uint32_t fr_surfaces_added_boxes(const FrSurfaces *surfaces, float boxes[FR_MOST_BOXES][2][3]);
/// All elements of all stands, and the first of a stand.
uint64_t fr_surfaces_element_count(const FrSurfaces *surfaces);
uint64_t fr_surfaces_first_element(const FrSurfaces *surfaces, uint32_t stand);
/// The element that collects what a triangle absorbs.
uint64_t fr_surfaces_element(const FrSurfaces *surfaces, uint32_t triangle);
/// Numbers the triangles anew if that pays; then returns the new number of every old one, to be
/// freed with g_free(), else NULL.
uint32_t *fr_surfaces_compact(FrSurfaces *surfaces);
uint64_t fr_surfaces_bytes(const FrSurfaces *surfaces);
