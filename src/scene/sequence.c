/// Scenes at several times: static parts are built for each, what grows step by step is handed on.
#include "scene/sequence.h"

#include "scene/simulation.h"

#include <string.h>

struct FrSequence {
    const FrDocument *document;
    FrSceneOptions options;
    FrEcosystem *ecosystem; ///< as the last scene has left it; NULL: there is none
    FrGrowing *growing;
    GArray *steps;        ///< FrSceneStep, of the last scene
    double light_seconds; ///< of them
    FrDigest stage;       ///< of what it has grown on
    bool goes_on;         ///< the scene that is begun has taken over what the last one has grown
};

FrSequence *fr_sequence_new(const FrDocument *document, const FrSceneOptions *options) {
    FrSequence *made = g_new0(FrSequence, 1);
    made->document = document;
    made->options = *options;
    made->steps = g_array_new(FALSE, FALSE, sizeof(FrSceneStep));
    return made;
}

static void drop(FrSequence *sequence) {
    g_clear_pointer(&sequence->ecosystem, fr_ecosystem_free);
    g_clear_pointer(&sequence->growing, fr_growing_free);
    g_array_set_size(sequence->steps, 0);
}

void fr_sequence_free(FrSequence *sequence) {
    if (sequence != NULL) {
        drop(sequence);
        g_array_unref(sequence->steps);
        g_free(sequence);
    }
}

/// Of all that is there before anything has grown: shapes, materials and where they stand.
static FrDigest stage_of(const FrScene *scene) {
    FrDigest digest = 0;
    for (guint i = 0; i < scene->plants->len; i++) {
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        FrDigest own = fr_plant_digest(plant);
        digest = fr_digest(digest, &own, sizeof own);
        for (guint m = 0; m < plant->materials->len; m++) {
            const char *name = fr_material_name(g_ptr_array_index(plant->materials, m));
            digest = fr_digest(digest, name, name == NULL ? 0 : strlen(name));
        }
    }
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const double where[5] = {stand->at[0], stand->at[1], stand->at[2], stand->turn,
                                 stand->scale};
        digest = fr_digest(digest, &stand->plant, sizeof stand->plant);
        digest = fr_digest(digest, where, sizeof where);
    }
    return digest;
}

bool fr_sequence_hand_over(FrSequence *sequence, FrScene *scene, uint64_t steps,
                           FrEcosystem **ecosystem, FrGrowing **growing) {
    FrDigest before = sequence->stage;
    sequence->stage = stage_of(scene);
    if (sequence->ecosystem == NULL || before != sequence->stage) {
        return false;
    }
    const FrGrowth *growth = fr_ecosystem_growth(sequence->ecosystem);
    if ((growth != NULL && fr_growth_step_count(growth) > steps) ||
        !fr_growing_go_on(sequence->growing, *growing)) {
        return false;
    }
    fr_ecosystem_free(*ecosystem);
    fr_growing_free(*growing);
    *ecosystem = g_steal_pointer(&sequence->ecosystem);
    *growing = g_steal_pointer(&sequence->growing);
    g_array_append_vals(scene->steps, sequence->steps->data, sequence->steps->len);
    scene->light_seconds = sequence->light_seconds;
    return sequence->goes_on = true;
}

/// Keeps what has grown; the scene itself is the caller's.
static FrScene *keep(FrSequence *sequence, FrSimulation *simulation) {
    FrScene *scene = g_steal_pointer(&simulation->scene);
    sequence->ecosystem = g_steal_pointer(&simulation->ecosystem);
    sequence->growing = g_steal_pointer(&simulation->growing);
    g_array_append_vals(sequence->steps, scene->steps->data, scene->steps->len);
    sequence->light_seconds = scene->light_seconds;
    return scene;
}

FrStatus fr_sequence_scene(FrSequence *sequence, double time, const FrContext *context,
                           FrScene **scene) {
    FrSceneHow how = {.options = sequence->options, .sequence = sequence};
    how.options.time = time;
    sequence->goes_on = false;
    *scene = NULL;
    FrSimulation simulation;
    FrStatus status = fr_scene_begin(sequence->document, &how, context, &simulation);
    drop(sequence);
    if (status != FR_OK) {
        return status;
    }
    if (sequence->goes_on) {
        how.options.resume = NULL; // the first scene has taken it up
    }
    status = fr_simulation_run(&simulation, &how.options, context);
    if (status == FR_OK) {
        *scene = keep(sequence, &simulation);
    }
    fr_simulation_clear(&simulation);
    return status;
}
