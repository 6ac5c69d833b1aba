/// frond render: a picture of a document.
#include "cli/cli.h"

#include <math.h>
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

static FrStatus render(CliSession *session, const FrScene *scene, const FrRenderParams *params,
                       FrImage **image) {
    const CliOptions *options = session->options;
    const FrContext *context = &session->context;
    FrSkinParams skin = fr_skin_default();
    skin.lod = options->lod;
    if (!options->has_light) {
        return fr_render(scene, params, &skin, context, image);
    }
    return options->light_axis >= 0
               ? fr_render_light(scene, options->light_axis, options->light_at, params, context,
                                 image)
               : fr_render_light_points(scene, options->light_where, (uint32_t)options->light_count,
                                        params, &skin, context, image);
}

static FrStatus render_and_save(CliSession *session, FrScene *scene, const char *path) {
    const CliOptions *options = session->options;
    FrNurbsParams plain = fr_nurbs_default();
    cli_nurbs_apply(options, scene, &plain);
    FrRenderParams params;
    fr_params_init(fr_render_table(), &params);
    params.width = options->width > 0 ? options->width : params.width;
    params.height = options->height > 0 ? options->height : params.height;
    params.samples = options->samples > 0 ? options->samples : params.samples;
    if (options->camera != NULL) {
        g_free(params.view);
        params.view = g_strdup(options->camera);
    }
    double began = cli_now();
    FrImage *image = NULL;
    FrStatus status = render(session, scene, &params, &image);
    session->render_seconds += cli_now() - began;
    if (status == FR_OK) {
        GBytes *png = fr_image_to_png(image);
        gsize size;
        const void *data = g_bytes_get_data(png, &size);
        status = cli_session_save(session, path, data, size);
        g_bytes_unref(png);
        fr_image_unref(image);
    }
    fr_params_clear(fr_render_table(), &params);
    return status;
}

// ---- sequences --------------------------------------------------------------------------------

/// grow.png, 7 → grow-0007.png. Free with g_free().
static char *frame_path(const char *path, int64_t frame) {
    size_t stem = strlen(path) - strlen(".png");
    return g_strdup_printf("%.*s-%04" G_GINT64_FORMAT "%s", (int)stem, path, frame, path + stem);
}

static bool is_told(const FrDiags *diags, const FrDiag *diag) {
    for (size_t i = 0; i < fr_diags_count(diags); i++) {
        const FrDiag *told = fr_diags_get(diags, i);
        if (told->severity == diag->severity && strcmp(told->code, diag->code) == 0 &&
            told->span.source == diag->span.source && told->span.begin == diag->span.begin &&
            strcmp(told->text, diag->text) == 0) {
            return true;
        }
    }
    return false;
}

/// Ends what `session->context.diags` began apart from `all`: adds to these what is new. The same
/// holds for many frames of a sequence, and is told once.
static void tell_once(CliSession *session, FrDiags *all) {
    FrDiags *apart = session->context.diags;
    for (size_t i = 0; i < fr_diags_count(apart); i++) {
        const FrDiag *diag = fr_diags_get(apart, i);
        if (!is_told(all, diag)) {
            fr_diags_add(all, diag->severity, diag->code, diag->span, "%s", diag->text);
        }
    }
    fr_diags_free(apart);
    session->context.diags = all;
}

/// Frames of one document.
typedef struct Frames {
    FrDocument *document;
    CliGrowth *growth; ///< NULL: each is a step of an L-system
} Frames;

/// A frame of a document is a time, that of an L-system a step of its derivation.
static FrStatus build_frame(CliSession *session, const Frames *frames, int64_t frame,
                            FrScene **scene) {
    double began = cli_now();
    double start = isnan(session->options->time) ? 0 : session->options->time;
    double time = start + (double)frame * fr_document_scene(frames->document)->frame_time;
    FrDiags *all = session->context.diags;
    session->context.diags = fr_diags_new();
    FrStatus status;
    if (frames->growth != NULL) {
        status = cli_growth_scene(frames->growth, time, scene);
    } else {
        status = cli_lsystem_set_steps(session, frames->document, frame);
        if (status == FR_OK) {
            status = cli_session_grow(session, frames->document, NAN, scene);
        }
    }
    tell_once(session, all);
    session->build_seconds += cli_now() - began;
    return status;
}

