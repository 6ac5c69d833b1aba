/// @file materials.h
/// The materials of a document: making, naming and choosing them, and how each looks by itself.
#pragma once

#include "frond/material.h"
#include "studio/model/document.h"

/// True for a parameter that names a material.
bool studio_names_material(const FrParam *param);
/// True for one that names a file of a picture.
bool studio_names_picture(const FrParam *param);
/// What an element of a material says. Free with fr_params_clear().
void studio_material_read(const StudioDocument *document, uint32_t material,
                          FrMaterialParams *params);
/// Adds a material, a copy of `like` unless that is FR_NONE, and gives it to an attribute of
/// `element` unless that is FR_NONE; one step. `*id` (may be NULL) receives what it is called, to
/// be freed with g_free(). False if nothing changed.
bool studio_add_material(StudioDocument *document, uint32_t like, uint32_t element,
                         const char *attribute, char **id);
/// Gives a material another id, wherever it is named. False if the new one is taken or is none.
bool studio_rename_material(StudioDocument *document, uint32_t material, const char *to);
/// A file as a document in that folder names it: from there on where both have more than the root
/// in common. Free with g_free().
char *studio_file_from(const char *folder, const char *path);

/// A smaller picture, RGBA, by means of pixels.
FrImage *studio_thumbnail(const FrImage *image, uint32_t width, uint32_t height);
/// A picture, RGBA, of the material by itself: leaves flat as they are, all else as a ball.
/// `colours` is its picture, NULL where it has none or it is not there yet.
FrImage *studio_swatch(const FrMaterialParams *params, const FrImage *colours, uint32_t size);
