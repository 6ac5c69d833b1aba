// A soup of triangles that come and go, on Embree 3.
//
// Every addition is a batch with a search tree of its own; what is removed is passed over. A ray
// asks one batch after the other and takes along how far it got. In robust mode Embree visits every
// box that the ray meets, and whether a triangle is met is a function of the ray and the triangle
// alone. The filter computes the distance anew in doubles and leaves the ray a little longer than
// that, so that everything at about the same distance is seen, whichever comes first.
#include "space/soup.h"

#include "space/embree.h"

#include <math.h>

enum { MOST_BATCHES = 4 };

typedef struct Batch {
    RTCScene scene;
    float (*corners)[9];
    uint64_t *keys;
    bool *is_gone;
    uint32_t first, count;
} Batch;

struct FrSoup {
    RTCDevice device;
    FrSoupHoleFn hole;
    void *user;
    GPtrArray *batches; ///< Batch
    uint32_t count, gone;
    float extent; ///< of all that was ever added, from the origin
};

typedef struct Query {
    struct RTCIntersectContext context; ///< first: the filter gets its address
    const FrSoup *soup;
    double origin[3], direction[3];
    uint32_t except;
    uint64_t key;
    FrSoupHit best;
} Query;

static inline double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

typedef struct Crossing {
    double distance, facing; ///< facing > 0: the ray goes the way of the normal
    double normal[3], toward[3], edge[2][3];
} Crossing;

// Where the line meets the plane of a triangle.
static inline Crossing cross_plane(const float *corners, const Query *query) {
    Crossing crossing;
    for (int c = 0; c < 3; c++) {
        double a = (double)corners[c];
        crossing.edge[0][c] = (double)corners[3 + c] - a;
        crossing.edge[1][c] = (double)corners[6 + c] - a;
        crossing.toward[c] = a - query->origin[c];
    }
    cross(crossing.edge[0], crossing.edge[1], crossing.normal);
    crossing.facing = dot(crossing.normal, query->direction);
    crossing.distance = dot(crossing.normal, crossing.toward) / crossing.facing;
    return crossing;
}

// Barycentric coordinates by the formula of Möller and Trumbore 1997.
static bool is_hole(const Query *query, const Crossing *crossing, uint32_t triangle) {
    if (query->soup->hole == NULL) {
        return false;
    }
    double across[3];
    cross(query->direction, crossing->toward, across);
    double u = -dot(crossing->edge[1], across) / crossing->facing;
    double v = dot(crossing->edge[0], across) / crossing->facing;
    return query->soup->hole(query->soup->user, triangle, u, v);
}

// For N = 1 the layouts of ray and hit are those of single ones, and only single rays are asked.
static void consider(const struct RTCFilterFunctionNArguments *arguments) {
    FR_ASSERT(arguments->N == 1);
    Query *query = (Query *)(void *)arguments->context;
    const Batch *batch = arguments->geometryUserPtr;
    uint32_t index = ((const struct RTCHit *)arguments->hit)->primID;
    uint32_t triangle = batch->first + index;
    arguments->valid[0] = 0;
    if (triangle == query->except || batch->is_gone[index]) {
        return;
    }
    Crossing crossing = cross_plane(batch->corners[index], query);
    FrSoupHit *best = &query->best;
    if (!(crossing.distance > 0.0) || !(crossing.distance <= best->distance) ||
        (crossing.distance == best->distance && batch->keys[index] > query->key) ||
        is_hole(query, &crossing, triangle)) {
        return;
    }
    best->distance = crossing.distance;
    best->triangle = triangle;
    best->is_back = crossing.facing > 0.0;
    memcpy(best->normal, crossing.normal, sizeof best->normal);
    query->key = batch->keys[index];
    arguments->valid[0] = -1;
    struct RTCRay *ray = (struct RTCRay *)arguments->ray;
    ray->tfar = 1.001f * (float)crossing.distance + 1e-5f * query->soup->extent;
}

FrSoup *fr_soup_new(int threads, FrSoupHoleFn hole, void *user) {
    FrSoup *soup = g_new0(FrSoup, 1);
    char *config = g_strdup_printf("threads=%d", threads);
    soup->device = rtcNewDevice(config);
    g_free(config);
    FR_ASSERT(soup->device != NULL);
    soup->hole = hole;
    soup->user = user;
    soup->batches = g_ptr_array_new();
    return soup;
}

static void free_batch(Batch *batch) {
    rtcReleaseScene(batch->scene);
    g_free(batch->corners);
    g_free(batch->keys);
    g_free(batch->is_gone);
    g_free(batch);
}

void fr_soup_free(FrSoup *soup) {
    if (soup == NULL) {
        return;
    }
    for (guint i = 0; i < soup->batches->len; i++) {
        free_batch(g_ptr_array_index(soup->batches, i));
    }
    g_ptr_array_unref(soup->batches);
    rtcReleaseDevice(soup->device);
    g_free(soup);
}

static RTCScene build(RTCDevice device, Batch *batch) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               batch->corners, 0, 3 * sizeof(float), 3 * (size_t)batch->count);
    uint32_t *indices = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), batch->count);
    FR_ASSERT(indices != NULL);
    for (uint32_t i = 0; i < 3 * batch->count; i++) {
        indices[i] = i;
    }
    rtcSetGeometryUserData(geometry, batch);
    rtcSetGeometryIntersectFilterFunction(geometry, consider);
    rtcCommitGeometry(geometry);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

static void find_extent(FrSoup *soup, const Batch *batch) {
    const float *numbers = &batch->corners[0][0];
    for (size_t i = 0; i < 9 * (size_t)batch->count; i++) {
        soup->extent = fmaxf(soup->extent, fabsf(numbers[i]));
    }
}

