/// @file film.h
/// Light gathered by pixel, and what becomes of it: less noise, exposure, tone. Private to render.
#pragma once

#include "frond/context.h"
#include "frond/image.h"
#include "frond/vector.h"

/// Means of the samples of a pixel. Light is kept as two halves, of the even and the odd samples,
/// whose difference tells the noise.
typedef struct FrFilm {
    uint32_t width, height;
    vec3s *half[2]; ///< radiance
    vec3s *albedo;  ///< of the first surface; white for the sky
    vec3s *normal;  ///< of the first surface, averaged; zero for the sky
    float *cover;   ///< part of the pixel that is not sky
} FrFilm;

/// Bytes that a film of so many pixels takes, that of its denoiser included.
uint64_t fr_film_bytes(uint64_t pixels);
FrFilm *fr_film_new(uint32_t width, uint32_t height);
void fr_film_free(FrFilm *film);
/// The mean of both halves with noise averaged away where neighbours agree within their noise.
/// width × height colours, to be freed with g_free(); NULL if cancelled.
vec3s *fr_film_denoise(const FrFilm *film, const FrContext *context);
/// The factor that exposes `light` well; `white` is the luminance of white ground in full light.
float fr_film_exposure(const FrFilm *film, const vec3s *light, float white);
/// The same for a picture whose mean is known already.
float fr_film_exposure_of(double picture, float white);
/// What makes `light` white, or nearly: multiplies the colours.
vec3s fr_film_balance(vec3s light);
/// Develops light times `exposure` to 8-bit sRGB. `balance` multiplies the colours first.
FrImage *fr_film_develop(const FrFilm *film, const vec3s *light, float exposure, vec3s balance);
/// The tone curve for one colour: linear scene light, 0.18 mid grey, to sRGB-encoded 0 … 1.
vec3s fr_tone(vec3s light);
