/// @file scene_edit.h
/// What a person does to the scene of a document, each one step that can be undone. All return
/// false if nothing changed. Places are in metres; z is up. With a `key` calls in a row are one
/// step, as in studio_history_replace().
#pragma once

#include "frond/surroundings.h"
#include "studio/model/camera.h"
#include "studio/model/document.h"

/// Where a plant is to stand; `turn` in degrees, `seed` < 0: that of the plant.
typedef struct StudioSpot {
    double at[3]; ///< z counts from the ground
    double turn, scale;
    int64_t seed;
} StudioSpot;

/// The last child of the scene of that tag; FR_NONE. What has been added last stands there.
uint32_t studio_scene_last(const StudioDocument *document, const char *tag);
/// Text that puts elements into the scene, behind that child of it (FR_NONE: at its end); without a
/// scene, one around them.
FrSplice studio_scene_insert(const FrContents *contents, uint32_t after, const char *xml);
/// Whether plants are placed; else the first plant is shown at the origin.
bool studio_scene_has_places(const StudioDocument *document);
/// Whether a plant (its element) grows bud by bud: it has no size and turn of its own.
bool studio_scene_is_species(const StudioDocument *document, uint32_t plant);

/// A `<place>` of a plant (its id). Free with g_free().
char *studio_place_xml(const StudioDocument *document, const char *plant, const StudioSpot *spot);
/// Plants a plant (its id) at spots. What was shown at the origin because nothing was placed is
/// placed there, so that it stays.
bool studio_plant(StudioDocument *document, const char *plant, const StudioSpot *spots,
                  size_t count, const char *key);
/// Places what is shown at the origin because nothing is placed.
bool studio_place_first(StudioDocument *document);
/// Puts a copy of an element of the scene behind it, of no road and nothing that has an id. The
/// copy; FR_NONE: nothing changed.
uint32_t studio_copy(StudioDocument *document, uint32_t element, const char *key);
/// Takes elements of the scene out; of a road both of its parts.
bool studio_take_out(StudioDocument *document, const uint32_t *elements, size_t count,
                     const char *key);

/// Adds an obstacle of a shape ("box", "sphere", …) of that size; `file` is that of a mesh or NULL.
bool studio_add_obstacle(StudioDocument *document, const char *shape, const double at[3],
                         const double size[3], const char *file);
/// Adds a road along points (double[3]) and, invisible, what keeps plants off it to a height.
bool studio_add_road(StudioDocument *document, const GArray *points, double width, double height);
/// Makes a file the ground, of that extent; NULL: level ground again.
bool studio_set_terrain(StudioDocument *document, const char *file, const double size[3]);
/// The outline (radius, height: double[2]) that a species grows within; empty: none.
bool studio_set_envelope(StudioDocument *document, uint32_t plant, const GArray *outline,
                         const char *key);
/// The `<view>` of the scene with that name; FR_NONE.
uint32_t studio_find_view(const StudioDocument *document, const char *name);
/// Keeps where the camera is as a view of that name, in the place of one that is called so.
bool studio_save_view(StudioDocument *document, const char *name, const StudioCamera *camera);
/// Calls a view otherwise; false, and nothing changes, if another one is called so, if it is not
/// there, or if the name is empty.
bool studio_rename_view(StudioDocument *document, const char *name, const char *to);
/// A name that no view has: "view 3". Free with g_free().
char *studio_free_view(const StudioDocument *document);

/// A file as a document names it: relative to its folder where it lies in there. Free with
/// g_free().
char *studio_file_name(const StudioDocument *document, const char *path);
