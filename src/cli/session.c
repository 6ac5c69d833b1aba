/// The session around a verb: threads, Ctrl-C, diagnostics, the way from a file to a scene.
#include "cli/cli.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// Written by the signal handler: what to cancel, and what has asked for it.
static FrProgress *volatile watched;
static volatile sig_atomic_t received;

static void on_signal(int number) {
    received = number;
    if (watched != NULL) {
        fr_progress_cancel(watched);
    }
}

static void watch_signals(FrProgress *progress) {
    watched = progress;
    // The second Ctrl-C ends the program at once.
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    signal(SIGXFSZ, SIG_IGN); // a write then fails with EFBIG, and what it has begun is taken away
}

int cli_session_signal(void) {
    return received;
}

void cli_session_open(CliSession *session, const CliVerb *verb, const CliOptions *options) {
    *session = (CliSession){.verb = verb, .options = options, .began = cli_now()};
    session->stands = g_array_new(FALSE, FALSE, sizeof(CliStand));
    session->context = (FrContext){.pool = fr_pool_new(options->threads),
                                   .progress = cli_progress_new(options->is_quiet),
                                   .diags = fr_diags_new(),
                                   .limits = options->limits};
    watch_signals(session->context.progress);
}

void cli_session_close(CliSession *session) {
    watched = NULL;
    cli_progress_free(session->context.progress);
    session->context.progress = NULL;
    cli_session_flush(session);
    fr_diags_free(session->context.diags);
    fr_source_unref(session->unwritten);
    g_array_unref(session->stands);
    fr_pool_free(session->context.pool);
}

/// What is told: with -q errors only, and never a place in a document that nobody wrote.
static FrDiags *told_of(const CliSession *session) {
    const FrDiags *diags = session->context.diags;
    FrDiags *told = fr_diags_new();
    for (size_t i = 0; i < fr_diags_count(diags); i++) {
        const FrDiag *diag = fr_diags_get(diags, i);
        bool is_placed = session->unwritten == NULL || diag->span.source != session->unwritten;
        if (diag->severity == FR_ERROR || !session->options->is_quiet) {
            fr_diags_add(told, diag->severity, diag->code, is_placed ? diag->span : (FrSpan){0},
                         "%s", diag->text);
        }
    }
    return told;
}

/// Whether there is a limit that --limit changes; some that are refused are fixed.
static bool is_changeable(const char *limit) {
    FrLimits limits = fr_limits_default();
    FrDiags *unheard = fr_diags_new();
    bool is_known = fr_limits_set(&limits, limit, "1", unheard) == FR_OK;
    fr_diags_free(unheard);
    return is_known;
}

/// Says how to have what a limit has refused.
static void add_hint(const FrDiags *printed, GString *text) {
    for (size_t i = 0; i < fr_diags_count(printed); i++) {
        const char *code = fr_diags_get(printed, i)->code;
        if (g_str_has_prefix(code, "limit-") && is_changeable(code + strlen("limit-"))) {
            char *name = g_strdelimit(g_strdup(code + strlen("limit-")), "_", '-');
            g_string_append_printf(text, "frond: if it is meant, --limit %s=N allows more\n", name);
            g_free(name);
            return;
        }
    }
}

void cli_session_flush(CliSession *session) {
    FrDiags *printed = told_of(session);
    GString *text = g_string_new(NULL);
    if (session->options->is_diag_json) {
        fr_diags_print_json(printed, text);
        if (text->len > 0 && text->str[text->len - 1] != '\n') {
            g_string_append_c(text, '\n');
        }
    } else {
        fr_diags_print(printed, text);
        add_hint(printed, text);
    }
    if (fr_diags_count(printed) > 0) {
        fwrite(text->str, 1, text->len, stderr);
    }
    g_string_free(text, TRUE);
    fr_diags_free(printed);
    fr_diags_free(session->context.diags);
    session->context.diags = fr_diags_new();
}

bool cli_check_spared(const CliOptions *options, const char *input) {
    GStatBuf read, written;
    if (g_stat(input, &read) != 0) {
        return true; // reading it will say so
    }
    for (guint i = 0; i <= options->outputs->len; i++) {
        const char *output =
            i < options->outputs->len ? g_ptr_array_index(options->outputs, i) : options->stats;
        bool is_same = output != NULL && strcmp(output, "-") != 0 &&
                       g_stat(output, &written) == 0 && S_ISREG(written.st_mode) &&
                       written.st_dev == read.st_dev && written.st_ino == read.st_ino;
        if (is_same) {
            cli_message("'%s' would be overwritten: it is read", output);
            return false;
        }
    }
    return true;
}

/// Whether no output would overwrite a file that a document names; NULL or "" names none.
static bool is_spared(const CliOptions *options, const FrDocument *document, const char *file) {
    if (file == NULL || *file == '\0') {
        return true;
    }
    char *path = g_path_is_absolute(file)
                     ? g_strdup(file)
                     : g_build_filename(fr_document_folder(document), file, NULL);
    bool is_spared = cli_check_spared(options, path);
    g_free(path);
    return is_spared;
}

/// The files that a component reads are what its parameters call so.
static bool check_component_spared(const CliOptions *options, const FrDocument *document,
                                   FrPgraph *graph, uint32_t component) {
    const FrParamTable *table = fr_pgraph_table(fr_pgraph_kind(graph, component));
    const char *params = fr_pgraph_params(graph, component);
    for (size_t r = 0; r < table->count; r++) {
        const FrParam *row = &table->rows[r];
        if (row->kind == FR_PARAM_TEXT && g_str_has_suffix(row->name, "file")) {
            const char *file;
            memcpy(&file, params + row->offset, sizeof file);
            if (!is_spared(options, document, file)) {
                return false;
            }
        }
    }
    return true;
}

