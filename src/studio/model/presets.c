#include "studio/model/presets.h"

#include "frond/document.h"
#include "frond/presets.h"
#include "frond/render.h"

#include <glib/gstdio.h>
#include <string.h>

static const char ending[] = ".frond";
static const char picture[] = ".png";

enum { PICTURE_WIDTH = 240, PICTURE_HEIGHT = 300, PICTURE_SAMPLES = 8, LONGEST_NAME = 80 };

const char *studio_presets_name_refusal(const char *name) {
    if (*name == '\0') {
        return "Give it a name";
    }
    if (strlen(name) > LONGEST_NAME || !g_utf8_validate(name, -1, NULL)) {
        return "The name is too long";
    }
    for (const char *at = name; *at != '\0'; at++) {
        if (*at == '/' || g_ascii_iscntrl(*at)) {
            return "A name has no slashes";
        }
    }
    bool is_odd = *name == '.' || *name == '-' || g_ascii_isspace(*name) ||
                  g_ascii_isspace(name[strlen(name) - 1]);
    return is_odd ? "A name begins with a letter or digit" : NULL;
}

char *studio_presets_problem(const char *file) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrDocument *document;
    char *problem = NULL;
    if (fr_document_load(file, &context, &document) != FR_OK) {
        for (size_t i = 0; i < fr_diags_count(context.diags) && problem == NULL; i++) {
            const FrDiag *diag = fr_diags_get(context.diags, i);
            uint32_t line, column;
            if (diag->severity == FR_ERROR && diag->span.source != NULL) {
                fr_source_position(diag->span.source, diag->span.begin, &line, &column);
                problem = g_strdup_printf("line %u: %s", line, diag->text);
            } else if (diag->severity == FR_ERROR) {
                problem = g_strdup(diag->text);
            }
        }
    }
    fr_document_free(document);
    fr_diags_free(context.diags);
    return problem;
}

FrStatus studio_presets_save(const char *folder, const char *name, const char *text,
                             FrDiags *diags) {
    FrContext context = fr_context_default();
    context.diags = diags;
    FrSource *source = fr_source_new(name, text, strlen(text));
    FrDocument *document;
    FrStatus status = fr_document_parse(source, folder, &context, &document);
    fr_document_free(document);
    fr_source_unref(source);
    if (status == FR_OK) {
        g_mkdir_with_parents(folder, 0777);
        char *file = fr_presets_file(folder, name, ending);
        char *old = fr_presets_file(folder, name, picture);
        status = fr_contents_save(text, strlen(text), file, diags);
        if (status == FR_OK) {
            g_unlink(old); // it shows what was called so before
        }
        g_free(old);
        g_free(file);
    }
    return status;
}

static bool is_there(const char *folder, const char *name) {
    char *file = fr_presets_file(folder, name, ending);
    bool is_it = g_file_test(file, G_FILE_TEST_EXISTS);
    g_free(file);
    return is_it;
}

bool studio_presets_rename(const char *folder, const char *name, const char *to) {
    if (studio_presets_name_refusal(to) != NULL || is_there(folder, to)) {
        return false;
    }
    static const char *const endings[] = {picture, ending}; // the picture has no place of its own
    bool is_renamed = is_there(folder, name);
    for (int i = 0; is_renamed && i < 2; i++) {
        char *from = fr_presets_file(folder, name, endings[i]);
        char *into = fr_presets_file(folder, to, endings[i]);
        is_renamed = g_rename(from, into) == 0 || endings[i] == picture;
        g_free(into);
        g_free(from);
    }
    return is_renamed;
}

bool studio_presets_remove(const char *folder, const char *name) {
    char *file = fr_presets_file(folder, name, ending);
    char *drawn = fr_presets_file(folder, name, picture);
    bool is_removed = g_unlink(file) == 0;
    if (is_removed) {
        g_unlink(drawn);
    }
    g_free(drawn);
    g_free(file);
    return is_removed;
}

// ---- its picture -------------------------------------------------------------------------------

static FrStatus draw(const FrScene *scene, const FrContext *context, FrImage **image) {
    FrRenderParams params;
    fr_params_init(fr_render_table(), &params);
    params.width = PICTURE_WIDTH;
    params.height = PICTURE_HEIGHT;
    params.samples = PICTURE_SAMPLES;
    FrSkinParams skin = fr_skin_default();
    FrStatus status = fr_render(scene, &params, &skin, context, image);
    fr_params_clear(fr_render_table(), &params);
    return status;
}

FrStatus studio_presets_draw(const char *folder, const char *name, const FrContext *context) {
    char *file = fr_presets_file(folder, name, ending);
    char *drawn = fr_presets_file(folder, name, picture);
    FrDocument *document;
    FrScene *scene = NULL;
    FrImage *image = NULL;
    FrStatus status = fr_document_load(file, context, &document);
    status = status == FR_OK ? fr_scene_build(document, -1, context, &scene) : status;
    status = status == FR_OK ? draw(scene, context, &image) : status;
    if (status == FR_OK) {
        GBytes *png = fr_image_to_png(image);
        gsize size;
        const char *bytes = g_bytes_get_data(png, &size);
        bool is_written = g_file_set_contents(drawn, bytes, (gssize)size, NULL);
        status = is_written ? FR_OK : FR_ERR_MACHINE;
        g_bytes_unref(png);
        fr_image_unref(image);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    g_free(drawn);
    g_free(file);
    return status;
}
