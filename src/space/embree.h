/// @file embree.h
/// What the files that know Embree share. Private to space.
#pragma once

#include <embree3/rtcore.h>
#include <stdint.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/// Embree is several times slower on denormals, so they count as zero during a query; the caller's
/// arithmetic must not notice. Returns what fr_restore_denormals() wants.
static inline unsigned fr_flush_denormals(void) {
#if defined(__SSE2__)
    unsigned saved = _mm_getcsr();
    _mm_setcsr(saved | 0x8040u);
    return saved;
#else
    return 0;
#endif
}

static inline void fr_restore_denormals(unsigned saved) {
#if defined(__SSE2__)
    _mm_setcsr(saved);
#else
    (void)saved;
#endif
}

static inline struct RTCRay fr_embree_ray(const float origin[3], const float direction[3],
                                          float near, float far) {
    return (struct RTCRay){
        .org_x = origin[0],
        .org_y = origin[1],
        .org_z = origin[2],
        .tnear = near,
        .dir_x = direction[0],
        .dir_y = direction[1],
        .dir_z = direction[2],
        .tfar = far,
        .mask = UINT32_MAX,
    };
}
