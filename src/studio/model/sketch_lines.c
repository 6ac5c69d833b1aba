// Thick lines in perspective: each pixel near a line is covered by how far it is from its middle.
#include "studio/model/sketch_lines.h"

#include <cglm/struct.h>
#include <glib.h>

#include <math.h>
#include <string.h>

static const float thinnest = 0.35f, thickest = 28.0f; // pixels
enum { LARGEST_SIDE = 16384 };

// A point of the picture: pixels, distance, half the thickness there.
typedef struct Spot {
    float x, y, w, r;
} Spot;

float studio_lens_thickness(const StudioLens *lens, float width, float distance) {
    return CLAMP(width * lens->unit / fmaxf(distance, 1e-9f), thinnest, thickest);
}

static Spot spot_of(const StudioRaster *raster, const StudioLens *lens, vec4s at, float width) {
    return (Spot){(0.5f + 0.5f * at.x / at.w) * (float)raster->width,
                  (0.5f - 0.5f * at.y / at.w) * (float)raster->height, at.w,
                  0.5f * studio_lens_thickness(lens, width, at.w)};
}

static vec4s projected(const StudioLens *lens, const float at[3]) {
    return glms_mat4_mulv(lens->project, (vec4s){{at[0], at[1], at[2], 1}});
}

bool studio_lens_see(const StudioLens *lens, uint32_t width, uint32_t height, const float at[3],
                     float seen[2]) {
    vec4s point = projected(lens, at);
    StudioRaster size = {.width = width, .height = height};
    if (!(point.w >= lens->nearest)) {
        return false;
    }
    Spot spot = spot_of(&size, lens, point, 1);
    seen[0] = spot.x;
    seen[1] = spot.y;
    return true;
}

// ---- pixels ------------------------------------------------------------------------------------

static uint32_t part_of(uint32_t pixel, int shift) {
    return (pixel >> shift) & 0xff;
}

// Puts a colour over a pixel; `cover` is 0 to 255.
static uint32_t over(uint32_t below, const uint8_t colour[4], uint32_t cover) {
    uint32_t alpha = colour[3] * cover / 255, rest = 255 - alpha;
    uint32_t red = (colour[0] * alpha + part_of(below, 16) * rest) / 255;
    uint32_t green = (colour[1] * alpha + part_of(below, 8) * rest) / 255;
    uint32_t blue = (colour[2] * alpha + part_of(below, 0) * rest) / 255;
    uint32_t opacity = alpha + part_of(below, 24) * rest / 255;
    return opacity << 24 | red << 16 | green << 8 | blue;
}

static void cover(StudioRaster *raster, int x, int y, float part, float w, const uint8_t *colour) {
    size_t pixel = (size_t)y * raster->width + (size_t)x;
    if (w > raster->depth[pixel]) {
        return;
    }
    raster->pixels[pixel] = over(raster->pixels[pixel], colour, (uint32_t)(255 * part));
    if (part > 0.5f && colour[3] > 127) {
        raster->depth[pixel] = w;
    }
}

// The columns that a line between two spots may touch in a row.
static void columns_of(Spot a, Spot b, float y, float reach, float *left, float *right) {
    float from = 0, to = 1, rise = b.y - a.y;
    if (fabsf(rise) > 1e-6f) {
        float one = (y - reach - a.y) / rise, other = (y + reach - a.y) / rise;
        from = CLAMP(fminf(one, other), 0, 1);
        to = CLAMP(fmaxf(one, other), 0, 1);
    }
    float x0 = a.x + from * (b.x - a.x), x1 = a.x + to * (b.x - a.x);
    *left = fminf(x0, x1) - reach;
    *right = fmaxf(x0, x1) + reach;
}

static void draw_spots(StudioRaster *raster, Spot a, Spot b, const uint8_t colour[4]) {
    float dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    float reach = fmaxf(a.r, b.r) + 0.5f;
    float last_x = (float)raster->width - 1, last_y = (float)raster->height - 1;
    if (!isfinite(square)) {
        return;
    }
    float first_row = CLAMP(floorf(fminf(a.y, b.y) - reach), 0, last_y + 1);
    float last_row = fminf(fmaxf(a.y, b.y) + reach, last_y);
    for (int row = (int)first_row; (float)row <= last_row; row++) {
        float y = (float)row + 0.5f, left, right;
        columns_of(a, b, y, reach, &left, &right);
        float end = fminf(right, last_x);
        for (int x = (int)CLAMP(floorf(left), 0, last_x + 1); (float)x <= end; x++) {
            float px = (float)x + 0.5f - a.x, py = y - a.y;
            float t = square > 0 ? CLAMP((px * dx + py * dy) / square, 0, 1) : 0;
            float off = hypotf(px - t * dx, py - t * dy), r = a.r + t * (b.r - a.r);
            float part = CLAMP(r + 0.5f - off, 0, fminf(1, 2 * r));
            if (part > 0) {
                cover(raster, x, row, part, a.w + t * (b.w - a.w), colour);
            }
        }
    }
}

// The part of a line that lies behind the window.
static bool cut(const StudioLens *lens, vec4s *a, vec4s *b) {
    bool is_a = a->w >= lens->nearest, is_b = b->w >= lens->nearest;
    if (!is_a && !is_b) {
        return false;
    }
    if (!is_a || !is_b) {
        vec4s *out = is_a ? b : a;
        const vec4s *in = is_a ? a : b;
        float t = (in->w - lens->nearest) / (in->w - out->w);
        *out = glms_vec4_lerp(*in, *out, t);
        out->w = lens->nearest;
    }
    return a->w > 0 && b->w > 0;
}

// ---- pictures ----------------------------------------------------------------------------------

void studio_raster_reset(StudioRaster *raster, uint32_t width, uint32_t height) {
    g_free(raster->pixels);
    g_free(raster->depth);
    raster->width = MIN(width, LARGEST_SIDE);
    raster->height = MIN(height, LARGEST_SIDE);
    size_t count = (size_t)raster->width * raster->height;
    raster->pixels = g_new(uint32_t, count + 1);
    raster->depth = g_new(float, count + 1);
    studio_raster_clear(raster);
}

void studio_raster_clear(StudioRaster *raster) {
    size_t count = (size_t)raster->width * raster->height;
    memset(raster->pixels, 0, count * sizeof *raster->pixels);
    for (size_t i = 0; i < count; i++) {
        raster->depth[i] = INFINITY;
    }
}

void studio_raster_draw(StudioRaster *raster, const StudioLens *lens, const StudioLine *lines,
                        size_t count, double scale) {
    if (raster->width == 0 || raster->height == 0) {
        return;
    }
    for (size_t i = 0; i < count; i++) {
        vec4s a = projected(lens, lines[i].from), b = projected(lens, lines[i].to);
        if (cut(lens, &a, &b)) {
            Spot from = spot_of(raster, lens, a, lines[i].width);
            Spot to = spot_of(raster, lens, b, lines[i].width);
            from.r *= (float)scale;
            to.r *= (float)scale;
            draw_spots(raster, from, to, lines[i].colour);
        }
    }
}
