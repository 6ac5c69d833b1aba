// Free-form surfaces of Wavefront OBJ: `v`, `cstype`, `deg`, `surf`, `parm`, `end`.
// Wavefront, Advanced Visualizer Manual, appendix B1. y is up there.
#include "material/nurbs_file.h"

#include <math.h>
#include <string.h>

typedef struct FrObjReader {
    FrSurfaceReader *reader;
    size_t line;
    GArray *vertices; ///< double[4], z up
    GArray *knots[2]; ///< double, of the surface being read
    GArray *controls; ///< uint32_t, vertices of the surface being read
    int64_t degree[2];
    bool is_rational, is_spline, is_surface;
} FrObjReader;

bool fr_obj_has_surfaces(const char *text) {
    return g_str_has_prefix(text, "surf ") || strstr(text, "\nsurf ") != NULL;
}

static double next_number(char **at) {
    char *end;
    double number = g_ascii_strtod(*at, &end);
    if (end == *at) {
        return NAN;
    }
    *at = end;
    return number;
}

static void read_vertex(FrObjReader *obj, char *at) {
    double v[4];
    for (int k = 0; k < 3; k++) {
        v[k] = next_number(&at);
    }
    v[3] = next_number(&at);
    const double point[4] = {v[0], -v[2], v[1], isnan(v[3]) ? 1.0 : v[3]};
    g_array_append_vals(obj->vertices, point, 1);
}

static void read_surface(FrObjReader *obj, char *at) {
    for (int k = 0; k < 4; k++) {
        next_number(&at); // the range of both parameters is that of the knots
    }
    g_array_set_size(obj->controls, 0);
    for (at += strspn(at, " \t"); *at != '\0'; at += strspn(at, " \t")) {
        char *end;
        gint64 index = g_ascii_strtoll(at, &end, 10), count = obj->vertices->len;
        index = index < 0 ? count + index : index - 1;
        if (end == at || index < 0 || index >= count) {
            fr_surface_fail(obj->reader, obj->line, "there is no such vertex");
            return;
        }
        uint32_t control = (uint32_t)index;
        g_array_append_val(obj->controls, control);
        at = end + strcspn(end, " \t");
    }
    obj->is_surface = true;
}

static void read_parameters(FrObjReader *obj, char *at) {
    at += strspn(at, " \t");
    GArray *knots = obj->knots[*at == 'v'];
    at++;
    g_array_set_size(knots, 0);
    for (double knot = next_number(&at); !isnan(knot); knot = next_number(&at)) {
        g_array_append_val(knots, knot);
    }
}

static void end_surface(FrObjReader *obj) {
    if (!obj->is_surface) {
        return;
    }
    obj->is_surface = false;
    int64_t count[2];
    bool is_sound = obj->is_spline;
    for (int k = 0; k < 2; k++) {
        count[k] = (int64_t)obj->knots[k]->len - obj->degree[k] - 1;
        is_sound = is_sound && obj->degree[k] >= 1 && obj->degree[k] <= FR_NURBS_DEGREE_MOST &&
                   count[k] > obj->degree[k];
    }
    if (!is_sound || count[0] * count[1] != obj->controls->len) {
        fr_surface_fail(obj->reader, obj->line,
                        obj->is_spline ? "knots, degrees and points do not go together"
                                       : "only 'cstype bspline' and 'cstype rat bspline' are read");
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
    fr_surface_take(obj->reader, surface, obj->line);
}

static void read_line(FrObjReader *obj, char *line) {
    line += strspn(line, " \t");
    size_t length = strcspn(line, " \t");
    char *rest = line + length;
    bool is_alone = *rest == '\0';
    *rest = '\0';
    char *at = is_alone ? rest : rest + 1;
    if (strcmp(line, "v") == 0) {
        read_vertex(obj, at);
    } else if (strcmp(line, "cstype") == 0) {
        obj->is_rational = strstr(at, "rat") != NULL;
        obj->is_spline = strstr(at, "bspline") != NULL;
    } else if (strcmp(line, "deg") == 0) {
        for (int k = 0; k < 2; k++) {
            double degree = next_number(&at);
            obj->degree[k] = degree >= 1.0 && degree <= 100.0 ? (int64_t)degree : 0;
        }
    } else if (strcmp(line, "surf") == 0) {
        read_surface(obj, at);
    } else if (strcmp(line, "parm") == 0) {
        read_parameters(obj, at);
    } else if (strcmp(line, "trim") == 0 || strcmp(line, "hole") == 0) {
        obj->reader->has_trims = true;
    } else if (strcmp(line, "end") == 0) {
        end_surface(obj);
    }
}

void fr_obj_surfaces(FrSurfaceReader *reader, const char *text) {
    FrObjReader obj = {.reader = reader,
                       .vertices = g_array_new(FALSE, FALSE, 4 * sizeof(double)),
                       .knots = {g_array_new(FALSE, FALSE, sizeof(double)),
                                 g_array_new(FALSE, FALSE, sizeof(double))},
                       .controls = g_array_new(FALSE, FALSE, sizeof(uint32_t))};
    GString *line = g_string_new(NULL);
    while (*text != '\0' && reader->status == FR_OK) {
        size_t length = strcspn(text, "\n");
        obj.line++;
        g_string_append_len(line, text, (gssize)length);
        text += length + (text[length] == '\n');
        g_strchomp(line->str);
        g_string_set_size(line, strlen(line->str));
        if (g_str_has_suffix(line->str, "\\")) { // goes on in the next line
            g_string_truncate(line, line->len - 1);
            g_string_append_c(line, ' ');
            continue;
        }
        read_line(&obj, line->str);
        g_string_truncate(line, 0);
    }
    g_string_free(line, TRUE);
    g_array_unref(obj.vertices);
    g_array_unref(obj.knots[0]);
    g_array_unref(obj.knots[1]);
    g_array_unref(obj.controls);
}