/// What the plants of a document are read from is not overwritten either.
static bool check_plants_spared(const CliOptions *options, const FrDocument *document) {
    const GPtrArray *plants = fr_document_plants(document);
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (plant->lsystem != NULL) {
            const FrLsystemParams *params = fr_lmodel_params(plant->lsystem);
            if (!is_spared(options, document, params->file) ||
                !is_spared(options, document, params->view)) {
                return false;
            }
        }
        if (plant->skeleton != NULL &&
            !is_spared(options, document, fr_skeleton_file(plant->skeleton))) {
            return false;
        }
        for (uint32_t c = 0; c < fr_pgraph_count(plant->pgraph); c++) {
            if (!check_component_spared(options, document, plant->pgraph, c)) {
                return false;
            }
        }
    }
    return true;
}

static bool check_obstacles_spared(const CliOptions *options, const FrDocument *document) {
    const GPtrArray *obstacles = fr_document_surroundings(document)->obstacles;
    for (guint i = 0; i < obstacles->len; i++) {
        const FrObstacle *obstacle = g_ptr_array_index(obstacles, i);
        if (!is_spared(options, document, obstacle->file)) {
            return false;
        }
    }
    const FrTerrain *terrain = fr_document_surroundings(document)->terrain;
    return terrain == NULL || is_spared(options, document, terrain->file);
}

static bool check_densities_spared(const CliOptions *options, const FrDocument *document) {
    const GPtrArray *strews = fr_document_strews(document);
    for (guint i = 0; i < strews->len; i++) {
        if (!is_spared(options, document,
                       ((const FrStrew *)g_ptr_array_index(strews, i))->density)) {
            return false;
        }
    }
    return true;
}

/// The user's own pictures are not overwritten either.
static bool check_pictures_spared(const CliOptions *options, const FrDocument *document) {
    const GPtrArray *materials = fr_document_materials(document);
    bool are_spared = true;
    for (guint i = 0; i < materials->len && are_spared; i++) {
        const FrMaterialParams *params = fr_material_params(g_ptr_array_index(materials, i));
        const char *files[] = {params->picture, params->normal_map, params->roughness_map};
        for (size_t k = 0; k < G_N_ELEMENTS(files) && are_spared; k++) {
            are_spared = is_spared(options, document, files[k]);
        }
    }
    return are_spared;
}

/// What a document says of itself as it has been set; what it said before counts no more.
static FrStatus tell_again(CliSession *session, const FrDocument *document) {
    size_t size;
    char *text = fr_document_text(document, &size);
    FrSource *source = fr_source_new(fr_document_name(document), text, size);
    fr_diags_free(session->context.diags);
    session->context.diags = fr_diags_new();
    FrDocument *again;
    FrStatus status =
        fr_document_parse(source, fr_document_folder(document), &session->context, &again);
    fr_document_free(again);
    fr_source_unref(source);
    g_free(text);
    return status;
}

FrStatus cli_session_read(CliSession *session, const char *path, FrDocument **document) {
    double began = cli_now();
    FrStatus status = cli_is_lsystem(path) ? cli_lsystem_read(session, path, document)
                                           : fr_document_load(path, &session->context, document);
    for (guint i = 0; i < session->options->sets->len && status == FR_OK; i++) {
        const char *set = g_ptr_array_index(session->options->sets, i);
        if (cli_lsystem_takes(path, set)) {
            continue;
        }
        const char *equals = strchr(set, '=');
        char *name = g_strndup(set, (gsize)(equals - set));
        status = fr_document_set(*document, name, equals + 1, &session->context);
        g_free(name);
    }
    if (status == FR_OK && session->options->sets->len > 0 && !cli_is_lsystem(path)) {
        status = tell_again(session, *document);
    }
    if (status == FR_OK) {
        status = cli_lsystem_apply(session, *document);
    }
    if (status == FR_OK && !(check_pictures_spared(session->options, *document) &&
                             check_plants_spared(session->options, *document) &&
                             check_obstacles_spared(session->options, *document) &&
                             check_densities_spared(session->options, *document))) {
        status = FR_ERR_USAGE;
    }
    if (status != FR_OK) {
        fr_document_free(*document);
        *document = NULL;
    }
    session->read_seconds += cli_now() - began;
    return status;
}

FrStatus cli_session_build(CliSession *session, const char *path, FrDocument **document,
                           FrScene **scene) {
    *scene = NULL;
    FrStatus status = cli_session_read(session, path, document);
    if (status != FR_OK) {
        return status;
    }
    double began = cli_now();
    status = cli_session_grow(session, *document, session->options->time, scene);
    session->build_seconds += cli_now() - began;
    if (status == FR_OK && cli_is_lsystem(path)) {
        cli_lsystem_name(path, *scene);
    }
    if (status != FR_OK) {
        fr_document_free(*document);
        *document = NULL;
    }
    return status;
}

typedef struct Bytes {
    const char *data;
    size_t size;
} Bytes;

static bool write_bytes(void *user, int descriptor) {
    const Bytes *bytes = user;
    for (size_t done = 0; done < bytes->size;) {
        ssize_t written = write(descriptor, bytes->data + done, bytes->size - done);
        if (written < 0 && errno != EINTR) {
            return false;
        }
        done += written > 0 ? (size_t)written : 0;
    }
    return true;
}

FrStatus cli_session_save(CliSession *session, const char *path, const void *data, size_t size) {
    Bytes bytes = {data, size};
    return fr_io_replace_file(path, write_bytes, &bytes, session->context.diags);
}
