/// @file api.h
/// Export mark, attributes and the always-on assertion shared by every public header.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FR_VERSION "0.1.0"

#if defined(__GNUC__)
#define FR_API __attribute__((visibility("default")))
#define FR_PRINTF(format_index, first_index)                                                       \
    __attribute__((format(printf, format_index, first_index)))
#define FR_MUST_USE __attribute__((warn_unused_result))
#define FR_NO_RETURN __attribute__((noreturn))
#else
#define FR_API
#define FR_PRINTF(format_index, first_index)
#define FR_MUST_USE
#define FR_NO_RETURN
#endif

/// "No such element": a parent of a root, a next node of a tip, an unset index.
#define FR_NONE UINT32_MAX

/// Our own mistakes end the program at once, in every build. A user's mistake is a
/// diagnostic (diag.h) and never reaches an assertion.
#define FR_ASSERT(condition)                                                                       \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fr_assertion_failed(#condition, __FILE__, __LINE__);                                   \
        }                                                                                          \
    } while (0)

FR_API FR_NO_RETURN void fr_assertion_failed(const char *condition, const char *file, int line);
