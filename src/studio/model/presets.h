/// @file presets.h
/// The presets of a user: documents in a folder, with a picture beside each.
#pragma once

#include "studio/model/document.h"

/// Why nothing can be called so, in a sentence; NULL: it can.
const char *studio_presets_name_refusal(const char *name);

/// What is wrong with a preset, by its file: "line 3: text". Free with g_free(); NULL: nothing is.
char *studio_presets_problem(const char *file);

/// Keeps a text as a preset, in the place of one that is called so, with copies of the files that
/// it names relative to `beside`. The file is whole at any time. FR_ERR_DOCUMENT if it is no
/// document without errors or names what cannot be kept: then nothing is written.
FR_MUST_USE FrStatus studio_presets_save(const char *folder, const char *name, const char *text,
                                         const char *beside, FrDiags *diags);
/// Calls a preset otherwise; false if it is not there or another one is called so. Its files stay.
bool studio_presets_rename(const char *folder, const char *name, const char *to);
/// Removes a preset with its files, but those that another one names.
bool studio_presets_remove(const char *folder, const char *name);
/// Draws a preset and keeps its picture beside it; may be called from any thread, takes seconds.
FR_MUST_USE FrStatus studio_presets_draw(const char *folder, const char *name,
                                         const FrContext *context);
