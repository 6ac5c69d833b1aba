/// Scenes built from the command line, with the files that a growth is saved to and resumed from.
#include "cli/cli.h"

#include "frond/only.h"
#include "frond/simulation.h"

bool cli_growth_takes_steps(const FrDocument *document) {
    const GPtrArray *plants = fr_document_plants(document);
    bool takes = false;
    for (guint i = 0; i < plants->len; i++) {
        takes |= ((const FrPlantDef *)g_ptr_array_index(plants, i))->kind == FR_PLANT_SPECIES;
    }
    return takes;
}

/// True where anything grows step by step: then it can be saved between two.
static bool grows_by_steps(const FrDocument *document) {
    const GPtrArray *plants = fr_document_plants(document);
    bool grows = cli_growth_takes_steps(document);
    for (guint i = 0; i < plants->len && !grows; i++) {
        grows = fr_scene_is_lit(document, g_ptr_array_index(plants, i));
    }
    return grows;
}

/// The file is replaced at once, so that one step is lost at most.
static FrStatus write_checkpoint(CliSession *session, const FrSimulation *simulation,
                                 const FrContext *context) {
    GBytes *bytes = fr_simulation_save(simulation, context);
    if (bytes == NULL) {
        return FR_ERR_DOCUMENT;
    }
    gsize size;
    const void *content = g_bytes_get_data(bytes, &size);
    FrStatus status = cli_session_save(session, session->options->checkpoint, content, size);
    g_bytes_unref(bytes);
    return status;
}

/// Once for each step of what grows bud by bud.
static void note_stand(CliSession *session, const FrGrowth *growth) {
    CliStand stand = {.step = fr_growth_step_count(growth)};
    GArray *stands = session->stands;
    if (stands->len > 0 && g_array_index(stands, CliStand, stands->len - 1).step >= stand.step) {
        return;
    }
    for (uint32_t i = 0; i < fr_growth_plant_count(growth); i++) {
        if (fr_growth_is_alive(growth, i)) {
            stand.living++;
            stand.wood += fr_growth_wood(growth, i);
        }
    }
    g_array_append_val(stands, stand);
}

static FrStatus after_step(void *data, const FrSimulation *simulation, const FrContext *context) {
    CliSession *session = data;
    const FrGrowth *growth = fr_simulation_growth(simulation);
    if (session->options->stats != NULL && growth != NULL) {
        note_stand(session, growth);
    }
    return session->options->checkpoint == NULL ? FR_OK
                                                : write_checkpoint(session, simulation, context);
}

static FrStatus grow_all(CliSession *session, const FrDocument *document, double time,
                         FrScene **scene) {
    const CliOptions *options = session->options;
    *scene = NULL;
    g_array_set_size(session->stands, 0);
    if ((options->checkpoint != NULL || options->resume != NULL) && !grows_by_steps(document)) {
        cli_message("nothing in the document grows step by step, so there is nothing to save or "
                    "resume");
        return FR_ERR_USAGE;
    }
    const FrParam *steps = fr_params_find(fr_growth_table(), "steps");
    if (cli_growth_takes_steps(document) && (double)options->steps > steps->max) {
        cli_message("--steps takes at most %.0f for what grows bud by bud, not %" G_GINT64_FORMAT,
                    steps->max, options->steps);
        return FR_ERR_USAGE;
    }
    FrSceneOptions how = {.seed = options->seed,
                          .time = time,
                          .steps = options->steps,
                          .after_step = after_step,
                          .data = session};
    char *saved = NULL;
    FrSource *named = NULL;
    if (options->resume != NULL) {
        GError *error = NULL;
        if (!g_file_get_contents(options->resume, &saved, &how.resume_size, &error)) {
            cli_message("cannot resume: %s", error->message);
            g_error_free(error);
            return FR_ERR_MACHINE;
        }
        how.resume = saved;
        named = fr_source_new(options->resume, "", 0); // its bytes are no text to show
        how.resume_span = (FrSpan){.source = named};
    }
    FrStatus status = fr_scene_build_with(document, &how, &session->context, scene);
    if (named != NULL) {
        fr_source_unref(named);
    }
    g_free(saved);
    return status;
}

FrStatus cli_session_grow(CliSession *session, const FrDocument *document, double time,
                          FrScene **scene) {
    const GPtrArray *names = session->options->only;
    if (names->len == 0) {
        return grow_all(session, document, time, scene);
    }
    *scene = NULL;
    FrOnly *only; // a wrong name is told before anything grows
    FrStatus status = fr_only_new(document, (const char *const *)names->pdata, names->len,
                                  &session->context, &only);
    if (status == FR_OK) {
        status = grow_all(session, document, time, scene);
    }
    if (status == FR_OK) {
        bool is_there = fr_only_apply(only, *scene, session->options->in_place);
        FR_ASSERT(is_there);
    }
    fr_only_free(only);
    return status;
}
