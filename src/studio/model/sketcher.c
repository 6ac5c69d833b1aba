#include "studio/model/sketcher.h"

#include "frond/contents.h"
#include "frond/scene.h"

#include <math.h>
#include <string.h>

// What runs longer gives way to a newer request.
static const double patience = 0.4; // seconds

typedef struct Ask {
    FrSource *source;
    char *folder;
    StudioSketchOf of;
    StudioSketchAsk wanted;
    uint64_t serial;
} Ask;

struct StudioSketcher {
    void (*wake)(void *user);
    void *user;
    GThread *thread;
    GMutex lock;
    GCond changed;
    // Under the lock:
    Ask *waiting;
    FrProgress *progress; // of what runs; NULL: nothing
    gint64 began;
    StudioSketched *done;
    bool is_over;
    uint64_t serial;
    // Of the thread alone:
    FrPool *pool;
    FrPlant *grown; // the base as its engine made it; NULL
    StudioBase *base;
    FrDigest digest; // of what it was grown from
};

StudioBase *studio_base_ref(StudioBase *base) {
    return base == NULL ? NULL : g_atomic_rc_box_acquire(base);
}

static void base_clear(gpointer data) {
    fr_plant_free(((StudioBase *)data)->plant);
}

void studio_base_unref(StudioBase *base) {
    if (base != NULL) {
        g_atomic_rc_box_release_full(base, base_clear);
    }
}

static void ask_free(Ask *ask) {
    if (ask != NULL) {
        fr_source_unref(ask->source);
        studio_sketch_of_clear(&ask->of);
        g_free(ask->folder);
        g_free(ask);
    }
}

void studio_sketched_free(StudioSketched *sketched) {
    if (sketched != NULL) {
        fr_diags_free(sketched->diags);
        studio_base_unref(sketched->base);
        g_ptr_array_unref(sketched->instances);
        g_free(sketched->stroke);
        g_free(sketched);
    }
}

// ---- the thread --------------------------------------------------------------------------------

static const FrPlantDef *find_plant(const FrDocument *document, const char *id) {
    const GPtrArray *plants = fr_document_plants(document);
    for (guint i = 0; id != NULL && i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (strcmp(plant->id, id) == 0) {
            return plant;
        }
    }
    return NULL;
}

// Digest of the text but for the variation: what the base may depend on.
static FrDigest digest_of(const Ask *ask) {
    size_t size, begin = 0, end = 0;
    const char *text = fr_source_text(ask->source, &size);
    FrContext context = fr_context_default();
    FrContents *contents;
    if (fr_contents_read(ask->source, &context, &contents) == FR_OK) {
        uint32_t vary = studio_sketch_vary(contents, ask->of.varied);
        if (vary != FR_NONE) {
            const FrContentsElement *element = fr_contents_at(contents, vary);
            begin = element->begin;
            end = element->end;
        }
        fr_contents_free(contents);
    }
    FrDigest digest = fr_digest(0, text, begin);
    digest = fr_digest(digest, text + end, size - end);
    return fr_digest(digest, ask->of.base, strlen(ask->of.base));
}

// A plant as it is shown.
static FrPlant *shown(const FrPlant *plant) {
    return plant->deformers->len > 0 ? fr_plant_deformed(plant) : fr_plant_copy(plant);
}

static FrStatus grow_base(StudioSketcher *sketcher, const FrDocument *document, const Ask *ask,
                          const FrContext *context) {
    FrDigest digest = digest_of(ask);
    if (sketcher->grown != NULL && digest == sketcher->digest) {
        return FR_OK;
    }
    const FrPlantDef *base = find_plant(document, ask->of.base);
    if (base == NULL || base->kind == FR_PLANT_VARIED) {
        fr_diags_add(context->diags, FR_ERROR, "unknown-plant", fr_document_span(document),
                     "there is no plant '%.64s' to sketch over", ask->of.base);
        return FR_ERR_DOCUMENT;
    }
    FrScenePlant built = {0};
    FrStatus status = fr_scene_grow(document, base, -1, NAN, context, &built, NULL);
    g_free(built.by_component);
    if (status != FR_OK) {
        fr_plant_free(built.plant);
        return status;
    }
    bool is_same =
        sketcher->grown != NULL && fr_plant_digest(sketcher->grown) == fr_plant_digest(built.plant);
    if (!is_same) { // who has selected branches of it keeps them where it is the same
        studio_base_unref(sketcher->base);
        sketcher->base = g_atomic_rc_box_new0(StudioBase);
        sketcher->base->plant = shown(built.plant);
    }
    fr_plant_free(sketcher->grown);
    sketcher->grown = built.plant;
    sketcher->digest = digest;
    return FR_OK;
}

static FrStatus vary(StudioSketcher *sketcher, const FrPlantDef *varied, const Ask *ask,
                     const FrContext *context, StudioSketched *done) {
    FrVaryParams *params = fr_vary_params(varied->vary);
    params->tilt = atan(ask->wanted.strength * tan(params->tilt));
    FrVaryPlan *plan;
    FrStatus status = fr_vary_prepare(varied->vary, sketcher->grown, context, &plan);
    if (status != FR_OK) {
        return status;
    }
    uint32_t count = sketcher->grown->axes.count;
    done->stroke = g_new(uint32_t, count + 1);
    for (uint32_t a = 0; a < count; a++) {
        done->stroke[a] = fr_vary_stroke_of(plan, a);
    }
    FrPlant **instances = g_new0(FrPlant *, ask->wanted.count + 1);
    status = fr_vary_collection(plan, ask->wanted.seed, ask->wanted.count, context, instances);
    for (uint32_t i = 0; status == FR_OK && i < ask->wanted.count; i++) {
        FrPlant *instance = instances[i];
        if (instance->deformers->len > 0) {
            instance = fr_plant_deformed(instances[i]);
            fr_plant_free(instances[i]);
        }
        g_ptr_array_add(done->instances, instance);
    }
    g_free(instances);
    fr_vary_plan_free(plan);
    return status;
}

