// Pens: devices with (x, y, pressure, height), the line protocol, and strokes from them.
#include "frond/variation.h"

#include <math.h>
#include <string.h>

typedef struct Replay {
    FrPenEvent *events;
    size_t count, at;
} Replay;

static bool replay_next(void *device, FrPenEvent *event) {
    Replay *replay = device;
    if (replay->at == replay->count) {
        return false;
    }
    *event = replay->events[replay->at++];
    return true;
}

static void replay_free(void *device) {
    Replay *replay = device;
    g_free(replay->events);
    g_free(replay);
}

FrPen *fr_pen_simulated(const FrPenEvent *events, size_t count) {
    Replay *replay = g_new0(Replay, 1);
    replay->events = g_memdup2(events, count * sizeof *events);
    replay->count = count;
    FrPen *pen = g_new0(FrPen, 1);
    *pen = (FrPen){.next = replay_next, .free = replay_free, .device = replay};
    return pen;
}

void fr_pen_free(FrPen *pen) {
    if (pen != NULL) {
        if (pen->free != NULL) {
            pen->free(pen->device);
        }
        g_free(pen);
    }
}

// ---- lines ------------------------------------------------------------------------------------

typedef struct Form {
    const char *word;
    FrPenEventKind kind;
    int numbers;
} Form;

static const Form forms[] = {
    {"down", FR_PEN_DOWN, 0},
    {"move", FR_PEN_MOVE, 4},     // x y pressure time
    {"height", FR_PEN_HEIGHT, 2}, // height time
    {"up", FR_PEN_UP, 0},
};

/// True if the line is an event.
static bool read_line(char *line, FrPenEvent *event) {
    char *at = line + strspn(line, " \t");
    size_t length = strcspn(at, " \t");
    for (size_t f = 0; f < G_N_ELEMENTS(forms); f++) {
        if (strlen(forms[f].word) != length || strncmp(at, forms[f].word, length) != 0) {
            continue;
        }
        double numbers[4] = {0};
        at += length;
        for (int n = 0; n < forms[f].numbers; n++) {
            char *end;
            numbers[n] = g_ascii_strtod(at, &end);
            if (end == at || !(fabs(numbers[n]) < 1e12)) {
                return false;
            }
            at = end;
        }
        *event = (FrPenEvent){.kind = forms[f].kind};
        if (event->kind == FR_PEN_MOVE) {
            event->x = numbers[0];
            event->y = numbers[1];
            event->pressure = fmin(fmax(numbers[2], 0), 1);
            event->time = numbers[3];
        } else if (event->kind == FR_PEN_HEIGHT) {
            event->height = numbers[0];
            event->time = numbers[1];
        }
        return at[strspn(at, " \t")] == '\0';
    }
    return false;
}

FrPen *fr_pen_from_lines(const char *text, size_t size, size_t *wrong) {
    GArray *events = g_array_new(FALSE, FALSE, sizeof(FrPenEvent));
    size_t bad = 0;
    for (size_t begin = 0; begin < size;) {
        const char *end = memchr(text + begin, '\n', size - begin);
        size_t length = end == NULL ? size - begin : (size_t)(end - text) - begin;
        char *line = g_strndup(text + begin, length);
        line[strcspn(line, "#\r")] = '\0';
        FrPenEvent event;
        if (read_line(line, &event)) {
            g_array_append_val(events, event);
        } else {
            bad += line[strspn(line, " \t")] != '\0';
        }
        g_free(line);
        begin += length + 1;
    }
    if (wrong != NULL) {
        *wrong = bad;
    }
    FrPen *pen = fr_pen_simulated((const FrPenEvent *)(const void *)events->data, events->len);
    g_array_unref(events);
    return pen;
}

char *fr_pen_line(const FrPenEvent *event) {
    GString *line = g_string_new(NULL);
    const double numbers[2][4] = {{event->x, event->y, event->pressure, event->time},
                                  {event->height, event->time}};
    for (size_t f = 0; f < G_N_ELEMENTS(forms); f++) {
        if (forms[f].kind != event->kind) {
            continue;
        }
        g_string_append(line, forms[f].word);
        for (int n = 0; n < forms[f].numbers; n++) {
            char number[G_ASCII_DTOSTR_BUF_SIZE];
            double value = numbers[event->kind == FR_PEN_HEIGHT][n];
            g_string_append_printf(line, " %s",
                                   g_ascii_formatd(number, sizeof number, "%.9g", value));
        }
    }
    g_string_append_c(line, '\n');
    return g_string_free(line, FALSE);
}

// ---- strokes ----------------------------------------------------------------------------------

/// Gives every move the height between those heard before and after it.
static void set_heights(GArray *moves, const GArray *heights) {
    guint next = 0;
    for (guint i = 0; i < moves->len; i++) {
        FrStrokePoint *move = &g_array_index(moves, FrStrokePoint, i);
        while (next < heights->len && g_array_index(heights, FrPenEvent, next).time <= move->time) {
            next++;
        }
        if (heights->len == 0) {
            return;
        }
        const FrPenEvent *after = &g_array_index(heights, FrPenEvent, MIN(next, heights->len - 1));
        const FrPenEvent *before = &g_array_index(heights, FrPenEvent, next > 0 ? next - 1 : 0);
        double span = after->time - before->time;
        double part = span > 0 ? fmin(fmax((move->time - before->time) / span, 0), 1) : 0;
        move->at.z = (float)(before->height + part * (after->height - before->height));
    }
}

static void add_move(GArray *moves, const FrPenEvent *event) {
    FrStrokePoint point = {.at = {{(float)event->x, (float)event->y, 0}},
                           .pressure = (float)event->pressure,
                           .time = event->time};
    g_array_append_val(moves, point);
}

FrStroke *fr_pen_stroke(FrPen *pen) {
    GArray *moves = g_array_new(FALSE, FALSE, sizeof(FrStrokePoint));
    GArray *heights = g_array_new(FALSE, FALSE, sizeof(FrPenEvent));
    FrStroke *stroke = NULL;
    FrPenEvent event;
    bool is_down = false;
    if (pen->height.kind == FR_PEN_HEIGHT) {
        g_array_append_val(heights, pen->height);
    }
    while (stroke == NULL && pen->next(pen->device, &event)) {
        switch (event.kind) {
        case FR_PEN_DOWN:
            is_down = true;
            g_array_set_size(moves, 0);
            break;
        case FR_PEN_MOVE:
            if (is_down) {
                add_move(moves, &event);
            }
            break;
        case FR_PEN_HEIGHT:
            // Before the pen is down only the last height counts.
            g_array_set_size(heights, is_down ? heights->len : 0);
            g_array_append_val(heights, event);
            pen->height = event;
            break;
        case FR_PEN_UP:
            is_down = false;
            set_heights(moves, heights);
            stroke = fr_stroke_new((const FrStrokePoint *)(const void *)moves->data, moves->len);
            if (heights->len > 1) {
                g_array_remove_range(heights, 0, heights->len - 1); // for a stroke after a point
            }
            break;
        }
    }
    g_array_unref(moves);
    g_array_unref(heights);
    return stroke;
}
