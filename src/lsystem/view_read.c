// View files: `label: values`, one a line, after the preprocessor. What only concerns pictures is
// read over.
#include "lsystem/companion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Reader {
    FrLview *view;
    const FrLtext *text;
    const char *folder;
    const FrContext *context;
    size_t begin, end; ///< of the line
    FrStatus status;
} Reader;

static void warn(Reader *reader, const char *code, const char *format, const char *detail) {
    char *text = g_strdup_printf("%s%s", format, detail);
    fr_diags_add(reader->context->diags, FR_WARNING, code,
                 fr_ltext_span(reader->text, reader->begin, reader->end), "%s", text);
    g_free(text);
}

/// Commands of pictures, cameras and windows, which the plant does not depend on.
static const char *const ignored[] = {"viewpoint",
                                      "view reference point",
                                      "twist",
                                      "projection",
                                      "viewing angle",
                                      "front distance",
                                      "back distance",
                                      "scale factor",
                                      "min zoom",
                                      "max zoom",
                                      "generate on view change",
                                      "z buffer",
                                      "render mode",
                                      "shade mode",
                                      "light direction",
                                      "light",
                                      "diffuse reflection",
                                      "surface ambient",
                                      "surface diffuse",
                                      "shadow map",
                                      "cue range",
                                      "antialiasing",
                                      "concave polygons",
                                      "background scene",
                                      "font",
                                      "winfont",
                                      "interpretation step",
                                      "ps linecap",
                                      "rayshade objects",
                                      "rayshade scale",
                                      "blob",
                                      "view up vector",
                                      "up",
                                      "function gallery",
                                      "capture quality",
                                      "polygons",
                                      "corrected rotation",
                                      "stationary view",
                                      "line caps",
                                      "tapered polygons"};

static const char *const known[] = {"angle increment",
                                    "angle factor",
                                    "initial line width",
                                    "line width increment",
                                    "line style",
                                    "tapered lines",
                                    "initial scale",
                                    "scale multiplier",
                                    "contour sides",
                                    "polygonization level",
                                    "contour",
                                    "twist of cylinders",
                                    "surface",
                                    "tsurface",
                                    "line",
                                    "tropism",
                                    "torque",
                                    "tropism direction",
                                    "initial elasticity",
                                    "elasticity increment",
                                    "function",
                                    "function set",
                                    "curve",
                                    "interpretation past %",
                                    "environment display",
                                    "initial color",
                                    "color increment"};

static bool is_on(const char *value) {
    return g_str_has_prefix(value, "on");
}

static FrLstyle style_of(const char *value) {
    return *value == '1' || *value == 'p'
               ? (value[0] == 'p' && value[1] == 'o' ? FR_LSTYLE_POLYGON : FR_LSTYLE_PIXEL)
           : *value == '2' ? FR_LSTYLE_POLYGON
                           : FR_LSTYLE_CYLINDER;
}

/// A tropism: T: x y z A: angle I: intensity E: elasticity S: step.
static void read_tropism(Reader *reader, const char *value, bool is_torque) {
    FrLtropism tropism = {.is_torque = is_torque, .direction = {0, 1, 0}};
    double intensity = 1;
    bool has_intensity = false;
    while (*value != '\0') {
        char letter = *value++;
        if (*value != ':') {
            continue;
        }
        double numbers[3] = {0, 0, 0};
        fr_lcompanion_numbers(value + 1, numbers, letter == 'T' ? 3 : 1);
        if (letter == 'T') {
            memcpy(tropism.direction, numbers, sizeof numbers);
        } else if (letter == 'A') {
            tropism.angle = numbers[0] * (G_PI / 180);
        } else if (letter == 'I') {
            intensity = numbers[0];
            has_intensity = true;
        } else if (letter == 'E') {
            tropism.elasticity = numbers[0];
        } else if (letter == 'S') {
            tropism.step = numbers[0];
        }
    }
    double length = sqrt(tropism.direction[0] * tropism.direction[0] +
                         tropism.direction[1] * tropism.direction[1] +
                         tropism.direction[2] * tropism.direction[2]);
    // What is cut to 1 is the factor, so that short vectors with an intensity may stay short.
    double factor = length > 0 ? intensity / length : 0;
    factor = has_intensity ? CLAMP(factor, -1, 1) : factor;
    for (int k = 0; k < 3; k++) {
        tropism.direction[k] *= factor;
    }
    g_array_append_val(reader->view->tropisms, tropism);
}

/// Surfaces that are not there are left out, as cpfg does; anything else is an error.
static FrSource *open_companion(Reader *reader, const char *name, bool is_needed) {
    char *path = reader->folder == NULL || g_path_is_absolute(name)
                     ? g_strdup(name)
                     : g_build_filename(reader->folder, name, NULL);
    FrSource *source = NULL;
    FrStatus status = FR_OK;
    if (*name != '\0' && g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        source = fr_source_load(path, reader->context->limits.document_bytes,
                                reader->context->diags, &status);
        reader->status = MAX(reader->status, status);
    } else {
        fr_diags_add(reader->context->diags, is_needed ? FR_ERROR : FR_WARNING, "missing-file",
                     fr_ltext_span(reader->text, reader->begin, reader->end),
                     "the file '%s' is not there", name);
        reader->status = MAX(reader->status, is_needed ? FR_ERR_DOCUMENT : FR_OK);
    }
    g_free(path);
    return source;
}

