/// @file document.h
/// The document a window shows: its text with all that can be undone, and what is in it. It belongs
/// to the main thread; others are handed snapshots of the text.
#pragma once

#include "frond/contents.h"

typedef struct StudioDocument StudioDocument;

/// Called after every change of the text, the name or what is saved.
typedef void (*StudioChanged)(void *user);

/// A document without a file; `name` is what it is called until it has one, `folder` where the
/// files are that it names (NULL: nowhere).
StudioDocument *studio_document_new(const char *text, size_t size, const char *name,
                                    const char *folder);
/// Reads a file. Any text is taken, so that it can be mended. An L-system (.l) becomes a document
/// without a file, with the view (.v) beside it if there is one.
FR_MUST_USE FrStatus studio_document_open(const char *path, FrDiags *diags,
                                          StudioDocument **document);
void studio_document_free(StudioDocument *document);
void studio_document_watch(StudioDocument *document, StudioChanged changed, void *user);
void studio_document_unwatch(StudioDocument *document, StudioChanged changed, void *user);

// ---- what it is --------------------------------------------------------------------------------

/// NULL: it has no file yet.
const char *studio_document_path(const StudioDocument *document);
/// Name of the file without its folder, or what it is called without one.
const char *studio_document_name(const StudioDocument *document);
const char *studio_document_folder(const StudioDocument *document);
/// The text now, with a name for messages. Borrowed; immutable, so other threads may keep a
/// reference.
FrSource *studio_document_source(const StudioDocument *document);
/// The elements of the text, or of the last one that was well-formed: then is_broken(), and edits
/// by elements are refused.
const FrContents *studio_document_contents(const StudioDocument *document);
bool studio_document_is_broken(const StudioDocument *document);
/// Whether the text is UTF-8. Another cannot be typed in: it would not be the file's any more.
bool studio_document_is_text(const StudioDocument *document);
/// Grows with each change of the text.
uint64_t studio_document_revision(const StudioDocument *document);
/// XXH3 of the text.
FrDigest studio_document_digest(const StudioDocument *document);

// ---- changing it -------------------------------------------------------------------------------

/// Does splices (FrSplice; freed and emptied) of the contents as one step. `name` and `key` are as
/// in studio_history_replace(). False if nothing changed or the text is broken.
bool studio_document_splice(StudioDocument *document, GArray *splices, const char *name,
                            const char *key);
bool studio_document_splice_one(StudioDocument *document, FrSplice splice, const char *name,
                                const char *key);
/// Replaces the whole text.
bool studio_document_replace(StudioDocument *document, const char *text, size_t size,
                             const char *name, const char *key);
void studio_document_seal(StudioDocument *document);
/// A pointer is pressed: what it does from here on can be taken back by abandon().
void studio_document_hold(StudioDocument *document);
/// Takes back what was done since hold(), which leaves no step, and refuses changes until
/// release(). False if nothing is held.
bool studio_document_abandon(StudioDocument *document);
/// The pointer is let go. After abandon() all who watch are called, to show what is.
void studio_document_release(StudioDocument *document);
/// Whether changes are refused, as the drag was abandoned.
bool studio_document_is_abandoned(const StudioDocument *document);
bool studio_document_undo(StudioDocument *document);
bool studio_document_redo(StudioDocument *document);
const char *studio_document_undo_name(const StudioDocument *document);
const char *studio_document_redo_name(const StudioDocument *document);
uint32_t studio_document_steps(const StudioDocument *document);

// ---- keeping it --------------------------------------------------------------------------------

bool studio_document_is_saved(const StudioDocument *document);
/// Writes beside `path`, flushes, renames; `path` NULL: to its own file, unless someone else has
/// written that since (FR_ERR_MACHINE). Later it has that file. In another folder copies of the
/// files that it names come with it, unless something is called so there; a warning tells what
/// stays behind.
FR_MUST_USE FrStatus studio_document_save(StudioDocument *document, const char *path,
                                          FrDiags *diags);
/// The text is not what its file holds: it was recovered.
void studio_document_mark_unsaved(StudioDocument *document);
