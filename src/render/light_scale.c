// The colours in which light is shown.
#include "frond/render.h"

#include <cglm/struct.h>
#include <math.h>

// Of samples without a measure so many are below the top of the scale.
#define TOP_PART 0.98

static int compare(const void *a, const void *b) {
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

float fr_light_scale_top(const FrScene *scene, const float *light, size_t count) {
    const FrLightParams *params = &scene->surroundings->light;
    bool has_sky = scene->params->sun_strength > 0 || scene->params->sky_strength > 0;
    if (params->relative || (params->by == FR_LIGHT_BY_VIEWS && has_sky) ||
        params->by == FR_LIGHT_BY_SHADOWS) {
        return 1;
    }
    if (count == 0) {
        return 1;
    }
    float *sorted = g_memdup2(light, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, compare);
    float top = sorted[(size_t)(TOP_PART * (double)(count - 1))];
    g_free(sorted);
    return top > 0 ? top : 1;
}

void fr_light_scale_paint(uint8_t *pixel, float part) {
    static const float colours[6][3] = {{8, 6, 18},    {48, 36, 128},  {148, 44, 118},
                                        {226, 98, 62}, {250, 190, 74}, {255, 252, 226}};
    float place = fminf(fmaxf(part, 0), 1) * 5;
    int step = (int)fminf(place, 4);
    for (int c = 0; c < 3; c++) {
        float mixed = glm_lerp(colours[step][c], colours[step + 1][c], place - (float)step);
        pixel[c] = (uint8_t)lroundf(mixed);
    }
}
