#include "studio/model/lamps.h"

#include "frond/document.h"
#include "frond/scene.h"
#include "studio/model/lamp_private.h"
#include "studio/model/scene_edit.h"
#include "studio/model/values.h"

#include <math.h>
#include <string.h>

// ---- what is there -----------------------------------------------------------------------------

uint32_t studio_find_in_scene(const StudioDocument *document, const char *name) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t scene = contents == NULL ? FR_NONE : fr_contents_child(contents, 0, "scene");
    return scene == FR_NONE ? FR_NONE : fr_contents_child(contents, scene, name);
}

void studio_read_params(const StudioDocument *document, uint32_t element, const FrParamTable *table,
                        void *params) {
    const FrContents *contents = studio_document_contents(document);
    fr_params_init(table, params);
    for (size_t i = 0; element != FR_NONE && i < table->count; i++) {
        char *attribute = fr_param_attribute(&table->rows[i]);
        char *value = fr_contents_get(contents, element, attribute);
        if (value != NULL && fr_params_set(table, params, &table->rows[i], value, (FrSpan){0}, NULL,
                                           NULL) != FR_OK) {
            g_debug("%s of a %s is wrong: its default is shown", attribute, table->element);
        }
        g_free(value);
        g_free(attribute);
    }
}

static void lamp_clear(gpointer data) {
    fr_params_clear(fr_lamp_table(), &((StudioLamp *)data)->params);
}

GArray *studio_lamps(const StudioDocument *document) {
    const FrContents *contents = studio_document_contents(document);
    GArray *lamps = g_array_new(FALSE, TRUE, sizeof(StudioLamp));
    g_array_set_clear_func(lamps, lamp_clear);
    for (uint32_t i = studio_find_in_scene(document, "lamp"); i != FR_NONE;
         i = fr_contents_sibling(contents, i)) {
        StudioLamp lamp = {.element = i};
        studio_read_params(document, i, fr_lamp_table(), &lamp.params);
        g_array_append_val(lamps, lamp);
    }
    return lamps;
}

char *studio_lamp_title(const StudioDocument *document, uint32_t element) {
    const FrContents *contents = studio_document_contents(document);
    const char *id = fr_contents_at(contents, element)->id;
    if (id != NULL) {
        return g_strdup(id);
    }
    int number = 1;
    for (uint32_t i = studio_find_in_scene(document, "lamp"); i != FR_NONE && i != element;
         i = fr_contents_sibling(contents, i)) {
        number++;
    }
    return g_strdup_printf("Lamp %d", number);
}

// ---- adding ------------------------------------------------------------------------------------

// Inserts an element into the scene, which is made around it if there is none.
static bool insert(StudioDocument *document, GArray *splices, const char *xml, const char *name) {
    const FrContents *contents = studio_document_contents(document);
    FrSplice splice = studio_scene_insert(contents, FR_NONE, xml);
    g_array_append_val(splices, splice);
    bool is_done = studio_document_splice(document, splices, name, NULL);
    g_array_unref(splices);
    return is_done;
}

static bool can_change(const StudioDocument *document) {
    return studio_document_contents(document) != NULL && !studio_document_is_broken(document);
}

uint32_t studio_add_lamp(StudioDocument *document, const char *kind, const double at[3]) {
    if (!can_change(document)) {
        return FR_NONE;
    }
    char *id = studio_free_name(document, "lamp");
    char *place = studio_vector_text(at, 1);
    char *xml = g_strdup_printf("<lamp id=\"%s\" kind=\"%s\" at=\"%s\"/>", id, kind, place);
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    bool is_done = insert(document, splices, xml, "Add a lamp");
    uint32_t element =
        is_done ? fr_contents_find(studio_document_contents(document), 0, id) : FR_NONE;
    g_free(xml);
    g_free(place);
    g_free(id);
    return element;
}

char *studio_free_name(const StudioDocument *document, const char *stem) {
    const FrContents *contents = studio_document_contents(document);
    char *id = g_strdup(stem);
    for (int k = 2; fr_contents_find(contents, 0, id) != FR_NONE; k++) {
        g_free(id);
        id = g_strdup_printf("%s%d", stem, k);
    }
    return id;
}

uint32_t studio_make_of_scene(StudioDocument *document, const char *name) {
    uint32_t there = studio_find_in_scene(document, name);
    if (there != FR_NONE || !can_change(document)) {
        return there;
    }
    const FrContents *contents = studio_document_contents(document);
    uint32_t scene = fr_contents_child(contents, 0, "scene");
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    if (scene != FR_NONE && strcmp(name, "sun") == 0) { // its angles follow from the date then
        static const char *const angles[] = {"sun-azimuth", "sun-elevation"};
        for (size_t i = 0; i < G_N_ELEMENTS(angles); i++) {
            char *given = fr_contents_get(contents, scene, angles[i]);
            if (given != NULL) {
                FrSplice splice = fr_contents_set(contents, scene, angles[i], NULL);
                g_array_append_val(splices, splice);
            }
            g_free(given);
        }
    }
    char *xml = g_strdup_printf("<%s/>", name);
    char *step = g_strdup_printf("Add %s", strcmp(name, "sun") == 0 ? "a date" : "a light");
    insert(document, splices, xml, step);
    g_free(step);
    g_free(xml);
    return studio_find_in_scene(document, name);
}
