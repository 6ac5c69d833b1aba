#include "studio/model/builder_private.h"
#include "studio/model/clocks.h"

enum { COARSE_FROM = 20000 }; // internodes from which on the coarse wood is worth making

// A running build that takes longer than this gives way to a newer request; a shorter one is
// finished and shown, so that a long drag shows something.
static const double patience = 0.4;

static void request_free(StudioRequest *request) {
    if (request != NULL) {
        fr_source_unref(request->source);
        g_free(request->folder);
        g_free(request);
    }
}

static void built_free(StudioBuilt *built) {
    if (built != NULL) {
        fr_diags_free(built->diags);
        g_clear_pointer(&built->counts, g_array_unref);
        g_clear_pointer(&built->loads, g_array_unref);
        g_free(built);
    }
}

// ---- the thread --------------------------------------------------------------------------------

static void report(void *user, const char *stage, double fraction) {
    (void)stage;
    StudioBuilder *builder = user;
    g_atomic_int_set(&builder->fraction, (gint)(fraction * 1000));
}

static double seconds_since(gint64 began) {
    return (double)(g_get_monotonic_time() - began) * 1e-6;
}

// Pictures of looks that are new are made elsewhere; what they cost does not hold up the build.
static void paint_looks(StudioBuilder *builder) {
    for (guint p = 0; p < builder->view->plants->len; p++) {
        const StudioPlant *plant = g_ptr_array_index(builder->view->plants, p);
        for (guint i = 0; i < plant->looks->len; i++) {
            const StudioLook *look = &g_array_index(plant->looks, StudioLook, i);
            studio_painter_add(builder->painter, look->material, look->digest);
        }
    }
}

// The light of the scene, anew where it has changed.
static void shade(StudioBuilder *builder, StudioView *view, const FrContext *context) {
    FrDigest digest = fr_shading_digest(view->scene);
    if (builder->view == NULL || builder->shaded != digest) {
        builder->shading = fr_shading_of(view->scene, context);
        builder->shaded = digest;
    }
    view->shading = builder->shading;
}

// Takes a new view; large ones get what is drawn while they move, taken over where no wood changed.
static void adopt_view(StudioBuilder *builder, StudioView *view, const FrContext *context) {
    shade(builder, view, context);
    studio_view_take_coarse(view, builder->view);
    studio_view_free(builder->view);
    builder->view = view;
    builder->scene = view->scene;
    if (studio_view_nodes(view) >= COARSE_FROM) {
        studio_view_add_coarse(view, context);
    }
}

// The view of what grows step by step. The document is taken over or freed.
static FrStatus grow(StudioBuilder *builder, const StudioRequest *request, FrDocument *document,
                     const FrContext *context, StudioBuilt *built) {
    size_t size;
    char *text = fr_document_text(document, &size);
    int64_t step = request->moment.step;
    FrStatus status =
        studio_grower_take(builder->grower, document, fr_digest(0, text, size), step >= 0, context);
    g_free(text);
    if (status != FR_OK) {
        fr_document_free(document);
        return status;
    }
    builder->scene = NULL;
    FrStatus gone = studio_grower_go(builder->grower, step, context);
    StudioView *view;
    FrContext calm = *context; // what has grown is shown, cancelled or not
    calm.progress = NULL;
    status = studio_grower_view(builder->grower, &calm, &view);
    if (status == FR_OK) {
        adopt_view(builder, view, &calm);
        built->view = view;
    }
    built->is_growing = true;
    built->step = studio_grower_step(builder->grower);
    built->step_count = studio_grower_step_count(builder->grower);
    return status == FR_OK ? gone : status;
}

static FrStatus rebuild(StudioBuilder *builder, FrDocument *document, const FrContext *context,
                        StudioBuilt *built) {
    FrStatus status = fr_rebuild_update(builder->rebuild, document, -1, context);
    if (status == FR_OK) {
        gint64 began = g_get_monotonic_time();
        FrContext calm = *context; // the rebuild is done: its view is made whole
        calm.progress = NULL;
        adopt_view(builder, studio_view_new(builder->rebuild, &calm), &calm);
        built->view = builder->view;
        built->times.view = seconds_since(began);
    }
    fr_document_free(document);
    return status;
}

// Tells the main thread of the ground, and where plants and what deforms them stand.
static void hand_ground(StudioBuilder *builder, StudioGround *ground) {
    GArray *stands = g_array_new(FALSE, FALSE, sizeof(StudioStand));
    for (uint32_t i = 0; i < fr_scene_stand_count(builder->scene); i++) {
        const FrStand *from = &g_array_index(builder->scene->stands, FrStand, i);
        StudioStand stand = {{from->at[0], from->at[1], from->at[2]}, from->origin, from->number};
        g_array_append_val(stands, stand);
    }
    GArray *footings = studio_footings_of(builder->scene);
    g_mutex_lock(&builder->lock);
    studio_ground_unref(builder->ground);
    g_clear_pointer(&builder->stands, g_array_unref);
    g_clear_pointer(&builder->footings, g_array_unref);
    builder->ground = ground;
    builder->stands = stands;
    builder->footings = footings;
    g_mutex_unlock(&builder->lock);
}

