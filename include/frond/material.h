/// @file material.h
/// Materials of bark, leaves and petals; image files; textures made by the program.
///
/// Texture coordinates: u across, v along, (0, 0) at the top left of the picture as in glTF.
/// A leaf's picture has its petiole at the bottom centre (v = 1) and its tip at the top (v = 0).
///
/// A leaf or petal fills its picture: a point `along` (0 base, 1 tip) and `across` (−0.5 to 0.5
/// of the blade's full width, > 0 to the right) is at
///
///     u = 0.5 + across        v = 1 − along
///
/// The blade is painted opaque to 1 % of the picture beyond its outline, so geometry cut along the
/// same outline never shows a transparent border; teeth are cut inwards from the outline, so
/// geometry reaches their points. Samplers of such a picture clamp at its edges; barks repeat.
#pragma once

#include "frond/image.h"
#include "frond/param.h"

/// What a texture made by the program shows.
typedef enum FrTextureKind {
    FR_TEXTURE_NONE,
    FR_TEXTURE_LEAF,          ///< blade with venation grown by space colonization (Runions 2005)
    FR_TEXTURE_PETAL,         ///< petal with fine longitudinal veins and a base spot
    FR_TEXTURE_BARK_FURROWED, ///< oak, chestnut, willow
    FR_TEXTURE_BARK_SMOOTH,   ///< beech, cherry, birch: lenticels
    FR_TEXTURE_BARK_PLATED,   ///< pine, plane
} FrTextureKind;

/// Parameters of a material. Where a file is named for a map, it takes the place of the map that
/// `texture` would make. White (the default) for a leaf or a bark that is made stands for a
/// typical green or brown.
#define FR_MATERIAL_PARAMS(X)                                                                      \
    X(COLOUR, colour, "#ffffff", 0, 1, "", "", "base colour; multiplies the picture")              \
    X(COLOUR, second_colour, "#000000", 0, 1, "", "",                                              \
      "veins of a leaf, base of a petal, depth of a bark; black: chosen from the base colour")     \
    X(CHOICE, texture, "none", 0, 0, "", "none leaf petal bark-furrowed bark-smooth bark-plated",  \
      "picture made by the program")                                                               \
    X(TEXT, picture, "", 0, 0, "", "", "file of the base colour, PNG or JPEG, with alpha")         \
    X(TEXT, normal_map, "", 0, 0, "", "", "file of the normal map, +Y up")                         \
    X(TEXT, roughness_map, "", 0, 0, "", "", "file of the roughness, green channel")               \
    X(REAL, roughness, "0.8", 0, 1, "", "", "0 mirror, 1 matt")                                    \
    X(REAL, translucency, "0", 0, 1, "", "", "part of the light that shines through a blade")      \
    X(REAL, mirror, "0", 0, 1, "", "", "part of its light thrown back as by a mirror")             \
    X(REAL, clear, "0", 0, 1, "", "",                                                              \
      "part of the other light that goes straight through, as through glass")                      \
    X(REAL, alpha_cutoff, "0.5", 0, 1, "", "", "pixels with less alpha are holes")                 \
    X(REAL, relief, "1", 0, 4, "", "", "strength of the normal map")                               \
    X(REAL, tile_width, "0.5", 0.001, 100, "m", "", "width of one bark tile on the stem")          \
    X(REAL, tile_height, "0.5", 0.001, 100, "m", "", "height of one bark tile on the stem")        \
    X(INTEGER, size, "512", 16, 4096, "", "", "pixels a side of a picture made by the program")    \
    X(INTEGER, seed, "1", 0, 4294967295.0, "", "", "seed of a picture made by the program")        \
    X(CHOICE, venation, "closed", 0, 0, "", "open closed", "veins end freely, or form loops")      \
    X(CHOICE, vein_pattern, "pinnate", 0, 0, "", "pinnate palmate parallel",                       \
      "main veins: one midrib, several from the base, or many side by side")                       \
    X(REAL, vein_density, "1", 0.1, 8, "", "", "density of veins relative to a typical leaf")      \
    X(POINTS, outline, "", 0, 0, "", "",                                                           \
      "half outline of the leaf in the picture: along 0-1, half width 0-0.5; empty: elliptic")     \
    X(INTEGER, teeth, "0", 0, 200, "", "", "teeth on each side of the picture's margin")           \
    X(REAL, tooth_depth, "0.03", 0, 0.5, "", "", "depth of the teeth, of the leaf's width")        \
    X(TEXT, ramp, "", 0, 0, "", "",                                                                \
      "colours over the season instead of colour: 0 #7fa845, 0.8 #d08a1e")

