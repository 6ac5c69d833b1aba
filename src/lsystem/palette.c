// Colours of the field's programs: a map of 256 triples of bytes, or records of materials of 15
// bytes: index, transparency, ambient, diffuse, emissive and specular colour, shininess.
#include "lsystem/palette.h"

enum { COLOURS = 256, MAP_BYTES = 3 * COLOURS, RECORD_BYTES = 15, DIFFUSE = 5, EMISSIVE = 8 };

static FrMaterial *material_of(unsigned index, const uint8_t *rgb) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.colour = (vec3s){{(float)rgb[0] / 255, (float)rgb[1] / 255, (float)rgb[2] / 255}};
    char *name = g_strdup_printf("colour-%u", index);
    FrMaterial *material = fr_material_new(name, &params, NULL, (FrSpan){0});
    g_free(name);
    fr_params_clear(fr_material_table(), &params);
    return material;
}

FrMaterial **fr_lpalette_read(FrSource *source, FrDiags *diags) {
    size_t size;
    const uint8_t *bytes = (const uint8_t *)(const void *)fr_source_text(source, &size);
    bool is_map = size == MAP_BYTES;
    if (!is_map && (size == 0 || size % RECORD_BYTES != 0)) {
        fr_diags_add(diags, FR_ERROR, "wrong-colour-map", (FrSpan){0},
                     "'%s' is neither a colour map of %d bytes nor materials of %d bytes each",
                     fr_source_name(source), MAP_BYTES, RECORD_BYTES);
        return NULL;
    }
    FrMaterial **colours = g_new0(FrMaterial *, COLOURS);
    for (unsigned i = 0; is_map && i < COLOURS; i++) {
        colours[i] = material_of(i, bytes + 3 * (size_t)i);
    }
    for (size_t at = 0; !is_map && at < size; at += RECORD_BYTES) {
        const uint8_t *record = bytes + at, *diffuse = record + DIFFUSE;
        bool is_dark = diffuse[0] == 0 && diffuse[1] == 0 && diffuse[2] == 0;
        fr_material_unref(colours[record[0]]);
        colours[record[0]] = material_of(record[0], is_dark ? record + EMISSIVE : diffuse);
    }
    return colours;
}

void fr_lpalette_free(FrMaterial **colours) {
    for (unsigned i = 0; colours != NULL && i < COLOURS; i++) {
        fr_material_unref(colours[i]);
    }
    g_free(colours);
}