/// `line: ~ file size`: segments of cylinders have the cross-section of that surface.
static void read_line_surface(Reader *reader, char **words, guint count) {
    guint file = count > 1 && strlen(words[0]) == 1 ? 1 : 0;
    if (count <= file) {
        warn(reader, "view-value", "a file name is missing: ", "line");
        return;
    }
    FrSource *source = open_companion(reader, words[file], false);
    if (source == NULL) {
        return;
    }
    double size = count > file + 1 ? g_ascii_strtod(words[file + 1], NULL) : 1;
    GArray *surfaces = g_array_new(FALSE, TRUE, sizeof(FrLsurface));
    if (fr_lcompanion_patches(source, surfaces, '~', size, 1, 1)) {
        FrLsurface *surface = &g_array_index(surfaces, FrLsurface, 0);
        g_free(reader->view->section);
        reader->view->section = fr_lcompanion_section(surface, &reader->view->section_count);
        g_free(surface->corners);
        g_free(surface->hull);
    } else {
        warn(reader, "view-file", "there is nothing to use in this file: ", words[file]);
    }
    g_array_unref(surfaces);
    fr_source_unref(source);
}

/// Commands that name a file.
static bool read_file(Reader *reader, const char *label, char **words, guint count) {
    bool is_surface = strcmp(label, "surface") == 0 || strcmp(label, "tsurface") == 0;
    bool is_contour = strcmp(label, "contour") == 0, is_curve = strcmp(label, "curve") == 0;
    bool is_function = g_str_has_prefix(label, "function");
    if (strcmp(label, "line") == 0) {
        read_line_surface(reader, words, count);
        return true;
    }
    if (!is_surface && !is_contour && !is_curve && !is_function) {
        return false;
    }
    guint file = is_surface || is_contour ? 1 : 0;
    if (count <= file) {
        warn(reader, "view-value", "a file name is missing: ", label);
        return true;
    }
    FrSource *source = open_companion(reader, words[file], !is_surface);
    if (source == NULL) {
        return true;
    }
    FrLview *view = reader->view;
    bool is_read = true;
    if (is_function) {
        guint before = view->functions->len;
        is_read = fr_lcompanion_functions(source, view->functions, count > 1 ? atoi(words[1]) : 0);
        // Only those of a set are known by their names.
        for (guint i = before; i < view->functions->len && strcmp(label, "function") == 0; i++) {
            g_clear_pointer(&g_array_index(view->functions, FrLspline, i).name, g_free);
        }
    } else if (is_contour || is_curve) {
        int samples = !is_curve ? 0 : count > 1 ? MAX(atoi(words[1]), 2) : 100;
        is_read = fr_lcompanion_contour(source, is_curve ? view->curves : view->contours,
                                        is_contour ? atoi(words[0]) : (int)view->curves->len + 1,
                                        samples);
    } else {
        double size = count > 2 ? g_ascii_strtod(words[2], NULL) : 1;
        // One number alone is a texture.
        int s = count > 4 ? atoi(words[3]) : 0, t = count > 4 ? atoi(words[4]) : 0;
        is_read = *label == 't'
                      ? fr_lcompanion_triangles(source, view->surfaces, *words[0], size)
                      : fr_lcompanion_patches(source, view->surfaces, *words[0], size, s, t);
    }
    if (!is_read) {
        warn(reader, "view-file", "there is nothing to use in this file: ", words[file]);
    }
    fr_source_unref(source);
    return true;
}

/// Commands of one or a few numbers.
static bool read_numbers(FrLview *view, const char *label, const char *value) {
    double n[3] = {0, 0, 0};
    int count = fr_lcompanion_numbers(value, n, 3);
    struct {
        const char *label;
        double *to;
    } plain[] = {{"angle increment", &view->angle},
                 {"line width increment", &view->width_step},
                 {"initial scale", &view->scale},
                 {"scale multiplier", &view->scale_step},
                 {"initial elasticity", &view->old_elasticity},
                 {"elasticity increment", &view->old_step}};
    for (size_t i = 0; i < G_N_ELEMENTS(plain); i++) {
        if (strcmp(label, plain[i].label) == 0) {
            bool is_zero_scale = n[0] == 0 && strchr("is", *label) != NULL && strstr(label, "scal");
            if (count > 0 && isfinite(n[0]) && !is_zero_scale) {
                *plain[i].to = (double)(float)n[0];
            }
            return true;
        }
    }
    if (strcmp(label, "angle factor") == 0) {
        view->angle = n[0] != 0 ? (double)(float)(360 / n[0]) : view->angle;
    } else if (strcmp(label, "tropism direction") == 0) {
        double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3 && length > 0; k++) {
            view->old_direction[k] = n[k] / length;
        }
    } else if (strcmp(label, "contour sides") == 0) {
        view->contour_sides = (uint32_t)CLAMP(n[0], 3, 128);
    } else if (strcmp(label, "polygonization level") == 0) {
        view->contour_sides = MAX(1U << (int)(CLAMP(n[0], 0, 6) + 1), 3);
    } else if (strcmp(label, "initial color") == 0) {
        view->colour = (int)CLAMP(n[0], 0, 255);
    } else if (strcmp(label, "color increment") == 0) {
        view->colour_step = (int)CLAMP(n[0], -255, 255);
    } else {
        return false;
    }
    return true;
}

