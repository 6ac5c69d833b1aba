/// @file context.h
/// What every long call is handed: threads, limits, progress and the list of diagnostics.
#pragma once

#include "frond/diag.h"
#include "frond/limits.h"
#include "frond/parallel.h"
#include "frond/progress.h"

typedef struct FrContext {
    FrPool *pool;         ///< NULL: single-threaded
    FrProgress *progress; ///< NULL: silent and not cancellable
    FrDiags *diags;       ///< NULL: diagnostics are dropped
    FrLimits limits;
} FrContext;

/// No pool, no progress, no diagnostics, default limits.
FR_API FrContext fr_context_default(void);
