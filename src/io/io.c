// Which format writes which extension.
#include "frond/io.h"

#include "io/formats.h"

#include <string.h>

typedef FrStatus (*FrFormatWrite)(const FrScene *scene, const char *path,
                                  const FrIoOptions *options, const FrContext *context,
                                  FrIoStats *stats);

// A longer extension stands before the one that it ends in.
#define FORMATS(X)                                                                                 \
    X(".3mf", fr_three_mf_write)                                                                   \
    X(".glb", fr_glb_write)                                                                        \
    X(".gltf", fr_gltf_write)                                                                      \
    X(".igs", fr_iges_write)                                                                       \
    X(".iges", fr_iges_write)                                                                      \
    X(".mtg", fr_mtg_write)                                                                        \
    X(".nurbs.obj", fr_free_form_write)                                                            \
    X(".obj", fr_obj_write)                                                                        \
    X(".opf", fr_opf_write)                                                                        \
    X(".ply", fr_ply_write)                                                                        \
    X(".step", fr_step_write)                                                                      \
    X(".stl", fr_stl_write)                                                                        \
    X(".stp", fr_step_write)                                                                       \
    X(".txt", fr_lines_write)                                                                      \
    X(".usda", fr_usd_write)

#define EXTENSION(extension, write) extension,
#define WRITER(extension, write) write,
static const char *const extensions[] = {FORMATS(EXTENSION) NULL};
static const FrFormatWrite writers[] = {FORMATS(WRITER)};

FrIoOptions fr_io_options_default(void) {
    return (FrIoOptions){
        .leaves = FR_LEAVES_MERGED, .skin = fr_skin_default(), .nurbs = fr_nurbs_default()};
}

const char *const *fr_io_extensions(void) {
    return extensions;
}

static FrFormatWrite writer_of(const char *path) {
    size_t length = strlen(path);
    for (size_t i = 0; extensions[i] != NULL; i++) {
        size_t tail = strlen(extensions[i]);
        if (length >= tail && g_ascii_strcasecmp(path + length - tail, extensions[i]) == 0) {
            return writers[i];
        }
    }
    return NULL;
}

bool fr_io_can_write(const char *path) {
    return writer_of(path) != NULL;
}

FrStatus fr_io_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                     const FrContext *context, FrIoStats *stats) {
    FrIoStats own = {0};
    FrFormatWrite write = writer_of(path);
    FrStatus status;
    if (write == NULL) {
        char *known = g_strjoinv(" ", (char **)extensions);
        fr_diags_add(context->diags, FR_ERROR, "unknown-format", (FrSpan){0},
                     "'%s' has none of the extensions that can be written: %s", path, known);
        g_free(known);
        status = FR_ERR_USAGE;
    } else {
        status = write(scene, path, options, context, &own);
    }
    if (stats != NULL) {
        *stats = own;
    }
    return status;
}
