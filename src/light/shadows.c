// Shadow propagation after Palubicki et al. 2009, in whole numbers: a voxel sums up what each point
// above it takes, so the order of casting does not matter. Multiplied shadows are sums of
// −log2(1 − a·b^−d).
#include "frond/shadows.h"

#include "frond/random.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

enum { LAYERS_A_CHUNK = 8 };

#define ONE 262144.0 // a whole unit of shadow

/// Voxels low … high − 1 along each axis.
typedef struct Box {
    int low[3], high[3];
} Box;

struct FrShadows {
    FrShadowSettings settings;
    float *light;     ///< by voxel, as of the last fr_shadows_settle(); NULL before the first
    Box changed;      ///< … but in here
    uint32_t *shade;  ///< by voxel, x fastest, then y, then z
    int *reach;       ///< half width of each layer
    uint32_t **table; ///< what a point takes in each layer: (2 reach + 1)²
};

FrShadowSettings fr_shadows_default(void) {
    return (FrShadowSettings){.form = FR_SHADOWS_MULTIPLY,
                              .a = 0.441,
                              .b = 6.31,
                              .full = 1,
                              .jitter = 0,
                              .depth = 6,
                              .spread = 1,
                              .cell = 1,
                              .origin = {-100.5, -100.5, 0},
                              .cells = {201, 201, 201}};
}

/// What a voxel loses to a point `layer` above it and (x, y) beside it.
static uint32_t taken(const FrShadowSettings *settings, int layer, int x, int y) {
    if (settings->form == FR_SHADOWS_SUBTRACT) {
        return (uint32_t)lround(ONE * settings->a * pow(settings->b, -layer));
    }
    if (layer == 0 || layer == settings->depth) {
        return 0;
    }
    double distance = sqrt((double)(layer * layer + x * x + y * y));
    double part = settings->a * pow(settings->b, -distance);
    return (uint32_t)lround(-ONE * log2(fmax(1.0 - part, 0x1.0p-16)));
}

static void make_tables(FrShadows *shadows) {
    const FrShadowSettings *settings = &shadows->settings;
    shadows->reach = g_new(int, settings->depth + 1);
    shadows->table = g_new(uint32_t *, settings->depth + 1);
    for (int layer = 0; layer <= settings->depth; layer++) {
        int reach = layer * settings->spread;
        int width = 2 * reach + 1;
        shadows->reach[layer] = reach;
        shadows->table[layer] = g_new(uint32_t, width * width);
        for (int i = 0; i < width * width; i++) {
            shadows->table[layer][i] = taken(settings, layer, i % width - reach, i / width - reach);
        }
    }
}

FrStatus fr_shadows_new(const FrShadowSettings *settings, const FrContext *context,
                        FrShadows **shadows) {
    *shadows = NULL;
    FR_ASSERT(settings->a > 0 && settings->b > 1 && settings->full > 0 && settings->cell > 0);
    FR_ASSERT(settings->depth >= 1 && settings->depth <= 64);
    FR_ASSERT(settings->jitter >= 0 && settings->jitter < 1);
    FR_ASSERT(settings->spread >= 0 && settings->spread <= 4);
    uint64_t count = 1;
    for (int axis = 0; axis < 3; axis++) {
        FR_ASSERT(settings->cells[axis] >= 1);
        count = fr_count_multiply(count, (uint64_t)settings->cells[axis]);
    }
    FrStatus status =
        fr_limit_check(fr_count_multiply(count, sizeof(uint32_t)), context->limits.bytes, "bytes",
                       "the shadow voxels", (FrSpan){0}, context->diags);
    if (status != FR_OK) {
        return status;
    }
    *shadows = g_new0(FrShadows, 1);
    (*shadows)->settings = *settings;
    (*shadows)->shade = g_new0(uint32_t, count);
    memcpy((*shadows)->changed.high, settings->cells, sizeof settings->cells);
    make_tables(*shadows);
    return FR_OK;
}

void fr_shadows_free(FrShadows *shadows) {
    if (shadows == NULL) {
        return;
    }
    for (int layer = 0; layer <= shadows->settings.depth; layer++) {
        g_free(shadows->table[layer]);
    }
    g_free(shadows->table);
    g_free(shadows->reach);
    g_free(shadows->shade);
    g_free(shadows->light);
    g_free(shadows);
}

// ---- casting ----------------------------------------------------------------------------------

typedef struct Cast {
    FrShadows *shadows;
    const vec3s *points;
    size_t count;
    bool is_taken;
} Cast;

/// The voxel of a point, each number within ±2^30.
static void voxel_of(const FrShadowSettings *settings, vec3s point, int voxel[3]) {
    for (int axis = 0; axis < 3; axis++) {
        double at = floor(((double)point.raw[axis] - settings->origin[axis]) / settings->cell);
        voxel[axis] = (int)fmin(fmax(at, -0x1.0p30), 0x1.0p30); // NaN goes to the lowest
    }
}

