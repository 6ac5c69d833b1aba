/// @file digest.h
/// A 64-bit digest of data, to compare plants, scenes and pictures (XXH3, not cryptographic).
#pragma once

#include "frond/api.h"

typedef uint64_t FrDigest;

/// The digest of `size` bytes continued from `seed` (0, or the digest of what came before).
FR_API FrDigest fr_digest(FrDigest seed, const void *data, size_t size);
