/// @file carry.h
/// Pictures and meshes that a text names, taken with it to where it goes: each is copied, and named
/// as it is called there. Meshes bring what they name themselves, in a folder of their own.
#pragma once

#include "studio/model/document.h"

/// From where to where.
typedef struct StudioCarry {
    const char *from;   ///< the folder that names are relative to
    bool is_inside;     ///< what is named must lie beneath it: other people may have written it
    const char *to;     ///< the folder of the copies, which is there
    const char *prefix; ///< of their names, as "oak.files/"; may be ""
    GHashTable *wanted; ///< elements (by GUINT_TO_POINTER) with all within them; NULL: all
} StudioCarry;

/// What came of it.
typedef struct StudioCarried {
    FrSource *source; ///< the text with the new names; NULL: it was refused, and nothing was copied
    char *refusal;    ///< in a sentence
    GPtrArray *made;  ///< char *: files and folders that were not there, folders before what is in
                      ///< them
} StudioCarried;

/// What is there already, the same to the byte, is used; what is called like another file gets a
/// number. Free with studio_carried_clear().
StudioCarried studio_carry(const FrContents *contents, const StudioCarry *how);
/// The same without new names: copies of what is named from `from` to where it is looked for
/// beneath `to`, unless something is there. Adds what is made to `made`. Returns the first name of
/// which that cannot be, to be freed with g_free(); NULL: all is there.
char *studio_carry_along(const FrContents *contents, const char *from, const char *to,
                         GPtrArray *made);
/// Removes what was made.
void studio_carried_undo(StudioCarried *carried);
void studio_remove_made(GPtrArray *made);
void studio_carried_clear(StudioCarried *carried);
/// Whether anything wanted names a file.
bool studio_names_files(const FrContents *contents, GHashTable *wanted);
/// Names of all files that elements name, relative as they are (char *). Free with
/// g_ptr_array_unref().
GPtrArray *studio_named_files(const FrContents *contents);
