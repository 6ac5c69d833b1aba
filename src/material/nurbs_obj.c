// Free-form surfaces of Wavefront OBJ: `v`, `cstype`, `deg`, `surf`, `parm`, `end`.
// Wavefront, Advanced Visualizer Manual, appendix B1. y is up there.
#include "material/nurbs_file.h"

#include <math.h>
#include <string.h>

typedef struct FrObjReader {
    FrSurfaceReader *reader;
    size_t line, surface_line; ///< the one being read, and that of the surface's `surf`
    GArray *vertices;          ///< double[4], z up
    GArray *knots[2];          ///< double, of the surface being read
    GArray *controls;          ///< uint32_t, vertices of the surface being read
    double ranges[2][2];       ///< of it, in u and v
    int64_t degree[2];
    bool is_rational, is_spline, is_surface;
} FrObjReader;

// ---- lines -------------------------------------------------------------------------------------

static const char *skip_blanks(const char *at) {
    while (*at == ' ' || *at == '\t') {
        at++;
    }
    return at;
}

static const char *skip_word(const char *at) {
    while (*at != '\0' && *at != ' ' && *at != '\t') {
        at++;
    }
    return at;
}

static bool is_word(const char *text, size_t size, const char *word) {
    size_t length = strlen(word);
    return size > length && memcmp(text, word, length) == 0 &&
           (text[length] == ' ' || text[length] == '\t');
}

static size_t count_blanks(const char *line, size_t length) {
    size_t blanks = 0;
    while (blanks < length && (line[blanks] == ' ' || line[blanks] == '\t')) {
        blanks++;
    }
    return blanks;
}

/// Takes one line off a text; answers its length.
static size_t take_line(const char **text, size_t *size, const char **line) {
    size_t length = fr_line_length(*text, *size);
    size_t step = length + fr_line_end(*text + length, *size - length);
    *line = *text;
    *text += step;
    *size -= step;
    return length;
}

static bool has_statement(const char *text, size_t size, const char *word) {
    const char *line;
    bool is_found = false;
    while (size > 0 && !is_found) {
        size_t length = take_line(&text, &size, &line), blanks = count_blanks(line, length);
        is_found = is_word(line + blanks, length - blanks, word);
    }
    return is_found;
}

bool fr_obj_has_surfaces(const char *text, size_t size) {
    return has_statement(text, size, "surf");
}

bool fr_obj_has_faces(const char *text, size_t size) {
    return has_statement(text, size, "f");
}

/// Leaves three numbers to a vertex: weights are for surfaces.
static void drop_weight(char *line, size_t length) {
    size_t words = 0, at = 0;
    for (bool is_blank = true; at < length && words <= 4; at++) {
        bool was_blank = is_blank;
        is_blank = line[at] == ' ' || line[at] == '\t';
        words += was_blank && !is_blank;
    }
    if (words > 4) {
        memset(line + at - 1, ' ', length - at + 1);
    }
}

bool fr_obj_keep_faces(char *text, size_t size) {
    static const char *const words[] = {"g", "s", "o", "v", "vt", "vn", "f", "usemtl", "mtllib"};
    bool has_faces = false, is_kept = false, goes_on = false;
    for (char *at = text; size > 0;) {
        size_t length = fr_line_length(at, size), blanks = count_blanks(at, length);
        if (!goes_on) {
            is_kept = false;
            for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
                is_kept |= is_word(at + blanks, length - blanks, words[i]);
            }
            has_faces |= is_word(at + blanks, length - blanks, "f");
        }
        goes_on = length > 0 && at[length - 1] == '\\';
        if (!is_kept) {
            memset(at, ' ', length);
        } else if (is_word(at + blanks, length - blanks, "v")) {
            drop_weight(at, length);
        }
        size_t end = fr_line_end(at + length, size - length);
        if (end == 1) {
            at[length] = '\n';
        }
        at += length + end;
        size -= length + end;
    }
    return has_faces;
}

// ---- statements --------------------------------------------------------------------------------

