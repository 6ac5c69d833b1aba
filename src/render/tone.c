// Exposure and tone. The tone curve is AgX (Sobotka 2022) in the polynomial form of Wrensch 2023,
// Minimal AgX Implementation: light is moved towards grey a little before each channel follows a
// film's curve, so bright greens and sunlit bark fade to white instead of turning yellow or cyan.
#include "render/colour.h"
#include "render/film.h"

#include "frond/random.h"

#include <math.h>

// Exposure of the curve in stops about mid grey, and the look on top: a little more contrast and
// colour than the neutral curve has.
#define LOWEST_STOP (-12.47393f)
#define HIGHEST_STOP 4.026069f
#define LOOK_POWER 1.3f
#define LOOK_SATURATION 1.27f
// What the average of the picture is exposed to, and how far the picture rather than the light that
// falls into it decides.
#define KEY 0.29f
#define PICTURE_PART 0.6f

static float film_curve(float x) {
    float x2 = x * x;
    float x4 = x2 * x2;
    return 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 +
           0.1191f * x - 0.00232f;
}

vec3s fr_tone(vec3s light) {
    static const float inset[3][3] = {
        {0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f},
        {0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f},
        {0.0423756549057051f, 0.0784336f, 0.879142973793104f}};
    static const float outset[3][3] = {
        {1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f},
        {-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f},
        {-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f}};
    float curved[3];
    for (int i = 0; i < 3; i++) {
        float mixed = inset[i][0] * light.r + inset[i][1] * light.g + inset[i][2] * light.b;
        float stops = log2f(fmaxf(mixed, 1e-10f));
        float part = (stops - LOWEST_STOP) / (HIGHEST_STOP - LOWEST_STOP);
        curved[i] = film_curve(fminf(fmaxf(part, 0.0f), 1.0f));
        curved[i] = powf(fmaxf(curved[i], 0.0f), LOOK_POWER);
    }
    float grey = fr_luminance((vec3s){{curved[0], curved[1], curved[2]}});
    for (int i = 0; i < 3; i++) {
        curved[i] = grey + LOOK_SATURATION * (curved[i] - grey);
    }
    vec3s shown;
    for (int i = 0; i < 3; i++) {
        float value =
            outset[i][0] * curved[0] + outset[i][1] * curved[1] + outset[i][2] * curved[2];
        shown.raw[i] = fminf(fmaxf(value, 0.0f), 1.0f);
    }
    return shown;
}

// The mean of the logarithms (Reinhard, Stark, Shirley, Ferwerda 2002), in which the sky counts
// little, together with what a light meter held into the light would say: a dark fir then stays
// darker than a birch.
float fr_film_exposure(const FrFilm *film, const vec3s *light, float white) {
    size_t count = (size_t)film->width * film->height;
    double sum = 0.0;
    double weights = 0.0;
    float floor = fmaxf(1e-3f * white, 1e-12f);
    for (size_t i = 0; i < count; i++) {
        double weight = 0.15 + 0.85 * (double)film->cover[i];
        sum += weight * log((double)fmaxf(fr_luminance(light[i]), floor));
        weights += weight;
    }
    double picture = exp(sum / weights);
    double meter = (double)fmaxf(0.18f * white, 1e-12f);
    double mean = exp(PICTURE_PART * log(picture) + (1.0 - PICTURE_PART) * log(meter));
    return (float)((double)KEY / mean);
}

// Rounding to 8 bits is dithered by less than a step, or a smooth sky would show bands.
FrImage *fr_film_develop(const FrFilm *film, const vec3s *light, float exposure, vec3s balance) {
    FrImage *image = fr_image_new(film->width, film->height, 3);
    size_t count = (size_t)film->width * film->height;
    vec3s factor = glms_vec3_scale(balance, exposure);
    for (size_t i = 0; i < count; i++) {
        vec3s shown = fr_tone(glms_vec3_mul(light[i], factor));
        for (int c = 0; c < 3; c++) {
            float dither = (float)fr_random((FrKey)i, 0, (uint32_t)c);
            float level = shown.raw[c] * 255.0f + dither;
            image->pixels[3 * i + (size_t)c] = (uint8_t)fminf(level, 255.0f);
        }
    }
    return image;
}
