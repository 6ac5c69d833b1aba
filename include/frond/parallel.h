/// @file parallel.h
/// One pool of threads and one way to use it. Results never depend on the split.
#pragma once

#include "frond/progress.h"

typedef struct FrPool FrPool;

/// `threads` counts the caller too; 0 means one per processor. Threads sleep between loops.
FR_API FrPool *fr_pool_new(int threads);
FR_API void fr_pool_free(FrPool *pool);
/// At least 1; 1 for a NULL pool.
FR_API int fr_pool_threads(const FrPool *pool);

/// Does elements [begin, end). `worker` is 0 … threads−1 and selects scratch memory.
typedef void (*FrRangeFn)(void *data, size_t begin, size_t end, int worker);

/// Cuts [0, count) into chunks of `grain` elements (the last may be shorter) and does them in any
/// order on all threads; returns when all are done, or soon after `progress` is cancelled.
/// With a NULL pool or one chunk everything happens in the calling thread. Not to be nested.
FR_API void fr_parallel_for(FrPool *pool, size_t count, size_t grain, FrRangeFn body, void *data,
                            FrProgress *progress);
