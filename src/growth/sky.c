// Light by views of the sky (Beneš 1996, An Efficient Estimation of Light in Simulation of Plant
// Development, as used by Beneš, Andrysco, Šťava 2009, section 3.3): from m directions the scene is
// drawn into a depth buffer; a bud's light is the share of views that see it, and its brightest
// spot lies where these views are, in the mean.
//
// Leaves are drawn as squares that face the view. One smaller than a pixel is drawn, or left out,
// by chance in proportion to its area, so that coverage is right in the mean. Every buffer keeps
// the nearest depth alone, so the order of drawing has no say.
#include "growth/sky.h"
#include "math/lanes.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

// ---- directions -------------------------------------------------------------------------------

/// Directions spread evenly over the upper half of the sphere (a Fibonacci lattice).
static vec3s lattice(uint32_t i, uint32_t count, vec3s up, versors frame) {
    double height = 1 - ((double)i + 0.5) / count;
    double around = 2 * G_PI * 0.6180339887498949 * i;
    double across = sqrt(1 - height * height);
    vec3s side = glms_vec3_add(glms_vec3_scale(fr_frame_left(frame), (float)(across * cos(around))),
                               glms_vec3_scale(fr_frame_up(frame), (float)(across * sin(around))));
    return glms_vec3_add(side, glms_vec3_scale(up, (float)height));
}

FrSky fr_sky_of(const FrGrowth *growth) {
    const FrGrowthParams *params = &growth->params;
    FrSky sky = {.count = (uint32_t)params->views};
    uint32_t suns = (uint32_t)MIN(params->suns, params->views);
    // The sky does not tilt with gravity.
    vec3s up = {{0, 0, 1}};
    versors frame = fr_frame_from_heading(up, (vec3s){{0, 1, 0}});
    double sum = 0;
    for (uint32_t i = 0; i < sky.count; i++) {
        double angle = G_PI * ((double)i + 0.5) / MAX(suns, 1);
        vec3s path = {{(float)cos(angle), 0, (float)sin(angle)}};
        vec3s sun = growth->suns != NULL && i < suns ? growth->suns[i] : path;
        sky.direction[i] = i < suns ? sun : lattice(i - suns, sky.count - suns, up, frame);
        double weight = params->overcast ? (1 + 2 * (double)sky.direction[i].z) / 3 : 1;
        sky.weight[i] = (float)weight;
        sum += weight;
    }
    for (uint32_t i = 0; i < sky.count; i++) {
        sky.weight[i] /= (float)sum;
    }
    return sky;
}

// ---- drawing ----------------------------------------------------------------------------------

enum { ABREAST = 64 }; ///< points that a view turns to at once

/// A view: two axes of its picture, and where on them the picture lies.
typedef struct View {
    vec3s right, up, towards;
    float left, bottom; ///< of the picture, m
    float scale;        ///< pixels a metre
    int width;          ///< pixels both ways
    float *depth;       ///< nearest to the sky
    uint32_t index;
} View;

typedef struct Looking {
    const FrGrowth *growth;
    const FrSky *sky;
    const FrShades *shades;
    const FrLiveBudAt *buds;
    uint32_t bud_count;
    float *x, *y, *z; ///< of buds
    float *own_shade; ///< of buds
    vec3s low, high;  ///< box around buds and leaves
    float lowest;     ///< height of the lowest bud
    float pixel;      ///< m
    int width;        ///< pixels
    float *depth;     ///< pictures, by worker
    uint8_t *is_seen; ///< by view, then by bud
} Looking;

/// Of a picture, and those behind it that nobody looks at.
static size_t pixels_of(const Looking *looking) {
    return (size_t)looking->width * (size_t)looking->width + ABREAST;
}

static View view_of(const Looking *looking, uint32_t index, int worker) {
    View view = {.towards = looking->sky->direction[index],
                 .scale = 1 / looking->pixel,
                 .width = looking->width,
                 .depth = looking->depth + pixels_of(looking) * (size_t)worker,
                 .index = index};
    versors frame = fr_frame_from_heading(view.towards, (vec3s){{0.36f, 0.48f, 0.8f}});
    view.right = fr_frame_left(frame);
    view.up = fr_frame_up(frame);
    vec3s middle = glms_vec3_scale(glms_vec3_add(looking->low, looking->high), 0.5f);
    float half = looking->pixel * (float)looking->width / 2;
    view.left = glms_vec3_dot(middle, view.right) - half;
    view.bottom = glms_vec3_dot(middle, view.up) - half;
    return view;
}

