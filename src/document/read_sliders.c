/// `<slider>`: a number with a name, which the numbers of its plant may use.
#include "document/reader.h"

#include <math.h>
#include <string.h>

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

char *fr_slider_choice(const FrSlider *slider) {
    if (slider->choices == NULL) {
        return NULL;
    }
    char **names = g_strsplit(slider->choices, " ", -1);
    double last = (double)g_strv_length(names) - 1;
    char *name = g_strdup(names[(size_t)fmax(0, fmin(floor(slider->value + 0.5), last))]);
    g_strfreev(names);
    return name;
}

/// The names of a slider's values; NULL if it has none.
static char **names_of_choices(FrReader *reader, uint32_t node) {
    const FrXmlAttribute *attribute = fr_xml_attribute(reader->tree, node, "choices");
    if (attribute == NULL) {
        return NULL;
    }
    char *text = fr_xml_decode(reader->tree, attribute->value, true);
    char **names = g_strsplit(text, " ", -1);
    for (guint k = 0; names[k] != NULL; k++) {
        guint first = 0;
        while (strcmp(names[first], names[k]) != 0) {
            first++;
        }
        if (!fr_id_is_valid(names[k]) || first < k) {
            fr_read_error(reader, "bad-choices", attribute->value,
                          "'%.64s' cannot name a value: names differ, are letters, digits, '-' and "
                          "'_', and one blank stands between them",
                          names[k]);
            break;
        }
    }
    g_free(text);
    return names;
}

/// Whether an attribute gives a value by its name, which is then read.
static bool read_named(FrReader *reader, const FrXmlAttribute *attribute, char *const *names,
                       FrSlider *slider) {
    bool is_value = fr_xml_equals(reader->tree, attribute->name, "value");
    if (!is_value && !fr_xml_equals(reader->tree, attribute->name, "initial")) {
        return false;
    }
    char *text = fr_xml_decode(reader->tree, attribute->value, true);
    guint k = 0;
    while (names[k] != NULL && strcmp(names[k], text) != 0) {
        k++;
    }
    bool is_found = names[k] != NULL;
    if (is_found) {
        *(is_value ? &slider->value : &slider->initial) = k;
    } else if (g_ascii_isalpha(*text)) {
        char *hint =
            fr_read_hint(reader, text, (const char *const *)names, g_strv_length((char **)names));
        fr_read_error(reader, "unknown-choice", attribute->value,
                      "'%.64s' is not one of the choices%s", text, hint);
        g_free(hint);
        is_found = true;
    }
    g_free(text);
    return is_found;
}

/// Its attributes. What chooses goes from the first name to the last and begins with that.
static void read_values(FrReader *reader, uint32_t node, FrSlider *slider) {
    char **names = names_of_choices(reader, node);
    if (names == NULL) {
        fr_read_attributes(reader, node, FR_ELEMENT_SLIDER, slider);
        return;
    }
    slider->initial = 0;
    slider->max = g_strv_length(names) - 1.0;
    const FrXmlNode *at = &reader->tree->nodes[node];
    for (uint32_t i = 0; i < at->attribute_count; i++) {
        const FrXmlAttribute *attribute = &reader->tree->attributes[at->attribute + i];
        if (!read_named(reader, attribute, names, slider)) {
            fr_read_attribute(reader, node, attribute, FR_ELEMENT_SLIDER, slider);
        }
    }
    g_strfreev(names);
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
    read_values(reader, node, slider);
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
