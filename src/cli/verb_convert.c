/// frond convert: documents in the formats of other programs, and back. One row for each way.
#include "cli/cli.h"

#include "frond/skeleton.h"

#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>

typedef struct Conversion {
    const char *from, *to; ///< extensions
    FrStatus (*run)(CliSession *session, const char *in, const char *out);
} Conversion;

/// The file with another extension.
static char *with_extension(const char *path, const char *extension) {
    const char *dot = strrchr(path, '.');
    return g_strdup_printf("%.*s%s", (int)(dot - path), path, extension);
}

static FrStatus save_text(CliSession *session, const char *path, const char *text) {
    FrStatus status = cli_session_save(session, path, text, strlen(text));
    if (status == FR_OK && !session->options->is_quiet) {
        printf("%s\n", path);
    }
    return status;
}

// ---- L-systems --------------------------------------------------------------------------------

/// The path of a file as seen from the folder of another. Free with g_free().
static char *path_from(const char *other, const char *path) {
    char *own = g_path_get_dirname(other), *folder = g_canonicalize_filename(own, NULL);
    char *file = g_canonicalize_filename(path, NULL);
    char **up = g_strsplit(folder, "/", -1), **down = g_strsplit(file, "/", -1);
    guint same = 0;
    while (up[same] != NULL && down[same] != NULL && strcmp(up[same], down[same]) == 0) {
        same++;
    }
    GString *relative = g_string_new(NULL);
    for (guint i = same; up[i] != NULL; i++) {
        g_string_append(relative, "../");
    }
    char *rest = g_strjoinv("/", down + same);
    g_string_append(relative, rest);
    g_free(rest);
    g_strfreev(up);
    g_strfreev(down);
    g_free(own);
    g_free(folder);
    g_free(file);
    return g_string_free(relative, FALSE);
}

/// An id like a file's name.
static char *id_of(const char *path) {
    char *id = g_path_get_basename(path);
    *strrchr(id, '.') = '\0';
    for (char *at = id; *at != '\0'; at++) {
        *at = g_ascii_isalnum(*at) || *at == '-' ? *at : '_';
    }
    if (!g_ascii_isalpha(*id)) {
        char *longer = g_strconcat("_", id, NULL);
        g_free(id);
        id = longer;
    }
    return id;
}

static FrStatus document_of_lsystem(CliSession *session, const char *in, const char *out) {
    FrDocument *document;
    FrStatus status = cli_session_read(session, in, &document); // wrong ones are told here
    if (status != FR_OK) {
        return status;
    }
    char *beside = with_extension(in, ".v"), *view = NULL, *text;
    if (session->options->view != NULL || g_file_test(beside, G_FILE_TEST_IS_REGULAR)) {
        view = path_from(out, session->options->view != NULL ? session->options->view : beside);
    }
    status = fr_document_extract_lsystem(
        document, g_ptr_array_index(fr_document_plants(document), 0), &session->context, &text);
    if (status == FR_OK) {
        char *id = id_of(out), *whole = fr_document_wrap_lsystem(id, text, view);
        status = save_text(session, out, whole);
        g_free(whole);
        g_free(id);
        g_free(text);
    }
    fr_document_free(document);
    g_free(beside);
    g_free(view);
    return status;
}

/// Copies the view of an L-system beside its file.
static FrStatus save_view(CliSession *session, const FrDocument *document, const FrPlantDef *plant,
                          const char *out) {
    char *name = fr_lmodel_view_name(plant->lsystem, fr_document_folder(document));
    if (name == NULL) {
        return FR_OK;
    }
    char *to = with_extension(out, ".v");
    char *from = g_path_is_absolute(name)
                     ? g_strdup(name)
                     : g_build_filename(fr_document_folder(document), name, NULL);
    char *same = g_canonicalize_filename(from, NULL), *target = g_canonicalize_filename(to, NULL);
    FrStatus status = FR_OK;
    if (strcmp(same, target) != 0) {
        FrSource *view = fr_source_load(from, session->options->limits.document_bytes,
                                        session->context.diags, &status);
        if (view != NULL) {
            status = save_text(session, to, fr_source_text(view, NULL));
            fr_source_unref(view);
        }
    }
    g_free(same);
    g_free(target);
    g_free(from);
    g_free(to);
    g_free(name);
    return status;
}

