#include "studio/model/profile.h"

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

StudioExported studio_export(StudioCopy *copy, const char *path, const StudioExport *how,
                             const FrContext *context) {
    StudioExported exported = {0};
    FrScene *scene;
    exported.status = studio_copy_take(copy, context, &scene, &exported.is_behind);
    if (exported.status == FR_OK) {
        FrIoOptions options = fr_io_options_default();
        options.leaves = how->leaves;
        options.skin.lod = how->lod;
        exported.status = fr_io_write(scene, path, &options, context, &exported.stats);
    }
    fr_scene_free(scene);
    return exported;
}
