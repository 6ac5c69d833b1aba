/// @file progress.h
/// Watching and stopping long work. A NULL FrProgress is allowed everywhere and never cancels.
#pragma once

#include "frond/api.h"

typedef struct FrProgress FrProgress;

/// Called from any thread, at most some ten times a second; `fraction` is 0 to 1 and never falls
/// within one stage. `stage` is a short word such as "build" or "render".
typedef void (*FrProgressFn)(void *user, const char *stage, double fraction);

FR_API FrProgress *fr_progress_new(FrProgressFn report, void *user);
FR_API void fr_progress_free(FrProgress *progress);
FR_API void fr_progress_report(FrProgress *progress, const char *stage, double fraction);
/// Async-signal-safe: a handler of Ctrl-C may call it.
FR_API void fr_progress_cancel(FrProgress *progress);
FR_API bool fr_progress_is_cancelled(const FrProgress *progress);
