/// @file files.h
/// Where the files are that come with the program.
#pragma once

#include <glib.h>

/// `name` within the folder data/: of $FROND_DATA, as installed, or near the program where it was
/// built. NULL if it is nowhere. Free with g_free().
char *studio_data_file(const char *name);
/// A page of the manual, installed or near the program; NULL. Free with g_free().
char *studio_manual_page(const char *name);
/// The names of the presets that come with the program, and of the user's, each sorted, without
/// folder and ending. Free with g_ptr_array_unref().
GPtrArray *studio_shipped_presets(void);
GPtrArray *studio_own_presets(void);
/// Both, the user's first.
GPtrArray *studio_preset_names(void);
/// The document (".frond") or the picture (".png") of a preset; NULL: there is none. Free with
/// g_free().
char *studio_preset_file(const char *name, const char *ending);
/// "weeping-willow" as it is read: "Weeping willow". Free with g_free().
char *studio_preset_title(const char *name);
