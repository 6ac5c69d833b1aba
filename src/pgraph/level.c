#include "pgraph/level.h"

uint64_t fr_level_row_bytes(void) {
#define FR_WIDTH(type, column) +sizeof(type)
    return 0 FR_LEVEL_COLUMNS(FR_WIDTH);
#undef FR_WIDTH
}

void fr_level_init(FrLevel *level, uint32_t count) {
    *level = (FrLevel){.count = count};
#define FR_NEW(type, column) level->column = g_new(type, (size_t)count + 1);
    FR_LEVEL_COLUMNS(FR_NEW)
#undef FR_NEW
}

void fr_level_clear(FrLevel *level) {
#define FR_FREE(type, column) g_free(level->column);
    FR_LEVEL_COLUMNS(FR_FREE)
#undef FR_FREE
    *level = (FrLevel){0};
}
