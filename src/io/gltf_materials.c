// Materials of a glTF asset: metallic-roughness, holes as a mask, never blended.
#include "io/gltf.h"

// The extension for light that goes straight through.
#define CLEAR "KHR_materials_transmission"

// Names of OpenGL's constants, which glTF uses.
enum { FR_CLAMP_TO_EDGE = 33071, FR_REPEAT = 10497, FR_LINEAR = 9729, FR_MIPMAPS = 9987 };

/// The texture that shows a picture with a way of wrapping, made if it is new.
static int texture_of(json_t *textures, uint32_t picture, bool clamps) {
    json_t *wanted =
        json_pack("{s:i, s:I}", "sampler", clamps ? 1 : 0, "source", (json_int_t)picture);
    size_t index;
    json_t *texture;
    json_array_foreach(textures, index, texture) {
        if (json_equal(texture, wanted)) {
            json_decref(wanted);
            return (int)index;
        }
    }
    json_array_append_new(textures, wanted);
    return (int)json_array_size(textures) - 1;
}

static json_t *material_of(const FrSurface *surface, json_t *textures) {
    FrMaterialParams params = fr_surface_params(surface);
    double tint[3];
    fr_surface_tint(surface, tint);
    json_t *reflection =
        json_pack("{s:[f, f, f, f], s:f, s:f}", "baseColorFactor", tint[0], tint[1], tint[2], 1.0,
                  "metallicFactor", params.mirror, "roughnessFactor",
                  params.roughness * (1 - params.mirror) * (1 - params.clear));
    json_t *material =
        json_pack("{s:s, s:o}", "name", surface->name, "pbrMetallicRoughness", reflection);
    int texture[FR_MAP_COUNT];
    for (FrMap map = 0; map < FR_MAP_COUNT; map++) {
        texture[map] = surface->picture[map] == FR_NONE
                           ? -1
                           : texture_of(textures, surface->picture[map], surface->clamps);
    }
    if (texture[FR_MAP_COLOUR] >= 0) {
        json_object_set_new(reflection, "baseColorTexture",
                            json_pack("{s:i}", "index", texture[FR_MAP_COLOUR]));
    }
    if (texture[FR_MAP_ROUGHNESS] >= 0) {
        json_object_set_new(reflection, "metallicRoughnessTexture",
                            json_pack("{s:i}", "index", texture[FR_MAP_ROUGHNESS]));
    }
    if (texture[FR_MAP_NORMAL] >= 0) {
        json_object_set_new(
            material, "normalTexture",
            json_pack("{s:i, s:f}", "index", texture[FR_MAP_NORMAL], "scale", params.relief));
    }
    if (surface->has_holes) {
        json_object_set_new(material, "alphaMode", json_string("MASK"));
        json_object_set_new(material, "alphaCutoff", json_real(params.alpha_cutoff));
    }
    if (surface->is_foliage) {
        json_object_set_new(material, "doubleSided", json_true());
    }
    if (params.clear > 0) {
        json_object_set_new(material, "extensions",
                            json_pack("{s:{s:f}}", CLEAR, "transmissionFactor",
                                      (1 - params.mirror) * params.clear));
    }
    if (params.translucency > 0.0) {
        json_object_set_new(material, "extras",
                            json_pack("{s:f}", "translucency", params.translucency));
    }
    return material;
}

static json_t *images_of(FrGltf *gltf, bool are_files) {
    json_t *images = json_array();
    for (guint i = 0; i < gltf->surfaces.pictures->len; i++) {
        const FrPicture *picture = fr_surfaces_picture(&gltf->surfaces, i);
        json_t *image = json_object();
        if (are_files) {
            char *uri = g_uri_escape_string(picture->name, NULL, FALSE);
            json_object_set_new(image, "uri", json_string(uri));
            g_free(uri);
        } else {
            gsize size;
            const void *data = g_bytes_get_data(picture->bytes, &size);
            int view = fr_gltf_add_view(gltf, data, size, 0, 0);
            char *name = fr_io_stem(picture->name);
            json_object_set_new(image, "name", json_string(name));
            json_object_set_new(image, "mimeType", json_string(picture->media_type));
            json_object_set_new(image, "bufferView", json_integer(view));
            g_free(name);
        }
        json_array_append_new(images, image);
    }
    return images;
}

static json_t *samplers_of(const json_t *textures) {
    json_t *samplers = json_array();
    for (int clamps = 0; clamps < 2 && json_array_size(textures) > 0; clamps++) {
        int wrap = clamps ? FR_CLAMP_TO_EDGE : FR_REPEAT;
        json_array_append_new(samplers,
                              json_pack("{s:i, s:i, s:i, s:i}", "magFilter", FR_LINEAR, "minFilter",
                                        FR_MIPMAPS, "wrapS", wrap, "wrapT", wrap));
    }
    return samplers;
}

/// Names the extensions that materials use, beside those named already.
static void name_extensions(json_t *root, const json_t *materials) {
    size_t index;
    json_t *material;
    json_array_foreach(materials, index, material) {
        if (json_object_get(material, "extensions") != NULL) {
            json_t *used = json_object_get(root, "extensionsUsed");
            if (used == NULL) {
                used = json_array();
                json_object_set_new(root, "extensionsUsed", used);
            }
            json_array_append_new(used, json_string(CLEAR));
            return;
        }
    }
}

void fr_gltf_add_materials(FrGltf *gltf, json_t *root, bool are_files) {
    json_t *materials = json_array();
    json_t *textures = json_array();
    for (guint i = 0; i < gltf->surfaces.surfaces->len; i++) {
        json_array_append_new(materials,
                              material_of(fr_surfaces_get(&gltf->surfaces, i), textures));
    }
    name_extensions(root, materials);
    json_object_set_new(root, "materials", materials);
    json_object_set_new(root, "textures", textures);
    json_object_set_new(root, "samplers", samplers_of(textures));
    json_object_set_new(root, "images", images_of(gltf, are_files));
}
