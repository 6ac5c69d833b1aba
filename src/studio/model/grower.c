#include "studio/model/grower.h"

#include "frond/simulation.h"

#include <cglm/struct.h>
#include <string.h>

enum { STEPS_BACK = 200 };

struct StudioGrower {
    FrSimulation *simulation; // NULL: nothing has been shown
    FrDocument *document;     // that it reads
    FrDigest digest;
    uint64_t step;
    GPtrArray *skins; // FrSkin *, by plant
};

static void free_skin(gpointer skin) {
    fr_skin_free(skin);
}

bool studio_grower_is_wanted(const FrDocument *document) {
    const GPtrArray *plants = fr_document_plants(document);
    for (guint i = 0; i < plants->len; i++) {
        if (((const FrPlantDef *)g_ptr_array_index(plants, i))->kind == FR_PLANT_SPECIES) {
            return true;
        }
    }
    return false;
}

StudioGrower *studio_grower_new(void) {
    StudioGrower *grower = g_new0(StudioGrower, 1);
    grower->skins = g_ptr_array_new_with_free_func(free_skin);
    return grower;
}

static void forget(StudioGrower *grower) {
    fr_simulation_free(grower->simulation);
    fr_document_free(grower->document);
    grower->simulation = NULL;
    grower->document = NULL;
    grower->step = 0;
}

void studio_grower_free(StudioGrower *grower) {
    if (grower != NULL) {
        forget(grower);
        g_ptr_array_unref(grower->skins);
        g_free(grower);
    }
}

static bool is_same_place(const FrPlace *a, const FrPlace *b) {
    return g_strcmp0(a->plant, b->plant) == 0 && glms_vec3_eqv(a->at, b->at) && a->seed == b->seed;
}

static bool is_same_gaps(const GArray *a, const GArray *b) {
    return a->len == b->len &&
           (a->len == 0 || memcmp(a->data, b->data, a->len * sizeof(uint32_t)) == 0);
}

// Whether another document has all rows and areas of one, with the same plants left out.
static bool keeps_spread(const FrDocument *document, const FrDocument *next) {
    const GPtrArray *rows = fr_document_rows(document), *new_rows = fr_document_rows(next);
    const GPtrArray *areas = fr_document_strews(document), *new_areas = fr_document_strews(next);
    bool is_kept = rows->len <= new_rows->len && areas->len <= new_areas->len;
    for (guint i = 0; is_kept && i < rows->len; i++) {
        const FrRow *row = g_ptr_array_index(rows, i), *new = g_ptr_array_index(new_rows, i);
        is_kept = is_same_gaps(row->gaps, new->gaps);
    }
    for (guint i = 0; is_kept && i < areas->len; i++) {
        const FrStrew *area = g_ptr_array_index(areas, i), *new = g_ptr_array_index(new_areas, i);
        is_kept = is_same_gaps(area->gaps, new->gaps);
    }
    return is_kept;
}

// Whether all that a document places by hand is still placed by another one, in the same order,
// perhaps among more: a plant that has been taken out or moved has never grown where it was.
static bool keeps_places(const FrDocument *document, const FrDocument *next) {
    const GPtrArray *old = fr_document_places(document), *new = fr_document_places(next);
    guint kept = 0;
    for (guint i = 0; i < new->len &&kept < old->len; i++) {
        kept += is_same_place(g_ptr_array_index(old, kept), g_ptr_array_index(new, i));
    }
    return kept == old->len && keeps_spread(document, next);
}

// Lets what has grown go on by another text; false if it cannot.
static bool change(StudioGrower *grower, FrDocument *document, FrDigest digest,
                   const FrContext *context) {
    if (grower->simulation == NULL || !keeps_places(grower->document, document)) {
        return false;
    }
    FrContext silent = *context;
    silent.diags = NULL;
    if (grower->digest != digest &&
        fr_simulation_change(grower->simulation, document, &silent) != FR_OK) {
        return false;
    }
    if (grower->digest != digest) {
        fr_document_free(grower->document);
        grower->document = document;
        grower->digest = digest;
    } else {
        fr_document_free(document);
    }
    return true;
}

static FrStatus begin(StudioGrower *grower, FrDocument *document, FrDigest digest,
                      const FrContext *context) {
    FrSimulation *simulation;
    FrStatus status = fr_simulation_new(document, -1, STEPS_BACK, context, &simulation);
    if (status == FR_OK) {
        forget(grower);
        grower->simulation = simulation;
        grower->document = document;
        grower->digest = digest;
    }
    return status;
}

FrStatus studio_grower_take(StudioGrower *grower, FrDocument *document, FrDigest digest,
                            bool goes_on, const FrContext *context) {
    return goes_on && change(grower, document, digest, context)
               ? FR_OK
               : begin(grower, document, digest, context);
}

FrStatus studio_grower_go(StudioGrower *grower, int64_t step, const FrContext *context) {
    FrStatus status = FR_OK;
    uint64_t wanted = step < 0 ? fr_simulation_step_count(grower->simulation) : (uint64_t)step;
    while (grower->step > wanted && fr_simulation_undo(grower->simulation)) {
        grower->step--;
    }
    while (grower->step < wanted && status == FR_OK) {
        status = fr_simulation_step(grower->simulation, context);
        grower->step += status == FR_OK;
    }
    return status;
}

uint64_t studio_grower_step(const StudioGrower *grower) {
    return grower->step;
}

uint64_t studio_grower_step_count(const StudioGrower *grower) {
    return grower->simulation == NULL ? 0 : fr_simulation_step_count(grower->simulation);
}

bool studio_grower_grows(const StudioGrower *grower, const char *plant) {
    const GPtrArray *plants =
        grower->document == NULL ? NULL : fr_document_plants(grower->document);
    bool is_it = false;
    for (guint i = 0; plants != NULL && i < plants->len && !is_it; i++) {
        const FrPlantDef *definition = g_ptr_array_index(plants, i);
        is_it = definition->kind == FR_PLANT_SPECIES && strcmp(definition->id, plant) == 0;
    }
    return is_it;
}

const FrGrowth *studio_grower_growth(const StudioGrower *grower) {
    return grower->simulation == NULL ? NULL : fr_simulation_growth(grower->simulation);
}

FrStatus studio_grower_view(StudioGrower *grower, const FrContext *context, StudioView **view) {
    *view = NULL;
    const FrScene *scene;
    FrStatus status = fr_simulation_scene(grower->simulation, context, &scene);
    FrSkinParams params = fr_skin_default();
    params.foliage = false;
    for (guint i = 0; status == FR_OK && i < scene->plants->len; i++) {
        if (i == grower->skins->len) {
            g_ptr_array_add(grower->skins, fr_skin_new(&params, FR_UP_Z));
        }
        status =
            fr_skin_update(g_ptr_array_index(grower->skins, i),
                           g_array_index(scene->plants, FrScenePlant, i).plant, false, context);
    }
    if (status == FR_OK) {
        *view = studio_view_of(scene, (const FrSkin *const *)(const void *)grower->skins->pdata,
                               context);
    }
    return status;
}
