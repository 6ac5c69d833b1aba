/// @file presets.h
/// The presets of a user: documents in a folder, with a picture beside each.
#pragma once

#include "studio/model/document.h"

/// Where they are unless a test says otherwise: frond/presets within the user's data. Free with
/// g_free().
char *studio_presets_folder(void);
/// Names of the presets in a folder, sorted, without folder and ending; none if it is not there.
/// Free with g_ptr_array_unref().
GPtrArray *studio_presets_list(const char *folder);
/// The file of a preset with that ending: ".frond", ".png". Free with g_free().
char *studio_presets_file(const char *folder, const char *name, const char *ending);
/// Why nothing can be called so, in a sentence; NULL: it can.
const char *studio_presets_name_refusal(const char *name);

/// Keeps a text as a preset, in the place of one that is called so. The file is whole at any time.
/// FR_ERR_DOCUMENT if it is no document without errors: then nothing is written.
FR_MUST_USE FrStatus studio_presets_save(const char *folder, const char *name, const char *text,
                                         FrDiags *diags);
/// Calls a preset otherwise; false if it is not there or another one is called so.
bool studio_presets_rename(const char *folder, const char *name, const char *to);
bool studio_presets_remove(const char *folder, const char *name);
/// Draws a preset and keeps its picture beside it; may be called from any thread, takes seconds.
FR_MUST_USE FrStatus studio_presets_draw(const char *folder, const char *name,
                                         const FrContext *context);
