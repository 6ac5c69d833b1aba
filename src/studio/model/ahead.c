#include "studio/model/ahead.h"

#include "frond/document.h"
#include "studio/model/clocks.h"
#include "studio/model/outline.h"

#include <math.h>

enum { MANY = 2000, MOST_LINES = 12000, MOST_STANDS = 2000, ORDERS = 16 };

// A picture within a tenth of a second is at once; sending and drawing take a part of that.
static const double at_once = 0.06;

struct StudioAhead {
    StudioWake wake;
    void *user;
    GMutex lock;
    StudioOverlay *skeleton; // under the lock; NULL: none
    gint is_forgotten;       // atomic: what follows is of another document
    // Of the thread that builds:
    GArray
        *counts; // StudioCount, of the last build; NULL: unknown, or there are others than p-graphs
    double seconds;    // the last build that made much took
    FrDigest digest;   // of the lines of the last skeleton …
    bool has_skeleton; // … if there was one
};

// ---- the skeleton ------------------------------------------------------------------------------

static const FrPlant *plant_at(const FrScene *scene, guint index) {
    return g_array_index(scene->plants, FrScenePlant, index).plant;
}

static uint32_t order_of(const FrPlant *plant, uint32_t axis) {
    return MIN(plant->axes.order[axis], ORDERS - 1);
}

// How many of each plant stand. Free with g_free().
static uint64_t *count_stands(const FrScene *scene) {
    uint64_t *counts = g_new0(uint64_t, scene->plants->len + 1);
    for (guint s = 0; s < scene->stands->len; s++) {
        counts[g_array_index(scene->stands, FrStand, s).plant]++;
    }
    return counts;
}

// The greatest order of branches with which there are not too many lines; stems there are at least.
static uint32_t last_order(const FrScene *scene, const uint64_t *stands, uint64_t most) {
    uint64_t counts[ORDERS] = {0};
    for (guint p = 0; p < scene->plants->len; p++) {
        const FrPlant *plant = plant_at(scene, p);
        for (uint32_t i = 0; stands[p] > 0 && i < plant->nodes.count; i++) {
            counts[order_of(plant, plant->nodes.axis[i])] += stands[p];
        }
    }
    uint32_t order = 0;
    uint64_t sum = counts[0];
    while (order + 1 < ORDERS && sum + counts[order + 1] <= most) {
        sum += counts[++order];
    }
    return order;
}

// Lines of the lowest orders of one plant, where it stands.
static void outline(GArray *ends, const FrStand *stand, const FrPlant *plant, uint32_t order,
                    uint64_t most) {
    for (uint32_t axis = 0; axis < plant->axes.count && ends->len < 2 * most; axis++) {
        if (order_of(plant, axis) <= order &&
            (plant->axes.flags[axis] & (FR_SHED | FR_HIDDEN)) == 0) {
            studio_outline_axis(ends, stand, plant, axis);
        }
    }
}

static StudioOverlay *skeleton_of(const FrScene *scene, uint64_t most) {
    static const float paint[4] = {0.80f, 0.93f, 0.72f, 0.9f};
    uint64_t *stands = count_stands(scene);
    uint32_t order = last_order(scene, stands, most);
    GArray *ends = g_array_new(FALSE, FALSE, 3 * sizeof(float));
    for (guint s = 0; s < scene->stands->len; s++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, s);
        outline(ends, stand, plant_at(scene, stand->plant), order, most);
    }
    StudioOverlay *overlay = studio_overlay_new();
    overlay->through = 0.8f;
    for (guint i = 0; i + 1 < ends->len; i += 2) {
        double at[2][3];
        for (guint k = 0; k < 6; k++) {
            at[k / 3][k % 3] = (double)((const float *)(const void *)ends->data)[3 * i + k];
        }
        studio_overlay_line(overlay, at[0], at[1], 1.5, paint);
    }
    g_array_unref(ends);
    g_free(stands);
    return overlay;
}

// ---- the document without what there is much of ------------------------------------------------

static void thin(const StudioAhead *ahead, FrDocument *document, const FrContext *context) {
    for (guint i = 0; i < ahead->counts->len; i++) {
        const StudioCount *count = &g_array_index(ahead->counts, StudioCount, i);
        if (count->instances >= MANY) {
            char *path = g_strdup_printf("%s.%s.enabled", count->plant, count->component);
            FrStatus status = fr_document_set(document, path, "no", context);
            (void)status; // it may be gone since
            g_free(path);
        }
    }
}

