#include "studio/model/profile.h"

#include "frond/only.h"
#include "frond/simulation.h"

static const StudioProfile profiles[] = {
    {"Blender", "One .glb with everything in it; leaves as one mesh", ".glb", FR_LEAVES_MERGED, 0},
    {"Unreal Engine", "Leaves merged, one level coarser, for Nanite or as a static mesh", ".glb",
     FR_LEAVES_MERGED, 1},
    {"Godot", "Leaves merged: Godot makes its own levels of detail", ".glb", FR_LEAVES_MERGED, 1},
    {"three.js and the web", "Leaves instanced on the graphics card: a small file", ".glb",
     FR_LEAVES_GPU, 1},
    {"Other programs", "Wavefront OBJ with materials beside it", ".obj", FR_LEAVES_MERGED, 0},
    {"3D printing", "Triangles alone, in metres", ".stl", FR_LEAVES_MERGED, 0},
    {"CAD", "Rational surfaces instead of triangles; large files", ".stp", FR_LEAVES_MERGED, 0},
};

const StudioProfile *studio_profiles(size_t *count) {
    *count = sizeof profiles / sizeof *profiles;
    return profiles;
}

// Leaves nothing of the scene but the one plant.
static FrStatus keep_one(FrScene *scene, const StudioExport *how, const FrContext *context) {
    FrOnly *only = fr_only_one(how->origin, how->number);
    bool is_there = fr_only_apply(only, scene, how->in_place);
    fr_only_free(only);
    if (!is_there) {
        fr_diags_add(context->diags, FR_ERROR, "unknown-stand", (FrSpan){0},
                     "the plant does not stand in the scene any more");
    }
    return is_there ? FR_OK : FR_ERR_DOCUMENT;
}

StudioExported studio_export(FrSource *source, const char *folder, const char *path,
                             const StudioExport *how, const FrContext *context) {
    StudioExported exported = {0};
    FrDocument *document;
    FrScene *scene = NULL;
    exported.status = fr_document_parse(source, folder, context, &document);
    if (exported.status == FR_OK) {
        const FrSceneOptions as_seen = {.seed = -1, .time = how->time, .steps = how->step};
        exported.status = fr_scene_build_with(document, &as_seen, context, &scene);
    }
    if (exported.status == FR_OK && how->is_one) {
        exported.status = keep_one(scene, how, context);
    }
    if (exported.status == FR_OK) {
        FrIoOptions options = fr_io_options_default();
        options.leaves = how->leaves;
        options.skin.lod = how->lod;
        exported.status = fr_io_write(scene, path, &options, context, &exported.stats);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    return exported;
}