static double next_number(const char **at) {
    char *end;
    double number = g_ascii_strtod(*at, &end);
    if (end == *at) {
        return NAN;
    }
    *at = end;
    return number;
}

static void read_vertex(FrObjReader *obj, const char *at) {
    double v[4];
    for (int k = 0; k < 3; k++) {
        v[k] = next_number(&at);
    }
    v[3] = next_number(&at);
    const double point[4] = {v[0], -v[2], v[1], isnan(v[3]) ? 1.0 : v[3]};
    g_array_append_vals(obj->vertices, point, 1);
}

static void fail_unended(FrObjReader *obj) {
    fr_surface_fail(obj->reader, obj->surface_line,
                    "the surface that begins here has no 'end'; is the file cut off?");
}

static void read_surface(FrObjReader *obj, const char *at) {
    if (obj->is_surface) {
        fail_unended(obj);
        return;
    }
    for (int k = 0; k < 4; k++) {
        obj->ranges[k / 2][k % 2] = next_number(&at);
    }
    g_array_set_size(obj->controls, 0);
    g_array_set_size(obj->knots[0], 0);
    g_array_set_size(obj->knots[1], 0);
    for (at = skip_blanks(at); *at != '\0'; at = skip_blanks(at)) {
        char *end;
        gint64 index = g_ascii_strtoll(at, &end, 10), count = obj->vertices->len;
        index = index < 0 ? count + index : index - 1;
        if (end == at || index < 0 || index >= count) {
            int length = (int)MIN(skip_word(at) - at, 20);
            fr_surface_fail(obj->reader, obj->line, "there is no vertex '%.*s'", length, at);
            return;
        }
        uint32_t control = (uint32_t)index;
        g_array_append_val(obj->controls, control);
        at = skip_word(end);
    }
    obj->is_surface = true;
    obj->surface_line = obj->line;
}

static void read_parameters(FrObjReader *obj, const char *at) {
    if (!obj->is_surface) {
        return; // of a curve
    }
    const char *name = skip_blanks(at);
    size_t size = strlen(name);
    if (!is_word(name, size, "u") && !is_word(name, size, "v")) {
        fr_surface_fail(obj->reader, obj->line, "'parm' is followed by u or v and their knots");
        return;
    }
    GArray *knots = obj->knots[*name == 'v'];
    g_array_set_size(knots, 0);
    for (at = skip_blanks(name + 1); *at != '\0' && *at != '#'; at = skip_blanks(at)) {
        const char *word = at;
        double knot = next_number(&at);
        if (isnan(knot) || skip_word(at) != at) {
            int length = (int)MIN(skip_word(word) - word, 20);
            fr_surface_fail(obj->reader, obj->line, "here should be a knot, not '%.*s'", length,
                            word);
            return;
        }
        g_array_append_val(knots, knot);
    }
}

/// Says what is wrong with counts; true if nothing is. `count` receives those of control points.
static bool check_counts(FrObjReader *obj, int64_t count[2]) {
    static const char names[2] = {'u', 'v'};
    if (!obj->is_spline) {
        fr_surface_fail(obj->reader, obj->surface_line,
                        "only 'cstype bspline' and 'cstype rat bspline' are read");
        return false;
    }
    for (int k = 0; k < 2; k++) {
        count[k] = (int64_t)obj->knots[k]->len - obj->degree[k] - 1;
        if (obj->degree[k] < 1 || obj->degree[k] > FR_NURBS_DEGREE_MOST) {
            fr_surface_fail(obj->reader, obj->surface_line, "'deg' is not from 1 to %d in %c",
                            FR_NURBS_DEGREE_MOST, names[k]);
            return false;
        }
        if (count[k] <= obj->degree[k]) {
            fr_surface_fail(obj->reader, obj->surface_line,
                            "'parm %c' has %u knots, too few for its degree", names[k],
                            obj->knots[k]->len);
            return false;
        }
    }
    if (count[0] * count[1] != obj->controls->len) {
        fr_surface_fail(obj->reader, obj->surface_line,
                        "there are %u control points where knots and degrees want %" G_GINT64_FORMAT
                        " times %" G_GINT64_FORMAT,
                        obj->controls->len, count[0], count[1]);
        return false;
    }
    return true;
}

