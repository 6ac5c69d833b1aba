// Ranks of proposals: a radix sort by the upper halves of their keys, then those few by hand whose
// halves are equal.
#include "growth/propose.h"

#include <string.h>

enum { DIGIT = 11, DIGITS = 1 << DIGIT };

static void sort_by_digit(const uint64_t *keys, const uint32_t *from, uint32_t *to, uint32_t count,
                          int shift) {
    uint32_t start[DIGITS + 1] = {0};
    for (uint32_t i = 0; i < count; i++) {
        start[(keys[from[i]] >> shift & (DIGITS - 1)) + 1]++;
    }
    for (int digit = 0; digit < DIGITS; digit++) {
        start[digit + 1] += start[digit];
    }
    for (uint32_t i = 0; i < count; i++) {
        to[start[keys[from[i]] >> shift & (DIGITS - 1)]++] = from[i];
    }
}

void fr_growth_rank(FrGrowth *growth, uint32_t count) {
    const uint64_t *keys = growth->sort_keys;
    uint32_t *sorted = growth->by_rank, *other = growth->other_rank;
    for (uint32_t i = 0; i < count; i++) {
        other[i] = i;
    }
    sort_by_digit(keys, other, sorted, count, 31);
    sort_by_digit(keys, sorted, other, count, 42);
    sort_by_digit(keys, other, sorted, count, 53);
    for (uint32_t i = 1; i < count; i++) {
        uint32_t moving = sorted[i], k = i;
        for (; k > 0 && keys[sorted[k - 1]] > keys[moving]; k--) {
            sorted[k] = sorted[k - 1];
        }
        sorted[k] = moving;
    }
    for (uint32_t i = 0; i < count; i++) {
        growth->proposals[sorted[i]].rank = i;
    }
}
