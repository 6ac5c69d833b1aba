// Surfaces of IGES files: entity 128, moved by transformation matrices (entity 124).
// ANSI US PRO/IPO-100-1996. A line has 80 columns, its section in the 73rd; an entity has two lines
// in the directory, which tell where its parameters are.
#include "material/nurbs_file.h"

#include <math.h>
#include <string.h>

enum { SECTION = 72, DATA = 64, DEPTH_MOST = 64, SURFACE = 128, MATRIX = 124, TRIMMED = 144 };
/// Global parameters, from 0: model space scale, flag and name of units.
enum { SCALE = 12, UNIT_FLAG = 13, UNIT_NAME = 14 };

/// A line of a section; of the text of the file, without its end.
typedef struct FrIgesLine {
    const char *text;
    size_t line; ///< of the file, from 1
} FrIgesLine;

typedef struct FrIgesEntity {
    int64_t type, parameters, matrix, lines; ///< lines of the section P count from 1
    size_t line;                             ///< of the file, where it is listed
} FrIgesEntity;

typedef struct FrIgesReader {
    FrSurfaceReader *reader;
    GArray *global, *directory, *data; ///< FrIgesLine
    GArray *entities;                  ///< FrIgesEntity, by directory line / 2
    char delimiter, end;               ///< of parameters, of records
    double unit;                       ///< metres
} FrIgesReader;

/// A rigid motion, row by row.
typedef struct FrIgesMotion {
    double rows[3][4];
} FrIgesMotion;

/// A whole number in a field of 8 columns; 0 for blanks.
static int64_t field(const char *line, int number) {
    char text[9];
    memcpy(text, line + 8 * (number - 1), 8);
    text[8] = '\0';
    return g_ascii_strtoll(text, NULL, 10);
}

static void split(FrIgesReader *iges, const char *text, size_t size) {
    for (size_t line = 1; size > 0; line++) {
        size_t length = fr_line_length(text, size);
        size_t step = length + fr_line_end(text + length, size - length);
        char section = length > SECTION ? text[SECTION] : ' ';
        GArray *lines = section == 'G'   ? iges->global
                        : section == 'D' ? iges->directory
                        : section == 'P' ? iges->data
                                         : NULL;
        if (lines != NULL) {
            FrIgesLine found = {text, line};
            g_array_append_val(lines, found);
        }
        text += step;
        size -= step;
    }
}

// ---- parameters --------------------------------------------------------------------------------

