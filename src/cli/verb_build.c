/// frond build: a document grown and written as models.
#include "cli/cli.h"

#include <stdio.h>
#include <string.h>

static bool check_outputs(const CliOptions *options) {
    for (guint i = 0; i < options->outputs->len; i++) {
        const char *path = g_ptr_array_index(options->outputs, i);
        if (!fr_io_can_write(path)) {
            char *known = g_strjoinv(" ", (char **)fr_io_extensions());
            cli_message("'%s': no format of that extension; there are %s", path, known);
            g_free(known);
            return false;
        }
    }
    return true;
}

static bool has_output(const CliOptions *options, bool (*is_one)(const char *path)) {
    for (guint i = 0; i < options->outputs->len; i++) {
        if (is_one(g_ptr_array_index(options->outputs, i))) {
            return true;
        }
    }
    return false;
}

/// Says which options nothing that is written reads.
static void check_effects(const CliOptions *options) {
    if (options->leaves != FR_LEAVES_MERGED && !has_output(options, fr_io_has_instances)) {
        cli_message("--leaves has no effect: it is for .glb, .gltf and .usda");
    }
    if (options->nurbs->len > 0 && options->outputs->len > 0 &&
        !has_output(options, fr_io_has_surface)) {
        cli_message("--nurbs has no effect: graphs have no surface");
    }
    if (options->lod > 0 && options->outputs->len == 0) {
        cli_message("--lod has no effect: nothing is written; -o names a file");
    }
}

static void say_written(const CliSession *session, const char *path, const FrIoStats *stats) {
    const char *sink = session->options->stats;
    if (session->options->is_quiet || (sink != NULL && strcmp(sink, "-") == 0)) {
        return;
    }
    char *count = cli_count_text(MAX(MAX(stats->surfaces, stats->entities), stats->triangles));
    char *size = g_format_size(stats->bytes);
    const char *what = stats->surfaces > 0   ? "surfaces"
                       : stats->entities > 0 ? "entities"
                                             : "triangles";
    printf("%s: %s %s, %s\n", path, count, what, size);
    g_free(count);
    g_free(size);
}

/// Writes every output; `total` receives the counts of the first and the seconds of all.
static FrStatus write_outputs(CliSession *session, FrScene *scene, FrIoStats *total) {
    FrIoOptions io = fr_io_options_default();
    io.leaves = session->options->leaves;
    io.skin.lod = session->options->lod;
    cli_nurbs_apply(session->options, scene, &io.nurbs);
    const GPtrArray *outputs = session->options->outputs;
    for (guint i = 0; i < outputs->len; i++) {
        const char *path = g_ptr_array_index(outputs, i);
        FrIoStats stats = {0};
        FrStatus status = fr_io_write(scene, path, &io, &session->context, &stats);
        if (status != FR_OK) {
            return status;
        }
        say_written(session, path, &stats);
        if (i == 0) {
            *total = stats;
        } else {
            total->bytes += stats.bytes;
            total->skin_seconds += stats.skin_seconds;
            total->write_seconds += stats.write_seconds;
        }
    }
    return FR_OK;
}

FrStatus cli_build(CliSession *session) {
    const CliOptions *options = session->options;
    if (!check_outputs(options)) {
        return FR_ERR_USAGE;
    }
    check_effects(options);
    const char *path = g_ptr_array_index(options->files, 0);
    FrDocument *document;
    FrScene *scene;
    FrStatus status = cli_session_build(session, path, &document, &scene);
    if (status != FR_OK) {
        return status;
    }
    FrIoStats stats = {0};
    status = write_outputs(session, scene, &stats);
    if (status == FR_OK && options->stats != NULL) {
        status = cli_stats_write(session, path, scene, options->outputs->len > 0 ? &stats : NULL);
    }
    if (status == FR_OK && options->is_verbose) {
        cli_message("read %.3f s, build %.3f s, skin %.3f s, write %.3f s, total %.3f s",
                    session->read_seconds, session->build_seconds, stats.skin_seconds,
                    stats.write_seconds, cli_now() - session->began);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    return status;
}
