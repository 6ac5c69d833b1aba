#include "plant/columns.h"

#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define LARGE_PAGE ((size_t)2 << 20)

// Every table begins with these two; the arrays follow.
typedef struct FrTableHead {
    uint32_t count, capacity;
} FrTableHead;

#define FR_ADD_WIDTH(field, fill, is_cache) +sizeof(*((FrNodes *)0)->field)
_Static_assert((0 FR_NODE_COLUMNS(FR_ADD_WIDTH)) <= 72, "an internode has outgrown its budget");

#define FR_COLUMN_OF(type, field_, fill_, is_cache_)                                               \
    {.offset = offsetof(type, field_),                                                             \
     .width = sizeof(*((type *)0)->field_),                                                        \
     .fill = FR_FILL_##fill_,                                                                      \
     .is_cache = is_cache_},
#define FR_NODE_COLUMN(field, fill, is_cache) FR_COLUMN_OF(FrNodes, field, fill, is_cache)
#define FR_AXIS_COLUMN(field, fill, is_cache) FR_COLUMN_OF(FrAxes, field, fill, is_cache)
#define FR_ORGAN_COLUMN(field, fill, is_cache) FR_COLUMN_OF(FrOrgans, field, fill, is_cache)
#define FR_BUD_COLUMN(field, fill, is_cache) FR_COLUMN_OF(FrBuds, field, fill, is_cache)

static const FrColumn node_columns[] = {FR_NODE_COLUMNS(FR_NODE_COLUMN)};
static const FrColumn axis_columns[] = {FR_AXIS_COLUMNS(FR_AXIS_COLUMN)};
static const FrColumn organ_columns[] = {FR_ORGAN_COLUMNS(FR_ORGAN_COLUMN)};
static const FrColumn bud_columns[] = {FR_BUD_COLUMNS(FR_BUD_COLUMN)};

const FrColumns fr_node_columns = {node_columns, G_N_ELEMENTS(node_columns)};
const FrColumns fr_axis_columns = {axis_columns, G_N_ELEMENTS(axis_columns)};
const FrColumns fr_organ_columns = {organ_columns, G_N_ELEMENTS(organ_columns)};
const FrColumns fr_bud_columns = {bud_columns, G_N_ELEMENTS(bud_columns)};

void *fr_column_data(const void *table, const FrColumn *column) {
    void *data;
    memcpy(&data, (const char *)table + column->offset, sizeof data);
    return data;
}

static void set_column_data(void *table, const FrColumn *column, void *data) {
    memcpy((char *)table + column->offset, &data, sizeof data);
}

static FrTableHead *head_of(void *table) {
    return table;
}

// Large columns on large pages: filling them then costs a few page faults instead of thousands.
// They begin with such a page, and their last small pages stay small. What realloc() moves does not
// get them, so it is copied.
static void *grow(void *old, size_t used, size_t size) {
    if (size < LARGE_PAGE) {
        return g_realloc(old, size);
    }
    void *data = NULL;
    if (posix_memalign(&data, LARGE_PAGE, size) != 0) {
        return g_realloc(old, size); // which ends the program where there is no memory
    }
    madvise(data, size & ~(LARGE_PAGE - 1), MADV_HUGEPAGE); // where it is refused, small ones do
    if (used > 0) {
        memcpy(data, old, used);
    }
    g_free(old);
    return data;
}

static void reserve(void *table, const FrColumns *columns, uint32_t capacity) {
    for (size_t c = 0; c < columns->count; c++) {
        const FrColumn *column = &columns->columns[c];
        void *data = fr_column_data(table, column);
        size_t used = (size_t)head_of(table)->count * column->width;
        set_column_data(table, column, grow(data, used, (size_t)capacity * column->width));
    }
    head_of(table)->capacity = capacity;
}

