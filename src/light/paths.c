// Photon paths: tracing them (Jensen 2001, Realistic Image Synthesis Using Photon Mapping) and
// keeping up with a scene that changes (Van Haevre, Di Fiore, Bekaert, Van Reeth 2004, Ray Density
// Estimation for Plant Growth Simulation, section 3.1).
#include "light/paths.h"

#include "light/scatter.h"

#include <string.h>

enum {
    PHOTONS_AT_ONCE = 1024, ///< that one thread follows; no result depends on it
    CHUNKS_AT_ONCE = 32,    ///< whose rays are held before they are stored
    RAYS_AT_ONCE = 16384,   ///< that one thread looks through for cuts
    RAYS_UNCOUNTED = 64,    ///< that one thread traces before it looks whether to stop
};

FrPaths *fr_paths_new(uint32_t photons, uint32_t most_bounces, uint64_t seed) {
    FrPaths *paths = g_new0(FrPaths, 1);
    paths->photon_count = photons;
    paths->first = g_new(uint32_t, photons);
    paths->most_bounces = most_bounces;
    paths->key = fr_key_child(fr_key_root(seed), fr_key_name("photons"));
    paths->free_slots = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    paths->fresh = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    return paths;
}

void fr_paths_free(FrPaths *paths) {
    if (paths == NULL) {
        return;
    }
    g_free(paths->rays);
    g_free(paths->first);
    g_array_unref(paths->free_slots);
    g_array_unref(paths->fresh);
    g_free(paths->met);
    g_free(paths);
}

/// A ray that does not meet any more what it met.
typedef struct Cut {
    uint32_t slot;
    bool is_known; ///< what it meets now
    FrSoupHit hit;
} Cut;

/// One loop over photons: all from their lamps, or some from where their paths were broken.
typedef struct Job {
    const FrPaths *paths;
    const FrEmitters *emitters; ///< NULL: go on from `cuts`
    const FrSurfaces *surfaces;
    const Cut *cuts;
    size_t begin, end; ///< photons, or cuts
    GArray **found;    ///< FrRay, one array for each chunk
    uint64_t *made;    ///< rays of all chunks; exact once all are done
    uint64_t most;     ///< such rays
    const FrProgress *progress;
} Job;

/// Rays of one chunk and how many of them are in the sum of all.
typedef struct Tally {
    GArray *rays;
    guint counted;
} Tally;

static bool may_go_on(const Job *job, Tally *tally) {
    uint64_t more = tally->rays->len - tally->counted;
    uint64_t made = __atomic_add_fetch(job->made, more, __ATOMIC_RELAXED);
    tally->counted = tally->rays->len;
    return made <= job->most && !fr_progress_is_cancelled(job->progress);
}

// From the ray's origin and direction to the end of the path. `known` is what the first ray meets,
// or NULL. False: there is no use in going on.
static bool follow(const Job *job, FrRay ray, const FrSoupHit *known, Tally *tally) {
    const FrSoup *soup = fr_surfaces_soup(job->surfaces);
    FrKey photon_key = fr_key_child(job->paths->key, ray.photon);
    for (;; known = NULL) {
        FrSoupHit hit =
            known != NULL ? *known : fr_soup_trace(soup, ray.origin, ray.direction, ray.from);
        ray.distance = hit.distance;
        ray.triangle = hit.triangle;
        ray.is_back = hit.is_back;
        g_array_append_val(tally->rays, ray);
        if (tally->rays->len - tally->counted >= RAYS_UNCOUNTED && !may_go_on(job, tally)) {
            return false;
        }
        if (hit.triangle == FR_NONE || ray.bounce >= job->paths->most_bounces) {
            return true;
        }
        double sign = hit.is_back ? -1.0 : 1.0;
        double normal[3] = {sign * hit.normal[0], sign * hit.normal[1], sign * hit.normal[2]};
        for (int c = 0; c < 3; c++) {
            ray.origin[c] =
                (float)((double)ray.origin[c] + hit.distance * (double)ray.direction[c]);
        }
        ray.bounce++;
        ray.from = hit.triangle;
        const FrOptics *optics = fr_surfaces_optics(job->surfaces, hit.triangle, hit.is_back);
        if (!fr_scatter(optics, normal, fr_key_child(photon_key, ray.bounce), ray.direction)) {
            return true;
        }
    }
}

