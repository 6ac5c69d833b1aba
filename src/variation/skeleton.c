// Lines of a plant, and tables of lines.
#include "frond/variation.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

#define PLAIN_RADIUS 0.01f
#define FARTHEST 1e9

FrSegment *fr_skeleton_segments(const FrPlant *plant, size_t *count) {
    const FrNodes *nodes = &plant->nodes;
    const FrAxes *axes = &plant->axes;
    FrSegment *segments = g_new0(FrSegment, (size_t)nodes->count + axes->count + 1);
    *count = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t axis = nodes->axis[i];
        vec3s from;
        if (axes->first[axis] != i) {
            from = nodes->position[nodes->parent[i]];
        } else {
            from = fr_plant_axis_origin(plant, axis);
            uint32_t bearer = axes->bearer[axis];
            if (bearer != FR_NONE && glms_vec3_norm2(axes->offset[axis]) > 0) {
                segments[(*count)++] =
                    (FrSegment){nodes->position[bearer], from, axes->base_radius[axis]};
            }
        }
        segments[(*count)++] = (FrSegment){from, nodes->position[i], nodes->radius[i]};
    }
    return segments;
}

typedef struct Table {
    const FrSource *source;
    const char *text;
    FrDiags *diags;
    FrStatus status;
} Table;

static void report(Table *table, size_t begin, size_t end, const char *what) {
    FrSpan span = {
        .source = (FrSource *)table->source, .begin = (uint32_t)begin, .end = (uint32_t)end};
    fr_diags_add(table->diags, FR_ERROR, "bad-table", span, "%s", what);
    table->status = FR_ERR_DOCUMENT;
}

/// Reads the numbers of a row; -1 for what is none.
static int read_numbers(const char *at, const char *end, double numbers[7]) {
    int count = 0;
    for (;;) {
        while (at < end && strchr(" \t,;\r", *at) != NULL) {
            at++;
        }
        if (at >= end) {
            return count;
        }
        char *stop;
        double number = g_ascii_strtod(at, &stop);
        if (stop == at || stop > end || count == 7 || !(fabs(number) <= FARTHEST)) {
            return -1;
        }
        numbers[count++] = number;
        at = stop;
    }
}

static void read_row(Table *table, size_t begin, size_t end, GArray *segments) {
    const char *comment = memchr(table->text + begin, '#', end - begin);
    size_t stop = comment == NULL ? end : (size_t)(comment - table->text);
    double n[7] = {0, 0, 0, 0, 0, 0, (double)PLAIN_RADIUS};
    int count = read_numbers(table->text + begin, table->text + stop, n);
    if (count == 0) {
        return;
    }
    if (count != 6 && count != 7) {
        report(table, begin, stop, "a row is x y z x y z r: two ends and a radius");
    } else if (n[6] < 0) {
        report(table, begin, stop, "the radius is negative");
    } else {
        FrSegment segment = {{{(float)n[0], (float)n[1], (float)n[2]}},
                             {{(float)n[3], (float)n[4], (float)n[5]}},
                             (float)n[6]};
        g_array_append_val(segments, segment);
    }
}

FrStatus fr_skeleton_read(const FrSource *source, const FrContext *context, FrSegment **segments,
                          size_t *count) {
    size_t size;
    const char *text = fr_source_text(source, &size);
    // A copy that ends with a zero, where numbers cannot run on.
    char *copy = g_strndup(text, size);
    size_t length = strlen(copy);
    Table table = {source, copy, context->diags, FR_OK};
    GArray *rows = g_array_new(FALSE, FALSE, sizeof(FrSegment));
    if (length < size) {
        report(&table, length, length + 1, "a table is text; this is a zero byte");
    }
    for (size_t begin = 0; begin < length && fr_diags_error_count(context->diags) < 20;) {
        size_t end = begin + strcspn(copy + begin, "\n");
        read_row(&table, begin, end, rows);
        begin = end + 1;
    }
    g_free(copy);
    *count = table.status == FR_OK ? rows->len : 0;
    *segments = (FrSegment *)(void *)g_array_free(rows, table.status != FR_OK);
    return table.status;
}
