/// @file key_table.h
/// A table from 64-bit digests to 32-bit numbers: open addressing with linear probing. Private to
/// light.
#pragma once

#include "frond/api.h"

#include <glib.h>

typedef struct FrKeyTable {
    struct FrKeySlot {
        uint64_t key;
        uint32_t value; ///< FR_NONE: empty
    } * slots;
    uint32_t mask, count;
} FrKeyTable;

static inline void fr_key_table_clear(FrKeyTable *table) {
    g_free(table->slots);
    *table = (FrKeyTable){0};
}

/// Where the value of a key is, or FR_NONE to be filled. Room must have been reserved.
static inline uint32_t *fr_key_table_at(FrKeyTable *table, uint64_t key) {
    uint32_t i = (uint32_t)(key >> 32) & table->mask;
    while (table->slots[i].value != FR_NONE && table->slots[i].key != key) {
        i = (i + 1) & table->mask;
    }
    table->count += table->slots[i].value == FR_NONE;
    table->slots[i].key = key;
    return &table->slots[i].value;
}

static inline uint32_t fr_key_table_find(const FrKeyTable *table, uint64_t key) {
    uint32_t i = (uint32_t)(key >> 32) & table->mask;
    while (table->slots[i].value != FR_NONE && table->slots[i].key != key) {
        i = (i + 1) & table->mask;
    }
    return table->slots[i].value;
}

/// Makes room for `more` keys: at most two thirds of the slots get filled.
static inline void fr_key_table_reserve(FrKeyTable *table, uint32_t more) {
    uint64_t wanted = 3 * ((uint64_t)table->count + more) / 2 + 1;
    uint64_t old_size = table->slots == NULL ? 0 : (uint64_t)table->mask + 1;
    if (table->slots != NULL && wanted <= old_size) {
        return;
    }
    uint64_t size = 64;
    while (size < wanted) {
        size *= 2;
    }
    struct FrKeySlot *old = table->slots;
    table->slots = g_new(struct FrKeySlot, size);
    table->mask = (uint32_t)(size - 1);
    table->count = 0;
    memset(table->slots, 0xff, size * sizeof *table->slots);
    for (uint64_t i = 0; i < old_size; i++) {
        if (old[i].value != FR_NONE) {
            *fr_key_table_at(table, old[i].key) = old[i].value;
        }
    }
    g_free(old);
}
