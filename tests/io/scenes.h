/// @file scenes.h
/// Small scenes for tests of model files, and a folder for these.
#pragma once

#include "frond/io.h"

#include <cglm/struct.h>
#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>

static inline void scene_plant_clear(gpointer data) {
    FrScenePlant *plant = data;
    fr_plant_free(plant->plant);
    g_free(plant->by_component);
}

static inline FrScene *scene_new(void) {
    FrScene *scene = g_new0(FrScene, 1);
    scene->name = g_strdup("meadow");
    scene->plants = g_array_new(FALSE, FALSE, sizeof(FrScenePlant));
    g_array_set_clear_func(scene->plants, scene_plant_clear);
    scene->stands = g_array_new(FALSE, FALSE, sizeof(FrStand));
    scene->views = g_ptr_array_new();
    scene->seed = 42;
    return scene;
}

/// Takes the plant.
static inline uint32_t scene_add(FrScene *scene, FrPlant *plant) {
    FrScenePlant entry = {.plant = plant, .instances = 1};
    g_array_append_val(scene->plants, entry);
    return scene->plants->len - 1;
}

static inline void scene_stand(FrScene *scene, uint32_t plant, double x, double y, double turn,
                               double scale) {
    FrStand stand = {.plant = plant, .at = {x, y, 0.25}, .turn = turn, .scale = scale};
    g_array_append_val(scene->stands, stand);
}

/// A material with pictures made by the program, or of a plain colour for FR_TEXTURE_NONE.
static inline FrMaterial *material_new(const char *name, FrTextureKind texture) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.texture = (int)texture;
    params.size = 32;
    params.colour = (vec3s){{0.5f, 0.25f, 0.125f}};
    FrMaterial *material = fr_material_new(name, &params, ".", (FrSpan){0});
    fr_params_clear(fr_material_table(), &params);
    return material;
}

/// A stem of six internodes with a branch and `leaves` leaves in all directions.
static inline FrPlant *plant_with_leaves(const char *name, uint32_t leaves, FrTextureKind bark,
                                         FrTextureKind leaf) {
    FrPlant *plant = fr_plant_new(name);
    FrMaterial *materials[] = {material_new("bark", bark), material_new("green leaf", leaf)};
    fr_plant_add_material(plant, materials[0]);
    fr_plant_add_material(plant, materials[1]);
    fr_material_unref(materials[0]);
    fr_material_unref(materials[1]);
    versors bend = glms_quatv(0.2f, (vec3s){{0.6f, 0.8f, 0}});
    uint32_t stem = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.05f);
    for (int i = 0; i < 6; i++) {
        fr_plant_add_node(plant, stem, bend, 0.3f, 0.05f - 0.008f * (float)i);
    }
    uint32_t branch = fr_plant_add_axis(plant, 2, (vec3s){{0, 0, -0.1f}}, 0.02f);
    fr_plant_add_node(plant, branch, glms_quatv(1, (vec3s){{0, 1, 0}}), 0.5f, 0.002f);
    plant->axes.material[stem] = plant->axes.material[branch] = 0;
    FrShape shape = {.kind = FR_SHAPE_BLADE};
    shape.blade = (FrBlade){.length = 0.2f,
                            .width = 0.1f,
                            .outline = FR_NONE,
                            .along_curve = FR_NONE,
                            .across_curve = FR_NONE,
                            .segments_along = 3,
                            .segments_across = 1};
    fr_plant_append_organs(plant, leaves);
    for (uint32_t o = 0; o < leaves; o++) {
        plant->organs.node[o] = o % plant->nodes.count;
        plant->organs.offset[o] = (vec3s){{0.01f, 0, -0.05f}};
        plant->organs.rotation[o] = glms_quatv(0.7f + (float)o, (vec3s){{0.36f, 0.48f, 0.8f}});
        plant->organs.scale[o] = 0.5f + 0.25f * (float)(o % 4);
        plant->organs.shape[o] = fr_plant_add_shape(plant, &shape);
        plant->organs.material[o] = 1;
    }
    return plant;
}

/// A new folder; remove_folder() takes it away with what is in it.
static inline char *folder_new(void) {
    char *folder = g_dir_make_tmp("frond-io-XXXXXX", NULL);
    g_assert_nonnull(folder);
    return folder;
}

/// The names in a folder, sorted and separated by spaces.
static inline char *folder_names(const char *folder) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    GDir *dir = g_dir_open(folder, 0, NULL);
    for (const char *name = g_dir_read_name(dir); name != NULL; name = g_dir_read_name(dir)) {
        guint at = 0;
        while (at < names->len && strcmp(g_ptr_array_index(names, at), name) < 0) {
            at++;
        }
        g_ptr_array_insert(names, (gint)at, g_strdup(name));
    }
    g_dir_close(dir);
    g_ptr_array_add(names, NULL);
    char *joined = g_strjoinv(" ", (char **)names->pdata);
    g_ptr_array_unref(names);
    return joined;
}

static inline void remove_folder(char *folder) {
    GDir *dir = g_dir_open(folder, 0, NULL);
    for (const char *name = g_dir_read_name(dir); name != NULL; name = g_dir_read_name(dir)) {
        char *path = g_build_filename(folder, name, NULL);
        g_assert_cmpint(g_remove(path), ==, 0);
        g_free(path);
    }
    g_dir_close(dir);
    g_assert_cmpint(g_rmdir(folder), ==, 0);
    g_free(folder);
}

/// A file's bytes, followed by a zero. Free with g_free().
static inline char *file_bytes(const char *folder, const char *name, size_t *size) {
    char *path = g_build_filename(folder, name, NULL);
    FILE *file = fopen(path, "rb");
    g_assert_nonnull(file);
    GStatBuf about;
    g_assert_cmpint(g_stat(path, &about), ==, 0);
    size_t length = (size_t)about.st_size;
    char *bytes = g_malloc0(length + 1);
    g_assert_cmpuint(fread(bytes, 1, length, file), ==, length);
    fclose(file);
    g_free(path);
    if (size != NULL) {
        *size = length;
    }
    return bytes;
}

/// Writes the scene as `name` in `folder` with a way to place leaves; must succeed.
static inline FrIoStats write_scene_at(const FrScene *scene, const char *folder, const char *name,
                                       FrLeaves leaves, int lod) {
    FrIoOptions options = fr_io_options_default();
    options.leaves = leaves;
    options.skin.lod = lod;
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrIoStats stats;
    char *path = g_build_filename(folder, name, NULL);
    FrStatus status = fr_io_write(scene, path, &options, &context, &stats);
    if (status != FR_OK) {
        GString *text = g_string_new(NULL);
        fr_diags_print(context.diags, text);
        g_error("%s: %s", name, text->str);
    }
    fr_diags_free(context.diags);
    g_free(path);
    return stats;
}

static inline FrIoStats write_scene(const FrScene *scene, const char *folder, const char *name,
                                    FrLeaves leaves) {
    return write_scene_at(scene, folder, name, leaves, 0);
}
