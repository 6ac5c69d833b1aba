/// @file diag.h
/// The list behind FrDiags. Private to base.
#pragma once

#include "frond/diag.h"

#include <pthread.h>

enum { FR_DIAGS_KEPT = 20 };

struct FrDiags {
    pthread_mutex_t lock;
    FrDiag kept[FR_DIAGS_KEPT];
    size_t count;       ///< of kept
    size_t total;       ///< of all ever added
    size_t error_total; ///< of errors among them
};
