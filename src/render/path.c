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
    float white;      ///< luminance of white ground in full light
    bool is_indirect; ///< light was scattered on the way, not only mirrored or let through
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

/// Adds what comes through of light from that way.
static void add_passing(Path *path, vec3s from, vec3s in, float far, vec3s light) {
    vec3s passing = fr_world_passes(path->world, from, in, far);
    if (!fr_is_black(passing)) {
        add_light(path, glms_vec3_mul(passing, light));
    }
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
    if (!fr_is_black(scattered)) {
        add_passing(path, start_point(surface, in), in, INFINITY,
                    glms_vec3_mul(scattered, sky->sun_irradiance));
    }
}

/// The weight of a direction that was sampled with `density`; an infinite one, of eyes and
/// mirrors, nobody else could have found.
static float power_weight(float density, float other) {
    if (isinf(density)) {
        return 1.0f;
    }
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
    if (fr_is_black(scattered)) {
        return;
    }
    float weight = is_only ? 1.0f : power_weight(density, fr_bsdf_density(&surface->bsdf, out, in));
    vec3s light = glms_vec3_scale(fr_sky_radiance(sky, in), weight / density);
    add_passing(path, start_point(surface, in), in, INFINITY, glms_vec3_mul(scattered, light));
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
    if (fr_is_black(scattered)) {
        return;
    }
    float other = fr_bsdf_density(&surface->bsdf, out, sight.direction);
    float weight = is_only ? 1.0f : power_weight(sight.density, other);
    vec3s light = glms_vec3_scale(sight.radiance, weight / sight.density);
    add_passing(path, from, sight.direction, far, glms_vec3_mul(scattered, light));
}

/// True if a lamp stands before what is `far` away; its light has been added.
static bool meet_lamp(Path *path, vec3s origin, vec3s direction, float far, float density) {
    FrLampSight sight;
    if (!fr_lamps_meet(&path->world->lamps, origin, direction, far, &sight)) {
        return false;
    }
    float weight = power_weight(density, sight.density);
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
    if (!path->is_indirect) {
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

/// Where a path is and where it goes.
typedef struct Way {
    vec3s origin, direction;
    vec3s from;    ///< where it took this direction, before clear glass
    float gone;    ///< since then
    float density; ///< with which the direction was sampled
} Way;

static void turn_to(Way *way, const FrSurface *surface, vec3s direction, float density) {
    vec3s origin = start_point(surface, direction);
    *way = (Way){origin, direction, origin, 0.0f, density};
}

/// What is seen of a surface by the eye itself, in mirrors and through glass too.
static void note_sight(const FrSurface *surface, FrPathSample *sample) {
    const FrBsdf *bsdf = &surface->bsdf;
    vec3s matt = glms_vec3_add(bsdf->reflectance, bsdf->transmittance);
    sample->albedo = glms_vec3_add(matt, glms_vec3_add(bsdf->mirror, bsdf->clear));
    sample->normal = bsdf->normal;
    sample->is_sky = false;
}

static vec3s mirrored(const FrSurface *surface, vec3s direction) {
    vec3s normal = surface->bsdf.normal;
    float along = glms_vec3_dot(normal, direction);
    return glms_vec3_normalize(glms_vec3_muladds(normal, -2.0f * along, direction));
}

/// Goes on from a surface; false if the path ends there. `*is_through`: by clear glass.
static bool go_on(Path *path, const FrSurface *surface, bool is_last, Way *way, bool *is_through) {
    vec3s out = glms_vec3_negate(way->direction), factor, direction;
    float u;
    float v;
    fr_sampler_pair(path->sampler, &u, &v);
    float choice = fr_sampler_single(path->sampler);
    FrStraight straight = fr_bsdf_decide(&surface->bsdf, &choice, &factor);
    path->throughput = glms_vec3_mul(path->throughput, factor);
    *is_through = straight == FR_STRAIGHT_CLEAR;
    if (straight == FR_STRAIGHT_CLEAR) {
        way->origin = surface->below;
        way->gone += surface->distance;
        return true;
    }
    if (is_last) {
        return false;
    }
    if (straight == FR_STRAIGHT_MIRROR) {
        direction = mirrored(surface, way->direction);
        turn_to(way, surface, direction, INFINITY);
        return glms_vec3_dot(direction, surface->bsdf.side) > 0.0f;
    }
    float density;
    if (!fr_bsdf_sample(&surface->bsdf, out, choice, u, v, &direction, &factor, &density)) {
        return false;
    }
    path->throughput = glms_vec3_mul(path->throughput, factor);
    path->is_indirect = true;
    turn_to(way, surface, direction, density);
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
    Way way = {origin, direction, origin, 0.0f, INFINITY};
    int surfaces = 0;
    for (uint32_t bounce = 0; bounce <= bounces && surfaces < FR_CLEAR_SURFACES;) {
        FrSurface surface;
        FrMet met = fr_world_trace(world, way.origin, way.direction, &surface);
        float distance = way.gone + surface.distance;
        if (meet_lamp(&path, way.from, way.direction, distance, way.density)) {
            break;
        }
        if (met == FR_MET_SKY) {
            meet_sky(&path, way.direction, bounce, way.density);
            break;
        }
        if (!path.is_indirect) {
            note_sight(&surface, &sample);
            if (met == FR_MET_GROUND && !pass_haze(&path, way.direction, distance)) {
                sample.is_sky = true;
                break;
            }
        }
        vec3s out = glms_vec3_negate(way.direction);
        bool is_last = bounce == bounces, is_through;
        add_sun(&path, &surface, out);
        if (bounce < SKY_SAMPLED_BOUNCES || is_last) {
            add_sky(&path, &surface, out, is_last);
        }
        add_lamps(&path, &surface, out, is_last);
        if (!go_on(&path, &surface, is_last, &way, &is_through) ||
            (!is_through && !survives(&path, bounce))) {
            break;
        }
        bounce += !is_through;
        surfaces += is_through;
    }
    sample.radiance = path.radiance;
    return sample;
}
