#include "glb.h"

#include <math.h>

static FrScene *meadow(uint32_t leaves) {
    FrScene *scene = scene_new();
    uint32_t oak =
        scene_add(scene, plant_with_leaves("oak", leaves, FR_TEXTURE_NONE, FR_TEXTURE_NONE));
    uint32_t elm = scene_add(scene, plant_with_leaves("elm", 3, FR_TEXTURE_NONE, FR_TEXTURE_NONE));
    scene_stand(scene, oak, 1, 2, 0, 1);
    scene_stand(scene, elm, 0, 0, 0.5, 2);
    scene_stand(scene, oak, -3, 0, 1.0, 0.5);
    return scene;
}

/// Every primitive: indices in range, bounds exact, normals unit, coordinates finite.
static void check_primitives(const Glb *glb) {
    size_t m, p;
    json_t *mesh, *primitive;
    json_array_foreach(member(glb->json, "meshes"), m, mesh) {
        json_array_foreach(member(mesh, "primitives"), p, primitive) {
            json_t *attributes = member(primitive, "attributes");
            json_int_t position = integer(attributes, "POSITION");
            json_int_t normal = integer(attributes, "NORMAL");
            json_int_t uv = integer(attributes, "TEXCOORD_0");
            json_int_t index = integer(primitive, "indices");
            json_t *about = element(glb, "accessors", position);
            size_t count = (size_t)integer(about, "count");
            double low[3] = {1e9, 1e9, 1e9}, high[3] = {-1e9, -1e9, -1e9};
            for (size_t v = 0; v < count; v++) {
                double norm = 0;
                for (int k = 0; k < 3; k++) {
                    low[k] = fmin(low[k], accessor_value(glb, position, v, k));
                    high[k] = fmax(high[k], accessor_value(glb, position, v, k));
                    norm += pow(accessor_value(glb, normal, v, k), 2);
                }
                g_assert_cmpfloat_with_epsilon(norm, 1.0, 1e-4);
                g_assert_true(isfinite(accessor_value(glb, uv, v, 0)));
                g_assert_true(isfinite(accessor_value(glb, uv, v, 1)));
            }
            for (size_t k = 0; k < 3; k++) {
                g_assert_cmpfloat((float)part_of(about, "min", k, 0), ==, (float)low[k]);
                g_assert_cmpfloat((float)part_of(about, "max", k, 0), ==, (float)high[k]);
            }
            size_t corners = (size_t)integer(element(glb, "accessors", index), "count");
            g_assert_cmpuint(corners % 3, ==, 0);
            g_assert_cmpuint(corners, >, 0);
            for (size_t i = 0; i < corners; i++) {
                g_assert_cmpfloat(accessor_value(glb, index, i, 0), <, (double)count);
            }
        }
    }
}

static size_t mesh_triangles(const Glb *glb, json_int_t mesh) {
    size_t p, corners = 0;
    json_t *primitive;
    json_array_foreach(member(element(glb, "meshes", mesh), "primitives"), p, primitive) {
        corners +=
            (size_t)integer(element(glb, "accessors", integer(primitive, "indices")), "count");
    }
    return corners / 3;
}

/// What a viewer draws: each node's mesh as often as it is instanced.
static size_t drawn_triangles(const Glb *glb) {
    size_t n, total = 0;
    json_t *node;
    json_array_foreach(member(glb->json, "nodes"), n, node) {
        if (member(node, "mesh") == NULL) {
            continue;
        }
        size_t times = 1;
        json_t *instancing = member(member(node, "extensions"), "EXT_mesh_gpu_instancing");
        if (instancing != NULL) {
            json_int_t at = integer(member(instancing, "attributes"), "TRANSLATION");
            times = (size_t)integer(element(glb, "accessors", at), "count");
        }
        total += times * mesh_triangles(glb, integer(node, "mesh"));
    }
    return total;
}

