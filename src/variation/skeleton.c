// Lines of a plant, and tables of lines.
#include "frond/variation.h"

#include <cglm/struct.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PLAIN_RADIUS 0.01f
#define FARTHEST 1e9

/// Where along the internodes of a plant branches stand, in ascending order for each.
typedef struct Feet {
    uint32_t *first; ///< of every node, into `along`; nodes + 1
    float *along;    ///< part of the internode, from its beginning
} Feet;

/// How far along its bearer a branch stands, from 0 to 1.
static float foot_of(const FrPlant *plant, uint32_t axis) {
    float length = plant->nodes.length[plant->axes.bearer[axis]];
    return length > 0 ? CLAMP(1 + plant->axes.offset[axis].z / length, 0.0f, 1.0f) : 1;
}

static int compare_feet(const void *a, const void *b) {
    float one = *(const float *)a, other = *(const float *)b;
    return (one > other) - (one < other);
}

static Feet find_feet(const FrPlant *plant) {
    const FrAxes *axes = &plant->axes;
    uint32_t nodes = plant->nodes.count;
    Feet feet = {g_new0(uint32_t, (gsize)nodes + 2), g_new(float, (gsize)axes->count + 1)};
    uint32_t *filled = feet.first + 1; // ends up as the first of the next
    for (uint32_t a = 0; a < axes->count; a++) {
        if (axes->bearer[a] != FR_NONE) {
            filled[axes->bearer[a]]++;
        }
    }
    for (uint32_t i = 0, total = 0; i < nodes; i++) {
        uint32_t count = filled[i];
        filled[i] = total;
        total += count;
    }
    for (uint32_t a = 0; a < axes->count; a++) {
        if (axes->bearer[a] != FR_NONE) {
            feet.along[filled[axes->bearer[a]]++] = foot_of(plant, a);
        }
    }
    for (uint32_t i = 0; i < nodes; i++) {
        qsort(feet.along + feet.first[i], feet.first[i + 1] - feet.first[i], sizeof(float),
              compare_feet);
    }
    return feet;
}

/// Where an internode begins: on the middle of its bearer if it is the first of a branch.
static vec3s begin_of(const FrPlant *plant, uint32_t node) {
    uint32_t axis = plant->nodes.axis[node], bearer = plant->axes.bearer[axis];
    if (plant->axes.first[axis] != node) {
        return plant->nodes.position[plant->nodes.parent[node]];
    }
    if (bearer == FR_NONE) {
        return plant->axes.offset[axis];
    }
    vec3s heading = fr_frame_heading(plant->nodes.frame[bearer]);
    float back = (foot_of(plant, axis) - 1) * plant->nodes.length[bearer];
    return glms_vec3_add(plant->nodes.position[bearer], glms_vec3_scale(heading, back));
}

FrSegment *fr_skeleton_segments(const FrPlant *plant, size_t *count) {
    const FrNodes *nodes = &plant->nodes;
    FrSegment *segments = g_new0(FrSegment, (size_t)nodes->count + plant->axes.count + 1);
    Feet feet = find_feet(plant);
    *count = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        vec3s from = begin_of(plant, i), tip = nodes->position[i];
        vec3s heading = fr_frame_heading(nodes->frame[i]);
        float reached = 0;
        for (uint32_t f = feet.first[i]; f < feet.first[i + 1]; f++) {
            float along = feet.along[f];
            if (along > reached && along < 1) {
                vec3s to =
                    glms_vec3_add(tip, glms_vec3_scale(heading, (along - 1) * nodes->length[i]));
                segments[(*count)++] = (FrSegment){from, to, nodes->radius[i]};
                from = to;
                reached = along;
            }
        }
        segments[(*count)++] = (FrSegment){from, tip, nodes->radius[i]};
    }
    g_free(feet.first);
    g_free(feet.along);
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
