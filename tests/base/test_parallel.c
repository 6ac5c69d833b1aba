// The pool: every element once, equal results for any number of threads, cancelling.
#include "frond/parallel.h"

#include <glib.h>
#include <stdatomic.h>

typedef struct Job {
    uint8_t *visits;
    size_t count, grain;
    atomic_int wrong_chunks;
    atomic_int busy[8]; // by worker: two threads must never share a number
    int threads;
} Job;

static void visit(void *data, size_t begin, size_t end, int worker) {
    Job *job = data;
    bool is_last = end == job->count;
    if (begin % job->grain != 0 || (!is_last && end - begin != job->grain) || end <= begin ||
        worker < 0 || worker >= job->threads || atomic_fetch_add(&job->busy[worker], 1) != 0) {
        atomic_fetch_add(&job->wrong_chunks, 1);
    }
    for (size_t i = begin; i < end; i++) {
        job->visits[i]++;
    }
    atomic_fetch_sub(&job->busy[worker], 1);
}

static void check_all_once(FrPool *pool, size_t count, size_t grain) {
    Job job = {.visits = g_malloc0(count + 1),
               .count = count,
               .grain = grain,
               .threads = fr_pool_threads(pool)};
    fr_parallel_for(pool, count, grain, visit, &job, NULL);
    g_assert_cmpint(job.wrong_chunks, ==, 0);
    for (size_t i = 0; i < count; i++) {
        g_assert_cmpint(job.visits[i], ==, 1);
    }
    g_assert_cmpint(job.visits[count], ==, 0);
    g_free(job.visits);
}

static void test_all_once(void) {
    const int threads[] = {1, 2, 3, 8};
    for (size_t t = 0; t < G_N_ELEMENTS(threads); t++) {
        FrPool *pool = fr_pool_new(threads[t]);
        g_assert_cmpint(fr_pool_threads(pool), ==, threads[t]);
        check_all_once(pool, 0, 10);
        check_all_once(pool, 1, 10);
        check_all_once(pool, 10, 10);
        check_all_once(pool, 11, 10);
        check_all_once(pool, 10007, 7);
        check_all_once(pool, 10007, 20000);
        fr_pool_free(pool);
    }
}

static void test_without_pool(void) {
    g_assert_cmpint(fr_pool_threads(NULL), ==, 1);
    check_all_once(NULL, 1001, 10);
    fr_pool_free(NULL);
}

// Many short loops in a row: a thread that wakes late must not join the next loop wrongly.
static void test_many_loops(void) {
    FrPool *pool = fr_pool_new(4);
    for (size_t i = 0; i < 3000; i++) {
        check_all_once(pool, 1 + i % 17, 1 + i % 3);
    }
    fr_pool_free(pool);
}

static void test_default_size(void) {
    FrPool *pool = fr_pool_new(0);
    g_assert_cmpint(fr_pool_threads(pool), ==, (int)g_get_num_processors());
    fr_pool_free(pool);
}

typedef struct Stopping {
    FrProgress *progress;
    atomic_int chunks;
} Stopping;

static void stop_soon(void *data, size_t begin, size_t end, int worker) {
    (void)begin, (void)end, (void)worker;
    Stopping *stopping = data;
    if (atomic_fetch_add(&stopping->chunks, 1) == 9) {
        fr_progress_cancel(stopping->progress);
    }
}

static void test_cancel(void) {
    const int threads[] = {1, 3};
    for (size_t t = 0; t < G_N_ELEMENTS(threads); t++) {
        FrPool *pool = fr_pool_new(threads[t]);
        Stopping stopping = {.progress = fr_progress_new(NULL, NULL)};
        fr_parallel_for(pool, 1000000, 1, stop_soon, &stopping, stopping.progress);
        g_assert_cmpint(stopping.chunks, >=, 10);
        // Between the tenth chunk and the cancel, others may go on for as long as the scheduler
        // likes, but not to the end.
        g_assert_cmpint(stopping.chunks, <, 1000000);
        fr_progress_free(stopping.progress);
        fr_pool_free(pool);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/parallel/every element is done once for any number of threads",
                    test_all_once);
    g_test_add_func("/base/parallel/without a pool the caller does everything", test_without_pool);
    g_test_add_func("/base/parallel/short loops follow each other safely", test_many_loops);
    g_test_add_func("/base/parallel/a pool has a thread per processor unless told",
                    test_default_size);
    g_test_add_func("/base/parallel/a cancelled loop stops early", test_cancel);
    return g_test_run();
}