static bool send_photon(const Job *job, uint32_t photon, Tally *tally) {
    FrEmission emission = fr_emitters_emit(job->emitters, fr_key_child(job->paths->key, photon),
                                           photon, job->paths->photon_count);
    FrRay ray = {.photon = photon, .from = FR_NONE};
    memcpy(ray.origin, emission.origin, sizeof ray.origin);
    memcpy(ray.direction, emission.direction, sizeof ray.direction);
    return follow(job, ray, NULL, tally);
}

static void follow_chunks(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Job *job = data;
    for (size_t chunk = begin; chunk < end; chunk++) {
        Tally tally = {.rays = job->found[chunk]};
        size_t first = job->begin + chunk * PHOTONS_AT_ONCE;
        size_t last = MIN(first + PHOTONS_AT_ONCE, job->end);
        bool goes_on = true;
        for (size_t i = first; i < last && goes_on; i++) {
            if (job->cuts == NULL) {
                goes_on = send_photon(job, (uint32_t)i, &tally);
            } else {
                const Cut *cut = &job->cuts[i];
                goes_on = follow(job, job->paths->rays[cut->slot], cut->is_known ? &cut->hit : NULL,
                                 &tally);
            }
        }
        may_go_on(job, &tally); // counts the rest
    }
}

static uint64_t most_rays(const FrContext *context) {
    return MIN(context->limits.bytes / sizeof(FrRay), FR_NONE - 1ull);
}

// The number asked for is the least that is too large: how many rays there are when threads stop is
// chance.
static FrStatus refuse(const FrPaths *paths, const FrContext *context) {
    uint64_t limit = MIN(context->limits.bytes, (FR_NONE - 1ull) * sizeof(FrRay));
    return fr_limit_check((most_rays(context) + 1) * sizeof(FrRay), limit, "bytes", "the light",
                          paths->span, context->diags);
}

static void reserve(FrPaths *paths, uint64_t more, const FrContext *context) {
    uint64_t wanted = paths->count + more - MIN(more, paths->free_slots->len);
    if (wanted > paths->capacity) {
        uint64_t capacity = MAX(wanted, paths->capacity + paths->capacity / 2ull);
        paths->capacity = (uint32_t)MIN(capacity, MAX(wanted, most_rays(context)));
        paths->rays = g_renew(FrRay, paths->rays, paths->capacity);
    }
}

static void note_meeting(FrPaths *paths, const FrRay *ray, uint64_t change) {
    if (ray->triangle != FR_NONE) {
        paths->met[2 * (uint64_t)ray->triangle + ray->is_back] += change;
    }
}

static uint32_t take_slot(FrPaths *paths) {
    GArray *slots = paths->free_slots;
    if (slots->len == 0) {
        paths->rays[paths->count].is_stale = false;
        return paths->count++;
    }
    uint32_t slot = g_array_index(slots, uint32_t, slots->len - 1);
    g_array_set_size(slots, slots->len - 1);
    return slot;
}

// Stores the rays of whole paths, or of the ends of paths that were cut.
static void store(FrPaths *paths, const GArray *found, const Cut *cut) {
    uint32_t last = FR_NONE;
    bool is_update = cut != NULL;
    for (guint i = 0; i < found->len; i++) {
        const FrRay *ray = &g_array_index(found, FrRay, i);
        bool is_first = last == FR_NONE || paths->rays[last].photon != ray->photon;
        uint32_t slot;
        if (!is_first) {
            slot = take_slot(paths);
            paths->rays[last].next = slot;
        } else if (is_update) {
            slot = cut++->slot;
        } else {
            slot = take_slot(paths);
            paths->first[ray->photon] = slot;
        }
        // What the slot held before may still be referred to.
        bool is_stale = paths->rays[slot].is_stale;
        paths->rays[slot] = *ray;
        paths->rays[slot].next = FR_NONE;
        paths->rays[slot].is_stale = is_stale;
        note_meeting(paths, ray, 1);
        if (is_update) {
            g_array_append_val(paths->fresh, slot);
        }
        last = slot;
    }
}

