/// @file history.h
/// A text and every step that led to it. Undo has no limit: a step keeps only the bytes it changed.
#pragma once

#include "frond/api.h"

#include <glib.h>

typedef struct StudioHistory StudioHistory;

/// Takes a copy. The first text counts as saved.
StudioHistory *studio_history_new(const char *text, size_t size);
void studio_history_free(StudioHistory *history);
/// The text now, borrowed until it changes; a zero byte that `size` does not count follows it.
const char *studio_history_text(const StudioHistory *history, size_t *size);
/// The text becomes this, as a step of that name, which the user reads. What could be redone is
/// gone. Steps in a row with the same `key` (not NULL) are one, as those of a drag, until
/// studio_history_seal(). False if nothing changed.
bool studio_history_replace(StudioHistory *history, const char *text, size_t size, const char *name,
                            const char *key);
/// The last step is over: the next one stands alone, whatever its key.
void studio_history_seal(StudioHistory *history);
/// False if there is nothing to undo or redo.
bool studio_history_undo(StudioHistory *history);
bool studio_history_redo(StudioHistory *history);
/// The text becomes again what it was after so many steps, as one that never changed; what came
/// after cannot be redone. The last of them may have been gone on with.
void studio_history_return(StudioHistory *history, uint32_t count, const char *text, size_t size);
/// The name of the step that would be undone or redone; NULL: none.
const char *studio_history_undo_name(const StudioHistory *history);
const char *studio_history_redo_name(const StudioHistory *history);
/// The text as it is now is what the file holds.
void studio_history_mark_saved(StudioHistory *history);
/// Whether the text is the one marked last.
bool studio_history_is_saved(const StudioHistory *history);
/// How many steps can be undone.
uint32_t studio_history_count(const StudioHistory *history);
