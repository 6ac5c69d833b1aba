// Which format writes which extension.
#include "frond/io.h"

#include "io/formats.h"

#include <string.h>

typedef FrStatus (*FrFormatWrite)(const FrScene *scene, const char *path,
                                  const FrIoOptions *options, const FrContext *context,
                                  FrIoStats *stats);

/// What a format makes use of.
enum {
    SURFACE = 1 << 0,   ///< the skin
    INSTANCES = 1 << 1, ///< leaves that share a mesh
};

// A longer extension stands before the one that it ends in.
#define FORMATS(X)                                                                                 \
    X(".3mf", fr_three_mf_write, SURFACE)                                                          \
    X(".glb", fr_glb_write, SURFACE | INSTANCES)                                                   \
    X(".gltf", fr_gltf_write, SURFACE | INSTANCES)                                                 \
    X(".igs", fr_iges_write, SURFACE)                                                              \
    X(".iges", fr_iges_write, SURFACE)                                                             \
    X(".mtg", fr_mtg_write, 0)                                                                     \
    X(".nurbs.obj", fr_free_form_write, SURFACE)                                                   \
    X(".obj", fr_obj_write, SURFACE)                                                               \
    X(".opf", fr_opf_write, 0)                                                                     \
    X(".ply", fr_ply_write, SURFACE)                                                               \
    X(".step", fr_step_write, SURFACE)                                                             \
    X(".stl", fr_stl_write, SURFACE)                                                               \
    X(".stp", fr_step_write, SURFACE)                                                              \
    X(".txt", fr_lines_write, 0)                                                                   \
    X(".usda", fr_usd_write, SURFACE | INSTANCES)

#define EXTENSION(extension, write, uses) extension,
#define WRITER(extension, write, uses) write,
#define USES(extension, write, uses) uses,
static const char *const extensions[] = {FORMATS(EXTENSION) NULL};
static const FrFormatWrite writers[] = {FORMATS(WRITER)};
static const int formats_use[] = {FORMATS(USES)};

FrIoOptions fr_io_options_default(void) {
    return (FrIoOptions){
        .leaves = FR_LEAVES_MERGED, .skin = fr_skin_default(), .nurbs = fr_nurbs_default()};
}

const char *const *fr_io_extensions(void) {
    return extensions;
}

/// The row of the format of a path, −1.
static int format_of(const char *path) {
    size_t length = strlen(path);
    for (int i = 0; extensions[i] != NULL; i++) {
        size_t tail = strlen(extensions[i]);
        if (length >= tail && g_ascii_strcasecmp(path + length - tail, extensions[i]) == 0) {
            return i;
        }
    }
    return -1;
}

bool fr_io_can_write(const char *path) {
    return format_of(path) >= 0;
}

static bool uses(const char *path, int what) {
    int format = format_of(path);
    return format >= 0 && (formats_use[format] & what) != 0;
}

bool fr_io_has_surface(const char *path) {
    return uses(path, SURFACE);
}

bool fr_io_has_instances(const char *path) {
    return uses(path, INSTANCES);
}

FrStatus fr_io_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                     const FrContext *context, FrIoStats *stats) {
    FrIoStats own = {0};
    int format = format_of(path);
    FrStatus status;
    if (format < 0) {
        char *known = g_strjoinv(" ", (char **)extensions);
        fr_diags_add(context->diags, FR_ERROR, "unknown-format", (FrSpan){0},
                     "'%s' has none of the extensions that can be written: %s", path, known);
        g_free(known);
        status = FR_ERR_USAGE;
    } else {
        status = writers[format](scene, path, options, context, &own);
    }
    if (stats != NULL) {
        *stats = own;
    }
    return status;
}
