#include "studio/model/painter.h"

typedef struct Order {
    FrMaterial *material; // NULL: no more
    FrDigest digest;
} Order;

struct StudioPainter {
    StudioWake wake;
    void *user;
    GThread *thread;
    GAsyncQueue *orders, *ready; // Order *, StudioPicture *
    GMutex lock;                 // of `known`
    GHashTable *known;           // digests
    FrProgress *progress;
    gint open; // atomic: orders that are not ready
};

static void paint(StudioPainter *painter, const Order *order, FrMap map) {
    FrContext context = fr_context_default();
    context.progress = painter->progress;
    FrStatus status = FR_OK;
    const FrImage *image = fr_progress_is_cancelled(painter->progress)
                               ? NULL
                               : fr_material_image(order->material, map, &context, &status);
    int texture = fr_material_params(order->material)->texture;
    StudioPicture *picture = g_new(StudioPicture, 1);
    *picture =
        (StudioPicture){order->digest, map, image == NULL ? NULL : fr_image_ref((FrImage *)image),
                        texture == FR_TEXTURE_LEAF || texture == FR_TEXTURE_PETAL};
    g_async_queue_push(painter->ready, picture);
    painter->wake(painter->user);
}

static gpointer run(gpointer data) {
    StudioPainter *painter = data;
    for (;;) {
        Order *order = g_async_queue_pop(painter->orders);
        if (order->material == NULL) {
            g_free(order);
            return NULL;
        }
        for (int map = 0; map < FR_MAP_COUNT; map++) {
            paint(painter, order, (FrMap)map);
        }
        fr_material_unref(order->material);
        g_free(order);
        g_atomic_int_add(&painter->open, -1);
        painter->wake(painter->user);
    }
}

StudioPainter *studio_painter_new(StudioWake wake, void *user) {
    StudioPainter *painter = g_new0(StudioPainter, 1);
    painter->wake = wake;
    painter->user = user;
    painter->orders = g_async_queue_new();
    painter->ready = g_async_queue_new();
    g_mutex_init(&painter->lock);
    painter->known = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    painter->progress = fr_progress_new(NULL, NULL);
    painter->thread = g_thread_new("painter", run, painter);
    return painter;
}

void studio_painter_free(StudioPainter *painter) {
    fr_progress_cancel(painter->progress);
    g_async_queue_push(painter->orders, g_new0(Order, 1));
    g_thread_join(painter->thread);
    StudioPicture picture;
    while (studio_painter_take(painter, &picture)) {
        fr_image_unref(picture.image);
    }
    g_async_queue_unref(painter->orders);
    g_async_queue_unref(painter->ready);
    g_hash_table_unref(painter->known);
    g_mutex_clear(&painter->lock);
    fr_progress_free(painter->progress);
    g_free(painter);
}

void studio_painter_add(StudioPainter *painter, FrMaterial *material, FrDigest digest) {
    gint64 key = (gint64)digest;
    g_mutex_lock(&painter->lock);
    bool is_new = g_hash_table_add(painter->known, g_memdup2(&key, sizeof key));
    g_mutex_unlock(&painter->lock);
    if (!is_new) {
        return;
    }
    Order *order = g_new(Order, 1);
    *order = (Order){fr_material_ref(material), digest};
    g_atomic_int_inc(&painter->open);
    g_async_queue_push(painter->orders, order);
}

bool studio_painter_take(StudioPainter *painter, StudioPicture *picture) {
    StudioPicture *ready = g_async_queue_try_pop(painter->ready);
    if (ready != NULL) {
        *picture = *ready;
        g_free(ready);
    }
    return ready != NULL;
}

bool studio_painter_is_busy(StudioPainter *painter) {
    return g_atomic_int_get(&painter->open) > 0;
}
