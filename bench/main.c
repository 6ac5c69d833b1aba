// frond-bench [NAME…] [--json]: the benchmarks, or those named.
#include "bench.h"

#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

static const struct {
    const char *name;
    void (*run)(void);
} benches[] = {
    {"plant", bench_plant},         {"expr", bench_expr},   {"pgraph", bench_pgraph},
    {"lsystem", bench_lsystem},     {"skin", bench_skin},   {"rebuild", bench_rebuild},
    {"variation", bench_variation}, {"nurbs", bench_nurbs}, {"density", bench_density},
    {"light", bench_light},         {"io", bench_io},       {"growth", bench_growth},
};

static GArray *results; // BenchResult
static bool is_json;

static double peak_bytes(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * (double)usage.ru_maxrss;
}

double bench_processor(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + (double)usage.ru_stime.tv_sec +
           1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// 12 345 678 as "12.3 M".
static void print_rate(double value) {
    static const char *const prefixes[] = {"", " k", " M", " G", " T"};
    int prefix = 0;
    while (value >= 1000 && prefix < 4) {
        value /= 1000;
        prefix++;
    }
    printf("%.3g%s", value, prefixes[prefix]);
}

static void print_result(const BenchResult *result) {
    printf("%s\t", result->name);
    print_rate(result->value);
    printf("%s%s\t", result->value < 1000 ? " " : "", result->unit);
    if (result->limit > 0) {
        printf("limit ");
        print_rate(result->limit);
        printf(", ratio %.2f", result->limit / result->value);
    }
    printf("\t%s\n", result->work);
    fflush(stdout);
}

void bench_tell(const char *name, double value, double limit, const char *unit,
                const char *work_format, ...) {
    va_list values;
    va_start(values, work_format);
    BenchResult result = {name, value, limit, unit, g_strdup_vprintf(work_format, values)};
    va_end(values);
    g_array_append_val(results, result);
    if (!is_json) {
        print_result(&result);
    }
}

double bench_now(void) {
    return (double)g_get_monotonic_time() * 1e-6;
}

double bench_shortest(int repeats, void (*run)(void *data), void *data) {
    double shortest = 1e30;
    for (int i = 0; i < repeats; i++) {
        double start = bench_now();
        run(data);
        double seconds = bench_now() - start;
        shortest = MIN(shortest, MAX(seconds, 1e-6));
    }
    return shortest;
}

static void print_json(void) {
    json_t *array = json_array();
    for (guint i = 0; i < results->len; i++) {
        const BenchResult *result = &g_array_index(results, BenchResult, i);
        json_t *object = json_pack("{s:s, s:f, s:s, s:s}", "name", result->name, "value",
                                   result->value, "unit", result->unit, "work", result->work);
        if (result->limit > 0) {
            json_object_set_new(object, "limit", json_real(result->limit));
        }
        json_array_append_new(array, object);
    }
    json_t *all =
        json_pack("{s:s, s:i, s:f, s:o}", "frond", FR_VERSION, "processors",
                  (int)g_get_num_processors(), "peak_bytes", peak_bytes(), "results", array);
    json_dumpf(all, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
    printf("\n");
    json_decref(all);
}

int main(int argc, char **argv) {
    int named = 0;
    results = g_array_new(FALSE, FALSE, sizeof(BenchResult));
    for (int a = 1; a < argc; a++) {
        is_json = is_json || strcmp(argv[a], "--json") == 0;
        named += strcmp(argv[a], "--json") != 0;
    }
    int unknown = named;
    for (size_t b = 0; b < G_N_ELEMENTS(benches); b++) {
        bool wanted = named == 0;
        for (int a = 1; a < argc; a++) {
            if (strcmp(argv[a], benches[b].name) == 0) {
                wanted = true;
                unknown--;
            }
        }
        if (wanted) {
            benches[b].run();
        }
    }
    if (unknown != 0) {
        fprintf(stderr,
                "usage: frond-bench [plant] [expr] [pgraph] [lsystem] [skin] [rebuild] [variation] "
                "[nurbs] [density] [growth] [io] [--json]\n");
        return 2;
    }
    if (is_json) {
        print_json();
    } else {
        printf("peak memory\t%.0f MB\n", peak_bytes() / 1e6);
    }
    for (guint i = 0; i < results->len; i++) {
        g_free(g_array_index(results, BenchResult, i).work);
    }
    g_array_unref(results);
    return 0;
}
