// Views of the sky by rays. A sun is one view, a lamp a few points, the sky a Fibonacci lattice of
// directions that stand for equal solid angles.
#include "frond/sky_views.h"

#include "light/backend.h"

#include <cglm/struct.h>
#include <glib.h>
#include <math.h>
#include <stdatomic.h>

enum {
    AREA_POINTS = 4, ///< along each side of an area lamp
    SURFACES = 64,   ///< that light may come through
    POINTS_A_CHUNK = 16,
};

// What is left of light that counts no more.
#define DARKEST 0.004f

/// Where to look. A direction if it is of the sky, else a place.
typedef struct View {
    vec3s at;
    float weight; ///< fluence, for a lamp at a distance of 1 m
    bool is_far;
    float cosine; ///< lamps: half the opening of the cone; 0 half a sphere; −1 all around
    vec3s axis;   ///< lamps: of the cone, or of the lit side
    bool is_matt; ///< lamps: by Lambert's law
} View;

typedef struct SkyViews {
    FrLight light;
    FrSkyViewSettings settings;
    FrRays *rays;
    FrMaskFn mask;
    void *mask_user;
    FrLightMesh *meshes; ///< copies of the scene's; what they point to is borrowed
    GArray *views;       ///< View
    float open;          ///< fluence under open sky; 0: no sun, no sky
    bool has_translucent;
    atomic_uint_fast64_t traced;
} SkyViews;

FrSkyViewSettings fr_sky_views_default(void) {
    return (FrSkyViewSettings){.count = 20, .near = 0.02f};
}

// ---- views ------------------------------------------------------------------------------------

static void add_view(SkyViews *sky, View view) {
    if (view.weight > 0 && isfinite(view.weight)) {
        g_array_append_val(sky->views, view);
    }
}

/// Points on an area lamp, each for its part of the lamp.
static void add_area(SkyViews *sky, const FrLamp *lamp) {
    vec3s normal = glms_vec3_cross(lamp->side[0], lamp->side[1]);
    for (int i = 0; i < AREA_POINTS * AREA_POINTS; i++) {
        float a = ((float)(i % AREA_POINTS) + 0.5f) / AREA_POINTS;
        float b = ((float)(i / AREA_POINTS) + 0.5f) / AREA_POINTS;
        vec3s at = glms_vec3_muladds(lamp->side[0], a, lamp->position);
        add_view(sky, (View){.at = glms_vec3_muladds(lamp->side[1], b, at),
                             .weight = (float)(lamp->power / (G_PI * AREA_POINTS * AREA_POINTS)),
                             .axis = glms_vec3_normalize(normal),
                             .is_matt = true});
    }
}

static void add_lamp(SkyViews *sky, const FrLamp *lamp) {
    float power = (float)lamp->power;
    if (lamp->kind == FR_LAMP_SUN) {
        add_view(sky, (View){.at = glms_vec3_negate(glms_vec3_normalize(lamp->direction)),
                             .weight = power,
                             .is_far = true});
    } else if (lamp->kind == FR_LAMP_POINT) {
        add_view(sky,
                 (View){.at = lamp->position, .weight = power / (float)(4 * G_PI), .cosine = -1});
    } else if (lamp->kind == FR_LAMP_SPOT) {
        float cosine = cosf(lamp->angle);
        add_view(sky, (View){.at = lamp->position,
                             .weight = power / (float)(2 * G_PI * (1 - (double)cosine)),
                             .cosine = cosine,
                             .axis = glms_vec3_normalize(lamp->direction)});
    } else if (lamp->kind == FR_LAMP_AREA) {
        add_area(sky, lamp);
    }
}

/// Radiance per power, from what one watt on level ground asks of the zenith: π for an even sky,
/// 7π/9 for an overcast one; that of a clear one is summed over the sky.
static double zenith_of(const FrLamp *lamp) {
    enum { RINGS = 32, SECTORS = 64 };
    if (lamp->sky != FR_SKY_CLEAR) {
        return lamp->power / (lamp->sky == FR_SKY_UNIFORM ? G_PI : 7 * G_PI / 9);
    }
    double sum = 0;
    for (int i = 0; i < RINGS * SECTORS; i++) {
        double height = (i / SECTORS + 0.5) / RINGS, side = sqrt(1 - height * height);
        double turn = 2 * G_PI * (i % SECTORS + 0.5) / SECTORS;
        vec3s direction = {{(float)(side * cos(turn)), (float)(side * sin(turn)), (float)height}};
        sum += height * fr_lamp_sky_brightness(lamp, direction);
    }
    return lamp->power * RINGS * SECTORS / (2 * G_PI * sum);
}