/// Numbers of a record; texts (nH…) count as 0. `name` (NULL: nobody asks) receives the text that
/// is the parameter UNIT_NAME.
static GArray *numbers_of(const FrIgesReader *iges, const char *text, size_t size, char **name) {
    GArray *numbers = g_array_new(FALSE, FALSE, sizeof(double));
    for (size_t at = 0; at < size;) {
        while (at < size && text[at] == ' ') {
            at++;
        }
        char *stop;
        double number = at < size ? g_ascii_strtod(text + at, &stop) : 0.0;
        size_t next = at < size ? (size_t)(stop - text) : at;
        if (next < size && text[next] == 'H' && number > 0.0) { // so many characters
            size_t length = (size_t)fmin(number, (double)(size - next - 1));
            if (name != NULL && numbers->len == UNIT_NAME) {
                *name = g_strndup(text + next + 1, length);
            }
            next += 1 + length;
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
        g_string_append_len(text, g_array_index(iges->data, FrIgesLine, line).text, DATA);
    }
    for (size_t i = 1; i < text->len; i++) {
        bool is_exponent = text->str[i] == 'D' &&
                           g_ascii_isdigit(text->str[i - 1] == '.' ? '0' : text->str[i - 1]);
        text->str[i] = is_exponent ? 'E' : text->str[i];
    }
    GArray *numbers = numbers_of(iges, text->str, text->len, NULL);
    g_string_free(text, TRUE);
    return numbers;
}

// ---- units -------------------------------------------------------------------------------------

static const struct {
    int flag;
    const char *names[2];
    double metres;
} units[] = {{1, {"IN", "INCH"}, 0.0254}, {2, {"MM"}, 0.001},    {4, {"FT"}, 0.3048},
             {5, {"MI"}, 1609.344},       {6, {"M"}, 1.0},       {7, {"KM"}, 1000.0},
             {8, {"MIL"}, 0.0000254},     {9, {"UM"}, 0.000001}, {10, {"CM"}, 0.01},
             {11, {"UIN"}, 0.0000000254}};

/// Metres of a unit; flag 3 has it by name. 0 if there is none like that.
static double unit_of(int flag, const char *name) {
    for (size_t i = 0; i < G_N_ELEMENTS(units); i++) {
        bool is_named =
            flag == 3 && name != NULL &&
            (g_ascii_strcasecmp(name, units[i].names[0]) == 0 ||
             (units[i].names[1] != NULL && g_ascii_strcasecmp(name, units[i].names[1]) == 0));
        if (flag == units[i].flag || is_named) {
            return units[i].metres;
        }
    }
    return 0.0;
}

static void read_units(FrIgesReader *iges, const GArray *numbers, const char *name) {
    double flag = numbers->len > UNIT_FLAG ? g_array_index(numbers, double, UNIT_FLAG) : 0.0;
    double scale = numbers->len > SCALE ? g_array_index(numbers, double, SCALE) : 0.0;
    size_t line = g_array_index(iges->global, FrIgesLine, 0).line;
    flag = flag == 0.0 ? 1.0 : flag; // by default they are inches
    iges->unit = flag >= 1.0 && flag < 100.0 ? unit_of((int)flag, name) : 0.0;
    if (!(iges->unit > 0.0)) {
        iges->unit = 1.0;
        fr_surface_warn(iges->reader, line, "the unit with the flag %g is unknown, so it is metres",
                        flag);
    }
    // The scale is the size in the model over the true one.
    bool is_scale = scale > 1e-9 && scale < 1e9;
    if (scale != 0.0 && !is_scale) {
        fr_surface_warn(iges->reader, line, "the scale of model space %g is left out", scale);
    }
    iges->unit /= is_scale ? scale : 1.0;
}

static void read_global(FrIgesReader *iges) {
    iges->delimiter = ',';
    iges->end = ';';
    iges->unit = 1.0;
    if (iges->global->len == 0) {
        return;
    }
    GString *text = g_string_new(NULL);
    for (uint32_t i = 0; i < iges->global->len; i++) {
        g_string_append_len(text, g_array_index(iges->global, FrIgesLine, i).text, SECTION);
    }
    if (g_str_has_prefix(text->str, "1H") && text->len > 6) {
        iges->delimiter = text->str[2];
        bool has_end = strncmp(text->str + 4, "1H", 2) == 0;
        iges->end = has_end ? text->str[6] : ';';
    }
    char *name = NULL;
    GArray *numbers = numbers_of(iges, text->str, text->len, &name);
    read_units(iges, numbers, name);
    g_free(name);
    g_array_unref(numbers);
    g_string_free(text, TRUE);
}

// ---- entities ----------------------------------------------------------------------------------

static void read_directory(FrIgesReader *iges) {
    for (uint32_t i = 0; i + 1 < iges->directory->len; i += 2) {
        const FrIgesLine *first = &g_array_index(iges->directory, FrIgesLine, i);
        const char *second = g_array_index(iges->directory, FrIgesLine, i + 1).text;
        FrIgesEntity entity = {field(first->text, 1), field(first->text, 2), field(first->text, 7),
                               field(second, 4), first->line};
        g_array_append_val(iges->entities, entity);
    }
}

/// `motion` after what the numbers of a matrix say.
static void move_on(FrIgesMotion *motion, const double *matrix) {
    FrIgesMotion before = *motion;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) {
            double sum = c == 3 ? matrix[4 * r + 3] : 0.0;
            for (int k = 0; k < 3; k++) {
                sum += matrix[4 * r + k] * before.rows[k][c];
            }
            motion->rows[r][c] = sum;
        }
    }
}

