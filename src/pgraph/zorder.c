#include "pgraph/zorder.h"

#include <string.h>

enum { PARTS = 1024, DIGIT = 10, DIGITS = 3 };

FrZorder fr_zorder(const double min[3], const double max[3]) {
    FrZorder order;
    for (int r = 0; r < 3; r++) {
        order.min[r] = min[r];
        order.parts[r] = max[r] > min[r] ? PARTS / (max[r] - min[r]) : 0;
    }
    return order;
}

// Two zeros before each of ten bits.
static uint32_t spread(uint32_t bits) {
    bits = (bits | bits << 16) & 0x030000FFu;
    bits = (bits | bits << 8) & 0x0300F00Fu;
    bits = (bits | bits << 4) & 0x030C30C3u;
    return (bits | bits << 2) & 0x09249249u;
}

uint64_t fr_zorder_item(const FrZorder *order, const double at[3], uint32_t number) {
    uint32_t place = 0;
    for (int r = 0; r < 3; r++) {
        double part = (at[r] - order->min[r]) * order->parts[r];
        place |= spread(part < 0 ? 0 : part < PARTS - 1 ? (uint32_t)part : PARTS - 1) << r;
    }
    return (uint64_t)place << 32 | number;
}

void fr_zorder_sort(uint64_t *items, uint64_t *spare, size_t count) {
    for (int digit = 0; digit < DIGITS; digit++) {
        const int shift = 32 + digit * DIGIT;
        size_t first[1 << DIGIT] = {0}, sum = 0;
        for (size_t i = 0; i < count; i++) {
            first[items[i] >> shift & ((1 << DIGIT) - 1)]++;
        }
        for (size_t d = 0; d < 1 << DIGIT; d++) {
            size_t here = first[d];
            first[d] = sum;
            sum += here;
        }
        for (size_t i = 0; i < count; i++) {
            spare[first[items[i] >> shift & ((1 << DIGIT) - 1)]++] = items[i];
        }
        memcpy(items, spare, count * sizeof *items);
    }
}