static void add_sky(SkyViews *sky, const FrLightScene *scene, size_t count) {
    double *zeniths = g_new0(double, scene->lamp_count);
    for (uint32_t i = 0; i < scene->lamp_count; i++) {
        if (scene->lamps[i].kind == FR_LAMP_SKY && scene->lamps[i].power > 0) {
            zeniths[i] = zenith_of(&scene->lamps[i]);
        }
    }
    const double golden = G_PI * (3.0 - sqrt(5.0));
    for (size_t k = 0; k < count; k++) {
        double height = ((double)k + 0.5) / (double)count;
        double side = sqrt(1.0 - height * height), turn = golden * (double)k;
        vec3s direction = {{(float)(side * cos(turn)), (float)(side * sin(turn)), (float)height}};
        double light = 0;
        for (uint32_t i = 0; i < scene->lamp_count; i++) {
            if (zeniths[i] > 0) {
                light += zeniths[i] * fr_lamp_sky_brightness(&scene->lamps[i], direction);
            }
        }
        add_view(sky, (View){.at = direction,
                             .weight = (float)(light * 2 * G_PI / (double)count),
                             .is_far = true});
    }
    g_free(zeniths);
}

static void make_views(SkyViews *sky, const FrLightScene *scene) {
    g_array_set_size(sky->views, 0);
    size_t suns = 0;
    bool has_sky = false;
    for (uint32_t i = 0; i < scene->lamp_count; i++) {
        suns += scene->lamps[i].kind == FR_LAMP_SUN;
        has_sky |= scene->lamps[i].kind == FR_LAMP_SKY;
        add_lamp(sky, &scene->lamps[i]);
    }
    if (has_sky) {
        size_t count = (size_t)sky->settings.count;
        add_sky(sky, scene, count > suns ? count - suns : 1);
    }
    sky->open = 0;
    for (guint i = 0; i < sky->views->len; i++) {
        View *view = &g_array_index(sky->views, View, i);
        if (view->is_far) {
            view->weight = sky->settings.is_even ? 1 : view->weight;
            sky->open += view->weight;
        }
    }
}

// ---- scene ------------------------------------------------------------------------------------

static bool lets_through(const FrOptics *optics) {
    return optics->transmit_diffuse + optics->transmit_specular > 0;
}

static void clear_scene(SkyViews *sky) {
    fr_rays_free(sky->rays);
    g_free(sky->meshes);
    sky->rays = NULL;
    sky->meshes = NULL;
}

/// Asked by rays, from any thread.
static bool is_hole(void *user, uint32_t mesh, uint32_t part, uint32_t triangle, float u, float v) {
    const SkyViews *sky = user;
    uint32_t mask = sky->meshes[mesh].materials[part].mask;
    if (mask == 0) {
        return false;
    }
    float uv[2];
    fr_mesh_uv(sky->meshes[mesh].mesh, part, triangle, u, v, uv);
    return sky->mask(sky->mask_user, mask, uv[0], uv[1]);
}

static FrStatus set_scene(FrLight *light, const FrLightScene *scene, const FrContext *context) {
    SkyViews *sky = (SkyViews *)light;
    (void)context;
    clear_scene(sky);
    make_views(sky, scene);
    sky->meshes = g_memdup2(scene->meshes, scene->mesh_count * sizeof *scene->meshes);
    sky->mask = scene->mask;
    sky->mask_user = scene->mask_user;
    sky->rays = fr_rays_new(scene->mask != NULL ? is_hole : NULL, sky);
    sky->has_translucent = false;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const FrLightMesh *mesh = &scene->meshes[i];
        fr_rays_add_mesh(sky->rays, mesh->mesh);
        for (uint32_t part = 0; part < mesh->mesh->part_count; part++) {
            const FrLightMaterial *material = &mesh->materials[part];
            sky->has_translucent |= lets_through(&material->front) || lets_through(&material->back);
        }
    }
    for (uint32_t i = 0; i < scene->stand_count; i++) {
        fr_rays_add_stand(sky->rays, scene->stands[i].mesh, scene->stands[i].transform);
    }
    fr_rays_commit(sky->rays);
    return FR_OK;
}

// ---- looking ----------------------------------------------------------------------------------