static void fill_rows(void *data, const FrColumn *column, uint32_t first, uint32_t count) {
    switch (column->fill) {
    case FR_FILL_ZERO:
        memset((char *)data + (size_t)first * column->width, 0, (size_t)count * column->width);
        break;
    case FR_FILL_NONE:
        memset((char *)data + (size_t)first * column->width, 0xff, (size_t)count * column->width);
        break;
    case FR_FILL_ONE: {
        float *row = (float *)data + first;
        for (uint32_t i = 0; i < count; i++) {
            row[i] = 1.0f;
        }
        break;
    }
    case FR_FILL_IDENTITY: {
        versors *row = (versors *)data + first;
        for (uint32_t i = 0; i < count; i++) {
            row[i] = GLMS_QUAT_IDENTITY;
        }
        break;
    }
    }
}

void fr_columns_reserve(void *table, const FrColumns *columns, uint32_t capacity) {
    if (capacity > head_of(table)->capacity) {
        reserve(table, columns, capacity);
    }
}

uint32_t fr_columns_append(void *table, const FrColumns *columns, uint32_t count) {
    return fr_columns_append_but(table, columns, count, 0);
}

void fr_columns_extend(void *table, const FrColumns *columns, uint32_t count) {
    FrTableHead *head = head_of(table);
    FR_ASSERT(count < FR_NONE - head->count); // FR_NONE stays free to mean "none"
    if (count == 0) {
        return;
    }
    uint32_t first = head->count;
    uint32_t wanted = first + count;
    if (wanted > head->capacity) {
        // Appended one by one, rows double the table; appended at once, they get what they need.
        uint64_t doubled = MAX(2 * (uint64_t)head->capacity, 16);
        bool grows = first > 0 && doubled < FR_NONE;
        reserve(table, columns, grows ? MAX((uint32_t)doubled, wanted) : MAX(wanted, 16));
    }
    head->count = wanted;
}

void fr_columns_fill(void *table, const FrColumns *columns, uint32_t first, uint32_t count,
                     uint32_t written) {
    if (count == 0) {
        return; // an empty table has no columns yet
    }
    for (size_t c = 0; c < columns->count; c++) {
        if ((written >> c & 1) == 0) {
            fill_rows(fr_column_data(table, &columns->columns[c]), &columns->columns[c], first,
                      count);
        }
    }
}

uint32_t fr_columns_append_but(void *table, const FrColumns *columns, uint32_t count,
                               uint32_t written) {
    uint32_t first = head_of(table)->count;
    fr_columns_extend(table, columns, count);
    fr_columns_fill(table, columns, first, count, written);
    return first;
}

void fr_columns_copy(void *to, const void *from, const FrColumns *columns) {
    const FrTableHead *head = from;
    *head_of(to) = (FrTableHead){.count = head->count, .capacity = head->count};
    for (size_t c = 0; c < columns->count; c++) {
        const FrColumn *column = &columns->columns[c];
        set_column_data(
            to, column,
            g_memdup2(fr_column_data(from, column), (size_t)head->count * column->width));
    }
}

void fr_columns_compact(void *table, const FrColumns *columns, const uint32_t *map,
                        uint32_t count) {
    FrTableHead *head = head_of(table);
    for (size_t c = 0; c < columns->count; c++) {
        const FrColumn *column = &columns->columns[c];
        char *data = fr_column_data(table, column);
        // Runs of kept rows move together; most of a plant is one long run.
        for (uint32_t i = 0; i < head->count;) {
            if (map[i] == FR_NONE) {
                i++;
                continue;
            }
            uint32_t end = i + 1;
            while (end < head->count && map[end] != FR_NONE) {
                end++;
            }
            if (map[i] != i) {
                memmove(data + (size_t)map[i] * column->width, data + (size_t)i * column->width,
                        (size_t)(end - i) * column->width);
            }
            i = end;
        }
    }
    head->count = count;
}

void fr_columns_free(void *table, const FrColumns *columns) {
    for (size_t c = 0; c < columns->count; c++) {
        g_free(fr_column_data(table, &columns->columns[c]));
    }
}

uint64_t fr_columns_bytes(const void *table, const FrColumns *columns) {
    const FrTableHead *head = table;
    uint64_t row = 0;
    for (size_t c = 0; c < columns->count; c++) {
        row += columns->columns[c].width;
    }
    return head->capacity * row;
}