// NULL: it cannot be built, or is too much even so.
static StudioOverlay *build_thin(const StudioAhead *ahead, const StudioDraft *draft,
                                 const FrContext *context) {
    FrContext quiet = *context;
    quiet.diags = fr_diags_new(); // the whole build will say what is wrong
    quiet.limits.instances = MIN(quiet.limits.instances, 20ULL * MANY);
    FrSource *source = studio_source_at_time(draft->source, draft->time, &quiet);
    FrDocument *document = NULL;
    FrScene *scene = NULL;
    StudioOverlay *skeleton = NULL;
    if (fr_document_parse(source, draft->folder, &quiet, &document) == FR_OK) {
        thin(ahead, document, &quiet);
        if (fr_scene_build(document, -1, &quiet, &scene) == FR_OK) {
            skeleton = skeleton_of(scene, MOST_LINES);
            fr_scene_free(scene);
        }
    }
    fr_document_free(document);
    fr_source_unref(source);
    fr_diags_free(quiet.diags);
    return skeleton;
}

// The skeleton if it is another than the last time, or NULL.
static StudioOverlay *next_skeleton(StudioAhead *ahead, const StudioDraft *draft,
                                    const FrContext *context) {
    StudioOverlay *skeleton = build_thin(ahead, draft, context);
    FrDigest digest = skeleton == NULL ? 0
                                       : fr_digest(0, skeleton->lines->data,
                                                   skeleton->lines->len * sizeof(StudioMark));
    bool is_new = skeleton != NULL && ahead->has_skeleton && digest != ahead->digest;
    ahead->has_skeleton = skeleton != NULL;
    ahead->digest = digest;
    if (!is_new) {
        studio_overlay_free(skeleton);
    }
    return is_new ? skeleton : NULL;
}

// Strings and plants that grow in steps take their time even where little is made of them.
static bool is_fit(const FrScene *scene) {
    bool is_all = scene->stands->len <= MOST_STANDS;
    for (guint p = 0; p < scene->plants->len && is_all; p++) {
        const FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, p);
        is_all = plant->by_component != NULL && plant->modules == 0;
    }
    return is_all;
}

// ---- when it is shown --------------------------------------------------------------------------

StudioAhead *studio_ahead_new(StudioWake wake, void *user) {
    StudioAhead *ahead = g_new0(StudioAhead, 1);
    ahead->wake = wake;
    ahead->user = user;
    g_mutex_init(&ahead->lock);
    return ahead;
}

void studio_ahead_free(StudioAhead *ahead) {
    studio_overlay_free(ahead->skeleton);
    g_clear_pointer(&ahead->counts, g_array_unref);
    g_mutex_clear(&ahead->lock);
    g_free(ahead);
}

static void hand_out(StudioAhead *ahead, StudioOverlay *skeleton) {
    g_mutex_lock(&ahead->lock);
    studio_overlay_free(ahead->skeleton);
    ahead->skeleton = skeleton;
    g_mutex_unlock(&ahead->lock);
}

void studio_ahead_begin(StudioAhead *ahead, const StudioDraft *draft, const FrContext *context) {
    if (g_atomic_int_and((guint *)&ahead->is_forgotten, 0) != 0) {
        g_clear_pointer(&ahead->counts, g_array_unref);
        ahead->has_skeleton = false;
    }
    if (ahead->counts == NULL || ahead->seconds < at_once) {
        return;
    }
    StudioOverlay *skeleton = next_skeleton(ahead, draft, context);
    if (skeleton != NULL) {
        hand_out(ahead, skeleton);
        ahead->wake(ahead->user);
    }
}

void studio_ahead_end(StudioAhead *ahead, const StudioDraft *draft, const FrScene *scene,
                      GArray *counts, double seconds, const FrContext *context) {
    hand_out(ahead, NULL);
    if (scene == NULL) {
        return;
    }
    g_clear_pointer(&ahead->counts, g_array_unref);
    ahead->counts = is_fit(scene) ? g_array_ref(counts) : NULL;
    ahead->seconds = seconds > 0 ? seconds : ahead->seconds;
    if (ahead->counts != NULL && !ahead->has_skeleton && ahead->seconds >= at_once) {
        studio_overlay_free(next_skeleton(ahead, draft, context)); // that the next can be told from
    }
}

void studio_ahead_forget(StudioAhead *ahead) {
    g_atomic_int_set(&ahead->is_forgotten, 1);
    hand_out(ahead, NULL);
}

StudioOverlay *studio_ahead_take(StudioAhead *ahead) {
    g_mutex_lock(&ahead->lock);
    StudioOverlay *skeleton = g_steal_pointer(&ahead->skeleton);
    g_mutex_unlock(&ahead->lock);
    return skeleton;
}
