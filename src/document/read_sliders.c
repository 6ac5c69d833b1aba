/// `<slider>`: a number with a name, which the numbers of its plant may use.
#include "document/reader.h"

static void free_slider(void *data) {
    FrSlider *slider = data;
    fr_params_clear(fr_slider_table(), slider);
    g_free(slider->id);
    g_free(slider);
}

static void check_value(FrReader *reader, uint32_t node, const FrSlider *slider,
                        const char *attribute, double value) {
    if (value < slider->min || value > slider->max) {
        fr_read_error(reader, "out-of-range", fr_read_value_place(reader, node, attribute),
                      "%g is outside the slider's range from %g to %g", value, slider->min,
                      slider->max);
    }
}

static void check_range(FrReader *reader, uint32_t node, const FrSlider *slider) {
    if (slider->min > slider->max) {
        fr_read_error(reader, "slider-range", fr_read_value_place(reader, node, "min"),
                      "the least value of a slider, %g, is more than its greatest, %g", slider->min,
                      slider->max);
        return;
    }
    bool is_given = fr_xml_attribute(reader->tree, node, "value") != NULL;
    check_value(reader, node, slider, "initial", slider->initial);
    if (is_given) {
        check_value(reader, node, slider, "value", slider->value);
    }
}

static FrSlider *read_slider(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_SLIDER);
    char *id = fr_read_id(reader, node);
    if (id == NULL) {
        return NULL;
    }
    FrSlider *slider = g_new0(FrSlider, 1);
    fr_params_init(fr_slider_table(), slider);
    slider->id = id;
    fr_read_attributes(reader, node, FR_ELEMENT_SLIDER, slider);
    check_range(reader, node, slider);
    if (fr_xml_attribute(reader->tree, node, "value") == NULL) {
        slider->value = slider->initial;
    }
    return slider;
}

/// Names that `plant.slider` would not reach, or that mean something else in an expression.
static void check_name(FrReader *reader, uint32_t node, const FrSlider *slider, FrScope *scope) {
    FrXmlRange place = fr_read_value_place(reader, node, "id");
    double value;
    if (fr_scope_value(scope, slider->id, &value)) {
        fr_read_error(reader, "duplicate-id", place, "there is a slider '%s' already", slider->id);
    } else if (fr_params_find(fr_element(FR_ELEMENT_PLANT).table, slider->id) != NULL) {
        fr_read_error(reader, "name-taken", place, "a plant has an attribute '%s' already",
                      slider->id);
    } else if (!fr_scope_add_value(scope, slider->id, slider->value)) {
        fr_read_error(
            reader, "name-taken", place,
            "'%s' cannot name a slider: it is a variable, function or curve already, or has "
            "other signs than letters, digits and '_'",
            slider->id);
    }
}

GPtrArray *fr_read_sliders(FrReader *reader, uint32_t plant, FrScope *scope) {
    GPtrArray *sliders = g_ptr_array_new_with_free_func(free_slider);
    for (uint32_t node = fr_read_first(reader, plant, FR_ELEMENT_SLIDER); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_SLIDER)) {
        FrSlider *slider = read_slider(reader, node);
        if (slider != NULL) {
            g_ptr_array_add(sliders, slider);
            check_name(reader, node, slider, scope);
        }
    }
    return sliders;
}

void fr_read_check_sliders(FrReader *reader, uint32_t plant, const FrPgraph *graph) {
    for (uint32_t node = fr_read_first(reader, plant, FR_ELEMENT_SLIDER); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_SLIDER)) {
        const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, node, "id");
        char *id = attribute == NULL ? NULL : fr_xml_decode(reader->tree, attribute->value, true);
        if (id != NULL && fr_pgraph_find(graph, id) != FR_NONE) {
            fr_read_error(reader, "duplicate-id", attribute->value,
                          "a slider and a component of this plant are called '%.64s'", id);
        }
        g_free(id);
    }
}
