// Shadow voxels as a backend: the surfaces of the scene are cut into pieces smaller than a voxel,
// the pieces of a voxel summed up in whole numbers, and each voxel casts for its area.
#include "frond/shadows.h"

#include "light/backend.h"

#include <cglm/struct.h>
#include <math.h>

enum {
    PIECES = 4,        ///< of a voxel's width along a triangle's side
    MOST_PIECES = 512, ///< along the side of one triangle
    AREA_STEPS = 1024, ///< in which area is counted, of the face of a voxel
    MOST_SHADOWS = 16, ///< that a voxel casts
};

// How far around a point the slope of light is taken, in voxels (the constant of the authors'
// program).
#define SLOPE_RADIUS 1.6

typedef struct ShadowLight {
    FrLight light;
    FrShadowLightSettings settings;
    FrShadows *shadows;
    bool is_dark; ///< neither sun nor sky shines
} ShadowLight;

FrShadowLightSettings fr_shadow_light_default(void) {
    FrShadowSettings base = fr_shadows_default();
    return (FrShadowLightSettings){.form = base.form,
                                   .a = base.a,
                                   .b = base.b,
                                   .full = base.full,
                                   .depth = base.depth,
                                   .cell = 0.2,
                                   .cells = 8000000};
}

typedef void (*TriangleFn)(void *data, const vec3s corners[3]);

static void for_each_triangle(const FrLightScene *scene, TriangleFn take, void *data) {
    for (uint32_t s = 0; s < scene->stand_count; s++) {
        const FrMesh *mesh = scene->meshes[scene->stands[s].mesh].mesh;
        for (uint32_t p = 0; p < mesh->part_count; p++) {
            const FrMeshPart *part = &mesh->parts[p];
            const FrVertex *vertices = mesh->vertices + part->first_vertex;
            const uint32_t *index = mesh->indices + part->first_index;
            for (uint64_t i = 0; i + 2 < part->index_count; i += 3) {
                vec3s corners[3];
                for (int c = 0; c < 3; c++) {
                    const float *at = vertices[index[i + (uint64_t)c]].position;
                    vec3s local = {{at[0], at[1], at[2]}};
                    corners[c] = glms_mat4_mulv3(scene->stands[s].transform, local, 1);
                }
                take(data, corners);
            }
        }
    }
}

typedef struct Box {
    double min[3], max[3];
} Box;

static void grow_box(void *data, const vec3s corners[3]) {
    Box *box = data;
    for (int c = 0; c < 3; c++) {
        for (int axis = 0; axis < 3 && isfinite(corners[c].raw[axis]); axis++) {
            box->min[axis] = fmin(box->min[axis], (double)corners[c].raw[axis]);
            box->max[axis] = fmax(box->max[axis], (double)corners[c].raw[axis]);
        }
    }
}

/// The grid around the scene, with room for the pyramids at its sides.
static FrShadowSettings grid_of(const ShadowLight *light, const FrLightScene *scene) {
    const FrShadowLightSettings *wanted = &light->settings;
    Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for_each_triangle(scene, grow_box, &box);
    FrShadowSettings grid = {.form = wanted->form,
                             .a = wanted->a,
                             .b = wanted->b,
                             .full = wanted->full,
                             .depth = (int)wanted->depth,
                             .spread = 1,
                             .cell = wanted->cell};
    double count;
    do {
        count = 1;
        for (int axis = 0; axis < 3; axis++) {
            bool is_empty = !(box.min[axis] <= box.max[axis]);
            double low = is_empty ? 0 : floor(box.min[axis] / grid.cell) - grid.depth;
            double high = is_empty ? 1 : floor(box.max[axis] / grid.cell) + 1 + grid.depth;
            grid.origin[axis] = low * grid.cell;
            count *= high - low;
            grid.cells[axis] = (int)fmin(high - low, INT32_MAX);
        }
        grid.cell *= count > (double)wanted->cells ? 1.25 : 1;
    } while (count > (double)wanted->cells);
    return grid;
}

typedef struct Cover {
    const FrShadowSettings *grid;
    uint32_t *area; ///< by voxel
} Cover;

static void add_piece(const Cover *cover, vec3s at, uint32_t area) {
    const FrShadowSettings *grid = cover->grid;
    size_t index = 0;
    for (int axis = 2; axis >= 0; axis--) {
        double cell = floor(((double)at.raw[axis] - grid->origin[axis]) / grid->cell);
        if (!(cell >= 0 && cell < grid->cells[axis])) {
            return;
        }
        index = index * (size_t)grid->cells[axis] + (size_t)cell;
    }
    cover->area[index] =
        (uint32_t)MIN((uint64_t)cover->area[index] + area, (uint64_t)MOST_SHADOWS * AREA_STEPS);
}