static FrStatus build(StudioBuilder *builder, const StudioRequest *request,
                      const FrContext *context, StudioBuilt *built) {
    gint64 began = g_get_monotonic_time();
    FrSource *source = studio_source_at_time(request->source, request->moment.time, context);
    FrDocument *document;
    FrStatus status = fr_document_parse(source, request->folder, context, &document);
    built->times.read = seconds_since(began);
    began = g_get_monotonic_time();
    StudioGround *ground = status == FR_OK ? studio_ground_new(document, context) : NULL;
    if (status != FR_OK) {
        fr_document_free(document);
    } else if (studio_grower_is_wanted(document)) {
        status = grow(builder, request, document, context, built);
    } else {
        status = rebuild(builder, document, context, built);
    }
    built->times.build = seconds_since(began) - built->times.view;
    if (built->view != NULL) {
        built->counts = studio_counts_of(builder->view);
        built->loads = studio_plant_loads(builder->view, built->counts,
                                          built->is_growing ? builder->grower : NULL);
        paint_looks(builder);
        hand_ground(builder, ground);
    } else {
        studio_ground_unref(ground);
    }
    fr_source_unref(source);
    return status;
}

// Hands an outcome over and waits until it has been looked at: it borrows from the rebuild.
static void deliver(StudioBuilder *builder, const StudioRequest *request, StudioBuilt *built) {
    g_mutex_lock(&builder->lock);
    if (built->view != NULL) {
        builder->stood = request->number;
        builder->stood_round = request->round;
    }
    builder->built = built;
    builder->is_changing = false;
    builder->wake(builder->user);
    while (builder->built != NULL && !builder->is_over) {
        if (!studio_builder_make_copy(builder)) {
            g_cond_wait(&builder->changed, &builder->lock);
        }
    }
    g_mutex_unlock(&builder->lock);
}

static void serve(StudioBuilder *builder, StudioRequest *request, FrProgress *progress) {
    if (builder->watch != NULL) {
        builder->watch(builder->watcher, NULL, NULL);
    }
    FrContext context = fr_context_default();
    context.pool = builder->pool;
    context.progress = progress;
    context.diags = fr_diags_new();
    StudioBuilt *built = g_new0(StudioBuilt, 1);
    built->revision = request->revision;
    built->round = request->round;
    built->diags = context.diags;
    StudioDraft draft = {request->source, request->folder, request->moment.time};
    studio_ahead_begin(builder->ahead, &draft, &context);
    built->status = build(builder, request, &context, built);
    bool is_large = fr_rebuild_work(builder->rebuild).instances_made > 0;
    studio_ahead_end(builder->ahead, &draft, built->view == NULL ? NULL : builder->scene,
                     built->counts, is_large ? built->times.build + built->times.view : 0,
                     &context);
    if (built->view != NULL) {
        builder->is_growing = built->is_growing;
    }
    deliver(builder, request, built);
}

static void look(StudioBuilder *builder, FrProgress *progress) {
    if (builder->watch == NULL || builder->view == NULL) {
        return;
    }
    FrContext context = fr_context_default();
    context.pool = builder->pool;
    context.progress = progress;
    StudioSeen seen = {builder->view->scene,
                       builder->is_growing ? studio_grower_growth(builder->grower) : NULL};
    builder->watch(builder->watcher, &seen, &context);
}

static gpointer run(gpointer data) {
    StudioBuilder *builder = data;
    g_mutex_lock(&builder->lock);
    while (!builder->is_over) {
        if (studio_builder_make_copy(builder)) {
            continue;
        }
        if (builder->waiting == NULL && !builder->is_look_due) {
            g_cond_wait(&builder->changed, &builder->lock);
            continue;
        }
        StudioRequest *request = g_steal_pointer(&builder->waiting);
        builder->is_looking = request == NULL;
        builder->is_changing = request != NULL;
        builder->is_look_due = request != NULL; // what it makes is looked at next
        FrProgress *progress = fr_progress_new(report, builder);
        builder->progress = progress;
        builder->began = g_get_monotonic_time();
        g_atomic_int_set(&builder->fraction, 0);
        g_mutex_unlock(&builder->lock);
        if (request != NULL) {
            serve(builder, request, progress);
        } else {
            look(builder, progress);
        }
        request_free(request);
        g_mutex_lock(&builder->lock);
        builder->progress = NULL;
        builder->is_looking = false;
        fr_progress_free(progress);
    }
    g_mutex_unlock(&builder->lock);
    return NULL;
}

// ---- the main thread's side --------------------------------------------------------------------

