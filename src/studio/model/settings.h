/// @file settings.h
/// What the studio remembers from one time to the next: sizes, choices, documents opened last.
#pragma once

#include "frond/api.h"

#include <glib.h>

typedef struct StudioSettings StudioSettings;

enum { STUDIO_MOST_RECENT = 12 };

/// The file of the user's settings. Free with g_free().
char *studio_settings_file(void);
/// Reads a file; what is not there or makes no sense has its default.
StudioSettings *studio_settings_new(const char *file);
/// Writes what changed, and frees.
void studio_settings_free(StudioSettings *settings);
bool studio_settings_save(StudioSettings *settings);
int studio_settings_int(const StudioSettings *settings, const char *name, int otherwise);
void studio_settings_set_int(StudioSettings *settings, const char *name, int value);
bool studio_settings_bool(const StudioSettings *settings, const char *name, bool otherwise);
void studio_settings_set_bool(StudioSettings *settings, const char *name, bool value);
/// Paths of the documents opened last, the newest first, that are still there. Free with
/// g_strfreev().
char **studio_settings_recent(const StudioSettings *settings);
void studio_settings_add_recent(StudioSettings *settings, const char *path);