typedef struct FrMaterialParams {
    FR_MATERIAL_PARAMS(FR_PARAM_FIELD)
} FrMaterialParams;

FR_API const FrParamTable *fr_material_table(void);

typedef enum FrMap {
    FR_MAP_COLOUR,    ///< RGB or RGBA, sRGB; colour dilated under transparent pixels
    FR_MAP_NORMAL,    ///< RGB, linear, +Y up; whoever shows it multiplies x and y by `relief`
    FR_MAP_ROUGHNESS, ///< RGB, linear: G multiplies `roughness`, B metallic 0, R 255
    FR_MAP_COUNT
} FrMap;

/// A material and its pictures, loaded or made on first use. Reference counted, thread-safe.
typedef struct FrMaterial FrMaterial;

/// Takes a copy of `params`. File names are relative to `folder`.
FR_API FrMaterial *fr_material_new(const char *name, const FrMaterialParams *params,
                                   const char *folder, FrSpan span);
/// Where a document names the file of that map: what errors about the picture point at, instead of
/// the material's span. Before the material is shared.
FR_API void fr_material_set_place(FrMaterial *material, FrMap map, FrSpan place);
/// The bytes of that map's file, a PNG or JPEG, instead of those on disk; takes a reference. Before
/// the material is shared.
FR_API void fr_material_set_file(FrMaterial *material, FrMap map, GBytes *bytes);
FR_API FrMaterial *fr_material_ref(FrMaterial *material);
FR_API void fr_material_unref(FrMaterial *material);
FR_API const char *fr_material_name(const FrMaterial *material);
FR_API const FrMaterialParams *fr_material_params(const FrMaterial *material);

/// Colours of a ramp are taken in so many steps.
enum { FR_RAMP_STEPS = 16 };
/// Whether its colour depends on the season.
FR_API bool fr_material_has_ramp(const FrMaterial *material);
/// The material with its colour at step 0 to FR_RAMP_STEPS of its ramp; made on first use, lives as
/// long as the material. The material itself without a ramp.
FR_API FrMaterial *fr_material_at(FrMaterial *material, uint32_t step);
/// False and a diagnostic if the text of a ramp is wrong.
FR_API bool fr_material_check_ramp(const char *text, FrSpan span, FrDiags *diags);

/// What multiplies the colour picture, sRGB: `colour`; but white for a picture made by the program,
/// which holds `colour` already.
FR_API vec3s fr_material_tint(const FrMaterial *material);

/// True if the material has that picture; makes and reads nothing.
FR_API bool fr_material_has(const FrMaterial *material, FrMap map);
/// The picture (borrowed; lives as long as the material) or NULL if it has none or, with a
/// diagnostic and *status set, if it cannot be read. Uses the context's pool: not to be called
/// from inside a parallel loop.
FR_API const FrImage *fr_material_image(FrMaterial *material, FrMap map, const FrContext *context,
                                        FrStatus *status);
/// The bytes of a PNG or JPEG file of that picture: a user's own file unchanged, else a PNG.
FR_API GBytes *fr_material_image_file(FrMaterial *material, FrMap map, const FrContext *context,
                                      const char **media_type, FrStatus *status);
/// True if any pixel of the colour picture may be a hole: made leaves and petals, and PNG files
/// that declare transparency (only the file's bytes are read).
FR_API bool fr_material_has_alpha(const FrMaterial *material);
