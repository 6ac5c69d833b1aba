#include "material/ramp.h"

#include <string.h>

static bool read_stop(const char *word, double before, double *at, vec3s *colour) {
    char *end;
    *at = g_ascii_strtod(word, &end);
    size_t space = strspn(end, " \t\r\n");
    if (end == word || space == 0 || !(*at > before && *at <= 1) || end[space] != '#') {
        return false;
    }
    const char *digits = end + space + 1;
    for (int k = 0; k < 6; k++) {
        if (!g_ascii_isxdigit(digits[k])) {
            return false;
        }
    }
    for (int k = 0; k < 3; k++) {
        int value =
            16 * g_ascii_xdigit_value(digits[2 * k]) + g_ascii_xdigit_value(digits[2 * k + 1]);
        colour->raw[k] = (float)value / 255;
    }
    return digits[6] == '\0';
}

bool fr_ramp_read(FrRamp *ramp, const char *text, FrSpan span, FrDiags *diags) {
    *ramp = (FrRamp){0};
    if (text == NULL || text[strspn(text, " \t\r\n")] == '\0') {
        return true;
    }
    char **words = g_strsplit(text, ",", FR_MOST_STOPS + 2);
    double before = -1e-300;
    size_t place = 0;
    bool is_right = g_strv_length(words) <= FR_MOST_STOPS;
    for (uint32_t k = 0; is_right && words[k] != NULL; k++) {
        size_t size = strlen(words[k]);
        FrSpan stop = {span.source, MIN(span.begin + (uint32_t)place, span.end),
                       MIN(span.begin + (uint32_t)(place + size), span.end)};
        is_right = read_stop(g_strstrip(words[k]), before, &ramp->at[k], &ramp->colour[k]);
        if (!is_right) {
            span = stop;
        }
        before = ramp->at[k];
        ramp->count = k + 1;
        place += size + 1;
    }
    g_strfreev(words);
    if (!is_right) {
        fr_diags_add(diags, FR_ERROR, "wrong-ramp", span,
                     "a ramp is written '0 #7fa845, 0.8 #d08a1e': up to %d places from 0 to 1, "
                     "rising, each with its colour",
                     FR_MOST_STOPS);
        *ramp = (FrRamp){0};
    }
    return is_right;
}

vec3s fr_ramp_at(const FrRamp *ramp, double place) {
    uint32_t k = 0;
    while (k + 1 < ramp->count && ramp->at[k + 1] <= place) {
        k++;
    }
    if (k + 1 == ramp->count || place <= ramp->at[k]) {
        return ramp->colour[k];
    }
    float part = (float)((place - ramp->at[k]) / (ramp->at[k + 1] - ramp->at[k]));
    vec3s mixed;
    for (int c = 0; c < 3; c++) {
        mixed.raw[c] =
            ramp->colour[k].raw[c] + part * (ramp->colour[k + 1].raw[c] - ramp->colour[k].raw[c]);
    }
    return mixed;
}
