// Which format writes which extension.
#include "frond/io.h"

#include "io/formats.h"

#include <string.h>

typedef FrStatus (*FrFormatWrite)(const FrScene *scene, const char *path,
                                  const FrIoOptions *options, const FrContext *context,
                                  FrIoStats *stats);

static const char *const extensions[] = {".glb", ".gltf", ".obj", ".ply", ".stl", NULL};
static const FrFormatWrite writers[] = {fr_glb_write, fr_gltf_write, fr_obj_write, fr_ply_write,
                                        fr_stl_write};

FrIoOptions fr_io_options_default(void) {
    return (FrIoOptions){.leaves = FR_LEAVES_MERGED, .skin = fr_skin_default()};
}

const char *const *fr_io_extensions(void) {
    return extensions;
}

static FrFormatWrite writer_of(const char *path) {
    char *name = g_path_get_basename(path);
    const char *dot = strrchr(name, '.');
    FrFormatWrite writer = NULL;
    for (size_t i = 0; dot != NULL && extensions[i] != NULL; i++) {
        if (g_ascii_strcasecmp(dot, extensions[i]) == 0) {
            writer = writers[i];
        }
    }
    g_free(name);
    return writer;
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
