// From a ray to the surface it meets. The origin of shadow rays is lifted from the flat triangle
// towards the smooth surface it stands for (Hanika 2021, Hacking the Shadow Terminator, Ray Tracing
// Gems II), or thin twigs of few sides would shade themselves in stripes.
#include "render/colour.h"
#include "render/world.h"

#include <math.h>

typedef struct Corners {
    vec3s position[3], normal[3];
    float uv[3][2];
    float weight[3];
} Corners;

static Corners corners_of(const FrWorldMesh *of, const FrHit *hit) {
    const FrMeshPart *part = &of->mesh->parts[hit->part];
    const FrVertex *vertices = of->mesh->vertices + part->first_vertex;
    const uint32_t *index = of->mesh->indices + part->first_index + 3 * (uint64_t)hit->triangle;
    Corners corners = {.weight = {1.0f - hit->u - hit->v, hit->u, hit->v}};
    for (int i = 0; i < 3; i++) {
        const FrVertex *vertex = &vertices[index[i]];
        corners.position[i] = fr_vec3_of(vertex->position);
        corners.normal[i] = fr_vec3_of(vertex->normal);
        corners.uv[i][0] = vertex->uv[0];
        corners.uv[i][1] = vertex->uv[1];
    }
    return corners;
}

static vec3s mix3(const vec3s *values, const float *weights) {
    vec3s sum = glms_vec3_scale(values[0], weights[0]);
    sum = glms_vec3_muladds(values[1], weights[1], sum);
    return glms_vec3_muladds(values[2], weights[2], sum);
}

static vec3s smooth_point(const Corners *corners, vec3s point) {
    vec3s lifted = point;
    for (int i = 0; i < 3; i++) {
        vec3s normal = corners->normal[i];
        float below = glms_vec3_dot(glms_vec3_sub(point, corners->position[i]), normal);
        if (below < 0.0f) {
            lifted = glms_vec3_muladds(normal, -below * corners->weight[i], lifted);
        }
    }
    return lifted;
}

/// Bends `normal` by a normal map's value in the frame of the texture coordinates.
static vec3s bend_normal(const Corners *corners, vec3s normal, vec3s mapped) {
    vec3s e1 = glms_vec3_sub(corners->position[1], corners->position[0]);
    vec3s e2 = glms_vec3_sub(corners->position[2], corners->position[0]);
    float u1 = corners->uv[1][0] - corners->uv[0][0];
    float v1 = corners->uv[1][1] - corners->uv[0][1];
    float u2 = corners->uv[2][0] - corners->uv[0][0];
    float v2 = corners->uv[2][1] - corners->uv[0][1];
    float area = u1 * v2 - u2 * v1;
    if (fabsf(area) < 1e-20f) {
        return normal;
    }
    vec3s along_u = glms_vec3_scale(glms_vec3_sub(glms_vec3_scale(e1, v2), glms_vec3_scale(e2, v1)),
                                    1.0f / area);
    along_u = glms_vec3_sub(along_u, glms_vec3_scale(normal, glms_vec3_dot(normal, along_u)));
    float length = glms_vec3_norm(along_u);
    if (!(length > 1e-12f)) {
        return normal;
    }
    along_u = glms_vec3_scale(along_u, 1.0f / length);
    // Pictures have v downwards and the map's y upwards; a mirrored picture turns that round.
    vec3s up = glms_vec3_scale(glms_vec3_cross(normal, along_u), area > 0.0f ? -1.0f : 1.0f);
    vec3s bent = glms_vec3_scale(along_u, mapped.x);
    bent = glms_vec3_muladds(up, mapped.y, bent);
    bent = glms_vec3_muladds(normal, mapped.z, bent);
    return glms_vec3_normalize(bent);
}

/// The normal turned as little as needed for `out` to be above it.
static vec3s facing(vec3s normal, vec3s out) {
    float cosine = glms_vec3_dot(normal, out);
    if (cosine >= 0.02f) {
        return normal;
    }
    return glms_vec3_normalize(glms_vec3_muladds(out, 0.02f - cosine, normal));
}

static float largest(vec3s v) {
    return fmaxf(fmaxf(fabsf(v.x), fabsf(v.y)), fabsf(v.z));
}

static void set_points(FrSurface *surface, vec3s point, vec3s lifted, vec3s side) {
    float skip = 1e-5f * largest(point) + 1e-6f;
    surface->point = glms_vec3_muladds(side, skip, lifted);
    surface->below = glms_vec3_muladds(side, -skip, point);
}

