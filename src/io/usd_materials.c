// Materials of a USD layer: UsdPreviewSurface, which every reader of USD shows; holes by a
// threshold.
#include "io/usd.h"

#include <string.h>

char *fr_usd_material_name(const FrUsd *usd, uint32_t surface) {
    // Names of surfaces are unique but for characters that USD lacks, so the number is added.
    char *plain = fr_usd_name(fr_surfaces_get(&usd->surfaces, surface)->name);
    char *name = g_strdup_printf("%s_%u", plain, surface + 1);
    g_free(plain);
    return name;
}

typedef struct FrUsdTexture {
    const char *name; ///< of the shader
    FrMap map;
    bool is_colour;             ///< sRGB, else raw numbers
    const double *scale, *bias; ///< four each; NULL: as it is
    const char *outputs;        ///< declared: `float3 outputs:rgb` and the like
} FrUsdTexture;

static void add_four(FrUsd *usd, const char *word, const double values[4]) {
    fr_usd_line(usd, "float4 inputs:%s = (%.6g, %.6g, %.6g, %.6g)", word, values[0], values[1],
                values[2], values[3]);
}

static void add_texture(FrUsd *usd, const char *path, const FrSurface *surface,
                        const FrUsdTexture *texture) {
    const FrPicture *picture = fr_surfaces_picture(&usd->surfaces, surface->picture[texture->map]);
    const char *quote = strchr(picture->name, '@') != NULL ? "@@@" : "@";
    const char *wrap = surface->clamps ? "clamp" : "repeat";
    fr_usd_open(usd, "def Shader \"%s\"", texture->name);
    fr_usd_line(usd, "uniform token info:id = \"UsdUVTexture\"");
    fr_usd_line(usd, "asset inputs:file = %s./%s%s", quote, picture->name, quote);
    fr_usd_line(usd, "token inputs:sourceColorSpace = \"%s\"", texture->is_colour ? "sRGB" : "raw");
    fr_usd_line(usd, "token inputs:wrapS = \"%s\"", wrap);
    fr_usd_line(usd, "token inputs:wrapT = \"%s\"", wrap);
    if (texture->scale != NULL) {
        add_four(usd, "scale", texture->scale);
    }
    if (texture->bias != NULL) {
        add_four(usd, "bias", texture->bias);
    }
    fr_usd_line(usd, "float2 inputs:st.connect = <%s/st.outputs:result>", path);
    char **outputs = g_strsplit(texture->outputs, ";", -1);
    for (char **output = outputs; *output != NULL; output++) {
        fr_usd_line(usd, "%s", *output);
    }
    g_strfreev(outputs);
    fr_usd_close(usd);
}

static bool has(const FrSurface *surface, FrMap map) {
    return surface->picture[map] != FR_NONE;
}

static void add_surface(FrUsd *usd, const char *path, const FrSurface *surface,
                        const FrMaterialParams *params, const double tint[3]) {
    fr_usd_open(usd, "def Shader \"surface\"");
    fr_usd_line(usd, "uniform token info:id = \"UsdPreviewSurface\"");
    if (has(surface, FR_MAP_COLOUR)) {
        fr_usd_line(usd, "color3f inputs:diffuseColor.connect = <%s/colour.outputs:rgb>", path);
    } else {
        fr_usd_line(usd, "color3f inputs:diffuseColor = (%.6g, %.6g, %.6g)", tint[0], tint[1],
                    tint[2]);
    }
    if (has(surface, FR_MAP_COLOUR) && surface->has_holes) {
        fr_usd_line(usd, "float inputs:opacity.connect = <%s/colour.outputs:a>", path);
        fr_usd_line(usd, "float inputs:opacityThreshold = %.6g", MAX(params->alpha_cutoff, 0.001));
    }
    if (has(surface, FR_MAP_NORMAL)) {
        fr_usd_line(usd, "normal3f inputs:normal.connect = <%s/normal.outputs:rgb>", path);
    }
    if (has(surface, FR_MAP_ROUGHNESS)) {
        fr_usd_line(usd, "float inputs:roughness.connect = <%s/roughness.outputs:g>", path);
    } else {
        fr_usd_line(usd, "float inputs:roughness = %.6g", params->roughness);
    }
    fr_usd_line(usd, "float inputs:metallic = 0");
    fr_usd_line(usd, "token outputs:surface");
    fr_usd_close(usd);
}

static void add_textures(FrUsd *usd, const char *path, const FrSurface *surface,
                         const FrMaterialParams *params, const double tint[3]) {
    const double colour[4] = {tint[0], tint[1], tint[2], 1};
    // A normal map's numbers 0 to 1 mean −1 to 1; relief multiplies x and y.
    const double slope[4] = {2 * params->relief, 2 * params->relief, 2, 1};
    const double middle[4] = {-params->relief, -params->relief, -1, 0};
    const double rough[4] = {1, params->roughness, 1, 1};
    const FrUsdTexture textures[] = {
        {"colour", FR_MAP_COLOUR, true, colour, NULL, "float3 outputs:rgb;float outputs:a"},
        {"normal", FR_MAP_NORMAL, false, slope, middle, "float3 outputs:rgb"},
        {"roughness", FR_MAP_ROUGHNESS, false, rough, NULL, "float outputs:g"},
    };
    bool any = false;
    for (size_t i = 0; i < G_N_ELEMENTS(textures); i++) {
        if (has(surface, textures[i].map)) {
            add_texture(usd, path, surface, &textures[i]);
            any = true;
        }
    }
    if (any) {
        fr_usd_open(usd, "def Shader \"st\"");
        fr_usd_line(usd, "uniform token info:id = \"UsdPrimvarReader_float2\"");
        fr_usd_line(usd, "string inputs:varname = \"st\"");
        fr_usd_line(usd, "float2 outputs:result");
        fr_usd_close(usd);
    }
}

static void add_material(FrUsd *usd, const char *scope, uint32_t index) {
    const FrSurface *surface = fr_surfaces_get(&usd->surfaces, index);
    FrMaterialParams params = fr_surface_params(surface);
    double tint[3];
    fr_surface_tint(surface, tint);
    char *name = fr_usd_material_name(usd, index);
    char *path = g_strdup_printf("%s/%s", scope, name);
    fr_usd_open(usd, "def Material \"%s\"", name);
    fr_usd_line(usd, "token outputs:surface.connect = <%s/surface.outputs:surface>", path);
    add_surface(usd, path, surface, &params, tint);
    add_textures(usd, path, surface, &params, tint);
    fr_usd_close(usd);
    g_free(path);
    g_free(name);
}

void fr_usd_materials(FrUsd *usd, const char *path, const bool *used) {
    fr_usd_open(usd, "def Scope \"Materials\"");
    char *scope = g_strconcat(path, "/Materials", NULL);
    for (guint i = 0; i < usd->surfaces.surfaces->len; i++) {
        if (used[i]) {
            add_material(usd, scope, i);
        }
    }
    g_free(scope);
    fr_usd_close(usd);
}
