/// @file random.h
/// Counter-based random numbers: a draw is a hash of (key, purpose, k), never a stream.
///
/// The key of an instance is a hash of its path in the plant (which components, iterations and
/// generations lead to it), so adding a branch leaves the draws of all others bit-identical.
/// The mixer is the finalizer of SplitMix64 (Steele, Lea, Flood 2014), applied per word.
#pragma once

#include "frond/api.h"

typedef uint64_t FrKey;

static inline uint64_t fr_mix64(uint64_t z) {
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/// The key of a plant or any other root of randomness.
static inline FrKey fr_key_root(uint64_t seed) {
    return fr_mix64(seed + UINT64_C(0x9e3779b97f4a7c15));
}

/// The key of what `word` names below `parent`: a component id, an iteration, a generation.
static inline FrKey fr_key_child(FrKey parent, uint64_t word) {
    return fr_mix64((parent ^ (word * UINT64_C(0xd1342543de82ef95))) +
                    UINT64_C(0x9e3779b97f4a7c15));
}

/// 64 random bits for one purpose (a parameter's id, say); `k` numbers several draws.
static inline uint64_t fr_random_bits(FrKey key, uint32_t purpose, uint32_t k) {
    return fr_key_child(key, ((uint64_t)purpose << 32) | k);
}

/// Uniform in [0, 1), 53 bits.
static inline double fr_random(FrKey key, uint32_t purpose, uint32_t k) {
    return (double)(fr_random_bits(key, purpose, k) >> 11) * 0x1.0p-53;
}

/// Uniform in [-1, 1).
static inline double fr_random_signed(FrKey key, uint32_t purpose, uint32_t k) {
    return 2.0 * fr_random(key, purpose, k) - 1.0;
}

/// Standard normal deviate (Box-Muller on draws 2k and 2k+1).
FR_API double fr_random_normal(FrKey key, uint32_t purpose, uint32_t k);

/// A key for a name, e.g. a component's id: FNV-1a over its bytes, then mixed.
FR_API FrKey fr_key_name(const char *name);
