// Mitchell. Spectrally Optimal Sampling for Distribution Ray Tracing. SIGGRAPH 1991, a batch of
// points at a time. Their candidates are first held against all points before the batch, place by
// place, and then in turn against those of the batch: the same ones are chosen as one by one, but
// what is near is looked up while it is in the cache.
#include "pgraph/farthest.h"

#include "pgraph/near.h"
#include "pgraph/zorder.h"

#include <glib.h>
#include <math.h>

#define LOST 0.5 // part of a usual squared distance

enum {
    // A batch has so many points, or one for so many before it.
    LEAST_BATCH = 16,
    MOST_BATCH = 65536,
    BATCHES = 6,
    AHEAD = 12, // so many places are fetched before their turn
};

/// Where a point may be.
typedef struct FrPlace {
    double at[3];
    double distance; ///< squared, to the points before the batch, or an upper bound of it
} FrPlace;

/// Points that are chosen together.
typedef struct FrBatch {
    const FrCandidates *drawn;
    FrNear *before, *within; ///< points before the batch, and of the batch
    FrPlace *places;         ///< by point and candidate
    uint64_t *items;         ///< twice as many
    double enough;           ///< of distances that are not more, only an upper bound is known
} FrBatch;

static void measure(FrBatch *batch, uint32_t count) {
    FrPlace *places = batch->places;
    double min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t k = 0; k < count; k++) {
        for (int r = 0; r < 3; r++) {
            min[r] = MIN(min[r], places[k].at[r]);
            max[r] = MAX(max[r], places[k].at[r]);
        }
    }
    FrZorder order = fr_zorder(min, max);
    for (uint32_t k = 0; k < count; k++) {
        batch->items[k] = fr_zorder_item(&order, places[k].at, k);
    }
    fr_zorder_sort(batch->items, batch->items + count, count);
    for (uint32_t k = 0; k < count; k++) {
        __builtin_prefetch(&places[fr_zorder_number(batch->items[MIN(k + AHEAD, count - 1)])]);
        FrPlace *place = &places[fr_zorder_number(batch->items[k])];
        place->distance = fr_near_distance(batch->before, place->at, INFINITY, batch->enough);
    }
}

/// The candidate that is farthest from all points, of equals the first. The most promising are
/// tried first, until no other can be farther; what was tried has a distance less than 0 then.
static uint32_t choose(const FrBatch *batch, FrPlace *places, double *farthest) {
    uint32_t best = 0;
    *farthest = -1;
    for (;;) {
        uint32_t next = 0;
        for (uint32_t c = 1; c < batch->drawn->count; c++) {
            next = places[c].distance > places[next].distance ? c : next;
        }
        double distance = places[next].distance;
        if (distance < *farthest || distance < 0) {
            return best;
        }
        places[next].distance = -1;
        distance = fr_near_distance(batch->within, places[next].at, distance, *farthest);
        if (distance <= batch->enough && distance >= *farthest) {
            distance = fr_near_distance(batch->before, places[next].at, distance, -1);
        }
        if (distance > *farthest || (distance == *farthest && next < best)) {
            *farthest = distance;
            best = next;
        }
    }
}

static void choose_batch(FrBatch *batch, uint32_t *chosen, uint32_t first, uint32_t count) {
    const FrCandidates *drawn = batch->drawn;
    for (uint32_t i = 0; i < count; i++) {
        FrKey key = fr_key_child(drawn->key, first + i);
        for (uint32_t c = 0; c < drawn->count; c++) {
            drawn->draw(drawn->data, key, c, batch->places[i * drawn->count + c].at);
        }
    }
    measure(batch, count * drawn->count);
    batch->within = fr_near_new(drawn->area, count);
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        FrPlace *places = batch->places + i * drawn->count;
        double farthest;
        chosen[i] = choose(batch, places, &farthest);
        fr_near_add(batch->within, places[chosen[i]].at);
        sum += farthest;
    }
    fr_near_free(batch->within);
    for (uint32_t i = 0; i < count; i++) {
        fr_near_add(batch->before, batch->places[i * drawn->count + chosen[i]].at);
    }
    fr_near_settle(batch->before);
    // Few will be chosen that are nearer to others than that.
    batch->enough = isfinite(sum) ? LOST * sum / count : -1;
}

uint32_t *fr_choose_farthest(const FrCandidates *candidates, uint32_t count,
                             const FrProgress *progress) {
    uint32_t *chosen = g_new0(uint32_t, count), done = 0;
    if (candidates->count == 1) {
        return chosen;
    }
    size_t room = (size_t)MIN(count, MOST_BATCH) * candidates->count;
    FrBatch batch = {.drawn = candidates,
                     .before = fr_near_new(candidates->area, count),
                     .places = g_new(FrPlace, room),
                     .items = g_new(uint64_t, 2 * room),
                     .enough = -1};
    while (done < count && !fr_progress_is_cancelled(progress)) {
        uint32_t size = MIN(CLAMP(done / BATCHES, LEAST_BATCH, MOST_BATCH), count - done);
        choose_batch(&batch, chosen + done, done, size);
        done += size;
    }
    fr_near_free(batch.before);
    g_free(batch.places);
    g_free(batch.items);
    return chosen;
}
