// L-systems: derivation beside a program that has the same productions written into it, contexts,
// plain rewriting, and the turtle.
#include "bench.h"

#include "frond/lsystem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEPS 20
#define MONO_MODULES UINT64_C(7340026) ///< 7·2^20 − 6

static const char MONO[] = "#define r1 0.9\n#define r2 0.6\n#define wr 0.707\n"
                           "Lsystem: 1\nderivation length: 20\naxiom: A(1,10)\n"
                           "A(l,w) --> !(w)F(l)[&(45)B(l*r2,w*wr)]/(137.5)A(l*r1,w*wr)\n"
                           "B(l,w) --> !(w)F(l)[-(45)$C(l*r2,w*wr)]C(l*r1,w*wr)\n"
                           "C(l,w) --> !(w)F(l)[+(45)$B(l*r2,w*wr)]B(l*r1,w*wr)\n"
                           "endlsystem\n";
static const char KOCH[] = "w : F-F-F-F\np1 : F -> F-F+F+FF-F-F+F\n";
// A signal climbs a growing bracketed structure; nearly every module has a context to read.
static const char SIGNAL[] = "ignore: +-\nw : S[+A]A\np1 : S < A -> S[+A][-A]A\np2 : S -> A\n"
                             "p3 : A < A -> A\n";

typedef struct Work {
    const char *text;
    uint64_t steps;
    FrContext context;
    FrLsystem *system;
    FrLderivation *derivation;
    FrPlant *plant;
    uint64_t modules;
} Work;

static Work begin(const char *text, uint64_t steps, int threads) {
    Work work = {.text = text, .steps = steps, .context = fr_context_default()};
    work.context.pool = fr_pool_new(threads);
    FrSource *source = fr_source_new("bench.l", text, strlen(text));
    if (fr_lsystem_compile(source, NULL, &work.context, &work.system) != FR_OK) {
        abort();
    }
    fr_source_unref(source);
    return work;
}

static void end(Work *work) {
    fr_plant_free(work->plant);
    fr_lderivation_free(work->derivation);
    fr_lsystem_free(work->system);
    fr_pool_free(work->context.pool);
}

static void derive(void *data) {
    Work *work = data;
    fr_lderivation_free(work->derivation);
    if (fr_lderivation_new(work->system, NULL, &work->context, &work->derivation) != FR_OK ||
        fr_lderivation_run(work->derivation, work->steps, &work->context) != FR_OK) {
        abort();
    }
    work->modules = fr_lstring_count(fr_lderivation_string(work->derivation));
}

static void draw(void *data) {
    Work *work = data;
    fr_plant_free(work->plant);
    if (fr_lderivation_plant(work->derivation, &work->context, &work->plant, NULL) != FR_OK) {
        abort();
    }
}

// ---- the same by hand -------------------------------------------------------------------------

typedef struct Module {
    int symbol;
    float a, b;
} Module;

typedef struct Hand {
    Module *now, *next;
    uint64_t count;
} Hand;

static Module *put(Module *to, int symbol, float a, float b) {
    *to = (Module){symbol, a, b};
    return to + 1;
}

static Module *rewrite(Module *to, int turn, int lateral, int apex, const Module *from,
                       bool is_stem) {
    float l = from->a, w = from->b * 0.707F;
    to = put(to, '!', from->b, 0);
    to = put(to, 'F', l, 0);
    to = put(to, '[', 0, 0);
    to = put(to, turn, 45, 0);
    to = is_stem ? to : put(to, '$', 0, 0);
    to = put(to, lateral, l * 0.6F, w);
    to = put(to, ']', 0, 0);
    to = is_stem ? put(to, '/', 137.5F, 0) : to;
    return put(to, apex, l * 0.9F, w);
}

static void free_hand(Hand *hand) {
    free(hand->now);
    free(hand->next);
}

// Takes new memory each time, as ours does: writing memory that an earlier run has made warm is
// five times as fast and no derivation's limit.
static void derive_by_hand(void *data) {
    Hand *hand = data;
    size_t bytes = (MONO_MODULES + 7) * sizeof(Module);
    free_hand(hand);
    hand->now = malloc(bytes);
    hand->next = malloc(bytes);
    if (hand->now == NULL || hand->next == NULL) {
        abort();
    }
    hand->now[0] = (Module){'A', 1, 10};
    hand->count = 1;
    for (int step = 0; step < STEPS; step++) {
        Module *to = hand->next;
        for (const Module *m = hand->now, *last = m + hand->count; m < last; m++) {
            to = m->symbol == 'A'   ? rewrite(to, '&', 'B', 'A', m, true)
                 : m->symbol == 'B' ? rewrite(to, '-', 'C', 'C', m, false)
                 : m->symbol == 'C' ? rewrite(to, '+', 'B', 'B', m, false)
                                    : put(to, m->symbol, m->a, m->b);
        }
        hand->count = (uint64_t)(to - hand->next);
        Module *swap = hand->now;
        hand->now = hand->next;
        hand->next = swap;
    }
}

/// Modules a second. Its last string is read and must be that of the L-system, so that none of the
/// work can be left out.
static double rate_by_hand(void) {
    Hand hand = {NULL, NULL, 0};
    double seconds = bench_shortest(5, derive_by_hand, &hand), length = 0;
    for (uint64_t i = 0; i < hand.count; i++) {
        length += hand.now[i].symbol == 'F' ? (double)hand.now[i].a : 0;
    }
    // Each internode is followed by one of 0.6 and one of 0.9 of its length.
    double expected = (pow(1.5, STEPS) - 1) / 0.5;
    if (hand.count != MONO_MODULES || fabs(length / expected - 1) > 1e-4) {
        abort();
    }
    double rate = (double)hand.count / seconds;
    bench_keep(hand.now);
    free_hand(&hand);
    return rate;
}

static void tell(const char *name, Work *work, double limit, const char *what) {
    double seconds = bench_shortest(4, derive, work);
    if (work->text == MONO && work->modules != MONO_MODULES) {
        abort();
    }
    const FrLstring *string = fr_lderivation_string(work->derivation);
    bench_tell(name, (double)work->modules / seconds, limit, "modules/s",
               "%s: %" G_GUINT64_FORMAT " modules, %.2f bytes a module", what, work->modules,
               (double)fr_lstring_bytes(string) / (double)work->modules);
}

/// From the string to an FrPlant in fresh memory: the walk over its modules, 3D segments with
/// widths as rows of axes and internodes, counts and box, frames and rotations of all internodes.
static void tell_turtle(const char *name, Work *work, const char *threads) {
    double seconds = bench_shortest(5, draw, work);
    bench_tell(name, (double)work->plant->nodes.count / seconds, 0, "segments/s",
               "its string to a plant: %u segments, %s", work->plant->nodes.count, threads);
}

void bench_lsystem(void) {
    double by_hand = rate_by_hand();
    Work mono = begin(MONO, STEPS, 1);
    tell("lsystem.mono", &mono, by_hand, "monopodial tree, 20 steps, 1 thread");
    tell_turtle("lsystem.turtle", &mono, "1 thread");
    end(&mono);
    Work two = begin(MONO, STEPS, 2);
    tell("lsystem.mono-2", &two, by_hand, "the same on 2 threads");
    tell_turtle("lsystem.turtle-2", &two, "2 threads");
    end(&two);
    Work koch = begin(KOCH, 6, 1);
    tell("lsystem.koch", &koch, 0, "quadratic Koch island, 6 steps");
    end(&koch);
    Work signal = begin(SIGNAL, 12, 1);
    tell("lsystem.context", &signal, 0, "a signal through contexts, 12 steps");
    end(&signal);
}
