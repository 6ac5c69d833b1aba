#include "studio/model/materials.h"

#include "material/texture.h"
#include "studio/model/borrowed.h"
#include "studio/model/commands.h"
#include "studio/model/lamp_private.h"

#include <math.h>
#include <string.h>

bool studio_names_material(const FrParam *param) {
    return param->kind == FR_PARAM_TEXT && (g_str_has_suffix(param->name, "material") ||
                                            g_str_has_prefix(param->meaning, "id of the material"));
}

bool studio_names_picture(const FrParam *param) {
    return param->kind == FR_PARAM_TEXT &&
           fr_params_find(fr_material_table(), param->name) == param &&
           g_str_has_prefix(param->meaning, "file of the");
}

void studio_material_read(const StudioDocument *document, uint32_t material,
                          FrMaterialParams *params) {
    studio_read_params(document, material, fr_material_table(), params);
}

// ---- making and naming -------------------------------------------------------------------------

static void add_splice(GArray *splices, FrSplice splice) {
    g_array_append_val(splices, splice);
}

// The text of an element with another id.
static char *copy_of(const FrContents *contents, uint32_t element, const char *id) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    size_t size;
    const char *text = fr_source_text(fr_contents_source(contents), &size);
    FrSplice rename = fr_contents_set(contents, element, "id", id);
    GString *copy = g_string_new_len(text + at->begin, rename.begin - at->begin);
    g_string_append(copy, rename.text);
    g_string_append_len(copy, text + rename.end, at->end - rename.end);
    g_free(rename.text);
    return g_string_free(copy, FALSE);
}

bool studio_add_material(StudioDocument *document, uint32_t like, uint32_t element,
                         const char *attribute, char **id) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t last = FR_NONE;
    for (uint32_t i = fr_contents_child(contents, 0, "material"); i != FR_NONE;
         i = fr_contents_sibling(contents, i)) {
        last = i;
    }
    const char *stem = like == FR_NONE ? NULL : fr_contents_at(contents, like)->id;
    char *own = studio_free_id(document, 0, stem != NULL ? stem : "material");
    char *xml = stem != NULL ? copy_of(contents, like, own)
                             : g_strdup_printf("<material id=\"%s\" colour=\"#8a8a80\"/>", own);
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    uint32_t first = fr_contents_at(contents, 0)->first;
    if (last == FR_NONE && first != FR_NONE) { // before all else, on a line of its own
        uint32_t begin = fr_contents_at(contents, first)->begin;
        add_splice(splices, (FrSplice){begin, begin, g_strconcat(xml, "\n  ", NULL)});
    } else {
        add_splice(splices, fr_contents_insert(contents, 0, last, xml));
    }
    if (element != FR_NONE) {
        add_splice(splices, fr_contents_set(contents, element, attribute, own));
    }
    char *name = g_strdup_printf("Add material %s", own);
    bool is_added = studio_document_splice(document, splices, name, NULL);
    g_array_unref(splices);
    g_free(name);
    g_free(xml);
    if (is_added && id != NULL) {
        *id = g_steal_pointer(&own);
    }
    g_free(own);
    return is_added;
}

// A list of ids with one of them changed; NULL: it does not name it.
static char *renamed_in(const char *value, const char *from, const char *to) {
    char **words = g_strsplit(value, ",", -1);
    bool is_named = false;
    for (guint i = 0; words[i] != NULL; i++) {
        char *word = g_strstrip(g_strdup(words[i]));
        if (strcmp(word, from) == 0) {
            const char *begin = words[i] + strspn(words[i], " \t\n");
            char *changed = g_strdup_printf("%.*s%s%s", (int)(begin - words[i]), words[i], to,
                                            begin + strlen(from));
            g_free(words[i]);
            words[i] = changed;
            is_named = true;
        }
        g_free(word);
    }
    char *list = is_named ? g_strjoinv(",", words) : NULL;
    g_strfreev(words);
    return list;
}

