// Four floats at a time, and stores that pass the caches by: what fills far more memory than the
// caches hold, and is not read again soon, is written twice as fast so.
#pragma once

#include <stdbool.h>
#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

typedef float FrFour __attribute__((vector_size(16)));

/// The lesser, or greater, of each pair; the second where neither is.
static inline FrFour fr_four_min(FrFour a, FrFour b) {
#ifdef __SSE2__
    return _mm_min_ps(a, b);
#else
    for (int k = 0; k < 4; k++) {
        b[k] = a[k] < b[k] ? a[k] : b[k];
    }
    return b;
#endif
}

static inline FrFour fr_four_max(FrFour a, FrFour b) {
#ifdef __SSE2__
    return _mm_max_ps(a, b);
#else
    for (int k = 0; k < 4; k++) {
        b[k] = a[k] > b[k] ? a[k] : b[k];
    }
    return b;
#endif
}

/// `to` is a multiple of 16 if `is_streamed`.
static inline void fr_four_store(float *to, FrFour value, bool is_streamed) {
#ifdef __SSE2__
    if (is_streamed) {
        _mm_stream_ps(to, value);
        return;
    }
#else
    (void)is_streamed;
#endif
    memcpy(to, &value, sizeof value);
}

/// Before other threads read what was streamed.
static inline void fr_stream_end(void) {
#ifdef __SSE2__
    _mm_sfence();
#endif
}
