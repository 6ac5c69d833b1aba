/// frond: plants from documents, on the command line.
#include "cli/cli.h"

#include <locale.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

static const CliVerb verbs[] = {
    {CLI_BUILD, "build", "DOC [-o OUT]...", "grow what a document says and write it as a model",
     cli_build, 1, 1},
    {CLI_RENDER, "render", "DOC -o OUT.png", "make a picture of it", cli_render, 1, 1},
    {CLI_CHECK, "check", "DOC...", "say what is wrong; nothing if nothing is", cli_check, 1,
     G_MAXUINT},
    {CLI_INFO, "info", "DOC|MODEL", "say what is in a document, a .glb or a .gltf", cli_info, 1, 1},
    {CLI_PRESETS, "presets", "", "list the species that come with the program", cli_presets, 0, 0},
    {CLI_NEW, "new", "NAME [--preset SPECIES]", "begin a document NAME.frond from a preset",
     cli_new, 1, 1},
    {CLI_DERIVE, "derive", "FILE", "derive an L-system and print its string", cli_derive, 1, 1},
    {CLI_VARY, "vary", "DOC -o FOLDER", "make a collection of instances of a plant", cli_vary, 1,
     1},
    {CLI_CONVERT, "convert", "IN OUT", "write a document in another program's format, or back",
     cli_convert, 2, 2},
    {CLI_SCHEMA, "schema", "", "print the XML Schema of documents", cli_schema, 0, 0},
    {CLI_REFERENCE, "reference", "", "print the reference of elements and attributes",
     cli_reference, 0, 0},
};

static void print_verbs(FILE *out) {
    for (size_t i = 0; i < G_N_ELEMENTS(verbs); i++) {
        fprintf(out, "  %-10s %s\n", verbs[i].name, verbs[i].meaning);
    }
}

static void print_usage(FILE *out) {
    fprintf(out, "usage: frond VERB FILE... [options]\n\n");
    print_verbs(out);
    fprintf(out, "\nfrond VERB -h says more. Manual: man frond\n");
}

static void print_help(const CliVerb *verb) {
    printf("usage: frond %s%s%s [options]\n\n%s\n\n", verb->name,
           *verb->synopsis == '\0' ? "" : " ", verb->synopsis, verb->meaning);
    cli_options_print(verb->id, stdout);
    if (verb->id == CLI_BUILD) {
        printf("\nformats:");
        for (const char *const *extension = fr_io_extensions(); *extension != NULL; extension++) {
            printf(" %s", *extension);
        }
        printf("\n");
    }
}

static const CliVerb *find_verb(const char *name) {
    for (size_t i = 0; i < G_N_ELEMENTS(verbs); i++) {
        if (strcmp(verbs[i].name, name) == 0) {
            return &verbs[i];
        }
    }
    return NULL;
}

static void report_unknown_verb(const char *name) {
    const char *names[G_N_ELEMENTS(verbs)];
    for (size_t i = 0; i < G_N_ELEMENTS(verbs); i++) {
        names[i] = verbs[i].name;
    }
    char *hint = cli_hint(name, names, G_N_ELEMENTS(names));
    cli_message("there is no verb '%s'%s%s", name, hint,
                *hint == '\0' ? "; the verbs are" : " The verbs are");
    g_free(hint);
    print_verbs(stderr);
}

static bool check_files(const CliVerb *verb, const CliOptions *options) {
    guint count = options->files->len;
    if (count >= verb->least_files && count <= verb->most_files) {
        bool are_spared = true;
        for (guint i = 0; i < count && are_spared; i++) {
            are_spared = cli_check_spared(options, g_ptr_array_index(options->files, i));
        }
        return are_spared;
    }
    if (count < verb->least_files) {
        cli_message("'%s' needs %s: frond %s %s", verb->name,
                    verb->least_files == 1 ? "a file" : "two files", verb->name, verb->synopsis);
    } else {
        cli_message("'%s' is too much: frond %s %s",
                    (const char *)g_ptr_array_index(options->files, verb->most_files), verb->name,
                    verb->synopsis);
    }
    return false;
}

static FrStatus run_verb(const CliVerb *verb, const CliOptions *options) {
    CliSession session;
    cli_session_open(&session, verb, options);
    FrStatus status = verb->run(&session);
    cli_session_close(&session);
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        cli_message("cannot write to standard output");
        return FR_ERR_MACHINE;
    }
    if (status == FR_CANCELLED) {
        cli_message("stopped");
    }
    return status;
}

/// Verb, options and what they ask for. `arguments` begins behind the program's name.
static FrStatus run(int count, char **arguments, CliOptions *options) {
    if (count == 0) {
        print_usage(stderr);
        return FR_ERR_USAGE;
    }
    const CliVerb *verb = NULL;
    if (arguments[0][0] != '-') {
        options->wants_help = strcmp(arguments[0], "help") == 0;
        bool asks_for_verb = options->wants_help && count > 1 && arguments[1][0] != '-';
        if (!options->wants_help || asks_for_verb) {
            const char *name = arguments[asks_for_verb];
            verb = find_verb(name);
            if (verb == NULL) {
                report_unknown_verb(name);
                return FR_ERR_USAGE;
            }
        }
        arguments += 1 + asks_for_verb;
        count -= 1 + asks_for_verb;
    }
    if (!cli_options_parse(options, verb, count, arguments)) {
        return FR_ERR_USAGE;
    }
    if (options->wants_version) {
        printf("frond %s\n", FR_VERSION);
        return FR_OK;
    }
    if (verb == NULL) {
        print_usage(options->wants_help ? stdout : stderr);
        return options->wants_help ? FR_OK : FR_ERR_USAGE;
    }
    if (options->wants_help) {
        print_help(verb);
        return FR_OK;
    }
    return check_files(verb, options) ? run_verb(verb, options) : FR_ERR_USAGE;
}

int main(int count, char **arguments) {
    setlocale(LC_CTYPE, "");
    CliOptions options = cli_options_new();
    FrStatus status = run(count - 1, arguments + 1, &options);
    cli_options_clear(&options);
    if (status == FR_CANCELLED && cli_session_signal() != 0) {
        // Whoever started the program sees that a signal ended it.
        signal(cli_session_signal(), SIG_DFL);
        raise(cli_session_signal());
    }
    return (int)status;
}
