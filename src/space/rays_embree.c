// Ray queries over triangles by Embree 3 (Wald, Woop, Benthin, Johnson, Ernst 2014, Embree: A
// Kernel Framework for Efficient CPU Ray Tracing).
//
// Each mesh is one search tree over its triangles, read where they lie; each stand is an instance
// of such a tree, one level deep.
#include "frond/rays.h"

#include "space/embree.h"

#include <cglm/struct.h>
#include <math.h>

typedef struct RayPart {
    const FrRays *rays;
    uint32_t mesh, part;
} RayPart;

typedef struct RayMesh {
    RTCScene scene;
    RayPart *parts; ///< what the filter is handed; Embree keeps their addresses
    bool is_empty;
} RayMesh;

typedef struct RayStand {
    uint32_t mesh;
    mat3s normals; ///< takes normals of the mesh to the world, not to unit length
} RayStand;

struct FrRays {
    RTCDevice device;
    RTCScene world;
    FrHoleFn hole;
    void *user;
    GArray *meshes; ///< RayMesh
    GArray *stands; ///< RayStand
};

// For N = 1 the layout of an RTCHitN is that of an RTCHit, and only single rays are asked for.
static void skip_hole(const struct RTCFilterFunctionNArguments *arguments) {
    FR_ASSERT(arguments->N == 1);
    const RayPart *part = arguments->geometryUserPtr;
    const struct RTCHit *hit = (const struct RTCHit *)arguments->hit;
    const FrRays *rays = part->rays;
    if (rays->hole(rays->user, part->mesh, part->part, hit->primID, hit->u, hit->v)) {
        arguments->valid[0] = 0;
    }
}

FrRays *fr_rays_new(FrHoleFn hole, void *user) {
    FrRays *rays = g_new0(FrRays, 1);
    rays->device = rtcNewDevice(NULL);
    FR_ASSERT(rays->device != NULL);
    rays->world = rtcNewScene(rays->device);
    rays->hole = hole;
    rays->user = user;
    rays->meshes = g_array_new(FALSE, TRUE, sizeof(RayMesh));
    rays->stands = g_array_new(FALSE, TRUE, sizeof(RayStand));
    return rays;
}

void fr_rays_free(FrRays *rays) {
    if (rays == NULL) {
        return;
    }
    rtcReleaseScene(rays->world);
    for (guint i = 0; i < rays->meshes->len; i++) {
        RayMesh *mesh = &g_array_index(rays->meshes, RayMesh, i);
        rtcReleaseScene(mesh->scene);
        g_free(mesh->parts);
    }
    rtcReleaseDevice(rays->device);
    g_array_free(rays->meshes, TRUE);
    g_array_free(rays->stands, TRUE);
    g_free(rays);
}

static void attach_part(FrRays *rays, RayMesh *owner, const FrMesh *mesh, uint32_t index) {
    const FrMeshPart *part = &mesh->parts[index];
    RTCGeometry triangles = rtcNewGeometry(rays->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               mesh->vertices, part->first_vertex * sizeof(FrVertex),
                               sizeof(FrVertex), part->vertex_count);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->indices,
                               part->first_index * sizeof(uint32_t), 3 * sizeof(uint32_t),
                               part->index_count / 3);
    if (rays->hole != NULL) {
        rtcSetGeometryUserData(triangles, &owner->parts[index]);
        rtcSetGeometryIntersectFilterFunction(triangles, skip_hole);
        rtcSetGeometryOccludedFilterFunction(triangles, skip_hole);
    }
    rtcCommitGeometry(triangles);
    rtcAttachGeometryByID(owner->scene, triangles, index);
    rtcReleaseGeometry(triangles);
}

uint32_t fr_rays_add_mesh(FrRays *rays, const FrMesh *mesh) {
    uint32_t id = rays->meshes->len;
    RayMesh added = {
        .scene = rtcNewScene(rays->device),
        .parts = g_new(RayPart, mesh->part_count),
        .is_empty = true,
    };
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        added.parts[i] = (RayPart){.rays = rays, .mesh = id, .part = i};
        if (mesh->parts[i].index_count >= 3) {
            attach_part(rays, &added, mesh, i);
            added.is_empty = false;
        }
    }
    rtcCommitScene(added.scene);
    g_array_append_val(rays->meshes, added);
    return id;
}

static bool is_usable(const mat4s *transform) {
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 3; row++) {
            if (!isfinite(transform->raw[column][row])) {
                return false;
            }
        }
    }
    float volume = glms_mat3_det(glms_mat4_pick3(*transform));
    return isnormal(volume);
}

uint32_t fr_rays_add_stand(FrRays *rays, uint32_t mesh, mat4s transform) {
    FR_ASSERT(mesh < rays->meshes->len);
    uint32_t id = rays->stands->len;
    RayStand stand = {.mesh = mesh, .normals = glms_mat3_identity()};
    const RayMesh *shown = &g_array_index(rays->meshes, RayMesh, mesh);
    // What has no triangles or no volume cannot be hit; Embree need not know of it.
    if (!shown->is_empty && is_usable(&transform)) {
        mat3s linear = glms_mat4_pick3(transform);
        stand.normals = glms_mat3_transpose(glms_mat3_inv(linear));
        RTCGeometry instance = rtcNewGeometry(rays->device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, shown->scene);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, transform.raw);
        rtcCommitGeometry(instance);
        rtcAttachGeometryByID(rays->world, instance, id);
        rtcReleaseGeometry(instance);
    }
    g_array_append_val(rays->stands, stand);
    return id;
}

void fr_rays_commit(FrRays *rays) {
    rtcCommitScene(rays->world);
}

static bool is_finite3(vec3s v) {
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

FrHit fr_rays_trace(const FrRays *rays, vec3s origin, vec3s direction, float near, float far) {
    FrHit hit = {
        .distance = INFINITY,
        .mesh = FR_NONE,
        .part = FR_NONE,
        .stand = FR_NONE,
        .triangle = FR_NONE,
    };
    if (!is_finite3(origin) || !is_finite3(direction) || !(near <= far)) {
        return hit;
    }
    struct RTCRayHit query = {.ray = fr_embree_ray(origin.raw, direction.raw, near, far)};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    unsigned saved = fr_flush_denormals();
    rtcIntersect1(rays->world, &context, &query);
    fr_restore_denormals(saved);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return hit;
    }
    const RayStand *stand = &g_array_index(rays->stands, RayStand, query.hit.instID[0]);
    vec3s normal = {{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
    // A normal as short as a tiny triangle's would lose its direction in the square.
    normal = glms_vec3_scale(
        normal, 1.0f / fmaxf(fmaxf(fabsf(normal.x), fabsf(normal.y)), fabsf(normal.z)));
    hit.distance = query.ray.tfar;
    hit.mesh = stand->mesh;
    hit.part = query.hit.geomID;
    hit.stand = query.hit.instID[0];
    hit.triangle = query.hit.primID;
    hit.u = query.hit.u;
    hit.v = query.hit.v;
    hit.normal = glms_vec3_normalize(glms_mat3_mulv(stand->normals, normal));
    return hit;
}

bool fr_rays_is_blocked(const FrRays *rays, vec3s origin, vec3s direction, float near, float far) {
    if (!is_finite3(origin) || !is_finite3(direction) || !(near <= far)) {
        return false;
    }
    struct RTCRay ray = fr_embree_ray(origin.raw, direction.raw, near, far);
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    unsigned saved = fr_flush_denormals();
    rtcOccluded1(rays->world, &context, &ray);
    fr_restore_denormals(saved);
    return ray.tfar < 0.0f;
}