// Follows some photons of a job and stores their rays in the photons' order.
static FrStatus run_some(FrPaths *paths, Job *job, size_t chunks, const FrContext *context) {
    uint64_t made = 0;
    job->made = &made;
    uint64_t most = most_rays(context), there = fr_paths_ray_count(paths);
    job->most = most - MIN(most, there);
    for (size_t i = 0; i < chunks; i++) {
        g_array_set_size(job->found[i], 0);
    }
    fr_parallel_for(context->pool, chunks, 1, follow_chunks, job, context->progress);
    paths->traced += made;
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    if (made > job->most) {
        return refuse(paths, context);
    }
    reserve(paths, made, context);
    for (size_t i = 0; i < chunks; i++) {
        const Cut *cuts = job->cuts != NULL ? job->cuts + job->begin + i * PHOTONS_AT_ONCE : NULL;
        store(paths, job->found[i], cuts);
    }
    return FR_OK;
}

static FrStatus run(FrPaths *paths, Job *job, const FrContext *context) {
    GArray *found[CHUNKS_AT_ONCE];
    for (int i = 0; i < CHUNKS_AT_ONCE; i++) {
        found[i] = g_array_new(FALSE, FALSE, sizeof(FrRay));
    }
    size_t count = job->end, step = (size_t)CHUNKS_AT_ONCE * PHOTONS_AT_ONCE;
    FrStatus status = FR_OK;
    job->found = found;
    job->progress = context->progress;
    for (size_t begin = 0; begin < count && status == FR_OK; begin += step) {
        job->begin = begin;
        job->end = MIN(begin + step, count);
        size_t chunks = (job->end - begin + PHOTONS_AT_ONCE - 1) / PHOTONS_AT_ONCE;
        status = run_some(paths, job, chunks, context);
        fr_progress_report(context->progress, "light", (double)job->end / (double)count);
    }
    for (int i = 0; i < CHUNKS_AT_ONCE; i++) {
        g_array_unref(found[i]);
    }
    return status;
}

static void fit_meetings(FrPaths *paths, const FrSurfaces *surfaces) {
    uint64_t count = 2 * (uint64_t)fr_soup_count(fr_surfaces_soup(surfaces));
    paths->met = g_renew(uint64_t, paths->met, count);
    for (; paths->met_count < count; paths->met_count++) {
        paths->met[paths->met_count] = 0;
    }
}

FrStatus fr_paths_trace(FrPaths *paths, const FrEmitters *emitters, const FrSurfaces *surfaces,
                        const FrContext *context) {
    paths->count = 0;
    paths->met_count = 0;
    g_array_set_size(paths->free_slots, 0);
    g_array_set_size(paths->fresh, 0);
    paths->is_all_new = true;
    fit_meetings(paths, surfaces);
    for (uint32_t i = 0; i < paths->photon_count; i++) {
        paths->first[i] = FR_NONE;
    }
    if (!(fr_emitters_power(emitters) > 0.0)) {
        return FR_OK;
    }
    Job job = {
        .paths = paths, .emitters = emitters, .surfaces = surfaces, .end = paths->photon_count};
    return run(paths, &job, context);
}

/// A look through all rays for those that a change touches.
typedef struct Search {
    const FrPaths *paths;
    const FrSurfaces *surfaces;
    uint32_t added, removed, box_count;
    float boxes[FR_MOST_BOXES][2][3];
    float extent;  ///< of the boxes, from the origin
    GArray **cuts; ///< Cut, one array for each chunk
} Search;

static inline float smaller(float a, float b) {
    return a < b ? a : b;
}

static inline float larger(float a, float b) {
    return a > b ? a : b;
}

