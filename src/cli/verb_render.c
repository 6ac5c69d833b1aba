/// frond render: a picture of a document.
#include "cli/cli.h"

#include <string.h>

static bool check_output(const CliOptions *options) {
    if (options->outputs->len != 1) {
        cli_message("render needs one picture to write: -o NAME.png");
        return false;
    }
    const char *path = g_ptr_array_index(options->outputs, 0);
    size_t length = strlen(path);
    if (length < 4 || g_ascii_strcasecmp(path + length - 4, ".png") != 0) {
        cli_message("'%s': pictures are written as .png", path);
        return false;
    }
    return true;
}

static bool check_camera(const CliOptions *options, const FrScene *scene) {
    if (options->camera == NULL) {
        return true;
    }
    const char **names = g_new(const char *, scene->views->len + 1);
    guint count = 0;
    bool is_known = false;
    for (guint i = 0; i < scene->views->len; i++) {
        const FrViewParams *view = g_ptr_array_index(scene->views, i);
        if (view->name != NULL) {
            names[count++] = view->name;
            is_known |= strcmp(view->name, options->camera) == 0;
        }
    }
    if (!is_known) {
        char *hint = cli_hint(options->camera, names, count);
        GString *listed = g_string_new(NULL);
        for (guint i = 0; i < count; i++) {
            g_string_append_printf(listed, "%s%s", i == 0 ? "; there are " : ", ", names[i]);
        }
        cli_message("there is no view '%s' in the document%s", options->camera,
                    *hint != '\0' ? hint : listed->str);
        g_string_free(listed, TRUE);
        g_free(hint);
    }
    g_free(names);
    return is_known;
}

static FrStatus render_and_save(CliSession *session, const FrScene *scene) {
    const CliOptions *options = session->options;
    FrRenderParams params;
    fr_params_init(fr_render_table(), &params);
    params.width = options->width > 0 ? options->width : params.width;
    params.height = options->height > 0 ? options->height : params.height;
    params.samples = options->samples > 0 ? options->samples : params.samples;
    if (options->camera != NULL) {
        g_free(params.view);
        params.view = g_strdup(options->camera);
    }
    FrSkinParams skin = fr_skin_default();
    skin.lod = options->lod;
    double began = cli_now();
    FrImage *image = NULL;
    FrStatus status = fr_render(scene, &params, &skin, &session->context, &image);
    session->render_seconds = cli_now() - began;
    if (status == FR_OK) {
        GBytes *png = fr_image_to_png(image);
        gsize size;
        const void *data = g_bytes_get_data(png, &size);
        status = cli_session_save(session, g_ptr_array_index(options->outputs, 0), data, size);
        g_bytes_unref(png);
        fr_image_unref(image);
    }
    fr_params_clear(fr_render_table(), &params);
    return status;
}

FrStatus cli_render(CliSession *session) {
    const CliOptions *options = session->options;
    if (!check_output(options)) {
        return FR_ERR_USAGE;
    }
    const char *path = g_ptr_array_index(options->files, 0);
    FrDocument *document;
    FrScene *scene;
    FrStatus status = cli_session_build(session, path, &document, &scene);
    if (status != FR_OK) {
        return status;
    }
    status = check_camera(options, scene) ? render_and_save(session, scene) : FR_ERR_USAGE;
    if (status == FR_OK && options->stats != NULL) {
        status = cli_stats_write(session, path, scene, NULL);
    }
    if (status == FR_OK && options->is_verbose) {
        cli_message("read %.3f s, build %.3f s, render %.3f s, total %.3f s", session->read_seconds,
                    session->build_seconds, session->render_seconds, cli_now() - session->began);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    return status;
}
