// Builds documents made by chance: fuzz-random [--count N] [--begin N] [--print N]. Each is read,
// built and skinned within small limits. None may end the program, take longer than SECONDS of the
// processor, give what is not finite, or be larger than a limit that said nothing; and every
// RETHREADED-th must be the same with three threads. Prints TAP, so that a short run is a test.
#include "random_document.h"

#include "frond/scene.h"

#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum {
    SECONDS = 20,
    RETHREADED = 16,
    MOST_KINDS = 64, // of diagnostics that are told apart
};

typedef struct Count {
    const char *code;
    uint64_t documents;
} Count;

typedef struct Tally {
    uint64_t begin, count, built, limited, wrong, triangles;
    double slowest;
    uint64_t slowest_number;
    Count codes[MOST_KINDS];
} Tally;

// What a signal handler prints: the document that is being built.
static char current[64];

static void on_signal(int number) {
    (void)number;
    ssize_t ignored = write(STDOUT_FILENO, current, strlen(current));
    (void)ignored;
    _exit(1);
}

static void watch(uint64_t number) {
    g_snprintf(current, sizeof current, "not ok 1 document %" PRIu64 " ends or hangs it\n", number);
    // Of the processor's time: a busy machine is no hang.
    struct itimerval timer = {.it_value = {.tv_sec = SECONDS}};
    setitimer(ITIMER_PROF, &timer, NULL);
}

static FrLimits small_limits(void) {
    FrLimits limits = fr_limits_default();
    limits.instances = 1000;
    limits.nodes = 5000;
    limits.organs = 1000;
    limits.shapes = 64;
    limits.depth = 64;
    limits.plants = 8;
    limits.triangles = 60000;
    limits.bytes = 20000000;
    return limits;
}

static void fail(uint64_t number, const char *why) {
    printf("not ok 1 document %" PRIu64 ": %s\n", number, why);
    fflush(stdout);
    _exit(1);
}

static void note(Tally *tally, const char *code) {
    for (Count *row = tally->codes; row < tally->codes + MOST_KINDS; row++) {
        if (row->code == NULL || strcmp(row->code, code) == 0) {
            row->code = code;
            row->documents++;
            return;
        }
    }
}

/// Every status but FR_OK has its reason, and limits have their own.
static void check_status(Tally *tally, uint64_t number, FrStatus status, const FrDiags *diags) {
    const char *first = NULL;
    for (size_t i = 0; i < fr_diags_count(diags) && first == NULL; i++) {
        const FrDiag *diag = fr_diags_get(diags, i);
        first = diag->severity == FR_ERROR ? diag->code : NULL;
    }
    if ((status == FR_OK) != (first == NULL)) {
        fail(number, "an error without a status, or a status without an error");
    }
    if (status == FR_OK) {
        return;
    }
    bool is_limit = g_str_has_prefix(first, "limit-");
    if (is_limit != (status == FR_ERR_LIMIT)) {
        fail(number, "a limit that is called something else");
    }
    note(tally, first);
    tally->limited += is_limit;
    tally->wrong += !is_limit;
}

static void check_sizes(uint64_t number, const FrScene *scene, const FrLimits *limits) {
    for (guint i = 0; i < scene->plants->len; i++) {
        const FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, i);
        if (plant->instances > limits->instances || plant->plant->nodes.count > limits->nodes ||
            plant->plant->organs.count > limits->organs ||
            plant->plant->shapes->len > limits->shapes) {
            fail(number, "larger than a limit that said nothing");
        }
        char *why = NULL;
        if (!fr_plant_is_valid(plant->plant, &why)) {
            fail(number, why == NULL ? "not a valid plant" : why);
        }
    }
}

static void check_mesh(uint64_t number, const FrMesh *mesh) {
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        const float *values = (const float *)&mesh->vertices[i];
        for (size_t k = 0; k < sizeof mesh->vertices[i] / sizeof *values; k++) {
            if (!isfinite(values[k])) {
                fail(number, k < 3   ? "a position is not finite"
                             : k < 6 ? "a normal is not finite"
                                     : "a texture coordinate is not finite");
            }
        }
    }
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        for (uint64_t i = 0; i < part->index_count; i++) {
            if (mesh->indices[part->first_index + i] >= part->vertex_count) {
                fail(number, "a triangle of no vertex");
            }
        }
    }
}