/// What comes through from `far` metres away.
static float passes(const SkyViews *sky, vec3s point, vec3s direction, float far) {
    float near = sky->settings.near;
    if (far <= near || !fr_rays_is_blocked(sky->rays, point, direction, near, far)) {
        return 1;
    }
    float left = sky->has_translucent ? 1 : 0;
    for (int i = 0; i < SURFACES && left > DARKEST; i++) {
        FrHit hit = fr_rays_trace(sky->rays, point, direction, near, far);
        if (isinf(hit.distance)) {
            return left;
        }
        const FrLightMaterial *material = &sky->meshes[hit.mesh].materials[hit.part];
        // Light comes towards us and arrives on the side that we do not see.
        bool is_front = glms_vec3_dot(hit.normal, direction) > 0;
        const FrOptics *optics = is_front ? &material->front : &material->back;
        left *= optics->transmit_diffuse + optics->transmit_specular;
        near = hit.distance * (1 + 1e-5f) + 1e-6f;
    }
    return left > DARKEST ? left : 0;
}

/// The direction of a view from a point and the light from there if nothing is in the way.
static float look(const View *view, vec3s point, vec3s *direction, float *far) {
    if (view->is_far) {
        *direction = view->at;
        *far = INFINITY;
        return view->weight;
    }
    vec3s way = glms_vec3_sub(view->at, point);
    float distance = glms_vec3_norm(way);
    if (!(distance > 1e-6f)) {
        return 0;
    }
    *direction = glms_vec3_scale(way, 1 / distance);
    *far = distance * (1 - 1e-5f);
    float cosine = -glms_vec3_dot(view->axis, *direction);
    if (view->cosine > -1 && cosine < view->cosine) {
        return 0;
    }
    return view->weight * (view->is_matt ? fmaxf(cosine, 0) : 1) / (distance * distance);
}

static FrLightAnswer answer_at(const SkyViews *sky, vec3s point) {
    FrLightAnswer answer = {0};
    vec3s sum = glms_vec3_zero(), brightest = glms_vec3_zero();
    float most = 0;
    for (guint i = 0; i < sky->views->len; i++) {
        vec3s direction;
        float far;
        float light = look(&g_array_index(sky->views, View, i), point, &direction, &far);
        light = light > 0 ? light * passes(sky, point, direction, far) : 0;
        if (!(light > 0)) {
            continue;
        }
        answer.samples++;
        answer.intensity += light;
        sum = glms_vec3_muladds(direction, light, sum);
        if (light > most * 1.0001f) {
            most = light;
            brightest = direction;
        } else if (light > most * 0.9999f) {
            brightest = glms_vec3_add(brightest, direction);
        }
    }
    float length = glms_vec3_norm(sum);
    answer.confidence = answer.intensity > 0 ? fminf(length / answer.intensity, 1) : 0;
    vec3s towards = sky->settings.is_mean ? sum : brightest;
    float norm = glms_vec3_norm(towards);
    answer.direction = norm > 1e-4f * most ? glms_vec3_scale(towards, 1 / norm) : glms_vec3_zero();
    answer.intensity /= sky->open > 0 ? sky->open : 1;
    return answer;
}

typedef struct Query {
    SkyViews *sky;
    const vec3s *points;
    FrLightAnswer *answers;
} Query;

static void answer_points(void *data, size_t begin, size_t end, int worker) {
    const Query *query = data;
    (void)worker;
    for (size_t i = begin; i < end; i++) {
        query->answers[i] = answer_at(query->sky, query->points[i]);
    }
    atomic_fetch_add(&query->sky->traced, (end - begin) * query->sky->views->len);
}

static FrStatus query_points(FrLight *light, const vec3s *points, size_t count,
                             const FrContext *context, FrLightAnswer *answers) {
    Query query = {(SkyViews *)light, points, answers};
    fr_parallel_for(context->pool, count, POINTS_A_CHUNK, answer_points, &query, context->progress);
    return fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
}

static void count_stats(const FrLight *light, FrLightStats *stats) {
    stats->rays = atomic_load(&((const SkyViews *)light)->traced);
}

static void free_views(FrLight *light) {
    SkyViews *sky = (SkyViews *)light;
    clear_scene(sky);
    g_array_unref(sky->views);
    g_free(sky);
}

FrLight *fr_sky_views_new(const FrSkyViewSettings *settings) {
    static const FrLightBackend backend = {
        .set_scene = set_scene, .query = query_points, .stats = count_stats, .free = free_views};
    SkyViews *sky = g_new0(SkyViews, 1);
    sky->light.backend = &backend;
    sky->settings = *settings;
    sky->views = g_array_new(FALSE, FALSE, sizeof(View));
    return &sky->light;
}