uint32_t fr_soup_add(FrSoup *soup, float (*corners)[9], uint64_t *keys, uint32_t count) {
    Batch *batch = g_new0(Batch, 1);
    *batch = (Batch){
        .corners = corners,
        .keys = keys,
        .is_gone = g_new0(bool, count),
        .first = soup->count,
        .count = count,
    };
    find_extent(soup, batch);
    batch->scene = build(soup->device, batch);
    g_ptr_array_add(soup->batches, batch);
    soup->count += count;
    return batch->first;
}

static Batch *batch_of(const FrSoup *soup, uint32_t triangle) {
    for (guint i = 0; i < soup->batches->len; i++) {
        Batch *batch = g_ptr_array_index(soup->batches, i);
        if (triangle - batch->first < batch->count) {
            return batch;
        }
    }
    return NULL;
}

void fr_soup_remove(FrSoup *soup, uint32_t triangle) {
    Batch *batch = batch_of(soup, triangle);
    FR_ASSERT(batch != NULL && !batch->is_gone[triangle - batch->first]);
    batch->is_gone[triangle - batch->first] = true;
    soup->gone++;
}

bool fr_soup_has(const FrSoup *soup, uint32_t triangle) {
    const Batch *batch = batch_of(soup, triangle);
    return batch != NULL && !batch->is_gone[triangle - batch->first];
}

uint32_t fr_soup_count(const FrSoup *soup) {
    return soup->count;
}

static void start(Query *query, const FrSoup *soup, const float origin[3],
                  const float direction[3]) {
    rtcInitIntersectContext(&query->context);
    query->soup = soup;
    for (int c = 0; c < 3; c++) {
        query->origin[c] = (double)origin[c];
        query->direction[c] = (double)direction[c];
    }
    query->except = FR_NONE;
    query->key = UINT64_MAX;
    query->best = (FrSoupHit){.distance = INFINITY, .triangle = FR_NONE};
}

FrSoupHit fr_soup_trace(const FrSoup *soup, const float origin[3], const float direction[3],
                        uint32_t except) {
    Query query;
    start(&query, soup, origin, direction);
    query.except = except;
    unsigned saved = fr_flush_denormals();
    struct RTCRayHit ray = {.ray = fr_embree_ray(origin, direction, 0.0f, INFINITY)};
    for (guint i = 0; i < soup->batches->len; i++) {
        const Batch *batch = g_ptr_array_index(soup->batches, i);
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(batch->scene, &query.context, &ray);
    }
    fr_restore_denormals(saved);
    return query.best;
}

FrSoupHit fr_soup_trace_last(const FrSoup *soup, const float origin[3], const float direction[3],
                             double distance, uint32_t triangle) {
    const Batch *last = g_ptr_array_index(soup->batches, soup->batches->len - 1);
    Query query;
    start(&query, soup, origin, direction);
    query.best.distance = distance;
    if (triangle != FR_NONE) {
        const Batch *batch = batch_of(soup, triangle);
        query.key = batch->keys[triangle - batch->first];
    }
    float far = 1.001f * (float)distance + 1e-5f * soup->extent;
    unsigned saved = fr_flush_denormals();
    struct RTCRayHit ray = {.ray = fr_embree_ray(origin, direction, 0.0f, far)};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(last->scene, &query.context, &ray);
    fr_restore_denormals(saved);
    return query.best;
}

bool fr_soup_wants_compaction(const FrSoup *soup) {
    return soup->batches->len > MOST_BATCHES || soup->gone > soup->count / 2;
}

// The first batch keeps its tree while it is most of the soup and most of it is left: what comes
// and goes in small steps is then merged without it.
static guint first_to_merge(const FrSoup *soup) {
    const Batch *first = g_ptr_array_index(soup->batches, 0);
    uint32_t gone = 0;
    for (uint32_t i = 0; i < first->count; i++) {
        gone += first->is_gone[i];
    }
    return soup->batches->len > 1 && soup->count - first->count < first->count / 2 &&
                   gone < first->count / 3
               ? 1
               : 0;
}

void fr_soup_compact(FrSoup *soup, uint32_t *remap) {
    guint from = first_to_merge(soup);
    uint32_t kept = from == 0 ? 0 : ((Batch *)g_ptr_array_index(soup->batches, 0))->count;
    for (uint32_t i = 0; i < kept; i++) {
        remap[i] = fr_soup_has(soup, i) ? i : FR_NONE;
    }
    float(*corners)[9] = g_malloc((soup->count - kept) * sizeof *corners + FR_SOUP_PADDING);
    uint64_t *keys = g_new(uint64_t, soup->count - kept);
    uint32_t next = 0;
    for (guint b = from; b < soup->batches->len; b++) {
        Batch *batch = g_ptr_array_index(soup->batches, b);
        for (uint32_t i = 0; i < batch->count; i++) {
            remap[batch->first + i] = batch->is_gone[i] ? FR_NONE : kept + next;
            soup->gone -= batch->is_gone[i];
            if (!batch->is_gone[i]) {
                memcpy(corners[next], batch->corners[i], sizeof *corners);
                keys[next++] = batch->keys[i];
            }
        }
        free_batch(batch);
    }
    g_ptr_array_set_size(soup->batches, (gint)from);
    soup->count = kept;
    if (next > 0) {
        fr_soup_add(soup, corners, keys, next);
    } else {
        g_free(corners);
        g_free(keys);
    }
}

uint64_t fr_soup_bytes(const FrSoup *soup) {
    // A triangle: corners, key, mark, indices; and about as much again in Embree's tree.
    return (uint64_t)soup->count * 2 * (9 * sizeof(float) + sizeof(uint64_t) + 1 + 12);
}
