/// L-systems as input: a .l file, with the .v view beside it or the one that --view names.
#include "cli/cli.h"

#include <stdio.h>
#include <string.h>

bool cli_is_lsystem(const char *path) {
    return g_str_has_suffix(path, ".l") || g_str_has_suffix(path, ".L");
}

static void print_text(void *user, const char *text) {
    (void)user;
    fputs(text, stderr);
}

static FrStatus read_view(CliSession *session, const char *path, FrLview **view) {
    char *beside = g_strdup(path);
    beside[strlen(beside) - 1] = 'v';
    const char *name = session->options->view;
    if (name == NULL && g_file_test(beside, G_FILE_TEST_IS_REGULAR)) {
        name = beside;
    }
    FrStatus status = FR_OK;
    if (name != NULL) {
        FrSource *source = fr_source_load(name, session->options->limits.document_bytes,
                                          session->context.diags, &status);
        if (source != NULL) {
            char *folder = g_path_get_dirname(name);
            status = fr_lview_read(source, folder, &session->context, view);
            g_free(folder);
            fr_source_unref(source);
        }
    }
    g_free(beside);
    return status;
}

static FrStatus read_system(CliSession *session, const char *path, CliLsystem *lsystem) {
    FrStatus status;
    FrSource *source = fr_source_load(path, session->options->limits.document_bytes,
                                      session->context.diags, &status);
    if (source == NULL) {
        return status;
    }
    char *folder = g_path_get_dirname(path);
    FrLoptions options = {.folder = folder, .view = lsystem->view};
    status = fr_lsystem_compile(source, &options, &session->context, &lsystem->system);
    g_free(folder);
    fr_source_unref(source);
    return status;
}

FrStatus cli_lsystem_open(CliSession *session, const char *path, CliLsystem *lsystem) {
    double began = cli_now();
    *lsystem = (CliLsystem){.simple = fr_lsimple_default()};
    lsystem->simple.light = (vec3s){{0.6F, 0, 0.8F}}; // from one side, so that plants bend
    FrStatus status = read_view(session, path, &lsystem->view);
    if (status == FR_OK) {
        status = read_system(session, path, lsystem);
    }
    if (status == FR_OK) {
        lsystem->environment = fr_lsimple_environment(&lsystem->simple);
        FrLsettings settings = fr_lsettings_default();
        settings.seed = session->options->seed;
        settings.steps = session->options->steps;
        settings.view = lsystem->view;
        settings.environment = &lsystem->environment;
        settings.print = print_text;
        status =
            fr_lderivation_new(lsystem->system, &settings, &session->context, &lsystem->derivation);
    }
    session->read_seconds += cli_now() - began;
    if (status != FR_OK) {
        cli_lsystem_close(lsystem);
    }
    return status;
}

void cli_lsystem_close(CliLsystem *lsystem) {
    fr_lderivation_free(lsystem->derivation);
    fr_lsystem_free(lsystem->system);
    fr_lview_free(lsystem->view);
    *lsystem = (CliLsystem){0};
}

// What stands around a plant that no document describes: the defaults of everything.
static FrStatus default_document(CliSession *session, const char *path, FrDocument **document) {
    static const char text[] = "<frond version=\"1\"/>";
    FrSource *source = fr_source_new(path, text, sizeof text - 1);
    char *folder = g_path_get_dirname(path);
    FrStatus status = fr_document_parse(source, folder, &session->context, document);
    g_free(folder);
    fr_source_unref(source);
    return status;
}

static FrStatus draw(CliSession *session, const char *path, CliLsystem *lsystem, FrPlant **plant) {
    FrStatus status = fr_lderivation_run(
        lsystem->derivation, fr_lderivation_length(lsystem->derivation), &session->context);
    if (status == FR_OK) {
        status = fr_lderivation_plant(lsystem->derivation, &session->context, plant, NULL);
    }
    if (status == FR_OK) {
        char *name = g_path_get_basename(path);
        name[strlen(name) - 2] = '\0';
        g_free((*plant)->name);
        (*plant)->name = name;
    }
    return status;
}

FrStatus cli_lsystem_build(CliSession *session, const char *path, FrDocument **document,
                           FrScene **scene) {
    *document = NULL;
    *scene = NULL;
    if (session->options->sets->len > 0) {
        cli_message("--set changes documents; an L-system has no attributes");
        return FR_ERR_USAGE;
    }
    CliLsystem lsystem;
    FrStatus status = cli_lsystem_open(session, path, &lsystem);
    if (status != FR_OK) {
        return status;
    }
    double began = cli_now();
    FrPlant *plant = NULL;
    status = draw(session, path, &lsystem, &plant);
    if (status == FR_OK) {
        status = default_document(session, path, document);
    }
    if (status == FR_OK) {
        uint64_t modules = fr_lstring_count(fr_lderivation_string(lsystem.derivation));
        *scene =
            fr_scene_of_plant(plant, modules, *document, (uint64_t)MAX(session->options->seed, 0));
    } else {
        fr_plant_free(plant);
    }
    cli_lsystem_close(&lsystem);
    session->build_seconds += cli_now() - began;
    return status;
}
