/// Chains of recursion in an i-tree.
#include "cli/cli.h"

/// The nearest instance above that has the same component. A recursion comes back to a component
/// within as many steps as there are components.
static uint32_t same_above(const FrPgraphCounts *counts, uint32_t instance, uint32_t components) {
    uint32_t above = counts->parent[instance];
    for (uint32_t step = 0; step < components && above != FR_NONE; step++) {
        if (counts->component[above] == counts->component[instance]) {
            return above;
        }
        above = counts->parent[above];
    }
    return FR_NONE;
}

CliChains *cli_chains_count(const FrPgraphCounts *counts, uint32_t components) {
    CliChains *chains = g_new0(CliChains, components + 1);
    uint32_t instances = (uint32_t)counts->instances;
    uint32_t *length = g_new0(uint32_t, counts->instances + 1);
    uint8_t *goes_on = g_new0(uint8_t, counts->instances + 1);
    // Parents stand before their children.
    for (uint32_t i = 0; i < instances; i++) {
        uint32_t above = same_above(counts, i, components);
        length[i] = above == FR_NONE ? 1 : length[above] + 1;
        if (above != FR_NONE) {
            goes_on[above] = 1;
        }
    }
    for (uint32_t i = 0; i < instances; i++) {
        if (goes_on[i] != 0) {
            continue;
        }
        CliChains *of = &chains[counts->component[i]];
        of->shortest = of->count == 0 ? length[i] : MIN(of->shortest, length[i]);
        of->longest = MAX(of->longest, length[i]);
        of->count++;
    }
    g_free(length);
    g_free(goes_on);
    return chains;
}