static bool read_switches(FrLview *view, const char *label, const char *value) {
    if (strcmp(label, "initial line width") == 0) {
        char *end;
        double width = g_ascii_strtod(value, &end);
        view->width = isfinite(width) && width > 0 ? width : 1;
        while (*end == ' ' || *end == '\t') {
            end++;
        }
        // A width without a unit chooses polygons.
        view->style = *end == 'p'   ? FR_LSTYLE_PIXEL
                      : *end == 's' ? FR_LSTYLE_CYLINDER
                                    : FR_LSTYLE_POLYGON;
    } else if (strcmp(label, "line style") == 0) {
        view->style = style_of(value);
    } else if (strcmp(label, "tapered lines") == 0) {
        view->tapers = is_on(value);
    } else if (strcmp(label, "twist of cylinders") == 0) {
        view->twists = is_on(value);
    } else if (strcmp(label, "box") == 0) {
        view->is_framed = true;
    } else if (strcmp(label, "interpretation past %") == 0) {
        view->draws_past_cut = !g_str_has_prefix(value, "off");
    } else if (strcmp(label, "environment display") == 0) {
        view->answers_before = g_str_has_prefix(value, "before");
    } else {
        return false;
    }
    return true;
}

static void report_unknown(Reader *reader, const char *label) {
    for (size_t i = 0; i < G_N_ELEMENTS(ignored); i++) {
        if (strcmp(label, ignored[i]) == 0) {
            return;
        }
    }
    if (strcmp(label, "texture") == 0 || strcmp(label, "initial texture") == 0) {
        warn(reader, "left-out", "textures are not drawn: ", label);
        return;
    }
    const char *near = fr_nearest_name(label, known, G_N_ELEMENTS(known));
    char *hint =
        near == NULL ? g_strdup(label) : g_strdup_printf("%s; did you mean '%s'?", label, near);
    warn(reader, "unknown-command", "no such command in a view: ", hint);
    g_free(hint);
}

static void read_line(Reader *reader, char *line) {
    char *colon = strchr(line, ':');
    if (colon == NULL) {
        if (*g_strstrip(line) != '\0') {
            warn(reader, "view-value", "a line of a view is 'command: values': ", line);
        }
        return;
    }
    *colon = '\0';
    char *label = g_ascii_strdown(g_strstrip(line), -1), *value = g_strstrip(colon + 1);
    char **split = g_strsplit_set(value, " \t", -1);
    guint count = 0;
    for (guint i = 0; split[i] != NULL; i++) {
        if (*split[i] != '\0') {
            char *word = split[i];
            split[i] = split[count];
            split[count++] = word;
        }
    }
    if (strcmp(label, "tropism") == 0 || strcmp(label, "torque") == 0) {
        read_tropism(reader, value, label[1] == 'o');
    } else if (!read_numbers(reader->view, label, value) &&
               !read_switches(reader->view, label, value) &&
               !read_file(reader, label, split, count)) {
        report_unknown(reader, label);
    }
    g_strfreev(split);
    g_free(label);
}

FrStatus fr_lview_read(FrSource *source, const char *folder, const FrContext *context,
                       FrLview **view) {
    *view = NULL;
    FrStatus status;
    FrLtext *text = fr_ltext_new(source, folder, NULL, 0, context, &status);
    if (text == NULL) {
        return status;
    }
    Reader reader = {.view = fr_lview_new(),
                     .text = text,
                     .folder = folder,
                     .context = context,
                     .status = status};
    const char *bytes = text->bytes->str;
    for (size_t at = 0; at < text->bytes->len; at++) {
        const char *newline = memchr(bytes + at, '\n', text->bytes->len - at);
        size_t end = newline == NULL ? text->bytes->len : (size_t)(newline - bytes);
        reader.begin = at;
        reader.end = end;
        char *line = g_strndup(bytes + at, end - at);
        read_line(&reader, line);
        g_free(line);
        at = end;
    }
    fr_ltext_free(text);
    if (reader.status != FR_OK) {
        fr_lview_free(reader.view);
        return reader.status;
    }
    *view = reader.view;
    return FR_OK;
}
