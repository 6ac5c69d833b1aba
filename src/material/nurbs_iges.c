// Surfaces of IGES files: entity 128, moved by transformation matrices (entity 124).
// ANSI US PRO/IPO-100-1996. A line has 80 columns, its section in the 73rd; an entity has two lines
// in the directory, which tell where its parameters are.
#include "material/nurbs_file.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 80, SECTION = 72, DATA = 64, DEPTH_MOST = 16, SURFACE = 128, MATRIX = 124 };

typedef struct FrIgesEntity {
    int64_t type, parameters, matrix, lines; ///< lines of the section P count from 1
} FrIgesEntity;

typedef struct FrIgesReader {
    FrSurfaceReader *reader;
    GPtrArray *global, *directory, *data; ///< lines of the sections, borrowed, without their ends
    GArray *entities;                     ///< FrIgesEntity, by directory line / 2
    char delimiter, end;                  ///< of parameters, of records
    double unit;                          ///< metres
} FrIgesReader;

/// A whole number in a field of 8 columns; 0 for blanks.
static int64_t field(const char *line, int number) {
    char text[9];
    memcpy(text, line + 8 * (number - 1), 8);
    text[8] = '\0';
    return g_ascii_strtoll(text, NULL, 10);
}

static void split(FrIgesReader *iges, const char *text, size_t size) {
    while (size > 0) {
        const char *end = memchr(text, '\n', size);
        size_t length = end != NULL ? (size_t)(end - text) : size;
        if (length >= SECTION + 1) {
            GPtrArray *sections[] = {iges->global, iges->directory, iges->data};
            const char *found = strchr("GDP", text[SECTION]);
            if (found != NULL && *found != '\0') {
                g_ptr_array_add(sections[found - "GDP"], (void *)text);
            }
        }
        text += length + (end != NULL);
        size -= length + (end != NULL);
    }
}

// ---- parameters --------------------------------------------------------------------------------

/// Numbers of a record; texts (nH…) count as 0.
static GArray *numbers_of(const FrIgesReader *iges, const char *text, size_t size) {
    GArray *numbers = g_array_new(FALSE, FALSE, sizeof(double));
    for (size_t at = 0; at < size;) {
        while (at < size && text[at] == ' ') {
            at++;
        }
        char *stop;
        double number = at < size ? g_ascii_strtod(text + at, &stop) : 0.0;
        size_t next = at < size ? (size_t)(stop - text) : at;
        if (next < size && text[next] == 'H' && number > 0.0) { // so many characters
            next += 1 + (size_t)fmin(number, (double)(size - next - 1));
            number = 0.0;
        }
        g_array_append_val(numbers, number);
        while (next < size && text[next] != iges->delimiter && text[next] != iges->end) {
            next++;
        }
        if (next >= size || text[next] == iges->end) {
            break;
        }
        at = next + 1;
    }
    return numbers;
}

/// The parameters of an entity as one text, with exponents that every reader knows.
static GArray *parameters_of(const FrIgesReader *iges, const FrIgesEntity *entity) {
    GString *text = g_string_new(NULL);
    for (int64_t i = 0; i < entity->lines; i++) {
        int64_t line = entity->parameters - 1 + i;
        if (line < 0 || line >= iges->data->len) {
            break;
        }
        g_string_append_len(text, g_ptr_array_index(iges->data, line), DATA);
    }
    for (size_t i = 1; i < text->len; i++) {
        bool is_exponent = text->str[i] == 'D' &&
                           g_ascii_isdigit(text->str[i - 1] == '.' ? '0' : text->str[i - 1]);
        text->str[i] = is_exponent ? 'E' : text->str[i];
    }
    GArray *numbers = numbers_of(iges, text->str, text->len);
    g_string_free(text, TRUE);
    return numbers;
}

static void read_global(FrIgesReader *iges) {
    GString *text = g_string_new(NULL);
    for (uint32_t i = 0; i < iges->global->len; i++) {
        g_string_append_len(text, g_ptr_array_index(iges->global, i), SECTION);
    }
    iges->delimiter = ',';
    iges->end = ';';
    if (g_str_has_prefix(text->str, "1H") && text->len > 6) {
        iges->delimiter = text->str[2];
        bool has_end = strncmp(text->str + 4, "1H", 2) == 0;
        iges->end = has_end ? text->str[6] : ';';
    }
    GArray *numbers = numbers_of(iges, text->str, text->len);
    // Model space scale and the flag of units, 13th and 14th.
    static const double units[] = {1, 0.0254, 0.001,     1,        0.3048, 1609.344,
                                   1, 1000,   0.0000254, 0.000001, 0.01,   0.0000000254};
    double flag = numbers->len > 13 ? g_array_index(numbers, double, 13) : 6.0;
    iges->unit = flag >= 1.0 && flag < G_N_ELEMENTS(units) ? units[(size_t)flag] : 1.0;
    g_array_unref(numbers);
    g_string_free(text, TRUE);
}

