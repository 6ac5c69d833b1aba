// Digests of data.
// XXH3: Yann Collet, xxHash 0.8, https://xxhash.com; the library's seed takes what came before.
#include "frond/digest.h"

#include <xxhash.h>

FrDigest fr_digest(FrDigest seed, const void *data, size_t size) {
    return XXH3_64bits_withSeed(data, size, seed);
}
