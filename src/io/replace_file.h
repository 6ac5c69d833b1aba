/// @file replace_file.h
/// Files that appear whole or not at all, one or several together.
#pragma once

#include "frond/io.h"

/// A file written beside its name and not yet moved there.
typedef struct FrReplacement {
    char *path;      ///< where it will be; owned
    char *temporary; ///< where it is now; owned; NULL for a device or pipe, written directly
} FrReplacement;

/// Writes what will replace `path` and flushes it to the disk. `write` returns false with errno
/// set, ECANCELED if it was asked to stop. On failure nothing is left and `replacement` is empty.
FrStatus fr_replacement_write(FrReplacement *replacement, const char *path,
                              bool (*write)(void *user, int descriptor), void *user,
                              FrDiags *diags);
/// Moves it to its path.
FrStatus fr_replacement_commit(FrReplacement *replacement, FrDiags *diags);
/// Removes it, unless it was committed, and frees what the struct owns.
void fr_replacement_clear(FrReplacement *replacement);

/// Several of them: a GArray of FrReplacement that clears its elements.
GArray *fr_replacements_new(void);
/// Writes one more.
FrStatus fr_replacements_write(GArray *replacements, const char *path,
                               bool (*write)(void *user, int descriptor), void *user,
                               FrDiags *diags);
/// Commits all, in order.
FrStatus fr_replacements_commit(GArray *replacements, FrDiags *diags);
