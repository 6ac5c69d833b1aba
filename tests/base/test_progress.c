// Progress reports: throttled, rising, per stage.
#include "frond/context.h"

#include <string.h>

typedef struct Log {
    int count;
    double last;
    char stage[16];
    bool has_fallen;
} Log;

static void note(void *user, const char *stage, double fraction) {
    Log *log = user;
    bool is_same = strcmp(stage, log->stage) == 0;
    log->has_fallen |= is_same && fraction < log->last;
    g_strlcpy(log->stage, stage, sizeof log->stage);
    log->last = fraction;
    log->count++;
}

static void test_throttle(void) {
    Log log = {0};
    FrProgress *progress = fr_progress_new(note, &log);
    gint64 begin = g_get_monotonic_time();
    for (int i = 0; i < 100000; i++) {
        fr_progress_report(progress, "build", i / 200000.0);
    }
    gint64 tenths = (g_get_monotonic_time() - begin) / 100000;
    g_assert_cmpint(log.count, >=, 1);
    g_assert_cmpint(log.count, <=, 2 + (int)tenths);
    fr_progress_report(progress, "build", 1);
    g_assert_cmpfloat(log.last, ==, 1); // the end is always told
    fr_progress_free(progress);
}

static void test_stages(void) {
    Log log = {0};
    FrProgress *progress = fr_progress_new(note, &log);
    fr_progress_report(progress, "build", 1);
    fr_progress_report(progress, "skin", 0.25);
    g_assert_cmpstr(log.stage, ==, "skin");
    g_assert_cmpfloat(log.last, ==, 0.25);
    fr_progress_report(progress, "skin", 2);
    g_assert_cmpfloat(log.last, ==, 1);
    int count = log.count;
    fr_progress_report(progress, "skin", 0.5);
    g_assert_cmpint(log.count, ==, count);
    g_assert_false(log.has_fallen);
    fr_progress_free(progress);
}

static void test_cancel(void) {
    FrProgress *progress = fr_progress_new(NULL, NULL);
    g_assert_false(fr_progress_is_cancelled(progress));
    fr_progress_cancel(progress);
    g_assert_true(fr_progress_is_cancelled(progress));
    fr_progress_report(progress, "build", 0.5);
    fr_progress_free(progress);
}

static void test_null(void) {
    fr_progress_report(NULL, "build", 0.5);
    fr_progress_cancel(NULL);
    g_assert_false(fr_progress_is_cancelled(NULL));
    fr_progress_free(NULL);
}

static void test_context(void) {
    FrContext context = fr_context_default();
    FrLimits limits = fr_limits_default();
    g_assert_null(context.pool);
    g_assert_null(context.progress);
    g_assert_null(context.diags);
    g_assert_true(memcmp(&context.limits, &limits, sizeof limits) == 0);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/progress/reports come some ten times a second", test_throttle);
    g_test_add_func("/base/progress/a fraction never falls within a stage", test_stages);
    g_test_add_func("/base/progress/work can be cancelled", test_cancel);
    g_test_add_func("/base/progress/no progress is allowed everywhere", test_null);
    g_test_add_func("/base/progress/a default context asks for nothing", test_context);
    return g_test_run();
}
