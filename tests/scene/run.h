/// Scenes from strings that grow step by step.
#pragma once

#include "frond/simulation.h"

#include <string.h>

typedef struct Run {
    FrContext context;
    FrDocument *document;
    FrSimulation *simulation;
} Run;

static inline FrDocument *parse(const char *text, const FrContext *context) {
    FrSource *source = fr_source_new("run.frond", text, strlen(text));
    FrDocument *document;
    g_assert_cmpint(fr_document_parse(source, NULL, context, &document), ==, FR_OK);
    fr_source_unref(source);
    return document;
}

static inline Run begin(const char *text, uint32_t history) {
    Run run = {.context = fr_context_default()};
    run.context.diags = fr_diags_new();
    run.document = parse(text, &run.context);
    g_assert_cmpint(fr_simulation_new(run.document, -1, history, &run.context, &run.simulation), ==,
                    FR_OK);
    return run;
}

static inline void step(Run *run, int count) {
    for (int i = 0; i < count; i++) {
        g_assert_cmpint(fr_simulation_step(run->simulation, &run->context), ==, FR_OK);
    }
}

static inline void end(Run *run) {
    fr_simulation_free(run->simulation);
    fr_document_free(run->document);
    fr_diags_free(run->context.diags);
}

static inline const FrScene *scene_of(Run *run) {
    const FrScene *scene;
    g_assert_cmpint(fr_simulation_scene(run->simulation, &run->context, &scene), ==, FR_OK);
    return scene;
}
