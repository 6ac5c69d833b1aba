// The digest against the vectors of xxHash's own sanity check.
#include "frond/digest.h"

#include <glib.h>

// The sanity buffer of xxHash: bytes from a multiplicative generator.
static void fill(unsigned char *buffer, size_t size) {
    uint64_t state = UINT64_C(2654435761);
    for (size_t i = 0; i < size; i++) {
        buffer[i] = (unsigned char)(state >> 56);
        state *= UINT64_C(11400714785074694797);
    }
}

static void test_vectors(void) {
    unsigned char buffer[6];
    fill(buffer, sizeof buffer);
    uint64_t seed = UINT64_C(0x9e3779b185ebca8d);
    g_assert_cmphex(fr_digest(0, buffer, 0), ==, UINT64_C(0x2d06800538d394c2));
    g_assert_cmphex(fr_digest(seed, buffer, 0), ==, UINT64_C(0xa8a6b918b2f0364a));
    g_assert_cmphex(fr_digest(0, buffer, 1), ==, UINT64_C(0xc44bdff4074eecdb));
    g_assert_cmphex(fr_digest(seed, buffer, 1), ==, UINT64_C(0x032be332dd766ef8));
    g_assert_cmphex(fr_digest(0, buffer, 6), ==, UINT64_C(0x27b56a84cd2d7325));
}

static void test_order(void) {
    FrDigest ab = fr_digest(fr_digest(0, "a", 1), "b", 1);
    FrDigest ba = fr_digest(fr_digest(0, "b", 1), "a", 1);
    g_assert_cmphex(ab, !=, ba);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/digest/it is XXH3 with a seed", test_vectors);
    g_test_add_func("/base/digest/the order of the parts counts", test_order);
    return g_test_run();
}
