/// @file pictures.h
/// The pictures of materials on the graphics card. The context of the viewport is current.
#pragma once

#include "studio/model/builder.h"

#include <epoxy/gl.h>

typedef struct StudioPictures StudioPictures;

StudioPictures *studio_pictures_new(void);
void studio_pictures_free(StudioPictures *pictures);
/// Nothing happens for one without an image.
void studio_pictures_add(StudioPictures *pictures, const StudioPicture *picture);
/// The texture of that map of a look; 0: there is none, or not yet.
GLuint studio_pictures_find(const StudioPictures *pictures, FrDigest look, FrMap map);
