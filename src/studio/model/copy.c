#include "studio/model/copy.h"

#include "frond/only.h"
#include "studio/model/builder_private.h"

enum { GLANCE_MICROSECONDS = 50000 }; // between two looks whether it has been cancelled

struct StudioCopy {
    gatomicrefcount references;
    StudioWhich which;
    uint64_t number; // of the request that it follows, and …
    uint64_t round;  // … its round
    GMutex lock;
    GCond answered;
    // Under its lock:
    bool is_done, is_gone, is_behind;
    bool stands; // there was something to be copied
    FrScene *scene;
};

void studio_copy_free(StudioCopy *copy) {
    if (copy != NULL && g_atomic_ref_count_dec(&copy->references)) {
        fr_scene_free(copy->scene);
        g_mutex_clear(&copy->lock);
        g_cond_clear(&copy->answered);
        g_free(copy);
    }
}

StudioCopy *studio_builder_copy(StudioBuilder *builder, const StudioWhich *which) {
    StudioCopy *copy = g_new0(StudioCopy, 1);
    g_atomic_ref_count_init(&copy->references);
    g_mutex_init(&copy->lock);
    g_cond_init(&copy->answered);
    copy->which = *which;
    g_atomic_ref_count_inc(&copy->references); // the builder's
    g_mutex_lock(&builder->lock);
    copy->number = builder->asked;
    copy->round = builder->round;
    g_queue_push_tail(&builder->copies, copy);
    if (builder->is_looking) {
        fr_progress_cancel(builder->progress);
        builder->is_look_due = true;
    }
    g_cond_broadcast(&builder->changed);
    g_mutex_unlock(&builder->lock);
    return copy;
}

// ---- the builder's side ------------------------------------------------------------------------

static void answer(StudioCopy *copy) {
    g_mutex_lock(&copy->lock);
    copy->is_done = true;
    g_cond_broadcast(&copy->answered);
    g_mutex_unlock(&copy->lock);
    studio_copy_free(copy);
}

void studio_builder_drop_copies(StudioBuilder *builder) {
    StudioCopy *copy;
    while ((copy = g_queue_pop_head(&builder->copies)) != NULL) {
        copy->is_gone = true;
        answer(copy);
    }
}

static void make(StudioCopy *copy, const FrScene *scene) {
    const StudioWhich *which = &copy->which;
    copy->stands = scene != NULL;
    if (scene != NULL && !which->is_one) {
        copy->scene = fr_only_copy(NULL, scene, true);
    } else if (scene != NULL && !copy->is_behind) { // the text has moved what placed it
        FrOnly *only = fr_only_one(which->origin, which->number);
        copy->scene = fr_only_copy(only, scene, which->in_place);
        fr_only_free(only);
    }
}

bool studio_builder_make_copy(StudioBuilder *builder) {
    StudioCopy *copy = g_queue_peek_head(&builder->copies);
    if (copy == NULL || (builder->waiting != NULL && builder->stood < copy->number)) {
        return false;
    }
    g_queue_pop_head(&builder->copies);
    copy->is_behind = builder->stood < copy->number;
    const FrScene *scene = builder->stood_round == copy->round ? builder->scene : NULL;
    g_mutex_unlock(&builder->lock);
    make(copy, scene);
    answer(copy);
    g_mutex_lock(&builder->lock);
    return true;
}

// ---- who has asked -----------------------------------------------------------------------------

FrStatus studio_copy_take(StudioCopy *copy, const FrContext *context, FrScene **scene,
                          bool *is_behind) {
    g_mutex_lock(&copy->lock);
    while (!copy->is_done && !fr_progress_is_cancelled(context->progress)) {
        g_cond_wait_until(&copy->answered, &copy->lock,
                          g_get_monotonic_time() + GLANCE_MICROSECONDS);
    }
    bool is_made = copy->is_done && !copy->is_gone;
    bool stands = is_made && copy->stands;
    *is_behind = is_made && copy->is_behind;
    *scene = is_made ? g_steal_pointer(&copy->scene) : NULL;
    g_mutex_unlock(&copy->lock);
    if (*scene != NULL || !is_made) {
        return is_made ? FR_OK : FR_CANCELLED;
    }
    if (stands) {
        fr_diags_add(
            context->diags, FR_ERROR, "unknown-stand", (FrSpan){0},
            "the plant does not stand in the scene any more, or its seed has no place there");
    } else {
        fr_diags_add(context->diags, FR_ERROR, "nothing-stands", (FrSpan){0},
                     "nothing could be made of this document that could be written");
    }
    return FR_ERR_DOCUMENT;
}
