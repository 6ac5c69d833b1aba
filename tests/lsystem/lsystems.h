/// @file lsystems.h
/// L-systems from text, for tests.
#pragma once

#include "frond/lsystem.h"

#include <string.h>

typedef struct Derived {
    FrSource *source;
    FrLsystem *system;
    FrLderivation *derivation;
    FrContext context;
} Derived;

static inline char *diag_text(const FrDiags *diags) {
    GString *text = g_string_new(NULL);
    fr_diags_print(diags, text);
    return g_string_free(text, FALSE);
}

/// Compiles and makes the axiom; neither may fail.
static inline Derived begin(const char *text, int threads) {
    Derived d = {.source = fr_source_new("test.l", text, strlen(text)),
                 .context = fr_context_default()};
    d.context.diags = fr_diags_new();
    d.context.pool = fr_pool_new(threads);
    FrStatus status = fr_lsystem_compile(d.source, NULL, &d.context, &d.system);
    char *said = diag_text(d.context.diags);
    if (status != FR_OK) {
        g_test_message("%s", said);
    }
    g_free(said);
    g_assert_cmpint(status, ==, FR_OK);
    g_assert_cmpint(fr_lderivation_new(d.system, NULL, &d.context, &d.derivation), ==, FR_OK);
    return d;
}

static inline void end(Derived *d) {
    fr_lderivation_free(d->derivation);
    fr_lsystem_free(d->system);
    fr_pool_free(d->context.pool);
    fr_diags_free(d->context.diags);
    fr_source_unref(d->source);
}

static inline char *now(const Derived *d) {
    GString *text = g_string_new(NULL);
    fr_lstring_print(fr_lderivation_string(d->derivation), text);
    return g_string_free(text, FALSE);
}

static inline void check_now(const Derived *d, const char *expected) {
    char *text = now(d);
    g_assert_cmpstr(text, ==, expected);
    g_free(text);
}

static inline void step(Derived *d, uint64_t steps) {
    g_assert_cmpint(fr_lderivation_run(d->derivation, steps, &d->context), ==, FR_OK);
}

/// The axiom, then the string after each step.
static inline void check_steps(const char *text, const char *const *strings, size_t count) {
    Derived d = begin(text, 1);
    for (size_t i = 0; i < count; i++) {
        check_now(&d, strings[i]);
        step(&d, 1);
    }
    end(&d);
}
#define CHECK_STEPS(text, ...)                                                                     \
    check_steps(text, (const char *const[]){__VA_ARGS__},                                          \
                sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

/// The string after `steps` steps of a cpfg file with this head and these productions.
static inline void check_cpfg(const char *head, const char *axiom, const char *productions,
                              uint64_t steps, const char *expected) {
    char *text = g_strdup_printf("Lsystem: 1\n%sderivation length: %d\naxiom: %s\n%s\nendlsystem\n",
                                 head, (int)steps, axiom, productions);
    Derived d = begin(text, 1);
    step(&d, steps);
    check_now(&d, expected);
    end(&d);
    g_free(text);
}