static void equal_plants_share(void) {
    char *folder = folder_new();
    FrScene *scene = meadow(9);
    FrIoStats stats = write_scene(scene, folder, "a.glb", FR_LEAVES_MERGED);
    Glb glb = glb_read(folder, "a.glb");
    check_primitives(&glb);
    g_assert_cmpuint(json_array_size(member(glb.json, "meshes")), ==, 2);
    g_assert_cmpuint(json_array_size(member(glb.json, "nodes")), ==, 3);
    g_assert_cmpuint(stats.meshes, ==, 2);
    g_assert_cmpuint(stats.triangles, ==, drawn_triangles(&glb));
    g_assert_cmpuint(stats.bytes, ==, 28 + glb.buffer_size + get32(glb.bytes + 12));
    size_t n;
    json_t *root;
    GString *names = g_string_new(NULL);
    json_array_foreach(member(json_array_get(member(glb.json, "scenes"), 0), "nodes"), n, root) {
        json_t *node = element(&glb, "nodes", json_integer_value(root));
        g_string_append_printf(names, "%s;", json_string_value(member(node, "name")));
    }
    g_assert_cmpstr(names->str, ==, "oak 1;oak 2;elm;");
    g_string_free(names, TRUE);
    glb_clear(&glb);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void stands_become_nodes(void) {
    char *folder = folder_new();
    FrScene *scene = meadow(0);
    write_scene(scene, folder, "a.glb", FR_LEAVES_MERGED);
    Glb glb = glb_read(folder, "a.glb");
    // The elm stands at (0, 0, 0.25) z up, turned by half a radian, twice as large.
    json_t *elm = element(&glb, "nodes", 2);
    g_assert_cmpfloat(part_of(elm, "translation", 1, 0), ==, 0.25);
    g_assert_cmpfloat_with_epsilon(part_of(elm, "rotation", 1, 0), sin(0.25), 1e-8);
    g_assert_cmpfloat_with_epsilon(part_of(elm, "rotation", 3, 1), cos(0.25), 1e-8);
    g_assert_cmpfloat(part_of(elm, "scale", 2, 1), ==, 2);
    // What lies to the north, y, lies at −z in glTF.
    json_t *oak = element(&glb, "nodes", 0);
    g_assert_cmpfloat(part_of(oak, "translation", 0, 0), ==, 1);
    g_assert_cmpfloat(part_of(oak, "translation", 2, 0), ==, -2);
    g_assert_null(member(oak, "rotation"));
    g_assert_null(member(oak, "scale"));
    json_t *asset = member(glb.json, "asset");
    g_assert_cmpstr(json_string_value(member(asset, "version")), ==, "2.0");
    g_assert_cmpstr(json_string_value(member(asset, "generator")), ==, "Frond " FR_VERSION);
    g_assert_cmpint(integer(member(asset, "extras"), "seed"), ==, 42);
    char digest[17];
    g_snprintf(digest, sizeof digest, "%016" G_GINT64_MODIFIER "x", fr_scene_digest(scene));
    g_assert_cmpstr(json_string_value(member(member(asset, "extras"), "digest")), ==, digest);
    glb_clear(&glb);
    fr_scene_free(scene);
    remove_folder(folder);
}

/// Adds up all drawn positions of a node: equal sums for files that show the same, whatever their
/// structure. The plant's own node is not moved, so children need no parent's transform.
static void centre(const Glb *glb, json_t *node, double sum[3], size_t *count) {
    if (member(node, "mesh") == NULL) {
        return;
    }
    json_t *mesh = element(glb, "meshes", integer(node, "mesh"));
    json_t *instancing = member(member(node, "extensions"), "EXT_mesh_gpu_instancing");
    json_t *attributes = member(instancing, "attributes");
    size_t p, times = 1;
    if (instancing != NULL) {
        times =
            (size_t)integer(element(glb, "accessors", integer(attributes, "TRANSLATION")), "count");
    }
    json_t *primitive;
    json_array_foreach(member(mesh, "primitives"), p, primitive) {
        json_int_t position = integer(member(primitive, "attributes"), "POSITION");
        size_t vertices = (size_t)integer(element(glb, "accessors", position), "count");
        for (size_t i = 0; i < times * vertices; i++) {
            float at[3], q[4], scale;
            for (int k = 0; k < 4; k++) {
                q[k] = (float)(instancing != NULL
                                   ? accessor_value(glb, integer(attributes, "ROTATION"),
                                                    i / vertices, k)
                                   : part_of(node, "rotation", (size_t)k, k == 3));
            }
            for (int k = 0; k < 3; k++) {
                at[k] = (float)(instancing != NULL
                                    ? accessor_value(glb, integer(attributes, "TRANSLATION"),
                                                     i / vertices, k)
                                    : part_of(node, "translation", (size_t)k, 0));
            }
            scale = (float)(instancing != NULL
                                ? accessor_value(glb, integer(attributes, "SCALE"), i / vertices, 0)
                                : part_of(node, "scale", 0, 1));
            vec3s point;
            for (int k = 0; k < 3; k++) {
                point.raw[k] = scale * (float)accessor_value(glb, position, i % vertices, k);
            }
            point = glms_quat_rotatev((versors){{q[0], q[1], q[2], q[3]}}, point);
            for (int k = 0; k < 3; k++) {
                // Squares too, or a wrong rotation about the middle would not show.
                double value = (double)point.raw[k] + (double)at[k];
                sum[k] += value + 3 * value * value;
            }
            ++*count;
        }
    }
}

static void leaves_stand_alike_at(int lod) {
    static const FrLeaves ways[] = {FR_LEAVES_MERGED, FR_LEAVES_NODES, FR_LEAVES_GPU};
    static const char *const files[] = {"merged.glb", "nodes.glb", "gpu.glb"};
    char *folder = folder_new();
    FrScene *scene = scene_new();
    FrPlant *oak = plant_with_leaves("oak", 40, FR_TEXTURE_NONE, FR_TEXTURE_NONE);
    oak->organs.flags[7] = FR_HIDDEN;
    oak->organs.flags[8] = FR_SHED;
    oak->nodes.flags[4] = FR_SHED; // with node 5 after it: leaves 4, 5, 11, 12 and so on
    scene_stand(scene, scene_add(scene, oak), 0, 0, 0, 1);
    g_array_index(scene->stands, FrStand, 0).at[2] = 0;
    double wanted[3] = {0};
    size_t wanted_count = 0;
    uint64_t wanted_triangles = 0;
    for (int way = 0; way < 3; way++) {
        FrIoStats stats = write_scene_at(scene, folder, files[way], ways[way], lod);
        Glb glb = glb_read(folder, files[way]);
        check_primitives(&glb);
        g_assert_cmpuint(stats.triangles, ==, drawn_triangles(&glb));
        double sum[3] = {0};
        size_t n, count = 0;
        json_t *node;
        json_array_foreach(member(glb.json, "nodes"), n, node) {
            centre(&glb, node, sum, &count);
        }
        if (way == 0) {
            memcpy(wanted, sum, sizeof wanted);
            wanted_count = count;
            wanted_triangles = stats.triangles;
        }
        g_assert_cmpuint(count, ==, wanted_count);
        g_assert_cmpuint(stats.triangles, ==, wanted_triangles);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(sum[k] / (double)count, wanted[k] / (double)wanted_count,
                                           1e-5);
        }
        size_t nodes = json_array_size(member(glb.json, "nodes"));
        g_assert_cmpuint(way == 1 ? 28 : 1 + (way == 2), >=, nodes);
        g_assert_true((nodes < 28) == (way != 1 || lod > 1));
        g_assert_cmpint(member(glb.json, "extensionsRequired") != NULL, ==, way == 2);
        glb_clear(&glb);
    }
    fr_scene_free(scene);
    remove_folder(folder);
}