static void read_directory(FrIgesReader *iges) {
    for (uint32_t i = 0; i + 1 < iges->directory->len; i += 2) {
        const char *first = g_ptr_array_index(iges->directory, i);
        const char *second = g_ptr_array_index(iges->directory, i + 1);
        FrIgesEntity entity = {field(first, 1), field(first, 2), field(first, 7), field(second, 4)};
        g_array_append_val(iges->entities, entity);
    }
}

// ---- entities ----------------------------------------------------------------------------------

/// Moves a point by a matrix and by the matrices that move this one.
static void move_point(const FrIgesReader *iges, int64_t matrix, double point[3]) {
    for (int depth = 0; depth < DEPTH_MOST && matrix > 0; depth++) {
        int64_t index = (matrix - 1) / 2;
        if (index >= iges->entities->len) {
            return;
        }
        const FrIgesEntity *entity = &g_array_index(iges->entities, FrIgesEntity, index);
        GArray *numbers = entity->type == MATRIX ? parameters_of(iges, entity) : NULL;
        if (numbers != NULL && numbers->len >= 13) {
            const double *n = &g_array_index(numbers, double, 1);
            double moved[3];
            for (int r = 0; r < 3; r++) {
                const double *row = n + 4 * r;
                moved[r] = row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3];
            }
            memcpy(point, moved, sizeof moved);
        }
        if (numbers != NULL) {
            g_array_unref(numbers);
        }
        matrix = entity->matrix;
    }
}

static bool is_count(double value) {
    return value >= 1.0 && value < 1e6;
}

static void read_surface(FrIgesReader *iges, const FrIgesEntity *entity, size_t line) {
    GArray *numbers = parameters_of(iges, entity);
    const double *n = (const double *)(void *)numbers->data;
    bool is_sound = numbers->len > 10 && n[0] == SURFACE && is_count(n[1]) && is_count(n[2]) &&
                    n[3] >= 1.0 && n[3] <= FR_NURBS_DEGREE_MOST && n[4] >= 1.0 &&
                    n[4] <= FR_NURBS_DEGREE_MOST;
    uint32_t count[2] = {0}, degree[2] = {0};
    for (int k = 0; k < 2 && is_sound; k++) {
        count[k] = (uint32_t)n[1 + k] + 1;
        degree[k] = (uint32_t)n[3 + k];
    }
    uint64_t points = (uint64_t)count[0] * count[1], knots = 0;
    knots = (uint64_t)count[0] + degree[0] + count[1] + degree[1] + 2;
    if (!is_sound || numbers->len < 10 + knots + 4 * points) {
        fr_surface_fail(iges->reader, line, "a surface (entity 128) has too few parameters");
    } else {
        double *to[2], (*net)[4];
        FrNurbsSurface surface =
            fr_surface_new(degree[0], count[0], degree[1], count[1], &to[0], &to[1], &net);
        const double *from = n + 10;
        for (int k = 0; k < 2; k++) {
            memcpy(to[k], from, ((size_t)count[k] + degree[k] + 1) * sizeof(double));
            from += count[k] + degree[k] + 1;
        }
        for (uint64_t i = 0; i < points; i++) {
            memcpy(net[i], from + points + 3 * i, 3 * sizeof(double));
            move_point(iges, entity->matrix, net[i]);
            for (int k = 0; k < 3; k++) {
                net[i][k] *= iges->unit;
            }
            net[i][3] = from[i];
        }
        fr_surface_take(iges->reader, surface, line);
    }
    g_array_unref(numbers);
}

void fr_iges_surfaces(FrSurfaceReader *reader, const char *text, size_t size) {
    FrIgesReader iges = {.reader = reader,
                         .global = g_ptr_array_new(),
                         .directory = g_ptr_array_new(),
                         .data = g_ptr_array_new(),
                         .entities = g_array_new(FALSE, FALSE, sizeof(FrIgesEntity))};
    split(&iges, text, size);
    read_global(&iges);
    read_directory(&iges);
    for (uint32_t i = 0; i < iges.entities->len && reader->status == FR_OK; i++) {
        const FrIgesEntity *entity = &g_array_index(iges.entities, FrIgesEntity, i);
        if (entity->type == SURFACE) {
            read_surface(&iges, entity, 2 * (size_t)i + 1);
        }
        reader->has_trims |= entity->type == 144; // a trimmed surface
    }
    g_ptr_array_unref(iges.global);
    g_ptr_array_unref(iges.directory);
    g_ptr_array_unref(iges.data);
    g_array_unref(iges.entities);
}