static void meet_plant(const FrWorld *world, const FrHit *hit, vec3s out, FrSurface *surface) {
    const FrWorldMesh *of = &g_array_index(world->meshes, FrWorldMesh, hit->mesh);
    const FrWorldStand *stand = &g_array_index(world->stands, FrWorldStand, hit->stand);
    const FrLook *look = &of->looks[hit->part];
    Corners corners = corners_of(of, hit);
    bool is_outer = glms_vec3_dot(hit->normal, out) >= 0.0f;
    float u = corners.weight[0] * corners.uv[0][0] + corners.weight[1] * corners.uv[1][0] +
              corners.weight[2] * corners.uv[2][0];
    float v = corners.weight[0] * corners.uv[0][1] + corners.weight[1] * corners.uv[1][1] +
              corners.weight[2] * corners.uv[2][1];
    vec3s local = mix3(corners.position, corners.weight);
    vec3s normal = mix3(corners.normal, corners.weight);
    if (look->normal != NULL) {
        normal = bend_normal(&corners, normal, fr_look_normal(look, u, v));
    }
    normal = glms_vec3_normalize(glms_mat3_mulv(stand->normals, normal));
    if (!(glms_vec3_dot(normal, normal) > 0.5f)) {
        normal = hit->normal;
    }
    vec3s point = glms_mat4_mulv3(stand->transform, local, 1.0f);
    vec3s lifted = point;
    if (!look->is_foliage && is_outer) {
        lifted = glms_mat4_mulv3(stand->transform, smooth_point(&corners, local), 1.0f);
    }
    FrBsdf *bsdf = &surface->bsdf;
    bsdf->side = is_outer ? hit->normal : glms_vec3_negate(hit->normal);
    // Normals of blades that skin turned to the light may lie on the other side of the triangle.
    bool agrees = glms_vec3_dot(normal, bsdf->side) >= 0.0f;
    bsdf->normal = facing(agrees ? normal : glms_vec3_negate(normal), out);
    fr_look_scattering(look, &world->decoder, u, v, is_outer, bsdf);
    set_points(surface, point, lifted, bsdf->side);
    surface->distance = hit->distance;
}

static void meet_ground(const FrWorld *world, vec3s point, float distance, vec3s out,
                        FrSurface *surface) {
    vec3s up = {{0, 0, 1}};
    FrGroundPoint ground = fr_ground_at(world->ground, point.x, point.y);
    surface->bsdf = (FrBsdf){
        .normal = facing(ground.normal, out),
        .side = up,
        .reflectance = ground.colour,
        .rough_a = 1.0f,
    };
    surface->distance = distance;
    set_points(surface, point, point, up);
}

FrMet fr_world_trace(const FrWorld *world, vec3s origin, vec3s direction, FrSurface *surface) {
    float ground = INFINITY;
    if (world->ground != NULL && direction.z < 0.0f) {
        ground = fmaxf(-origin.z / direction.z, 0.0f);
    }
    FrHit hit = fr_rays_trace(world->rays, origin, direction, 0.0f, ground);
    vec3s out = glms_vec3_negate(direction);
    if (!isinf(hit.distance)) {
        meet_plant(world, &hit, out, surface);
        return FR_MET_PLANT;
    }
    surface->distance = ground;
    if (isinf(ground)) {
        return FR_MET_SKY;
    }
    vec3s point = glms_vec3_muladds(direction, ground, origin);
    point.z = 0.0f;
    meet_ground(world, point, ground, out, surface);
    return FR_MET_GROUND;
}

static bool is_blocked(const FrWorld *world, vec3s origin, vec3s direction, float far) {
    if (world->ground != NULL && direction.z < 0.0f && -origin.z > direction.z * far) {
        return true;
    }
    return fr_rays_is_blocked(world->rays, origin, direction, 0.0f, far);
}

vec3s fr_world_passes(const FrWorld *world, vec3s origin, vec3s direction, float far) {
    if (!is_blocked(world, origin, direction, far)) {
        return glms_vec3_one();
    }
    vec3s left = world->has_clear ? glms_vec3_one() : glms_vec3_zero();
    for (int i = 0; i < FR_CLEAR_SURFACES && !fr_is_black(left); i++) {
        FrSurface surface;
        if (fr_world_trace(world, origin, direction, &surface) == FR_MET_SKY ||
            surface.distance >= far) {
            return left;
        }
        left = glms_vec3_mul(left, surface.bsdf.clear);
        far -= surface.distance;
        origin = surface.below;
    }
    return glms_vec3_zero();
}
