// Progress of long work, throttled, and its cancellation.
#include "frond/progress.h"

#include <glib.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

enum { MICROSECONDS_BETWEEN_REPORTS = 100000 };

struct FrProgress {
    FrProgressFn report;
    void *user;
    atomic_bool is_cancelled;
    // Hints that let most calls return without the lock.
    _Atomic(const char *) last_stage;
    _Atomic int64_t last_time;
    pthread_mutex_t lock; // pthread, not GMutex: thread sanitizers see through it
    char stage[32];
    double fraction;
};

FrProgress *fr_progress_new(FrProgressFn report, void *user) {
    FrProgress *progress = g_new0(FrProgress, 1);
    progress->report = report;
    progress->user = user;
    progress->fraction = -1.0;
    pthread_mutex_init(&progress->lock, NULL);
    return progress;
}

void fr_progress_free(FrProgress *progress) {
    if (progress == NULL) {
        return;
    }
    pthread_mutex_destroy(&progress->lock);
    g_free(progress);
}

void fr_progress_report(FrProgress *progress, const char *stage, double fraction) {
    if (progress == NULL || progress->report == NULL) {
        return;
    }
    fraction = fraction > 0.0 ? (fraction < 1.0 ? fraction : 1.0) : 0.0;
    int64_t now = g_get_monotonic_time();
    bool is_soon = now - atomic_load_explicit(&progress->last_time, memory_order_relaxed) <
                   MICROSECONDS_BETWEEN_REPORTS;
    bool is_known = atomic_load_explicit(&progress->last_stage, memory_order_relaxed) == stage;
    if (is_soon && is_known && fraction < 1.0) {
        return;
    }
    pthread_mutex_lock(&progress->lock);
    atomic_store_explicit(&progress->last_stage, stage, memory_order_relaxed);
    if (strncmp(progress->stage, stage, sizeof progress->stage - 1) != 0) {
        g_strlcpy(progress->stage, stage, sizeof progress->stage);
        progress->fraction = -1.0;
    }
    if (fraction > progress->fraction) {
        progress->fraction = fraction;
        atomic_store_explicit(&progress->last_time, now, memory_order_relaxed);
        progress->report(progress->user, progress->stage, fraction);
    }
    pthread_mutex_unlock(&progress->lock);
}

void fr_progress_cancel(FrProgress *progress) {
    if (progress != NULL) {
        atomic_store(&progress->is_cancelled, true);
    }
}

bool fr_progress_is_cancelled(const FrProgress *progress) {
    return progress != NULL && atomic_load_explicit(&progress->is_cancelled, memory_order_acquire);
}
