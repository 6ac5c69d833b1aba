// Parameters along a stem. A parameter is evaluated anew where it is asked for, with `s` the place;
// its random part is drawn from the path and so is the same all along.
#include "pgraph/along.h"

#include <math.h>

// Gauss and Legendre's rule of three points: exact for polynomials of degree 5.
static const double gauss_place[] = {-0.7745966692414834, 0, 0.7745966692414834};
static const double gauss_weight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

#define ROW(field)                                                                                 \
    { offsetof(FrStemParams, field), FR_STEM_##field }
static const struct {
    size_t offset;
    uint32_t parameter;
} rows[FR_ALONG_COUNT] = {
    [FR_ALONG_RADIUS] = ROW(radius),
    [FR_ALONG_FLATNESS] = ROW(flatness),
    [FR_ALONG_CURVATURE] = ROW(curvature),
    [FR_ALONG_TWIST] = ROW(twist),
    [FR_ALONG_GNARL] = ROW(gnarl),
    [FR_ALONG_GRAVITROPISM] = ROW(gravitropism),
    [FR_ALONG_PHOTOTROPISM] = ROW(phototropism),
    [FR_ALONG_PLAGIOTROPISM] = ROW(plagiotropism),
};
#undef ROW

static const FrNumber *number_of(const FrStemParams *params, FrAlong which) {
    return (const FrNumber *)(const void *)((const char *)params + rows[which].offset);
}

uint32_t fr_along_find(const FrStemParams *params) {
    uint32_t found = 0;
    for (FrAlong which = 0; which < FR_ALONG_COUNT; which++) {
        bool is_along = fr_number_uses(number_of(params, which), FR_VAR_s);
        found |= (uint32_t)is_along << which;
    }
    return found;
}

double fr_along_at(const FrStem *stem, FrAlong which, double at) {
    FrEvaluator *evaluator = stem->evaluator;
    const FrNumber *number = number_of(stem->prepared->params, which);
    bool is_thickness = which == FR_ALONG_RADIUS || which == FR_ALONG_FLATNESS;
    evaluator->vars.value[FR_VAR_s] = at * (is_thickness ? stem->slim : stem->whole);
    double value = fr_value(evaluator, number, rows[which].parameter);
    evaluator->vars.value[FR_VAR_s] = 0;
    return value;
}

double fr_along_mean(const FrStem *stem, FrAlong which, double from, double to) {
    double middle = 0.5 * (from + to), half = 0.5 * (to - from), sum = 0;
    for (size_t k = 0; k < G_N_ELEMENTS(gauss_place); k++) {
        sum += gauss_weight[k] * fr_along_at(stem, which, middle + half * gauss_place[k]);
    }
    return sum;
}

double fr_along_size(const FrStem *stem, FrAlong which) {
    enum { PLACES = 8 };
    double sum = 0;
    for (int k = 0; k < PLACES; k++) {
        sum += fabs(fr_along_at(stem, which, (k + 0.5) / PLACES)) / PLACES;
    }
    return sum;
}
