// The draws that need more than the mixer of random.h.
// Box, Muller: A note on the generation of random normal deviates. Annals of Mathematical
// Statistics 29, 1958. FNV-1a: Fowler, Noll, Vo, 1991.
#include "frond/random.h"

#include <math.h>

double fr_random_normal(FrKey key, uint32_t purpose, uint32_t k) {
    // 1 - u lies in (0, 1], so the logarithm is finite.
    double radius = sqrt(-2.0 * log(1.0 - fr_random(key, purpose, 2 * k)));
    double angle = 6.283185307179586 * fr_random(key, purpose, 2 * k + 1);
    return radius * cos(angle);
}

FrKey fr_key_name(const char *name) {
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (const char *c = name; *c != 0; c++) {
        hash = (hash ^ (unsigned char)*c) * UINT64_C(0x100000001b3);
    }
    return fr_mix64(hash);
}