/// Skins the plants of a scene at a level of detail of the document's own.
static FrStatus skin(Tally *tally, uint64_t number, const FrScene *scene,
                     const FrContext *context) {
    FrSkinParams params = fr_skin_default();
    params.lod = (int64_t)(number % 5);
    for (guint i = 0; i < scene->plants->len; i++) {
        FrMesh *mesh;
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        FrStatus status = fr_skin_plant(plant, &params, FR_UP_Z, context, &mesh);
        if (status != FR_OK) {
            return status;
        }
        if (mesh->index_count > 3 * context->limits.triangles) {
            fail(number, "more triangles than their limit, which said nothing");
        }
        check_mesh(number, mesh);
        tally->triangles += mesh->index_count / 3;
        fr_mesh_free(mesh);
    }
    return FR_OK;
}

static void check_threads(uint64_t number, const FrDocument *document, const FrScene *scene,
                          FrContext context) {
    context.pool = fr_pool_new(3);
    context.diags = fr_diags_new();
    FrScene *other;
    FrStatus status = fr_scene_build(document, -1, &context, &other);
    if (status != FR_OK || fr_scene_digest(other) != fr_scene_digest(scene)) {
        fail(number, "another plant with three threads");
    }
    fr_scene_free(other);
    fr_diags_free(context.diags);
    fr_pool_free(context.pool);
}

static FrStatus try_scene(Tally *tally, uint64_t number, const FrDocument *document,
                          const FrContext *context) {
    FrScene *scene;
    FrStatus status = fr_scene_build(document, -1, context, &scene);
    if (status != FR_OK) {
        return status;
    }
    check_sizes(number, scene, &context->limits);
    status = skin(tally, number, scene, context);
    if (number % RETHREADED == 0) {
        check_threads(number, document, scene, *context);
    }
    fr_scene_free(scene);
    return status;
}

static double processor_seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

static void try_document(Tally *tally, uint64_t number) {
    char *text = random_document(number);
    double began = processor_seconds();
    watch(number);
    FrContext context = fr_context_default();
    context.limits = small_limits();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("random.frond", text, strlen(text));
    FrDocument *document;
    FrStatus status = fr_document_parse(source, "/nonexistent", &context, &document);
    if (status == FR_OK) {
        status = try_scene(tally, number, document, &context);
    }
    check_status(tally, number, status, context.diags);
    tally->built += status == FR_OK;
    fr_document_free(document);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    double seconds = processor_seconds() - began;
    if (seconds > tally->slowest) {
        tally->slowest = seconds;
        tally->slowest_number = number;
    }
    g_free(text);
}

static void report(const Tally *tally) {
    printf("# %" PRIu64 " documents from %" PRIu64 ": %" PRIu64 " built with %" PRIu64
           " triangles, %" PRIu64 " met a limit, %" PRIu64 " were wrong\n",
           tally->count, tally->begin, tally->built, tally->triangles, tally->limited,
           tally->wrong);
    printf("# slowest: %" PRIu64 ", %.2f s\n", tally->slowest_number, tally->slowest);
    for (const Count *row = tally->codes; row < tally->codes + MOST_KINDS && row->code; row++) {
        printf("#   %-28s %" PRIu64 "\n", row->code, row->documents);
    }
}

int main(int argc, char **argv) {
    Tally tally = {.count = 2000};
    for (int i = 1; i + 1 < argc; i += 2) {
        uint64_t value = g_ascii_strtoull(argv[i + 1], NULL, 10);
        if (strcmp(argv[i], "--print") == 0) {
            char *text = random_document(value);
            fputs(text, stdout);
            g_free(text);
            return 0;
        }
        *(strcmp(argv[i], "--begin") == 0 ? &tally.begin : &tally.count) = value;
    }
    signal(SIGPROF, on_signal);
    signal(SIGABRT, on_signal);
    signal(SIGSEGV, on_signal);
    signal(SIGTRAP, on_signal);
    signal(SIGFPE, on_signal);
    signal(SIGBUS, on_signal);
    printf("1..1\n");
    for (uint64_t i = 0; i < tally.count; i++) {
        try_document(&tally, tally.begin + i);
    }
    report(&tally);
    // A generator whose documents say nothing would test nothing.
    bool is_useful = tally.built >= tally.count / 3;
    printf("%s 1 /fuzz/random/documents made by chance are built or refused\n",
           is_useful ? "ok" : "not ok");
    return is_useful ? 0 : 1;
}
