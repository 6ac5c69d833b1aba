// Exposure and tone. The tone curve is AgX (agx.h): light is moved towards grey a little before
// each channel follows a film's curve, so bright greens and sunlit bark fade to white instead of
// turning yellow or cyan.
#include "render/agx.h"
#include "render/colour.h"
#include "render/film.h"

#include "frond/random.h"

#include <math.h>

// What the average of the picture is exposed to, and how far the picture rather than the light that
// falls into it decides.
#define KEY 0.29f
#define PICTURE_PART 0.6f
// How far colours are balanced towards the light that falls into the picture being white.
#define BALANCE_PART 0.75f

static float film_curve(float x) {
    float x2 = x * x;
    float x4 = x2 * x2;
    return FR_AGX_CURVE(x, x2, x4);
}

vec3s fr_tone(vec3s light) {
    static const float inset[] = {FR_AGX_INSET};
    static const float outset[] = {FR_AGX_OUTSET};
    float curved[3];
    for (int i = 0; i < 3; i++) {
        float mixed =
            inset[3 * i] * light.r + inset[3 * i + 1] * light.g + inset[3 * i + 2] * light.b;
        float stops = log2f(fmaxf(mixed, 1e-10f));
        float part = (stops - (FR_AGX_LOWEST)) / (FR_AGX_HIGHEST - (FR_AGX_LOWEST));
        curved[i] = film_curve(fminf(fmaxf(part, 0.0f), 1.0f));
        curved[i] = powf(fmaxf(curved[i], 0.0f), FR_AGX_POWER);
    }
    float grey = fr_luminance((vec3s){{curved[0], curved[1], curved[2]}});
    for (int i = 0; i < 3; i++) {
        curved[i] = grey + FR_AGX_SATURATION * (curved[i] - grey);
    }
    vec3s shown;
    for (int i = 0; i < 3; i++) {
        float value = outset[3 * i] * curved[0] + outset[3 * i + 1] * curved[1] +
                      outset[3 * i + 2] * curved[2];
        shown.raw[i] = fminf(fmaxf(value, 0.0f), 1.0f);
    }
    return shown;
}

float fr_film_exposure_of(double picture, float white) {
    double meter = (double)fmaxf(0.18f * white, 1e-12f);
    double mean = exp(PICTURE_PART * log(picture) + (1.0 - PICTURE_PART) * log(meter));
    return (float)((double)KEY / mean);
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
    return fr_film_exposure_of(exp(sum / weights), white);
}

vec3s fr_film_balance(vec3s light) {
    float mean = fr_luminance(light);
    vec3s balance = glms_vec3_one();
    for (int c = 0; c < 3; c++) {
        if (light.raw[c] > 1e-3f * mean) {
            balance.raw[c] = powf(mean / light.raw[c], BALANCE_PART);
        }
    }
    return balance;
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
