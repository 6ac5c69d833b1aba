/// @file presets.h
/// Where presets are: documents in a folder, each perhaps with a picture beside it.
#pragma once

#include "frond/api.h"

#include <glib.h>

/// The folder of the user's own presets, frond/presets within the user's data; it need not be
/// there. Free with g_free().
FR_API char *fr_presets_folder(void);
/// Names of the presets in a folder, sorted, without folder and ending; none if it is not there.
/// Free with g_ptr_array_unref().
FR_API GPtrArray *fr_presets_list(const char *folder);
/// The file of a preset with that ending: ".frond", ".png". Free with g_free().
FR_API char *fr_presets_file(const char *folder, const char *name, const char *ending);
