/// @file text.h
/// Stepping through text that may not be valid UTF-8. Private to base.
#pragma once

#include "frond/api.h"

#include <glib.h>

/// One character: a valid code point, or one byte that is none.
typedef struct TextChar {
    gunichar code; ///< U+FFFD for a byte that belongs to no character
    size_t size;   ///< in bytes, at least 1
} TextChar;

/// The character at `at`, which must be before `end`.
static inline TextChar fr_text_char(const char *at, const char *end) {
    unsigned char first = (unsigned char)*at;
    if (first < 0x80) {
        return (TextChar){first, 1};
    }
    gunichar code = g_utf8_get_char_validated(at, end - at);
    if (code == (gunichar)-1 || code == (gunichar)-2) {
        return (TextChar){0xfffd, 1};
    }
    return (TextChar){code, (size_t)g_unichar_to_utf8(code, NULL)};
}

/// Appends a character as a terminal may safely show it: what does not print, such as an escape
/// sequence, becomes U+FFFD.
static inline void fr_text_append_visible(GString *out, gunichar code) {
    g_string_append_unichar(out, g_unichar_isprint(code) ? code : 0xfffd);
}
