/// @file recovery.h
/// Copies of unsaved documents, kept beside no file of the user's, so that a crash loses nothing.
/// A copy is written whole or not at all, and goes when its document is saved or closed.
#pragma once

#include "studio/model/document.h"

typedef struct StudioRecovery StudioRecovery;

/// What a program that ended too early has left.
typedef struct StudioLeft {
    char *text_file; ///< of the copy
    char *path;      ///< the document's file, NULL if it had none
    char *name;      ///< what it was called
    char *folder;    ///< where the files are that it names
} StudioLeft;

/// The folder where copies are kept: that of the user's state. Free with g_free().
char *studio_recovery_folder(void);
/// Keeps copies of `document` in `folder`, which is made if it is not there.
StudioRecovery *studio_recovery_new(const char *folder, StudioDocument *document);
/// The document is closed: removes the copy.
void studio_recovery_free(StudioRecovery *recovery);
/// Writes a copy if the document is unsaved and has changed since the last one; removes the copy if
/// it is saved. False if the disk failed.
bool studio_recovery_update(StudioRecovery *recovery);
/// Saves the document as studio_document_save() does. However it ends, a copy that is left is never
/// older than the file.
FR_MUST_USE FrStatus studio_recovery_save(StudioRecovery *recovery, const char *path,
                                          FrDiags *diags);
/// What programs that do not run any more have left in `folder`: StudioLeft *, oldest first. What
/// their file holds just so is none of it: it was saved.
GPtrArray *studio_recovery_list(const char *folder);
/// The document that was left, unsaved. NULL with a diagnostic if its copy cannot be read.
StudioDocument *studio_recovery_restore(const StudioLeft *left, FrDiags *diags);
/// Removes what was left.
void studio_recovery_discard(const StudioLeft *left);