// Without the care of fmaxf() for what is no number, of which there is none here.
static inline float larger(float a, float b) {
    return a > b ? a : b;
}

static inline float smaller(float a, float b) {
    return a < b ? a : b;
}

static void draw_square(const View *view, float x, float y, float depth, float half) {
    int left = (int)larger(x - half + 0.5f, 0),
        right = (int)smaller(x + half + 0.5f, (float)view->width);
    int low = (int)larger(y - half + 0.5f, 0),
        high = (int)smaller(y + half + 0.5f, (float)view->width);
    for (int row = low; row < high; row++) {
        float *pixels = view->depth + (size_t)row * (size_t)view->width;
        for (int column = left; column < right; column++) {
            pixels[column] = larger(pixels[column], depth);
        }
    }
}

/// Where points lie in a picture, and how near they are to the sky.
typedef struct Places {
    float x[ABREAST], y[ABREAST], depth[ABREAST];
} Places;

/// In a form that compilers turn into vectors.
FR_LANES_CLONES static void place(const View *view, const float *restrict x,
                                  const float *restrict y, const float *restrict z, uint32_t count,
                                  Places *restrict places) {
    vec3s right = view->right, up = view->up, towards = view->towards;
    float left = view->left, bottom = view->bottom, scale = view->scale;
    for (uint32_t i = 0; i < count; i++) {
        places->x[i] = (x[i] * right.x + y[i] * right.y + z[i] * right.z - left) * scale;
        places->y[i] = (x[i] * up.x + y[i] * up.y + z[i] * up.z - bottom) * scale;
        places->depth[i] = x[i] * towards.x + y[i] * towards.y + z[i] * towards.z;
    }
}

/// Where squares of less than a pixel are drawn: by chance, and else in a pixel behind the picture,
/// one for each lane. Every second square comes to nothing, which no branch foresees, so that
/// drawing all of them costs less than asking. Tells whether some squares are wider than a pixel.
FR_LANES_CLONES static bool choose(const View *view, const float *restrict side,
                                   const uint32_t *restrict hash, uint32_t count,
                                   const Places *restrict places, int32_t *restrict pixel) {
    uint32_t own = view->index * 0x9e3779b9u;
    float scale = view->scale, size = (float)view->width;
    int32_t width = view->width, behind = width * width, wide = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t bits = (hash[i] ^ own) * 0x85ebca6bu;
        bits ^= bits >> 15;
        bits *= 0x2c1b3c6du;
        float across = side[i] * scale, x = places->x[i], y = places->y[i];
        // No && and no branch: vectors know neither.
        int32_t is_inside = (x >= 0) & (y >= 0) & (x < size) & (y < size);
        int32_t is_drawn = (float)(int32_t)(bits >> 8) * 0x1p-24f < across * across;
        int32_t column = (int32_t)smaller(larger(x, 0), size);
        int32_t row = (int32_t)smaller(larger(y, 0), size);
        int32_t is_wide = across > 1;
        wide |= is_wide;
        is_drawn &= is_inside & !is_wide;
        pixel[i] = is_drawn != 0 ? row * width + column : behind + (int32_t)i;
    }
    return wide != 0;
}

static void draw_shades(const View *view, const FrShades *shades) {
    Places places;
    int32_t pixel[ABREAST];
    for (uint32_t i = 0; i < shades->count; i += ABREAST) {
        uint32_t count = MIN(ABREAST, shades->count - i);
        place(view, shades->x + i, shades->y + i, shades->z + i, count, &places);
        bool has_wide = choose(view, shades->side + i, shades->hash + i, count, &places, pixel);
        for (uint32_t k = 0; k < count; k++) {
            float *at = view->depth + pixel[k];
            *at = larger(*at, places.depth[k]);
        }
        for (uint32_t k = 0; has_wide && k < count; k++) {
            float side = shades->side[i + k] * view->scale;
            if (side > 1) {
                draw_square(view, places.x[k], places.y[k], places.depth[k], side / 2);
            }
        }
    }
}

/// A triangle in a picture: its corners in pixels and how near they are to the sky.
typedef struct Flat {
    float at[3][2];
    float depth[3];
} Flat;

