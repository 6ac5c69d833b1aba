// Path tracing (Kajiya 1986, The Rendering Equation) with light sampled at every surface and
// multiple importance sampling of the sky and of lamps by the power heuristic (Veach, Guibas 1995).
// The sun's disc is so small that only light sampling ever finds it.
#include "render/path.h"

#include "render/colour.h"

#include <math.h>

enum {
    SKY_SAMPLED_BOUNCES = 2, ///< deeper surfaces find the sky only by their own directions
    ROULETTE_BOUNCES = 2,    ///< from here on dim paths end at random
};

// A single indirect contribution may be this many times as bright as white ground in full light.
#define BRIGHTEST_INDIRECT 3.0f
#define BRIGHTEST_DIRECT 60.0f

typedef struct Path {
    const FrWorld *world;
    FrSampler *sampler;
    vec3s radiance, throughput;
    float white; ///< luminance of white ground in full light
    bool is_indirect;
} Path;

static void add_light(Path *path, vec3s light) {
    vec3s brought = glms_vec3_mul(path->throughput, light);
    float limit = path->white * (path->is_indirect ? BRIGHTEST_INDIRECT : BRIGHTEST_DIRECT);
    float luminance = fr_luminance(brought);
    if (luminance > limit) {
        brought = glms_vec3_scale(brought, limit / luminance);
    }
    path->radiance = glms_vec3_add(path->radiance, brought);
}

static vec3s start_point(const FrSurface *surface, vec3s direction) {
    return glms_vec3_dot(direction, surface->bsdf.side) > 0.0f ? surface->point : surface->below;
}

static void add_sun(Path *path, const FrSurface *surface, vec3s out) {
    const FrSky *sky = path->world->sky;
    float u;
    float v;
    fr_sampler_pair(path->sampler, &u, &v);
    if (fr_is_black(sky->sun_irradiance)) {
        return;
    }
    vec3s in = fr_sky_sample_sun(sky, u, v);
    vec3s scattered = fr_bsdf_eval(&surface->bsdf, out, in);
    if (fr_is_black(scattered) ||
        fr_world_is_blocked(path->world, start_point(surface, in), in, INFINITY)) {
        return;
    }
    add_light(path, glms_vec3_mul(scattered, sky->sun_irradiance));
}

static float power_weight(float density, float other) {
    float a = density * density;
    return a / (a + other * other);
}

/// `is_only` if no direction sampled from the surface will look for the sky.
static void add_sky(Path *path, const FrSurface *surface, vec3s out, bool is_only) {
    const FrSky *sky = path->world->sky;
    float u;
    float v;
    fr_sampler_pair(path->sampler, &u, &v);
    float density;
    vec3s in = fr_sky_sample(sky, u, v, &density);
    if (!(density > 0.0f)) {
        return;
    }
    vec3s scattered = fr_bsdf_eval(&surface->bsdf, out, in);
    if (fr_is_black(scattered) ||
        fr_world_is_blocked(path->world, start_point(surface, in), in, INFINITY)) {
        return;
    }
    float weight = is_only ? 1.0f : power_weight(density, fr_bsdf_density(&surface->bsdf, out, in));
    vec3s light = glms_vec3_scale(fr_sky_radiance(sky, in), weight / density);
    add_light(path, glms_vec3_mul(scattered, light));
}

/// As add_sky(), with the lamps.
static void add_lamps(Path *path, const FrSurface *surface, vec3s out, bool is_only) {
    const FrLampSet *lamps = &path->world->lamps;
    if (lamps->count == 0) {
        return;
    }
    float u;
    float v;
    fr_sampler_pair(path->sampler, &u, &v);
    FrLampSight sight =
        fr_lamps_sample(lamps, surface->point, fr_sampler_single(path->sampler), u, v);
    if (fr_is_black(sight.radiance)) {
        return;
    }
    vec3s scattered = fr_bsdf_eval(&surface->bsdf, out, sight.direction);
    vec3s from = start_point(surface, sight.direction);
    float far = sight.distance * (1.0f - 1e-4f) - 1e-5f;
    if (fr_is_black(scattered) || fr_world_is_blocked(path->world, from, sight.direction, far)) {
        return;
    }
    float other = fr_bsdf_density(&surface->bsdf, out, sight.direction);
    float weight = is_only ? 1.0f : power_weight(sight.density, other);
    vec3s light = glms_vec3_scale(sight.radiance, weight / sight.density);
    add_light(path, glms_vec3_mul(scattered, light));
}