static void cover_triangle(void *data, const vec3s corners[3]) {
    const Cover *cover = data;
    vec3s a = glms_vec3_sub(corners[1], corners[0]), b = glms_vec3_sub(corners[2], corners[0]);
    double longest = fmax((double)fmaxf(glms_vec3_norm(a), glms_vec3_norm(b)),
                          (double)glms_vec3_norm(glms_vec3_sub(a, b)));
    double area = 0.5 * (double)glms_vec3_norm(glms_vec3_cross(a, b));
    if (!isfinite(area)) {
        return;
    }
    double cell = cover->grid->cell;
    int steps = (int)fmin(fmax(ceil(PIECES * longest / cell), 1), MOST_PIECES);
    double part = area / (cell * cell) * AREA_STEPS / ((double)steps * steps);
    uint32_t counted = (uint32_t)fmin(fmax(ceil(part), 1), MOST_SHADOWS * AREA_STEPS);
    // Small triangles that point up and, between them, that point down.
    for (int i = 0; i < steps; i++) {
        for (int j = 0; j < 2 * (steps - i) - 1; j++) {
            float third = (j & 1) != 0 ? 2.0f / 3 : 1.0f / 3;
            float u = ((float)i + third) / (float)steps;
            float v = ((float)(j / 2) + third) / (float)steps;
            vec3s at = glms_vec3_muladds(a, u, corners[0]);
            add_piece(cover, glms_vec3_muladds(b, v, at), counted);
        }
    }
}

/// The middles of covered voxels, each as often as it casts.
static GArray *casting_points(const FrShadowSettings *grid, const uint32_t *area) {
    GArray *points = g_array_new(FALSE, FALSE, sizeof(vec3s));
    size_t index = 0;
    for (int z = 0; z < grid->cells[2]; z++) {
        for (int y = 0; y < grid->cells[1]; y++) {
            for (int x = 0; x < grid->cells[0]; x++, index++) {
                vec3s at = {{(float)(grid->origin[0] + (x + 0.5) * grid->cell),
                             (float)(grid->origin[1] + (y + 0.5) * grid->cell),
                             (float)(grid->origin[2] + (z + 0.5) * grid->cell)}};
                uint32_t shadows =
                    area[index] == 0 ? 0 : MAX((area[index] + AREA_STEPS / 2) / AREA_STEPS, 1);
                for (uint32_t i = 0; i < shadows; i++) {
                    g_array_append_val(points, at);
                }
            }
        }
    }
    return points;
}

static bool has_daylight(const FrLightScene *scene) {
    for (uint32_t i = 0; i < scene->lamp_count; i++) {
        const FrLamp *lamp = &scene->lamps[i];
        if ((lamp->kind == FR_LAMP_SUN || lamp->kind == FR_LAMP_SKY) && lamp->power > 0) {
            return true;
        }
    }
    return false;
}

static FrStatus set_scene(FrLight *base, const FrLightScene *scene, const FrContext *context) {
    ShadowLight *light = (ShadowLight *)base;
    fr_shadows_free(light->shadows);
    light->shadows = NULL;
    light->is_dark = !has_daylight(scene);
    FrShadowSettings grid = grid_of(light, scene);
    size_t count = (size_t)grid.cells[0] * (size_t)grid.cells[1] * (size_t)grid.cells[2];
    FrStatus status =
        fr_limit_check(fr_count_multiply(count, 2 * sizeof(uint32_t)), context->limits.bytes,
                       "bytes", "the light", light->settings.span, context->diags);
    if (status == FR_OK) {
        status = fr_shadows_new(&grid, context, &light->shadows);
    }
    if (status != FR_OK) {
        return status;
    }
    Cover cover = {&grid, g_new0(uint32_t, count)};
    for_each_triangle(scene, cover_triangle, &cover);
    GArray *points = casting_points(&grid, cover.area);
    fr_shadows_cast(light->shadows, (const vec3s *)(const void *)points->data, points->len, false,
                    context);
    g_array_unref(points);
    g_free(cover.area);
    return FR_OK;
}

static FrStatus query(FrLight *base, const vec3s *points, size_t count, const FrContext *context,
                      FrLightAnswer *answers) {
    const ShadowLight *light = (const ShadowLight *)base;
    (void)context;
    for (size_t i = 0; i < count; i++) {
        FrShadowSample sample = fr_shadows_at(light->shadows, points[i], SLOPE_RADIUS);
        answers[i] = (FrLightAnswer){.intensity = sample.light,
                                     .direction = sample.direction,
                                     .confidence = fminf(sample.slope * 4, 1),
                                     .samples = 1};
        if (light->is_dark) {
            answers[i] = (FrLightAnswer){.samples = 1};
        }
    }
    return FR_OK;
}

static void count_stats(const FrLight *base, FrLightStats *stats) {
    (void)base;
    (void)stats;
}

static void free_light(FrLight *base) {
    ShadowLight *light = (ShadowLight *)base;
    fr_shadows_free(light->shadows);
    g_free(light);
}

FrLight *fr_shadow_light_new(const FrShadowLightSettings *settings) {
    static const FrLightBackend backend = {
        .set_scene = set_scene, .query = query, .stats = count_stats, .free = free_light};
    ShadowLight *light = g_new0(ShadowLight, 1);
    light->light.backend = &backend;
    light->settings = *settings;
    return &light->light;
}