static void rename_in_element(const FrContents *contents, uint32_t element, const char *from,
                              const char *to, GArray *splices) {
    const FrParamTable *table = fr_contents_at(contents, element)->table;
    for (size_t i = 0; table != NULL && i < table->count; i++) {
        if (!studio_names_material(&table->rows[i])) {
            continue;
        }
        char *attribute = fr_param_attribute(&table->rows[i]);
        char *value = fr_contents_get(contents, element, attribute);
        char *list = value == NULL ? NULL : renamed_in(value, from, to);
        if (list != NULL) {
            add_splice(splices, fr_contents_set(contents, element, attribute, list));
        }
        g_free(list);
        g_free(value);
        g_free(attribute);
    }
}

bool studio_rename_material(StudioDocument *document, uint32_t material, const char *to) {
    const FrContents *contents = studio_document_contents(document);
    const char *from = fr_contents_at(contents, material)->id;
    if (from == NULL || !fr_contents_is_id(to)) {
        return false;
    }
    if (studio_tag_find(contents, 0, STUDIO_TAG_MATERIAL, to) != FR_NONE) {
        return false;
    }
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    add_splice(splices, fr_contents_set(contents, material, "id", to));
    for (uint32_t i = 0; i < fr_contents_count(contents); i++) {
        rename_in_element(contents, i, from, to, splices);
    }
    char *name = g_strdup_printf("Rename %s", from);
    bool is_renamed = studio_document_splice(document, splices, name, NULL);
    g_array_unref(splices);
    g_free(name);
    return is_renamed;
}

char *studio_file_from(const char *folder, const char *path) {
    if (folder == NULL || *folder == '\0') {
        return g_strdup(path);
    }
    char *base = g_canonicalize_filename(folder, NULL), *file = g_canonicalize_filename(path, NULL);
    char **from = g_strsplit(base, "/", -1), **to = g_strsplit(file, "/", -1);
    guint same = 0;
    while (from[same] != NULL && to[same] != NULL && strcmp(from[same], to[same]) == 0) {
        same++;
    }
    GString *text = g_string_new(NULL);
    for (guint i = same; from[i] != NULL; i++) {
        g_string_append(text, "../");
    }
    for (guint i = same; to[i] != NULL; i++) {
        g_string_append_printf(text, "%s%s", i > same ? "/" : "", to[i]);
    }
    if (same < 2) { // nothing but the root: it would not follow if the document moved
        g_string_assign(text, file);
    }
    g_strfreev(from);
    g_strfreev(to);
    g_free(base);
    g_free(file);
    return g_string_free(text, FALSE);
}

// ---- swatches ----------------------------------------------------------------------------------

FrImage *studio_thumbnail(const FrImage *image, uint32_t width, uint32_t height) {
    FrImage *small = fr_image_new(width, height, 4);
    for (uint32_t i = 0; i < width * height; i++) {
        uint32_t x = i % width, y = i / width, sum[4] = {0}, count = 0;
        uint32_t left = x * image->width / width, top = y * image->height / height;
        uint32_t right = MAX((x + 1) * image->width / width, left + 1);
        uint32_t bottom = MAX((y + 1) * image->height / height, top + 1);
        for (uint32_t at = 0; at < (right - left) * (bottom - top); at++, count++) {
            size_t pixel =
                (size_t)(top + at / (right - left)) * image->width + left + at % (right - left);
            const uint8_t *from = image->pixels + pixel * image->channels;
            for (uint32_t c = 0; c < 4; c++) {
                sum[c] += c == 3 ? (image->channels == 4 ? from[3] : 255)
                                 : from[image->channels < 3 ? 0 : c];
            }
        }
        for (uint32_t c = 0; c < 4; c++) {
            small->pixels[4 * i + c] = (uint8_t)((sum[c] + count / 2) / count);
        }
    }
    return small;
}