/// One layer of the pyramid below a voxel; `z` is within the grid.
static void cast_layer(const Cast *cast, const int voxel[3], int z) {
    const FrShadows *shadows = cast->shadows;
    const int *cells = shadows->settings.cells;
    int layer = voxel[2] - z;
    int reach = shadows->reach[layer];
    int left = MAX(voxel[0] - reach, 0);
    int right = MIN(voxel[0] + reach, cells[0] - 1);
    int front = MAX(voxel[1] - reach, 0);
    int back = MIN(voxel[1] + reach, cells[1] - 1);
    for (int y = front; y <= back && left <= right; y++) {
        uint32_t *row =
            shadows->shade + ((size_t)z * (size_t)cells[1] + (size_t)y) * (size_t)cells[0];
        const uint32_t *table =
            shadows->table[layer] + (y - voxel[1] + reach) * (2 * reach + 1) - voxel[0] + reach;
        if (cast->is_taken) {
            for (int x = left; x <= right; x++) {
                row[x] -= table[x];
            }
        } else {
            for (int x = left; x <= right; x++) {
                row[x] += table[x];
            }
        }
    }
}

/// All points into the layers begin … end − 1: no other thread writes there.
static void cast_layers(void *data, size_t begin, size_t end, int worker) {
    const Cast *cast = data;
    const FrShadowSettings *settings = &cast->shadows->settings;
    (void)worker;
    for (size_t i = 0; i < cast->count; i++) {
        int voxel[3];
        voxel_of(settings, cast->points[i], voxel);
        int top = MIN(voxel[2], (int)end - 1);
        int bottom = MAX(voxel[2] - settings->depth, (int)begin);
        for (int z = bottom; z <= top; z++) {
            cast_layer(cast, voxel, z);
        }
    }
}

/// Notes where the shadows of points fall.
static void note_changed(FrShadows *shadows, const vec3s *points, size_t count) {
    const FrShadowSettings *settings = &shadows->settings;
    int aside = settings->depth * settings->spread;
    Box *box = &shadows->changed;
    for (size_t i = 0; i < count; i++) {
        int voxel[3];
        voxel_of(settings, points[i], voxel);
        for (int axis = 0; axis < 3; axis++) {
            int below = axis == 2 ? settings->depth : aside, above = axis == 2 ? 0 : aside;
            int low = CLAMP(voxel[axis] - below, 0, settings->cells[axis] - 1);
            int high = CLAMP(voxel[axis] + above, 0, settings->cells[axis] - 1) + 1;
            box->low[axis] = MIN(box->low[axis], low);
            box->high[axis] = MAX(box->high[axis], high);
        }
    }
}

void fr_shadows_cast(FrShadows *shadows, const vec3s *points, size_t count, bool is_taken,
                     const FrContext *context) {
    note_changed(shadows, points, count);
    Cast cast = {shadows, points, count, is_taken};
    size_t layers = (size_t)shadows->settings.cells[2];
    size_t grain = context->pool == NULL ? layers : LAYERS_A_CHUNK;
    fr_parallel_for(context->pool, layers, grain, cast_layers, &cast, NULL);
}

// ---- light ------------------------------------------------------------------------------------

/// A part of full light, the same for a voxel always, in the uneven light of `jitter`.
static double unevenness(const FrShadowSettings *settings, size_t index) {
    return settings->jitter > 0
               ? 1 - settings->jitter * fr_random(fr_key_root(settings->seed), 0, (uint32_t)index)
               : 1;
}

static double light_of(const FrShadows *shadows, size_t index) {
    const FrShadowSettings *settings = &shadows->settings;
    double shade = (double)shadows->shade[index] / ONE;
    double even = unevenness(settings, index);
    if (settings->form == FR_SHADOWS_MULTIPLY) {
        return even * exp2(-shade);
    }
    double left = settings->full - shade + (shade > 0 ? settings->a : 0);
    return even * fmin(fmax(left / settings->full, 0), 1);
}

static bool is_in(const Box *box, int x, int y, int z) {
    return x >= box->low[0] && x < box->high[0] && y >= box->low[1] && y < box->high[1] &&
           z >= box->low[2] && z < box->high[2];
}

static double voxel_light(const FrShadows *shadows, int x, int y, int z) {
    const int *cells = shadows->settings.cells;
    if (x < 0 || y < 0 || z < 0 || x >= cells[0] || y >= cells[1] || z >= cells[2]) {
        return 1;
    }
    size_t index = ((size_t)z * (size_t)cells[1] + (size_t)y) * (size_t)cells[0] + (size_t)x;
    return shadows->light == NULL || is_in(&shadows->changed, x, y, z)
               ? light_of(shadows, index)
               : (double)shadows->light[index];
}

