// Branch orders. Strahler 1957, Quantitative analysis of watershed geomorphology; Weibel 1963,
// Morphometry of the human lung; Gravelius 1914. Parents come before children, so each is one or
// two straight loops.
#include "frond/plant.h"

// While a loop runs, the top bit of a node's entry holds one yes or no about its children.
#define FR_MARK UINT32_C(0x80000000)

static void clear(uint32_t *order, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        order[i] = 0;
    }
}

/// A node's entry after one more child of order `own`: the largest order among the children seen,
/// marked if two of them have it.
static uint32_t with_child(uint32_t entry, uint32_t own) {
    uint32_t largest = entry & ~FR_MARK;
    uint32_t marked = own == largest ? entry | FR_MARK : entry;
    return own > largest ? own : marked;
}

void fr_plant_strahler(const FrPlant *plant, uint32_t *order) {
    const uint32_t *parent = plant->nodes.parent;
    clear(order, plant->nodes.count);
    // The node before is mostly the parent; its entry is then handed on without going through
    // memory, on which the processor would wait.
    uint32_t handed_on = 0;
    for (uint32_t i = plant->nodes.count; i-- > 0;) {
        uint32_t entry = with_child(order[i], handed_on);
        uint32_t own = (entry & ~FR_MARK) + (entry >> 31);
        own = own > 0 ? own : 1;
        order[i] = own;
        handed_on = 0;
        if (parent[i] == i - 1 && i > 0) {
            handed_on = own;
        } else if (parent[i] != FR_NONE) {
            order[parent[i]] = with_child(order[parent[i]], own);
        }
    }
}

void fr_plant_weibel(const FrPlant *plant, uint32_t *order) {
    const uint32_t *parent = plant->nodes.parent;
    uint32_t count = plant->nodes.count;
    clear(order, count);
    // First 1 for one child, marked for more: a fork.
    for (uint32_t i = 0; i < count; i++) {
        if (parent[i] != FR_NONE) {
            order[parent[i]] = order[parent[i]] == 0 ? 1 : FR_MARK;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t generation = 0;
        if (parent[i] != FR_NONE) {
            uint32_t below = order[parent[i]];
            generation = (below & ~FR_MARK) + (below >> 31);
        }
        order[i] = (order[i] & FR_MARK) | generation;
    }
    for (uint32_t i = 0; i < count; i++) {
        order[i] &= ~FR_MARK;
    }
}

void fr_plant_botanical(const FrPlant *plant, uint32_t *order) {
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        order[i] = plant->axes.order[plant->nodes.axis[i]];
    }
}