/// Where a row meets a triangle: columns [from, to).
static bool span_of(const Flat *flat, float area, float y, int width, int *from, int *to) {
    float low = -0.5f, high = (float)width - 0.5f; // middles of pixels from here to there
    for (int i = 0; i < 3; i++) {
        const float *a = flat->at[i], *b = flat->at[(i + 1) % 3];
        // Inside, (b − a) × (p − a) has the sign of the area: linear in x along a row.
        float slope = -(b[1] - a[1]) * area;
        float start = ((b[0] - a[0]) * (y - a[1]) + (b[1] - a[1]) * a[0]) * area;
        if (slope > 0) {
            low = larger(low, -start / slope - 0.5f);
        } else if (slope < 0) {
            high = smaller(high, -start / slope - 0.5f);
        } else if (start < 0) {
            return false;
        }
    }
    *from = (int)ceilf(low);
    *to = (int)floorf(high) + 1;
    *from = MAX(*from, 0);
    *to = MIN(*to, width);
    return *from < *to;
}

/// Pixels whose middle a triangle covers.
static void draw_triangle(const View *view, const Flat *flat) {
    const float *a = flat->at[0], *b = flat->at[1], *c = flat->at[2];
    float area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (fabsf(area) < 1e-9f) {
        return;
    }
    // Depth is linear over the picture.
    float along = ((flat->depth[1] - flat->depth[0]) * (c[1] - a[1]) -
                   (flat->depth[2] - flat->depth[0]) * (b[1] - a[1])) /
                  area;
    float across = ((flat->depth[2] - flat->depth[0]) * (b[0] - a[0]) -
                    (flat->depth[1] - flat->depth[0]) * (c[0] - a[0])) /
                   area;
    float low = smaller(a[1], smaller(b[1], c[1])), high = larger(a[1], larger(b[1], c[1]));
    int first = (int)larger(low - 0.5f, 0), last = (int)smaller(high + 0.5f, (float)view->width);
    for (int row = first; row < last; row++) {
        float y = (float)row + 0.5f;
        int from, to;
        if (!span_of(flat, area > 0 ? 1 : -1, y, view->width, &from, &to)) {
            continue;
        }
        float *pixels = view->depth + (size_t)row * (size_t)view->width;
        float begin = flat->depth[0] + across * (y - a[1]) + along * (0.5f - a[0]);
        for (int column = from; column < to; column++) {
            pixels[column] = larger(pixels[column], begin + along * (float)column);
        }
    }
}

/// What lies no higher than all buds shades none of them.
static void draw_obstacles(const View *view, const FrGrowth *growth, float lowest) {
    for (uint32_t o = 0; o < growth->obstacle_count; o++) {
        const FrGrowthObstacle *obstacle = &growth->obstacles[o];
        for (uint32_t i = 0; i + 2 < obstacle->index_count && !obstacle->is_clear; i += 3) {
            Flat flat;
            float top = -INFINITY;
            for (uint32_t k = 0; k < 3; k++) {
                vec3s at = obstacle->positions[obstacle->indices[i + k]];
                top = larger(top, at.z);
                flat.at[k][0] = (glms_vec3_dot(at, view->right) - view->left) * view->scale;
                flat.at[k][1] = (glms_vec3_dot(at, view->up) - view->bottom) * view->scale;
                flat.depth[k] = glms_vec3_dot(at, view->towards);
            }
            if (top > lowest) {
                draw_triangle(view, &flat);
            }
        }
    }
}

// ---- looking ----------------------------------------------------------------------------------

/// The pixels of points, and what is as near to the sky as they.
FR_LANES_CLONES static void find_pixels(const View *view, float pixel,
                                        const float *restrict own_shade, uint32_t count,
                                        const Places *restrict places, int32_t *restrict at,
                                        float *restrict depth) {
    float last = (float)(view->width - 1);
    int width = view->width;
    for (uint32_t i = 0; i < count; i++) {
        int column = (int)CLAMP(places->x[i], 0, last), row = (int)CLAMP(places->y[i], 0, last);
        at[i] = row * width + column;
        // Its own leaves do not shade a bud, nor does the slope of the pixel.
        depth[i] = places->depth[i] + larger(pixel, own_shade[i]);
    }
}

static void look_at_buds(const Looking *looking, const View *view) {
    uint8_t *is_seen = looking->is_seen + (size_t)view->index * looking->bud_count;
    Places places;
    int32_t at[ABREAST];
    float depth[ABREAST];
    for (uint32_t i = 0; i < looking->bud_count; i += ABREAST) {
        uint32_t count = MIN(ABREAST, looking->bud_count - i);
        place(view, looking->x + i, looking->y + i, looking->z + i, count, &places);
        find_pixels(view, looking->pixel, looking->own_shade + i, count, &places, at, depth);
        for (uint32_t k = 0; k < count; k++) {
            is_seen[i + k] = view->depth[at[k]] <= depth[k];
        }
    }
}

