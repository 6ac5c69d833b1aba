/// @file find.h
/// Plants of a document by their id.
#pragma once

#include "frond/scene.h"

#include <string.h>

/// NULL if there is none.
static inline const FrPlantDef *fr_scene_find_plant(const FrDocument *document, const char *id) {
    const GPtrArray *plants = fr_document_plants(document);
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (strcmp(plant->id, id) == 0) {
            return plant;
        }
    }
    return NULL;
}