// True if the ray meets one of the boxes around what is new, up to some rounding.
static bool meets_box(const Search *search, const FrRay *ray) {
    float inverse[3];
    for (int c = 0; c < 3; c++) {
        inverse[c] = 1.0f / (fabsf(ray->direction[c]) > 1e-20f ? ray->direction[c] : 1e-20f);
    }
    for (uint32_t b = 0; b < search->box_count; b++) {
        float near = 0.0f, far = (float)ray->distance;
        for (int c = 0; c < 3; c++) {
            float slack = 1e-5f * (search->extent + fabsf(ray->origin[c]));
            float low = (search->boxes[b][0][c] - slack - ray->origin[c]) * inverse[c];
            float high = (search->boxes[b][1][c] + slack - ray->origin[c]) * inverse[c];
            near = larger(near, smaller(low, high));
            far = smaller(far, larger(low, high));
        }
        bool is_met = near <= far * 1.0001f;
        if (is_met != (b == 0)) {
            return is_met; // the first is around all others
        }
    }
    return false;
}

static bool is_cut(const Search *search, const FrRay *ray, Cut *cut) {
    const FrSoup *soup = fr_surfaces_soup(search->surfaces);
    cut->is_known = false;
    if (search->removed > 0 && ray->triangle != FR_NONE && !fr_soup_has(soup, ray->triangle)) {
        return true;
    }
    if (search->added == 0 || !meets_box(search, ray)) {
        return false;
    }
    cut->hit = fr_soup_trace_last(soup, ray->origin, ray->direction, ray->distance, ray->triangle);
    cut->is_known = cut->hit.triangle != FR_NONE;
    return cut->is_known;
}

static void search_rays(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Search *search = data;
    GArray *cuts = g_array_new(FALSE, FALSE, sizeof(Cut));
    for (size_t i = begin; i < end; i++) {
        const FrRay *ray = &search->paths->rays[i];
        Cut cut = {.slot = (uint32_t)i};
        if (ray->photon != FR_NONE && is_cut(search, ray, &cut)) {
            g_array_append_val(cuts, cut);
        }
    }
    search->cuts[begin / RAYS_AT_ONCE] = cuts;
}

// All cuts in the order of their slots. NULL: cancelled.
static GArray *find_cuts(Search *search, const FrContext *context) {
    uint32_t count = search->paths->count;
    size_t chunks = ((size_t)count + RAYS_AT_ONCE - 1) / RAYS_AT_ONCE;
    search->cuts = g_new0(GArray *, chunks);
    fr_parallel_for(context->pool, count, RAYS_AT_ONCE, search_rays, search, context->progress);
    GArray *all = g_array_new(FALSE, FALSE, sizeof(Cut));
    bool is_whole = true;
    for (size_t i = 0; i < chunks; i++) {
        is_whole = is_whole && search->cuts[i] != NULL;
        if (search->cuts[i] != NULL) {
            g_array_append_vals(all, search->cuts[i]->data, search->cuts[i]->len);
            g_array_unref(search->cuts[i]);
        }
    }
    g_free(search->cuts);
    if (!is_whole) {
        g_array_unref(all);
        return NULL;
    }
    return all;
}

// Frees what comes after each cut, and keeps of the cuts those that are the first on their paths.
static void prune(FrPaths *paths, GArray *cuts) {
    for (guint i = 0; i < cuts->len; i++) {
        uint32_t slot = g_array_index(cuts, Cut, i).slot;
        for (uint32_t r = paths->rays[slot].next; r != FR_NONE;) {
            FrRay *ray = &paths->rays[r];
            if (ray->photon == FR_NONE) {
                break; // freed by a cut behind this one
            }
            note_meeting(paths, ray, UINT64_MAX);
            ray->photon = FR_NONE;
            ray->is_stale = true;
            g_array_append_val(paths->free_slots, r);
            r = ray->next;
        }
    }
    guint kept = 0;
    for (guint i = 0; i < cuts->len; i++) {
        const Cut *cut = &g_array_index(cuts, Cut, i);
        FrRay *ray = &paths->rays[cut->slot];
        if (ray->photon != FR_NONE) {
            note_meeting(paths, ray, UINT64_MAX);
            ray->is_stale = true;
            g_array_index(cuts, Cut, kept++) = *cut;
        }
    }
    g_array_set_size(cuts, kept);
}

