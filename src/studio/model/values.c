#include "studio/model/values.h"

#include "frond/curve.h"

#include <math.h>
#include <string.h>

bool studio_value_is_number(const char *text, double *value) {
    return studio_numbers_read(text, 1, value);
}

bool studio_numbers_read(const char *text, int count, double *numbers) {
    bool is_right = true;
    for (int i = 0; i < count && is_right; i++) {
        char *end;
        numbers[i] = g_ascii_strtod(text, &end);
        is_right = end != text && isfinite(numbers[i]);
        while (g_ascii_isspace(*end)) {
            end++;
        }
        is_right = is_right && *end == (i + 1 < count ? ',' : '\0');
        text = end + 1; // behind the comma
    }
    return is_right;
}

char *studio_value_text(double value, double span) {
    int digits = span > 0 ? (int)ceil(3 - log10(span)) : 3;
    digits = CLAMP(digits, 0, 9);
    char text[64];
    char format[8];
    g_snprintf(format, sizeof format, "%%.%df", digits);
    g_ascii_formatd(text, sizeof text, format, value);
    if (strchr(text, '.') != NULL) {
        size_t length = strlen(text);
        while (text[length - 1] == '0') {
            length--;
        }
        text[text[length - 1] == '.' ? length - 1 : length] = '\0';
    }
    return g_strdup(strcmp(text, "-0") == 0 ? "0" : text);
}

char *studio_value_short(const char *text) {
    double value;
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    if (strchr(text, '.') == NULL || !studio_value_is_number(text, &value)) {
        return g_strdup(text);
    }
    g_ascii_formatd(number, sizeof number, "%.6g", value);
    bool is_plain = strchr(number, 'e') == NULL && strlen(number) < strlen(text);
    return g_strdup(is_plain ? number : text);
}

char *studio_vector_text(const double at[3], double span) {
    char *parts[3];
    for (int i = 0; i < 3; i++) {
        parts[i] = studio_value_text(at[i], span);
    }
    char *text = g_strdup_printf("%s, %s, %s", parts[0], parts[1], parts[2]);
    for (int i = 0; i < 3; i++) {
        g_free(parts[i]);
    }
    return text;
}

char *studio_length_text(double length) {
    static const struct {
        const char *name;
        double in_metre, least; // of it in a metre; from how many metres on it suits
    } units[] = {{"km", 0.001, 1000}, {"m", 1, 1}, {"cm", 100, 0.01}, {"mm", 1000, 0}};
    size_t i = 0;
    while (length < units[i].least * (1 - 1e-9)) { // a step is made of powers, which round
        i++;
    }
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    g_ascii_formatd(number, sizeof number, "%.6g", length * units[i].in_metre);
    return g_strdup_printf("%s\u202f%s", number, units[i].name);
}

char *studio_count_text(uint64_t count) {
    char digits[24];
    int length = g_snprintf(digits, sizeof digits, "%" G_GUINT64_FORMAT, count);
    GString *text = g_string_new(NULL);
    for (int i = 0; i < length; i++) {
        g_string_append(text, i > 0 && (length - i) % 3 == 0 ? "\u202f" : "");
        g_string_append_c(text, digits[i]);
    }
    return g_string_free(text, FALSE);
}

char *studio_count_words(uint64_t count, const char *one, const char *many) {
    char *number = studio_count_text(count);
    char *text = g_strdup_printf("%s %s", number, count == 1 ? one : many);
    g_free(number);
    return text;
}

static double power_above(double value) {
    double power = pow(10, floor(log10(value)));
    return value / power <= 1   ? power
           : value / power <= 2 ? 2 * power
           : value / power <= 5 ? 5 * power
                                : 10 * power;
}

char *studio_value_tip(const FrParam *param) {
    GString *tip = g_string_new(param->meaning);
    bool has_range = param->max > param->min;
    if (has_range) {
        g_string_append_printf(tip, "\n%g to %g %s", param->min, param->max, param->unit);
    }
    if (*param->default_text != '\0') {
        g_string_append_printf(tip, "%s%s unless given", has_range ? ", " : "\n",
                               param->default_text);
    }
    return g_string_free(tip, FALSE);
}

