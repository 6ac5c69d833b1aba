// The film's storage.
#include "render/film.h"

uint64_t fr_film_bytes(uint64_t pixels) {
    uint64_t film = 4 * sizeof(vec3s) + sizeof(float);
    uint64_t denoised = 4 * sizeof(vec3s);
    return fr_count_multiply(pixels, film + denoised);
}

FrFilm *fr_film_new(uint32_t width, uint32_t height) {
    FrFilm *film = g_new0(FrFilm, 1);
    size_t count = (size_t)width * height;
    film->width = width;
    film->height = height;
    film->half[0] = g_new0(vec3s, count);
    film->half[1] = g_new0(vec3s, count);
    film->albedo = g_new0(vec3s, count);
    film->normal = g_new0(vec3s, count);
    film->cover = g_new0(float, count);
    return film;
}

void fr_film_free(FrFilm *film) {
    if (film == NULL) {
        return;
    }
    g_free(film->half[0]);
    g_free(film->half[1]);
    g_free(film->albedo);
    g_free(film->normal);
    g_free(film->cover);
    g_free(film);
}