/// True if a lamp stands before what is `far` away; its light has been added.
static bool meet_lamp(Path *path, vec3s origin, vec3s direction, float far, uint32_t bounce,
                      float density) {
    FrLampSight sight;
    if (!fr_lamps_meet(&path->world->lamps, origin, direction, far, &sight)) {
        return false;
    }
    float weight = bounce == 0 ? 1.0f : power_weight(density, sight.density);
    if (!fr_is_black(sight.radiance)) {
        add_light(path, glms_vec3_scale(sight.radiance, weight));
    }
    return true;
}

/// Distant ground dissolves into the horizon: returns false if nothing of it is left.
static bool pass_haze(Path *path, vec3s direction, float distance) {
    float haze = path->world->ground->haze;
    float far = distance / haze;
    float part = isinf(haze) ? 0.0f : 1.0f - expf(-far * far / (1.0f + far));
    if (part <= 0.0f) {
        return true;
    }
    vec3s level = {{direction.x, direction.y, 0.0f}};
    vec3s horizon = fr_sky_radiance(path->world->sky, glms_vec3_normalize(level));
    add_light(path, glms_vec3_scale(horizon, part));
    path->throughput = glms_vec3_scale(path->throughput, 1.0f - part);
    return part < 0.999f;
}

static void meet_sky(Path *path, vec3s direction, uint32_t bounce, float density) {
    const FrSky *sky = path->world->sky;
    vec3s light = fr_sky_radiance(sky, direction);
    if (bounce == 0) {
        light = glms_vec3_add(light, fr_sky_sun_radiance(sky, direction));
    } else if (bounce <= SKY_SAMPLED_BOUNCES) {
        float other = fr_sky_density(sky, direction);
        light = glms_vec3_scale(light, power_weight(density, other));
    }
    add_light(path, light);
}

/// Ends dim paths at random; the survivors carry the light of those that ended.
static bool survives(Path *path, uint32_t bounce) {
    float chance = fmaxf(fmaxf(path->throughput.r, path->throughput.g), path->throughput.b);
    if (bounce < ROULETTE_BOUNCES) {
        return chance > 0.0f;
    }
    chance = fminf(chance * 1.5f, 1.0f);
    if (!(fr_sampler_single(path->sampler) < chance)) {
        return false;
    }
    path->throughput = glms_vec3_scale(path->throughput, 1.0f / chance);
    return true;
}

FrPathSample fr_path_trace(const FrWorld *world, vec3s origin, vec3s direction, FrSampler *sampler,
                           uint32_t bounces) {
    Path path = {
        .world = world,
        .sampler = sampler,
        .throughput = glms_vec3_one(),
        .white = fr_luminance(world->white) / FR_PI_F,
    };
    FrPathSample sample = {.albedo = glms_vec3_one(), .is_sky = true};
    float density = 0.0f;
    for (uint32_t bounce = 0; bounce <= bounces; bounce++) {
        FrSurface surface;
        FrMet met = fr_world_trace(world, origin, direction, &surface);
        path.is_indirect = bounce > 0;
        if (meet_lamp(&path, origin, direction, surface.distance, bounce, density)) {
            break;
        }
        if (met == FR_MET_SKY) {
            meet_sky(&path, direction, bounce, density);
            break;
        }
        vec3s out = glms_vec3_negate(direction);
        if (bounce == 0) {
            sample.albedo = glms_vec3_add(surface.bsdf.reflectance, surface.bsdf.transmittance);
            sample.normal = surface.bsdf.normal;
            sample.is_sky = false;
            if (met == FR_MET_GROUND && !pass_haze(&path, direction, surface.distance)) {
                sample.is_sky = true;
                break;
            }
        }
        bool is_last = bounce == bounces;
        add_sun(&path, &surface, out);
        if (bounce < SKY_SAMPLED_BOUNCES || is_last) {
            add_sky(&path, &surface, out, is_last);
        }
        add_lamps(&path, &surface, out, is_last);
        float u;
        float v;
        fr_sampler_pair(sampler, &u, &v);
        vec3s factor;
        if (is_last || !fr_bsdf_sample(&surface.bsdf, out, fr_sampler_single(sampler), u, v,
                                       &direction, &factor, &density)) {
            break;
        }
        path.throughput = glms_vec3_mul(path.throughput, factor);
        if (!survives(&path, bounce)) {
            break;
        }
        origin = start_point(&surface, direction);
    }
    sample.radiance = path.radiance;
    return sample;
}