static void leaves_stand_alike(void) {
    for (int lod = 0; lod < 5; lod++) {
        leaves_stand_alike_at(lod);
    }
}

static void leaves_have_their_material(void) {
    char *folder = folder_new();
    FrScene *scene = scene_new();
    FrPlant *oak = plant_with_leaves("oak", 4, FR_TEXTURE_BARK_FURROWED, FR_TEXTURE_LEAF);
    scene_stand(scene, scene_add(scene, oak), 0, 0, 0, 1);
    write_scene(scene, folder, "a.glb", FR_LEAVES_MERGED);
    Glb glb = glb_read(folder, "a.glb");
    json_t *materials = member(glb.json, "materials");
    g_assert_cmpuint(json_array_size(materials), ==, 2);
    json_t *bark = json_array_get(materials, 0);
    json_t *leaf = json_array_get(materials, 1);
    g_assert_cmpstr(json_string_value(member(bark, "name")), ==, "bark");
    g_assert_cmpstr(json_string_value(member(leaf, "name")), ==, "green_leaf");
    g_assert_null(member(bark, "doubleSided"));
    g_assert_null(member(bark, "alphaMode"));
    g_assert_true(json_is_true(member(leaf, "doubleSided")));
    g_assert_cmpstr(json_string_value(member(leaf, "alphaMode")), ==, "MASK");
    g_assert_cmpfloat(json_number_value(member(leaf, "alphaCutoff")), ==, 0.5);
    json_t *reflection = member(leaf, "pbrMetallicRoughness");
    g_assert_cmpfloat(json_number_value(member(reflection, "metallicFactor")), ==, 0);
    g_assert_null(member(glb.json, "extensionsUsed"));
    // Normal maps come with tangents: unit, perpendicular to the normals, with a sign.
    size_t p;
    json_t *primitive;
    json_array_foreach(member(element(&glb, "meshes", 0), "primitives"), p, primitive) {
        json_t *attributes = member(primitive, "attributes");
        json_int_t tangent = integer(attributes, "TANGENT");
        json_int_t normal = integer(attributes, "NORMAL");
        size_t count = (size_t)integer(element(&glb, "accessors", tangent), "count");
        g_assert_cmpint(integer(element(&glb, "accessors", normal), "count"), ==,
                        (json_int_t)count);
        for (size_t v = 0; v < count; v++) {
            double norm = 0, dot = 0;
            for (int k = 0; k < 3; k++) {
                norm += pow(accessor_value(&glb, tangent, v, k), 2);
                dot += accessor_value(&glb, tangent, v, k) * accessor_value(&glb, normal, v, k);
            }
            g_assert_cmpfloat_with_epsilon(norm, 1, 1e-4);
            g_assert_cmpfloat_with_epsilon(dot, 0, 1e-4);
            g_assert_cmpfloat(fabs(accessor_value(&glb, tangent, v, 3)), ==, 1);
        }
    }
    // Barks repeat, leaves end at their pictures' edges.
    static const json_int_t wraps[] = {10497, 33071};
    for (size_t m = 0; m < 2; m++) {
        json_t *colour = member(member(json_array_get(materials, m), "pbrMetallicRoughness"),
                                "baseColorTexture");
        json_t *texture = element(&glb, "textures", integer(colour, "index"));
        json_t *sampler = element(&glb, "samplers", integer(texture, "sampler"));
        g_assert_cmpint(integer(sampler, "wrapS"), ==, wraps[m]);
        json_t *image = element(&glb, "images", integer(texture, "source"));
        json_t *view = element(&glb, "bufferViews", integer(image, "bufferView"));
        g_assert_cmpstr(json_string_value(member(image, "mimeType")), ==, "image/png");
        g_assert_true(memcmp(glb.buffer + integer(view, "byteOffset"), "\x89PNG", 4) == 0);
    }
    glb_clear(&glb);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void mirrors_and_glass(void) {
    char *folder = folder_new();
    FrScene *scene = scene_new();
    FrPlant *lamp = plant_with_leaves("lamp", 1, FR_TEXTURE_NONE, FR_TEXTURE_NONE);
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.roughness = 0.5;
    params.mirror = 0.25;
    params.clear = 0.5;
    fr_material_unref(lamp->materials->pdata[0]);
    lamp->materials->pdata[0] = fr_material_new("pane", &params, ".", (FrSpan){0});
    fr_params_clear(fr_material_table(), &params);
    scene_stand(scene, scene_add(scene, lamp), 0, 0, 0, 1);
    write_scene(scene, folder, "a.glb", FR_LEAVES_MERGED);
    Glb glb = glb_read(folder, "a.glb");
    json_t *pane = element(&glb, "materials", 0);
    json_t *reflection = member(pane, "pbrMetallicRoughness");
    json_t *through = member(member(pane, "extensions"), "KHR_materials_transmission");
    g_assert_cmpfloat(json_number_value(member(reflection, "metallicFactor")), ==, 0.25);
    g_assert_cmpfloat(json_number_value(member(reflection, "roughnessFactor")), ==, 0.1875);
    g_assert_cmpfloat(json_number_value(member(through, "transmissionFactor")), ==, 0.375);
    json_t *used = member(glb.json, "extensionsUsed");
    g_assert_cmpuint(json_array_size(used), ==, 1);
    g_assert_cmpstr(json_string_value(json_array_get(used, 0)), ==, "KHR_materials_transmission");
    g_assert_null(member(element(&glb, "materials", 1), "extensions"));
    glb_clear(&glb);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void wood_is_whole(void) {
    char *folder = folder_new();
    FrScene *scene = scene_new();
    FrPlant *herb = plant_with_leaves("herb", 4, FR_TEXTURE_LEAF, FR_TEXTURE_LEAF);
    scene_stand(scene, scene_add(scene, herb), 0, 0, 0, 1);
    write_scene(scene, folder, "a.glb", FR_LEAVES_MERGED);
    Glb glb = glb_read(folder, "a.glb");
    json_t *materials = member(glb.json, "materials");
    g_assert_null(member(json_array_get(materials, 0), "alphaMode"));
    g_assert_cmpstr(json_string_value(member(json_array_get(materials, 1), "alphaMode")), ==,
                    "MASK");
    glb_clear(&glb);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void plain_colours_are_linear(void) {
    char *folder = folder_new();
    FrScene *scene = meadow(1);
    write_scene(scene, folder, "a.glb", FR_LEAVES_MERGED);
    Glb glb = glb_read(folder, "a.glb");
    json_t *factor =
        member(member(element(&glb, "materials", 0), "pbrMetallicRoughness"), "baseColorFactor");
    // sRGB 0.5, 0.25, 0.125 by IEC 61966-2-1.
    static const double linear[] = {0.214041, 0.050876, 0.014350, 1.0};
    for (size_t k = 0; k < 4; k++) {
        g_assert_cmpfloat_with_epsilon(json_number_value(json_array_get(factor, k)), linear[k],
                                       1e-5);
    }
    glb_clear(&glb);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void files_beside(void) {
    char *folder = folder_new();
    FrScene *scene = scene_new();
    FrPlant *oak = plant_with_leaves("oak", 4, FR_TEXTURE_NONE, FR_TEXTURE_LEAF);
    scene_stand(scene, scene_add(scene, oak), 0, 0, 0, 1);
    write_scene(scene, folder, "a.glb", FR_LEAVES_MERGED);
    FrIoStats stats = write_scene(scene, folder, "my oak.gltf", FR_LEAVES_MERGED);
    size_t size, binary_size;
    char *text = file_bytes(folder, "my oak.gltf", &size);
    char *binary = file_bytes(folder, "my oak.bin", &binary_size);
    json_t *json = json_loadb(text, size, 0, NULL);
    json_t *buffer = json_array_get(member(json, "buffers"), 0);
    g_assert_cmpstr(json_string_value(member(buffer, "uri")), ==, "my%20oak.bin");
    g_assert_cmpuint((size_t)integer(buffer, "byteLength"), ==, binary_size);
    // The same geometry as in the .glb, which goes on with pictures.
    Glb glb = glb_read(folder, "a.glb");
    g_assert_cmpuint(binary_size, <, glb.buffer_size);
    g_assert_true(memcmp(binary, glb.buffer, binary_size) == 0);
    size_t i;
    json_t *image;
    uint64_t bytes = size + binary_size;
    json_array_foreach(member(json, "images"), i, image) {
        char *name = g_uri_unescape_string(json_string_value(member(image, "uri")), NULL);
        size_t picture_size;
        char *picture = file_bytes(folder, name, &picture_size);
        g_assert_true(memcmp(picture, "\x89PNG", 4) == 0);
        bytes += picture_size;
        g_free(picture);
        g_free(name);
    }
    g_assert_cmpuint(i, >, 0);
    g_assert_cmpuint(stats.bytes, ==, bytes);
    glb_clear(&glb);
    json_decref(json);
    g_free(binary);
    g_free(text);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void nothing_to_show(void) {
    char *folder = folder_new();
    FrScene *scene = scene_new();
    write_scene(scene, folder, "none.glb", FR_LEAVES_MERGED);
    Glb glb = glb_read(folder, "none.glb");
    g_assert_null(member(glb.json, "buffers"));
    g_assert_null(member(glb.json, "meshes"));
    g_assert_null(glb.buffer);
    glb_clear(&glb);
    // A plant without anything still is a node.
    scene_stand(scene, scene_add(scene, fr_plant_new("seed")), 0, 0, 0, 1);
    FrIoStats stats = write_scene(scene, folder, "seed.glb", FR_LEAVES_GPU);
    glb = glb_read(folder, "seed.glb");
    g_assert_cmpuint(json_array_size(member(glb.json, "nodes")), ==, 1);
    g_assert_null(member(glb.json, "meshes"));
    g_assert_cmpuint(stats.triangles, ==, 0);
    glb_clear(&glb);
    static const char *const others[] = {"seed.gltf", "seed.obj", "seed.ply", "seed.stl"};
    for (size_t i = 0; i < G_N_ELEMENTS(others); i++) {
        write_scene(scene, folder, others[i], FR_LEAVES_MERGED);
    }
    fr_scene_free(scene);
    remove_folder(folder);
}

static void limits(void) {
    char *folder = folder_new();
    char *path = g_build_filename(folder, "a.glb", NULL);
    FrScene *scene = meadow(50);
    FrIoOptions options = fr_io_options_default();
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.triangles = 20;
    g_assert_cmpint(fr_io_write(scene, path, &options, &context, NULL), ==, FR_ERR_LIMIT);
    context.limits = fr_limits_default();
    context.limits.organs = 60;
    options.leaves = FR_LEAVES_NODES;
    g_assert_cmpint(fr_io_write(scene, path, &options, &context, NULL), ==, FR_ERR_LIMIT);
    g_assert_cmpuint(fr_diags_error_count(context.diags), ==, 2);
    // A cancelled export leaves nothing.
    context.limits = fr_limits_default();
    context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(context.progress);
    g_assert_cmpint(fr_io_write(scene, path, &options, &context, NULL), ==, FR_CANCELLED);
    char *names = folder_names(folder);
    g_assert_cmpstr(names, ==, "");
    g_free(names);
    // Nor does a path without a known extension.
    g_assert_cmpint(fr_io_write(scene, "a.fbx", &options, &context, NULL), ==, FR_ERR_USAGE);
    g_assert_true(fr_io_can_write("x/A.GLB"));
    g_assert_false(fr_io_can_write("x.glb/a"));
    fr_progress_free(context.progress);
    fr_diags_free(context.diags);
    fr_scene_free(scene);
    g_free(path);
    remove_folder(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/io/gltf/equal plants share a mesh and each stand is a named node",
                    equal_plants_share);
    g_test_add_func("/io/gltf/a stand is moved, turned and scaled, with y up", stands_become_nodes);
    g_test_add_func("/io/gltf/leaves stand alike merged, as nodes and as instances at every level",
                    leaves_stand_alike);
    g_test_add_func("/io/gltf/leaves are masked and double-sided, barks repeat",
                    leaves_have_their_material);
    g_test_add_func("/io/gltf/mirrors are metal and glass transmits", mirrors_and_glass);
    g_test_add_func("/io/gltf/a stem painted as a leaf has no holes", wood_is_whole);
    g_test_add_func("/io/gltf/colours are written linear", plain_colours_are_linear);
    g_test_add_func("/io/gltf/a .gltf has the same buffer and its pictures beside it",
                    files_beside);
    g_test_add_func("/io/gltf/a scene or plant without anything is a valid file", nothing_to_show);
    g_test_add_func("/io/gltf/limits and cancelling leave no file", limits);
    return g_test_run();
}
