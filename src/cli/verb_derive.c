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

FrStatus cli_derive(CliSession *session) {
    const char *path = g_ptr_array_index(session->options->files, 0);
    CliLsystem lsystem;
    FrStatus status = cli_lsystem_open(session, path, &lsystem);
    if (status != FR_OK) {
        return status;
    }
    if (fr_lsystem_is_open(lsystem.system)) {
        status = derive_open(session, lsystem.derivation);
    } else {
        status = fr_lderivation_run(lsystem.derivation, fr_lderivation_length(lsystem.derivation),
                                    &session->context);
        if (status == FR_OK) {
            print_string(lsystem.derivation, session->options->prints_count);
        }
    }
    if (status == FR_OK && session->options->is_verbose) {
        cli_message("%" G_GUINT64_FORMAT " steps, %" G_GUINT64_FORMAT " modules, %.3f s",
                    fr_lderivation_step(lsystem.derivation),
                    fr_lstring_count(fr_lderivation_string(lsystem.derivation)),
                    cli_now() - session->began);
    }
    cli_lsystem_close(&lsystem);
    return status;
}