/// The motion of an entity by its matrix and by those that move this one. False after a diagnostic.
static bool motion_of(const FrIgesReader *iges, const FrIgesEntity *entity, FrIgesMotion *motion) {
    *motion = (FrIgesMotion){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    int64_t next = entity->matrix;
    for (int depth = 0; next > 0; depth++) {
        int64_t index = (next - 1) / 2;
        const FrIgesEntity *matrix = index < iges->entities->len
                                         ? &g_array_index(iges->entities, FrIgesEntity, index)
                                         : NULL;
        if (matrix == NULL || matrix->type != MATRIX) {
            fr_surface_fail(iges->reader, entity->line, "its matrix is no entity 124");
            return false;
        }
        if (depth == DEPTH_MOST) {
            fr_surface_fail(iges->reader, entity->line,
                            "its matrices (entity 124) move one another in a circle");
            return false;
        }
        GArray *numbers = parameters_of(iges, matrix);
        bool is_whole = numbers->len >= 13;
        if (is_whole) {
            move_on(motion, &g_array_index(numbers, double, 1));
        } else {
            fr_surface_fail(iges->reader, matrix->line,
                            "a matrix (entity 124) has 12 numbers, not %u",
                            numbers->len > 0 ? numbers->len - 1 : 0);
        }
        g_array_unref(numbers);
        if (!is_whole) {
            return false;
        }
        next = matrix->matrix;
    }
    return true;
}

/// What the first numbers of a surface say.
typedef struct FrIgesHead {
    uint32_t count[2], degree[2], knots[2];
    uint64_t points;
} FrIgesHead;

static bool is_count(double value) {
    return value >= 1.0 && value < 1e6;
}

static bool read_head(FrIgesReader *iges, const GArray *numbers, size_t line, FrIgesHead *head) {
    const double *n = (const double *)(void *)numbers->data;
    if (numbers->len == 0 || n[0] != SURFACE) {
        fr_surface_fail(iges->reader, line, "its parameters are not those of an entity 128");
        return false;
    }
    if (numbers->len < 10) {
        fr_surface_fail(iges->reader, line, "a surface (entity 128) begins with 9 numbers, not %u",
                        numbers->len - 1);
        return false;
    }
    uint64_t wanted = 10;
    head->points = 1;
    for (int k = 0; k < 2; k++) {
        if (!(n[3 + k] >= 1.0 && n[3 + k] <= FR_NURBS_DEGREE_MOST)) {
            fr_surface_fail(iges->reader, line, "a surface has degrees from 1 to %d, not %g",
                            FR_NURBS_DEGREE_MOST, n[3 + k]);
            return false;
        }
        if (!is_count(n[1 + k]) || n[1 + k] < n[3 + k]) {
            fr_surface_fail(iges->reader, line,
                            "a surface of degree %g cannot have %g control points", n[3 + k],
                            n[1 + k] + 1);
            return false;
        }
        head->count[k] = (uint32_t)n[1 + k] + 1;
        head->degree[k] = (uint32_t)n[3 + k];
        head->knots[k] = head->count[k] + head->degree[k] + 1;
        head->points *= head->count[k];
        wanted += head->knots[k];
    }
    wanted += 4 * head->points;
    if (numbers->len < wanted) {
        fr_surface_fail(iges->reader, line,
                        "a surface of %u times %u points has %" G_GUINT64_FORMAT " numbers, not %u",
                        head->count[0], head->count[1], wanted - 1, numbers->len - 1);
        return false;
    }
    return true;
}

/// The ranges of u and v behind all else; those of the knots if they are left out.
static void read_ranges(const GArray *numbers, const FrIgesHead *head, double ranges[2][2]) {
    uint64_t first = 10 + head->knots[0] + head->knots[1] + 4 * head->points;
    for (uint32_t k = 0; k < 2; k++) {
        bool is_given = numbers->len >= first + 2 * (k + 1);
        for (uint32_t end = 0; end < 2; end++) {
            ranges[k][end] = is_given ? g_array_index(numbers, double, first + 2 * k + end) : 0.0;
        }
        if (ranges[k][0] == 0.0 && ranges[k][1] == 0.0) {
            ranges[k][0] = -INFINITY;
            ranges[k][1] = INFINITY;
        }
    }
}

static void take_surface(FrIgesReader *iges, const GArray *numbers, const FrIgesHead *head,
                         const FrIgesMotion *motion, size_t line) {
    double *to[2], (*net)[4], ranges[2][2];
    FrNurbsSurface surface = fr_surface_new(head->degree[0], head->count[0], head->degree[1],
                                            head->count[1], &to[0], &to[1], &net);
    const double *from = (const double *)(void *)numbers->data + 10;
    for (int k = 0; k < 2; k++) {
        memcpy(to[k], from, head->knots[k] * sizeof(double));
        from += head->knots[k];
    }
    for (uint64_t i = 0; i < head->points; i++) {
        const double *p = from + head->points + 3 * i;
        for (int k = 0; k < 3; k++) {
            const double *row = motion->rows[k];
            net[i][k] = iges->unit * (row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
        }
        net[i][3] = from[i];
    }
    read_ranges(numbers, head, ranges);
    fr_surface_take(iges->reader, surface, ranges, line);
}

static void read_surface(FrIgesReader *iges, const FrIgesEntity *entity) {
    GArray *numbers = parameters_of(iges, entity);
    FrIgesHead head;
    FrIgesMotion motion;
    if (read_head(iges, numbers, entity->line, &head) && motion_of(iges, entity, &motion)) {
        take_surface(iges, numbers, &head, &motion, entity->line);
    }
    g_array_unref(numbers);
}

void fr_iges_surfaces(FrSurfaceReader *reader, const char *text, size_t size) {
    FrIgesReader iges = {.reader = reader,
                         .global = g_array_new(FALSE, FALSE, sizeof(FrIgesLine)),
                         .directory = g_array_new(FALSE, FALSE, sizeof(FrIgesLine)),
                         .data = g_array_new(FALSE, FALSE, sizeof(FrIgesLine)),
                         .entities = g_array_new(FALSE, FALSE, sizeof(FrIgesEntity))};
    split(&iges, text, size);
    read_global(&iges);
    read_directory(&iges);
    for (uint32_t i = 0; i < iges.entities->len && reader->status == FR_OK; i++) {
        const FrIgesEntity *entity = &g_array_index(iges.entities, FrIgesEntity, i);
        if (entity->type == SURFACE) {
            read_surface(&iges, entity);
        }
        reader->has_trims |= entity->type == TRIMMED;
    }
    g_array_unref(iges.global);
    g_array_unref(iges.directory);
    g_array_unref(iges.data);
    g_array_unref(iges.entities);
}