/// All pictures show what the first and the last hold, so that a plant is seen to grow.
static FrStatus frame_all(CliSession *session, const Frames *frames, double min[3], double max[3]) {
    const CliOptions *options = session->options;
    const int64_t ends[2] = {options->first_frame, options->last_frame};
    for (int k = 0; k < 2; k++) {
        FrScene *scene;
        FrStatus status = build_frame(session, frames, ends[k], &scene);
        if (status != FR_OK) {
            return status;
        }
        double low[3], high[3];
        fr_scene_bounds(scene, low, high);
        fr_scene_free(scene);
        for (int r = 0; r < 3; r++) {
            bool is_first = k == 0 || !(min[r] <= max[r]);
            min[r] = is_first ? low[r] : fmin(min[r], low[r]);
            max[r] = is_first ? high[r] : fmax(max[r], high[r]);
        }
    }
    return FR_OK;
}

static FrStatus render_frames(CliSession *session, const Frames *frames) {
    const CliOptions *options = session->options;
    double min[3], max[3];
    FrStatus status = frame_all(session, frames, min, max);
    for (int64_t frame = options->first_frame; frame <= options->last_frame && status == FR_OK;
         frame++) {
        FrScene *scene;
        status = build_frame(session, frames, frame, &scene);
        if (status != FR_OK) {
            break;
        }
        scene->is_framed = min[0] <= max[0];
        memcpy(scene->frame_min, min, sizeof min);
        memcpy(scene->frame_max, max, sizeof max);
        char *path = frame_path(g_ptr_array_index(options->outputs, 0), frame);
        status =
            check_camera(options, scene) ? render_and_save(session, scene, path) : FR_ERR_USAGE;
        if (status == FR_OK && frame == options->last_frame && options->stats != NULL) {
            status = cli_stats_write(session, g_ptr_array_index(options->files, 0), scene, NULL);
        }
        g_free(path);
        fr_scene_free(scene);
    }
    return status;
}

static FrStatus render_sequence(CliSession *session) {
    const char *path = g_ptr_array_index(session->options->files, 0);
    Frames frames = {0};
    FrStatus status = cli_session_read(session, path, &frames.document);
    if (status == FR_OK && !cli_is_lsystem(path)) {
        status = cli_growth_open(session, frames.document, &frames.growth);
    }
    if (status == FR_OK) {
        status = render_frames(session, &frames);
    }
    cli_growth_close(frames.growth);
    fr_document_free(frames.document);
    return status;
}

static FrStatus render_still(CliSession *session) {
    const CliOptions *options = session->options;
    const char *path = g_ptr_array_index(options->files, 0);
    FrDocument *document;
    FrScene *scene;
    FrStatus status = cli_session_build(session, path, &document, &scene);
    if (status != FR_OK) {
        return status;
    }
    status = check_camera(options, scene)
                 ? render_and_save(session, scene, g_ptr_array_index(options->outputs, 0))
                 : FR_ERR_USAGE;
    if (status == FR_OK && options->stats != NULL) {
        status = cli_stats_write(session, path, scene, NULL);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    return status;
}

FrStatus cli_render(CliSession *session) {
    const CliOptions *options = session->options;
    if (!check_output(options)) {
        return FR_ERR_USAGE;
    }
    FrStatus status = options->has_frames ? render_sequence(session) : render_still(session);
    if (status == FR_OK && options->is_verbose) {
        cli_message("read %.3f s, build %.3f s, render %.3f s, total %.3f s", session->read_seconds,
                    session->build_seconds, session->render_seconds, cli_now() - session->began);
    }
    return status;
}
