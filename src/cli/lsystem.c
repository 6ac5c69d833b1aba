/// L-systems as input. A .l file is read as a document of one plant, with the .v view beside it or
/// the one that --view names; so is a file of another name that looks like an L-system.
#include "cli/cli.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Whether a file begins with no tag and has a production or a keyword soon after.
static bool looks_like_one(const char *path) {
    char text[4096];
    FILE *file = g_file_test(path, G_FILE_TEST_IS_REGULAR) ? fopen(path, "rb") : NULL;
    if (file == NULL) {
        return false;
    }
    size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[size] = '\0';
    size_t begin = strspn(text, " \t\r\n\xEF\xBB\xBF");
    static const char *const marks[] = {"->", "\xe2\x86\x92", "Lsystem", "lsystem", "axiom"};
    bool is_marked = false;
    for (size_t i = 0; i < G_N_ELEMENTS(marks); i++) {
        is_marked |= strstr(text + begin, marks[i]) != NULL;
    }
    return is_marked && text[begin] != '<';
}

bool cli_is_lsystem(const char *path) {
    if (g_str_has_suffix(path, ".l") || g_str_has_suffix(path, ".L")) {
        return true;
    }
    return !g_str_has_suffix(path, ".frond") && !g_str_has_suffix(path, ".xml") &&
           !cli_is_model(path) && looks_like_one(path);
}

static void print_text(void *user, const char *text) {
    (void)user;
    fputs(text, stderr);
}

/// Whether --set names a number of the L-system itself and not an attribute of the document.
static bool is_define(const char *set) {
    return memchr(set, '.', strcspn(set, "=")) == NULL;
}

/// The document that a .l file stands for.
static char *document_text(const CliSession *session, const char *path) {
    char *file = g_path_get_basename(path);
    GString *text = g_string_new(NULL);
    char *part = g_markup_printf_escaped(
        "<frond version=\"1\"><plant id=\"plant\"><lsystem file=\"%s\">", file);
    g_string_append(text, part);
    g_free(part);
    for (guint i = 0; i < session->options->sets->len; i++) {
        const char *set = g_ptr_array_index(session->options->sets, i);
        if (is_define(set)) {
            char *name = g_strndup(set, strcspn(set, "="));
            part = g_markup_printf_escaped("<define id=\"%s\" value=\"%s\"/>", name,
                                           strchr(set, '=') + 1);
            g_string_append(text, part);
            g_free(part);
            g_free(name);
        }
    }
    g_string_append(text, "</lsystem></plant></frond>");
    g_free(file);
    return g_string_free(text, FALSE);
}

FrStatus cli_lsystem_read(CliSession *session, const char *path, FrDocument **document) {
    *document = NULL;
    if (!isnan(session->options->time)) {
        cli_message("--time is for components, which have clocks; L-systems have --steps");
        return FR_ERR_USAGE;
    }
    FrStatus status;
    FrSource *file = fr_source_load(path, session->options->limits.document_bytes,
                                    session->context.diags, &status);
    if (file == NULL) {
        return status;
    }
    fr_source_unref(file);
    char *text = document_text(session, path), *folder = g_path_get_dirname(path);
    FrSource *source = fr_source_new(path, text, strlen(text));
    status = fr_document_parse(source, folder, &session->context, document);
    fr_source_unref(session->unwritten);
    session->unwritten = source;
    g_free(folder);
    g_free(text);
    return status;
}

bool cli_lsystem_takes(const char *path, const char *set) {
    return cli_is_lsystem(path) && is_define(set);
}

/// Sets an attribute of every L-system of a document.
static FrStatus set_all(CliSession *session, FrDocument *document, const char *attribute,
                        const char *value) {
    FrStatus status = FR_OK;
    bool is_any = false;
    for (guint i = 0; i < fr_document_plants(document)->len && status == FR_OK; i++) {
        const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(document), i);
        if (plant->kind == FR_PLANT_LSYSTEM) {
            char *target = g_strdup_printf("%s.lsystem.%s", plant->id, attribute);
            status = fr_document_set(document, target, value, &session->context);
            g_free(target);
            is_any = true;
        }
    }
    if (!is_any) {
        cli_message("--%s is for L-systems, and there is none in the document", attribute);
        return FR_ERR_USAGE;
    }
    return status;
}

/// Lets the L-systems of a document print on standard error.
static void let_print(const FrDocument *document) {
    for (guint i = 0; i < fr_document_plants(document)->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(document), i);
        if (plant->kind == FR_PLANT_LSYSTEM) {
            fr_lmodel_set_print(plant->lsystem, print_text, NULL);
        }
    }
}

FrStatus cli_lsystem_set_steps(CliSession *session, FrDocument *document, int64_t steps) {
    char *text = g_strdup_printf("%" G_GINT64_FORMAT, steps);
    FrStatus status = set_all(session, document, "steps", text);
    g_free(text);
    let_print(document);
    return status;
}

static bool has_lsystem(const FrDocument *document) {
    const GPtrArray *plants = fr_document_plants(document);
    bool has = false;
    for (guint i = 0; i < plants->len; i++) {
        has |= ((const FrPlantDef *)g_ptr_array_index(plants, i))->kind == FR_PLANT_LSYSTEM;
    }
    return has;
}

FrStatus cli_lsystem_apply(CliSession *session, FrDocument *document) {
    const CliOptions *options = session->options;
    FrStatus status = FR_OK;
    if (options->view != NULL && !g_file_test(options->view, G_FILE_TEST_IS_REGULAR)) {
        fr_diags_add(session->context.diags, FR_ERROR, "missing-file", (FrSpan){0},
                     "the file '%s' of --view is not there", options->view);
        status = FR_ERR_DOCUMENT;
    } else if (options->view != NULL) {
        char *path = g_canonicalize_filename(options->view, NULL);
        status = set_all(session, document, "view", path);
        g_free(path);
    }
    // Beside plants that grow bud by bud L-systems are as long as they say: they only stop earlier,
    // so that a growth can be resumed with more steps.
    bool is_for_them = !cli_growth_takes_steps(document) ||
                       (session->verb->id == CLI_DERIVE && has_lsystem(document));
    if (options->steps >= 0 && status == FR_OK && is_for_them) {
        status = cli_lsystem_set_steps(session, document, options->steps);
    }
    if (status == FR_OK) {
        let_print(document);
    }
    return status;
}

void cli_lsystem_name(const char *path, FrScene *scene) {
    for (guint i = 0; i < scene->plants->len; i++) {
        FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        g_free(plant->name);
        plant->name = g_path_get_basename(path);
        char *dot = strrchr(plant->name, '.');
        if (dot != NULL && dot > plant->name) {
            *dot = '\0';
        }
    }
}

const FrPlantDef *cli_lsystem_find(const CliSession *session, const FrDocument *document) {
    const char *wanted = session->options->plant;
    const GPtrArray *plants = fr_document_plants(document);
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (plant->kind == FR_PLANT_LSYSTEM && (wanted == NULL || strcmp(plant->id, wanted) == 0)) {
            return plant;
        }
    }
    cli_message("there is no L-system %s%s%sin the document", wanted == NULL ? "" : "'",
                wanted == NULL ? "" : wanted, wanted == NULL ? "" : "' ");
    return NULL;
}