void studio_value_range(const FrParam *param, double value, double *min, double *max) {
    static const double handy = 400;
    double usual = 0;
    studio_value_is_number(param->default_text, &usual);
    *min = param->min;
    *max = param->max;
    if (strcmp(param->unit, "deg") == 0 && *max - *min > handy) {
        double reach = fabs(value) > 180 ? 360 : 180;
        *min = fmax(*min, -reach);
        *max = fmin(*max, reach);
    } else if (*max - *min > handy || (usual > 0 && *max > 50 * usual)) {
        double size = fmax(fmax(fabs(value), fabs(usual)), 0.01);
        *max = fmin(*max, power_above(2.5 * size));
        *min = fmax(*min, value < 0 || param->min < 0 ? -*max : 0);
    }
    *min = fmin(*min, value);
    *max = fmax(*max, value);
    if (!(*max > *min)) {
        *max = *min + 1;
    }
}

double studio_value_step(const FrParam *param, double min, double max) {
    if (param->kind == FR_PARAM_INTEGER) {
        return 1;
    }
    return pow(10, floor(log10((max - min) / 50)));
}

// ---- points ------------------------------------------------------------------------------------

GArray *studio_points_read(const char *text) {
    GArray *points = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    const char *at = text;
    for (;;) {
        while (g_ascii_isspace(*at)) {
            at++;
        }
        if (*at == '\0' && points->len > 0) {
            return points;
        }
        double point[2];
        char *end;
        point[0] = g_ascii_strtod(at, &end);
        if (end == at || *end != ',' || !isfinite(point[0])) {
            break;
        }
        at = end + 1;
        point[1] = g_ascii_strtod(at, &end);
        if (end == at || !(g_ascii_isspace(*end) || *end == '\0') || !isfinite(point[1])) {
            break;
        }
        at = end;
        g_array_append_val(points, point);
    }
    g_array_unref(points);
    return NULL;
}

char *studio_points_write(const GArray *points) {
    GString *text = g_string_new(NULL);
    for (guint i = 0; i < points->len; i++) {
        const double *point = &g_array_index(points, double, 2 * i);
        char *x = studio_value_text(point[0], 1), *y = studio_value_text(point[1], 1);
        g_string_append_printf(text, "%s%s,%s", i == 0 ? "" : " ", x, y);
        g_free(x);
        g_free(y);
    }
    return g_string_free(text, FALSE);
}

char *studio_points_of_shape(const char *name) {
    FrCurve *curve = fr_curve_builtin(name);
    if (curve == NULL) {
        return NULL;
    }
    GArray *points = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    for (size_t i = 0; i < fr_curve_point_count(curve); i++) {
        double point[2];
        fr_curve_point(curve, i, point);
        g_array_append_val(points, point);
    }
    char *text = studio_points_write(points);
    g_array_unref(points);
    fr_curve_unref(curve);
    return text;
}

void studio_points_move(GArray *points, guint index, double x, double y, bool is_function) {
    static const double gap = 0.001;
    double *at = (double *)(void *)points->data;
    if (is_function) {
        bool is_end = index == 0 || index + 1 == points->len;
        x = is_end ? at[2 * index] : CLAMP(x, at[2 * index - 2] + gap, at[2 * index + 2] - gap);
    }
    at[2 * index] = x;
    at[2 * index + 1] = y;
}

static double distance_to_side(const double *a, const double *b, double x, double y) {
    double dx = b[0] - a[0], dy = b[1] - a[1];
    double length = dx * dx + dy * dy;
    double t = length > 0 ? CLAMP(((x - a[0]) * dx + (y - a[1]) * dy) / length, 0, 1) : 0;
    return hypot(x - a[0] - t * dx, y - a[1] - t * dy);
}

guint studio_points_add(GArray *points, double x, double y, bool is_function) {
    const double *at = (const double *)(const void *)points->data;
    guint index = points->len;
    double nearest = INFINITY;
    for (guint i = 0; i < points->len; i++) {
        if (is_function && at[2 * i] > x) {
            index = i;
            break;
        }
        if (!is_function && i > 0) {
            double distance = distance_to_side(at + 2 * i - 2, at + 2 * i, x, y);
            index = distance < nearest ? i : index;
            nearest = fmin(nearest, distance);
        }
    }
    double point[2] = {x, y};
    g_array_insert_vals(points, index, point, 1);
    return index;
}
