/// @file lsystem/text.h
/// The text of an L-system after preprocessing: each byte knows where it came from.
#pragma once

#include "frond/context.h"

typedef struct FrLtext {
    GString *bytes;
    GArray *origins;    ///< uint32_t: offset into its source, one for each byte
    GArray *files;      ///< uint8_t: index into sources, one for each byte
    GPtrArray *sources; ///< FrSource *, owned references
    GHashTable *held;   ///< set of char *: names set from outside that a directive asked for
    GPtrArray *defined; ///< char *: names that directives have defined
    bool is_cut;        ///< a comment that nothing ends has taken the rest
} FrLtext;

/// Names that are known from the start: the functions of a view stand for their number, what is
/// set from outside stands for itself and cannot be defined in the text.
typedef struct FrLname {
    const char *name;
    int value;
    bool is_held;
} FrLname;

/// Joins lines, removes comments, obeys directives, replaces macros. `folder` (may be NULL: then
/// nothing can be included) is where included files are sought. Errors do not end the work; NULL
/// only where a limit does.
FrLtext *fr_ltext_new(FrSource *source, const char *folder, const FrLname *names, size_t count,
                      const FrContext *context, FrStatus *status);
void fr_ltext_free(FrLtext *text);
/// The place of bytes [begin, end) in the file they came from.
FrSpan fr_ltext_span(const FrLtext *text, size_t begin, size_t end);