// The picture's colour at u, v, linear, times the tint; its alpha.
static float colour_at(const FrImage *image, const float tint[3], float u, float v, float out[3]) {
    memcpy(out, tint, 3 * sizeof *out);
    if (image == NULL) {
        return 1;
    }
    uint32_t x = MIN((uint32_t)(u * (float)image->width), image->width - 1);
    uint32_t y = MIN((uint32_t)(v * (float)image->height), image->height - 1);
    const uint8_t *pixel = image->pixels + ((size_t)y * image->width + x) * image->channels;
    vec3s colour;
    for (int c = 0; c < 3; c++) {
        colour.raw[c] = (float)pixel[image->channels < 3 ? 0 : c] / 255;
    }
    colour = fr_colour_linear(colour);
    for (int c = 0; c < 3; c++) {
        out[c] *= colour.raw[c];
    }
    return image->channels == 4 ? (float)pixel[3] / 255 : 1;
}

// Light from the upper left, a little from everywhere, and a highlight as wide as it is rough.
static void shade_ball(float x, float y, float roughness, float colour[3]) {
    static const float light[3] = {-0.45f, 0.55f, 0.70f};
    float z = sqrtf(fmaxf(0, 1 - x * x - y * y));
    float lit = fmaxf(0, x * light[0] + y * light[1] + z * light[2]);
    float half = fmaxf(0, (x * light[0] + y * light[1] + z * (light[2] + 1)) / 1.844f);
    float width = fmaxf(roughness * roughness, 0.05f);
    float gloss = roughness < 1 ? 0.02f / width * powf(half, 2 / (width * width)) : 0;
    for (int c = 0; c < 3; c++) {
        colour[c] = colour[c] * (0.25f + 0.95f * lit) + gloss;
    }
}

static void paint(const FrMaterialParams *params, const FrImage *colours, const float tint[3],
                  float x, float y, float out[4]) {
    bool is_flat = params->texture == FR_TEXTURE_LEAF || params->texture == FR_TEXTURE_PETAL ||
                   (colours != NULL && colours->channels == 4);
    if (is_flat && colours != NULL) {
        float alpha = colour_at(colours, tint, 0.5f + 0.5f * x, 0.5f - 0.5f * y, out);
        out[3] = alpha >= (float)params->alpha_cutoff ? 1 : 0;
        return;
    }
    float square = x * x + y * y;
    out[3] = square < 0.94f ? 1 : 0;
    float z = sqrtf(fmaxf(0, 1 - square));
    float u = 0.5f + atan2f(x, z) / (float)G_PI, v = acosf(fminf(fmaxf(y, -1), 1)) / (float)G_PI;
    colour_at(colours, tint, u, v, out);
    shade_ball(x, y, (float)params->roughness, out);
}

FrImage *studio_swatch(const FrMaterialParams *params, const FrImage *colours, uint32_t size) {
    enum { SAMPLES = 3 };
    FrImage *image = fr_image_new(size, size, 4);
    bool has_file = params->picture != NULL && *params->picture != '\0';
    bool is_made = params->texture != FR_TEXTURE_NONE && !has_file;
    // A picture that is made has the colour already.
    vec3s tint = colours != NULL && is_made ? (vec3s){{1, 1, 1}} : fr_colour_linear(params->colour);
    for (uint32_t i = 0; i < size * size; i++) {
        float sum[4] = {0};
        for (int k = 0; k < SAMPLES * SAMPLES; k++) {
            float out[4];
            float across = (float)(i % size) + ((float)(k % SAMPLES) + 0.5f) / SAMPLES;
            float down = (float)(i / size) + ((float)(k / SAMPLES) + 0.5f) / SAMPLES;
            paint(params, colours, tint.raw, 2 * across / (float)size - 1,
                  1 - 2 * down / (float)size, out);
            for (int c = 0; c < 3; c++) {
                sum[c] += out[c] * out[3];
            }
            sum[3] += out[3];
        }
        for (int c = 0; c < 3; c++) {
            float value = fr_colour_srgb(sum[c] / fmaxf(sum[3], 1e-6f));
            image->pixels[4 * i + (uint32_t)c] = (uint8_t)(value * 255 + 0.5f);
        }
        image->pixels[4 * i + 3] = (uint8_t)(sum[3] / (SAMPLES * SAMPLES) * 255 + 0.5f);
    }
    return image;
}