FrStatus fr_paths_update(FrPaths *paths, const FrSurfaces *surfaces, uint32_t added,
                         uint32_t removed, const FrContext *context) {
    Search search = {.paths = paths, .surfaces = surfaces, .added = added, .removed = removed};
    if (added == 0 && removed == 0) {
        return FR_OK;
    }
    fit_meetings(paths, surfaces);
    search.box_count = added > 0 ? fr_surfaces_added_boxes(surfaces, search.boxes) : 0;
    for (int c = 0; c < 3 && added > 0; c++) {
        search.extent = larger(search.extent,
                               larger(fabsf(search.boxes[0][0][c]), fabsf(search.boxes[0][1][c])));
    }
    GArray *cuts = find_cuts(&search, context);
    if (cuts == NULL) {
        return FR_CANCELLED;
    }
    prune(paths, cuts);
    Job job = {.paths = paths,
               .surfaces = surfaces,
               .cuts = (const Cut *)(void *)cuts->data,
               .end = cuts->len};
    FrStatus status = run(paths, &job, context);
    g_array_unref(cuts);
    return status;
}

void fr_paths_renumber(FrPaths *paths, const uint32_t *remap, uint32_t triangle_count) {
    for (uint32_t i = 0; i < paths->count; i++) {
        FrRay *ray = &paths->rays[i];
        if (ray->photon != FR_NONE) {
            ray->from = ray->from != FR_NONE ? remap[ray->from] : FR_NONE;
            ray->triangle = ray->triangle != FR_NONE ? remap[ray->triangle] : FR_NONE;
        }
    }
    for (uint64_t i = 0; i < paths->met_count / 2; i++) {
        if (remap[i] != FR_NONE) {
            memmove(&paths->met[2 * (uint64_t)remap[i]], &paths->met[2 * i],
                    2 * sizeof *paths->met);
        }
    }
    paths->met_count = 2 * (uint64_t)triangle_count;
}

void fr_paths_settle(FrPaths *paths) {
    if (!paths->is_all_new) {
        for (guint i = 0; i < paths->fresh->len; i++) {
            paths->rays[g_array_index(paths->fresh, uint32_t, i)].is_stale = false;
        }
        for (guint i = 0; i < paths->free_slots->len; i++) {
            paths->rays[g_array_index(paths->free_slots, uint32_t, i)].is_stale = false;
        }
    }
    g_array_set_size(paths->fresh, 0);
    paths->traced = 0;
    paths->is_all_new = false;
}

FrDigest fr_paths_digest(const FrPaths *paths) {
    FrDigest digest = 0;
    for (uint32_t i = 0; i < paths->photon_count; i++) {
        for (uint32_t r = paths->first[i]; r != FR_NONE; r = paths->rays[r].next) {
            const FrRay *ray = &paths->rays[r];
            const uint32_t rest[4] = {ray->photon, ray->bounce, ray->is_back,
                                      ray->triangle != FR_NONE};
            digest = fr_digest(digest, ray->origin, sizeof ray->origin);
            digest = fr_digest(digest, ray->direction, sizeof ray->direction);
            digest = fr_digest(digest, &ray->distance, sizeof ray->distance);
            digest = fr_digest(digest, rest, sizeof rest);
        }
    }
    return digest;
}

uint64_t fr_paths_ray_count(const FrPaths *paths) {
    return paths->count - paths->free_slots->len;
}

uint64_t fr_paths_bytes(const FrPaths *paths) {
    return paths->capacity * sizeof(FrRay) + paths->photon_count * sizeof *paths->first +
           paths->free_slots->len * sizeof(uint32_t) + paths->met_count * sizeof *paths->met;
}
