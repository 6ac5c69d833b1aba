#include "studio/model/levels.h"

#include "frond/species.h"
#include "studio/model/commands.h"
#include "studio/model/place.h"
#include "studio/model/values.h"

#include <string.h>

uint32_t studio_levels_species(const StudioDocument *document, uint32_t selected, uint32_t shown) {
    const FrContents *contents = studio_document_contents(document);
    if (contents == NULL) {
        return FR_NONE;
    }
    uint32_t plant = selected == FR_NONE ? shown : studio_place_plant(contents, selected);
    if (plant == FR_NONE && selected != FR_NONE &&
        strcmp(fr_contents_at(contents, selected)->name, "place") == 0) {
        char *id = fr_contents_get(contents, selected, "plant");
        plant = id == NULL ? FR_NONE : fr_contents_find(contents, 0, id);
        g_free(id);
    }
    return plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "species");
}

bool studio_levels_are_whole(const StudioDocument *document, uint32_t selected) {
    static const char *const whole[] = {"plant", "species", "sliders"};
    const char *name = selected == FR_NONE
                           ? whole[0]
                           : fr_contents_at(studio_document_contents(document), selected)->name;
    for (size_t i = 0; i < G_N_ELEMENTS(whole); i++) {
        if (strcmp(name, whole[i]) == 0) {
            return true;
        }
    }
    return false;
}

double studio_levels_get(const StudioDocument *document, uint32_t species, const char *name) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t sliders = fr_contents_child(contents, species, "sliders");
    char *text = sliders == FR_NONE ? NULL : fr_contents_get(contents, sliders, name);
    const FrParam *row = fr_params_find(fr_species_sliders_table(), name);
    double value;
    if (text == NULL || !studio_value_is_number(text, &value)) {
        value = g_ascii_strtod(row->default_text, NULL);
    }
    g_free(text);
    return value;
}

bool studio_levels_set(StudioDocument *document, uint32_t species, const char *name, double value) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t sliders = fr_contents_child(contents, species, "sliders");
    char *text = studio_value_text(value, 2);
    bool is_changed;
    if (sliders != FR_NONE) {
        is_changed = studio_set(document, sliders, name, text, true);
    } else if (value == studio_levels_get(document, species, name)) {
        is_changed = false;
    } else {
        char *xml = g_strdup_printf("<sliders %s=\"%s\"/>", name, text);
        uint32_t made = species + 1; // the element that it becomes, for which studio_set() goes on
        while (made < fr_contents_count(contents) &&
               fr_contents_at(contents, made)->begin < fr_contents_at(contents, species)->end) {
            made++;
        }
        char *key = g_strdup_printf("%u.%s", made, name);
        char *step = g_strdup_printf("Change %s of sliders", name);
        is_changed = studio_document_splice_one(
            document, fr_contents_insert(contents, species, FR_NONE, xml), step, key);
        g_free(step);
        g_free(key);
        g_free(xml);
    }
    g_free(text);
    return is_changed;
}
