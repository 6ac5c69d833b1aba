/// @file sampler.h
/// Well-spread random numbers for one path: pairs of the Sobol' sequence, scrambled and shuffled
/// anew for each dimension after Burley 2020, Practical Hash-based Owen Scrambling (JCGT 9-4).
/// A pure function of pixel, sample and dimension. Private to render.
#pragma once

#include "frond/random.h"

typedef struct FrSampler {
    uint32_t index; ///< of the sample within its pixel
    uint32_t mask;  ///< a power of two ≥ the samples of a pixel, minus 1
    uint32_t seed;  ///< of the pixel
    uint32_t dimension;
} FrSampler;

static inline uint32_t fr_reverse_bits(uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

/// Owen's scrambling of the bits of x read from the highest.
static inline uint32_t fr_owen_scramble(uint32_t x, uint32_t seed) {
    x = fr_reverse_bits(x);
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return fr_reverse_bits(x);
}

/// The second coordinate of Sobol' point `index` as 32 fraction bits; the first is
/// fr_reverse_bits(index). Its generator matrix is Pascal's triangle modulo 2, the fifth Kronecker
/// power of [[1, 1], [0, 1]], hence five steps.
static inline uint32_t fr_sobol_second(uint32_t index) {
    index ^= (index >> 16) & 0x0000ffffu;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 1) & 0x55555555u;
    return fr_reverse_bits(index);
}

static inline FrSampler fr_sampler(uint32_t x, uint32_t y, uint32_t index, uint32_t count) {
    FrKey key = fr_key_child(fr_key_child(fr_key_root(0), x), y);
    uint32_t mask = count <= 1 ? 0 : UINT32_MAX >> __builtin_clz(count - 1);
    return (FrSampler){.index = index, .mask = mask, .seed = (uint32_t)key, .dimension = 0};
}

/// The next two numbers in [0, 1).
static inline void fr_sampler_pair(FrSampler *sampler, float *u, float *v) {
    FrKey key = fr_key_child(sampler->seed, sampler->dimension++);
    uint32_t shuffle = (uint32_t)key;
    uint32_t scramble = (uint32_t)(key >> 32);
    uint32_t index = fr_owen_scramble(sampler->index, shuffle) & sampler->mask;
    uint32_t first = fr_owen_scramble(fr_reverse_bits(index), scramble);
    uint32_t second = fr_owen_scramble(fr_sobol_second(index), scramble ^ 0x9e3779b9u);
    *u = (float)(first >> 8) * 0x1.0p-24f;
    *v = (float)(second >> 8) * 0x1.0p-24f;
}

static inline float fr_sampler_single(FrSampler *sampler) {
    float u;
    float v;
    fr_sampler_pair(sampler, &u, &v);
    return u;
}
