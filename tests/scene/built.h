/// Documents from strings, built.
#pragma once

#include "frond/scene.h"

#include <string.h>

typedef struct Built {
    FrDocument *document;
    FrScene *scene;
    FrDiags *diags;
    FrStatus status;
} Built;

static inline Built build_with(const char *text, int64_t seed, FrContext context) {
    Built built = {.diags = fr_diags_new()};
    context.diags = built.diags;
    FrSource *source = fr_source_new("wood.frond", text, strlen(text));
    built.status = fr_document_parse(source, NULL, &context, &built.document);
    if (built.status == FR_OK) {
        built.status = fr_scene_build(built.document, seed, &context, &built.scene);
    }
    fr_source_unref(source);
    return built;
}

static inline Built build(const char *text, int64_t seed) {
    return build_with(text, seed, fr_context_default());
}

static inline void forget(Built *built) {
    fr_scene_free(built->scene);
    fr_document_free(built->document);
    fr_diags_free(built->diags);
}

static inline const FrScenePlant *plant_at(const Built *built, guint index) {
    return &g_array_index(built->scene->plants, FrScenePlant, index);
}

static inline const FrStand *stand_at(const Built *built, guint index) {
    return &g_array_index(built->scene->stands, FrStand, index);
}