StudioBuilder *studio_builder_new(StudioWake wake, void *user) {
    StudioBuilder *builder = g_new0(StudioBuilder, 1);
    builder->wake = wake;
    builder->user = user;
    g_mutex_init(&builder->lock);
    g_cond_init(&builder->changed);
    FrSkinParams params = fr_skin_default();
    params.foliage = false;
    builder->rebuild = fr_rebuild_new(&params, FR_UP_Z);
    builder->ahead = studio_ahead_new(wake, user);
    builder->grower = studio_grower_new();
    builder->pool = fr_pool_new(0);
    builder->painter = studio_painter_new(wake, user);
    builder->thread = g_thread_new("builder", run, builder);
    return builder;
}

void studio_builder_free(StudioBuilder *builder) {
    if (builder == NULL) {
        return;
    }
    g_mutex_lock(&builder->lock);
    builder->is_over = true;
    fr_progress_cancel(builder->progress);
    g_cond_broadcast(&builder->changed);
    g_mutex_unlock(&builder->lock);
    g_thread_join(builder->thread);
    studio_builder_drop_copies(builder);
    if (builder->watch != NULL) {
        builder->watch(builder->watcher, NULL, NULL);
    }
    studio_painter_free(builder->painter);
    studio_view_free(builder->view);
    studio_ground_unref(builder->ground);
    g_clear_pointer(&builder->stands, g_array_unref);
    g_clear_pointer(&builder->footings, g_array_unref);
    built_free(builder->built);
    request_free(builder->waiting);
    fr_rebuild_free(builder->rebuild);
    studio_ahead_free(builder->ahead);
    studio_grower_free(builder->grower);
    fr_pool_free(builder->pool);
    g_cond_clear(&builder->changed);
    g_mutex_clear(&builder->lock);
    g_free(builder);
}

void studio_builder_request(StudioBuilder *builder, FrSource *source, const char *folder,
                            uint64_t revision, StudioMoment moment) {
    StudioRequest *request = g_new(StudioRequest, 1);
    *request = (StudioRequest){fr_source_ref(source), g_strdup(folder), revision, moment, 0, 0};
    g_mutex_lock(&builder->lock);
    request->round = builder->round;
    request->number = ++builder->asked;
    request_free(builder->waiting);
    builder->waiting = request;
    if (builder->progress != NULL &&
        (builder->is_looking || seconds_since(builder->began) > patience)) {
        fr_progress_cancel(builder->progress);
    }
    g_cond_broadcast(&builder->changed);
    g_mutex_unlock(&builder->lock);
}

void studio_builder_forget(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    builder->round++;
    g_clear_pointer(&builder->waiting, request_free);
    studio_builder_drop_copies(builder);
    studio_ahead_forget(builder->ahead);
    fr_progress_cancel(builder->progress);
    g_mutex_unlock(&builder->lock);
}

void studio_builder_watch(StudioBuilder *builder, StudioWatch watch, void *user) {
    builder->watch = watch;
    builder->watcher = user;
}

void studio_builder_look(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    if (builder->is_looking) {
        fr_progress_cancel(builder->progress);
    }
    builder->is_look_due = true;
    g_cond_broadcast(&builder->changed);
    g_mutex_unlock(&builder->lock);
}

void studio_builder_cancel(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    fr_progress_cancel(builder->progress);
    g_mutex_unlock(&builder->lock);
}

bool studio_builder_is_busy(StudioBuilder *builder, double *fraction, double *seconds) {
    g_mutex_lock(&builder->lock);
    bool is_running = builder->progress != NULL;
    bool is_busy =
        is_running || builder->waiting != NULL || builder->built != NULL || builder->is_look_due;
    *seconds = is_running ? seconds_since(builder->began) : 0;
    g_mutex_unlock(&builder->lock);
    *fraction = g_atomic_int_get(&builder->fraction) / 1000.0;
    return is_busy;
}

bool studio_builder_is_looking(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    bool is_looking = builder->is_looking;
    g_mutex_unlock(&builder->lock);
    return is_looking;
}

const StudioBuilt *studio_builder_collect(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    StudioBuilt *built = builder->is_held ? NULL : builder->built;
    builder->is_held = built != NULL;
    if (built != NULL) {
        builder->collected = MAX(builder->collected, built->revision);
        built->is_forgotten = built->round != builder->round;
    }
    g_mutex_unlock(&builder->lock);
    return built;
}

void studio_builder_release(StudioBuilder *builder) {
    g_mutex_lock(&builder->lock);
    if (builder->is_held) {
        built_free(builder->built);
        builder->built = NULL;
        builder->is_held = false;
        g_cond_broadcast(&builder->changed);
    }
    g_mutex_unlock(&builder->lock);
}

StudioOverlay *studio_builder_take_ahead(StudioBuilder *builder) {
    return studio_ahead_take(builder->ahead);
}

bool studio_builder_take_picture(StudioBuilder *builder, StudioPicture *picture) {
    return studio_painter_take(builder->painter, picture);
}

void studio_builder_paint(StudioBuilder *builder, FrMaterial *material) {
    studio_painter_add(builder->painter, material,
                       studio_look_digest(fr_material_params(material)));
}

bool studio_builder_is_painting(StudioBuilder *builder) {
    return studio_painter_is_busy(builder->painter);
}
