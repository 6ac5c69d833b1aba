/// frond derive: the string of an L-system, or how many modules it has.
#include "cli/cli.h"

#include <stdio.h>

static void print_string(const FrLderivation *derivation, bool is_count) {
    const FrLstring *string = fr_lderivation_string(derivation);
    if (is_count) {
        printf("%" G_GUINT64_FORMAT "\n", fr_lstring_count(string));
        return;
    }
    GString *text = g_string_new(NULL);
    fr_lstring_print(string, text);
    g_string_append_c(text, '\n');
    fwrite(text->str, 1, text->len, stdout);
    g_string_free(text, TRUE);
}

// Each step as it was made and as it is after the environment has answered.
static FrStatus derive_open(CliSession *session, FrLderivation *derivation) {
    bool is_count = session->options->prints_count;
    uint64_t length = fr_lderivation_length(derivation);
    FrStatus status = FR_OK;
    for (;;) {
        uint64_t step = fr_lderivation_step(derivation);
        printf("%" G_GUINT64_FORMAT ": ", step);
        print_string(derivation, is_count);
        status = fr_lderivation_ask(derivation, &session->context);
        if (status != FR_OK) {
            return status;
        }
        printf("%" G_GUINT64_FORMAT "': ", step);
        print_string(derivation, is_count);
        if (step >= length || fr_lderivation_is_stopped(derivation)) {
            return FR_OK;
        }
        status = fr_lderivation_run(derivation, 1, &session->context);
        if (status != FR_OK) {
            return status;
        }
    }
}

/// A step's number, the modules, and how many they are after homomorphism.
static FrStatus print_step(const CliSession *session, FrLderivation *derivation) {
    uint64_t interpreted;
    FrStatus status = fr_lderivation_count(derivation, &session->context, &interpreted);
    if (status == FR_OK) {
        printf("%" G_GUINT64_FORMAT " %" G_GUINT64_FORMAT " %" G_GUINT64_FORMAT "\n",
               fr_lderivation_step(derivation), fr_lstring_count(fr_lderivation_string(derivation)),
               interpreted);
    }
    return status;
}

static FrStatus derive_steps(CliSession *session, FrLderivation *derivation) {
    for (;;) {
        uint64_t step = fr_lderivation_step(derivation);
        FrStatus status = print_step(session, derivation);
        if (status != FR_OK) {
            return status;
        }
        if (step >= fr_lderivation_length(derivation) || fr_lderivation_is_stopped(derivation)) {
            return FR_OK;
        }
        status = fr_lderivation_run(derivation, 1, &session->context);
        if (status != FR_OK) {
            return status;
        }
    }
}

/// What is looked at in the light of a scene.
typedef struct Seen {
    const CliSession *session;
    uint64_t count; ///< modules of the last string
    bool is_any;    ///< the scene has such a plant
} Seen;

static FrStatus see(void *user, FrLderivation *derivation, bool is_answered) {
    Seen *seen = user;
    const CliOptions *options = seen->session->options;
    seen->is_any = true;
    seen->count = fr_lstring_count(fr_lderivation_string(derivation));
    if (options->prints_steps) {
        return is_answered ? FR_OK : print_step(seen->session, derivation);
    }
    if (!options->prints_count) {
        printf("%" G_GUINT64_FORMAT "%s: ", fr_lderivation_step(derivation),
               is_answered ? "'" : "");
        print_string(derivation, false);
    }
    return FR_OK;
}

static FrStatus derive(CliSession *session, const FrPlantDef *plant) {
    FrLsettings settings = fr_lmodel_settings(plant->lsystem);
    int64_t own = plant->has_seed ? (int64_t)plant->seed : -1;
    settings.seed = session->options->seed >= 0 ? session->options->seed : own;
    FrLderivation *derivation;
    FrStatus status = fr_lmodel_derive(plant->lsystem, &settings, &session->context, &derivation);
    if (status != FR_OK) {
        return status;
    }
    if (session->options->prints_steps) {
        status = derive_steps(session, derivation);
    } else if (fr_lsystem_is_open(fr_lmodel_system(plant->lsystem)) &&
               !session->options->prints_count) {
        status = derive_open(session, derivation);
    } else {
        status =
            fr_lderivation_run(derivation, fr_lderivation_length(derivation), &session->context);
        if (status == FR_OK) {
            print_string(derivation, session->options->prints_count);
        }
    }
    if (status == FR_OK && session->options->is_verbose) {
        cli_message("%" G_GUINT64_FORMAT " steps, %" G_GUINT64_FORMAT " modules, %.3f s",
                    fr_lderivation_step(derivation),
                    fr_lstring_count(fr_lderivation_string(derivation)),
                    cli_now() - session->began);
    }
    fr_lderivation_free(derivation);
    return status;
}

/// An L-system that grows in its scene, in the light of everything there.
static FrStatus derive_in_light(CliSession *session, const FrDocument *document,
                                const FrPlantDef *plant) {
    Seen seen = {.session = session};
    FrStatus status =
        fr_scene_derive(document, plant, session->options->seed, &session->context, see, &seen);
    if (status == FR_OK && !seen.is_any) {
        fr_diags_add(session->context.diags, FR_WARNING, "unplaced-plant", plant->span,
                     "the scene does not place '%s', so it is derived alone and without light",
                     plant->id);
        return derive(session, plant);
    }
    if (status == FR_OK && session->options->prints_count && !session->options->prints_steps) {
        printf("%" G_GUINT64_FORMAT "\n", seen.count);
    }
    return status;
}

FrStatus cli_derive(CliSession *session) {
    const char *path = g_ptr_array_index(session->options->files, 0);
    FrDocument *document;
    FrStatus status = cli_session_read(session, path, &document);
    if (status != FR_OK) {
        return status;
    }
    const FrPlantDef *plant = cli_lsystem_find(session, document);
    if (plant == NULL) {
        status = FR_ERR_USAGE;
    } else if (fr_scene_is_lit(document, plant)) {
        status = derive_in_light(session, document, plant);
    } else {
        status = derive(session, plant);
    }
    fr_document_free(document);
    return status;
}