static void destroy_plant(gpointer plant) {
    fr_plant_free(plant);
}

static StudioSketched *work(StudioSketcher *sketcher, const Ask *ask, FrProgress *progress) {
    gint64 began = g_get_monotonic_time();
    StudioSketched *done = g_new0(StudioSketched, 1);
    done->serial = ask->serial;
    done->diags = fr_diags_new();
    done->instances = g_ptr_array_new_with_free_func(destroy_plant);
    FrContext context = fr_context_default();
    context.pool = sketcher->pool;
    context.progress = progress;
    context.diags = done->diags;
    FrDocument *document = NULL;
    done->status = fr_document_parse(ask->source, ask->folder, &context, &document);
    if (done->status == FR_OK) {
        done->status = grow_base(sketcher, document, ask, &context);
    }
    if (done->status == FR_OK) {
        done->base = studio_base_ref(sketcher->base);
        const FrPlantDef *varied = find_plant(document, ask->of.varied);
        if (varied != NULL && varied->vary != NULL) {
            done->status = vary(sketcher, varied, ask, &context, done);
        }
    }
    fr_document_free(document);
    done->seconds = (double)(g_get_monotonic_time() - began) * 1e-6;
    return done;
}

static gpointer run(gpointer data) {
    StudioSketcher *sketcher = data;
    g_mutex_lock(&sketcher->lock);
    for (;;) {
        while (sketcher->waiting == NULL && !sketcher->is_over) {
            g_cond_wait(&sketcher->changed, &sketcher->lock);
        }
        if (sketcher->is_over) {
            break;
        }
        Ask *ask = g_steal_pointer(&sketcher->waiting);
        FrProgress *progress = sketcher->progress = fr_progress_new(NULL, NULL);
        sketcher->began = g_get_monotonic_time();
        g_mutex_unlock(&sketcher->lock);
        StudioSketched *done = work(sketcher, ask, progress);
        g_mutex_lock(&sketcher->lock);
        sketcher->progress = NULL;
        bool is_useless = done->status == FR_CANCELLED;
        if (is_useless) {
            studio_sketched_free(done);
        } else {
            studio_sketched_free(sketcher->done);
            sketcher->done = done;
        }
        bool is_over = sketcher->is_over;
        g_mutex_unlock(&sketcher->lock);
        fr_progress_free(progress);
        ask_free(ask);
        if (!is_over && !is_useless) {
            sketcher->wake(sketcher->user);
        }
        g_mutex_lock(&sketcher->lock);
    }
    g_mutex_unlock(&sketcher->lock);
    return NULL;
}

// ---- the main thread ---------------------------------------------------------------------------

StudioSketcher *studio_sketcher_new(void (*wake)(void *user), void *user) {
    StudioSketcher *sketcher = g_new0(StudioSketcher, 1);
    sketcher->wake = wake;
    sketcher->user = user;
    sketcher->pool = fr_pool_new(0);
    g_mutex_init(&sketcher->lock);
    g_cond_init(&sketcher->changed);
    sketcher->thread = g_thread_new("sketch", run, sketcher);
    return sketcher;
}

void studio_sketcher_free(StudioSketcher *sketcher) {
    if (sketcher == NULL) {
        return;
    }
    g_mutex_lock(&sketcher->lock);
    sketcher->is_over = true;
    if (sketcher->progress != NULL) {
        fr_progress_cancel(sketcher->progress);
    }
    g_cond_signal(&sketcher->changed);
    g_mutex_unlock(&sketcher->lock);
    g_thread_join(sketcher->thread);
    ask_free(sketcher->waiting);
    studio_sketched_free(sketcher->done);
    fr_plant_free(sketcher->grown);
    studio_base_unref(sketcher->base);
    fr_pool_free(sketcher->pool);
    g_mutex_clear(&sketcher->lock);
    g_cond_clear(&sketcher->changed);
    g_free(sketcher);
}

uint64_t studio_sketcher_ask(StudioSketcher *sketcher, FrSource *source, const char *folder,
                             const StudioSketchOf *of, StudioSketchAsk wanted) {
    Ask *ask = g_new0(Ask, 1);
    *ask = (Ask){.source = fr_source_ref(source),
                 .folder = g_strdup(folder),
                 .of = {g_strdup(of->base), g_strdup(of->varied)},
                 .wanted = wanted};
    g_mutex_lock(&sketcher->lock);
    uint64_t serial = ask->serial = ++sketcher->serial;
    ask_free(sketcher->waiting);
    sketcher->waiting = ask;
    double runs = (double)(g_get_monotonic_time() - sketcher->began) * 1e-6;
    if (sketcher->progress != NULL && runs > patience) {
        fr_progress_cancel(sketcher->progress);
    }
    g_cond_signal(&sketcher->changed);
    g_mutex_unlock(&sketcher->lock);
    return serial;
}

StudioSketched *studio_sketcher_take(StudioSketcher *sketcher) {
    g_mutex_lock(&sketcher->lock);
    StudioSketched *done = g_steal_pointer(&sketcher->done);
    g_mutex_unlock(&sketcher->lock);
    return done;
}

bool studio_sketcher_is_busy(StudioSketcher *sketcher) {
    g_mutex_lock(&sketcher->lock);
    bool is_busy =
        sketcher->waiting != NULL || sketcher->progress != NULL || sketcher->done != NULL;
    g_mutex_unlock(&sketcher->lock);
    return is_busy;
}
