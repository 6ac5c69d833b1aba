/// `<vary>`: a plant made from another one, with its `<stroke>`s and `<indicator>`s.
#include "document/reader.h"

#include <cglm/struct.h>

#include <string.h>

static void read_stroke(FrReader *reader, uint32_t node, FrVary *vary) {
    fr_read_check_children(reader, node, FR_ELEMENT_STROKE);
    FrStrokeParams params;
    fr_params_init(fr_stroke_table(), &params);
    fr_read_attributes(reader, node, FR_ELEMENT_STROKE, &params);
    FrStroke *stroke = fr_read_line(reader, node);
    if (stroke != NULL) {
        FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "select"));
        fr_vary_add_stroke(vary, stroke, params.select, (FrApply)params.apply, span);
    }
    fr_stroke_unref(stroke);
    fr_params_clear(fr_stroke_table(), &params);
}

static void read_indicator(FrReader *reader, uint32_t node, FrVary *vary) {
    fr_read_check_children(reader, node, FR_ELEMENT_INDICATOR);
    FrIndicatorParams params;
    fr_params_init(fr_indicator_table(), &params);
    fr_read_attributes(reader, node, FR_ELEMENT_INDICATOR, &params);
    FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "select"));
    fr_vary_add_indicator(vary, glms_vec3_sub(params.to, params.from), params.select,
                          (FrApply)params.apply, span);
    fr_params_clear(fr_indicator_table(), &params);
}

FrVary *fr_read_vary(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_VARY);
    FrVaryParams params;
    fr_params_init(fr_vary_table(), &params);
    fr_read_attributes(reader, node, FR_ELEMENT_VARY, &params);
    if (params.base == NULL && fr_xml_attribute(reader->tree, node, "base") != NULL) {
        fr_read_error(reader, "unknown-plant", fr_read_value_place(reader, node, "base"),
                      "the plant to vary has no name");
    }
    FrVary *vary = fr_vary_new(&params);
    fr_params_clear(fr_vary_table(), &params);
    for (uint32_t child = fr_read_first(reader, node, FR_ELEMENT_STROKE); child != FR_NONE;
         child = fr_read_next(reader, child, FR_ELEMENT_STROKE)) {
        read_stroke(reader, child, vary);
    }
    for (uint32_t child = fr_read_first(reader, node, FR_ELEMENT_INDICATOR); child != FR_NONE;
         child = fr_read_next(reader, child, FR_ELEMENT_INDICATOR)) {
        read_indicator(reader, child, vary);
    }
    return vary;
}

void fr_read_check_bases(FrReader *reader) {
    const GPtrArray *plants = reader->document->plants;
    const char **names = g_new(const char *, plants->len + 1);
    for (guint i = 0; i < plants->len; i++) {
        names[i] = ((const FrPlantDef *)g_ptr_array_index(plants, i))->id;
    }
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        const char *base = plant->vary == NULL ? NULL : fr_vary_params(plant->vary)->base;
        if (base == NULL) {
            continue; // none, or reported as missing
        }
        FrXmlRange place = {plant->span.begin, plant->span.end};
        const FrPlantDef *found = g_hash_table_lookup(reader->plant_ids, base);
        if (found == NULL) {
            char *hint = fr_read_hint(reader, base, names, plants->len);
            fr_read_error(reader, "unknown-plant", place, "there is no plant '%.64s' to vary%s",
                          base, hint);
            g_free(hint);
        } else if (found->kind == FR_PLANT_VARIED) {
            fr_read_error(reader, "varied-base", place,
                          "'%.64s' is varied itself; vary what it is made from", base);
        }
    }
    g_free(names);
}
