/// @file building.h
/// A builder for each test, asked as the window asks it.
#pragma once

#include "studio.h"

#include <math.h>

typedef struct Fixture {
    gint wakes;
    StudioBuilder *builder;
} Fixture;

#define ADD(name, function) g_test_add(name, Fixture, NULL, set_up, function, tear_down)

static inline void wake(void *user) {
    g_atomic_int_inc((gint *)user);
}

static inline void set_up(Fixture *fixture, gconstpointer data) {
    (void)data;
    fixture->wakes = 0;
    fixture->builder = studio_builder_new(wake, &fixture->wakes);
}

static inline void tear_down(Fixture *fixture, gconstpointer data) {
    (void)data;
    studio_builder_free(fixture->builder);
}

static inline void request_moment(Fixture *fixture, const StudioDocument *document,
                                  StudioMoment moment) {
    studio_builder_request(fixture->builder, studio_document_source(document),
                           studio_document_folder(document), studio_document_revision(document),
                           moment);
}

static inline void request(Fixture *fixture, const StudioDocument *document, double time) {
    request_moment(fixture, document, (StudioMoment){time, -1});
}

static inline void request_step(Fixture *fixture, const StudioDocument *document, int64_t step) {
    request_moment(fixture, document, (StudioMoment){NAN, step});
}

static inline const StudioBuilt *await(Fixture *fixture) {
    for (int i = 0; i < 60000; i++) {
        const StudioBuilt *built = studio_builder_collect(fixture->builder);
        if (built != NULL) {
            return built;
        }
        g_usleep(1000);
    }
    g_assert_not_reached();
}
