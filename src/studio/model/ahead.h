/// @file ahead.h
/// The skeleton of what is being built, shown before it is. Where the last build took longer than
/// an eye waits, the document is first built without the components that there are thousands of.
/// That takes some milliseconds, and what it makes has the bits of the whole. If its lines are
/// other ones than before the edit, they are handed out.
#pragma once

#include "studio/model/builder.h"

typedef struct StudioAhead StudioAhead;

/// A document at a time, in years; NAN: as it says.
typedef struct StudioDraft {
    FrSource *source;
    const char *folder;
    double time;
} StudioDraft;

StudioAhead *studio_ahead_new(StudioWake wake, void *user);
void studio_ahead_free(StudioAhead *ahead);
/// Before a build, on its thread: hands out the skeleton if it is worth it.
void studio_ahead_begin(StudioAhead *ahead, const StudioDraft *draft, const FrContext *context);
/// After it, on its thread: what was not taken is dropped. `scene`: what was made, with its counts
/// (StudioCount); NULL: it failed. `seconds`: that took; 0: little was made anew.
void studio_ahead_end(StudioAhead *ahead, const StudioDraft *draft, const FrScene *scene,
                      GArray *counts, double seconds, const FrContext *context);
/// Another document comes.
void studio_ahead_forget(StudioAhead *ahead);
/// The skeleton, or NULL; from any thread.
StudioOverlay *studio_ahead_take(StudioAhead *ahead);
