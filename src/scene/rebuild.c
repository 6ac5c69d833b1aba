#include "scene/rebuild.h"

#include "skin/kept.h"

// One plant that is shown.
typedef struct Unit {
    char *key;
    FrPgraphBuild *build; // NULL for other engines: then the scene owns the plant
    FrSkin *skin;
} Unit;

// All that is shown, or shall be.
typedef struct Show {
    FrScene *scene;
    GPtrArray *views; // of the document it was made from, as are …
    FrSurroundings surroundings;
    FrSceneParams params;
    GArray *units;      // Unit, by plant
    GHashTable *by_key; // key → index of unit + 1
} Show;

struct FrRebuild {
    FrSkinParams params;
    FrUpAxis up;
    Show *show; // NULL before the first update
    FrRebuildWork work;
};

FrRebuild *fr_rebuild_new(const FrSkinParams *params, FrUpAxis up) {
    FrRebuild *rebuild = g_new0(FrRebuild, 1);
    rebuild->params = *params;
    rebuild->up = up;
    return rebuild;
}

// ---- what is shown -----------------------------------------------------------------------------

static void unit_clear(gpointer data) {
    Unit *unit = data;
    g_free(unit->key);
    fr_pgraph_build_free(unit->build);
    fr_skin_free(unit->skin);
}

// What scenes borrow of their document stays as it is when the document changes or goes.
static void hold_settings(Show *show, const FrDocument *document) {
    const FrSurroundings *around = fr_document_surroundings(document);
    FrSurroundings *own = &show->surroundings;
    show->views = g_ptr_array_ref((GPtrArray *)fr_document_views(document));
    own->obstacles = g_ptr_array_ref(around->obstacles);
    own->lamps = g_ptr_array_ref(around->lamps);
    fr_params_copy(fr_sun_table(), &own->sun, &around->sun);
    fr_params_copy(fr_light_table(), &own->light, &around->light);
    fr_params_copy(fr_scene_table(), &show->params, fr_document_scene(document));
}

static void drop_settings(Show *show) {
    g_ptr_array_unref(show->views);
    g_ptr_array_unref(show->surroundings.obstacles);
    g_ptr_array_unref(show->surroundings.lamps);
    fr_params_clear(fr_sun_table(), &show->surroundings.sun);
    fr_params_clear(fr_light_table(), &show->surroundings.light);
    fr_params_clear(fr_scene_table(), &show->params);
}

static void show_free(Show *show) {
    if (show == NULL) {
        return;
    }
    for (guint i = 0; show->scene != NULL && i < show->units->len; i++) {
        if (g_array_index(show->units, Unit, i).build != NULL) {
            g_array_index(show->scene->plants, FrScenePlant, i).plant = NULL;
        }
    }
    fr_scene_free(show->scene);
    drop_settings(show);
    g_array_unref(show->units);
    g_hash_table_unref(show->by_key);
    g_free(show);
}

static Unit *unit_of(const Show *show, const char *key) {
    guint found = show != NULL ? GPOINTER_TO_UINT(g_hash_table_lookup(show->by_key, key)) : 0;
    return found > 0 ? &g_array_index(show->units, Unit, found - 1) : NULL;
}

static const FrPgraphBuild *last_of(void *data, const char *key) {
    const Unit *unit = unit_of(((FrRebuild *)data)->show, key);
    return unit != NULL ? unit->build : NULL;
}

// One unit a plant of the scene, or what is left of a scene that failed.
static void list_units(Show *show, const GArray *parts) {
    guint plants = show->scene != NULL ? show->scene->plants->len : parts->len;
    g_array_set_size(show->units, plants);
    for (guint i = 0; i < parts->len; i++) {
        const FrScenePart *part = &g_array_index(parts, FrScenePart, i);
        g_array_index(show->units, Unit, show->scene != NULL ? part->plant : i) =
            (Unit){.key = part->key, .build = part->build};
    }
    for (guint i = 0; i < plants; i++) {
        Unit *unit = &g_array_index(show->units, Unit, i);
        if (unit->key == NULL) { // obstacles, or made together with others
            unit->key = g_strdup_printf("plant %u", i);
        }
        g_hash_table_insert(show->by_key, unit->key, GUINT_TO_POINTER(i + 1));
    }
}

