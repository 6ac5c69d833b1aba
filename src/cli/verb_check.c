/// frond check: what is wrong with documents. They are also built, for much is known only then; but
/// what grows in the light, or bud by bud, is not grown.
#include "cli/cli.h"

#include <math.h>
#include <string.h>

/// Pictures that a material takes from files can be read.
static FrStatus check_pictures(CliSession *session, const FrDocument *document) {
    FrStatus worst = FR_OK;
    const GPtrArray *materials = fr_document_materials(document);
    for (guint i = 0; i < materials->len; i++) {
        FrMaterial *material = g_ptr_array_index(materials, i);
        const FrMaterialParams *params = fr_material_params(material);
        const char *files[FR_MAP_COUNT] = {[FR_MAP_COLOUR] = params->picture,
                                           [FR_MAP_NORMAL] = params->normal_map,
                                           [FR_MAP_ROUGHNESS] = params->roughness_map};
        for (FrMap map = 0; map < FR_MAP_COUNT; map++) {
            FrStatus status = FR_OK;
            if (files[map] != NULL) {
                fr_material_image(material, map, &session->context, &status);
            }
            worst = MAX(worst, status);
        }
    }
    return worst;
}

static bool is_standing(const FrScene *scene, const char *id) {
    for (guint i = 0; i < scene->plants->len; i++) {
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        if (strcmp(plant->name, id) == 0) {
            return true;
        }
    }
    return false;
}

/// Plants that stand nowhere are built all the same.
static FrStatus check_others(CliSession *session, const FrDocument *document,
                             const FrScene *scene) {
    const GPtrArray *definitions = fr_document_plants(document);
    FrStatus worst = FR_OK;
    for (guint i = 0; i < definitions->len && worst != FR_CANCELLED; i++) {
        const FrPlantDef *definition = g_ptr_array_index(definitions, i);
        if (definition->kind == FR_PLANT_SPECIES || is_standing(scene, definition->id)) {
            continue;
        }
        FrScene *alone = NULL;
        FrStatus status = fr_scene_collect(document, definition, session->options->seed, NAN, 1,
                                           &session->context, &alone);
        fr_scene_free(alone);
        worst = MAX(worst, status);
    }
    return worst;
}

FrStatus cli_check(CliSession *session) {
    const GPtrArray *files = session->options->files;
    FrStatus worst = FR_OK;
    for (guint i = 0; i < files->len && worst != FR_CANCELLED; i++) {
        FrDocument *document = NULL;
        FrScene *scene = NULL;
        const char *path = g_ptr_array_index(files, i);
        FrStatus status = cli_session_read(session, path, &document);
        if (status == FR_OK) {
            status = check_pictures(session, document);
            // A document may hold materials and curves only.
            if (status == FR_OK && fr_document_plants(document)->len > 0) {
                status =
                    fr_scene_check(document, session->options->seed, &session->context, &scene);
            }
            if (scene != NULL) {
                status = check_others(session, document, scene);
            }
            fr_scene_free(scene);
        }
        cli_session_flush(session);
        fr_document_free(document);
        worst = MAX(worst, status);
    }
    return worst;
}
