// A pool of threads that sleep between loops.
//
// A loop lives on its caller's stack. Threads join it while it is announced, take chunks from one
// counter, and leave; a thread that wakes too late finds nothing announced and sleeps on, so a
// loop never waits for a slow start. Which thread does a chunk is left open, therefore a body
// writes only to its own elements (and to scratch memory selected by `worker`).
#include "frond/parallel.h"

#include <glib.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>

enum { MOST_THREADS = 256 };

typedef struct Loop {
    FrRangeFn body;
    void *data;
    size_t count;
    size_t grain;
    size_t chunk_count;
    FrProgress *progress;
    atomic_size_t next_chunk;
    int joined; // threads inside, caller not counted; under the pool's lock
} Loop;

typedef struct Worker {
    FrPool *pool;
    pthread_t thread;
    int index;
} Worker;

struct FrPool {
    pthread_mutex_t lock;
    pthread_cond_t announced; // a loop is to be joined, or the pool ends
    pthread_cond_t left;      // the last thread has left a loop
    Loop *loop;               // NULL between loops
    uint64_t loop_number;     // tells a thread whether it has joined this loop before
    bool is_ending;
    int threads;
    Worker workers[]; // threads - 1, with indices from 1
};

static void do_chunks(Loop *loop, int worker) {
    while (!fr_progress_is_cancelled(loop->progress)) {
        size_t chunk = atomic_fetch_add_explicit(&loop->next_chunk, 1, memory_order_relaxed);
        if (chunk >= loop->chunk_count) {
            return;
        }
        size_t begin = chunk * loop->grain;
        size_t size = loop->count - begin < loop->grain ? loop->count - begin : loop->grain;
        loop->body(loop->data, begin, begin + size, worker);
    }
}

static void *work(void *data) {
    Worker *worker = data;
    FrPool *pool = worker->pool;
    uint64_t done_number = 0;
    pthread_mutex_lock(&pool->lock);
    for (;;) {
        while (!pool->is_ending && (pool->loop == NULL || pool->loop_number == done_number)) {
            pthread_cond_wait(&pool->announced, &pool->lock);
        }
        if (pool->is_ending) {
            break;
        }
        Loop *loop = pool->loop;
        done_number = pool->loop_number;
        loop->joined++;
        pthread_mutex_unlock(&pool->lock);
        do_chunks(loop, worker->index);
        pthread_mutex_lock(&pool->lock);
        if (--loop->joined == 0) {
            pthread_cond_signal(&pool->left);
        }
    }
    pthread_mutex_unlock(&pool->lock);
    return NULL;
}

// Signals go to the program's own threads: Ctrl-C must not land in a loop. Where the system
// gives fewer threads than asked for, the pool is smaller; results are the same.
static void start_workers(FrPool *pool, int wanted) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    for (int index = 1; index < wanted; index++) {
        Worker *worker = &pool->workers[index - 1];
        *worker = (Worker){.pool = pool, .index = index};
        if (pthread_create(&worker->thread, NULL, work, worker) != 0) {
            break;
        }
        pool->threads++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

FrPool *fr_pool_new(int threads) {
    int wanted = threads > 0 ? threads : (int)g_get_num_processors();
    wanted = wanted < MOST_THREADS ? wanted : MOST_THREADS;
    FrPool *pool = g_malloc0(sizeof *pool + (size_t)wanted * sizeof(Worker));
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->announced, NULL);
    pthread_cond_init(&pool->left, NULL);
    pool->threads = 1;
    start_workers(pool, wanted);
    return pool;
}

void fr_pool_free(FrPool *pool) {
    if (pool == NULL) {
        return;
    }
    pthread_mutex_lock(&pool->lock);
    FR_ASSERT(pool->loop == NULL);
    pool->is_ending = true;
    pthread_cond_broadcast(&pool->announced);
    pthread_mutex_unlock(&pool->lock);
    for (int i = 0; i < pool->threads - 1; i++) {
        pthread_join(pool->workers[i].thread, NULL);
    }
    pthread_cond_destroy(&pool->left);
    pthread_cond_destroy(&pool->announced);
    pthread_mutex_destroy(&pool->lock);
    g_free(pool);
}

int fr_pool_threads(const FrPool *pool) {
    return pool != NULL ? pool->threads : 1;
}

void fr_parallel_for(FrPool *pool, size_t count, size_t grain, FrRangeFn body, void *data,
                     FrProgress *progress) {
    grain = grain > 0 ? grain : 1;
    Loop loop = {
        .body = body,
        .data = data,
        .count = count,
        .grain = grain,
        .chunk_count = count / grain + (count % grain != 0 ? 1 : 0),
        .progress = progress,
    };
    if (fr_pool_threads(pool) == 1 || loop.chunk_count <= 1) {
        do_chunks(&loop, 0);
        return;
    }
    pthread_mutex_lock(&pool->lock);
    FR_ASSERT(pool->loop == NULL); // loops are not nested, and a pool has one caller at a time
    pool->loop = &loop;
    pool->loop_number++;
    pthread_cond_broadcast(&pool->announced);
    pthread_mutex_unlock(&pool->lock);

    do_chunks(&loop, 0);

    pthread_mutex_lock(&pool->lock);
    pool->loop = NULL;
    while (loop.joined > 0) {
        pthread_cond_wait(&pool->left, &pool->lock);
    }
    pthread_mutex_unlock(&pool->lock);
}