static void look(void *data, size_t begin, size_t end, int worker) {
    const Looking *looking = data;
    size_t pixels = pixels_of(looking);
    for (size_t index = begin; index < end; index++) {
        View view = view_of(looking, (uint32_t)index, worker);
        for (size_t i = 0; i < pixels; i++) {
            view.depth[i] = -INFINITY;
        }
        draw_shades(&view, looking->shades);
        draw_obstacles(&view, looking->growth, looking->lowest);
        look_at_buds(looking, &view);
    }
}

/// Brightness that comes to buds, as light and as a vector.
typedef struct Brightness {
    float light[ABREAST], x[ABREAST], y[ABREAST], z[ABREAST];
} Brightness;

FR_LANES_CLONES static void add_view(Brightness *restrict sum, const uint8_t *restrict is_seen,
                                     float weight, vec3s part, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        float seen = (float)is_seen[i];
        sum->light[i] += seen * weight;
        sum->x[i] += seen * part.x;
        sum->y[i] += seen * part.y;
        sum->z[i] += seen * part.z;
    }
}

static void sum_up(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Looking *looking = data;
    const FrSky *sky = looking->sky;
    for (size_t i = begin; i < end; i += ABREAST) {
        uint32_t count = (uint32_t)MIN(ABREAST, end - i);
        Brightness all = {0};
        for (uint32_t view = 0; view < sky->count; view++) {
            vec3s part = glms_vec3_scale(sky->direction[view], sky->weight[view]);
            add_view(&all, looking->is_seen + (size_t)view * looking->bud_count + i,
                     sky->weight[view], part, count);
        }
        for (uint32_t k = 0; k < count; k++) {
            FrLiveBud *bud = looking->buds[i + k].bud;
            vec3s sum = {{all.x[k], all.y[k], all.z[k]}};
            float length = glms_vec3_norm(sum);
            bud->light = smaller(all.light[k], 1);
            bud->slope = 1;
            bud->brightest = length > 1e-6f ? glms_vec3_scale(sum, 1 / length) : (vec3s){0};
        }
    }
}

static void spread(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Looking *looking = data;
    for (size_t i = begin; i < end; i++) {
        looking->x[i] = looking->buds[i].world.x;
        looking->y[i] = looking->buds[i].world.y;
        looking->z[i] = looking->buds[i].world.z;
        looking->own_shade[i] = looking->buds[i].own_shade;
    }
}

static void include(Looking *looking, vec3s at) {
    looking->low = glms_vec3_minv(looking->low, at);
    looking->high = glms_vec3_maxv(looking->high, at);
}

/// Pixels no finer than leaves need.
static void lay_pictures(Looking *looking) {
    float widest = 0;
    looking->low = (vec3s){{INFINITY, INFINITY, INFINITY}};
    looking->high = glms_vec3_negate(looking->low);
    for (uint32_t i = 0; i < looking->bud_count; i++) {
        include(looking, looking->buds[i].world);
    }
    looking->lowest = looking->low.z;
    for (uint32_t i = 0; i < looking->shades->count; i++) {
        include(looking,
                (vec3s){{looking->shades->x[i], looking->shades->y[i], looking->shades->z[i]}});
        widest = fmaxf(widest, looking->shades->side[i]);
    }
    float size = glms_vec3_distance(looking->low, looking->high) + widest;
    looking->pixel =
        fmaxf(fmaxf(size / (float)looking->growth->params.resolution, widest / 4), 0.001f);
    looking->width = (int)ceilf(size / looking->pixel) + 1;
}

void fr_sky_look(FrGrowth *growth, const FrSky *sky, const FrShades *shades,
                 const FrLiveBudAt *buds, uint32_t count, const FrContext *context) {
    enum { GRAIN = 1024 };
    if (count == 0) {
        return;
    }
    Looking looking = {
        .growth = growth, .sky = sky, .shades = shades, .buds = buds, .bud_count = count};
    lay_pictures(&looking);
    size_t pixels = pixels_of(&looking) * (size_t)fr_pool_threads(context->pool);
    size_t columns = pixels + (size_t)count * 4;
    looking.depth =
        fr_scratch_take(&growth->sky_memory, columns * sizeof(float) + (size_t)sky->count * count);
    looking.x = looking.depth + pixels;
    looking.y = looking.x + count;
    looking.z = looking.y + count;
    looking.own_shade = looking.z + count;
    looking.is_seen = (uint8_t *)(looking.depth + columns);
    fr_parallel_for(context->pool, count, GRAIN, spread, &looking, NULL);
    fr_parallel_for(context->pool, sky->count, 1, look, &looking, context->progress);
    fr_parallel_for(context->pool, count, GRAIN, sum_up, &looking, context->progress);
}
