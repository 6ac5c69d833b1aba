// Strings of modules: memory, walking, text, digest.
#include "lsystem/derive.h"

#include <stdlib.h>

FrLstring *fr_lstring_new(void) {
    FrLstring *string = g_new0(FrLstring, 1);
    string->marks = g_array_new(FALSE, FALSE, sizeof(FrLmark));
    return string;
}

void fr_lstring_free(FrLstring *string) {
    if (string != NULL) {
        free(string->words);
        g_array_unref(string->marks);
        g_free(string);
    }
}

bool fr_lstring_reserve(FrLstring *string, uint64_t words) {
    if (words <= string->capacity) {
        return true;
    }
    uint32_t *grown = realloc(string->words, words * sizeof *grown);
    if (grown == NULL) {
        return false;
    }
    string->words = grown;
    string->capacity = words;
    return true;
}

uint64_t fr_lstring_count(const FrLstring *string) {
    return string->modules;
}

uint64_t fr_lstring_bytes(const FrLstring *string) {
    return string->count * sizeof *string->words;
}

bool fr_lstring_next(const FrLstring *string, uint64_t *at, FrLmodule *module) {
    if (*at >= string->count) {
        return false;
    }
    const uint32_t *head = string->words + *at;
    *module = (FrLmodule){(char)fr_lhead_symbol(*head), (uint8_t)fr_lhead_count(*head),
                          (uint16_t)fr_lhead_mark(*head), (const float *)(const void *)(head + 1)};
    *at += 1 + fr_lhead_count(*head);
    return true;
}

void fr_lmodule_print(const FrLmodule *module, GString *out) {
    g_string_append_c(out, module->symbol);
    for (unsigned i = 0; i < module->count; i++) {
        uint32_t word;
        char number[G_ASCII_DTOSTR_BUF_SIZE] = "?";
        memcpy(&word, module->parameters + i, sizeof word);
        if (word != FR_LOPEN) {
            g_ascii_formatd(number, sizeof number, "%g", module->parameters[i]);
        }
        g_string_append_c(out, i == 0 ? '(' : ',');
        g_string_append(out, number);
    }
    if (module->count > 0) {
        g_string_append_c(out, ')');
    }
}

void fr_lstring_print(const FrLstring *string, GString *out) {
    FrLmodule module;
    for (uint64_t at = 0; fr_lstring_next(string, &at, &module);) {
        fr_lmodule_print(&module, out);
    }
}

FrDigest fr_lstring_digest(const FrLstring *string) {
    // The marks in the heads are no part of the string.
    FrDigest digest = 0;
    uint32_t buffer[4096];
    size_t used = 0;
    for (uint64_t at = 0; at < string->count;) {
        unsigned count = fr_lhead_count(string->words[at]);
        if (used + count + 1 > G_N_ELEMENTS(buffer)) {
            digest = fr_digest(digest, buffer, used * sizeof *buffer);
            used = 0;
        }
        memcpy(buffer + used, string->words + at, (count + 1) * sizeof *buffer);
        buffer[used] &= FR_LHEAD_KEY;
        used += count + 1;
        at += count + 1;
    }
    return fr_digest(digest, buffer, used * sizeof *buffer);
}
