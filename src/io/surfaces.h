/// @file surfaces.h
/// The materials that a model file names: one for each bark and leaf kind, and their pictures.
#pragma once

#include "frond/io.h"

/// A picture file, kept once however many surfaces show it.
typedef struct FrPicture {
    char *name;             ///< file name, unique among the model's: `oak-bark-colour.png`
    const char *media_type; ///< static
    GBytes *bytes;
} FrPicture;

typedef struct FrSurface {
    FrMaterial *material; ///< NULL: the plain default
    bool is_foliage;      ///< seen from both sides
    bool has_holes;
    bool clamps;                    ///< its pictures end at their edges, else they repeat
    char *name;                     ///< unique among the surfaces
    uint32_t picture[FR_MAP_COUNT]; ///< index into pictures, FR_NONE
} FrSurface;

typedef struct FrSurfaces {
    GArray *surfaces; ///< FrSurface
    GArray *pictures; ///< FrPicture
    char *prefix;     ///< of picture names
    GHashTable *names;
} FrSurfaces;

/// `prefix` begins the names of picture files.
void fr_surfaces_init(FrSurfaces *surfaces, const char *prefix);
void fr_surfaces_clear(FrSurfaces *surfaces);
/// The index of the surface for a material of `plant` (FR_NONE: the default), made if it is new.
FrStatus fr_surfaces_find(FrSurfaces *surfaces, const FrPlant *plant, uint32_t material,
                          bool is_foliage, const FrContext *context, uint32_t *index);
const FrSurface *fr_surfaces_get(const FrSurfaces *surfaces, uint32_t index);
const FrPicture *fr_surfaces_picture(const FrSurfaces *surfaces, uint32_t index);
/// The parameters of a surface's material, or the defaults.
FrMaterialParams fr_surface_params(const FrSurface *surface);
/// What multiplies the colour picture, linear.
void fr_surface_tint(const FrSurface *surface, double linear[3]);
/// Writes the picture files beside `path`, to be committed with `files` (of FrReplacement).
FrStatus fr_surfaces_write(const FrSurfaces *surfaces, const char *path, GArray *files,
                           const FrContext *context, uint64_t *bytes);
/// The file name of `path` without its extension. Free with g_free().
char *fr_io_stem(const char *path);
/// `name` beside `path`. Free with g_free().
char *fr_io_beside(const char *path, const char *name);