static void settle_layers(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrShadows *shadows = data;
    const int *cells = shadows->settings.cells;
    const Box *box = &shadows->changed;
    for (size_t layer = begin; layer < end; layer++) {
        size_t z = (size_t)box->low[2] + layer;
        for (int y = box->low[1]; y < box->high[1]; y++) {
            size_t row = (z * (size_t)cells[1] + (size_t)y) * (size_t)cells[0];
            for (int x = box->low[0]; x < box->high[0]; x++) {
                shadows->light[row + (size_t)x] = (float)light_of(shadows, row + (size_t)x);
            }
        }
    }
}

void fr_shadows_settle(FrShadows *shadows, const FrContext *context) {
    const int *cells = shadows->settings.cells;
    Box *box = &shadows->changed;
    if (shadows->light == NULL) {
        shadows->light = g_new(float, (size_t)cells[0] * (size_t)cells[1] * (size_t)cells[2]);
    }
    if (box->high[2] > box->low[2]) {
        size_t layers = (size_t)(box->high[2] - box->low[2]);
        fr_parallel_for(context->pool, layers, 1, settle_layers, shadows, NULL);
    }
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = cells[axis];
        box->high[axis] = 0;
    }
}

/// The eight voxels at `low` and above along each axis.
static void corners_of(const FrShadows *shadows, const int low[3], double corners[8]) {
    const int *cells = shadows->settings.cells;
    const Box *box = &shadows->changed;
    bool is_settled = shadows->light != NULL && box->high[0] <= box->low[0];
    bool is_inside = true;
    for (int axis = 0; axis < 3; axis++) {
        is_inside = is_inside && low[axis] >= 0 && low[axis] < cells[axis] - 1;
    }
    if (is_settled && is_inside) {
        size_t row = (size_t)cells[0], layer = row * (size_t)cells[1];
        const float *at =
            shadows->light + (size_t)low[2] * layer + (size_t)low[1] * row + (size_t)low[0];
        for (int corner = 0; corner < 8; corner++) {
            corners[corner] = (double)at[(size_t)(corner & 1) + (size_t)(corner >> 1 & 1) * row +
                                         (size_t)(corner >> 2) * layer];
        }
        return;
    }
    for (int corner = 0; corner < 8; corner++) {
        corners[corner] = voxel_light(shadows, low[0] + (corner & 1), low[1] + (corner >> 1 & 1),
                                      low[2] + (corner >> 2));
    }
}

/// Light at a place in voxels from the middle of the first one.
static double light_at(const FrShadows *shadows, const double place[3]) {
    double part[3], corners[8];
    int low[3];
    for (int axis = 0; axis < 3; axis++) {
        double at = place[axis] > -0x1.0p30 ? place[axis] : -0x1.0p30; // and what is no number
        at = at < 0x1.0p30 - 1 ? at : 0x1.0p30 - 1;
        low[axis] = (int)at - (at < (double)(int)at);
        part[axis] = at - (double)low[axis];
    }
    corners_of(shadows, low, corners);
    double sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        double weight =
            (x ? part[0] : 1 - part[0]) * (y ? part[1] : 1 - part[1]) * (z ? part[2] : 1 - part[2]);
        sum += weight * corners[corner];
    }
    return sum;
}

/// A point in voxels from the middle of the first one.
static void place_of(const FrShadows *shadows, vec3s point, double place[3]) {
    const FrShadowSettings *settings = &shadows->settings;
    for (int axis = 0; axis < 3; axis++) {
        place[axis] = ((double)point.raw[axis] - settings->origin[axis]) / settings->cell - 0.5;
    }
}

float fr_shadows_light(const FrShadows *shadows, vec3s point) {
    double place[3];
    place_of(shadows, point, place);
    return (float)light_at(shadows, place);
}

FrShadowSample fr_shadows_at(const FrShadows *shadows, vec3s point, double radius) {
    double place[3];
    place_of(shadows, point, place);
    vec3s slope;
    for (int axis = 0; axis < 3; axis++) {
        double before[3] = {place[0], place[1], place[2]};
        double behind[3] = {place[0], place[1], place[2]};
        before[axis] += radius;
        behind[axis] -= radius;
        slope.raw[axis] =
            (float)((light_at(shadows, before) - light_at(shadows, behind)) / (2 * radius));
    }
    float steep = glms_vec3_norm(slope);
    return (FrShadowSample){
        .light = (float)light_at(shadows, place),
        .direction = steep > 1e-9f ? glms_vec3_scale(slope, 1 / steep) : (vec3s){{0, 0, 1}},
        .slope = steep,
    };
}

FrDigest fr_shadows_digest(const FrShadows *shadows) {
    const int *cells = shadows->settings.cells;
    size_t count = (size_t)cells[0] * (size_t)cells[1] * (size_t)cells[2];
    return fr_digest(0, shadows->shade, count * sizeof *shadows->shade);
}
