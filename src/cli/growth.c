/// Scenes built from the command line, with the files that a growth is saved to and resumed from.
#include "cli/cli.h"

#include "frond/only.h"
#include "frond/sequence.h"

struct CliGrowth {
    CliSession *session;
    FrSequence *sequence;
    FrOnly *only;    ///< NULL: all
    char *saved;     ///< of --resume; NULL
    FrSource *named; ///< what it was read from; NULL
};

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

/// Once for each step of what grows bud by bud; a scene that grows from the seeds tells all again.
static void note_stand(CliSession *session, const FrGrowth *growth) {
    CliStand stand = {.step = fr_growth_step_count(growth)};
    GArray *stands = session->stands;
    while (stands->len > 0 && g_array_index(stands, CliStand, stands->len - 1).step >= stand.step) {
        g_array_set_size(stands, stands->len - 1);
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

static FrStatus check_options(const CliOptions *options, const FrDocument *document) {
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
    return FR_OK;
}

/// Reads what is to be resumed.
static FrStatus read_saved(CliGrowth *growth, FrSceneOptions *how) {
    const char *resume = growth->session->options->resume;
    GError *error = NULL;
    if (resume == NULL) {
        return FR_OK;
    }
    if (!g_file_get_contents(resume, &growth->saved, &how->resume_size, &error)) {
        cli_message("cannot resume: %s", error->message);
        g_error_free(error);
        return FR_ERR_MACHINE;
    }
    how->resume = growth->saved;
    growth->named = fr_source_new(resume, "", 0); // its bytes are no text to show
    how->resume_span = (FrSpan){.source = growth->named};
    return FR_OK;
}

FrStatus cli_growth_open(CliSession *session, const FrDocument *document, CliGrowth **growth) {
    const CliOptions *options = session->options;
    CliGrowth *made = g_new0(CliGrowth, 1);
    made->session = session;
    FrSceneOptions how = {
        .seed = options->seed, .steps = options->steps, .after_step = after_step, .data = session};
    FrStatus status = check_options(options, document);
    if (status == FR_OK && options->only->len > 0) { // a wrong name is told before anything grows
        status = fr_only_new(document, (const char *const *)options->only->pdata,
                             options->only->len, &session->context, &made->only);
    }
    if (status == FR_OK) {
        status = read_saved(made, &how);
    }
    made->sequence = fr_sequence_new(document, &how);
    g_array_set_size(session->stands, 0);
    if (status != FR_OK) {
        g_clear_pointer(&made, cli_growth_close);
    }
    *growth = made;
    return status;
}

void cli_growth_close(CliGrowth *growth) {
    if (growth != NULL) {
        fr_sequence_free(growth->sequence);
        fr_only_free(growth->only);
        fr_source_unref(growth->named);
        g_free(growth->saved);
        g_free(growth);
    }
}

FrStatus cli_growth_scene(CliGrowth *growth, double time, FrScene **scene) {
    CliSession *session = growth->session;
    bool stays = session->options->in_place || session->verb->id == CLI_INFO;
    FrStatus status = fr_sequence_scene(growth->sequence, time, &session->context, scene);
    if (status == FR_OK && growth->only != NULL && !fr_only_apply(growth->only, *scene, stays)) {
        fr_diags_add(session->context.diags, FR_ERROR, "only-seeds", (FrSpan){0},
                     "nothing of what --only names has grown: its seeds have no place to stand");
        g_clear_pointer(scene, fr_scene_free);
        status = FR_ERR_DOCUMENT;
    }
    return status;
}

FrStatus cli_session_grow(CliSession *session, const FrDocument *document, double time,
                          FrScene **scene) {
    CliGrowth *growth;
    *scene = NULL;
    FrStatus status = cli_growth_open(session, document, &growth);
    if (status == FR_OK) {
        status = cli_growth_scene(growth, time, scene);
    }
    cli_growth_close(growth);
    return status;
}