static void end_surface(FrObjReader *obj) {
    int64_t count[2];
    bool is_surface = obj->is_surface;
    obj->is_surface = false;
    if (!is_surface || !check_counts(obj, count)) {
        return;
    }
    double *knots[2], (*points)[4];
    FrNurbsSurface surface =
        fr_surface_new((uint32_t)obj->degree[0], (uint32_t)count[0], (uint32_t)obj->degree[1],
                       (uint32_t)count[1], &knots[0], &knots[1], &points);
    for (int k = 0; k < 2; k++) {
        memcpy(knots[k], obj->knots[k]->data, obj->knots[k]->len * sizeof(double));
    }
    for (uint32_t i = 0; i < obj->controls->len; i++) {
        uint32_t vertex = g_array_index(obj->controls, uint32_t, i);
        memcpy(points[i], obj->vertices->data + vertex * sizeof *points, sizeof *points);
        points[i][3] = obj->is_rational ? points[i][3] : 1.0;
    }
    fr_surface_take(obj->reader, surface, obj->ranges, obj->surface_line);
}

static void read_degrees(FrObjReader *obj, const char *at) {
    for (int k = 0; k < 2; k++) {
        double degree = next_number(&at);
        obj->degree[k] = degree >= 1.0 && degree <= 100.0 ? (int64_t)degree : 0;
    }
}

static void read_line(FrObjReader *obj, const char *line, size_t size) {
    const char *word = skip_blanks(line);
    size -= (size_t)(word - line);
    const char *at = skip_word(word);
    if (is_word(word, size, "v")) {
        read_vertex(obj, at);
    } else if (is_word(word, size, "cstype")) {
        obj->is_rational = strstr(at, "rat") != NULL;
        obj->is_spline = strstr(at, "bspline") != NULL;
    } else if (is_word(word, size, "deg")) {
        read_degrees(obj, at);
    } else if (is_word(word, size, "surf")) {
        read_surface(obj, at);
    } else if (is_word(word, size, "parm")) {
        read_parameters(obj, at);
    } else if (is_word(word, size, "trim") || is_word(word, size, "hole")) {
        obj->reader->has_trims = true;
    } else if (is_word(word, size, "end")) {
        end_surface(obj);
    }
}

static void read_lines(FrObjReader *obj, const char *text, size_t size) {
    GString *line = g_string_new(NULL);
    while (size > 0 && obj->reader->status == FR_OK) {
        const char *begin;
        size_t length = take_line(&text, &size, &begin);
        bool goes_on = length > 0 && begin[length - 1] == '\\' && size > 0;
        g_string_append_len(line, begin, (gssize)(length - (goes_on ? 1 : 0)));
        g_string_append_c(line, ' '); // words end with one, also before the line that goes on
        obj->line++;
        if (!goes_on) {
            read_line(obj, line->str, line->len);
            g_string_truncate(line, 0);
        }
    }
    g_string_free(line, TRUE);
    if (obj->is_surface && obj->reader->status == FR_OK) {
        fail_unended(obj);
    }
}

void fr_obj_surfaces(FrSurfaceReader *reader, const char *text, size_t size) {
    FrObjReader obj = {.reader = reader,
                       .vertices = g_array_new(FALSE, FALSE, 4 * sizeof(double)),
                       .knots = {g_array_new(FALSE, FALSE, sizeof(double)),
                                 g_array_new(FALSE, FALSE, sizeof(double))},
                       .controls = g_array_new(FALSE, FALSE, sizeof(uint32_t))};
    read_lines(&obj, text, size);
    g_array_unref(obj.vertices);
    g_array_unref(obj.knots[0]);
    g_array_unref(obj.knots[1]);
    g_array_unref(obj.controls);
}