static Show *show_new(FrRebuild *rebuild, const FrDocument *document, int64_t seed,
                      const FrContext *context, FrStatus *status) {
    Show *show = g_new0(Show, 1);
    FrSceneParts parts = {g_array_new(FALSE, FALSE, sizeof(FrScenePart)), last_of, rebuild};
    hold_settings(show, document);
    show->units = g_array_new(FALSE, TRUE, sizeof(Unit));
    g_array_set_clear_func(show->units, unit_clear);
    show->by_key = g_hash_table_new(g_str_hash, g_str_equal);
    *status = fr_scene_build_parts(document, seed, context, &parts, &show->scene);
    list_units(show, parts.parts);
    if (*status == FR_OK) {
        show->scene->params = &show->params;
        show->scene->surroundings = &show->surroundings;
        for (guint i = 0; i < show->scene->plants->len; i++) { // places of the document's text
            g_array_index(show->scene->plants, FrScenePlant, i).nurbs_span = (FrSpan){0};
        }
    }
    g_array_unref(parts.parts);
    return show;
}

// ---- updating ----------------------------------------------------------------------------------

static const FrPlant *plant_at(const Show *show, guint index) {
    return g_array_index(show->scene->plants, FrScenePlant, index).plant;
}

// Plans the skins of all plants; those that were shown keep theirs until all is planned.
static FrStatus plan_skins(const FrRebuild *rebuild, Show *next, const FrContext *context) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < next->units->len && status == FR_OK; i++) {
        Unit *unit = &g_array_index(next->units, Unit, i);
        const Unit *last = unit_of(rebuild->show, unit->key);
        bool has_same_rows = last != NULL && last->build != NULL && unit->build != NULL &&
                             fr_pgraph_build_shares(unit->build, last->build);
        if (last == NULL) {
            unit->skin = fr_skin_new(&rebuild->params, rebuild->up);
        }
        status = fr_skin_plan(last != NULL ? last->skin : unit->skin, plant_at(next, i),
                              has_same_rows, context);
    }
    for (guint i = 0; rebuild->show != NULL && status != FR_OK && i < rebuild->show->units->len;
         i++) {
        fr_skin_drop(g_array_index(rebuild->show->units, Unit, i).skin);
    }
    return status;
}

static void write_skins(FrRebuild *rebuild, Show *next, const FrContext *context) {
    FrRebuildWork *work = &rebuild->work;
    *work = (FrRebuildWork){0};
    for (guint i = 0; i < next->units->len; i++) {
        Unit *unit = &g_array_index(next->units, Unit, i);
        Unit *last = unit_of(rebuild->show, unit->key);
        if (last != NULL) {
            unit->skin = last->skin;
            last->skin = NULL;
        }
        fr_skin_write(unit->skin, plant_at(next, i), context);
        FrSkinWork skin = fr_skin_work(unit->skin);
        work->skin.runs += skin.runs;
        work->skin.runs_written += skin.runs_written;
        work->skin.organs += skin.organs;
        work->skin.organs_written += skin.organs_written;
        if (unit->build != NULL) {
            uint64_t instances = fr_pgraph_build_counts(unit->build)->instances;
            work->instances += instances;
            work->instances_made += instances - fr_pgraph_build_taken_over(unit->build);
        }
    }
}

FrStatus fr_rebuild_update(FrRebuild *rebuild, const FrDocument *document, int64_t seed,
                           const FrContext *context) {
    FrStatus status;
    Show *next = show_new(rebuild, document, seed, context, &status);
    status = status == FR_OK ? plan_skins(rebuild, next, context) : status;
    if (status != FR_OK) {
        show_free(next);
        return status;
    }
    write_skins(rebuild, next, context);
    show_free(rebuild->show);
    rebuild->show = next;
    return FR_OK;
}

void fr_rebuild_free(FrRebuild *rebuild) {
    if (rebuild != NULL) {
        show_free(rebuild->show);
        g_free(rebuild);
    }
}

const FrScene *fr_rebuild_scene(const FrRebuild *rebuild) {
    return rebuild->show != NULL ? rebuild->show->scene : NULL;
}

const FrSkin *fr_rebuild_skin(const FrRebuild *rebuild, uint32_t plant) {
    FR_ASSERT(rebuild->show != NULL && plant < rebuild->show->units->len);
    return g_array_index(rebuild->show->units, Unit, plant).skin;
}

FrRebuildWork fr_rebuild_work(const FrRebuild *rebuild) {
    return rebuild->work;
}