static FrStatus lsystem_of_document(CliSession *session, const char *in, const char *out) {
    FrDocument *document;
    FrStatus status = cli_session_read(session, in, &document);
    if (status != FR_OK) {
        return status;
    }
    const FrPlantDef *plant = cli_lsystem_find(session, document);
    char *text;
    status = plant == NULL ? FR_ERR_USAGE
                           : fr_document_extract_lsystem(document, plant, &session->context, &text);
    if (status == FR_OK) {
        status = save_text(session, out, text);
        g_free(text);
    }
    if (status == FR_OK) {
        status = save_view(session, document, plant, out);
    }
    fr_document_free(document);
    return status;
}

// ---- skeletons --------------------------------------------------------------------------------

/// A document that names the file, once that has been read without errors.
static FrStatus document_of_lines(CliSession *session, const char *in, const char *out) {
    FrSkeletonParams params;
    fr_params_init(fr_skeleton_table(), &params);
    g_free(params.file);
    params.file = g_strdup(in);
    FrSkeleton *skeleton = fr_skeleton_new(&params);
    FrStatus status = fr_skeleton_load(skeleton, NULL, ".", (FrSpan){0}, &session->context);
    if (status == FR_OK) {
        char *id = id_of(out), *file = path_from(out, in);
        char *text = fr_document_wrap_skeleton(id, file);
        status = save_text(session, out, text);
        g_free(id);
        g_free(file);
        g_free(text);
    }
    fr_skeleton_free(skeleton);
    fr_params_clear(fr_skeleton_table(), &params);
    return status;
}

static FrStatus lines_of_document(CliSession *session, const char *in, const char *out) {
    FrDocument *document;
    FrScene *scene;
    FrStatus status = cli_session_build(session, in, &document, &scene);
    if (status == FR_OK) {
        FrIoOptions io = fr_io_options_default();
        status = fr_io_write(scene, out, &io, &session->context, NULL);
        fr_scene_free(scene);
        fr_document_free(document);
    }
    if (status == FR_OK && !session->options->is_quiet) {
        printf("%s\n", out);
    }
    return status;
}

// ---- which way --------------------------------------------------------------------------------

static const Conversion conversions[] = {
    {".l", ".frond", document_of_lsystem}, {".frond", ".l", lsystem_of_document},
    {".mtg", ".frond", document_of_lines}, {".txt", ".frond", document_of_lines},
    {".frond", ".mtg", lines_of_document}, {".frond", ".txt", lines_of_document},
};

static bool is_of(const char *path, const char *extension) {
    size_t length = strlen(path), own = strlen(extension);
    return length > own && g_ascii_strcasecmp(path + length - own, extension) == 0;
}

/// The file to be written must not be one that is read.
static bool is_same_file(const char *in, const char *out) {
    GStatBuf read, written;
    return g_stat(in, &read) == 0 && g_stat(out, &written) == 0 && read.st_dev == written.st_dev &&
           read.st_ino == written.st_ino;
}

FrStatus cli_convert(CliSession *session) {
    const char *in = g_ptr_array_index(session->options->files, 0);
    const char *out = g_ptr_array_index(session->options->files, 1);
    for (size_t i = 0; i < G_N_ELEMENTS(conversions); i++) {
        if (is_of(in, conversions[i].from) && is_of(out, conversions[i].to)) {
            if (is_same_file(in, out)) {
                cli_message("'%s' would be overwritten: it is read", out);
                return FR_ERR_USAGE;
            }
            return conversions[i].run(session, in, out);
        }
    }
    GString *known = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(conversions); i++) {
        g_string_append_printf(known, "%s %s to %s", i == 0 ? "" : ",", conversions[i].from,
                               conversions[i].to);
    }
    cli_message("cannot convert '%s' to '%s'; known are%s", in, out, known->str);
    g_string_free(known, TRUE);
    return FR_ERR_USAGE;
}
