/// @file lsystem/macro.h
/// Macros of the preprocessor: definitions, replacement, the arithmetic of #if.
#pragma once

#include "lsystem/text.h"

typedef struct FrLmacro {
    char *body;
    char **formals; ///< NULL-terminated; NULL for an object-like macro
} FrLmacro;

typedef struct FrLmacros {
    GHashTable *table; ///< name → FrLmacro *
    uint64_t work;     ///< bytes replaced so far
    uint64_t most;     ///< more are not
    bool is_full;      ///< `most` was reached
    bool is_deep;      ///< a macro nested too deeply
} FrLmacros;

void fr_lmacros_init(FrLmacros *macros, uint64_t most);
void fr_lmacros_clear(FrLmacros *macros);
/// Reads `NAME body` or `NAME(a, b) body`. False where that is no definition.
bool fr_lmacros_define(FrLmacros *macros, const char *text);
/// Called for each run of bytes of the replaced line; `from` is where in the line it came from.
typedef void (*FrLmacroSink)(void *data, const char *bytes, size_t size, size_t from);
/// Replaces the macros in a line.
void fr_lmacros_expand(FrLmacros *macros, const char *line, size_t size, FrLmacroSink sink,
                       void *data);
/// The value of an #if expression; false in *is_valid where there is none.
long long fr_lmacros_condition(FrLmacros *macros, const char *text, bool *is_valid);
